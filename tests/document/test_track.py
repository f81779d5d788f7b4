"""Where a plan's skills take the vehicle."""

from __future__ import annotations

import dataclasses
import itertools
import json
import math
import tomllib
from pathlib import Path
from typing import Any

import pytest

import planner_ft.vocabulary
from planner_ft.document.track import Track, estimate, stated, track
from planner_ft.support.files import read_toml
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import build_vocabulary
from tests.documents import DRONE, USV, document, step, task


def of(*tasks: dict[str, Any]) -> Track:
    return track(document(tasks), USV)


def transit(x: float, y: float, steps: list[dict[str, Any]] | None = None) -> dict[str, Any]:
    return task(
        "Transit",
        {"target_position": [x, y]},
        steps if steps is not None else [step("GoToXY", {"x": x, "y": y})],
    )


def test_legs_follow_each_other_from_home() -> None:
    path = of(transit(30, 40), transit(0, 0))
    assert [leg.points for leg in path.legs] == [((0, 0), (30, 40)), ((30, 40), (0, 0))]
    assert [leg.metres for leg in path.legs] == [50, 50]
    assert path.legs[0].seconds == pytest.approx(50 / 1.5)


def test_a_task_s_own_speed_counts() -> None:
    path = of(task("ParallelStructurePass", {"speed": 0.5}, [step("GoToXY", {"x": 0, "y": 10})]))
    assert path.legs[0].seconds == 20


def test_a_limit_of_speed_holds_for_the_way() -> None:
    plan = document([transit(0, 10)], constraints=["The vehicle goes no faster than 0.5 m/s."])
    assert track(plan, USV).legs[0].seconds == 20
    own = task("ParallelStructurePass", {"speed": 2}, [step("GoToXY", {"x": 0, "y": 10})])
    limit = "The vehicle goes no faster than 0.5 m/s during Transit."
    plan = document([own, transit(0, 0)], constraints=[limit])
    assert [leg.seconds for leg in track(plan, USV).legs] == [5, 20]


def test_the_time_of_a_task_is_that_of_its_one_stay() -> None:
    stay = [step("VisualStationKeep")]
    path = of(transit(0, 15), task("FeatureStare", {"duration": 120}, stay))
    assert path.legs[-1].seconds == 120
    assert of(task("FeatureStare", {}, stay)).legs[-1].seconds is None
    assert of(task("FeatureStare", {"duration": 9}, stay * 2)).legs[-1].seconds is None


def own(*changes: tuple[str, str], motion: dict[str, Any] | None = None) -> Vocabulary:
    """The drone with another definition."""
    folder = Path(planner_ft.vocabulary.__file__).parent
    text = (folder / "inspection_drone.toml").read_text()
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    known = read_toml(folder / "inspection_drone.motion.toml")
    return build_vocabulary(tomllib.loads(text), {}, "own", motion={**known, **(motion or {})})


def test_a_task_s_time_is_converted_and_may_have_another_name() -> None:
    hover = 'name = "duration", type = "number", unit = "s"'
    minutes = own((hover, 'name = "duration", type = "number", unit = "min"'))
    hold = {"id": "t1", "title": "HoverWatch", "parameters": {"duration": 2}}
    assert stated(hold, "time", minutes) == ("duration", 120)
    other = own((hover, 'name = "interval", type = "number", unit = "s"'))
    hold["parameters"] = {"interval": 2}
    assert stated(hold, "time", other) is None
    named = own(
        (hover, 'name = "interval", type = "number", unit = "s"'),
        motion={"task": {"HoverWatch": {"time": "interval"}}},
    )
    assert stated(hold, "time", named) == ("interval", 2)


def test_an_arc_goes_round_the_task_s_centre_clockwise() -> None:
    circle = step("ArcTurn", {"radius": 10, "delta_yaw": 90})
    path = of(
        transit(0, 110),
        task("PerformOrbit", {"center": [0, 100], "radius": 10, "arc": 90}, [circle]),
    )
    leg = path.legs[-1]
    assert (
        leg.kind == "arc"
        and leg.points[0] == (0, 110)
        and leg.points[-1] == pytest.approx((10, 100))
    )
    assert leg.metres == pytest.approx(10 * math.pi / 2)
    assert all(math.dist(point, (0, 100)) == pytest.approx(10, abs=0.01) for point in leg.points)
    assert all(math.dist(*pair) < 3 for pair in itertools.pairwise(leg.points))


