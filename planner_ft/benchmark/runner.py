"""Running the benchmark: answers and timed queries that are not there yet are made, then all are
scored.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from planner_ft.benchmark import folder
from planner_ft.benchmark.plan import Job, Plan, make_plan
from planner_ft.benchmark.planning_time import time_planning
from planner_ft.benchmark.records import Line, RecordLog, add_costs, begin_run, measured, read_run
from planner_ft.benchmark.results import Results, assemble
from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.benchmark.sources import AnswerSource, Fields, open_source
from planner_ft.support.manifest import build_manifest
from planner_ft.support.ranks import ALONE, Ranks
from planner_ft.vocabulary.outputs import parse_output

Progress = Callable[[str, int, int], None]
"""Called with a label, queries done and queries in all of that part of the run."""


def _silent(_label: str, _done: int, _total: int) -> None:
    pass


@dataclass(frozen=True)
class _Run:
    """A run of this process."""

    plan: Plan
    ranks: Ranks
    predictions: RecordLog
    progress: Progress

    @contextlib.contextmanager
    def source(self, jobs: list[Job]) -> Iterator[AnswerSource]:
        source = open_source(self.plan, jobs)
        try:
            yield source
        finally:
            source.release()

    def share(self, done: Mapping[str, Line]) -> list[Sample]:
        """This process's part of the samples that have no answer."""
        return self.ranks.share(_without(self.plan.data.samples, done))

    def answer(self, job: Job, samples: list[Sample], source: AnswerSource) -> None:
        """Record answers as they come."""
        label, total = f"{job.name}: answers", len(self.plan.data.samples)
        before = total - len(samples)
        self.progress(label, before, total)
        for done, (index, answer) in enumerate(source.answers(job, samples), before + 1):
            self.predictions.append(_prediction(job, samples[index], answer))
            self.progress(label, done, total)

    def time(
        self, job: Job, samples: list[Sample], total: int, source: AnswerSource, log: RecordLog
    ) -> None:
        """Time queries one at a time."""
        found = source.latencies(job, samples) if samples else ()
        for done, (index, timed) in enumerate(found, total - len(samples) + 1):
            log.append({"id": samples[index].id, **job.named(), **timed, "key": job.key})
            self.progress(f"{job.name}: latency", done, total)


def run_bench(
    settings: BenchSettings, progress: Progress = _silent, ranks: Ranks = ALONE
) -> Results:
    """Benchmark every candidate in every configuration and write results.json and the tables into
    `settings.folder`.

    Answers are written as they are made; with `resume` those that are there are not made again.
    With several processes this is for the first, and `help_bench` for the others. Raises
    PlannerError.
    """
    out = settings.folder
    hint = "give --resume to go on, --overwrite to start anew, or another --out"
    folder.check_folder(out, () if settings.resume or settings.overwrite else folder.ALL, hint)
    plan = make_plan(replace(settings, device=ranks.device(settings.device)))
    started = time.time()
    if settings.overwrite:
        folder.clear(out)
    with (
        _nothing_left(out),
        RecordLog(out / folder.PREDICTIONS) as predictions,
        RecordLog(out / folder.LATENCY) as latencies,
    ):
        begin_run(plan, predictions)
        reused = len(predictions.records)
        ranks.wait()
        # The others read the answers that are there: every share is cut from the same list.
        ranks.wait()
        run = _Run(plan, ranks, predictions, progress)
        for jobs in plan.by_candidate():
            _run_candidate(run, jobs, latencies)
            if settings.planning_samples:
                add_costs(out, jobs[0].candidate.name, time_planning(plan, jobs, progress))
            ranks.wait()
        took = {"seconds": round(time.time() - started, 1), "reused_predictions": reused}
        results = _results(plan, predictions, latencies, took)
        folder.write_results(out, results)
    return results


@contextlib.contextmanager
def _nothing_left(out: Path) -> Iterator[None]:
    """Remove the files of a run that failed before its first answer, such as in loading: the next
    one would take them for results.
    """
    try:
        yield
    except Exception:
        answers = out / folder.PREDICTIONS
        if not (answers.exists() and answers.stat().st_size):
            folder.clear(out)
        raise


