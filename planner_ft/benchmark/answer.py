"""One answer beside what was expected: what every metric of a sample is computed from."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import Any

from planner_ft.benchmark.metrics.alignment import Alignment, align
from planner_ft.benchmark.metrics.entries import Entry, plan_entries
from planner_ft.benchmark.metrics.schema_valid import schema_valid
from planner_ft.benchmark.metrics.strict_valid import strict_valid
from planner_ft.benchmark.samples import Sample
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

Value = float | bool | None
"""A metric of one sample: None where the sample says nothing about it."""


@dataclass(frozen=True)
class Answer:
    """A sample with the plan that was answered; `plan` is None when the output is not one JSON
    object.

    What several metrics need is computed once.
    """

    level: Level
    sample: Sample
    plan: dict[str, Any] | None
    vocabulary: Vocabulary

    @property
    def expected(self) -> dict[str, Any]:
        """The expected plan."""
        return self.sample.expected

    @functools.cached_property
    def wanted(self) -> tuple[Entry, ...]:
        """The expected tasks or skills."""
        return plan_entries(self.level, self.expected)

    @functools.cached_property
    def given(self) -> tuple[Entry, ...]:
        """The predicted tasks or skills; none when the output does not parse."""
        return plan_entries(self.level, self.plan)

    @functools.cached_property
    def wanted_names(self) -> list[str]:
        """The expected names in order."""
        return [entry.name for entry in self.wanted]

    @functools.cached_property
    def given_names(self) -> list[str]:
        """The predicted names in order."""
        return [entry.name for entry in self.given]

    @functools.cached_property
    def alignment(self) -> Alignment:
        """Which predicted entry stands for which expected one."""
        return align(self.level, self.wanted, self.given, self.vocabulary)

    @functools.cached_property
    def strict_valid(self) -> bool:
        """Whether the plan is strictly valid."""
        return strict_valid(self.level, self.plan, self.vocabulary)

    @functools.cached_property
    def schema_valid(self) -> bool:
        """Whether the plan is schema-valid, as what is strictly valid always is."""
        return self.strict_valid or schema_valid(self.level, self.plan, self.vocabulary)
