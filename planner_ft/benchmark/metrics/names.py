"""Names of tasks and skills as sets and as multisets: of a plan, per name and per role.

Every predicted name counts, also outside the vocabulary; an answer that does not parse has none.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from planner_ft.benchmark.metrics.counts import Counts
from planner_ft.benchmark.metrics.entries import Entry


def set_counts(predicted: Iterable[str], expected: Iterable[str]) -> Counts:
    """Distinct names."""
    ours, theirs = set(predicted), set(expected)
    return Counts(len(ours & theirs), len(ours), len(theirs))


def set_f1(predicted: Iterable[str], expected: Iterable[str]) -> float:
    """The published F1, over the sets of names: 1.0 when both are empty, 0.0 when one is."""
    return set_counts(predicted, expected).f1


def multiset_counts(predicted: Iterable[str], expected: Iterable[str]) -> Counts:
    """Occurrences of names: of three expected Transits, one predicted is one right of three."""
    ours, theirs = Counter(predicted), Counter(expected)
    return Counts((ours & theirs).total(), ours.total(), theirs.total())


def counts_by_name(predicted: Iterable[str], expected: Iterable[str]) -> dict[str, Counts]:
    """Occurrences of each name of either plan."""
    ours, theirs = Counter(predicted), Counter(expected)
    both = ours & theirs
    return {name: Counts(both[name], ours[name], theirs[name]) for name in {**theirs, **ours}}


def counts_by_role(predicted: Iterable[Entry], expected: Iterable[Entry]) -> dict[str, Counts]:
    """Occurrences of names in each role that either plan has: a skill in another role than its own
    is wrong in both.
    """
    ours, theirs = _names_by_role(predicted), _names_by_role(expected)
    return {
        role: multiset_counts(ours.get(role, ()), theirs.get(role, ()))
        for role in {**theirs, **ours}
    }


def _names_by_role(entries: Iterable[Entry]) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for entry in entries:
        found.setdefault(entry.role, []).append(entry.name)
    return found
