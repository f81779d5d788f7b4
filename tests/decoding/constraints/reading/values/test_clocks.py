"""Durations told by the clock."""

from __future__ import annotations

import pytest

from planner_ft.decoding.constraints.reading.values.clocks import with_durations


@pytest.mark.parametrize(
    ("prompt", "read"),
    [
        ("It is 14:10 now. Hold until 14:52.", "Hold for 42 minutes."),
        ("Time now is 0905 hours, drift until 0920.", "drift for 15 minutes."),
        ("Hold from 09:00 to 09:20.", "Hold for 20 minutes."),
        ("It's 23:50; stay until 00:10.", "stay for 20 minutes."),
        ("Hold until 14:52.", "Hold until 14:52."),
        ("Run from 1200 to 1400 m.", "Run from 1200 to 1400 m."),
    ],
)
def test_times_of_day(prompt: str, read: str) -> None:
    assert with_durations(prompt) == read
