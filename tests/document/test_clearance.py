"""Ways end at the stand-off of structures and lead round them."""

from __future__ import annotations

import itertools
import math
from typing import Any

import pytest

from planner_ft.document import apply
from planner_ft.document.clearance import _walls, way_round
from planner_ft.document.ontology import named_places
from planner_ft.document.structures import Structure, fence, structures, way_off
from planner_ft.document.track import track
from planner_ft.planning.passes import Face
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
    near = [211.9, -67.8]
    assert (waypoints(plan)[0] == near) is (arc == 360)
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
    assert not structures(document([grid], command="Map round the wreck at [100, 0]."), USV)
    (found,) = structures(document([grid], command="Map round the platform at [100, 0]."), USV)
    assert found.name == "the platform"


@pytest.mark.parametrize(
    "command",
    [
        "A panorama at [20, 40], a third at [60, 0].",
        "Go to [60, 9], no, I read that wrong, [60, 0] it is.",
        "Actually the other way round, [60, 0] first.",
        "Take a geotagged snapshot at 60,0.",
        "Do the loop [60, 0], [60, 40] twice.",
        "Station the boat at [60, 0].",
    ],
)
def test_words_before_a_position_are_not_all_things(command: str) -> None:
    assert waypoints(document([transit(60, 0, "Go to [60, 0].")], command=command)) == [[60, 0]]


@pytest.mark.parametrize(
    "command",
    [
        "My net is at 60,0, very bad for the propeller.",
        "A concrete pier stands at 60,0.",
        "The casualty, a small tanker, is aground at 60,0.",
        "The barges are anchored at [60, 0] and [60, 40].",
        "There is a lit buoy in [60, 0].",
        "A lighthouse stands in the water at [60, 0].",
        "Mind: red buoy at 60,0.",
        "Nets in the water at 60,0.",
        "On the way stands a dolphin, namely at [60, 0].",
        "Watch out for the barge which lies at 60,0.",
        "At [60, 0] there is a rock.",
        "Right ahead, at 60,0, lies a mooring buoy.",
        "A boom reaches from 60,-30 to 60,30.",
        "There is a net between the two buoys at [60, -15] and [60, 15].",
        "Mind the breakwater, it runs from 50,0 to 70,0.",
        "There's a fish farm from 60,-30 to 60,30.",
        "Keep out of the reeds, they run from 60,-20 to 60,20.",
        "Mind the dolphin standing right in the middle at 60,0.",
    ],
)
def test_things_that_are_only_told_of_are_kept_clear_of(command: str) -> None:
    plan = document([transit(120, 0, "Go to [120, 0].")], command=f"{command} Go to 120,0.")
    assert nearest(plan, [60, 0]) >= 9.5
    assert waypoints(plan)[-1] == [120, 0]


def test_what_is_kept_off_one_of_a_row_is_kept_off_all_of_it() -> None:
    command = "Go to 150,-60. The net pens at [75, -30] and [110, -44] must be passed at 20 m."
    limit = "The vehicle stays at least 20 m from the net pens at [75, -30]."
    plan = document([transit(150, -60)], command=command, constraints=[limit])
    assert nearest(plan, [75, -30]) >= 19 and nearest(plan, [110, -44]) >= 19


def test_a_channel_and_a_cable_bar_no_way() -> None:
    for thing in ("channel", "power cable"):
        command = f"There is a {thing} from 60,-30 to 60,30. Go to 120,0."
        plan = document([transit(120, 0, "Go to [120, 0].")], command=command)
        assert waypoints(plan) == [[120, 0]]


def test_what_is_run_along_bars_no_way_and_a_bar_is_warned_of_once() -> None:
    command = "Go along the quay wall from 60,-30 to 60,30."
    plan = document([transit(60, -30), transit(60, 30)], command=command)
    assert waypoints(plan) == [[60, -30], [60, 30]]
    leaving = "Leave the jetty and go from 60,-30 to 60,30."
    assert document([transit(60, -30), transit(60, 30)], command=leaving)["warnings"] == []
    past = document(
        [transit(60, -30), transit(60, 30)], command="Pass the pier from 60,-30 to 60,30."
    )
    assert waypoints(past) == [[60, -30], [60, 30]]
    across = "A boom lies from 60,-30 to 60,30. Go to 55,0."
    plan = document([transit(55, 0, "Go to [55, 0].")], command=across)
    assert [one["kind"] for one in plan["warnings"]] == ["structure-close"]
    long = "A net lies from 60,-1500 to 60,1500. Go to 200,0."
    assert document([transit(200, 0, "Go to [200, 0].")], command=long)["warnings"] != []


