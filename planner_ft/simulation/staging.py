"""From a plan document to stages that an executor runs, and everything that is refused before."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from planner_ft.document.limits import limits_of
from planner_ft.document.structures import ROUND, Allowed, Structure, fence, structures
from planner_ft.document.track import Leg, Point, place_of
from planner_ft.exporters.formats import PlanExport
from planner_ft.simulation.executor import Stage
from planner_ft.simulation.measures import Ring
from planner_ft.simulation.sensing import MEASURES
from planner_ft.simulation.skill import Job, implementation_of, settings_of
from planner_ft.simulation.slots import LEARNT, WAYPOINTS, Slots
from planner_ft.simulation.vessel import Vessel
from planner_ft.simulation.world import Fence, World
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.definition import SIMULATION, Motion

PATIENCE, SLACK = 3.0, 60.0
"""A step may take so many times what it is planned for, and so many seconds more."""
SQUARE = "square"  # the pattern of a task whose stand-off is half the side of a square


class Staging:
    """The stages of one plan. Raises PlannerError for a plan that cannot be run as a whole."""

    def __init__(
        self,
        plan: PlanExport,
        vessel: Vessel,
        raw: Mapping[str, Any],
        tolerance: float,
        slots: Slots | None = None,
    ) -> None:
        self.plan, self.vessel, self.raw, self.tolerance = plan, vessel, raw, tolerance
        self.slots = slots or Slots()
        self.slots.check(raw, plan.vocabulary.name)
        self.document, self.vocabulary = plan.document, plan.vocabulary
        self.legs = {(leg.task, leg.step): leg for leg in plan.track.legs}
        self.limits = limits_of(self.document, self.vocabulary)
        self.structures: list[Structure] = structures(self.document, self.vocabulary)
        self._check()

    def _check(self) -> None:
        way_out = "give its place with `plannerft review` or --locate of `plannerft plan`"
        for place in self.document["open_places"]:
            numbers = ", ".join(f"t{number}" for number in place["tasks"])
            verb = "need" if len(place["tasks"]) > 1 else "needs"
            problem = f"where {place['name']} is, is not known, and {numbers} {verb} it"
            raise PlannerError(f"{problem}; {way_out}")
        for task in self.document["tasks"]:
            if not task["skill_sequence"] or task.get("stale"):
                hint = "ask for them with `plannerft review`"
                raise PlannerError(f"{task['id']} has no skills that fit it; {hint}")
            if task["id"] in self.plan.track.open:
                problem = "its movement is not known in full (a radius, an angle or a motion lacks)"
                raise PlannerError(f"{task['id']} {task['title']}: {problem}; state it, plan again")
        if not self.document["tasks"]:
            raise PlannerError("the plan has no tasks; plan another command")

    @property
    def fences(self) -> list[Fence]:
        """The polygons that the whole plan keeps."""
        found = [
            Fence(_polygon(limit["values"]["polygon"]), limit["kind"] == "fence")
            for limit in self.limits
            if limit["kind"] in ("fence", "keep_out_area")
        ]
        area = self.document["vehicle"]["area"]
        return found + ([Fence(_polygon(area))] if area else [])

    @property
    def allowed(self) -> Allowed:
        """Whether a leg keeps the fences."""
        return fence(self.document, self.vocabulary)

    @property
    def seconds(self) -> float:
        """How long a run may take: the vehicle's endurance, or the plan's own limit."""
        return self._most("duration", self.vessel.endurance)

    @property
    def speed(self) -> float:
        """m/s that the plan may go at most."""
        return self._most("speed", self.vessel.speed)

    def _most(self, kind: str, own: float) -> float:
        """The vehicle's own limit, or the least that the plan states."""
        stated = [one["values"][kind] for one in self.limits if one["kind"] == kind]
        return float(min([own, *stated]))

    def rings(self) -> dict[str, Ring]:
        """The stand-off of each task that keeps one, by its id."""
        found = {}
        for task in self.document["tasks"]:
            own = self.vocabulary.motion.standoff(task["title"])
            center, known = place_of(task, self.vocabulary), self.vocabulary.task[task["title"]]
            radius = task["parameters"].get(own.radius) if own else None
            if center and radius and known.pattern in ROUND:
                found[task["id"]] = Ring(center, float(radius), known.pattern == SQUARE)
        return found

    def close(self) -> frozenset[str]:
        """Tasks that come close to a structure on purpose: they dock, or pass along it."""
        known = {task["id"]: self.vocabulary.task[task["title"]] for task in self.document["tasks"]}
        return frozenset(name for name, one in known.items() if one.docks or one.pattern == "pass")

    def check_starts(self, starts: Sequence[Point], world: World) -> None:
        """Raise PlannerError for a start in a structure, and for one or a home that a fence
        excludes.
        """
        import numpy as np

        home = self.vocabulary.home
        for polygon in self.fences if home not in starts else ():
            if polygon.outside_by(np.array([home]))[0] > 0:
                problem = "a fence of the plan excludes home, where runs that fail return to"
                raise PlannerError(f"{problem}; plan with another fence")
        for start, away in zip(starts, world.nearest(np.array(starts, float)), strict=True):
            shown = f"[{start[0]:g}, {start[1]:g}]"
            if away < self.vessel.radius:
                near = min(world.structures, key=lambda one: math.dist(start, one.position))
                problem = f"the vehicle would start in {near.name}, at {shown}"
                raise PlannerError(f"{problem}; give --start x,y or another place of it")
            for polygon in self.fences:
                if polygon.outside_by(np.array([start]))[0] > 0:
                    problem = f"a fence of the plan excludes the start {shown}"
                    raise PlannerError(f"{problem}; plan with another fence, or give --start x,y")

    def stages(self) -> Iterator[Stage]:
        """The steps of all tasks in their order."""
        for index, task in enumerate(self.document["tasks"]):
            own = self.plan.hold_time(index)
            stages = [
                self._stage(task, number, step, own[1] if own else None)
                for number, step in enumerate(task["skill_sequence"])
            ]
            job = self._survey(task)
            yield from self.slots.surveyed(stages, job) if job else stages

    def _survey(self, task: Mapping[str, Any]) -> Job | None:
        """The one movement that takes the place of a task's waypoints, where it is to."""
        learnt = self.raw.get("task", {}).get(task["title"], {}).get(LEARNT)
        ring = self.rings().get(task["id"])
        if self.slots.survey == WAYPOINTS or not learnt or not ring:
            return None
        name = next((one.name for one in self.structures if one.position == ring.center), None)
        folder = {} if self.slots.survey == LEARNT else {"policy": self.slots.survey}
        standoff = self.slots.standoff(name, ring.radius)
        settings = {"implementation": learnt, "standoff": standoff, **folder}
        speed = min(self.vessel.cruise, self.speed)
        where: dict[str, Any] = {"center": ring.center, "tolerance": self.tolerance, "speed": speed}
        motion, failure = Motion("go", {}), "survey failed"
        given = task["parameters"]
        return Job(task["title"], given, motion, settings, task["id"], failure=failure, **where)

    def check_skills(self, stages: Sequence[Stage]) -> None:
        """Raise PlannerError for a skill without implementation and an unknown measure."""
        for stage in stages:
            for job in (stage.movement, *stage.filters, *stage.sensors):
                implementation_of(job).check(job, self.vessel)
                if (measure := job.settings.get("measure")) not in (None, *MEASURES):
                    where = f"{self.vocabulary.name}{SIMULATION}: [skill.{job.skill}]"
                    problem = f"measure = {measure!r} must be one of {', '.join(MEASURES)}"
                    raise PlannerError(f"{where}: {problem}")

    def home(self) -> Stage:
        """The way home, with the vehicle's filters that keep clear and inside."""
        movement = Job(
            *("way home", {}, Motion("go", {}), {}, "home", 0, (self.vocabulary.home,)),
            speed=min(self.vessel.cruise, self.speed),
            tolerance=self.tolerance,
            failure="home not reached",
        )
        margin, known = self.document["vehicle"]["stand_off"], self.vocabulary.motion.skills
        filters = [
            Job(name, {}, motion, {}, "home", 0, margin=margin)
            for name, motion in known.items()
            if motion.kind == "clearance" or (motion.kind == "boundary" and self.fences)
        ]
        return Stage("home", 0, movement, tuple(filters), (), self.seconds, ())

    def _stage(
        self, task: Mapping[str, Any], number: int, step: Mapping[str, Any], own: float | None
    ) -> Stage:
        leg = self.legs.get((task["id"], number))
        skill = step["navigation_skill"]
        motion = self.vocabulary.motion.of(skill["name"])
        stated = motion.value("time", skill["parameters"]) if motion else None
        seconds = own if stated is None else float(stated)
        stays = leg is not None and leg.kind in ("hold", "drift")
        movement = self._job(task, number, skill, leg, seconds if stays else None)
        filters = [self._job(task, number, one, None, None) for one in step["filter_skills"]]
        sensors = [self._job(task, number, one, None, None) for one in step["perception_skills"]]
        planned = (leg.seconds if leg else None) or seconds or 0.0
        patience = PATIENCE * planned + SLACK
        modes = tuple(step["failure_modes"])
        return Stage(task["id"], number, movement, tuple(filters), tuple(sensors), patience, modes)

    def _job(
        self,
        task: Mapping[str, Any],
        number: int,
        skill: Mapping[str, Any],
        leg: Leg | None,
        seconds: float | None,
    ) -> Job:
        name, vocabulary = skill["name"], self.vocabulary
        pace = leg.metres / leg.seconds if leg and leg.seconds and leg.metres else None
        speed = min(pace or self.vessel.cruise, self.speed, self.vessel.speed)
        ring, motion = vocabulary.motion.standoff(task["title"]), vocabulary.motion.of(name)
        kind = motion.kind if motion else None
        return Job(
            name,
            skill["parameters"],
            motion,
            self.slots.settings(settings_of(vocabulary, self.raw, name), kind),
            task["id"],
            number,
            leg.points if leg else (),
            seconds,
            speed,
            place_of(task, vocabulary) if ring else None,
            float(self.document["vehicle"]["stand_off"]),
            self.tolerance,
            vocabulary.skill[name].failure or "failed",
        )


def _polygon(corners: Sequence[Sequence[float]]) -> tuple[Point, ...]:
    return tuple((float(x), float(y)) for x, y in corners)
