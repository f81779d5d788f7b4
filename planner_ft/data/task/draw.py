"""One sample in the making, from a bound template: the task's parameters and which of their values
the prompt has used, the template's values, the text put together, the steps worked out.
"""

import itertools
import re
from collections.abc import Callable, Iterator
from random import Random
from typing import Any, NamedTuple

from planner_ft.data.numbers import Value, count_text, length, pick, rotation
from planner_ft.data.task.binding import SIDES, Bound
from planner_ft.data.task.phrasebook import Phrasebook, parse_phrase
from planner_ft.data.task.steps import DRAWS, SHAPES, Entry, Plan, grid_size, line_legs
from planner_ft.data.templates import grammar, render
from planner_ft.data.templates.grammar import Argument, Call, Slot
from planner_ft.data.templates.render import PIECE, after_article, bare, joined
from planner_ft.vocabulary.definition import Task

LINKED = 0.75  # share of stated values that the task's parameters hold too
REFER = 0.3  # share of values of a clause that stand in the task's parameters alone
SPACING = 0.85  # share of grids whose stated size the task's parameters hold too
_WAY = re.compile(r"\b(left|right|port|starboard|(anti|counter-)?clockwise)\b", re.IGNORECASE)
LEFT = (" to the left", " to port", " anticlockwise")
RIGHT = (" to the right", " to starboard", " clockwise")
UNRESOLVED = 0.05  # share of samples whose position is not known yet
BESIDE = ("filter_skills", "perception_skills")


class Context:
    """The task's values; one that fills a slot is used once, then the slot has its own values."""

    def __init__(self, book: Phrasebook, task: Task, rng: Random) -> None:
        self.book, self.task, self.rng = book, task, rng
        self.entry = book.tasks[task.title]
        self.values: dict[str, Value] = {}
        self.used: set[str] = set()
        self.said: dict[str, list[Any]] = {}
        """The values of the prompt so far by kind, which differ."""
        for parameter in task.parameters:
            if parameter.required or rng.random() < 0.75:
                self.require(parameter.name)
        if task.require_any and not any(name in self.values for name in task.require_any):
            self.require(pick(task.require_any, rng))
        place, share = task.position_parameter, UNRESOLVED / (1 if task.arrival == "self" else 2)
        unknown = list(book.vocabulary.unresolved)
        if place in self.values and rng.random() < share and book.within(unknown):
            self.values[place] = Value(unknown, "", "", "")

    def require(self, name: str) -> Value:
        """The task parameter's value, drawn now if the task has none yet."""
        if name not in self.values:
            self.values[name] = self.entry.draws[name](self.rng)
        return self.values[name]

    def unresolved(self, name: str | None) -> bool:
        """Whether this is a position that is not known yet and so can only be referred to."""
        return name in self.values and self.values[name].text == ""

    def resolve(self, name: str | None) -> None:
        """Make the position known, unless the prompt has referred to it already."""
        if name and self.unresolved(name) and name not in self.used:
            self.values[name] = self.entry.draws[name](self.rng)

    def linked(self, place: str) -> str | None:
        """The task parameter that fills this slot ("StationKeep.time") and has not been used up."""
        name = self.entry.links.get(place)
        return name if name in self.values and name not in self.used else None

    def refer(self, name: str) -> str:
        """Words for the task parameter's value."""
        phrases, unresolved = self.entry.refer(name), self.entry.config.get("unresolved")
        if unresolved and self.unresolved(name) and self.rng.random() < 0.7:
            phrases = unresolved
        return self.say(pick(phrases, self.rng))

    def say(self, phrase: str) -> str:
        """A wording of a phrase without values of the plan."""
        parts = grammar.choose(parse_phrase(phrase), self.rng, [])
        pieces: list[PIECE] = [
            (part, False) if isinstance(part, str) else (self.word(part.key), True)
            for part in parts
        ]
        return joined(pieces, small=True)

    def word(self, name: str) -> str:
        """Text that is no value of the plan: the task parameter of that name, if the task has it,
        else a number of [decor] or an entry of a word list.
        """
        known = self.values.get(name)
        if known is not None and known.text:
            return known.text
        if name in self.book.decor:
            return self.book.decor[name](self.rng).text
        return self.book.lexicon.entry(name, self.rng)

    def prepare(self, bound: Bound) -> None:
        """Have the task parameters that a text refers to; a position that is calculated with is
        known.
        """
        for name in sorted(bound.params):
            self.require(name)
            self.used.add(name)
        shapes = [step.call for step in bound.steps if step.call.name in SHAPES]
        place = self.task.position_parameter
        if place in bound.located:
            self.used.discard(place)
            self.resolve(place)
            self.used.add(place)
        elif shapes or not bound.clause:
            self.resolve(place)
        for argument in itertools.chain(*(call.arguments for call in shapes)):
            if argument.kind == "param" and argument.name == "count":
                self.values[str(argument.value)] = DRAWS["Sectors", "count"](self.rng)

    def parameters(self) -> dict[str, Any]:
        """The task's parameters as they stand in the record, in the order of the definition."""
        return {name: self.values[name].value for name in self.task.by_name if name in self.values}


