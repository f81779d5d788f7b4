"""The list of candidates as data: size, licence, memory, and where each lies or how to get it."""

from __future__ import annotations

from typing import Any

from planner_ft.candidates.loading import download_command, how_to_get
from planner_ft.candidates.location import check_folder
from planner_ft.candidates.memory import memory_summary
from planner_ft.candidates.registry import Candidate
from planner_ft.support.errors import PlannerError

FIELDS = ("name", "repo", "parameters", "chat", "licence", "gated", "vocabulary")


def describe(candidate: Candidate) -> dict[str, Any]:
    """One row of `plannerft candidates` as JSON values.

    `memory` is in GiB, None where the dimensions are unknown. `here` is true when the files are
    complete; else `problem` or `get` says the way out, and `command` downloads it.
    """
    missing, problem = candidate.folder is None, None
    if candidate.folder is not None:
        try:
            check_folder(candidate.folder)
        except PlannerError as error:
            problem = str(error)
    return {
        **{name: getattr(candidate, name) for name in FIELDS},
        "row": candidate.row_name,
        "standin": candidate.is_standin,
        "memory": memory_summary(candidate),
        "here": not missing and problem is None,
        "folder": None if missing else str(candidate.folder),
        "source": candidate.source,
        "problem": problem,
        "get": how_to_get(candidate) if missing else None,
        "command": download_command(candidate) if missing else None,
    }
