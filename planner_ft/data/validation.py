"""Checking datasets, predictions and plans against form, vocabulary and labelling rules.

A file is JSON Lines (or one JSON object) whose objects are told apart by what they hold: `expected`
makes a dataset record, `output` a prediction, `tasks` or `skill_sequence` a plan. Every problem is
reported, not the first alone.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from planner_ft.data.completeness import completeness_problems
from planner_ft.data.rules import rule_problems
from planner_ft.data.steprules import step_problems
from planner_ft.data.tags import tag_problems
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, decode_json, iterate_jsonl, read_text
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import (
    LEVELS,
    Level,
    canonical_parameters,
    canonical_plan,
    list_key,
    plan_problems,
)
from planner_ft.vocabulary.schema import ELEMENTS

Kind = Literal["record", "prediction", "plan"]
RECORD_KEYS = ("id", "family", "task", "parameters", "prompt", "expected", "spans", "tags")
"""The order in which a record's keys are written; others follow."""


@dataclass(frozen=True)
class Problem:
    """What is wrong at a line of a file."""

    path: Path
    line: int
    text: str

    def __str__(self) -> str:
        return f"{self.path}:{self.line}: {self.text}"


@dataclass(frozen=True)
class Report:
    """What a file holds, by kind ("mission record", "task prediction", ...), and everything wrong
    with it.
    """

    path: Path
    counts: dict[str, int]
    problems: tuple[Problem, ...]


def validate_file(
    path: Path, vocabulary: Vocabulary, level: Level | None = None, *, complete: bool = False
) -> Report:
    """Check every object of a file. `complete` asks of dataset records what the curated set has:
    family, spans, tags, all texts, canonical form.

    Raises PlannerError when the file is missing, unreadable, not UTF-8 or empty.
    """
    counts: Counter[str] = Counter()
    problems = []
    lines: dict[str, int] = {}
    for line, value, problem in file_values(path):
        if problem is None and isinstance(value, dict):
            kind, found_level, texts = object_problems(value, vocabulary, level, complete=complete)
            counts[" ".join(filter(None, (found_level, kind or "unknown object")))] += 1
            if (
                complete
                and kind == "record"
                and found_level
                and not texts
                and canonical_record(found_level, value, vocabulary) != compact_json(value)
            ):
                texts.append(
                    "not in canonical form: order of keys or parameters, or a whole number written"
                    " with a point"
                )
            key = identity(value)
            if kind != "plan" and key in lines:
                texts.append(f"id {value.get('id')!r} stands in line {lines[key]} already")
            lines.setdefault(key, line)
        else:
            texts = [problem or f"a JSON object is expected, not {type(value).__name__}"]
        problems += [Problem(path, line, text) for text in texts]
    return Report(path, dict(counts), tuple(problems))


def canonical_record(level: Level, record: dict[str, Any], vocabulary: Vocabulary) -> str:
    """The line of a valid record in the form in which gen-data writes it: keys in a fixed order,
    canonical plan.
    """
    values = {**record, "expected": canonical_plan(level, record["expected"], vocabulary)}
    if level == "task":
        values["parameters"] = canonical_parameters(
            record["parameters"], vocabulary.task[record["task"]]
        )
    ordered = [key for key in RECORD_KEYS if key in values] + [
        key for key in values if key not in RECORD_KEYS
    ]
    return compact_json({key: values[key] for key in ordered})


def identity(value: dict[str, Any]) -> str:
    """What must be unique in a file: the id, for predictions of several systems with candidate and
    configuration.
    """
    return compact_json([str(value.get(key)) for key in ("id", "candidate", "configuration")])


def file_values(path: Path) -> Iterator[tuple[int, Any, str | None]]:
    """(line, value, None) or (line, None, what is wrong) for each object: one per line, or the
    whole file as one object.
    """
    text = read_text(path)
    if not text.strip():
        raise PlannerError(f"{path}: is empty; a dataset, predictions or a plan is expected")
    first = text.lstrip().split("\n", 1)[0]
    if path.suffix == ".json" or first.strip() in ("{", "["):
        value, line, problem = decode_json(text)
        yield line or 1, value, problem
        return
    yield from iterate_jsonl(path)


def object_problems(
    value: dict[str, Any],
    vocabulary: Vocabulary,
    level: Level | None = None,
    *,
    complete: bool = False,
) -> tuple[Kind | None, Level | None, list[str]]:
    """Kind and level of an object, and everything wrong with it. `level` is the one that it must
    have; None takes what it has.
    """
    kind, plan = _kind(value)
    if kind is None:
        return (
            None,
            level,
            [
                "none of a dataset record (expected), a prediction (output) and a plan (tasks or"
                " skill_sequence)"
            ],
        )
    if kind == "prediction" and isinstance(plan, str):
        plan, _line, problem = decode_json(plan)
        if problem:
            return kind, level, [*_identifier_problems(value, ("id",)), f"output: {problem}"]
    found = next(
        (known for known in LEVELS if isinstance(plan, dict) and list_key(known) in plan), level
    )
    if found is None:
        return kind, None, [f"{_plan_key(kind)}holds neither tasks nor skill_sequence"]
    problems = (
        [] if level in (None, found) else [f"a {level} plan is expected, this is a {found} plan"]
    )
    if kind == "record":
        return kind, found, problems + record_problems(found, value, vocabulary, complete=complete)
    identifiers = _identifier_problems(value, ("id",)) if kind == "prediction" else []
    return (
        kind,
        found,
        [
            *problems,
            *identifiers,
            *(
                f"{_plan_key(kind)}{text}"
                for text in _plan_problems(found, plan, vocabulary, value.get("prompt"))
            ),
        ],
    )


