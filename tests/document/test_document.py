"""The document as a file: digest, reading what is broken, and differences in words."""

from __future__ import annotations

import copy
import hashlib
import json
import sys
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import rfc8785

from planner_ft.document import (
    PlanDocument,
    altered,
    apply,
    differences,
    document_digest,
    read_document,
    revise,
    write_document,
)
from planner_ft.document.build import canonical, document_problem
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.schema import document_schema
from tests.documents import DRONE, USV, document, step, task
from tests.values import changeable


@pytest.fixture(scope="module")
def plan() -> PlanDocument:
    steps = [step("GoToXY", {"x": 10, "y": 2.5})]
    return document(
        [
            task("Transit", {"target_position": [10, 2.5]}, steps),
            task("Transit", {"target_position": [0, 0]}, steps),
        ],
        command="Go to [10, 2.5], come back.",
    )


def test_anybody_can_compute_the_digest(plan: PlanDocument) -> None:
    rest = {key: value for key, value in plan.items() if key != "digest"}
    assert (
        plan["digest"] == hashlib.sha256(rfc8785.dumps(rest)).hexdigest() == document_digest(plan)
    )


def test_what_a_document_is_made_of_cannot_be_changed() -> None:
    draft = "planner_ft.document.operations.Draft"
    assert changeable("planner_ft.document", "planner_ft.document.warnings") == [draft]


def test_numbers_that_have_no_exact_form_still_have_a_digest(plan: PlanDocument) -> None:
    assert document_digest({**plan, "peak_memory_bytes": 10**20}) == document_digest(
        {**plan, "peak_memory_bytes": 1e20}
    )


def test_a_document_survives_a_file_and_another_order_of_keys(
    plan: PlanDocument, tmp_path: Path
) -> None:
    path = tmp_path / "plan.json"
    write_document(path, plan)
    assert read_document(path) == plan
    path.write_text(json.dumps(plan, sort_keys=True), encoding="utf-8")
    assert not altered(read_document(path))


def test_one_changed_digit_is_seen(plan: PlanDocument, tmp_path: Path) -> None:
    changed = copy.deepcopy(plan)
    changed["tasks"][0]["skill_sequence"][0]["navigation_skill"]["parameters"]["x"] = 11
    (tmp_path / "plan.json").write_text(json.dumps(changed), encoding="utf-8")
    assert altered(read_document(tmp_path / "plan.json"))


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda plan: json.dumps(plan)[:500], "not JSON"),
        (lambda plan: "", "not JSON"),
        (lambda plan: json.dumps(plan)[:-1] + ', "edits": []}', "'edits' stands twice"),
        (lambda plan: "[]", "is no plan document"),
        (lambda plan: json.dumps({**plan, "version": 9}), "is of version 9"),
        (
            lambda plan: json.dumps({**plan, "manifest": {**plan["manifest"], "agents": None}}),
            "manifest.agents",
        ),
        (
            lambda plan: json.dumps({**plan, "vocabulary": {"name": "usv", "sha256": "0" * 64}}),
            "was made with another vocabulary",
        ),
        (
            lambda plan: json.dumps(
                {**plan, "vocabulary": {**plan["vocabulary"], "motion": "0" * 64}}
            ),
            "was made with another motion file",
        ),
        (
            lambda plan: json.dumps(
                {**plan, "vocabulary": {"name": "/etc/passwd", "sha256": "0" * 64}}
            ),
            "which is not bundled",
        ),
        (lambda plan: json.dumps({**plan, "tasks": [{"title": "Fly"}]}), "tasks[0]"),
        (
            lambda plan: json.dumps(
                {key: value for key, value in plan.items() if key != "proposed"}
            ),
            "'proposed' is a required property",
        ),
    ],
)
def test_what_is_no_whole_plan_is_named_in_one_sentence(
    plan: PlanDocument, tmp_path: Path, change: Any, sentence: str
) -> None:
    path = tmp_path / "plan.json"
    path.write_text(change(plan), encoding="utf-8")
    with pytest.raises(PlannerError) as caught:
        read_document(path)
    assert (
        str(path) in str(caught.value)
        and sentence in str(caught.value)
        and "\n" not in str(caught.value)
    )


