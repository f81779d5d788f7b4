"""Replaying a mission plan: where it stops, for which reason, and what it leaves behind."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.replay import (
    START,
    Holds,
    Progress,
    collects,
    on_board,
    replay,
    sound,
    stops,
    target,
)
from tests.missions import OPEN, REPORT, STARE, Task, find, go, send

USV, DRONE = load_vocabulary(), load_vocabulary("inspection_drone")


def plan(*tasks: Task) -> dict[str, Any]:
    return {"tasks": [{"title": title, "parameters": given} for title, given in tasks]}


ORBIT: Task = ("PerformOrbit", {"center": [10, 20], "radius": 15})
GRID: Task = ("BathymetryGridSurvey", {"center": [10, 20]})
DRIFT: Task = ("DriftAudit", {"duration": 60})
THERMAL: Task = ("ThermalTimeLapse", {"duration": 600})
FOUND = (find("green buoy"), go(*OPEN), STARE, REPORT, go(0, 0))
UNRESOLVED = "its place is unresolved and no SearchAndDetect comes before it"
SEEN = "SearchAndDetect locates but does not arrive; no Transit comes before this task"
AWAY = "performed at [10, 20], but no Transit there comes before it"
THERE = "the only target that was located (red buoy) is where the vehicle is"
ABSENT = "target_position is missing or no position"
NOTHING = USV.logic.lacking["observations"]
LATER = "'thermal readings' is collected later in the plan"


@pytest.mark.parametrize(
    ("tasks", "stop"),
    [
        (FOUND, None),
        (FOUND[1:], (0, "target located", UNRESOLVED)),
        ((go(10, 20), go(*OPEN)), (1, "target located", UNRESOLVED)),
        ((find("green buoy"), STARE), (1, "vehicle at the place", SEEN)),
        (
            (find("green buoy"), ("KeepStation", {"duration": 60})),
            (1, "vehicle at the place", SEEN),
        ),
        ((find("green buoy"), go(10, 20), ORBIT), None),
        ((ORBIT,), (0, "vehicle at the place", AWAY)),
        ((go(5, 5), ORBIT), (1, "vehicle at the place", AWAY)),
        ((go(10, 5), ORBIT), (1, "vehicle at the place", AWAY)),
        ((go(5, 20), ORBIT), (1, "vehicle at the place", AWAY)),
        ((go(10, 20), ORBIT, STARE), None),
        # The grid ends elsewhere, and drifting off is known to.
        ((GRID, ORBIT), (1, "vehicle at the place", AWAY)),
        ((go(10, 20), DRIFT, ORBIT), None),
        ((("DockingApproach", {"goal_position": OPEN}),), None),  # A berth needs no search.
        ((("FollowTarget", {"target_id": "contact 4"}),), None),
        ((("FollowTarget", {"target_position": [1, 2]}),), None),
        ((("KeepStation", {"duration": 60}),), None),  # "Hold where you are."
        # Two places that are not known yet; the same one again, unless the vehicle has drifted off.
        ((find("red buoy"), find("white buoy"), go(*OPEN), STARE, go(*OPEN)), None),
        ((find("red buoy"), go(*OPEN), STARE, go(*OPEN)), (3, "target located", THERE)),
        ((find("red buoy"), go(*OPEN), DRIFT, go(*OPEN), STARE), None),
        ((go(10, 20), REPORT, STARE), (1, "data collected", NOTHING)),
        ((go(10, 20), STARE, REPORT), None),
        ((send("log"),), (0, "data collected", NOTHING)),
        ((("SmartDataHarvest", {}),), (0, "data collected", NOTHING)),
        ((send("thermal readings"), THERMAL), (0, "data collected", LATER)),
        ((STARE, send("thermal readings"), THERMAL), (1, "data collected", LATER)),
        ((THERMAL, send("thermal readings"), THERMAL), None),
        ((go(1, 2), ("Berthing", {})), (1, "task known", "'Berthing' is no task of this vehicle")),
        ((("Transit", {}),), (0, "position known", ABSENT)),
        ((("Transit", {"target_position": "the pier"}),), (0, "position known", ABSENT)),
        ((("FollowTarget", {}),), (0, "position known", f"target_id or {ABSENT}")),
    ],
)
def test_a_plan_runs_to_its_end_or_stops_at_the_task_that_cannot_run(
    tasks: tuple[Task, ...], stop: tuple[int, str, str] | None
) -> None:
    found = replay(plan(*tasks), USV)
    assert (found and (found.index, found.condition, found.reason)) == stop
    assert found is None or found.title == tasks[found.index][0]


def test_every_unmet_condition_is_told_as_if_those_before_were_met() -> None:
    found = list(stops(plan(go(*OPEN), ORBIT, send("sonar"), REPORT, send("log")), USV))
    assert [(stop.index, stop.condition, missing) for stop, missing in found] == [
        (0, "target located", frozenset()),
        (1, "vehicle at the place", frozenset()),
    ]
    found = list(stops(plan(REPORT, send("thermal"), THERMAL, send("thermal")), USV))
    assert [(stop.index, missing) for stop, missing in found] == [
        (0, {"observations"}),
        (1, {"thermal"}),
    ]


def test_what_is_on_board_may_be_sent_and_reported() -> None:
    early = plan(send("Depth soundings"), GRID, REPORT)
    assert on_board(early, USV) == Holds(items=frozenset({"depth soundings"}))
    assert on_board(plan(REPORT), USV) == Holds(facts=frozenset({"observations"}))
    assert replay(early, USV, on_board(early, USV)) is None
    assert replay(plan(send("DEPTH soundings")), USV, on_board(early, USV)) is None
    assert replay(plan(send("log")), USV, on_board(early, USV)) is not None
    assert replay(plan(REPORT), USV, Holds(facts=frozenset({"observations"}))) is None


def test_progress_says_where_a_plan_stands_behind_each_task() -> None:
    def behind(*tasks: Task) -> Progress:
        progress = START
        for title, given in tasks:
            progress = progress.after(USV.task[title], given, USV)
        return progress

    titles = ("SearchAndDetect", "Transit", "DriftAudit", "PerformOrbit")
    assert Progress(0, (), None, False, False, (), ()) == START
    assert behind(find("buoy")) == Progress(1, ("buoy",), None, True, True, titles[:1])
    assert behind(find("buoy"), go(1, 2)) == Progress(
        2, ("buoy",), (1, 2), False, False, titles[:2], ((1, 2),)
    )
    drifted = behind(find("buoy"), go(1, 2), DRIFT)
    assert (drifted.here, drifted.moved, drifted.done) == ((1, 2), True, titles[:3])
    there = behind(find("buoy"), go(1, 2), DRIFT, ORBIT)
    assert (there.tasks, there.here, there.moved) == (4, (10, 20), False)
    assert (there.done, there.visited) == (titles, ((1, 2), (10, 20)))
    assert behind(GRID).here is None and behind(GRID).visited == ((10, 20),)
    assert behind(("SearchAndDetect", {})).searched == ("",)


def test_a_search_is_for_what_its_text_says() -> None:
    assert target(USV.task["SearchAndDetect"], find("red buoy")[1]) == "red buoy"
    assert target(USV.task["Diagnostics"], {}) == ""


def test_an_item_is_collected_by_a_task_that_yields_one_of_its_words() -> None:
    pano, orbit = USV.logic.of("HorizontalPanorama"), USV.logic.of("ParallelStructurePass")
    lapse = USV.logic.of("ThermalTimeLapse")
    for item in ("a picture", "Pictures of it", "PANORAMA", "pano-s, stills"):
        assert collects(pano, item), item
    assert collects(orbit, "passes") and collects(lapse, "the time-lapse")
    for item in ("pictur", "picturesque", "", "sonar"):
        assert not collects(pano, item), item


def test_only_parameters_that_are_valid_by_themselves_count() -> None:
    orbit = USV.task["PerformOrbit"]
    given = {"center": [1, 2], "radius": -1, "colour": "red"}
    assert sound(given, orbit) == {"center": [1, 2]}
    assert sound([1], orbit) == sound(None, orbit) == {}


def test_entries_that_are_no_tasks_stop_the_plan() -> None:
    for entry in ("Transit", {"title": ["Transit"]}, {"title": "Transit", "parameters": [1]}):
        assert replay({"tasks": [entry]}, USV) is not None


def test_another_vehicle_replays_by_its_own_definition() -> None:
    check: Task = ("PreflightCheck", {})
    seek: Task = ("FindAsset", {"target_description": "chimney"})
    fly: Task = ("FlyToPoint", {"target_position": OPEN})
    orbit: Task = ("TowerOrbit", {"center": OPEN, "radius": 20})
    assert replay(plan(check, seek, fly, orbit, ("SendReport", {})), DRONE) is None
    for tasks, at, condition in (
        ((check, fly, orbit), 1, "target located"),
        ((check, seek, orbit), 2, "vehicle at the place"),
    ):
        stop = replay(plan(*tasks), DRONE)
        assert stop is not None and (stop.index, stop.condition) == (at, condition)
    stop = replay(plan(("SendReport", {}), check), DRONE)
    assert stop is not None
    assert stop.reason == "nothing has been inspected yet that could be reported"
