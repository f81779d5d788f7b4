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
    missing, extra = list(alignment.missing), list(alignment.extra)
    ours, theirs = (
        _neighbours(alignment.pairs, len(alignment.expected), 0),
        _neighbours(alignment.pairs, len(alignment.predicted), 1),
    )
    found: dict[int, int] = {}
    for shared in (2, 1):
        for index in missing:
            role = alignment.expected[index].role
            free = [
                other
                for other in extra
                if other not in found.values() and alignment.predicted[other].role == role
            ]
            partner = next(
                (other for other in free if len(ours[index] & theirs[other]) == shared), None
            )
            if index not in found and partner is not None:
                found[index] = partner
    named: list[Substitution] = [
        (
            alignment.expected[index].name,
            alignment.predicted[found[index]].name if index in found else None,
        )
        for index in missing
    ]
    return named + [
        (None, alignment.predicted[other].name) for other in extra if other not in found.values()
    ]


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
