"""The rotations that a task input leaves no choice about."""

from __future__ import annotations

import itertools
from typing import Any

import pytest

from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.constraints.reading.rows.turn_parts import NUDGE, ROTATE
from planner_ft.decoding.constraints.reading.rows.turns import read_turns
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()


def turns(prompt: str, task: str = "HorizontalPanorama", **parameters: Any) -> Any:
    return read_turns({"task": task, "prompt": prompt, "parameters": parameters}, VOCABULARY)


def headings(*degrees: float) -> tuple[tuple[str, float], ...]:
    return tuple((ROTATE, value) for value in degrees)


def nudges(*degrees: float) -> tuple[tuple[str, float], ...]:
    return tuple((NUDGE, value) for value in degrees)


@pytest.mark.parametrize(
    ("prompt", "degrees"),
    [
        ("Turn to north, east, south and west, a still at each heading.", (0, 90, 180, 270)),
        (
            "Bearings 80, 100, 120 in that order, hot point over 60 degrees on every one.",
            (80, 100, 120),
        ),
        ("Face N, E, S, W in turn.", (0, 90, 180, 270)),
        ("Turn to 0, 120 and 240 degrees. After each turn hold for 10 s.", (0, 120, 240)),
        ("Come to zero nine zero and wait. Then one eight zero and wait likewise.", (90, 180)),
        ("Swing the bow south-south-east.", (157.5,)),
        ("Come to bearing two four zero, I say again two four zero.", (240,)),
        (
            "Look in six directions, sixty degrees apart, going clockwise from north.",
            (0, 60, 120, 180, 240, 300),
        ),
        (
            (
                "Four headings, 90 degrees apart, the first one east and the others anticlockwise"
                " from there."
            ),
            (90, 0, 270, 180),
        ),
        (
            "Turn through four evenly spaced headings, starting at east, anticlockwise.",
            (90, 0, 270, 180),
        ),
        (
            "Turn from 300 through north to 060 clockwise, in steps of 30 degrees.",
            (300, 330, 0, 30, 60),
        ),
        ("270, 180, 090: turn to each, a still every time.", (270, 180, 90)),
        ("Go to (3, 4), then turn to 200 and check the sector at 45 degrees.", (200,)),
        ("Turn to 090. Slices only while facing 090.", (90,)),
        (
            "Turn to the four cardinal points, anticlockwise and beginning with west.",
            (270, 180, 90, 0),
        ),
        ("Look in all four cardinal directions clockwise from north.", (0, 90, 180, 270)),
        (
            "Turn to each of the eight compass points clockwise from east.",
            (90, 135, 180, 225, 270, 315, 0, 45),
        ),
    ],
)
def test_headings_are_read_in_order(prompt: str, degrees: tuple[float, ...]) -> None:
    assert turns(prompt) == headings(*degrees)


@pytest.mark.parametrize(
    ("prompt", "degrees"),
    [
        ("Pan 35 degrees to starboard four times.", (35, 35, 35, 35)),
        ("Nudge eight degrees to port twice.", (-8, -8)),
        ("Pan left by 30 degrees, then left by 30 degrees once more.", (-30, -30)),
        ("hold 10 s. yaw 30 left. yaw 60 right. yaw 30 left.", (-30, 60, -30)),
        ("Three nudges of 20 degrees to starboard.", (20, 20, 20)),
        ("Quarter turn to port, then half a turn to starboard.", (-90, 180)),
        ("Swing the bow three points to port.", (-33.75,)),
        (
            (
                "Two points to starboard on the spot (a point being 11.25 degrees), then one point"
                " to port."
            ),
            (22.5, -11.25),
        ),
        ("Pan 40 degrees to the left and back again by the same angle.", (-40, 40)),
        ("Nudge 5 degrees to port and as much to starboard.", (-5, 5)),
        ("Turn all the way round, anticlockwise, in 4 equal steps.", (-90, -90, -90, -90)),
        ("Adjust the heading by -75 degrees.", (-75,)),
        ("Turn 45° cw. Turn 45° ccw.", (45, -45)),
        (
            (
                "Nudge the bow 15 degrees to port, then arc 90 degrees to starboard at a radius of"
                " 20 m."
            ),
            (-15,),
        ),
        ("Pan to port across 90 degrees in three equal parts.", (-30, -30, -30)),
        ("Rotate by 60 degrees to starboard in two equal steps.", (30, 30)),
        (
            (
                "Once all the way round, clockwise, in four quarter turns, and after every quarter"
                " turn wait until she is steady."
            ),
            (90, 90, 90, 90),
        ),
        ("Make three quarter turns to port.", (-90, -90, -90)),
        ("Turn 20 to port, 40 across to starboard, 20 back to port.", (-20, 40, -20)),
        ("hodl 5 s, rotaet 10 degres to prot", (-10,)),
    ],
)
def test_angles_to_turn_by_are_read_with_their_side(
    prompt: str, degrees: tuple[float, ...]
) -> None:
    assert turns(prompt) == nudges(*degrees)


