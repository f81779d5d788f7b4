"""Missing answers and timed queries are made, by processes that share a run, and all scored.

The time to plan missions of 1 to 10 tasks with both agents is measured, not added up.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from pathlib import Path
from typing import Any

from planner_ft.benchmark import folder
from planner_ft.benchmark.folder import Line, RecordLog
from planner_ft.benchmark.plan import Job, Plan, make_plan
from planner_ft.benchmark.results import Results, assemble
from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.benchmark.sources import EndpointSource, EngineSource
from planner_ft.candidates.adapters import adapter_sha256, find_adapter
from planner_ft.support.files import sha256_text
from planner_ft.support.manifest import build_manifest
from planner_ft.support.ranks import ALONE, Ranks
from planner_ft.support.terminal import Report, silent
from planner_ft.vocabulary.plans import parse_output

Source = EndpointSource | EngineSource
MOST = 10
EASTS = (40, -35, 120, 15, -80, 70, -25, 160, -140, 5)
NORTHS = (10, 60, -20, 95, -45, 130, -110, 55, 30, -75)


@dataclass(frozen=True)
class _Run:
    """A run of this process, which times queries where there is a log for them."""

    plan: Plan
    ranks: Ranks
    progress: Report
    predictions: RecordLog
    latencies: RecordLog | None = None

    def every_candidate(self) -> None:
        """Make this process's share of all answers, candidate by candidate."""
        for _name, of_candidate in groupby(self.plan.jobs, lambda job: job.candidate.name):
            jobs = list(of_candidate)
            self._candidate(jobs)
            if self.latencies is not None and self.plan.settings.planning_samples:
                costs = time_planning(self.plan, jobs, self.progress)
                folder.add_costs(self.plan.settings.folder, jobs[0].candidate.name, costs)
            self.ranks.wait()

    def _candidate(self, jobs: list[Job]) -> None:
        """Make this process's share of a candidate's answers; time queries; load it if need be."""
        every, log = [sample.id for sample in self.plan.data.samples], self.latencies
        timed = every[: self.plan.settings.latency_samples] if log else []
        known = [self.predictions.missing(job.key, every) for job in jobs]
        # Neighbours, so that batches are as large as those of one process.
        own = self.ranks.stretch([(at, name) for at, names in enumerate(known) for name in names])
        missing = [[name for of, name in own if of == at] for at in range(len(jobs))]
        # The repeats of a system take the time of the first.
        first = [job for job in jobs if job.sampling is None or job.sampling.repeat == 1]
        untimed = [log.missing(job.key, timed) if log else [] for job in first]
        needed = any(missing) or any(untimed)
        with contextlib.ExitStack() as loaded:
            if needed:
                self.progress(f"{jobs[0].candidate.name}: loading", 0, 0)
                source = _source(self.plan, jobs)
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


def _source(plan: Plan, jobs: Sequence[Job]) -> Source:
    """What answers these jobs of one candidate, loaded. Raises PlannerError."""
    if plan.settings.endpoint is not None:
        return EndpointSource(plan, jobs, plan.settings.endpoint)
    return EngineSource(plan, jobs)


def _answers(job: Job, samples: list[Sample], source: Source) -> Iterator[Line]:
    """Lines of predictions.jsonl, as they come."""
    for index, answer in source.answers(job, samples):
        parsed = parse_output(answer["output"])
        error = answer["error"] or parsed.problem
        beside = {"parsed": parsed.plan, "error": error, "standin": job.candidate.is_standin}
        yield {"id": samples[index].id, **job.named(), **answer, **beside}


def _timed(job: Job, samples: list[Sample], source: Source) -> Iterator[Line]:
    """Lines of latency.jsonl, one query at a time."""
    for index, (seconds, tokens, passes, first) in source.latencies(job, samples):
        named = {"id": samples[index].id, **job.named(), "latency_s": round(seconds, 6)}
        begun = {} if first is None else {"first_token_s": round(first, 6)}
        yield {**named, "tokens": tokens, "forward_passes": passes, **begun}


