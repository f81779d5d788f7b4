"""What a command says of the order of its tasks and places."""

from __future__ import annotations

import pytest

from planner_ft.decoding.constraints.grounded_mission import read_told
from planner_ft.decoding.constraints.reading.missions.orders import read_orders
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.replay import START


@pytest.mark.parametrize(
    ("command", "pairs"),
    [
        (
            (
                "Contact 4 is to be shadowed, and ahead of the contact a panorama from [9, 9]."
                " Contact 4 to follow."
            ),
            {("HorizontalPanorama", "FollowTarget")},
        ),
        (
            "Send the log, but not until the sensors have been checked.",
            {("Diagnostics", "SmartDataHarvest")},
        ),
        (
            (
                "A report, though not until the panorama is through, and that one has to wait for"
                " the drift audit."
            ),
            {
                ("HorizontalPanorama", "AutoGenerateReportSummary"),
                ("DriftAudit", "HorizontalPanorama"),
            },
        ),
        ("Drift at [9, 9], then send the log.", set()),
        ("Before docking at [1, 1], a panorama or a drift, not both.", set()),
        ("Before you send the log, look at the dock gate.", set()),
    ],
)
def test_tasks_before_others(command: str, pairs: set[tuple[str, str]]) -> None:
    assert read_orders(command).titles == pairs


@pytest.mark.parametrize(
    ("command", "row"),
    [
        (
            "Stops at [5, 0], [25, 0] and [45, 0], the farthest from home first, a minute each.",
            [(45, 0), (25, 0), (5, 0)],
        ),
        (
            "Hold a minute at [25, 0], [5, 0] and [45, 0], starting with the nearest.",
            [(5, 0), (25, 0), (45, 0)],
        ),
        ("Survey [5, 10], [5, 30] and [5, 20] from north to south.", [(5, 30), (5, 20), (5, 10)]),
        ("Survey [5, 10], [5, 30] and [5, 20] in reverse order.", [(5, 20), (5, 30), (5, 10)]),
        (
            (
                "Circle the can at [5, 10] and the cone at [5, 30]; on the way from one to the"
                " other hold at [5, 20]."
            ),
            [(5, 10), (5, 20), (5, 30)],
        ),
        (
            "Point A is [5, 10], point B is [5, 30]. A panorama at B, a hold at A.",
            [(5, 30), (5, 10)],
        ),
        (
            "Do this from the bottom up:\n1. hold at [5, 10]\n2. drift at [5, 30]\n3. report",
            [(5, 30), (5, 10)],
        ),
        ("Survey [5, 10], [5, 30] and [5, 20].", []),
        ("Point A is [5, 10], point B is [5, 30]. A panorama at B, before it a hold at A.", []),
        ("A run from north to south along the pier at [5, 10], then hold at [5, 30].", []),
    ],
)
def test_places_in_another_row(command: str, row: list[tuple[float, float]]) -> None:
    pairs = read_orders(command).places
    assert pairs == {(one, two) for index, one in enumerate(row) for two in row[index + 1 :]}


def test_what_comes_later_may_not_stand_before() -> None:
    vocabulary = load_vocabulary()
    told = read_told("Send the log, but not until the sensors have been checked.")
    assert not told.allows("SmartDataHarvest", START)
    assert told.allows(
        "SmartDataHarvest", START.after(vocabulary.task["Diagnostics"], {}, vocabulary)
    )
    told = read_told(
        "Stops at [5, 0], [25, 0] and [45, 0], the farthest from home first, a minute each."
    )
    assert set(told.too_early(START)) == {(5, 0), (25, 0)}
    assert set(
        told.too_early(
            START.after(vocabulary.task["Transit"], {"target_position": [45, 0]}, vocabulary)
        )
    ) == {(5, 0)}
