"""Is an answer right as a whole, and how is a wrong one wrong (the published failure kinds)?"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Mapping
from itertools import groupby
from typing import Any, Literal, get_args

from planner_ft.benchmark.metrics.alignment import Entry, align, plan_entries
from planner_ft.benchmark.metrics.names import exact_sequence, name_sequence
from planner_ft.benchmark.metrics.values import parameters_agree
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, list_key, named_entries, plan_problems
from planner_ft.vocabulary.replay import Stop, on_board, replay

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
PUBLISHED: dict[Failure, int] = dict(zip(FAILURES, (4, 2, 2, 1), strict=False))
"""Failures of the published mission agent in 25 answers; of the other kinds there was none."""
Plan = dict[str, Any]
Step = tuple[Entry, ...]


def schema_valid(level: Level, plan: Plan | None, vocabulary: Vocabulary) -> bool:
    """Whether an answer has a plan's structure, as published (LEVEL.schema.json)."""
    return plan is not None and not plan_problems(level, plan, vocabulary, strict=False)


def strict_valid(level: Level, plan: Plan | None, vocabulary: Vocabulary) -> bool:
    """Whether names, roles, types and ranges are the vocabulary's (LEVEL.strict.schema.json)."""
    return plan is not None and not plan_problems(level, plan, vocabulary, strict=True)


def invented_names(level: Level, plan: Plan | None, vocabulary: Vocabulary) -> list[str]:
    """Names of the plan that are not in the vocabulary, in order."""
    known = vocabulary.task if level == "mission" else vocabulary.skill
    return [entry.name for entry in plan_entries(level, plan) if entry.name not in known]


def refuses(level: Level, plan: Plan | None) -> bool:
    """Whether an answer is a plan without entries; one that does not parse refuses nothing."""
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
        # Task by task, or step by step: the two targets of two Transits must not be swapped.
        steps = zip(_steps(level, expected), _steps(level, plan), strict=True)
        right = all(_step_right(level, *pair, vocabulary) for pair in steps)
        return None if right else "parameter propagation"
    predicted, wanted = list(named_entries(level, plan)), list(named_entries(level, expected))
    ours, theirs = (Counter(name for name, _ in entries) for entries in (predicted, wanted))
    missing, added, nowhere = theirs - ours, ours - theirs, list(vocabulary.unresolved)
    unresolved = Counter(name for name, values in predicted if nowhere in values.values())
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
    level: Level, plan: Plan | None, expected: Plan, vocabulary: Vocabulary
) -> bool:
    """Whether a valid answer has the right tasks, or whole steps, as expected, in any order."""
    if plan is None or not schema_valid(level, plan, vocabulary):
        return False
    if sorted(name_sequence(level, plan)) != sorted(name_sequence(level, expected)):
        return False
    from scipy.optimize import linear_sum_assignment

    ours, theirs = (_alike(level, one) for one in (expected, plan))
    for names, steps in ours.items():
        right = [
            [_step_right(level, one, other, vocabulary) for other in theirs[names]] for one in steps
        ]
        pairs = zip(*linear_sum_assignment(right, maximize=True), strict=True)
        if not all(right[row][column] for row, column in pairs):
            return False
    return True


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


def _alike(level: Level, plan: Plan) -> dict[tuple[str, ...], list[Step]]:
    """A plan's steps by their names and roles."""
    found: dict[tuple[str, ...], list[Step]] = defaultdict(list)
    for step in _steps(level, plan):
        found[tuple(sorted(f"{entry.role} {entry.name}" for entry in step))].append(step)
    return found


def executable(
    plan: Mapping[str, Any] | None, expected: Mapping[str, Any], vocabulary: Vocabulary
) -> Stop | None:
    """Where the vehicle, carrying a mission answer out task by task, stops, or None when it runs to
    its end, which need not be the one that was asked for (`vocabulary.replay`).

    Data that the expected plan sends or reports without collecting it is on board from before and
    given to the answer, too. An answer that does not parse, and one without tasks where tasks are
    expected, is no plan and stops at once: refusing everything is not executable.
    """
    entries = plan.get("tasks") if plan else None
    if not isinstance(entries, list) or (not entries and expected["tasks"]):
        reason = "the answer does not parse" if plan is None else "nothing is planned"
        return Stop(0, "", "plan given", reason)
    return replay(plan or {}, vocabulary, on_board(expected, vocabulary))
