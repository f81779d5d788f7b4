"""Parameters of aligned tasks or skills: entries that are all right, and F1 of keys and of
key-value pairs.
"""

from __future__ import annotations

from collections import Counter
from typing import NamedTuple

from planner_ft.benchmark.metrics.alignment import Alignment
from planner_ft.benchmark.metrics.names import Counts
from planner_ft.benchmark.metrics.values import agreeing_keys, known_parameters, parameters_agree
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level


class Agreement(NamedTuple):
    """Of the expected entries that the answer has, too (`matched`), how many have exactly the
    expected parameters.
    """

    right: int
    matched: int


class ParameterCounts(NamedTuple):
    """Keys, and key-value pairs, that are right, predicted and expected: in aligned entries, and in
    the whole plan, with the keys of missing and extra entries.
    """

    keys: Counts
    values: Counts
    keys_overall: Counts
    values_overall: Counts


def right_entries(level: Level, alignment: Alignment, vocabulary: Vocabulary) -> Agreement:
    """Aligned entries with the expected keys, every value agreeing in the form that the vehicle
    reads (`values_agree`). Expected entries without a `parameters` object are not compared.
    """
    right = [
        parameters_agree(level, ours.name, theirs.parameters, ours.parameters, vocabulary)
        for ours, theirs in alignment.matched()
        if ours.stated
    ]
    return Agreement(sum(right), len(right))


def parameter_counts(level: Level, alignment: Alignment, vocabulary: Vocabulary) -> ParameterCounts:
    """Counts of keys and of key-value pairs; values agree by their content ("5 min" is 300 s, a
    list of texts a set).

    Where the expected plan has entries and states no parameters at all, nothing is compared.
    """
    expected, predicted = alignment.expected, alignment.predicted
    compared = [
        (one.name, one.parameters, other.parameters)
        for one, other in alignment.matched()
        if one.stated
    ]
    keys = sum(len(ours.keys() & theirs.keys()) for _name, ours, theirs in compared)
    values = sum(
        len(agreeing_keys(level, name, theirs, ours, vocabulary)) for name, ours, theirs in compared
    )
    stated = sum(len(ours) for _name, ours, _theirs in compared)
    given = sum(len(theirs) for _name, _ours, theirs in compared)
    labelled = not expected or any(entry.stated for entry in expected)
    missing = sum(len(expected[index].parameters) for index in alignment.missing)
    extra = sum(len(predicted[index].parameters) for index in alignment.extra) if labelled else 0
    overall = given + extra, stated + missing
    return ParameterCounts(
        Counts(keys, given, stated),
        Counts(values, given, stated),
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
    for ours, theirs in alignment.matched():
        known = known_parameters(level, ours.name, vocabulary)
        agreeing = agreeing_keys(level, ours.name, theirs.parameters, ours.parameters, vocabulary)
        for key in ours.parameters:
            kind = known[key].type if key in known else "unknown"
            stated[kind] += 1
            right[kind] += key in agreeing
    return {kind: (right[kind], count) for kind, count in stated.items()}
