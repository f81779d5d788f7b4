"""Training and validation samples: read, checked against form and vocabulary, rendered into ids and
completion mask.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.prompts import Rendered, render_sample
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import iterate_jsonl, sha256_file
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, plan_problems

if TYPE_CHECKING:
    from transformers import PreTrainedTokenizerBase

SHOWN = 5
"""Problems of one kind that are listed; the others are counted."""


@dataclass(frozen=True)
class Record:
    """A dataset record and the line it stands on."""

    line: int
    value: dict[str, Any]

    @property
    def id(self) -> str:
        return str(self.value["id"])


@dataclass(frozen=True)
class Sample:
    """A rendered record."""

    id: str
    rendered: Rendered

    @property
    def length(self) -> int:
        return len(self.rendered.input_ids)

    @property
    def completion_length(self) -> int:
        return self.length - self.rendered.prompt_length


@dataclass(frozen=True)
class Split:
    """A data file: its digest, records and, once rendered, samples in the same order."""

    path: Path
    sha256: str
    records: list[Record]
    samples: list[Sample] = field(default_factory=list)

    @property
    def tokens(self) -> int:
        return sum(sample.length for sample in self.samples)

    @property
    def longest(self) -> int:
        return max((sample.length for sample in self.samples), default=0)


def read_split(
    path: Path, level: Level, vocabulary: Vocabulary, problems: list[str], limit: int | None = None
) -> Split | None:
    """Read a JSONL file, at most `limit` records. Adds everything wrong to `problems`; None when it
    cannot be read at all.
    """
    if not path.is_file():
        problems.append(
            f"{path}: no such file; make the data with `plannerft gen-data --level {level}`, or"
            " give --data-dir or --train-file"
        )
        return None
    found: list[str] = []
    records: list[Record] = []
    seen: dict[str, int] = {}
    try:
        for line, value, problem in iterate_jsonl(path):
            problem = problem or record_problem(value, level, vocabulary)
            if problem:
                found.append(f"{path}:{line}: {problem}")
            elif (first := seen.setdefault(value["id"], line)) != line:  # type: ignore[index]
                found.append(f"{path}:{line}: id {value['id']!r} stands in line {first} already")  # type: ignore[index]
            else:
                records.append(Record(line, value))  # type: ignore[arg-type]
            if limit is not None and len(records) >= limit:
                break
    except PlannerError as error:
        problems.append(str(error))
        return None
    if not records and not found:
        found.append(f"{path}: holds no records")
    problems.extend(shortened(found))
    return Split(path, sha256_file(path), records)


def record_problem(value: Any, level: Level, vocabulary: Vocabulary) -> str | None:
    """What keeps a record from being trained on, or None."""
    if not isinstance(value, dict):
        return f"a JSON object is expected, not {type(value).__name__}"
    for key in ("id", "prompt", *(("task",) if level == "task" else ())):
        if not isinstance(value.get(key), str) or not value[key].strip():
            return f"{key} is missing or no text"
    if level == "task" and not isinstance(value.get("parameters", {}), dict):
        return "parameters is no JSON object"
    if "expected" not in value:
        return "expected (the plan) is missing"
    found = plan_problems(level, value["expected"], vocabulary, strict=True)
    return "expected: " + "; ".join(found) if found else None


def render_split(
    split: Split,
    level: Level,
    tokenizer: PreTrainedTokenizerBase,
    vocabulary: Vocabulary,
    *,
    with_vocabulary: bool = False,
    tick: Callable[[], None] = lambda: None,
) -> Split:
    """The split with its samples rendered; `tick` is called after each."""
    samples = []
    for record in split.records:
        samples.append(
            Sample(
                record.id,
                render_sample(
                    level, record.value, tokenizer, vocabulary, with_vocabulary=with_vocabulary
                ),
            )
        )
        tick()
    return Split(split.path, split.sha256, split.records, samples)


def shortened(problems: Iterable[str], shown: int = SHOWN) -> list[str]:
    """The first problems, and how many more there are."""
    listed = list(problems)
    rest = len(listed) - shown
    return listed if rest <= 0 else [*listed[:shown], f"... and {rest} more of this kind"]
