"""Parameters of aligned tasks or skills: entries all right, F1 of keys and key-value pairs."""

from __future__ import annotations

from collections import Counter
from typing import NamedTuple

from planner_ft.benchmark.metrics.alignment import Alignment
from planner_ft.benchmark.metrics.names import Counts
from planner_ft.benchmark.metrics.values import agreeing_keys, known_parameters, parameters_agree
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level


class Parameters(NamedTuple):
    """Of the expected entries that the answer has, too (`matched`), how many have exactly the
    expected parameters (`right`): every key, every value in the form that the vehicle reads. What
    is expected without a `parameters` object is not compared.

    Keys, and key-value pairs, that are right, predicted and expected, in aligned entries and in the
    whole plan, with the keys of missing and extra entries; values agree by their content there ("5
    min" is 300 s, a list of texts a set). Where the expected plan has entries and states no
    parameters at all, nothing is compared.

    `types` has per type of parameter (position, number, text ...) the expected values of aligned
    entries that the answer gives, and how many there are.
    """

    right: int
    matched: int
    keys: Counts
    values: Counts
    keys_overall: Counts
    values_overall: Counts
    types: dict[str, tuple[int, int]]


def compare_parameters(level: Level, alignment: Alignment, vocabulary: Vocabulary) -> Parameters:
    """The parameters of an answer beside the expected ones."""
    expected, predicted = alignment.expected, alignment.predicted
    pairs = [pair for pair in alignment.matched() if pair[0].stated]
    right, keys = 0, 0
    agreed, there = Counter[str](), Counter[str]()
    for ours, theirs in pairs:
        judged = level, ours.name, theirs.parameters, ours.parameters, vocabulary
        known, agreeing = known_parameters(level, ours.name, vocabulary), agreeing_keys(*judged)
        right += parameters_agree(*judged)
        keys += len(ours.parameters.keys() & theirs.parameters.keys())
        for key in ours.parameters:
            kind = known[key].type if key in known else "unknown"
            there[kind] += 1
            agreed[kind] += key in agreeing
    stated, given = (sum(len(pair[side].parameters) for pair in pairs) for side in (0, 1))
    labelled = not expected or any(entry.stated for entry in expected)
    missing = sum(len(expected[index].parameters) for index in alignment.missing)
    extra = sum(len(predicted[index].parameters) for index in alignment.extra) if labelled else 0
    types = {kind: (agreed[kind], count) for kind, count in there.items()}
    of_entries = Counts(keys, given, stated), Counts(agreed.total(), given, stated)
    sizes = given + extra, stated + missing
    overall = Counts(keys, *sizes), Counts(agreed.total(), *sizes)
    return Parameters(right, len(pairs), *of_entries, *overall, types)
