"""What people say beside their orders."""

from __future__ import annotations

import pytest

from planner_ft.decoding.constraints.reading.rows import turn_forms as f
from planner_ft.decoding.constraints.reading.rows.asides import without_asides
from planner_ft.decoding.constraints.reading.values.clocks import without_clock_times


def left(prompt: str) -> str:
    """What is left of a text, without marks and spaces at its ends."""
    return without_asides(f.plain(prompt, {}, measured=True)).strip(" .,;")


@pytest.mark.parametrize(
    "aside",
    [
        "The tug comes in twenty minutes",
        "Our divers are back aboard at five",
        "Wind is from the left and rising",
        "It is still raining",
        "Yesterday the other boat drifted half an hour",
        "We had fifteen knots last week",
        "You are pointing north at the moment",
        "Did anybody see the dog?",
        "The ferry leaves at 16:40",
    ],
)
def test_what_is_about_something_else_is_taken_out(aside: str) -> None:
    assert left(f"{aside}. Hold for a minute.") == "hold for T60"
    assert left(f"Hold for a minute. {aside}.") == "hold for T60"


@pytest.mark.parametrize(
    ("prompt", "rest"),
    [
        ("Hold for a minute, would you, so that the crew can eat.", "hold for T60"),
        ("Hold for a minute so Anna can take her sample, then drift.", "hold for T60 , then drift"),
        ("Hold for a minute for the divers.", "hold for T60"),
        ("Hold for a minute while we bring the line ashore.", "hold for T60"),
        ("Hold for a minute until the pilot waves.", "hold for T60"),
        (
            "Tug outbound, I say again tug outbound. Hold for a minute.",
            "tug outbound. hold for T60",
        ),
    ],
)
def test_courtesies_and_purposes_are_taken_out(prompt: str, rest: str) -> None:
    assert left(prompt) == rest


@pytest.mark.parametrize(
    "order",
    [
        "The pilot boat is at [4, 5]",
        "The crew has to be kept in the picture, hold",
        "As yesterday, hold for a minute",
        "You are to turn to 90",
        "Hold so that you face 90",
        "Wait until she is steady",
    ],
)
def test_what_may_be_an_order_stays(order: str) -> None:
    text = f.plain(order, {}, measured=True)
    assert any(word in without_asides(text) for word in (" P", "hold", "turn", "home", "until she"))
    assert len(without_asides(text)) > len(text) / 2


def test_times_of_day() -> None:
    assert (
        without_clock_times("Ferry at 09:15, lost since 1840.")
        == "Ferry at clocktime, lost since clocktime."
    )
    assert (
        without_clock_times("Turn to 090, then go to [1840, 5].")
        == "Turn to 090, then go to [1840, 5]."
    )
