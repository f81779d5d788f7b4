"""What the corpus is made of."""

from __future__ import annotations

import itertools
from collections import Counter
from pathlib import Path

import pytest

from planner_ft.document.own_vehicle import new_vehicle
from planner_ft.pretraining.corpus import Mixture, stream
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary

USV = load_vocabulary()


def test_missions_of_other_vehicles_come_in_their_share_and_with_their_own_titles(
    tmp_path: Path,
) -> None:
    for name in ("mole", "heron"):
        new_vehicle(name, tmp_path / name)
    mixture = Mixture(missions=0.8, vehicles=0.5, folder=tmp_path)
    drawn = Counter[tuple[str, str]]()
    for level, record, vehicle in itertools.islice(stream(USV, 3, mixture), 300):
        drawn[vehicle.name, level] += 1
        if level == "mission":
            titles = {task["title"] for task in record["expected"]["tasks"]}
            assert titles <= {task.title for task in vehicle.tasks}
    assert drawn["mole", "task"] == drawn["heron", "task"] == 0
    assert min(drawn["mole", "mission"], drawn["heron", "mission"]) > 40
    assert 90 < drawn["usv", "mission"] < 150  # 120 expected


def test_a_folder_without_vehicles_is_named(tmp_path: Path) -> None:
    mixture = Mixture(vehicles=0.5, folder=tmp_path / "none")
    with pytest.raises(PlannerError, match="none: no vehicles"):
        next(stream(USV, 3, mixture))
