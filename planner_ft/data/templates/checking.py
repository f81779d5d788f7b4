"""Checking the templates of a vehicle: every one is drawn some times, its plans must be valid.

    python -m planner_ft.data.templates [NAME] [--show N]

prints what is wrong as FILE:LINE, and N samples of every template whose id begins with --only.
"""

import argparse
import itertools
from collections.abc import Iterator
from random import Random
from typing import Any

from planner_ft.data.missions import MissionSampler
from planner_ft.data.numbers import pick
from planner_ft.data.task.binding import binding, titles
from planner_ft.data.task.draw import Context, draw_template
from planner_ft.data.task.phrasebook import Phrasebook
from planner_ft.data.templates.records import Template, template_files, templates
from planner_ft.data.templates.render import plain
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.support.terminal import show
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level, plan_problems

DRAWS = 4


def checked_templates(
    vocabulary: Vocabulary, only: str = "", show: int = 0
) -> Iterator[tuple[Template, list[tuple[str, Any]], PlannerError | None]]:
    """Every template whose id begins with `only`, with draws as (text, plan), `show` at least where
    nothing is wrong, and what is wrong with it. Raises PlannerError for a file that is no template
    file.
    """
    for level, template, samples in _samples(vocabulary):
        if not template.id.startswith(only):
            continue
        drawn, error = list[tuple[str, Any]](), None
        try:
            drawn = list(itertools.islice(samples, max(DRAWS, show)))
            plans = (plan_problems(level, plan, vocabulary, strict=True) for _text, plan in drawn)
            problem = next(itertools.chain(*plans), "" if drawn else "comes to nothing")
            error = template.error(problem) if problem else None
        except PlannerError as found:
            error = found
        yield template, drawn, error


def _samples(vocabulary: Vocabulary) -> Iterator[tuple[Level, Template, Iterator[tuple[str, Any]]]]:
    """Every template with its level and its draws as (text, plan)."""
    if template_files(vocabulary, "commands"):
        sampler = MissionSampler(vocabulary, split=None)
        for command in itertools.chain(*sampler.groups):
            made = (sampler.compose([command], Random(seed)) for seed in range(40))
            yield "mission", command, ((plain(one.text), one.expected) for one in made)
        for clause in itertools.chain(*sampler.clauses):
            yield "mission", clause, _clauses(clause, sampler)
    book = Phrasebook(vocabulary, unseen=False)
    for prompt in itertools.chain(*templates(vocabulary, "prompts")):
        yield "task", prompt, _prompts(prompt, book)


def _clauses(clause: Template, sampler: MissionSampler) -> Iterator[tuple[str, Any]]:
    """Commands with the clause, where it fits one of one task."""
    for rng in map(Random, range(200)):
        command = sampler.compose([pick(sampler.short, rng)], rng, 1, only=clause)
        if command.clauses:
            yield plain(command.text), command.expected


def _prompts(prompt: Template, book: Phrasebook) -> Iterator[tuple[str, Any]]:
    names = titles(prompt, book.vocabulary)
    for seed in range(40):
        title = names[seed % len(names)]
        if bound := binding(prompt, title, book):
            context = Context(book, book.vocabulary.task[title], Random(seed))
            if drawn := draw_template(bound, context):
                yield plain(drawn.text), {"skill_sequence": drawn.steps}


def main(arguments: list[str] | None = None) -> int:
    """Exit status 1 where a template is wrong, 2 where a file cannot be read."""
    parser = argparse.ArgumentParser(description="Check the templates of a vehicle.")
    parser.add_argument("vocabulary", nargs="?", default="usv")
    parser.add_argument("--show", type=int, default=0, metavar="N", help="print N samples of each")
    parser.add_argument("--only", default="", metavar="ID", help="templates whose id begins so")
    options = parser.parse_args(arguments)
    wrong = total = 0
    try:
        vocabulary = load_vocabulary(options.vocabulary)
        for template, drawn, error in checked_templates(vocabulary, options.only, options.show):
            total += 1
            wrong += error is not None
            if error:
                show(str(error))
            for text, plan in drawn[: 0 if error else options.show]:
                show(f"{template.id}: {text}\n    {compact_json(plan)}")
    except PlannerError as error:
        show(str(error), error=True)
        return 2
    show(f"{total} templates, {wrong} wrong")
    return 1 if wrong else 0
