"""Grammars of a skill sequence, made as it grows: which waypoint may come next depends on those before it.

A step goes somewhere else than the step before it, to a place that the facts of the task give (`waypoints`), and a path that was begun
(the lanes of a grid, a survey square) is run to its end before the answer may close.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from planner_ft.decoding.constraints import patterns
from planner_ft.decoding.constraints.answer import Script
from planner_ft.decoding.constraints.grammar import (
    MOST_SKILLS,
    MOST_STEPS,
    SKILL_OPENS,
    Context,
    Grammar,
    Narrowed,
    Values,
    key,
    named_skills,
    skill_body,
    step_tail,
    written_number,
)
from planner_ft.decoding.constraints.patterns import literal
from planner_ft.decoding.constraints.state import coordinates
from planner_ft.decoding.constraints.waypoints import Ending, Ground, Path, Point
from planner_ft.vocabulary import Parameter, Skill, Task, Vocabulary
from planner_ft.vocabulary.plans import STEP_KEYS

FILTERS, PERCEPTIONS = (key(name) + "[" for name in STEP_KEYS[1:3])
STEP_OPENS = "{" + key(STEP_KEYS[0]) + SKILL_OPENS
CLOSES = "]}"


class RouteValues(Narrowed):
    """The values of another strength, with these waypoints alone."""

    def __init__(self, values: Values, points: Sequence[Point]) -> None:
        super().__init__(values)
        self._columns: dict[str, list[str]] = {}
        for x, y in points:
            self._columns.setdefault(written_number(x), []).append(written_number(y))

    def parameter(self, grammar: Grammar, parameter: Parameter, owner: Task | Skill, context: Context) -> list[tuple[str, Context]]:
        pair = coordinates(owner) if isinstance(owner, Skill) else ()
        if parameter not in pair:
            return super().parameter(grammar, parameter, owner, context)
        if pair.index(parameter) == 0:
            return [(literal(x), context | {f"x {x}"}) for x in self._columns]
        column = next(mark for mark in context if mark.startswith("x "))
        ways = dict.fromkeys(self._columns[column[2:]])
        return [(grammar.terminal(" | ".join(map(literal, ways))), context - {column})]


@dataclass(frozen=True)
class TaskScript:
    """The parts of an answer: the names that may follow, what stands behind the chosen name, then the skills beside it.

    A part ends where a name begins: tokenizers keep signs and letters apart. Only the short part with the waypoint is new in every step;
    the others come again and are compiled once. `before` are the waypoints so far, `steps` their number with all other steps; `chosen` is
    the skill whose name was written last, `written` what stands behind it so far.
    """

    vocabulary: Vocabulary
    values: Values
    ground: Ground
    before: Path = ()
    steps: int = 0
    chosen: Skill | None = None
    written: str = ""

    def opening(self) -> str:
        return Grammar().text(f"{literal('{' + key('skill_sequence') + '[')} ({literal(STEP_OPENS)} | {literal(CLOSES)})")

    def following(self, text: str) -> tuple[str, Script] | None:
        if self.chosen is None and text in self.vocabulary.skill:
            chosen = replace(self, chosen=self.vocabulary.skill[text])
            return chosen._movement(), chosen
        if text.endswith(STEP_OPENS):
            ahead = self if self.chosen is None else replace(self._behind(text), steps=self.steps + 1, chosen=None, written="")
            return ahead._names(), ahead
        for role, opens in (("filter", FILTERS), ("perception", PERCEPTIONS)):
            if text.endswith(opens + SKILL_OPENS):
                ahead = replace(self, written=text)
                return ahead._beside(role, ending=self.ground.ending(ahead._behind("").before)), ahead
        return None

    def closing(self) -> Script:
        return replace(self, ground=replace(self.ground, paths=(), itinerary=None, alone=False, shaped=False))

    def _behind(self, text: str) -> TaskScript:
        """The script with the waypoint of the step that is being written."""
        pair = coordinates(self.chosen) if self.chosen else ()
        if not pair:
            return self
        start = (self.written + text).index("{")
        parameters, _end = json.JSONDecoder().raw_decode((self.written + text)[start:])
        return replace(self, before=(*self.before, (parameters[pair[0].name], parameters[pair[1].name])))

    def _names(self) -> str:
        """The navigation skills that may follow."""
        ground = self.ground
        skills = self.vocabulary.skills_in_role("navigation")
        offered = [skill for skill in skills if (ground.following(self.before) if coordinates(skill) else not ground.waypoints_alone)]
        return Grammar().text(" | ".join(literal(patterns.quoted(skill.name)) for skill in offered))

    def _movement(self) -> str:
        """What may stand behind the name of a movement, up to the first skill beside it or to the next step."""
        assert self.chosen is not None
        grammar = Grammar()
        tail = step_tail(grammar, self.values)
        opens, skill = literal("," + FILTERS), literal(SKILL_OPENS)
        options = []
        for body, ending in self._bodies(grammar):
            bare = f"{literal(']')} {tail} {self._ends(ending)}"
            options.append(f"{body} {opens} ({skill} | {literal('],' + PERCEPTIONS)} ({skill} | {bare}))")
        return grammar.text(" | ".join(options))

    def _bodies(self, grammar: Grammar) -> list[tuple[str | None, Ending]]:
        """The parameters of a movement, and whether the answer ends behind them."""
        assert self.chosen is not None
        if not coordinates(self.chosen):
            return [(skill_body(grammar, self.chosen, self.values), self.ground.ending(self.before))]
        found: dict[Ending, list[Point]] = {}
        for point in self.ground.following(self.before):
            found.setdefault(self.ground.ending((*self.before, point)), []).append(point)
        return [(skill_body(grammar, self.chosen, RouteValues(self.values, points)), ending) for ending, points in found.items()]

    def _beside(self, role: str, *, ending: Ending) -> str:
        """What may stand behind `{"name":"` of the first skill beside the movement."""
        grammar = Grammar()
        filters, perceptions = (self._several(grammar, one) for one in ("filter", "perception"))
        rest = f"{literal(']')} {step_tail(grammar, self.values)} {self._ends(ending)}"
        if role == "perception":
            return grammar.text(f"{perceptions} {rest}")
        more = f"({literal(SKILL_OPENS)} {perceptions})?" if perceptions else ""
        return grammar.text(f"{filters} {literal('],' + PERCEPTIONS)} {more} {rest}")

    def _several(self, grammar: Grammar, role: Any) -> str | None:
        named = named_skills(grammar, self.vocabulary, role, self.values)
        return f"{named} ({literal(',' + SKILL_OPENS)} {named}){{0,{MOST_SKILLS - 1}}}" if named else None

    def _ends(self, ending: Ending) -> str:
        """What follows a step: another one, or the end."""
        more = [literal("," + STEP_OPENS)] if self.steps + 1 < MOST_STEPS and ending != "must" else []
        return f"({' | '.join(more + ([literal(CLOSES)] if ending != 'not yet' or not more else []))})"
