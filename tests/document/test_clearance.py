"""Ways end at the stand-off of structures and lead round them."""

from __future__ import annotations

import itertools
from typing import Any

import pytest

from planner_ft.document import apply
from planner_ft.document.clearance import way_round
from planner_ft.document.ontology import named_places
from planner_ft.document.structures import fence, structures, way_off
from planner_ft.document.track import track
from tests.documents import USV, document, step, task

MAST = [250, -80]


def go(x: float, y: float) -> dict[str, Any]:
    return step("GoToXY", {"x": x, "y": y})


def transit(x: float, y: float, prompt: str = "Go there.") -> dict[str, Any]:
    return task("Transit", {"target_position": [x, y]}, [go(x, y)], prompt)


def orbit(arc: float = 360) -> dict[str, Any]:
    turn = step("ArcTurn", {"radius": 40, "delta_yaw": arc})
    return task("PerformOrbit", {"center": MAST, "radius": 40, "arc": arc}, [turn])


def nearest(plan: dict[str, Any], place: list[float]) -> float:
    legs = [leg.points for leg in track(plan, USV).legs if len(leg.points) > 1]
    pairs = itertools.chain.from_iterable(map(itertools.pairwise, legs))
    return min(way_off((place[0], place[1]), *pair) for pair in pairs)


def waypoints(plan: dict[str, Any]) -> list[list[float]]:
    steps = [one for entry in plan["tasks"] for one in entry["skill_sequence"]]
    skills = [one["navigation_skill"] for one in steps]
    return [[*own["parameters"].values()] for own in skills if own["name"] == "GoToXY"]


def kinds(plan: dict[str, Any]) -> list[str]:
    return [item["kind"] for item in plan["warnings"]]


@pytest.mark.parametrize("arc", [360, 180, 90, -180])
def test_an_orbit_is_entered_on_its_circle_and_left_round_it(arc: float) -> None:
    plan = document([transit(*MAST), orbit(arc), transit(0, 0)])
    assert nearest(plan, MAST) >= 39
    assert waypoints(plan)[0] == [211.9, -67.8]
    assert waypoints(plan)[-1] == [0, 0]
    assert plan["tasks"][0]["parameters"]["target_position"] == MAST
    assert plan["tasks"][0]["added"][0]["kind"] == "clearance"
    assert "structure-close" not in kinds(plan)
    assert "skill-value-not-said" not in kinds(plan)


NAMES = ["green buoy", "mooring buoy", "light of the harbour", "platform leg"]


@pytest.mark.parametrize("name", NAMES)
def test_a_thing_that_the_prompt_names_has_the_vehicles_standoff(name: str) -> None:
    plan = document([transit(60, 0, f"Go to the {name} at [60, 0]."), transit(100, 0)])
    assert waypoints(plan)[0] == [50, 0]
    assert nearest(plan, [60, 0]) >= 9.5
    assert waypoints(plan)[-1] == [100, 0]
    (buoy,) = structures(plan, USV)
    assert (buoy.name, buoy.standoff) == (f"the {name}", 10)


def test_a_thing_of_the_command_is_one_where_the_plan_goes_to_it_without_its_name() -> None:
    command = "Go to [200, 0], past the platform at [100, 0], and come home."
    tasks = [transit(200, 0, "Go to [200, 0]."), transit(100, 0, "Go to [100, 0]."), transit(0, 0)]
    plan = document(tasks, command=command)
    assert nearest(plan, [100, 0]) >= 9.5
    grid = task("BathymetryGridSurvey", {"center": [100, 0], "width": 9, "length": 9}, None)
    assert not structures(document([grid], command="Map round the platform at [100, 0]."), USV)


@pytest.mark.parametrize(("margin", "reached"), [(20, 40), (15, 45), (5, 50), (None, 50)])
def test_what_is_followed_is_gone_to_no_closer_than_the_filter_lets_it(
    margin: float | None, reached: float
) -> None:
    near = go(60, 0)
    near["filter_skills"] = [{"name": "ObstacleAvoidance", "parameters": {}}]
    if margin:
        near["filter_skills"][0]["parameters"]["min_distance"] = margin
    follow = task(
        "FollowTarget", {"target_position": [60, 0]}, [near], "Follow the ferry at [60, 0]."
    )
    plan = document([follow])
    assert waypoints(plan) == [[reached, 0]]
    assert "structure-close" not in kinds(plan)


@pytest.mark.parametrize(
    "prompt",
    [
        "Go to [60, 0].",
        "Go to the waypoint at [60, 0].",
        "Go to the middle of the channel at [60, 0].",
        "Hold the position at [60, 0] for 5 s.",
    ],
)
def test_a_place_of_the_water_is_gone_to_itself(prompt: str) -> None:
    plan = document([transit(60, 0, prompt), transit(0, 0)])
    assert waypoints(plan) == [[60, 0], [0, 0]]
    assert "added" not in plan["tasks"][0]


def test_berths_and_areas_that_are_gone_over_are_no_structures() -> None:
    berth = task(
        "DockingApproach", {"goal_position": [5, 5]}, [go(5, 5)], "Dock at the pier at [5, 5]."
    )
    size = {"center": [50, 30], "width": 20, "length": 20, "spacing": 20}
    grid = task("BathymetryGridSurvey", size, [go(40, 20), go(40, 40), go(60, 40), go(60, 20)])
    plan = document([grid, berth], chart={"wreck": (50.0, 30.0)})
    assert structures(plan, USV) == []
    assert waypoints(plan)[-1] == [5, 5]


