"""What a mission command says of its values beyond doubt, and where it leaves the choice."""

from __future__ import annotations

import pytest

from planner_ft.data.stated import stated_positions
from planner_ft.decoding.constraints.reading.missions.apart import read_apart
from planner_ft.decoding.constraints.reading.missions.areas import read_area
from planner_ft.decoding.constraints.reading.missions.homeward import no_way_home
from planner_ft.decoding.constraints.reading.missions.offsets import read_offsets
from planner_ft.decoding.constraints.reading.missions.searches import nothing_to_search
from planner_ft.decoding.constraints.reading.missions.standoffs import read_standoffs


@pytest.mark.parametrize(
    ("text", "sides"),
    [
        ("Depths at [5, 5], 70 by 30, 30 is the width.", (30, 70)),
        ("Depths at [5, 5], 70 by 30, 70 being the length.", (30, 70)),
        ("A grid at [5, 5] of 70 m by 30 m; the longer side is the length.", (30, 70)),
        ("A grid at [5, 5] of 30 by 70 m; the shorter side is its length.", (70, 30)),
        ("A grid at [5, 5] of 30 by 70, the width is the longer.", (70, 30)),
        ("Sound [5, 5]: width 30, length 70, lanes every 5 m.", (30, 70)),
        ("Sound [5, 5], 70 long and 30 wide.", (30, 70)),
        ("Depths at [5, 5], 0.2 km by 50 m. The long side is the width.", (200, 50)),
        ("Depths at [5, 5], 70 by 30.", None),
        (
            "Depths at [5, 5], 70 by 30, and at [9, 9], 20 by 40. The longer side is the length.",
            None,
        ),
        ("Run along the wall, 70 m long, then sound 20 by 30 at [5, 5].", None),
        ("Sound [5, 5], 70 wide. Or rather 80 wide and 20 long.", None),
        ("Depths at [5, 5], 40 by 40, the longer side is the length.", None),
    ],
)
def test_width_and_length(text: str, sides: tuple[float, float] | None) -> None:
    assert read_area(text) == ({} if sides is None else {"width": sides[0], "length": sides[1]})


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (
            "Run along the quay wall at [4, 8], 90 m long and 7 off.",
            {("pass", "distance"): 7, ("pass", "length"): 90},
        ),
        (
            (
                "Hold at [1, 1] for a minute. Then a run along the north face of the silo, sixty"
                " metres, three metres off."
            ),
            {("pass", "distance"): 3, ("pass", "length"): 60},
        ),
        (
            "Circle the mast at [4, 8] 20 m out, then inspect it at the same distance.",
            {("square", "radius"): 20},
        ),
        ("Orbit the mast at [4, 8] at 20 m. Home.", {("orbit", "radius"): 20}),
        ("Survey the mast at [4, 8], stand-off 15.", {}),
        ("Survey the mast at [4, 8] from 15 m.", {("square", "radius"): 15}),
        (
            "Come back and dock by camera, stopping 80 cm short of the red panel.",
            {("visual", "distance"): 0.8},
        ),
        (
            "Survey the mast at [4, 8] from 15 m, and the pile at [9, 9].",
            {("square", "radius"): 15},
        ),
        ("Survey the mast at [4, 8] from 15 m, and survey the pile at [9, 9].", {}),
        ("Survey the mast at [4, 8] and the pile at [9, 9], the second from 15 m.", {}),
        ("Survey the mast at [4, 8] from 15 m. Make it 18.", {}),
        ("Do not survey the mast at [4, 8] from 15 m.", {}),
        (
            (
                "Run along the face of pier A at [1, 2] and of pier B at [3, 4], 6 and 9 m off"
                " respectively."
            ),
            {},
        ),
        ("Survey the barge UU8 out at [4, 8].", {}),
        ("Circle the mast at [4, 8] at 20 m. Too near. 30 m.", {}),
    ],
)
def test_stand_offs(text: str, told: dict[tuple[str, str], float]) -> None:
    assert read_standoffs(text) == told


