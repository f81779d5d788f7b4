"""Training and validation samples: read, checked, enlarged, rendered, shown in colour."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import groupby
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING, Any

from planner_ft.data.curated import known_tests
from planner_ft.data.leakage import input_digest
from planner_ft.prompts import Rendered, render_sample
from planner_ft.prompts.text import user_text
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, iterate_jsonl, sha256_file, sha256_text
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, list_key, plan_problems

if TYPE_CHECKING:
    from rich.text import Text
    from transformers import PreTrainedTokenizerBase

SHOWN = 5
"""Problems of one kind that are listed; the others are counted."""
JOINED, PARTNERS = 0.4, 4
"""Share of the varied copies that go on with another record, the first of so many that fits."""
AUGMENT_SEED = 7_000_000
"""Far from the seeds of `gen-data`: no synthetic data set of a small seed has the same samples."""
Record = dict[str, Any]


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

    def extended(self, records: list[Record], digest: str) -> Split:
        """The split with more records behind its own; its digest covers theirs."""
        both = sha256_text(self.sha256 + digest)
        return replace(self, sha256=both, records=[*self.records, *records])


def read_split(
    path: Path,
    level: Level,
    vocabulary: Vocabulary,
    problems: list[str],
    limit: int | None = None,
    known: Split | None = None,
) -> Split | None:
    """Read a JSONL file, at most `limit` records; None when it cannot be read at all.

    Everything wrong with it is added to `problems`, also ids that `known` holds already.
    """
    if not path.is_file():
        command = f"`plannerft gen-data --level {level}`"
        way_out = f"make the data with {command}, or give --data-dir or --train-file"
        problems.append(f"{path}: no such file; {way_out}")
        return None
    found: list[str] = []
    records: list[Record] = []
    seen = {record["id"]: str(known.path) for record in known.records} if known else {}
    try:
        for line, value, problem in iterate_jsonl(path):
            problem = problem or record_problem(value, level, vocabulary)
            if problem is None and value is not None and value["id"] in seen:
                problem = f"id {value['id']!r} stands in {seen[value['id']]} already"
            if problem or value is None:
                found.append(f"{path}:{line}: {problem}")
                continue
            seen[value["id"]] = f"line {line}"
            records.append(value)
            if len(records) == limit:
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
    if problem := input_problem(value, level):
        return problem
    if "expected" not in value:
        return "expected (the plan) is missing"
    found = plan_problems(level, value["expected"], vocabulary, strict=True)
    return "expected: " + "; ".join(found) if found else None


def input_problem(value: Any, level: Level) -> str | None:
    """The reason why a record holds no input of an agent, or None."""
    if not isinstance(value, dict):
        return f"a JSON object is expected, not {type(value).__name__}"
    for key in ("id", "prompt", *(("task",) if level == "task" else ())):
        if not isinstance(value.get(key), str) or not value[key].strip():
            return f"{key} is missing or no text"
    if level == "task" and not isinstance(value.get("parameters", {}), dict):
        return "parameters is no JSON object"
    return None


def digests(split: Split, level: Level, vocabulary: Vocabulary) -> list[str]:
    """The digest of every record's input, by which it is known again in a test set."""
    return [input_digest(user_text(level, record, vocabulary)) for record in split.records]


def tests_within(splits: Sequence[Split], level: Level, vocabulary: Vocabulary) -> dict[str, str]:
    """The known test sets that share inputs with the splits, and how many: "25 of 25"."""
    used = {digest for split in splits for digest in digests(split, level, vocabulary)}
    found: dict[str, tuple[str, str]] = {}
    known = known_tests(level, splits[0].path.parent, vocabulary) if splits else ()
    for path in known:
        values = (value for _line, value, _problem in iterate_jsonl(path))
        records = [one for one in values if one and input_problem(one, level) is None]
        of_test = Split(path, sha256_file(path), records)
        shared = sum(digest in used for digest in digests(of_test, level, vocabulary))
        if shared:
            found.setdefault(of_test.sha256, (str(path), f"{shared} of {len(records)}"))
    return dict(found.values())


def tests_warnings(tests: Mapping[str, str]) -> list[str]:
    """A sentence for each test set whose inputs are trained on."""
    return [
        f"{count} inputs of {path} are in the training or validation data: figures that are"
        " measured on them say nothing about other commands"
        for path, count in tests.items()
    ]


