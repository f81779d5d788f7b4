"""Running the benchmark: answers and timed queries that are not there yet are made, then all are scored."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from planner_ft.benchmark import folder
from planner_ft.benchmark.outputs import parse_output
from planner_ft.benchmark.plan import Job, Plan, make_plan
from planner_ft.benchmark.predictions import Line, RecordLog, latency_log, prediction_log
from planner_ft.benchmark.results import Results, score_system
from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, write_json
from planner_ft.support.manifest import build_manifest

Progress = Callable[[str, int, int], None]
"""Called with a label, queries done and queries in all of that part of the run."""


def run_bench(settings: BenchSettings, progress: Progress = lambda _label, _done, _total: None) -> Results:
    """Benchmark every candidate in every configuration and write results.json and the tables into `settings.folder`.

    Answers are written as they are made; with `resume` those that are there are not made again. Raises PlannerError.
    """
    if not (settings.resume or settings.overwrite):
        folder.check_folder(settings.folder, folder.ALL, "give --resume to go on, --overwrite to start anew, or another --out")
    folder.check_writable(settings.folder)
    plan = make_plan(settings)
    started = time.time()
    if settings.overwrite:
        folder.clear(settings.folder)
    with prediction_log(settings.folder) as predictions, latency_log(settings.folder) as latencies:
        _record_run(plan, predictions)
        reused = len(predictions.records)
        for jobs in plan.by_candidate():
            _run_candidate(plan, jobs, predictions, latencies, progress)
        results = _results(plan, predictions, latencies, {"seconds": round(time.time() - started, 1), "reused_predictions": reused})
        folder.write_results(settings.folder, results)
    return results


def _record_run(plan: Plan, predictions: RecordLog) -> None:
    """Write run.json, and refuse to go on with a run that was made with something else."""
    path = plan.settings.folder / folder.RUN
    recorded: dict[str, dict[str, Any]] = read_json(path)["jobs"] if path.is_file() else {}
    for job in plan.jobs:
        before = recorded.get(job.name, job.parts)
        changed = [name for name in job.parts if before.get(name) != job.parts[name]]
        if changed:
            raise PlannerError(f"{path}: {job.name} was begun with another {' and another '.join(changed)}; give --overwrite to start anew, or another --out")
    keys = {(job.candidate.name, job.configuration.name): job.key for job in plan.jobs}
    for record in predictions.records.values():
        name = str(record.get("candidate")), str(record.get("configuration"))
        if keys.get(name, record["key"]) != record["key"]:
            raise PlannerError(f"{predictions.path}: holds answers of {name[0]} {name[1]} that are not of this run; give --overwrite or another --out")
    write_json(path, {"jobs": {**recorded, **{job.name: job.parts for job in plan.jobs}}})


def _run_candidate(plan: Plan, jobs: list[Job], predictions: RecordLog, latencies: RecordLog, progress: Progress) -> None:
    """Make what is missing of one candidate; its model is loaded once, and only if anything is."""
    timed = plan.data.samples[: plan.settings.latency_samples]
    missing = {job.name: _without(plan.data.samples, predictions, job) for job in jobs}
    untimed = {job.name: _without(timed, latencies, job) for job in jobs}
    if not any(missing.values()) and not any(untimed.values()):
        return
    with _loaded(plan, jobs, progress) as engine:
        for job in jobs:
            _answer(plan, job, missing[job.name], engine, predictions, progress)
        for job in jobs:
            _time(plan, job, untimed[job.name], len(timed), engine, latencies, progress)


def _without(samples: tuple[Sample, ...], log: RecordLog, job: Job) -> list[Sample]:
    done = log.of_key(job.key)
    return [sample for sample in samples if sample.id not in done]


@contextlib.contextmanager
def _loaded(plan: Plan, jobs: list[Job], progress: Progress) -> Iterator[Any]:
    """The candidate's model, with its adapter if any job needs it; released afterwards."""
    from planner_ft.decoding.engine import Engine

    progress(f"{jobs[0].candidate.name}: loading", 0, 0)
    adapter = next((job.adapter for job in jobs if job.adapter), None)
    engine = Engine.load(
        jobs[0].candidate, plan.vocabulary, adapters={plan.settings.level: adapter} if adapter else None, device=plan.device,
        quantization=jobs[0].quantization, max_new_tokens=plan.settings.token_limit, threads=jobs[0].threads,
    )  # fmt: skip
    try:
        yield engine
    finally:
        engine.release()


