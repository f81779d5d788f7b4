"""Clearances, fences and names that leave a value no choice."""

from __future__ import annotations

import itertools
import re
from typing import Any

import pytest

from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.constraints.companions import read_companions
from planner_ft.decoding.constraints.facts import read
from planner_ft.decoding.constraints.reading.paths.itinerary import without_fences
from planner_ft.decoding.constraints.reading.values.clearances import clearances, margins_only
from planner_ft.decoding.constraints.reading.values.fences import fences
from planner_ft.decoding.constraints.reading.values.told_values import (
    CLEARANCE,
    FENCE,
    Told,
    read_told_values,
)
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("Ring of six points, radius 18 m, with 7 m of clearance.", {7}),
        ("Run to (4, 60), eight metres clear of all obstacles, and hold within 3 m.", {8}),
        ("Nothing may come closer than 12 m while you drift; the box is 40 m wide.", {12}),
        ("Margin to obstacles: 9 yards. Go 30 m to the north.", {8.2296}),
        ("Out to (10, 0) with a margin of 6 m, and back with 4 m.", {6, 4}),
        ("Fifteen metres of clearance there, five will do on the way home.", {15, 5}),
    ],
)
def test_a_length_is_a_clearance_by_the_words_beside_it(text: str, values: set[float]) -> None:
    assert sorted(clearances(text)) == pytest.approx(sorted(values))


@pytest.mark.parametrize(
    ("text", "values"),
    [
        (
            (
                "One arc turn to port, thirty yards radius, with sixty feet of clearance on"
                " everything."
            ),
            {18.288},
        ),
        (
            (
                "An arc to starboard, radius 25 m, margin 6 m, and another one of 40 m with a"
                " margin of 6 m."
            ),
            set(),
        ),
        (
            (
                "Two arcs, radius 25 m, safety margin 6 m; the outer one has a radius of 40 m and a"
                " margin of 12 m."
            ),
            {6, 12},
        ),
        ("Hold within 6 m.", set()),
    ],
)
def test_a_length_that_can_only_be_a_clearance(text: str, values: set[float]) -> None:
    assert sorted(margins_only(text)) == pytest.approx(sorted(values))


@pytest.mark.parametrize(
    "text",
    [
        "Hold within 4 m.",
        "Clearance one five metres.",
        "Half a cable of clearance, then 20 m of clearance.",
        "Clear the lens.",
    ],
)
def test_where_no_length_certainly_is_one_none_is_told(text: str) -> None:
    assert not clearances(text)


@pytest.mark.parametrize(
    ("text", "corners"),
    [
        (
            "Go to (5, 5). Fence (0, 0), (9, 0), (9, 9) and (0, 9).",
            [[(0, 0), (9, 0), (9, 9), (0, 9)]],
        ),
        (
            "Stay inside [[1, 2], [30, 2], [30, 40]], then go to (7, 7).",
            [[(1, 2), (30, 2), (30, 40)]],
        ),
        (
            "Polygon of corners, in kilometres: (0, 0), (0.2, 0), (0.2, -0.1).",
            [[(0, 0), (200, 0), (200, -100)]],
        ),
        ("Turn to 40 and let (1, 1), (8, 1), (8, 8) be your limits.", [[(1, 1), (8, 1), (8, 8)]]),
        ("Visit (0, 0), (9, 0), (9, 9) in turn.", []),
        ("The box from (0, 0) to (40, 20).", []),
    ],
)
def test_a_fence_is_a_list_of_corners_behind_words_for_one(
    text: str, corners: list[list[tuple[float, float]]]
) -> None:
    assert list(fences(text)) == corners


@pytest.mark.parametrize(
    "text",
    [
        "Turn to 40, treating [1, 1], [8, 1], [8, 8] as a hard limit.",
        "(1, 1), (8, 1), (8, 8) must not be left while you turn.",
        "Turn. (1, 1), (8, 1), (8, 8) is the fence.",
    ],
)
def test_corners_before_the_word_for_a_fence_are_no_waypoints(text: str) -> None:
    assert not re.search(r"\d", without_fences(text).replace("40", ""))
    assert re.search(
        "9, 9", without_fences("Visit (0, 0), (9, 0), (9, 9) and hold within your limits.")
    )


def told(record: dict[str, Any]) -> Told:
    return read_told_values(
        read(record["prompt"], VOCABULARY),
        read_companions(record, VOCABULARY).mentioned,
        VOCABULARY,
    )


def test_what_is_told_has_the_labels() -> None:
    """Of sampled inputs; what is told of a parameter has every value that the label gives it."""
    right = wrong = 0
    for record in itertools.islice(sample_tasks(VOCABULARY, 4711, 150, "train"), 150):
        values = told(record).values
        for step in record["expected"]["skill_sequence"]:
            for skill in step["filter_skills"]:
                for name, written in skill["parameters"].items():
                    if (skill["name"], name) in values and (skill["name"], name) in (
                        CLEARANCE,
                        FENCE,
                    ):
                        agrees = compact_json(written) in values[skill["name"], name]
                        right, wrong = right + agrees, wrong + (not agrees)
    assert right >= 20
    assert wrong <= right / 20


def test_what_is_told_of_a_skill_itself_is_written() -> None:
    record = {
        "prompt": "Geotagged still, note rung 4 loose, by camera mast_1, 6 m clear of obstacles.",
        "task": "Transit",
        "parameters": {},
    }
    assert told(record).needed == {("CaptureGeoSnapshot", "note"), CLEARANCE}