class Drawn(NamedTuple):
    """A prompt: its family, its text with the values marked, and its steps."""

    family: str
    text: str
    steps: list[Entry]

    @property
    def skills(self) -> set[str]:
        """The skills that run beside the movements."""
        calls = itertools.chain(*(step[key] for step in self.steps for key in BESIDE))
        return {call["name"] for call in calls}


def draw_template(bound: Bound, context: Context) -> Drawn | None:
    """A prompt of a template; None for a draw without a plan."""
    context.prepare(bound)
    drawing = Drawing(bound, context)
    text = joined(drawing.pieces(), small=grammar.is_small(drawing.parts))
    steps = steps_of(drawing.plan.steps)
    return Drawn(f"template/{len(steps)}", text, steps) if steps else None


def steps_of(make: Callable[[], list[Entry]]) -> list[Entry]:
    """The steps that are made; none where they make no plan."""
    try:
        steps = make()
    except (ValueError, ZeroDivisionError):
        return []
    return [] if any(twice(step[key]) for step in steps for key in BESIDE) else steps


def twice(calls: list[Entry]) -> bool:
    """Whether a skill stands twice with the same parameters, or once with none."""
    names = [call["name"] for call in calls]
    return len(set(names)) < len(names) and any(
        names.count(call["name"]) > 1 and (not call["parameters"] or calls.count(call) > 1)
        for call in calls
    )


