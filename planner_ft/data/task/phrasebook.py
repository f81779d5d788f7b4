"""The phrases of NAME.phrases.toml by skill and by task, in the grammar of the templates.

(~hold|~keep) (position|station)[ within {radius}][ for {time}]

~verb    inflected: base form in commands, -ing form after "while"
{slot}   a value as it is stated or referred to ("the planned time"); with a mark, only a value
         that is stated: {slot#} in full, {slot!} short, {slot^} as a noun, {slot+} as a
         direction (see numbers.Value)
{_list}  an entry of a word list, or a value of the task, that is no value of the plan

A definition without phrases still works: each skill falls back on a phrase made from its name and
parameter names.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator, Sequence
from random import Random
from typing import Any

from planner_ft.data.numbers import Draw, Value
from planner_ft.data.templates.grammar import Nodes, TemplateError, all_slots, parse_text
from planner_ft.data.values import (
    ANYWHERE,
    FALLBACK,
    MADE_UP,
    Bounds,
    WordLists,
    draw_position,
    number_space,
    value_space,
)
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary.definition import PHRASES, ROLES, Parameter, Skill, Task, Vocabulary

FORMS = {"#": "full", "!": "num", "^": "noun", "+": "way"}
_FORM = re.compile(r"(?<=\w)[#!^+](?=})")
_VERB = re.compile(r"~([A-Za-z-]+)")
_GERUND = {"be": "being", "lie": "lying", "tie": "tying", "begin": "beginning"}
KINDS = ("phrases", "unseen", "with", "passive")
SETTINGS = {"values", "links", "often", "stated", "phrases_for", "lead_skill", "openers"}
"""Keys of the phrase file that hold no phrases."""


def phrase_text(phrase: str, *, ing: bool = False) -> str:
    """The phrase as the text of a template, its verbs as gerunds if `ing`."""
    text = _VERB.sub(lambda verb: gerund(verb[1]) if ing else verb[1], phrase)
    return _FORM.sub(lambda mark: f" {FORMS[mark[0]]}", text)


@functools.cache
def parse_phrase(phrase: str) -> Nodes:
    """The nodes of a phrase as a command. Raises TemplateError."""
    return parse_text(phrase_text(phrase))


def gerund(verb: str) -> str:
    """The -ing form of an English verb: "take" -> "taking", "run" -> "running"."""
    if verb in _GERUND:
        return _GERUND[verb]
    vowels = [letter in "aeiou" for letter in verb]
    if sum(vowels) == 1 and vowels[-2:] == [True, False] and verb[-1] not in "wxy":
        return verb + verb[-1] + "ing"
    return (verb[:-1] if verb[-1] == "e" and verb[-2:] != "ee" else verb) + "ing"


def spaced(name: str) -> str:
    """A name as words: "RotateToHeading" -> "rotate to heading", "target_id" -> "target id"."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])|_", " ", name).lower()


class SkillEntry:
    """The phrases and parameter spaces of one skill."""

    def __init__(self, skill: Skill, config: dict[str, Any], book: Phrasebook) -> None:
        self.skill, self.draws = skill, _draws(skill, config, book)
        shares, items = config.get("often", {}), skill.parameters
        self.often = {one.name: 1.0 if one.required else shares.get(one.name, 0.5) for one in items}
        """How often an optional part of a phrase stands, by parameter."""
        known = {*skill.by_name, *(("xy",) if skill.motion == "goto" else ())}
        for phrase in (one for key in KINDS for one in config.get(key, ())):
            for name in set(_values(phrase)) - known:
                raise PlannerError(
                    f"vocabulary {book.vocabulary.source}: phrase {phrase!r}: {skill.name} has no"
                    f" parameter {name}"
                )
        own = (book.unseen and config.get("unseen")) or config.get("phrases", [])
        self.phrases: dict[str, list[str]] = {
            "": own or [_generic_phrase(skill)],
            "with": config.get("with", []),
            "passive": [] if book.unseen else config.get("passive", []),
        }
        self.bare = [one for one in own if not _values(one)]
        self.none: list[str] = config.get("none", [])
        self.several = bool(config.get("several", True)) and bool(items)
        self.repeats = bool(config.get("repeats"))


class TaskEntry:
    """The phrases, links and parameter spaces of one task."""

    def __init__(self, task: Task, config: dict[str, Any], book: Phrasebook) -> None:
        self.config, self.draws = config, _draws(task, config, book)
        unseen = config.get("lead_unseen") if book.unseen else None
        self.lead: list[str] = unseen or config.get("lead", [])
        self.phrases: list[str] = [] if book.unseen else config.get("phrases", [])
        self.links: dict[str, str] = {}
        """The task parameter that fills a place: "StationKeep.time", "square.center"."""
        for parameter in task.parameters:
            own = config.get("links", {}).get(parameter.name)
            for place in own or _default_links(task, parameter, book.vocabulary):
                self.links.setdefault(place, parameter.name)

    def refer(self, name: str) -> list[str]:
        """Phrases for a value that stands in the task's parameters alone."""
        return self.config.get("refer", {}).get(name) or [f"the given {spaced(name)}"]


