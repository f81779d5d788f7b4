"""Synthetic missions: commands drawn from a vehicle's command templates, with their plans.

    for record in sample_missions(seed=0, count=500): ...

The templates stand beside the vehicle's definition (`templates.records`), their word lists and the
texts of the plans in NAME.missions.toml. The plan follows from the template's intents by the
labelling rules (`mission_plan`).
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterator, Sequence
from random import Random
from typing import Any

from planner_ft.data.composing import Command
from planner_ft.data.mission_plan import Beside, PlanTexts
from planner_ft.data.numbers import Draw, Value, feet, knots, pick
from planner_ft.data.targets import HOME
from planner_ft.data.templates.grammar import TemplateError
from planner_ft.data.templates.records import Template, templates
from planner_ft.data.templates.render import noisy, plain
from planner_ft.data.values import WordLists, value_space
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Parameter, Task, Vocabulary, load_vocabulary
from planner_ft.vocabulary.definition import MISSIONS
from planner_ft.vocabulary.limits import load_limits
from planner_ft.vocabulary.plans import value_problem

FOREIGN = 0.03
"""Share of lengths and speeds in feet and knots."""
CLAUSES, HOSTS, TWO = 0.3, 0.35, 0.25
"""Shares of commands with clauses; of these, of templates made for them and of two in one."""
HOST, HOSTED = "{C", "clauses-"
"""A place for a clause, and the ids of the templates of this subject, which are drawn often."""
ORDERING = ("first", "before", "after", "last", "then", "finally", "end", "finish", "next", "again")
"""Words that a template cannot have beside another one."""


def sample_missions(
    seed: int, count: int | None = None, vocabulary: Vocabulary | None = None
) -> Iterator[dict[str, Any]]:
    """Synthetic mission samples of a vehicle (usv unless told otherwise), endless when `count` is
    None; the same seed gives the same samples.

    A record is {"id", "family", "prompt", "expected"}, with {"tags"} where no task fits; `family`
    names the subject of the template. Raises PlannerError for a vehicle without command templates.
    """
    for record, _beside in missions_with_skills(seed, count, vocabulary or load_vocabulary()):
        yield record


def missions_with_skills(
    seed: int, count: int | None, vocabulary: Vocabulary, subjects: tuple[str, ...] = ()
) -> Iterator[tuple[dict[str, Any], list[list[Beside]]]]:
    """The samples, each with the skills that its clauses put beside its tasks; of the templates of
    these subjects alone, where some are named.
    """
    sampler = mission_sampler(vocabulary, subjects)
    for number in itertools.count() if count is None else range(count):
        yield sampler.sample(Random(seed * 1_000_003 + number), f"synthetic-{seed}-{number}")


@functools.lru_cache(maxsize=8)
def mission_sampler(vocabulary: Vocabulary, subjects: tuple[str, ...] = ()) -> MissionSampler:
    """The sampler of a vehicle's missions, made once."""
    return MissionSampler(vocabulary, subjects=subjects)


class MissionSampler:
    """Draws commands and their plans for one vehicle, from templates of one split."""

    def __init__(
        self, vocabulary: Vocabulary, split: str | None = "train", subjects: Sequence[str] = ()
    ) -> None:
        self.vocabulary = vocabulary
        self.config = vocabulary.beside(MISSIONS)
        self.words = WordLists(vocabulary.phrases.get("words", {}), self.config.get("words", {}))
        self.texts = PlanTexts(vocabulary, self.config)
        self.default: str = self.config.get("target", "thing")
        if self.default not in self.words:
            file = f"{vocabulary.name}{MISSIONS}"
            raise PlannerError(f"{file}: target = {self.default!r}: there is no such word list")
        self.groups = templates(vocabulary, "commands", split, subjects)
        clauses = list(itertools.chain(*templates(vocabulary, "clauses", split)))
        kinds = load_limits(vocabulary)
        limits = [line for line in clauses if not line.steps or line.steps[0].call.name in kinds]
        self.clauses = ([line for line in clauses if line not in limits], limits)
        self.hosts = [group for group in self.groups if group[0].id.startswith(HOSTED)]
        self.short = [line for group in self.groups for line in group if _is_short(line)]
        if not self.groups:
            named = f" of {', '.join(subjects)}" if subjects else ""
            raise PlannerError(
                f"vocabulary {vocabulary.name}: there are no command templates{named} for synthetic"
                f" missions; write {vocabulary.name}.commands.jsonl beside the definition"
            )

    def sample(self, rng: Random, name: str) -> tuple[dict[str, Any], list[list[Beside]]]:
        """One record, and by task the skills that its clauses put beside it."""
        made, clauses = [pick(pick(self.groups, rng), rng)], 0
        if any(self.clauses) and rng.random() < CLAUSES:
            clauses = pick((1, 1, 1, 1, 1, 2, 2, 2, 3, 3), rng)
            if self.hosts and rng.random() < HOSTS:
                made, clauses = [pick(pick(self.hosts, rng), rng)], clauses - 1
            elif self.short and rng.random() < TWO:
                made = [pick(self.short, rng), pick(self.short, rng)]
        command = self.compose(made, rng, clauses)
        calls = [step.call for template in made for step in template.steps]
        arguments = itertools.chain(*(call.arguments for call in calls))
        texts = (str(one.value) for one in arguments if one.kind == "literal")
        literal = frozenset(word for text in texts for word in text.split())
        tasks = command.expected["tasks"]
        values = [str(value) for task in tasks for value in task["parameters"].values()]
        shout = all(value == value.lower() for value in values)
        record = {
            "id": name,
            "family": f"synthetic-{made[0].subject}",
            "prompt": plain(noisy(command.text, rng, keep=literal, shout=shout)),
            "expected": command.expected,
            # Without the key: a list of tags says that none but these holds.
            **({} if tasks else {"tags": ["rule.empty"]}),
        }
        return record, command.beside

    def compose(
        self, made: Sequence[Template], rng: Random, clauses: int = 0, only: Template | None = None
    ) -> Command:
        """The command of these templates, with clauses, `only` of one record where it is given.
        Raises PlannerError for a template that does not fit the vehicle.
        """
        records = ([only], [only]) if only else self.clauses
        try:
            return Command(self, made, rng, records, clauses)
        except TemplateError as error:
            raise (only or made[0]).error(error) from None

    def draw(self, task: Task, parameter: Parameter) -> Draw:
        """How values of a parameter are drawn, with their words."""
        config: dict[str, Any] = {}
        for source in (self.vocabulary.phrases, self.config):
            own = source.get("task", {}).get(task.title, {})
            config |= own.get("values", {}).get(parameter.name, {})
        draw, typical = value_space(parameter, config, self.words), config.get("typical", (1, 60))
        measure = parameter.unit if parameter.type == "number" else None
        if measure not in ("m", "m/s"):
            return draw

        def drawn(rng: Random) -> Value:
            if rng.random() < FOREIGN:
                foreign = knots(rng) if measure == "m/s" else feet(rng, *typical)
                if foreign is not None and value_problem(foreign.value, parameter) is None:
                    return foreign
            return draw(rng)

        return drawn


def _is_short(template: Template) -> bool:
    """Whether a template asks for one thing, so that another one can follow it."""
    text, calls = template.text, [step.call for step in template.steps]
    if len(calls) != 1 or calls[0].name == HOME or calls[0].label or len(text) >= 110:
        return False
    more = template.excluded or template.constraints or template.assumptions
    ordered = HOST in text or any(word in text.lower() for word in ("{~", *ORDERING))
    return not (more or ordered or any(one.value == "here" for one in calls[0].arguments))
