"""Headings from one to another in steps, reciprocals of what was said, titles before the
movements.
"""

from __future__ import annotations

import pytest

from planner_ft.decoding.constraints.reading.paths.chains import chain_in_places
from planner_ft.decoding.constraints.reading.rows.sequence import read_sequence
from planner_ft.decoding.constraints.reading.rows.turns import read_turns
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()


@pytest.mark.parametrize(
    ("prompt", "headings"),
    [
        (
            (
                "Begin facing 120 and work anticlockwise through east to 030, turning to a heading"
                " every 30 degrees."
            ),
            [120, 90, 60, 30],
        ),
        (
            "Turn clockwise from 300 to 060, stopping at a heading every 40 degrees.",
            [300, 340, 20, 60],
        ),
        ("Start on 180 and go counter-clockwise to 060 in steps of 60 degrees.", [180, 120, 60]),
        ("Turn clockwise from 300 to 060, stopping at a heading every 50 degrees.", None),
        (
            "Face 020, then the reciprocal of that, then 110, then the reciprocal of that one.",
            [20, 200, 110, 290],
        ),
        ("Face 020, hold for a minute, then face the reciprocal of that.", [20, 200]),
        ("Compass check: face 020, then 110.", [20, 110]),
    ],
)
def test_headings(prompt: str, headings: list[float] | None) -> None:
    turns = read_turns({"prompt": prompt, "parameters": {}}, VOCABULARY)
    assert turns == (tuple(("RotateToHeading", value) for value in headings) if headings else None)


def test_motoring_out_is_no_drift() -> None:
    found = read_sequence(
        {
            "task": "Transit",
            "parameters": {},
            "prompt": "Motor out to [5, 9], then hold for a minute.",
        },
        VOCABULARY,
    )
    assert found is not None
    assert [one.name for one in found] == ["GoToXY", "StationKeep"]


@pytest.mark.parametrize(
    ("prompt", "places"),
    [
        (
            "From home steam 300 m north, then 200 m east, then hold for a minute.",
            "go to (0, 300), then go to (200, 300), then hold for a minute.",
        ),
        (
            "Go to [5, 5], then run 20 m south and hold there.",
            "go to (5, 5), then go to (5, -15) and hold there.",
        ),
        ("Go to [5, 5] and hold there.", None),
    ],
)
def test_legs_as_places(prompt: str, places: str | None) -> None:
    assert chain_in_places({"prompt": prompt, "parameters": {}}, (0, 0)) == places
