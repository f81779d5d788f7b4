"""The labelling rules that a program can check, for the plan of a mission command.

They read the vocabulary's fields (arrival, leaves, position parameter, pattern, locate, transit,
home, unresolved) and so hold for any vehicle. A rule that depends on what the command says is
checked only when the command is given; a tag of the record that names an exception is believed.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from planner_ft.facts import WAYPOINT, Input, missing_words, read, read_input, words
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.places import read_positions
from planner_ft.vocabulary import Parameter, Task, Vocabulary
from planner_ft.vocabulary.plans import value_problem
from planner_ft.vocabulary.replay import START

SEARCH_WORDS = re.compile(
    r"\b(?:f[iu]n?d(?:ing)?|fnd|look(?:s|ing)?|search\w*|locat\w*|spot|seek|detect|scout|hunt\w*|track"
    r" down|trace|comb|sight|eyes on|"
    r"lookout|sweep\w*|scan\w*|whereabouts|visual on|establish where|pin down|pinpoint|where"
    r" .{1,40} (?:is|are|lies|went))\b",
    re.IGNORECASE,
)
GO_WORDS = re.compile(
    r"\b(?:go|going|proceed\w*|head|heading|move|moving|transit\w*|sail|steam|make (?:for|your"
    r" way)|run (?:out|over)|over to|relocat\w*|"
    r"reposition|carry on|continue to|take (?:her|it|the boat) to|come to|boat to|drive|cross|get"
    r" (?:over|yourself)|travel|visit)\b",
    re.IGNORECASE,
)
STAY_WORDS = re.compile(
    r"\b(?:where (?:you|she|it|the \w+) (?:are|is|lies|now|sits?)|where you're|where"
    r" she's|here|right there|on the spot|"
    r"same (?:place|spot)|stay (?:put|there)|at the end of)\b",
    re.IGNORECASE,
)
NAMED_SIDES = re.compile(r"\b(?:wide|width|long|length|broad)\b", re.IGNORECASE)
PLACED = re.compile(
    r"[\s,(\[:@]*(?:(?:lying|located|standing|which"
    r" is|position)\s*)?(?:(?:at|near|around|about|in|on)\s*)*[\s(\[xX=:-]*(?:minus\s*)?",
    re.IGNORECASE,
)
"""What stands between a target and its coordinates."""
AREA = re.compile(r"\bby\b", re.IGNORECASE)


@dataclass(frozen=True)
class Step:
    """A task of the plan with what the definition says about it, and its valid parameters."""

    index: int
    task: Task
    parameters: dict[str, Any]

    @property
    def place(self) -> list[float] | None:
        name = self.task.position_parameter
        return self.parameters.get(name) if name else None

    def first(self, kind: str) -> str | None:
        """The value of the first parameter of this type."""
        names = (item.name for item in self.task.parameters if item.type == kind)
        return next((str(self.parameters[name]) for name in names if name in self.parameters), None)

    def __str__(self) -> str:
        return f"tasks[{self.index}] {self.task.title}"


def rule_problems(
    plan: Any, vocabulary: Vocabulary, prompt: str | None = None, tags: list[str] | None = None
) -> list[str]:
    """What breaks a labelling rule in a mission plan; names that are not in the vocabulary and
    values that are none of their parameter are passed over: plan_problems reports them.
    """
    return list(_Rules(plan, vocabulary, prompt, tags).problems())


class _Rules:
    """The rules for one plan; the command's words and the record's tags may be missing."""

    def __init__(
        self, plan: Any, vocabulary: Vocabulary, prompt: str | None, tags: list[str] | None
    ) -> None:
        self.vocabulary, self.prompt, self.tags = vocabulary, prompt, tags
        self.unresolved, self.home = list(vocabulary.unresolved), list(vocabulary.home)
        tasks = plan.get("tasks") if isinstance(plan, dict) else None
        self.steps = []
        for index, entry in enumerate(tasks if isinstance(tasks, list) else []):
            task = vocabulary.task.get(str(entry.get("title"))) if isinstance(entry, dict) else None
            if task:
                given = entry.get("parameters")
                sound = {
                    name: value
                    for name, value in (given.items() if isinstance(given, dict) else ())
                    if name in task.by_name and value_problem(value, task.by_name[name]) is None
                }
                self.steps.append(Step(index, task, sound))

    def problems(self) -> Iterator[str]:
        """Everything that breaks a rule."""
        yield from self._searches()
        yield from self._movements()
        yield from self._returns()
        if self.prompt is not None:
            yield from self._values(self.prompt)

    def _allows(self, tag: str, said: re.Pattern[str]) -> bool:
        """Whether an exception holds: by its tag, or by the command's words where the record has no
        tags; without both it may.
        """
        if self.tags is not None:
            return tag in self.tags
        return self.prompt is None or said.search(self.prompt) is not None

    def _is(self, step: Step, title: str | None) -> bool:
        return step.task.title == title

    # ------------------------------------------------------------ searching

    def _searches(self) -> Iterator[str]:
        locate = self.vocabulary.locate
        searched: dict[str, Step] = {}
        for number, step in enumerate(self.steps):
            unresolved = step.place == self.unresolved
            if self._is(step, locate):
                target = step.first("text") or ""
                if target.lower() in searched:
                    yield (
                        f"{step}: {target!r} was searched by {searched[target.lower()]} already;"
                        " one search per structure"
                    )
                searched[target.lower()] = step
                yield from self._needless_search(step, target, self.steps[number + 1 :])
            elif unresolved and not searched and not step.task.docks:
                yield f"{step}: the place is unresolved and no {locate} comes before it"
            if unresolved and step.first("id") is not None:
                place = step.task.position_parameter
                yield f"{step}: an identifier needs no place; leave out {place}"

    def _needless_search(self, step: Step, target: str, following: list[Step]) -> Iterator[str]:
        if self._allows("rule.search-on-request", SEARCH_WORDS):
            return
        locate = self.vocabulary.locate
        used = itertools.takewhile(lambda later: not self._is(later, locate), following)
        if not any(later.place == self.unresolved for later in used):
            yield (
                f"{step}: nothing unresolved follows and the command asks for no search (tag"
                " rule.search-on-request)"
            )
        if self.prompt and target and _has_coordinates(self.prompt, target):
            yield f"{step}: the command gives coordinates for {target!r}, so it is not searched"

    # ------------------------------------------------------------ getting there

    def _movements(self) -> Iterator[str]:
        locate, transit = self.vocabulary.locate, self.vocabulary.transit
        progress, left = START, False
        for step, following in itertools.zip_longest(self.steps, self.steps[1:]):
            task = step.task
            here = None if progress.here is None else list(progress.here)
            if self._is(step, transit):
                # Two places that are not known yet look the same.
                unsure = step.place == self.unresolved and len(progress.searched) > 1
                yield from self._transit(step, following, None if unsure else here, left)
            elif not progress.offers(task):
                yield (
                    f"{step}: {locate} does not arrive; {transit} to {self.unresolved} comes"
                    " before this task"
                )
            elif task.arrival == "transit" and (
                left and not self._allows("rule.no-transit", STAY_WORDS)
            ):
                yield (
                    f"{step}: the task before does not end at its place, so {transit} comes"
                    " before this task (or tag rule.no-transit)"
                )
            elif task.arrival == "transit" and step.place not in (None, here):
                yield (f"{step}: performed at {step.place}, but no {transit} there comes before it")
            progress = progress.after(task, step.parameters, self.vocabulary)
            if self._is(step, locate) or step.place is not None:
                left = task.leaves and not self._is(step, locate)

    def _transit(
        self, step: Step, following: Step | None, here: list[float] | None, left: bool
    ) -> Iterator[str]:
        if step.place is None:
            return
        if step.place == here and not left:
            yield f"{step}: the vehicle is at {step.place} already"
        if following is None or following.place != step.place:
            return
        by_itself = following.task.arrival == "self" and following.task.title != step.task.title
        if by_itself and not self._allows("rule.explicit-go", GO_WORDS):
            yield (
                f"{step}: {following.task.title} goes to {step.place} by itself; needed only where"
                " the command says to go there (tag rule.explicit-go)"
            )

    def _returns(self) -> Iterator[str]:
        transit = self.vocabulary.transit
        returns = [
            number
            for number, step in enumerate(self.steps)
            if self._is(step, transit) and step.place == self.home
        ]
        docks = any(step.task.docks for step in self.steps)
        if "rule.return" in (self.tags or ()) and not returns and not docks:
            yield f"the tag rule.return needs a {transit} to {self.home} or a docking"
        named = self.prompt is not None and read(self.prompt).evidence(self.home, WAYPOINT).given
        if named or not returns:
            return
        last, *after = self.steps[returns[-1] :]
        if after and after[0].task.docks:
            yield f"{last}: a return that ends in {after[0].task.title} is that task alone"
        for step in after:
            if step.task.arrival != "none" and not step.task.docks:
                yield f"{step}: comes after the return home, which is the last {transit}"

    # ------------------------------------------------------------ values

    def _values(self, prompt: str) -> Iterator[str]:
        source = read_input({"prompt": prompt}, self.vocabulary)
        misspelt = self.tags is None or "param.spelling" in self.tags
        for step in self.steps:
            for name, value in step.parameters.items():
                parameter = step.task.by_name[name]
                found = unstated(value, parameter, source, prompt, "the command", misspelt=misspelt)
                yield from (f"{step}, {name}: {problem}" for problem in found)
            if {"width", "length"} <= step.parameters.keys() and not NAMED_SIDES.search(prompt):
                yield from _order_problems(step, prompt)


def unstated(
    value: Any, parameter: Parameter, source: Input, said: str, where: str, *, misspelt: bool = True
) -> Iterator[str]:
    """Why a value does not come from what was said."""
    if parameter.type in ("number", "integer"):
        # Turning left is a negative angle, and is said without the sign.
        if [source.evidence(number, parameter).given for number in (value, -value)] == [False] * 2:
            unit = f" {parameter.unit}" if parameter.unit else ""
            yield f"{value!r}{unit} does not follow from {where}"
    elif parameter.type == "position":
        if source.evidence(value, parameter).given is False:
            yield f"the coordinates {value!r} are not in {where}"
    elif parameter.type in ("text", "id", "texts"):
        for text in value if isinstance(value, list) else [str(value)]:
            if missing := missing_words(said, text, misspelt=misspelt):
                hint = "" if misspelt else " (spelling put right needs the tag param.spelling)"
                yield f"{', '.join(map(repr, missing))} of {text!r} not in {where}{hint}"
            if words(text)[:1] in (["the"], ["a"], ["an"]):
                yield f"{text!r} begins with an article"
            if text != text.strip() or text[-1:] in ".,;:!?":
                yield f"{text!r} ends or begins with a blank or punctuation"


def _has_coordinates(prompt: str, target: str) -> bool:
    place = prompt.lower().find(target.lower())
    end = place + len(target)
    return place >= 0 and any(
        found.start >= end and PLACED.fullmatch(prompt[end : found.start])
        for found in read_positions(prompt)
        if not AREA.search(prompt[found.start : found.end])
    )


def _order_problems(step: Step, prompt: str) -> Iterator[str]:
    """ "80 by 50" is width by length unless the command names which is which."""
    width, length = step.parameters["width"], step.parameters["length"]
    for first, second in itertools.pairwise(read_numbers(prompt)):
        between = prompt[first.end : second.start].strip().lower()
        if (
            between in ("by", "x", "×", "times", "on")
            and (first.value, second.value) == (length, width)
            and width != length
        ):
            yield (
                f"{step}: {first.value:g} by {second.value:g} is width {first.value:g} and length"
                f" {second.value:g}, not the other way round"
            )
