"""Making the data sets: `generate` writes both levels with card, leakage report and manifest."""

import itertools
import shlex
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.data.curated import curated_folder, curated_splits, find_source
from planner_ft.data.leakage import forms, leakage_report
from planner_ft.data.missions import sample_missions
from planner_ft.data.output import Generated, dataset_card, lines_of, write_sets
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.data.validation import canonical_record
from planner_ft.support import files
from planner_ft.support.errors import PlannerError
from planner_ft.support.manifest import build_manifest
from planner_ft.support.resources import uncollected
from planner_ft.support.terminal import Report, silent
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.definition import DEFAULT
from planner_ft.vocabulary.plans import LEVELS, Level, plan_problems

TASKS = {"train": 10_000, "validation": 500, "test": 500, "test_unseen": 500}
"""The published sizes of the splits at task level."""
SYNTHETIC = "mission-synthetic"
"""The set of synthetic missions, beside the curated one."""
ABOUT = "labelling.md"
"""Beside a curated set: how it was labelled, for its card."""

Record = dict[str, Any]
Messages = Callable[[Level, Record, Vocabulary], list[dict[str, str]]]


@dataclass(frozen=True)
class GenerationSettings:
    """What to generate. None is the published count; `source` the folder of the curated set."""

    level: str = "all"
    out: Path = Path("data")
    seed: int = 0
    train: int | None = None
    validation: int | None = None
    test: int | None = None
    vocabulary: str = "usv"
    source: Path | None = None
    overwrite: bool = False
    chat: bool = False
    synthetic: int | None = None
    """Records of the synthetic mission set, which lies beside the curated one; None makes none."""

    def __post_init__(self) -> None:
        if self.level not in (*LEVELS, "all"):
            raise PlannerError(f"--level {self.level}: must be {', '.join(LEVELS)} or all")
        for flag in ("train", "validation", "test", "synthetic"):
            count = getattr(self, flag)
            if count is not None and count < 1:
                raise PlannerError(f"--{flag} {count}: at least one record is needed")
        if self.synthetic and self.level == "task":
            raise PlannerError(f"--synthetic {self.synthetic}: it belongs to the mission level")
        if self.seed < 0:
            raise PlannerError(f"--seed {self.seed}: must be 0 or more")

    @property
    def levels(self) -> tuple[Level, ...]:
        return tuple(level for level in LEVELS if self.level in (level, "all"))

    def counts(self, level: Level) -> dict[Any, int | None]:
        """Records asked for, by split; None where no flag says it."""
        asked = {"train": self.train, "validation": self.validation, "test": self.test}
        return {**asked, "test_unseen": self.test} if level == "task" else asked


def generate(
    settings: GenerationSettings, progress: Report = silent, messages: Messages | None = None
) -> list[Generated]:
    """Generate, check and write the data of each level; `messages` turns a record into the chat
    form that `chat` asks for.

    Nothing is written before everything is made, and existing files that would change are kept
    unless `overwrite` is set. Raises PlannerError when the curated source is faulty, counts cannot
    be met, or the folder cannot be written.
    """
    vocabulary = load_vocabulary(settings.vocabulary)
    files.check_writable(settings.out)
    curated = settings.source or curated_folder(vocabulary)
    sets: list[str] = [
        level for level in settings.levels if level == "task" or not settings.synthetic or curated
    ]
    sets += [SYNTHETIC] if settings.synthetic else []
    chat = messages if settings.chat else None
    made = [_make(name, settings, vocabulary, progress, chat) for name in sets]
    started = time.perf_counter()
    write_sets(made, overwrite=settings.overwrite)
    made[-1].seconds["writing"] = time.perf_counter() - started
    return made


