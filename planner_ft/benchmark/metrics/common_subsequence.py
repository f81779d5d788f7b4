"""Longest common subsequence: right entries in the right order, whatever is between."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

from rapidfuzz.distance import LCSseq

from planner_ft.benchmark.metrics.counts import Counts


def common_subsequence(predicted: Sequence[Hashable], expected: Sequence[Hashable]) -> Counts:
    """Its length beside those of the two sequences; the F1 is ROUGE-L with beta 1 (Lin 2004) over
    names instead of words.
    """
    return Counts(LCSseq.similarity(predicted, expected), len(predicted), len(expected))