BREAKS: list[tuple[str, Any]] = [
    ("id", 3),
    ("id", None),
    ("title", "Fly"),
    ("title", 3),
    ("parameters", {}),
    ("parameters", {"target_position": [1]}),
    ("parameters", {"target_position": [1, "2"]}),
    ("parameters", {"target_position": [1, 2], "speed": 1}),
    ("parameters", []),
    ("task_prompt", 5),
    ("skill_sequence", 3),
    ("skill_sequence", [3]),
    ("skill_sequence", [{}]),
    ("skill_sequence", None),
    ("skill_sequence", []),
    ("skill_sequence", [step("Fly")]),
    ("skill_sequence", [step("GoToXY", {"x": 1})]),
    ("skill_sequence", [step("DetectObjects")]),
    ("skill_sequence", [{**step("StationKeep"), "more": 1}]),
    ("skill_sequence", [{**step("StationKeep"), "stop_conditions": [1]}]),
    ("stale", True),
    ("stale", False),
    ("sources", {"target_position": {"kind": "guess"}}),
    ("sources", {"target_position": {"kind": "command", "spans": [[0]]}}),
    ("located", {"target_position": ""}),
    ("note", 1),
]


@pytest.mark.parametrize(("key", "value"), BREAKS)
@pytest.mark.parametrize("proposed", [False, True])
def test_reading_accepts_what_the_published_schema_accepts(
    plan: PlanDocument, key: str, value: Any, proposed: bool
) -> None:
    changed = copy.deepcopy(plan)
    (changed["proposed"] if proposed else changed)["tasks"][0][key] = value
    by_schema = jsonschema.Draft202012Validator(document_schema(USV)).is_valid(changed)
    assert (document_problem(changed, USV) is None) == by_schema


def test_a_plan_of_another_vehicle_is_read_with_its_own_vocabulary(tmp_path: Path) -> None:
    title = DRONE.transit
    drone = document(
        [task(title, {DRONE.task[title].position_parameter or "": [1, 2]}, None)], DRONE
    )
    write_document(tmp_path / "plan.json", drone)
    assert read_document(tmp_path / "plan.json") == drone
    with pytest.raises(PlannerError, match="another vocabulary"):
        read_document(tmp_path / "plan.json", load_vocabulary("usv"))


def test_differences_say_what_was_changed(plan: PlanDocument) -> None:
    assert differences(plan) == []
    edited = apply(plan, {"kind": "move", "task": "t2", "to": 0}, USV)
    edited = apply(
        edited,
        {"kind": "parameter", "task": "t1", "name": "target_position", "value": [11, 3]},
        USV,
    )
    edited = apply(edited, {"kind": "insert", "at": 2, "title": "Diagnostics"}, USV)
    assert [change.text for change in differences(edited)] == [
        "task 2, Transit: target_position [10,2.5] -> [11,3]",
        "task 3, Diagnostics: added",
        "Transit: moved from place 1 to 2",
    ]
    assert [
        change.text for change in differences(apply(plan, {"kind": "remove", "task": "t2"}, USV))
    ] == ["Transit (t2): removed"]


def test_what_is_wrong_is_named_with_its_place_and_cut_to_200_characters(
    plan: PlanDocument,
) -> None:
    def problem(**changes: Any) -> str:
        return document_problem({**plan, **changes}, USV) or ""

    assert problem(edits=3).startswith("edits: ")
    assert (document_problem(3, USV) or "").startswith("the document: ")
    wrong = copy.deepcopy(plan["tasks"])
    wrong[1]["parameters"] = {"target_position": [1, 2], "x" * 300: 1}
    named = problem(tasks=wrong)
    assert named.startswith("tasks[1]: ") and len(named) == len("tasks[1]: ") + 204
    assert named.endswith(" ...")
    again = problem(proposed={**plan["proposed"], "tasks": wrong})
    assert again.startswith("proposed.tasks[1]: ")


