"""Lark grammars of the two plan forms, put together from a vocabulary and from what its values may
be.

`Values` decides what a value may be, `Script` what may stand where; the strengths differ in nothing
else. Key order, separators and the order of parameters are those of `answer_text`.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, NamedTuple, Self

from planner_ft.decoding.constraints import patterns
from planner_ft.decoding.constraints.patterns import literal, regex
from planner_ft.facts.geometry import Area
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Parameter, Skill, Task, Vocabulary, plans

MOST_TASKS, MOST_STEPS = 32, 128
MOST_SKILLS = 16
"""Filters, and perception skills, of one step."""
MOST_TEXTS = 16
"""Items of a list of texts: assumptions, target_list, stop_conditions."""
MOST_CORNERS = 32
LONGEST_TEXT = 200
LONGEST_PROSE = 400
"""Characters of a parameter, and of a sentence; the longest labels have 55 and 181."""

Symbol = str | None
"""The name of a rule or terminal; None where there is nothing to write."""
Context = frozenset[str]
"""What was written for the same owner that later parameters depend on."""
Options = list[tuple[str, Context]]
"""The symbols of a value, each with the context behind it."""


class Slot(NamedTuple):
    """The place of a parameter's value in an entry for its owner, a task or skill."""

    grammar: Grammar
    owner: Any
    parameter: Parameter
    context: Context


class Grammar:
    """Rules and terminals under construction; the same body gets the same name."""

    def __init__(self) -> None:
        self._names: dict[str, str] = {}

    def rule(self, body: str) -> str:
        """The name of a rule with this body."""
        return self._names.setdefault(body, f"r{len(self._names)}")

    def terminal(self, body: str) -> str:
        """The name of a terminal (one lexeme, no recursion) with this body."""
        return self._names.setdefault(body, f"T{len(self._names)}")

    def one_of(self, texts: Iterable[str]) -> Symbol:
        """The terminal that matches one of the texts; None where there is none."""
        options = list(dict.fromkeys(texts))
        return self.terminal(" | ".join(map(literal, options))) if options else None

    def items(self, item: Symbol, least: int = 0, most: int = MOST_TEXTS) -> str:
        """The rule of a list; an empty one where there is no item."""
        if not item:
            return self.rule(literal("[]"))
        some = f'{item} ("," {item}){{{max(least - 1, 0)},{most - 1}}}'
        return self.rule(f'"[" {some} "]"' if least else f'"[" ({some})? "]"')

    def text(self, start: str) -> str:
        """The whole grammar; `start` is the body of its first rule."""
        lines = (f"{name}: {body}" for body, name in self._names.items())
        return "\n".join([f"start: {start}", *lines])