class Phrasebook:
    """Everything that the sampler says, for the training families or for the unseen ones.

    Raises PlannerError for a phrase that does not parse or names a word list that is not there.
    """

    def __init__(self, vocabulary: Vocabulary, *, unseen: bool) -> None:
        self.vocabulary, self.unseen, raw = vocabulary, unseen, vocabulary.phrases
        _check_phrases(vocabulary)
        self.lexicon = WordLists(raw.get("words", {}))
        self.bounds = _bounds(vocabulary)
        skills, tasks = raw.get("skill", {}), raw.get("task", {})
        self.skills = {
            name: SkillEntry(skill, skills.get(name, {}), self)
            for name, skill in vocabulary.skill.items()
        }
        self.tasks = {
            title: TaskEntry(task, tasks.get(title, {}), self)
            for title, task in vocabulary.task.items()
        }
        self.decor = {
            name: number_space(Parameter(name, "number", config.get("unit")), config)
            for name, config in raw.get("decor", {}).items()
        }
        self.sentences: dict[str, list[str]] = raw.get("sentence", {})
        self.patterns: dict[str, dict[str, Any]] = raw.get("pattern", {})
        moving = (skill for skill in reversed(vocabulary.skills) if skill.motion)
        self.motions: dict[str, str] = {str(skill.motion): skill.name for skill in moving}
        self.roles = {role: [one.name for one in vocabulary.skills_in_role(role)] for role in ROLES}
        self.verbs = {"run", *_VERB.findall(compact_json(raw))}

    def place(self, rng: Random) -> Value:
        """A position to which the vehicle can go, as it is said."""
        return draw_position(rng, self.bounds)

    def within(self, at: Sequence[float]) -> bool:
        """Whether the vehicle can go to this position."""
        return all(low <= one <= high for one, (low, high) in zip(at, self.bounds, strict=True))

    def pattern(self, name: str, title: str) -> Sequence[str]:
        """Phrases of a movement of several steps, the task's own ones twice as often."""
        general = self.patterns.get(name, {})
        if self.unseen and general.get("unseen"):
            return list(general["unseen"])
        own = self.tasks[title].config.get("pattern_phrases", {}).get(name, [])
        return [*own * 2, *general.get("phrases", [])]


@functools.lru_cache(maxsize=8)
def phrasebook(vocabulary: Vocabulary, *, unseen: bool) -> Phrasebook:
    """The vocabulary's phrases, parsed once."""
    return Phrasebook(vocabulary, unseen=unseen)


def _draws(owner: Skill | Task, config: dict[str, Any], book: Phrasebook) -> dict[str, Draw]:
    spaces = config.get("values", {})
    return {
        item.name: book.place
        if item.type == "position"
        else value_space(item, spaces.get(item.name, {}), book.lexicon)
        for item in owner.parameters
    }


def _bounds(vocabulary: Vocabulary) -> Bounds:
    """The coordinates that every skill that goes to a position takes; all where none is left."""
    known = [skill.by_name for skill in vocabulary.skills if skill.motion == "goto"]
    bounds = list[tuple[float, float]]()
    for axis, (least, most) in zip("xy", ANYWHERE, strict=True):
        ends = [(one[axis].minimum, one[axis].maximum) for one in known if axis in one]
        low = max((low for low, _high in ends if low is not None), default=least)
        high = min((high for _low, high in ends if high is not None), default=most)
        bounds.append((low, high) if low <= high else (least, most))
    return bounds


def _values(phrase: str) -> list[str]:
    return [slot.key for slot in all_slots(parse_phrase(phrase)) if not slot.sign]


def _generic_phrase(skill: Skill) -> str:
    names = [parameter.name for parameter in skill.parameters]
    if "x" in names and "y" in names:
        names = ["xy", *(name for name in names if name not in ("x", "y"))]
    parts = (f"[ with {'position' if name == 'xy' else spaced(name)} {{{name}}}]" for name in names)
    return f"~run {spaced(skill.name)}{''.join(parts)}"


def _check_phrases(vocabulary: Vocabulary) -> None:
    raw, where = vocabulary.beside(PHRASES), f"vocabulary {vocabulary.source}: phrase"
    known = {*raw.get("words", {}), *raw.get("decor", {}), *FALLBACK, *MADE_UP}
    known.update(name for task in vocabulary.tasks for name in task.by_name)
    for section in ("skill", "task", "pattern", "sentence"):
        for phrase in _texts(raw.get(section, {})):
            try:
                slots = list(all_slots(parse_phrase(phrase.replace("{}", ""))))
            except TemplateError as error:
                raise PlannerError(f"{where} file, [{section}]: {phrase!r}: {error}") from None
            for name in (slot.key for slot in slots if slot.sign and slot.key not in known):
                raise PlannerError(
                    f"{where} {phrase!r} names the word list {name!r}; add it to [words] or [decor]"
                )


def _texts(value: Any) -> Iterator[str]:
    """All phrases in a section of the phrase file."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict | list):
        pairs = value.items() if isinstance(value, dict) else enumerate(value)
        yield from (text for key, item in pairs if key not in SETTINGS for text in _texts(item))


def _default_links(task: Task, parameter: Parameter, vocabulary: Vocabulary) -> Iterator[str]:
    """The skill parameters that a task parameter fills where the phrase file does not say it."""
    for name in (entry for names in task.skills.values() for entry in names):
        skill = vocabulary.skill[name]
        if parameter.type == "position" and skill.motion == "goto":
            yield f"{name}.xy"
        elif (same := skill.by_name.get(parameter.name)) and same.type == parameter.type:
            yield f"{name}.{parameter.name}"
