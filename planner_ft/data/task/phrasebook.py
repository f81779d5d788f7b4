"""The phrases of a vocabulary by skill and by task.

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
from planner_ft.data.task.phrase import FORMS, Given, Phrase, mark, parse_phrase, parse_phrases
from planner_ft.data.task.values import Draw, number_space, value_space
from planner_ft.data.templates.grammar import all_slots
from planner_ft.data.wordlists import FALLBACK, MADE_UP, WordLists
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary.definition import Parameter, Skill, Task, Vocabulary

KINDS = ("phrases", "with", "passive")
SETTINGS = {"values", "links", "often", "stated", "phrases_for", "lead_skill", "openers"}
"""Keys of the phrase file that hold no phrases."""


def spaced(name: str) -> str:
    """A name as words: "RotateToHeading" -> "rotate to heading", "target_id" -> "target id"."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])|_", " ", name).lower()


class Slots(dict[str, str]):
    """Wordings by slot. A slot that begins with an underscore is no value of the plan: the task
    parameter of that name, if the task has it, else a number of [decor] or an entry of a word list.
    """

    def __init__(
        self, book: Phrasebook, rng: random.Random, task_values: Mapping[str, Value] | None = None
    ) -> None:
        super().__init__()
        self._book, self._rng, self._task_values = book, rng, task_values or {}

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
        self[name] = mark(value.text)
        wordings = (value.text, value.short, value.noun, value.way)
        for form, wording in zip(FORMS.values(), wordings, strict=True):
            if wording is not None:
                self[f"{name} {form}"] = mark(wording)
        return value.value


@dataclass
class Saying:
    """Phrases, any of which says the same thing with these slots."""

    phrases: Sequence[Phrase]
    slots: Slots
    suffix: str = ""

    def render(self, rng: random.Random, *, ing: bool = False) -> str:
        """One wording."""
        return pick(self.phrases, rng).render(self.slots, rng, ing=ing) + self.suffix


class SkillEntry:
    """The phrases and parameter spaces of one skill."""

    def __init__(
        self, skill: Skill, config: dict[str, Any], lexicon: WordLists, *, unseen: bool
    ) -> None:
        self.skill = skill
        spaces, often = config.get("values", {}), config.get("often", {})
        self.values: dict[str, dict[str, Any]] = {
            name: spaces.get(name, {}) for name in skill.by_name
        }
        self.draws = _draws(skill, self.values, lexicon)
        self.often = {
            item.name: 1.0 if item.required else float(often.get(item.name, 0.5))
            for item in skill.parameters
        }
        self._layers = {kind: [parse_phrases(config.get(kind, ()))] for kind in KINDS}
        self.generic = [parse_phrase(_generic_phrase(skill))]
        self._layers["phrases"].append(self.generic)
        if unseen:
            self._layers["phrases"].insert(0, parse_phrases(config.get("unseen", ())))
            self._layers["passive"] = []
        self.none: list[str] = config.get("none", [])
        self.several = bool(config.get("several", True))
        self.repeats = bool(config.get("repeats"))
        self._fitting: dict[tuple[Given, str], list[Phrase]] = {}

    def fitting(self, given: Given, kind: str = "phrases") -> list[Phrase]:
        """Phrases that say exactly `given`; of the kind "phrases" there always are some."""
        if (given, kind) not in self._fitting:
            layers = ([one for one in layer if one.fits(given)] for layer in self._layers[kind])
            self._fitting[given, kind] = next(filter(None, layers), [])
        return self._fitting[given, kind]