@pytest.mark.parametrize(
    ("text", "given"),
    [
        (
            "Hold at [1, 2], at [3, 4] and at [5, 6] for 1, 3 and 5 minutes respectively.",
            {(1, 2): {"s": {60}}, (3, 4): {"s": {180}}, (5, 6): {"s": {300}}},
        ),
        (
            "Survey [1, 2] and [3, 4] at 9 and 12 metres, in that order.",
            {(1, 2): {"m": {9}}, (3, 4): {"m": {12}}},
        ),
        ("Circle the piles at [1, 2] and [3, 4]. Hold there for 2 and 3 minutes.", {}),
        (
            (
                "Tank A at [1, 2] and tank B at [3, 4] get a lap each, tank A at 2 m/s and tank B"
                " at 1.5."
            ),
            {(1, 2): {"m/s": {2}}, (3, 4): {"m/s": {1.5}}},
        ),
        (
            (
                "Cages 1 and 2 are at [1, 2] and [3, 4]. Cage 1: hold 40 seconds. Cage 2: a lap at"
                " 9 m."
            ),
            {(1, 2): {"s": {40}}, (3, 4): {"m": {9}}},
        ),
        (
            "Cages 1 and 2 are at [1, 2] and [3, 4]. Cage 1: hold 40 seconds. Cage 2: the same.",
            {(1, 2): {"s": {40}}},
        ),
        ("Hold at [1, 2] for 1, 3 or 5 minutes.", {}),
    ],
)
def test_values_given_apart(
    text: str, given: dict[tuple[float, float], dict[str, set[float]]]
) -> None:
    assert {
        place: {unit: set(values) for unit, values in units.items()}
        for place, units in read_apart(text).items()
    } == given


@pytest.mark.parametrize(
    ("text", "places"),
    [
        ("The pile stands 30 m due west of [100, 20].", [((70, 20), True)]),
        ("Hold 30 m north and 10 m east of [100, 20].", [((110, 50), True)]),
        ("Drift 50 metres south of the mast at (4, 8).", [((4, -42), False)]),
        ("Loiter 40 m east of home.", [((40, 0), False)]),
        ("Hold 30 m off [100, 20], bow north.", []),
        ("Thirty metres of wall, east of [100, 20].", []),
    ],
)
def test_places_told_from_others(text: str, places: list[tuple[tuple[float, float], bool]]) -> None:
    assert [(offset.place, offset.bare) for offset in read_offsets(text, (0.0, 0.0))] == places


@pytest.mark.parametrize(
    ("text", "ruled_out"),
    [
        ("Hold at [5, 5]. I do not want the vessel brought home after that.", True),
        ("Hold at [5, 5], no return.", True),
        ("Hold 90 m north of home.", True),
        ("Check the lens before you leave base, then hold at [5, 5].", True),
        ("Hold at [5, 5] without leaving it and then head back.", False),
        ("Don't come home before you have held at [5, 5].", False),
        ("Do not go back to the mast, go home.", False),
        ("Survey [5, 5] and off home.", False),
        ("Hold 90 m north of home, then come back.", False),
        ("Survey [5, 5].", False),
    ],
)
def test_the_way_home(text: str, ruled_out: bool) -> None:
    assert no_way_home(text) is ruled_out


@pytest.mark.parametrize(
    ("text", "nothing"),
    [
        ("Stop at [5, 5], wait there and film the latch on the hatch cover for 20 s.", True),
        (
            "Hold at [5, 5] for ten minutes and log the heat of the boiler while you are there.",
            True,
        ),
        ("Survey the mast at [5, 5] from 9 m. Check your sensors. Home.", True),
        ("Survey the mast at [5, 5] and then the wreck.", False),
        ("Survey the mast at [5, 5] and the wreck.", False),
        ("Survey the mast at [5, 5], find the wreck there.", False),
        ("Survey the mast at [5, 5]. Circle the wreck.", False),
        ("Once the wreck has been filmed, survey the mast at [5, 5].", False),
        ("Circle the wreck.", False),
    ],
)
def test_nothing_to_search_for(text: str, nothing: bool) -> None:
    assert nothing_to_search(text) is nothing


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("Inspect the can at one-two-five, minus four-zero.", (125, -40)),
        ("Inspect the can at nine-five, six-zero.", (95, 60)),
    ],
)
def test_two_digits_tied_by_a_hyphen(text: str, place: tuple[float, float]) -> None:
    assert place in stated_positions(text)