class Values:
    """What may be written as a value: all that the strict schema allows, up to the bounds above."""

    def parameter(
        self, grammar: Grammar, parameter: Parameter, without: Sequence[Any] | None = None
    ) -> Symbol:
        """The symbol of a parameter's value, none of `without`. An identifier that must be another
        one than those is a text.
        """
        kind, barred = parameter.type, without or ()
        if kind in ("number", "integer"):
            return self.number(grammar, parameter, barred)
        if kind == "position":
            return self.position(grammar, barred)
        if kind == "polygon":
            corner = self.position(grammar, barred)
            return grammar.items(corner, 3, MOST_CORNERS) if corner else None
        if kind == "id" and without is None:
            return self.identity(grammar)
        text = self.text(grammar, [str(value) for value in barred])
        return grammar.items(text) if text and kind == "texts" else text

    def position(self, grammar: Grammar, without: Sequence[Sequence[float]] = ()) -> Symbol:
        """The symbol of a position, none of `without`."""
        barred = none_of(literal(written(place)) for place in without)
        return grammar.terminal(f"{regex(patterns.ANY_POSITION)}{barred}")

    def number(
        self, grammar: Grammar, parameter: Parameter, without: Sequence[float] = ()
    ) -> Symbol:
        """The symbol of a parameter's number, none of `without`."""
        whole, low, high = parameter.type == "integer", parameter.minimum, parameter.maximum
        pattern, beyond = patterns.any_number(whole=whole), list[str]()
        if low is not None and high is not None:
            pattern, beyond = patterns.number_range(low, high, whole=whole)
        barred = (*map(regex, beyond), *map(literal, map(written, without)))
        return grammar.terminal(f"{regex(pattern)}{none_of(barred)}")

    @property
    def areas(self) -> Sequence[Area]:
        """The areas that can be meant where no sizes are said; none where any can."""
        return ()

    def middle(self, grammar: Grammar, without: Sequence[Sequence[float]] = ()) -> Symbol:
        """The symbol of the middle of another area than `areas`, none of `without`."""
        return self.position(grammar, without)

    def has_number(self, parameter: Parameter, value: float) -> bool:
        """Whether a parameter's number can be `value`."""
        return plans.value_problem(value, parameter) is None

    def text(self, grammar: Grammar, without: Sequence[str] = ()) -> Symbol:
        """The symbol of a parameter's text, none of `without`."""
        pattern = patterns.string(LONGEST_TEXT, blank=False)
        return grammar.terminal(f"{pattern}{none_of_texts(without)}")

    def identity(self, grammar: Grammar) -> Symbol:
        """The symbol of an identifier."""
        whole = grammar.terminal(regex(patterns.ANY_INTEGER))
        return grammar.rule(f"{self.text(grammar)} | {whole}")

    def prose(self, grammar: Grammar) -> str:
        """The symbol of a task prompt, an assumption or a constraint."""
        return grammar.terminal(patterns.string(LONGEST_PROSE, blank=True))

    def step_texts(self, grammar: Grammar, key: str) -> str:
        """The symbol of a step's stop_conditions, failure_modes or expected_outputs."""
        return grammar.items(self.prose(grammar))


def name_of(owner: Task | Skill) -> str:
    """The name of a task or skill in plans."""
    return owner.title if isinstance(owner, Task) else owner.name


def written(value: float | Sequence[float]) -> str:
    """A number or position as plans write it."""
    return compact_json(plans.canonical_value(value))


@functools.cache
def key(name: str) -> str:
    """A key with its colon."""
    return compact_json(name) + ":"


def none_of_texts(texts: Sequence[str]) -> str:
    """What takes these texts, in capitals or not, out of a terminal of JSON strings."""
    quoted = map(patterns.quoted, texts)
    return none_of(regex(f'(?i:{patterns.QUOTE}{patterns.escaped(text)}")') for text in quoted)


def none_of(terminals: Iterable[str]) -> str:
    """What takes these terminals out of another one."""
    return "".join(f" & ~{terminal}" for terminal in terminals)


def prefix_free(names: Iterable[str]) -> bool:
    """Whether no name begins another and none needs an escape."""
    known = sorted(names)
    begins = (longer.startswith(shorter) for shorter, longer in itertools.pairwise(known))
    return not any(begins) and all(patterns.quoted(name) == name for name in known)


