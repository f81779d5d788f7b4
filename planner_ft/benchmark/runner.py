"""Missing answers and timed queries are made, by processes that share a run, and all scored."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from planner_ft.benchmark import folder
from planner_ft.benchmark.folder import Line, Progress, RecordLog, silent
from planner_ft.benchmark.plan import Job, Plan, make_plan
from planner_ft.benchmark.planning_time import time_planning
from planner_ft.benchmark.results import Results, assemble
from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.benchmark.sources import AnswerSource, open_source
from planner_ft.support.manifest import build_manifest
from planner_ft.support.ranks import Ranks
from planner_ft.vocabulary.outputs import parse_output


@dataclass(frozen=True)
class _Run:
    """A run of this process, which times queries where there is a log for them."""

    plan: Plan
    ranks: Ranks
    progress: Progress
    predictions: RecordLog
    latencies: RecordLog | None = None

    def every_candidate(self) -> None:
        """Make this process's share of all answers, candidate by candidate."""
        for jobs in self.plan.by_candidate():
            self._candidate(jobs)
            if self.latencies is not None and self.plan.settings.planning_samples:
                costs = time_planning(self.plan, jobs, self.progress)
                folder.add_costs(self.plan.settings.folder, jobs[0].candidate.name, costs)
            self.ranks.wait()

    def _candidate(self, jobs: list[Job]) -> None:
        """Make this process's share of a candidate's answers; time queries; load it if need be."""
        every, log = [sample.id for sample in self.plan.data.samples], self.latencies
        timed = every[: self.plan.settings.latency_samples] if log else []
        missing = [self.ranks.share(self.predictions.missing(job.key, every)) for job in jobs]
        # The repeats of a system take the time of the first.
        first = [job for job in jobs if job.sampling is None or job.sampling.repeat == 1]
        untimed = [log.missing(job.key, timed) if log else [] for job in first]
        needed = any(missing) or any(untimed)
        with contextlib.ExitStack() as loaded:
            if needed:
                self.progress(f"{jobs[0].candidate.name}: loading", 0, 0)
                source = open_source(self.plan, jobs)
                loaded.callback(source.release)
                for job, names in zip(jobs, missing, strict=True):
                    made = _answers(job, self._samples(names), source)
                    how = self.progress, f"{job.name}: answers", len(names), len(every)
                    self.predictions.fill(job.key, made, *how)
            if log is None:
                loaded.close()
            # Timing wants a quiet machine: the others have answered, and wait until it is over.
            self.ranks.wait()
            self.predictions.read()
            if needed and log is not None:
                for job, names in zip(first, untimed, strict=True):
                    if names:
                        made = _timed(job, self._samples(names), source)
                        how = self.progress, f"{job.name}: latency", len(names), len(timed)
                        log.fill(job.key, made, *how)
                folder.add_costs(self.plan.settings.folder, jobs[0].candidate.name, source.costs())

    def _samples(self, names: Sequence[str]) -> list[Sample]:
        wanted = set(names)
        return [sample for sample in self.plan.data.samples if sample.id in wanted]


def _answers(job: Job, samples: list[Sample], source: AnswerSource) -> Iterator[Line]:
    """Lines of predictions.jsonl, as they come."""
    for index, answer in source.answers(job, samples):
        parsed = parse_output(answer["output"])
        error = answer["error"] or parsed.problem
        beside = {"parsed": parsed.plan, "error": error, "standin": job.candidate.is_standin}
        yield {"id": samples[index].id, **job.named(), **answer, **beside}


def _timed(job: Job, samples: list[Sample], source: AnswerSource) -> Iterator[Line]:
    """Lines of latency.jsonl, one query at a time."""
    for index, timed in source.latencies(job, samples):
        yield {"id": samples[index].id, **job.named(), **timed}


def run_bench(
    settings: BenchSettings, progress: Progress = silent, ranks: Ranks | None = None
) -> Results:
    """Benchmark every candidate in every configuration and write results.json and the tables into
    `settings.folder`.

    Answers are written as they are made; with `resume` those that are there are not made again.
    With several processes this is for the first, and `help_bench` for the others. Raises
    PlannerError.
    """
    out, ranks = settings.folder, ranks or Ranks()
    folder.check_folder(out, folder.ALL, resume=settings.resume, overwrite=settings.overwrite)
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
        _Run(plan, ranks, progress, predictions, latencies).every_candidate()
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
        _Run(plan, ranks, silent, predictions).every_candidate()


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
