"""Where the facts of a task can send a vehicle."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.ground import Ground
from planner_ft.decoding.constraints.waypoints import read_ground
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()


def ground(task: str, prompt: str, **parameters: Any) -> Ground:
    return read_ground({"task": task, "prompt": prompt, "parameters": parameters}, VOCABULARY)


def follows(facts: Ground, path: list[tuple[float, float]]) -> bool:
    return (
        all(point in facts.following(tuple(path[:place])) for place, point in enumerate(path))
        and facts.ending(tuple(path)) != "not yet"
    )


def test_a_grid_that_was_begun_is_run_to_its_end() -> None:
    facts = ground(
        "BathymetryGridSurvey",
        "Run the grid, starting where it is deepest.",
        center=[0, 0],
        width=20,
        length=20,
        spacing=5,
    )
    lanes = g.lawnmower((0, 0), 20, 20, 5)
    assert follows(facts, lanes)
    assert (
        facts.following(tuple(lanes[:2])) == [lanes[2]]
        and facts.ending(tuple(lanes[:4])) == "not yet"
    )
    assert follows(facts, g.lawnmower((0, 0), 20, 20, 5, "north-east"))


def test_a_grid_can_be_stated_in_the_prompt_alone_also_by_a_corner() -> None:
    facts = ground(
        "BathymetryGridSurvey",
        "Mow an area 40 m wide and 60 m long from its south-west corner at (10, 10), lanes 20 m"
        " apart.",
    )
    assert follows(facts, g.lawnmower((30, 40), 40, 60, 20))


def test_an_area_can_be_stated_by_two_opposite_corners() -> None:
    facts = ground(
        "BathymetryGridSurvey",
        "Area from (10, 10) up to (40, 50), north-south lanes 10 m apart, from the north-west"
        " corner.",
        center=[25, 30],
    )
    assert follows(facts, g.lawnmower((25, 30), 30, 40, 10, "north-west"))
    facts = ground(
        "SearchAndDetect",
        "Comb the rectangle between [210, 140] and [180, 80] in three lanes spread evenly, the"
        " right-hand one first.",
    )
    assert follows(facts, g.lawnmower((195, 110), 30, 60, 15, "north-east"))


def test_a_grid_can_lie_round_home() -> None:
    facts = ground(
        "BathymetryGridSurvey",
        "Sound a 20 x 40 m area about the origin, lanes 20 m apart, where you like to begin.",
        center=[0, 0],
    )
    assert follows(facts, g.lawnmower((0, 0), 20, 40, 20))


def test_half_a_square_is_left_at_its_middle() -> None:
    facts = ground(
        "SurveyTarget",
        "The western half of the square only, from the middle of the north side,"
        " counter-clockwise.",
        target_position=[30, 40],
        radius=10,
    )
    assert follows(facts, g.survey_square((30, 40), 10, "north")[:5])
    whole = ground(
        "SurveyTarget",
        "The square from the middle of the north side on, where it is safe.",
        target_position=[30, 40],
        radius=10,
    )
    assert not follows(whole, g.survey_square((30, 40), 10, "north")[:5])


def test_a_survey_square_may_start_anywhere() -> None:
    facts = ground(
        "SurveyTarget",
        "Survey it on a square, beginning where the light is best.",
        target_position=[30, 40],
        radius=10,
    )
    assert follows(facts, g.survey_square((30, 40), 10))
    square = g.survey_square((30, 40), 10, "north-west")
    assert follows(facts, square) and facts.ending(tuple(square[:3])) == "not yet"


def test_a_stated_way_off_a_stated_place_is_a_waypoint_and_no_other_place_is() -> None:
    facts = ground("Transit", "Go to the point 30 m due south of (10, 20), then 15 m east.")
    assert follows(facts, [(10, -10), (25, -10)])
    assert (10, 50) not in facts.following(()) and (11, 20) not in facts.following(())


def test_a_step_goes_somewhere_else_unless_the_prompt_speaks_of_coming_back() -> None:
    assert (5, 5) not in ground("Transit", "Go to (5, 5).").following(((5, 5),))
    assert (5, 5) in ground("Transit", "Go to (5, 5) twice.").following(((5, 5),))


def test_shapes_that_are_not_derived_leave_room() -> None:
    assert ground("Transit", "Run a zigzag of 20 m from (5, 5).").free
    assert ground("Transit", "Go to (5, 5) and on for 3 furlongs.").free
    assert not ground("Transit", "Go to (5, 5).").free


@pytest.mark.parametrize(
    "said",
    [
        "No square today, just close up on the target.",
        "Forget the survey square: go to the target position and hold there.",
    ],
)
def test_a_shape_that_is_ruled_out_binds_nothing(said: str) -> None:
    record = {
        "task": "SurveyTarget",
        "parameters": {"target_position": [60, 20], "radius": 6},
        "prompt": said,
    }
    assert read_ground(record, load_vocabulary()).free


def test_a_working_derives_coordinates_by_right_sums_over_the_facts() -> None:
    half = (
        "Only the eastern half of the area: first lane on the north-south centre line from its"
        " south end, then outwards to the east."
    )
    record = {
        "task": "BathymetryGridSurvey",
        "parameters": {"center": [100, 0], "width": 80, "length": 40, "spacing": 10},
        "prompt": half,
    }
    ground = read_ground(record, VOCABULARY)
    assert not ground.told
    # A sum that is wrong, one over a length that nobody said, and one from a place that nobody
    # said.
    shown = ground.shown(
        "40/2=20;y0-20=-20;y-20+40=20;x100+10=110;x110+10=121;x110+7=117;x90+10=100"
    )
    assert shown.worked == ({0, 100, 110}, {0, -20, 20})
    assert (110, 20) in shown.following(((100, -20), (100, 20)))
    assert ground.shown("x100+7=107").worked == ground.worked
    assert ground.shown("no sum").worked == ground.worked


@pytest.mark.parametrize(
    "prompt",
    [
        "Keep 9 m off everything out to the target, then home without that.",
        "Target via [5, 5], back by the same place and then home.",
        "Over [5, 5] and [7, 1], then into the target.",
    ],
)
def test_waypoints_are_not_told_where_the_tasks_own_place_would_be_left_out(prompt: str) -> None:
    assert ground("Transit", prompt, target_position=[40, -8]).itinerary is None


def test_lanes_with_all_sizes_are_a_grid_for_any_task() -> None:
    prompt = "Search the block centred on [20, 10], 20 m wide and 40 m long, in lanes 10 m apart."
    assert ground("SearchAndDetect", prompt).itinerary == tuple(g.lawnmower((20, 10), 20, 40, 10))
    corner = (
        "The patch has its south-west corner at [10, -10]; it is 20 m wide and 40 m long. Comb it"
        " with lanes every 10 m."
    )
    assert ground("SearchAndDetect", corner).paths == (tuple(g.lawnmower((20, 10), 20, 40, 10)),)


def test_the_middle_of_a_side_is_no_centre() -> None:
    facts = ground(
        "SearchAndDetect",
        "The middle of the east side of the area is [20, 10]. It is 20 m wide and 40 m long, lanes"
        " every 10 m.",
    )
    assert facts.itinerary is None and not facts.shaped
