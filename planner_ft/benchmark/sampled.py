"""Runs that sample their answers: one job per repeat, and what is wrong with settings for it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from planner_ft.decoding.sampling import Sampling

if TYPE_CHECKING:
    from planner_ft.benchmark.plan import Job
    from planner_ft.benchmark.settings import BenchSettings


def repeated(job: Job, settings: BenchSettings) -> list[Job]:
    """The job once for every repeat, each with its own random numbers and its own key; the job
    itself where decoding is greedy.
    """
    if settings.temperature == 0:
        return [job]
    jobs = []
    for repeat in range(1, settings.repeats + 1):
        sampling = Sampling(settings.temperature, settings.top_p, settings.seed, repeat)
        drawn = {
            "temperature": sampling.temperature,
            "top-p": sampling.top_p,
            "seed": sampling.seed,
            "repeat": repeat,
        }
        jobs.append(
            replace(
                job,
                sampling=sampling,
                parts={**job.parts, **drawn},
                system=replace(job.system, repeat=repeat),
            )
        )
    return jobs


def repeats_problems(repeats: int, temperature: float, top_p: float) -> list[str]:
    """What is wrong with these settings, in words."""
    problems = []
    if not 1 <= repeats <= 1000:
        problems.append(f"--repeats {repeats}: must be between 1 and 1000")
    if not 0 <= temperature <= 10:
        problems.append(f"--temperature {temperature:g}: must be between 0 (greedy) and 10")
    if not 0 < top_p <= 1:
        problems.append(f"--top-p {top_p:g}: must be above 0 and at most 1")
    if repeats > 1 and temperature == 0:
        problems.append(
            f"--repeats {repeats}: greedy answers are all the same; give --temperature, for"
            " example 0.7"
        )
    if top_p != 1 and temperature == 0:
        problems.append(
            f"--top-p {top_p:g}: greedy decoding samples nothing; give --temperature, for"
            " example 0.7"
        )
    return problems
