"""The grammar of templates: texts with alternatives and slots, plans with calls and arguments.

(a|b|c)        one of the alternatives, which may be empty; brackets without a bar stand
               for themselves
{time2}        a slot; {T1:boat a} has a kind and an option; {~P1} is taken back,
               {_structure} is an entry of a word list, {param.time} a task parameter in
               words, {?film} a label: it says nothing and marks the alternative as chosen
[ for {time}]  stands exactly when all slots in it are given
\\(             the character itself

Title?label argument name=value -name name="text" +Filter &Perception / EACH; NEXT
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from random import Random
from typing import NoReturn

DIGITS = "0123456789"
_CLOSES = {"(": ")", "[": "]"}
_MARK = re.compile(r"\\(.?)|\{([^}]*)\}|([(\[{|)\]}])")
_SLOT = re.compile(r"(param\.|[~_?]?)([A-Za-z]\w*)(?::(\w*))?((?: +\w+)*) *", re.ASCII)
_WORD = re.compile(r"""(?:[^\s"';]|"[^"]*"|(?<==)'[^']*'|')+|;""")
_HEAD = re.compile(r"""[+&]?("[^"]+"|[\w-]+)(?:\?([^@]*))?(?:@(first|last|odd|even))?""")
_ARGUMENT = re.compile(
    r"""(?:(?P<name>\w+)=)?(?:(?P<quote>["'])(?P<text>.*)(?P=quote)|~(?P<unused>.+)"""
    r"""|(?P<minus>-?)(?:param\.(?P<param>\w+)|(?P<slot>[A-Za-z][\w-]*(?:\([\w,()]*\))?))|(?P<number>-?\d+(?:\.\d+)?))""",
    re.DOTALL,
)
_KINDS = {"text": "literal"}


class TemplateError(ValueError):
    """What is wrong with a template."""


def fail(problem: str) -> NoReturn:
    """Raise TemplateError."""
    raise TemplateError(problem)


@dataclass(frozen=True, slots=True)
class Slot:
    """A slot: `key` with its number ("T1", "time2"), `base` without. `sign` is "~" (taken back),
    "_" (word list), "?" (label), "param" (task parameter in words) or "".
    """

    key: str
    base: str
    sign: str = ""
    kind: str = ""
    options: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class Choice:
    """One of the branches stands."""

    branches: tuple[Nodes, ...]


@dataclass(frozen=True, slots=True)
class Optional:
    """The nodes stand when all their slots are given."""

    slots: frozenset[str]
    nodes: Nodes


Node = str | Slot | Choice | Optional
Nodes = tuple[Node, ...]
Part = str | Slot


def base_of(key: str) -> str:
    """The slot without its number: "time2" -> "time"."""
    return key.rstrip(DIGITS)


# ---------------------------------------------------------------- texts


def parse_text(source: str) -> Nodes:
    """The nodes of a text. Raises TemplateError."""
    return _branches(source, 0, "")[0][0]


def _branches(source: str, place: int, opener: str) -> tuple[list[Nodes], int]:
    """The alternatives from a place up to the bracket that closes them, and the place behind it."""
    branches, nodes, begun = list[Nodes](), list[Node](), place - 1
    while found := _MARK.search(source, place):
        nodes.append(source[place : found.start()])
        rest, place = repr(source[found.start() : found.start() + 30]), found.end()
        escaped, slot, mark = found.groups()
        if escaped is not None or slot is not None:
            nodes.append(parse_slot(slot) if escaped is None else escaped)
        elif mark in "([":
            inside, place = _branches(source, place, mark)
            nodes += _bracket(mark, inside, source)
        elif mark == "{":
            raise TemplateError(f"a brace is not closed: {rest}")
        elif opener and mark in "|" + _CLOSES[opener]:
            branches.append(_merged(nodes))
            nodes = []
            if mark != "|":
                return branches, place
        else:
            raise TemplateError(f"{mark!r} closes nothing: {rest}")
    if opener:
        raise TemplateError(f"a bracket is not closed: {source[begun : begun + 30]!r}")
    return [_merged([*nodes, source[place:]])], len(source)


def _bracket(opener: str, branches: list[Nodes], source: str) -> Nodes:
    """What stands between brackets as nodes of the text around them."""
    if opener == "(":
        several = len(branches) > 1
        return (Choice(tuple(branches)),) if several else ("(", *branches[0], ")")
    slots = frozenset(slot.key for slot in all_slots(branches[0]) if not slot.sign)
    if len(branches) > 1 or not slots:
        problem = "square brackets hold a slot and no bar; write \\[ for the character"
        raise TemplateError(f"{problem}: {source[:30]!r}")
    return (Optional(slots, branches[0]),)


def _merged(nodes: list[Node]) -> Nodes:
    """The nodes with neighbouring strings as one."""
    merged: list[Node] = []
    for node in (one for one in nodes if one):
        if isinstance(node, str) and merged and isinstance(merged[-1], str):
            merged[-1] += node
        else:
            merged.append(node)
    return tuple(merged)


