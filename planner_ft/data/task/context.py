"""One sample in the making: the task's parameters and which of their values the prompt has used."""

from __future__ import annotations

import random
from typing import Any

from planner_ft.data.numbers import Value, pick
from planner_ft.data.task.phrasebook import Phrasebook, parse_phrase
from planner_ft.data.templates.grammar import choose
from planner_ft.data.templates.render import PIECE, joined
from planner_ft.vocabulary.definition import Task

UNRESOLVED = 0.05
"""Share of samples whose position is not known yet."""


class Context:
    """The task's values; one that fills a slot is used once, then the slot has its own values."""

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
        phrases = self.entry.refer[name]
        if self.entry.unresolved and self.unresolved(name) and self.rng.random() < 0.7:
            phrases = self.entry.unresolved
        return self.say(pick(phrases, self.rng))

    def say(self, phrase: str) -> str:
        """A wording of a phrase without values of the plan."""
        parts = choose(parse_phrase(phrase), self.rng, [])
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

    def parameters(self) -> dict[str, Any]:
        """The task's parameters as they stand in the record, in the order of the definition."""
        return {name: self.values[name].value for name in self.task.by_name if name in self.values}
