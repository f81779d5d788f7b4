"""Review of a plan by a person: approval log, verification, terminal, browser, harvest."""

from planner_ft.review.approval import approval_of as approval_of
from planner_ft.review.approval import approve as approve
from planner_ft.review.approval import reject as reject
from planner_ft.review.log import log_beside as log_beside
from planner_ft.review.log import read_log as read_log
