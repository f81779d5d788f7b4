"""Ways and movements told by way of others, and values told by a parameter's name."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.decoding.constraints.reading.told_otherwise import told_plainly
from planner_ft.decoding.constraints.reading.values.own_values import in_figures


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("Go to [9, 4] via [3, 2].", "Go to [3, 2], then go to [9, 4]."),
        (
            "Proceed to the target position by way of the light at [3, 2].",
            "Proceed to the light at [3, 2], then go to the target position.",
        ),
        (
            "Sail to [9, 4] via [3, 2] and [5, 2], then hold.",
            "Sail to [3, 2] and [5, 2], then go to [9, 4], then hold.",
        ),
        ("Head home by way of [3, 2].", "Head to [3, 2], then go home."),
        (
            "Return to the goal position, passing through [3, 2] on the way.",
            "Go to [3, 2], then go to the goal position.",
        ),
        (
            "Via the beacon at [3, 2] head for [9, 4].",
            "go to the beacon at [3, 2], then head for [9, 4].",
        ),
        ("Go to [9, 4] and hold there.", "Go to [9, 4] and hold there."),
        ("Go to [9, 4] past [3, 2].", "Go to [9, 4] past [3, 2]."),
    ],
)
def test_ways_over_other_places(said: str, plain: str) -> None:
    assert told_plainly(said, {}) == plain


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("Go to x 0.2 km, y minus 0.05 km.", "Go to [200, -50]."),
        ("Go to x = 1.5 km and y = 0.", "Go to [1500, 0]."),
        ("Proceed to x one-four, y minus six, then hold.", "Proceed to [14, -6], then hold."),
        (
            "Proceed to one-four, minus six, I say again, one-four, minus six.",
            "Proceed to [14, -6].",
        ),
        (
            "Proceed to one-four, minus six, then hold three-zero seconds.",
            "Proceed to [14, -6], then hold 30 seconds.",
        ),
        ("Turn to one-two-zero, zero-four-five.", "Turn to one-two-zero, zero-four-five."),
        ("Go to x 14, y 6.", "Go to x 14, y 6."),
    ],
)
def test_coordinates(said: str, plain: str) -> None:
    assert told_plainly(said, {}) == plain


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        (
            "Go to [3, 2], drift for a minute, then return to where the drift began.",
            "Go to [3, 2], drift for a minute, then return to [3, 2].",
        ),
        (
            (
                "Two drifts of a minute each, the first from [3, 2] and the second from [9, 2];"
                " motor to each start first."
            ),
            "go to [3, 2], drift for a minute, go to [9, 2], drift for a minute.",
        ),
        (
            "Two points off the pier: [3, 2] and [9, 2]. Hold for a minute at each.",
            "Go to [3, 2] and [9, 2]. Hold for a minute at each.",
        ),
        ("Three points off the pier: [3, 2] and [9, 2]. Hold for a minute at each.", None),
        ("Two points off the pier: [3, 2] and [9, 2]. Go to the second one.", None),
        ("Visit only two points: [3, 2] and [9, 2].", "Go to [3, 2] and [9, 2]."),
        ("Go to the midpoint between [0, 0] and [8, 4].", "Go to [4, 2]."),
        ("Drift, then go to where the drift began.", None),
    ],
)
def test_places_of_movements(said: str, plain: str | None) -> None:
    assert told_plainly(said, {}) == (plain or said)


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        (
            "A half circle to port on a 9 m radius, then the same to starboard.",
            (
                "A half circle to port on a 9 m radius, then a half circle to starboard on a 9 m"
                " radius."
            ),
        ),
        (
            (
                "Hold for a minute, then make an arc of 90 degrees clockwise, radius 12 m, the same"
                " again the other way."
            ),
            (
                "Hold for a minute, then make an arc of 90 degrees clockwise, radius 12 m, then"
                " make an arc of 90 degrees anticlockwise, radius 12 m."
            ),
        ),
        ("Pan 20 degrees to port, then the same to starboard.", None),
        ("Go to [1, 2]. Finish with the bow facing east.", "Go to [1, 2]. Then turn to east."),
        (
            "Go to [1, 2], then [3, 4]. Before you go to the first point, wait until steady.",
            "First wait until steady. Go to [1, 2], then [3, 4].",
        ),
        (
            "Drift for the duration, the old figure of five minutes is obsolete.",
            "Drift for the duration .",
        ),
        ("The old figure of five minutes stands.", None),
        ("Run two cables north (a cable is 185 metres).", "Run two cables north."),
    ],
)
def test_movements_again(said: str, plain: str | None) -> None:
    assert told_plainly(said, {}) == (plain or said)


@pytest.mark.parametrize(
    ("said", "plain", "parameters"),
    [
        (
            "Turn half the scan width to port.",
            "Turn 40 degrees to port.",
            {"scan_width_degrees": 80},
        ),
        (
            "Pan to starboard by half of the given width.",
            "Pan to starboard by 40 degrees.",
            {"scan_width_degrees": 80},
        ),
        (
            "Pan half the scan width left, then half of it back to the right.",
            "Pan 40 degrees left, then 40 degrees back to the right.",
            {"scan_width_degrees": 80},
        ),
        ("Thermal statistics over the whole scan width, please.", None, {"scan_width_degrees": 80}),
        (
            "Go to the point the given radius due north of the target position.",
            "Go to [5, 17].",
            {"target_position": [5, 5], "radius": 12},
        ),
        (
            "Visit the points the given radius east and west of the target position.",
            "Visit [17, 5] and [-7, 5].",
            {"target_position": [5, 5], "radius": 12},
        ),
        (
            "Go 12 m north of [3, 3].",
            "Go 12 m north of [3, 3].",
            {"target_position": [5, 5], "radius": 12},
        ),
        ("The spacing in the form is too fine, make it 20.", "spacing 20 m.", {"spacing": 10}),
        (
            "Run the grid with a spacing of 20 m instead of 10.",
            "Run the grid with a spacing of 20 m.",
            {"spacing": 10},
        ),
        (
            "Survey square with 9 m as the radius instead of the one given.",
            "Survey square with a radius of 9 m.",
            {"radius": 12},
        ),
        ("Run the grid at double the spacing.", "Run the grid at spacing 20 m.", {"spacing": 10}),
        ("Hold within a radius of 5 m.", "Hold within a radius of 5 m.", {"duration": 10}),
    ],
)
def test_values_told_by_name(said: str, plain: str | None, parameters: dict[str, Any]) -> None:
    assert in_figures(said, parameters) == (plain or said)
