"""The logic of a skill sequence: grammars made as it grows, from one skill name to the next.

A skill stands in a step once, or again with another value, and the same movement does not come
without end. Where waypoints follow from the facts of the task (`waypoints`), which one may come
next depends on those before it.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from planner_ft.decoding.constraints.answer import Script
from planner_ft.decoding.constraints.grammar import (
    MOST_SKILLS,
    MOST_STEPS,
    SKILL_OPENS,
    Context,
    Grammar,
    Narrowed,
    SchemaValues,
    Values,
    key,
    sequence_opens,
    skill_body,
    step_tail,
    written_number,
)
from planner_ft.decoding.constraints.patterns import literal, quoted
from planner_ft.decoding.constraints.state import prefix_free
from planner_ft.decoding.constraints.waypoints import Path, Point, Waypoints
from planner_ft.vocabulary import Parameter, Skill, Task, Vocabulary
from planner_ft.vocabulary.definition import Role
from planner_ft.vocabulary.plans import STEP_KEYS, without_working

STEP_OPENS = "{" + key(STEP_KEYS[0]) + SKILL_OPENS
FILTERS, PERCEPTIONS = (key(name) + "[" for name in STEP_KEYS[1:3])
CLOSES = "]}"
MOST_ALIKE = 4
"""Uses of a skill in one step."""
MOST_SAME, MOST_RUN = 12, 36
"""Steps in a row with the same movement and values, and with the same movement that goes nowhere:
a turn in 36 steps has 10 degrees each.
"""

Step = tuple[Skill, Mapping[str, Any]]
"""A skill and its parameters."""


class OtherValues(Narrowed):
    """The values of another strength; a skill that was used in a step has another value there for
    the parameter that it was used with.
    """

    def __init__(self, values: Values, skill: Skill, used: Sequence[Mapping[str, Any]]) -> None:
        super().__init__(values)
        self._skill, named = skill, {name for one in used for name in one}
        self._telling = next((item for item in skill.parameters if item.name in named), None)
        self._barred = [one.get(self._telling.name) for one in used] if self._telling else []

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task | Skill, context: Context
    ) -> list[tuple[str, Context]]:
        symbol: str | None = None
        if owner != self._skill or parameter != self._telling:
            return super().parameter(grammar, parameter, owner, context)
        if parameter.type in ("number", "integer"):
            barred = [value for value in self._barred if isinstance(value, int | float)]
            symbol = self.number(grammar, parameter, barred)
        elif parameter.type in ("text", "id"):
            symbol = self.text(grammar, [str(value) for value in self._barred])
        else:
            return super().parameter(grammar, parameter, owner, context)
        return [(symbol, context)] if symbol else []

    def needs(self, parameter: Parameter, owner: Task | Skill) -> bool:
        return super().needs(parameter, owner) or (
            owner == self._skill and parameter == self._telling
        )


class WaypointValues(Narrowed):
    """The values of another strength, with these waypoints alone."""

    def __init__(self, values: Values, points: Sequence[Point]) -> None:
        super().__init__(values)
        self._columns: dict[str, list[str]] = {}
        for x, y in points:
            self._columns.setdefault(written_number(x), []).append(written_number(y))

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task | Skill, context: Context
    ) -> list[tuple[str, Context]]:
        pair = owner.coordinates if isinstance(owner, Skill) else ()
        if parameter not in pair:
            return super().parameter(grammar, parameter, owner, context)
        if pair.index(parameter) == 0:
            return [(literal(x), context | {f"x {x}"}) for x in self._columns]
        column = next(mark for mark in context if mark.startswith("x "))
        ways = dict.fromkeys(self._columns[column[2:]])
        return [(grammar.terminal(" | ".join(map(literal, ways))), context - {column})]


@dataclass(frozen=True)
class TaskScript:
    """The parts of an answer: the names that may follow, then what stands behind the chosen name,
    up to the next one.

    A part ends where a name begins or ends: tokenizers keep signs and letters apart. `waypoints`
    are those that the facts give, None where any may be meant. `steps` are the movements so far,
    with the one of the step that is being written; `written` is that step's text as far as its
    parts are matched. `chosen` is the skill whose name was written last, None where one is to
    follow, `beside` are the skills before it in its list.
    """

    vocabulary: Vocabulary
    values: Values
    waypoints: Waypoints | None = None
    steps: tuple[Step, ...] = ()
    role: Role = "navigation"
    beside: tuple[Step, ...] = ()
    chosen: Skill | None = None
    written: str = ""

    def opening(self) -> str:
        grammar = Grammar()
        return grammar.text(
            f"{sequence_opens(grammar)} ({literal(STEP_OPENS)} | {literal(CLOSES)})"
        )

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
        if text.endswith(STEP_OPENS):
            return TaskScript(
                self.vocabulary, self.values, self.waypoints, steps, written=STEP_OPENS
            )
        role: Role = "perception" if PERCEPTIONS in text else "filter"
        step = json.loads(text.removesuffix(SKILL_OPENS).removesuffix(",") + "]}")
        beside = [
            (self.vocabulary.skill[skill["name"]], skill["parameters"])
            for skill in step[f"{role}_skills"]
        ]
        return replace(
            self, steps=steps, role=role, beside=tuple(beside), chosen=None, written=text
        )

    def _names(self) -> str:
        """The names that may follow; with what stands behind them where one begins another."""
        known = self.vocabulary.skills_in_role(self.role)
        # An answer never stands without a way on.
        offered = [skill for skill in known if self._offers(skill)] or list(known)
        if not prefix_free(skill.name for skill in self.vocabulary.skills):
            return self._behind(offered, names=True)
        return Grammar().text(" | ".join(literal(skill.name) for skill in offered))

    def _offers(self, skill: Skill) -> bool:
        if self.role == "navigation":
            latest = self.steps[-MOST_SAME:]
            same = len(latest) == MOST_SAME and all(step == latest[0] for step in latest)
            run = [step[0] for step in self.steps[-MOST_RUN:]]
            long = not skill.coordinates and run.count(skill) == MOST_RUN
            return not ((same and latest[0][0] == skill) or long)
        used = [parameters for other, parameters in self.beside if other == skill]
        if used and not (all(used) and len(used) < MOST_ALIKE):
            return False
        return skill_body(Grammar(), skill, self._values_of(skill)) is not None

    def _values_of(self, skill: Skill) -> Values:
        if skill.coordinates and self.waypoints is not None:
            points = self.waypoints.following(self._path)
            return WaypointValues(self.values, points) if points else self.values
        used = [parameters for other, parameters in self.beside if other == skill]
        return OtherValues(self.values, skill, used) if used else self.values

    @property
    def _path(self) -> Path:
        """The waypoints so far."""
        pairs = ((skill.coordinates, values) for skill, values in self.steps if skill.coordinates)
        return tuple((values[x.name], values[y.name]) for (x, y), values in pairs)

    def _behind(self, skills: Sequence[Skill], *, names: bool) -> str:
        """What may stand behind a skill's name, up to the next name; with the name before it."""
        grammar = Grammar()
        if self.role == "navigation":
            ends = f"{literal(',' + FILTERS)} {self._list(grammar, 'filter', ())}"
        bodies = []
        for skill in skills:
            if self.role != "navigation":
                used = [other for other, _parameters in self.beside]
                ends = self._list(grammar, self.role, (*used, skill))
            body = skill_body(grammar, skill, self._values_of(skill))
            body = body or skill_body(grammar, skill, SchemaValues())
            bodies.append(f"{literal(quoted(skill.name)) if names else ''} {body} {ends}")
        return grammar.text(" | ".join(bodies))

    def _list(self, grammar: Grammar, role: Role, used: Sequence[Skill]) -> str:
        """What may stand in the list of a role's skills behind those used: the next one, or what
        follows the list.
        """
        known = self.vocabulary.skills_in_role(role)
        more = len(used) < MOST_SKILLS and any(
            skill not in used or (skill.parameters and used.count(skill) < MOST_ALIKE)
            for skill in known
        )
        if role == "filter":
            behind = literal("]," + PERCEPTIONS) + " " + self._list(grammar, "perception", ())
        else:
            behind = f"{literal(']')} {step_tail(grammar, self.values)} {self._ends()}"
        return f"({literal(',' * bool(used) + SKILL_OPENS)} | {behind})" if more else behind

    def _ends(self) -> str:
        """What follows a step: another one, or the end."""
        count = len(self.steps) + (self.role == "navigation")
        more = f"{literal(',' + STEP_OPENS)} | " if count < MOST_STEPS else ""
        return f"({more}{literal(CLOSES)})"
