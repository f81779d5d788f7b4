"""One sample from a bound template: values drawn, the text put together, the steps worked out."""

from __future__ import annotations

import random
import re
from collections.abc import Sequence
from typing import Any

from planner_ft.data.numbers import Value, angle, count_text, length, rotation
from planner_ft.data.task.context import Context
from planner_ft.data.task.phrase import mark
from planner_ft.data.task.prompts import shapes
from planner_ft.data.task.prompts.binding import Bound, Call, Fill, Source, Step
from planner_ft.data.task.steps import Step as Move
from planner_ft.data.task.steps import plan_step
from planner_ft.data.templates.grammar import Part, Slot, base_of, choose
from planner_ft.facts import geometry as g
from planner_ft.vocabulary.plans import canonical_parameters

LINKED = 0.75  # share of stated values that the task's parameters hold too
SPACING = 0.85  # share of grids whose stated size the task's parameters hold too
LANES = 12

Entry = dict[str, Any]


class Drawing:
    """The values of one sample and what was chosen of the text."""

    def __init__(self, bound: Bound, context: Context) -> None:
        self.bound, self.context, self.rng, self.book = bound, context, context.rng, context.book
        self.values: dict[str, Value] = {}
        self.flags: set[str] = set()
        self._task_values()
        for step in bound.steps:
            if step.movement.name == "Grid":
                self._grid(step.movement)
        self.parts = self._chosen_parts()
        for part in self.parts:
            if isinstance(part, Slot) and not part.sign and part.key not in self.values:
                self.values[part.key] = self._draw(part.key, bound.sources[part.key])

    # ------------------------------------------------------------ values

    def _task_values(self) -> None:
        """Task parameters that the text refers to are there; positions are known where something is
        calculated from them.
        """
        context = self.context
        for name in sorted(self.bound.params):
            context.require(name)
            context.used.add(name)
        place = context.task.position_parameter
        if (
            place in context.values
            and context.unresolved(context.values[place])
            and (place in self.bound.located or place not in self.bound.params)
        ):
            context.values[place] = context.entry.draws[place](self.rng)
        for step in self.bound.steps:
            for fill in step.movement.fills:
                if step.movement.shape and fill.kind == "param" and fill.target == "count":
                    number = self.rng.choice((3, 4, 4, 5, 6, 6, 8, 8, 9, 10, 12))
                    context.values[fill.value] = Value(number, count_text(number, self.rng))

    def _grid(self, call: Call) -> None:
        """Size and spacing that fill each other, in the slots and in the task's parameters."""
        context, rng = self.context, self.rng
        fills = {fill.target: fill for fill in call.fills}
        axis = self._early(fills.get("axis")) or "y"
        width, along, spacing = shapes.grid_size(rng, free=axis == "y")
        sizes: dict[str, float] = {
            "width": width,
            "length": along,
            "spacing": spacing,
            "count": g.lane_count(width if axis == "y" else along, spacing) or 0,
        }
        for role, size in sizes.items():
            value = length(size, rng) if role != "count" else Value(size, count_text(size, rng))
            fill = fills.get(role)
            if fill and fill.kind == "slot":
                self.values[fill.value] = value
            name = (
                fill.value
                if fill and fill.kind == "param"
                else context.entry.links.get(f"lawnmower.{role}")
            )
            if name and (
                (fill and fill.kind == "param") or name in context.values or rng.random() < SPACING
            ):
                context.values[name] = value

    def _early(self, fill: Fill | None) -> Any:
        """The value of a slot that others depend on."""
        if fill is None or fill.kind != "slot":
            return fill.value if fill else None
        value = self.values[fill.value] = self._draw(fill.value, self.bound.sources[fill.value])
        return value.value

    def _draw(self, key: str, source: Source) -> Value:
        sign = self.bound.signs.get(key)
        value = self._linked(source) or self._new(key, source)
        if sign:
            size = abs(value.value)
            said = angle(size, self.rng)
            return Value(sign * size, said.text, said.short)
        return value

    def _linked(self, source: Source) -> Value | None:
        """The task's own value, now and then, so that the parameters repeat what the text
        states.
        """
        context = self.context
        name = context.linked(source.place) if source.place and self.rng.random() < LINKED else None
        if not name or context.unresolved(context.values[name]) or source.type == "texts":
            return None
        context.used.add(name)
        value = context.values[name]
        if base_of(source.place).endswith("delta_yaw"):
            return None if not value.value else rotation(value.value, self.rng)
        return value

    def _new(self, key: str, source: Source) -> Value:
        """A value that differs from those of the same kind."""
        others = [
            other.value for name, other in self.values.items() if base_of(name) == base_of(key)
        ]
        value = source.draw(self.rng)
        for _ in range(8):
            if value.value not in others:
                break
            value = source.draw(self.rng)
        return value

    # ------------------------------------------------------------ text

    def _chosen_parts(self) -> list[Part]:
        parts: list[Part] = []
        for part in choose(self.bound.line.nodes, self.rng, []):
            if isinstance(part, Slot) and part.sign == "?":
                self.flags.add(part.key)
            elif isinstance(part, Slot) and part.sign == "_":
                parts.append(self.context.slots()[f"_{part.key}"])
            else:
                parts.append(part)
        return parts

    def text(self) -> str:
        """The prompt with its values marked."""
        said = ""
        for place, part in enumerate(self.parts):
            if isinstance(part, str):
                said += part
                continue
            after = "".join(
                other for other in self.parts[place + 1 : place + 4] if isinstance(other, str)
            )
            said += self._say(part, said, after)
        return tidy(said)

    def _say(self, slot: Slot, before: str, after: str) -> str:
        if slot.sign:
            words = self.context.refer(slot.key)
            return _ARTICLE.sub("", words) if _AFTER_ARTICLE.search(before) else words
        value = self.values[slot.key]
        text = worded(value, slot, before, after)
        if (
            slot.key in self.bound.signs
            and "adj" not in slot.options
            and not (_WAY.search(_clause_end(before)) or _WAY.search(_clause_start(after)))
        ):
            text += self.rng.choice(
                (" to the left", " to port", " anticlockwise")
                if value.value < 0
                else (" to the right", " to starboard", " clockwise")
            )
        return mark(text)

    # ------------------------------------------------------------ steps

    def steps(self) -> list[Entry]:
        """The steps of the plan. Raises ValueError when what was chosen makes no plan."""
        plan: list[Entry] = []
        for step in self.bound.steps:
            if not step.movement.flag or step.movement.flag in self.flags:
                plan += self._expand(step)
        if self.bound.everywhere is None:
            return plan
        filters, perceptions = (
            self._calls(self.bound.everywhere.filters),
            self._calls(self.bound.everywhere.perceptions),
        )
        for entry in plan:
            for own, common in ((entry["filters"], filters), (entry["perceptions"], perceptions)):
                own[:] = [*common, *own] if self.bound.front else [*own, *common]
        return plan

    def _expand(self, step: Step) -> list[Entry]:
        moves = self._moves(step.movement)
        entries: list[Entry] = []
        for index, (name, parameters) in enumerate(moves):
            at = {"first": index == 0, "last": index == len(moves) - 1, "": True}
            filters = self._calls([call for call in step.filters if at[call.at]])
            perceptions = self._calls([call for call in step.perceptions if at[call.at]])
            entries.append(
                {
                    "name": name,
                    "parameters": parameters,
                    "filters": filters,
                    "perceptions": perceptions,
                }
            )
            if step.each:
                entries += self._expand(step.each)
        return entries

    def _moves(self, call: Call) -> list[Move]:
        if not call.shape:
            return [(call.name, self._parameters(call))]
        values = {
            fill.target: value for fill in call.fills if (value := self._value(fill)) is not None
        }
        keys = {
            motion: self.book.skills[name].skill.parameters[0].name
            for motion, name in self.book.motions.items()
            if motion in ("turn_to", "turn_by")
        }
        x, y = self.book.vocabulary.home
        try:
            return shapes.steps_of(call.name, values, self.book.motions, keys, (x, y))
        except KeyError as error:
            raise ValueError(f"{call.name} has no {error}") from None

    def _calls(self, calls: Sequence[Call]) -> list[Entry]:
        return [
            {
                "name": call.name,
                "parameters": canonical_parameters(
                    self._parameters(call), self.book.vocabulary.skill[call.name]
                ),
            }
            for call in calls
            if not call.flag or call.flag in self.flags
        ]

    def _parameters(self, call: Call) -> dict[str, Any]:
        parameters: dict[str, Any] = {}
        known = self.book.vocabulary.skill[call.name].by_name
        for fill in call.fills:
            value = self._value(fill)
            if value is None:
                continue
            if fill.target == "xy":
                parameters["x"], parameters["y"] = value
            else:
                as_list = known[fill.target].type == "texts" and not isinstance(value, list)
                parameters[fill.target] = [value] if as_list else value
        return parameters

    def _value(self, fill: Fill) -> Any:
        """The value, or None for a slot of an alternative that was not chosen."""
        if fill.kind == "literal":
            return g.tidy(fill.value) if isinstance(fill.value, float) else fill.value
        said = (
            self.context.values[fill.value]
            if fill.kind == "param"
            else self.values.get(fill.value)
            if self._chosen(fill.value)
            else None
        )
        if said is None:
            return None
        return -said.value if fill.negative else said.value

    def _chosen(self, key: str) -> bool:
        return any(isinstance(part, Slot) and part.key == key for part in self.parts)


