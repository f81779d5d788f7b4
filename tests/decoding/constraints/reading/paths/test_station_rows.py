"""Rows of stations and of lanes told by the first one, and lines that are run right over."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.decoding.constraints.reading.paths.station_rows import read_station_rows

Points = list[tuple[float, float]]


def record(prompt: str, **parameters: Any) -> dict[str, Any]:
    return {"task": "Transit", "parameters": parameters, "prompt": prompt}


@pytest.mark.parametrize(
    ("prompt", "path"),
    [
        (
            (
                "Three stations on a line: the first at [1, 2], each following one 20 m due east of"
                " the one before."
            ),
            [(1, 2), (21, 2), (41, 2)],
        ),
        (
            "Four sampling points, the first at [1, 2], the others at 15 m steps to the north.",
            [(1, 2), (1, 17), (1, 32), (1, 47)],
        ),
        (
            "Three stations in a row, 25 m apart, from [1, 2] on towards the west. Log at each.",
            [(1, 2), (-24, 2), (-49, 2)],
        ),
        (
            (
                "Three stations lie on one west-east line: the first at [1, 2], every next one 5 m"
                " farther east."
            ),
            [(1, 2), (6, 2), (11, 2)],
        ),
        (
            "Run from [0, 0] to [60, 0] with a waypoint every 20 m, start and end included.",
            [(0, 0), (20, 0), (40, 0), (60, 0)],
        ),
        (
            "Transect from [0, 0] to [0, 90], four stations evenly spaced, the two ends included.",
            [(0, 0), (0, 30), (0, 60), (0, 90)],
        ),
        (
            "Transect from [0, 0] to [0, 90] in two equal legs, a still at every waypoint.",
            [(0, 0), (0, 45), (0, 90)],
        ),
        (
            (
                "Two parallel lanes, 20 m apart. The first goes from [1, 2] north to [1, 50], the"
                " other lies east of it."
            ),
            [(1, 2), (1, 50), (21, 50), (21, 2)],
        ),
        (
            "The net lies between [0, 0] and [0, 80]. Run over the top of it, north end first.",
            [(0, 80), (0, 0)],
        ),
        ("Run the line from [0, 0] to [0, 80], beginning at the north end.", [(0, 80), (0, 0)]),
    ],
)
def test_rows(prompt: str, path: Points) -> None:
    assert read_station_rows(record(prompt)) == tuple(path)


@pytest.mark.parametrize(
    "prompt",
    [
        "Three stations, the first at [1, 2], each next one 20 m from the one before.",
        "Run from [0, 0] to [50, 0] with a waypoint every 20 m.",
        "Transect from [0, 0] to [0, 90], four stations evenly spaced between them.",
        "Three stations from [1, 2], 25 m apart to the east, then back to the first.",
        "The net lies between [0, 0] and [0, 80]. Run over the top of it, 5 m off.",
    ],
)
def test_what_is_not_clear_is_not_read(prompt: str) -> None:
    assert read_station_rows(record(prompt)) is None
