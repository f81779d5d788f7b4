"""From a plan document to stages that an executor runs, and everything that is refused before.

A slot of a plan is exchangeable: guidance and waypoints, or learnt skills; parameters, perception,
filters, end and failure modes stay what they are. `learnt = "..."` in [skill.NAME] and [task.TITLE]
of NAME.simulation.toml names the implementation.
"""

import functools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from planner_ft.document.limits import limits_of
from planner_ft.document.structures import ROUND, Allowed, Structure, fence, structures
from planner_ft.document.track import Leg, Point, circle_of, hold_time, place_of, point_of, shown
from planner_ft.exporters.formats import PlanExport
from planner_ft.planning.limits import time_left
from planner_ft.simulation.asked import GUIDANCE, LEARNT, WAYPOINTS, SimulationSettings
from planner_ft.simulation.checking import check_measure
from planner_ft.simulation.executor import Stage
from planner_ft.simulation.fast import Vessel
from planner_ft.simulation.measures import Bound, Ring
from planner_ft.simulation.skill import Job, check
from planner_ft.simulation.world import PILE, Fence, Reach, World
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.definition import Motion

CLEAR = 0.5  # share of a learnt stand-off that filters without a distance of their own keep clear
Entry = Mapping[str, Any]
PATIENCE, SLACK = 3.0, 60.0
"""A step may take so many times what it is planned for, and so many seconds more."""
SQUARE = "square"  # the pattern of a task whose stand-off is half the side of a square


