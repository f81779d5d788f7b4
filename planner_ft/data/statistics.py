"""Figures that describe a data set: coverage of the vocabulary, lengths, diversity."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from planner_ft.data.leakage import mask
from planner_ft.facts import words
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, list_key, plan_names, step_skills

Records = Sequence[Mapping[str, Any]]
Splits = Mapping[str, Records]
QUANTILES = (0, 50, 90, 100)


def name_counts(level: Level, records: Records) -> Counter[str]:
    """How often each task title, or skill name, stands in the expected plans."""
    return Counter(name for record in records for name in plan_names(level, record["expected"]))


def input_tasks(records: Records) -> Counter[str]:
    """How often each task is the input of a task-level record."""
    return Counter(str(record["task"]) for record in records)


def pairs(level: Level, record: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Mission level: titles that follow each other. Task level: skills that run at the same time,
    in alphabetical order.
    """
    if level == "mission":
        yield from itertools.pairwise(plan_names(level, record["expected"]))
        return
    for step in record["expected"]["skill_sequence"]:
        yield from itertools.combinations(
            sorted({str(skill["name"]) for _role, skill in step_skills(step)}), 2
        )


def pair_counts(level: Level, records: Records) -> Counter[tuple[str, str]]:
    """How often each pair occurs."""
    return Counter(pair for record in records for pair in pairs(level, record))


def possible_pairs(vocabulary: Vocabulary) -> int:
    """Skill pairs that can run at the same time: navigation with others, and others among
    themselves.
    """
    alone = len(vocabulary.skills_in_role("navigation"))
    beside = len(vocabulary.skills) - alone
    return alone * beside + beside * (beside - 1) // 2


def length_rows(level: Level, splits: Splits) -> list[tuple[str, str, list[int]]]:
    """(what is measured, split, minimum, median, 90th percentile, maximum)."""
    measures: dict[str, Callable[[Mapping[str, Any]], int]] = {
        "words in the prompt": lambda record: len(words(record["prompt"])),
        f"{'tasks' if level == 'mission' else 'steps'} in the plan": lambda record: len(
            record["expected"][list_key(level)]
        ),
        "characters in the plan": lambda record: len(compact_json(record["expected"])),
    }
    return [
        (
            what,
            split,
            [
                round(value)
                for value in np.percentile([measure(record) for record in records], QUANTILES)
            ],
        )
        for what, measure in measures.items()
        for split, records in splits.items()
        if records
    ]


def diversity(records: Records) -> dict[str, float]:
    """Families, phrasings (prompts without numbers and names), vocabulary size, type-token ratio
    and distinct-n of the prompts.

    distinct-n is the share of word n-grams that are different (Li et al. 2016); distinct-1 is the
    type-token ratio.
    """
    tokens = [words(str(record["prompt"])) for record in records]
    total = sum(map(len, tokens))
    figures: dict[str, float] = {
        "families": len({record.get("family") for record in records}),
        "phrasings": len({mask(str(record["prompt"])) for record in records}),
        "different words": len({word for text in tokens for word in text}),
        "type-token ratio": round(
            len({word for text in tokens for word in text}) / max(total, 1), 4
        ),
    }
    for size in (2, 3):
        grams = [
            tuple(text[start : start + size])
            for text in tokens
            for start in range(len(text) - size + 1)
        ]
        figures[f"distinct-{size}"] = round(len(set(grams)) / max(len(grams), 1), 4)
    return figures
