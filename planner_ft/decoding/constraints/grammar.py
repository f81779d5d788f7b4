"""Lark grammars of the two plan forms, put together from a vocabulary and from what its values may
be.

`Values` decides what a value may be; the strengths differ in nothing else. Key order, separators
and the order of parameters are those of `answer_text`.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable, Sequence
from typing import Protocol

from planner_ft.decoding.constraints import patterns
from planner_ft.decoding.constraints.patterns import literal, regex
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Parameter, Skill, Task, Vocabulary
from planner_ft.vocabulary.definition import Role
from planner_ft.vocabulary.plans import (
    MISSION_KEYS,
    STEP_KEYS,
    WORKING,
    Level,
    canonical_value,
    value_problem,
)

MOST_TASKS, MOST_STEPS = 32, 128
MOST_SKILLS = 16
"""Filters, and perception skills, of one step."""
MOST_TEXTS = 16
"""Items of a list of texts: assumptions, target_list, stop_conditions."""
MOST_CORNERS = 32
LONGEST_WORKING = 600
"""Characters of a working. The longest of 3,000 sampled tasks has 250."""
LONGEST_TEXT = 200
LONGEST_PROSE = 400
"""Characters of a parameter, and of a task prompt, an assumption or a constraint. The longest
labels have 55 and 181.
"""

Positions = Sequence[Sequence[float]]

TASK_OPENS = '{"title":"'
SKILL_OPENS = '{"name":"'
STEP_TAIL = STEP_KEYS[3:]


class Grammar:
    """Rules and terminals under construction; the same body gets the same name."""

    def __init__(self) -> None:
        self._names: dict[str, str] = {}
        self._lines: list[str] = []

    def rule(self, body: str) -> str:
        """The name of a rule with this body."""
        return self._named(body, "r")

    def terminal(self, body: str) -> str:
        """The name of a terminal with this body: one lexeme, a regular expression without
        recursion.
        """
        return self._named(body, "T")

    def text(self, start: str) -> str:
        """The whole grammar; `start` is the body of its first rule."""
        return "\n".join([f"start: {start}", *self._lines])

    def _named(self, body: str, prefix: str) -> str:
        name = self._names.get(body)
        if name is None:
            name = self._names[body] = f"{prefix}{len(self._names)}"
            self._lines.append(f"{name}: {body}")
        return name


Context = frozenset[str]
"""What was written for the same owner that later parameters depend on."""
IDENTIFIED: Context = frozenset({"id"})


class Values(Protocol):
    """What may be written as a value. A symbol is None where there is nothing to write."""

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task | Skill, context: Context
    ) -> list[tuple[str, Context]]:
        """The symbols of a parameter's value, each with the context behind it."""

    def needs(self, parameter: Parameter, owner: Task | Skill) -> bool:
        """Whether a parameter must be written."""

    def position(self, grammar: Grammar, without: Positions) -> str | None:
        """The symbol of a position, none of `without`."""

    def number(
        self, grammar: Grammar, parameter: Parameter, without: Sequence[float]
    ) -> str | None:
        """The symbol of a parameter's number, none of `without`."""

    def has_number(self, parameter: Parameter, value: float) -> bool:
        """Whether a parameter's number can be `value`."""

    def text(self, grammar: Grammar, without: Sequence[str]) -> str | None:
        """The symbol of a parameter's text, none of `without`."""

    def prose(self, grammar: Grammar) -> str:
        """The symbol of a task prompt, an assumption or a constraint."""

    def step_texts(self, grammar: Grammar, key: str) -> str:
        """The symbol of a step's stop_conditions, failure_modes or expected_outputs."""


