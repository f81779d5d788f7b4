"""What ArduPilot is told of a plan: items, fences, and what is said to be lost."""

from __future__ import annotations

import inspect
import json
import math
from typing import Any

import pytest
from hypothesis import HealthCheck, assume, given, settings
from pymavlink.dialects.v20 import ardupilotmega

from planner_ft.exporters import Origin, PlanExport, mission
from planner_ft.exporters.mission import Mission, build_mission
from planner_ft.exporters.run import stop_words
from planner_ft.support.errors import PlannerError

from .plans import BUOY, DRONE, MAST, USV, document, documents, origins, step, task
from .readers import command

ORIGIN = Origin(59.9, 10.7)
HERE = {"target_position": [10, 0]}
SQUARE = [[-5, -5], [15, -5], [15, 5], [-5, 5]]


def written(tasks: list[dict[str, Any]], vocabulary: Any = USV, area: Any = None) -> Mission:
    return build_mission(
        PlanExport(document(tasks, vocabulary, area=area), vocabulary, ORIGIN), fences=True
    )


def items(*steps: dict[str, Any], vocabulary: Any = USV) -> list[tuple[int, tuple[float, ...]]]:
    title = vocabulary.transit
    return [
        (item.command, item.parameters)
        for item in written([task(title, HERE, list(steps))], vocabulary).items
    ]


def why(tasks: list[dict[str, Any]], what: str, area: Any = None) -> str:
    account = written(tasks, area=area).ledger.close()
    return next(loss.why for loss in (*account.lost, *account.changed) if what in loss.what)


def test_the_numbers_are_those_of_mavlink() -> None:
    numbers = {
        name: value
        for name, value in inspect.getmembers(mission)
        if name.startswith(("NAV_", "DO_"))
    }
    assert len(numbers) == 5
    assert all(command(name) == value for name, value in numbers.items())


def test_a_plan_becomes_items_in_order() -> None:
    commands = [item.command for item in written(MAST).items]
    arc = [command("NAV_WAYPOINT")] * (len(commands) - 8)
    speed, turn = command("DO_CHANGE_SPEED"), command("NAV_SET_YAW_SPEED")
    go, hold = command("NAV_WAYPOINT"), command("NAV_LOITER_TIME")
    assert commands == [go, turn, speed, speed, *arc, speed, speed, hold, go] and len(arc) >= 18


def test_a_stated_speed_ends_with_its_task() -> None:
    speeds = [
        item.parameters[1]
        for item in written(MAST).items
        if item.command == command("DO_CHANGE_SPEED")
    ]
    assert speeds == [1.2, 1.2, 1.5, 1.5]


def test_a_hold_lasts_as_long_as_stated() -> None:
    assert items(step("StationKeep", {"time": 90})) == [(command("NAV_LOITER_TIME"), (90, 0, 0, 0))]
    assert items(step("StationKeep", {"time": 0})) == [(command("NAV_LOITER_TIME"), (0, 0, 0, 0))]
    assert items(step("WaitForStability", {"time": 2.5})) == [
        (command("NAV_LOITER_TIME"), (3, 0, 0, 0))
    ]


def test_a_long_hold_becomes_several_that_the_autopilot_can_count() -> None:
    times = [parameters[0] for _command, parameters in items(step("StationKeep", {"time": 86400}))]
    assert sum(times) == 86400 and max(times) <= 32767


def test_a_hold_that_fills_a_mission_is_refused() -> None:
    assert len(items(step("StationKeep", {"time": 3_276_700}))) == 100
    for time in (3_276_701, 1e12):
        with pytest.raises(PlannerError, match=r"t1 holds for .*; shorten the hold"):
            items(step("StationKeep", {"time": time}))


def test_a_hold_without_a_time_has_no_end() -> None:
    assert items(step("StationKeep")) == [(command("NAV_LOITER_UNLIM"), (0, 0, 0, 0))]
    assert "the operator sends the vehicle on" in why(
        [task("Transit", HERE, [step("StationKeep")])], "StationKeep"
    )


def test_turns_are_headings_and_wide_ones_go_the_right_way() -> None:
    turn = command("NAV_SET_YAW_SPEED")
    assert items(
        step("RotateToHeading", {"heading": 315}), step("NudgeYaw", {"delta_yaw": 90})
    ) == [(turn, (315, 0, 0, 0)), (turn, (45, 0, 0, 0))]
    round_about = [
        parameters[0]
        for _command, parameters in items(
            step("GoToXY", {"x": 9, "y": 0}), step("NudgeYaw", {"delta_yaw": -360})
        )[1:]
    ]
    assert round_about == pytest.approx([330, 210, 90])


