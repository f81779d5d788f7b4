"""The plan of a mission command: intents become tasks by the labelling rules, with their texts.

The rules (searches, transits, positions) read the vocabulary's fields, the texts come from
NAME.missions.toml; so both hold for any vehicle.
"""

import functools
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from random import Random
from typing import Any

from planner_ft.data.task.phrasebook import spaced
from planner_ft.data.templates.grammar import Slot, choose, parse_text
from planner_ft.facts.geometry import Point, tidy
from planner_ft.vocabulary import Task, Vocabulary
from planner_ft.vocabulary.limits import written
from planner_ft.vocabulary.plans import TASK_KEYS


@dataclass(frozen=True)
class Target:
    """A place, structure or moving thing that a command speaks of; `key` tells those of one command
    apart.

    `description` is written as in the plan, `text` is said, both without article; `article`: texts
    put "the" before it. `identity` is the id of something to follow. `spot` marks a docking place,
    `on_site` that the vehicle lies there already.
    """

    key: str
    description: str | None = None
    position: Point | None = None
    article: bool = True
    text: str = ""
    identity: str | None = None
    spot: bool = False
    doubtful: bool = False
    whereabouts: str = ""
    on_site: bool = False
    noun: str = ""

    @property
    def must_be_found(self) -> bool:
        """Whether only a search can tell where it is."""
        known = self.position is not None or self.identity is not None
        return not (known or self.spot or self.on_site)

    @property
    def name(self) -> str:
        """The target as the plan's texts call it: "the green barrel", "[45, 10]"."""
        if self.description is None:
            return self.identity or written(self.position or (0, 0))
        return f"the {self.description}" if self.article else self.description

    @property
    def place(self) -> str:
        """The name with its place: "the met mast at [120, -35]"."""
        if self.description is None or self.position is None:
            return self.name
        return f"{self.name} at {written(self.position)}"


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
    first use of what has no position, a transit to where a task is performed.
    """
    intents = list(intents)
    locate, transit = vocabulary.task[vocabulary.locate], vocabulary.task[vocabulary.transit]
    described = next(item.name for item in locate.parameters if item.type == "text")
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


# ---------------------------------------------------------------- texts


_parsed = functools.lru_cache(maxsize=1024)(parse_text)


def say(sources: Iterable[str], given: Mapping[str, str]) -> str | None:
    """The first sentence whose slots are all given; None without one."""
    for nodes in map(_parsed, sources):
        if all(node.key in given for node in nodes if isinstance(node, Slot)):
            parts = choose(nodes, Random(0), [], frozenset(given))
            return "".join(part if isinstance(part, str) else given[part.key] for part in parts)
    return None


class PlanTexts:
    """Task prompts, assumptions and constraints of a vehicle's plans."""

    def __init__(self, vocabulary: Vocabulary, config: Mapping[str, Any]) -> None:
        self.vocabulary, self.config = vocabulary, config
        self.tasks: Mapping[str, Any] = config.get("task", {})

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
        """The intent of one task in one sentence."""
        if planned.intent.home:
            sources = self.config.get("home", {}).get("prompt", ["Return home."])
        else:
            sources = self.tasks.get(planned.task.title, {}).get("prompt", [])
        text = say(sources, self._given(planned))
        if text is not None:
            return text
        place = planned.intent.target.place if planned.intent.target else "where the vehicle is"
        return f"{spaced(planned.task.title).capitalize()}: {place}."

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
