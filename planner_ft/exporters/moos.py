"""A plan as a behaviour file (.bhv) for the helm of MOOS-IvP.

Every movement is a behaviour that runs while MISSION_STEP holds its number, and sets the next when
it is complete. Boundaries and clearances are behaviours beside them. Skills that no behaviour does
are posted as SKILL_ variables for apps of the vehicle, and words stand in comments.
docs/exporters.md says how it is used; the sources of the syntax are named in moos_text and
moos_behaviours.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from planner_ft.exporters.formats import Format, PlanExport, Written
from planner_ft.exporters.ledger import LISTS, Ledger, Path
from planner_ft.exporters.moos_behaviours import (
    TABLE,
    Guard,
    Move,
    guard_form,
    guards,
    is_region,
    move_of,
)
from planner_ft.exporters.moos_text import block, comment, is_changed, quoted, variable
from planner_ft.support.files import compact_json
from planner_ft.vocabulary.plans import step_skills

STEP = "MISSION_STEP"
FIRST, SECOND = "move", "speed"
"""Endings of the names of a movement's behaviours."""
DEFAULT_SPEED = 1.0
"""Metres per second where the plan's vehicle says none."""
NO_SKILL = {"name": "", "parameters": {}}


def write(plan: PlanExport) -> Written:
    """The behaviour file of a plan, up to the first task whose movement is not known."""
    return _File(plan).written()


@dataclass(frozen=True)
class _Place:
    """A movement in the plan: its number from 1, its task's index, where its step stands and what
    it says (None and nothing: a task without skills), its name, and what is done.
    """

    number: int
    task: int
    at: Path | None
    step: Mapping[str, Any]
    name: str
    move: Move


