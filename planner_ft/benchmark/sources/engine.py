"""Answers of a candidate that is loaded here; batches by length, whose size finds itself."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.sources import Fields, Timed
from planner_ft.candidates.loading import resolve_device
from planner_ft.confidence.calibration import plan_confidence, read_calibration
from planner_ft.confidence.parts import as_json, known
from planner_ft.decoding.configurations import Configuration
from planner_ft.decoding.engine import Engine
from planner_ft.planning.settings import Agent
from planner_ft.support.errors import PlannerError
from planner_ft.support.resources import peak_memory, reset_peak_memory

if TYPE_CHECKING:
    from planner_ft.benchmark.plan import Job, Plan
    from planner_ft.decoding.generate import Generation
    from planner_ft.decoding.sequence import Query

SWAPS = 3  # how often the adapter is put on and off to time it


class EngineSource:
    """An engine with the candidate's adapter, if any job needs it. Raises PlannerError."""

    def __init__(self, plan: Plan, jobs: Sequence[Job]) -> None:
        self.plan, self.level = plan, plan.settings.level
        self.device = resolve_device(plan.device)
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
        largest = LARGEST if plan.device.startswith("cuda") else FIRST
        asked = plan.settings.batch_size
        self.batch = BatchSize(asked, asked) if asked else BatchSize(FIRST, largest)

    def answers(self, job: Job, samples: Sequence[Sample]) -> Iterator[tuple[int, Fields]]:
        """Batch by batch, longest prompts first."""
        queries = self._queries(job, samples)
        lengths = [len(query.prompt) for query in queries]

        def ask(indices: list[int]) -> Iterator[tuple[int, Generation]]:
            chosen, how = [queries[index] for index in indices], {"sampling": job.sampling}
            return self.engine.answers(chosen, job.configuration, batch_size=len(indices), **how)

        calibration = None
        if job.sampling is None:
            how = job.configuration, job.adapter, job.quantization
            told = bool(job.system.with_vocabulary)
            agent = Agent(self.level, job.candidate, *how, told)
            held_for = agent.held_for(self.plan.vocabulary)
            calibration = read_calibration(agent.calibration, held_for)[0]
        for index, answer, size in in_batches(ask, lengths, self.batch, is_out_of_memory):
            text = self.engine.text(answer)
            choices = known(self.engine.choices(answer), text)
            fields = {
                "output": text,
                "tokens": len(answer.ids),
                "forward_passes": answer.forward_passes,
                "time_s": round(answer.seconds, 4),
                "finish_reason": answer.finish_reason,
                "error": answer.error,
                "prompt_tokens": lengths[index],
                "batch": size,
            }
            extra: Fields = {"alternatives": answer.alternatives}
            extra |= {"working": self.engine.working(answer), "logprobs": as_json(choices)}
            extra["confidence"] = plan_confidence(calibration, text, choices)
            more = {name: value for name, value in extra.items() if value not in (None, 0, "")}
            yield index, {**fields, **more}

    def latencies(self, job: Job, samples: Sequence[Sample]) -> Iterator[tuple[int, Timed]]:
        queries = self._queries(job, samples)
        for index, one in self.engine.latencies(queries, job.configuration, sampling=job.sampling):
            yield index, (one.seconds, len(one.ids), one.forward_passes, one.first_token_s)

    def costs(self) -> dict[str, Any]:
        """Seconds to load, the mean of an adapter switch, the most memory since loading."""
        swap, began = None, time.perf_counter()
        if self.level in self.engine.adapters:
            for adapter in (True, False) * SWAPS:
                with self.engine.configured(self.level, Configuration(adapter)):
                    pass
            swap = round((time.perf_counter() - began) / (2 * SWAPS), 6)
        peak = max(self.load_peak, peak_memory(self.device))
        loading = round(self.load_seconds, 3)
        return {"load_s": loading, "adapter_swap_s": swap, "peak_memory_bytes": peak}

    def release(self) -> None:
        self.engine.release()

    def _queries(self, job: Job, samples: Sequence[Sample]) -> list[Query]:
        told = bool(job.system.with_vocabulary)
        return [self.engine.query(self.level, one.record, with_vocabulary=told) for one in samples]


Answer = TypeVar("Answer")

FIRST, LARGEST = 16, 256
"""The size to begin with, also the largest on a CPU (larger ones gain nothing), and on a GPU."""


@dataclass
class BatchSize:
    """The queries that are generated together, and how many there may be at most."""

    size: int
    largest: int

    def used(self, count: int, *, fitted: bool) -> None:
        """Judge by a batch of `count` queries. Raises PlannerError when one alone did not fit."""
        if fitted:
            self.size = min(2 * count, self.largest) if count == self.size else self.size
        elif count == 1:
            raise PlannerError(
                "the device has too little memory for a single query; give a smaller candidate or"
                " another --device (what is done is kept for --resume)"
            )
        else:
            self.size = self.largest = count // 2


def in_batches(
    ask: Callable[[list[int]], Iterator[tuple[int, Answer]]],
    lengths: Sequence[int],
    batch: BatchSize,
    out_of_memory: Callable[[Exception], bool],
) -> Iterator[tuple[int, Answer, int]]:
    """Yield (index, answer, size of its batch), longest queries first, so that a query that does
    not fit shows at once; those that a full memory left unanswered are asked again. `ask` answers
    the queries of some indices and yields (place among them, answer).
    """
    waiting = sorted(range(len(lengths)), key=lambda index: (-lengths[index], index))
    while waiting:
        asked, done, full = waiting[: batch.size], set(), False
        try:
            for place, answer in ask(asked):
                done.add(asked[place])
                yield asked[place], answer, len(asked)
        except Exception as error:
            if not out_of_memory(error):
                raise
            full = True
        # Out of the handler: the exception held the tensors of the batch.
        batch.used(len(asked), fitted=not full)
        waiting = [index for index in waiting if index not in done]


def is_out_of_memory(error: BaseException) -> bool:
    """Whether the accelerator's memory was too small; its cached memory is given back then."""
    import torch

    found = any(isinstance(one, torch.OutOfMemoryError) for one in (error, error.__cause__))
    if found and torch.cuda.is_available():
        torch.cuda.empty_cache()
    return found
