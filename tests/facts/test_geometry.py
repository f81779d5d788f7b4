"""Waypoints against cases computed by hand."""

import pytest

from planner_ft.facts import geometry as g


def test_survey_square_starts_mid_east_and_runs_counter_clockwise():
    assert g.survey_square((10, 20), 5) == [
        (15, 20),
        (15, 25),
        (10, 25),
        (5, 25),
        (5, 20),
        (5, 15),
        (10, 15),
        (15, 15),
    ]


def test_survey_square_clockwise_from_the_north_west_corner():
    assert g.survey_square((0, 0), 8, "north-west", clockwise=True)[:4] == [
        (-8, 8),
        (0, 8),
        (8, 8),
        (8, 0),
    ]


def test_lawnmower_twenty_by_twenty_at_five_metres_has_ten_waypoints_from_the_south_west():
    points = g.lawnmower((0, 0), 20, 20, 5)
    assert points == [
        (-10, -10),
        (-10, 10),
        (-5, 10),
        (-5, -10),
        (0, -10),
        (0, 10),
        (5, 10),
        (5, -10),
        (10, -10),
        (10, 10),
    ]


@pytest.mark.parametrize(
    ("corner", "axis", "expected"),
    [
        ("north-west", "y", [(0, 10), (0, 0), (5, 0), (5, 10), (10, 10), (10, 0)]),
        ("south-east", "y", [(10, 0), (10, 10), (5, 10), (5, 0), (0, 0), (0, 10)]),
        ("south-west", "x", [(0, 0), (10, 0), (10, 5), (0, 5), (0, 10), (10, 10)]),
        ("north-east", "x", [(10, 10), (0, 10), (0, 5), (10, 5), (10, 0), (0, 0)]),
    ],
)
def test_lawnmower_from_other_corners_and_along_x(corner, axis, expected):
    assert g.lawnmower((5, 5), 10, 10, 5, corner, axis) == expected


def test_lawnmower_width_lies_along_x():
    points = g.lawnmower((100, 50), 12, 40, 6)
    assert points == [(94, 30), (94, 70), (100, 70), (100, 30), (106, 30), (106, 70)]


def test_lawnmower_refuses_a_spacing_that_does_not_fill_the_area():
    with pytest.raises(ValueError, match="do not fill"):
        g.lawnmower((0, 0), 20, 20, 6)
    assert g.lane_count(20, 2.5) == 9


def test_line_follows_the_compass():
    assert g.straight_line((10, 0), 90, 40) == [(10, 0), (50, 0)]
    assert g.straight_line((0, 0), 225, 100) == [(0, 0), (-70.71, -70.71)]
    assert g.straight_line((0, 0), 30, 20) == [(0, 0), (10, 17.32)]


def test_circle_points_from_a_bearing_on():
    assert g.circle((0, 0), 10, 4, 90, clockwise=False) == [(10, 0), (0, 10), (-10, 0), (0, -10)]
    assert g.circle((5, 5), 10, 4, 0, clockwise=True) == [(5, 15), (15, 5), (5, -5), (-5, 5)]


def test_sector_headings():
    assert g.sector_headings(6) == [0, 60, 120, 180, 240, 300]
    assert g.sector_headings(4, 45, clockwise=False) == [45, 315, 225, 135]


def test_a_circle_goes_the_way_that_is_asked_for_and_headings_too():
    right = [(0, 10), (10, 0), (0, -10), (-10, 0)]
    assert g.circle((0, 0), 10, 4, 0, clockwise=True) == right
    assert g.circle((0, 0), 10, 4, 0, clockwise=False) == [right[0], *right[:0:-1]]
    assert g.sector_headings(4, 45) == [45, 135, 225, 315]
    assert g.sector_headings(4, 45, clockwise=False) == [45, 315, 225, 135]


def test_lanes_are_counted_where_the_spacing_divides_the_side():
    assert (g.lane_count(20, 5), g.lane_count(0.6, 0.2), g.lane_count(20, 6)) == (5, 4, None)


@pytest.mark.parametrize("start", g.SQUARE_STARTS)
def test_a_square_is_the_same_ring_from_wherever_it_starts(start: str) -> None:
    ring = g.survey_square((10, 20), 5)
    at = g.SQUARE_STARTS.index(start)
    assert g.survey_square((10, 20), 5, start) == ring[at:] + ring[:at]
    back = [*ring[at::-1], *ring[:at:-1]]
    assert g.survey_square((10, 20), 5, start, clockwise=True) == back


def test_lanes_are_run_from_every_corner() -> None:
    west, east, south, north = 0, 10, 0, 20
    for corner in g.CORNERS:
        x = (west, east) if "west" in corner else (east, west)
        y = (south, north) if "south" in corner else (north, south)
        along_y = [(x[0], y[0]), (x[0], y[1]), (x[1], y[1]), (x[1], y[0])]
        along_x = [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])]
        assert g.lawnmower((5, 10), 10, 20, 10, corner) == along_y
        assert g.lawnmower((5, 10), 10, 20, 20, corner, "x") == along_x
    with pytest.raises(ValueError, match="lanes 6 m apart do not fill 10 m"):
        g.lawnmower((5, 10), 10, 18, 6)
    assert len(g.lawnmower((5, 10), 10, 18, 6, lanes_along="x")) == 8


def test_coordinates_have_two_decimals_and_no_negative_zero() -> None:
    assert [str(g.tidy(value)) for value in (2.0, -0.001, 1.005001, 1.25)] == [
        *("2", "0", "1.01", "1.25")
    ]


def test_lanes_may_end_at_the_far_side_nearer_to_the_one_before() -> None:
    ends = g.lawnmower((0, 0), 10, 4, 4, uneven=True)
    assert [x for x, _y in ends[::2]] == [-5, -1, 3, 5]
