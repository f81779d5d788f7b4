"""An operator's edits: what each does, what none may do, what is recorded, and taking them back."""

from __future__ import annotations

import copy
from typing import Any

import jsonschema
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner_ft.document import PlanDocument, adopt, altered, apply, differences, operations, undo
from planner_ft.document.entered import reword
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.schema import document_schema
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


def test_a_pass_along_an_open_place_waits_for_it_and_has_it_in_its_prompt() -> None:
    face = {"side_id": "east", "length": 40, "distance": 8}
    waiting = document(
        [
            task("SearchAndDetect", {"target_description": "mole"}, [step("StationKeep")], "Find."),
            task("ParallelStructurePass", face, None, "Run along the east side of the Mole."),
        ],
        command="Find the mole and run along its east side for 40 m, 8 m off.",
    )
    assert by_id(waiting, "t2")["waits_for"] == "mole" and not waiting["complete"]
    placed = apply(waiting, {"kind": "locate", "name": "mole", "position": [60, 40.5]}, USV)
    run = by_id(placed, "t2")
    assert run["task_prompt"] == "Run along the east side of the Mole at [60, 40.5]."
    assert "waits_for" not in run and placed["located"] == {"mole": [60, 40.5]}
    SCHEMA.validate(placed)
    moved = apply(placed, {"kind": "locate", "name": "mole", "position": [5, 6]}, USV)
    assert by_id(moved, "t2")["task_prompt"] == "Run along the east side of the Mole at [5, 6]."
    reworded = {"kind": "prompt", "task": "t2", "text": "Run along the mole."}
    again = apply(moved, reworded, USV)
    assert again["located"] == {} and by_id(again, "t2")["waits_for"] == "mole"
    there = {**reworded, "text": "Run along the mole at [7, 7]."}
    assert "waits_for" not in by_id(apply(waiting, there, USV), "t2")


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
            {"kind": "parameter", "task": "t5", "name": "target_position", "value": [0, -1e308]},
            "target_position: must be at most 1,000,000 m either way",
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


def test_a_plan_has_at_most_a_thousand_tasks() -> None:
    tasks = [task("KeepStation", {}, None) for _number in range(2)]
    edit = {"kind": "insert", "at": 0, "title": "Diagnostics"}
    with pytest.MonkeyPatch.context() as patch:
        assert operations.MOST_TASKS == 1000
        patch.setattr(operations, "MOST_TASKS", 3)
        full = apply(document(tasks), edit, USV)
        with pytest.raises(PlannerError, match="the plan has 3 tasks, and no more fit"):
            apply(full, edit, USV)


def test_a_new_task_has_an_id_that_none_had_before(plan: PlanDocument) -> None:
    edit = {"kind": "insert", "at": 5, "title": "Diagnostics"}
    first = apply(plan, edit, USV)
    assert first["tasks"][-1]["id"] == "t6"
    gone = apply(first, {"kind": "remove", "task": "t6"}, USV)
    assert apply(gone, edit, USV)["tasks"][-1]["id"] == "t7"
    fewer = apply(plan, {"kind": "remove", "task": "t5"}, USV)
    assert apply(fewer, {**edit, "at": 0}, USV)["tasks"][0]["id"] == "t6"
    assert apply(document([]), {**edit, "at": 0}, USV)["tasks"][0]["id"] == "t1"


