"""The plan as a tree for a terminal."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.document import apply
from planner_ft.document.tree import constraint_lines, plan_tree, task_tree
from planner_ft.support.geodesy import Origin
from tests.documents import USV, document, step, task


def transit(x: float, y: float, prompt: str = "Go.") -> dict[str, Any]:
    go = step("GoToXY", {"x": x, "y": y})
    return task("Transit", {"target_position": [x, y]}, [go], prompt)


OPEN = task("Transit", {"target_position": [-99, -99]}, None, "Go to the buoy.")


def test_the_whole_tree() -> None:
    look = step("RotateToHeading", {"heading": 90})
    look["filter_skills"] = [{"name": "ObstacleAvoidance", "parameters": {"min_distance": 5}}]
    look["perception_skills"] = [{"name": "DetectObjects", "parameters": {}}]
    turn = task("HorizontalPanorama", {"sectors": 2}, [look, step("StationKeep")], "Look round.")
    command = "Look round, go to the buoy."
    plan = document([transit(30, 40), turn, OPEN, OPEN], command=command, origin=Origin(54.3, 10.1))
    plan = {**plan, "assumptions": ["It is day."], "peak_memory_bytes": 2 * 2**30, "warnings": []}
    plan["usage"]["mission"] |= {"adapter": "a1", "load_seconds": 2.25, "queries": 2}
    assert plan_tree(plan).splitlines() == [
        command,
        "Origin of [0, 0]: 54.3° N, 10.1° E",
        "How sure: not known (Mission Agent: the model gives no log-probabilities that can be"
        " believed)",
        " 1 Transit(target_position=[30,40])",
        "   Go.",
        "    1. GoToXY(x=30, y=40)",
        " 2 HorizontalPanorama(sectors=2)",
        "   Look round.",
        "    1. RotateToHeading(heading=90) | ObstacleAvoidance(min_distance=5) + DetectObjects()",
        "    2. StationKeep()",
        " 3 Transit(target_position=[-99,-99])",
        "   Go to the buoy.",
        "   (skills wait for the position of buoy)",
        " 4 Transit(target_position=[-99,-99])",
        "   Go to the buoy.",
        "   (skills wait for the position of buoy)",
        "Assumptions:",
        " - It is day.",
        'Open places (fill in with --locate "NAME=x,y"):',
        " - buoy: tasks 3, 4",
        "",
        "Mission Agent  embedded lora, adapter a1: 2 answers, 1 tokens, 1 forward passes, 1.00 s"
        " (loaded in 2.2 s)",
        "peak memory 2.0 GiB",
    ]
    known = plan_tree(document([transit(30, 40)]))
    assert "Ends 50 m from home." in known.splitlines()
    assert "no adapter: 1 answer, " in known and "loaded" not in known
    (asks,) = [one for one in known.splitlines() if one.startswith(" - ")]
    assert asks.startswith(" - Task 1, Transit: target_position is [30, 40], which the command")
    one = plan_tree(document([OPEN], command="Go to the buoy."))
    assert " - buoy: task 1" in one.splitlines()


@pytest.mark.parametrize(
    ("command", "shown"), [("Fahre zur grünen Tonne.", 1), ("Go to [3, 4].", 0)]
)
def test_another_language_is_told_before_all_else_and_once(command: str, shown: int) -> None:
    lines = plan_tree(document([], command=command)).splitlines()
    told = [at for at, line in enumerate(lines) if "Most words of the command" in line]
    assert told == [1] * shown


def test_what_the_essentials_added_is_marked_in_its_step() -> None:
    plan = document([transit(30, 40)])
    marks = [("clearance", 0), ("clearance", 0), ("vehicle", 0), ("limit", 1)]
    plan["tasks"][0]["added"] = [
        {"step": at, "role": "filter", "name": "GoToXY", "kind": kind, "note": "n"}
        for kind, at in marks
    ]
    assert "    1. GoToXY(x=30, y=40)  (clearance)" in list(task_tree(plan))


def test_constraints_say_their_words_and_what_keeps_them() -> None:
    texts = [
        "Take care.",
        "The vehicle stays within 90 m of home.",
        "The vehicle keeps at least 5 m from every obstacle.",
        "The vehicle is back by 16:30.",
    ]
    plan = document([transit(30, 40)], command="Stay within 90 m of home.", constraints=texts)
    assert list(constraint_lines(plan)) == [
        texts[0],
        f'{texts[1]} (from "Stay within 90 m of home")',
        f"{texts[2]} (kept by ObstacleAvoidance)",
        f"{texts[3]} (not checked: the plan has no time of day)",
    ]


@pytest.mark.parametrize(("count", "told"), [(5, "p5"), (6, "p5 (and 1 more)")])
@pytest.mark.parametrize(("length", "more"), [(400, ""), (401, " ... (401 characters;")])
def test_an_answer_that_is_not_valid_is_cut_to_five_problems_and_400_characters(
    count: int, told: str, length: int, more: str
) -> None:
    wrong = {"problems": [f"p{one}" for one in range(1, count + 1)], "output": "x" * length}
    plan = {**document([]), **wrong}
    first, second, *_rest = task_tree(plan)
    assert first.endswith(f"is not a valid plan: p1; p2; p3; p4; {told}")
    assert second.startswith("   " + "x" * min(length, 400) + more) and "x" * 401 not in second
    assert ("--json" in second) == bool(more)


def test_a_plan_of_nothing_and_a_task_whose_skills_are_not_there() -> None:
    assert list(task_tree(document([]))) == ["no tasks"]
    plan = document([OPEN, transit(30, 40)])
    assert "   (skills wait for the position of buoy)" in task_tree(plan)
    placed = apply(plan, {"kind": "locate", "name": "buoy", "position": [9, 8]}, USV)
    assert next(iter(task_tree(placed))) == "Located: buoy at [9,8]"
    edit = {"kind": "prompt", "task": "t2", "text": "Go there."}
    outdated = "   (the skills were planned before the task was edited)"
    assert outdated in task_tree(apply(plan, edit, USV)) and outdated not in task_tree(plan)
