"""The phrases of a vocabulary, compiled, and skill calls drawn from them.

A definition without phrases still works: each skill falls back on a phrase made from its name and
parameter names.
"""

from __future__ import annotations

import random
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from planner_ft.data.numbers import Value
from planner_ft.data.task.template import Form, Template, compile_template, mark
from planner_ft.data.task.values import Draw, number_space, value_space
from planner_ft.data.task.words import FALLBACK, MADE_UP, Lexicon
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.definition import ROLES, Parameter, Role, Skill, Task, Vocabulary

Given = frozenset[str]


def spaced(name: str) -> str:
    """A name as words: "RotateToHeading" -> "rotate to heading", "target_id" -> "target id"."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])|_", " ", name).lower()


class Slots(dict[str, str]):
    """What is said for each slot. A slot that begins with an underscore is said for the context's
    sake and is no value of the plan: the task parameter of that name, if the task has it, else a
    number of [decor] or an entry of a word list.
    """

    def __init__(
        self, book: Phrasebook, rng: random.Random, task_values: Mapping[str, Value] | None = None
    ) -> None:
        super().__init__()
        self._book, self._rng, self._task_values = book, rng, task_values or {}
        self.given: set[str] = set()

    def __missing__(self, key: str) -> str:
        name = key[1:]
        if name in self._task_values:
            return mark(self._task_values[name].text)
        if name in self._book.decor:
            return mark(self._book.decor[name](self._rng).text)
        return mark(self._book.lexicon.entry(name, self._rng))

    def put(self, name: str, value: Value) -> None:
        """Say the value's wordings in the slot, set apart as values."""
        self.given.add(name)
        self[name] = mark(value.text)
        for sign, wording in (
            ("#", value.text),
            ("!", value.short),
            ("^", value.noun),
            ("+", value.way),
        ):
            if wording is not None:
                self.given.add(name + sign)
                self[name + sign] = mark(wording)

    def put_words(self, name: str, text: str) -> None:
        """Say words in the slot that refer to a value without stating it."""
        self.given.add(name)
        self[name] = text


@dataclass
class Saying:
    """Phrases, any of which says the same thing with these slots."""

    templates: Sequence[Template]
    slots: Slots
    prefix: str = ""
    suffix: str = ""

    def render(self, rng: random.Random, form: Form = "base") -> str:
        """One wording."""
        return (
            self.prefix
            + self.templates[int(rng.random() * len(self.templates))].render(self.slots, rng, form)
            + self.suffix
        )


@dataclass
class Call:
    """A skill with its parameters and how it is said; `skill` is None for words that ask for no
    skill of their own.
    """

    skill: str | None
    parameters: dict[str, Any]
    saying: Saying
    with_saying: Saying | None = None
    noun_saying: Saying | None = None
    passive_saying: Saying | None = None
    order: int = field(default=0)


