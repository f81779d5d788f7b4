"""Decisions: who may approve what, and what the log says about a plan afterwards."""

from __future__ import annotations

import copy
import json
from pathlib import Path
from typing import Any

import pytest

from planner_ft.document import PlanDocument, apply, document_digest, revise
from planner_ft.review import approval_of, approve, log_beside, read_log, reject
from planner_ft.review.approval import UnacknowledgedError
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary

WARNINGS = [
    {"id": "a", "kind": "unresolved-location", "task": None, "parameter": None, "text": "First."},
    {"id": "b", "kind": "unresolved-location", "task": None, "parameter": None, "text": "Second."},
]


def sealed(document: PlanDocument, **values: Any) -> PlanDocument:
    """The document with other values and the digest that belongs to them."""
    changed = {**document, **values}
    return {**changed, "digest": document_digest(changed)}


@pytest.fixture
def log(plan: Path) -> Path:
    return log_beside(plan)


def test_every_warning_must_be_acknowledged(document: PlanDocument, log: Path) -> None:
    warned = sealed(document, warnings=WARNINGS)
    with pytest.raises(
        UnacknowledgedError, match="1 of 2 warnings are not acknowledged: b;"
    ) as caught:
        approve(warned, log, "Ann", ["a"])
    assert caught.value.missing == ("b",)
    with pytest.raises(
        PlannerError, match="--acknowledge c: the plan has no such warning; it has a, b"
    ):
        approve(warned, log, "Ann", ["a", "b", "c"])
    assert not read_log(log)
    for acknowledged in (["a", "b"], ["all"]):
        record = approve(warned, log, "Ann", acknowledged).record
        assert record["acknowledged"] == [
            {"id": "a", "text": "First."},
            {"id": "b", "text": "Second."},
        ]


@pytest.mark.parametrize("name", ["", "  ", "Ann\x1b[31m", "a\nb", "x" * 201, "\udc80"])
def test_a_name_is_needed_and_cannot_carry_control_characters(
    document: PlanDocument, log: Path, name: str
) -> None:
    for decide in (
        lambda: approve(document, log, name, ["all"]),
        lambda: reject(document, log, name, "no"),
    ):
        with pytest.raises(PlannerError, match="name"):
            decide()
    assert not log.exists()


def test_what_is_altered_or_not_valid_cannot_be_approved(document: PlanDocument, log: Path) -> None:
    with pytest.raises(PlannerError, match="altered by hand"):
        approve({**document, "command": "Sink."}, log, "Ann", ["all"])
    with pytest.raises(PlannerError, match="not valid"):
        approve(sealed(document, valid=False), log, "Ann", ["all"])
    with pytest.raises(PlannerError, match="reason"):
        reject(document, log, "Ann", " ")
    assert not log.exists()


def test_the_record_holds_the_plan_with_its_models_and_differences(
    document: PlanDocument, log: Path, usv: Vocabulary
) -> None:
    edited = apply(
        document, {"kind": "parameter", "task": "t3", "name": "radius", "value": 15}, usv
    )
    record = approve(edited, log, " Ann ", ["all"], "good").record
    assert (
        record["reviewer"] == "Ann"
        and record["reason"] == "good"
        and record["digest"] == edited["digest"]
    )
    assert document_digest(record["plan"]) == edited["digest"]
    assert "radius 12 -> 15" in record["differences"][0]["text"]
    assert (
        record["models"]["task"]["configuration"] == "lora+grounded"
        and record["models"]["mission"]["candidate"] == "embedded"
    )


def test_the_last_decision_about_a_digest_counts(document: PlanDocument, log: Path) -> None:
    assert approval_of(document, log).status == "unknown"
    approve(document, log, "Ann", ["all"])
    approve(document, log, "Bob", ["all"])
    found = approval_of(document, log)
    assert (found.status, found.reviewer, found.sequence) == ("approved", "Bob", 2)
    reject(document, log, "Ann", "the wind")
    assert approval_of(document, log).status == "rejected" and approval_of(
        document, log
    ).text.endswith("(record 3): the wind")
    approve(document, log, "Ann", ["all"])
    assert approval_of(document, log).sequence == 4


