"""The language of the prompt templates: one line becomes a tree of text and a list of steps. Names
are checked in binding.py.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

WORDINGS = ("adj", "num", "noun", "way", "left", "right", "full")
COMPASS_WORDS = {
    "north": 0,
    "north-east": 45,
    "east": 90,
    "south-east": 135,
    "south": 180,
    "south-west": 225,
    "west": 270,
    "north-west": 315,
}
TURNS = {"clockwise": True, "counter-clockwise": False, "anticlockwise": False}


class TemplateError(ValueError):
    """What is wrong with a line."""


@dataclass(frozen=True)
class Slot:
    """A value in the text: `key` with its digit ("time2"), how it is worded, and whether it is a
    task parameter in words.
    """

    key: str
    wording: frozenset[str] = frozenset()
    param: bool = False


@dataclass(frozen=True)
class Words:
    """An entry of a word list of the phrase file; no value of the plan."""

    name: str


@dataclass(frozen=True)
class Flag:
    """Marks that this alternative was chosen; says nothing."""

    name: str


@dataclass(frozen=True)
class Choice:
    """One of the branches."""

    branches: tuple[tuple[Node, ...], ...]


Node = str | Slot | Words | Flag | Choice


@dataclass(frozen=True)
class Argument:
    """A parameter of a call: `name` where the line says it, and a slot key, a task parameter, or a
    literal value.
    """

    kind: Literal["slot", "param", "literal", "word"]
    value: str | float
    name: str = ""
    negative: bool = False


@dataclass(frozen=True)
class CallText:
    """A skill or a shape with its arguments. `flag`: only when that alternative was chosen; `at`:
    only the first or last step.
    """

    name: str
    arguments: tuple[Argument, ...]
    flag: str = ""
    at: str = ""


@dataclass(frozen=True)
class StepText:
    """A step or shape, with what runs in it; `each` is carried out after every waypoint of it."""

    movement: CallText
    filters: tuple[CallText, ...]
    perceptions: tuple[CallText, ...]
    each: StepText | None = None


@dataclass(frozen=True)
class LineText:
    """A parsed line. `everywhere` runs in every step, mentioned before what the steps have of their
    own where `front`.
    """

    source: str
    tasks: tuple[str, ...]
    text: tuple[Node, ...]
    steps: tuple[StepText, ...]
    everywhere: StepText | None
    front: bool


def parse_line(source: str) -> LineText:
    """Parse `TASK, TASK | TEXT => STEP; STEP`. Raises TemplateError."""
    tasks, bar, rest = source.partition("|")
    text, arrow, steps = rest.rpartition("=>")
    if not bar or not arrow:
        raise TemplateError("expected TASK, TASK | TEXT => STEP; STEP")
    if not text.strip() or not steps.strip():
        raise TemplateError("the text or the steps are missing")
    titles = tuple(title.strip() for title in tasks.split(","))
    return LineText(source, titles, parse_text(text.strip()), *_parse_steps(steps))


# ---------------------------------------------------------------- text

_TOKEN = re.compile(r"\{[^{}]*\}|[()\[\]|]|[^{}()\[\]|]+")
_SLOT = re.compile(r"(param[ .:])? *([A-Za-z_]+?)(\d*)((?: [a-z]+)*)$")


def parse_text(source: str) -> tuple[Node, ...]:
    """The text as a tree. A pair of brackets without a bar, or a closing one alone, stands for
    itself.
    """
    tokens = _TOKEN.findall(source)
    if "".join(tokens) != source:
        raise TemplateError("a brace is not closed")
    place, branches = _branches(tokens, 0, "")
    while place < len(tokens):
        if tokens[place] != ")":
            raise TemplateError(f"{tokens[place]!r} closes nothing")
        place, more = _branches(tokens, place + 1, "")
        branches = [(*branches[0], ")", *more[0]), *more[1:]]
    if len(branches) > 1:
        raise TemplateError("a bar outside brackets")
    return branches[0]


def _branches(tokens: list[str], place: int, opened: str) -> tuple[int, list[tuple[Node, ...]]]:
    branches: list[tuple[Node, ...]] = []
    nodes: list[Node] = []
    while place < len(tokens) and tokens[place] not in ")]":
        token = tokens[place]
        if token == "|":
            branches.append(tuple(nodes))
            nodes = []
        elif token in "([":
            place, inner = _branches(tokens, place + 1, token)
            if place >= len(tokens) or tokens[place] != {"(": ")", "[": "]"}[token]:
                raise TemplateError(f"a bracket {token!r} is not closed")
            if token == "[":
                nodes.append(Choice((*inner, ())))
            elif len(inner) == 1:
                nodes += ["(", *inner[0], ")"]
            else:
                nodes.append(Choice(tuple(inner)))
        elif token[0] == "{":
            nodes.append(_slot(token[1:-1]))
        else:
            nodes.append(token)
        place += 1
    branches.append(tuple(nodes))
    return place, branches


def _slot(text: str) -> Node:
    if text.startswith("?"):
        return Flag(text[1:])
    if text.startswith("_"):
        return Words(text[1:])
    match = _SLOT.match(text)
    if not match:
        raise TemplateError(f"{{{text}}} is no slot")
    param, base, digit, wording = match.groups()
    words = frozenset(wording.split())
    if words - set(WORDINGS):
        raise TemplateError(
            f"{{{text}}}: {', '.join(sorted(words - set(WORDINGS)))} is no wording; one of"
            f" {', '.join(WORDINGS)}"
        )
    return Slot(base + digit, words, bool(param))


def slots_of(nodes: tuple[Node, ...]) -> list[Slot]:
    """All slots in the order of the text, those of all alternatives."""
    found: list[Slot] = []
    for node in nodes:
        if isinstance(node, Slot):
            found.append(node)
        elif isinstance(node, Choice):
            for branch in node.branches:
                found += slots_of(branch)
    return found


def flags_of(nodes: tuple[Node, ...]) -> set[str]:
    """All flags of the text."""
    found: set[str] = set()
    for node in nodes:
        if isinstance(node, Flag):
            found.add(node.name)
        elif isinstance(node, Choice):
            found = found.union(*(flags_of(branch) for branch in node.branches))
    return found


# ---------------------------------------------------------------- steps

_ALL = re.compile(r"\{\s*ALL\s*:?\s*((?:[^{}]|\{[^{}]*\})*)\}")
_PARAM = re.compile(r"\{\s*param[ .:]+(\w+)\s*\}|\bparam[ .:]+(\w+)")
_BRACED = re.compile(r"\{\s*(\w+)(?: [a-z]+)*\s*\}")
_CALL_START = re.compile(r"\s*(?<![\w=])([+&])\s*(?=[A-Z])")
_WORD = re.compile(r"""(?:[^\s"'\[]|"[^"]*"|'[^']*'|\[[^\]]*\])+""")


def _parse_steps(source: str) -> tuple[tuple[StepText, ...], StepText | None, bool]:
    source = _PARAM.sub(lambda match: f"param.{match.group(1) or match.group(2)}", source)
    source = _ALL.sub(r"; ALL \1 ;", source)
    source = re.sub(r"\[([+&][^\[\]]*)\]", r"\1", _BRACED.sub(r"\1", source))
    steps: list[StepText] = []
    everywhere: StepText | None = None
    front = False
    for part in filter(None, (part.strip() for part in source.split(";"))):
        step = _parse_step(part)
        if step.movement.name.rstrip(":") != "ALL":
            steps.append(step)
            continue
        if everywhere:
            raise TemplateError("ALL stands twice")
        everywhere, front = step, not steps
    if not steps:
        raise TemplateError("there is no step")
    return tuple(steps), everywhere, front


def _parse_step(source: str) -> StepText:
    head, _slash, tail = source.partition(" / ")
    parts = _CALL_START.split(head)
    calls: dict[str, list[CallText]] = {"+": [], "&": []}
    for sign, text in zip(parts[1::2], parts[2::2], strict=True):
        calls[sign].append(_parse_call(text))
    return StepText(
        _parse_call(parts[0]),
        tuple(calls["+"]),
        tuple(calls["&"]),
        _parse_step(tail) if tail.strip() else None,
    )


def _parse_call(source: str) -> CallText:
    words = _WORD.findall(source)
    if not words:
        raise TemplateError("a step has no name")
    match = re.match(r"([A-Za-z]+):?(?:\?(\w+))?(?:@(first|last))?$", words[0])
    if not match:
        raise TemplateError(f"{words[0]!r} is no name of a skill")
    name, flag, at = match.groups()
    return CallText(name, tuple(_argument(word) for word in words[1:]), flag or "", at or "")


def _argument(word: str) -> Argument:
    name, equals, value = word.partition("=") if re.match(r"[a-z_]+=", word) else ("", "", word)
    del equals
    negative = value.startswith("-") and value[1:2].isalpha()
    value = value[1:] if negative else value
    if value.startswith("param."):
        return Argument("param", value[6:], name, negative)
    if re.fullmatch(r"[+-]?\d+(\.\d+)?", value):
        return Argument("literal", float(value), name)
    if value[:1] in "\"'[":
        return Argument("literal", value.strip("[]").strip("\"'"), name)
    if value in COMPASS_WORDS or value in TURNS or value in WORDINGS:
        return Argument("word", value, name)
    if not re.fullmatch(r"[A-Za-z_]+\d*", value):
        raise TemplateError(f"{word!r} is no slot, number or param.NAME")
    return Argument("slot", value, name, negative)
