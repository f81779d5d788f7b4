"""Reading cases, a line of JSON each: field cases (schemas/field.schema.json), and demands.

A demand record is {"id", "prompt", "skills": [{"task": TITLE, "skills": [NAME, ...]}], "locate"}: a
demand is met when some step of a task of the title has the skill.
"""

from __future__ import annotations

import functools
import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import iterate_jsonl, read_text
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.schema import SHAPES

CASES, DEMANDS = Path("eval/field"), Path("eval/both/demands.jsonl")
"""The folder of cases, and the file of demands, where no file is named."""
CHECKS = (
    *("titles", "has", "lacks", "skill", "waypoints", "visits", "never_at", "clear", "outcome"),
    *("says", "warns", "quiet", "any"),
)
"""What an object of `expect` is told by."""
KEYS = ("id", "prompt", "skills", "locate", "expected")
Check = Mapping[str, Any]
Find = Callable[[Any, Vocabulary], str | None]


@dataclass(frozen=True)
class Case:
    """A command with places (metres), origin (degrees) and checks; silent `danger` counts apart."""

    id: str
    kind: str
    command: str
    expect: tuple[Check, ...]
    locate: dict[str, tuple[float, float]] = field(default_factory=dict)
    origin: tuple[float, float] | None = None
    danger: bool = False


def case_files(files: Sequence[Path]) -> list[Path]:
    """The files, eval/field/*.jsonl without any. Raises PlannerError when there is none."""
    paths = list(files) or sorted(CASES.glob("*.jsonl"))
    if not paths:
        raise PlannerError(f"--field: there is no {CASES}/*.jsonl here; name a file of cases")
    return paths


def load_cases(files: Sequence[Path], vocabulary: Vocabulary) -> list[Case]:
    """The cases of files. Raises PlannerError with file and line."""
    cases = []
    for value in _checked(files, vocabulary, _case_problem):
        origin = tuple(value["origin"]) if "origin" in value else None
        known = {"expect": tuple(value["expect"]), "locate": _places(value), "origin": origin}
        cases.append(Case(**{**value, **known}))
    return cases


def load_demands(files: Sequence[Path], vocabulary: Vocabulary) -> list[Case]:
    """The records of files as cases, a check per demand. Raises PlannerError with file and line."""
    cases = []
    for record in _checked(files, vocabulary, _demand_problem):
        expect = tuple(_demanded(record.get("skills", [])))
        cases.append(Case(record["id"], "both", record["prompt"], expect, _places(record)))
    if not any(case.expect for case in cases):
        raise PlannerError(f"{files[0]}: demands no skills; give records the key skills")
    return cases


def _checked(files: Sequence[Path], vocabulary: Vocabulary, find: Find) -> Iterator[Any]:
    """The values of files. Raises PlannerError at the first problem that `find` names."""
    seen = set[str]()
    for path in files:
        number = 0
        for number, value, problem in iterate_jsonl(path):
            problem = problem or find(value, vocabulary)
            if value is not None and not problem and value["id"] in seen:
                problem = f"id {value['id']!r} is given twice; give every case its own"
            if problem or value is None:
                raise PlannerError(f"{path}:{number}: {problem}")
            seen.add(value["id"])
            yield value
        if not number:
            raise PlannerError(f"{path}: holds no cases")


def _places(value: dict[str, Any]) -> dict[str, tuple[float, float]]:
    return {name: (x, y) for name, (x, y) in value.get("locate", {}).items()}


def _case_problem(value: Any, vocabulary: Vocabulary) -> str | None:
    """What is wrong with a case: its form, a name that the vehicle has not, or an expression."""
    from jsonschema.exceptions import best_match

    expect = value.get("expect") if isinstance(value, dict) else None
    for check in expect if isinstance(expect, list) else ():
        if isinstance(check, dict) and not check.keys() & set(CHECKS):
            return f"expect: {str(check)[:80]} is no check; there is {', '.join(CHECKS)}"
    if found := best_match(_validator().iter_errors(value)):
        where = found.json_path.removeprefix("$").lstrip(".") or "the case"
        return f"{where}: {found.message[:200]}"
    return next((text for one in value["expect"] for text in check_problems(one, vocabulary)), None)


def _demand_problem(value: Any, vocabulary: Vocabulary) -> str | None:
    if not isinstance(value, dict) or not all(isinstance(value.get(key), str) for key in KEYS[:2]):
        return "a record with the texts id and prompt is expected"
    if unknown := [key for key in value if key not in KEYS]:
        return f"unknown key {unknown[0]!r}; there is {', '.join(KEYS)}"
    entries = value.get("skills", [])
    if not isinstance(entries, list) or not all(map(_is_demand, entries)):
        return 'skills must be a list of {"task": TITLE, "skills": [NAME, ...]}'
    checks = [*({"under": entry["task"]} for entry in entries), *_demanded(entries)]
    problems = (text for check in checks for text in check_problems(check, vocabulary))
    return next((f"skills: {text}" for text in problems), None)


def _demanded(entries: Sequence[dict[str, Any]]) -> list[dict[str, str]]:
    return [{"skill": name, "under": one["task"]} for one in entries for name in one["skills"]]


def _is_demand(entry: Any) -> bool:
    if not isinstance(entry, dict) or entry.keys() != {"task", "skills"}:
        return False
    names = entry["skills"] if isinstance(entry["skills"], list) else [None]
    return all(isinstance(name, str) for name in (entry["task"], *names))


def check_problems(check: Check, vocabulary: Vocabulary) -> Iterator[str]:
    """Names of a check that the vehicle has not, and bad regular expressions."""
    for inner in check.get("any", ()):
        yield from check_problems(inner, vocabulary)
    named = [check[key] for key in ("has", "lacks", "under") if key in check]
    for title in (*check.get("titles", ()), *named):
        if title not in vocabulary.task:
            yield f"{title!r} is no task of this vehicle"
    owner: Any = vocabulary.task.get(check.get("has", ""))
    if "skill" in check:
        owner = vocabulary.skill.get(check["skill"])
        if owner is None:
            yield f"{check['skill']!r} is no skill of this vehicle"
    for name in check.get("with", {}) if owner else ():
        if name not in owner.by_name:
            yield f"with: {name!r} is no parameter there"
    for key in ("says", "warns"):
        try:
            re.compile(check.get(key, ""))
        except re.error as error:
            yield f"{key}: {check[key]!r} is no regular expression ({error})"


@functools.cache
def _validator() -> Any:
    import jsonschema

    schema = json.loads(read_text(SHAPES / "field.schema.json"))
    return jsonschema.Draft202012Validator(schema)
