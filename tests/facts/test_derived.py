"""What follows from stated places, lengths, bearings and counts, and what does not."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.facts.geometry import Ground, sector_counts, turned
from tests.values import changeable

NOTHING: dict[str, Any] = dict.fromkeys(
    ("places", "centres", "lengths", "bearings", "counts", "sizes"), ()
)


def ground(**given: Any) -> Ground:
    return Ground(**NOTHING | given)


def test_what_is_read_cannot_be_changed() -> None:
    assert changeable("planner_ft.facts") == []


def test_turns_and_lines_are_divided_into_2_to_36_parts() -> None:
    assert sector_counts([1, 2, 2.5, 3.0, 36, 37, 0, -4]) == {2, 3, 36}


@pytest.mark.parametrize(
    ("said", "counts", "angles"),
    [
        ([], [], []),
        # Parts, turns to port, and to the side and back.
        ([90], [], [-90, -45, 0, 45, 90, 180, 270]),
        ([400], [], [-400, -200, 40, 130, 200, 220, 310]),
        ([], [2], []),
        ([], [3], [-120, 0, 120, 240]),
        ([30], [4], [-90, -30, -15, -7.5, 0, 7.5, 15, 30, 90, 120, 180, 210, 270, 300]),
        ([400], [4], [-400, -200, -100, -90, 0, 40, 90, 100, 130, 180, 200, 220, 270, 310]),
        # Of more than eight stated angles nothing but the turn to port follows.
        (range(10, 18), [], None),
        (range(10, 19), [], [*range(-18, -9)]),
    ],
)
def test_angles_that_follow_from_stated_ones(said: Any, counts: Any, angles: Any) -> None:
    found = sorted(set(turned(said, counts)))
    assert found == angles if angles is not None else 5 in found and 100 in found


LINE = {"places": ((0, 0), (40, 20))}
NEAR = {"places": ((100, 0),), "lengths": (30,), "bearings": (60,)}
SQUARE = {"centres": ((10, 20),), "lengths": (5,)}
RING = {"centres": ((10, 20),), "lengths": (10,), "counts": (6,)}
GRID = {"places": ((10, 20),), "sizes": ((20, 10),), "spacing": 5}


@pytest.mark.parametrize(
    ("given", "right", "wrong"),
    [
        ({}, [], [(0, 0)]),
        # Known places and the crossings of their axes, to 2 cm.
        (
            LINE,
            [(0, 0), (40, 20), (0, 20), (40, 0), (40.019, 0.019), (39.981, -0.019)],
            [(40.021, 0), (0, 20.021), (39.979, 0), (10, 0)],
        ),
        # The middle of a line; with a count of three the thirds and, as points, the halves.
        (LINE, [(20, 10), (20.01, 10.01)], [(20.03, 10), (10, 5), (13.33, 6.67)]),
        (LINE | {"counts": (3,)}, [(20, 10), (13.33, 6.67), (26.67, 13.33)], [(10, 5), (30, 15)]),
        (LINE | {"counts": (5,)}, [(10, 5), (30, 15), (8, 4), (32, 16)], [(13.33, 6.67)]),
        # A length away on a bearing, to either side of it or back.
        (
            NEAR,
            [(125.98, 15), (115, -25.98), (74.02, -15), (85, 25.98), (125.99, 15)],
            [(130, 0), (125.98, -15), (126.03, 15), (115, 25.98), (151.96, 30)],
        ),
        # On the course between two places.
        (
            {"places": ((0, 0), (30, 40)), "lengths": (10,)},
            [(6, 8), (36, 48), (24, 32), (-8, 6), (38, 34)],
            [(8, 6), (10, 0)],
        ),
        (
            {"places": ((5, 7), (35, 47)), "lengths": (10,)},
            [(11, 15), (29, 39), (-1, -1), (-3, 13), (43, 41)],
            [(13, 13), (15, 7), (5, 17)],
        ),
        # Corners and mid-sides of a square of half a side.
        (
            SQUARE,
            [(15, 20), (15, 25), (10, 25), (5, 15), (15.019, 24.981)],
            [(10, 20), (12, 25), (15, 22), (15.03, 20), (20, 20), (10.03, 25)],
        ),
        # Evenly round a ring from the four quarters, or from a stated bearing on.
        (
            RING,
            [(10, 30), (18.66, 25), (18.66, 15), (1.34, 15), (15, 28.66), (20, 20), (0, 20)],
            [(17.07, 27.07), (10, 31), (18.7, 25), (10.05, 30.05), (12.59, 29.66)],
        ),
        (RING | {"bearings": (15,)}, [(12.59, 29.66), (19.66, 22.59)], [(17.07, 27.07)]),
        (RING | {"counts": (4,)}, [(20, 20)], [(18.66, 25), (17.07, 27.07)]),
        # Ends of lanes, along either side.
        (
            GRID,
            [(0, 15), (5, 25), (20, 15), (0, 20), (20, 20), (15, 15.019), (5.019, 25)],
            [(5, 20), (2, 15), (25, 15), (0, 30), (5.03, 25), (5, 25.03), (-5, 15), (0, 22.5)],
        ),
        (GRID | {"spacing": 4}, [(4, 15), (12, 25), (0, 15)], [(5, 15), (0, 19)]),
        (GRID | {"spacing": 7}, [], [(7, 15), (0, 22)]),
        # Without a stated spacing: stated lengths, and what a number of lanes leaves between them.
        (GRID | {"spacing": None, "lengths": (10,)}, [(10, 25), (0, 15)], [(5, 25)]),
        (GRID | {"spacing": None, "counts": (3,)}, [(10, 25), (0, 20), (5, 25)], [(4, 25)]),
    ],
)
def test_points_that_follow(given: Any, right: list[Any], wrong: list[Any]) -> None:
    found = ground(**given)
    assert [point for point in right if not found.leads_to(point)] == []
    assert [point for point in wrong if found.leads_to(point)] == []


def test_a_point_may_follow_from_those_before_it() -> None:
    found = ground(lengths=(30,), bearings=(90,))
    assert found.leads_to((35, 7), [(5, 7)]) and found.leads_to((5, 7), [(5, 7)])
    assert not found.leads_to((35, 7), [(5, 9)]) and not found.leads_to((35, 7))


def test_places_a_stated_way_off_others_are_made() -> None:
    found = ground(lengths=(10, 20), bearings=(0, 90)).away([(1, 2), (3, 4)])
    assert list(found) == [
        *((1, 12), (1, 22), (11, 2), (21, 2)),
        *((3, 14), (3, 24), (13, 4), (23, 4)),
    ]


def test_areas_lie_around_places_or_between_centres_and_have_two_sides() -> None:
    sizes = ((20, 10), (0, 5), (5, 0))
    assert ground(places=((1, 2),), sizes=sizes).areas == [(1, 2, 20, 10)]
    assert ground(places=((1, 2),), sizes=sizes, corners=True).areas == [
        *((1, 2, 20, 10), (11, 7, 20, 10), (11, -3, 20, 10), (-9, 7, 20, 10), (-9, -3, 20, 10))
    ]
    assert ground(centres=((1, 2), (7, 12), (7, 2))).areas == [(4, 7, 6, 10)]
    assert ground(lengths=(4, 5), counts=(3, 5)).spacings(20, 8) == (4, 5, 10, 2)
