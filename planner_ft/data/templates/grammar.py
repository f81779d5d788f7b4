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

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from random import Random

DIGITS = "0123456789"
_MARK = re.compile(r"\\(.?)|\{([^}]*)\}|([(\[{|)\]}])")
_SLOT = re.compile(r"(param\.|[~_?]?)([A-Za-z]\w*)(?::(\w*))?((?: +\w+)*) *", re.ASCII)
_WORD = re.compile(r"""(?:[^\s"';]|"[^"]*"|(?<==)'[^']*'|')+|;""")
_HEAD = re.compile(r"""[+&]?("[^"]+"|[\w-]+)(?:\?([^@]*))?(?:@(first|last))?""")
_ARGUMENT = re.compile(
    r"""(?:(?P<name>\w+)=)?(?:(?P<quote>["'])(?P<text>.*)(?P=quote)|~(?P<unused>.+)"""
    r"""|(?P<minus>-?)(?:param\.(?P<param>\w+)|(?P<slot>[A-Za-z][\w-]*))|(?P<number>-?[\d.]+))""",
    re.DOTALL,
)


class TemplateError(ValueError):
    """What is wrong with a template."""


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


@dataclass
class _Level:
    """A bracket that is open: its branches up to the last bar, and the nodes behind that."""

    opener: str
    place: int
    branches: list[Nodes] = field(default_factory=list)
    nodes: list[Node] = field(default_factory=list)

    def add(self, node: Node) -> None:
        if isinstance(node, str) and self.nodes and isinstance(self.nodes[-1], str):
            self.nodes[-1] += node
        elif node:
            self.nodes.append(node)

    def branch(self) -> None:
        self.branches.append(tuple(self.nodes))
        self.nodes = []


def parse_text(source: str) -> Nodes:
    """The nodes of a text. Raises TemplateError."""
    levels, place = [_Level("", 0)], 0
    for found in _MARK.finditer(source):
        level, rest = levels[-1], repr(source[found.start() : found.start() + 30])
        level.add(source[place : found.start()])
        place = found.end()
        escaped, slot, mark = found.groups()
        if escaped is not None:
            level.add(escaped)
        elif slot is not None:
            level.add(parse_slot(slot))
        elif mark in "([":
            levels.append(_Level(mark, found.start()))
        elif mark == "{":
            raise TemplateError(f"a brace is not closed: {rest}")
        elif mark == "|" and level.opener:
            level.branch()
        elif level.opener and mark == {"(": ")", "[": "]"}[level.opener]:
            level.branch()
            levels.pop()
            _close(level, levels[-1], source)
        else:
            raise TemplateError(f"{mark!r} closes nothing: {rest}")
    if len(levels) > 1:
        begun = source[levels[-1].place : levels[-1].place + 30]
        raise TemplateError(f"a bracket is not closed: {begun!r}")
    levels[0].add(source[place:])
    return tuple(levels[0].nodes)


def _close(level: _Level, outer: _Level, source: str) -> None:
    """Add what stood between brackets to the level around them."""
    first = level.branches[0]
    if level.opener == "[":
        slots = frozenset(slot.key for slot in all_slots(first) if not slot.sign)
        if len(level.branches) > 1 or not slots:
            problem = "square brackets hold a slot and no bar; write \\[ for the character"
            raise TemplateError(f"{problem}: {source[:30]!r}")
        outer.add(Optional(slots, first))
    elif len(level.branches) > 1:
        outer.add(Choice(tuple(level.branches)))
    else:
        for node in ("(", *first, ")"):
            outer.add(node)


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
    """A task, skill or shape with its arguments. `label`: only where that alternative was chosen;
    `at`: only at the "first" or "last" waypoint of a shape.
    """

    name: str
    arguments: tuple[Argument, ...] = ()
    label: str = ""
    at: str = ""


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
    steps: list[Step] = []
    words: list[str] = []
    for word in [*_WORD.findall(source), ";"]:
        if word != ";":
            words.append(word)
        elif words:
            steps.append(_step(words))
            words = []
    return tuple(steps)


def _step(words: list[str]) -> Step:
    each = None
    if "/" in words:
        place = words.index("/")
        words, each = words[:place], _step(words[place + 1 :])
    groups: list[list[str]] = [[]]
    for word in words:
        if word[0] in "+&" and word[1:2].isupper():
            groups.append([])
        groups[-1].append(word)
    beside: dict[str, list[Call]] = {"+": [], "&": []}
    for group in groups[1:]:
        beside[group[0][0]].append(_call(group))
    return Step(_call(groups[0]), tuple(beside["+"]), tuple(beside["&"]), each)


def _call(words: list[str]) -> Call:
    if not words:
        raise TemplateError("a step has no name")
    head = _HEAD.fullmatch(words[0])
    if head is None:
        raise TemplateError(f"{words[0]!r} is no name of a task, skill or shape")
    name, label, at = head.groups()
    return Call(
        name.strip('"'), tuple(_argument(word) for word in words[1:]), label or "", at or ""
    )


def _argument(word: str) -> Argument:
    found = _ARGUMENT.fullmatch(word)
    name = found["name"] or "" if found else ""
    negative = bool(found and found["minus"])
    for group, kind in (("unused", "unused"), ("text", "literal"), ("param", "param")):
        if found and found[group] is not None:
            return Argument(kind, found[group], name, negative)
    if found and found["slot"]:
        return Argument("slot", found["slot"], name, negative)
    try:
        return Argument("literal", float(found["number"] if found else ""), name)
    except ValueError:
        raise TemplateError(f"{word!r} is no slot, number, text or param.NAME") from None