def test_a_file_of_64_mib_is_read_and_a_larger_one_is_not(
    plan: PlanDocument, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_document(tmp_path / "plan.json", plan)
    size = (tmp_path / "plan.json").stat().st_size
    files = sys.modules[read_document.__module__]
    assert files.LARGEST_FILE == 64 * 1024 * 1024
    monkeypatch.setattr(files, "LARGEST_FILE", size)
    assert read_document(tmp_path / "plan.json") == plan
    monkeypatch.setattr(files, "LARGEST_FILE", size - 1)
    with pytest.raises(PlannerError, match=f"has {size} bytes, more than"):
        read_document(tmp_path / "plan.json")


@pytest.mark.parametrize(
    ("made", "sentence"),
    [
        (3, "names no vocabulary"),
        ({}, "names no vocabulary"),
        ({"name": 3}, "names no vocabulary"),
        (None, "names no vocabulary"),
    ],
)
def test_a_plan_that_names_no_vocabulary_is_refused(
    plan: PlanDocument, tmp_path: Path, made: Any, sentence: str
) -> None:
    (tmp_path / "plan.json").write_text(json.dumps({**plan, "vocabulary": made}))
    with pytest.raises(PlannerError, match=sentence):
        read_document(tmp_path / "plan.json")
    with pytest.raises(PlannerError, match=r"another vocabulary \('?\w+'?, other content\)"):
        read_document(tmp_path / "plan.json", USV)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (2**53 - 1, b"9007199254740991"),
        (-(2**53 - 1), b"-9007199254740991"),
        (2**53, b"9007199254740992"),
        ([True, {"a": 10**21}], b'[true,{"a":1e+21}]'),
    ],
)
def test_whole_numbers_have_the_form_of_rfc_8785(value: Any, text: bytes) -> None:
    assert canonical(value) == text


def test_a_plan_is_complete_when_nothing_is_open_and_all_answers_are_valid() -> None:
    steps = [step("StationKeep", {"time": 60})]
    hold = task("KeepStation", {"duration": 60}, steps, "Hold for 60 s.")
    whole = document([hold], command="Hold for 60 s.")
    assert (whole["valid"], whole["complete"]) == (True, True)
    less = document([hold, {**hold, "skill_sequence": None}], command="Hold for 60 s.")
    assert (less["valid"], less["complete"]) == (True, False)
    wrong = revise({**whole, "problems": ["no"], "output": ""}, USV)
    assert (wrong["valid"], wrong["complete"]) == (False, False)
    bad = copy.deepcopy(less)
    bad["tasks"][1] |= {"problems": ["no"], "output": ""}
    assert revise(bad, USV)["valid"] is False
    assert [one["id"] for one in less["tasks"]] == ["t1", "t2"]


def test_a_place_that_was_filled_in_is_located_in_its_tasks_and_an_open_one_is_not() -> None:
    there = task("Transit", {"target_position": [-99, -99]}, None, "Go to the buoy.")
    plan = document([task("KeepStation", {}, None), there, there], command="Go to the buoy.")
    assert plan["located"] == {} and plan["open_places"] == [{"name": "buoy", "tasks": [2, 3]}]
    assert [one.get("waits_for") for one in plan["tasks"]] == [None, "buoy", "buoy"]
    assert not any("located" in one for one in plan["tasks"])


def test_a_plan_without_the_digest_of_its_motion_file_is_read(
    plan: PlanDocument, tmp_path: Path
) -> None:
    old = {**plan, "vocabulary": {key: plan["vocabulary"][key] for key in ("name", "sha256")}}
    write_document(tmp_path / "plan.json", old)
    assert read_document(tmp_path / "plan.json")["tasks"] == plan["tasks"]
