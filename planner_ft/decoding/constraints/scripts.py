"""The logic of plans: what may follow the tasks of a mission plan and the steps of a skill sequence.

The rules of missions read the vocabulary's fields (locate, transit, unresolved, a task's arrival,
leaves and pattern) and hold for any vehicle. A place that is not known yet needs a search before
it; a target is searched once; a task that is performed at a place follows what brings the vehicle
there; nothing goes to where the vehicle is. They are those of the labelling rules that need no
reading of the command: whether a vehicle that a survey took elsewhere goes on where it is then,
only the command says.

A skill stands in a step once, or again with another value, and the same movement does not come
without end. Where waypoints follow from the facts of the task (`waypoints`), which one may come
next depends on those before it.
"""

from __future__ import annotations

import functools
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from planner_ft.decoding.constraints import grammar as lark
from planner_ft.decoding.constraints.grammar import Context, Grammar, Options, Script, key
from planner_ft.decoding.constraints.patterns import literal, regex
from planner_ft.decoding.constraints.waypoints import Path, Waypoints
from planner_ft.vocabulary import Parameter, Skill, Task
from planner_ft.vocabulary.definition import Role
from planner_ft.vocabulary.plans import STEP_KEYS, WORKING, without_working
from planner_ft.vocabulary.replay import START, Progress, target_parameter


@dataclass(frozen=True)
class MissionScript(Script):
    """A mission plan: the titles that may follow, then what follows the `chosen` title."""

    opens: str = lark.TASK_OPENS
    most: int = lark.MOST_TASKS
    progress: Progress = START

    def opening(self) -> str:
        grammar = Grammar()
        opens, first = literal(lark.mission_opens()), literal(lark.TASK_OPENS)
        return grammar.text(f"{opens} ({first} | {lark.mission_closes(grammar, self.values)})")

    @property
    def known(self) -> Sequence[Task]:
        return self.vocabulary.tasks

    def offers(self, owner: Task) -> bool:
        fits = not self.logical or self.progress.offers(owner)
        return fits and lark.possible(owner, self)

    def read(self, text: str) -> MissionScript:
        progress = self.progress
        if self.written:
            entry, _end = json.JSONDecoder().raw_decode(text)
            task = self.vocabulary.task[entry["title"]]
            progress = progress.after(task, entry["parameters"], self.vocabulary)
        return replace(self, progress=progress, chosen=None, written=lark.TASK_OPENS)

    def behind(self, owners: Sequence[Task], *, names: bool) -> str:
        grammar = Grammar()
        entries = " | ".join(self.entry(grammar, task, named=not names) for task in owners)
        more = f"{literal(',' + lark.TASK_OPENS)} | " if self.progress.tasks + 1 < self.most else ""
        return grammar.text(f"({entries}) ({more}{lark.mission_closes(grammar, self.values)})")

    # ------------------------------------------------------------ what the tasks so far leave

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task, context: Context
    ) -> Options:
        if self.logical and parameter.name == owner.position_parameter:
            symbol = self._place(grammar, owner, identified=context >= lark.IDENTIFIED)
        elif self._is_target(parameter, owner):
            searched = [target for target in self.progress.searched if target]
            symbol = self.values.text(grammar, searched)
        else:
            return super().parameter(grammar, parameter, owner, context)
        return [(symbol, context)] if symbol else []

    def needs(self, parameter: Parameter, owner: Task) -> bool:
        # Two searches that name no target are the same search.
        again = self._is_target(parameter, owner) and "" in self.progress.searched
        return super().needs(parameter, owner) or again

    def _is_target(self, parameter: Parameter, owner: Task) -> bool:
        search = self.logical and owner.title == self.vocabulary.locate
        return search and parameter == target_parameter(owner)

    def _place(self, grammar: Grammar, task: Task, *, identified: bool) -> str | None:
        progress, unresolved, at = self.progress, self.vocabulary.unresolved, self.progress.here
        unknown = not identified and (bool(progress.searched) or task.docks)
        if task.arrival == "transit":
            lost = at is None or (at == unresolved and not unknown)
            return None if at is None or lost else literal(lark.written(at))
        without = [] if unknown else [unresolved]
        # Two places that are not known yet look the same: behind a second search, unresolved can be
        # another place.
        same = at == unresolved and len(progress.searched) > 1
        if task.title == self.vocabulary.transit and at and not (same or progress.moved):
            without.append(at)
        return self.values.position(grammar, without)


