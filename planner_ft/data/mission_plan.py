"""The plan of a mission command: intents become tasks by the labelling rules, with their texts.

The rules (searches, transits, positions) read the vocabulary's fields, the texts come from
NAME.missions.toml; so both hold for any vehicle.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from random import Random
from typing import TYPE_CHECKING, Any

from planner_ft.data.targets import Target
from planner_ft.data.task.phrasebook import spaced
from planner_ft.data.templates.grammar import Slot, choose, fail, parse_text
from planner_ft.facts.geometry import tidy
from planner_ft.facts.units import named
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Task, Vocabulary
from planner_ft.vocabulary.definition import MISSIONS
from planner_ft.vocabulary.limits import load_limits, prompt_sentence, sentence, slots, written
from planner_ft.vocabulary.plans import TASK_KEYS

if TYPE_CHECKING:
    from planner_ft.data.drawing import Drawing
    from planner_ft.data.missions import MissionSampler


@dataclass(frozen=True)
class Intent:
    """One thing to do: a task with its target and stated parameters; `home` is a return, `part` the
    part of the target that no parameter holds.
    """

    task: Task
    target: Target | None = None
    parameters: Mapping[str, Any] = field(default_factory=dict)
    home: bool = False
    part: str = ""


@dataclass(frozen=True)
class Planned:
    """A task of the plan; `inserted` when the command does not ask for it by name."""

    task: Task
    parameters: dict[str, Any]
    intent: Intent
    inserted: bool = False


def label(intents: Iterable[Intent], vocabulary: Vocabulary) -> list[Planned]:
    """The tasks for intents in the order of execution, by the labelling rules: a search before the
    first use of what has no position, a transit to where a task is performed. Raises PlannerError.
    """
    intents = list(intents)
    locate, transit = vocabulary.task[vocabulary.locate], vocabulary.task[vocabulary.transit]
    described = next((item.name for item in locate.parameters if item.type == "text"), None)
    if described is None:
        needs = "says what is searched for and needs a parameter of type text"
        raise PlannerError(f"task {locate.title}: [vehicle] locate {needs}")
    there = str(transit.position_parameter)
    plan: list[Planned] = []
    located: set[str] = set()
    on_site = (intent.target for intent in intents if intent.target and intent.target.on_site)
    here = next((target.key for target in on_site), None)

    def place(target: Target) -> list[Any]:
        if target.position is None or target.key in located:
            return list(vocabulary.unresolved)
        return [tidy(target.position[0]), tidy(target.position[1])]

    for intent in intents:
        task, target = intent.task, intent.target
        if intent.home:
            plan.append(Planned(transit, {there: list(vocabulary.home)}, intent))
            here = None
            continue
        asked = task.title == locate.title
        if target is not None and task.arrival != "none":
            if target.key not in located and (target.must_be_found or asked):
                search: dict[str, Any] = {described: target.description}
                plan.append(Planned(locate, search, intent, inserted=not asked))
                located.add(target.key)
                here = None
            if task.arrival == "transit" and here != target.key:
                plan.append(Planned(transit, {there: place(target)}, intent, inserted=True))
        if asked:
            continue
        parameters: dict[str, Any] = {}
        if target is not None and target.identity is not None:
            parameters = {one.name: target.identity for one in task.parameters if one.type == "id"}
        own = task.position_parameter
        if own and target is not None and (target.identity is None or target.position):
            parameters[own] = place(target)
        plan.append(Planned(task, parameters | dict(intent.parameters), intent))
        if task.arrival != "none":
            leaves = task.leaves and own is not None
            here = None if leaves else target.key if target is not None else here
        elif task.pattern != "hold":
            here = None
    return plan


# ---------------------------------------------------------------- limits and demands


Beside = tuple[str, str, dict[str, Any]]
"""A skill that runs in the steps of a task: role, name and parameters."""


@dataclass
class Effect:
    """What limits and demands add to the `planned` tasks: constraints, and by the task's place a
    sentence of its prompt with the skill that it stands for. `about`: the kinds of limits and the
    skills in it.
    """

    sampler: MissionSampler
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

    def limit(self, kind: str, given: dict[str, Any], own: Sequence[int] = ()) -> bool:
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
        limits = load_limits(self.sampler.vocabulary)
        rule = limits[kind]
        if not any(set(slots(form)) <= given.keys() for form in rule.sentences):
            fail(f"{kind} needs {' and '.join(slots(rule.sentences[-1]))}")
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

    def demand(self, name: str, given: dict[str, Any], places: Sequence[int]) -> bool:
        """Add a demand for data to the tasks at these places; whether there are any."""
        skill, where = self.sampler.vocabulary.skill[name], given.pop("where", "")
        text = given.pop("say", "") or self.sampler.config["demand"][name]
        for parameter in skill.parameters:
            value = given.get(parameter.name)
            if parameter.type == "texts" and isinstance(value, str):
                given[parameter.name] = [value]
            text = text.replace(f"{{{parameter.name}}}", str(value))
        self.about.add(name)
        self.add(places, f"{text} {where}".rstrip() + ".", (skill.role, name, given))
        return bool(places)


def effect_of(
    clause: Drawing, planned: Sequence[Planned], covered: set[int], *, alone: bool
) -> Effect | None:
    """What a clause adds to a plan of which it covers the tasks at these places; None where it does
    not fit. `alone`: these tasks are one thing that was asked for.
    """
    effect, titles = Effect(clause.sampler, planned), clause.template.tasks
    asked = [at for at in sorted(covered) if not planned[at].inserted]
    own = [at for at in asked if not planned[at].intent.home]
    if titles and not any(planned[at].task.title in titles for at in own):
        return None
    limits, moving = load_limits(clause.vocabulary), effect.moving()
    for call in filter(clause.is_chosen, clause.bound.limits):
        given = clause.given(call)
        if given.get("scope", "mission") != "mission" and not alone:
            return None
        if call.name in limits:
            fits = effect.limit(call.name, given, own)
        else:
            scope = given.pop("scope", "mission")
            places = [
                at for at in moving if _suits(clause, planned[at], call.name, scope, at in covered)
            ]
            fits = effect.demand(call.name, given, places)
        if not (fits and moving):
            return None
    for text in clause.remarks()[0]:
        effect.constraints.append(text)
        effect.add(moving, text)
    return effect


def _suits(clause: Drawing, planned: Planned, skill: str, scope: str, covered: bool) -> bool:
    """Whether a demand of this scope belongs to a task; `covered` by the clause or not."""
    task, home, titles = planned.task, planned.intent.home, clause.template.tasks
    able = skill in task.skills.get("perception", ())
    transit = task.title == clause.vocabulary.transit
    fits = {"mission": able, "home": home, "way": covered and transit and not home}
    fits["task"] = covered and not planned.inserted and (able or transit)
    return fits[scope] and (not titles or task.title in titles)


# ---------------------------------------------------------------- texts


_parsed = functools.lru_cache(maxsize=1024)(parse_text)
_MEASURED = re.compile(r"\{(\w+)\}[ -]?(?!in\b|a\b)([^\s\\{}\[\]().,;|]+)")
"""A slot and the word behind it, which may be a unit."""


def say(sources: Iterable[str], given: Mapping[str, str]) -> str | None:
    """The first sentence whose slots are all given; None without one."""
    for nodes in map(_parsed, sources):
        if all(node.key in given for node in nodes if isinstance(node, Slot)):
            parts = choose(nodes, Random(0), [], frozenset(given))
            return "".join(part if isinstance(part, str) else given[part.key] for part in parts)
    return None


def _prompt_problems(vocabulary: Vocabulary, config: Mapping[str, Any]) -> Iterator[str]:
    """Values that a task prompt says in another unit than the parameter's."""
    for task in vocabulary.tasks:
        prompts = config.get("task", {}).get(task.title, {}).get("prompt", ())
        for name, word in _MEASURED.findall(" ".join(prompts)):
            unit = task.by_name[name].unit if name in task.by_name else None
            own, said = named(unit), named(word)
            if own and said and own.base == said.base and own != said:
                yield f"[task.{task.title}] prompt: {name} is in {unit}, not {word}; correct it"


