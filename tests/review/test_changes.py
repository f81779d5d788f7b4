"""What was changed in a plan outside of the review, and who changed what in it."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import pytest

from planner_ft.document import PlanDocument, apply, differences, read_document
from planner_ft.review.approval import MORE, changes, tampered
from planner_ft.review.desk import open_desk
from planner_ft.review.terminal import review_lines
from planner_ft.support.files import compact_json, write_json
from planner_ft.vocabulary import Vocabulary
from tests.values import changeable

WIDER = {"kind": "parameter", "task": "t3", "name": "radius", "value": 15}


def test_what_a_review_is_made_of_cannot_be_changed() -> None:
    assert changeable("planner_ft.review") == []


def test_a_plan_as_it_was_saved_differs_in_nothing(document: PlanDocument, usv: Vocabulary) -> None:
    assert tampered(document, usv) is None
    assert tampered(apply(document, WIDER, usv, "Ada"), usv) is None


def test_changes_by_hand_are_named_against_what_was_saved_with_its_edits(
    document: PlanDocument, usv: Vocabulary
) -> None:
    saved = copy.deepcopy(apply(document, WIDER, usv, "Ada"))
    saved["tasks"][2]["parameters"]["radius"] = 3
    assert [one.text for one in tampered(saved, usv) or ()] == ["task 3, radius: saved 15, now 3"]


def test_changes_beside_the_tasks_are_told_too(document: PlanDocument, usv: Vocabulary) -> None:
    changed = copy.deepcopy(document)
    changed["vehicle"]["endurance"] = 90_000
    assert [one.text for one in tampered(changed, usv) or ()][-1] == MORE


def test_the_terminal_names_them_and_begins_with_a_line_per_task(
    plan: Path, usv: Vocabulary
) -> None:
    changed = read_document(plan)
    changed["tasks"][2]["parameters"]["radius"] = 3
    write_json(plan, changed)
    desk = open_desk(plan, None, None, "Ada")
    lines = [text for text, _style in review_lines(desk.document, desk.approval(), usv)]
    assert " - task 3, radius: saved 12, now 3" in lines
    assert lines.index("What will happen") < lines.index("Not checked") < lines.index("Command")
    assert any(text.startswith(" - caution: A place is not known. ") for text in lines)


def test_a_difference_says_who_made_it(document: PlanDocument, usv: Vocabulary) -> None:
    changed = apply(document, WIDER, usv, "Ada")
    changed = apply(changed, {"kind": "remove", "task": "t1"}, usv, "Bo")
    changed = apply(changed, {"kind": "prompt", "task": "t4", "text": "Come home."}, usv)
    found = {(one.kind, one.task): one.by for one in differences(changed)}
    assert found[("parameter", "t3")] == "Ada"
    assert found[("removed", "t1")] == "Bo"
    assert found[("prompt", "t4")] is None
    texts = [one.text for one in differences(changed)]
    assert "task 2, PerformOrbit: radius 12 -> 15, changed by Ada" in texts


def texts(approved: Any, now: Any) -> list[str]:
    return [one.text for one in changes(approved, now)]


def entry(ident: str, **parameters: Any) -> dict[str, Any]:
    steps = [{"navigation_skill": {"name": "GoToXY", "parameters": {"x": 1}}, "filter_skills": []}]
    return {"id": ident, "parameters": parameters, "skill_sequence": steps}


FIRST, SECOND, THIRD = entry("t1", radius=1), entry("t2", radius=2), entry("t3")
STEPS = SECOND["skill_sequence"]


@pytest.mark.parametrize(
    ("approved", "now", "said"),
    [
        ({"a": 1}, {"a": 1}, []),
        ({"a": 1}, {"a": True}, ["a: approved 1, now true"]),
        ({"a": False}, {"a": 0}, ["a: approved false, now 0"]),
        ({"a": 1}, {"a": 1.0}, []),
        ({"a": 1}, {}, ["a: approved 1, now nothing"]),
        ({}, {"a": [1]}, ["a: approved nothing, now [1]"]),
        ({"a": [1, 2]}, {"a": [1, 3]}, ["a: approved [1,2], now [1,3]"]),
        ({"a": [1]}, {"a": {"b": 1}}, ['a: approved [1], now {"b":1}']),
        ({"a": {"b": 1}}, {"a": [1]}, ['a: approved {"b":1}, now [1]']),
        (
            {"a": [{"b": 1}, {"b": 2}]},
            {"a": [{"b": 1}, {"b": 3}]},
            ["a, item 2, b: approved 2, now 3"],
        ),
        ({"a": [{"b": 1}]}, {"a": []}, ['a, item 1: approved {"b":1}, now nothing']),
        ({"a": []}, {"a": [{"name": "n"}]}, ['a, n: approved nothing, now {"name":"n"}']),
        ({"digest": "x"}, {"digest": "y"}, ['digest: approved "x", now "y"']),
        ({"digest": "x", "a": 1}, {"digest": "y", "a": 2}, ["a: approved 1, now 2"]),
        (
            {"warnings": 1, "b": 1},
            {"warnings": 2, "b": 2},
            ["b: approved 1, now 2", "warnings: approved 1, now 2"],
        ),
        (
            {"tasks": [FIRST, SECOND]},
            {"tasks": [FIRST, entry("t2", radius=3)]},
            ["task 2, radius: approved 2, now 3"],
        ),
        (
            {"tasks": [FIRST, SECOND]},
            {"tasks": [SECOND, FIRST]},
            ["order of tasks: approved t1, t2, now t2, t1"],
        ),
        (
            {"tasks": [FIRST]},
            {"tasks": [SECOND, FIRST]},
            [f"task 1: approved nothing, now {compact_json(SECOND)[:120]} ..."],
        ),
        (
            {"tasks": [FIRST, SECOND]},
            {"tasks": [SECOND]},
            [f"task 1: approved {compact_json(FIRST)[:120]} ..., now nothing"],
        ),
        (
            {"tasks": [FIRST, SECOND, THIRD]},
            {"tasks": [THIRD, SECOND]},
            [
                f"task 1: approved {compact_json(FIRST)[:120]} ..., now nothing",
                "order of tasks: approved t2, t3, now t3, t2",
            ],
        ),
        (
            {"tasks": [{**SECOND, "skill_sequence": STEPS * 2}]},
            {
                "tasks": [
                    {
                        **SECOND,
                        "skill_sequence": [
                            *STEPS,
                            {
                                **STEPS[0],
                                "navigation_skill": {"name": "GoToXY", "parameters": {"x": 5}},
                            },
                        ],
                    }
                ]
            },
            ["task 1, step 2, GoToXY, x: approved 1, now 5"],
        ),
        ("x" * 118, "y", [f'the plan: approved "{"x" * 118}", now "y"']),
        ("x" * 119, "y", [f'the plan: approved "{"x" * 119} ..., now "y"']),
    ],
)
def test_every_value_that_differs_is_named_for_people(
    approved: Any, now: Any, said: list[str]
) -> None:
    assert texts(approved, now) == said


def test_what_is_changed_by_hand_is_told_with_what_else_was(
    document: PlanDocument, usv: Vocabulary
) -> None:
    broken = {**copy.deepcopy(document), "proposed": {}}
    assert [one.text for one in tampered(broken, usv) or ()] == [MORE]
    sealed = {**copy.deepcopy(document), "digest": "0" * 64}
    assert [one.text for one in tampered(sealed, usv) or ()] == [MORE]
