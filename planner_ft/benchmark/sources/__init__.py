"""Sources of answers: a candidate that is loaded here, or a server.

A source serves the jobs of one candidate. The runner asks it for missing answers and writes each
down as it comes, so a source that fails half-way keeps what it answered.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from planner_ft.benchmark.plan import Job, Plan
    from planner_ft.benchmark.samples import Sample


@dataclass(frozen=True)
class Answered:
    """One answer as predictions.jsonl records it; fields that a source cannot know are None.

    `seconds` is its share of the batch's time. `more` holds further JSON fields of the record.
    """

    output: str
    seconds: float
    finish_reason: str
    tokens: int | None = None
    prompt_tokens: int | None = None
    forward_passes: int | None = None
    error: str | None = None
    more: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Timed:
    """One query timed alone, as latency.jsonl records it. `first_token_s` is the time until the
    first token was known.
    """

    seconds: float
    tokens: int | None = None
    forward_passes: int | None = None
    first_token_s: float | None = None


class AnswerSource(Protocol):
    """Answers the queries of one candidate's jobs. Raises PlannerError where it cannot go on."""

    def answers(self, job: Job, samples: Sequence[Sample]) -> Iterator[tuple[int, Answered]]:
        """Yield (index of the sample, answer) as answers are completed, in any order."""

    def latencies(self, job: Job, samples: Sequence[Sample]) -> Iterator[tuple[int, Timed]]:
        """Yield (index of the sample, timed query), one query after the other, after a warm-up."""

    def costs(self) -> dict[str, Any]:
        """Costs beside the queries, as run.json records them per candidate: load_s ..."""

    def release(self) -> None:
        """Give memory or connections back."""


def open_source(plan: Plan, jobs: Sequence[Job]) -> AnswerSource:
    """The source that answers these jobs of one candidate, loaded. Raises PlannerError."""
    if plan.settings.endpoint is not None:
        from planner_ft.benchmark.sources.endpoint import EndpointSource

        return EndpointSource(plan, jobs, plan.settings.endpoint)
    from planner_ft.benchmark.sources.engine import EngineSource

    return EngineSource(plan, jobs)