def _answer(plan: Plan, job: Job, samples: list[Sample], engine: Any, log: RecordLog, progress: Progress) -> None:
    """Generate and record the answers that are missing, in batches."""
    total = len(plan.data.samples)
    done = total - len(samples)
    label = f"{job.name}: answers"
    progress(label, done, total)
    queries = [engine.query(plan.settings.level, sample.record, with_vocabulary=job.with_vocabulary) for sample in samples]
    for index, answer in engine.answers(queries, job.configuration, batch_size=plan.settings.batch_size):
        log.append(_prediction(job, samples[index], answer, engine.text(answer), len(queries[index].prompt)))
        done += 1
        progress(label, done, total)


def _prediction(job: Job, sample: Sample, answer: Any, text: str, prompt_tokens: int) -> Line:
    parsed = parse_output(text)
    return {
        "id": sample.id, "candidate": job.candidate.name, "configuration": job.configuration.name, "output": text, "parsed": parsed.plan,
        "tokens": len(answer.ids), "forward_passes": answer.forward_passes, "time_s": round(answer.seconds, 4), "finish_reason": answer.finish_reason,
        "error": answer.error or parsed.problem, "prompt_tokens": prompt_tokens, "standin": job.candidate.is_standin, "key": job.key,
    }  # fmt: skip


def _time(plan: Plan, job: Job, samples: list[Sample], total: int, engine: Any, log: RecordLog, progress: Progress) -> None:
    """Time the queries that are missing, one at a time."""
    if not samples:
        return
    done = total - len(samples)
    label = f"{job.name}: latency"
    progress(label, done, total)
    queries = [engine.query(plan.settings.level, sample.record, with_vocabulary=job.with_vocabulary) for sample in samples]
    for index, latency in engine.latencies(queries, job.configuration):
        record = {"id": samples[index].id, "candidate": job.candidate.name, "configuration": job.configuration.name}
        log.append({**record, "latency_s": round(latency.seconds, 6), "tokens": latency.tokens, "forward_passes": latency.forward_passes, "key": job.key})
        done += 1
        progress(label, done, total)


def _results(plan: Plan, predictions: RecordLog, latencies: RecordLog, run: dict[str, Any]) -> Results:
    settings = plan.settings
    rows, scores = [], []
    for job in plan.jobs:
        row, of_samples = score_system(
            settings.level, job.system, plan.data.samples, predictions.of_key(job.key), plan.vocabulary, seed=settings.seed, timed=latencies.of_key(job.key)
        )
        rows.append(row)
        scores += of_samples
    configuration = {
        "level": settings.level, "vocabulary": {"name": plan.vocabulary.name, "sha256": plan.vocabulary.sha256}, "limit": settings.limit,
        "batch_size": settings.batch_size, "max_new_tokens": settings.token_limit, "latency_samples": settings.latency_samples, "decoding": "greedy",
    }  # fmt: skip
    manifest = build_manifest(
        "bench",
        seed=settings.seed,
        configuration=configuration,
        inputs={"data": plan.data.path},
        device=plan.device,
        jobs={job.name: {**job.parts, "threads": job.threads} for job in plan.jobs},
        run=run,
    )
    return Results(settings.level, plan.data.summary(), tuple(rows), manifest, tuple(scores))


def resume_hint(path: Path) -> str:
    """How many answers an interrupted run has left."""
    predictions = path / folder.PREDICTIONS
    count = predictions.read_bytes().count(b"\n") if predictions.is_file() else 0
    return f"{count} answers are kept in {predictions}"
