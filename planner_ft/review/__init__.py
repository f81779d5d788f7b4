"""Review of a plan by a person: approval log, verification, review in terminal and browser, harvest.

`approval` takes decisions, `log` and `chain` keep them, `verify` and `changes` compare a plan with
the approved one. `desk` is a plan in review, which `terminal` and `web` show; `commands` are typed
edits. `harvest` turns reviewed plans into training samples.
"""

from planner_ft.review.approval import approve, reject
from planner_ft.review.log import append, check_log, log_beside, read_log
from planner_ft.review.verify import Approval, approval_of

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