class SchemaValues:
    """Every value that the strict schema allows, up to the bounds above."""

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task | Skill, context: Context
    ) -> list[tuple[str, Context]]:
        kind = parameter.type
        if kind in ("number", "integer"):
            return [(self.number(grammar, parameter, ()), context)]
        if kind in ("position", "polygon"):
            position = self.position(grammar, ())
            return [(corners(grammar, position) if kind == "polygon" else position, context)]
        text = self.text(grammar, ())
        if kind == "id":
            return [
                (
                    grammar.rule(f"{text} | {grammar.terminal(regex(patterns.ANY_INTEGER))}"),
                    context | IDENTIFIED,
                )
            ]
        return [(items(grammar, text, MOST_TEXTS) if kind == "texts" else text, context)]

    def needs(self, parameter: Parameter, owner: Task | Skill) -> bool:
        return parameter.required

    def position(self, grammar: Grammar, without: Positions) -> str:
        return grammar.terminal(
            f"{regex(patterns.ANY_POSITION)}{_none_of(literal(written(place)) for place in without)}"
        )

    def number(self, grammar: Grammar, parameter: Parameter, without: Sequence[float]) -> str:
        pattern = patterns.number_range(
            parameter.minimum, parameter.maximum, whole=parameter.type == "integer"
        )
        return grammar.terminal(
            f"{regex(pattern)}{_none_of(literal(written_number(number)) for number in without)}"
        )

    def has_number(self, parameter: Parameter, value: float) -> bool:
        return value_problem(value, parameter) is None

    def text(self, grammar: Grammar, without: Sequence[str]) -> str:
        return grammar.terminal(
            f"{patterns.string(LONGEST_TEXT, blank=False)}{none_of_texts(without)}"
        )

    def prose(self, grammar: Grammar) -> str:
        return grammar.terminal(patterns.string(LONGEST_PROSE, blank=True))

    def step_texts(self, grammar: Grammar, key: str) -> str:
        return items(grammar, self.prose(grammar), MOST_TEXTS)


class Narrowed:
    """The values of another strength, to be narrowed by overriding."""

    def __init__(self, values: Values) -> None:
        self._values = values

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task | Skill, context: Context
    ) -> list[tuple[str, Context]]:
        return self._values.parameter(grammar, parameter, owner, context)

    def needs(self, parameter: Parameter, owner: Task | Skill) -> bool:
        return self._values.needs(parameter, owner)

    def position(self, grammar: Grammar, without: Positions) -> str | None:
        return self._values.position(grammar, without)

    def number(
        self, grammar: Grammar, parameter: Parameter, without: Sequence[float]
    ) -> str | None:
        return self._values.number(grammar, parameter, without)

    def has_number(self, parameter: Parameter, value: float) -> bool:
        return self._values.has_number(parameter, value)

    def text(self, grammar: Grammar, without: Sequence[str]) -> str | None:
        return self._values.text(grammar, without)

    def prose(self, grammar: Grammar) -> str:
        return self._values.prose(grammar)

    def step_texts(self, grammar: Grammar, key: str) -> str:
        return self._values.step_texts(grammar, key)


def written_number(number: float) -> str:
    """A number as plans write it."""
    return compact_json(canonical_value(number))


def written(position: Sequence[float]) -> str:
    """A position as plans write it."""
    return compact_json(canonical_value(list(position)))


def none_of_texts(texts: Sequence[str]) -> str:
    """What takes these texts, in capitals or not, out of a terminal of JSON strings."""
    return _none_of(
        regex(f'(?i:{patterns.QUOTE}{patterns.escaped(patterns.quoted(text))}")') for text in texts
    )


def _none_of(terminals: Iterable[str]) -> str:
    return "".join(f" & ~{terminal}" for terminal in terminals)


def plan_grammar(
    level: Level, vocabulary: Vocabulary, values: Values, most: int | None = None
) -> str:
    """The grammar of a whole plan of at most `most` tasks or steps."""
    grammar = Grammar()
    if level == "mission":
        tasks = [
            whole
            for whole in (titled_task(grammar, task, values) for task in vocabulary.tasks)
            if whole
        ]
        task = grammar.rule(f"{literal(TASK_OPENS)} ({' | '.join(tasks)})")
        return grammar.text(
            f"{literal(mission_opens())} {_some(task, most or MOST_TASKS)}"
            f" {mission_closes(grammar, values)}"
        )
    step = _step(grammar, vocabulary, values)
    return grammar.text(
        f"{sequence_opens(grammar)} {_some(step, most or MOST_STEPS)} {literal(']}')}"
    )


def sequence_opens(grammar: Grammar) -> str:
    """The expression before the first step of a skill sequence, with or without a scratchpad of
    sums in front.
    """
    opens = literal(key("skill_sequence") + "[")
    sums = grammar.terminal(regex(f'"{patterns.SUMS}{{1,{LONGEST_WORKING}}}"'))
    return f'"{{" ({literal(key(WORKING))} {sums} ",")? {opens}'


def mission_opens() -> str:
    """The text before the first task of a mission plan."""
    return "{" + key(MISSION_KEYS[0]) + "["


def mission_closes(grammar: Grammar, values: Values) -> str:
    """The expression behind the last task of a mission plan."""
    texts = items(grammar, values.prose(grammar), MOST_TEXTS)
    assumptions, constraints = (key(name) for name in MISSION_KEYS[1:])
    return (
        f"{literal('],' + assumptions)} {texts} {literal(',' + constraints)} {texts} {literal('}')}"
    )