@pytest.mark.parametrize(
    ("edit", "sentence"),
    [
        ({"kind": "move", "task": "t1", "to": 5}, "place 6: the plan has places 1 to 5"),
        ({"kind": "move", "task": "t1", "to": -1}, "place 0: the plan has places 1 to 5"),
        (
            {"kind": "insert", "at": 6, "title": "Diagnostics"},
            "place 7: the plan has places 1 to 6",
        ),
        (
            {"kind": "insert", "at": 0, "title": "Diagnostics", "parameters": []},
            "must be an object",
        ),
        (
            {"kind": "insert", "at": 0, "title": "Diagnostics", "parameters": {"x": 1}},
            "x: is no param",
        ),
        ({"kind": "constraint", "at": 1}, "constraint 2: the plan has 0"),
        ({"kind": "constraint", "at": 0}, "constraint 1: the plan has 0"),
        ({"kind": "constraint", "at": -1, "text": "x"}, "constraint 0: the plan has 0"),
        ({"kind": "constraint", "at": 0, "text": " "}, "constraint 1: the text is empty"),
        (
            {"kind": "constraint", "at": 0, "text": "The vehicle stays within 1e999 m of home."},
            "constraint 1: 1e999 is beyond all range",
        ),
        (
            {
                "kind": "skill",
                "task": "t4",
                "step": 1,
                "role": "navigation",
                "index": 0,
                "name": "time",
            },
            "t4 step 2: the task has 1 steps",
        ),
        (
            {
                "kind": "skill",
                "task": "t4",
                "step": -1,
                "role": "navigation",
                "index": 0,
                "name": "time",
            },
            "t4 step 0: the task has 1 steps",
        ),
        (
            {
                "kind": "skill",
                "task": "t3",
                "step": 0,
                "role": "navigation",
                "index": 0,
                "name": "time",
            },
            "t3 step 1: the task has 0 steps",
        ),
        (
            {
                "kind": "skill",
                "task": "t4",
                "step": 0,
                "role": "navigation",
                "index": 1,
                "name": "time",
            },
            "t4 step 1: has 1 navigation skills, and none of number 2",
        ),
        (
            {
                "kind": "skill",
                "task": "t4",
                "step": 0,
                "role": "filter",
                "index": 0,
                "name": "time",
            },
            "t4 step 1: has 0 filter skills, and none of number 1",
        ),
        (
            {
                "kind": "skill",
                "task": "t4",
                "step": 0,
                "role": "navigation",
                "index": -1,
                "name": "time",
            },
            "none of number 0",
        ),
        (
            {"kind": "drop", "task": "t4", "name": "DetectObjects"},
            "t4: has no filter or perception",
        ),
        (
            {"kind": "drop", "task": "t4", "name": "DetectObjects", "step": 1},
            "one of the task's 1, from 0",
        ),
        (
            {"kind": "drop", "task": "t4", "name": "DetectObjects", "step": -1},
            "one of the task's 1, from 0",
        ),
        (
            {"kind": "drop", "task": "t3", "name": "DetectObjects", "step": 0},
            "one of the task's 0, from 0",
        ),
        (
            {"kind": "drop", "task": "t4", "name": "DetectObjects", "step": 0},
            "t4 step 1: has no filter",
        ),
        ({"kind": "replace", "tasks": [{"id": "t1"}]}, "edit replace: {'id': 't1'} is not valid"),
        ({"kind": "prompt", "task": "t1", "text": "x" * 4001}, "at most 4000 characters"),
        ({"kind": "remove", "task": "x" * 120}, f"task {'x' * 120}: is not"),
        ({"kind": "remove", "task": "x" * 121}, f"task {'x' * 120} ...: is not"),
    ],
)
def test_the_first_and_last_that_an_edit_can_name(
    plan: PlanDocument, edit: dict[str, Any], sentence: str
) -> None:
    with pytest.raises(PlannerError) as caught:
        apply(plan, edit, USV)
    assert sentence in str(caught.value)


def test_a_prompt_may_have_4000_characters_and_lines(plan: PlanDocument) -> None:
    text = "x" * 3997 + "\n\ty"
    edited = apply(plan, {"kind": "prompt", "task": "t1", "text": text}, USV)
    assert by_id(edited, "t1")["task_prompt"] == text and by_id(edited, "t1")["stale"]
    waiting = apply(plan, {"kind": "prompt", "task": "t3", "text": "Go."}, USV)
    assert "stale" not in by_id(waiting, "t3"), "it has no skills yet"


