"""Training and validation samples: read, checked, enlarged, rendered, shown in colour."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING, Any

from planner_ft.data.curated import known_tests
from planner_ft.data.leakage import input_digest
from planner_ft.prompts import Rendered, render_sample, user_text
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, iterate_jsonl, sha256_file, sha256_text
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import MISSIONS
from planner_ft.vocabulary.plans import Level, list_key, plan_problems

if TYPE_CHECKING:
    from rich.text import Text
    from transformers import PreTrainedTokenizerBase

SHOWN = 5
"""Problems of one kind that are listed; the others are counted."""
JOINED, PARTNERS = 0.4, 4
"""Share of the varied copies that go on with another record, the first of so many that fits."""
SEVERAL, LOST, HEADED = 0.25, 0.5, 0.08
"""Shares of those that ask for several places where they can, lack words, have a heading."""
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
    level: Level
    vocabulary: Vocabulary
    records: list[Record]
    sha256: str
    samples: list[Sample] = field(default_factory=list)

    def digests(self) -> list[str]:
        """The digest of every record's input, by which it is known again in a test set."""
        texts = (user_text(self.level, record, self.vocabulary) for record in self.records)
        return list(map(input_digest, texts))

    def rendered(self, tokenizer: PreTrainedTokenizerBase, **shown: Any) -> Split:
        """The split with its samples rendered; `shown` is given to `render_sample`."""
        known = tokenizer, self.vocabulary
        samples = [
            Sample(record["id"], render_sample(self.level, record, *known, **shown))
            for record in self.records
        ]
        return replace(self, samples=samples)

    def contradictions(self) -> Iterator[str]:
        """Records of the same input with different plans, however a task prompt is worded."""
        first: dict[str, Record] = {}
        for record, digest in zip(self.records, self.digests(), strict=True):
            known = first.setdefault(digest, record)
            if _labels(self.level, known) != _labels(self.level, record):
                same = f"{known['id']} and {record['id']} are the same input with different plans"
                yield f"{self.path}: {same}; keep the right one"

    def _extended(self, records: list[Record], digest: str | None = None) -> Split:
        """The split with more records behind its own; its digest covers theirs."""
        theirs = digest or "".join(map(compact_json, records))
        both = sha256_text(self.sha256 + theirs)
        return replace(self, sha256=both, records=[*self.records, *records])

    def corrected(self, path: Path, problems: list[str]) -> Split:
        """With the records of `path` (`review --harvest`); its faults are added to `problems`."""
        added = read_split(path, self.level, self.vocabulary, problems, known=self)
        return self._extended(added.records, added.sha256) if added else self

    def augmented(self, seed: int, count: int) -> Split:
        """With `count` records of the level's generator, which holds no curated and no test sample.
        Raises PlannerError for a vocabulary without templates.
        """
        from planner_ft.data.missions import sample_missions
        from planner_ft.data.task.sampler import sample_tasks

        seed += AUGMENT_SEED
        made = sample_missions(seed, count, self.vocabulary)
        if self.level == "task":
            made = sample_tasks(self.vocabulary, seed, count, "train")
        records = list(made)
        named = [{**record, "id": f"augment-{record['id']}"} for record in records]
        return self._extended(named, "".join(map(compact_json, records)))

    def multiplied(self, seed: int, vary: int, borrow: int, added: list[str]) -> Split:
        """With `vary` samples more for each record: `borrow` of them commands to the surface
        vehicle, as far as there are any, the others copies. What is added is noted in `added`.
        """
        lent = self.lent(seed, borrow * len(self.records)) if borrow else []
        copies = max(0, vary * len(self.records) - len(lent))
        split = self.varied(seed, vary, copies) if copies else self
        if count := len(split.records) - len(self.records):
            added.append(f"{count} of the training samples with other values")
        if borrow:
            ways_out = (
                "" if lent else f": see `like` and `prompt` in {self.vocabulary.name}{MISSIONS}"
            )
            added.append(f"{len(lent) or 'none'} of the training samples borrowed{ways_out}")
        return split._extended(lent) if lent else split

    def lent(self, seed: int, count: int) -> list[Record]:
        """At most `count` commands to the surface vehicle, translated for this one. Raises
        PlannerError at task level.
        """
        from planner_ft.data.borrowing import borrowed

        if self.level == "task":
            raise PlannerError("--borrow is for the mission level; --augment makes samples of both")
        return borrowed(self.vocabulary, count, seed)

    def varied(self, seed: int, count: int, most: int | None = None) -> Split:
        """With `count` copies of each record with other values where it has some, `most` in all;
        some go on with another record, are of several places, or lack words. Raises PlannerError
        at task level.
        """
        from planner_ft.data.recombining import at_several, joined
        from planner_ft.data.varying import varied, with_heading, with_lost_words

        if self.level == "task":
            raise PlannerError("--vary is for the mission level; --augment makes samples of both")
        made = []
        for number, record in itertools.product(range(1, count + 1), self.records):
            rng, new = Random(f"{seed} {number} {record['id']}"), record
            if rng.random() < SEVERAL:
                new = at_several(new, self.vocabulary, rng) or new
            if rng.random() < JOINED:
                others = rng.choices(self.records, k=PARTNERS)
                tried = (joined(new, other, self.vocabulary, rng) for other in others)
                new = next(filter(None, tried), new)
            new = varied(new, self.vocabulary, rng) or new
            if rng.random() < LOST:
                new = with_lost_words(new, rng) or new
            if rng.random() < HEADED:
                new = with_heading(new, rng)
            if new is not record:
                made.append({**new, "id": f"varied-{number}-{record['id']}"})
        return self._extended(made[:most])


