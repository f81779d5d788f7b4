"""Waypoints on a circle: what is read of them, and what is left to the model."""

import pytest

from planner_ft.decoding.constraints.reading.paths.rings import read_ring


def ring(prompt, pattern="orbit", **parameters):
    return read_ring(
        {"prompt": prompt, "parameters": {"center": [10, 20], "radius": 10, **parameters}},
        pattern,
        (10, 20),
    )


NORTH, EAST, SOUTH, WEST = (10, 30), (20, 20), (10, 10), (0, 20)


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        (
            "Four points at the radius from the middle: due east of it, north, west, south.",
            (EAST, NORTH, WEST, SOUTH),
        ),
        (
            "Round the centre: west point, north, east, then south, at the radius.",
            (WEST, NORTH, EAST, SOUTH),
        ),
        (
            "Four waypoints evenly round the centre, the first one due north, clockwise.",
            (NORTH, EAST, SOUTH, WEST),
        ),
        (
            "Four stops, one every 90 degrees, on the circle. Begin due east, counter-clockwise.",
            (EAST, NORTH, WEST, SOUTH),
        ),
        (
            "Circle of four waypoints, south first, anticlockwise; close the ring.",
            (SOUTH, EAST, NORTH, WEST, SOUTH),
        ),
        (
            "Circle of four waypoints, south first, anticlockwise; do not close the ring.",
            (SOUTH, EAST, NORTH, WEST),
        ),
        (
            "A ring of four waypoints round [50, 60], 5 m out, starting north, clockwise.",
            ((50, 65), (55, 60), (50, 55), (45, 60)),
        ),
    ],
)
def test_rings_that_are_told_whole(prompt, expected):
    assert ring(prompt) == expected


@pytest.mark.parametrize(
    "prompt",
    [
        "Four waypoints evenly round the centre, clockwise.",
        "Four waypoints evenly round the centre, the first one due north.",
        "Waypoints evenly round the centre, the first one due north, clockwise.",
        "Four waypoints evenly round the centre, due north first, clockwise, then home.",
        "Go to [3, 4], then four waypoints evenly round the centre, due north first, clockwise.",
        (
            "Four waypoints evenly round the centre, due north first, clockwise, at 12 m and then"
            " at 15 m."
        ),
        "Two arcs round the centre, north to east, clockwise.",
    ],
)
def test_what_is_not_told_is_left_free(prompt):
    assert ring(prompt) is None


def test_stops_round_a_survey_target_are_its_square():
    assert ring("Go round the target, eight stops, south-west first, clockwise.", "square") is None
    assert ring(
        "Four stops evenly on a circle round the target, east first, clockwise.", "square"
    ) == (EAST, SOUTH, WEST, NORTH)
