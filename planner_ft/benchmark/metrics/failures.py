"""Whether an answer is right as a whole, and the kind of failure of a wrong one, as the published
robustness analysis classified them.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence
from itertools import groupby
from typing import Any, Literal, get_args

from planner_ft.benchmark.metrics.alignment import Entry, align, plan_entries
from planner_ft.benchmark.metrics.names import exact_sequence, name_sequence
from planner_ft.benchmark.metrics.values import parameters_agree
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, list_key, named_entries, plan_problems

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

Plan = dict[str, Any]
Step = tuple[Entry, ...]


def schema_valid(level: Level, plan: Plan | None, vocabulary: Vocabulary) -> bool:
    """Whether an answer parsed and has the structure of a plan of this level
    (`schemas/LEVEL.schema.json`). The published definition: an invented name can be schema-valid.
    """
    return plan is not None and not plan_problems(level, plan, vocabulary, strict=False)


def strict_valid(level: Level, plan: Plan | None, vocabulary: Vocabulary) -> bool:
    """Whether an answer is schema-valid and every name, role, parameter name, type and range is of
    the vocabulary (`schemas/LEVEL.strict.schema.json`).
    """
    return plan is not None and not plan_problems(level, plan, vocabulary, strict=True)


def invented_names(level: Level, plan: Plan | None, vocabulary: Vocabulary) -> list[str]:
    """Names of the plan that are not in the vocabulary, in order."""
    known = vocabulary.task if level == "mission" else vocabulary.skill
    return [entry.name for entry in plan_entries(level, plan) if entry.name not in known]


def refuses(level: Level, plan: Plan | None) -> bool:
    """Whether an answer is a plan without entries. An output that does not parse refuses nothing: a
    model that breaks down is not praised for caution.
    """
    return plan is not None and plan.get(list_key(level)) == []


def failure_kind(
    level: Level,
    plan: Plan | None,
    expected: Plan,
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
        right = _parameters_right(level, plan, expected, vocabulary)
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
        pairs = zip(predicted, wanted, strict=False)
        # Something is planned after the first expected name that is missing.
        goes_on = not added and any(one[0] != other[0] for one, other in pairs)
        unlocated = vocabulary.locate in missing and bool(unresolved)
        if level == "mission" and (unlocated or goes_on):
            return "prerequisite omission"
        return "substitution" if added else "omission"
    if added:
        return "extra step" if added - unresolved else "parameter propagation"
    return "wrong order"


def whole_plan_unordered(
    level: Level,
    plan: Plan | None,
    expected: Plan,
    vocabulary: Vocabulary,
    *,
    valid: bool | None = None,
) -> bool:
    """Whether the answer has the right tasks, or steps, with the right parameters, in any order.

    Skills that run in one step must stand in one step. An answer that is not schema-valid is never
    right; `valid` says whether it is, where that is known.
    """
    if plan is None or not (schema_valid(level, plan, vocabulary) if valid is None else valid):
        return False
    if sorted(name_sequence(level, plan)) != sorted(name_sequence(level, expected)):
        return False
    from scipy.optimize import linear_sum_assignment

    ours, theirs = (_alike(_steps(level, one)) for one in (expected, plan))
    for names, steps in ours.items():
        right = [
            [_step_right(level, one, other, vocabulary) for other in theirs[names]] for one in steps
        ]
        pairs = zip(*linear_sum_assignment(right, maximize=True), strict=True)
        if not all(right[row][column] for row, column in pairs):
            return False
    return True


def _parameters_right(level: Level, plan: Plan, expected: Plan, vocabulary: Vocabulary) -> bool:
    """Of two plans with the same sequence of names, whether the parameters are right task by task,
    or step by step: the two targets of two Transits must not be swapped.
    """
    steps = zip(_steps(level, expected), _steps(level, plan), strict=True)
    return all(_step_right(level, *pair, vocabulary) for pair in steps)


def _step_right(level: Level, expected: Step, predicted: Step, vocabulary: Vocabulary) -> bool:
    """Whether two steps with the same names have the same parameters."""
    pairs = align(level, expected, predicted, vocabulary).matched()
    return all(
        parameters_agree(level, ours.name, theirs.parameters, ours.parameters, vocabulary)
        for ours, theirs in pairs
        if ours.stated
    )


def _steps(level: Level, plan: Plan) -> list[Step]:
    entries = plan_entries(level, plan)
    return [tuple(group) for _step, group in groupby(entries, key=lambda entry: entry.step)]


def _alike(steps: Sequence[Step]) -> dict[tuple[str, ...], list[Step]]:
    """Steps by their names and roles."""
    found: dict[tuple[str, ...], list[Step]] = defaultdict(list)
    for step in steps:
        found[tuple(sorted(f"{entry.role} {entry.name}" for entry in step))].append(step)
    return found