def test_a_turn_from_an_unknown_heading_is_lost() -> None:
    nudge = [
        task(
            "Transit", HERE, [step("NudgeYaw", {"delta_yaw": 90}), step("GoToXY", {"x": 1, "y": 1})]
        )
    ]
    assert len(written(nudge).items) == 1
    assert "heading before it is not known" in why(nudge, "NudgeYaw")


@pytest.mark.parametrize(
    ("lost", "said"),
    [
        (step("DriftWithCurrent", {"time": 60}), "no command that lets the vehicle drift"),
        (step("WaitForStability", {"threshold": 2}), "cannot tell when the vehicle is steady"),
        (step("ArcTurn", {"delta_yaw": 40}), "radius or its angle is not stated"),
        (step("RotateToHeading"), "heading is not stated"),
    ],
)
def test_a_movement_that_the_autopilot_has_not_is_lost_with_the_reason(
    lost: dict[str, Any], said: str
) -> None:
    tasks = [task("Transit", HERE, [lost, step("GoToXY", {"x": 10, "y": 0})])]
    assert [item.command for item in written(tasks).items] == [command("NAV_WAYPOINT")]
    assert said in why(tasks, lost["navigation_skill"]["name"])


def test_an_arc_keeps_its_distance() -> None:
    orbit = [item for item in written([MAST[1]]).items if item.command == command("NAV_WAYPOINT")]
    places = [ORIGIN.to_local(item.latitude, item.longitude) for item in orbit]
    assert all(math.dist(place, (120, -35)) == pytest.approx(25, abs=1e-3) for place in places)


def boundary(polygon: Any, *more: dict[str, Any]) -> list[dict[str, Any]]:
    return [
        task(
            "Transit",
            HERE,
            [
                step(
                    "GoToXY",
                    {"x": 10, "y": 0},
                    filters=[("BoundaryEnforcement", {"poly_coords": polygon})],
                ),
                *more,
            ],
        )
    ]


def test_a_boundary_that_holds_the_whole_mission_is_a_clockwise_fence() -> None:
    found = written(
        boundary(
            SQUARE,
            step(
                "GoToXY",
                {"x": 0, "y": 0},
                filters=[("BoundaryEnforcement", {"poly_coords": SQUARE})],
            ),
        )
    ).fences
    assert len(found) == 1
    corners = [ORIGIN.to_local(*corner) for corner in found[0]]
    assert sorted((round(x, 3), round(y, 3)) for x, y in corners) == sorted(map(tuple, SQUARE))
    assert (
        sum(
            (x2 - x1) * (y2 + y1)
            for (x1, y1), (x2, y2) in zip(corners, corners[1:] + corners[:1], strict=True)
        )
        > 0
    )


def test_a_boundary_that_the_mission_leaves_is_no_fence() -> None:
    leaving = boundary(SQUARE, step("GoToXY", {"x": 100, "y": 0}))
    assert written(leaving).fences == ()
    assert "the mission leaves this one" in why(leaving, "BoundaryEnforcement")
    crossed = boundary([[-5, -5], [15, 5], [15, -5], [-5, 5]])
    assert written(crossed).fences == () and "its sides cross" in why(
        crossed, "BoundaryEnforcement"
    )


def test_the_vehicles_area_is_a_fence() -> None:
    go = [task("Transit", HERE, [step("GoToXY", {"x": 10, "y": 0})])]
    assert len(written(go, area=SQUARE).fences) == 1
    assert written(go, area=[[-5, -5], [5, -5], [5, 5]]).fences == ()


def test_nothing_after_an_open_place_is_carried() -> None:
    assert [item.command for item in written(BUOY).items] == [command("NAV_LOITER_UNLIM")]
    assert 't2 waits for "green buoy"' in why(
        BUOY, "title PerformOrbit"
    ) and 't2 waits for "green buoy"' in why(BUOY, "GoToXY")


def test_a_plan_of_which_nothing_can_be_carried_is_refused() -> None:
    with pytest.raises(
        PlannerError,
        match='nothing of the plan can be written as a mission: t1 waits for "green buoy"',
    ):
        written(BUOY[1:])
    with pytest.raises(PlannerError, match="no movement"):
        written([task("Diagnostics", {}, [])])