def test_a_grid_leads_round_what_stands_in_its_middle_and_over_a_wreck() -> None:
    lanes = [go(80, -20), go(80, 20), go(100, 20), go(100, -20), go(120, -20), go(120, 20)]
    for name, close in (("gas platform", False), ("wreck of the barge", True)):
        values = {"center": [100, 0], "width": 40, "length": 40, "spacing": 20}
        prompt = f"Survey the depths around the {name} at [100, 0]."
        grid = task("BathymetryGridSurvey", values, lanes, prompt)
        assert (nearest(document([grid]), [100, 0]) < 9) == close


def test_what_is_to_be_kept_clear_of_is_where_the_command_has_it() -> None:
    command = "There is a wind turbine at 100, 0. Go to 200, 0; give the turbine a berth of 30 m."
    limit = "The vehicle stays at least 30 m from the turbine."
    plan = document([transit(200, 0)], command=command, constraints=[limit])
    assert nearest(plan, [100, 0]) >= 29.5
    assert plan["limits"][0]["values"]["position"] == [100, 0]
    two = f"{command} The other wind turbine is at 9, 90."
    plan = document([transit(200, 0)], command=two, constraints=[limit])
    assert "position" not in plan["limits"][0]["values"]


@pytest.mark.parametrize(
    ("command", "thing", "place"),
    [
        (
            "A jack-up rig stands at 100,0. Go to 200,0, stay 30 m clear of the rig.",
            "rig",
            [100, 0],
        ),
        ("Wreck at 100,0. Go to 200,0, no closer than 30 m to that wreck.", "wreck", [100, 0]),
        ("Go to 200,0 and keep 30 m from home.", "home", [0, 0]),
    ],
)
def test_what_is_to_be_kept_clear_of_needs_no_article(
    command: str, thing: str, place: list[float]
) -> None:
    limit = f"The vehicle stays at least 30 m from the {thing}."
    plan = document([transit(200, 0)], command=command, constraints=[limit])
    assert plan["limits"][0]["values"]["position"] == place


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
    chart = {"wreck": (50.0, 30.0)}
    plan = document([grid, berth], command="Map the wreck, then dock.", chart=chart)
    assert structures(plan, USV) == []
    assert waypoints(plan)[-1] == [5, 5]
    # What nobody names is no thing that is gone over on purpose.
    plan = document([grid, berth], command="Map the depths, then dock.", chart=chart)
    assert [one.name for one in structures(plan, USV)] == ["wreck"]
    assert nearest(plan, [50, 30]) >= 9 or "structure-close" in kinds(plan)


@pytest.mark.parametrize(("head", "kept"), [((40.0, 42.0), True), ((-7.0, -2.0), False)])
def test_docking_keeps_clear_of_all_but_what_the_berth_is_at(
    head: tuple[float, float], kept: bool
) -> None:
    berth = task("DockingApproach", {"goal_position": [-6, -4]}, [go(-6, -4)], "Dock at [-6, -4].")
    plan = document([transit(80, 80), berth, transit(-40, 60)], chart={"breakwater head": head})
    away = nearest(plan, [*head])
    assert (away >= 9) is kept and "structure-close" not in kinds(plan)
    steps = plan["tasks"][1]["skill_sequence"]
    assert (len(steps) > 1) is kept and steps[-1]["navigation_skill"]["parameters"]["x"] == -6


@pytest.mark.parametrize("side", ["", "from the west side"])
def test_a_half_circle_is_begun_so_that_the_way_on_is_short(side: str) -> None:
    around = {**orbit(180), "task_prompt": f"Circle the mast {side}."}
    plan = document([transit(*MAST), around, transit(0, 0)])
    legs = [leg for leg in track(plan, USV).legs if leg.kind == "go"]
    length = sum(math.dist(*leg.points) for leg in legs)
    # The near side is 222 m from home, the far side 302 m, and the way round the mast is longer.
    assert (length < 520) is not side and nearest(plan, MAST) >= 39


