"""Waypoints that follow from the facts of a task."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.decoding.constraints.waypoints import Waypoints, read_waypoints
from planner_ft.facts import geometry as g
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()


def read(task: str, prompt: str, **parameters: Any) -> Waypoints | str:
    return read_waypoints({"task": task, "prompt": prompt, "parameters": parameters}, VOCABULARY)


def waypoints(task: str, prompt: str, **parameters: Any) -> Waypoints:
    found = read(task, prompt, **parameters)
    assert isinstance(found, Waypoints)
    return found


def follows(facts: Waypoints, path: list[tuple[float, float]]) -> bool:
    return all(point in facts.following(tuple(path[:at])) for at, point in enumerate(path))


GRID = {"center": [0, 0], "width": 20, "length": 20, "spacing": 5}


def test_a_grid_that_was_begun_is_gone_on_with() -> None:
    facts = waypoints("BathymetryGridSurvey", "Run the grid from where it is deepest.", **GRID)
    lanes = g.lawnmower((0, 0), 20, 20, 5)
    assert follows(facts, lanes)
    assert facts.following(tuple(lanes[:2])) == [lanes[2]]
    assert follows(facts, g.lawnmower((0, 0), 20, 20, 5, "north-east"))


def test_a_grid_of_stated_size_is_done_at_its_end_alone() -> None:
    facts = waypoints("BathymetryGridSurvey", "Survey the depths around [0, 0].", **GRID)
    lanes = tuple(g.lawnmower((0, 0), 20, 20, 5))
    begun = [facts.unfinished(lanes[:at]) for at in (0, 1, 2, 8, 9, 10)]
    assert begun == [False, *[True] * 4, False]
    assert facts.unfinished(lanes[:8], 1)
    assert not facts.unfinished(lanes[:9], 1)
    part = waypoints("BathymetryGridSurvey", "Run the first 3 lanes around [0, 0].", **GRID)
    assert not part.unfinished(lanes[:6])


def test_before_a_whole_grid_a_place_a_stated_way_off_may_follow() -> None:
    facts = waypoints("BathymetryGridSurvey", "Go 30 m east of it, then survey it.", **GRID)
    assert facts.whole and (30, 0) in facts.following(())


def test_behind_a_whole_grid_no_further_lane_follows() -> None:
    facts = waypoints("BathymetryGridSurvey", "Survey it, 5 m lanes, then stop at (3, 4).", **GRID)
    lanes = tuple(g.lawnmower((0, 0), 20, 20, 5))
    corners = {(-10, -10), (-10, 10), (10, -10), (10, 10)}
    assert set(facts.following(lanes)) == {(0, 0), (3, 4), *corners} - {lanes[-1]}


def test_a_limit_of_the_mission_leaves_a_grid_of_stated_size_as_it_is() -> None:
    limits = "Keep at least 70 m from the platform at [100, 100]. Go no faster than 1.5 m/s."
    facts = waypoints("BathymetryGridSurvey", f"Survey the depths around [0, 0]. {limits}", **GRID)
    lanes = tuple(g.lawnmower((0, 0), 20, 20, 5))
    assert facts.whole
    assert set(facts.following(lanes[:1])) == {(-10, 10), (10, -10)}


@pytest.mark.parametrize(
    ("prompt", "path"),
    [
        (
            "Mow an area 40 m wide and 60 m long from its south-west corner at (10, 10), lanes 20 m"
            " apart.",
            g.lawnmower((30, 40), 40, 60, 20),
        ),
        (
            "Area from (10, 10) up to (40, 50), north-south lanes 10 m apart, from the north-west"
            " corner.",
            g.lawnmower((25, 30), 30, 40, 10, "north-west"),
        ),
        (
            "Sound a 20 x 40 m area about the origin, lanes 20 m apart.",
            g.lawnmower((0, 0), 20, 40, 20),
        ),
    ],
)
def test_a_grid_can_be_stated_in_the_prompt_alone(
    prompt: str, path: list[tuple[float, float]]
) -> None:
    assert follows(waypoints("BathymetryGridSurvey", prompt), path)


def test_squares_and_rings_follow_from_a_radius() -> None:
    own = {"target_position": [12, -40], "radius": 15}
    facts = waypoints("SurveyTarget", "Survey the pile, then close the square.", **own)
    square = g.survey_square((12, -40), 15, "north", clockwise=True)
    assert follows(facts, [*square, square[0]])
    assert follows(facts, square[1::2])
    assert follows(facts, [*square, (0, 0)]), "a whole square may be left"
    facts = waypoints("SurveyTarget", "Six points round it, the first due west.", **own)
    assert follows(facts, g.circle((12, -40), 15, 6, 270, clockwise=False))


def test_points_lie_a_stated_way_off() -> None:
    facts = waypoints("Transit", "Go 30 m east of it, then 20 m on 045.", target_position=[5, 5])
    first = g.offset((5, 5), 90, 30)
    assert follows(facts, [first, g.offset(first, 45, 20)])
    assert not follows(facts, [(5, 5), (5, 5)]), "the vehicle is there"
    assert not follows(facts, [(6, 7)])


def test_a_scratchpad_derives_coordinates_by_right_sums_alone() -> None:
    prompt = "Pass 12 m off one side and 20 m off the other."
    facts = waypoints("Transit", prompt, target_position=[33, -18])
    assert (45, 2) not in facts.following(())
    assert (45, 2) in facts.following((), "x33+12=45;y-18+20=2")
    assert (46, 2) not in facts.following((), "x33+12=46;y-18+20=2")
    assert (47, 2) not in facts.following((), "x33+14=47;y-18+20=2")


@pytest.mark.parametrize(
    ("task", "prompt", "words"),
    [
        ("SurveyTarget", "Survey the pile.", "no radius for SurveyTarget"),
        ("BathymetryGridSurvey", "Sound the area.", "no sizes and lane spacing"),
        ("Transit", "Go to the place with easting 40, the other one you know.", "not certain"),
    ],
)
def test_without_evidence_waypoints_are_the_models(task: str, prompt: str, words: str) -> None:
    found = read(task, prompt, target_position=[12, -40], center=[12, -40])
    assert isinstance(found, str) and words in found


LANES = tuple(g.lawnmower((0, 0), 20, 20, 5))


def grid(width: float, length: float, spacing: float, prompt: str = "Survey it.") -> Any:
    sizes = {"width": width, "length": length, "spacing": spacing}
    return read("BathymetryGridSurvey", prompt, center=[0, 0], **sizes)


@pytest.mark.parametrize(
    ("width", "length", "spacing", "counts"),
    [
        # Lanes along either side where the spacing divides it: two to 32 of them.
        (20, 20, 5, {10}),
        (10, 20, 10, {4, 6}),
        (310, 7, 10, {64}),
        (320, 7, 10, set()),
        (10, 7, 10, {4}),
        (7, 10, 10, {4}),
        (7, 7, 10, set()),
    ],
)
def test_lanes_of_a_grid(width: float, length: float, spacing: float, counts: set[int]) -> None:
    found = grid(width, length, spacing)
    if not counts:
        assert isinstance(found, str) or not found.whole
        return
    assert found.whole and found.begun == 1
    assert {len(path) for path in found.paths} == counts
    assert len({path[0] for path in found.paths}) == 4


@pytest.mark.parametrize(
    ("prompt", "whole"),
    [
        ("Survey it.", True),
        ("Survey it, 5 m lanes.", True),
        ("Survey it in 20 lanes.", True),
        ("Survey it in 4 lanes.", False),
        ("Survey it, 30 m off.", True),
        ("Survey [3, 4] in 3.", True),
    ],
)
def test_a_bare_number_may_be_of_lanes(prompt: str, whole: bool) -> None:
    assert waypoints("BathymetryGridSurvey", prompt, **GRID).whole is whole


def test_a_path_that_was_begun_is_gone_on_with_from_two_or_three_waypoints_on() -> None:
    square = g.survey_square((12, -40), 15)
    own = {"target_position": [12, -40], "radius": 15}
    shaped = waypoints("SurveyTarget", "Survey the pile.", **own)
    assert shaped.begun == 2 and not shaped.whole
    assert set(shaped.following((square[0],))) > {square[1], square[-1], (12, -40)}
    onward = shaped.following(tuple(square[:3]))
    assert onward == [square[3]]
    lone = waypoints("Transit", "Circle at 15 m, 8 points.", target_position=[12, -40])
    assert lone.begun == 3
    assert len(lone.following(tuple(square[:2]))) > 2
    assert lone.following(tuple(square[:3])) == [square[3]]
    assert shaped.following(()) and (12, -40) not in shaped.following(((12, -40),))


def test_a_whole_path_is_unfinished_from_its_first_waypoint_on() -> None:
    facts = waypoints("BathymetryGridSurvey", "Survey it.", **GRID)
    assert [facts.unfinished(LANES[:at]) for at in range(11)] == [False, *[True] * 9, False]
    assert [facts.unfinished(LANES[:8], more) for more in (0, 1, 2, 3)] == [
        True,
        True,
        False,
        False,
    ]
    assert not facts.unfinished(((77, 77),))
    assert not waypoints("SurveyTarget", "Survey.", target_position=[1, 2], radius=5).unfinished(
        ((6, 2),)
    )


def test_grids_rings_and_points_of_other_tasks() -> None:
    lanes = waypoints("Transit", "Lanes of 20 by 20 m, 5 m apart.", target_position=[0, 0])
    assert LANES in lanes.paths and not lanes.whole
    plain = waypoints("Transit", "An area of 20 by 20 m, 5 m.", target_position=[0, 0])
    assert LANES not in plain.paths
    ring = tuple(g.circle((9, 9), 10, 3, 90, clockwise=True))
    three = waypoints("Transit", "Three points round it, 10 m off.", target_position=[9, 9])
    assert ring in three.paths and (*ring, ring[0]) in three.paths
    two = waypoints("Transit", "Two points round it, 10 m off.", target_position=[9, 9])
    assert not any(len(path) == 2 for path in two.paths)
    square = tuple(g.survey_square((9, 9), 10, "north", clockwise=True))
    for path in (square, (*square, square[0]), square[::2], (*square[::2], square[0])):
        assert path in two.paths
    assert not any(-99 in point for path in two.paths for point in path)


@pytest.mark.parametrize(
    ("working", "point", "derived"),
    [
        ("x33+12=45;y-18+20=2", (45, 2), True),
        ("x33-12=21;y-18-20=-38", (21, -38), True),
        ("x33+12=45.01;y-18+20=2", (45.01, 2), False),
        ("x33+12=45;y-18+20=2.01", (45, 2.01), False),
        ("x33+12=45;x45+12=57;y-18+20=2", (57, 2), True),
        ("20/2=10;x33+10=43", (43, -18), True),
        ("20/2=10;x33+10=43;y-18+10=-8", (43, -8), True),
        ("20/3=6.67;x33+6.67=39.67;y-18+10=-8", (39.67, -8), False),
        ("20/2=11;x33+11=44;y-18+20=2", (44, 2), False),
        ("21/2=10.5;x33+10.5=43.5;y-18+20=2", (43.5, 2), False),
        ("x34+12=46;y-18+20=2", (46, 2), False),
        ("20/0=5;x33+5=38;y-18+20=2", (38, 2), False),
    ],
)
def test_sums_of_a_scratchpad(working: str, point: tuple[float, float], derived: bool) -> None:
    prompt = "Pass 12 m off one side and 20 m off the other."
    facts = waypoints("Transit", prompt, target_position=[33, -18])
    assert (point in facts.following((), working)) is derived


def test_why_waypoints_are_the_models() -> None:
    center = {"center": [12, -40]}
    assert read("BathymetryGridSurvey", "Sound it.", **center) == (
        "The command states no sizes and lane spacing for BathymetryGridSurvey; its waypoints are"
        " the model's."
    )
    assert read("SurveyTarget", "Survey it.", target_position=[12, -40]) == (
        "The command states no radius for SurveyTarget; its waypoints are the model's."
    )
    assert read("Transit", "Run a zigzag.", target_position=[12, -40]) == (
        "The geometry of the command is not certain; the waypoints are the model's."
    )
    assert waypoints("Transit", "Go.", target_position=[12, -40]).paths == ()
