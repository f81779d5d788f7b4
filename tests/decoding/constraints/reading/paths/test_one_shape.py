"""Tasks that are one grid or one survey square, where some choice is left about it."""

from __future__ import annotations

import random
from typing import Any

import numpy as np
import pytest

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.factory import constraint_factory
from planner_ft.decoding.constraints.grammar import SchemaValues
from planner_ft.decoding.constraints.ground import Ground
from planner_ft.decoding.constraints.reading.paths.cues import ANY, read_cues
from planner_ft.decoding.constraints.routes import STEP_OPENS, TaskScript
from planner_ft.decoding.constraints.waypoints import read_ground
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()
GRID = {"center": [120, 80], "width": 40, "length": 60, "spacing": 10}
SQUARE = {"target_position": [100, 50], "radius": 20}


def ground(task: str, prompt: str, parameters: dict[str, Any]) -> Ground:
    return read_ground({"task": task, "prompt": prompt, "parameters": parameters}, VOCABULARY)


def only(facts: Ground, path: list[tuple[float, float]]) -> bool:
    """Whether these waypoints are written and no others can be."""
    return (
        all(facts.following(tuple(path[:place])) == [point] for place, point in enumerate(path))
        and facts.ending(tuple(path)) == "must"
    )


@pytest.mark.parametrize(
    ("prompt", "parameters", "path"),
    [
        (
            (
                "We lost a net here. Start at the north-west corner of the area, back and forth"
                " east-west."
            ),
            GRID,
            g.lawnmower((120, 80), 40, 60, 10, "north-west", "x"),
        ),
        (
            "Execute a lawnmower survey of the area, clear of anything by 6 m.",
            GRID,
            g.lawnmower((120, 80), 40, 60, 10),
        ),
        (
            "Survey block. Enter at the southeast corner, lane spacing one five metres.",
            {**GRID, "width": 60},
            None,
        ),
        (
            (
                "Lanes parallel to the x axis at the task's spacing. First lane is the southernmost"
                " and it starts at its east end."
            ),
            GRID,
            g.lawnmower((120, 80), 40, 60, 10, "south-east", "x"),
        ),
        (
            (
                "Sound a block 30 metres wide (east-west) and 20 metres long (north-south), centre"
                " (120, 80), lanes five metres apart."
            ),
            GRID,
            g.lawnmower((120, 80), 30, 20, 5),
        ),
        (
            "Little grid, 12 wide and 18 long, one lane every 6 m.",
            GRID,
            g.lawnmower((120, 80), 12, 18, 6),
        ),
        (
            "The block measures 80 m by 30 m. Cover it in east-west lines 10 m apart.",
            GRID,
            g.lawnmower((120, 80), 80, 30, 10, "south-west", "x"),
        ),
    ],
)
def test_a_grid_lies_as_its_words_say(
    prompt: str, parameters: dict[str, Any], path: list[tuple[float, float]] | None
) -> None:
    facts = ground("BathymetryGridSurvey", prompt, parameters)
    if path is None:  # the task's own spacing stays possible
        lanes = g.lawnmower((120, 80), 60, 60, 15, "south-east")
        assert (
            all(point in facts.following(tuple(lanes[:place])) for place, point in enumerate(lanes))
            and facts.ending(tuple(lanes)) == "must"
        )
    else:
        assert only(facts, path)


@pytest.mark.parametrize(
    ("prompt", "path"),
    [
        (
            "The usual survey square at the radius given; a photo at all eight points.",
            g.survey_square((100, 50), 20),
        ),
        (
            "Survey square round the target, clockwise. Video on.",
            g.survey_square((100, 50), 20, clockwise=True),
        ),
        (
            "Corners only: south-west, then anticlockwise round the target, 8 m margin.",
            g.survey_square((100, 50), 20, "south-west")[::2],
        ),
        (
            (
                "Survey square round the target. Stills at the four corners; at the mid-sides only"
                " read the depth."
            ),
            g.survey_square((100, 50), 20),
        ),
        (
            "Take her round the square and close it.",
            [*g.survey_square((100, 50), 20), g.survey_square((100, 50), 20)[0]],
        ),
        (
            "A square of 30 m, please, from the middle of the north side.",
            g.survey_square((100, 50), 30, "north"),
        ),
    ],
)
def test_a_square_lies_as_its_words_say(prompt: str, path: list[tuple[float, float]]) -> None:
    assert only(ground("SurveyTarget", prompt, SQUARE), path)


