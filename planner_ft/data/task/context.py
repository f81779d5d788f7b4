"""One sample in the making: the task's parameters and which of their values the prompt has used."""

from __future__ import annotations

import random
from typing import Any

from planner_ft.data.numbers import Value, position
from planner_ft.data.task.phrasebook import Call, Phrasebook, Saying, Slots
from planner_ft.data.task.template import compile_template
from planner_ft.data.task.values import draw_point, say_number, sense_of
from planner_ft.vocabulary.definition import Task

REPEATED = 0.08  # share of calls said with an interval, which no skill has
REFER = 0.3  # share of values that stand in the task's parameters alone
UNRESOLVED = 0.05  # share of samples whose position is not known yet


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
                self.values[parameter.name] = self.entry.draws[parameter.name](rng)
        if task.require_any and not any(name in self.values for name in task.require_any):
            name = task.require_any[int(rng.random() * len(task.require_any))]
            self.values[name] = self.entry.draws[name](rng)
        place = task.position_parameter
        if place in self.values and rng.random() < (
            UNRESOLVED if task.arrival == "self" else UNRESOLVED / 2
        ):
            self.values[place] = Value(list(book.vocabulary.unresolved), "", "", "")

    def slots(self) -> Slots:
        """Empty slots that know the vehicle's words and the task's values."""
        return Slots(
            self.book, self.rng, {name: value for name, value in self.values.items() if value.text}
        )

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

    def fill(self, slots: Slots, slot: str, place: str, *, refer: bool | None = None) -> Any:
        """Put the linked task parameter into `slot`, stated or only referred to; its value."""
        name = self.entry.links[place]
        self.used.add(name)
        value = self.values[name]
        referred = name not in self.entry.stated and (
            self.rng.random() < REFER if refer is None else refer
        )
        if self.unresolved(value) or referred:
            slots.put_words(slot, self.refer(name))
        else:
            slots.put(slot, value)
        return value.value

    def refer(self, name: str) -> str:
        """Words for the task parameter's value."""
        templates = self.entry.refer[name]
        if self.entry.unresolved and self.unresolved(self.values[name]) and self.rng.random() < 0.7:
            templates = self.entry.unresolved
        return templates[int(self.rng.random() * len(templates))].render(self.slots(), self.rng)

    def call(self, name: str) -> Call:
        """A skill with drawn parameters, as it is said."""
        entry, rng, slots = self.book.skills[name], self.rng, self.slots()
        parameters: dict[str, Any] = {}
        if entry.skill.motion == "goto":
            parameters["x"], parameters["y"] = self.point(slots, f"{name}.xy")
        for parameter in entry.skill.parameters:
            key = parameter.name
            place = f"{name}.{key}"
            if key in parameters:
                continue
            if self.linked(place):
                parameters[key] = self._linked_value(slots, key, place)
            elif rng.random() < entry.often[key]:
                value = entry.draws[key](rng)
                slots.put(key, value)
                parameters[key] = value.value
        given = frozenset(slots.given)
        templates = entry.fitting(given)
        if entry.skill.motion == "goto" and self.entry.goto_phrases and rng.random() < 0.6:
            templates = [
                template for template in self.entry.goto_phrases if template.fits(given)
            ] or templates
        elif name == self.entry.phrases_for and rng.random() < 0.6:
            templates = [
                template for template in self.entry.phrases if template.fits(given)
            ] or templates
        if entry.repeats and rng.random() < REPEATED and self.book.sentences.get("repeat"):
            return Call(name, parameters, Saying(templates, slots, suffix=" " + self._repeat()))
        after_with, nouns, passive = (
            Saying(found, slots) if found else None
            for found in (entry.after_with(given), entry.nouns(given), entry.passive(given))
        )
        return Call(name, parameters, Saying(templates, slots), after_with, nouns, passive)

    def _repeat(self) -> str:
        phrases = self.book.sentences["repeat"]
        return compile_template(phrases[int(self.rng.random() * len(phrases))]).render(
            self.slots(), self.rng
        )

    def _linked_value(self, slots: Slots, key: str, place: str) -> Any:
        """The task parameter's value, said in the way of the skill's parameter ("an arc of 90" as
        "90 degrees to the right").
        """
        skill_name = place.split(".")[0]
        parameter = self.book.skills[skill_name].skill.by_name[key]
        value = self.fill(slots, key, place)
        config = self.book.raw.get("skill", {}).get(skill_name, {}).get("values", {}).get(key, {})
        sense = sense_of(parameter, config)
        if sense == "rotation" and f"{key}#" in slots:
            slots.put(key, say_number(value, sense, parameter.unit, self.rng))
        return [value] if parameter.type == "texts" and isinstance(value, str) else value

    def point(self, slots: Slots, place: str) -> tuple[float, float]:
        """A place to go to: the task's, if not used up, else one of its own."""
        if self.linked(place):
            x, y = self.fill(slots, "xy", place)
            return x, y
        value = position(draw_point(self.rng), self.rng)
        slots.put("xy", value)
        return value.value[0], value.value[1]

    def parameters(self) -> dict[str, Any]:
        """The task's parameters as they stand in the record, in the order of the definition."""
        return {
            parameter.name: self.values[parameter.name].value
            for parameter in self.task.parameters
            if parameter.name in self.values
        }
