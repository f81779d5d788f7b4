"""Review of a plan by a person: approval log, verification, terminal, browser, harvest."""

from planner_ft.review.approval import Approval, approval_of, approve, reject
from planner_ft.review.log import append, check_log, log_beside, read_log

__all__ = [
    "Approval",
    "append",
    "approval_of",
    "approve",
    "check_log",
    "log_beside",
    "read_log",
    "reject",
]