class Drawing(render.Drawing):
    """The values of one template or clause and what was chosen of the text."""

    def __init__(self, bound: Bound, context: Context) -> None:
        self.bound, self.context, self.rng, self.book = bound, context, context.rng, context.book
        self.referred: dict[str, str] = {}
        given = frozenset(
            key
            for key, share in bound.often.items()
            if self.rng.random() < share or context.linked(bound.places[key])
        )
        super().__init__(bound.nodes, bound.draws, self.rng, given)
        for step in bound.steps:
            if step.call.name in ("Grid", "Line"):
                self._sizes(step.call)
        self.plan = Plan(bound, self.book, self.labels | self.said, self._value)
        for slot in self.slots:
            if not slot.sign:
                if slot.key not in self.values:
                    self.values[slot.key] = self._linked(slot) or self._new(slot)
                context.said.setdefault(slot.base, []).append(self.values[slot.key].value)

    # ------------------------------------------------------------ values

    def _sizes(self, call: Call) -> None:
        """Sizes of a grid, or legs of a line, that fill each other, in the slots and in the task's
        parameters.
        """
        context, rng = self.context, self.rng
        said = (one for one in call.arguments if one.kind != "slot" or one.value in self.said)
        arguments = {one.name: one for one in said}
        links, sizes = context.entry.links, dict[str, float]()
        if call.name == "Grid":
            axis: Any = arguments["axis"].value if "axis" in arguments else "y"
            if "axis" in arguments and arguments["axis"].kind == "slot":
                self.values[axis] = self.draws[axis](rng)
                axis = self.values[axis].value
            sizes = grid_size(rng, free=axis == "y")
        elif not arguments.keys().isdisjoint(("spacing", "count")):
            count = arguments.get("count")
            fixed = int(count.value) if count and count.kind == "literal" else None
            links, sizes = {}, line_legs(fixed, rng)
        for role, size in sizes.items():
            value = length(size, rng) if role != "count" else Value(size, count_text(size, rng))
            argument = arguments.get(role)
            if argument is not None and argument.kind == "slot":
                self.values[str(argument.value)] = value
            if argument is not None and argument.kind == "param":
                context.values[str(argument.value)] = value
                continue
            name = links.get(f"lawnmower.{role}")
            free = name and name not in context.used
            if name and free and (name in context.values or rng.random() < SPACING):
                context.values[name] = value
                context.used.add(name)

    def _linked(self, slot: Slot) -> Value | None:
        """The task's own value; in a clause it may only be referred to."""
        context, clause, place = self.context, self.bound.clause, self.bound.places[slot.key]
        name = context.linked(place) if clause or self.rng.random() < LINKED else None
        if not name:
            return None
        value, unresolved = context.values[name], context.unresolved(name)
        if unresolved and (slot.options or not clause):
            return None
        if place == "sectors.sectors":
            value = context.values[name] = self.draws[slot.key](self.rng)
        if place.endswith("delta_yaw"):
            value = rotation(value.value, self.rng)
        if clause:
            if unresolved or (
                not slot.options
                and name not in context.entry.config.get("stated", ())
                and self.rng.random() < REFER
            ):
                self.referred[slot.key] = context.refer(name)
            elif not value.has(slot.options):
                return None
        context.used.add(name)
        return value

    def _new(self, slot: Slot) -> Value:
        """A value that differs from those of the same kind."""
        options = slot.options if self.bound.clause else render.PLAIN
        return self.new(slot.key, self.context.said.get(slot.base, ()), options)

    # ------------------------------------------------------------ text

    def spoken(self, slot: Slot, place: int) -> Iterator[PIECE]:
        """A value as it is stated or referred to, or words that are none."""
        if slot.sign == "_":
            yield self.context.word(slot.key), True
        elif slot.sign == "param" or slot.key in self.referred:
            said = self.referred.get(slot.key) or self.context.refer(slot.key)
            before = self.parts[place - 1] if place else ""
            yield bare(said) if isinstance(before, str) and after_article(before) else said, False
        elif slot.sign == "~":
            yield self._new(slot).worded(slot.options), True
        else:
            yield self._said(slot, place), True

    def _said(self, slot: Slot, place: int) -> str:
        """The value's wording: bare in quotation marks, with the side where the text has none."""
        value = self.values[slot.key]
        around = (self.parts[:place][-2:], self.parts[place + 1 : place + 4])
        before, after = ("".join(part for part in some if isinstance(part, str)) for some in around)
        if before[-1:] in ("'", '"') and after[:1] == before[-1:]:
            return str(value.value)
        text = value.worded(slot.options)
        if SIDES.keys() & self.asked(slot.key) and "adj" not in slot.options:
            clause = re.split(r"[.;:]", before)[-1][-40:], re.split(r"[.;:]", after)[0][:40]
            if not any(_WAY.search(text) for text in clause):
                text += pick(LEFT if value.value < 0 else RIGHT, self.rng)
        return text

    # ------------------------------------------------------------ steps

    def _value(self, argument: Argument) -> Any:
        """The value, or None for a slot of an alternative that was not chosen."""
        key = str(argument.value)
        if argument.kind == "param":
            return self.context.values[key].value
        return self.values[key].value if key in self.said else None
