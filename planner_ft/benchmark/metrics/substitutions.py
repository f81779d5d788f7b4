"""Which name stands where another one was expected."""

from __future__ import annotations

from collections.abc import Sequence

from planner_ft.benchmark.metrics.alignment import Alignment, Pair

Substitution = tuple[str | None, str | None]
"""(expected name, predicted name); None where nothing stands for it."""


def substitutions(alignment: Alignment) -> list[Substitution]:
    """Unaligned entries in pairs: a predicted one stands for an expected one of its role that has
    the same aligned neighbours before and after, or one of them (a plan's beginning and end count
    as neighbours). The rest was omitted (no predicted name) or added (no expected one).
    """
    expected, predicted = alignment.expected, alignment.predicted
    ours = _neighbours(alignment.pairs, len(expected), 0)
    theirs = _neighbours(alignment.pairs, len(predicted), 1)
    free = list(alignment.extra)
    found: dict[int, int] = {}
    for shared in (2, 1):
        for index in (index for index in alignment.missing if index not in found):
            for other in free:
                same_role = predicted[other].role == expected[index].role
                if same_role and len(ours[index] & theirs[other]) == shared:
                    found[index] = other
                    free.remove(other)
                    break
    named: list[Substitution] = [
        (expected[index].name, predicted[found[index]].name if index in found else None)
        for index in alignment.missing
    ]
    return named + [(None, predicted[other].name) for other in free]


def _neighbours(pairs: Sequence[Pair], size: int, side: int) -> list[set[tuple[str, int]]]:
    """For each entry of one side, the numbers of the aligned pairs next to it, before and after."""
    number = {pair[side]: index for index, pair in enumerate(pairs)}
    found: list[set[tuple[str, int]]] = [set() for _ in range(size)]
    for way, order in (("before", range(size)), ("after", range(size - 1, -1, -1))):
        last = -1
        for index in order:
            found[index].add((way, last))
            last = number.get(index, last)
    return found