class SkillEntry:
    """The phrases and parameter spaces of one skill."""

    def __init__(
        self, skill: Skill, config: dict[str, Any], lexicon: Lexicon, *, unseen: bool
    ) -> None:
        self.skill = skill
        spaces = config.get("values", {})
        self.draws: dict[str, Draw] = {
            parameter.name: value_space(parameter, spaces.get(parameter.name, {}), lexicon)
            for parameter in skill.parameters
        }
        often = config.get("often", {})
        self.often = {
            parameter.name: 1.0 if parameter.required else float(often.get(parameter.name, 0.5))
            for parameter in skill.parameters
        }
        fallback = [_generic_phrase(skill)]
        seen = [compile_template(text) for text in config.get("phrases", fallback)]
        new = [compile_template(text) for text in config.get("unseen", [])] if unseen else []
        self._layers = [
            layer for layer in (new, seen, [compile_template(text) for text in fallback]) if layer
        ]
        self._with = [compile_template(text) for text in config.get("with", [])]
        self._nouns = [] if unseen else [compile_template(text) for text in config.get("nouns", [])]
        self._passive = (
            [] if unseen else [compile_template(text) for text in config.get("passive", [])]
        )
        self.during = [compile_template(text) for text in config.get("during", [])]
        self.none: list[str] = config.get("none", [])
        self.several = bool(config.get("several", True))
        self.repeats = bool(config.get("repeats"))
        self._cache: dict[tuple[Given, str], list[Template]] = {}

    def fitting(self, given: Given) -> list[Template]:
        """Phrases that say exactly `given`; never empty."""
        return self._fitting(given, "phrases", self._layers)

    @property
    def bare(self) -> bool:
        """Whether a phrase names the skill without any parameter."""
        return any(template.fits(frozenset()) for template in self._layers[0])

    def after_with(self, given: Given) -> list[Template]:
        """What stands after "with"; empty if nothing says exactly `given`."""
        return self._fitting(given, "with", [self._with])

    def nouns(self, given: Given) -> list[Template]:
        """What stands after "log"; empty if nothing says exactly `given`."""
        return self._fitting(given, "nouns", [self._nouns])

    def passive(self, given: Given) -> list[Template]:
        """Clauses that say that the skill runs; empty if nothing says exactly `given`."""
        return self._fitting(given, "passive", [self._passive])

    def _fitting(self, given: Given, kind: str, layers: list[list[Template]]) -> list[Template]:
        key = (given, kind)
        if key not in self._cache:
            found: list[Template] = next(
                (fits for layer in layers if (fits := [t for t in layer if t.fits(given)])), []
            )
            self._cache[key] = found
        return self._cache[key]


def _generic_phrase(skill: Skill) -> str:
    names = [parameter.name for parameter in skill.parameters]
    if "x" in names and "y" in names:
        names = ["xy", *(name for name in names if name not in ("x", "y"))]
    return f"~run {spaced(skill.name)}" + "".join(
        f"[ with {'position' if name == 'xy' else spaced(name)} {{{name}}}]" for name in names
    )


class Phrasebook:
    """Everything that the sampler says, for the training families or for the unseen ones."""

    def __init__(self, vocabulary: Vocabulary, *, unseen: bool) -> None:
        self.vocabulary, self.unseen = vocabulary, unseen
        self.raw = vocabulary.phrases
        _check_phrases(vocabulary)
        self.lexicon = Lexicon(self.raw.get("words", {}))
        configs = self.raw.get("skill", {})
        self.skills = {
            skill.name: SkillEntry(skill, configs.get(skill.name, {}), self.lexicon, unseen=unseen)
            for skill in vocabulary.skills
        }
        self.tasks = {task.title: TaskEntry(task, self) for task in vocabulary.tasks}
        self.decor = {
            name: number_space(Parameter(name, "number", config.get("unit")), config)
            for name, config in self.raw.get("decor", {}).items()
        }
        self.sentences: dict[str, list[str]] = self.raw.get("sentence", {})
        self.motions: dict[str, str] = {}
        for skill in vocabulary.skills:
            if skill.motion:
                self.motions.setdefault(skill.motion, skill.name)
        self.verbs = _verbs(self.raw)
        self.by_role: dict[Role, list[str]] = {
            role: [skill.name for skill in vocabulary.skills_in_role(role)] for role in ROLES
        }

    def slots(self, rng: random.Random) -> Slots:
        """Empty slots that know this vocabulary's words."""
        return Slots(self, rng)

    def say(self, source: str, rng: random.Random) -> str:
        """A wording of a phrase without values."""
        return compile_template(source).render(self.slots(rng), rng)

    def pattern(self, name: str, title: str, key: str = "phrases") -> list[Template]:
        """Phrases of a movement of several steps: the task's own ones and the general ones."""
        general = self.raw.get("pattern", {}).get(name, {})
        if self.unseen and key == "phrases" and general.get("unseen"):
            return [compile_template(text) for text in general["unseen"]]
        own = (
            self.raw.get("task", {}).get(title, {}).get("pattern_phrases", {}).get(name, [])
            if key == "phrases"
            else []
        )
        return [compile_template(text) for text in (*own, *own, *general.get(key, []))]


