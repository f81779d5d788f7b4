"""The phrases of a vocabulary, compiled, by skill and by task.

A definition without phrases still works: each skill falls back on a phrase made from its name and
parameter names.
"""

from __future__ import annotations

import functools
import random
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.data.numbers import Value, pick
from planner_ft.data.task.template import Form, Template, compile_template, mark
from planner_ft.data.task.values import Draw, number_space, value_space
from planner_ft.data.wordlists import FALLBACK, MADE_UP, WordLists
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.definition import ROLES, Parameter, Role, Skill, Task, Vocabulary

Given = frozenset[str]
SETTINGS = {"values", "links", "often", "stated", "phrases_for", "lead_skill", "openers"}
"""Keys of the phrase file that hold no phrases of the phrase language."""


def spaced(name: str) -> str:
    """A name as words: "RotateToHeading" -> "rotate to heading", "target_id" -> "target id"."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])|_", " ", name).lower()


class Slots(dict[str, str]):
    """Wordings by slot. A slot that begins with an underscore is said for the context's sake and is
    no value of the plan: the task parameter of that name, if the task has it, else a number of
    [decor] or an entry of a word list.
    """

    def __init__(
        self, book: Phrasebook, rng: random.Random, task_values: Mapping[str, Value] | None = None
    ) -> None:
        super().__init__()
        self._book, self._rng, self._task_values = book, rng, task_values or {}
        self.given: set[str] = set()

    def __missing__(self, key: str) -> str:
        name = key[1:]
        known = self._task_values.get(name)
        if known is not None and known.text:
            return mark(known.text)
        if name in self._book.decor:
            return mark(self._book.decor[name](self._rng).text)
        return mark(self._book.lexicon.entry(name, self._rng))

    def put(self, name: str, value: Value) -> Any:
        """Say the value's wordings in the slot, set apart as values; the value."""
        wordings = {"": value.text, "#": value.text, "!": value.short, "^": value.noun}
        for sign, wording in (*wordings.items(), ("+", value.way)):
            if wording is not None:
                self.put_words(name + sign, mark(wording))
        return value.value

    def put_words(self, name: str, text: str) -> None:
        """Say words in the slot that refer to a value without stating it."""
        self.given.add(name)
        self[name] = text


@dataclass
class Saying:
    """Phrases, any of which says the same thing with these slots."""

    templates: Sequence[Template]
    slots: Slots
    suffix: str = ""

    def render(self, rng: random.Random, form: Form = "base") -> str:
        """One wording."""
        return str(pick(self.templates, rng).render(self.slots, rng, form)) + self.suffix


@dataclass(eq=False)
class Call:
    """A skill with its parameters and how it is said; `skill` is None for words that ask for no
    skill of their own. `order` is the place of its mention in the prompt.
    """

    skill: str | None
    parameters: dict[str, Any]
    saying: Saying
    other: Mapping[str, Saying]
    """Wordings of other forms: "with" (behind that word), "nouns" (behind "log"), "passive"."""
    order: int = 0


class SkillEntry:
    """The phrases and parameter spaces of one skill."""

    def __init__(
        self, skill: Skill, config: dict[str, Any], lexicon: WordLists, *, unseen: bool
    ) -> None:
        self.skill = skill
        spaces, often = config.get("values", {}), config.get("often", {})
        self.values: dict[str, dict[str, Any]] = {
            parameter.name: spaces.get(parameter.name, {}) for parameter in skill.parameters
        }
        self.draws: dict[str, Draw] = {
            parameter.name: value_space(parameter, self.values[parameter.name], lexicon)
            for parameter in skill.parameters
        }
        self.often = {
            parameter.name: 1.0 if parameter.required else float(often.get(parameter.name, 0.5))
            for parameter in skill.parameters
        }
        fallback = compiled([_generic_phrase(skill)])
        seen = compiled(config["phrases"]) if "phrases" in config else fallback
        self._layers = {"phrases": [seen, fallback], "with": [compiled(config.get("with", []))]}
        if unseen:
            self._layers["phrases"].insert(0, compiled(config.get("unseen", [])))
        for kind in ("nouns", "passive"):
            self._layers[kind] = [] if unseen else [compiled(config.get(kind, []))]
        self.during = compiled(config.get("during", []))
        self.none: list[str] = config.get("none", [])
        self.several = bool(config.get("several", True))
        self.repeats = bool(config.get("repeats"))
        self._cache: dict[tuple[Given, str], list[Template]] = {}

    def fitting(self, given: Given, kind: str = "phrases") -> list[Template]:
        """Phrases of the kind that say exactly `given`; there always are some of the kind
        "phrases".
        """
        if (given, kind) not in self._cache:
            layers = ([one for one in layer if one.fits(given)] for layer in self._layers[kind])
            self._cache[given, kind] = next(filter(None, layers), [])
        return self._cache[given, kind]

    @property
    def bare(self) -> bool:
        """Whether a phrase names the skill without any parameter."""
        first = next(filter(None, self._layers["phrases"]))
        return any(template.fits(frozenset()) for template in first)