def _kind(value: dict[str, Any]) -> tuple[Kind | None, Any]:
    if "expected" in value:
        return "record", value["expected"]
    if "output" in value:
        return "prediction", value["output"]
    return ("plan", value) if any(list_key(level) in value for level in LEVELS) else (None, None)


def _plan_key(kind: Kind) -> str:
    return {"record": "expected: ", "prediction": "output: ", "plan": ""}[kind]


def _plan_problems(level: Level, plan: Any, vocabulary: Vocabulary, prompt: Any) -> list[str]:
    problems = plan_problems(level, plan, vocabulary, strict=True)
    if level == "mission":
        problems += rule_problems(plan, vocabulary, prompt if isinstance(prompt, str) else None)
    return problems


# ---------------------------------------------------------------- dataset records


def record_problems(
    level: Level, record: dict[str, Any], vocabulary: Vocabulary, *, complete: bool = False
) -> list[str]:
    """What is wrong with a dataset record. Without `complete`, `expected` may hold names and
    parameters alone.
    """
    problems = _identifier_problems(
        record, ("id", "prompt", *(("family",) if complete or "family" in record else ()))
    )
    if level == "task":
        problems += _task_problems(record, vocabulary)
    expected = record.get("expected")
    form = plan_problems(
        level, expected if complete else _filled(level, expected), vocabulary, strict=True
    )
    problems += [f"expected: {text}" for text in form]
    prompt = record.get("prompt")
    if not isinstance(prompt, str) or not isinstance(expected, dict):
        return problems
    if level == "task":
        problems += [f"expected: {text}" for text in step_problems(record, vocabulary)]
    else:
        tags = record.get("tags")
        tags = (
            tags if isinstance(tags, list) and all(isinstance(tag, str) for tag in tags) else None
        )
        problems += [
            f"expected: {text}" for text in rule_problems(expected, vocabulary, prompt, tags)
        ]
        problems += _annotation_problems(record, prompt, vocabulary, complete=complete)
    if complete and not form:
        problems += completeness_problems(level, record, vocabulary)
    return problems


def _identifier_problems(record: dict[str, Any], keys: tuple[str, ...]) -> list[str]:
    return [
        f"{key} is {'missing' if key not in record else 'no text'}"
        for key in keys
        if not (isinstance(record.get(key), str) and record[key].strip())
    ]


def _filled(level: Level, expected: Any) -> Any:
    """The plan with what an outsider may leave out: texts, and empty lists and parameters."""
    if not isinstance(expected, dict) or not isinstance(expected.get(list_key(level)), list):
        return expected
    if level == "mission":
        tasks = [
            {"parameters": {}, "task_prompt": "", **task} if isinstance(task, dict) else task
            for task in expected["tasks"]
        ]
        return {"assumptions": [], "constraints": [], **expected, "tasks": tasks}
    empty: dict[str, list[Any]] = {
        key: []
        for key in (
            "filter_skills",
            "perception_skills",
            "stop_conditions",
            "failure_modes",
            "expected_outputs",
        )
    }
    steps = []
    for step in expected["skill_sequence"]:
        filled = {**empty, **step} if isinstance(step, dict) else step
        if isinstance(filled, dict):
            for key, item in filled.items():
                filled[key] = (
                    [_with_parameters(skill) for skill in item]
                    if key.endswith("_skills") and isinstance(item, list)
                    else _with_parameters(item)
                )
        steps.append(filled)
    return {**expected, "skill_sequence": steps}


def _with_parameters(skill: Any) -> Any:
    return {"parameters": {}, **skill} if isinstance(skill, dict) else skill


def _task_problems(record: dict[str, Any], vocabulary: Vocabulary) -> list[str]:
    """What is wrong with the input of a task record: its title and parameters."""
    missing = [f"{key} is missing" for key in ("task", "parameters") if key not in record]
    if missing:
        return missing
    plan = {
        "tasks": [{"title": record["task"], "parameters": record["parameters"], "task_prompt": ""}],
        "assumptions": [],
        "constraints": [],
    }
    found = plan_problems("mission", plan, vocabulary, strict=True)
    return [
        text.replace("tasks[0].parameters", "parameters").replace("tasks[0]", "task")
        for text in found
    ]


def _annotation_problems(
    record: dict[str, Any], prompt: str, vocabulary: Vocabulary, *, complete: bool
) -> list[str]:
    problems = [f"{key} is missing" for key in ("spans", "tags") if complete and key not in record]
    for key in ("spans", "tags"):
        if not isinstance(record.get(key, []), list):
            return [*problems, f"{key} is no list"]
    for index, span in enumerate(record.get("spans", [])):
        problems += [f"spans[{index}]: {text}" for text in _span_problems(span, prompt)]
    if all(isinstance(tag, str) for tag in record.get("tags", [])):
        return problems + (list(tag_problems(record, vocabulary)) if "tags" in record else [])
    return [*problems, "tags holds something else than texts"]


def _span_problems(span: Any, prompt: str) -> Iterator[str]:
    if not isinstance(span, dict) or set(span) != {"element", "start", "end", "text"}:
        yield "an object with element, start, end and text is expected"
        return
    if span["element"] not in ELEMENTS:
        yield f"element {span['element']!r} is none of {', '.join(ELEMENTS)}"
    start, end = span["start"], span["end"]
    if not all(
        isinstance(bound, int) and not isinstance(bound, bool) for bound in (start, end)
    ) or not 0 <= start < end <= len(prompt):
        yield f"{start!r} to {end!r} lies outside the prompt"
    elif prompt[start:end] != span["text"]:
        yield f"text is {span['text']!r}, but the prompt has {prompt[start:end]!r} there"
