"""Precision, recall and F1 of counts."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Counts:
    """How many of the `predicted` items were among the `expected` ones (`right`)."""

    right: int
    predicted: int
    expected: int

    @property
    def precision(self) -> float:
        """right / predicted; nothing predicted is right only where nothing is expected."""
        return self.right / self.predicted if self.predicted else float(not self.expected)

    @property
    def recall(self) -> float:
        """right / expected; where nothing is expected, right is only to predict nothing."""
        return self.right / self.expected if self.expected else float(not self.predicted)

    @property
    def f1(self) -> float:
        """Harmonic mean of precision and recall (van Rijsbergen 1979), 2 right / (predicted +
        expected); 1 where nothing is expected and nothing predicted.
        """
        total = self.predicted + self.expected
        return 2 * self.right / total if total else 1.0
