"""A plan as a behaviour file (.bhv) for the helm of MOOS-IvP.

Every movement is a behaviour that runs while MISSION_STEP holds its number, and sets the next when
it is complete. Boundaries and clearances are behaviours beside them. What no behaviour does is
posted as SKILL_ variables for apps of the vehicle, and words stand in comments. docs/handover.md
says how it is used; the sources of the syntax are named in moos_text and moos_moves.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from planner_ft.exporters.formats import Format, Handover, Written
from planner_ft.exporters.ledger import LISTS, Item, Ledger, Path
from planner_ft.exporters.moos_filters import GUARDED, Guard, guards, is_region
from planner_ft.exporters.moos_moves import UNENDED, Move, move_of
from planner_ft.exporters.moos_text import CHANGED, Behaviour, comment, is_changed, quoted, variable
from planner_ft.support.files import compact_json
from planner_ft.vocabulary.plans import step_skills

STEP = "MISSION_STEP"
COMMENT_FORM = "as words in a comment, which no app reads"
FLAG_FORM = "posted as a SKILL_ variable, on which no app of MOOS-IvP itself acts"
WORDS_FORM = {
    "stop_conditions": "as words in a comment: the behaviour ends the step by its own criteria",
    "failure_modes": "as words in a comment: the helm does not watch for it",
    "expected_outputs": COMMENT_FORM,
}
AREA_FORM = f"{COMMENT_FORM}: the helm's boundary must be convex, and this one is not"
FIRST, SECOND = "move", "speed"
"""What the name of a movement's behaviours ends with."""
UNKNOWN = (
    "the plan does not say the movement: where it begins, its radius and its angle must be known"
)
DEFAULT_SPEED = 1.0
"""Metres per second where the plan's vehicle says none."""


def write(handover: Handover) -> Written:
    """The behaviour file of a plan, up to the first task whose movement is not known."""
    return _File(handover).written()


@dataclass(frozen=True)
class _Place:
    """A movement in the plan: its number from 1, its task's index, its step in the task (None: a
    task without skills), and what is done.
    """

    number: int
    task: int
    step: int | None
    name: str
    move: Move


