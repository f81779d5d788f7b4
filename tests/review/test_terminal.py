"""What a review in the terminal shows of a plan."""

from __future__ import annotations

import pytest

from planner_ft.review.terminal import review_lines
from planner_ft.review.verify import Approval
from planner_ft.vocabulary import Vocabulary
from tests.review.conftest import go, mission_document, task


@pytest.mark.parametrize(
    ("holds", "shown"), [(0, "m/s; ends"), (1, "of task 2"), (2, "of tasks 2, 3")]
)
def test_the_estimate_names_the_tasks_of_unknown_time(
    usv: Vocabulary, holds: int, shown: str
) -> None:
    there = task("Transit", {"target_position": [9, 2]}, "Go to [9, 2].")
    tasks = [there, *[task("KeepStation", {}, "Hold.")] * holds]
    document = mission_document("Go to [9, 2] and hold.", tasks, {1: go((9, 2))}, usv)
    approval = Approval("unknown", "no decision", "")
    lines = [text for text, _style in review_lines(document, approval, usv)]
    (estimate,) = [text for text in lines if "at a cruise speed" in text]
    assert shown in estimate