def test_the_way_to_a_berth_leads_round_what_lies_before_it() -> None:
    berth = task("DockingApproach", {"goal_position": [12, -6]}, [go(12, -6)], "Dock at [12, -6].")
    plan = document([berth], command="Dock at [12, -6]. Mind the barge moored at [6, -3].")
    assert nearest(plan, [6, -3]) > 5 and "structure-close" not in kinds(plan)
    assert waypoints(plan)[-1] == [12, -6]


def test_a_ring_is_begun_on_the_near_side_unless_a_side_is_named() -> None:
    ring = [(60, 30), (60, 40), (50, 40), (40, 40), (40, 30), (40, 20), (50, 20), (60, 20)]
    survey = task(
        "SurveyTarget", {"target_position": [50, 30], "radius": 10}, [go(*at) for at in ring]
    )
    plan = document([survey])
    assert waypoints(plan)[0] == [40, 20] and len(waypoints(plan)) == 8
    survey["task_prompt"] = "Inspect the north mast at [50, 30]."
    assert waypoints(document([survey]))[0] == [40, 20]
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


BUOY = Structure("buoy", (50.0, 0.0), 10.0)


@pytest.mark.parametrize(
    ("point", "metres"),
    [((50, 7), 7), ((-3, 4), 5), ((103, -4), 5), ((0, 0), 0), ((100, 0), 0), ((20, -2.5), 2.5)],
)
def test_how_far_a_point_is_off_a_leg(point: tuple[float, float], metres: float) -> None:
    assert way_off(point, (0, 0), (100, 0)) == metres
    assert way_off((3, 4), (0, 0), (0, 0)) == 5


@pytest.mark.parametrize(
    ("standoff", "y", "blocked"),
    [(10, 9.49, True), (10, 9.5, False), (400, 397.9, True), (400, 398, False), (10, -9, True)],
)
def test_a_leg_may_come_half_a_metre_or_half_a_hundredth_closer(
    standoff: float, y: float, *, blocked: bool
) -> None:
    assert Structure("", (50, 0), standoff).blocks((0, y), (100, y)) is blocked


def test_a_full_way_round_has_twelve_corners_half_a_metre_beyond_the_standoff() -> None:
    corners = BUOY.corners()
    assert len(corners) == 12 and corners[0][0] == 50 and corners[3][1] == pytest.approx(0)
    sides = list(itertools.pairwise([*corners, corners[0]]))
    assert [way_off(BUOY.position, *side) for side in sides] == pytest.approx([10.5] * 12)
    assert corners[0][1] > 0 and corners[3][0] > 50


def test_the_shortest_way_round_is_taken_and_from_within_none_is_nearer() -> None:
    def free(_start: Any, _goal: Any) -> bool:
        return True

    north = way_round((0, 1), (100, 1), [BUOY], free)
    south = way_round((0, -1), (100, -1), [BUOY], free)
    assert {y > 0 for _x, y in north} == {True} and {y > 0 for _x, y in south} == {False}
    way = [(0.0, 1.0), *north, (100.0, 1.0)]
    assert sum(itertools.starmap(math.dist, itertools.pairwise(way))) == pytest.approx(
        101.930, abs=0.01
    )
    assert not any(BUOY.blocks(*leg) for leg in itertools.pairwise(way))
    assert way_round((0, 20), (100, 20), [BUOY], free) == []
    for ends in (((45.0, 0.0), (100.0, 0.0)), ((0.0, 0.0), (55.0, 0.0))):
        way = [ends[0], *way_round(*ends, [BUOY], free), ends[1]]
        assert min(way_off(BUOY.position, *leg) for leg in itertools.pairwise(way)) >= 4.99
    beside = Structure("", (50.0, 16.0), 10.0)
    way = [(0.0, 1.0), *way_round((0, 1), (100, 1), [BUOY, beside], free), (100.0, 1.0)]
    assert not any(one.blocks(*leg) for leg in itertools.pairwise(way) for one in (BUOY, beside))
    only_north = way_round(
        (0, -1), (100, -1), [BUOY], lambda start, goal: min(start[1], goal[1]) > -2
    )
    assert only_north and all(y > 0 for _x, y in only_north)