@pytest.mark.parametrize(("head", "kept"), [((40.0, 42.0), True), ((-8.0, 4.0), False)])
def test_docking_keeps_clear_of_all_but_what_the_berth_is_at(
    head: tuple[float, float], kept: bool
) -> None:
    berth = task("DockingApproach", {"goal_position": [-6, -4]}, [go(-6, -4)], "Dock at [-6, -4].")
    plan = document([transit(80, 80), berth, transit(-40, 60)], chart={"breakwater head": head})
    away = nearest(plan, [*head])
    assert (away >= 9) is kept and "structure-close" not in kinds(plan)
    steps = plan["tasks"][1]["skill_sequence"]
    assert (len(steps) > 1) is kept and steps[-1]["navigation_skill"]["parameters"]["x"] == -6


def test_a_ring_is_begun_on_the_near_side_unless_a_side_is_named() -> None:
    ring = [(60, 30), (60, 40), (50, 40), (40, 40), (40, 30), (40, 20), (50, 20), (60, 20)]
    survey = task(
        "SurveyTarget", {"target_position": [50, 30], "radius": 10}, [go(*at) for at in ring]
    )
    plan = document([survey])
    assert waypoints(plan)[0] == [40, 20] and len(waypoints(plan)) == 8
    survey["task_prompt"] = "Inspect it from the east."
    plan = document([survey])
    assert len(waypoints(plan)) > 8 and waypoints(plan)[-8] == [60, 30]
    assert nearest(plan, [50, 30]) >= 9.5


def test_a_chart_names_structures_and_a_waypoint_beside_one_is_the_first_warning() -> None:
    plan = document([transit(100, 0)], chart={"mast": (50.0, 0.0), "pier": (103.0, 0.0)})
    assert plan["structures"] == {"mast": [50, 0], "pier": [103, 0]}
    assert nearest(plan, [50, 0]) >= 9.5
    assert kinds(plan)[0] == "structure-close"
    assert "pier" in plan["warnings"][0]["text"]


def test_new_skills_of_a_task_keep_clear_too() -> None:
    plan = document([transit(60, 0, "Go to the buoy at [60, 0]."), transit(100, 0)])
    edit = {"kind": "skills", "task": "t2", "skill_sequence": [go(100, 0)]}
    plan = apply(plan, edit, USV)
    assert nearest(plan, [60, 0]) >= 9.5
    moved = {"kind": "skill", "task": "t2", "step": 0, "role": "navigation", "index": 0}
    plan = apply(plan, {**moved, "name": "y", "value": 3}, USV)
    assert "structure-close" in kinds(plan)


def test_a_way_leads_round_many_structures_and_none_through_a_fence() -> None:
    chart = {f"pile {number}": (50.0, 12.0 * number) for number in range(-3, 4)}
    plan = document([transit(100, 0)], chart=chart)
    assert all(nearest(plan, [*place]) >= 9.5 for place in chart.values())
    limit = "The vehicle stays inside [-5, -5], [105, -5], [105, 5], [-5, 5]."
    plan = document([transit(100, 0)], chart={"mast": (50.0, 0.0)}, constraints=[limit])
    assert waypoints(plan) == [[100, 0]]
    assert kinds(plan)[0] == "structure-close"
    assert way_round((0, 0), (1, 0), [], lambda _start, _goal: True) == []


def test_the_vehicles_area_is_a_fence_of_every_plan() -> None:
    plan = document([task("Transit", {"target_position": [9, 9]}, None)])
    area = [[-50, -50], [50, -50], [50, 50], [-50, 50]]
    within = fence({**plan, "vehicle": {**plan["vehicle"], "area": area}}, USV)
    assert within((0, 0), (40, 40)) and not within((0, 0), (60, 0))
    assert fence(plan, USV)((0, 0), (60, 0))


def test_the_way_to_a_pass_leads_round_the_face_and_not_through_it() -> None:
    def crosses(leg: Any) -> bool:
        (a, b), (c, d) = leg
        return (a - 60) * (c - 60) < 0 and -45 < b + (60 - a) / (c - a) * (d - b) < 75

    given = {"side_id": "east", "length": 120, "distance": 7}
    ends = [step("GoToXY", {"x": 67, "y": y}) for y in (75, -45)]
    prompt = "Run along the east side of the pier at [60, 15] for 120 m, 7 m off."
    to = task("Transit", {"target_position": [60, 15]}, [step("GoToXY", {"x": 60, "y": 15})])
    home = task("Transit", {"target_position": [0, 0]}, [step("GoToXY", {"x": 0, "y": 0})])
    plan = document([to, task("ParallelStructurePass", given, ends, prompt), home])
    skills = [
        s["navigation_skill"]["parameters"] for t in plan["tasks"] for s in t["skill_sequence"]
    ]
    way = [(0, 0), *((at["x"], at["y"]) for at in skills)]
    assert (70, 15) in way and (67, 75) in way
    assert not any(map(crosses, itertools.pairwise(way)))


def test_a_row_of_positions_behind_things_is_of_these_things() -> None:
    command = "Inspect the cages at 100,20, 130,20 and 160,20, then go to 50,50."
    found = [(words, place.x) for words, place in named_places(command, USV)]
    assert found == [("the cages", 100), ("the cages", 130), ("the cages", 160)]
    assert len(list(named_places("Go by the buoy at 100,20, 130,20 and 160,20.", USV))) == 1