def parse_slot(source: str) -> Slot:
    """The slot between braces. Raises TemplateError."""
    found = _SLOT.fullmatch(source)
    if found is None:
        raise TemplateError(f"{{{source}}} is no slot")
    sign, key, kind, options = found.groups()
    return Slot(key, base_of(key), sign.rstrip("."), kind or "", frozenset(options.split()))


def all_slots(nodes: Sequence[Node]) -> Iterator[Slot]:
    """Every slot of every alternative, in the order of the text."""
    for node in nodes:
        if isinstance(node, Slot):
            yield node
        elif isinstance(node, Choice):
            for branch in node.branches:
                yield from all_slots(branch)
        elif isinstance(node, Optional):
            yield from all_slots(node.nodes)


def always(nodes: Sequence[Node]) -> set[str]:
    """The keys of the slots that every alternative holds."""
    found: set[str] = set()
    for node in nodes:
        if isinstance(node, Slot) and node.sign != "~":
            found.add(node.key)
        elif isinstance(node, Choice):
            found |= set.intersection(*(always(branch) for branch in node.branches))
    return found


def choose(
    nodes: Sequence[Node], rng: Random, parts: list[Part], given: frozenset[str] = frozenset()
) -> list[Part]:
    """`parts` with the strings and slots of one alternative of each choice added."""
    for node in nodes:
        if isinstance(node, str | Slot):
            parts.append(node)
        elif isinstance(node, Choice):
            choose(node.branches[int(rng.random() * len(node.branches))], rng, parts, given)
        elif node.slots <= given:
            choose(node.nodes, rng, parts, given)
    return parts


def is_small(nodes: Sequence[Node]) -> bool:
    """Whether a text is written without capitals."""
    return bool(nodes) and isinstance(nodes[0], str) and nodes[0][:1].islower()


# ---------------------------------------------------------------- plans


@dataclass(frozen=True, slots=True)
class Argument:
    """A parameter of a call. `kind`: "slot" (or a word that the caller knows), "param" (task
    parameter), "literal", "unused" (a slot that the plan leaves out on purpose).
    """

    kind: str
    value: str | float
    name: str = ""
    negative: bool = False


@dataclass(frozen=True, slots=True)
class Call:
    """A task, skill or shape with its arguments. `label`: only where that alternative, or one with
    the slot of this name, was chosen; `at`: only at the "first", "last", "odd" or "even" waypoints of a shape.
    """

    name: str
    arguments: tuple[Argument, ...] = ()
    label: str = ""
    at: str = ""

    def of(self, kind: str) -> list[str]:
        """The values of the arguments of a kind."""
        return [str(one.value) for one in self.arguments if one.kind == kind]


@dataclass(frozen=True, slots=True)
class Step:
    """A call with the filters and perception skills beside it; `each` follows every waypoint."""

    call: Call
    filters: tuple[Call, ...] = ()
    perceptions: tuple[Call, ...] = ()
    each: Step | None = None

    def calls(self) -> Iterator[Call]:
        """All calls of the step, those of `each` included."""
        yield from (self.call, *self.filters, *self.perceptions)
        if self.each:
            yield from self.each.calls()


def parse_plan(source: str) -> tuple[Step, ...]:
    """The steps of a plan. Raises TemplateError."""
    words = _WORD.findall(source)
    groups = (list(group) for end, group in itertools.groupby(words, ";".__eq__) if not end)
    return tuple(map(_step, groups))


def _step(words: list[str]) -> Step:
    each = None
    if "/" in words:
        place = words.index("/")
        words, each = words[:place], _step(words[place + 1 :])
    groups: list[list[str]] = [[]]
    for word in words:
        if word[0] in "+&":
            groups.append([])
        groups[-1].append(word)
    filters, perceptions = (
        tuple(_call(group) for group in groups[1:] if group[0][0] == sign) for sign in "+&"
    )
    return Step(_call(groups[0]), filters, perceptions, each)


def _call(words: list[str]) -> Call:
    if not words:
        raise TemplateError("a step has no name")
    head = _HEAD.fullmatch(words[0])
    if head is None:
        raise TemplateError(f"{words[0]!r} is no name of a task, skill or shape")
    name, label, at = head.groups("")
    return Call(name.strip('"'), tuple(map(_argument, words[1:])), label, at)


def _argument(word: str) -> Argument:
    found = _ARGUMENT.fullmatch(word)
    if found is None:
        raise TemplateError(f"{word!r} is no slot, number, text or param.NAME")
    name, kind = found["name"] or "", str(found.lastgroup)
    if kind == "number":
        return Argument("literal", float(found["number"]), name)
    return Argument(_KINDS.get(kind, kind), found[kind], name, bool(found["minus"]))
