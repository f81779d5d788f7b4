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
from typing import Any

from planner_ft.decoding.constraints import patterns
from planner_ft.decoding.constraints.patterns import literal, regex
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

Numbers = Sequence[float]
Positions = Sequence[Numbers]
Symbol = str | None
"""The name of a rule or terminal; None where there is nothing to write."""

TASK_OPENS = '{"title":"'
SKILL_OPENS = '{"name":"'


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

    def text(self, start: str) -> str:
        """The whole grammar; `start` is the body of its first rule."""
        lines = (f"{name}: {body}" for body, name in self._names.items())
        return "\n".join([f"start: {start}", *lines])


Context = frozenset[str]
"""What was written for the same owner that later parameters depend on."""
IDENTIFIED: Context = frozenset({"id"})
Options = list[tuple[str, Context]]
"""The symbols of a value, each with the context behind it."""


class Values:
    """What may be written as a value: all that the strict schema allows, up to the bounds above."""

    def parameter(self, grammar: Grammar, parameter: Parameter, context: Context) -> Options:
        """The options of a parameter's value; none where there is nothing to write."""
        symbol: Symbol
        kind = parameter.type
        if kind in ("number", "integer"):
            symbol = self.number(grammar, parameter)
        elif kind in ("position", "polygon"):
            symbol = self.position(grammar)
            symbol = corners(grammar, symbol) if symbol and kind == "polygon" else symbol
        else:
            symbol = self.identity(grammar) if kind == "id" else self.text(grammar)
            symbol = items(grammar, symbol, MOST_TEXTS) if symbol and kind == "texts" else symbol
        after = context | IDENTIFIED if kind == "id" else context
        return [(symbol, after)] if symbol else []

    def position(self, grammar: Grammar, without: Positions = ()) -> Symbol:
        """The symbol of a position, none of `without`."""
        barred = none_of(literal(written(place)) for place in without)
        return grammar.terminal(f"{regex(patterns.ANY_POSITION)}{barred}")

    def number(self, grammar: Grammar, parameter: Parameter, without: Numbers = ()) -> Symbol:
        """The symbol of a parameter's number, none of `without`."""
        whole, low, high = parameter.type == "integer", parameter.minimum, parameter.maximum
        pattern, beyond = patterns.any_number(whole=whole), list[str]()
        if low is not None and high is not None:
            pattern, beyond = patterns.number_range(low, high, whole=whole)
        barred = (*map(regex, beyond), *map(literal, map(written, without)))
        return grammar.terminal(f"{regex(pattern)}{none_of(barred)}")

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
        return items(grammar, self.prose(grammar), MOST_TEXTS)


@dataclass(frozen=True)
class Script:
    """The grammars of an answer, made as it grows. Each one ends where nothing can follow it, at a
    place where no token spans both sides: where a name begins or ends, since tokenizers keep
    letters and signs apart. A script does not change: a copy of an answer goes on with the same.

    `values` are those that may be written; without `logical`, anything may follow anything. An
    answer has at most `most` entries; `chosen` is the task or skill whose name was written last,
    `written` the text of the entry that is being written as far as its parts are matched, `opens`
    the text before a name.
    """

    vocabulary: Vocabulary
    values: Values
    logical: bool = True
    most: int = 0
    chosen: Any = None
    written: str = ""
    opens: str = ""

    @property
    def schema_alone(self) -> Script:
        """This script without facts and logic."""
        return replace(self, values=Values(), logical=False)

    def opening(self) -> str:
        """The first grammar."""
        raise NotImplementedError

    @property
    def known(self) -> Sequence[Task] | Sequence[Skill]:
        """What can be named next, whatever stands before."""
        raise NotImplementedError

    def offers(self, owner: Any) -> bool:
        """Whether a task or skill may be named next."""
        raise NotImplementedError

    def read(self, text: str) -> Script:
        """The script where a name follows the text of an entry, or what stands before the first."""
        raise NotImplementedError

    def behind(self, owners: Sequence[Any], *, names: bool) -> str:
        """What may stand behind a name, up to the next one; with the name before it."""
        raise NotImplementedError

    def following(self, text: str) -> tuple[str, Script] | None:
        """The next grammar and script behind a matched `text`; None: complete."""
        named = {name_of(owner): owner for owner in self.known} if self.chosen is None else {}
        if text in named:
            chosen = replace(self, chosen=named[text], written=self.written + text)
            return chosen.behind([chosen.chosen], names=False), chosen
        if not text.endswith(self.opens):
            return None
        ahead = self.read(self.written + text)
        return ahead.names(), ahead

    def names(self) -> str:
        """The names that may follow; with what stands behind them where one begins another."""
        # A vocabulary can be such that nothing fits; the schema alone holds then.
        offered = [owner for owner in self.known if self.offers(owner)] or list(self.known)
        if prefix_free(map(name_of, self.known)):
            return Grammar().text(" | ".join(literal(name_of(owner)) for owner in offered))
        return self.behind(offered, names=True)

    def entry(self, grammar: Grammar, owner: Task | Skill, *, named: bool) -> str:
        """A task or skill behind its name, or with it where it is not `named` yet."""
        behind = body(grammar, owner, self) or body(grammar, owner, self.schema_alone)
        return f"{'' if named else literal(patterns.quoted(name_of(owner)))} {behind}"

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Any, context: Context
    ) -> Options:
        """The options of a parameter's value: here, whatever `values` allow."""
        return self.values.parameter(grammar, parameter, context)

    def needs(self, parameter: Parameter, owner: Any) -> bool:
        """Whether a parameter must be written."""
        return parameter.required