def test_the_task_s_own_values_stand_for_the_words_that_refer_to_them() -> None:
    covered = (
        "Face 210 first, then come to port 40 degrees at a time until the scan width has been"
        " covered."
    )
    assert turns(covered, "ThermalHotspotLocalizer", scan_width_degrees=120) == (
        *headings(210),
        *nudges(-40, -40, -40),
    )
    assert turns(
        "Turn to 100 degrees, then pan clockwise by the scan width.", scan_width_degrees=120
    ) == (*headings(100), *nudges(120))
    assert turns(
        "Go to the start and turn to the given heading.",
        "SubseaCableTrack",
        start=[0, 0],
        heading=250,
    ) == headings(250)
    assert turns(
        "All round in the planned number of sectors, clockwise from south.", sectors=4
    ) == headings(180, 270, 0, 90)


@pytest.mark.parametrize(
    "prompt",
    [
        "Turn to 090 - sorry, to 080.",
        "Before you turn to 90, nudge 20 degrees to starboard.",
        "It ends with 5 degrees of rotation to starboard. Before that, turn to 90.",
        "Do not turn to 90.",
        "Turn to 40 or to 50.",
        "Turn a bit to port.",
        "Go to (3, 4) and face 148.",
        "Turn to 90, then pan a little.",
        "Bring her to 145, 30.",
        "Swing 66 degrees to port in a curve of 6 m.",
        "Turn to 90, then repeat all that.",
        "If it is calm, turn to 90.",
        "Turn 180.",
        "Rotate 90 degrees to face east.",
        "Pan 30 degrees to port, then return.",
    ],
)
def test_what_is_not_certain_is_not_read(prompt: str) -> None:
    assert turns(prompt) is None


def test_an_orbit_turns_along_its_circle() -> None:
    assert turns("Swing 170 degrees to port.", "PerformOrbit", center=[0, 0], radius=10) is None


def test_no_word_for_a_turn_is_no_rotation() -> None:
    assert turns("Go to (3, 4) and hold for 20 s.") == ()
    assert turns("Go to (3, 4) and watch the bow.") is None


def test_sampled_labels_are_met() -> None:
    read = right = 0
    for record in itertools.islice(sample_tasks(VOCABULARY, 77, None, "train"), 300):
        found = read_turns(record, VOCABULARY)
        steps = [step["navigation_skill"] for step in record["expected"]["skill_sequence"]]
        wanted = [
            (step["name"], next(iter(step["parameters"].values())))
            for step in steps
            if step["name"] in (ROTATE, NUDGE)
        ]
        if found is not None:
            read += 1
            right += len(found) == len(wanted) and all(
                one[0] == two[0] and abs(one[1] - two[1]) < 0.01
                for one, two in zip(found, wanted, strict=True)
            )
    assert read > 120
    assert right >= read - 1


@pytest.mark.parametrize(
    "prompt",
    [
        "Bow to the west, a minute, then the reciprocal.",
        "After you reach [4, 50]: nudge 10 degrees to port. Before you set out: face 200 degrees.",
        "Eight left, a pause, then 30 degrees to starboard.",
        "Pan 40 degrees to port, then back to where the bow was.",
        "A waypoint every 90 degrees round [5, 6], 20 m off, clockwise from north.",
    ],
)
def test_turns_told_backwards_or_by_another_are_not_read(prompt: str) -> None:
    assert turns(prompt) is None


def test_a_count_can_be_written_with_a_times_sign() -> None:
    assert turns("4 x 30 deg to port, a still after each.") == nudges(-30, -30, -30, -30)
