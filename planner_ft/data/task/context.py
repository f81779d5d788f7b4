"""One sample in the making: the task's parameters and which of their values the prompt has used."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from planner_ft.data.numbers import Value, pick, say_number
from planner_ft.data.task.phrase import Phrase, parse_phrase
from planner_ft.data.task.phrasebook import Phrasebook, Saying, Slots
from planner_ft.data.task.steps import Step
from planner_ft.data.task.values import Draw, draw_position, sense_of
from planner_ft.vocabulary.definition import Task

REPEATED = 0.08
"""Share of calls with an interval in the prompt, which no skill has."""
REFER = 0.3
"""Share of values that stand in the task's parameters alone."""
UNRESOLVED = 0.05
"""Share of samples whose position is not known yet."""


@dataclass
class Movement:
    """Steps in one wording; `saying` is None where the prompt asks for no movement, so that the
    vehicle holds.
    """

    kind: str
    steps: list[Step]
    saying: Saying | None


@dataclass(eq=False)
class Call:
    """A skill with its parameters and its wordings: as a command, in other forms ("with",
    "passive"). `skill` is None for words that ask for no skill of their own; `order` is the place
    of its mention in the prompt.
    """

    skill: str | None
    parameters: dict[str, Any]
    saying: Saying
    other: dict[str, Saying] = field(default_factory=dict)
    order: int = 0


class Context:
    """Draws calls for one task; a task parameter that fills a slot is used once, then the slot has
    values of its own.
    """

    def __init__(self, book: Phrasebook, task: Task, rng: random.Random) -> None:
        self.book, self.task, self.rng = book, task, rng
        self.entry = book.tasks[task.title]
        self.values: dict[str, Value] = {}
        self.used: set[str] = set()
        for parameter in task.parameters:
            if parameter.required or rng.random() < 0.75:
                self.require(parameter.name)
        if task.require_any and not any(name in self.values for name in task.require_any):
            self.require(pick(task.require_any, rng))
        place, share = task.position_parameter, UNRESOLVED / (1 if task.arrival == "self" else 2)
        if place in self.values and rng.random() < share:
            self.values[place] = Value(list(book.vocabulary.unresolved), "", "", "")

    def slots(self) -> Slots:
        """Empty slots that know the vehicle's words and the task's values."""
        return Slots(self.book, self.rng, self.values)

    def require(self, name: str) -> Value:
        """The task parameter's value, drawn now if the task has none yet."""
        if name not in self.values:
            self.values[name] = self.entry.draws[name](self.rng)
        return self.values[name]

    def unresolved(self, value: Value) -> bool:
        """Whether this is a position that is not known yet and so can only be referred to."""
        return value.text == ""

    def linked(self, place: str) -> str | None:
        """The task parameter that fills this slot ("StationKeep.time") and has not been used up."""
        name = self.entry.links.get(place)
        return name if name in self.values and name not in self.used else None

    def fill(self, slots: Slots, slot: str, place: str) -> Any:
        """Put the linked task parameter into `slot`, stated or only referred to; its value."""
        name = self.entry.links[place]
        value = self.values[name]
        referred = name not in self.entry.stated and self.rng.random() < REFER
        if self.unresolved(value) or referred:
            slots[slot] = self.refer(name)
        else:
            slots.put(slot, value)
        self.used.add(name)
        return value.value

    def take(self, slots: Slots, slot: str, place: str, draw: Draw) -> Any:
        """The value of the linked task parameter, else a new one that only the prompt states."""
        if self.linked(place):
            return self.fill(slots, slot, place)
        return slots.put(slot, draw(self.rng))

    def refer(self, name: str) -> str:
        """Words for the task parameter's value."""
        phrases = self.entry.refer[name]
        if self.entry.unresolved and self.unresolved(self.values[name]) and self.rng.random() < 0.7:
            phrases = self.entry.unresolved
        return pick(phrases, self.rng).render(self.slots(), self.rng)

    def call(self, name: str) -> Call:
        """A skill with drawn parameters and its wordings."""
        entry, rng, slots = self.book.skills[name], self.rng, self.slots()
        parameters: dict[str, Any] = {}
        goto = entry.skill.motion == "goto"
        if goto:
            parameters["x"], parameters["y"] = self.take(slots, "xy", f"{name}.xy", draw_position)
        for key in entry.skill.by_name:
            if key in parameters:
                continue
            if self.linked(f"{name}.{key}"):
                parameters[key] = self._linked_value(slots, name, key)
            elif rng.random() < entry.often[key]:
                parameters[key] = slots.put(key, entry.draws[key](rng))
        given = frozenset(slots)
        phrases = entry.fitting(given)
        if (name == self.entry.phrases_for or goto) and rng.random() < 0.6:
            own = self.entry.phrases
            if goto:
                own = self.book.pattern("goto", self.task.title, given)
            phrases = [phrase for phrase in own if phrase.fits(given)] or phrases
        repeat = self.book.sentences.get("repeat")
        if entry.repeats and repeat and rng.random() < REPEATED:
            words = parse_phrase(pick(repeat, rng)).render(self.slots(), rng)
            return Call(name, parameters, Saying(phrases, slots, f" {words}"))
        forms = {kind: entry.fitting(given, kind) for kind in ("with", "passive")}
        other = {kind: Saying(found, slots) for kind, found in forms.items() if found}
        return Call(name, parameters, Saying(phrases, slots), other)

    def _linked_value(self, slots: Slots, name: str, key: str) -> Any:
        """The task parameter's value, in the words of the skill's parameter ("an arc of 90" as "90
        degrees to the right").
        """
        entry = self.book.skills[name]
        parameter = entry.skill.by_name[key]
        value = self.fill(slots, key, f"{name}.{key}")
        sense = sense_of(parameter, entry.values[key])
        if sense == "rotation" and f"{key} full" in slots:
            slots.put(key, say_number(value, sense, parameter.unit, self.rng))
        return [value] if parameter.type == "texts" and isinstance(value, str) else value

    def simple(self, name: str) -> Movement:
        """One navigation skill in one step."""
        call = self.call(name)
        kind = self.book.skills[name].skill.motion or name
        return Movement(kind, [(name, call.parameters)], call.saying)

    def movement(self, pattern: str, steps: Sequence[Step], slots: Slots) -> Movement | None:
        """Steps in a phrase of the pattern; None where no phrase says what is given."""
        phrases = self.phrases(pattern, slots)
        return Movement(pattern, list(steps), Saying(phrases, slots)) if steps and phrases else None

    def phrases(self, pattern: str, slots: Slots, key: str = "phrases") -> list[Phrase]:
        """The pattern's phrases that say exactly what is given."""
        return self.book.pattern(pattern, self.task.title, frozenset(slots), key)

    def goto(self, points: Sequence[tuple[float, float]]) -> list[Step]:
        """Steps to these points; none for a vehicle that cannot go to one."""
        name = self.book.motions.get("goto")
        return [(name, {"x": x, "y": y}) for x, y in points] if name else []

    def parameters(self) -> dict[str, Any]:
        """The task's parameters as they stand in the record, in the order of the definition."""
        return {name: self.values[name].value for name in self.task.by_name if name in self.values}


Builder = Callable[[Context], Movement | None]
