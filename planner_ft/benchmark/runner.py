"""Missing answers and timed queries are made, by processes that share a run, and all scored."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from planner_ft.benchmark import folder
from planner_ft.benchmark.folder import Line, RecordLog
from planner_ft.benchmark.plan import Job, Plan, make_plan
from planner_ft.benchmark.planning_time import time_planning
from planner_ft.benchmark.results import Results, assemble
from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.benchmark.sources import AnswerSource, Fields, open_source
from planner_ft.support.manifest import build_manifest
from planner_ft.support.ranks import Ranks
from planner_ft.vocabulary.outputs import parse_output

Progress = Callable[[str, int, int], None]
"""Called with a label, queries done and queries in all of that part of the run."""


def _silent(_label: str, _done: int, _total: int) -> None:
    pass


@dataclass(frozen=True)
class _Run:
    """A run of this process, which times queries where there is a log for them."""

    plan: Plan
    ranks: Ranks
    progress: Progress
    predictions: RecordLog
    latencies: RecordLog | None = None

    def candidate(self, jobs: list[Job]) -> None:
        """Make this process's share of a candidate's answers; time queries; load it if need be."""
        every, settings = self.plan.data.samples, self.plan.settings
        timed = every[: settings.latency_samples] if self.latencies is not None else ()
        missing = [self.ranks.share(_without(every, self.predictions, job)) for job in jobs]
        # The repeats of a system take the time of the first.
        first = [job for job in jobs if job.sampling is None or job.sampling.repeat == 1]
        untimed = [_without(timed, self.latencies, job) for job in first]
        needed = any(missing) or any(untimed)
        with contextlib.ExitStack() as loaded:
            if needed:
                self.progress(f"{jobs[0].candidate.name}: loading", 0, 0)
                source = open_source(self.plan, jobs)
                loaded.callback(source.release)
                for job, samples in zip(jobs, missing, strict=True):
                    self._answer(job, samples, source)
            if self.latencies is None:
                loaded.close()
            # Timing wants a quiet machine: the others have answered, and wait until it is over.
            self.ranks.wait()
            self.predictions.read()
            if needed and self.latencies is not None:
                for job, samples in zip(first, untimed, strict=True):
                    self._time(job, samples, len(timed), source, self.latencies)
                folder.add_costs(settings.folder, jobs[0].candidate.name, source.costs())

    def _answer(self, job: Job, samples: list[Sample], source: AnswerSource) -> None:
        """Record answers as they come."""
        label, total = f"{job.name}: answers", len(self.plan.data.samples)
        before = total - len(samples)
        self.progress(label, before, total)
        for done, (index, answer) in enumerate(source.answers(job, samples), before + 1):
            self.predictions.append(_prediction(job, samples[index], answer))
            self.progress(label, done, total)

    def _time(
        self, job: Job, samples: list[Sample], total: int, source: AnswerSource, log: RecordLog
    ) -> None:
        """Time queries one at a time."""
        found = source.latencies(job, samples) if samples else ()
        for done, (index, timed) in enumerate(found, total - len(samples) + 1):
            log.append({"id": samples[index].id, **job.named(), **timed, "key": job.key})
            self.progress(f"{job.name}: latency", done, total)


def run_bench(
    settings: BenchSettings, progress: Progress = _silent, ranks: Ranks | None = None
) -> Results:
    """Benchmark every candidate in every configuration and write results.json and the tables into
    `settings.folder`.

    Answers are written as they are made; with `resume` those that are there are not made again.
    With several processes this is for the first, and `help_bench` for the others. Raises
    PlannerError.
    """
    out, goes_on, ranks = settings.folder, settings.resume or settings.overwrite, ranks or Ranks()
    folder.check_folder(out, () if goes_on else folder.ALL, folder.GO_ON)
    plan = make_plan(replace(settings, device=ranks.device(settings.device)))
    started = time.time()
    if settings.overwrite:
        folder.clear(out)
    with (
        _nothing_left(out),
        RecordLog(out / folder.PREDICTIONS) as predictions,
        RecordLog(out / folder.LATENCY) as latencies,
    ):
        folder.begin_run(plan, predictions)
        reused = len(predictions.records)
        ranks.wait()
        # The others read the answers that are there: every share is cut from the same list.
        ranks.wait()
        for jobs in plan.by_candidate():
            _Run(plan, ranks, progress, predictions, latencies).candidate(jobs)
            if settings.planning_samples:
                costs = time_planning(plan, jobs, progress)
                folder.add_costs(out, jobs[0].candidate.name, costs)
            ranks.wait()
        took = {"seconds": round(time.time() - started, 1), "reused_predictions": reused}
        results = _results(plan, took)
        folder.write_results(out, results)
    return results


@contextlib.contextmanager
def _nothing_left(out: Path) -> Iterator[None]:
    """Remove what a run that failed before its first answer left: it is no result."""
    try:
        yield
    except Exception:
        answers = out / folder.PREDICTIONS
        if not (answers.exists() and answers.stat().st_size):
            folder.clear(out)
        raise


def help_bench(settings: BenchSettings, ranks: Ranks) -> None:
    """Make this process's share of a run that another process leads. Raises PlannerError."""
    plan = make_plan(replace(settings, device=ranks.device(settings.device)))
    # The first process has refused or cleared the folder before anybody goes on.
    ranks.wait()
    with RecordLog(settings.folder / folder.PREDICTIONS) as predictions:
        ranks.wait()
        for jobs in plan.by_candidate():
            _Run(plan, ranks, _silent, predictions).candidate(jobs)
            ranks.wait()


def _without(samples: Sequence[Sample], log: RecordLog | None, job: Job) -> list[Sample]:
    """The samples of which the log holds nothing for this job."""
    done = log.of_key(job.key) if log is not None else {}
    return [sample for sample in samples if sample.id not in done]


def _prediction(job: Job, sample: Sample, answer: Fields) -> Line:
    parsed = parse_output(answer["output"])
    error = answer["error"] or parsed.problem
    beside = {"parsed": parsed.plan, "error": error, "standin": job.candidate.is_standin}
    return {"id": sample.id, **job.named(), **answer, **beside, "key": job.key}


def _results(plan: Plan, took: dict[str, Any]) -> Results:
    settings, record = plan.settings, folder.read_run(plan.settings.folder)
    sampled = {name: getattr(settings, name) for name in ("temperature", "top_p", "repeats")}
    manifest = build_manifest(
        "bench",
        seed=settings.seed,
        configuration={
            "level": settings.level,
            "vocabulary": plan.vocabulary.named,
            "limit": settings.limit,
            "batch_size": settings.batch_size or "auto",
            "max_new_tokens": settings.token_limit,
            "latency_samples": settings.latency_samples,
            "decoding": sampled if settings.temperature else "greedy",
        },
        inputs={"data": plan.data.path},
        device=plan.device,
        jobs={job.name: {**job.parts, "threads": job.threads} for job in plan.jobs},
        costs=record.costs,
        run=took,
    )
    found = folder.measured_in(settings.folder, record, [job.name for job in plan.jobs])
    return assemble(plan.data, plan.vocabulary, found, seed=settings.seed, manifest=manifest)


def resume_hint(path: Path) -> str:
    """How many answers an interrupted run has left."""
    predictions = path / folder.PREDICTIONS
    count = predictions.read_bytes().count(b"\n") if predictions.is_file() else 0
    return f"{count} answers are kept in {predictions}"