# ---------------------------------------------------------------- wording

_ARTICLE = re.compile(r"^(the|a|an) ")
_AFTER_ARTICLE = re.compile(r"\b(the|a|an|this|that|each|every|its|any) $", re.IGNORECASE)
_WAY = re.compile(
    r"\b(left|right|port|starboard|clockwise|anticlockwise|counter-clockwise)\b", re.IGNORECASE
)


def _clause_end(text: str) -> str:
    return re.split(r"[.;:\x03]", text)[-1][-40:]


def _clause_start(text: str) -> str:
    return re.split(r"[.;:\x02]", text)[0][:40]


def worded(value: Value, slot: Slot, before: str, after: str) -> str:
    """The value's wording here: without its article after one, bare between quotation marks, else
    as the slot asks.
    """
    if before[-1:] in ("'", '"') and after[:1] == before[-1:]:
        return str(value.value)
    if slot.options & {"adj", "num"} and value.short:
        return value.short
    if "noun" in slot.options and value.noun:
        return value.noun
    if "way" in slot.options and value.way:
        return value.way
    return _ARTICLE.sub("", value.text) if _AFTER_ARTICLE.search(before) else value.text


_GAPS = re.compile(r" +(?=[ .,;:!?)])")
_SENTENCE = re.compile(r"(?<!i\.e)(?<!e\.g)(?<!approx)(?<=[.!?] )([a-z])")
_SPOKEN = re.compile(
    r"(^|(?<=[.!?] ))\x02(the |a |an |due"
    r" |(?:north|south|east|west)(?:-(?:east|west))?|[a-z]+-?[a-z]*"
    r" (?:metres?|seconds?|minutes?|degrees?))"
)


