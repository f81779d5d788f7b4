"""Steps of a skill plan in canonical form: from the skills that run in them, and from a bound
template once its values are known.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

from planner_ft.data.task.binding import XY, Bound
from planner_ft.data.task.phrasebook import Phrasebook
from planner_ft.data.task.shapes import SHAPES
from planner_ft.data.templates.grammar import Argument, Call
from planner_ft.data.templates.grammar import Step as Pattern
from planner_ft.facts.geometry import tidy
from planner_ft.vocabulary.definition import Vocabulary
from planner_ft.vocabulary.plans import canonical_parameters

Step = tuple[str, dict[str, Any]]
"""A navigation skill and its parameters."""
Entry = dict[str, Any]
Beside = tuple[list[Entry], list[Entry]]
"""Filters and perception skills of a step."""


def entry_of(name: str, parameters: Mapping[str, Any], vocabulary: Vocabulary) -> Entry:
    """A skill as it stands in a plan."""
    canonical = canonical_parameters(dict(parameters), vocabulary.skill[name])
    return {"name": name, "parameters": canonical}


def plan_step(
    name: str,
    parameters: dict[str, Any],
    filters: list[Entry],
    perceptions: list[Entry],
    vocabulary: Vocabulary,
) -> Entry:
    """A step of the plan in canonical form, with the strings that its skills report."""
    running = (name, *(entry["name"] for entry in (*filters, *perceptions)))
    stops, failures, outputs = _reports(vocabulary, running)
    return {
        "navigation_skill": entry_of(name, parameters, vocabulary),
        "filter_skills": filters,
        "perception_skills": perceptions,
        "stop_conditions": list(stops),
        "failure_modes": list(failures),
        "expected_outputs": list(outputs),
    }


@functools.lru_cache(maxsize=4096)
def _reports(vocabulary: Vocabulary, running: tuple[str, ...]) -> list[list[str]]:
    """Stop condition of the first skill, failure modes and outputs of all."""
    skills = [vocabulary.skill[name] for name in running]
    failures, outputs = ([getattr(skill, key) for skill in skills] for key in ("failure", "output"))
    return [list(filter(None, dict.fromkeys(t))) for t in ([skills[0].stop], failures, outputs)]


def _stands(at: str, number: int, count: int) -> bool:
    """Whether what is marked `at` stands at waypoint `number`, counted from 0, of `count`."""
    marks = {"first": number == 0, "last": number == count - 1}
    return marks.get(at, not at or (at == "even") == bool(number % 2))


class Plan:
    """The steps of a bound template. `labels` are those that were chosen; `given` has the value of
    a slot or a task parameter, None where it was not said; `added` runs in every step.
    """

    def __init__(
        self,
        bound: Bound,
        book: Phrasebook,
        labels: Collection[str],
        given: Callable[[Argument], Any],
        added: Beside = ([], []),
    ) -> None:
        self.bound, self.book, self.labels, self.given = bound, book, labels, given
        self.added = added
        self.vocabulary = book.vocabulary

    def steps(self) -> list[Entry]:
        """The steps. Raises ValueError when what was chosen makes no plan."""
        everywhere = self.bound.everywhere
        common = self.beside(everywhere) if everywhere else ([], [])
        return [
            entry
            for step in self.bound.steps
            if not step.call.label or step.call.label in self.labels
            for entry in self._expand(step, common)
        ]

    def _expand(self, step: Pattern, common: Beside) -> list[Entry]:
        entries: list[Entry] = []
        moves = self._moves(step.call)
        for number, (name, parameters) in enumerate(moves):
            own = self.beside(step, number, len(moves))
            parts = (common, own) if self.bound.front else (own, common)
            filters, perceptions = ([*first, *then] for first, then in zip(*parts, strict=True))
            for mine, more in zip((filters, perceptions), self.added, strict=True):
                mine += [entry for entry in more if entry not in mine]
            entries.append(plan_step(name, parameters, filters, perceptions, self.vocabulary))
            if step.each and _stands(step.each.call.at, number, len(moves)):
                entries += self._expand(step.each, common)
        return entries

    def beside(self, step: Pattern, number: int = 0, count: int = 1) -> Beside:
        """Filters and perception skills at waypoint `number`, counted from 0, of `count`."""
        filters, perceptions = (
            [
                entry_of(call.name, self._parameters(call), self.vocabulary)
                for call in calls
                if _stands(call.at, number, count) and (not call.label or call.label in self.labels)
            ]
            for calls in (step.filters, step.perceptions)
        )
        return filters, perceptions

    def _moves(self, call: Call) -> Sequence[Step]:
        """Navigation skills with their parameters. Raises ValueError when lanes do not fill."""
        shape = SHAPES.get(call.name)
        if shape is None:
            return [(call.name, self._parameters(call))]
        said = ((argument.name, self._value(argument)) for argument in call.arguments)
        values = {name: value for name, value in said if value is not None}
        name = self.book.motions[shape.motion]
        try:
            found = shape.expand({**values, "home": self.vocabulary.home})
        except KeyError as error:
            raise ValueError(f"{call.name} has no {error}") from None
        if shape.motion == "goto":
            return [(name, {"x": x, "y": y}) for x, y in found]
        key = self.book.skills[name].skill.parameters[0].name
        return [(name, {key: value}) for value in found]

    def _parameters(self, call: Call) -> dict[str, Any]:
        parameters: dict[str, Any] = {}
        known = self.vocabulary.skill[call.name].by_name
        for argument in call.arguments:
            value = self._value(argument)
            if value is None:
                continue
            if argument.name == XY:
                parameters["x"], parameters["y"] = value
            else:
                as_list = known[argument.name].type == "texts" and not isinstance(value, list)
                parameters[argument.name] = [value] if as_list else value
        return parameters

    def _value(self, argument: Argument) -> Any:
        if argument.kind == "literal":
            value = argument.value
            return tidy(value) if isinstance(value, float) else value
        drawn = self.given(argument)
        return -drawn if argument.negative and drawn is not None else drawn
