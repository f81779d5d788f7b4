"""Places off home written out as coordinates, prompts in capitals, and units."""

from __future__ import annotations

import pytest

from planner_ft.data.stated import stated_numbers
from planner_ft.decoding.constraints.reading.paths.written_out import written_out
from planner_ft.decoding.constraints.reading.telegrams import in_small_letters
from planner_ft.decoding.constraints.waypoints import read_ground
from planner_ft.vocabulary import load_vocabulary


@pytest.mark.parametrize(
    ("prompt", "text"),
    [
        ("Go to a point 1.5 km west and 2,000 ft north of home.", "Go to a point (-1500, 609.6)."),
        (
            "Head a tenth of a nautical mile due south of home, slowly.",
            "Head to (0, -185.2), slowly.",
        ),
        ("Go to the spot 300 m north of home and 50 m east of it.", "Go to the spot (50, 300)."),
        ("The raft is 30 m east of home: go there.", "The raft : go to (30, 0)."),
        ("Go 30 m east of the buoy at (4, 5).", "Go 30 m east of the buoy at (4, 5)."),
    ],
)
def test_places_off_home(prompt: str, text: str) -> None:
    assert written_out(prompt, (0, 0)) == text


def test_a_place_off_home_is_no_way_home() -> None:
    record = {
        "task": "Transit",
        "parameters": {"target_position": [200, -100]},
        "prompt": "Shift 0.2 km east and 100 m south of home, and log the depth there.",
    }
    assert read_ground(record, load_vocabulary()).itinerary == ((200, -100),)


@pytest.mark.parametrize(
    ("prompt", "text"),
    [
        ("GO TO (4, 5) STOP HOLD 30 S STOP NO REPLY STOP", "go to (4, 5). hold 30 s. no reply."),
        ("DRIVE TO 10 E 20 S STOP STORE CAM_2 PICTURE", "drive to 10 E 20 S. store CAM_2 picture"),
        (
            "GO TO A = [1, 2], B = [3, 4] AND THEN STOP FOR 20 SECONDS",
            "go to A = [1, 2], B = [3, 4] and then stop for 20 seconds",
        ),
        ("Go to A and STOP there", "Go to A and STOP there"),
    ],
)
def test_capitals_are_read_as_small_letters(prompt: str, text: str) -> None:
    assert in_small_letters(prompt) == text


def test_units() -> None:
    assert stated_numbers("Drift for 3 h 10 min.", "s") == {11400}
    assert 60 in stated_numbers("Drift for 2 hours and one minute.", "s")
    assert 33.75 in stated_numbers("Turn three points to port.", "deg")
    assert any(
        value == pytest.approx(18.288) for value in stated_numbers("Keep ten fathoms off.", "m")
    )
