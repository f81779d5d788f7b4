"""Running the benchmark: answers and timed queries that are not there yet are made, then all are
scored.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from planner_ft.benchmark import folder
from planner_ft.benchmark.assembly import Measured, assemble
from planner_ft.benchmark.plan import Job, Plan, make_plan
from planner_ft.benchmark.planning_time import planning_key, planning_log, time_planning
from planner_ft.benchmark.predictions import Line, RecordLog, latency_log, prediction_log
from planner_ft.benchmark.ranks import ALONE, Ranks, remove_parts, take_in, take_in_abandoned
from planner_ft.benchmark.record import add_costs, begin_run, costs_of, read_run, records_by_key
from planner_ft.benchmark.results import Results
from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.benchmark.sources import Answered, AnswerSource, open_source
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary.outputs import parse_output

Progress = Callable[[str, int, int], None]
"""Called with a label, queries done and queries in all of that part of the run."""


def run_bench(
    settings: BenchSettings,
    progress: Progress = lambda _label, _done, _total: None,
    ranks: Ranks = ALONE,
) -> Results:
    """Benchmark every candidate in every configuration and write results.json and the tables into
    `settings.folder`.

    Answers are written as they are made; with `resume` those that are there are not made again.
    With several processes this is for the first, and `help_bench` for the others. Raises
    PlannerError.
    """
    if not (settings.resume or settings.overwrite):
        folder.check_folder(
            settings.folder,
            folder.ALL,
            "give --resume to go on, --overwrite to start anew, or another --out",
        )
    folder.check_writable(settings.folder)
    plan = make_plan(ranks.settings(settings))
    started = time.time()
    if settings.overwrite:
        folder.clear(settings.folder)
        remove_parts(settings.folder)
    with prediction_log(settings.folder) as predictions, latency_log(settings.folder) as latencies:
        take_in_abandoned(settings.folder, predictions)
        begin_run(plan, predictions)
        reused = len(predictions.records)
        ranks.wait()
        # The others read what is there: every share is cut from the same list.
        ranks.wait()
        for jobs in plan.by_candidate():
            _run_candidate(plan, jobs, predictions, latencies, progress, ranks)
            _time_planning(plan, jobs, progress)
            ranks.wait()
        remove_parts(settings.folder)
        results = _results(
            plan,
            predictions,
            latencies,
            {"seconds": round(time.time() - started, 1), "reused_predictions": reused},
        )
        folder.write_results(settings.folder, results)
    return results


def help_bench(settings: BenchSettings, ranks: Ranks) -> None:
    """Make this process's share of the answers of a run that another process leads. Raises
    PlannerError.
    """
    plan = make_plan(ranks.settings(settings))
    # The first process has refused or cleared the folder and taken in what lay there before anybody
    # goes on.
    ranks.wait()
    done = records_by_key(settings.folder / folder.PREDICTIONS)
    ranks.wait()
    with ranks.log(settings.folder) as own:
        for jobs in plan.by_candidate():
            missing = {
                job.name: ranks.share(_without(plan.data.samples, done.get(job.key, {})))
                for job in jobs
            }
            if any(missing.values()):
                with _opened(plan, jobs) as source:
                    for job in jobs:
                        _answer(
                            plan,
                            job,
                            missing[job.name],
                            source,
                            own,
                            lambda _label, _done, _total: None,
                        )
            ranks.wait()
            # Timing wants a quiet machine: only the first process goes on until here.
            ranks.wait()


def _run_candidate(
    plan: Plan,
    jobs: list[Job],
    predictions: RecordLog,
    latencies: RecordLog,
    progress: Progress,
    ranks: Ranks,
) -> None:
    """Make what is missing of one candidate; its model is loaded once, and only if anything is."""
    timed = plan.data.samples[: plan.settings.latency_samples]
    missing = {
        job.name: ranks.share(_without(plan.data.samples, predictions.of_key(job.key)))
        for job in jobs
    }
    # The repeats of a system take the time of the first.
    first = [job for job in jobs if job.sampling is None or job.sampling.repeat == 1]
    untimed = {job.name: _without(timed, latencies.of_key(job.key)) for job in first}
    if not any(missing.values()) and not any(untimed.values()):
        ranks.wait()
        return
    progress(f"{jobs[0].candidate.name}: loading", 0, 0)
    with _opened(plan, jobs) as source:
        for job in jobs:
            _answer(plan, job, missing[job.name], source, predictions, progress)
        ranks.wait()
        take_in(plan.settings.folder, predictions)
        for job in first:
            _time(job, untimed[job.name], len(timed), source, latencies, progress)
        add_costs(plan.settings.folder, jobs[0].candidate.name, source.costs())


@contextlib.contextmanager
def _opened(plan: Plan, jobs: list[Job]) -> Iterator[AnswerSource]:
    source = open_source(plan, jobs)
    try:
        yield source
    finally:
        source.release()


def _time_planning(plan: Plan, jobs: list[Job], progress: Progress) -> None:
    """Time missions of 1 to 10 tasks with both agents, if that is asked for; no other model is
    loaded then.
    """
    if not plan.settings.planning_samples:
        return
    with planning_log(plan.settings.folder) as log:
        problem = time_planning(plan, jobs, log, progress)
    keys = {job.configuration.name: planning_key(plan, job) for job in jobs}
    add_costs(
        plan.settings.folder,
        jobs[0].candidate.name,
        {"planning_keys": keys, "planning_problem": problem},
    )


def _without(samples: tuple[Sample, ...], done: Mapping[str, Line]) -> list[Sample]:
    return [sample for sample in samples if sample.id not in done]


def _answer(
    plan: Plan,
    job: Job,
    samples: list[Sample],
    source: AnswerSource,
    log: RecordLog,
    progress: Progress,
) -> None:
    """Record the answers that are missing, as they come."""
    total = len(plan.data.samples)
    done = total - len(samples)
    label = f"{job.name}: answers"
    progress(label, done, total)
    for index, answer in source.answers(job, samples):
        log.append(_prediction(job, samples[index], answer))
        done += 1
        progress(label, done, total)


def _prediction(job: Job, sample: Sample, answer: Answered) -> Line:
    parsed = parse_output(answer.output)
    return {
        "id": sample.id,
        "candidate": job.candidate.name,
        "configuration": job.configuration.name,
        **_repeat(job),
        "output": answer.output,
        "parsed": parsed.plan,
        "tokens": answer.tokens,
        "forward_passes": answer.forward_passes,
        "time_s": round(answer.seconds, 4),
        "finish_reason": answer.finish_reason,
        "error": answer.error or parsed.problem,
        "prompt_tokens": answer.prompt_tokens,
        "standin": job.candidate.is_standin,
        **answer.more,
        "key": job.key,
    }


def _repeat(job: Job) -> Line:
    return {"repeat": job.sampling.repeat} if job.sampling else {}


def _time(
    job: Job,
    samples: list[Sample],
    total: int,
    source: AnswerSource,
    log: RecordLog,
    progress: Progress,
) -> None:
    """Time the queries that are missing, one at a time."""
    if not samples:
        return
    done = total - len(samples)
    label = f"{job.name}: latency"
    progress(label, done, total)
    for index, timed in source.latencies(job, samples):
        record: Line = {
            "id": samples[index].id,
            "candidate": job.candidate.name,
            "configuration": job.configuration.name,
            **_repeat(job),
        }
        record |= {
            "latency_s": round(timed.seconds, 6),
            "tokens": timed.tokens,
            "forward_passes": timed.forward_passes,
        }
        if timed.first_token_s is not None:
            record["first_token_s"] = round(timed.first_token_s, 6)
        log.append({**record, **timed.more, "key": job.key})
        done += 1
        progress(label, done, total)


def _results(
    plan: Plan, predictions: RecordLog, latencies: RecordLog, run: dict[str, Any]
) -> Results:
    settings = plan.settings
    configuration = {
        "level": settings.level,
        "vocabulary": {"name": plan.vocabulary.name, "sha256": plan.vocabulary.sha256},
        "limit": settings.limit,
        "batch_size": settings.batch_size or "auto",
        "max_new_tokens": settings.token_limit,
        "latency_samples": settings.latency_samples,
        "decoding": {
            "temperature": settings.temperature,
            "top_p": settings.top_p,
            "repeats": settings.repeats,
        }
        if settings.temperature
        else "greedy",
    }
    costs = read_run(settings.folder).costs
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
    measured = [
        Measured(
            job.system,
            predictions.of_key(job.key),
            latencies.of_key(job.key),
            *costs_of(settings.folder, costs, job.system),
        )
        for job in plan.jobs
    ]
    return assemble(plan.data, plan.vocabulary, measured, seed=settings.seed, manifest=manifest)


def resume_hint(path: Path) -> str:
    """How many answers an interrupted run has left."""
    predictions = path / folder.PREDICTIONS
    count = predictions.read_bytes().count(b"\n") if predictions.is_file() else 0
    return f"{count} answers are kept in {predictions}"
