"""Sources of answers: a candidate that is loaded here, or a server.

A source serves the jobs of one candidate. The runner asks it for missing answers and writes each
down as it comes, so a source that fails half-way keeps what it answered.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from planner_ft.benchmark.plan import Job, Plan
    from planner_ft.benchmark.samples import Sample

Fields = dict[str, Any]  # fields of a line; those that a source cannot know are None


class AnswerSource(Protocol):
    """Answers the queries of one candidate's jobs. Raises PlannerError where it cannot go on."""

    def answers(self, job: Job, samples: Sequence[Sample]) -> Iterator[tuple[int, Fields]]:
        """Yield (index of the sample, fields for predictions.jsonl), in any order."""

    def latencies(self, job: Job, samples: Sequence[Sample]) -> Iterator[tuple[int, Fields]]:
        """Yield (index of the sample, fields of `timed`), one query at a time, after a warm-up."""

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


def timed(seconds: float, tokens: int | None, passes: int | None, first: float | None) -> Fields:
    """The fields of a timed query; `first` are the seconds until the first token was known."""
    found = {"latency_s": round(seconds, 6), "tokens": tokens, "forward_passes": passes}
    return found if first is None else {**found, "first_token_s": round(first, 6)}