class TaskEntry:
    """The phrases, links and parameter spaces of one task."""

    def __init__(self, task: Task, book: Phrasebook) -> None:
        config = book.raw.get("task", {}).get(task.title, {})
        refer = config.get("refer", {})
        self.draws = _draws(task, config.get("values", {}), book.lexicon)
        self.refer = {
            name: parse_phrases(refer.get(name, [f"the given {spaced(name)}"]))
            for name in task.by_name
        }
        self.links: dict[str, str] = {}
        """The task parameter that fills a place: "StationKeep.time", "square.center"."""
        for parameter in task.parameters:
            own = config.get("links", {}).get(parameter.name)
            for place in own or _default_links(task, parameter, book.vocabulary):
                self.links.setdefault(place, parameter.name)
        lead = (config.get("lead_unseen") if book.unseen else None) or config.get("lead", ())
        self.lead = parse_phrases(lead)
        self.lead_skill: dict[str, str] = config.get("lead_skill", {})
        self.stated = frozenset(config.get("stated", ()))
        self.phrases = [] if book.unseen else parse_phrases(config.get("phrases", ()))
        self.phrases_for: str | None = config.get("phrases_for")
        self.openers: list[str] = config.get("openers", [])
        self.unresolved = parse_phrases(config.get("unresolved", ()))
        self.patterns: dict[str, list[str]] = config.get("pattern_phrases", {})


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
        self.verbs = {"run", *re.findall(r"~([A-Za-z-]+)", compact_json(self.raw))}
        self._patterns: dict[tuple[str, str, str, Given], list[Phrase]] = {}

    def say(self, source: str, rng: random.Random) -> str:
        """A wording of a phrase without values."""
        return parse_phrase(source).render(Slots(self, rng), rng)

    def pattern(self, name: str, title: str, given: Given, key: str = "phrases") -> list[Phrase]:
        """Phrases of a movement of several steps that say exactly `given`: the task's own ones,
        twice as often, and the general ones.
        """
        place = (name, title, key, given)
        if place not in self._patterns:
            general = self.raw.get("pattern", {}).get(name, {})
            texts = general.get(key, [])
            if self.unseen and key == "phrases" and general.get("unseen"):
                texts = general["unseen"]
            elif key == "phrases":
                texts = [*self.tasks[title].patterns.get(name, []) * 2, *texts]
            self._patterns[place] = [one for one in parse_phrases(texts) if one.fits(given)]
        return self._patterns[place]


@functools.lru_cache(maxsize=8)
def phrasebook(vocabulary: Vocabulary, *, unseen: bool) -> Phrasebook:
    """The vocabulary's phrases, parsed once."""
    return Phrasebook(vocabulary, unseen=unseen)


def _draws(
    owner: Skill | Task, spaces: Mapping[str, dict[str, Any]], lexicon: WordLists
) -> dict[str, Draw]:
    return {
        item.name: value_space(item, spaces.get(item.name, {}), lexicon)
        for item in owner.parameters
    }


def _generic_phrase(skill: Skill) -> str:
    names = [parameter.name for parameter in skill.parameters]
    if "x" in names and "y" in names:
        names = ["xy", *(name for name in names if name not in ("x", "y"))]
    parts = (f"[ with {'position' if name == 'xy' else spaced(name)} {{{name}}}]" for name in names)
    return f"~run {spaced(skill.name)}{''.join(parts)}"


def _check_phrases(vocabulary: Vocabulary) -> None:
    raw, where = vocabulary.phrases, f"vocabulary {vocabulary.source}: phrase"
    known = {*raw.get("words", {}), *raw.get("decor", {}), *FALLBACK, *MADE_UP, "step"}
    known.update(name for task in vocabulary.tasks for name in task.by_name)
    for section in ("skill", "task", "pattern", "sentence"):
        for phrase in _texts(raw.get(section, {})):
            try:
                slots = all_slots(parse_phrase(phrase.replace("{}", "")).nodes)
            except ValueError as error:
                raise PlannerError(f"{where} file, [{section}]: {phrase!r}: {error}") from None
            for name in (slot.key for slot in slots if slot.sign and slot.key not in known):
                raise PlannerError(
                    f"{where} {phrase!r} names the word list {name!r}; add it to [words] or [decor]"
                )


def _texts(value: Any) -> Iterator[str]:
    """All phrases in a section of the phrase file."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, list):
        for item in value:
            yield from _texts(item)
    elif isinstance(value, dict):
        for key, item in value.items():
            if key not in SETTINGS:
                yield from _texts(item)


def _default_links(task: Task, parameter: Parameter, vocabulary: Vocabulary) -> Iterator[str]:
    """The skill parameters that a task parameter fills where the phrase file does not say it."""
    for name in (entry for names in task.skills.values() for entry in names):
        skill = vocabulary.skill[name]
        if parameter.type == "position" and skill.motion == "goto":
            yield f"{name}.xy"
        elif (same := skill.by_name.get(parameter.name)) and same.type == parameter.type:
            yield f"{name}.{parameter.name}"