class TaskEntry:
    """The phrases, links and parameter spaces of one task."""

    def __init__(self, task: Task, book: Phrasebook) -> None:
        self.task = task
        config = book.raw.get("task", {}).get(task.title, {})
        spaces = config.get("values", {})
        self.draws: dict[str, Draw] = {
            parameter.name: value_space(parameter, spaces.get(parameter.name, {}), book.lexicon)
            for parameter in task.parameters
        }
        self.refer = {
            parameter.name: [
                compile_template(text)
                for text in config.get("refer", {}).get(
                    parameter.name, [f"the given {spaced(parameter.name)}"]
                )
            ]
            for parameter in task.parameters
        }
        self.links: dict[str, str] = {}
        for parameter in task.parameters:
            for place in config.get("links", {}).get(parameter.name) or _default_links(
                task, parameter.name, book.vocabulary
            ):
                self.links.setdefault(place, parameter.name)
        lead_key = "lead_unseen" if book.unseen and config.get("lead_unseen") else "lead"
        self.lead = [compile_template(text) for text in config.get(lead_key, [])]
        self.stated = frozenset(config.get("stated", ()))
        self.lead_skill: dict[str, str] = config.get("lead_skill", {})
        self.phrases = (
            [] if book.unseen else [compile_template(text) for text in config.get("phrases", [])]
        )
        self.phrases_for: str | None = config.get("phrases_for")
        self.openers: list[str] = config.get("openers", [])
        self.unresolved = [compile_template(text) for text in config.get("unresolved", [])]
        self.goto_phrases = [
            compile_template(text) for text in config.get("pattern_phrases", {}).get("goto", [])
        ]


def _check_phrases(vocabulary: Vocabulary) -> None:
    """Raise PlannerError for a phrase that does not parse or names a word list that is not
    there.
    """
    raw = vocabulary.phrases
    known = {
        *raw.get("words", {}),
        *raw.get("decor", {}),
        *FALLBACK,
        *MADE_UP,
        *(name for task in vocabulary.tasks for name in task.by_name),
        "step",
    }
    for section in ("skill", "task", "pattern", "sentence"):
        for phrase in _phrases(raw.get(section, {})):
            try:
                compile_template(phrase.replace("{}", ""))
            except ValueError as error:
                raise PlannerError(
                    f"vocabulary {vocabulary.source}: phrase file, [{section}]: {error}"
                ) from None
            for name in re.findall(r"\{_([a-z_]+)\}", phrase):
                if name not in known:
                    raise PlannerError(
                        f"vocabulary {vocabulary.source}: phrase {phrase!r} names the word list"
                        f" {name!r}; add it to [words] or [decor]"
                    )


def _phrases(value: Any) -> Iterator[str]:
    """All phrases in a section of the phrase file; settings of values, links and the like are
    passed over.
    """
    if isinstance(value, str):
        yield value
    elif isinstance(value, list):
        for item in value:
            yield from _phrases(item)
    elif isinstance(value, dict):
        for key, item in value.items():
            if key not in (
                "values",
                "links",
                "often",
                "stated",
                "phrases_for",
                "lead_skill",
                "openers",
            ):
                yield from _phrases(item)


def _verbs(phrases: Any) -> set[str]:
    """The base forms of all verbs of the phrase file, by which a command is told from other
    openings of a sentence.
    """
    if isinstance(phrases, str):
        return set(re.findall(r"~([A-Za-z-]+)", phrases))
    values = (
        phrases.values()
        if isinstance(phrases, dict)
        else phrases
        if isinstance(phrases, list)
        else ()
    )
    return set().union(*(_verbs(value) for value in values)) if values else set()


def _default_links(task: Task, name: str, vocabulary: Vocabulary) -> list[str]:
    parameter = task.by_name[name]
    places = []
    for skill_name in (entry for names in task.skills.values() for entry in names):
        skill = vocabulary.skill[skill_name]
        if parameter.type == "position" and skill.motion == "goto":
            places.append(f"{skill_name}.xy")
        elif name in skill.by_name and skill.by_name[name].type == parameter.type:
            places.append(f"{skill_name}.{name}")
    return places
