"""An operator's edits: what each does, what none may do, what is recorded, and taking them back."""

from __future__ import annotations

import copy
from typing import Any

import jsonschema
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner_ft.document import PlanDocument, adopt, altered, apply, differences, undo
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.document_schema import document_schema
from tests.documents import USV, document, step, task

SCHEMA = jsonschema.Draft202012Validator(document_schema(USV))
COMMAND = "Find the green buoy, circle it at 12 m, hold for a minute, come home."


@pytest.fixture(scope="module")
def plan() -> PlanDocument:
    return document(
        [
            task(
                "SearchAndDetect",
                {"target_description": "green buoy"},
                [step("StationKeep")],
                "Search for the green buoy.",
            ),
            task("Transit", {"target_position": [-99, -99]}, None, "Go to the green buoy."),
            task(
                "PerformOrbit",
                {"center": [-99, -99], "radius": 12},
                None,
                "Circle the green buoy at 12 m, not at 120 m.",
            ),
            task(
                "KeepStation",
                {"duration": 60},
                [step("StationKeep", {"time": 60})],
                "Hold for 60 seconds.",
            ),
            task(
                "Transit",
                {"target_position": [0, 0]},
                [step("GoToXY", {"x": 0, "y": 0})],
                "Return home to [0, 0].",
            ),
        ],
        command=COMMAND,
    )


def by_id(plan: PlanDocument, ident: str) -> dict[str, Any]:
    return next(entry for entry in plan["tasks"] if entry["id"] == ident)


def test_a_located_place_is_filled_in_wherever_the_plan_waits_for_it(plan: PlanDocument) -> None:
    placed = apply(
        plan, {"kind": "locate", "name": "green buoy", "position": [120.0, -35]}, USV, "Ada"
    )
    assert by_id(placed, "t2")["parameters"] == {"target_position": [120, -35]} and by_id(
        placed, "t3"
    )["parameters"]["center"] == [120, -35]
    assert (
        placed["located"] == {"green buoy": [120, -35]}
        and placed["open_places"] == []
        and "waits_for" not in by_id(placed, "t2")
    )
    assert by_id(placed, "t3")["sources"]["center"]["kind"] == "located"
    assert [(record["by"], record["edit"]["kind"]) for record in placed["edits"]] == [
        ("Ada", "locate")
    ]
    moved = apply(placed, {"kind": "locate", "name": "green buoy", "position": [5, 5]}, USV)
    assert by_id(moved, "t3")["parameters"]["center"] == [5, 5], "a place can be put elsewhere"
    SCHEMA.validate(moved)


def test_an_edited_parameter_takes_its_prompt_along_and_outdates_the_skills(
    plan: PlanDocument,
) -> None:
    edited = apply(plan, {"kind": "parameter", "task": "t4", "name": "duration", "value": 90}, USV)
    entry = by_id(edited, "t4")
    assert (entry["parameters"], entry["task_prompt"], entry["stale"]) == (
        {"duration": 90},
        "Hold for 90 seconds.",
        True,
    )
    assert entry["sources"]["duration"]["kind"] == "operator"
    assert by_id(
        apply(plan, {"kind": "parameter", "task": "t3", "name": "radius", "value": 15}, USV), "t3"
    )["task_prompt"].startswith("Circle the green buoy at 15 m, not")
    again = apply(
        edited,
        {"kind": "skills", "task": "t4", "skill_sequence": [step("StationKeep", {"time": 90})]},
        USV,
    )
    assert "stale" not in by_id(again, "t4")
    assert (
        "duration"
        not in by_id(
            apply(
                plan, {"kind": "parameter", "task": "t4", "name": "duration", "value": None}, USV
            ),
            "t4",
        )["parameters"]
    )


def test_a_place_is_forgotten_with_the_last_task_at_it(plan: PlanDocument) -> None:
    placed = apply(plan, {"kind": "locate", "name": "green buoy", "position": [120, -35]}, USV)
    fewer = apply(placed, {"kind": "remove", "task": "t2"}, USV)
    assert fewer["located"] == {"green buoy": [120, -35]}
    assert apply(fewer, {"kind": "remove", "task": "t3"}, USV)["located"] == {}


