"""Check the templates of a vehicle: python -m planner_ft.data.templates [NAME] [--show N].

Prints what is wrong as FILE:LINE, and N samples of every template whose id begins with --only.
"""

from __future__ import annotations

import argparse
import itertools
import sys
from collections.abc import Iterator
from random import Random
from typing import Any

from planner_ft.data.missions import MissionSampler
from planner_ft.data.numbers import pick
from planner_ft.data.task.context import Context
from planner_ft.data.task.phrasebook import Phrasebook
from planner_ft.data.task.prompts.binding import binding, titles
from planner_ft.data.task.prompts.draw import draw_template
from planner_ft.data.templates.records import Template, template_files, templates
from planner_ft.data.templates.render import plain
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import Level, plan_problems

DRAWS = 4


def main(arguments: list[str] | None = None) -> int:
    """Exit status 1 where a template is wrong, 2 where a file cannot be read."""
    parser = argparse.ArgumentParser(description="Check the templates of a vehicle.")
    parser.add_argument("vocabulary", nargs="?", default="usv")
    parser.add_argument("--show", type=int, default=0, metavar="N", help="print N samples of each")
    parser.add_argument("--only", default="", metavar="ID", help="templates whose id begins so")
    options = parser.parse_args(arguments)
    wrong = total = 0
    try:
        for level, template, samples in _samples(options.vocabulary):
            if not template.id.startswith(options.only):
                continue
            total += 1
            vocabulary = load_vocabulary(options.vocabulary)
            try:
                drawn = list(itertools.islice(samples, max(DRAWS, options.show)))
                problems = [
                    problem
                    for _text, plan in drawn
                    for problem in plan_problems(level, plan, vocabulary, strict=True)
                ]
                if problems or not drawn:
                    raise template.error(problems[0] if problems else "comes to nothing")
            except PlannerError as error:
                wrong += 1
                print(error)
                continue
            for text, plan in drawn[: options.show]:
                print(f"{template.id}: {text}\n    {compact_json(plan)}")
    except PlannerError as error:
        print(error, file=sys.stderr)
        return 2
    print(f"{total} templates, {wrong} wrong")
    return 1 if wrong else 0


def _samples(name: str) -> Iterator[tuple[Level, Template, Iterator[tuple[str, Any]]]]:
    """Every template with its level and its draws as (text, plan)."""
    vocabulary = load_vocabulary(name)
    if template_files(vocabulary, "commands"):
        sampler = MissionSampler(vocabulary, split=None)
        for command in itertools.chain(*sampler.groups):
            draws = (
                (plain(text), plan)
                for seed in range(40)
                for text, plan in [sampler.draw(command, Random(seed))]
            )
            yield "mission", command, draws
        for clause in itertools.chain(*sampler.clauses):
            yield "mission", clause, _clauses(clause, sampler)
    book = Phrasebook(vocabulary, unseen=False)
    for prompt in itertools.chain(*templates(vocabulary, "prompts")):
        yield "task", prompt, _prompts(prompt, book)


def _clauses(clause: Template, sampler: MissionSampler) -> Iterator[tuple[str, Any]]:
    """Commands with the clause, where it fits one of one task."""
    for seed in range(200):
        rng = Random(seed)
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
                yield plain(drawn[0]), drawn[1]


if __name__ == "__main__":
    sys.exit(main())
