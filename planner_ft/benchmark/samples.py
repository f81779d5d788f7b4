"""Test data: JSONL of `{"id", "prompt", "expected"}` (tasks: also `task`, `parameters`)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import iterate_jsonl, sha256_file
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, list_key, plan_names, step_skills

SHOWN = 5  # bad lines that an error lists before it only counts the rest


@dataclass(frozen=True)
class Sample:
    """One test sample. `family` is its phrasing family, or its id where the data has none."""

    id: str
    family: str
    record: dict[str, Any]

    @classmethod
    def of(cls, record: dict[str, Any]) -> Sample:
        return cls(record["id"], str(record.get("family") or record["id"]), record)

    @property
    def expected(self) -> dict[str, Any]:
        """The expected plan; it may hold names and parameters alone."""
        plan: dict[str, Any] = self.record["expected"]
        return plan


@dataclass(frozen=True)
class BenchData:
    """The samples of a file, or the first up to a limit; `ids` are all of the file."""

    path: Path
    sha256: str
    level: Level
    samples: tuple[Sample, ...]
    ids: frozenset[str]

    def summary(self) -> dict[str, Any]:
        """Path, digest and number of samples, as results.json has them."""
        return {"path": str(self.path), "sha256": self.sha256, "n": len(self.samples)}


def load_bench_data(
    path: Path | str, level: Level, vocabulary: Vocabulary, limit: int | None = None
) -> BenchData:
    """Read and check test data. Raises PlannerError that names the bad lines."""
    path = Path(path)
    if limit is not None and limit < 1:
        raise PlannerError(f"--limit {limit}: must be at least 1")
    lines: dict[str, int] = {}
    samples, problems = [], []
    record: Any
    for number, record, problem in iterate_jsonl(path):
        problem = problem or next(_problems(record, level, vocabulary), None)
        if problem is None and lines.setdefault(record["id"], number) != number:
            problem = f"id {record['id']!r} stands on line {lines[record['id']]} already"
        if problem is not None:
            problems.append(f"{path}:{number}: {problem}")
        else:
            samples.append(Sample.of(record))
    if problems:
        raise PlannerError(joined(problems))
    if not samples:
        raise PlannerError(f"{path}: holds no samples")
    return BenchData(path, sha256_file(path), level, tuple(samples[:limit]), frozenset(lines))


def joined(problems: list[str]) -> str:
    """The first problems as one text, with the number of the others."""
    more = f"; and {len(problems) - SHOWN} more" if len(problems) > SHOWN else ""
    return "; ".join(problems[:SHOWN]) + more


def _problems(record: Any, level: Level, vocabulary: Vocabulary) -> Iterator[str]:
    """Reasons why a line is no test sample: entries without a name would miss in the score."""
    if not isinstance(record, dict):
        yield f"a JSON object is expected, not {type(record).__name__}"
        return
    for key in ("id", "prompt"):
        if not isinstance(record.get(key), str) or not record[key].strip():
            yield f"{key} is missing or no text"
    expected, key = record.get("expected"), list_key(level)
    if not isinstance(expected, dict) or not isinstance(expected.get(key), list):
        yield f'expected must be an object with the list "{key}" (is this data of --level {level}?)'
        return
    mission = level == "mission"
    if not mission and str(record.get("task")) not in vocabulary.task:
        yield f"task {record.get('task')!r} is no task of the vocabulary {vocabulary.name}"
    if not mission and not isinstance(record.get("parameters"), dict):
        yield "parameters is missing or no object"
    field = "title" if mission else "name"
    for index, entry in enumerate(expected[key]):
        items = [entry] if mission else [skill for _role, skill in step_skills(entry)]
        named = [isinstance(item, dict) and isinstance(item.get(field), str) for item in items]
        if not items or not all(named):
            yield f"expected.{key}[{index}] has no {field}"
        elif not all(isinstance(item.get("parameters", {}), dict) for item in items):
            yield f"expected.{key}[{index}]: parameters is no object"
    known = vocabulary.task if mission else vocabulary.skill
    for name in plan_names(level, expected):
        if name not in known:
            where = f"is not in the vocabulary {vocabulary.name}; correct it or give --vocabulary"
            yield f"expected names {name!r}, which {where}"


def default_data(level: Level, vocabulary: Vocabulary) -> Path:
    """The test split that `plannerft gen-data` writes. Raises PlannerError when it is not there."""
    path = vocabulary.data / level / "test.jsonl"
    if not path.is_file():
        way = f"write it with `plannerft gen-data --level {level}`, or give --data"
        raise PlannerError(f"{path}: no such file; {way}")
    return path
