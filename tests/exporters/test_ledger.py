"""The accounting: everything that a plan says is carried or lost."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import given, settings

from planner_ft.exporters import Ledger
from planner_ft.exporters.ledger import NO_PLACE

from .plans import BUOY, DRONE, MAST, USV, document, documents, step, task

NOT_SAID = (
    "format",
    "version",
    "vocabulary",
    "ontology",
    "valid",
    "complete",
    "output",
    "estimate",
    "edits",
    "proposed",
    "usage",
    "peak_memory_bytes",
    "manifest",
    "digest",
    "id",
    "sources",
)
ONE = ("parameters", "vehicle", "located")


def leaves(value: Any, path: tuple[str | int, ...] = ()) -> Iterator[tuple[str | int, ...]]:
    """Every value of a document that a person or vehicle would miss, found without the ledger's own
    walk.
    """
    entry = path[:1] in (("warnings",), ("open_places",)) and len(path) == 2
    whole = entry or path[-2:-1] in [(key,) for key in ONE]
    if whole or not isinstance(value, dict | list):
        if value is not None:
            yield path
    elif isinstance(value, dict):
        for key, item in value.items():
            if key not in NOT_SAID or path[-1:] in [(key,) for key in ONE]:
                yield from leaves(item, (*path, key))
    else:
        for index, item in enumerate(value):
            yield from leaves(item, (*path, index))


@pytest.mark.parametrize("vocabulary", [USV, DRONE], ids=lambda vocabulary: vocabulary.name)
def test_a_ledger_lists_everything_that_a_plan_says(vocabulary: Any) -> None:
    @settings(max_examples=60)
    @given(documents(vocabulary))
    def check(plan: dict[str, Any]) -> None:
        assert set(Ledger(plan).items) == set(leaves(plan))

    check()


def test_what_is_never_mentioned_is_lost() -> None:
    account = Ledger(document(MAST)).close()
    assert not account.carried and account.lost_paths == set(Ledger(document(MAST)).items)
    assert {loss.why for loss in account.lost} == {NO_PLACE}


def test_a_path_stands_for_what_lies_below_and_carrying_wins() -> None:
    ledger = Ledger(document(MAST))
    ledger.carry("tasks", 0, "skill_sequence")
    ledger.lose("tasks", 0, why="no reason")
    account = ledger.close()
    assert (
        "tasks",
        0,
        "skill_sequence",
        0,
        "navigation_skill",
        "parameters",
        "yaw",
    ) in account.carried
    assert ("tasks", 0, "title") in account.lost_paths
    assert not account.carried & account.lost_paths


def test_what_the_plan_does_not_say_cannot_be_carried() -> None:
    with pytest.raises(KeyError):
        Ledger(document(MAST)).carry("tasks", 99)


def test_losses_say_task_and_steps() -> None:
    steps = [
        step("GoToXY", {"x": x, "y": 0}, perception=[("GetSeabedDepth", {})])
        for x in (1, 2, 3, 4, 5)
    ]
    del steps[3]["perception_skills"][0]
    told = (
        Ledger(document([task("Transit", {"target_position": [5, 0]}, steps)]))
        .close("no sonar")
        .lost
    )
    assert "GetSeabedDepth (steps 1-3, 5)" in next(
        loss for loss in told if loss.task == "t1"
    ).what.split("; ")


def test_an_open_place_is_told() -> None:
    told = {loss.what for loss in Ledger(document(BUOY)).close().lost}
    assert any("open place: green buoy" in what for what in told)
    assert any("waits for: green buoy" in what for what in told)
