"""Clauses of a command, limits and demands for data: what they say and what they add to a plan.

The records stand in NAME.clauses.jsonl, the sentences of limits in NAME.limits.toml and those of
demands under [demand] in NAME.missions.toml (docs/data.md, "Clauses").
"""

from __future__ import annotations

import functools
from collections.abc import Sequence
from dataclasses import dataclass, field
from random import Random
from typing import TYPE_CHECKING, Any

from planner_ft.data.drawing import Drawing
from planner_ft.data.mission_binding import IT, LIMIT, Bound, bound
from planner_ft.data.mission_plan import Planned, Target
from planner_ft.data.templates.grammar import Slot, TemplateError, all_slots
from planner_ft.data.templates.records import Template
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.limits import load_limits, prompt_sentence, sentence, slots

if TYPE_CHECKING:
    from planner_ft.data.missions import MissionSampler

SCOPES = ("mission", "task", "way", "home")
Beside = tuple[str, str, dict[str, Any]]
"""A skill that runs in the steps of a task: role, name and parameters."""


@dataclass
class Effect:
    """What a clause adds to the `planned` tasks: constraints, and by the task's place a sentence of
    its prompt with the skill that it stands for. `about`: the kinds of limits and the skills in it.
    """

    planned: Sequence[Planned]
    about: set[str] = field(default_factory=set)
    constraints: list[str] = field(default_factory=list)
    sentences: list[tuple[int, str, Beside | None]] = field(default_factory=list)

    def moving(self) -> list[int]:
        """The places of the tasks in which the vehicle moves or holds a place."""
        tasks = enumerate(item.task for item in self.planned)
        return [at for at, task in tasks if task.arrival != "none" or task.pattern != "hold"]

    def add(self, places: Sequence[int], text: str, beside: Beside | None = None) -> None:
        """A sentence for the tasks at these places."""
        self.sentences += [(place, text, beside) for place in places]

    def limit(
        self, vocabulary: Vocabulary, kind: str, given: dict[str, Any], own: Sequence[int] = ()
    ) -> bool:
        """Add a limit; whether it fits. One of the tasks at the places `own` alone names their
        titles, which no other task may have. Raises TemplateError where a value is missing.
        """
        planned, places, titles = self.planned, self.moving(), list[str]()
        if given.pop("scope", "mission") == "task":
            titles = [planned[place].task.title for place in own]
            others = (item for place, item in enumerate(planned) if place not in own)
            if any(item.task.title in titles for item in others):
                return False
            places = [place for place in places if place in own]
        limits = load_limits(vocabulary)
        rule = limits[kind]
        if not any(set(slots(form)) <= given.keys() for form in rule.sentences):
            raise TemplateError(f"{kind} needs {' and '.join(slots(rule.sentences[-1]))}")
        self.about.add(kind)
        self.constraints.append(sentence(kind, given, limits, titles))
        values = {name: given[value] for name, value in rule.parameters.items()}
        if kind == "return":
            places = [place for place in places if planned[place].intent.home]
        elif kind == "duration" and not titles:
            places = []
        beside = ("filter", rule.filter, values) if rule.filter else None
        self.add(places, prompt_sentence(kind, given, limits), beside)
        return True


class Clause(Drawing):
    """One clause in the making; `it` is the target that it may take up again."""

    def __init__(
        self, sampler: MissionSampler, template: Template, rng: Random, it: Target | None = None
    ) -> None:
        self.it = it
        super().__init__(sampler, bind_clause(template, sampler), rng)

    def _draw(self, slot: Slot) -> None:
        if slot.base != IT:
            super()._draw(slot)
        elif self.it is not None:
            self.targets[IT] = self.it

    def effect(self, planned: list[Planned], covered: set[int], *, alone: bool) -> Effect | None:
        """What the clause adds to a plan of which it covers the tasks at these places; None where
        it does not fit. `alone`: these tasks are one thing that was asked for.
        """
        effect, titles = Effect(planned), frozenset(self.template.tasks)
        asked = [at for at in sorted(covered) if not planned[at].inserted]
        own = [at for at in asked if not planned[at].intent.home]
        if titles and titles.isdisjoint(planned[at].task.title for at in own):
            return None
        limits, places = load_limits(self.vocabulary), effect.moving()
        for call in (step.call for step in self.template.steps):
            if call.label and call.label not in self.labels:
                continue
            given = self.given(call)
            if given.get("scope", "mission") != "mission" and not alone:
                return None
            if call.name in limits:
                fits = effect.limit(self.vocabulary, call.name, given, own)
            else:
                fits = self._demand(effect, call.name, given, covered)
            if not (fits and places):
                return None
        for text in self.remarks()[0]:
            effect.constraints.append(text)
            effect.add(places, text)
        return effect

    def _demand(self, effect: Effect, name: str, given: dict[str, Any], covered: set[int]) -> bool:
        """Add a demand; whether it fits a task."""
        titles, scope = self.template.tasks, given.pop("scope", "mission")
        places = []
        for place in effect.moving():
            item, own = effect.planned[place], place in covered
            transit, home = item.task.title == self.vocabulary.transit, item.intent.home
            able = name in item.task.skills.get("perception", ())
            fits = {"mission": able, "home": home, "way": own and transit and not home}
            fits["task"] = own and not item.inserted and (able or transit)
            if fits[scope] and (not titles or item.task.title in titles):
                places.append(place)
        effect.about.add(name)
        effect.add(places, *demanded(name, given, self.sampler))
        return bool(places)


def demanded(name: str, given: dict[str, Any], sampler: MissionSampler) -> tuple[str, Beside]:
    """The sentence of a task prompt that asks for a skill, and the skill with its parameters."""
    skill, where = sampler.vocabulary.skill[name], given.pop("where", "")
    text = given.pop("say", "") or sampler.config["demand"][name]
    for parameter in skill.parameters:
        value = given.get(parameter.name)
        if parameter.type == "texts" and isinstance(value, str):
            given[parameter.name] = [value]
        text = text.replace(f"{{{parameter.name}}}", str(value))
    return f"{text} {where}".rstrip() + ".", (skill.role, name, given)


@functools.cache
def bind_clause(template: Template, sampler: MissionSampler) -> Bound:
    """The clause for this vehicle. Raises TemplateError."""
    vocabulary, used = sampler.vocabulary, set[str]()
    demands: dict[str, str] = sampler.config.get("demand", {})
    names = load_limits(vocabulary).keys() | (demands.keys() & vocabulary.skill)
    for call in (step.call for step in template.steps):
        if call.name not in names:
            raise TemplateError(f"{call.name} is no kind of limit and no skill with a [demand]")
        for argument in call.arguments:
            value = str(argument.value)
            if argument.name == "scope" and value not in SCOPES:
                raise TemplateError(f"scope={value}: must be {', '.join(SCOPES)}")
            if argument.kind == "slot" and argument.name != "scope":
                used.add(value)
    for title in template.tasks:
        if title not in vocabulary.task:
            raise TemplateError(f"there is no task {title}")
    every = all_slots(template.nodes)
    owners = {s.key: (LIMIT, LIMIT.by_name[s.base]) for s in every if s.base in LIMIT.by_name}
    return bound(template, sampler.words, used, owners, [])
