"""The manner of a movement, from the command to the skills, with the agents that ship."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.planning import Planner


@pytest.fixture(scope="module")
def planner() -> Planner:
    return Planner.load(device="cpu")


def _moves(planner: Planner, command: str, title: str) -> list[dict[str, Any]]:
    answer = next(one.answer for one in planner.plan(command).tasks if one.title == title)
    assert answer is not None and answer.plan is not None
    return [step["navigation_skill"]["parameters"] for step in answer.plan["skill_sequence"]]


@pytest.mark.parametrize(
    ("sense", "angle"), [("anticlockwise", -360), ("clockwise", 360), ("", 360)]
)
def test_a_round_goes_the_way_that_is_said(planner: Planner, sense: str, angle: int) -> None:
    moves = _moves(planner, f"Circle the mast at [60, 40] {sense} at 15 m.", "PerformOrbit")
    assert moves[-1] == {"radius": 15, "delta_yaw": angle}


def test_a_survey_begins_on_the_side_that_is_said(planner: Planner) -> None:
    command = "Inspect the pontoon at [100, 80] from 20 m. Start on the west side."
    moves = _moves(planner, command, "SurveyTarget")
    assert (moves[0]["x"], moves[0]["y"]) == (80, 80)
