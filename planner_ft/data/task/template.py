"""The phrase language of NAME.phrases.toml: templates that expand to many wordings.

    (~hold|~keep) (position|station)[ within {radius}][ for {time}]

    (a|b)    one of the alternatives, which may be empty
    [text]   optional part: stands exactly when all slots in it are given
    {slot}   a value as it is said or referred to ("the planned time"); with a mark, only a value that is stated: {slot#} in full,
             {slot!} short, {slot^} as a noun, {slot+} as a direction (see numbers.Value)
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
from typing import Literal

Form = Literal["base", "ing"]
VALUE_OPEN, VALUE_CLOSE = "\x02", "\x03"

_TOKEN = re.compile(r"~[A-Za-z-]+|\{[a-z_]+[!^+#]?\}|[()\[\]|]|[^~{}()\[\]|]+")
_DOUBLING = frozenset(
    [
        "begin",
        "clip",
        "cut",
        "dip",
        "drop",
        "fit",
        "flag",
        "get",
        "grab",
        "hug",
        "jot",
        "let",
        "log",
        "map",
        "pan",
        "pin",
        "plan",
        "put",
        "run",
        "scan",
        "set",
        "shut",
        "sit",
        "skim",
        "snap",
        "spin",
        "spot",
        "step",
        "stop",
        "tag",
        "trim",
    ]
)
_GERUND = {"be": "being", "lie": "lying", "tie": "tying", "see": "seeing", "flee": "fleeing"}


def gerund(verb: str) -> str:
    """The -ing form of an English verb: "hold" -> "holding", "take" -> "taking", "run" ->
    "running".
    """
    if verb in _GERUND:
        return _GERUND[verb]
    if verb in _DOUBLING:
        return verb + verb[-1] + "ing"
    return (verb[:-1] if verb.endswith("e") and not verb.endswith("ee") else verb) + "ing"


MARKS = "#!^+"
Node = tuple[str, object]


@dataclass(frozen=True)
class Template:
    """A compiled phrase: the slots that must be given, and the sets of slots that bring an optional
    part each.
    """

    source: str
    nodes: tuple[Node, ...]
    needed: frozenset[str]
    optional: tuple[frozenset[str], ...]

    def fits(self, given: frozenset[str]) -> bool:
        """Whether the phrase says exactly the given slots: all that it needs can be said, and none
        is left unsaid.
        """
        if not self.needed <= given:
            return False
        said = self.needed.union(*(part for part in self.optional if part <= given))
        return all(slot in said for slot in given if slot[-1] not in MARKS)

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
    nodes = branches[0]
    optional: list[frozenset[str]] = []
    return Template(source, nodes, frozenset(_slots(nodes, optional)), tuple(optional))


def _branches(tokens: list[str], position: int) -> tuple[int, list[tuple[Node, ...]]]:
    branches: list[tuple[Node, ...]] = []
    nodes: list[Node] = []
    while position < len(tokens) and tokens[position] not in ")]":
        token = tokens[position]
        if token == "|":
            branches.append(tuple(nodes))
            nodes = []
        elif token in "([":
            position, inner = _branches(tokens, position + 1)
            if position >= len(tokens) or tokens[position] != {"(": ")", "[": "]"}[token]:
                raise ValueError(f"phrase {''.join(tokens)!r}: unbalanced brackets")
            if len({frozenset(_slots(branch, [])) for branch in inner}) > 1:
                raise ValueError(
                    f"phrase {''.join(tokens)!r}: all alternatives must say the same slots; write"
                    " an optional part instead"
                )
            if token == "[" and len(inner) > 1:
                raise ValueError(
                    f"phrase {''.join(tokens)!r}: alternatives in an optional part need brackets of"
                    " their own"
                )
            nodes.append(
                ("choice", tuple(inner))
                if token == "("
                else ("optional", (frozenset(_slots(inner[0], [])), inner[0]))
            )
        elif token[0] == "~":
            nodes.append(("verb", (token[1:], gerund(token[1:]))))
        elif token[0] == "{":
            nodes.append(("slot", token[1:-1]))
        else:
            nodes.append(("text", token))
        position += 1
    branches.append(tuple(nodes))
    return position, branches


def _slots(nodes: tuple[Node, ...], optional: list[frozenset[str]]) -> set[str]:
    """Slots outside optional parts, those of all alternatives included; the slots of each optional
    part go to `optional`.
    """
    needed: set[str] = set()
    for kind, content in nodes:
        if kind == "slot" and str(content)[0] != "_":
            needed |= {str(content), str(content).rstrip(MARKS)}
        elif kind == "choice":
            for branch in content:  # type: ignore[attr-defined]
                needed |= _slots(branch, optional)
        elif kind == "optional":
            optional.append(content[0])  # type: ignore[index]
    return needed


def _render(
    nodes: tuple[Node, ...],
    values: Mapping[str, str],
    rng: random.Random,
    ing: bool,
    parts: list[str],
) -> None:
    for kind, content in nodes:
        if kind == "text":
            parts.append(content)  # type: ignore[arg-type]
        elif kind == "slot":
            parts.append(values[content])  # type: ignore[index]
        elif kind == "verb":
            parts.append(content[ing])  # type: ignore[index]
        elif kind == "choice":
            _render(content[int(rng.random() * len(content))], values, rng, ing, parts)  # type: ignore[arg-type,index]
        elif all(slot in values for slot in content[0]):  # type: ignore[index]
            _render(content[1], values, rng, ing, parts)  # type: ignore[index]


def mark(text: str) -> str:
    """The text of a value, set apart from the wording around it."""
    return f"{VALUE_OPEN}{text}{VALUE_CLOSE}"


_GAPS = re.compile(r" +(?=[ .,;])")


# "a image", "an 8-second", "every a minute"
_BEFORE_VOWEL = re.compile(
    r"\b([Aa])(?="
    r" \x02?(?:8\d?|11|18|8\d\d|eight\w*|eleven|hour|[aei]|o(?!ne\b)|u(?!s|ni))(?![A-Z]))"
)
_DOUBLE_ARTICLE = re.compile(
    r"\b(every|each|last|past|recent|latest|preceding) (\x02?)an? (?=[a-z])"
)


def close_gaps(text: str) -> str:
    """The text without the double blanks that empty alternatives leave, and with articles that fit
    what stands behind them.
    """
    return _DOUBLE_ARTICLE.sub(r"\1 \2", _BEFORE_VOWEL.sub(r"\1n", _GAPS.sub("", text)))


_VALUE = re.compile(f"{VALUE_OPEN}[^{VALUE_CLOSE}]*{VALUE_CLOSE}")


def plain(text: str) -> str:
    """The text without the marks."""
    return text.replace(VALUE_OPEN, "").replace(VALUE_CLOSE, "")


def skeleton(text: str) -> str:
    """The text with each value replaced by an underscore."""
    return _VALUE.sub("_", text)
