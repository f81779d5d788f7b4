"""Prompts put together: movements, and the filters and perception skills that run in some or all of
them, drawn for one task and said in the frames of frames.toml; and the plan that this means.
"""

from __future__ import annotations

import functools
import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

from planner_ft.data.numbers import in_words, pick
from planner_ft.data.task.clauses import lead_clause, pattern_clause, pattern_phrase, skill_clause
from planner_ft.data.task.context import Context
from planner_ft.data.task.frames import TABLES, Scopes
from planner_ft.data.task.phrasebook import parse_phrase
from planner_ft.data.task.prompts.binding import Bound
from planner_ft.data.task.prompts.draw import Drawing, twice
from planner_ft.data.task.steps import Entry, Step, plan_step
from planner_ft.data.templates.grammar import Nodes, Slot, all_slots, choose
from planner_ft.data.templates.render import PIECE

EXTRA_MOVEMENTS = (0.56, 0.2, 0.13, 0.07, 0.04)
"""How often a prompt has none, one, ... movements beside the main one."""
AGAIN = 0.15
"""Share of skills that stand a second time with other parameters."""
LOCAL = 0.5
"""Share of the skills of a single step that are said with its movement."""
REPEATED = 0.08
"""Share of skills with an interval in the prompt, which no skill has as a parameter."""
SHARES: dict[Literal["filter", "perception"], tuple[float, ...]] = {
    "perception": (0.14, 0.36, 0.28, 0.15, 0.07),
    "filter": (0.56, 0.34, 0.1),
}
PATTERNS: dict[str, dict[str, float]] = {
    "goto": {"waypoints": 0.15, "home": 0.05},
    "square": {"square": 0.85, "waypoints": 0.1},
    "lawnmower": {"lawnmower": 0.85, "waypoints": 0.1},
    "orbit": {"orbit": 0.35, "waypoints": 0.1},
    "pass": {"pass": 0.5, "line": 0.35},
    "line": {"line": 0.75, "pass": 0.1},
    "sectors": {"sectors": 0.45, "headings": 0.25, "steps": 0.1},
    "sweep": {"headings": 0.15, "steps": 0.15},
    "follow": {"waypoints": 0.05},
}
"""How often a task of the pattern is drawn as each movement; else a skill that fits the task."""
OTHER = ("waypoints", "square", "line", "pass", "headings", "steps", "orbit", "lawnmower")
"""Movements that may stand beside the task's own."""

Clause = Callable[[str], Bound]
"""A clause in a form: "" (a command), "ing", "each", "with", "passive"."""
Maker = Callable[[str], list[PIECE]]
"""Words for a part of the prompt in a form."""


class Misfit(Exception):
    """A draw that came to nothing."""


@dataclass
class Movement:
    """What moves or holds the vehicle; `clause` is None where the prompt does not ask for it."""

    kind: str
    clause: Clause | None
    several: bool = False
    """Whether it may have several steps."""
    route: list[Step] = field(default_factory=list)


@dataclass
class Run:
    """A skill, or words that ask for none (no name), beside the movements at these places."""

    skill: str
    clause: Clause
    forms: frozenset[str]
    steps: frozenset[int]