@dataclass(frozen=True)
class Script:
    """The grammars of an answer, each made from the text before it. One ends where nothing can
    follow it, at a place where no token spans both sides: where a name begins or ends, since
    tokenizers keep letters and signs apart.

    `values` are those that may be written; without `logical`, anything may follow anything. An
    answer has at most `most` entries.
    """

    vocabulary: Vocabulary
    values: Values
    logical: bool = True
    most: int = 0
    begins: ClassVar[str] = ""
    """The text before the first entry."""
    opens: ClassVar[str] = ""
    """The text before a name."""

    def opening(self, grammar: Grammar) -> str:
        """The expression of an answer up to the first name, or of an empty one."""
        raise NotImplementedError

    def read(self, before: str) -> Self:
        """The script behind the text `before` an entry."""
        raise NotImplementedError

    @property
    def known(self) -> Sequence[Task | Skill]:
        """What can be named next, whatever stands before."""
        raise NotImplementedError

    def offers(self, grammar: Grammar, owner: Any) -> bool:
        """Whether a task or skill may be named next."""
        raise NotImplementedError

    def ending(self, grammar: Grammar, owner: Any) -> str:
        """The expression behind a task's or skill's parameters, up to the next name."""
        raise NotImplementedError

    def grammar(self, text: str) -> str | None:
        """The grammar of what follows `text`, up to the next place where one ends; None where the
        answer is complete.
        """
        grammar = Grammar()
        if not text:
            return grammar.text(self.opening(grammar))
        before, _opens, name = text.rpartition(self.opens)
        if '"' in name:
            return None
        here = self.read(before)
        if name:
            named = [owner for owner in here.known if name_of(owner) == name]
            return here._entries(named, named=True)
        # A vocabulary can be such that nothing fits; the schema alone holds then.
        offered = [one for one in here.known if here.offers(grammar, one)] or list(here.known)
        if prefix_free(map(name_of, here.known)):
            return Grammar().text(" | ".join(literal(name_of(owner)) for owner in offered))
        return here._entries(offered, named=False)

    def _entries(self, owners: Sequence[Task | Skill], *, named: bool) -> str:
        """What stands behind the name of one of the owners, with it where it is not `named` yet."""
        grammar, ways = Grammar(), []
        for owner in owners:
            schema = replace(self, values=Values(), logical=False)
            entry = self.entry(grammar, owner) or schema.entry(grammar, owner)
            name = "" if named else literal(patterns.quoted(name_of(owner)))
            ways.append(f"{name} {entry} {self.ending(grammar, owner)}")
        return grammar.text(" | ".join(ways))

    def possible(self, grammar: Grammar, owner: Task | Skill) -> bool:
        """Whether the parameters of a task or skill can be written."""
        needy = owner.require_any or any(self.needs(owner, item) for item in owner.parameters)
        return not needy or self.entry(grammar, owner) is not None

    def entry(self, grammar: Grammar, owner: Task | Skill) -> Symbol:
        """The rule of a task or skill behind its name; None where a needed value is missing."""

        @functools.cache
        def rest(index: int, comma: bool, satisfied: bool, context: Context) -> Symbol:
            if index == len(owner.parameters):
                return literal("}") if satisfied else None
            parameter, ways = owner.parameters[index], []
            opens = literal("," * comma + key(parameter.name))
            enough = satisfied or parameter.name in owner.require_any
            for value, after in self.options(Slot(grammar, owner, parameter, context)):
                behind = rest(index + 1, True, enough, after)
                ways += [f"{opens} {value} {behind}"] if behind else []
            if not self.needs(owner, parameter):
                behind = rest(index + 1, comma, satisfied, context)
                ways += [behind] if behind else []
            return grammar.rule(" | ".join(ways)) if ways else None

        parameters = rest(0, False, not owner.require_any, frozenset())
        if parameters is None:
            return None
        opens, closes = literal(f'",{key("parameters")}{{'), literal("}")
        if isinstance(owner, Task):
            closes = f"{literal(',' + key('task_prompt'))} {self.values.prose(grammar)} {closes}"
        return grammar.rule(f"{opens} {parameters} {closes}")

    def options(self, slot: Slot, barred: Sequence[Any] | None = None) -> Options:
        """The options of a parameter's value; None is `barred` where the logic says nothing."""
        symbol = self.values.parameter(slot.grammar, slot.parameter, barred)
        if not symbol and barred is None and slot.parameter.required:
            # Without evidence of its kind, a value that must be written is the model's.
            symbol = Values().parameter(slot.grammar, slot.parameter)
        return [(symbol, slot.context)] if symbol else []

    def needs(self, owner: Any, parameter: Parameter) -> bool:
        """Whether a parameter must be written."""
        return parameter.required
