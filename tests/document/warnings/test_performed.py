"""Steps that do not perform their task."""

from __future__ import annotations

from typing import Any

import pytest

from tests.documents import DRONE, document, step, task

GRID = {"center": [100, 50], "width": 20, "length": 20, "spacing": 10}


def lanes(xs: list[float], south: float, north: float) -> list[dict[str, Any]]:
    return [step("GoToXY", {"x": x, "y": y}) for x in xs for y in (south, north)]


def found(title: str, parameters: dict[str, Any], steps: list[dict[str, Any]]) -> list[str]:
    made = document([task(title, parameters, steps)], command="Do it.")
    return [item["text"] for item in made["warnings"] if item["kind"] == "not-performed"]


def test_a_grid_that_leaves_half_of_its_area_is_named() -> None:
    assert found("BathymetryGridSurvey", GRID, lanes([90, 100, 110], 40, 60)) == []
    (text,) = found("BathymetryGridSurvey", GRID, lanes([90, 100, 110], 50, 60))
    assert "span 20 m by 10 m, and the area is 20 m by 20 m" in text


@pytest.mark.parametrize(
    ("words", "kept"),
    [
        ("lines 10 m apart north-south", True),
        ("lines 10 m apart, N to S", True),
        ("lines 10 m apart east-west", False),
        ("start in the south-west corner", True),
        ("start in the north-west corner", False),
        ("start in the north-east corner", False),
    ],
)
def test_lines_that_lie_as_the_command_says_are_not_lost(words: str, kept: bool) -> None:
    grid = task("BathymetryGridSurvey", GRID, lanes([90, 100, 110], 40, 60))
    made = document([grid], command=f"Map 20 by 20 m round 100,50, {words}.")
    assert ("value-lost" not in {one["kind"] for one in made["warnings"]}) is kept


RING = [(20.0, 0.0), (20.0, 20.0), (-20.0, 20.0), (-20.0, -20.0), (20.0, -20.0)]


def go_round(points: list[tuple[float, float]]) -> dict[str, Any]:
    steps = [step("GoToXY", {"x": 60 + x, "y": 40 + y}) for x, y in points]
    return task("SurveyTarget", {"target_position": [60, 40], "radius": 20}, steps)


def arc(angle: float | None, prompt: str = "Do it.") -> dict[str, Any]:
    turn = step("ArcTurn", {"radius": 20, **({} if angle is None else {"delta_yaw": angle})})
    given = {"center": [60, 40], "radius": 20, "arc": 360}
    return task("PerformOrbit", given, None if prompt != "Do it." else [turn], prompt)


def look(*headings: float) -> dict[str, Any]:
    turns = [step("RotateToHeading", {"heading": heading}) for heading in headings]
    return task("HorizontalPanorama", {"sectors": 4}, turns)


@pytest.mark.parametrize(
    ("words", "tasks", "kept"),
    [
        ("anticlockwise", [arc(360)], False),
        ("anticlockwise", [arc(-360)], True),
        ("Counter-clockwise", [arc(None)], False),
        ("clockwise", [arc(None)], True),
        ("clockwise", [go_round(RING)], False),
        ("CCW", [go_round(RING)], True),
        ("counter-clockwise", [arc(-360)], True),
        ("clockwise", [go_round(RING[::-1])], True),
        ("anticlockwise", [arc(None, "Circle it anticlockwise.")], True),
        ("anticlockwise", [arc(None, "Circle it.")], False),
        ("clockwise and then anticlockwise", [arc(360), arc(-360)], True),
        ("clockwise and then anticlockwise", [arc(360), arc(360)], False),
        ("clockwise, sorry, anticlockwise", [arc(-360)], True),
        ("clockwise. No, hang on, anticlockwise", [arc(-360)], True),
        ("clockwise no anticlockwise", [arc(-360)], True),
        ("not clockwise", [arc(-360)], True),
        ("anticlockwise", [look(0, 270, 180, 90)], True),
        ("anticlockwise", [look(0, 90, 180, 270)], False),
    ],
)
def test_a_sense_of_rotation_that_no_task_has_is_told(
    words: str, tasks: list[dict[str, Any]], kept: bool
) -> None:
    made = document(tasks, command=f"Go round the mast at 60,40 {words}.")
    lost = [one["id"].casefold() for one in made["warnings"] if one["kind"] == "value-lost"]
    assert (not [one for one in lost if "clockwise" in one or "ccw" in one]) is kept


@pytest.mark.parametrize(
    ("words", "prompt", "told"),
    [
        ("contrary to the clock", "Circle it clockwise.", True),
        ("contrary to the clock", "Circle it anticlockwise.", True),
        ("contrary to the clock", "Circle it.", False),
        ("clockwise", "Circle it clockwise.", False),
        ("keeping it to port", "Circle it anticlockwise.", False),
    ],
)
def test_a_sense_of_rotation_in_other_words_is_told(words: str, prompt: str, told: bool) -> None:
    made = document([arc(None, prompt)], command=f"Go round the mast at 60,40 once, {words}.")
    texts = [one["text"] for one in made["warnings"] if one["kind"] == "value-not-said"]
    assert any("its prompt says" in text and "clockwise" in text for text in texts) is told