def titled_task(grammar: Grammar, task: Task, values: Values) -> str | None:
    """A task behind `{"title":"`, up to its closing brace; None where a required parameter has no
    value.
    """
    body = task_body(grammar, task, values)
    return None if body is None else f"{title(task)} {body}"


def title(task: Task) -> str:
    """A task's title, without quotation marks."""
    return literal(patterns.quoted(task.title))


def task_body(grammar: Grammar, task: Task, values: Values) -> str | None:
    """The rule of a task behind its title, up to its closing brace; None where a required parameter
    has no value.
    """
    parameters = _parameters(grammar, task, values)
    if parameters is None:
        return None
    opens = literal(f'",{key("parameters")}{{')
    return grammar.rule(
        f"{opens} {parameters} {literal(',' + key('task_prompt'))} {values.prose(grammar)}"
        f" {literal('}')}"
    )


@functools.cache
def key(name: str) -> str:
    """A key with its colon."""
    return compact_json(name) + ":"


def items(grammar: Grammar, item: str | None, most: int) -> str:
    """The rule of a list of at most `most` items; an empty one where there is no item."""
    return grammar.rule(f'"[" {_some(item, most)} "]"' if item else literal("[]"))


def corners(grammar: Grammar, position: str) -> str:
    """The rule of a polygon."""
    return grammar.rule(f'"[" {position} ("," {position}){{2,{MOST_CORNERS - 1}}} "]"')


def _some(item: str, most: int) -> str:
    return f'({item} ("," {item}){{0,{most - 1}}})?'


def _step(grammar: Grammar, vocabulary: Vocabulary, values: Values) -> str:
    navigation = _skills(grammar, vocabulary, "navigation", values)
    return grammar.rule(
        f"{literal('{' + key(STEP_KEYS[0]))} {navigation} {step_rest(grammar, vocabulary, values)}"
    )


def step_rest(grammar: Grammar, vocabulary: Vocabulary, values: Values) -> str:
    """The rule of a step behind its navigation skill, up to its closing brace."""
    others = [_skills(grammar, vocabulary, role, values) for role in ("filter", "perception")]
    lists = [
        f"{literal(',' + key(name))} {items(grammar, skill, MOST_SKILLS)}"
        for name, skill in zip(STEP_KEYS[1:3], others, strict=True)
    ]
    return grammar.rule(f"{' '.join(lists)} {step_tail(grammar, values)}")


def step_tail(grammar: Grammar, values: Values) -> str:
    """The rule of a step behind its perception skills, up to its closing brace."""
    lists = [f"{literal(',' + key(name))} {values.step_texts(grammar, name)}" for name in STEP_TAIL]
    return grammar.rule(f"{' '.join(lists)} {literal('}')}")


def skill_body(grammar: Grammar, skill: Skill, values: Values) -> str | None:
    """The rule of a skill behind its name, up to its closing brace; None where a required parameter
    has no value.
    """
    parameters = _parameters(grammar, skill, values)
    opens = literal(f'",{key("parameters")}{{')
    return None if parameters is None else grammar.rule(f"{opens} {parameters} {literal('}')}")


def _skills(grammar: Grammar, vocabulary: Vocabulary, role: Role, values: Values) -> str | None:
    """The rule of a skill of this role; None where the vocabulary has none that can be written."""
    bodies = (
        (skill, skill_body(grammar, skill, values)) for skill in vocabulary.skills_in_role(role)
    )
    options = [f"{literal(patterns.quoted(skill.name))} {body}" for skill, body in bodies if body]
    return (
        grammar.rule(f"{literal(SKILL_OPENS)} {grammar.rule(' | '.join(options))}")
        if options
        else None
    )


def _parameters(grammar: Grammar, owner: Task | Skill, values: Values) -> str | None:
    """The rule of an owner's parameters behind their opening brace, up to the closing one; None
    where none can be written.
    """

    @functools.cache
    def rest(index: int, comma: bool, satisfied: bool, context: Context) -> str | None:
        if index == len(owner.parameters):
            return literal("}") if satisfied else None
        parameter, options = owner.parameters[index], []
        opens = literal("," * comma + key(parameter.name))
        for value, after in values.parameter(grammar, parameter, owner, context):
            behind = rest(index + 1, True, satisfied or parameter.name in owner.require_any, after)
            options += [f"{opens} {value} {behind}"] if behind else []
        if not values.needs(parameter, owner):
            behind = rest(index + 1, comma, satisfied, context)
            options += [behind] if behind else []
        return grammar.rule(" | ".join(options)) if options else None

    return rest(0, False, not owner.require_any, frozenset())