class Prompt:
    """One sample: what is said, and the plan. Raises Misfit when the draw came to nothing."""

    def __init__(self, context: Context) -> None:
        self.c, self.rng, self.book = context, context.rng, context.book
        self.unseen = "_unseen" if self.book.unseen else ""
        self.mentioned: list[tuple[Run, list[Entry], list[Entry]]] = []
        lead = self._lead()
        self.movements = self._movements(lead is not None)
        self.runs = self._runs(lead)
        asked = self.movements[0].clause or "perception" in map(self._role, self.runs)
        if not asked:
            raise Misfit
        self.frame, self.pieces = self._said()
        self.plan = self._plan()
        steps = self.plan["skill_sequence"]
        if any(twice(step[f"{role}_skills"]) for step in steps for role in SHARES):
            raise Misfit

    # ------------------------------------------------------------ what is asked for

    def _lead(self) -> Clause | None:
        entry, title = self.c.entry, self.c.task.title
        if not entry.lead or self.rng.random() < 0.2:
            return None
        for place, name in entry.links.items():
            if place.startswith("lead."):
                self.c.require(name)
        phrase = pick(entry.lead, self.rng)
        return lambda form: lead_clause(self.book, title, phrase, form == "ing")

    def _movements(self, lead: bool) -> list[Movement]:
        rng, hold, task = self.rng, self.book.motions.get("hold"), self.c.task
        still = 0.35 if task.arrival == "none" and task.pattern == "hold" else 0.02
        if hold and rng.random() < (0.55 if lead else still):
            return [Movement("implied", None, route=[(hold, {})])]
        movements = [self._skill(hold) if hold and lead and rng.random() < 0.7 else self._main()]
        for _ in range(_count(rng, EXTRA_MOVEMENTS)):
            if extra := self._extra():
                movements.insert(int(rng.random() * (len(movements) + 1)), extra)
        home = self._pattern("home") if rng.random() < 0.03 else None
        return [*movements, home] if home else movements

    def _main(self) -> Movement:
        roll, task = self.rng.random(), self.c.task
        for pattern, share in PATTERNS.get(task.pattern, {}).items():
            if roll < share and (found := self._pattern(pattern)):
                return found
            roll -= share
        names = task.skills["navigation"]
        return self._skill(names[int(self.rng.random() ** 1.8 * len(names))])

    def _extra(self) -> Movement | None:
        roll, motions = self.rng.random(), self.book.motions
        if roll < 0.06:
            return self._pattern(pick(OTHER, self.rng))
        if roll < 0.35 and "goto" in motions:
            return self._skill(motions["goto"])
        known = self.c.task.skills if roll < 0.65 else self.book.roles
        return self._skill(pick(known["navigation"], self.rng))

    def _pattern(self, name: str) -> Movement | None:
        title = self.c.task.title
        phrase, plan = pattern_phrase(self.book, title, name, self.rng)
        if not phrase or not pattern_clause(self.book, title, name, phrase, plan, False):
            return None

        def clause(form: str) -> Bound:
            bound = pattern_clause(self.book, title, name, phrase, plan, form == "ing")
            if bound is None:
                raise Misfit
            return bound

        return Movement(name, clause, True)

    def _skill(self, name: str) -> Movement:
        motion = self.book.skills[name].skill.motion
        return Movement(motion or name, functools.partial(self._clause, name))

    def _clause(self, name: str, form: str) -> Bound:
        """A phrase for the skill in this form, at times one of the task's own."""
        entry, task = self.book.skills[name], self.c.entry
        phrases: Sequence[str] = entry.phrases.get(form) or entry.phrases[""]
        own: Sequence[str] = task.phrases if name == task.phrases_for else []
        if entry.skill.motion == "goto":
            own = self.book.pattern("goto", self.c.task.title)
        if own and self.rng.random() < 0.6:
            phrases = own
        return skill_clause(self.book, name, pick(phrases, self.rng), form == "ing")

    def _runs(self, lead: Clause | None) -> list[Run]:
        every, rng = frozenset(range(len(self.movements))), self.rng
        skill = self.c.entry.lead_skill.get("skill", "")
        runs = [Run(skill, lead, frozenset(), every)] if lead else []
        for role, shares in SHARES.items():
            skills, fitting = self.book.roles[role], self.c.task.skills.get(role, ())
            count = _count(rng, shares)
            names = [
                pick(fitting if fitting and rng.random() < 0.85 else skills, rng)
                for _ in range(count if skills else 0)
            ]
            for name in dict.fromkeys(names):  # Mostly those that fit the task.
                entry, steps = self.book.skills[name], _steps(len(every), rng)
                forms = frozenset(form for form in ("with", "passive") if entry.phrases[form])
                run = Run(name, functools.partial(self._clause, name), forms, steps)
                runs.append(run)
                others = every - steps or every
                share = AGAIN if others != every else AGAIN / 2 if role == "perception" else 0
                if entry.several and rng.random() < share:
                    runs.append(Run(name, run.clause, forms, others))
        return runs

    def _role(self, run: Run) -> str:
        return self.book.skills[run.skill].skill.role if run.skill else "perception"

    # ------------------------------------------------------------ how it is said

    def _said(self) -> tuple[str, list[PIECE]]:
        """The name of the frames, and the pieces of the prompt."""
        movement, *others = self.movements
        if others:
            return "several", self._several()
        name = "one" if movement.clause else "no_movement"
        table, data = name + self.unseen, self.runs
        filters = [run for run in data if self._role(run) == "filter"]
        if not filters or self.rng.random() < 0.3:
            return name, self._movement(table, movement, data)
        data = [run for run in data if run not in filters]
        if not data and not movement.clause:
            return name, self._movement(table, movement, filters)
        makers: dict[str, Maker] = {
            "core": lambda _form: self._movement(table, movement, data),
            "filters": functools.partial(self._calls, filters),
        }
        return name, self._say("filters", {"core", *_forms("filters", filters)}, makers)

    def _say(self, table: str, given: set[str], makers: Mapping[str, Maker]) -> list[PIECE]:
        """A frame of the table that says exactly what is given."""
        return self._frame(pick(_frames(table, frozenset(given)), self.rng), makers)

    def _frame(self, nodes: Nodes, makers: Mapping[str, Maker]) -> list[PIECE]:
        pieces: list[PIECE] = []
        for part in choose(nodes, self.rng, []):
            if isinstance(part, Slot):
                pieces += makers[part.base]("".join(part.options))
            else:
                pieces.append((part, False))
        return pieces

    def _movement(self, table: str, movement: Movement, data: Sequence[Run]) -> list[PIECE]:
        """A movement with what runs beside it."""
        given = _forms("data", data)
        makers: dict[str, Maker] = {"data": functools.partial(self._calls, data)}
        if movement.clause:
            given |= {"move", "move ing"}
            makers["move"] = functools.partial(self._move, movement)
        return self._say(table, given, makers)

    def _move(self, movement: Movement, form: str) -> list[PIECE]:
        if movement.clause is None:
            raise Misfit
        drawing = Drawing(movement.clause(form), self.c)
        try:
            movement.route = drawing.plan.route()
        except ValueError:
            raise Misfit from None
        return drawing.pieces()

    def _calls(self, runs: Sequence[Run], form: str) -> list[PIECE]:
        """Several skills in a form: "record the sonar, log the depth and take a fix"."""
        last = ". " if form == "each" else pick((" and ", " and ", ", and "), self.rng)
        pieces: list[PIECE] = []
        for place, run in enumerate(runs):
            if place:
                joint = ", " if form != "each" and place < len(runs) - 1 else last
                pieces.append((joint, False))
            pieces += self._call(run, form)
        return pieces

    def _call(self, run: Run, form: str) -> list[PIECE]:
        drawing = Drawing(run.clause(form), self.c)
        step = drawing.bound.everywhere
        filters, perceptions = drawing.plan.beside(step) if step else ([], [])
        pieces = drawing.pieces()
        repeat = self.book.sentences.get("repeat")
        repeats = run.skill and self.book.skills[run.skill].repeats
        if repeat and repeats and self.rng.random() < REPEATED:
            pieces += [(" ", False), (self.c.say(pick(repeat, self.rng)), False)]
        self.mentioned.append((run, filters, perceptions))
        return pieces

    def _several(self) -> list[PIECE]:
        movements, later = self.movements, []
        local: list[list[Run]] = [[] for _ in movements]
        for run in self.runs:
            if len(run.steps) == 1 and self.rng.random() < LOCAL:
                local[min(run.steps)].append(run)
            else:
                later.append(run)
        first, middle, last = pick(TABLES[f"several{self.unseen}"], self.rng)
        part = "part" if any(one.several for one in movements) else "step"
        scopes = Scopes(len(movements), part, self.rng, numbered="{n}" in first)
        marked = any(local) or any(len(run.steps) < len(movements) for run in later)
        pieces: list[PIECE] = []
        if later and not scopes.numbered and self.rng.random() < 0.15:
            pieces = [*self._scoped(later[:1], scopes, marked), (". ", False)]
            later = later[1:]
        for place, text in enumerate((first, *[middle] * (len(movements) - 2), last)):
            number, nth = place + 1, scopes.nth([place])
            makers: dict[str, Maker] = {
                "clause": functools.partial(self._part, movements[place], local[place]),
                "n": _constant(str(number)),
                "nth": _constant(nth),
                "number": _constant(in_words(number)),
            }
            pieces += self._frame(parse_phrase(text), makers)
        for steps in dict.fromkeys(run.steps for run in later):
            pieces.append((". ", False))
            pieces += self._scoped([run for run in later if run.steps == steps], scopes, marked)
        return pieces

    def _part(self, movement: Movement, data: Sequence[Run], form: str) -> list[PIECE]:
        return self._movement(f"clause_{form}" if form else "clause", movement, data)

    def _scoped(self, runs: Sequence[Run], scopes: Scopes, marked: bool) -> list[PIECE]:
        """What runs in the same steps; `marked`: one that runs everywhere needs words for it."""
        makers: dict[str, Maker] = {"data": functools.partial(self._calls, runs)}
        given = _forms("data", runs)
        if not marked and self.rng.random() < 0.5:
            return self._say("everywhere", given, makers)
        makers["where"] = _constant(scopes.words(runs[0].steps))
        return self._say("scope", {*given, "where"}, makers)

    # ------------------------------------------------------------ what it means

    def _plan(self) -> dict[str, Any]:
        """The plan; within a step, filters and perception skills stand in the order of mention."""
        steps = []
        for place, movement in enumerate(self.movements):
            beside = [found for run, *found in self.mentioned if place in run.steps]
            filters, perceptions = ([one for found in beside for one in found[i]] for i in (0, 1))
            steps += [
                plan_step(name, parameters, filters, perceptions, self.book.vocabulary)
                for name, parameters in movement.route
            ]
        return {"skill_sequence": steps}


