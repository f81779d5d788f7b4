"""Phrases of NAME.phrases.toml and of frames.toml, in the grammar of the templates.

(~hold|~keep) (position|station)[ within {radius}][ for {time}]

~verb    inflected: base form in commands, -ing form after "while"
{slot}   a value as it is stated or referred to ("the planned time"); with a mark, only a value
         that is stated: {slot#} in full, {slot!} short, {slot^} as a noun, {slot+} as a
         direction (see numbers.Value)
{_list}  an entry of a word list, or a value of the task, that is no value of the plan
"""

from __future__ import annotations

import functools
import random
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from planner_ft.data.templates.grammar import (
    Choice,
    Nodes,
    Optional,
    Slot,
    all_slots,
    choose,
    parse_text,
)
from planner_ft.data.templates.render import VALUE_CLOSE, VALUE_OPEN, joined, segments

Given = frozenset[str]
FORMS = {"#": "full", "!": "num", "^": "noun", "+": "way"}
_FORM = re.compile(r"(?<=\w)[#!^+](?=})")
_VERB = re.compile(r"~([A-Za-z-]+)")
_ARTICLE = re.compile(r"(?<=\ba )")
_GERUND = {"be": "being", "lie": "lying", "tie": "tying", "begin": "beginning"}


@dataclass(frozen=True, eq=False)
class Phrase:
    """A parsed phrase: the names of the slots that must be given, and those of each optional part.
    A name is the slot's key with the form that is asked for: "time", "time num".
    """

    nodes: Nodes
    needed: Given
    optional: tuple[Given, ...]

    def fits(self, given: Given) -> bool:
        """Whether the phrase says exactly the given slots."""
        said = set(self.needed)
        for part in self.optional:
            if part <= given:
                said |= part
        return said <= given and all(
            " " in name or name[0] == "_" or name in said for name in given
        )

    def render(self, slots: Mapping[str, str], rng: random.Random, *, ing: bool = False) -> str:
        """A wording with `slots` (name to text) put in; verbs as gerunds if `ing`."""
        text, given = "", frozenset(slots) if self.optional else frozenset()
        for part in choose(self.nodes, rng, [], given):
            text += (
                _VERB.sub(_gerund if ing else r"\1", part)
                if isinstance(part, str)
                else slots[name_of(part)]
            )
        return text


def name_of(slot: Slot) -> str:
    """The name by which a slot's text is found."""
    return f"_{slot.key}" if slot.sign else " ".join([slot.key, *slot.options])


@functools.cache
def parse_phrase(source: str) -> Phrase:
    """Raises ValueError for a phrase that does not parse or could leave a value unsaid."""
    nodes = parse_text(_FORM.sub(lambda mark: f" {FORMS[mark[0]]}", source))
    optional: list[Given] = []
    return Phrase(nodes, _needed(nodes, optional), tuple(optional))


def parse_phrases(sources: Iterable[str]) -> list[Phrase]:
    """The phrases, parsed."""
    return [parse_phrase(source) for source in sources]


def _needed(nodes: Sequence[object], optional: list[Given]) -> Given:
    """Names of the slots outside optional parts; those of each optional part go to `optional`."""
    needed: set[str] = set()
    for node in nodes:
        if isinstance(node, Slot) and not node.sign:
            needed |= {node.key, name_of(node)}
        elif isinstance(node, Choice):
            said = {_needed(branch, optional) for branch in node.branches}
            if len(said) > 1:
                raise ValueError("all alternatives must say the same slots")
            needed |= said.pop()
        elif isinstance(node, Optional):
            slots = [slot for slot in all_slots(node.nodes) if not slot.sign]
            optional.append(frozenset(name for slot in slots for name in (slot.key, name_of(slot))))
    return frozenset(needed)


def gerund(verb: str) -> str:
    """The -ing form of an English verb: "take" -> "taking", "run" -> "running"."""
    if verb in _GERUND:
        return _GERUND[verb]
    vowels = [letter in "aeiou" for letter in verb]
    if sum(vowels) == 1 and vowels[-2:] == [True, False] and verb[-1] not in "wxy":
        return verb + verb[-1] + "ing"
    return (verb[:-1] if verb[-1] == "e" and verb[-2:] != "ee" else verb) + "ing"


def _gerund(verb: re.Match[str]) -> str:
    return gerund(verb[1])


def mark(text: str) -> str:
    """The text of a value, set apart from the wording around it."""
    return f"{VALUE_OPEN}{text}{VALUE_CLOSE}"


def finished(text: str, *, small: bool = False) -> str:
    """Articles that fit, gaps closed, and capitals where sentences begin unless `small`."""
    pieces = [
        (part, value)
        for piece, value in segments(text)
        for part in ([piece] if value else _ARTICLE.split(piece))
    ]
    return joined(pieces, small=small)
