"""Geographic positions of a command in local metres, and as open places."""

from __future__ import annotations

import pytest

from planner_ft.planning.frame import agents_frame, doubt, frame_of, local_frame
from planner_ft.planning.locations import open_places
from planner_ft.support.geodesy import Origin
from planner_ft.vocabulary import load_vocabulary

USV = load_vocabulary()
KIEL = Origin(54.32, 10.14)
COMMAND = "Go to 54.3217 N, 10.1412 E and hold there for ten minutes."


@pytest.mark.parametrize(
    "words",
    [
        "54.3217 N, 10.1412 E",
        "54.3217, 10.1412",
        "N54.3217 E10.1412",
        "54°19'18.1\"N 10°08'28.3\"E",
        "54°19.302'N, 010°08.472'E",
        "lat 54.3217 lon 10.1412",
    ],
)
def test_a_position_is_converted_with_the_origin(words: str) -> None:
    frame = local_frame(f"Go to {words} and come home.", KIEL)
    (swap,) = frame.swaps
    assert swap.position == pytest.approx((78.1, 189.2), abs=1.5)
    assert frame.spoken == f"Go to {swap.written} and come home."


def test_a_place_in_brackets_keeps_them() -> None:
    spoken = local_frame("Survey the wreck (54.3217, 10.1412).", KIEL).spoken
    assert spoken == "Survey the wreck (78.1, 189.2)."


def test_spans_lead_back_to_the_words_as_they_were_typed() -> None:
    command = "First 54.3217 N, 10.1412 E, then 54.33 N, 10.15 E, 12 m off."
    frame = local_frame(command, KIEL)
    for words in ("First", "then", "12 m"):
        start = frame.spoken.index(words)
        first, last = frame.span(start, start + len(words))
        assert command[first:last] == words
    start = frame.spoken.index("78.1")
    first, last = frame.span(start, start + len("78.1, 189.2"))
    assert command[first:last] == "54.3217 N, 10.1412 E"


def test_without_an_origin_the_agents_are_told_a_placeholder_and_the_plan_has_none() -> None:
    frame = agents_frame(COMMAND + " Then [137, 94].", None)
    x, y = frame.swaps[0].position
    assert frame.spoken.startswith(f"Go to [{x:g}, {y:g}] and hold")
    assert (x, y) != (137, 94)
    transit = {
        "title": "Transit",
        "parameters": {"target_position": [x, y]},
        "task_prompt": f"Go to [{x:g}, {y:g}].",
    }
    plan = frame.restored({"tasks": [transit], "assumptions": [], "constraints": []}, USV)
    assert plan["tasks"][0]["parameters"]["target_position"] == [-99, -99]
    assert plan["tasks"][0]["task_prompt"] == "Go to 54.3217 N, 10.1412 E."
    (place,) = open_places(plan, USV)
    assert place.name == "54.3217 N, 10.1412 E"


def test_a_position_far_from_the_origin_stays_open_and_the_origin_is_doubted() -> None:
    turned = Origin(10.14, 54.32)
    assert "swapped" in str(doubt(COMMAND, turned))
    assert not agents_frame(COMMAND, turned).swaps[0].known
    assert frame_of({"command": COMMAND, "origin": {"latitude": 0, "longitude": 0}}).swaps == ()
    assert "Gulf" in str(doubt("", Origin(0, 0)))
    assert "right" in str(doubt(COMMAND, Origin(40, 10)))
    assert doubt(COMMAND, KIEL) is None


def test_commands_in_metres_are_left_alone() -> None:
    command = "Go to [40.25, 25.5], 12.345 m off, at 10:30."
    assert agents_frame(command, None).spoken == command
    assert local_frame(command, KIEL).spoken == command


@pytest.mark.parametrize(
    ("command", "spoken"),
    [
        ("To x = 12,5 m and y = 30,5 m.", "To x = 12.5 m and y = 30.5 m."),
        ("Fahre zu x = 12,5 und y = -40,5.", "Fahre zu x = 12.5 und y = -40.5."),
        ("Go to X 3,25 Y 4,75 and hold.", "Go to X 3.25 Y 4.75 and hold."),
        ("Go to x = 12, y = 40.", "Go to x = 12, y = 40."),
        ("Go to 12,5 and 40,5.", "Go to 12,5 and 40,5."),
    ],
)
def test_decimal_commas_behind_axes_are_points(command, spoken):
    frame = agents_frame(command, None)
    assert frame.spoken == spoken
    assert frame.span(3, 9) == (3, 9)
