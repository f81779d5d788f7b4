"""F1 over the set of names: the published metric."""

from __future__ import annotations

from collections.abc import Iterable

from planner_ft.benchmark.metrics.names import set_counts


def set_f1(predicted: Iterable[str], expected: Iterable[str]) -> float:
    """F1 between the set of predicted and the set of expected names (task titles or skill names) of
    one sample.

    1.0 when both are empty, 0.0 when one is. Order and repetitions do not count; a name outside the
    vocabulary is a false positive like any other. An answer that does not parse predicts no names.
    """
    return set_counts(predicted, expected).f1
