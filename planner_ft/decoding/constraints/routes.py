"""Grammars of a skill sequence, made as it grows: which waypoint may come next depends on those
before it.

A step goes somewhere else than the step before it, to a place that the facts of the task give
(`waypoints`), and a path that was begun (the lanes of a grid, a survey square) is run to its end
before the answer may close.
"""

from __future__ import annotations

import functools
import json
from collections.abc import Sequence as Row
from dataclasses import dataclass, field, replace

from planner_ft.decoding.constraints import patterns
from planner_ft.decoding.constraints.answer import Script
from planner_ft.decoding.constraints.companions import Companions
from planner_ft.decoding.constraints.derived_paths import Path, Point
from planner_ft.decoding.constraints.grammar import (
    MOST_SKILLS,
    MOST_STEPS,
    MOST_TEXTS,
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
from planner_ft.decoding.constraints.ground import Ending, Ground
from planner_ft.decoding.constraints.patterns import literal
from planner_ft.decoding.constraints.reading.rows.sequence import Sequence
from planner_ft.decoding.constraints.reading.rows.sequence_clauses import Movement
from planner_ft.decoding.constraints.reading.rows.turn_parts import Turn
from planner_ft.decoding.constraints.repeats import (
    ROTATING,
    MovementValues,
    Step,
    TurnValues,
    UnlikeValues,
    repeatable,
    spent,
)
from planner_ft.vocabulary import Parameter, Skill, Task, Vocabulary
from planner_ft.vocabulary.definition import Role
from planner_ft.vocabulary.plans import STEP_KEYS, without_working

FILTERS, PERCEPTIONS = (key(name) + "[" for name in STEP_KEYS[1:3])
STEP_OPENS = "{" + key(STEP_KEYS[0]) + SKILL_OPENS
CLOSES = "]}"
LIST_OPENS, NEXT_TEXT = '["', '","'
"""How a list of texts begins, and goes on behind one."""


class RouteValues(Narrowed):
    """The values of another strength, with these waypoints alone."""

    def __init__(self, values: Values, points: Row[Point]) -> None:
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


NOWHERE: Point = (0.0, 0.0)


@dataclass(frozen=True)
class TaskScript:
    """The parts of an answer: the names that may follow, then what stands behind the chosen name,
    up to the next one.

    A part ends where a name begins: tokenizers keep signs and letters apart. Parts that come again
    in another step are compiled once. `before` are the waypoints so far, `steps` the movements of
    the steps that are written; `turns` are the rotations of the whole plan where they are certain,
    `sequence` are all movements where these are. `chosen` is the skill whose name was written last,
    None where a name is to follow; `written` is the text of the step that is being written, as far
    as its parts are matched, `beside` are the skills of the list that is being written, and
    `listed` the texts of a skill's own list. `could_end` says whether the answer could have ended
    behind the steps that are written; with `owes`, the model would have ended it there, although
    movements that are asked for are missing.
    """

    vocabulary: Vocabulary
    values: Values
    ground: Ground
    text: str = ""
    turns: tuple[Turn, ...] | None = None
    companions: Companions = field(default_factory=Companions)
    sequence: Sequence | None = None
    before: Path = ()
    steps: tuple[Step, ...] = ()
    chosen: Skill | None = None
    role: Role = "navigation"
    written: str = ""
    beside: tuple[Step, ...] = ()
    listed: tuple[str, ...] = ()
    could_end: bool = False
    owes: bool = False

    def opening(self) -> str:
        grammar = Grammar()
        return grammar.text(
            f"{sequence_opens(grammar, working=not self.ground.told and self.sequence is None)}"
            f" ({literal(STEP_OPENS)} | {literal(CLOSES)})"
        )

    def following(self, text: str) -> tuple[str, Script] | None:
        if self.chosen is None and text in self.vocabulary.skill:
            chosen = replace(
                self, chosen=self.vocabulary.skill[text], written=self.written + text, owes=False
            )
            return chosen._behind_name(), chosen
        if not text.endswith(SKILL_OPENS):
            if not text.endswith((LIST_OPENS, NEXT_TEXT)):
                return None
            said = (
                *self.listed,
                *(
                    [json.loads('"' + text[: 1 - len(NEXT_TEXT)])]
                    if text.endswith(NEXT_TEXT)
                    else []
                ),
            )
            ahead = replace(self, written=self.written + text, listed=said)
            return ahead._behind_text(), ahead
        if text.endswith(STEP_OPENS):
            ahead = self._opened(text) if self.chosen is None else self._behind_step(text)
            ahead = replace(
                ahead, chosen=None, role="navigation", written=STEP_OPENS, beside=(), listed=()
            )
        else:
            ahead = self._behind_skill(text)
        return ahead._names(), ahead

    def _opened(self, text: str) -> TaskScript:
        """The script behind the opening, with what the working in it derives."""
        working = without_working(text)[1]
        return replace(self, ground=self.ground.shown(working)) if working else self

    def closing(self) -> Script:
        return replace(
            self,
            ground=replace(self.ground, paths=(), itinerary=None, alone=False, shaped=False),
            turns=None,
            companions=Companions(),
            sequence=None,
        )

    def taken_back(self, text: str) -> tuple[str, str] | None:
        """A step that the model would begin with a movement which may not follow is not begun: the
        answer ends where it could.
        """
        if self.chosen is not None or self.role != "navigation" or not self.could_end:
            return None
        meant = any(
            patterns.quoted(skill.name).startswith(text)
            for skill in self.vocabulary.skills_in_role("navigation")
        )
        return ("," + STEP_OPENS, CLOSES) if meant else None

    def pressed(self, text: str) -> Script | None:
        """Where the model would end behind a step while a movement is owed, that one is to
        follow.
        """
        end = self._step_end(text)
        return (
            replace(self, owes=True)
            if end is not None and text[end:].startswith(CLOSES[0])
            else None
        )

    def declines(self, text: str) -> bool:
        """A skill that the model would name in a list, and which may not stand there, is no reason
        to name another one where the list could have ended.
        """
        if self.chosen is not None or self.role == "navigation":
            return False
        _more, ends = self._listed(
            self.role, *self._movement, [skill for skill, _parameters in self.beside]
        )
        return ends and any(
            patterns.quoted(skill.name).startswith(text)
            for skill in self.vocabulary.skills_in_role(self.role)
        )

    def asks(self, text: str) -> int | None:
        """Before a name that may be a substitute, and behind a step where a movement is owed."""
        return 0 if self.taken_back(text) or self.declines(text) else self._step_end(text)

    def _step_end(self, text: str) -> int | None:
        """Where the step ends in a text that goes on with it, if a movement is owed behind it."""
        if self.chosen is None or not self.companions.asked:
            return None
        try:
            step, end = json.JSONDecoder().raw_decode(self.written + text)
            entry = step[STEP_KEYS[0]]
            movement = self.vocabulary.skill[entry["name"]], entry["parameters"]
            path = self._path(movement)
        except (ValueError, KeyError):
            # No whole step: what the model means need not be allowed.
            return None
        return (
            max(0, end - len(self.written))
            if self._owed(movement[0]) and self._read_ending(movement[0], path) == "may"
            else None
        )

    def _owed(self, movement: Skill) -> list[Skill]:
        """The movements that are asked for and not written, this one counted as written."""
        written = [movement, *(skill for skill, _parameters in self.steps)]
        asked = [
            skill
            for skill in self.vocabulary.skills_in_role("navigation")
            if skill.name in self.companions.asked and skill not in written
        ]
        return (
            []
            if self.ground.waypoints_alone or self.sequence is not None
            else [skill for skill in asked if self._spoken(skill)]
        )

    def _behind_step(self, text: str) -> TaskScript:
        """The script behind a step, with its movement and its waypoint."""
        movement = self._first_of((self.written + text)[len(STEP_OPENS) - len(SKILL_OPENS) :])
        before = self._path(movement)
        return replace(
            self,
            steps=(*self.steps, movement),
            before=before,
            could_end=self._ending(movement[0], before) == "may",
        )

    def _path(self, movement: Step) -> Path:
        """The waypoints with that of a movement."""
        point = waypoint(movement)
        return (*self.before, point) if point else self.before

    def _behind_skill(self, text: str) -> TaskScript:
        """The script at the name of a filter or perception skill."""
        role: Role = (
            "filter"
            if text.endswith(FILTERS + SKILL_OPENS)
            else "perception"
            if text.endswith(PERCEPTIONS + SKILL_OPENS)
            else self.role
        )
        whole = self.written + text
        beside = (
            (*self.beside, self._first_of(whole[whole.rindex(SKILL_OPENS, 0, -len(SKILL_OPENS)) :]))
            if role == self.role
            else ()
        )
        return replace(self, chosen=None, role=role, written=whole, beside=beside, listed=())

    def _first_of(self, text: str) -> Step:
        """The skill that a text begins with."""
        entry, _end = json.JSONDecoder().raw_decode(text)
        return self.vocabulary.skill[entry["name"]], entry["parameters"]

    def _names(self) -> str:
        """The names that may follow."""
        skills = (
            self._owed(self.steps[-1][0])
            if self.owes and self.role == "navigation"
            else self.vocabulary.skills_in_role(self.role)
        )
        offered = [skill for skill in skills if self._offers(skill)]
        said = {skill for skill, _parameters in self.beside}
        due = [
            skill
            for skill in offered
            if self.role != "navigation"
            and skill not in said
            and self._runs(skill, *self._movement)
        ]
        # Nothing takes the room of what must run.
        offered = due if due and len(self.beside) + len(due) >= MOST_SKILLS else offered
        # What is insisted on comes first: a model that left it out would put it off.
        offered = [
            skill
            for skill in offered
            if skill.name in self.companions.insisted and skill not in said
        ] or offered
        # An answer never stands without a way on: a skill comes twice rather than one that nobody
        # asked for.
        return Grammar().text(
            " | ".join(
                literal(patterns.quoted(skill.name))
                for skill in offered or sorted(said, key=skills.index) or skills
            )
        )

    def _offers(self, skill: Skill) -> bool:
        if self.role == "navigation" and self.sequence is not None:
            return self._told is not None and self._told.name == skill.name
        if skill.coordinates:
            return (
                self.ground.free or bool(self.ground.following(self.before))
            ) and not self._halt_due(self.steps[-1][0] if self.steps else None, self.before)
        if self.role == "navigation" and self.ground.halts_here(self.before) is False:
            return False
        if self.role == "navigation" and self.ground.waypoints_alone:
            return False
        if skill.motion in ROTATING and self.turns is not None:
            return self._turn is not None and self._turn[0] == skill.name
        if self.role == "navigation" and not self._spoken(skill):
            return False
        if self.role != "navigation" and self._runs(skill, *self._movement) is False:
            return False
        uses = [parameters for used, parameters in self.beside if used == skill]
        if uses and self._told_value(skill) is not None:
            return False
        if self.role == "navigation" and {} in spent(skill, self.steps, self.text):
            return False
        return (
            repeatable(skill, uses)
            and skill_body(Grammar(), skill, self._values_of(skill)) is not None
        )

    def _spoken(self, movement: Skill) -> bool:
        """Whether the input may speak of a movement."""
        return self.companions.movements is None or movement.name in self.companions.movements

    def _values_of(self, skill: Skill) -> Values:
        """What the parameters of a skill may be here: not again what it said before."""
        if skill.role == "navigation" and self._told and self._told.name == skill.name:
            return (
                self.values
                if self._told.free
                else MovementValues(self.values, skill, self._told.values)
            )
        if skill.motion in ROTATING and self._turn and self._turn[0] == skill.name:
            return TurnValues(self.values, skill, self._turn[1])
        if skill.role == "navigation":
            return UnlikeValues(self.values, skill, spent(skill, self.steps, self.text))
        told = self._told_value(skill)
        if told is not None:
            return TurnValues(self.values, skill, told)
        return UnlikeValues(
            self.values, skill, [parameters for used, parameters in self.beside if used == skill]
        )

    def _told_value(self, skill: Skill) -> float | None:
        """The value of a filter or perception skill in the step that is being written, where the
        input tells one for it.
        """
        if skill.role == "navigation" or not skill.parameters:
            return None
        return self.companions.value(
            skill.name,
            self._movement[0].name,
            [earlier.name for earlier, _parameters in self.steps],
        )

    @property
    def _told(self) -> Movement | None:
        """The movement of this step, where all are known."""
        return (
            self.sequence[len(self.steps)]
            if self.sequence is not None and len(self.steps) < len(self.sequence)
            else None
        )

    @property
    def _turned(self) -> int:
        """Rotations of the steps that are written."""
        return sum(skill.motion in ROTATING for skill, _parameters in self.steps)

    @property
    def _turn(self) -> Turn | None:
        """The rotation that comes next; None where there is none, or where it is not known."""
        return (
            self.turns[self._turned]
            if self.turns is not None and self._turned < len(self.turns)
            else None
        )

    def _runs(self, skill: Skill, movement: Skill, path: Path) -> bool | None:
        """Whether a skill must or must not run beside a movement in the step that is being written,
        with the waypoints up to it.
        """
        earlier = [name.name for name, _parameters in self.steps]
        verdict = self.companions.runs(
            skill.name, movement.name, earlier, path if movement.coordinates else ()
        )
        return (
            verdict
            if verdict is not True or skill_body(Grammar(), skill, self.values) is not None
            else None
        )

    def _listed(
        self, role: Role, movement: Skill, path: Path, said: Row[Skill] = ()
    ) -> tuple[bool, bool]:
        """Whether a list of skills beside a movement may go on, and whether it may end, behind
        those that were `said`.
        """
        skills = [
            (skill, self._runs(skill, movement, path))
            for skill in self.vocabulary.skills_in_role(role)
        ]
        missing = any(runs and skill not in said for skill, runs in skills)
        more = len(said) < MOST_SKILLS and any(
            runs is not False
            and (skill not in said or (skill.parameters and not self._single(skill, movement)))
            for skill, runs in skills
        )
        return more or missing, not missing

    def _single(self, skill: Skill, movement: Skill) -> bool:
        """Whether a skill stands beside a movement once, since its value there is told."""
        return (
            self.companions.value(
                skill.name, movement.name, [earlier.name for earlier, _parameters in self.steps]
            )
            is not None
        )

    def _behind_name(self) -> str:
        """What may stand behind the chosen name, up to the next one."""
        assert self.chosen is not None
        grammar = Grammar()
        if self.role == "navigation":
            options = [
                f"{self._body(grammar, values)} {literal(',' + FILTERS)}"
                f" {self._list(grammar, 'filter', self.chosen, path, ending)}"
                for values, path, ending in self._movements()
            ]
            return grammar.text(" | ".join(options))
        movement, before = self._movement
        ending, said = (
            self._ending(movement, before),
            [*(skill for skill, _parameters in self.beside), self.chosen],
        )
        values, behind = (
            self._values_of(self.chosen),
            self._list(grammar, self.role, movement, before, ending, said),
        )
        if self._lists_texts and values.item(Grammar(), ()):
            only, opens = self.chosen.parameters[0], f'",{key("parameters")}{{'
            without = (
                "" if values.needs(only, self.chosen) else f" | {literal(opens + '}}')} {behind}"
            )
            return grammar.text(f"{literal(opens + key(only.name) + LIST_OPENS)}{without}")
        return grammar.text(f"{self._body(grammar, values)} {behind}")

    @property
    def _lists_texts(self) -> bool:
        """Whether the chosen skill has a list of texts and nothing else: it is written text by
        text, since none stands in it twice.
        """
        return self.chosen is not None and [item.type for item in self.chosen.parameters] == [
            "texts"
        ]

    def _behind_text(self) -> str:
        """A text of a list that none before it is, and what may stand behind that."""
        assert self.chosen is not None
        grammar, (movement, before) = Grammar(), self._movement
        ending, said = (
            self._ending(movement, before),
            [*(skill for skill, _parameters in self.beside), self.chosen],
        )
        behind = (
            f"{literal(']}}')} {self._list(grammar, self.role, movement, before, ending, said)}"
        )
        text = self.values.item(grammar, self.listed) or self.values.item(grammar, ())
        more = (
            len(self.listed) + 1 < MOST_TEXTS
            and self.values.item(Grammar(), (*self.listed, "")) is not None
        )
        return grammar.text(
            f"{text} ({literal(NEXT_TEXT[1:])} | {behind})" if more else f"{text} {behind}"
        )

    def _list(
        self,
        grammar: Grammar,
        role: Role,
        movement: Skill,
        path: Path,
        ending: Ending,
        said: Row[Skill] = (),
    ) -> str:
        """What may stand in the list of a role's skills behind those that were said: the next one,
        or what follows the list.
        """
        more, ends = self._listed(role, movement, path, said)
        options = [literal("," * bool(said) + SKILL_OPENS)] if more else []
        if ends or not more:
            behind = (
                self._list(grammar, "perception", movement, path, ending)
                if role == "filter"
                else f"{step_tail(grammar, self.values)} {self._ends(ending)}"
            )
            options.append(f"{literal('],' + PERCEPTIONS if role == 'filter' else ']')} {behind}")
        return f"({' | '.join(options)})"

    def _body(self, grammar: Grammar, values: Values) -> str:
        assert self.chosen is not None
        body = skill_body(grammar, self.chosen, values) or skill_body(
            grammar, self.chosen, self.values
        )
        return body or str(skill_body(grammar, self.chosen, SchemaValues()))

    def _movements(self) -> list[tuple[Values, Path, Ending]]:
        """What the parameters of the chosen movement may be, the waypoints with it where they tell
        what runs beside it, and whether the answer ends there.
        """
        assert self.chosen is not None
        following = (
            self.ground.following(self.before)
            if self.chosen.coordinates and not self.ground.free
            else []
        )
        if not self.chosen.coordinates or self.ground.free or self._told:
            # Where waypoints are free, what runs beside one is told by its number alone.
            path = (
                (*self.before, following[0])
                if len(following) == 1
                else (*self.before, NOWHERE)
                if self.ground.free
                else ()
            )
            return [(self._values_of(self.chosen), path, self._ending(self.chosen, self.before))]
        found: dict[tuple[Ending, Path], list[Point]] = {}
        for point in following:
            path = (*self.before, point)
            found.setdefault(
                (self._ending(self.chosen, path), path if self.companions.on_path else ()), []
            ).append(point)
        return [
            (RouteValues(self.values, points), path, ending)
            for (ending, path), points in found.items()
        ] or [(self.values, (), "may")]

    @functools.cached_property
    def _movement(self) -> tuple[Skill, Path]:
        """The movement of the step that is being written, and the waypoints with its own."""
        movement = self._first_of(self.written[len(STEP_OPENS) - len(SKILL_OPENS) :])
        return movement[0], self._path(movement)

    def _ending(self, movement: Skill, before: Path) -> Ending:
        """Whether the answer may, must or may not yet end behind a step with this movement: no
        movement is left out that is asked for.
        """
        ending = self._read_ending(movement, before)
        return "not yet" if ending == "may" and self._owed(movement) else ending

    def _read_ending(self, movement: Skill, before: Path) -> Ending:
        """The same as far as paths and rotations tell: none is left half-way."""
        if self.sequence is not None:
            return "not yet" if len(self.steps) + 1 < len(self.sequence) else "must"
        if self._halt_due(movement, before):
            return "not yet"
        turned = self._turned + (movement.motion in ROTATING)
        return (
            "not yet"
            if self.turns is not None and turned < len(self.turns)
            else self.ground.ending(before)
        )

    def _halt_due(self, movement: Skill | None, before: Path) -> bool:
        """Whether a hold or the like must follow a step with this movement, which goes to a
        waypoint where the input asks for one.
        """
        return (
            movement is not None
            and bool(movement.coordinates)
            and self.ground.halts_here(before) is True
            and self._any_halt
        )

    @functools.cached_property
    def _any_halt(self) -> bool:
        """Whether the input speaks of a movement that goes nowhere."""
        return any(
            self._spoken(skill)
            for skill in self.vocabulary.skills_in_role("navigation")
            if not skill.coordinates
        )

    def _ends(self, ending: Ending) -> str:
        """What follows a step: another one, or the end."""
        more = (
            [literal("," + STEP_OPENS)]
            if len(self.steps) + 1 < MOST_STEPS and ending != "must"
            else []
        )
        return (
            f"({' | '.join(more + ([literal(CLOSES)] if ending != 'not yet' or not more else []))})"
        )


def waypoint(movement: Step) -> Point | None:
    """Where a movement goes; None for one that goes nowhere."""
    pair = movement[0].coordinates
    return (movement[1][pair[0].name], movement[1][pair[1].name]) if pair else None