def test_a_grid_that_is_run_twice_unasked_is_named() -> None:
    there_and_back = [*lanes([90, 100, 110], 40, 60), *lanes([110, 100, 90], 60, 40)]
    (text,) = found("BathymetryGridSurvey", GRID, there_and_back)
    assert text.endswith("it goes to 6 of its waypoints again.")
    asked = task("BathymetryGridSurvey", GRID, there_and_back, "Survey it there and back.")
    kinds = [one["kind"] for one in document([asked], command="Do it.")["warnings"]]
    assert "not-performed" not in kinds


@pytest.mark.parametrize("xs", [[85, 105], [85, 105, 115]])
def test_lanes_need_not_divide_the_area(xs: list[float]) -> None:
    wide = {**GRID, "width": 30, "spacing": 20}
    assert found("BathymetryGridSurvey", wide, lanes(xs, 40, 60)) == []


def test_a_task_whose_steps_only_go_there_is_named() -> None:
    go = step("GoToXY", {"x": 10, "y": 10})
    (text,) = found("ThermalHotspotLocalizer", {}, [go])
    assert "no step performs it" in text
    assert found("ThermalHotspotLocalizer", {}, [go, step("RotateToHeading")]) == []
    assert found("Transit", {"target_position": [10, 10]}, [go]) == []


def test_a_transit_that_stays_is_named() -> None:
    title, place = DRONE.transit, DRONE.task[DRONE.transit].position_parameter
    made = document([task(title, {place: [9, 9]}, [step("Hover", {"time": 9})])], DRONE)
    told = [one["text"] for one in made["warnings"] if one["kind"] == "not-performed"]
    assert len(told) == 1 and told[0].startswith(f"Task 1, {title}: n")


def test_a_transit_that_ends_at_a_stand_off_is_gone() -> None:
    crane = "Go to the crane at [40, 30]."
    go = step("GoToXY", {"x": 40, "y": 30})
    made = document([task("Transit", {"target_position": [40, 30]}, [go], crane)], command=crane)
    assert made["tasks"][0]["added"]
    assert "not-performed" not in [one["kind"] for one in made["warnings"]]


def test_a_pass_that_is_shorter_than_its_length_is_named() -> None:
    given = {"side_id": "west", "length": 60, "distance": 5}
    whole, none = (
        [step("GoToXY", {"x": 35, "y": y}) for y in ends] for ends in ((-20, 40), (9, 9))
    )
    assert found("ParallelStructurePass", given, whole) == []
    (text,) = found("ParallelStructurePass", given, none)
    assert "0 m apart, and its length is 60 m" in text


def test_a_line_that_leaves_its_course_is_named() -> None:
    given = {"start": [20, 20], "heading": 45, "max_dist": 100}
    ends = [step("GoToXY", {"x": x, "y": y}) for x, y in ((20, 20), (90.71, 90.71))]
    assert found("SubseaCableTrack", given, ends) == []
    (text,) = found("SubseaCableTrack", {**given, "heading": 90}, ends)
    assert "no waypoint is at [120, 20], 100 m on 90 from its start" in text


def test_a_waypoint_of_a_survey_that_is_off_its_square_is_named() -> None:
    given = {"target_position": [0, 0], "radius": 10}
    square = [
        step("GoToXY", {"x": x, "y": y}) for x, y in ((10, 0), (10, 10), (0, 10), (-7.07, 7.07))
    ]
    assert found("SurveyTarget", given, square) == []
    (text,) = found("SurveyTarget", given, [*square, step("GoToXY", {"x": -8, "y": 8})])
    assert "waypoint [-8, 8] is not 10 m off its target" in text


def test_a_panorama_that_does_not_look_round_is_named() -> None:
    looks = [step("RotateToHeading", {"heading": heading}) for heading in (0, 120, 240)]
    assert found("HorizontalPanorama", {"sectors": 3}, looks) == []
    (text,) = found("HorizontalPanorama", {"sectors": 8}, looks)
    assert "it turns 3 times for 8 sectors" in text


def test_a_pass_with_one_waypoint_and_values_of_nothing_are_named() -> None:
    given = {"side_id": "west", "length": 60, "distance": 5}
    (text,) = found("ParallelStructurePass", given, [step("GoToXY", {"x": 35, "y": 10})])
    assert "its waypoints are 0 m apart, and its length is 60 m" in text
    texts = found("BathymetryGridSurvey", {**GRID, "spacing": 0}, lanes([90, 110], 40, 60))
    assert texts[0].endswith("spacing is 0, with which nothing can be done.")
    assert found("SubseaCableTrack", {"start": [9, 9], "heading": 0}, [step("StationKeep")]) != []
    turn = [step("NudgeYaw", {"delta_yaw": 0})]
    assert not [one for one in found("PerformOrbit", {"arc": 0}, turn) if "arc" in one]


def test_ends_of_a_pass_follow_from_its_values() -> None:
    given = {"side_id": "north", "length": 50, "distance": 6}
    prompt = "Run along the north side of the quay at [80, 30] for 50 m, 6 m off."
    for west, expected in ((55, set()), (57, {"skill-value-not-said"})):
        ends = [step("GoToXY", {"x": x, "y": 36}) for x in (west, 105)]
        plan = document([task("ParallelStructurePass", given, ends, prompt)])
        assert {one["kind"] for one in plan["warnings"]} & {"skill-value-not-said"} == expected
