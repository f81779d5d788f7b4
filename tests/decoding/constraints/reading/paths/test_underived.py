"""Constructions whose waypoints are left to the model."""

from __future__ import annotations

import pytest

from planner_ft.decoding.constraints.waypoints import read_ground
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()


@pytest.mark.parametrize(
    "text",
    [
        "From [10, 20]: 30 east, 8 south, 30 west, 8 south, 30 east.",
        (
            "40 m east-west, 90 m north-south, SW corner [5, 5]: visit the corners and leave the"
            " loop open."
        ),
        "Both diagonals of the box [0, 0] to [40, 20].",
        "Run from [4, 4] to [9, 9] and then the same distance and direction once more.",
        "[12, 30] from its west side at 20 m, then at 6 m.",
        "A is [1, 2], B is [9, 2], C is [5, 2]. From west to east, please.",
    ],
)
def test_waypoints_are_left_open(text: str) -> None:
    assert read_ground(
        {"task": "Transit", "parameters": {"target_position": [70, 80]}, "prompt": text}, VOCABULARY
    ).free


@pytest.mark.parametrize(("word", "second"), [("cw", (0, -10)), ("ccw", (20, -10))])
def test_clockwise_in_short(word: str, second: tuple[float, float]) -> None:
    record = {
        "task": "SurveyTarget",
        "parameters": {"target_position": [10, 0], "radius": 10},
        "prompt": f"Square round [10, 0], 10 metres, {word} from south.",
    }
    ground = read_ground(record, VOCABULARY)
    assert {path[:2] for path in ([ground.itinerary] if ground.itinerary else ground.paths)} == {
        ((10, -10), second)
    }