class PlanTexts:
    """Task prompts, assumptions and constraints of a vehicle's plans. Raises PlannerError where a
    prompt says a value in another unit than the parameter's.
    """

    def __init__(self, vocabulary: Vocabulary, config: Mapping[str, Any]) -> None:
        self.vocabulary, self.config = vocabulary, config
        self.tasks: Mapping[str, Any] = config.get("task", {})
        if problem := next(_prompt_problems(vocabulary, config), None):
            raise PlannerError(f"{vocabulary.name}{MISSIONS}: {problem}")

    def plan(self, plan: list[Planned], notes: list[str], taken: list[str]) -> dict[str, Any]:
        """The plan as a record holds it, with the command's own remarks."""
        values = ((one.task.title, one.parameters, self.task_prompt(one)) for one in plan)
        return {
            "tasks": [dict(zip(TASK_KEYS, of_task, strict=True)) for of_task in values],
            "assumptions": list(dict.fromkeys([*self._assumptions(plan), *taken])),
            "constraints": list(dict.fromkeys([*self._constraints(plan), *notes])),
        }

    def excluded(self, title: str) -> str:
        """The constraint where a command rules a task, or the return home, out."""
        entry = self.config.get("home", {}) if title == "Home" else self.tasks.get(title, {})
        return str(entry.get("excluded", f"{spaced(title).capitalize()} is not done."))

    def task_prompt(self, planned: Planned) -> str:
        """The intent of one task in one sentence; without one of its own it says the values."""
        if planned.intent.home:
            sources = self.config.get("home", {}).get("prompt", ["Return home."])
        else:
            sources = self.tasks.get(planned.task.title, {}).get("prompt", [])
        text = say(sources, self._given(planned))
        if text is not None:
            return text
        given = {} if sources else self._given(planned)
        said = [f"{spaced(name)} {given[name]}, " for name in planned.parameters if name in given]
        place = planned.intent.target.place if planned.intent.target else "where the vehicle is"
        return f"{spaced(planned.task.title).capitalize()}: {''.join(said)}{place}."

    def _given(self, planned: Planned) -> dict[str, str]:
        """What a sentence can say of a task."""
        task, target, part = planned.task, planned.intent.target, planned.intent.part
        given = {"at": "where the vehicle is", "of": "where the vehicle is"}
        if thing := self.tasks.get(task.title, {}).get("thing"):
            given["name"] = thing
        if target is not None:
            if target.description is not None or not thing:
                given["name"] = target.name
            given |= {"place": target.place, "at": f"at {target.place}"}
            given["thing"] = f"the {part} of {target.place}" if part else target.place
            given["of"] = f"{'of' if target.description else 'at'} {target.name}"
            if part:
                given["of"] = f"of the {part} of {target.name}"
            around = f"around {written(target.position)}" if target.position is not None else ""
            if around or target.whereabouts:
                given["whereabouts"] = around or target.whereabouts
        for name, value in planned.parameters.items():
            kind = task.by_name[name].type
            if kind == "position":
                unknown = value == list(self.vocabulary.unresolved)
                given["position"] = "where it has been found" if unknown else written(value)
                given |= {"found": "once it has been found"} if unknown else {}
            elif kind == "texts":
                given[name] = ", then ".join(f"the {item}" for item in value)
            else:
                given[name] = str(value)
            if kind == "text" and not planned.inserted:
                same = target is not None and value == target.description
                given["feature"] = given["name"] if same else f"the {value} {given['of']}"
                given |= {} if same else {"part": str(value)}
        return given

    def _assumptions(self, plan: list[Planned]) -> Iterator[str]:
        """What the plan takes for granted: targets to be found, doubtful positions, docks, home."""
        for planned in plan:
            target = planned.intent.target
            if planned.intent.home:
                yield f"Home is {written(self.vocabulary.home)}."
            if target is None:
                continue
            if planned.task.title == self.vocabulary.locate and target.position is None:
                yield f"The position of {target.name} is unknown until it has been found."
            if target.doubtful and target.position is not None:
                yield f"{written(target.position)} is taken as correct."
            if target.on_site:
                yield f"The vehicle lies at {target.name}."
            if target.spot and target.position is None:
                yield f"The position of {target.name} is filled in before docking."

    def _constraints(self, plan: list[Planned]) -> Iterator[str]:
        """Which targets must be found before what is done with them."""
        for index, planned in enumerate(plan):
            target = planned.intent.target
            if planned.task.title != self.vocabulary.locate or target is None:
                continue
            uses = (later for later in plan[index + 1 :] if later.intent.target == target)
            use = next((later for later in uses if not later.inserted), None)
            if use is not None:
                title = use.task.title
                before = self.tasks.get(title, {}).get("before", [f"{spaced(title)} begins"])
                name = target.name[0].upper() + target.name[1:]
                yield f"{name} must be found before {say(before, self._given(use))}."
