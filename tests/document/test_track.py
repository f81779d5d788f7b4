"""Where a plan's skills take the vehicle."""

from __future__ import annotations

import itertools
import json
import math
from typing import Any

import pytest

from planner_ft.document.track import Track, estimate, track
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
    json.dumps(path.as_json(), allow_nan=False)


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
