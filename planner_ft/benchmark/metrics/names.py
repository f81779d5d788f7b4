"""Names of tasks and skills, as sets and as multisets, of a plan, per name and per role.

Scorers differ in what they leave out, and each omission flatters: a class list taken from the
expected names never counts an invented name, a set drops repetitions, a sample that does not parse
is skipped. Here every predicted name counts.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from planner_ft.benchmark.metrics.counts import Counts
from planner_ft.benchmark.metrics.entries import Entry


def set_counts(predicted: Iterable[str], expected: Iterable[str]) -> Counts:
    """Distinct names: what the published F1 is computed of."""
    ours, theirs = set(predicted), set(expected)
    return Counts(len(ours & theirs), len(ours), len(theirs))


def multiset_counts(predicted: Iterable[str], expected: Iterable[str]) -> Counts:
    """Occurrences of names: of three expected Transits, one predicted is one right of three."""
    ours, theirs = Counter(predicted), Counter(expected)
    return Counts(
        sum(min(count, theirs[name]) for name, count in ours.items()), ours.total(), theirs.total()
    )


def counts_by_name(predicted: Iterable[str], expected: Iterable[str]) -> dict[str, Counts]:
    """Occurrences of each name of either plan, names outside the vocabulary included."""
    ours, theirs = Counter(predicted), Counter(expected)
    return {
        name: Counts(min(ours[name], theirs[name]), ours[name], theirs[name])
        for name in {**theirs, **ours}
    }


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
