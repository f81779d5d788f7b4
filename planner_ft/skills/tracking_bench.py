"""GoToXY and StationKeep measured in the simulator of missions, beside guidance and PID."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from planner_ft.benchmark.statistics import bootstrap_mean, wilson
from planner_ft.simulation.asked import Faults
from planner_ft.simulation.executor import Running, Stage
from planner_ft.simulation.fast import Bools, FastSimulator, Floats
from planner_ft.simulation.scene import Scene
from planner_ft.simulation.skill import Job
from planner_ft.simulation.world import World
from planner_ft.skills.dynamics import published_vessel
from planner_ft.skills.policies import Policy
from planner_ft.support.geodesy import Origin
from planner_ft.support.tables import Table, TableRow, figure, row
from planner_ft.support.terminal import Report
from planner_ft.vocabulary.definition import Motion

if TYPE_CHECKING:
    from planner_ft.skills.bench import SkillBench

CURRENTS = {"published current": 1.0, "twice the published current": 2.0}
AWAY = (5.0, 30.0)  # metres from a goal at the start
SECONDS, PATIENCE = 60.0, 120.0  # how long a place is held, and how long a way may take
COLUMNS = {
    "goto": ("arrived % ↑", "waypoint m ↓", "seconds ↓"),
    "hold": ("stayed % ↑", "holding m ↓", "after 20 s, m ↓"),
}
PUBLISHED = {"goto": (None, "0.93 to 0.97", None), "hold": (None, "0.12 to 0.43", None)}
CAPTION = (
    "In the simulator of missions, position by GPS and dead reckoning, errors against the truth;"
    " means with 95 % intervals (rates: Wilson; means: bootstrap over episodes). Waypoint: the"
    " distance when a way ends, tolerance 1 m; holding: mean distance over 60 s, from up to 1 m off."
)


def tracking_table(request: SkillBench, policies: Sequence[Policy], report: Report) -> Table:
    """A section per current, a row per policy and for guidance."""
    skill = request.skill
    names = ["learnt, shipped", *(f"learnt, {one}" for one in request.policies)]
    implementations: dict[str, dict[str, Any]] = {
        name: {"implementation": f"learnt-{skill}", "policy": str(policy.path.parent)}
        for name, policy in zip(names, policies, strict=True)
    }
    implementations["guidance and PID"] = {}
    rows, total, done = list[TableRow](), len(CURRENTS) * len(implementations), 0
    for current, factor in CURRENTS.items():
        rows.append(row(current, kind="section"))
        for name, settings in implementations.items():
            report(f"{skill} bench", done, total)
            rows.append(_row(name, *measure(request, settings, factor), request.seed))
            done += 1
    report(f"{skill} bench", total, total)
    shown = [figure(None) if one is None else one for one in PUBLISHED[skill]]
    rows += [row("published", kind="section"), row("", *shown, kind="published")]
    return Table("", COLUMNS[skill], rows, name=skill, caption=CAPTION)


def measure(
    request: SkillBench, settings: dict[str, Any], factor: float
) -> tuple[Bools, Floats, Floats]:
    """Which episodes came to their end, and two figures of each (n,)."""
    hold, count = request.skill == "hold", request.episodes
    random = np.random.default_rng([request.seed, 17])
    scene = _scene(count, hold, factor, request.seed, random)
    motion = Motion("hold" if hold else "go", {})
    seconds = SECONDS if hold else None
    points = ((0.0, 0.0),)
    job = Job(
        "skill", {}, motion, settings, points=points, seconds=seconds, speed=scene.vessel.speed
    )
    running = Running(Stage("bench", 0, job, (), (), PATIENCE, ()), scene)
    everyone = np.arange(count)
    running.start(everyone)
    ended, active = np.full(count, np.nan), np.ones(count, dtype=bool)
    errors, off = np.zeros(count), list[Floats]()
    while active.any() and scene.time < PATIENCE:
        runs = everyone[active]
        running.step(runs, scene)
        scene.advance(active)
        off.append(np.linalg.norm(scene.pose[:, :2], axis=1))
        over = runs[running.done(runs)]
        ended[over], errors[over] = scene.time, off[-1][over]
        active[over] = False
    arrived = np.isfinite(ended)
    if hold:
        after = np.array(off[: round(SECONDS / scene.seconds)])
        return arrived, after.mean(axis=0), after[round(20 / scene.seconds) :].mean(axis=0)
    return arrived, errors[arrived], ended[arrived]


def _scene(count: int, hold: bool, factor: float, seed: int, random: np.random.Generator) -> Scene:
    """Vehicles at rest about [0, 0], heading anywhere, in water that moves `factor` times as fast
    as published.
    """
    vessel = published_vessel()
    world = World(
        *(vessel, (0.0, 0.0), (), (), {}, (), lambda _start, _goal: True, Faults(), count, seed)
    )
    world.current = factor * world.current
    starts = np.zeros((count, 4))
    away, angle = (
        random.uniform(*((0.0, 1.0) if hold else AWAY), count),
        random.uniform(0, 7, count),
    )
    starts[:, 0], starts[:, 1] = away * np.cos(angle), away * np.sin(angle)
    starts[:, 3] = random.uniform(-math.pi, math.pi, count)
    return Scene(world, FastSimulator(vessel, count), starts, Origin(0.0, 0.0), lambda _r, _l: None)


def _row(name: str, arrived: Bools, first: Floats, second: Floats, seed: int) -> TableRow:
    rate = wilson(int(arrived.sum()), len(arrived))
    means = (bootstrap_mean(one.tolist(), range(len(one)), seed) for one in (first, second))
    return row(name, rate.cell(scale=100, decimals=0), *(one.cell() for one in means))
