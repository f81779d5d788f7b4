"""Skills in closed loops: what each does to the vehicle, and what it records."""

from __future__ import annotations

import math
from typing import Any

import pytest

from planner_ft.simulation.asked import read_faults, read_outlines
from tests.documents import DRONE, USV, step, task

from .conftest import Run
from .plans import go, lines, transit, using

HOLD = {"time": 4}


def test_every_skill_of_the_vessel_executes(run: Run) -> None:
    perception = [(skill.name, {}) for skill in USV.skills if skill.role == "perception"]
    polygon = [[-50, -50], [50, -50], [50, 50], [-50, 50]]
    filters: list[Any] = [("ObstacleAvoidance", {"min_distance": 3}), ("LockHeading", {})]
    filters.append(("BoundaryEnforcement", {"poly_coords": polygon}))
    moves = [
        step("GoToXY", {"x": 8, "y": 0, "yaw": 45}),
        step("StationKeep", HOLD),
        step("VisualStationKeep", {"target_id": "buoy"}),
        step("RotateToHeading", {"heading": 180}),
        step("NudgeYaw", {"delta_yaw": -20}),
        step("ArcTurn", {"radius": 6, "delta_yaw": 90}),
        step("DriftWithCurrent", HOLD),
        step("WaitForStability", {"threshold": 5, "time": 20}),
    ]
    steps = [using(moves[1], filters, perception), *map(using, moves)]
    done = run([transit(8, 0, *steps)], locations={"buoy": [30, 0]})
    assert [one.outcome for one in done.results] == ["done", "done"]
    told = lines(done)
    ran = {name for line in told if line["kind"] == "step" for name in line["skills"]}
    assert ran == {skill.name for skill in USV.skills} and len(ran) == 37
    recorded = {line["skill"] for line in told if line["kind"] == "record"}
    assert recorded == {name for name, _given in perception} and len(recorded) == 26
    assert all(line["t"] >= 0 and len(line["at"]) == 2 for line in told if line["kind"] == "record")


def test_every_skill_of_another_vehicle_executes(run: Run) -> None:
    perception = [(skill.name, {}) for skill in DRONE.skills if skill.role == "perception"]
    corners = [[-90, -90], [90, -90], [90, 90], [-90, 90]]
    filters = [("KeepClearance", {"distance": 2}), ("StayInGeofence", {"corners": corners})]
    moves = [
        step("FlyToXY", {"x": 20, "y": 5, "altitude": 12}),
        step("Hover", HOLD),
        step("YawTo", {"heading": 90}),
        step("OrbitArc", {"radius": 8, "delta_yaw": 180}),
    ]
    steps = [using(moves[0], filters, perception), *map(using, moves[1:])]
    done = run([task("FlyToPoint", {"target_position": [20, 5]}, steps)], DRONE)
    assert [one.outcome for one in done.results] == ["done", "done"]
    names = {name for line in lines(done) if line["kind"] == "step" for name in line["skills"]}
    assert names == {skill.name for skill in DRONE.skills}
    assert done.scene.pose[0, 2] == pytest.approx(12, abs=1.1)


@pytest.mark.parametrize("goal", [(25, 0), (-10, -15)])
def test_a_position_is_reached_within_its_tolerance(run: Run, goal: tuple[float, float]) -> None:
    done = run([transit(*goal)], tolerance=0.5)
    assert all(one.success and 0 < (one.waypoint_error or 9) < 0.9 for one in done.results)
    assert all(math.dist(track[-1], goal) < 1.5 for track in done.tracks)


def test_a_heading_on_arrival_is_reached(run: Run) -> None:
    done = run([transit(12, 0, go(12, 0, yaw=180))])
    assert [math.degrees(yaw) for yaw in done.scene.yaw] == pytest.approx([-90, -90], abs=4)


def test_a_hold_stays_where_a_drift_does_not(run: Run) -> None:
    held = run([transit(9, 0, go(9, 0), using(step("StationKeep", {"time": 60})))])
    adrift = run([transit(9, 0, go(9, 0), using(step("DriftWithCurrent", {"time": 60})))])
    assert all((one.holding_error or 9) < 0.5 for one in held.results)
    moved = [math.dist(track[-1], (9, 0)) for track in adrift.tracks]
    assert min(moved) > 1.2 and all(one.success for one in adrift.results)


def test_turns_take_the_stated_angle(run: Run) -> None:
    turns = (
        using(step("RotateToHeading", {"heading": 90})),
        using(step("NudgeYaw", {"delta_yaw": 200})),
    )
    done = run([transit(0, 0, *turns)])
    assert [math.degrees(yaw) for yaw in done.scene.yaw] == pytest.approx([160, 160], abs=5)


def test_an_orbit_keeps_its_stand_off(run: Run) -> None:
    orbit = {"center": [30, 0], "radius": 12, "arc": 360}
    steps = [using(step("ArcTurn", {"radius": 12, "delta_yaw": 360}))]
    done = run([transit(18, 0), task("PerformOrbit", orbit, steps)])
    assert all(one.success and (one.clearance or 0) > 9 for one in done.results)
    around = [math.degrees(math.atan2(y, x - 30)) for x, y in done.tracks[0]]
    assert max(around) > 170 and min(around) < -170
    steps = [using(step("ArcTurn", {"radius": 12, "delta_yaw": 360})) for _turn in range(2)]
    twice = run([transit(18, 0), task("PerformOrbit", orbit, steps)])
    assert all(0 < (one.standoff_error or 9) < 1 for one in twice.results)


