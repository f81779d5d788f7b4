"""What an operator changed, in words, with who did it."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.document import PlanDocument, apply, differences
from tests.documents import USV, document, step, task


def to(x: float, y: float, prompt: str = "Go there.") -> dict[str, Any]:
    go = step("GoToXY", {"x": x, "y": y})
    return task("Transit", {"target_position": [x, y]}, [go], prompt)


OPEN = task("Transit", {"target_position": [-99, -99]}, None, "Go to the buoy.")


@pytest.fixture
def plan() -> PlanDocument:
    hold = task("KeepStation", {"duration": 60}, [step("StationKeep", {"time": 60})], "Hold 60 s.")
    return document([to(1, 2), hold, to(3, 4), OPEN], constraints=["Take care."])


def said(plan: PlanDocument, *edits: dict[str, Any]) -> list[str]:
    for edit in edits:
        by = edit.pop("by", "Ada")
        plan = apply(plan, edit, USV, by)
    return [one.text for one in differences(plan)]


def value(task: str, name: str, given: Any, **more: Any) -> dict[str, Any]:
    return {"kind": "parameter", "task": task, "name": name, "value": given, **more}


ADA = ", changed by Ada"


@pytest.mark.parametrize(
    ("edits", "texts"),
    [
        (
            [value("t2", "duration", 90)],
            [
                f"task 2, KeepStation: duration 60 -> 90{ADA}",
                f'task 2, KeepStation: prompt "Hold 60 s." -> "Hold 90 s."{ADA}',
            ],
        ),
        ([value("t2", "duration", None)], [f"task 2, KeepStation: duration 60 -> nothing{ADA}"]),
        (
            [
                value("t1", "target_position", [9, 2], by="Bo"),
                value("t3", "target_position", [9, 9]),
            ],
            [
                "task 1, Transit: target_position [1,2] -> [9,2], changed by Bo",
                f"task 3, Transit: target_position [3,4] -> [9,9]{ADA}",
            ],
        ),
        (
            [
                value("t2", "duration", 90, by="Bo"),
                {"kind": "prompt", "task": "t2", "text": "Hold."},
            ],
            [
                "task 2, KeepStation: duration 60 -> 90, changed by Bo",
                f'task 2, KeepStation: prompt "Hold 60 s." -> "Hold."{ADA}',
            ],
        ),
        (
            [value("t2", "duration", 90, by=None)],
            [
                "task 2, KeepStation: duration 60 -> 90",
                'task 2, KeepStation: prompt "Hold 60 s." -> "Hold 90 s."',
            ],
        ),
        (
            [{"kind": "locate", "name": "buoy", "position": [7, 8]}],
            [
                f"buoy: nothing -> [7,8]{ADA}",
                f"task 4, Transit: target_position [-99,-99] -> [7,8]{ADA}",
            ],
        ),
        (
            [
                {"kind": "locate", "name": "buoy", "position": [7, 8], "by": "Bo"},
                value("t1", "target_position", [9, 2]),
            ],
            [
                "buoy: nothing -> [7,8], changed by Bo",
                f"task 1, Transit: target_position [1,2] -> [9,2]{ADA}",
                "task 4, Transit: target_position [-99,-99] -> [7,8], changed by Bo",
            ],
        ),
        ([{"kind": "constraint", "at": 0}], [f'constraint "Take care.": removed{ADA}']),
        ([{"kind": "constraint", "at": 1, "text": "Hurry."}], [f'constraint "Hurry.": added{ADA}']),
        ([{"kind": "remove", "task": "t2"}], [f"KeepStation (t2): removed{ADA}"]),
        (
            [{"kind": "insert", "at": 1, "title": "Diagnostics"}],
            [f"task 2, Diagnostics: added{ADA}"],
        ),
        (
            [{"kind": "title", "task": "t2", "title": "FeatureStare"}],
            [f"task 2, FeatureStare: was KeepStation{ADA}"],
        ),
        ([{"kind": "move", "task": "t4", "to": 0}], [f"Transit: moved from place 4 to 1{ADA}"]),
        ([{"kind": "move", "task": "t1", "to": 3}], [f"Transit: moved from place 1 to 4{ADA}"]),
        (
            [{"kind": "move", "task": "t1", "to": 3}, {"kind": "move", "task": "t2", "to": 2}],
            ["2", "1"],
        ),
        (
            [{"kind": "skills", "task": "t2", "skill_sequence": [step("StationKeep")] * 2}],
            [f"task 2, KeepStation: skills 1 step -> 2 steps{ADA}"],
        ),
        (
            [{"kind": "skills", "task": "t4", "skill_sequence": [step("StationKeep")]}],
            [f"task 4, Transit: skills nothing -> 1 step{ADA}"],
        ),
    ],
)
def test_a_difference_is_a_sentence_with_who_made_it(
    plan: PlanDocument, edits: list[dict[str, Any]], texts: list[str]
) -> None:
    found = said(plan, *map(dict, edits))
    if texts == ["2", "1"]:
        assert len(found) == 2 and all("moved from place" in one for one in found)
    else:
        assert found == texts


def test_the_fewest_moves_explain_an_order() -> None:
    plan = document([to(one, 0) for one in range(5)])
    order = [{"kind": "move", "task": "t5", "to": 0}, {"kind": "move", "task": "t1", "to": 4}]
    assert said(plan, *map(dict, order)) == [
        f"Transit: moved from place 5 to 1{ADA}",
        f"Transit: moved from place 1 to 5{ADA}",
    ]


def test_what_is_there_twice_is_compared_once() -> None:
    plan = document([to(1, 2)], constraints=["Take care.", "Take care."])
    assert said(plan, {"kind": "constraint", "at": 0}) == []
    assert said(plan, {"kind": "remove", "task": "t1"}) == [f"Transit (t1): removed{ADA}"]


def test_each_parameter_of_a_task_has_the_one_who_changed_it() -> None:
    orbit = task("PerformOrbit", {"center": [1, 2], "radius": 20}, None, "Circle it.")
    edits = (value("t1", "radius", 30, by="Bo"), value("t1", "arc", 90))
    assert said(document([orbit]), *edits) == [
        "task 1, PerformOrbit: radius 20 -> 30, changed by Bo",
        f"task 1, PerformOrbit: arc nothing -> 90{ADA}",
    ]
