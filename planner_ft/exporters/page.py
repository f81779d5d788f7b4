"""Export from the page of a review: the formats there are, and the files of an approved plan."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Any

from planner_ft.exporters.formats import known_formats, load_format
from planner_ft.exporters.run import PlanExportSettings, export_plan, loss_lines, stop_words
from planner_ft.support.errors import PlannerError
from planner_ft.support.geodesy import parse_origin


@functools.cache
def formats() -> list[dict[str, Any]]:
    """Name, description and extension of every format, and whether it needs an origin."""
    found = []
    for name in known_formats():
        try:
            one = load_format(name)
        except PlannerError:
            continue  # a format of somebody's own that does not load: the terminal says why
        about = {"description": one.description, "extension": one.extension}
        found.append({"name": name, **about, "needs_origin": one.needs_origin})
    return found


def hand_over(
    plan: Path, log: Path, names: list[str], origin: str, *, overwrite: bool, sure: bool
) -> list[dict[str, Any]]:
    """Write an approved plan in these formats; `sure`: a doubtful origin is right all the same.

    Raises QuestionError and PlannerError as `export_plan`.
    """
    place = parse_origin(origin) if origin.strip() else None
    settings = PlanExportSettings(
        plan, tuple(names), place, log=log, overwrite=overwrite, sure=sure
    )
    return [
        {
            "format": done.format.name,
            "file": done.file.name,
            "report": done.report.name,
            "text": done.file.read_text(encoding="utf-8"),
            "stops": stop_words(done.account),
            "lines": list(loss_lines(done.account)),
        }
        for done in export_plan(settings)
    ]