def _count(rng: random.Random, shares: Sequence[float]) -> int:
    return rng.choices(range(len(shares)), shares)[0]


def _constant(text: str) -> Maker:
    return lambda _form: [(text, False)]


def _steps(count: int, rng: random.Random) -> frozenset[int]:
    """The movements beside which a skill runs: all, one, all but one, or any two."""
    every, one, roll = frozenset(range(count)), frozenset({int(rng.random() * count)}), rng.random()
    if count == 1 or roll < 0.33:
        return every
    if roll < 0.8 or count == 2:
        return one
    return every - one if roll < 0.9 else one | {int(rng.random() * count)}


def _forms(group: str, runs: Sequence[Run]) -> set[str]:
    """The slots in which these skills can be said."""
    forms = frozenset.intersection(*(run.forms for run in runs)) if runs else ()
    return {group, *(f"{group} {form}" for form in ("ing", "each", *forms))} if runs else set()


@functools.cache
def _frames(table: str, given: frozenset[str]) -> list[Nodes]:
    """The frames that have exactly the groups of what is given, each in a given form."""
    groups = {name.partition(" ")[0] for name in given}
    frames = [parse_phrase(frame) for frame in TABLES[table]]
    slots = [{" ".join([slot.key, *slot.options]) for slot in all_slots(one)} for one in frames]
    return [
        frame
        for frame, names in zip(frames, slots, strict=True)
        if names <= given and {name.partition(" ")[0] for name in names} == groups
    ]
