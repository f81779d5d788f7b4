"""Whether a plan is right as a whole: names, order and parameters, all or nothing."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from itertools import groupby
from typing import Any

from planner_ft.benchmark.metrics.alignment import align
from planner_ft.benchmark.metrics.entries import Entry, plan_entries
from planner_ft.benchmark.metrics.exact_sequence import name_sequence
from planner_ft.benchmark.metrics.parameters import right_entries
from planner_ft.benchmark.metrics.validity import schema_valid
from planner_ft.benchmark.metrics.values import parameters_agree
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

Step = tuple[Entry, ...]


def parameters_right(
    level: Level, plan: dict[str, Any], expected: dict[str, Any], vocabulary: Vocabulary
) -> bool:
    """Of two plans with the same sequence of names, whether the parameters are right task by task,
    or step by step: the two targets of two Transits must not be swapped.
    """
    wanted, given = plan_entries(level, expected), plan_entries(level, plan)
    steps = zip(_steps(wanted), _steps(given), strict=True)
    return wanted == given or all(_step_right(level, *pair, vocabulary) for pair in steps)


def whole_plan_unordered(
    level: Level,
    plan: dict[str, Any] | None,
    expected: dict[str, Any],
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
    ours, theirs = (_alike(_steps(plan_entries(level, one))) for one in (expected, plan))
    return all(_matchable(level, steps, theirs[names], vocabulary) for names, steps in ours.items())


def _matchable(
    level: Level, expected: Sequence[Step], predicted: Sequence[Step], vocabulary: Vocabulary
) -> bool:
    """Whether each expected step has a right one of its own among as many predicted ones."""
    if len(expected) == 1:
        return _step_right(level, expected[0], predicted[0], vocabulary)
    from scipy.optimize import linear_sum_assignment

    right = [
        [_step_right(level, one, other, vocabulary) for other in predicted] for one in expected
    ]
    rows, columns = linear_sum_assignment(right, maximize=True)
    return all(right[row][column] for row, column in zip(rows, columns, strict=True))


def _step_right(level: Level, expected: Step, predicted: Step, vocabulary: Vocabulary) -> bool:
    """Whether two steps with the same names have the same parameters; names that stand twice in a
    step are aligned first.
    """
    given = {(entry.role, entry.name): entry.parameters for entry in predicted}
    if len(given) == len(predicted):
        return all(
            parameters_agree(
                level, entry.name, given[entry.role, entry.name], entry.parameters, vocabulary
            )
            for entry in expected
            if entry.stated
        )
    agreement = right_entries(level, align(level, expected, predicted, vocabulary), vocabulary)
    return agreement.right == agreement.matched


def _steps(entries: Sequence[Entry]) -> list[Step]:
    return [tuple(group) for _step, group in groupby(entries, key=lambda entry: entry.step)]


def _alike(steps: Sequence[Step]) -> dict[tuple[str, ...], list[Step]]:
    """Steps by their names and roles."""
    found: dict[tuple[str, ...], list[Step]] = defaultdict(list)
    for step in steps:
        found[tuple(sorted(f"{entry.role} {entry.name}" for entry in step))].append(step)
    return found
