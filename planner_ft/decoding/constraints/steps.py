"""The logic of a skill sequence: grammars made as it grows, from one skill name to the next.

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
from planner_ft.decoding.constraints.grammar import (
    SKILL_OPENS,
    Context,
    Grammar,
    Options,
    Script,
    key,
)
from planner_ft.decoding.constraints.patterns import literal, quoted
from planner_ft.decoding.constraints.waypoints import Path, Waypoints
from planner_ft.vocabulary import Parameter, Skill
from planner_ft.vocabulary.definition import Role
from planner_ft.vocabulary.plans import STEP_KEYS, without_working

STEP_OPENS = "{" + key(STEP_KEYS[0]) + SKILL_OPENS
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
    written; `written` is that step's text as far as its parts are matched. `beside` are the skills
    before the chosen one in its list.
    """

    most: int = lark.MOST_STEPS
    waypoints: Waypoints | None = None
    whole: Waypoints | None = None
    steps: tuple[Step, ...] = ()
    role: Role = "navigation"
    beside: tuple[Step, ...] = ()
    written: str = ""

    def opening(self) -> str:
        grammar = Grammar()
        opens = lark.sequence_opens(grammar)
        return grammar.text(f"{opens} ({literal(STEP_OPENS)} | {literal(CLOSES)})")

    def following(self, text: str) -> tuple[str, Script] | None:
        if self.chosen is None and text in self.vocabulary.skill:
            skill = self.vocabulary.skill[text]
            ahead = replace(self, chosen=skill, written=self.written + text)
            return ahead._behind([skill], names=False), ahead
        if not text.endswith(SKILL_OPENS):
            return None
        ahead = self._read(self.written + text)
        return ahead._names(), ahead

    def _read(self, text: str) -> TaskScript:
        """The script where a name follows the text of a step, or what stands before the first."""
        if not self.written:
            shown = self.waypoints.shown(without_working(text)[1]) if self.waypoints else None
            return replace(self, waypoints=shown, written=STEP_OPENS)
        steps = self.steps
        if self.role == "navigation":
            entry, _end = json.JSONDecoder().raw_decode(text[len(STEP_OPENS) - len(SKILL_OPENS) :])
            steps = (*steps, (self.vocabulary.skill[entry["name"]], entry["parameters"]))
        ahead = replace(self, steps=steps, chosen=None)
        if text.endswith(STEP_OPENS):
            return replace(ahead, role="navigation", beside=(), written=STEP_OPENS)
        role: Role = "perception" if PERCEPTIONS in text else "filter"
        step = json.loads(text.removesuffix(SKILL_OPENS).removesuffix(",") + "]}")
        beside = (
            (self.vocabulary.skill[one["name"]], one["parameters"])
            for one in step[f"{role}_skills"]
        )
        return replace(ahead, role=role, beside=tuple(beside), written=text)

    def _names(self) -> str:
        """The names that may follow; with what stands behind them where one begins another."""
        known = self.vocabulary.skills_in_role(self.role)
        # An answer never stands without a way on.
        offered = [skill for skill in known if self._offers(skill)] or list(known)
        if not lark.prefix_free(skill.name for skill in self.vocabulary.skills):
            return self._behind(offered, names=True)
        return Grammar().text(" | ".join(literal(skill.name) for skill in offered))

    def _offers(self, skill: Skill) -> bool:
        if self.logical and self.role == "navigation":
            latest = self.steps[-MOST_SAME:]
            same = len(latest) == MOST_SAME and all(step == latest[0] for step in latest)
            run = [step[0] for step in self.steps[-MOST_RUN:]]
            long = not skill.coordinates and run.count(skill) == MOST_RUN
            return not ((same and latest[0][0] == skill) or long)
        used = self._used(skill)
        if self.logical and used and not (all(used) and len(used) < MOST_ALIKE):
            return False
        return lark.possible(skill, self)

    def _behind(self, skills: Sequence[Skill], *, names: bool) -> str:
        """What may stand behind a skill's name, up to the next name; with the name before it."""
        grammar, options = Grammar(), []
        for skill in skills:
            if self.role == "navigation":
                going = bool(skill.coordinates)
                ends = f"{literal(',' + FILTERS)} {self._list(grammar, 'filter', (), going=going)}"
            else:
                used = [other for other, _parameters in self.beside]
                ends = self._list(grammar, self.role, (*used, skill))
            behind = lark.body(grammar, skill, self)
            behind = behind or lark.body(grammar, skill, self.schema_alone)
            options.append(f"{literal(quoted(skill.name)) if names else ''} {behind} {ends}")
        return grammar.text(" | ".join(options))

    def _list(
        self, grammar: Grammar, role: Role, used: Sequence[Skill], *, going: bool = False
    ) -> str:
        """The next skill of a role's list behind those used, or what follows the list. `going`: a
        waypoint is chosen in the same part.
        """
        if role == "filter":
            perceptions = self._list(grammar, "perception", (), going=going)
            behind = f"{literal('],' + PERCEPTIONS)} {perceptions}"
        else:
            count = len(self.steps) + (self.role == "navigation")
            ways = [literal("," + STEP_OPENS)] if count < self.most else []
            if not (ways and self.whole and self.whole.unfinished(self._path, int(going))):
                ways.append(literal(CLOSES))
            tail = lark.step_tail(grammar, self.values)
            behind = f"{literal(']')} {tail} ({' | '.join(ways)})"
        more = len(used) < lark.MOST_SKILLS and any(
            not (self.logical and skill in used)
            or (skill.parameters and used.count(skill) < MOST_ALIKE)
            for skill in self.vocabulary.skills_in_role(role)
        )
        return f"({literal(',' * bool(used) + SKILL_OPENS)} | {behind})" if more else behind

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
            coordinate = self._waypoint if self._columns else self._coordinate
            return coordinate(grammar, parameter, axis, context)
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
            x, y = map(lark.written_number, point)
            columns.setdefault(x, []).append(y)
        return columns

    def _waypoint(
        self, grammar: Grammar, _parameter: Parameter, axis: int, context: Context
    ) -> Options:
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
            options.append((literal(lark.written_number(value)), context | suspect))
        return options
