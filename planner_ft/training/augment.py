"""Synthetic samples beside those of the training file: `train --augment N`.

At mission level they come from the generator of commands, at task level from the training families
of the sampler. Neither holds a curated sample, nor anything that a test split holds.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import Any

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, sha256_text
from planner_ft.training.samples import Record, Split
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

SEED = 7_000_000
"""Far from the seeds of `gen-data`, so that no synthetic data set written with small seeds holds
the same samples.
"""


def synthetic_records(
    level: Level, vocabulary: Vocabulary, seed: int, count: int
) -> Iterator[dict[str, Any]]:
    """`count` records of the level's generator. Raises PlannerError for a vocabulary that it does
    not speak of.
    """
    if level == "task":
        from planner_ft.data.task.sampler import sample_tasks

        yield from sample_tasks(vocabulary, SEED + seed, count, "train")
        return
    from planner_ft.data.mission.synthetic import sample_missions

    for record in itertools.islice(sample_missions(SEED + seed), count):
        unknown = [
            task["title"]
            for task in record["expected"]["tasks"]
            if task["title"] not in vocabulary.task
        ]
        if unknown:
            raise PlannerError(
                f"--augment: the generator of commands plans {unknown[0]}, which the vocabulary"
                f" {vocabulary.name} does not have; leave it out"
            )
        yield record


def augmented(split: Split, level: Level, vocabulary: Vocabulary, seed: int, count: int) -> Split:
    """The split with `count` synthetic records after its own; its digest covers them."""
    made = list(synthetic_records(level, vocabulary, seed, count))
    digest = sha256_text(split.sha256 + "".join(compact_json(record) for record in made))
    last = max((record.line for record in split.records), default=0)
    records = [
        Record(last + number, {**record, "id": f"augment-{record['id']}"})
        for number, record in enumerate(made, start=1)
    ]
    return Split(split.path, digest, [*split.records, *records])
