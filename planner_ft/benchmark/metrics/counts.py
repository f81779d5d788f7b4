"""Precision, recall and F1 of counts."""

from __future__ import annotations

from typing import NamedTuple


class Counts(NamedTuple):
    """How many of the `predicted` items were among the `expected` ones (`right`).

    Where nothing is expected, only to predict nothing is right.
    """

    right: int
    predicted: int
    expected: int

    @property
    def precision(self) -> float:
        return self.right / self.predicted if self.predicted else float(not self.expected)

    @property
    def recall(self) -> float:
        return self.right / self.expected if self.expected else float(not self.predicted)

    @property
    def f1(self) -> float:
        """Harmonic mean of precision and recall (van Rijsbergen 1979)."""
        total = self.predicted + self.expected
        return 2 * self.right / total if total else 1.0
