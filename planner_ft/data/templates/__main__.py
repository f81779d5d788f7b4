"""Check the templates of a vehicle: python -m planner_ft.data.templates [NAME] [--show N].

Prints what is wrong as FILE:LINE, and N samples of every template whose id begins with --only.
"""

from __future__ import annotations

import argparse
import sys

from planner_ft.data.templates.checking import checked_templates
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.support.terminal import show
from planner_ft.vocabulary import load_vocabulary


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


if __name__ == "__main__":
    sys.exit(main())
