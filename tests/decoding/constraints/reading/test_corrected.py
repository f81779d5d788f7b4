"""Numbers that are taken back."""

from __future__ import annotations

import pytest

from planner_ft.decoding.constraints.reading.corrected import as_corrected, read_corrections


@pytest.mark.parametrize(
    ("text", "taken_back", "instead"),
    [
        ("Float for two minutes. Scratch that: three and a half.", {120}, {210}),
        ("Hold 20 seconds, no, make that 30 seconds.", {20}, set()),
        ("Ten metres off, correction, 12 metres off.", {10}, set()),
        ("Threshold 60, and not 55 as I told you.", {55}, set()),
        ("8 m clearance, sorry, make it 9.", {8}, {9}),
        ("Hold 20 seconds, no, 30 seconds, then 20 seconds more.", set(), set()),
        ("Heading 45, wait 30 seconds, then heading 90.", set(), set()),
        ("Not nearer than 5 m, hold 30 s.", set(), set()),
        ("Go 20 m. No wait there, hold for 30 seconds at the second one.", set(), set()),
    ],
)
def test_the_first_number_goes(text: str, taken_back: set[float], instead: set[float]) -> None:
    found = read_corrections(text)
    assert (found.taken_back, found.instead) == (taken_back, instead)


@pytest.mark.parametrize(
    ("text", "corrected"),
    [
        ("Go to [4, 8] - no wait, sorry, [8, 4] - and hold.", "Go to [8, 4] - and hold."),
        ("Go to (4, 8), not (8, 4), and hold.", "Go to (4, 8), and hold."),
        ("Proceed to [7, 5], I say again [7, 5], yaw 45.", "Proceed to [7, 5], yaw 45."),
        ("Turn to 100, I mean 120, and wait.", "Turn to 120, and wait."),
        ("Turn to north, no, make it north-east.", "Turn to north-east."),
        ("Ten degrees to port, sorry, starboard.", "Ten degrees to starboard."),
        (
            "Float for two minutes. Scratch that: three and a half.",
            "Float for three and a half minutes.",
        ),
        (
            "Hold within 5 m, correction, 8 m, for ten seconds, or rather twenty seconds.",
            "Hold within 8 m, for twenty seconds.",
        ),
        ("Radius 16 metres - oh, I mean 6 - and stay.", "Radius 6 metres - and stay."),
    ],
)
def test_what_is_taken_back_is_not_said(text: str, corrected: str) -> None:
    assert as_corrected(text) == corrected


@pytest.mark.parametrize(
    "text",
    [
        "Go to [1, 2]. No sensors. Then [3, 4].",
        "Turn to 090, no need to wait, then 180.",
        "Heading 270, no wait; heading 180, wait one minute.",
        "Hold 20 seconds, then 30 seconds.",
        "10 degrees to port, then starboard again.",
        "Hold 5 minutes, no longer than 8 minutes.",
    ],
)
def test_what_is_not_taken_back_stays(text: str) -> None:
    assert as_corrected(text) == text
