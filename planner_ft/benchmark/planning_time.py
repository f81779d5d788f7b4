"""How long a mission of 1 to 10 tasks takes to plan, with both agents, measured and not added
up.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.benchmark.folder import PLANNING
from planner_ft.benchmark.predictions import Line, RecordLog
from planner_ft.candidates.adapters import CONFIG, WEIGHTS, find_adapter
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import sha256_text, sha256_tree

if TYPE_CHECKING:
    from planner_ft.benchmark.plan import Job, Plan
    from planner_ft.planning import Planner

MOST = 10
PLACES = (
    (40, 10),
    (-35, 60),
    (120, -20),
    (15, 95),
    (-80, -45),
    (70, 130),
    (-25, -110),
    (160, 55),
    (-140, 30),
    (5, -75),
)
Progress = Callable[[str, int, int], None]


def planning_command(tasks: int, variant: int) -> str:
    """A command of so many tasks, to sail to places and to keep station there in turn; variants
    differ in the places.
    """
    steps = []
    for step in range(tasks):
        east, north = PLACES[(step // 2 + variant) % len(PLACES)]
        steps.append(
            f"keep station there for {60 + 30 * ((step + variant) % 4)} seconds"
            if step % 2
            else f"go to ({east}, {north})"
        )
    text = ", then ".join(steps)
    return f"{text[0].upper()}{text[1:]}."


def planning_log(folder: Path) -> RecordLog:
    """The log of timed missions: one line per command, candidate and configuration."""
    return RecordLog(folder / PLANNING)


def time_planning(
    plan: Plan, jobs: Sequence[Job], log: RecordLog, progress: Progress
) -> str | None:
    """Time what is missing of the candidate's `planning_samples` commands for each number of tasks.

    Returns why a configuration could not be timed (it has no adapter of the Task Agent), or None.
    """
    problem = None
    for job in jobs:
        try:
            key = _key(plan, job)
        except PlannerError as error:
            problem = str(error)
            continue
        wanted = {
            f"tasks{tasks}-{variant}": planning_command(tasks, variant)
            for variant in range(plan.settings.planning_samples)
            for tasks in range(1, MOST + 1)
        }
        missing = {name: command for name, command in wanted.items() if name not in log.of_key(key)}
        done = len(wanted) - len(missing)
        for line in _timed(plan, job, missing, key):
            log.append(line)
            done += 1
            progress(f"{job.name}: planning time", done, len(wanted))
    return problem


def planning_key(plan: Plan, job: Job) -> str | None:
    """The key of a job's lines in planning.jsonl, None where it cannot plan."""
    try:
        return _key(plan, job)
    except PlannerError:
        return None


def _key(plan: Plan, job: Job) -> str:
    adapter = _task_adapter(plan, job)
    return sha256_text(f"{job.key} {sha256_tree(adapter, (WEIGHTS, CONFIG)) if adapter else None}")[
        :20
    ]


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


def _timed(plan: Plan, job: Job, commands: dict[str, str], key: str) -> Iterator[Line]:
    from planner_ft.planning import Planner

    if not commands:
        return
    candidate = str(job.candidate.folder) if job.candidate.source == "path" else job.candidate.name
    adapters: dict[str, Any] = {
        "mission_adapter": job.adapter,
        "task_adapter": _task_adapter(plan, job),
    }
    settings: dict[str, Any] = {
        "vocabulary": plan.settings.vocabulary,
        "device": plan.settings.device,
        "quantization": plan.settings.quantization,
    }
    with Planner.load(
        candidate, configuration=job.configuration.name, **adapters, **settings
    ) as planner:
        # What is done once (4-bit weights packed, grammars compiled, the Task Agent loaded) is not
        # counted.
        planner.plan(planning_command(2, 0))
        for name, command in commands.items():
            yield {
                "id": name,
                "candidate": job.candidate.name,
                "configuration": job.configuration.name,
                **_measure(planner, command),
                "key": key,
            }


def _measure(planner: Planner, command: str) -> dict[str, Any]:
    started = time.perf_counter()
    planned = planner.plan(command)
    seconds = time.perf_counter() - started
    by_agent = {f"{level}_s": round(use.seconds, 4) for level, use in planned.usage.items()}
    return {
        "tasks": len(planned.tasks) if planned.valid else None,
        "seconds": round(seconds, 4),
        **by_agent,
        "peak_memory_bytes": planned.peak_memory,
    }
