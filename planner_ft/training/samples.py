"""Training and validation samples: read, checked, enlarged, rendered into ids and mask."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.prompts import Rendered, render_sample
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, iterate_jsonl, sha256_file, sha256_text
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, plan_problems

if TYPE_CHECKING:
    from transformers import PreTrainedTokenizerBase

SHOWN = 5
"""Problems of one kind that are listed; the others are counted."""
AUGMENT_SEED = 7_000_000
"""Far from the seeds of `gen-data`: no synthetic data set of a small seed has the same samples."""


@dataclass(frozen=True)
class Record:
    """A dataset record and its line."""

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

    def with_records(self, values: Iterable[dict[str, Any]], sha256: str) -> Split:
        """The split with more records behind its own."""
        last = max((record.line for record in self.records), default=0)
        added = [Record(last + number, value) for number, value in enumerate(values, start=1)]
        return replace(self, sha256=sha256, records=[*self.records, *added])


def read_split(
    path: Path, level: Level, vocabulary: Vocabulary, problems: list[str], limit: int | None = None
) -> Split | None:
    """Read a JSONL file, at most `limit` records; None when it cannot be read at all.

    Everything wrong with it is added to `problems`.
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
            if problem is None and value is not None:
                first = seen.setdefault(value["id"], line)
                if first == line:
                    records.append(Record(line, value))
                else:
                    problem = f"id {value['id']!r} stands in line {first} already"
            if problem:
                found.append(f"{path}:{line}: {problem}")
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
    """The reason why a record cannot be trained on, or None."""
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


def with_corrections(
    split: Split, path: Path, level: Level, vocabulary: Vocabulary, problems: list[str]
) -> Split:
    """The split with the records of `path`, as `plannerft review --harvest` writes them, behind.

    Its digest covers them. Everything wrong with the file is added to `problems`.
    """
    corrections = read_split(path, level, vocabulary, problems)
    if corrections is None:
        return split
    known = {record.id for record in split.records}
    problems += [
        f"{path}:{record.line}: id {record.id!r} stands in {split.path} already"
        for record in corrections.records
        if record.id in known
    ]
    values = (record.value for record in corrections.records)
    return split.with_records(values, sha256_text(split.sha256 + corrections.sha256))


def augmented(split: Split, level: Level, vocabulary: Vocabulary, seed: int, count: int) -> Split:
    """The split with `count` synthetic records behind its own; its digest covers them."""
    made = list(synthetic_records(level, vocabulary, seed, count))
    digest = sha256_text(split.sha256 + "".join(compact_json(record) for record in made))
    return split.with_records(({**one, "id": f"augment-{one['id']}"} for one in made), digest)


def synthetic_records(
    level: Level, vocabulary: Vocabulary, seed: int, count: int
) -> Iterator[dict[str, Any]]:
    """`count` records of the level's generator, which holds no curated and no test sample.

    Raises PlannerError for a vocabulary without templates.
    """
    if level == "task":
        from planner_ft.data.task.sampler import sample_tasks

        yield from sample_tasks(vocabulary, AUGMENT_SEED + seed, count, "train")
        return
    from planner_ft.data.missions import sample_missions

    yield from sample_missions(AUGMENT_SEED + seed, count, vocabulary)


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
        rendered = render_sample(
            level, record.value, tokenizer, vocabulary, with_vocabulary=with_vocabulary
        )
        samples.append(Sample(record.id, rendered))
        tick()
    return replace(split, samples=samples)


def shortened(problems: Iterable[str], shown: int = SHOWN) -> list[str]:
    """The first problems, and how many more there are."""
    listed = list(problems)
    rest = len(listed) - shown
    return listed if rest <= 0 else [*listed[:shown], f"... and {rest} more of this kind"]
