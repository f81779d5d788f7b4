"""Order and return of a plan, steps that perform their task at the bound, sizes said together."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.document import revise

from ...documents import USV, document, step, task


def to(x: float, y: float, prompt: str = "Go.") -> dict[str, Any]:
    go = step("GoToXY", {"x": x, "y": y})
    return task("Transit", {"target_position": [x, y]}, [go], prompt)


def hold(seconds: float, prompt: str = "Hold.") -> dict[str, Any]:
    return task(
        "KeepStation", {"duration": seconds}, [step("StationKeep", {"time": seconds})], prompt
    )


def grid(width: float, length: float, prompt: str = "Map it.") -> dict[str, Any]:
    sizes = {"center": [9, 9], "width": width, "length": length, "spacing": 10}
    return task("BathymetryGridSurvey", sizes, None, prompt)


DOCK = task("DockingApproach", {"goal_position": [5, 5]}, [step("GoToXY", {"x": 5, "y": 5})])
LOOK = task("VisualDockingApproach", {"target_feature": "board"}, [step("VisualStationKeep")])
CHECK = task("Diagnostics", {}, [step("StationKeep")])
OPEN = task("Transit", {"target_position": [-99, -99]}, None, "Go to the buoy.")


def told(command: str, *tasks: dict[str, Any], kind: str) -> list[str]:
    plan = document(tasks, command=command)
    return [one["id"].removeprefix(f"{kind}:") for one in plan["warnings"] if one["kind"] == kind]


@pytest.mark.parametrize(
    ("tasks", "missing"),
    [
        ([to(9, 9)], True),
        ([to(9, 9), to(0, 0)], False),
        ([to(0, 0), to(9, 9)], True),
        ([to(9, 9), DOCK], False),
        ([to(9, 9), LOOK], False),
        ([to(9, 9), CHECK], True),
        ([to(9, 9), to(0, 0), CHECK], False),
        ([CHECK], False),
    ],
)
def test_a_plan_comes_home_or_docks(tasks: list[dict[str, Any]], *, missing: bool) -> None:
    assert bool(told("Go to 9,9, come home.", *tasks, kind="missing-return")) is missing


@pytest.mark.parametrize(
    ("command", "asked"),
    [
        ("From home you go to 9,9.", False),
        ("From home base you go to 9,9.", False),
        ("Go to 9,9, within 600 m of home.", False),
        ("From home you go to 9,9, then home.", True),
    ],
)
def test_home_as_a_beginning_is_no_return(command: str, *, asked: bool) -> None:
    assert bool(told(command, to(9, 9), kind="missing-return")) is asked


@pytest.mark.parametrize(
    ("tasks", "ids"),
    [
        ([to(9, 9), hold(60, "Hold at [9, 9].")], []),
        ([to(9, 9), hold(60, "Hold at [9, 8].")], ["t2"]),
        ([to(9, 9), {**CHECK, "task_prompt": "Check at [9, 8]."}], []),
        ([hold(60, "Hold at [9, 9]."), to(9, 9)], ["t1"]),
    ],
)
def test_a_task_is_where_its_prompt_says(tasks: list[dict[str, Any]], ids: list[str]) -> None:
    assert told("Go to 9,9.", *tasks, kind="not-at-place") == ids


def test_a_place_that_is_open_names_its_first_task_and_all() -> None:
    plan = document([CHECK, OPEN, OPEN], command="Go to the buoy.")
    (found,) = [one for one in plan["warnings"] if one["kind"] == "unresolved-location"]
    assert (found["task"], found["parameter"]) == ("t2", "target_position")
    assert "; tasks 2, 3 cannot be carried out" in found["text"]
    plan = document([CHECK, OPEN], command="Go to the buoy.")
    assert "; task 2 cannot be carried out" in str(plan["warnings"])


@pytest.mark.parametrize(
    ("place", "sentence"),
    [
        ("10.5000 N, 170.5000 E", "is a geographic position"),
        ("10.5000 N, 190.5000 E", "is no position on the globe"),
        ("95.1000 N, 10.5000 E", "is no position on the globe"),
    ],
)
def test_a_geographic_place_is_on_the_globe_or_said_not_to_be(place: str, sentence: str) -> None:
    go = task("Transit", {"target_position": [-99, -99]}, None, f"Go to {place}.")
    plan = document([go], command=f"Go to {place}.")
    assert f"{place} {sentence}" in str(plan["warnings"])


@pytest.mark.parametrize(
    ("tasks", "ids"),
    [
        ([grid(50, 20)], []),
        ([grid(20, 50)], []),
        ([grid(50, 10), grid(9, 9)], ["20 m"]),
        ([grid(9, 9), grid(50, 10)], ["20 m"]),
        ([grid(50, 10), grid(20, 10)], ["20 m"]),
        ([grid(7, 7)], ["50", "20 m"]),
        ([grid(50, 10, "Map 50 by 20 m.")], []),
        ([grid(50, 10, "Map 20 by 50 m.")], []),
        ([grid(50, 10, "Map 50 by 20 by 5 m.")], ["20 m"]),
    ],
)
def test_sizes_that_are_said_together_are_of_one_task(
    tasks: list[dict[str, Any]], ids: list[str]
) -> None:
    assert told("Map 50 by 20 m at 9,9, 10 m lines.", *tasks, kind="value-lost") == ids


def test_a_position_is_in_the_plan_or_its_numbers_are_values() -> None:
    assert told("Go to 30,40.", hold(30), hold(40), kind="value-lost") == []
    assert told("Go to 30,40.", hold(30), hold(41), kind="value-lost") == ["30,40"]
    assert told("Go to 30,40.", hold(60, "Hold off [30, 40]."), kind="value-lost") == []
    assert told("Go to 30,40.", to(30, 41), kind="value-lost") == ["30,40"]
    assert told("Go to 30,40.", to(31, 40), kind="value-lost") == ["30,40"]


# ---------------------------------------------------------------- steps that perform their task


def problem(title: str, given: dict[str, Any], steps: list[dict[str, Any]]) -> str:
    plan = document([task(title, given, steps)])
    return " ".join(one["text"] for one in plan["warnings"] if one["kind"] == "not-performed")


@pytest.mark.parametrize(
    ("run", "short"), [(97.6, False), (97.4, True), (100, False), (110, False)]
)
def test_a_pass_may_be_two_hundredths_and_half_a_metre_short(run: float, *, short: bool) -> None:
    ends = [step("GoToXY", {"x": 5, "y": y}) for y in (0, run)]
    found = problem(
        "ParallelStructurePass", {"side_id": "west", "length": 100, "distance": 5}, ends
    )
    assert bool(found) is short and (not short or "97.4 m apart" in found)


def test_a_waypoint_for_clearance_is_none_of_a_pass() -> None:
    ends = [step("GoToXY", {"x": 5, "y": y}) for y in (0, 200, 97.4)]
    given = {"side_id": "west", "length": 100, "distance": 5}
    plan = document([task("ParallelStructurePass", given, [*ends, step("StationKeep")])])
    assert "not-performed" not in str(plan["warnings"])
    mark = {"step": 1, "role": "navigation", "name": "GoToXY", "kind": "clearance", "note": ""}
    plan["tasks"][0]["added"] = [mark]
    assert "97.4 m apart" in str(revise(plan, USV)["warnings"])


@pytest.mark.parametrize(
    ("turns", "named"), [(6, True), (5, False), (4, False), (3, False), (2, True)]
)
def test_a_panorama_of_four_sectors_needs_three_turns(turns: int, *, named: bool) -> None:
    looks = [step("RotateToHeading", {"heading": 90 * one}) for one in range(turns)]
    mixed = [*looks, step("StationKeep")]
    for steps in (looks, mixed):
        assert bool(problem("HorizontalPanorama", {"sectors": 4}, steps)) is named
    nudges = [step("NudgeYaw", {"delta_yaw": 90})] * turns
    assert bool(problem("HorizontalPanorama", {"sectors": 4}, nudges)) is named


def test_only_what_can_be_nothing_may_be_nothing() -> None:
    turn = [step("NudgeYaw", {"delta_yaw": 9}), step("ArcTurn", {"radius": 5, "delta_yaw": 9})]
    given = {"center": [9, 9], "radius": 5}
    assert "radius is 0" in problem("PerformOrbit", {**given, "radius": 0}, turn)
    assert "is 0" not in problem("PerformOrbit", {**given, "arc": 0}, turn)
    assert "is 0" not in problem("PerformOrbit", given, turn)


def test_steps_that_are_out_of_date_or_of_a_search_may_do_anything() -> None:
    go = [step("GoToXY", {"x": 9, "y": 9})]
    assert problem("SearchAndDetect", {"target_description": "buoy"}, go) == ""
    plan = document([task("ThermalHotspotLocalizer", {}, go)])
    assert "not-performed" in str(plan["warnings"])
    plan["tasks"][0]["stale"] = True
    assert "not-performed" not in str(revise(plan, USV)["warnings"])


# ---------------------------------------------------------------- stand-offs


def close(
    *tasks: dict[str, Any], chart: dict[str, tuple[float, float]], limits: tuple[str, ...] = ()
) -> list[str]:
    plan = document(tasks, chart=chart, constraints=limits)
    for entry, own in zip(plan["tasks"], tasks, strict=True):
        entry["skill_sequence"] = own["skill_sequence"]
    found = revise(plan, USV)["warnings"]
    return [one["text"] for one in found if one["kind"] == "structure-close"]


@pytest.mark.parametrize(
    ("mast", "metres"),
    [((50, 9.4), "9.4"), ((50, 9.6), None), ((50, -3), "3.0"), ((-4, 0), None), ((104, 0), "4.0")],
)
def test_a_leg_that_comes_too_close_is_told_in_tenths_of_metres(
    mast: tuple[float, float], metres: str | None
) -> None:
    texts = close(to(100, 0), chart={"mast": mast})
    assert texts == (
        [
            f"Task 1, Transit passes {metres} m from mast at {list(mast)};"
            " the stand-off from it is 10 m."
        ]
        if metres
        else []
    )


def test_each_task_and_structure_is_told_and_a_task_without_steps_is_not() -> None:
    masts = {"one": (50.0, 5.0), "two": (50.0, -6.0)}
    assert len(close(to(100, 0), to(0, 0), chart=masts)) == 4
    assert close(to(100, 0) | {"skill_sequence": None}, chart=masts) == []
    assert len(close(to(40, 0), to(100, 0), chart={"one": (70.0, 5.0)})) == 1


@pytest.mark.parametrize("thing", ["the mast", "[50, 5]", "the mast at [50, 5]"])
def test_a_limit_tells_of_its_structure_itself(thing: str) -> None:
    chart = {"the mast": (50.0, 5.0)}
    limit = "The vehicle stays at least {} m from {}."
    assert close(to(100, 0), chart=chart, limits=(limit.format(4, thing),)) == []
    assert len(close(to(100, 0), chart=chart, limits=(limit.format(4, "the buoy"),))) == 1
