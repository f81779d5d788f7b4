"""The review in the browser: `plannerft review --web`."""

from planner_ft.review.web.server import serve as serve
from planner_ft.review.web.session import WebSettings as WebSettings
