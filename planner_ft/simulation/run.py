"""Simulating an approved plan: read and check it, run it, write results, logs and reports."""

from __future__ import annotations

import contextlib
import importlib.util
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from planner_ft.document import read_document
from planner_ft.document.track import Point
from planner_ft.exporters.formats import PlanExport
from planner_ft.planning.frame import origin_of
from planner_ft.review.approval import approval_of
from planner_ft.review.log import log_beside
from planner_ft.simulation.asked import Faults
from planner_ft.simulation.executor import Executor
from planner_ft.simulation.fast import SIMULATORS, Floats, build_simulator
from planner_ft.simulation.logs import RunLogs
from planner_ft.simulation.measures import Observer, RunResult
from planner_ft.simulation.scene import Scene
from planner_ft.simulation.slots import GUIDANCE, WAYPOINTS, Slots
from planner_ft.simulation.staging import Staging
from planner_ft.simulation.vessel import TOLERANCE, build_vessel, simulation_file
from planner_ft.simulation.world import World
from planner_ft.support.alone import alone
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import check_writable
from planner_ft.support.geodesy import Origin
from planner_ft.support.terminal import Report
from planner_ft.vocabulary import load_vocabulary

MOST_RUNS = 500
RESULTS, MANIFEST = "results.json", "manifest.json"
OURS = (
    "run-*.jsonl",
    "run-*.mcap",
    RESULTS,
    MANIFEST,
    "table.*",
    "tracks.svg",
    "report.*",
    ".*.tmp",
)
"""Files of a simulation, which --overwrite may remove."""
Watch = Callable[[Executor], None]


@dataclass(frozen=True)
class SimulationSettings:
    """What is simulated. `locations` say where objects truly stand, `starts` where runs begin in
    turn (home without any); `mcap` is the number of runs with a ROS 2 log.
    """

    plan: Path
    out: Path | None = None
    runs: int = 20
    seed: int = 0
    simulator: str = "fast"
    tolerance: float = TOLERANCE
    locations: Mapping[str, Sequence[float]] = field(default_factory=dict)
    starts: tuple[Point, ...] = ()
    faults: Faults = field(default_factory=Faults)
    origin: Origin | None = None
    mcap: int = 1
    log: Path | None = None
    draft: bool = False
    vocabulary: str | None = None
    overwrite: bool = False
    goto: str = GUIDANCE
    survey: str = WAYPOINTS
    outlines: Mapping[str, Floats] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Raise PlannerError for numbers out of range and an unknown simulator."""
        if not 1 <= self.runs <= MOST_RUNS:
            raise PlannerError(f"--runs {self.runs}: must be from 1 to {MOST_RUNS}")
        if not 0 < self.tolerance <= 100:
            raise PlannerError(f"--tolerance {self.tolerance:g}: must be above 0 m, at most 100")
        if not 0 <= self.mcap <= self.runs:
            raise PlannerError(f"--mcap {self.mcap}: must be from 0 to the {self.runs} runs")
        if self.simulator not in SIMULATORS:
            known = ", ".join(SIMULATORS)
            raise PlannerError(f"--simulator {self.simulator}: must be one of {known}")

        _ = self.slots

    @property
    def slots(self) -> Slots:
        """What fills the slots of the plan. Raises PlannerError."""
        return Slots(self.goto, self.survey, self.outlines)

    @property
    def folder(self) -> Path:
        """The folder of the results: by default the plan's name with ".simulation"."""
        return self.out or self.plan.with_suffix(".simulation")


@dataclass(frozen=True)
class Simulated:
    """A simulation that has ended: the plan, what was run, and the results."""

    plan: PlanExport
    settings: SimulationSettings
    staging: Staging
    scene: Scene
    results: list[RunResult]
    tracks: list[list[Point]]
    log: list[dict[str, Any]]  # the log of run 1, without its poses


def simulate(
    settings: SimulationSettings, report: Report | None = None, watch: Watch | None = None
) -> Simulated:
    """Run an approved plan and write everything into the folder; `watch` is called after every
    step. Raises PlannerError.
    """
    plan = read_plan(settings)
    with alone(settings.folder, "--out", "a simulation"):
        check_writable(settings.folder)
        kept = [path.name for path in settings.folder.glob("*")] if settings.folder.exists() else []
        if kept and not settings.overwrite:
            hint = "give --overwrite to replace it, or another folder with --out"
            raise PlannerError(f"--out {settings.folder}: holds {kept[0]}; {hint}")
        prepared = _Prepared(plan, settings)
        if kept:
            _clear(settings.folder)
        settings.folder.mkdir(parents=True, exist_ok=True)
        done = prepared.run(report or (lambda _label, _done, _total: None), watch)
        from planner_ft.simulation.output import write_all

        write_all(done)
    return done