def test_an_arc_from_the_centre_goes_out_to_the_circle_first() -> None:
    path = of(
        task(
            "PerformOrbit",
            {"center": [0, 0], "radius": 10},
            [step("ArcTurn", {"radius": 10, "delta_yaw": 360})],
        )
    )
    assert path.legs[0].points[:2] == ((0, 0), (0, 10))
    assert path.legs[0].metres == pytest.approx(10 + 20 * math.pi)


def test_an_arc_without_a_centre_turns_to_the_side_of_its_sign() -> None:
    glare = {"target_feature": "name board"}
    right = of(
        transit(0, 10),
        task("GlareFreeApproach", glare, [step("ArcTurn", {"radius": 5, "delta_yaw": 90})]),
    )
    left = of(
        transit(0, 10),
        task("GlareFreeApproach", glare, [step("ArcTurn", {"radius": 5, "delta_yaw": -90})]),
    )
    assert right.legs[1].points[-1] == pytest.approx((5, 15))
    assert left.legs[1].points[-1] == pytest.approx((-5, 15))


def test_holds_turns_and_drifts_stay_where_they_are() -> None:
    steps = [
        step("RotateToHeading", {"heading": 90}),
        step("StationKeep", {"time": 60}),
        step("DriftWithCurrent", {"time": 30}),
        step("VisualStationKeep"),
    ]
    path = of(task("KeepStation", {}, steps))
    assert [(leg.kind, leg.seconds) for leg in path.legs] == [
        ("turn", 4.5),
        ("hold", 60),
        ("drift", 30),
        ("hold", None),
    ]
    assert {leg.points for leg in path.legs} == {((0, 0),)}


def test_what_is_not_known_is_open_and_so_is_the_way_from_there() -> None:
    search = task("SearchAndDetect", {"target_description": "buoy"}, [step("StationKeep")])
    path = of(
        search, transit(-99, -99, []) | {"skill_sequence": None}, transit(5, 5), transit(0, 0)
    )
    assert path.open == ("t2", "t3")
    assert (
        path.targets[0].name == "buoy"
        and path.targets[0].position is None
        and path.targets[0].task == "t2"
    )
    assert path.legs[-1].points == ((5, 5), (0, 0))


def test_a_task_without_skills_moves_as_its_parameters_say() -> None:
    path = of(
        transit(3, 4) | {"skill_sequence": None},
        task("BathymetryGridSurvey", {"center": [9, 9]}, None),
    )
    assert path.legs[0].metres == 5 and path.open == ("t2",)


def test_circles_and_boundaries_are_those_of_tasks_and_filters() -> None:
    fenced = step("GoToXY", {"x": 1, "y": 1}) | {
        "filter_skills": [
            {"name": "BoundaryEnforcement", "parameters": {"poly_coords": [[0, 0], [9, 0], [9, 9]]}}
        ]
    }
    path = of(task("SurveyTarget", {"target_position": [1, 1], "radius": 4}, [fenced]))
    assert [(circle.center, circle.radius, circle.arc) for circle in path.circles] == [
        ((1, 1), 4, None)
    ]
    assert [boundary.polygon for boundary in path.boundaries] == [((0, 0), (9, 0), (9, 9))]


def test_another_vehicle_is_drawn_by_its_own_motion_file() -> None:
    tasks = [
        task(
            "FlyToPoint",
            {"target_position": [0, 50]},
            [
                step("FlyToXY", {"x": 0, "y": 50, "altitude": 30}),
                step("OrbitArc", {"radius": 5, "delta_yaw": 180}),
            ],
        )
    ]
    path = track(document(tasks, DRONE), DRONE)
    assert [leg.kind for leg in path.legs] == ["go", "arc"] and path.legs[0].seconds == 10


def test_a_track_is_plain_json_whatever_the_numbers_are() -> None:
    path = of(
        transit(1e308, 1e308, []) | {"skill_sequence": None},
        transit(-1e308, 0, []) | {"skill_sequence": None},
    )
    json.dumps(dataclasses.asdict(path), allow_nan=False)


def test_the_estimate_sums_what_is_known_and_names_the_rest() -> None:
    plan = document(
        [
            transit(30, 40),
            task("KeepStation", {}, [step("StationKeep")]),
            transit(-99, -99, []) | {"skill_sequence": None},
        ]
    )
    assert estimate(plan, track(plan, USV)) == {"length": 50, "seconds": 33, "open": ["t2", "t3"]}