def read_split(
    path: Path,
    level: Level,
    vocabulary: Vocabulary,
    problems: list[str],
    limit: int | None = None,
    known: Split | None = None,
) -> Split | None:
    """Read a JSONL file, at most `limit` records; None when it cannot be read at all. Everything
    wrong with it is added to `problems`, also ids that `known` holds already.
    """
    if not path.is_file():
        command = f"`plannerft gen-data --level {level}`"
        way_out = f"make the data with {command}, or give --data-dir or --train-file"
        what = "is a folder, and a file is needed" if path.is_dir() else f"no such file; {way_out}"
        problems.append(f"{path}: {what}")
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
    return Split(path, level, vocabulary, records, sha256_file(path))


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


def tests_within(splits: Sequence[Split]) -> dict[str, str]:
    """The known test sets that share inputs with the splits, and how many: "25 of 25"."""
    if not splits:
        return {}
    level, vocabulary = splits[0].level, splits[0].vocabulary
    used = {digest for split in splits for digest in split.digests()}
    found: dict[str, tuple[str, str]] = {}
    for path in known_tests(level, splits[0].path.parent, vocabulary):
        values = (value for _line, value, _problem in iterate_jsonl(path))
        records = [one for one in values if one and input_problem(one, level) is None]
        of_test = Split(path, level, vocabulary, records, sha256_file(path))
        if shared := sum(digest in used for digest in of_test.digests()):
            found.setdefault(of_test.sha256, (str(path), f"{shared} of {len(records)}"))
    return dict(found.values())


def tests_warnings(tests: Mapping[str, str]) -> list[str]:
    """A sentence for each test set whose inputs are trained on."""
    return [
        f"{count} inputs of {path} are in the training or validation data: figures that are"
        " measured on them say nothing about other commands"
        for path, count in tests.items()
    ]


def _labels(level: Level, record: Record) -> list[Record]:
    entries: list[Record] = record["expected"][list_key(level)]
    return [{key: one for key, one in entry.items() if key != "task_prompt"} for entry in entries]


def shortened(problems: Iterable[str]) -> list[str]:
    """The first problems, and how many more there are."""
    listed = list(problems)
    rest = len(listed) - SHOWN
    return listed if rest <= 0 else [*listed[:SHOWN], f"... and {rest} more of this kind"]


def preview_text(sample: Sample, tokenizer: PreTrainedTokenizerBase) -> Text:
    """The sample as the model sees it: prompt dim, completion green, special tokens reversed. The
    trained part stands in ⟦ ⟧, so that it shows without colour.
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
    for (mask, alone), run in itertools.groupby(range(len(ids)), key=kinds.__getitem__):
        if mask != trained:
            text.append("⟦" if mask else "⟧", "bold")
            trained = mask
        style = ("green" if mask else "dim") + ("" if alone is None else " reverse")
        tokens = [ids[position] for position in run]
        text.append(str(tokenizer.decode(tokens, clean_up_tokenization_spaces=False)), style)
    return text.append("⟧", "bold") if trained else text
