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

from planner_ft.facts import WAYPOINT, missing_words, read, read_input, words
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
DOCKING = "approach"
"""The pattern of tasks that end at a docking spot, which needs no search."""


@dataclass(frozen=True)
class Step:
    """A task of the plan with what the definition says about it."""

    index: int
    task: Task
    parameters: dict[str, Any]

    @property
    def place(self) -> list[float] | None:
        name = self.task.position_parameter
        return self.parameters.get(name) if name else None

    def __str__(self) -> str:
        return f"tasks[{self.index}] {self.task.title}"


@dataclass(frozen=True)
class Command:
    """What a plan answers: the words and the tags, either of which may be missing."""

    prompt: str | None = None
    tags: frozenset[str] | None = None

    def allows(self, tag: str, said: re.Pattern[str]) -> bool:
        """Whether an exception holds: by its tag, or by the command's words where the record has no
        tags; without both it may.
        """
        if self.tags is not None:
            return tag in self.tags
        return self.prompt is None or said.search(self.prompt) is not None


def rule_problems(
    plan: Any, vocabulary: Vocabulary, prompt: str | None = None, tags: list[str] | None = None
) -> list[str]:
    """What breaks a labelling rule in a mission plan; names that are not in the vocabulary are
    passed over.
    """
    tasks = plan.get("tasks") if isinstance(plan, dict) else None
    steps = [
        Step(
            index,
            vocabulary.task[entry["title"]],
            _sound_parameters(entry.get("parameters", {}), vocabulary.task[entry["title"]]),
        )
        for index, entry in enumerate(tasks if isinstance(tasks, list) else [])
        if isinstance(entry, dict)
        and isinstance(entry.get("title"), str)
        and entry["title"] in vocabulary.task
    ]
    command = Command(prompt, None if tags is None else frozenset(tags))
    problems = [
        *_search_problems(steps, vocabulary, command),
        *_movement_problems(steps, vocabulary, command),
        *_return_problems(steps, vocabulary, command),
    ]
    if prompt is not None:
        problems += _value_problems(steps, vocabulary, command)
    return problems


def _sound_parameters(parameters: Any, task: Task) -> dict[str, Any]:
    """Parameters that are valid by themselves; what is wrong with the others is reported by
    plan_problems.
    """
    if not isinstance(parameters, dict):
        return {}
    return {
        name: value
        for name, value in parameters.items()
        if name in task.by_name and value_problem(value, task.by_name[name]) is None
    }


# ---------------------------------------------------------------- searching


def _search_problems(steps: list[Step], vocabulary: Vocabulary, command: Command) -> Iterator[str]:
    unresolved = list(vocabulary.unresolved)
    searched: dict[str, Step] = {}
    for number, step in enumerate(steps):
        if step.task.title == vocabulary.locate:
            target = next(
                (
                    str(step.parameters[item.name])
                    for item in step.task.parameters
                    if item.type == "text" and item.name in step.parameters
                ),
                "",
            )
            if target.lower() in searched:
                yield (
                    f"{step}: {target!r} was searched by {searched[target.lower()]} already; one"
                    " search per structure"
                )
            searched[target.lower()] = step
            yield from _needless_search(step, target, steps[number + 1 :], vocabulary, command)
        elif step.place == unresolved and not searched and step.task.pattern != DOCKING:
            yield f"{step}: the place is unresolved and no {vocabulary.locate} comes before it"
        if step.place == unresolved and any(
            item.type == "id" and item.name in step.parameters for item in step.task.parameters
        ):
            yield f"{step}: an identifier needs no place; leave out {step.task.position_parameter}"


def _needless_search(
    step: Step, target: str, following: list[Step], vocabulary: Vocabulary, command: Command
) -> Iterator[str]:
    used = []
    for later in following:
        if later.task.title == vocabulary.locate:
            break
        used.append(later)
    asked = command.allows("rule.search-on-request", SEARCH_WORDS)
    if not asked and not any(later.place == list(vocabulary.unresolved) for later in used):
        yield (
            f"{step}: nothing unresolved follows and the command asks for no search (tag"
            " rule.search-on-request)"
        )
    if not asked and command.prompt and target and _has_coordinates(command.prompt, target):
        yield f"{step}: the command gives coordinates for {target!r}, so it is not searched"


def _has_coordinates(prompt: str, target: str) -> bool:
    place = prompt.lower().find(target.lower())
    if place < 0:
        return False
    end = place + len(target)
    pairs = [
        place.start
        for place in read_positions(prompt)
        if not AREA.search(prompt[place.start : place.end])
    ]
    return any(start >= end and PLACED.fullmatch(prompt[end:start]) is not None for start in pairs)


# ---------------------------------------------------------------- getting there