def test_a_located_place_is_a_target_where_a_task_is_at_it() -> None:
    plan = document([transit(3, 4), transit(30, 40), transit(30, 40)])
    plan = {**plan, "located": {"buoy": [30, 40], "wreck": [7, 7]}}
    found = [(one.name, one.position, one.task) for one in track(plan, USV).targets]
    assert found == [("buoy", (30, 40), "t2")]


@pytest.mark.parametrize("side", [1, -1])
def test_arcs_one_after_the_other_go_on_smoothly(side: int) -> None:
    def drawn(*angles: int) -> Track:
        arcs = [step("ArcTurn", {"radius": 10, "delta_yaw": side * angle}) for angle in angles]
        return of(task("VisualDockingApproach", {"target_feature": "name board"}, arcs))

    whole, parts = drawn(180), drawn(60, 120)
    assert parts.legs[-1].points[-1] == pytest.approx(whole.legs[-1].points[-1])
    assert math.dist(*(whole.legs[-1].points[place] for place in (0, -1))) == pytest.approx(20)


ARC = {"target_feature": "name board"}
"""A task of the camera: it has no centre."""


def turned(*headings: float, skill: str = "RotateToHeading", key: str = "heading") -> list[Any]:
    path = of(task("KeepStation", {}, [step(skill, {key: one}) for one in headings]))
    return [leg.seconds for leg in path.legs]


def test_a_turn_takes_the_shorter_way_and_a_nudge_the_way_that_it_says() -> None:
    assert turned(90, 350, 10, 10, -10, 359) == [4.5, 5, 1, 0, 1, 0.45]
    assert turned(180, 0) == [9, 9]
    assert turned(270, -45, 10, skill="NudgeYaw", key="delta_yaw") == [13.5, 2.25, 0.5]


@pytest.mark.parametrize(
    ("skill", "given", "to"),
    [
        ("GoToXY", {"x": 0, "y": 10}, (10, 20)),
        ("GoToXY", {"x": 10, "y": 0}, (20, -10)),
        ("GoToXY", {"x": 0, "y": 10, "yaw": 90}, (10, 0)),
        ("GoToXY", {"x": 0, "y": 0}, (10, 10)),
        ("RotateToHeading", {"heading": -90}, (-10, 10)),
        ("NudgeYaw", {"delta_yaw": 180}, (-10, -10)),
        ("StationKeep", {"time": 9}, (10, 10)),
    ],
)
def test_a_curve_begins_where_the_vehicle_points(
    skill: str, given: dict[str, float], to: tuple[float, float]
) -> None:
    steps = [step(skill, given), step("ArcTurn", {"radius": 10, "delta_yaw": 90})]
    assert of(task("GlareFreeApproach", ARC, steps)).legs[-1].points[-1] == pytest.approx(to)


@pytest.mark.parametrize(
    ("angle", "points", "end"),
    [
        (5, 2, (0.038, 0.872)),
        (10, 2, (0.152, 1.736)),
        (11, 3, (0.184, 1.908)),
        (360, 37, (0, 0)),
        (3600, 361, (0, 0)),
        (36000, 361, (0, 0)),
        (-3690, 361, (0, 0)),
        (0, 2, (0, 0)),
    ],
)
def test_a_curve_has_a_point_each_ten_degrees_for_ten_turns_and_its_whole_length(
    angle: float, points: int, end: tuple[float, float]
) -> None:
    curve = step("ArcTurn", {"radius": 10, "delta_yaw": angle})
    (leg,) = of(task("GlareFreeApproach", ARC, [curve])).legs
    assert len(leg.points) == points and leg.points[-1] == end
    assert leg.metres == pytest.approx(math.radians(abs(angle)) * 10)


def test_a_circle_is_reached_straight_and_has_the_vehicles_angle_without_one() -> None:
    given = {"center": [0, 100], "radius": 10}
    ring = step("ArcTurn", {"radius": 10})
    path = of(task("PerformOrbit", given, [ring, step("ArcTurn", {"radius": 12})]))
    first, second = path.legs
    assert first.points[:2] == ((0, 0), (0, 90)) and first.points[-1] == (0, 90)
    assert first.metres == pytest.approx(90 + 20 * math.pi)
    assert second.points[:2] == ((0, 90), (0, 88))
    assert path.open == ()
    on_it = of(transit(0, 90), task("PerformOrbit", given, [ring])).legs[-1]
    assert len(on_it.points) == 37 and on_it.metres == pytest.approx(20 * math.pi)
    half = {**document([task("PerformOrbit", given, [ring])])}
    half["vehicle"] = {**half["vehicle"], "orbit_angle": 180}
    assert track(half, USV).legs[0].points[-1] == (0, 110)
    for steps in ([step("ArcTurn", {"radius": 5})], [step("ArcTurn", {"delta_yaw": 90})]):
        assert of(task("GlareFreeApproach", ARC, steps)).open == ("t1",)