def with_corrections(
    split: Split, path: Path, level: Level, vocabulary: Vocabulary, problems: list[str]
) -> Split:
    """The split with the records of `path`, as `plannerft review --harvest` writes them, behind.

    Everything wrong with the file is added to `problems`.
    """
    added = read_split(path, level, vocabulary, problems, known=split)
    return split.extended(added.records, added.sha256) if added else split


def contradictions(split: Split, level: Level, vocabulary: Vocabulary) -> Iterator[str]:
    """Records of the same input with different plans; how a task prompt is worded is no difference."""
    first: dict[str, Record] = {}
    for record, digest in zip(split.records, digests(split, level, vocabulary), strict=True):
        known = first.setdefault(digest, record)
        if _labels(level, known) != _labels(level, record):
            same = f"{known['id']} and {record['id']} are the same input with different plans"
            yield f"{split.path}: {same}; keep the right one"


def _labels(level: Level, record: Record) -> list[Record]:
    entries: list[Record] = record["expected"][list_key(level)]
    return [{key: one for key, one in entry.items() if key != "task_prompt"} for entry in entries]


def augmented(split: Split, level: Level, vocabulary: Vocabulary, seed: int, count: int) -> Split:
    """The split with `count` synthetic records behind its own.

    The level's generator makes them, which holds no curated and no test sample. Raises
    PlannerError for a vocabulary without templates.
    """
    from planner_ft.data.missions import sample_missions
    from planner_ft.data.task.sampler import sample_tasks

    seed += AUGMENT_SEED
    if level == "task":
        made = list(sample_tasks(vocabulary, seed, count, "train"))
    else:
        made = list(sample_missions(seed, count, vocabulary))
    named = [{**record, "id": f"augment-{record['id']}"} for record in made]
    return split.extended(named, "".join(compact_json(record) for record in made))


def with_variants(
    split: Split, level: Level, vocabulary: Vocabulary, seed: int, count: int
) -> Split:
    """The split with `count` copies of each record behind its own, with other values where it has
    some; a part of them goes on with another record. Raises PlannerError at task level.
    """
    from planner_ft.data.joining import joined
    from planner_ft.data.varying import varied

    if level == "task":
        raise PlannerError("--vary is for the mission level; --augment makes samples of both")
    made = []
    for number in range(1, count + 1):
        for record in split.records:
            rng, longer = Random(f"{seed} {number} {record['id']}"), None
            if rng.random() < JOINED:
                others = rng.choices(split.records, k=PARTNERS)
                tried = (joined(record, other, vocabulary, rng) for other in others)
                longer = next(filter(None, tried), None)
            if new := varied(longer or record, vocabulary, rng) or longer:
                made.append({**new, "id": f"varied-{number}-{record['id']}"})
    return split.extended(made, "".join(compact_json(record) for record in made))


def render_split(
    split: Split,
    level: Level,
    tokenizer: PreTrainedTokenizerBase,
    vocabulary: Vocabulary,
    *,
    with_vocabulary: bool = False,
) -> Split:
    """The split with its samples rendered."""
    shown = {"with_vocabulary": with_vocabulary}
    samples = [
        Sample(record["id"], render_sample(level, record, tokenizer, vocabulary, **shown))
        for record in split.records
    ]
    return replace(split, samples=samples)


def shortened(problems: Iterable[str]) -> list[str]:
    """The first problems, and how many more there are."""
    listed = list(problems)
    rest = len(listed) - SHOWN
    return listed if rest <= 0 else [*listed[:SHOWN], f"... and {rest} more of this kind"]


def preview_text(sample: Sample, tokenizer: PreTrainedTokenizerBase) -> Text:
    """The sample as the model sees it: prompt dim, completion green, special tokens reversed.

    The trained part stands in ⟦ ⟧, so that it shows without colour.
    """
    from rich.text import Text

    text, trained = Text(), False
    special = set(tokenizer.all_special_ids) | set(tokenizer.added_tokens_decoder)
    ids, masks = sample.rendered.input_ids, sample.rendered.completion_mask
    # A character may consist of several tokens: runs are decoded together, special tokens alone.
    kinds = [
        (bool(mask), position if token in special else None)
        for position, (token, mask) in enumerate(zip(ids, masks, strict=True))
    ]
    for (mask, alone), run in groupby(range(len(ids)), key=kinds.__getitem__):
        if mask != trained:
            text.append("⟦" if mask else "⟧", "bold")
            trained = mask
        style = ("green" if mask else "dim") + ("" if alone is None else " reverse")
        tokens = [ids[position] for position in run]
        text.append(str(tokenizer.decode(tokens, clean_up_tokenization_spaces=False)), style)
    return text.append("⟧", "bold") if trained else text
