"""Systems without a model: the most frequent plan of the training split, and the plan of its most
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
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from planner_ft.benchmark.retrieval import Index
from planner_ft.benchmark.samples import BenchData, Sample, load_bench_data
from planner_ft.prompts.text import user_text
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import DEFAULT
from planner_ft.vocabulary.plans import Level, list_key, step_skills

MAJORITY, NEAREST = "majority plan", "nearest neighbour"
TRAIN = "train.jsonl"

Line = dict[str, Any]
Plan = dict[str, Any]


@dataclass(frozen=True)
class Baselines:
    """The answers of each baseline by sample id, none where there is no training split for the
    data; `notes` are for the reader.
    """

    answers: dict[str, dict[str, Line]] = field(default_factory=dict)
    training: dict[str, Any] | None = None
    notes: tuple[str, ...] = ()


def make_baselines(data: BenchData, vocabulary: Vocabulary) -> Baselines:
    """Both baselines for the samples of `data`. They are not measured on the split that they are
    made from.
    """
    training, problem = _find_training(data, vocabulary)
    if training is None:
        return Baselines(notes=(f"No baselines: {problem}.",))
    if training.sha256 == data.sha256:
        note = f"{data.path} is the training split itself, and whatever was trained on it has seen"
        return Baselines(notes=(f"No baselines: {note} these samples.",))
    size = len(training.samples)
    notes = [f"Baselines need no model and are made from {training.path} ({size} samples)."]
    ours, theirs = (
        [user_text(data.level, sample.record, vocabulary) for sample in one.samples]
        for one in (data, training)
    )
    seen = set(map(_normalised, theirs))
    if known := sum(_normalised(text) in seen for text in ours):
        notes.append(
            f"{known} of {len(ours)} test inputs stand in the training split, too: figures of"
            " whatever was trained on it are too high."
        )
    nearest: dict[str, Line] = {}
    for sample, (place, similarity) in zip(data.samples, Index(theirs).nearest(ours), strict=True):
        neighbour = training.samples[place]
        nearest[sample.id] = {
            **_line(sample, neighbour.expected),
            "neighbour": neighbour.id,
            "similarity": round(similarity, 4),
        }
    answers = {MAJORITY: _majority(data, training), NEAREST: nearest}
    return Baselines(answers, training.summary(), tuple(notes))


def _find_training(data: BenchData, vocabulary: Vocabulary) -> tuple[BenchData | None, str]:
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


def _majority(data: BenchData, training: BenchData) -> dict[str, Line]:
    """The most frequent plan: at task level that of the same task, which the input names, or of all
    for a task without samples.
    """
    groups: dict[Any, list[Sample]] = {}
    for sample in training.samples:
        groups.setdefault(sample.record.get("task"), []).append(sample)
    if data.level == "mission":
        groups = {}
    plans = {group: majority_plan(data.level, samples) for group, samples in groups.items()}
    fallback = majority_plan(data.level, training.samples)
    return {
        sample.id: _line(sample, plans.get(sample.record.get("task"), fallback))
        for sample in data.samples
    }


def majority_plan(level: Level, samples: Sequence[Sample]) -> Plan:
    """The first plan with the most frequent sequence of names; at each place the most frequent
    parameters that stand there in such plans. Of several that are equally frequent the first
    counts.
    """
    sequences = [_sequence(level, sample.expected) for sample in samples]
    best = Counter(sequences).most_common(1)[0][0]
    like = [sample.expected for sample, one in zip(samples, sequences, strict=True) if one == best]
    majority = copy.deepcopy(like[0])
    places = [_entries(level, plan) for plan in like]
    for place, entry in enumerate(_entries(level, majority)):
        given = Counter(compact_json(entries[place].get("parameters", {})) for entries in places)
        entry["parameters"] = json.loads(given.most_common(1)[0][0])
    return majority


def _line(sample: Sample, plan: Plan) -> Line:
    return {"id": sample.id, "output": compact_json(plan)}


def _normalised(text: str) -> str:
    return re.sub(r"\W+", " ", text.lower()).strip()


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
    if level == "mission":
        return entries
    return [skill for step in entries for _role, skill in step_skills(step)]