@pytest.mark.parametrize(
    ("prompt", "before", "after", "then"),
    [
        ("Circle at 12 m, not at 120 m.", 12, 15, "Circle at 15 m, not at 120 m."),
        ("Hold 12.5 s.", 12, 15, "Hold 12.5 s."),
        ("Hold 12. Go.", 12, 15, "Hold 15. Go."),
        ("Hold 12 s at 12 m.", 12, 15, "Hold 12 s at 12 m."),
        ("Hold -12 s.", 12, 15, "Hold -12 s."),
        ("Go to (1, -2).", [1, -2], [3, 4], "Go to [3, 4]."),
        ("Go to [ 1,-2 ].", [1, -2], [3, 4], "Go to [3, 4]."),
        ("Go to [1, -2, 3].", [1, -2, 3], [3, 4], "Go to [1, -2, 3]."),
        ("Find the buoy, not the buoys.", "buoy", "mast", "Find the mast, not the buoys."),
        ("Take it.", True, False, "Take it."),
        ("Look at a, b.", ["a", "b"], ["c"], "Look at a, b."),
    ],
)
def test_the_one_mention_of_a_value_is_replaced(
    prompt: str, before: Any, after: Any, then: str
) -> None:
    assert reword(prompt, before, after) == then


def test_an_answer_of_the_agent_replaces_all_that_was_of_the_one_before(plan: PlanDocument) -> None:
    steps = [step("StationKeep", {"time": 60})]
    edit = {"kind": "skills", "task": "t4", "skill_sequence": steps}
    told = apply(plan, {**edit, "assumptions": ["Calm."], "defaults": {"duration": 9}}, USV)
    assert by_id(told, "t4")["assumptions"] == ["Calm."]
    assert by_id(told, "t4")["parameters"] == {"duration": 60}
    assert "assumptions" not in by_id(apply(told, edit, USV), "t4")
    free = apply(plan, {"kind": "parameter", "task": "t4", "name": "duration", "value": None}, USV)
    given = by_id(apply(free, {**edit, "defaults": {"duration": 9}}, USV), "t4")
    assert (given["parameters"], given["defaults"]) == ({"duration": 9}, {"duration": 9})
    for wrong in ("Calm.", [1], {"a": 1}):
        with pytest.raises(PlannerError, match="assumptions must be a list of texts"):
            apply(plan, {**edit, "assumptions": wrong}, USV)


def test_a_task_that_is_edited_by_hand_is_no_longer_at_its_located_place(
    plan: PlanDocument,
) -> None:
    placed = apply(plan, {"kind": "locate", "name": "green buoy", "position": [5, 5]}, USV)
    moved = {"kind": "parameter", "task": "t3", "name": "center", "value": [6, 6]}
    free = apply(placed, moved, USV)
    assert "located" not in by_id(free, "t3") and free["located"] == {"green buoy": [5, 5]}
    kept = apply(placed, {**moved, "name": "radius", "value": 9}, USV)
    assert by_id(kept, "t3")["located"] == {"center": "green buoy"}
    assert "stale" not in by_id(placed, "t2") and "stale" not in by_id(placed, "t3")
    other = apply(placed, {"kind": "title", "task": "t3", "title": "SurveyTarget"}, USV)
    assert by_id(other, "t3")["located"] == {"target_position": "green buoy"}


def test_a_value_that_is_set_in_a_step_is_the_operators(plan: PlanDocument) -> None:
    marked = {"kind": "skills", "task": "t4", "skill_sequence": [step("StationKeep", {"time": 60})]}
    mark = {
        "step": 0,
        "role": "navigation",
        "name": "StationKeep",
        "kind": "vehicle",
        "parameter": "time",
    }
    known = apply(plan, {**marked, "added": [mark]}, USV)
    assert by_id(known, "t4")["added"] == [mark]
    where = {"task": "t4", "step": 0, "role": "navigation", "index": 0, "name": "radius"}
    assert "added" not in by_id(apply(known, {"kind": "skill", **where, "value": 4}, USV), "t4")