LONGEST_WORKING = 600
"""Characters of a working. The longest of 3,000 sampled tasks has 250."""
SUMS = r"[xy0-9.+/=;\-]"
"""Signs of a working (data.task.working); its form is not enforced: wrong sums derive nothing."""
STEP_OPENS = "{" + key(STEP_KEYS[0]) + lark.SKILL_OPENS
FILTERS, PERCEPTIONS = (key(name) + "[" for name in STEP_KEYS[1:3])
CLOSES = "]}"
MOST_ALIKE = 4
"""Uses of a skill in one step."""
MOST_SAME, MOST_RUN = 12, 36
"""Equal steps in a row, and movements that go nowhere: a turn in 36 steps has 10 degrees each."""

Step = tuple[Skill, Mapping[str, Any]]
"""A skill and its parameters."""


@dataclass(frozen=True)
class TaskScript(Script):
    """The parts of an answer: the names that may follow, then what stands behind the chosen name,
    up to the next one.

    `waypoints` are those that the facts give, None where any may be meant; a path of `whole` is not
    left before its end. `steps` are the movements so far, with the one of the step that is being
    written, `beside` the skills before the chosen one in its list.
    """

    opens: str = lark.SKILL_OPENS
    most: int = lark.MOST_STEPS
    waypoints: Waypoints | None = None
    whole: Waypoints | None = None
    steps: tuple[Step, ...] = ()
    role: Role = "navigation"
    beside: tuple[Step, ...] = ()

    def opening(self) -> str:
        grammar = Grammar()
        sums = grammar.terminal(regex(f'"{SUMS}{{1,{LONGEST_WORKING}}}"'))
        opens = f'"{{" ({literal(key(WORKING))} {sums} ",")? {literal(key("skill_sequence") + "[")}'
        return grammar.text(f"{opens} ({literal(STEP_OPENS)} | {literal(CLOSES)})")

    @property
    def known(self) -> Sequence[Skill]:
        return self.vocabulary.skills_in_role(self.role)

    def read(self, text: str) -> TaskScript:
        if not self.written:
            shown = self.waypoints.shown(without_working(text)[1]) if self.waypoints else None
            return replace(self, waypoints=shown, written=STEP_OPENS)
        steps = self.steps
        if self.role == "navigation":
            begins = len(STEP_OPENS) - len(lark.SKILL_OPENS)
            entry, _end = json.JSONDecoder().raw_decode(text, begins)
            steps = (*steps, (self.vocabulary.skill[entry["name"]], entry["parameters"]))
        ahead = replace(self, steps=steps, chosen=None)
        if text.endswith(STEP_OPENS):
            return replace(ahead, role="navigation", beside=(), written=STEP_OPENS)
        role: Role = "perception" if PERCEPTIONS in text else "filter"
        step = json.loads(text.removesuffix(lark.SKILL_OPENS).removesuffix(",") + "]}")
        known, listed = self.vocabulary.skill, step[f"{role}_skills"]
        beside = tuple((known[one["name"]], one["parameters"]) for one in listed)
        return replace(ahead, role=role, beside=beside, written=text)

    def offers(self, owner: Skill) -> bool:
        if self.logical and self.role == "navigation":
            latest = self.steps[-MOST_SAME:]
            same = len(latest) == MOST_SAME and all(step == latest[0] for step in latest)
            run = [step[0] for step in self.steps[-MOST_RUN:]]
            long = not owner.coordinates and run.count(owner) == MOST_RUN
            return not ((same and latest[0][0] == owner) or long)
        used = self._used(owner)
        if self.logical and used and not (all(used) and len(used) < MOST_ALIKE):
            return False
        return lark.possible(owner, self)

    def behind(self, owners: Sequence[Skill], *, names: bool) -> str:
        grammar, options = Grammar(), []
        for skill in owners:
            if self.role == "navigation":
                going = bool(skill.coordinates)
                ends = f"{literal(',' + FILTERS)} {self._list(grammar, 'filter', (), going)}"
            else:
                used = [other for other, _parameters in self.beside]
                ends = self._list(grammar, self.role, (*used, skill))
            options.append(f"{self.entry(grammar, skill, named=not names)} {ends}")
        return grammar.text(" | ".join(options))

    def _list(
        self, grammar: Grammar, role: Role, used: Sequence[Skill], going: bool = False
    ) -> str:
        """The next skill of a role's list behind those used, or what follows the list. `going`: a
        waypoint is chosen in the same part.
        """
        if role == "filter":
            perceptions = self._list(grammar, "perception", (), going)
            behind = f"{literal('],' + PERCEPTIONS)} {perceptions}"
        else:
            count = len(self.steps) + (self.role == "navigation")
            ways = [literal("," + STEP_OPENS)] if count < self.most else []
            if not (ways and self.whole and self.whole.unfinished(self._path, int(going))):
                ways.append(literal(CLOSES))
            keys, texts = STEP_KEYS[3:], self.values.step_texts
            tail = (f"{literal(',' + key(name))} {texts(grammar, name)}" for name in keys)
            reports = grammar.rule(f"{' '.join(tail)} {literal('}')}")
            behind = f"{literal(']')} {reports} ({' | '.join(ways)})"
        more = len(used) < lark.MOST_SKILLS and any(
            not (self.logical and skill in used)
            or (skill.parameters and used.count(skill) < MOST_ALIKE)
            for skill in self.vocabulary.skills_in_role(role)
        )
        return f"({literal(',' * bool(used) + lark.SKILL_OPENS)} | {behind})" if more else behind

    # ------------------------------------------------------------ what the steps so far leave

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Skill, context: Context
    ) -> Options:
        """No unresolved place, for a destination one of the waypoints where there are any, and for
        a skill that was used in its step another value of the parameter that it was used with.
        """
        kind = parameter.type
        if self.logical and parameter in owner.coordinates:
            axis = owner.coordinates.index(parameter)
            if self._columns:
                return self._waypoint(grammar, axis, context)
            return self._coordinate(grammar, parameter, axis, context)
        if self.logical and kind == "polygon":
            corner = self.values.position(grammar, (self.vocabulary.unresolved,))
            symbol = lark.corners(grammar, corner) if corner else None
        elif parameter == self._telling(owner) and kind in ("number", "integer", "text", "id"):
            used = [one[parameter.name] for one in self._used(owner) if parameter.name in one]
            if kind in ("text", "id"):
                symbol = self.values.text(grammar, [str(value) for value in used])
            else:
                numbers = [value for value in used if isinstance(value, int | float)]
                symbol = self.values.number(grammar, parameter, numbers)
        else:
            return super().parameter(grammar, parameter, owner, context)
        return [(symbol, context)] if symbol else []

    def needs(self, parameter: Parameter, owner: Skill) -> bool:
        return super().needs(parameter, owner) or parameter == self._telling(owner)

    def _used(self, skill: Skill) -> list[Mapping[str, Any]]:
        return [parameters for other, parameters in self.beside if other == skill]

    def _telling(self, owner: Skill) -> Parameter | None:
        """The parameter that tells one use of a skill from the other."""
        named = {name for one in self._used(owner) for name in one} if self.logical else ()
        return next((item for item in owner.parameters if item.name in named), None)

    @property
    def _path(self) -> Path:
        """The waypoints so far."""
        pairs = ((skill.coordinates, values) for skill, values in self.steps if skill.coordinates)
        return tuple((values[x.name], values[y.name]) for (x, y), values in pairs)

    @functools.cached_property
    def _columns(self) -> dict[str, list[str]]:
        """The waypoints that may follow: y by x, as they are written."""
        columns: dict[str, list[str]] = {}
        for point in self.waypoints.following(self._path) if self.waypoints else ():
            x, y = map(lark.written, point)
            columns.setdefault(x, []).append(y)
        return columns

    def _waypoint(self, grammar: Grammar, axis: int, context: Context) -> Options:
        """A coordinate of one of the points."""
        if axis == 0:
            return [(literal(x), context | {f"x {x}"}) for x in self._columns]
        column = next(mark for mark in context if mark.startswith("x "))
        symbol = lark.one_of(grammar, self._columns[column[2:]])
        return [(symbol, context - {column})] if symbol else []

    def _coordinate(
        self, grammar: Grammar, parameter: Parameter, axis: int, context: Context
    ) -> Options:
        """A coordinate of any place but the unresolved one."""
        value, suspect = self.vocabulary.unresolved[axis], frozenset({"unresolved"})
        without = () if axis == 1 and not context >= suspect else (value,)
        symbol = self.values.number(grammar, parameter, without)
        options = [(symbol, context)] if symbol else []
        if axis == 0 and self.values.has_number(parameter, value):
            options.append((literal(lark.written(value)), context | suspect))
        return options
