"""What was changed in a plan outside of the review, and who changed what in it."""

from __future__ import annotations

import copy
from pathlib import Path

from planner_ft.document import PlanDocument, apply, differences, read_document
from planner_ft.review.changes import MORE, tampered
from planner_ft.review.desk import open_desk
from planner_ft.review.terminal import review_lines
from planner_ft.support.files import write_json
from planner_ft.vocabulary import Vocabulary

WIDER = {"kind": "parameter", "task": "t3", "name": "radius", "value": 15}


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
