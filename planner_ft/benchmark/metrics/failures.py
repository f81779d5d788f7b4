"""The kind of failure of a wrong answer, as the published robustness analysis classified them by
hand.
"""

from __future__ import annotations

from collections import Counter
from typing import Any, Literal, get_args

from planner_ft.benchmark.metrics.exact_sequence import exact_sequence
from planner_ft.benchmark.metrics.hallucination import invented_names
from planner_ft.benchmark.metrics.schema_valid import schema_valid
from planner_ft.benchmark.metrics.whole_plan import parameters_right
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, named_entries

Failure = Literal[
    "prerequisite omission",
    "parameter propagation",
    "substitution",
    "hallucination",
    "omission",
    "extra step",
    "wrong order",
    "invalid output",
]
FAILURES: tuple[Failure, ...] = get_args(Failure)
PUBLISHED: dict[Failure, int] = {
    "prerequisite omission": 4,
    "parameter propagation": 2,
    "substitution": 2,
    "hallucination": 1,
}
"""Failures of the published mission agent in 25 answers; of the other kinds there was none."""

Entry = tuple[str, dict[str, Any]]


def failure_kind(
    level: Level,
    plan: dict[str, Any] | None,
    expected: dict[str, Any],
    vocabulary: Vocabulary,
    *,
    valid: bool | None = None,
) -> Failure | None:
    """Why an answer is wrong, or None when names, order and parameters are all right; `valid` says
    whether it is schema-valid, where that is known.

    The first that holds:

    - invalid output: it does not parse, or is not schema-valid;
    - hallucination: a name outside the vocabulary;
    - parameter propagation: the right names in the right order, but a value lost, altered or
      invented;
    - prerequisite omission: the task that locates a target is missing and a place stays unresolved;
      or names are missing, none is added, and something is planned after the first that is missing
      (mission level);
    - substitution: expected names are missing and others of the vocabulary stand instead;
    - omission: names are missing, at the end or at task level;
    - extra step: names were added; where all of them hold the unresolved location it is parameter
      propagation;
    - wrong order: the right names in another order (or, at task level, in other steps or roles).
    """
    if plan is None or not (schema_valid(level, plan, vocabulary) if valid is None else valid):
        return "invalid output"
    if invented_names(level, plan, vocabulary):
        return "hallucination"
    if exact_sequence(level, plan, expected):
        return (
            None if parameters_right(level, plan, expected, vocabulary) else "parameter propagation"
        )
    predicted, wanted = list(named_entries(level, plan)), list(named_entries(level, expected))
    missing = Counter(name for name, _ in wanted) - Counter(name for name, _ in predicted)
    added = Counter(name for name, _ in predicted) - Counter(name for name, _ in wanted)
    if (
        missing
        and level == "mission"
        and _prerequisite(predicted, wanted, missing, added, vocabulary)
    ):
        return "prerequisite omission"
    if missing:
        return "substitution" if added else "omission"
    if added:
        return (
            "parameter propagation"
            if _all_unresolved(predicted, added, vocabulary)
            else "extra step"
        )
    return "wrong order"


def _prerequisite(
    predicted: list[Entry],
    wanted: list[Entry],
    missing: Counter[str],
    added: Counter[str],
    vocabulary: Vocabulary,
) -> bool:
    unresolved = any(_is_unresolved(parameters, vocabulary) for _name, parameters in predicted)
    if vocabulary.locate in missing and unresolved:
        return True
    if added:
        return False
    for position, (name, _parameters) in enumerate(wanted):
        if position == len(predicted):
            return False
        if predicted[position][0] != name:
            return True
    return False


def _all_unresolved(predicted: list[Entry], added: Counter[str], vocabulary: Vocabulary) -> bool:
    """Whether every added name can be told by an entry that holds the unresolved location."""
    spurious = Counter(
        name for name, parameters in predicted if _is_unresolved(parameters, vocabulary)
    )
    return not added - spurious


def _is_unresolved(parameters: dict[str, Any], vocabulary: Vocabulary) -> bool:
    return any(value == list(vocabulary.unresolved) for value in parameters.values())