def test_what_flies_keeps_its_altitude_and_does_not_turn_on_the_spot() -> None:
    there = {"x": 3, "y": 4}
    flight = written(
        [
            task(
                "FlyToPoint",
                HERE,
                [
                    step("FlyToXY", {**there, "altitude": 30}),
                    step("YawTo", {"heading": 90}),
                    step("FlyToXY", there),
                ],
            )
        ],
        DRONE,
    )
    assert [(item.command, item.altitude) for item in flight.items] == [
        (command("NAV_WAYPOINT"), 30),
        (command("NAV_WAYPOINT"), 0),
    ]
    assert flight.vehicle_type == 2 and written(MAST).vehicle_type == 11


@pytest.mark.parametrize(
    ("kind", "number"),
    [("boat", "SURFACE_BOAT"), ("rover", "GROUND_ROVER"), ("copter", "QUADROTOR")],
)
@pytest.mark.parametrize("vocabulary", [USV, DRONE], ids=lambda vocabulary: vocabulary.name)
def test_the_vehicle_is_of_the_kind_that_its_profile_states(
    kind: str, number: str, vocabulary: Any
) -> None:
    name = "GoToXY" if vocabulary is USV else "FlyToXY"
    go = step(name, {"x": 3, "y": 4} | ({"altitude": 9} if vocabulary is DRONE else {}))
    plan = document([task(vocabulary.transit, HERE, [go])], vocabulary)
    plan["vehicle"]["kind"] = kind
    done = mission.write_qgc(PlanExport(plan, vocabulary, ORIGIN))
    wanted = getattr(ardupilotmega, f"MAV_TYPE_{number}")
    assert json.loads(done.text)["mission"]["vehicleType"] == wanted
    assert ("vehicle", "kind") in done.account.carried - done.account.changed_paths
    flown = any("altitude" in path for path in done.account.carried)
    assert flown == (kind == "copter" and vocabulary is DRONE)


@pytest.mark.parametrize("altitude", [0, 0.004])
def test_an_altitude_of_nothing_is_no_descent_and_the_account_says_so(altitude: float) -> None:
    down = step("FlyToXY", {"x": 3, "y": 4, "altitude": altitude})
    account = written([task("FlyToPoint", HERE, [down])], DRONE).ledger.close()
    lost = [loss for loss in account.lost if "altitude at hand" in loss.why]
    assert [(loss.what, loss.stops) for loss in lost] == [
        ("FlyToXY (step 1)", True),
        (f"FlyToXY altitude = {altitude} (step 1)", False),
    ]
    assert stop_words(account) == ["does not move as planned in task 1"]


@pytest.mark.parametrize("vocabulary", [USV, DRONE], ids=lambda vocabulary: vocabulary.name)
def test_what_is_said_to_be_carried_is_in_the_items(vocabulary: Any) -> None:
    @settings(max_examples=15, suppress_health_check=list(HealthCheck))
    @given(documents(vocabulary), origins())
    def check(plan: dict[str, Any], origin: Origin) -> None:
        try:
            made = build_mission(PlanExport(plan, vocabulary, origin), fences=True)
        except PlannerError:
            assume(False)
        account = made.ledger.close()
        places = [
            origin.to_local(item.latitude, item.longitude)
            for item in made.items
            if item.frame == mission.FRAME_RELATIVE_ALTITUDE
        ]
        numbers = [value for item in made.items for value in (*item.parameters, item.altitude)]
        for path in account.carried:
            value: Any = plan
            for key in path:
                value = value[key]
            if path[-1] in ("x", "y"):
                at = 0 if path[-1] == "x" else 1
                assert any(abs(place[at] - value) < 0.01 for place in places), path
            elif path[-1] in (
                "time",
                "wait",
                "duration",
                "interval",
                "yaw",
                "heading",
                "speed",
                "altitude",
            ):
                wanted = (
                    value % 360
                    if path[-1] in ("yaw", "heading")
                    else math.ceil(value)
                    if path[-1] in ("time", "wait", "duration", "interval")
                    else value
                )
                assert any(abs(number - wanted) < 1e-9 for number in numbers) or wanted > 32767, (
                    path
                )
            elif path[-1] in ("target_position", "goal_position", "center", "start"):
                assert any(math.dist(value, place) < 0.02 for place in places), path
            else:
                assert path in account.changed_paths or path[-1] == "name", path

    check()
