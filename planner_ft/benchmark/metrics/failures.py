"""The kind of failure of a wrong answer, as the published robustness analysis classified them."""

from __future__ import annotations

from collections import Counter
from typing import Any, Literal, get_args

from planner_ft.benchmark.metrics.exact_sequence import exact_sequence
from planner_ft.benchmark.metrics.hallucination import invented_names
from planner_ft.benchmark.metrics.validity import schema_valid
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
        right = parameters_right(level, plan, expected, vocabulary)
        return None if right else "parameter propagation"
    predicted, wanted = list(named_entries(level, plan)), list(named_entries(level, expected))
    ours, theirs = (Counter(name for name, _ in entries) for entries in (predicted, wanted))
    missing, added = theirs - ours, ours - theirs
    unresolved = Counter(
        name
        for name, parameters in predicted
        if any(value == list(vocabulary.unresolved) for value in parameters.values())
    )
    if missing:
        if level == "mission" and (
            (vocabulary.locate in missing and unresolved)
            or (not added and _goes_on(predicted, wanted))
        ):
            return "prerequisite omission"
        return "substitution" if added else "omission"
    if added:
        return "extra step" if added - unresolved else "parameter propagation"
    return "wrong order"


def _goes_on(predicted: list[Entry], wanted: list[Entry]) -> bool:
    """Whether something is planned after the first expected name that is missing."""
    return any(one[0] != other[0] for one, other in zip(predicted, wanted, strict=False))
