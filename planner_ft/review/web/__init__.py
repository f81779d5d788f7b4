"""The review in the browser: `plannerft review --web`."""

from planner_ft.review.web.server import serve
from planner_ft.review.web.session import WebSettings

__all__ = ["WebSettings", "serve"]