def test_steps_that_were_added_or_moved_are_marked_and_others_keep_their_marks() -> None:
    plan = document([transit(100, 0)], chart={"mast": (50.0, 0.0)})
    steps, marks = plan["tasks"][0]["skill_sequence"], plan["tasks"][0]["added"]
    assert [mark["step"] for mark in marks] == list(range(len(steps) - 1))
    assert {(mark["role"], mark["name"], mark["kind"]) for mark in marks} == {
        ("navigation", "GoToXY", "clearance")
    }
    assert {mark["note"] for mark in marks} == {"keeps clear of a structure"}
    points = [point for at in waypoints(plan) for point in at]
    assert points == [round(point, 1) for point in points]
    text = "The vehicle keeps at least 5 m from every obstacle."
    plan = document([transit(100, 0)], chart={"mast": (50.0, 0.0)}, constraints=[text])
    limited = [mark for mark in plan["tasks"][0]["added"] if mark["kind"] == "limit"]
    assert [mark["step"] for mark in limited] == list(
        range(len(plan["tasks"][0]["skill_sequence"]))
    )
    near = document([transit(60, 0, "Go to the buoy at [60, 0].")])
    (mark,) = near["tasks"][0]["added"]
    assert (mark["step"], mark["note"]) == (0, "ends at the stand-off")


@pytest.mark.parametrize(
    ("beside", "moved"), [(0.0, True), (0.5, True), (0.7, False), (-0.7, False)]
)
def test_a_waypoint_within_half_a_metre_of_a_structure_is_the_structure(
    beside: float, *, moved: bool
) -> None:
    plan = document([transit(100 + beside, 0)], chart={"mast": (100.0, 0.0)})
    assert (waypoints(plan) == [[90, 0]]) is moved
    assert ("structure-close" in kinds(plan)) is not moved


def test_from_home_a_structure_at_home_is_left_to_the_west() -> None:
    plan = document([transit(0, 3, "Go to the buoy at [0, 3].")])
    assert waypoints(plan) == [[0, -7]]


def standoffs(*tasks: dict[str, Any], **planned_as: Any) -> dict[str, float]:
    return {one.name: one.standoff for one in structures(document(tasks, **planned_as), USV)}


def test_the_standoff_is_the_limits_the_tasks_or_the_vehicles_and_never_below_the_least() -> None:
    ring = {"center": [90, 0]}
    go = transit(50, 0, "Go to the mast at [50, 0].")
    far = "The vehicle stays at least 30 m from the mast at [50, 0]."
    farther = far.replace("30", "40")
    assert standoffs(go) == {"the mast": 10}
    assert standoffs(go, constraints=[far]) == {"the mast": 30}
    assert standoffs(go, constraints=[farther, far]) == {"the mast": 40}
    every = [f"The vehicle keeps at least {far} m from every obstacle." for far in (15, 12)]
    assert standoffs(go, constraints=every) == {"the mast": 15}
    assert standoffs(go, constraints=[far, every[0]]) == {"the mast": 30}
    assert standoffs(task("PerformOrbit", {**ring, "radius": 7}, [])) == {"[90, 0]": 7}
    assert standoffs(task("PerformOrbit", {**ring, "radius": 0.5}, [])) == {"[90, 0]": 0.5}
    both = [task("PerformOrbit", {**ring, "radius": radius}, []) for radius in (7, 9)]
    assert standoffs(*both) == {"[90, 0]": 7}
    assert standoffs(task("PerformOrbit", ring, [])) == {"[90, 0]": 10}
    plan = document([task("PerformOrbit", ring, [])])
    plan["vehicle"] = {**plan["vehicle"], "stand_off": 4}
    assert structures(plan, USV)[0].standoff == 4
    plan["vehicle"] = None
    assert structures(plan, USV)[0].standoff == 10


