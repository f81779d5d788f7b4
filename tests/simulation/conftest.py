"""A fixture that simulates plans."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest

from planner_ft.simulation import output
from planner_ft.simulation.run import Simulated, SimulationSettings, simulate
from planner_ft.vocabulary import Vocabulary
from tests.documents import USV

from .plans import saved

Run = Callable[..., Simulated]


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """Simulates tasks in two runs, without the picture, which takes half the time."""
    monkeypatch.setattr(output, "track_svg", lambda _done: "<svg/>")

    def running(
        tasks: Sequence[dict[str, Any]],
        vocabulary: Vocabulary = USV,
        how: dict[str, Any] | None = None,
        **settings: Any,
    ) -> Simulated:
        path = saved(tmp_path, tasks, vocabulary, **(how or {}))
        given = {"runs": 2, "mcap": 0, "overwrite": True, **settings}
        return simulate(SimulationSettings(path, **given))

    return running
