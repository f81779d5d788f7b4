"""Time to plan a mission of 1 to 10 tasks with both agents, measured and not added up."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.benchmark.folder import PLANNING
from planner_ft.benchmark.records import Line, RecordLog
from planner_ft.candidates.adapters import CONFIG, WEIGHTS, find_adapter
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import sha256_text, sha256_tree

if TYPE_CHECKING:
    from planner_ft.benchmark.plan import Job, Plan

MOST = 10
EASTS = (40, -35, 120, 15, -80, 70, -25, 160, -140, 5)
NORTHS = (10, 60, -20, 95, -45, 130, -110, 55, 30, -75)
PLACES = tuple(zip(EASTS, NORTHS, strict=True))


def planning_command(tasks: int, variant: int) -> str:
    """A command of so many tasks, to sail to places and to keep station there in turn; variants
    differ in the places.
    """
    steps = []
    for step in range(tasks):
        east, north = PLACES[(step // 2 + variant) % len(PLACES)]
        seconds = 60 + 30 * ((step + variant) % 4)
        hold, go = f"keep station there for {seconds} seconds", f"go to ({east}, {north})"
        steps.append(hold if step % 2 else go)
    text = ", then ".join(steps)
    return f"{text[0].upper()}{text[1:]}."


def time_planning(
    plan: Plan, jobs: Sequence[Job], progress: Callable[[str, int, int], None]
) -> dict[str, Any]:
    """Time the missing ones of the candidate's `planning_samples` commands for each number of
    tasks, into planning.jsonl; no other model is loaded then.

    Returns, for run.json, the key of each configuration's lines and why one could not be timed (it
    has no adapter of the Task Agent).
    """
    wanted = {
        f"tasks{tasks}-{variant}": planning_command(tasks, variant)
        for variant in range(plan.settings.planning_samples)
        for tasks in range(1, MOST + 1)
    }
    keys: dict[str, str | None] = {}
    problem = None
    with RecordLog(plan.settings.folder / PLANNING) as log:
        for job in jobs:
            keys[job.configuration.name] = None
            try:
                adapter = _task_adapter(plan, job)
            except PlannerError as error:
                problem = str(error)
                continue
            digest = sha256_tree(adapter, (WEIGHTS, CONFIG)) if adapter else None
            key = keys[job.configuration.name] = sha256_text(f"{job.key} {digest}")[:20]
            done = log.of_key(key)
            missing = {name: text for name, text in wanted.items() if name not in done}
            for index, line in enumerate(_timed(plan, job, adapter, missing), 1):
                log.append({**line, "key": key})
                left = len(missing) - index
                progress(f"{job.name}: planning time", len(wanted) - left, len(wanted))
    return {"planning_keys": keys, "planning_problem": problem}


def _task_adapter(plan: Plan, job: Job) -> Path | None:
    if job.adapter is None:
        return None
    adapter = find_adapter(job.candidate, "task", plan.vocabulary)
    if adapter is None:
        raise PlannerError(
            f"{job.name}: planning time needs an adapter of the task level; train one with"
            " `plannerft train --level task`"
        )
    return adapter


def _timed(
    plan: Plan, job: Job, task_adapter: Path | None, commands: dict[str, str]
) -> Iterator[Line]:
    from planner_ft.planning import Planner

    if not commands:
        return
    candidate = str(job.candidate.folder) if job.candidate.source == "path" else job.candidate.name
    settings: dict[str, Any] = {
        "mission_adapter": job.adapter,
        "task_adapter": task_adapter,
        "vocabulary": plan.settings.vocabulary,
        "device": plan.settings.device,
        "quantization": plan.settings.quantization,
    }
    with Planner.load(candidate, configuration=job.configuration.name, **settings) as planner:
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
