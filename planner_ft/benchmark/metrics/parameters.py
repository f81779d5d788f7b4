"""Parameters of aligned tasks or skills: entries that are all right, and F1 of keys and of
key-value pairs.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import Any

from planner_ft.benchmark.metrics.alignment import Alignment, align
from planner_ft.benchmark.metrics.counts import Counts
from planner_ft.benchmark.metrics.entries import plan_entries
from planner_ft.benchmark.metrics.values import (
    agreeing_keys,
    known_parameters,
    parameters_agree,
    values_agree,
)
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

__all__ = [
    "Agreement",
    "ParameterCounts",
    "agreement_by_type",
    "parameter_agreement",
    "parameter_counts",
    "right_entries",
    "values_agree",
]


@dataclass(frozen=True)
class Agreement:
    """Of the expected entries that the answer has, too (`matched`), how many have exactly the
    expected parameters.
    """

    right: int
    matched: int


@dataclass(frozen=True)
class ParameterCounts:
    """Keys, and key-value pairs, that are right, predicted and expected: in aligned entries, and in
    the whole plan, where the keys of a missing entry are lost and those of an extra one invented.
    """

    keys: Counts
    values: Counts
    keys_overall: Counts
    values_overall: Counts


def parameter_agreement(
    level: Level, plan: dict[str, Any] | None, expected: dict[str, Any], vocabulary: Vocabulary
) -> Agreement:
    """Align the entries of two plans and count those with the expected parameters
    (`right_entries`).
    """
    return right_entries(
        level,
        align(level, plan_entries(level, expected), plan_entries(level, plan), vocabulary),
        vocabulary,
    )


def right_entries(level: Level, alignment: Alignment, vocabulary: Vocabulary) -> Agreement:
    """Aligned entries with the expected keys, every value agreeing in the form that the vehicle
    reads (`values_agree`).

    Expected entries without a `parameters` object are not compared.
    """
    pairs = [
        (alignment.expected[ours], alignment.predicted[theirs])
        for ours, theirs in alignment.pairs
        if alignment.expected[ours].stated
    ]
    right = sum(
        parameters_agree(level, ours.name, theirs.parameters, ours.parameters, vocabulary)
        for ours, theirs in pairs
    )
    return Agreement(right, len(pairs))


def parameter_counts(level: Level, alignment: Alignment, vocabulary: Vocabulary) -> ParameterCounts:
    """Counts of keys and of key-value pairs; values agree by their content ("5 min" is 300 s, a
    list of texts a set).

    Where the expected plan has entries and states no parameters at all, nothing is compared.
    """
    expected, predicted = alignment.expected, alignment.predicted
    keys = values = ours_there = theirs_there = 0
    for one, other in alignment.pairs:
        stated, given = expected[one], predicted[other]
        if stated.stated:
            keys += len(stated.parameters.keys() & given.parameters.keys())
            values += len(
                agreeing_keys(level, stated.name, given.parameters, stated.parameters, vocabulary)
            )
            ours_there, theirs_there = (
                ours_there + len(stated.parameters),
                theirs_there + len(given.parameters),
            )
    labelled = not expected or any(entry.stated for entry in expected)
    lost = sum(len(expected[index].parameters) for index in alignment.missing)
    invented = sum(len(predicted[index].parameters) for index in alignment.extra) if labelled else 0
    there, overall = (theirs_there, ours_there), (theirs_there + invented, ours_there + lost)
    return ParameterCounts(
        Counts(keys, *there),
        Counts(values, *there),
        Counts(keys, *overall),
        Counts(values, *overall),
    )


def agreement_by_type(
    level: Level, alignment: Alignment, vocabulary: Vocabulary
) -> dict[str, tuple[int, int]]:
    """Per type of parameter (position, number, text ...): expected values of aligned entries that
    the answer gives, and how many there are.
    """
    right: Counter[str] = Counter()
    stated: Counter[str] = Counter()
    for one, other in alignment.pairs:
        ours, theirs = alignment.expected[one], alignment.predicted[other]
        known = known_parameters(level, ours.name, vocabulary)
        agreeing = set(
            agreeing_keys(level, ours.name, theirs.parameters, ours.parameters, vocabulary)
        )
        for key in ours.parameters:
            kind = known[key].type if key in known else "unknown"
            stated[kind] += 1
            right[kind] += key in agreeing
    return {kind: (right[kind], count) for kind, count in stated.items()}
