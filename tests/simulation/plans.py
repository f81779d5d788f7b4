"""Plans that are simulated, made without a model."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from planner_ft.document import read_document, write_document
from planner_ft.review import approve, log_beside
from planner_ft.simulation.run import Simulated
from planner_ft.vocabulary import Vocabulary
from tests.documents import USV, document, step, task


def using(movement: dict[str, Any], filters: Any = (), perception: Any = ()) -> dict[str, Any]:
    """A step with more skills, given as (name, parameters); it names every failure mode."""
    parts = [
        [{"name": name, "parameters": given} for name, given in group]
        for group in (filters, perception)
    ]
    modes = [skill.failure for skill in USV.skills if skill.failure]
    return {
        **movement,
        "filter_skills": parts[0],
        "perception_skills": parts[1],
        "failure_modes": modes,
    }


def go(x: float, y: float, **more: Any) -> dict[str, Any]:
    return using(step("GoToXY", {"x": x, "y": y, **more}))


def transit(x: float, y: float, *steps: dict[str, Any]) -> dict[str, Any]:
    return task("Transit", {"target_position": [x, y]}, list(steps) or [go(x, y)])


def saved(
    folder: Path, tasks: Sequence[dict[str, Any]], vocabulary: Vocabulary = USV, **how: Any
) -> Path:
    """The file of an approved plan."""
    path = folder / "plan.json"
    write_document(path, document(tasks, vocabulary, **how))
    approve(read_document(path, vocabulary), log_beside(path), "Ada", ["all"])
    return path


def lines(done: Simulated, run: int = 1) -> list[dict[str, Any]]:
    """The log of a run as it was written."""
    path = done.settings.folder / f"run-{run:02d}.jsonl"
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
