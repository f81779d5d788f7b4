"""Numbers that are taken back."""

from __future__ import annotations

import pytest

from planner_ft.decoding.constraints.reading.corrected import read_corrections


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