def test_where_the_vehicle_is_after_a_task_that_is_not_known_in_full() -> None:
    hold = task("KeepStation", {"duration": 60}, None)
    survey = task("SurveyTarget", {"target_position": [30, 40], "radius": 5}, None)
    search = task("SearchAndDetect", {"target_description": "buoy"}, None)
    path = of(transit(3, 4), hold, transit(3, 8))
    assert [leg.metres for leg in path.legs] == [5, 4] and path.end == (3, 8)
    assert path.open == ("t2",)
    path = of(survey, transit(30, 50))
    assert [leg.metres for leg in path.legs] == [10]
    path = of(search, search, transit(30, 50))
    assert path.legs == () and path.open == ("t1", "t2", "t3") and path.end == (30, 50)
    unknown = task("KeepStation", {}, [step("GoToXY", {"x": 3, "y": 4}), step("DetectObjects")])
    assert of(unknown, search, unknown).open == ("t1", "t2", "t3")
    assert of(unknown, search, hold).legs[0].metres == 5


def test_holds_where_the_vehicle_is_not_known_have_no_point() -> None:
    search = task("SearchAndDetect", {"target_description": "buoy"}, None)
    path = of(search, task("KeepStation", {}, [step("StationKeep", {"time": 9})]))
    assert [(leg.points, leg.metres, leg.seconds) for leg in path.legs] == [((), 0, 9)]
    assert path.last((1, 2)) == (1, 2) and of(transit(5, 5)).last((1, 2)) == (5, 5)


def test_legs_are_found_by_task_and_step_and_named_by_their_skill() -> None:
    path = of(transit(1, 0), transit(2, 0, [step("StationKeep"), step("GoToXY", {"x": 2, "y": 0})]))
    assert [(leg.task, leg.step, leg.skill) for leg in path.of("t2")] == [
        ("t2", 0, "StationKeep"),
        ("t2", 1, "GoToXY"),
    ]
    assert [leg.metres for leg in path.of("t2", 1)] == [1] and path.of("t1", 1) == []
    asked = of(transit(1, 0) | {"skill_sequence": None}).legs[0]
    assert (asked.task, asked.step, asked.skill) == ("t1", 0, "")


@pytest.mark.parametrize(
    ("tasks", "told"),
    [
        ([transit(0.3, 0.44)], {"away": 0.5, "length": 0.5, "seconds": 0}),
        ([transit(3, 4), transit(0, 0)], {"length": 10, "seconds": 7}),
        ([transit(0.03, 0)], {"length": 0, "seconds": 0}),
        (
            [transit(7.5, 0), task("KeepStation", {}, [step("StationKeep", {"time": 100})])],
            {"away": 7.5, "length": 7.5, "seconds": 105},
        ),
    ],
)
def test_the_estimate_is_in_tenths_of_metres_and_seconds(tasks: Any, told: Any) -> None:
    plan = document(tasks)
    assert estimate(plan, track(plan, USV)) == {**told, "open": []}
    home = estimate(plan, track(plan, USV), (7.5, 0.0))
    assert ("away" in home) == (track(plan, USV).end != (7.5, 0))


def test_boundaries_and_circles_say_their_task_step_and_arc() -> None:
    corners = [[0, 0], [9, 0], [9, 9]]
    fenced = step("GoToXY", {"x": 1, "y": 1})
    fenced["filter_skills"] = [
        {"name": "ObstacleAvoidance", "parameters": {"min_distance": 5}},
        {"name": "BoundaryEnforcement", "parameters": {"poly_coords": corners}},
        {"name": "BoundaryEnforcement", "parameters": {}},
    ]
    around = {"center": [1, 1], "radius": 4, "arc": 90}
    path = of(transit(5, 5, []), task("PerformOrbit", around, [step("StationKeep"), fenced]))
    assert [(one.task, one.step) for one in path.boundaries] == [("t2", 1)]
    assert [(one.task, one.radius, one.arc) for one in path.circles] == [("t2", 4, 90)]
    assert of(task("PerformOrbit", {"center": [1, 1]}, [])).circles == ()


def test_a_located_place_names_the_first_task_at_it() -> None:
    plan = {**document([transit(3, 4), transit(30, 40), transit(3, 4)]), "located": {"a": [3, 4]}}
    assert [one.task for one in track(plan, USV).targets] == ["t1"]