class _File:
    """Builds the file and keeps account of it."""

    def __init__(self, handover: Handover) -> None:
        self.handover, self.document, self.vocabulary = (
            handover,
            handover.document,
            handover.vocabulary,
        )
        self.ledger: Ledger = handover.ledger()
        self.cruise_speed = float(
            (self.document.get("vehicle") or {}).get("cruise_speed") or DEFAULT_SPEED
        )
        self.places = list(self._places())
        self.notes: dict[int, list[Item]] = {}
        for item in self.ledger.items.values():
            if item.path[0] == "tasks" and item.path[2] != "skill_sequence":
                self.notes.setdefault(int(item.path[1]), []).append(item)

    def _places(self) -> Iterator[_Place]:
        """The movements of every task that can be handed over; a step whose movement is not known
        is lost.
        """
        legs = {(leg.task, leg.step): leg for leg in self.handover.track.legs}
        numbers = itertools.count(1)
        for index, task in enumerate(self.document["tasks"][: self.handover.ready]):
            for number, skill in enumerate(
                [None]
                if task["skill_sequence"] is None
                else [step["navigation_skill"] for step in task["skill_sequence"]]
            ):
                motion = self.vocabulary.motion.of(skill["name"]) if skill else None
                known = skill is None or motion is not None
                move = (
                    move_of(
                        motion,
                        skill["parameters"] if skill else {},
                        legs.get((task["id"], number)),
                        self.cruise_speed,
                    )
                    if known
                    else None
                )
                if move:
                    yield _Place(
                        next(numbers),
                        index,
                        number if skill else None,
                        f"{task['id']}_{number + 1}",
                        move,
                    )
                elif skill:
                    self.ledger.lose("tasks", index, "skill_sequence", number, why=UNKNOWN)

    def written(self) -> Written:
        lines = [*self._head(), ""]
        for guard in guards(self._filters()):
            lines += [*self._guard(guard), ""]
        of_task = {
            index: list(places)
            for index, places in itertools.groupby(self.places, key=lambda place: place.task)
        }
        for index in range(self.handover.ready):
            lines += [*comment("-" * 100), *self._task_words(index)]
            for place in of_task.get(index, ()):
                lines += [*self._movement(place), ""]
        if self.handover.blocked:
            first, why = self.handover.blocked
            lines += comment(f"the plan goes on, and this file does not: {why}")
            for index in range(first, len(self.document["tasks"])):
                self.ledger.lose("tasks", index, why=why)
        return Written("\n".join(lines).rstrip() + "\n", self.ledger.close())

    # ------------------------------------------------------------ words

    def _head(self) -> Iterator[str]:
        """What the plan says as a whole, and the variables with which the mission begins."""
        yield from comment(self.handover.name)
        yield from comment(f"approval: {self.handover.mark}")
        yield from comment(f"{self.vocabulary.frame}: the helm's own x and y")
        origin = self.handover.origin
        where = (
            f"LatOrigin = {origin.latitude:.8f}, LongOrigin = {origin.longitude:.8f}"
            if origin
            else "LatOrigin and LongOrigin are where the plan's [0, 0] lies"
        )
        yield from comment(f"in the .moos file: {where}")
        for path, item in self.ledger.items.items():
            if path[0] not in ("tasks", "open_places"):
                yield from comment(
                    f"command: {self.document['command']}" if path == ("command",) else item.what
                )
                self.ledger.carry(*path, form=COMMENT_FORM)
        yield from (
            "",
            "initialize DEPLOY = false",
            f"initialize {STEP} = 1",
            "initialize MISSION = open",
        )
        yield f"initialize MISSION_NAME = {quoted(self.handover.name)}"

    def _task_words(self, index: int) -> Iterator[str]:
        task = self.document["tasks"][index]
        yield from comment(f"{task['id']} {task['title']}: {task['task_prompt']}")
        for item in self.notes[index]:
            if item.path[2] not in ("title", "task_prompt"):
                yield from comment(item.what)
            self.ledger.carry(*item.path, form=COMMENT_FORM)

    # ------------------------------------------------------------ movements

    def _movement(self, place: _Place) -> Iterator[str]:
        step: Mapping[str, Any] = (
            {}
            if place.step is None
            else self.document["tasks"][place.task]["skill_sequence"][place.step]
        )
        skill = step.get("navigation_skill", {"name": "", "parameters": {}})
        yield from comment(f"{place.name}: {skill['name']} {compact_json(skill['parameters'])}")
        for key in LISTS:
            if step.get(key):
                yield from comment(f"{key.replace('_', ' ')}: {'; '.join(step[key])}")
        if place.step is None:
            self.ledger.carry(
                "tasks",
                place.task,
                "parameters",
                self.vocabulary.task[self.document["tasks"][place.task]["title"]].position_parameter
                or "",
            )
        else:
            self._account(("tasks", place.task, "skill_sequence", place.step), step, place.move)
        for number, (kind, settings) in enumerate(place.move.behaviours):
            yield from self._behaviour(place, step, number, kind, settings)

    def _behaviour(
        self,
        place: _Place,
        step: Mapping[str, Any],
        number: int,
        kind: str,
        settings: list[tuple[str, str]],
    ) -> list[str]:
        """A block of the file. The first behaviour of a movement posts its flags, and the next
        step.
        """
        # The helm takes no name that another one begins with: "t1_1" and "t1_10" could not stand in
        # one file.
        name = f"{place.name}_{SECOND if number else FIRST}"
        conditions = [("condition", "DEPLOY = true"), ("condition", f"{STEP} = {place.number}")]
        flags = (
            []
            if number
            else [
                *self._flags(step, place.move),
                *([("endflag", flag) for flag in self._next(place)] if place.move.ends else []),
            ]
        )
        return Behaviour(kind, name, [("pwt", "100"), *conditions, *flags, *settings]).lines()

    def _flags(self, step: Mapping[str, Any], move: Move) -> Iterator[tuple[str, str]]:
        """The skills beside the movement: on with their parameters when the step begins, off when
        it ends.
        """
        beside = [skill for role, skill in step_skills(step) if role != "navigation"]
        for skill in beside:
            told = "; ".join(
                [
                    "on",
                    *(
                        f"{key}={value if isinstance(value, str) else compact_json(value)}"
                        for key, value in skill["parameters"].items()
                    ),
                ]
            )
            yield "activeflag", f"{variable(skill['name'])} = {quoted(told)}"
        for name in dict.fromkeys(skill["name"] for skill in beside):
            yield "endflag" if move.ends else "idleflag", f"{variable(name)} = {quoted('off')}"

    def _next(self, place: _Place) -> list[str]:
        if place.number < len(self.places):
            return [f"{STEP} = {place.number + 1}"]
        return [
            f"{STEP} = {place.number + 1}",
            f"MISSION = {'partly' if self.handover.blocked else 'complete'}",
            "DEPLOY = false",
        ]

    def _account(self, at: Path, step: Mapping[str, Any], move: Move) -> None:
        """Enter what becomes of a step's movement and words. Its other skills are flags; `_guard`
        enters what becomes more than that.
        """
        skill = step["navigation_skill"]
        self.ledger.carry(*at, "navigation_skill", "name", form="" if move.ends else UNENDED)
        motion = self.vocabulary.motion.of(skill["name"])
        roles = {key: role for role, key in motion.parameters.items()} if motion else {}
        for key in skill["parameters"]:
            role = roles.get(key, key)
            if role in move.forms:
                self.ledger.carry(*at, "navigation_skill", "parameters", key, form=move.forms[role])
            else:
                self.ledger.lose(
                    *at,
                    "navigation_skill",
                    "parameters",
                    key,
                    why=move.losses.get(role, "no behaviour has a setting for it"),
                )
        own = self.vocabulary.skill[skill["name"]].stop if move.ends else None
        for words in LISTS:
            for number, text in enumerate(step[words]):
                self.ledger.carry(
                    *at,
                    words,
                    number,
                    form="" if words == "stop_conditions" and text == own else WORDS_FORM[words],
                )

    # ------------------------------------------------------------ filters

    def _filters(self) -> Iterator[tuple[int, str, Any]]:
        """(number of the movement, kind, polygon or distance) of every filter that a behaviour
        stands for; the rest are flags alone.
        """
        yield from self._area()
        for place in self.places:
            if place.step is None:
                continue
            at: Path = ("tasks", place.task, "skill_sequence", place.step)
            step = self.document["tasks"][place.task]["skill_sequence"][place.step]
            for key in ("filter_skills", "perception_skills"):
                for number, skill in enumerate(step[key]):
                    motion = self.vocabulary.motion.of(skill["name"])
                    told = [skill["name"], *(str(value) for value in skill["parameters"].values())]
                    self.ledger.carry(
                        *at,
                        key,
                        number,
                        form=f"{FLAG_FORM}; {CHANGED}" if any(map(is_changed, told)) else FLAG_FORM,
                    )
                    if motion and motion.kind in GUARDED:
                        value = motion.value(
                            "polygon" if motion.kind == "boundary" else "distance",
                            skill["parameters"],
                        )
                        guarded, form = GUARDED[motion.kind](value)
                        self.ledger.carry(*at, key, number, form=form)
                        if guarded:
                            yield place.number, motion.kind, value

    def _area(self) -> Iterator[tuple[int, str, Any]]:
        """The vehicle's area, as a boundary of every movement."""
        area = (self.document.get("vehicle") or {}).get("area")
        if not area:
            return
        if is_region(area):
            self.ledger.carry("vehicle", "area")
            yield from ((place.number, "boundary", area) for place in self.places)
        else:
            self.ledger.carry("vehicle", "area", form=AREA_FORM)

    def _guard(self, guard: Guard) -> Iterator[str]:
        span = (
            f"{STEP} = {guard.first}"
            if guard.first == guard.last
            else f"({STEP} >= {guard.first}) and ({STEP} <= {guard.last})"
        )
        yield from Behaviour(
            guard.behaviour,
            guard.name,
            [("pwt", "500"), ("condition", "DEPLOY = true"), ("condition", span), *guard.settings],
        ).lines()


FORMAT = Format(
    "moos", ".bhv", "behaviour file for the helm of MOOS-IvP", needs_origin=False, write=write
)
