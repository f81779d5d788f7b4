"""A person decides about a plan: the approval log, whether a plan is the one that was approved,
review in the terminal, harvest.

`approval` takes decisions, `log` and `chain` keep them, `verify` and `changes` compare a plan with
what was approved.
"""

from planner_ft.review.approval import approve, reject
from planner_ft.review.log import append, check_log, log_beside, read_log
from planner_ft.review.verify import Approval, approval_in, approval_of

__all__ = [
    "Approval",
    "append",
    "approval_in",
    "approval_of",
    "approve",
    "check_log",
    "log_beside",
    "read_log",
    "reject",
]
