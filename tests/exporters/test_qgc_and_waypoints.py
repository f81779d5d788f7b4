"""The two files of a mission, read back by pymavlink and by the published rules of a .plan."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from planner_ft.exporters import DRAFT, Origin, PlanExport, load_format
from planner_ft.exporters.mission import HEADER

from .plans import DRONE, MAST, USV, document, origins, step, task
from .readers import command, load_waypoints, local_waypoints, plan_items

ORIGIN = Origin(-33.9, 151.2)
METRES = st.floats(-20_000, 20_000, allow_nan=False)


def text(
    name: str,
    plan: dict[str, Any],
    *,
    origin: Origin = ORIGIN,
    vocabulary: Any = USV,
    approval: str | None = "approved by Ada",
) -> str:
    return load_format(name).write(PlanExport(plan, vocabulary, origin, approval)).text


@settings(max_examples=15, suppress_health_check=list(HealthCheck))
@given(
    st.lists(st.tuples(METRES, METRES), min_size=1, max_size=8),
    origins(),
    st.sampled_from([USV, DRONE]),
)
def test_every_waypoint_returns_to_the_centimetre(
    tmp_path_factory: pytest.TempPathFactory,
    points: list[tuple[float, float]],
    origin: Origin,
    vocabulary: Any,
) -> None:
    assume(list(vocabulary.unresolved) not in [list(point) for point in points])
    go = next(skill.name for skill in vocabulary.skills if skill.motion == "goto")
    plan = document(
        [
            task(
                vocabulary.transit,
                {"target_position": list(points[-1])},
                [step(go, {"x": x, "y": y}) for x, y in points],
            )
        ],
        vocabulary,
    )
    read = local_waypoints(
        plan_items(json.loads(text("qgc", plan, origin=origin, vocabulary=vocabulary))), origin
    )
    assert [pytest.approx(point, abs=0.01) for point in points] == read
    path = tmp_path_factory.mktemp("mission") / "plan.waypoints"
    path.write_text(text("waypoints", plan, origin=origin, vocabulary=vocabulary), encoding="utf-8")
    loaded = load_waypoints(path)
    assert [pytest.approx(point, abs=0.01) for point in points] == [
        origin.to_local(item.x, item.y) for item in loaded[1:]
    ]


def test_pymavlink_reads_the_text_mission_as_it_was_meant(tmp_path: Path) -> None:
    path = tmp_path / "plan.waypoints"
    path.write_text(text("waypoints", document(MAST)), encoding="utf-8")
    home, *items = load_waypoints(path)
    assert (home.seq, home.current, home.frame, home.command) == (0, 1, 0, command("NAV_WAYPOINT"))
    assert (home.x, home.y) == (-33.9, 151.2)
    assert [
        (item.command, [item.param1, item.param2, item.param3, item.param4, item.x, item.y, item.z])
        for item in items
    ] == plan_items(json.loads(text("qgc", document(MAST))))
    assert all(item.autocontinue == 1 and item.current == 0 for item in items)


def test_a_draft_reads_like_the_approved_mission(tmp_path: Path) -> None:
    loaded = []
    for number, approval in enumerate((None, "approved by Ada")):
        path = tmp_path / f"{number}.waypoints"
        path.write_text(text("waypoints", document(MAST), approval=approval), encoding="utf-8")
        loaded.append([(item.command, item.x, item.y) for item in load_waypoints(path)])
    assert loaded[0] == loaded[1]
    assert (tmp_path / "0.waypoints").read_text().splitlines()[:2] == [
        HEADER,
        f"# {DRAFT}: plan {document(MAST)['digest'][:12]}",
    ]


def test_the_plan_file_says_vehicle_home_speed_and_approval() -> None:
    plan = json.loads(text("qgc", document(MAST)))
    mission = plan["mission"]
    assert (
        mission["firmwareType"],
        mission["vehicleType"],
        mission["cruiseSpeed"],
        mission["plannedHomePosition"],
    ) == (3, 11, 1.5, [-33.9, 151.2, 0])
    assert plan["planner_ft"]["approval"] == "approved by Ada"
    assert plan["geoFence"]["polygons"] != []


def test_what_the_autopilot_cannot_do_is_told_task_by_task() -> None:
    account = load_format("qgc").write(PlanExport(document(MAST), USV, ORIGIN)).account
    told = {(loss.task, what): loss.why for loss in account.lost for what in loss.what.split("; ")}
    assert "AVOID_MARGIN" in told["t1", "ObstacleAvoidance min_distance = 5 (step 1)"]
    assert "run them beside the autopilot" in told["t2", "SetStreamRecording (step 1)"]
    assert "failsafes" in told["t3", "failure mode: position lost (step 1)"]
    changed = {(loss.task, what) for loss in account.changed for what in loss.what.split("; ")}
    assert ("t2", "ArcTurn radius = 25 (step 1)") in changed
