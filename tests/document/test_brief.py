"""A plan in short."""

from __future__ import annotations

from typing import Any

from planner_ft.document.brief import Brief, brief, overview_lines
from planner_ft.document.track import track
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


def test_a_line_per_task_for_a_terminal() -> None:
    plan = document([OUT, HOLD, OPEN])
    lines = list(overview_lines(plan, brief(plan, track(plan, USV), USV)))
    assert lines[0].split() == ["1", "Transit", "300", "m", "3:20", "3", "%"]
    assert lines[2].endswith("and more that is not known")
    assert lines[3].startswith("Ends not known")