@pytest.mark.parametrize(
    ("command", "standoff"),
    [
        ("From 25 m away film the mast at 50,0 for a minute.", 25),
        ("Film the mast at 50,0 for a minute from 25 m away, then go home.", 25),
        ("Film the mast at 50,0 from 50 feet off.", 15.24),
        ("Film the mast at 50,0, the 25 m one.", 10),
        ("Film the mast at 50,0 from 1 m away.", 10),
        ("Film the mast at 50,0 and the buoy at 90,0 from 25 m away.", 25),
        ("Film the mast at 50,0 beside the buoy at 90,0 from 25 m away.", 10),
        ("From 40 m away film the mast at 50,0 for 40 seconds.", 40),
    ],
)
def test_a_distance_that_the_command_keeps_off_a_thing_is_its_standoff(
    command: str, standoff: float
) -> None:
    tasks = [
        transit(50, 0, "Go to the mast at [50, 0]."),
        task("KeepStation", {"duration": 40}, []),
    ]
    plan = document(tasks, command=command)
    found = {one.position: one.standoff for one in structures(plan, USV)}
    assert found.get((90, 0) if "and the buoy" in command else (50, 0)) == pytest.approx(standoff)
    lost = [one["text"] for one in plan["warnings"] if one["kind"] == "value-lost"]
    assert standoff == 10 or not [text for text in lost if f'"{standoff} m"' in text]


def test_a_thing_that_a_task_looks_at_is_a_structure_and_the_place_of_the_vehicle_is_none() -> None:
    sweep = task("BoatLandingClearanceSweep", {}, [])
    assert standoffs(transit(70, 0), sweep) == {}
    assert standoffs(transit(70, 0, "Go to the boat landing at [70, 0]."), sweep) == {
        "the boat landing": 10
    }
    far = task("BoatLandingClearanceSweep", {}, [], "Scan the boat landing at [90, 0].")
    assert standoffs(transit(70, 0), far) == {"the boat landing": 10}
    bare = document([transit(90, 0), far], command="Go to 90,0 and scan the boat landing.")
    called = document([transit(90, 0), far], command="Scan the boat landing at 90,0.")
    assert [one.position for one in structures(bare, USV)] == []
    assert [one.position for one in structures(called, USV)] == [(90, 0)]
    home = task("PerformOrbit", {"center": [0, 0], "radius": 5}, [])
    assert standoffs(home) == {}
    placed = {**document([transit(70, 0)]), "located": {"wreck": [8, 8], "middle": [9, 9]}}
    assert [(one.name, one.position) for one in structures(placed, USV)] == [("wreck", (8, 8))]


@pytest.mark.parametrize(("beside", "found"), [(0.5, 1), (0.7, 2)])
def test_a_thing_that_the_prompt_puts_beside_the_place_is_at_the_place(
    beside: float, found: int
) -> None:
    ring = {"center": [90, 0], "radius": 7}
    words = f"Circle the mast at [{90 + beside}, 0] at 7 m."
    named = standoffs(task("PerformOrbit", ring, [], words))
    assert ("the mast" in named) is (found == 1)


@pytest.mark.parametrize(
    ("leg", "kept"),
    [
        ([(0, 0), (40, 0)], True),
        ([(0, 0), (50.4, 0)], True),
        ([(0, 0), (50.6, 0)], False),
        ([(0, 0), (30, 19.4)], True),
        ([(0, 0), (30, 21)], False),
        ([(20, 40), (40, 40)], True),
        ([(10, 40), (25, 40)], True),
    ],
)
def test_a_fence_and_a_closed_area_are_kept_to_half_a_metre(leg: Any, *, kept: bool) -> None:
    texts = [
        "The vehicle stays inside [-50, -50], [50, -50], [50, 50], [-50, 50].",
        "The vehicle stays outside [25, 19], [35, 19], [35, 29], [25, 29].",
    ]
    assert fence(document([transit(9, 9)], constraints=texts), USV)(*leg) is kept
    alone = fence(document([transit(9, 9)], constraints=texts[1:]), USV)
    assert alone((0, 0), (60, 0)) and not alone((0, 0), (30, 25))


def ring(*points: tuple[float, float], prompt: str = "Survey it.") -> dict[str, Any]:
    given = {"target_position": [50, 30], "radius": 10}
    return task("SurveyTarget", given, [go(*at) for at in points], prompt)


SQUARE = [(60, 30), (60, 40), (50, 40), (40, 40), (40, 30), (40, 20), (50, 20), (60, 20)]


