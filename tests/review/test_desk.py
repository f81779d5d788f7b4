"""A plan in review: what is saved when, and that nobody overwrites anybody."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from planner_ft.document import altered, read_document, write_document
from planner_ft.planning.result import Answer
from planner_ft.review import log_beside, read_log
from planner_ft.review.desk import ChangedError, Desk, open_desk
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary
from tests.review.conftest import answer, go


def circling(task: Mapping[str, Any], before: Sequence[Mapping[str, Any]]) -> Answer:
    """A Task Agent that always goes to two places."""
    return answer({"skill_sequence": go((1, 2), (3, 4))})


@pytest.fixture
def desk(plan: Path, usv: Vocabulary) -> Desk:
    return Desk(plan, log_beside(plan), usv, circling, "Ann")


def radius(path: Path) -> Any:
    return json.loads(path.read_text())["tasks"][2]["parameters"].get("radius")


def test_an_edit_is_on_the_disk_when_it_is_shown(desk: Desk, plan: Path) -> None:
    assert desk.edit("3.radius=15")[0].text == "task 3, PerformOrbit: radius 12 -> 15"
    written = read_document(plan)
    assert radius(plan) == 15 and written == desk.document and written["edits"][-1]["by"] == "Ann"
    assert any("15 -> 12" in found.text for found in desk.edit("undo"))
    assert radius(plan) == 12 and not read_document(plan)["edits"]
    with pytest.raises(PlannerError, match="no edit to take back"):
        desk.edit("undo")


def test_a_refused_edit_leaves_the_plan_as_it_was(desk: Desk, plan: Path) -> None:
    before = plan.read_bytes()
    for text in (
        "3.radius=-1",
        "2.target_position=",
        "remove 9",
        "locate red buoy=1,2",
        "insert 9 Transit target_position=1,2",
    ):
        with pytest.raises(PlannerError):
            desk.edit(text)
    assert plan.read_bytes() == before and desk.document == read_document(plan)


def test_two_reviewers_of_one_plan_cannot_overwrite_each_other(
    desk: Desk, plan: Path, usv: Vocabulary
) -> None:
    other = Desk(plan, log_beside(plan), usv, circling, "Bob")
    desk.edit("3.radius=15")
    for use in (
        lambda: other.edit("3.radius=20"),
        lambda: other.approve("Bob", ["all"]),
        lambda: other.reject("Bob", "no"),
    ):
        with pytest.raises(ChangedError, match="changed by somebody else"):
            use()
    assert radius(plan) == 15 and not read_log(log_beside(plan))
    other.read()
    other.edit("3.radius=20")
    assert radius(plan) == 20


def test_skills_are_asked_for_again(desk: Desk) -> None:
    desk.edit("locate green buoy=120,-35")
    found = desk.edit("skills")
    assert [(item.task, item.kind) for item in found] == [("t2", "skills"), ("t3", "skills")]
    assert desk.document["complete"]
    with pytest.raises(PlannerError, match="has skills that fit it"):
        desk.edit("skills")
    desk.edit("3.radius=20")
    assert desk.document["tasks"][2]["stale"]
    desk.edit("skills 3")
    assert "stale" not in desk.document["tasks"][2]


def test_an_answer_that_is_not_valid_is_not_taken(plan: Path, usv: Vocabulary) -> None:
    desk = Desk(plan, log_beside(plan), usv, lambda task, _before: answer(None, "no such skill"))
    with pytest.raises(
        PlannerError,
        match=r"SearchAndDetect: the Task Agent's answer is not valid \(no such skill\)",
    ):
        desk.edit("skills 1")


def test_what_the_vehicle_adds_to_new_skills_is_marked(plan: Path, usv: Vocabulary) -> None:
    mark = {"step": 0, "role": "navigation", "name": "GoToXY", "kind": "vehicle"}
    desk = Desk(
        plan,
        log_beside(plan),
        usv,
        lambda task, _before: replace(circling(task, _before), added=(mark,)),
    )
    desk.edit("skills 1")
    assert read_document(plan)["tasks"][0]["added"] == [mark]


def test_without_a_model_the_rest_of_the_review_works(
    plan: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    desk = open_desk(plan, None, None, None, candidate="Llama-3.2-1B-Instruct")
    monkeypatch.setenv("PLANNERFT_MODELS", "")
    monkeypatch.chdir(plan.parent)
    with pytest.raises(PlannerError, match=r"Llama-3\.2-1B-Instruct"):
        desk.edit("skills 1")
    desk.edit("3.radius=15")
    assert desk.approve("Ann", ["all"]).record["sequence"] == 1


def test_the_task_agent_needs_the_place(plan: Path) -> None:
    with pytest.raises(PlannerError, match="place is open"):
        open_desk(plan, None, None, None).edit("skills 2")


def altered_by_hand(plan: Path, value: Any) -> None:
    document = json.loads(plan.read_text())
    document["tasks"][2]["parameters"]["radius"] = value
    plan.write_text(json.dumps(document))


def test_a_plan_altered_by_hand_is_adopted_explicitly(desk: Desk, plan: Path) -> None:
    with pytest.raises(PlannerError, match="was not altered"):
        desk.adopt()
    desk.approve("Ann", ["all"])
    altered_by_hand(plan, 20)
    desk.read()
    assert altered(desk.document) and desk.approval().status == "altered"
    assert "task 3, radius: approved 12, now 20" in [
        change.text for change in desk.approval().changes
    ]
    for use in (lambda: desk.edit("3.radius=15"), lambda: desk.approve("Ann", ["all"])):
        with pytest.raises(PlannerError, match="alter"):
            use()
    desk.adopt()
    assert (
        not altered(desk.document)
        and radius(plan) == 20
        and desk.document["edits"][-1]["edit"]["kind"] == "replace"
    )
    desk.edit("undo")
    assert radius(plan) == 12


def test_warnings_that_were_taken_out_of_the_file_come_back_before_the_approval(
    desk: Desk, plan: Path
) -> None:
    """Whoever takes them out can put the digest right, too."""
    desk.edit("remove 4")
    assert desk.document["warnings"]
    write_document(plan, {**desk.document, "warnings": []})
    desk.read()
    assert not altered(desk.document)
    with pytest.raises(PlannerError, match="worked out anew"):
        desk.approve("Ann", ["all"])
    assert desk.document["warnings"] and read_document(plan)["warnings"]
    assert desk.approve("Ann", ["all"]).record["acknowledged"]