def _make(
    name: str,
    settings: GenerationSettings,
    vocabulary: Vocabulary,
    progress: Report,
    messages: Messages | None,
) -> Generated:
    """One set: "mission", "task" or the synthetic missions."""
    level: Level = "task" if name == "task" else "mission"
    source = find_source(settings.source, vocabulary) if name == "mission" else None
    made, started = Generated(level, settings.out / name, source), time.perf_counter()

    def timed(stage: str) -> None:
        made.seconds[stage] = time.perf_counter() - started - sum(made.seconds.values())

    if source is None:
        splits, seed = _sampled(name, settings, vocabulary, progress), settings.seed
        timed("sampling and validation")
    else:
        ours, seed = settings.source is None or vocabulary.name == DEFAULT, None
        audit = vocabulary.bundled and ours
        splits = curated_splits(source, settings.counts("mission"), vocabulary, audit=audit)
        timed("validation and audit")
    leakage, labelling = None, ""
    for split, records in splits.items():
        lines = (canonical_record(level, record, vocabulary) for record in records)
        made.counts[split], made.texts[f"{split}.jsonl"] = len(records), lines_of(lines)
    if name != SYNTHETIC:
        leakage = leakage_report(level, splits, lambda step: progress(f"{level}: {step}", 0, 0))
        made.texts["leakage.json"] = files.indented_json(leakage)
        timed("leakage report")
    if source and (source / ABOUT).is_file():
        labelling = files.read_text(source / ABOUT).strip()
    about = level, splits, vocabulary, leakage, seed, labelling
    command, told = _command(name, settings), messages is not None
    made.texts["README.md"] = dataset_card(*about, command=command, chat=told)
    for split, records in splits.items():
        if messages is None:
            break
        chats = ((record["id"], messages(level, record, vocabulary)) for record in records)
        made.texts[f"chat/{split}.jsonl"] = lines_of(itertools.starmap(_chat, chats))
    timed("card and serialisation")
    configuration: dict[str, Any] = {
        "level": level,
        "counts": made.counts,
        "vocabulary": vocabulary.name,
        "vocabulary_sha256": vocabulary.sha256,
        "chat": told,
    }
    if name == "task":
        configuration["phrases_sha256"] = files.sha256_text(files.compact_json(vocabulary.phrases))
    elif name == SYNTHETIC:
        configuration["synthetic"] = settings.synthetic
    inputs: dict[str, Path | str] = {}
    if source:
        inputs = {split: source / f"{split}.jsonl" for split in splits}
    made.manifest = build_manifest("data", seed=seed, configuration=configuration, inputs=inputs)
    return made


def _command(name: str, settings: GenerationSettings) -> str:
    """The command that makes a set, with all options given that its files depend on."""
    flags = ["synthetic"] if name == SYNTHETIC else ["train", "validation", "test"]
    flags += ["vocabulary", "source" if name == "mission" else "seed"]
    words = ["plannerft", "gen-data", "--level", "task" if name == "task" else "mission"]
    for flag in flags:
        value = getattr(settings, flag)
        if value != getattr(GenerationSettings, flag):
            words += [f"--{flag}", str(value)]
    return shlex.join([*words, *(["--chat"] if settings.chat else [])])


def _chat(id_: str, chat: list[dict[str, str]]) -> str:
    """For other trainers: all messages, and the answer apart from what comes before it."""
    parts = {"prompt": chat[:-1], "completion": chat[-1:]}
    return files.compact_json({"id": id_, "messages": chat, **parts})


def _sampled(
    name: str, settings: GenerationSettings, vocabulary: Vocabulary, progress: Report
) -> dict[str, list[Record]]:
    splits: dict[str, list[Record]] = {}
    train: set[str] = set()
    synthetic = name == SYNTHETIC
    asked: dict[Any, int | None] = settings.counts("task")
    asked = {"train": settings.synthetic} if synthetic else asked
    with uncollected():  # Samples have no cycles, and there are thousands of parsed templates.
        for split, number in asked.items():
            count = number or TASKS[split]
            records = splits[split] = []
            samples = (
                sample_missions(settings.seed, count, vocabulary)
                if synthetic
                else sample_tasks(vocabulary, settings.seed, count, split, apart=train)
            )
            for record in samples:
                if synthetic and (
                    found := plan_problems("mission", record["expected"], vocabulary, strict=True)
                ):
                    raise PlannerError(f"--synthetic: {record['family']}: {found[0]}")
                records.append(record)
                if len(records) % 100 == 0 or len(records) == count:
                    progress(f"{name}: {split}", len(records), count)
            if split == "train" and not synthetic:
                train = {form for record in records for form in forms(record["prompt"])}
    return splits