class _File:
    """Builds the file and keeps account of it."""

    def __init__(self, plan: PlanExport) -> None:
        self.plan, self.document, self.vocabulary = plan, plan.document, plan.vocabulary
        self.ledger: Ledger = plan.ledger()
        vehicle = self.document.get("vehicle") or {}
        self.area = vehicle.get("area")
        self.cruise_speed = float(vehicle.get("cruise_speed") or DEFAULT_SPEED)
        self.tasks = self.document["tasks"][: plan.ready]
        self.places = list(self._places())

    def _places(self) -> Iterator[_Place]:
        """The movements of every task that can be exported; a step whose movement is not known is
        lost.
        """
        legs = {(leg.task, leg.step): leg for leg in self.plan.track.legs}
        count = itertools.count(1)
        for index, task in enumerate(self.tasks):
            steps = task["skill_sequence"]
            for number, step in enumerate([{}] if steps is None else steps):
                skill = step.get("navigation_skill", NO_SKILL)
                motion = self.vocabulary.motion.of(skill["name"])
                at: Path | None = ("tasks", index, "skill_sequence", number) if step else None
                move = None
                if motion or at is None:
                    leg = legs.get((task["id"], number))
                    move = move_of(motion, skill["parameters"], leg, self.cruise_speed)
                if move:
                    name = f"{task['id']}_{number + 1}"
                    yield _Place(next(count), index, at, step, name, move)
                elif at:
                    self.ledger.lose(*at, why=TABLE["unknown"])

    def written(self) -> Written:
        lines = [*self._head(), ""]
        for guard in guards(self._filters()):
            lines += [*self._guard(guard), ""]
        for index, task in enumerate(self.tasks):
            lines += [*comment("-" * 100), *self._task_words(index, task)]
            for place in self.places:
                if place.task == index:
                    lines += [*self._movement(place), ""]
        if self.plan.blocked:
            lines += comment(f"the plan goes on, and this file does not: {self.plan.blocked[1]}")
            self.plan.lose_blocked(self.ledger)
        return Written("\n".join(lines).rstrip() + "\n", self.ledger.close())

    # ------------------------------------------------------------ words

    def _head(self) -> Iterator[str]:
        """The words of the plan as a whole, and the variables with which the mission begins."""
        where, origin = (
            "LatOrigin and LongOrigin are where the plan's [0, 0] lies",
            self.plan.origin,
        )
        if origin:
            where = f"LatOrigin = {origin.latitude:.8f}, LongOrigin = {origin.longitude:.8f}"
        yield from comment(self.plan.name)
        yield from comment(f"approval: {self.plan.mark}")
        yield from comment(f"{self.vocabulary.frame}: the helm's own x and y")
        yield from comment(f"in the .moos file: {where}")
        for path, item in self.ledger.items.items():
            if path[0] not in ("tasks", "open_places"):
                command = f"command: {self.document['command']}"
                yield from comment(command if path == ("command",) else item.what)
                self.ledger.carry(*path, form=TABLE["comment"])
        yield from ("", "initialize DEPLOY = false", f"initialize {STEP} = 1")
        yield from (
            "initialize MISSION = open",
            f"initialize MISSION_NAME = {quoted(self.plan.name)}",
        )

    def _task_words(self, index: int, task: Mapping[str, Any]) -> Iterator[str]:
        yield from comment(f"{task['id']} {task['title']}: {task['task_prompt']}")
        for path, item in self.ledger.items.items():
            if path[:2] == ("tasks", index) and path[2] != "skill_sequence":
                if path[2] not in ("title", "task_prompt"):
                    yield from comment(item.what)
                self.ledger.carry(*path, form=TABLE["comment"])

    # ------------------------------------------------------------ movements

    def _movement(self, place: _Place) -> Iterator[str]:
        skill = place.step.get("navigation_skill", NO_SKILL)
        yield from comment(f"{place.name}: {skill['name']} {compact_json(skill['parameters'])}")
        for key in LISTS:
            if place.step.get(key):
                yield from comment(f"{key.replace('_', ' ')}: {'; '.join(place.step[key])}")
        if place.at:
            self._account(place.at, place.step, place.move)
        else:
            known = self.vocabulary.task[self.tasks[place.task]["title"]]
            self.ledger.carry("tasks", place.task, "parameters", known.position_parameter or "")
        # The helm takes no name that another one begins with: "t1_1" and "t1_10" could not stand in
        # one file.
        base = [("pwt", "100"), ("condition", "DEPLOY = true")]
        base.append(("condition", f"{STEP} = {place.number}"))
        for number, (kind, settings) in enumerate(place.move.behaviours):
            name = f"{place.name}_{SECOND if number else FIRST}"
            flags = [] if number else list(self._flags(place))
            yield from block(kind, name, [*base, *flags, *settings])

    def _flags(self, place: _Place) -> Iterator[tuple[str, str]]:
        """The skills beside the movement: on with their parameters when the step begins, off when
        it ends; and the next step.
        """
        beside = [skill for role, skill in step_skills(place.step) if role != "navigation"]
        for skill in beside:
            state = "on"
            for key, value in skill["parameters"].items():
                state += f"; {key}={value if isinstance(value, str) else compact_json(value)}"
            yield "activeflag", f"{variable(skill['name'])} = {quoted(state)}"
        ending = "endflag" if place.move.ends else "idleflag"
        for name in dict.fromkeys(skill["name"] for skill in beside):
            yield ending, f"{variable(name)} = {quoted('off')}"
        if place.move.ends:
            yield "endflag", f"{STEP} = {place.number + 1}"
            if place.number == len(self.places):
                yield "endflag", f"MISSION = {'partly' if self.plan.blocked else 'complete'}"
                yield "endflag", "DEPLOY = false"

    def _account(self, at: Path, step: Mapping[str, Any], move: Move) -> None:
        """Enter what becomes of a step's movement and words; `_filters` enters its other skills."""
        skill, steered = step["navigation_skill"], (*at, "navigation_skill")
        self.ledger.carry(*steered, "name", form="" if move.ends else TABLE["unended"])
        motion = self.vocabulary.motion.of(skill["name"])
        roles = {key: role for role, key in motion.parameters.items()} if motion else {}
        for key in skill["parameters"]:
            role = roles.get(key, key)
            if role in move.forms:
                self.ledger.carry(*steered, "parameters", key, form=move.forms[role])
            else:
                why = move.losses.get(role, TABLE["no_setting"])
                self.ledger.lose(*steered, "parameters", key, why=why)
        own = self.vocabulary.skill[skill["name"]].stop if move.ends else None
        for words in LISTS:
            for number, text in enumerate(step[words]):
                kept = words == "stop_conditions" and text == own
                self.ledger.carry(*at, words, number, form="" if kept else TABLE["texts"][words])

    # ------------------------------------------------------------ filters

    def _filters(self) -> Iterator[tuple[int, str, Any]]:
        """(number of the movement, kind, polygon or distance) of every filter that a behaviour
        stands for; the rest are flags alone.
        """
        if self.area:
            region = is_region(self.area)
            self.ledger.carry("vehicle", "area", form="" if region else TABLE["area"])
            if region:
                yield from ((place.number, "boundary", self.area) for place in self.places)
        for place in self.places:
            if place.at is None:
                continue
            for key in ("filter_skills", "perception_skills"):
                for number, skill in enumerate(place.step[key]):
                    form, guard = self._guarded(skill)
                    self.ledger.carry(*place.at, key, number, form=form)
                    if guard:
                        yield (place.number, *guard)

    def _guarded(self, skill: Mapping[str, Any]) -> tuple[str, tuple[str, Any] | None]:
        """(how the file holds a skill beside a movement, (kind, polygon or distance) where a
        behaviour stands for it).
        """
        motion, given = self.vocabulary.motion.of(skill["name"]), skill["parameters"]
        if motion and motion.kind in ("boundary", "clearance"):
            value = motion.value("polygon" if motion.kind == "boundary" else "distance", given)
            stands, form = guard_form(motion.kind, value)
            return form, (motion.kind, value) if stands else None
        changed = any(map(is_changed, [skill["name"], *map(str, given.values())]))
        return f"{TABLE['flag']}; {TABLE['changed']}" if changed else TABLE["flag"], None

    def _guard(self, guard: Guard) -> list[str]:
        span = f"{STEP} = {guard.first}"
        if guard.first != guard.last:
            span = f"({STEP} >= {guard.first}) and ({STEP} <= {guard.last})"
        base = [("pwt", "500"), ("condition", "DEPLOY = true"), ("condition", span)]
        return block(guard.behaviour, guard.name, [*base, *guard.settings])


FORMAT = Format("moos", ".bhv", "behaviour file for the helm of MOOS-IvP", False, write)