@pytest.mark.parametrize(
    ("points", "first"),
    [
        (SQUARE, (40, 20)),
        (SQUARE[5:] + SQUARE[:5], (40, 20)),
        ([(60, 30), (60, 40)], None),
        ([(40, 20), (50, 20)], (40, 20)),
    ],
)
def test_a_ring_is_begun_where_it_can_be_gone_to_and_nearest(
    points: list[tuple[float, float]], first: tuple[float, float] | None
) -> None:
    plan = document([ring(*points)])
    added = [mark["note"] for mark in plan["tasks"][0].get("added", ())]
    turned = first is not None and first != points[0]
    assert ("begins on the near side" in added) is turned
    if first:
        assert waypoints(plan)[0] == [*first] and len(waypoints(plan)) == len(points)
    else:
        assert len(waypoints(plan)) > len(points)
    marked = [mark["step"] for mark in plan["tasks"][0].get("added", ()) if "near" in mark["note"]]
    assert marked == ([0] if turned else [])


def test_marks_of_a_ring_go_round_with_its_steps() -> None:
    text = "The vehicle keeps at least 5 m from every obstacle."
    survey = ring(*SQUARE)
    survey["skill_sequence"][0]["filter_skills"] = [
        {"name": "ObstacleAvoidance", "parameters": {"min_distance": 9}}
    ]
    plan = document([survey], constraints=[text])
    marks = [one["step"] for one in plan["tasks"][0]["added"] if one["kind"] == "limit"]
    (kept,) = [
        at
        for at, one in enumerate(plan["tasks"][0]["skill_sequence"])
        if one["filter_skills"][0]["parameters"]["min_distance"] == 9
    ]
    assert sorted(marks) == [at for at in range(8) if at != kept] and kept == 3


def test_the_face_of_a_pass_is_gone_round_also_where_it_is_as_short_as_a_point() -> None:
    for length, count in ((120, 19), (5, 2), (1000, 0)):
        walls = _walls(Face(((0, 0), (length, 0)), 90, 7))
        assert len(walls) == count
        if walls:
            assert walls[0].position == (0, 0) and walls[-1].position == (length, 0)
            assert {one.standoff for one in walls} == {7}
    assert len(_walls(Face(((0, 0), (420, 0)), 90, 7))) == 61
    assert len(_walls(Face(((0, 0), (421, 0)), 90, 7))) == 0
    assert len(_walls(Face(((0, 0), (10, 0)), 90, 0.1))) == 21


def square(x: float, y: float, radius: float) -> dict[str, Any]:
    sides = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)]
    steps = [go(x + radius * east, y + radius * north) for east, north in sides]
    given = {"target_position": [x, y], "radius": radius}
    return task("SurveyTarget", given, steps, f"Survey the pile at [{x}, {y}].")


@pytest.mark.parametrize("places", [[(60, 0), (120, 0)], [(40, 40), (110, 40), (75, 110)]])
def test_rings_behind_each_other_end_where_the_next_one_can_be_gone_to(
    places: list[tuple[float, float]],
) -> None:
    plan = document([square(*at, 12) for at in places])
    assert [len(one["skill_sequence"]) for one in plan["tasks"]] == [8] * len(places)
    assert not [one for one in plan["warnings"] if one["kind"] == "structure-close"]


def test_a_ring_of_which_no_end_is_free_is_begun_as_before() -> None:
    told = "Survey the pile at [60, 0]. Keep at least 40 m from the rig at [120, 0]."
    rig = task("SurveyTarget", {"target_position": [120, 0], "radius": 12}, [go(108, 0)], told)
    plan = document([square(60, 0, 12), rig])
    assert len(plan["tasks"][0]["skill_sequence"]) == 8


def test_a_beacon_that_the_command_puts_in_the_middle_of_a_grid_is_kept_clear_of() -> None:
    given = {"center": [100, 100], "width": 60, "length": 60, "spacing": 30}
    lanes = [(70, 70), (70, 130), (100, 130), (100, 70), (130, 70), (130, 130)]
    told = "Survey the depths around [100, 100]."
    grid = task("BathymetryGridSurvey", given, [go(*at) for at in lanes], told)
    plan = document([grid], command="Map 60 x 60 round 100,100, mind the beacon at 100,100.")
    assert nearest(plan, [100, 100]) >= 9.5
    plan = document([grid], command="Map 60 x 60 round 100,100, mind the wreck at 100,100.")
    assert waypoints(plan) == [list(at) for at in lanes]


def test_the_way_on_from_an_arc_begins_with_no_step_off_its_circle() -> None:
    here = (50, 10)  # on the stand-off circle of the buoy
    first = way_round(here, (50, -40), [BUOY], lambda _start, _goal: True)[0]
    assert math.dist(here, first) > 5


