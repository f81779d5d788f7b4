"""Answers of a candidate that is loaded here."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.sources import Fields, timed
from planner_ft.benchmark.sources.batching import in_batches, is_out_of_memory, new_batch_size
from planner_ft.candidates.loading import resolve_device
from planner_ft.confidence.calibration import plan_confidence
from planner_ft.confidence.choices import as_json, known
from planner_ft.decoding.configurations import Configuration
from planner_ft.decoding.engine import Engine
from planner_ft.support.resources import peak_memory, reset_peak_memory

if TYPE_CHECKING:
    from planner_ft.benchmark.plan import Job, Plan
    from planner_ft.decoding.generate import Generation, Query

SWAPS = 3
"""How often the adapter is put on and off to time it."""


class EngineSource:
    """An engine with the candidate's adapter, if any job needs it; queries are batched. Raises
    PlannerError where the candidate cannot be loaded.
    """

    def __init__(self, plan: Plan, jobs: Sequence[Job]) -> None:
        self.device, self.level = resolve_device(plan.device), plan.settings.level
        reset_peak_memory(self.device)
        started = time.perf_counter()
        adapter = next((job.adapter for job in jobs if job.adapter), None)
        self.engine = Engine.load(
            jobs[0].candidate,
            plan.vocabulary,
            adapters={self.level: adapter} if adapter else None,
            device=plan.device,
            quantization=jobs[0].quantization,
            max_new_tokens=plan.settings.token_limit,
            threads=jobs[0].threads,
        )
        self.load_seconds = time.perf_counter() - started
        for job in jobs:  # a limit that a strength cannot keep is refused before the first query
            self.engine.method(self.level, job.configuration)
        # The size of batches is judged by a peak of its own, which begins here.
        self.load_peak = peak_memory(self.device)
        self.batch = new_batch_size(plan.settings.batch_size, plan.device)

    def answers(self, job: Job, samples: Sequence[Sample]) -> Iterator[tuple[int, Fields]]:
        """Batch by batch, longest prompts first."""
        queries = self._queries(job, samples)
        lengths = [len(query.prompt) for query in queries]

        def ask(indices: list[int]) -> Iterator[tuple[int, Generation]]:
            chosen, size = [queries[index] for index in indices], len(indices)
            sampling = job.sampling
            return self.engine.answers(
                chosen, job.configuration, batch_size=size, sampling=sampling
            )

        calibration = job.calibration()
        for index, answer, size in in_batches(ask, lengths, self.batch, is_out_of_memory):
            text = self.engine.text(answer)
            choices = known(self.engine.choices(answer), text)
            extra: dict[str, Any] = {
                "alternatives": answer.alternatives,
                "working": self.engine.working(answer),
                "logprobs": as_json(choices),
                "confidence": plan_confidence(calibration, text, choices),
            }
            yield (
                index,
                {
                    "output": text,
                    "tokens": len(answer.ids),
                    "forward_passes": answer.forward_passes,
                    "time_s": round(answer.seconds, 4),
                    "finish_reason": answer.finish_reason,
                    "error": answer.error,
                    "prompt_tokens": lengths[index],
                    "batch": size,
                    **{name: value for name, value in extra.items() if value not in (None, 0, "")},
                },
            )

    def latencies(self, job: Job, samples: Sequence[Sample]) -> Iterator[tuple[int, Fields]]:
        queries = self._queries(job, samples)
        for index, one in self.engine.latencies(queries, job.configuration, sampling=job.sampling):
            yield index, timed(one.seconds, len(one.ids), one.forward_passes, one.first_token_s)

    def costs(self) -> dict[str, Any]:
        """Seconds to load base and adapter, the mean of a switch between them, and the most memory
        since loading began.
        """
        return {
            "load_s": round(self.load_seconds, 3),
            "adapter_swap_s": self._swap_seconds(),
            "peak_memory_bytes": max(self.load_peak, peak_memory(self.device)),
        }

    def _swap_seconds(self) -> float | None:
        if self.level not in self.engine.adapters:
            return None
        began = time.perf_counter()
        for adapter in (True, False) * SWAPS:
            with self.engine.configured(self.level, Configuration(adapter)):
                pass
        return round((time.perf_counter() - began) / (2 * SWAPS), 6)

    def release(self) -> None:
        self.engine.release()

    def _queries(self, job: Job, samples: Sequence[Sample]) -> list[Query]:
        told = job.with_vocabulary
        return [self.engine.query(self.level, one.record, with_vocabulary=told) for one in samples]
