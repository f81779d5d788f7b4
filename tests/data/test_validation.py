"""`validate` tells datasets, predictions and plans apart and reports every problem with its
line.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from planner_ft.data.validation import validate_file
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import write_jsonl
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import STEP_KEYS
from planner_ft.vocabulary.schema import FORMAT

ROOT = Path(__file__).parents[2]
USV = load_vocabulary()
SPAN = {"element": "target", "start": 10, "end": 17, "text": "[4, 5]."}


def record(**more: Any) -> dict[str, Any]:
    task = {
        "title": "Transit",
        "parameters": {"target_position": [4, 5]},
        "task_prompt": "Go to [4, 5].",
    }
    expected = {"tasks": [task], "assumptions": [], "constraints": []}
    return {
        "id": "a",
        "family": "f",
        "prompt": "Proceed to [4, 5].",
        "expected": expected,
        "spans": [],
        "tags": [],
        **more,
    }


def problems(
    tmp_path: Path, *lines: Any, complete: bool = False, name: str = "data.jsonl"
) -> list[str]:
    path = tmp_path / name
    write_jsonl(path, lines)
    return [
        str(problem).removeprefix(f"{tmp_path}/")
        for problem in validate_file(path, USV, complete=complete).problems
    ]


def test_the_curated_set_is_clean() -> None:
    for split, count in (("train", 125), ("validation", 25), ("test", 25)):
        report = validate_file(
            ROOT / "data" / "mission" / f"{split}.jsonl", USV, "mission", complete=True
        )
        assert report.problems == ()
        assert report.counts == {"mission record": count}


def test_a_key_that_stands_twice_and_a_line_without_end_are_problems(tmp_path: Path) -> None:
    path = tmp_path / "data.jsonl"
    long = json.dumps(record(id="b", prompt="Proceed to [4, 5]. " * 60_000))
    path.write_text('{"id":"x","id":"y","prompt":"Go.","expected":{"tasks":[]}}\n' + long + "\n")
    first, second = (problem.text for problem in validate_file(path, USV).problems)
    assert "'id' stands twice" in first
    assert second.endswith("at most 500,000 are expected in one record")


def test_every_problem_is_reported_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "data.jsonl"
    lines = [
        json.dumps(record()),
        '{"id":',
        "[]",
        json.dumps(record(prompt=" ", tags=["rule.none"])),
        json.dumps({"id": "z"}),
    ]
    path.write_text("\n".join(lines) + "\n\n")
    found = [str(problem) for problem in validate_file(path, USV).problems]
    for line, text in (
        (2, "not JSON"),
        (3, "a JSON object is expected"),
        (4, "prompt is no text"),
        (4, "'rule.none' is not known"),
        (4, "coordinates [4, 5] are not in the command"),
        (4, "id 'a' stands in line 1 already"),
        (5, "none of a dataset record"),
    ):
        assert any(
            problem.startswith(f"{path}:{line}: ") and text in problem for problem in found
        ), (line, text, found)
    assert not any(problem.startswith(f"{path}:1:") for problem in found)


@pytest.mark.parametrize(
    ("span", "problem"),
    [
        ({**SPAN, "start": 9}, "but the prompt has"),
        ({**SPAN, "end": 99}, "outside the prompt"),
        ({**SPAN, "element": "verb"}, "element 'verb' is none of"),
        ({"text": "x"}, "an object with element, start, end and text"),
    ],
)
def test_spans_are_checked_against_the_prompt(
    tmp_path: Path, span: dict[str, Any], problem: str
) -> None:
    good = {**SPAN, "start": 11, "end": 18}
    assert problems(tmp_path, record(spans=[good])) == []
    assert any(problem in text for text in problems(tmp_path, record(spans=[span])))


def test_outsiders_may_leave_out_texts_and_labels(tmp_path: Path) -> None:
    mission = {
        "id": "a",
        "prompt": "Go to [4, 5].",
        "expected": {"tasks": [{"title": "Transit", "parameters": {"target_position": [4, 5]}}]},
    }
    step = {
        "navigation_skill": {"name": "StationKeep"},
        "perception_skills": [{"name": "GetGPSLocation"}],
    }
    task = {
        "id": "b",
        "prompt": "Hold.",
        "task": "KeepStation",
        "parameters": {},
        "expected": {"skill_sequence": [step]},
    }
    assert problems(tmp_path, mission) == []
    assert problems(tmp_path, task) == []
    asked = problems(tmp_path, mission, complete=True)
    for part in (
        "family is missing",
        "spans is missing",
        "tags is missing",
        "task_prompt is missing",
        "assumptions is missing",
    ):
        assert any(part in text for text in asked)


def test_texts_may_not_invent_numbers(tmp_path: Path) -> None:
    invented = record()
    invented["expected"]["tasks"][0]["task_prompt"] = "Go to [4, 5] at 3 m/s."
    assert any(
        "3 is neither in the command nor in a parameter" in text
        for text in problems(tmp_path, invented, complete=True)
    )
    assert problems(tmp_path, record(), complete=True) == []


@pytest.mark.parametrize(
    "prompt",
    [
        "Proceed to [4, 5] at 3 m/s.",
        "Proceed to [4, 5], not to [6, 7].",
        "Proceed to [4, 5] and wait there for two minutes.",
    ],
)
def test_what_the_command_states_may_not_be_lost(tmp_path: Path, prompt: str) -> None:
    assert any(
        "of the command stand" in text
        for text in problems(tmp_path, record(prompt=prompt), complete=True)
    )
    assert problems(tmp_path, record(prompt=prompt)) == []


def test_a_limit_that_is_a_constraint_is_not_lost(tmp_path: Path) -> None:
    limited = record(prompt="Proceed to [4, 5] and keep two hundred metres clear of [9, 9].")
    limited["expected"]["constraints"] = ["Keep 200 metres clear of [9, 9]."]
    assert problems(tmp_path, limited, complete=True) == []


def test_the_same_task_twice_in_a_row_is_a_mistake(tmp_path: Path) -> None:
    twice = record()
    twice["expected"]["tasks"] *= 2
    assert any("the same task again" in text for text in problems(tmp_path, twice, complete=True))


def test_a_record_of_the_curated_form_is_canonical(tmp_path: Path) -> None:
    odd = record()
    odd["expected"]["tasks"][0]["parameters"]["target_position"] = [4.0, 5]
    assert any("canonical form" in text for text in problems(tmp_path, odd, complete=True))
    assert problems(tmp_path, odd) == []


def test_predictions_are_checked_as_the_model_wrote_them(tmp_path: Path) -> None:
    right = json.dumps({"tasks": [], "assumptions": [], "constraints": []})
    lines = [
        {"id": "a", "output": right},
        {"id": "a", "output": right, "configuration": "base"},
        {"id": "b", "output": "Sure! Here is the plan"},
        {
            "id": "c",
            "output": (
                '{"tasks": [{"title": "Berthing", "parameters": {}, "task_prompt": ""}],'
                ' "assumptions": [], "constraints": []}'
            ),
        },
        {"id": "d", "output": "{}"},
    ]
    found = problems(tmp_path, *lines, name="predictions.jsonl")
    assert [text.split(":")[1] for text in found] == ["3", "4", "5"]
    assert (
        "not JSON" in found[0]
        and "'Berthing' is no task title" in found[1]
        and "neither tasks nor skill_sequence" in found[2]
    )


def test_a_plan_in_a_json_file_is_checked(tmp_path: Path) -> None:
    path = tmp_path / "plan.json"
    path.write_text(
        json.dumps(
            {
                "tasks": [{"title": "Transit", "parameters": {}, "task_prompt": ""}],
                "assumptions": [],
                "constraints": [],
            },
            indent=2,
        )
    )
    report = validate_file(path, USV)
    assert report.counts == {"mission plan": 1}
    assert [problem.text for problem in report.problems] == [
        "tasks[0]: Transit needs target_position"
    ]


def test_the_level_can_be_asked_for(tmp_path: Path) -> None:
    path = tmp_path / "data.jsonl"
    write_jsonl(path, [record()])
    assert any(
        "a task plan is expected" in problem.text
        for problem in validate_file(path, USV, "task").problems
    )


def test_task_values_come_from_the_prompt_or_the_parameters(tmp_path: Path) -> None:
    def task(time: float, **more: Any) -> dict[str, Any]:
        step = {"navigation_skill": {"name": "StationKeep", "parameters": {"time": time}}}
        return {
            "id": "a",
            "prompt": "Hold for two minutes.",
            "task": "KeepStation",
            "parameters": {"duration": 45},
            "expected": {"skill_sequence": [step]},
            **more,
        }

    assert problems(tmp_path, task(120)) == problems(tmp_path, task(45)) == []
    assert any("60 s does not follow from" in text for text in problems(tmp_path, task(60)))
    assert any(
        "parameters.duration" in text
        for text in problems(tmp_path, task(120, parameters={"duration": "long"}))
    )
    assert any(
        "'Loiter' is no task title" in text for text in problems(tmp_path, task(120, task="Loiter"))
    )


@pytest.mark.parametrize(
    ("content", "message"),
    [(None, "no such file"), (b"", "is empty"), (b" \n", "is empty"), (b"\xff\xfe{", "not UTF-8")],
)
def test_a_file_that_cannot_be_read_is_one_sentence(
    tmp_path: Path, content: bytes | None, message: str
) -> None:
    path = tmp_path / "data.jsonl"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(PlannerError, match=message):
        validate_file(path, USV)


@pytest.mark.parametrize(
    "line", ['{"id": NaN}', "[" * 100_000, '{"id": "\\ud800"}', '{"n": ' + "9" * 5000 + "}"]
)
def test_hostile_lines_are_problems_and_no_tracebacks(tmp_path: Path, line: str) -> None:
    path = tmp_path / "data.jsonl"
    path.write_text(f"{line}\n{line}\n")
    assert len(validate_file(path, USV).problems) == 2


def goes(*places: tuple[float, float]) -> dict[str, Any]:
    """A mission plan that goes from place to place."""
    tasks = [
        {"title": "Transit", "parameters": {"target_position": [*place]}, "task_prompt": ""}
        for place in places
    ]
    return {"tasks": tasks, "assumptions": [], "constraints": []}


def held(**more: Any) -> dict[str, Any]:
    """A task record without values."""
    sequence = {"skill_sequence": [{"navigation_skill": {"name": "StationKeep"}}]}
    given = {"task": "KeepStation", "parameters": {}}
    return {"id": "a", "prompt": "Hold.", **given, "expected": sequence, **more}


def spanned(*spans: Any) -> dict[str, Any]:
    return record(spans=[{**SPAN, "start": 11, "end": 18}, *spans])


AFTER_HOME = "tasks[1] Transit: comes after the return home, which is the last Transit"
NO_OBJECT, NO_LIST = "an object is expected, not a number", "a list is expected, not a number"
BEYOND = "spans[1]: {} lies outside the prompt"
EMPTY = "the tag rule.empty and an empty task list go together"
STEP: dict[str, Any] = {key: [] for key in STEP_KEYS[1:]}


@pytest.mark.parametrize(
    ("value", "found"),
    [
        # The rules of missions hold for plans and predictions too, with the command where it is.
        (goes((4, 5), (0, 0)), []),
        (goes((0, 0), (4, 5)), [AFTER_HOME]),
        (goes((0, 0), (4, 5)) | {"prompt": "To [0, 0] and [4, 5]."}, ["unknown key 'prompt'"]),
        (goes((0, 0), (4, 5)) | {"prompt": 7}, ["unknown key 'prompt'", AFTER_HOME]),
        ({"id": "a", "output": goes((0, 0), (4, 5))}, [f"output: {AFTER_HOME}"]),
        ({"skill_sequence": [STEP | {"navigation_skill": 3}]},
         [f"skill_sequence[0].navigation_skill: {NO_OBJECT}"]),
        (goes((4, 5)) | {"format": FORMAT},
         ["a plan document, which `plannerft review FILE --show` checks"]),
        ({"output": goes()}, ["id is missing"]),
        ({"id": " ", "output": "Sure!"},
         ["id is no text", "output: not JSON (Expecting value at column 1)"]),
        ({"id": " ", "output": "{}"},
         ["id is no text", "output: holds neither tasks nor skill_sequence"]),
        # What a record is made of.
        (record(prompt=7), ["prompt is no text"]),
        (record(family=7), ["family is no text"]),
        (record(spans={}), ["spans is no list"]),
        (record(tags={}), ["tags is no list"]),
        (record(tags=["rule.none", 7]), ["tags holds something else than texts"]),
        (record(tags=["rule.none"]), ["tag 'rule.none' is not known"]),
        (record(expected=[]), ["expected: holds neither tasks nor skill_sequence"]),
        (record(expected={"tasks": [3]}), [f"expected: tasks[0]: {NO_OBJECT}", EMPTY]),
        (record(expected={"tasks": []}, tags=["rule.empty"]), []),
        (spanned({**SPAN, "start": 0, "text": "Proceed to [4, 5]"} | {"end": 17}), []),
        (spanned({**SPAN, "start": 17}), [BEYOND.format("17 to 17")]),
        (spanned({**SPAN, "start": -1}), [BEYOND.format("-1 to 17")]),
        (spanned({**SPAN, "end": 19}), [BEYOND.format("10 to 19")]),
        (spanned({**SPAN, "start": True}), [BEYOND.format("True to 17")]),
        (spanned({**SPAN, "end": "b"}), [BEYOND.format("10 to 'b'")]),
        (spanned([]), ["spans[1]: an object with element, start, end and text is expected"]),
        # The input and the steps of a task record; outsiders leave out what is empty.
        (held(), []),
        (held(parameters={"duration": "long"}), ["parameters.duration: 'long' is no number"]),
        (held(task="Loiter"), ["task: 'Loiter' is no task title of the vocabulary"]),
        ({key: value for key, value in held().items() if key != "task"}, ["task is missing"]),
        (held(expected={"skill_sequence": 3}), [f"expected: skill_sequence: {NO_LIST}"]),
        (held(expected={"skill_sequence": [3]}), [f"expected: skill_sequence[0]: {NO_OBJECT}"]),
        (held(expected={"skill_sequence": [{"filter_skills": [3], "failure_modes": 3}]}), [
            "expected: skill_sequence[0]: navigation_skill is missing",
            f"expected: skill_sequence[0].failure_modes: {NO_LIST}",
            f"expected: skill_sequence[0].filter_skills[0]: {NO_OBJECT}",
        ]),
    ],
)  # fmt: skip
def test_the_problems_of_an_object_and_no_others(
    tmp_path: Path, value: Any, found: list[str]
) -> None:
    assert problems(tmp_path, value) == [f"data.jsonl:1: {problem}" for problem in found]


def test_a_level_that_is_asked_for_is_told_first_and_read_where_nothing_tells_it(
    tmp_path: Path,
) -> None:
    path = tmp_path / "data.jsonl"
    write_jsonl(path, [record(), held(id="b"), record(id="c", expected=[]), {"x": 1}])
    report = validate_file(path, USV, "task")
    texts = [(problem.line, problem.text) for problem in report.problems]
    assert texts[0] == (1, "a task plan is expected, this is a mission plan")
    assert not [text for line, text in texts if line == 2]
    assert (3, "task is missing") in texts
    assert report.counts == {"mission record": 1, "task record": 2, "task unknown object": 1}


def test_the_level_is_told_before_what_else_is_wrong(tmp_path: Path) -> None:
    path = tmp_path / "data.jsonl"
    write_jsonl(path, [{"output": goes()}])
    first, second, *_rest = (problem.text for problem in validate_file(path, USV, "task").problems)
    assert (first, second) == ("a task plan is expected, this is a mission plan", "id is missing")


def test_the_same_id_is_told_of_records_and_of_one_system_s_predictions(tmp_path: Path) -> None:
    said = {"id": "a", "output": goes()}
    lines = [record(), record(), said | {"candidate": "x"}, said | {"configuration": "x"}]
    lines += [said | {"candidate": "x"}, goes(), goes()]
    assert problems(tmp_path, *lines) == [
        "data.jsonl:2: id 'a' stands in line 1 already",
        "data.jsonl:5: id 'a' stands in line 3 already",
    ]


@pytest.mark.parametrize("suffix", ["json", "jsonl"])
@pytest.mark.parametrize("before", ["", "\n\n"])
def test_a_file_of_one_object_names_the_line_where_it_cannot_be_read(
    tmp_path: Path, suffix: str, before: str
) -> None:
    path, text = tmp_path / f"plan.{suffix}", json.dumps(goes((4, 5)), indent=2)
    path.write_text(before + text)
    assert validate_file(path, USV).problems == ()
    path.write_text(before + text.replace('"task_prompt": ""', '"task_prompt":'))
    (problem,) = validate_file(path, USV).problems
    line = text[: text.index('"task_prompt"')].count("\n") + 2 + len(before)
    assert problem.line == line and problem.text.startswith("not JSON")


def test_a_record_may_have_half_a_million_characters(tmp_path: Path) -> None:
    path = tmp_path / "data.jsonl"
    for more, count in ((0, 0), (1, 1)):
        line = json.dumps(held(note=""))
        path.write_text(line.replace('""', f'"{"x" * (500_000 - len(line) + more)}"'))
        assert len(validate_file(path, USV).problems) == count


def test_canonical_form_is_asked_of_right_records_alone_and_can_be_left(tmp_path: Path) -> None:
    path = tmp_path / "data.jsonl"
    turned = dict(reversed(record().items()))
    write_jsonl(path, [record(), turned | {"id": "b"}, turned | {"id": "c", "tags": 3}])
    (form, tags) = validate_file(path, USV, complete=True).problems
    assert form.line == 2 and form.text.startswith("not in canonical form")
    assert tags.text == "tags is no list"
    assert validate_file(path, USV, complete=True, canonical=False).problems == (tags,)