class Staging:
    """The stages of one plan. Raises PlannerError for a plan that cannot be run as a whole."""

    def __init__(
        self, plan: PlanExport, vessel: Vessel, raw: Entry, settings: SimulationSettings
    ) -> None:
        self.plan, self.vessel, self.raw, self.settings = plan, vessel, raw, settings
        self.document, self.vocabulary = plan.document, plan.vocabulary
        for flag, value, usual, table in settings.slots:
            if value != usual and not any(LEARNT in one for one in raw.get(table, {}).values()):
                problem = f"{self.vocabulary.name} has no learnt skill for it; leave it out"
                raise PlannerError(f"{flag} {value}: {problem}")
        self.legs = {(leg.task, leg.step): leg for leg in plan.track.legs}
        self.limits = limits_of(self.document, self.vocabulary)
        self.structures: list[Structure] = structures(self.document, self.vocabulary)
        self._check()

    def _check(self) -> None:
        way_out = "give its place with `plannerft review` or --locate of `plannerft plan`"
        for place in self.document["open_places"]:
            several = len(place["tasks"]) > 1
            need = (
                f"task{'s' * several} {', '.join(map(str, place['tasks']))} need{'s'[several:]} it"
            )
            problem = f"where {place['name']} is, is not known, and {need}"
            raise PlannerError(f"{problem}; {way_out}")
        for number, task in enumerate(self.document["tasks"], start=1):
            if not task["skill_sequence"] or task.get("stale"):
                hint = "ask for them with `plannerft review`"
                raise PlannerError(f"task {number} has no skills that fit it; {hint}")
            if task["id"] in self.plan.track.open:
                problem = "its movement is not known in full (a radius, an angle or a motion lacks)"
                raise PlannerError(
                    f"task {number} {task['title']}: {problem}; state it, plan again"
                )
        if not self.document["tasks"]:
            raise PlannerError("the plan has no tasks; plan another command")

    @property
    def fences(self) -> list[Fence]:
        """The polygons that the whole plan keeps."""
        areas = [one.area for one in self.bounds if not one.tasks]
        return [area for area in areas if isinstance(area, Fence)]

    @functools.cached_property
    def bounds(self) -> list[Bound]:
        """The limits on place, time and speed, and the vehicle's area, that runs are watched for."""
        found = []
        for limit in self.limits:
            kind, values, text = limit["kind"], limit["values"], limit["text"].rstrip(".")
            held = self._held(limit)
            if kind in ("fence", "keep_out_area"):
                found.append(Bound(text, _polygon(values["polygon"], kind == "fence"), tasks=held))
            elif kind == "distance":
                reach = Reach(self.vocabulary.home, float(values["distance"]))
                found.append(Bound(text, reach, tasks=held))
            elif kind == "duration":
                found.append(Bound(text, seconds=float(values["duration"]), tasks=held))
            elif kind == "speed":
                found.append(Bound(text, tasks=held, speed=float(values["speed"])))
            elif kind == "return" and (left := time_left(values)) is not None:
                found.append(Bound(text, seconds=left))
        if area := self.document["vehicle"]["area"]:
            found.append(Bound("the area of the vehicle", _polygon(area, True)))
        return found

    def _held(self, limit: Entry) -> frozenset[str]:
        """The ids of the tasks that a limit holds for; none for one of the whole mission."""
        tasks, held = self.document["tasks"], limit["tasks"]
        whole = len(held) == len(tasks)
        return frozenset() if whole else frozenset(tasks[place - 1]["id"] for place in held)

    @property
    def allowed(self) -> Allowed:
        """Whether a leg keeps the fences."""
        return fence(self.document, self.vocabulary)

    @property
    def seconds(self) -> float:
        """How long a run may take: the vehicle's endurance, or the plan's own limit."""
        whole = (one.seconds for one in self.bounds if not one.tasks)
        return min([self.vessel.endurance, *whole])

    def speed(self, task: str) -> float:
        """m/s that a task may go at most, by its id: the vehicle's own, or the least stated."""
        limits = [one for one in self.limits if one["kind"] == "speed"]
        held = [one for one in limits if task in (self._held(one) or (task,))]
        return float(min([self.vessel.speed, *(one["values"]["speed"] for one in held)]))

    def rings(self) -> dict[str, Ring]:
        """The stand-off of each task that keeps one, by its id."""
        found = {}
        for task in self.document["tasks"]:
            circle, known = circle_of(task, self.vocabulary), self.vocabulary.task[task["title"]]
            if circle and known.pattern in ROUND:
                found[task["id"]] = Ring(*circle, known.pattern == SQUARE)
        return found

    def least(self) -> list[float]:
        """Metres from each structure below which its stand-off is cut: a limit holds but for what
        legs may cut, the way round a structure may be off by the tolerance of a position.
        """
        around = {ring.center for ring in self.rings().values()}
        firm: dict[Point | None, float] = {None: 0.0}  # None: from every structure
        for limit in self.limits:
            values, at = limit["values"], None
            if limit["kind"] == "keep_out" and "position" in values:
                at = point_of(values["position"])
            elif limit["kind"] != "clearance":
                continue
            firm[at] = max(firm.get(at, 0.0), float(values["distance"]))
        found = []
        for one in self.structures:
            held = max(firm[None], firm.get(one.position, 0.0))
            loose = one.position in around and held < one.standoff
            room = max(one.slack, self.settings.tolerance) if loose else one.slack
            found.append(max(one.standoff - room, held - one.slack))
        return found

    def close(self) -> frozenset[str]:
        """Tasks that come close to a structure on purpose: they dock, or pass along it."""
        known = {task["id"]: self.vocabulary.task[task["title"]] for task in self.document["tasks"]}
        return frozenset(name for name, one in known.items() if one.docks or one.pattern == "pass")

    def check_starts(self, starts: Sequence[Point], world: World) -> None:
        """Raise PlannerError for starts in structures, and a home or start that is fenced out."""
        home = self.vocabulary.home
        if home not in starts and self._excludes(home):
            problem = "a fence of the plan excludes home, where runs that fail return to"
            raise PlannerError(f"{problem}; plan with another fence")
        for start, away in zip(starts, world.nearest(np.array(starts, float)), strict=True):
            if away < self.vessel.radius:
                near = min(world.structures, key=lambda one: math.dist(start, one.position))
                problem = f"the vehicle would start in {near.name}, at {shown(start)}"
                raise PlannerError(f"{problem}; give --start x,y or another place of it")
            if self._excludes(start):
                problem = f"a fence of the plan excludes the start {shown(start)}"
                raise PlannerError(f"{problem}; plan with another fence, or give --start x,y")

    def _excludes(self, place: Point) -> bool:
        return any(one.outside_by(np.array([place]))[0] > 0 for one in self.fences)

    def stages(self) -> Iterator[Stage]:
        """The steps of all tasks in their order."""
        for task in self.document["tasks"]:
            own = hold_time(task, self.vocabulary)
            stages = [
                self._stage(task, number, step, own[1] if own else None)
                for number, step in enumerate(task["skill_sequence"])
            ]
            job = self._survey(task, stages[1:] or stages)
            yield from self._surveyed(stages, job) if job else stages

    def _survey(self, task: Entry, rest: Sequence[Stage]) -> Job | None:
        """The one movement that takes the place of a task's waypoints, where it is to."""
        learnt = self.raw.get("task", {}).get(task["title"], {}).get(LEARNT)
        survey, ring = self.settings.survey, self.rings().get(task["id"])
        if survey == WAYPOINTS or not learnt or not ring:
            return None
        name = next((one.name for one in self.structures if one.position == ring.center), "")
        outline = self.settings.outlines.get(name)
        reach = PILE if outline is None else float(np.linalg.norm(outline, axis=1).max())
        folder = {} if survey == LEARNT else {"policy": survey}
        return Job(
            *(task["title"], task["parameters"], Motion("go", {})),
            settings={"implementation": learnt, "standoff": ring.radius - reach, **folder},
            task=task["id"],
            step=rest[0].step,
            speed=min(self.vessel.cruise, self.speed(task["id"])),
            center=ring.center,
            tolerance=self.settings.tolerance,
            failure="survey failed",
        )

    def _surveyed(self, stages: Sequence[Stage], job: Job) -> list[Stage]:
        """The stages of a task with all but its approach replaced by one learnt survey."""
        clear = CLEAR * float(job.settings["standoff"])
        filters, sensors = (
            [replace(one, step=job.step) for one in _all(stages, role)]
            for role in ("filters", "sensors")
        )
        filters = [replace(one, margin=min(one.margin, clear)) for one in filters]
        patience = sum(one.patience for one in stages[1:] or stages)
        modes = tuple(dict.fromkeys(mode for one in stages for mode in one.failures))
        beside = tuple(filters), tuple(sensors)
        return [stages[0], Stage(job.task, job.step, job, *beside, patience, modes)]

    def check_skills(self, stages: Sequence[Stage]) -> None:
        """Raise PlannerError for a skill without implementation and an unknown measure."""
        for stage in stages:
            for job in stage.jobs:
                check(job, self.vessel)
                check_measure(job.skill, job.settings, self.vocabulary)

    def home(self) -> Stage:
        """The way home, with the vehicle's filters that keep clear and inside."""
        movement = Job(
            *("way home", {}, Motion("go", {}), {}, "home", 0, (self.vocabulary.home,)),
            speed=min(self.vessel.cruise, self.speed("home")),
            tolerance=self.settings.tolerance,
            failure="home not reached",
        )
        margin, known = self.document["vehicle"]["stand_off"], self.vocabulary.motion.skills
        filters = [
            Job(name, {}, motion, {}, "home", 0, margin=margin)
            for name, motion in known.items()
            if motion.kind == "clearance" or (motion.kind == "boundary" and self.fences)
        ]
        return Stage("home", 0, movement, tuple(filters), (), self.seconds, ())

    def _stage(self, task: Entry, number: int, step: Entry, own: float | None) -> Stage:
        leg = self.legs.get((task["id"], number))
        skill = step["navigation_skill"]
        motion = self.vocabulary.motion.of(skill["name"])
        stated = motion.value("time", skill["parameters"]) if motion else None
        seconds = own if stated is None else float(stated)
        stays = leg is not None and leg.kind in ("hold", "drift")
        movement = self._job(task, number, skill, leg, seconds if stays else None)
        filters, sensors = (
            tuple(self._job(task, number, one, None, None) for one in step[key])
            for key in ("filter_skills", "perception_skills")
        )
        planned = (leg.seconds if leg else None) or seconds or 0.0
        patience, modes = PATIENCE * planned + SLACK, tuple(step["failure_modes"])
        return Stage(task["id"], number, movement, filters, sensors, patience, modes)

    def _filled(self, skill: str, motion: Motion | None) -> Entry:
        """[skill.NAME] of the simulation file, if any, with what fills its slot."""
        own, goto = self.raw.get("skill", {}).get(skill, {}), self.settings.goto
        if not isinstance(own, Mapping):
            return {}
        if goto == GUIDANCE or LEARNT not in own:
            return own
        given = motion and motion.kind == "go" and goto != LEARNT
        return {**own, "implementation": own[LEARNT], **({"policy": goto} if given else {})}

    def _job(
        self, task: Entry, number: int, skill: Entry, leg: Leg | None, seconds: float | None
    ) -> Job:
        name, vocabulary = skill["name"], self.vocabulary
        pace = leg.metres / leg.seconds if leg and leg.seconds and leg.metres else None
        speed = min(pace or self.vessel.cruise, self.speed(task["id"]))
        ring, motion = vocabulary.motion.standoff(task["title"]), vocabulary.motion.of(name)
        return Job(
            name,
            skill["parameters"],
            motion,
            self._filled(name, motion),
            task["id"],
            number,
            leg.points if leg else (),
            seconds,
            speed,
            place_of(task, vocabulary) if ring else None,
            float(self.document["vehicle"]["stand_off"]),
            self.settings.tolerance,
            vocabulary.skill[name].failure or "failed",
        )


def _polygon(corners: Sequence[Any], inside: bool) -> Fence:
    return Fence(tuple(map(point_of, corners)), inside)


def _all(stages: Sequence[Stage], role: str) -> list[Job]:
    """The filters or sensors of all stages, each once."""
    found: dict[str, Job] = {}
    for stage in stages:
        for job in getattr(stage, role):
            found.setdefault(f"{job.skill} {sorted(job.parameters.items())}", job)
    return list(found.values())