class TaskEntry:
    """The phrases, links and parameter spaces of one task."""

    def __init__(self, task: Task, book: Phrasebook) -> None:
        config = book.raw.get("task", {}).get(task.title, {})
        spaces, refer = config.get("values", {}), config.get("refer", {})
        self.draws: dict[str, Draw] = {
            parameter.name: value_space(parameter, spaces.get(parameter.name, {}), book.lexicon)
            for parameter in task.parameters
        }
        self.refer = {
            name: compiled(refer.get(name, [f"the given {spaced(name)}"])) for name in task.by_name
        }
        self.links: dict[str, str] = {}
        """The task parameter that fills a place: "StationKeep.time", "square.center"."""
        for parameter in task.parameters:
            own = config.get("links", {}).get(parameter.name)
            for place in own or _default_links(task, parameter, book.vocabulary):
                self.links.setdefault(place, parameter.name)
        lead = (config.get("lead_unseen") if book.unseen else None) or config.get("lead", [])
        self.lead = compiled(lead)
        self.lead_skill: dict[str, str] = config.get("lead_skill", {})
        self.stated = frozenset(config.get("stated", ()))
        self.phrases = [] if book.unseen else compiled(config.get("phrases", []))
        self.phrases_for: str | None = config.get("phrases_for")
        self.openers: list[str] = config.get("openers", [])
        self.unresolved = compiled(config.get("unresolved", []))
        self.patterns = {
            name: compiled(texts) for name, texts in config.get("pattern_phrases", {}).items()
        }


class Phrasebook:
    """Everything that the sampler says, for the training families or for the unseen ones.

    Raises PlannerError for a phrase that does not parse or names a word list that is not there.
    """

    def __init__(self, vocabulary: Vocabulary, *, unseen: bool) -> None:
        self.vocabulary, self.unseen, self.raw = vocabulary, unseen, vocabulary.phrases
        _check_phrases(vocabulary)
        self.lexicon = WordLists(self.raw.get("words", {}))
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
        self.motions: dict[str, str] = {
            skill.motion: skill.name for skill in reversed(vocabulary.skills) if skill.motion
        }
        verbs = (
            node[1][0].lower()
            for phrase in _phrases({**self.raw, "words": {}})
            for node in _flat(compile_template(phrase.replace("{}", "")).nodes)
            if node[0] == "verb"
        )
        self.verbs = frozenset(verbs)
        self.by_role: dict[Role, list[str]] = {
            role: [skill.name for skill in vocabulary.skills_in_role(role)] for role in ROLES
        }
        self._fitting: dict[tuple[str, str, str, Given], list[Template]] = {}

    def say(self, source: str, rng: random.Random) -> str:
        """A wording of a phrase without values."""
        return compile_template(source).render(Slots(self, rng), rng)

    def pattern(self, name: str, title: str, given: Given, key: str = "phrases") -> list[Template]:
        """Phrases of a movement of several steps that say exactly `given`: the task's own ones,
        twice as often, and the general ones.
        """
        place = (name, title, key, given)
        if place not in self._fitting:
            general = self.raw.get("pattern", {}).get(name, {})
            texts = general.get(key, [])
            own = self.tasks[title].patterns.get(name, []) if key == "phrases" else []
            if self.unseen and key == "phrases" and general.get("unseen"):
                texts, own = general["unseen"], []
            known = [*own, *own, *compiled(texts)]
            self._fitting[place] = [template for template in known if template.fits(given)]
        return self._fitting[place]


@functools.lru_cache(maxsize=8)
def phrasebook(vocabulary: Vocabulary, *, unseen: bool) -> Phrasebook:
    """The vocabulary's phrases, compiled once."""
    return Phrasebook(vocabulary, unseen=unseen)


def compiled(texts: Sequence[str]) -> list[Template]:
    """The phrases, parsed."""
    return [compile_template(text) for text in texts]


def _generic_phrase(skill: Skill) -> str:
    names = [parameter.name for parameter in skill.parameters]
    if "x" in names and "y" in names:
        names = ["xy", *(name for name in names if name not in ("x", "y"))]
    parts = (f"[ with {'position' if name == 'xy' else spaced(name)} {{{name}}}]" for name in names)
    return f"~run {spaced(skill.name)}{''.join(parts)}"


def _check_phrases(vocabulary: Vocabulary) -> None:
    raw = vocabulary.phrases
    known = {*raw.get("words", {}), *raw.get("decor", {}), *FALLBACK, *MADE_UP, "step"}
    known.update(name for task in vocabulary.tasks for name in task.by_name)
    for section in ("skill", "task", "pattern", "sentence"):
        for phrase in _phrases(raw.get(section, {})):
            try:
                nodes = compile_template(phrase.replace("{}", "")).nodes
            except ValueError as error:
                raise PlannerError(
                    f"vocabulary {vocabulary.source}: phrase file, [{section}]: {error}"
                ) from None
            for kind, content in _flat(nodes):
                if kind == "slot" and content[0] == "_" and content[1:] not in known:
                    raise PlannerError(
                        f"vocabulary {vocabulary.source}: phrase {phrase!r} names the word list"
                        f" {content[1:]!r}; add it to [words] or [decor]"
                    )


def _flat(nodes: Sequence[tuple[str, Any]]) -> Iterator[tuple[str, Any]]:
    """All nodes of a phrase, those of alternatives and optional parts included."""
    for kind, content in nodes:
        if kind == "choice":
            for branch in content:
                yield from _flat(branch)
        elif kind == "optional":
            yield from _flat(content[1])
        else:
            yield kind, content


def _phrases(value: Any) -> Iterator[str]:
    """All phrases in a section of the phrase file."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, list):
        for item in value:
            yield from _phrases(item)
    elif isinstance(value, dict):
        for key, item in value.items():
            if key not in SETTINGS:
                yield from _phrases(item)


def _default_links(task: Task, parameter: Parameter, vocabulary: Vocabulary) -> Iterator[str]:
    """The skill parameters that a task parameter fills where the phrase file does not say it."""
    for name in (entry for names in task.skills.values() for entry in names):
        skill = vocabulary.skill[name]
        if parameter.type == "position" and skill.motion == "goto":
            yield f"{name}.xy"
        elif (same := skill.by_name.get(parameter.name)) and same.type == parameter.type:
            yield f"{name}.{parameter.name}"