def test_ways_to_and_from_steps_within_a_stand_off_come_no_nearer_than_these() -> None:
    ring = [(80, 30), (120, 30), (120, 70), (80, 70)]
    survey = task(
        "SurveyTarget",
        {"target_position": [100, 50], "radius": 20},
        [go(x, y) for x, y in ring],
        "Inspect [100, 50] at a stand-off of 20 m.",
    )
    divers = "The vehicle stays at least 40 m from the divers at [50, 25]."
    plan = document([survey, transit(0, 0)], constraints=[divers])
    assert nearest(plan, [50, 25]) >= math.dist((80, 30), (50, 25)) - 0.1
    assert "limit-broken" in kinds(plan)


def test_ways_lead_round_closed_areas() -> None:
    closed = "The vehicle stays outside [60, -20], [100, -20], [100, 30], [60, 30]."
    plan = document([transit(120, 0), transit(0, 0)], constraints=[closed])
    assert waypoints(plan) == [[59, -21], [101, -21], [120, 0], [101, -21], [59, -21], [0, 0]]
    assert "limit-broken" not in kinds(plan)
    # What lies inside can only be warned of.
    inside = document([transit(80, 0)], constraints=[closed])
    assert waypoints(inside) == [[80, 0]]
    assert "limit-broken" in kinds(inside)


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("Note the wreck's mast is sticking out of the water right at 80,-40.", ["mast"]),
        ("Crew boat is moored at x 105, y 80.", ["boat"]),
        ("Hold station at west cardinal buoy 90,-35.", ["buoy"]),
        ("The red buoy is at 40,20.", ["The red buoy"]),
        ("The boat is to wait, then 40,20.", []),
    ],
)
def test_things_are_told_of_at_their_position(text: str, named: list[str]) -> None:
    assert [words for words, _place in named_places(text, USV)] == named


def test_a_small_thing_has_a_small_stand_off() -> None:
    """What is gone to as far off as its circle is not moved, and no waypoint is rounded into it."""
    turn = step("ArcTurn", {"radius": 0.5, "delta_yaw": 360})
    weld = task("PerformOrbit", {"center": [7, -2], "radius": 0.5, "arc": 360}, [turn])
    for start in (6.5, 7):
        plan = document([transit(start, -2), weld])
        moved = track(plan, USV).legs[0].points[-1]
        assert math.dist(moved, (7, -2)) == pytest.approx(0.5, abs=0.01)
        assert moved == (6.5, -2) or start == 7


def along(side: str, y: float) -> dict[str, Any]:
    given = {"side_id": side, "length": 50, "distance": 18}
    prompt = f"Run along the {side} side of the platform at [90, 0] for 50 m, 18 m off."
    return task("ParallelStructurePass", given, [go(65, y), go(115, y)], prompt)


def test_a_pass_is_gone_to_at_its_distance_and_the_next_one_round_the_structure() -> None:
    to = transit(90, 0, "Go to the platform at [90, 0].")
    plan = document([to, along("north", 18), along("south", -18), transit(0, 0)])
    assert [90, 18] in waypoints(plan)
    assert nearest(plan, [90, 0]) >= 17.5
    added = [mark for mark in plan["tasks"][2]["added"] if mark["kind"] == "clearance"]
    steps = plan["tasks"][2]["skill_sequence"]
    assert added and len(steps) == len(added) + 2
    assert "structure-close" not in kinds(plan)
    # The pass itself is as it was.
    assert waypoints({"tasks": [plan["tasks"][1]]}) == [[65, 18], [115, 18]]
    assert waypoints({"tasks": [plan["tasks"][2]]})[-2:] == [[65, -18], [115, -18]]


def test_a_way_to_a_pass_through_a_structure_is_told() -> None:
    fence = "The vehicle stays inside [0, -20], [200, -20], [200, 20], [0, 20]."
    given = {"side_id": "west", "length": 20, "distance": 40}
    prompt = "Run along the west side of the platform at [90, 0] for 20 m, 40 m off."
    west = task("ParallelStructurePass", given, [go(50, -10), go(50, 10)], prompt)
    plan = document([transit(150, 0), west], constraints=[fence])
    assert "structure-close" in kinds(plan)