def tidy(text: str) -> str:
    """No double blanks; a capital after a full stop where the text begins with one."""
    text = _GAPS.sub("", text).strip()
    if text[:1].isupper() or text[:1] in "\x0212345(":
        text = _SENTENCE.sub(lambda match: match.group(1).upper(), text)
        text = _SPOKEN.sub(
            lambda match: "\x02" + match.group(2)[0].upper() + match.group(2)[1:], text
        )
    return text


def draw_template(bound: Bound, context: Context) -> tuple[str, dict[str, Any], set[str]] | None:
    """The prompt with its values marked, the expected plan and the skills in it; None when the draw
    came to nothing.
    """
    drawing = Drawing(bound, context)
    text = drawing.text()
    try:
        entries = drawing.steps()
    except (ValueError, ZeroDivisionError):
        return None
    if not entries or any(
        _twice(entry[key]) for entry in entries for key in ("filters", "perceptions")
    ):
        return None
    vocabulary = context.book.vocabulary
    steps = [
        plan_step(
            entry["name"], entry["parameters"], entry["filters"], entry["perceptions"], vocabulary
        )
        for entry in entries
    ]
    skills = {
        call["name"]
        for entry in entries
        for key in ("filters", "perceptions")
        for call in entry[key]
    }
    return text, {"skill_sequence": steps}, skills


def _twice(calls: list[Entry]) -> bool:
    """Whether a skill stands twice with the same parameters, or once with none."""
    names = [call["name"] for call in calls]
    return len(set(names)) < len(names) and any(
        names.count(call["name"]) > 1 and (not call["parameters"] or calls.count(call) > 1)
        for call in calls
    )


def pick(lines: Sequence[Sequence[Bound]], rng: random.Random) -> Bound:
    """A line, each equally often, for one of its tasks."""
    tasks = lines[int(rng.random() * len(lines))]
    return tasks[int(rng.random() * len(tasks))]
