"""Edit distance between sequences of names."""

from __future__ import annotations

from collections.abc import Hashable, Sequence


def edit_distance(predicted: Sequence[Hashable], expected: Sequence[Hashable]) -> float:
    """Levenshtein distance (1966) over whole names or steps, each insertion, deletion and
    substitution counting 1, over the longer length.

    0.0 for equal sequences, two empty ones included; 1.0 where nothing agrees, so also where one is
    empty.
    """
    if predicted == expected:
        return 0.0
    return levenshtein(predicted, expected) / max(len(predicted), len(expected))


def levenshtein(predicted: Sequence[Hashable], expected: Sequence[Hashable]) -> int:
    """The number of edits."""
    row = list(range(len(expected) + 1))
    for above, one in enumerate(predicted, 1):
        diagonal, row[0] = row[0], above
        for column, other in enumerate(expected, 1):
            diagonal, row[column] = (
                row[column],
                min(diagonal + (one != other), row[column] + 1, row[column - 1] + 1),
            )
    return row[-1]
