"""A plan in short."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from planner_ft.document.track import Target, track
from planner_ft.document.tree import Brief, brief, overview_lines
from planner_ft.support.geodesy import Origin
from tests.documents import USV, document, step, task

OUT = task(
    "Transit", {"target_position": [300, 0]}, [step("GoToXY", {"x": 300, "y": 0})], "Go out."
)
HOLD = task("KeepStation", {"duration": 600}, [step("StationKeep", {"time": 600})])
BACK = task("Transit", {"target_position": [0, 0]}, [step("GoToXY", {"x": 0, "y": 0})], "Return.")
OPEN = task("Transit", {"target_position": [-99, -99]}, None, "Go to the green buoy.")


def made(*tasks: dict[str, Any], **planned_as: Any) -> Brief:
    plan = document(tasks, **planned_as)
    return brief(plan, track(plan, USV), USV)


def test_a_row_per_task_with_length_time_and_endurance_used_so_far() -> None:
    rows = made(OUT, HOLD, BACK).rows
    assert [(row.task, row.length, row.seconds, row.known) for row in rows] == [
        ("t1", 300, 200, True),
        ("t2", 0, 600, True),
        ("t3", 300, 200, True),
    ]
    assert [round(7200 * (row.used or 0)) for row in rows] == [200, 800, 1000]


def test_a_row_says_that_a_part_is_not_known() -> None:
    assert [row.known for row in made(OUT, OPEN, BACK).rows] == [True, False, False]


def test_where_the_vehicle_ends() -> None:
    assert made(OUT, BACK).end == "at home"
    assert made(OUT).end == "300 m from home, at (300, 0)"
    assert made(OUT, OPEN).end.startswith("not known")
    assert made(OPEN, BACK).end == "at home", "the way is not known, the end is"
    assert made().end.startswith("where it starts")


def test_values_that_nobody_stated_are_taken_for_granted() -> None:
    (assumed,) = made(HOLD, command="Hold here.").assumed
    assert assumed == "Task 1, KeepStation: duration 600 s is the model's own."
    assert made(HOLD, command="Hold here for 600 seconds.").assumed == ()


def test_what_was_not_checked_is_said_and_gets_less_with_an_origin_and_a_fence() -> None:
    found = made(OUT, BACK).unchecked
    assert [one.split(":")[0] for one in found] == [
        "Obstacles",
        "Where the vehicle may be",
        "Where on earth this is",
        "Wind, waves, current, depth and traffic",
    ]
    fence = "The vehicle stays inside [-10, -10], [400, -10], [400, 10], [-10, 10]."
    less = made(OUT, BACK, constraints=[fence], origin=Origin(54.3, 10.1))
    assert [one.split(":")[0] for one in less.unchecked] == ["Obstacles", found[-1].split(":")[0]]
    assert less.fences[0].inside and len(less.fences[0].polygon) == 4
    words = made(OUT, BACK, constraints=["The crew must agree."]).unchecked
    assert words[0].startswith("A constraint is no limit")


def test_every_part_that_was_not_checked_is_counted_and_named() -> None:
    chart = {f"mast {one}": (50.0 * one, 90.0) for one in range(1, 7)}
    texts = [
        "The crew must agree.",
        "Mind the paint.",
        "The vehicle is back by 16:30.",
        "The vehicle stays outside [40, 80], [60, 80], [60, 85], [40, 85].",
    ]
    found = made(OUT, OPEN, OPEN, chart=chart, constraints=texts)
    assert found.unchecked[:4] == (
        "The vehicle is back by 16:30: the plan has no time of day.",
        "2 constraints are no limit that a program keeps: read the list of constraints.",
        "Length, time or way of tasks 2, 3: a part of it is not known.",
        "Obstacles other than mast 1, mast 2, mast 3, mast 4, mast 5 and others: the program knows"
        " no others.",
    )
    assert found.unchecked[4].startswith("Where the vehicle may be"), "a closed area is no fence"
    del chart["mast 6"]
    less = made(OUT, OPEN, chart=chart).unchecked
    assert less[0].startswith("Length, time or way of task 2: a part")
    assert less[1].startswith("Obstacles other than mast 1, mast 2, mast 3, mast 4, mast 5: the")


def test_areas_and_a_distance_from_home_are_fences() -> None:
    corners = "[40, 80], [60, 80], [60, 85], [40, 85]"
    texts = [f"The vehicle stays {how} {corners}." for how in ("inside", "outside")]
    far = "The vehicle stays within 90 m of home."
    inside, outside, ring = made(OUT, constraints=[*texts, far]).fences
    assert inside.polygon == outside.polygon == ((40, 80), (60, 80), (60, 85), (40, 85))
    assert (inside.inside, outside.inside, ring.inside) == (True, False, True)
    assert [one.text for one in (inside, outside, ring)] == [*texts, far]
    assert len(ring.polygon) == 72 and ring.polygon[0] == (0, 90)
    assert ring.polygon[18] == pytest.approx((90, 0)) and ring.polygon[36][1] == -90


@pytest.mark.parametrize(
    ("x", "end"),
    [(0.5, "at home"), (0.6, "1 m from home, at (0.6, 0)"), (7, "7 m from home, at buoy")],
)
def test_the_end_is_home_a_named_place_or_a_position(x: float, end: str) -> None:
    go = task("Transit", {"target_position": [x, 0]}, [step("GoToXY", {"x": x, "y": 0})])
    path = track(plan := document([go]), USV)
    buoy = Target("buoy", (7.9, 0.0), "t1")
    assert brief(plan, replace(path, targets=(Target("mast", None, "t1"), buoy)), USV).end == end
    far = replace(path, targets=(Target("buoy", (x + 1, 0.0), "t1"),))
    assert "buoy" not in brief(plan, far, USV).end


def test_values_of_the_vehicle_and_notes_of_the_agents_are_taken_for_granted() -> None:
    plan = document([HOLD, OUT], command="Hold here, go to [300, 0].")
    plan["assumptions"] = ["It is day."]
    plan["tasks"][0]["sources"]["duration"]["kind"] = "vehicle"
    plan["tasks"][1] |= {"assumptions": ["The tide is out."]}
    assert brief(plan, track(plan, USV), USV).assumed == (
        "It is day.",
        "Task 1, KeepStation: duration 600 s is the vehicle's own value.",
        "Task 2, Transit: The tide is out.",
    )


def test_a_row_without_an_endurance_says_no_share_of_it() -> None:
    plan = document([OUT, OPEN])
    plan["vehicle"] = None
    found = brief(plan, track(plan, USV), USV)
    assert [row.used for row in found.rows] == [None, None]
    assert [row.seconds for row in found.rows] == [0, 0]
    assert list(overview_lines(plan, found)) == [
        "  1 Transit     300 m      0:00",
        "  2 Transit       0 m      0:00  and more that is not known",
        "Ends not known: a place or the steps of a task are missing.",
    ]


def test_a_line_per_task_for_a_terminal() -> None:
    plan = document([OUT, HOLD, OPEN])
    lines = list(overview_lines(plan, brief(plan, track(plan, USV), USV)))
    assert lines[0].split() == ["1", "Transit", "300", "m", "3:20", "3", "%"]
    assert lines[2].endswith("and more that is not known")
    assert lines[3].startswith("Ends not known")