def name_of(owner: Task | Skill) -> str:
    """The name of a task or skill in plans."""
    return owner.title if isinstance(owner, Task) else owner.name


def written(value: float | Sequence[float]) -> str:
    """A number or position as plans write it."""
    return compact_json(plans.canonical_value(value))


def none_of_texts(texts: Sequence[str]) -> str:
    """What takes these texts, in capitals or not, out of a terminal of JSON strings."""
    quoted = map(patterns.quoted, texts)
    return none_of(regex(f'(?i:{patterns.QUOTE}{patterns.escaped(text)}")') for text in quoted)


def none_of(terminals: Iterable[str]) -> str:
    """What takes these terminals out of another one."""
    return "".join(f" & ~{terminal}" for terminal in terminals)


def one_of(grammar: Grammar, texts: Iterable[str]) -> Symbol:
    """The terminal that matches one of the texts; None where there is none."""
    options = list(dict.fromkeys(texts))
    return grammar.terminal(" | ".join(map(literal, options))) if options else None


def mission_opens() -> str:
    """The text before the first task of a mission plan."""
    return "{" + key(plans.MISSION_KEYS[0]) + "["


def mission_closes(grammar: Grammar, values: Values) -> str:
    """The expression behind the last task of a mission plan."""
    texts = items(grammar, values.prose(grammar), MOST_TEXTS)
    assumptions, constraints = (f",{key(name)}" for name in plans.MISSION_KEYS[1:])
    return f"{literal(']' + assumptions)} {texts} {literal(constraints)} {texts} {literal('}')}"


def prefix_free(names: Iterable[str]) -> bool:
    """Whether no name begins another and none needs an escape."""
    known = sorted(names)
    begins = (longer.startswith(shorter) for shorter, longer in itertools.pairwise(known))
    return not any(begins) and all(patterns.quoted(name) == name for name in known)


@functools.cache
def key(name: str) -> str:
    """A key with its colon."""
    return compact_json(name) + ":"


def items(grammar: Grammar, item: str | None, most: int) -> str:
    """The rule of a list of at most `most` items; an empty one where there is no item."""
    some = f'({item} ("," {item}){{0,{most - 1}}})?'
    return grammar.rule(f'"[" {some} "]"' if item else literal("[]"))


def corners(grammar: Grammar, position: str) -> str:
    """The rule of a polygon."""
    return grammar.rule(f'"[" {position} ("," {position}){{2,{MOST_CORNERS - 1}}} "]"')


def body(grammar: Grammar, owner: Task | Skill, script: Script) -> str | None:
    """The rule of a task or skill behind its name; None where a needed value is missing."""
    parameters = _parameters(grammar, owner, script)
    if parameters is None:
        return None
    opens, closes = literal(f'",{key("parameters")}{{'), literal("}")
    if isinstance(owner, Task):
        closes = f"{literal(',' + key('task_prompt'))} {script.values.prose(grammar)} {closes}"
    return grammar.rule(f"{opens} {parameters} {closes}")


def possible(owner: Task | Skill, script: Script) -> bool:
    """Whether the parameters of a task or skill can be written."""
    needy = owner.require_any or any(script.needs(item, owner) for item in owner.parameters)
    return not needy or _parameters(Grammar(), owner, script) is not None


def _parameters(grammar: Grammar, owner: Task | Skill, script: Script) -> str | None:
    """The rule of an owner's parameters between their braces; None where none can be written."""

    @functools.cache
    def rest(index: int, comma: bool, satisfied: bool, context: Context) -> str | None:
        if index == len(owner.parameters):
            return literal("}") if satisfied else None
        parameter, options = owner.parameters[index], []
        opens = literal("," * comma + key(parameter.name))
        for value, after in script.parameter(grammar, parameter, owner, context):
            behind = rest(index + 1, True, satisfied or parameter.name in owner.require_any, after)
            options += [f"{opens} {value} {behind}"] if behind else []
        if not script.needs(parameter, owner):
            behind = rest(index + 1, comma, satisfied, context)
            options += [behind] if behind else []
        return grammar.rule(" | ".join(options)) if options else None

    return rest(0, False, not owner.require_any, frozenset())
