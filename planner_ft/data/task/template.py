"""The phrase language of NAME.phrases.toml: templates that expand to many wordings.

    (~hold|~keep) (position|station)[ within {radius}][ for {time}]

    (a|b)    one of the alternatives, which may be empty
    [text]   optional part: stands exactly when all slots in it are given
    {slot}   a value as it is said or referred to ("the planned time"); with a mark, only a value
             that is stated: {slot#} in full, {slot!} short, {slot^} as a noun, {slot+} as a
             direction (see numbers.Value)
    {_list}  an entry of a word list, or a value of the task, that is no value of the plan
    ~verb    inflected: base form in commands, -ing form after "while"

Values are set between VALUE_OPEN and VALUE_CLOSE, so that what surrounds them can be told apart:
the skeleton of a prompt is the prompt without its values.
"""

from __future__ import annotations

import functools
import random
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from planner_ft.data.templates.render import VALUE_CLOSE, VALUE_OPEN, article_for, tidied

Form = Literal["base", "ing"]
Node = tuple[str, Any]
"""("text", str), ("slot", name), ("verb", (base, gerund)), ("choice", branches) or ("optional",
(slots, nodes)).
"""
MARKS = "#!^+"

_TOKEN = re.compile(r"~[A-Za-z-]+|\{[a-z_]+[!^+#]?\}|[()\[\]|]|[^~{}()\[\]|]+")
_EVERY = ("every", "each", "last", "past", "recent", "latest", "preceding")
_GERUND = {"be": "being", "lie": "lying", "tie": "tying", "begin": "beginning"}


def gerund(verb: str) -> str:
    """The -ing form of an English verb: "hold" -> "holding", "take" -> "taking", "run" ->
    "running".
    """
    if verb in _GERUND:
        return _GERUND[verb]
    vowels = [letter in "aeiou" for letter in verb]
    if sum(vowels) == 1 and vowels[-2:] == [True, False] and verb[-1] not in "wxy":
        return verb + verb[-1] + "ing"
    return (verb[:-1] if verb[-1] == "e" and verb[-2:] != "ee" else verb) + "ing"


@dataclass(frozen=True)
class Template:
    """A compiled phrase: the slots that must be given, and the sets of slots that bring an optional
    part each.
    """

    source: str
    nodes: tuple[Node, ...]
    needed: frozenset[str]
    optional: tuple[frozenset[str], ...]

    def says(self, given: frozenset[str]) -> frozenset[str] | None:
        """The slots that are said where these are given; None when a needed one is missing."""
        if not self.needed <= given:
            return None
        return self.needed.union(*(part for part in self.optional if part <= given))

    def fits(self, given: frozenset[str]) -> bool:
        """Whether the phrase says exactly the given slots: all that it needs can be said, and none
        is left unsaid.
        """
        said = self.says(given)
        return said is not None and all(slot in said for slot in given if slot[-1] not in MARKS)

    def render(self, values: Mapping[str, str], rng: random.Random, form: Form = "base") -> str:
        """A wording with `values` (slot, or slot with its mark, to text) put in."""
        parts: list[str] = []
        _render(self.nodes, values, rng, form == "ing", parts)
        return "".join(parts)


@functools.lru_cache(maxsize=16384)
def compile_template(source: str) -> Template:
    """Parse a phrase. Raises ValueError on unbalanced brackets."""
    tokens = _TOKEN.findall(source)
    if "".join(tokens) != source:
        raise ValueError(f"phrase {source!r}: stray brace or tilde")
    position, branches = _branches(tokens, 0)
    if position != len(tokens) or len(branches) != 1:
        raise ValueError(f"phrase {source!r}: unbalanced brackets")
    optional: list[frozenset[str]] = []
    return Template(source, branches[0], _slots(branches[0], optional), tuple(optional))


def _branches(tokens: list[str], position: int) -> tuple[int, list[tuple[Node, ...]]]:
    """The alternatives from `position` on up to a closing bracket, and where that stands."""
    branches: list[list[Node]] = [[]]
    while position < len(tokens) and tokens[position] not in ")]":
        token = tokens[position]
        if token == "|":
            branches.append([])
        elif token in "([":
            position, inner = _branches(tokens, position + 1)
            if position >= len(tokens) or tokens[position] != {"(": ")", "[": "]"}[token]:
                raise ValueError(f"phrase {''.join(tokens)!r}: unbalanced brackets")
            slots = {_slots(branch, []) for branch in inner}
            if len(slots) > 1 or (token == "[" and len(inner) > 1):
                problem = "all alternatives must say the same slots; write optional parts, each of"
                raise ValueError(f"phrase {''.join(tokens)!r}: {problem} one text")
            content = tuple(inner) if token == "(" else (slots.pop(), inner[0])
            branches[-1].append(("choice" if token == "(" else "optional", content))
        elif token[0] == "~":
            branches[-1].append(("verb", (token[1:], gerund(token[1:]))))
        elif token[0] == "{":
            branches[-1].append(("slot", token[1:-1]))
        else:
            branches[-1].append(("text", token))
        position += 1
    return position, [tuple(nodes) for nodes in branches]


def _slots(nodes: tuple[Node, ...], optional: list[frozenset[str]]) -> frozenset[str]:
    """Slots outside optional parts, those of all alternatives included; the slots of each optional
    part go to `optional`.
    """
    needed: set[str] = set()
    for kind, content in nodes:
        if kind == "slot" and content[0] != "_":
            needed |= {content, content.rstrip(MARKS)}
        elif kind == "choice":
            needed.update(*(_slots(branch, optional) for branch in content))
        elif kind == "optional":
            optional.append(content[0])
    return frozenset(needed)


def _render(
    nodes: tuple[Node, ...],
    values: Mapping[str, str],
    rng: random.Random,
    ing: bool,
    parts: list[str],
) -> None:
    for kind, content in nodes:
        if kind == "text":
            parts.append(content)
        elif kind == "slot":
            parts.append(values[content])
        elif kind == "verb":
            parts.append(content[ing])
        elif kind == "choice":
            _render(content[int(rng.random() * len(content))], values, rng, ing, parts)
        elif all(slot in values for slot in content[0]):
            _render(content[1], values, rng, ing, parts)


def mark(text: str) -> str:
    """The text of a value, set apart from the wording around it."""
    return f"{VALUE_OPEN}{text}{VALUE_CLOSE}"


def close_gaps(text: str) -> str:
    """The text without the double blanks that empty alternatives leave, and with articles that fit
    what stands behind them: "an image", "every minute", "an 8-second hold".
    """
    text = tidied(text)
    for word in _EVERY if f" {VALUE_OPEN}a" in text else ():
        for article in ("a ", "an "):
            text = text.replace(f"{word} {VALUE_OPEN}{article}", f"{word} {VALUE_OPEN}")
    first, *rest = f" {text}".split(" a ")
    text = first + "".join(f" {article_for(part.lstrip(VALUE_OPEN))} {part}" for part in rest)
    if text.startswith(" A ") and article_for(text[3:].lstrip(VALUE_OPEN)) == "an":
        text = f" An{text[2:]}"
    return text[1:]
