"""The labelling rules that a program can check, for the plan of a mission command.

They read the vocabulary's fields (arrival, leaves, position parameter, pattern, locate, transit,
home, unresolved) and so hold for any vehicle. A rule that depends on what the command says is
checked only when the command is given; a tag of the record that names an exception is believed.
"""

import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from planner_ft.data.labels import WORDS, unstated
from planner_ft.facts import WAYPOINT, read, read_input
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.places import read_positions
from planner_ft.vocabulary import Task, Vocabulary, replay
from planner_ft.vocabulary.replay import START, sound

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

    def __str__(self) -> str:
        return f"tasks[{self.index}] {self.task.title}"


def rule_problems(
    plan: Any, vocabulary: Vocabulary, prompt: str | None = None, tags: list[str] | None = None
) -> list[str]:
    """What breaks a labelling rule in a mission plan; names that are not in the vocabulary and
    values that are none of their parameter are passed over: plan_problems reports them.
    """
    rules = _Rules(plan, vocabulary, prompt, tags)
    groups = (rules.searches(), rules.movements(), rules.returns(), rules.values(prompt))
    return list(itertools.chain(*groups))


class _Rules:
    """The rules for one plan; the command's words and the record's tags may be missing."""

    def __init__(
        self, plan: Any, vocabulary: Vocabulary, prompt: str | None, tags: list[str] | None
    ) -> None:
        self.vocabulary, self.prompt, self.tags = vocabulary, prompt, tags
        self.locate, self.transit = vocabulary.locate, vocabulary.transit
        self.unresolved, self.home = list(vocabulary.unresolved), list(vocabulary.home)
        tasks = plan.get("tasks") if isinstance(plan, dict) else None
        self.steps = [
            Step(index, task, sound(entry.get("parameters"), task))
            for index, entry in enumerate(tasks if isinstance(tasks, list) else ())
            if isinstance(entry, dict) and (task := vocabulary.task.get(str(entry.get("title"))))
        ]

    def _allows(self, tag: str) -> bool:
        """Whether an exception holds: by tag, else by the command's words; without both it may."""
        if self.tags is not None:
            return tag in self.tags
        return self.prompt is None or WORDS[tag].search(self.prompt) is not None

    def searches(self) -> Iterator[str]:
        """A search is needed, and once, for what has no place."""
        searched: dict[str, Step] = {}
        for number, step in enumerate(self.steps):
            unresolved = step.place == self.unresolved
            if step.task.title == self.locate:
                target = replay.target(step.task, step.parameters)
                if target.lower() in searched:
                    yield (
                        f"{step}: {target!r} was searched by {searched[target.lower()]} already;"
                        " one search per structure"
                    )
                searched[target.lower()] = step
                if not self._allows("rule.search-on-request"):
                    yield from self._needless_search(step, target, self.steps[number + 1 :])
            elif unresolved and not searched and not step.task.docks:
                yield f"{step}: the place is unresolved and no {self.locate} comes before it"
            by_name, place = step.task.by_name, step.task.position_parameter
            if unresolved and any(by_name[name].type == "id" for name in step.parameters):
                yield f"{step}: an identifier needs no place; leave out {place}"

    def _needless_search(self, step: Step, target: str, following: list[Step]) -> Iterator[str]:
        used = itertools.takewhile(lambda later: later.task.title != self.locate, following)
        if not any(later.place == self.unresolved for later in used):
            yield (
                f"{step}: nothing unresolved follows and the command asks for no search (tag"
                " rule.search-on-request)"
            )
        prompt = self.prompt or ""
        said = prompt.lower().find(target.lower()) if target else -1
        end = said + len(target)
        if said >= 0 and any(
            found.start >= end and PLACED.fullmatch(prompt[end : found.start])
            for found in read_positions(prompt)
            if not AREA.search(prompt[found.start : found.end])
        ):
            yield f"{step}: the command gives coordinates for {target!r}, so it is not searched"

    def movements(self) -> Iterator[str]:
        """The vehicle is brought to where a task is performed, and not to where it is."""
        progress, left = START, False
        for step, following in itertools.zip_longest(self.steps, self.steps[1:]):
            task, title = step.task, step.task.title
            here = None if progress.here is None else list(progress.here)
            if title == self.transit:
                # Two places that are not known yet look the same.
                unsure = step.place == self.unresolved and len(progress.searched) > 1
                yield from self._transit(step, following, None if unsure else here, left)
            elif not progress.offers(task):
                yield (
                    f"{step}: {self.locate} does not arrive; {self.transit} to {self.unresolved}"
                    " comes before this task"
                )
            elif task.arrival == "transit" and left and not self._allows("rule.no-transit"):
                yield (
                    f"{step}: the task before does not end at its place, so {self.transit} comes"
                    " before this task (or tag rule.no-transit)"
                )
            elif task.arrival == "transit" and step.place not in (None, here):
                yield (
                    f"{step}: performed at {step.place}, but no {self.transit} there comes before it"
                )
            progress = progress.after(task, step.parameters, self.vocabulary)
            if title == self.locate or step.place is not None:
                left = task.leaves and title != self.locate

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
        if by_itself and not self._allows("rule.explicit-go"):
            yield (
                f"{step}: {following.task.title} goes to {step.place} by itself; needed only where"
                " the command says to go there (tag rule.explicit-go)"
            )

    def returns(self) -> Iterator[str]:
        """The return home is the last transit, or a docking alone."""
        returns = [
            number
            for number, step in enumerate(self.steps)
            if step.task.title == self.transit and step.place == self.home
        ]
        docks = any(step.task.docks for step in self.steps)
        if "rule.return" in (self.tags or ()) and not returns and not docks:
            yield f"the tag rule.return needs a {self.transit} to {self.home} or a docking"
        named = self.prompt is not None and read(self.prompt).evidence(self.home, WAYPOINT).given
        if named or not returns:
            return
        last, *after = self.steps[returns[-1] :]
        if after and after[0].task.docks:
            yield f"{last}: a return that ends in {after[0].task.title} is that task alone"
        for step in after:
            if step.task.arrival != "none" and not step.task.docks:
                yield f"{step}: comes after the return home, which is the last {self.transit}"

    def values(self, prompt: str | None) -> Iterator[str]:
        """Values come from the command; "80 by 50" is width by length unless it names the sides."""
        if prompt is None:
            return
        source = read_input({"prompt": prompt}, self.vocabulary)
        misspelt = self.tags is None or "param.spelling" in self.tags
        for step in self.steps:
            values = step.parameters
            for name, value in values.items():
                parameter = step.task.by_name[name]
                found = unstated(value, parameter, source, prompt, "the command", misspelt=misspelt)
                yield from (f"{step}, {name}: {problem}" for problem in found)
            width, length = values.get("width"), values.get("length")
            if None in (width, length) or width == length or NAMED_SIDES.search(prompt):
                continue
            for one, two in itertools.pairwise(read_numbers(prompt)):
                between = prompt[one.end : two.start].strip().lower()
                turned = (one.value, two.value) == (length, width)
                if turned and between in ("by", "x", "×", "times", "on"):
                    yield (
                        f"{step}: {one.value:g} by {two.value:g} is width {one.value:g} and length"
                        f" {two.value:g}, not the other way round"
                    )
