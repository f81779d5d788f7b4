"""Which predicted task or skill stands for which expected one: an optimal assignment over equal
names (Kuhn 1955, as scipy's linear_sum_assignment computes it).
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.benchmark.metrics.entries import TASK, Entry
from planner_ft.benchmark.metrics.values import agreeing_keys, parameters_agree
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

Pair = tuple[int, int]
Entries = tuple[Entry, ...]
Company = Callable[[int, int], float]

LEADING = (TASK, "navigation")
"""Roles of entries that are paired first: one of them makes a step."""
COMPANY, NEARNESS = 1e-2, 1e-4
"""Weights that decide between equals, over all pairs, beside 1 for a pair's parameters."""


@dataclass(frozen=True)
class Alignment:
    """Entries of an expected and a predicted plan. `pairs` are (expected, predicted) indices, in
    the order of the expected ones; `missing` are expected entries without a partner, `extra`
    predicted ones.
    """

    expected: Entries
    predicted: Entries
    pairs: tuple[Pair, ...]

    @property
    def missing(self) -> tuple[int, ...]:
        paired = {expected for expected, _predicted in self.pairs}
        return tuple(index for index in range(len(self.expected)) if index not in paired)

    @property
    def extra(self) -> tuple[int, ...]:
        paired = {predicted for _expected, predicted in self.pairs}
        return tuple(index for index in range(len(self.predicted)) if index not in paired)

    def to_json(self) -> dict[str, list[Any]]:
        """Indices into the entries of the expected and the predicted plan (`plan_entries`)."""
        pairs = [list(pair) for pair in self.pairs]
        return {"pairs": pairs, "missing": list(self.missing), "extra": list(self.extra)}


def align(level: Level, expected: Entries, predicted: Entries, vocabulary: Vocabulary) -> Alignment:
    """Pair as many entries of equal name as there are, each at most once, so that the sum of their
    likeness is greatest.

    Likeness counts, in this order: parameters that are all right; the share of key-value pairs that
    agree; the same company (tasks: the same neighbours; navigation skills: the same other skills in
    their step; other skills: a step whose navigation skill is paired with that of theirs); nearness
    in the plan. Roles do not count.
    """
    if expected == predicted:
        same = tuple((index, index) for index in range(len(expected)))
        return Alignment(expected, predicted, same)
    leading = {entry.name for entry in expected if entry.role in LEADING}
    others = {entry.name for entry in expected} - leading
    ours, theirs = _surroundings(expected), _surroundings(predicted)

    def beside(one: int, other: int) -> float:
        most = max(ours[one].total(), theirs[other].total(), 1)
        return (ours[one] & theirs[other]).total() / most

    def in_step(one: int, other: int) -> float:
        return float((expected[one].step, predicted[other].step) in steps)

    leads = _assigned(level, expected, predicted, leading, beside, vocabulary)
    steps = {(expected[one].step, predicted[other].step) for one, other in leads}
    rest = _assigned(level, expected, predicted, others, in_step, vocabulary)
    return Alignment(expected, predicted, tuple(sorted([*leads, *rest])))


def _surroundings(entries: Entries) -> list[Counter[str]]:
    """The neighbours of each entry: the titles before and after a task, the skills of a step."""
    if any(entry.role == TASK for entry in entries):
        names = ["", *(entry.name for entry in entries), ""]
        around = zip(names, names[2:], strict=False)
        return [Counter((f"after {before}", f"before {after}")) for before, after in around]
    steps: dict[int, Counter[str]] = defaultdict(Counter)
    for entry in entries:
        steps[entry.step][f"{entry.role} {entry.name}"] += 1
    return [steps[entry.step] for entry in entries]


def _assigned(
    level: Level,
    expected: Entries,
    predicted: Entries,
    names: set[str],
    company: Company,
    vocabulary: Vocabulary,
) -> list[Pair]:
    """The best pairs for each of these names."""
    ours, theirs = _by_name(expected, names), _by_name(predicted, names)
    size = max(len(expected), len(predicted))

    def weight(one: int, other: int) -> float:
        near = 1 - ((one - other) / size) ** 2
        likeness = _likeness(level, expected[one], predicted[other], size, vocabulary)
        return likeness + (COMPANY * company(one, other) + NEARNESS * near) / size

    pairs: list[Pair] = []
    for name, rows in ours.items():
        columns = theirs.get(name, [])
        if len(rows) == len(columns) == 1:
            pairs.append((rows[0], columns[0]))
        elif columns:
            best = _assignment([[weight(one, other) for other in columns] for one in rows])
            pairs += [(rows[row], columns[column]) for row, column in best]
    return pairs


def _likeness(level: Level, ours: Entry, theirs: Entry, size: int, vocabulary: Vocabulary) -> float:
    """Share of key-value pairs that agree (their F1), and more than all shares together where the
    parameters are all right.
    """
    stated, given = ours.parameters, theirs.parameters
    if not ours.stated:
        return 0.0
    if stated == given:
        return 1.0 + 2 * size
    agreeing = agreeing_keys(level, ours.name, given, stated, vocabulary)
    share = 2 * len(agreeing) / (len(stated) + len(given))
    right = share == 1.0 and parameters_agree(level, ours.name, given, stated, vocabulary)
    return share + 2 * size * right


def _assignment(weights: Sequence[Sequence[float]]) -> list[Pair]:
    """(row, column) pairs of the greatest sum."""
    if len(weights) == 1:
        return [(0, max(range(len(weights[0])), key=weights[0].__getitem__))]
    from scipy.optimize import linear_sum_assignment

    rows, columns = linear_sum_assignment(weights, maximize=True)
    return list(zip(rows.tolist(), columns.tolist(), strict=True))


def _by_name(entries: Entries, names: set[str]) -> dict[str, list[int]]:
    found: dict[str, list[int]] = defaultdict(list)
    for index, entry in enumerate(entries):
        if entry.name in names:
            found[entry.name].append(index)
    return found