def test_a_plan_that_was_edited_after_its_approval_names_every_change(
    document: PlanDocument, log: Path, usv: Vocabulary
) -> None:
    approve(document, log, "Ann", ["all"])
    edited = apply(
        document, {"kind": "parameter", "task": "t3", "name": "radius", "value": 20}, usv
    )
    edited = apply(edited, {"kind": "remove", "task": "t4"}, usv)
    edited = apply(edited, {"kind": "move", "task": "t3", "to": 0}, usv)
    found = approval_of(edited, log)
    texts = [change.text for change in found.changes]
    assert found.status == "altered" and "Ann approved it" in found.text
    assert "task 1, radius: approved 12, now 20" in texts
    assert any(
        text.startswith("task 4: approved {") and text.endswith("now nothing") for text in texts
    )
    assert "order of tasks: approved t1, t2, t3, now t3, t1, t2" in texts


CHANGES_BY_HAND = [
    (
        lambda plan: plan["tasks"][2]["parameters"].update(radius=20),
        "task 3, radius: approved 12, now 20",
    ),
    (
        lambda plan: plan["tasks"][3]["skill_sequence"][0]["navigation_skill"]["parameters"].update(
            x=1
        ),
        "task 4, step 1, GoToXY, x: approved 0, now 1",
    ),
    (
        lambda plan: plan["tasks"][0]["skill_sequence"][0]["stop_conditions"].append("x"),
        'task 1, step 1, stop_conditions: approved ["done"], now ["done","x"]',
    ),
    (lambda plan: plan["tasks"].pop(0), "task 1: approved {"),
    (
        lambda plan: plan.update(command="Sink."),
        'command: approved "Find the green buoy, circle it at 12 m, come home.", now "Sink."',
    ),
    (lambda plan: plan["vehicle"].update(endurance=1), "vehicle, endurance: approved "),
    (
        lambda plan: plan["proposed"]["tasks"][2]["parameters"].update(radius=13),
        "proposed, task 3, radius: approved 12, now 13",
    ),
    (lambda plan: plan.update(valid=1), "valid: approved true, now 1"),
    (lambda plan: plan.update(digest="0" * 64), "digest: approved "),
    (lambda plan: plan.update(extra=[1]), "extra: approved nothing, now [1]"),
]


@pytest.mark.parametrize("new_digest", [False, True])
@pytest.mark.parametrize(("change", "text"), CHANGES_BY_HAND)
def test_a_file_changed_by_hand_names_the_change(
    document: PlanDocument, log: Path, change: Any, text: str, new_digest: bool
) -> None:
    """Whether or not whoever changed it also put the digest right."""
    approve(document, log, "Ann", ["all"])
    altered = copy.deepcopy(document)
    change(altered)
    if new_digest and not text.startswith("digest"):
        altered["digest"] = document_digest(altered)
    found = approval_of(json.loads(json.dumps(altered)), log)
    assert found.status == "altered" and any(
        entry.text.startswith(text) for entry in found.changes
    ), found.changes


def test_a_plan_of_another_command_is_unknown(document: PlanDocument, log: Path) -> None:
    approve(document, log, "Ann", ["all"])
    other = sealed(
        document, command="Sink.", proposed={**document["proposed"], "constraints": ["other"]}
    )
    assert approval_of(other, log).status == "unknown"


def test_a_command_that_is_planned_again_is_another_plan(
    document: PlanDocument, log: Path, usv: Vocabulary
) -> None:
    approve(document, log, "Ada", ["all"])
    again = revise(
        {**document, "manifest": {**document["manifest"], "created": "2026-01-01T00:00:00+00:00"}},
        usv,
    )
    assert again["command"] == document["command"] and approval_of(again, log).status == "unknown"


def test_a_rejected_plan_that_was_altered_is_not_compared_with_the_rejection(
    document: PlanDocument, log: Path
) -> None:
    reject(document, log, "Ann", "no")
    found = approval_of({**document, "command": "Sink."}, log)
    assert found.status == "altered" and not found.changes and "holds no approval" in found.text
