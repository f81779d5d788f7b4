"""Time to plan a mission of 1 to 10 tasks with both agents, measured and not added up."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from planner_ft.benchmark.folder import PLANNING, Line, Progress, RecordLog
from planner_ft.benchmark.plan import Job, Plan
from planner_ft.candidates.adapters import adapter_sha256, find_adapter
from planner_ft.support.files import sha256_text

MOST = 10
EASTS = (40, -35, 120, 15, -80, 70, -25, 160, -140, 5)
NORTHS = (10, 60, -20, 95, -45, 130, -110, 55, 30, -75)


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


def time_planning(plan: Plan, jobs: Sequence[Job], progress: Progress) -> dict[str, Any]:
    """Time the missing ones of the candidate's `planning_samples` commands for each number of
    tasks, into planning.jsonl; no other model is loaded then. Returns, for run.json, the key of
    each configuration's lines and why one could not be timed (it has no adapter of the Task Agent).
    """
    variants, numbers = range(plan.settings.planning_samples), range(1, MOST + 1)
    pairs = [(tasks, variant) for variant in variants for tasks in numbers]
    wanted = {f"tasks{one[0]}-{one[1]}": planning_command(*one) for one in pairs}
    keys: dict[str, str | None] = {}
    problem = None
    with RecordLog(plan.settings.folder / PLANNING) as log:
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
                log.fill(key, _timed(plan, job, adapter, missing), *how)
    return {"planning_keys": keys, "planning_problem": problem}


def _timed(
    plan: Plan, job: Job, task_adapter: Path | None, commands: dict[str, str]
) -> Iterator[Line]:
    from planner_ft.planning import Planner

    shared = ("vocabulary", "device", "quantization")
    settings: dict[str, Any] = {name: getattr(plan.settings, name) for name in shared}
    settings |= {"mission_adapter": job.adapter, "task_adapter": task_adapter}
    settings["configuration"] = job.configuration.name
    with Planner.load(job.candidate.given_as, **settings) as planner:
        # Work that is done once (4-bit weights packed, grammars compiled, the Task Agent loaded) is
        # not counted.
        planner.plan(planning_command(2, 0))
        for name, command in commands.items():
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
