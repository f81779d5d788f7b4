"""The review in the browser: `plannerft review --web`.

`server` listens, `guard` keeps strangers out, `app` answers, `session` is the review itself, with
the folder's plans in `plans`, the agents in `planning` and the news for open pages in `events`. The
page's own files are in `page`.
"""

from planner_ft.review.web.server import serve
from planner_ft.review.web.session import WebSettings

__all__ = ["WebSettings", "serve"]