def test_a_constraint_is_changed_added_and_removed_and_the_others_stay(plan: PlanDocument) -> None:
    edits = (
        ({"at": 0, "text": "One."}, ["One."]),
        ({"at": 1, "text": "Two."}, ["One.", "Two."]),
        ({"at": 2, "text": "Three."}, ["One.", "Two.", "Three."]),
        ({"at": 1, "text": "2."}, ["One.", "2.", "Three."]),
        ({"at": 0}, ["2.", "Three."]),
        ({"at": 1}, ["2."]),
    )
    for edit, left in edits:
        plan = apply(plan, {"kind": "constraint", **edit}, USV)
        assert plan["constraints"] == left
    with pytest.raises(PlannerError, match="constraint 2: the plan has 1"):
        apply(plan, {"kind": "constraint", "at": 1}, USV)


def test_tasks_are_removed_moved_and_inserted(plan: PlanDocument) -> None:
    assert [
        entry["id"] for entry in apply(plan, {"kind": "remove", "task": "t4"}, USV)["tasks"]
    ] == ["t1", "t2", "t3", "t5"]
    assert [
        entry["id"] for entry in apply(plan, {"kind": "move", "task": "t5", "to": 0}, USV)["tasks"]
    ] == ["t5", "t1", "t2", "t3", "t4"]
    first = apply(
        plan,
        {"kind": "insert", "at": 0, "title": "Diagnostics", "task_prompt": "Check the sensors."},
        USV,
    )
    second = apply(
        first,
        {"kind": "insert", "at": 6, "title": "Transit", "parameters": {"target_position": [4, 5]}},
        USV,
    )
    assert [entry["id"] for entry in second["tasks"]] == ["t6", "t1", "t2", "t3", "t4", "t5", "t7"]
    assert second["tasks"][-1]["sources"]["target_position"]["kind"] == "operator"
    SCHEMA.validate(second)


def test_a_skill_can_be_set(plan: PlanDocument) -> None:
    change = {
        "kind": "skill",
        "task": "t5",
        "step": 0,
        "role": "navigation",
        "index": 0,
        "name": "yaw",
        "value": 90,
    }
    assert by_id(apply(plan, change, USV), "t5")["skill_sequence"][0]["navigation_skill"][
        "parameters"
    ] == {"x": 0, "y": 0, "yaw": 90}
    with pytest.raises(PlannerError, match="needs x"):
        apply(plan, {**change, "name": "x", "value": None}, USV)


@pytest.mark.parametrize(
    ("edit", "sentence"),
    [
        ({"kind": "fly"}, "edit 'fly': is not known"),
        ({"kind": []}, "edit []: is not known"),
        ({"kind": "remove", "task": "t1", "note": "x"}, "edit remove: has no note"),
        ({"kind": "remove", "task": "x" * 9000}, "x ...: is not in the plan"),
        ({"kind": "replace", "tasks": [{"title": "Fly"}]}, "edit replace: "),
        ({"kind": "replace", "tasks": [7]}, "edit replace: 7 is not"),
        (
            {"kind": "skills", "task": "t1", "skill_sequence": [], "assumptions": [3]},
            "assumptions must be a list of texts",
        ),
        ({"kind": "remove", "task": "t9"}, "task t9: is not in the plan; there is t1, t2"),
        ({"kind": "remove"}, "edit remove: task must be the id of a task"),
        ({"kind": "move", "task": "t1", "to": 9}, "place 10: the plan has places 1 to 5"),
        ({"kind": "move", "task": "t1", "to": True}, "to must be a whole number"),
        (
            {"kind": "parameter", "task": "t4", "name": "speed", "value": 1},
            "speed: is no parameter of KeepStation; there is duration",
        ),
        (
            {"kind": "parameter", "task": "t4", "name": "duration", "value": "long"},
            "duration: 'long' is no number",
        ),
        (
            {"kind": "parameter", "task": "t5", "name": "target_position", "value": None},
            "t5: Transit needs target_position",
        ),
        (
            {"kind": "locate", "name": "lighthouse", "position": [1, 2]},
            "lighthouse: no such place is open; there is green buoy",
        ),
        ({"kind": "locate", "name": "green buoy", "position": [1]}, "is no position"),
        (
            {"kind": "locate", "name": "green buoy", "position": [-99, -99]},
            "stands for an unknown place",
        ),
        ({"kind": "insert", "at": 0, "title": "Fly"}, "Fly: is no task of this vehicle"),
        ({"kind": "insert", "at": 0, "title": "Transit"}, "Transit needs target_position"),
        (
            {
                "kind": "skills",
                "task": "t1",
                "skill_sequence": [{"navigation_skill": {"name": "Fly"}}],
            },
            "skills of t1",
        ),
        ({"kind": "prompt", "task": "t1", "text": "x" * 5000}, "at most 4000 characters"),
        ({"kind": "prompt", "task": "t1", "text": "a\x00b"}, "control character '\\x00'"),
        (
            {"kind": "parameter", "task": "t1", "name": "target_description", "value": "\x1b[2J"},
            "control character '\\x1b'",
        ),
    ],
)
def test_what_cannot_be_is_one_sentence_and_changes_nothing(
    plan: PlanDocument, edit: dict[str, Any], sentence: str
) -> None:
    before = copy.deepcopy(plan)
    with pytest.raises(PlannerError) as caught:
        apply(plan, edit, USV)
    assert sentence in str(caught.value) and "\n" not in str(caught.value)
    assert plan == before


