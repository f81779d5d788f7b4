"""Places that an ordinal picks or leaves out."""

from __future__ import annotations

from typing import Any

import pytest

from ...documents import document, step, task

BUOYS = "There are buoys at 20,0 and 40,0, "


def to(x: float, *perception: str) -> dict[str, Any]:
    seen = [{"name": name, "parameters": {}} for name in perception]
    steps = [{**step("GoToXY", {"x": x, "y": 0}), "perception_skills": seen}]
    return task("Transit", {"target_position": [x, 0]}, steps)


def hold() -> dict[str, Any]:
    return task("KeepStation", {"duration": 60}, [step("StationKeep", {"time": 60})])


def orbit(x: float) -> dict[str, Any]:
    values = {"center": [x, 0], "radius": 15, "arc": 360}
    return task("PerformOrbit", values, [step("ArcTurn", {"radius": 15, "angle": 360})])


def said(command: str, *tasks: dict[str, Any]) -> list[str]:
    warnings = document([*tasks], command=command)["warnings"]
    return [one["text"] for one in warnings if "does not keep to that" in one["text"]]


@pytest.mark.parametrize(
    ("command", "right", "wrong"),
    [
        (f"{BUOYS}circle the second.", [orbit(40)], [orbit(20), orbit(40)]),
        (f"{BUOYS}circle the last one.", [orbit(40)], [orbit(20)]),
        (
            "Visit 2,0, 4,0 and 6,0, depth logged at the last one only.",
            [to(2), to(4), to(6, "GetSeabedDepth")],
            [to(2), to(4, "GetSeabedDepth"), to(6, "GetSeabedDepth")],
        ),
        (
            "Visit 2,0, 4,0 and 6,0 and hold for 60 s at the middle waypoint.",
            [to(2), to(4), hold(), to(6)],
            [to(2), to(4), to(6), hold()],
        ),
        (
            "Hold 60 s at 2,0 and at 4,0. No hold at the second place.",
            [to(2), hold(), to(4)],
            [to(2), hold(), to(4), hold()],
        ),
        ("Visit 2,0, 4,0 and 6,0. Skip the last two.", [to(2)], [to(2), to(4)]),
        (
            "Go to 9,0. Then 2,0 and 4,0, hold for 60 s at the first.",
            [to(2), hold()],
            [to(4), hold()],
        ),
    ],
)
def test_what_is_done_elsewhere_than_at_the_place_that_is_picked_is_a_contradiction(
    command: str, right: list[dict[str, Any]], wrong: list[dict[str, Any]]
) -> None:
    assert said(command, *right) == []
    assert len(said(command, *wrong)) == 1


def test_one_of_several_tasks_at_places_that_are_left_out_is_named() -> None:
    found = said("Visit 2,0, 4,0 and 6,0. Skip the last two.", to(2), to(4), to(6))
    assert len(found) == 1 and "task 2" in found[0]


@pytest.mark.parametrize(
    "command",
    [
        "Go to 2,0 and 4,0, wait a second at each.",
        "First go to 2,0, then to 4,0 and hold for 60 s.",
        "Go to 2,0 and 4,0. On the second lap hold for 60 s.",
        "Hold at 2,0 and 4,0 for 60 s; hold at the first one.",
    ],
)
def test_other_ordinals_and_what_is_asked_for_twice_pick_no_place(command: str) -> None:
    assert said(command, to(2), hold(), to(4), hold()) == []


def test_a_place_that_is_left_out_is_not_missing_from_its_row() -> None:
    command = "Go to 1,0, 3,0 and 5,0 in turn, skip the middle one."
    assert document([to(1), to(5)], command=command)["warnings"] == []


@pytest.mark.parametrize(
    ("behind", "tasks", "count"),
    [
        ("", [to(40)], 1),
        (", then wait a minute at 40,0", [to(40), hold()], 0),
        (", then go to 40,0", [to(40)], 0),
        (", home", [to(0)], 0),
    ],
)
def test_a_corner_of_a_surveyed_area_is_not_gone_to(
    behind: str, tasks: list[dict[str, Any]], count: int
) -> None:
    values = {"center": [20, 10], "width": 40, "length": 20, "spacing": 10}
    grid = task("BathymetryGridSurvey", values, None)
    command = f"Sound the box 0,0 / 40,0 / 40,20 / 0,20, 10 m lines{behind}."
    warnings = document([grid, *tasks], command=command)["warnings"]
    asked = [one for one in warnings if "no words of the command" in one["text"]]
    assert len(asked) == count


def test_an_ordinal_beyond_the_places_picks_none() -> None:
    assert said("Go to 20,0 and 40,0. Skip the fourth. Hold at the last one.", to(40), hold()) == []


@pytest.mark.parametrize(
    ("command", "feature", "count"),
    [
        ("Film the flare tip for a minute. Track the subsea cable from 0,0.", "subsea cable", 1),
        ("Film the flare tip for a minute. Track the subsea cable from 0,0.", "flare tip", 0),
        ("Film the cable end for a minute. Track the cable from 0,0.", "cable", 0),
        ("Look at the cable and film it. Track the subsea line from 0,0.", "cable", 0),
        ("Track the subsea cable from 0,0.", "subsea cable", 1),
    ],
)
def test_a_name_that_is_said_of_another_task_alone_is_told(
    command: str, feature: str, count: int
) -> None:
    stare = task("FeatureStare", {"feature_type": feature, "duration": 60}, [])
    track = task("SubseaCableTrack", {"start": [0, 0]}, [])
    warnings = document([stare, track], command=command)["warnings"]
    assert sum("of another task alone" in one["text"] for one in warnings) == count