def test_a_beginning_that_is_not_read_leaves_every_corner() -> None:
    facts = ground(
        "BathymetryGridSurvey", "Lanes over the area, begin at the end by the sluice.", GRID
    )
    assert set(facts.following(())) == {
        g.lawnmower((120, 80), 40, 60, 10, corner)[0] for corner in g.CORNERS
    }


def test_a_place_apart_is_gone_to_beside_the_grid() -> None:
    facts = ground(
        "BathymetryGridSurvey",
        "Proceed to [90, 10] and settle. Mow the area after that, lanes north-south.",
        GRID,
    )
    path = [(90, 10), *g.lawnmower((120, 80), 40, 60, 10)]
    assert (
        all(point in facts.following(tuple(path[:place])) for place, point in enumerate(path))
        and facts.ending(tuple(path)) == "may"
    )


@pytest.mark.parametrize(
    ("task", "prompt"),
    [
        ("BathymetryGridSurvey", "The grid can wait. Run out to the planned centre."),
        ("BathymetryGridSurvey", "Two grids, the first round (10, 20), the second round (90, 20)."),
        ("BathymetryGridSurvey", "A transect 140 m long from (10, 20) on a course of 150."),
        ("SurveyTarget", "Go to the point 30 m north of the target."),
        ("SurveyTarget", "Zigzag over the square."),
    ],
)
def test_other_ways_are_not_read_as_the_shape(task: str, prompt: str) -> None:
    assert not ground(task, prompt, GRID if task == "BathymetryGridSurvey" else SQUARE).shaped


def test_cues() -> None:
    assert (
        read_cues("Mow the area.") == (read_cues(""))
        and read_cues("").corners == ("south-west",)
        and read_cues("").turns == (False,)
    )
    assert read_cues("East-west lanes, from the NE corner, clockwise.") == type(ANY)(
        ("north-east",), ("x",), ("north-east",), (True,)
    )
    assert read_cues("Lanes, the other way round, starting where you like.").turns == ANY.turns


def test_an_answer_that_must_close_can_go_somewhere_else() -> None:
    facts = ground("SurveyTarget", "The usual survey square at the radius given.", SQUARE)
    script = TaskScript(VOCABULARY, SchemaValues(), facts).closing()
    named = script.following('{"skill_sequence":[' + STEP_OPENS)
    assert named is not None
    movement = named[1].following("GoToXY")
    assert movement is not None and movement[0]
    assert isinstance(script, TaskScript) and script.ground.following(())


def test_any_limit_is_kept(tokenizer: Any) -> None:
    record = {
        "task": "BathymetryGridSurvey",
        "prompt": "Lawnmower over the area, from the north-east corner.",
        "parameters": GRID,
    }
    ends = (int(tokenizer.eos_token_id),)
    factory = constraint_factory(
        tokenizer, "task", VOCABULARY, "grounded", end_ids=ends, limit=4096
    )
    assert factory is not None
    rng = random.Random(0)
    for limit in range(factory.least_tokens, factory.least_tokens + 400, 40):
        answer = factory.start(record, limit)
        for _token in range(limit):
            allowed = np.flatnonzero(np.unpackbits(answer.mask().view(np.uint8), bitorder="little"))
            token = int(rng.choice(list(allowed)))
            answer.accept(token)
            if token in ends:
                break
        assert answer.ended