def help_bench(settings: BenchSettings, ranks: Ranks) -> None:
    """Make this process's share of the answers of a run that another process leads. Raises
    PlannerError.
    """
    plan = make_plan(replace(settings, device=ranks.device(settings.device)))
    # The first process has refused or cleared the folder before anybody goes on.
    ranks.wait()
    with RecordLog(settings.folder / folder.PREDICTIONS) as predictions:
        ranks.wait()
        for jobs in plan.by_candidate():
            _run_candidate(_Run(plan, ranks, predictions, _silent), jobs, None)
            ranks.wait()


def _run_candidate(run: _Run, jobs: list[Job], latencies: RecordLog | None) -> None:
    """Make this process's share of the missing answers of one candidate, and time queries if there
    is a log for them; the model is loaded once, and only if need be.
    """
    timed = run.plan.data.samples[: run.plan.settings.latency_samples]
    missing = {job.name: run.share(run.predictions.of_key(job.key)) for job in jobs}
    # The repeats of a system take the time of the first.
    first = [job for job in jobs if job.sampling is None or job.sampling.repeat == 1]
    untimed = {
        job.name: _without(timed, latencies.of_key(job.key))
        for job in first
        if latencies is not None
    }
    with contextlib.ExitStack() as loaded:
        if needed := any(missing.values()) or any(untimed.values()):
            run.progress(f"{jobs[0].candidate.name}: loading", 0, 0)
            source = loaded.enter_context(run.source(jobs))
            for job in jobs:
                run.answer(job, missing[job.name], source)
        if latencies is None:
            loaded.close()
        # Timing wants a quiet machine: the others have answered, and wait until it is over.
        run.ranks.wait()
        run.predictions.read()
        if needed and latencies is not None:
            for job in first:
                run.time(job, untimed[job.name], len(timed), source, latencies)
            add_costs(run.plan.settings.folder, jobs[0].candidate.name, source.costs())


def _without(samples: Sequence[Sample], done: Mapping[str, Line]) -> list[Sample]:
    return [sample for sample in samples if sample.id not in done]


def _prediction(job: Job, sample: Sample, answer: Fields) -> Line:
    parsed = parse_output(answer["output"])
    return {
        "id": sample.id,
        **job.named(),
        **answer,
        "parsed": parsed.plan,
        "error": answer["error"] or parsed.problem,
        "standin": job.candidate.is_standin,
        "key": job.key,
    }


def _results(
    plan: Plan, predictions: RecordLog, latencies: RecordLog, run: dict[str, Any]
) -> Results:
    settings, costs = plan.settings, read_run(plan.settings.folder).costs
    sampled = {name: getattr(settings, name) for name in ("temperature", "top_p", "repeats")}
    configuration = {
        "level": settings.level,
        "vocabulary": {"name": plan.vocabulary.name, "sha256": plan.vocabulary.sha256},
        "limit": settings.limit,
        "batch_size": settings.batch_size or "auto",
        "max_new_tokens": settings.token_limit,
        "latency_samples": settings.latency_samples,
        "decoding": sampled if settings.temperature else "greedy",
    }
    manifest = build_manifest(
        "bench",
        seed=settings.seed,
        configuration=configuration,
        inputs={"data": plan.data.path},
        device=plan.device,
        jobs={job.name: {**job.parts, "threads": job.threads} for job in plan.jobs},
        costs=costs,
        run=run,
    )
    found = []
    for job in plan.jobs:
        answers, timed = predictions.of_key(job.key), latencies.of_key(job.key)
        found.append(measured(settings.folder, costs, job.system, answers, timed))
    return assemble(plan.data, plan.vocabulary, found, seed=settings.seed, manifest=manifest)


def resume_hint(path: Path) -> str:
    """How many answers an interrupted run has left."""
    predictions = path / folder.PREDICTIONS
    count = predictions.read_bytes().count(b"\n") if predictions.is_file() else 0
    return f"{count} answers are kept in {predictions}"
