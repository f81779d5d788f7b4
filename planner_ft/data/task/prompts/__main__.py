"""Check template files: python -m planner_ft.data.task.prompts FILE... [--show N]."""

from __future__ import annotations

import argparse
import random
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from planner_ft.data.task.context import Context
from planner_ft.data.task.phrasebook import Phrasebook
from planner_ft.data.task.prompts.binding import Bound, bind
from planner_ft.data.task.prompts.draw import draw_template
from planner_ft.data.task.prompts.language import TemplateError, parse_line
from planner_ft.data.task.prompts.library import FOLDER, numbered_lines, tasks_for
from planner_ft.data.templates.render import plain
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.definition import load_vocabulary
from planner_ft.vocabulary.plans import plan_problems

TRIES = 40


def main(arguments: list[str] | None = None) -> int:
    """Print what is wrong with each line, and how many lines are right; exit status 1 when one is
    wrong.
    """
    parser = argparse.ArgumentParser(
        prog="python -m planner_ft.data.task.prompts",
        description="Check template files and show samples of their lines.",
    )
    parser.add_argument(
        "files", nargs="*", type=Path, metavar="FILE", help="default: the files of the package"
    )
    parser.add_argument(
        "--show", type=int, default=0, metavar="N", help="print N samples of each line"
    )
    parser.add_argument("--vocabulary", default="usv")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(arguments)
    book = Phrasebook(load_vocabulary(options.vocabulary), unseen=False)
    rng = random.Random(options.seed)
    wrong = total = 0
    for path in options.files or sorted(FOLDER.glob("*.txt")):
        for number, source in numbered_lines(path):
            total += 1
            try:
                shown = list(_checked(source, book, rng, options.show))
            except TemplateError as error:
                wrong += 1
                print(f"{path}:{number}: {error}\n    {source}")
                continue
            for text in shown:
                print(f"{path.name}:{number}: {text}")
    print(f"{total} lines, {wrong} wrong")
    return 1 if wrong else 0


def _checked(source: str, book: Phrasebook, rng: random.Random, show: int) -> Iterator[str]:
    """Samples of the line. Raises TemplateError for what is wrong with it."""
    line = parse_line(source)
    unknown = [title for title in line.tasks if title != "*" and title not in book.vocabulary.task]
    if unknown:
        raise TemplateError(f"there is no task {unknown[0]}")
    bounds: list[Bound] = []
    for task in tasks_for(line, book.vocabulary):
        try:
            bounds.append(bind(line, task, book))
        except TemplateError:
            # Of "*" the tasks remain that have what the line needs.
            if "*" not in line.tasks:
                raise
    if not bounds:
        bind(line, tasks_for(line, book.vocabulary)[0], book)
    drawn = 0
    for index in range(TRIES):
        bound = bounds[index % len(bounds)]
        context = Context(book, bound.task, rng)
        found = draw_template(bound, context)
        if found is None:
            continue
        text, plan, _skills = found
        problems = plan_problems("task", plan, book.vocabulary, strict=True)
        if problems:
            raise TemplateError(f"makes a plan that is not valid: {problems[0]}")
        drawn += 1
        if drawn <= show:
            yield (
                f"[{bound.task.title}] {plain(text)}\n    {context.parameters()}\n    {brief(plan)}"
            )
    if drawn < TRIES / 2:
        raise TemplateError(
            "comes to nothing in most draws: a needed slot is optional, or a skill stands twice"
            " with the same parameters"
        )


def brief(plan: dict[str, Any]) -> str:
    """The plan on one line."""
    return "; ".join(
        " ".join(
            [
                _call(step["navigation_skill"]),
                *(f"+{_call(call)}" for call in step["filter_skills"]),
                *(f"&{_call(call)}" for call in step["perception_skills"]),
            ]
        )
        for step in plan["skill_sequence"]
    )


def _call(call: dict[str, Any]) -> str:
    return f"{call['name']}({', '.join(f'{name}={value}' for name, value in call['parameters'].items())})"


if __name__ == "__main__":
    try:
        sys.exit(main())
    except PlannerError as error:
        sys.exit(f"{error}")