def test_what_was_altered_outside_is_adopted_or_not_edited(plan: PlanDocument) -> None:
    by_hand = copy.deepcopy(plan)
    by_id(by_hand, "t4")["parameters"]["duration"] = 600
    assert altered(by_hand)
    with pytest.raises(PlannerError, match="altered outside"):
        apply(by_hand, {"kind": "remove", "task": "t1"}, USV)
    adopted = adopt(by_hand, USV, "Ada")
    assert not altered(adopted) and [change.text for change in differences(adopted)] == [
        "task 4, KeepStation: duration 60 -> 600, changed by Ada"
    ]
    assert adopted["edits"][-1]["by"] == "Ada" and undo(adopted, USV) == plan
    by_id(by_hand, "t4")["parameters"]["duration"] = "long"
    with pytest.raises(PlannerError, match="'long' is no number"):
        adopt(by_hand, USV)


EDITS = st.one_of(
    st.fixed_dictionaries(
        {
            "kind": st.just("move"),
            "task": st.sampled_from(["t1", "t2", "t3", "t4", "t5", "t6"]),
            "to": st.integers(0, 6),
        }
    ),
    st.fixed_dictionaries(
        {"kind": st.just("remove"), "task": st.sampled_from(["t1", "t2", "t3", "t6"])}
    ),
    st.fixed_dictionaries(
        {
            "kind": st.just("parameter"),
            "task": st.just("t4"),
            "name": st.just("duration"),
            "value": st.integers(1, 500),
        }
    ),
    st.fixed_dictionaries(
        {
            "kind": st.just("locate"),
            "name": st.just("green buoy"),
            "position": st.lists(st.integers(-90, 90), min_size=2, max_size=2),
        }
    ),
    st.fixed_dictionaries(
        {"kind": st.just("insert"), "at": st.integers(0, 3), "title": st.just("Diagnostics")}
    ),
)


@settings(max_examples=40)
@given(st.lists(EDITS, max_size=6))
def test_undo_gives_every_state_back(plan: PlanDocument, edits: list[dict[str, Any]]) -> None:
    states = [plan]
    for edit in edits:
        try:
            states.append(apply(states[-1], edit, USV))
        except PlannerError:
            continue
    now = states[-1]
    assert not altered(now)
    for state in reversed(states[:-1]):
        now = undo(now, USV)
        assert now == state
    with pytest.raises(PlannerError, match="no edit to take back"):
        undo(now, USV)


def test_a_skill_is_dropped_from_one_step_or_from_all(plan: PlanDocument) -> None:
    look = {"name": "DetectObjects", "parameters": {}}
    going = step("GoToXY", {"x": 0, "y": 0})
    steps = [{**going, "perception_skills": [look]}, going, {**going, "perception_skills": [look]}]
    known = apply(plan, {"kind": "skills", "task": "t5", "skill_sequence": steps}, USV)

    def left(**edit: Any) -> list[int]:
        after = apply(known, {"kind": "drop", "task": "t5", "name": "DetectObjects", **edit}, USV)
        return [len(one["perception_skills"]) for one in by_id(after, "t5")["skill_sequence"]]

    assert left() == [0, 0, 0] and left(step=0) == [0, 0, 1] and left(step=2) == [1, 0, 0]
    for number, sentence in ((1, "t5 step 2: has no filter or perc"), (3, "one of the task's 3")):
        with pytest.raises(PlannerError, match=sentence):
            left(step=number)