AVOID = [("ObstacleAvoidance", {"min_distance": 6})]


def test_avoidance_goes_round_what_a_leg_would_hit(run: Run) -> None:
    legs = go(40, 0), using(step("GoToXY", {"x": 40, "y": 0}), AVOID)
    # The chart is wrong: the plan goes straight where the buoy truly is.
    chart, there = {"chart": {"wreck buoy": (20.0, 60.0)}}, {"wreck buoy": (20.0, 0.0)}
    straight, round_it = (run([transit(40, 0, leg)], how=chart, locations=there) for leg in legs)
    assert {one.outcome for one in straight.results} == {"collision"}
    assert all(one.success and (one.clearance or 0) > 4 for one in round_it.results)


def test_a_way_from_afar_goes_round_what_stands_in_it(run: Run) -> None:
    done = run([transit(-10, 0)], how={"chart": {"wreck buoy": (20.0, 0.0)}}, starts=((45.0, 0.0),))
    assert all(one.success and (one.clearance or 0) > 6 for one in done.results)
    assert [one.clearance_violations for one in done.results] == [0, 0]


def test_an_outline_is_hit_where_a_pile_is_passed(run: Run) -> None:
    chart, outlines = {"chart": {"wreck buoy": (20.0, 60.0)}}, read_outlines(["wreck buoy=8x30"])
    there = {"wreck buoy": (20.0, 12.0)}
    passed = run([transit(40, 0)], how=chart, locations=there)
    hit = run([transit(40, 0)], how=chart, locations=there, outlines=outlines)
    assert all(one.success and 10 < (one.clearance or 0) < 12 for one in passed.results)
    assert {one.outcome for one in hit.results} == {"collision"}


def test_a_boundary_holds_the_vehicle_until_the_step_fails(run: Run) -> None:
    corners = [[-20, -20], [15, -20], [15, 20], [-20, 20]]
    fenced = [("BoundaryEnforcement", {"poly_coords": corners})]
    done = run([transit(30, 0, using(step("GoToXY", {"x": 30, "y": 0}), fenced))])
    assert {one.outcome for one in done.results} == {"returned"}
    assert {one.reason for one in done.results} == {"GoToXY: position not reachable after 120 s"}
    assert max(x for track in done.tracks for x, _y in track) < 16.5


def test_a_locked_bow_stays_in_its_band(run: Run) -> None:
    locked = [("LockHeading", {})]
    done = run([transit(0, 0, using(step("StationKeep", {"time": 20}), locked))])
    yaws = [line["pose"][2] for line in lines(done) if line["kind"] == "pose"]
    free = run([transit(0, 0, using(step("StationKeep", {"time": 20})))])
    loose = [line["pose"][2] for line in lines(free) if line["kind"] == "pose"]
    assert max(yaws) - min(yaws) < math.radians(35) < max(loose) - min(loose)


def test_a_search_waits_for_a_detection(run: Run) -> None:
    look = using(step("StationKeep"), (), [("DetectObjects", {"class_list": ["raft"]})])
    search = task("SearchAndDetect", {"target_description": "raft"}, [look])
    found = run([search], locations={"raft": [20, 5]})
    assert all(one.success for one in found.results)
    record = next(line for line in lines(found) if line["kind"] == "record")
    assert math.dist(record["detections"][0]["at"], (20, 5)) < 3
    missing = run([search])
    assert {one.reason for one in missing.results} == {"DetectObjects: nothing found after 60 s"}


def test_a_step_without_the_failure_mode_stops(run: Run) -> None:
    look = using(step("StationKeep"), (), [("DetectObjects", {"class_list": ["raft"]})])
    done = run(
        [task("SearchAndDetect", {"target_description": "raft"}, [{**look, "failure_modes": []}])]
    )
    assert {one.outcome for one in done.results} == {"stopped"}
    assert "no failure mode" in done.results[0].reason


def test_depths_are_those_of_one_seabed(run: Run) -> None:
    sounding = [("GetSeabedDepth", {})]
    steps = [using(step("GoToXY", {"x": x, "y": 0}), (), sounding) for x in (20, 0)]
    done = run([transit(20, 0, *steps)])
    world = done.scene.world
    records = [line for line in lines(done) if line["kind"] == "record"]
    off = [abs(one["depth_m"] - world.depth(*one["at"])) for one in records]
    assert len(records) > 20 and max(off) < 0.8
    assert len({one["depth_m"] for one in records}) > 10


def test_lost_rays_and_a_dead_receiver_are_recorded_as_nothing(run: Run) -> None:
    look = [("DistanceToObstacle", {"fov": 360}), ("GetGPSLocation", {})]
    here = transit(0, 0, using(step("StationKeep", {"time": 8}), (), look))
    faults = read_faults(["lidar=1", "gps@0.5"])
    chart = {"chart": {"wreck buoy": (8.0, 0.0)}}
    seen, blind = lines(run([here], how=chart)), lines(run([here], how=chart, faults=faults))
    assert all(one["distance_m"] for one in seen if "distance_m" in one)
    assert not any(one["distance_m"] for one in blind if "distance_m" in one)
    fixes = [[one["fix"] for one in log if "fix" in one] for log in (seen, blind)]
    assert all(fixes[0]) and fixes[1][0] and not fixes[1][-1]
