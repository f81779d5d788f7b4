"""Reading field cases: JSON Lines, a case per line (schemas/field.schema.json)."""

from __future__ import annotations

import functools
import json
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import iterate_jsonl, read_text
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.schema import SHAPES

DEFAULT = Path("eval/field")
"""The folder of cases that are run where no file is named."""
CHECKS = (
    *("titles", "has", "lacks", "skill", "waypoints", "visits", "never_at", "clear", "outcome"),
    *("says", "warns", "quiet", "any"),
)
"""What an object of `expect` is told by."""
Check = Mapping[str, Any]


@dataclass(frozen=True)
class Case:
    """A command with positions of its places (metres) and an origin (degrees), and its checks.

    A `danger`ous case that fails without any warning is counted apart.
    """

    id: str
    kind: str
    command: str
    expect: tuple[Check, ...]
    locate: dict[str, tuple[float, float]] = field(default_factory=dict)
    origin: tuple[float, float] | None = None
    danger: bool = False


def case_files(files: Sequence[Path]) -> list[Path]:
    """The files, eval/field/*.jsonl without any. Raises PlannerError when there is none."""
    paths = list(files) or sorted(DEFAULT.glob("*.jsonl"))
    if not paths:
        raise PlannerError(f"--field: there is no {DEFAULT}/*.jsonl here; name a file of cases")
    return paths


def load_cases(files: Sequence[Path], vocabulary: Vocabulary) -> list[Case]:
    """The cases of files. Raises PlannerError with file and line."""
    cases: dict[str, Case] = {}
    for path in files:
        before = len(cases)
        for number, value, problem in iterate_jsonl(path):
            problem = problem or _problem(value, vocabulary)
            case = None if problem or value is None else _case(value)
            if case and case.id in cases:
                problem = f"id {case.id!r} is given twice; give every case its own"
            if problem or case is None:
                raise PlannerError(f"{path}:{number}: {problem or 'null is no case'}")
            cases[case.id] = case
        if len(cases) == before:
            raise PlannerError(f"{path}: holds no cases")
    return list(cases.values())


def _case(value: dict[str, Any]) -> Case:
    locate = {name: (x, y) for name, (x, y) in value.get("locate", {}).items()}
    origin = tuple(value["origin"]) if "origin" in value else None
    return Case(**{**value, "expect": tuple(value["expect"]), "locate": locate, "origin": origin})


def _problem(value: Any, vocabulary: Vocabulary) -> str | None:
    """What is wrong with a case: its form, a name that the vehicle has not, or an expression."""
    from jsonschema.exceptions import best_match

    expect = value.get("expect") if isinstance(value, dict) else None
    for check in expect if isinstance(expect, list) else ():
        if isinstance(check, dict) and not check.keys() & set(CHECKS):
            return f"expect: {str(check)[:80]} is no check; there is {', '.join(CHECKS)}"
    if found := best_match(_validator().iter_errors(value)):
        where = found.json_path.removeprefix("$").lstrip(".") or "the case"
        return f"{where}: {found.message[:200]}"
    return next(
        (text for check in value["expect"] for text in check_problems(check, vocabulary)), None
    )


def check_problems(check: Check, vocabulary: Vocabulary) -> Iterator[str]:
    """Names of a check that the vehicle has not, and bad regular expressions."""
    for inner in check.get("any", ()):
        yield from check_problems(inner, vocabulary)
    titles = [
        *check.get("titles", ()),
        *(check[key] for key in ("has", "lacks", "under") if key in check),
    ]
    yield from (
        f"{title!r} is no task of this vehicle" for title in titles if title not in vocabulary.task
    )
    owner = vocabulary.task.get(check.get("has", ""))
    if "skill" in check:
        owner = vocabulary.skill.get(check["skill"])  # type: ignore[assignment]
        if owner is None:
            yield f"{check['skill']!r} is no skill of this vehicle"
    if owner is not None:
        unknown = [name for name in check.get("with", {}) if name not in owner.by_name]
        yield from (f"with: {name!r} is no parameter there" for name in unknown)
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
