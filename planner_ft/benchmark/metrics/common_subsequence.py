"""Longest common subsequence of two plans: what is right and in the right order, whatever stands
between.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence

from planner_ft.benchmark.metrics.counts import Counts


def common_subsequence(predicted: Sequence[Hashable], expected: Sequence[Hashable]) -> Counts:
    """Its length beside those of the two sequences; the F1 is ROUGE-L with beta 1 (Lin 2004) over
    names instead of words.
    """
    if predicted == expected:
        return Counts(len(expected), len(predicted), len(expected))
    row = [0] * (len(expected) + 1)
    for one in predicted:
        diagonal = 0
        for column, other in enumerate(expected, 1):
            diagonal, row[column] = (
                row[column],
                (diagonal + 1 if one == other else max(row[column], row[column - 1])),
            )
    return Counts(row[-1], len(predicted), len(expected))
