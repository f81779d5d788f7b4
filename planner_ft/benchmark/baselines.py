"""What needs no model: the most frequent plan of the training split, and the plan of its most
similar command.

A candidate that does not beat them has learnt nothing from the training split that looking it up
would not give.
"""

from __future__ import annotations

import copy
import json
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.benchmark.results import System
from planner_ft.benchmark.retrieval import Index
from planner_ft.benchmark.samples import BenchData, Sample, load_bench_data
from planner_ft.prompts.text import user_text
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import DEFAULT
from planner_ft.vocabulary.plans import Level, list_key, step_skills

CONFIGURATION = "baseline"
MAJORITY, NEAREST = "majority plan", "nearest neighbour"
TRAIN = "train.jsonl"

Line = dict[str, Any]
Plan = dict[str, Any]


@dataclass(frozen=True)
class Baseline:
    """A baseline with its answers by sample id, as lines of predictions.jsonl."""

    system: System
    predictions: dict[str, Line]


@dataclass(frozen=True)
class Baselines:
    """The baselines of some test data, none where there is no training split for it; `notes` say
    what a reader must know.
    """

    found: tuple[Baseline, ...] = ()
    training: dict[str, Any] | None = None
    notes: tuple[str, ...] = ()


def make_baselines(data: BenchData, vocabulary: Vocabulary) -> Baselines:
    """Both baselines for the samples of `data`. They are not measured on the split that they are
    made from.
    """
    training, problem = find_training(data, vocabulary)
    if training is None:
        return Baselines(notes=(f"No baselines: {problem}.",))
    if training.sha256 == data.sha256:
        return Baselines(
            notes=(
                (
                    f"No baselines: {data.path} is the training split itself, and whatever was"
                    " trained on it has seen these samples."
                ),
            )
        )
    seen = {_normalised(data.level, sample, vocabulary) for sample in training.samples}
    known = sum(_normalised(data.level, sample, vocabulary) in seen for sample in data.samples)
    notes = [
        f"Baselines need no model and are made from {training.path} ({len(training.samples)}"
        " samples)."
    ]
    if known:
        notes.append(
            f"{known} of {len(data.samples)} test inputs stand in the training split, too: figures"
            " of whatever was trained on it are too high."
        )
    found = (_majority(data, training), _nearest(data, training, vocabulary))
    return Baselines(found, training.summary(), tuple(notes))


def find_training(data: BenchData, vocabulary: Vocabulary) -> tuple[BenchData | None, str]:
    """The training split that goes with test data: beside it, in data/LEVEL, or the package's; else
    None and why.
    """
    problem = (
        f"no training split of the {data.level} level; `plannerft gen-data --level {data.level}`"
        f" writes data/{data.level}/{TRAIN}"
    )
    for path in _places(data, vocabulary):
        if path.is_file():
            try:
                return load_bench_data(path, data.level, vocabulary), ""
            except PlannerError as error:
                problem = f"the training split cannot be used ({error})"
    return None, problem


def _places(data: BenchData, vocabulary: Vocabulary) -> Iterator[Path]:
    yield data.path.with_name(TRAIN)
    yield Path("data") / data.level / TRAIN
    if data.level == "mission" and vocabulary.name == DEFAULT:
        from planner_ft.data.curated import find_source

        yield find_source() / TRAIN


def _majority(data: BenchData, training: BenchData) -> Baseline:
    """The most frequent plan: at task level that of the same task, which the input names, or of all
    for a task without samples.
    """
    groups: dict[str | None, list[Sample]] = {}
    for sample in training.samples:
        groups.setdefault(_group(data.level, sample), []).append(sample)
    plans = {group: majority_plan(data.level, samples) for group, samples in groups.items()}
    fallback = majority_plan(data.level, training.samples)
    answers = {
        sample.id: plans.get(_group(data.level, sample), fallback) for sample in data.samples
    }
    return _baseline(MAJORITY, {name: _line(name, plan) for name, plan in answers.items()})


def majority_plan(level: Level, samples: Sequence[Sample]) -> Plan:
    """The first plan with the most frequent sequence of names; at each place the most frequent
    parameters that stand there in such plans.

    Of several that are equally frequent the first counts.
    """
    sequences = Counter(_sequence(level, sample.expected) for sample in samples)
    best = sequences.most_common(1)[0][0]
    like = [sample.expected for sample in samples if _sequence(level, sample.expected) == best]
    majority = copy.deepcopy(like[0])
    places = [_entries(level, plan) for plan in like]
    for place, entry in enumerate(_entries(level, majority)):
        entry["parameters"] = json.loads(
            Counter(
                compact_json(entries[place].get("parameters", {})) for entries in places
            ).most_common(1)[0][0]
        )
    return majority


def _nearest(data: BenchData, training: BenchData, vocabulary: Vocabulary) -> Baseline:
    index = Index([user_text(data.level, sample.record, vocabulary) for sample in training.samples])
    neighbours = index.nearest(
        [user_text(data.level, sample.record, vocabulary) for sample in data.samples]
    )
    lines = {}
    for sample, (place, similarity) in zip(data.samples, neighbours, strict=True):
        neighbour = training.samples[place]
        lines[sample.id] = {
            **_line(sample.id, neighbour.expected),
            "neighbour": neighbour.id,
            "similarity": round(similarity, 4),
        }
    return _baseline(NEAREST, lines)


def _baseline(name: str, lines: dict[str, Line]) -> Baseline:
    return Baseline(
        System(name, CONFIGURATION, label=f"{name} (baseline)", is_baseline=True), lines
    )


def _line(name: str, plan: Plan) -> Line:
    return {"id": name, "output": compact_json(plan)}


def _group(level: Level, sample: Sample) -> str | None:
    return str(sample.record["task"]) if level == "task" else None


def _normalised(level: Level, sample: Sample, vocabulary: Vocabulary) -> str:
    return re.sub(r"\W+", " ", user_text(level, sample.record, vocabulary).lower()).strip()


def _sequence(level: Level, plan: Plan) -> tuple[Any, ...]:
    """Titles in order, or the names of each step with their roles."""
    if level == "mission":
        return tuple(task["title"] for task in plan[list_key(level)])
    return tuple(
        tuple((role, skill["name"]) for role, skill in step_skills(step))
        for step in plan[list_key(level)]
    )


def _entries(level: Level, plan: Plan) -> list[dict[str, Any]]:
    """The tasks, or the skills of all steps."""
    entries: list[dict[str, Any]] = plan[list_key(level)]
    return (
        entries
        if level == "mission"
        else [skill for step in entries for _role, skill in step_skills(step)]
    )
