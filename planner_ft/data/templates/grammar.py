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
from dataclasses import dataclass
from random import Random

DIGITS = "0123456789"
SIGNS = "~_?"
_MARK = re.compile(r"[\\(\[{|)\]}]")
_WORD = re.compile(r"""(?:[^\s"';]|"[^"]*"|(?<==)'[^']*'|')+|;""")


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


class _Scanner:
    """Reads a text into nodes; `place` is the next character."""

    def __init__(self, source: str) -> None:
        self.source, self.place = source, 0

    def sequence(self, closer: str) -> list[Nodes]:
        """The branches up to `closer`, which is passed; the end of the text for ""."""
        branches: list[Nodes] = []
        nodes: list[Node] = []
        plain: list[str] = []

        def close() -> None:
            if any(plain):
                nodes.append("".join(plain))
            plain.clear()

        start = self.place
        while found := _MARK.search(self.source, self.place):
            mark = found[0]
            plain.append(self.source[self.place : found.start()])
            self.place = found.end()
            if mark == "\\":
                plain.append(self.source[self.place : self.place + 1])
                self.place += 1
            elif mark == "(":
                inner = self.sequence(")")
                if len(inner) == 1:
                    close()
                    nodes += ["(", *inner[0], ")"]
                else:
                    close()
                    nodes.append(Choice(tuple(inner)))
            elif mark == "[":
                close()
                nodes.append(_optional(self.sequence("]"), self.source))
            elif mark == "{":
                close()
                end = self.source.find("}", self.place)
                if end < 0:
                    raise TemplateError(f"a brace is not closed: {self.rest(self.place - 1)}")
                nodes.append(parse_slot(self.source[self.place : end]))
                self.place = end + 1
            elif mark == "|" and closer:
                close()
                branches.append(tuple(nodes))
                nodes.clear()
            elif mark == closer:
                close()
                return [*branches, tuple(nodes)]
            else:
                raise TemplateError(f"{mark!r} closes nothing: {self.rest(self.place - 1)}")
        plain.append(self.source[self.place :])
        self.place = len(self.source)
        if closer:
            raise TemplateError(f"a bracket is not closed: {self.rest(start - 1)}")
        close()
        return [tuple(nodes)]

    def rest(self, place: int) -> str:
        """The text from there, shortened."""
        return repr(self.source[max(place, 0) : place + 30])


def _optional(branches: list[Nodes], source: str) -> Optional:
    slots = frozenset(slot.key for slot in all_slots(branches[0]) if not slot.sign)
    if len(branches) > 1 or not slots:
        raise TemplateError(
            f"square brackets hold a slot and no bar; write \\[ for the character: {source[:30]!r}"
        )
    return Optional(slots, branches[0])


def parse_text(source: str) -> Nodes:
    """The nodes of a text. Raises TemplateError."""
    return _Scanner(source).sequence("")[0]


def parse_slot(source: str) -> Slot:
    """The slot between braces."""
    head, *options = source.split()
    sign = head[0] if head[0] in SIGNS else ""
    key, _colon, kind = head[len(sign) :].partition(":")
    if key.startswith("param."):
        sign, key = "param", key[6:]
    if not key.replace("_", "").isalnum() or not key[0].isalpha():
        raise TemplateError(f"{{{source}}} is no slot")
    return Slot(key, base_of(key), sign, kind, frozenset(options))


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
    if "/" in words:
        place = words.index("/")
        head = _step(words[:place])
        return Step(head.call, head.filters, head.perceptions, _step(words[place + 1 :]))
    groups: list[list[str]] = [[]]
    for word in words:
        if word[0] in "+&" and word[1:2].isupper():
            groups.append([])
        groups[-1].append(word)
    calls = [_call(group) for group in groups]
    beside = list(zip(groups[1:], calls[1:], strict=True))
    return Step(
        calls[0],
        tuple(call for group, call in beside if group[0][0] == "+"),
        tuple(call for group, call in beside if group[0][0] == "&"),
    )


def _call(words: list[str]) -> Call:
    if not words:
        raise TemplateError("a step has no name")
    head, _at, at = words[0].lstrip("+&").partition("@")
    name, _mark, label = head.partition("?")
    if not name.isalpha() or at not in ("", "first", "last"):
        raise TemplateError(f"{words[0]!r} is no name of a task, skill or shape")
    return Call(name, tuple(_argument(word) for word in words[1:]), label, at)


def _argument(word: str) -> Argument:
    name, equals, value = word.partition("=")
    if not equals or not name.replace("_", "").isalnum():
        name, value = "", word
    if value[:1] in "\"'" and len(value) > 1:
        return Argument("literal", value[1:-1], name)
    if value[:1] == "~":
        return Argument("unused", value[1:], name)
    negative = value[:1] == "-" and value[1:2].isalpha()
    value = value[negative:]
    if value.startswith("param."):
        return Argument("param", value[6:], name, negative)
    if value.replace("_", "").replace("-", "").isalnum() and value[0].isalpha():
        return Argument("slot", value, name, negative)
    try:
        return Argument("literal", float(value), name)
    except ValueError:
        raise TemplateError(f"{word!r} is no slot, number, text or param.NAME") from None
