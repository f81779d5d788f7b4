"""Edit distance between sequences of names."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

from rapidfuzz.distance import Levenshtein


def edit_distance(predicted: Sequence[Hashable], expected: Sequence[Hashable]) -> float:
    """Levenshtein distance (1966) over whole names or steps, over the longer length: 0.0 for equal
    sequences, two empty ones included; 1.0 where nothing agrees, so also where one is empty.
    """
    return Levenshtein.normalized_distance(predicted, expected)
