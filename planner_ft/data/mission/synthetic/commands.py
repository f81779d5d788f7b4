"""The check of files with commands written by hand as templates.

python -m planner_ft.data.mission.synthetic.commands FILE... [--show N] [--only LINE]
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from random import Random

from planner_ft.data.mission.synthetic.commands_check import FOLDER, Problem, read_templates
from planner_ft.data.mission.synthetic.commands_draw import draw_command
from planner_ft.data.mission.synthetic.commands_format import FormatError, Template
from planner_ft.data.mission.synthetic.numbers import draw_style
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import plan_problems

DRAWS = 40
"""A check draws every template so often."""


def file_problems(path: Path) -> tuple[list[Template], list[Problem]]:
    """The templates of a file and what is wrong with it, its plans included. Raises PlannerError
    when it cannot be read.
    """
    templates, problems = read_templates(path)
    vocabulary = load_vocabulary()
    for template in templates:
        found: dict[str, None] = {}
        for seed in range(DRAWS):
            rng = Random(seed)
            try:
                _, expected, _ = draw_command(template, rng, draw_style(rng))
                found |= dict.fromkeys(plan_problems("mission", expected, vocabulary, strict=True))
            except FormatError as error:
                found[str(error)] = None
        problems += [Problem(path, template.number, text) for text in found]
    return templates, sorted(problems, key=lambda problem: problem.number)


def shown(template: Template, count: int) -> str:
    """`count` samples of a template with their plans, as text."""
    lines = [f"--- {template.subject}:{template.number}"]
    for seed in range(count):
        rng = Random(f"{template.number} {seed}")
        text, expected, _ = draw_command(template, rng, draw_style(rng))
        lines.append(text)
        lines += [f"    {task['title']} {task['parameters']}" for task in expected["tasks"]]
        lines += [f"    - {line}" for line in (*expected["assumptions"], *expected["constraints"])]
    return "\n".join(lines)


def main(arguments: list[str] | None = None) -> int:
    """Check template files; exit status 1 where something is wrong, 2 where a file cannot be
    read.
    """
    parser = argparse.ArgumentParser(description="Check files of command templates.")
    parser.add_argument(
        "files", nargs="*", type=Path, help="files to check; the shipped ones without any"
    )
    parser.add_argument(
        "--show", type=int, default=0, metavar="N", help="print N samples of every template"
    )
    parser.add_argument("--only", type=int, metavar="LINE", help="show this line only")
    options = parser.parse_args(arguments)
    wrong = 0
    try:
        for path in options.files or sorted(FOLDER.glob("*.txt")):
            templates, problems = file_problems(path)
            bad = {problem.number for problem in problems}
            for template in templates:
                if (
                    options.show
                    and template.number not in bad
                    and options.only in (None, template.number)
                ):
                    print(shown(template, options.show))
            for problem in problems:
                print(problem)
            print(f"{path}: {len(templates)} templates, {len(problems)} problems")
            wrong += len(problems)
    except PlannerError as error:
        print(error, file=sys.stderr)
        return 2
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