def read_plan(settings: SimulationSettings) -> PlanExport:
    """The plan, approved or a draft. Raises PlannerError for any other."""
    vocabulary = load_vocabulary(settings.vocabulary) if settings.vocabulary else None
    document = read_document(settings.plan, vocabulary)
    approval = approval_of(document, settings.log or log_beside(settings.plan))
    if approval.status == "altered":
        hint = "look at it and approve it again with `plannerft review`"
        raise PlannerError(f"{settings.plan}: {approval.text}; {hint}")
    approved = approval.status == "approved"
    if not approved and not settings.draft:
        way = f"approve it with `plannerft review {settings.plan}`"
        draft = "give --draft for results that are marked so"
        raise PlannerError(f"{settings.plan}: {approval.text}; {way}, or {draft}")
    vocabulary = vocabulary or load_vocabulary(document["vocabulary"]["name"])
    words = f"{approval.text}; digest {approval.digest}" if approved else None
    return PlanExport(document, vocabulary, settings.origin or origin_of(document), words)


class _Prepared:
    """A checked plan with its world, before anything is written."""

    def __init__(self, plan: PlanExport, settings: SimulationSettings) -> None:
        self.plan, self.settings = plan, settings
        vocabulary, document = plan.vocabulary, plan.document
        raw = simulation_file(vocabulary)
        self.vessel = build_vessel(vocabulary, document["vehicle"])
        one_sided = [one for one in settings.faults.all if one.kind in ("port", "starboard")]
        if one_sided and self.vessel.drive != "differential":
            problem = f"{vocabulary.name} has no port and starboard thrusters"
            raise PlannerError(f"--fault {one_sided[0].text}: {problem}; leave it out")
        self.staging = Staging(plan, self.vessel, raw, settings.tolerance, settings.slots)
        if settings.mcap and importlib.util.find_spec("mcap_ros2") is None:
            ways = "pip install planner_ft[sim], or give --mcap 0"
            raise PlannerError(f"--mcap {settings.mcap}: ROS 2 logs need an extra; {ways}")
        self.stages, self.home = list(self.staging.stages()), self.staging.home()
        self.staging.check_skills([*self.stages, self.home])
        starts = list(settings.starts) or [vocabulary.home]
        charted, objects = self.staging.structures, self._objects()
        true = {place: objects[name] for name, place in self._named().items()}
        placed = [replace(one, position=true.get(one.position, one.position)) for one in charted]
        self.world = World(
            self.vessel,
            vocabulary.home,
            charted,
            placed,
            objects,
            self.staging.fences,
            self.staging.allowed,
            settings.faults,
            settings.runs,
            settings.seed,
        )
        for name, corners in settings.outlines.items():
            self.world.add_outline(name, corners)
        self.staging.check_starts(starts, self.world)
        count = settings.runs
        self.simulator = build_simulator(settings.simulator, self.vessel, count)
        poses = np.zeros((count, 4))
        poses[:, :2] = [starts[run % len(starts)] for run in range(count)]
        poses[:, 3] = np.random.default_rng([settings.seed, 3]).uniform(-math.pi, math.pi, count)
        self.starts = poses

    def _named(self) -> dict[str, Point]:
        """Objects of the plan by name: located places, those of a chart, and structures."""
        found = {one.name: one.position for one in self.staging.structures}
        for key in ("structures", "located"):
            for name, place in self.plan.document.get(key, {}).items():
                found[name] = (float(place[0]), float(place[1]))
        return found

    def _objects(self) -> dict[str, Point]:
        given = {
            name: (float(place[0]), float(place[1]))
            for name, place in self.settings.locations.items()
        }
        return {**self._named(), **given}

    def run(self, report: Report, watch: Watch | None) -> Simulated:
        settings, staging = self.settings, self.staging
        with contextlib.ExitStack() as stack:
            writer = RunLogs(settings.folder, settings.runs, settings.mcap, settings.faults, stack)
            origin = self.plan.origin or Origin(0.0, 0.0)
            scene = Scene(self.world, self.simulator, self.starts, origin, writer.write)
            tasks = [task["id"] for task in self.plan.document["tasks"]]
            observer = Observer(scene, staging.fences, staging.rings(), staging.close(), tasks)
            writer.begin(scene, observer, self._way())
            executor = Executor(
                self.stages, self.home, scene, observer.finished, observer.observed, staging.seconds
            )
            executor.begin()
            while executor.step():
                writer.step(executor)
                if watch is not None:
                    watch(executor)
                if scene.steps % 100 == 0:
                    ended = settings.runs - int(executor.active.sum())
                    report("runs ended", ended, settings.runs)
            report("runs ended", settings.runs, settings.runs)
            results = observer.results(executor)
            return Simulated(
                self.plan, settings, staging, scene, results, writer.tracks, writer.first
            )

    def _way(self) -> list[Point]:
        return [point for leg in self.plan.track.legs for point in leg.points]


def _clear(folder: Path) -> None:
    """Remove the files of an earlier simulation. Raises PlannerError when others are there."""
    ours = {path for pattern in OURS for path in folder.glob(pattern) if path.is_file()}
    if foreign := sorted(set(folder.iterdir()) - ours):
        problem = f"holds {foreign[0].name}, which is not of a simulation"
        raise PlannerError(f"--out {folder}: {problem}; give another folder")
    for path in ours:
        path.unlink()