def _movement_problems(
    steps: list[Step], vocabulary: Vocabulary, command: Command
) -> Iterator[str]:
    unresolved = list(vocabulary.unresolved)
    progress, left = START, False
    for number, step in enumerate(steps):
        task, following = step.task, steps[number + 1] if number + 1 < len(steps) else None
        here = None if progress.here is None else list(progress.here)
        if task.title == vocabulary.transit:
            # Two places that are not known yet look the same.
            unsure = step.place == unresolved and len(progress.searched) > 1
            yield from _transit_problems(
                step, following, None if unsure else here, left, vocabulary, command
            )
        elif not progress.offers(task):
            yield (
                f"{step}: {vocabulary.locate} does not arrive; {vocabulary.transit} to {unresolved}"
                " comes before this task"
            )
        elif (
            task.arrival == "transit" and left and not command.allows("rule.no-transit", STAY_WORDS)
        ):
            yield (
                f"{step}: the task before does not end at its place, so {vocabulary.transit} comes"
                " before this task (or tag rule.no-transit)"
            )
        elif task.arrival == "transit" and step.place is not None and step.place != here:
            yield (
                f"{step}: performed at {step.place}, but no {vocabulary.transit} there comes"
                " before it"
            )
        progress = progress.after(task, step.parameters, vocabulary)
        if task.title == vocabulary.locate or step.place is not None:
            left = task.leaves and task.title != vocabulary.locate


def _transit_problems(
    step: Step,
    following: Step | None,
    here: list[float] | None,
    left: bool,
    vocabulary: Vocabulary,
    command: Command,
) -> Iterator[str]:
    if step.place is None:
        return
    if step.place == here and not left:
        yield f"{step}: the vehicle is at {step.place} already"
    if (
        following is None
        or following.place != step.place
        or following.task.title == vocabulary.transit
    ):
        return
    if following.task.arrival == "self" and not command.allows("rule.explicit-go", GO_WORDS):
        yield (
            f"{step}: {following.task.title} goes to {step.place} by itself; needed only where the"
            " command says to go there (tag rule.explicit-go)"
        )


def _return_problems(steps: list[Step], vocabulary: Vocabulary, command: Command) -> Iterator[str]:
    home = list(vocabulary.home)
    ends = [
        step
        for step in steps
        if step.task.pattern == DOCKING
        or (step.task.title == vocabulary.transit and step.place == home)
    ]
    if command.tags is not None and "rule.return" in command.tags and not ends:
        yield f"the tag rule.return needs a {vocabulary.transit} to {home} or a docking"
    if command.prompt is not None and read(command.prompt).evidence(home, WAYPOINT).given:
        return
    returns = [
        number
        for number, step in enumerate(steps)
        if step.task.title == vocabulary.transit and step.place == home
    ]
    if not returns:
        return
    after = steps[returns[-1] + 1 :]
    if after and after[0].task.pattern == DOCKING:
        yield (
            f"{steps[returns[-1]]}: a return that ends in {after[0].task.title} is that task alone"
        )
    for step in after:
        if step.task.arrival != "none" and step.task.pattern != DOCKING:
            yield f"{step}: comes after the return home, which is the last {vocabulary.transit}"


# ---------------------------------------------------------------- values


def _value_problems(steps: list[Step], vocabulary: Vocabulary, command: Command) -> Iterator[str]:
    for step in steps:
        for name, value in step.parameters.items():
            yield from (
                f"{step}, {name}: {problem}"
                for problem in _value_problem(value, step.task.by_name[name], vocabulary, command)
            )
        yield from _order_problems(step, str(command.prompt))


def _value_problem(
    value: Any, parameter: Parameter, vocabulary: Vocabulary, command: Command
) -> Iterator[str]:
    prompt = str(command.prompt)
    if parameter.type in ("number", "integer", "position"):
        if read_input({"prompt": prompt}, vocabulary).evidence(value, parameter).given is False:
            unit = f" {parameter.unit}" if parameter.unit else ""
            yield (
                f"the coordinates {value!r} are not in the command"
                if parameter.type == "position"
                else f"{value!r}{unit} does not follow from the command"
            )
    elif parameter.type in ("text", "id", "texts"):
        for text in value if isinstance(value, list) else [str(value)]:
            yield from _text_problem(text, prompt, command.tags)


def _text_problem(text: str, prompt: str, tags: frozenset[str] | None) -> Iterator[str]:
    missing = missing_words(prompt, text, misspelt=tags is None or "param.spelling" in tags)
    if missing:
        yield (
            f"{', '.join(map(repr, missing))} of {text!r} not in the command (spelling put right"
            " needs the tag param.spelling)"
        )
    if words(text)[:1] in (["the"], ["a"], ["an"]):
        yield f"{text!r} begins with an article"
    if text != text.strip() or text[-1:] in ".,;:!?":
        yield f"{text!r} ends or begins with a blank or punctuation"


def _order_problems(step: Step, prompt: str) -> Iterator[str]:
    """ "80 by 50" is width by length unless the command names which is which."""
    if not {"width", "length"} <= set(step.parameters) or NAMED_SIDES.search(prompt):
        return
    width, length = step.parameters["width"], step.parameters["length"]
    numbers = read_numbers(prompt)
    for first, second in itertools.pairwise(numbers):
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
