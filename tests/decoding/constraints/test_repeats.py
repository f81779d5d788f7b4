"""How often a plan may say the same."""

from typing import Any

import pytest

from planner_ft.decoding.constraints.repeats import UNBOUNDED, facing, most_often, repeatable, spent
from planner_ft.vocabulary import load_vocabulary

SKILLS = load_vocabulary().skill
TURN, NUDGE, HOLD, GO = (
    SKILLS[name] for name in ("RotateToHeading", "NudgeYaw", "StationKeep", "GoToXY")
)


@pytest.mark.parametrize(
    ("text", "value", "often"),
    [
        ("Pan 35 degrees to starboard.", 35, 1),
        ("Pan 35 degrees to starboard, four times over.", 35, 4),
        ("yaw 30 left. yaw 60 right. yaw 30 left.", -30, 2),
        ("Turn north, then east, then north.", 0, 2),
        ("Turn to zero nine zero and hold.", 90, 1),
        ("Nudge 5 degrees to port and once more.", -5, 2),
        ("Come to port 40 degrees at a time until the width is covered.", -40, UNBOUNDED),
        ("Hold for one minute. Then hold a second minute.", 60, 2),
        ("Hold.", None, 1),
    ],
)
def test_a_step_comes_as_often_as_the_text_says(text: str, value: Any, often: int) -> None:
    assert most_often(text, value) == often


def test_no_turn_goes_to_where_the_vehicle_points() -> None:
    steps = [(TURN, {"heading": 100}), (HOLD, {"time": 10}), (NUDGE, {"delta_yaw": -20})]
    assert facing(steps) == 80
    assert {"heading": 80} in spent(TURN, steps, "Turn to 100, hold 10 s, pan 20 left.")
    assert facing([*steps, (GO, {"x": 1, "y": 2})]) is None


def test_a_turn_is_spent_when_it_came_as_often_as_it_was_said_and_a_hold_behind_another_step_is_not() -> (
    None
):
    steps = [
        (NUDGE, {"delta_yaw": 35}),
        (HOLD, {"time": 4}),
        (NUDGE, {"delta_yaw": 35}),
        (HOLD, {"time": 4}),
    ]
    text = "Pan 35 degrees, hold 4 s; pan 35 degrees, hold 4 s."
    assert spent(NUDGE, steps, text) == [{"delta_yaw": 35}] and spent(NUDGE, steps[:2], text) == []
    assert spent(HOLD, steps[:3], "Pan 35 degrees, hold 4 s.") == [] and spent(
        HOLD, steps, "Pan 35 degrees, hold 4 s."
    ) == [{"time": 4}]
    assert spent(GO, [(GO, {"x": 1, "y": 2})], "Go to (1, 2).") == []


def test_a_skill_stands_twice_in_a_step_with_other_values_only() -> None:
    sector, lidar = SKILLS["GetSectorDistance"], SKILLS["GetGPSLocation"]
    assert (
        repeatable(sector, [])
        and repeatable(sector, [{"bearing": 0}])
        and not repeatable(sector, [{}])
    )
    assert not repeatable(lidar, [{}])


def test_a_hold_does_not_follow_itself_because_something_else_is_done_every_so_often() -> None:
    hold = (HOLD, {"time": 90})
    text = "Lines every 15 m over the box; behind the last one hold for 90 seconds."
    assert spent(HOLD, [hold], text) == [{"time": 90}]
    assert spent(HOLD, [hold], "Hold 90 seconds, three times.") == []
    path = [hold, (GO, {"x": 1, "y": 2}), hold, (GO, {"x": 3, "y": 4})]
    assert spent(HOLD, path, text) == [{"time": 90}]
    assert spent(HOLD, path, "Grid; hold 90 seconds at every waypoint.") == []
