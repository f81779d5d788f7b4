"""One answer beside what was expected: what every metric of a sample is computed from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from planner_ft.benchmark.samples import Sample
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

Value = float | bool | None
"""A metric of one sample: None where the sample says nothing about it."""


@dataclass(frozen=True)
class Answer:
    """A sample with the plan that was answered; `plan` is None when the output is not one JSON object."""

    level: Level
    sample: Sample
    plan: dict[str, Any] | None
    vocabulary: Vocabulary

    @property
    def expected(self) -> dict[str, Any]:
        """The expected plan."""
        return self.sample.expected