def run_bench(settings: BenchSettings, progress: Report = silent, ranks: Ranks = ALONE) -> Results:
    """Benchmark every candidate in every configuration and write results.json and the tables into
    `settings.folder`.

    Answers are written as they are made; with `resume` those that are there are not made again.
    With several processes this is for the first, and `help_bench` for the others. Raises
    PlannerError.
    """
    out = settings.folder
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
        reused = sum(map(len, predictions.records.values()))
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
        costs=record["costs"],
        run=took,
    )
    found = folder.measured_in(settings.folder, record, [job.name for job in plan.jobs])
    return assemble(plan.data, plan.vocabulary, found, manifest)


def planning_command(tasks: int, variant: int) -> str:
    """A command to sail to places and keep station there in turn; variants differ in places."""
    steps = []
    for step in range(tasks):
        place = (step // 2 + variant) % len(EASTS)
        seconds = 60 + 30 * ((step + variant) % 4)
        hold = f"keep station there for {seconds} seconds"
        steps.append(hold if step % 2 else f"go to ({EASTS[place]}, {NORTHS[place]})")
    text = ", then ".join(steps)
    return f"{text[0].upper()}{text[1:]}."


def time_planning(plan: Plan, jobs: Sequence[Job], progress: Report) -> dict[str, Any]:
    """Time the missing ones of the candidate's `planning_samples` commands for each number of
    tasks, into planning.jsonl; no other model is loaded then. Returns, for run.json, the key of
    each configuration's lines and why one could not be timed (it has no adapter of the Task Agent).
    """
    variants, numbers = range(plan.settings.planning_samples), range(1, MOST + 1)
    pairs = [(tasks, variant) for variant in variants for tasks in numbers]
    wanted = {f"tasks{one[0]}-{one[1]}": planning_command(*one) for one in pairs}
    keys: dict[str, str | None] = {}
    problem = None
    with RecordLog(plan.settings.folder / folder.PLANNING) as log:
        for job in jobs:
            keys[job.configuration.name] = None
            adapter = find_adapter(job.candidate, "task", plan.vocabulary) if job.adapter else None
            if job.adapter and adapter is None:
                way = "train one with `plannerft train --level task`"
                problem = f"{job.name}: planning time needs an adapter of the task level; {way}"
                continue
            digest = adapter_sha256(adapter) if adapter else None
            key = keys[job.configuration.name] = sha256_text(f"{job.key} {digest}")[:20]
            missing = {name: wanted[name] for name in log.missing(key, wanted)}
            if missing:
                how = progress, f"{job.name}: planning time", len(missing), len(wanted)
                log.fill(key, _planned(plan, job, adapter, missing), *how)
    return {"planning_keys": keys, "planning_problem": problem}


def _planned(plan: Plan, job: Job, adapter: Path | None, wanted: dict[str, str]) -> Iterator[Line]:
    from planner_ft.planning import Planner

    shared = ("vocabulary", "device", "quantization")
    settings: dict[str, Any] = {name: getattr(plan.settings, name) for name in shared}
    settings |= {"mission_adapter": job.adapter, "task_adapter": adapter}
    settings["configuration"] = job.configuration.name
    with Planner.load(job.candidate.given_as, **settings) as planner:
        # Work that is done once (4-bit weights packed, grammars compiled, the Task Agent loaded) is
        # not counted.
        planner.plan(planning_command(2, 0))
        for name, command in wanted.items():
            started = time.perf_counter()
            planned = planner.plan(command)
            seconds = time.perf_counter() - started
            yield {
                "id": name,
                **job.named(),
                "tasks": len(planned.tasks) if planned.valid else None,
                "seconds": round(seconds, 4),
                **{f"{level}_s": round(use.seconds, 4) for level, use in planned.usage.items()},
                "peak_memory_bytes": planned.peak_memory,
            }
