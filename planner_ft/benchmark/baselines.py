"""Systems without a model: the most frequent plan of the training split, and the plan of its most
similar command. A candidate that does not beat them has learnt no more than looking up would give.
"""

import copy
import functools
import itertools
import json
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from planner_ft.benchmark.samples import BenchData, Sample, load_bench_data
from planner_ft.data.leakage import input_digest
from planner_ft.prompts import user_text
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, list_key, step_skills

MAJORITY, NEAREST = "majority plan", "nearest neighbour"
TRAIN = "train.jsonl"
TOKEN = re.compile(r"\w+|[^\w\s]")
CHARACTERS = (3, 4, 5)  # lengths of the pieces of a word, its borders included
ROWS = 256  # queries that are compared at a time

Line = dict[str, Any]
Plan = dict[str, Any]


@dataclass(frozen=True)
class Baselines:
    """Answers by baseline and sample id, none without a training split; notes for the reader."""

    answers: dict[str, dict[str, Line]] = field(default_factory=dict)
    training: dict[str, Any] | None = None
    notes: tuple[str, ...] = ()


def make_baselines(data: BenchData, vocabulary: Vocabulary) -> Baselines:
    """Both baselines for the samples of `data`, unless that is the split they are made from."""
    try:
        training = _find_training(data, vocabulary)
    except PlannerError as error:
        return Baselines(notes=(f"No baselines: {error}.",))
    size = len(training.samples)
    notes = [f"Baselines need no model and are made from {training.path} ({size} samples)."]
    ours, theirs = (
        [user_text(data.level, sample.record, vocabulary) for sample in one.samples]
        for one in (data, training)
    )
    seen = set(map(input_digest, theirs))
    if known := sum(input_digest(text) in seen for text in ours):
        stand = f"{known} of {len(ours)} test inputs stand in the training split, too"
        notes.append(f"{stand}: figures of whatever was trained on it are too high.")
    similar: dict[str, Line] = {}
    for sample, (place, similarity) in zip(data.samples, nearest(ours, theirs), strict=True):
        neighbour = training.samples[place]
        found = {"neighbour": neighbour.id, "similarity": round(similarity, 4)}
        similar[sample.id] = _line(sample, neighbour.expected) | found
    answers = {MAJORITY: _majority(data, training), NEAREST: similar}
    return Baselines(answers, training.summary(), tuple(notes))


def _find_training(data: BenchData, vocabulary: Vocabulary) -> BenchData:
    """The training split beside the data, in data/LEVEL, or the package's. Raises PlannerError."""
    command = f"`plannerft gen-data --level {data.level}` writes data/{data.level}/{TRAIN}"
    problem = f"no training split of the {data.level} level; {command}"
    for path in filter(Path.is_file, _places(data, vocabulary)):
        try:
            found = load_bench_data(path, data.level, vocabulary)
        except PlannerError as error:
            problem = f"the training split cannot be used ({error})"
            continue
        if found.sha256 != data.sha256:
            return found
        itself = f"{data.path} is the training split itself"
        raise PlannerError(f"{itself}, and whatever was trained on it has seen these samples")
    raise PlannerError(problem)


def _places(data: BenchData, vocabulary: Vocabulary) -> Iterator[Path]:
    yield data.path.with_name(TRAIN)
    yield vocabulary.data / data.level / TRAIN
    if data.level == "mission" and vocabulary.bundled:
        from planner_ft.data.curated import find_source

        yield find_source(None, vocabulary) / TRAIN


def _majority(data: BenchData, training: BenchData) -> dict[str, Line]:
    """The most frequent plan, at task level of the task that the input names if it has samples."""
    groups: dict[Any, list[Sample]] = {}
    for sample in training.samples if data.level == "task" else ():
        groups.setdefault(sample.record.get("task"), []).append(sample)
    plans = {group: majority_plan(data.level, samples) for group, samples in groups.items()}
    fallback = majority_plan(data.level, training.samples)
    asked = ((sample, sample.record.get("task")) for sample in data.samples)
    return {sample.id: _line(sample, plans.get(task, fallback)) for sample, task in asked}


def majority_plan(level: Level, samples: Sequence[Sample]) -> Plan:
    """The first plan of the most frequent names, each place with the most frequent parameters."""
    sequences = [
        tuple((step, role, entry.get("title") or entry["name"]) for step, role, entry in entries)
        for entries in (_entries(level, sample.expected) for sample in samples)
    ]
    best = Counter(sequences).most_common(1)[0][0]
    like = [sample.expected for sample, one in zip(samples, sequences, strict=True) if one == best]
    majority = copy.deepcopy(like[0])
    places = [_entries(level, plan) for plan in like]
    for place, (_step, _role, entry) in enumerate(_entries(level, majority)):
        given = Counter(compact_json(entries[place][2].get("parameters", {})) for entries in places)
        entry["parameters"] = json.loads(given.most_common(1)[0][0])
    return majority


def _entries(level: Level, plan: Plan) -> list[tuple[int, str, dict[str, Any]]]:
    """The tasks, or the skills of all steps, with their step and role."""
    steps = enumerate(plan[list_key(level)])
    if level == "mission":
        return [(step, "task", entry) for step, entry in steps]
    return [(step, role, skill) for step, entry in steps for role, skill in step_skills(entry)]


def _line(sample: Sample, plan: Plan) -> Line:
    return {"id": sample.id, "output": compact_json(plan)}


def nearest(texts: Sequence[str], among: Sequence[str]) -> list[tuple[int, float]]:
    """For each text the index of the most similar one, the first of equals, and the cosine, by
    TF-IDF over words, pairs and pieces of words (Salton and Buckley 1988).
    """
    from sklearn.feature_extraction.text import TfidfVectorizer

    vectorizer = TfidfVectorizer(analyzer=features)
    matrix = vectorizer.fit_transform(among)
    queries, found = vectorizer.transform(texts), list[tuple[int, float]]()
    for start in range(0, len(texts), ROWS):
        # Rounded, because equal texts may differ in their last bit.
        similarity = (queries[start : start + ROWS] @ matrix.T).toarray().round(9)
        best = similarity.argmax(1).tolist()
        found += zip(best, similarity.max(1).tolist(), strict=True)
    return found


def features(text: str) -> list[str]:
    """The words of a text, their pieces, and pairs of them."""
    words = TOKEN.findall(text.lower())
    pairs = (f"{one} {other}" for one, other in itertools.pairwise(words))
    return [*itertools.chain.from_iterable(map(_pieces, words)), *pairs]


@functools.lru_cache(maxsize=65_536)
def _pieces(word: str) -> tuple[str, ...]:
    padded = f"<{word}>"
    spans = ((at, at + n) for n in CHARACTERS for at in range(len(padded) - n + 1))
    return (word, *(padded[start:end] for start, end in spans))
