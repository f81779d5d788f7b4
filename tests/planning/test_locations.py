"""Open places are named as the operator would, and filled in by name."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.planning.locations import (
    KEPT_CLEAR,
    OpenPlace,
    fitting,
    open_places,
    parse_location,
    parse_locations,
    resolve,
)
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary

USV = load_vocabulary()
OPEN = [-99, -99]


def plan(*tasks: tuple[str, dict[str, Any], str]) -> dict[str, Any]:
    entries = [
        {"title": title, "parameters": parameters, "task_prompt": prompt}
        for title, parameters, prompt in tasks
    ]
    return {"tasks": entries, "assumptions": [], "constraints": []}


TWO_TARGETS = plan(
    ("SearchAndDetect", {"target_description": "green buoy"}, "Find the green buoy."),
    ("SearchAndDetect", {"target_description": "green barge"}, "Find the green barge."),
    ("Transit", {"target_position": OPEN}, "Go to the green buoy."),
    ("PerformOrbit", {"center": OPEN, "radius": 10}, "Circle it."),
    ("Transit", {"target_position": [4, 5]}, "Go to [4, 5]."),
    ("DockingApproach", {"goal_position": OPEN}, "Dock at the fuel pontoon, then report."),
)


def test_a_place_is_called_by_the_search_that_the_task_speaks_of_and_a_berth_by_the_task_itself() -> (
    None
):
    assert open_places(TWO_TARGETS, USV) == [
        OpenPlace("green buoy", (3,)),
        OpenPlace("green barge", (4,)),
        OpenPlace("fuel pontoon", (6,)),
    ]


def test_a_plan_with_coordinates_leaves_nothing_open() -> None:
    assert open_places(plan(("Transit", {"target_position": [0, 0]}, "Return home.")), USV) == []


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("green buoy=120,-35", ("green buoy", (120.0, -35.0))),
        (" the green buoy = [120.5, -35] ", ("the green buoy", (120.5, -35.0))),
        ("berth=3=1,2", ("berth=3", (1.0, 2.0))),
    ],
)
def test_a_location_is_a_name_and_two_numbers(
    text: str, expected: tuple[str, tuple[float, float]]
) -> None:
    assert parse_location(text) == expected


@pytest.mark.parametrize(
    "text",
    [
        "green buoy",
        "=1,2",
        "buoy=1",
        "buoy=1,2,3",
        "buoy=here,there",
        "buoy=nan,1",
        "buoy=1e999,1",
        "",
    ],
)
def test_anything_else_is_refused_with_an_example(text: str) -> None:
    with pytest.raises(PlannerError, match=r'expected "NAME=x,y" in metres'):
        parse_location(text)


def test_a_name_has_one_position() -> None:
    assert parse_locations(["buoy=1,2", "barge=3,4", "buoy=1,2"]) == {
        "buoy": (1.0, 2.0),
        "barge": (3.0, 4.0),
    }
    with pytest.raises(PlannerError, match="--locate buoy: two positions are given"):
        parse_locations(["buoy=1,2", "buoy=3,4"])


@pytest.mark.parametrize("name", ["green buoy", "The Green  Buoy", "buoy"])
def test_places_are_filled_in_by_name_without_regard_to_case_article_and_spaces(name: str) -> None:
    filled = resolve(TWO_TARGETS, {name: (120.0, -35.5)}, USV)
    assert [place.name for place in open_places(filled, USV)] == ["green barge", "fuel pontoon"]
    assert filled["tasks"][2]["parameters"] == {"target_position": [120, -35.5]}
    assert TWO_TARGETS["tasks"][2]["parameters"] == {"target_position": OPEN}


def test_whole_numbers_are_positions_too() -> None:
    assert resolve(TWO_TARGETS, {"green barge": (3, 4)}, USV)["tasks"][3]["parameters"][
        "center"
    ] == [3, 4]


@pytest.mark.parametrize(
    ("locations", "message"),
    [
        (
            {"red buoy": (1.0, 2.0)},
            (
                '--locate red buoy: no such place is open; there is "green buoy", "green barge",'
                ' "fuel pontoon"'
            ),
        ),
        (
            {"green": (1.0, 2.0)},
            '--locate green: fits several places; there is "green buoy", "green barge"',
        ),
        (
            {"buoy": (1.0, 2.0), "the green buoy": (3.0, 4.0)},
            '"green buoy" is located by "buoy" already',
        ),
        ({"green buoy": (-99.0, -99.0)}, "stands for an unknown place"),
    ],
)
def test_a_location_that_cannot_be_used_is_an_error_that_says_what_is_open(
    locations: dict[str, tuple[float, float]], message: str
) -> None:
    with pytest.raises(PlannerError) as error:
        resolve(TWO_TARGETS, locations, USV)
    assert message in str(error.value)


def test_a_note_says_that_what_is_no_place_of_a_task_is_kept_clear_of() -> None:
    home = plan(("Transit", {"target_position": [0, 0]}, "Return home."))
    fits, (pier, buoy) = fitting(home, {"pier": (50.0, 2.0), "buoy": (-99.0, -99.0)}, USV)
    assert fits == {} and pier.endswith(f"leaves no place open.{KEPT_CLEAR}")
    assert buoy.endswith("give where it is.")


@pytest.mark.parametrize("name", ["room 20", "room 2", "oom 203", "3"])
def test_a_part_of_a_word_or_number_is_no_name(name: str) -> None:
    room = plan(
        ("SearchAndDetect", {"target_description": "room 203"}, "Find room 203."),
        ("Transit", {"target_position": OPEN}, "Go to room 203."),
    )
    fits, (note,) = fitting(room, {name: (5.0, 5.0)}, USV)
    assert fits == {} and 'no such place is open; there is "room 203"' in note
    assert fitting(room, {"203": (5.0, 5.0)}, USV) == ({"203": (5.0, 5.0)}, [])


def test_a_name_in_full_wins_in_any_order() -> None:
    given = {"buoy": (5.0, 5.0), "the green buoy": (9.0, 9.0)}
    for locations in (given, dict(reversed(given.items()))):
        fits, (note,) = fitting(TWO_TARGETS, locations, USV)
        assert fits == {"the green buoy": (9.0, 9.0)}
        assert '"green buoy" is located by "the green buoy" already' in note


def test_a_location_for_a_plan_without_open_places_is_an_error() -> None:
    with pytest.raises(PlannerError, match="leaves no place open"):
        resolve(
            plan(("Transit", {"target_position": [0, 0]}, "Return home.")),
            {"buoy": (1.0, 2.0)},
            USV,
        )


@pytest.mark.parametrize(
    ("prompt", "told"),
    [
        ("Run along the east side of the Mole, 8 m off.", "of the Mole at [60, 40.5], 8 m off."),
        ("Run along the mole at [9, 9].", "Run along the mole at [9, 9]."),
        ("Run along the quay.", "Run along the quay."),
    ],
)
def test_a_pass_is_told_where_its_thing_is(prompt: str, told: str) -> None:
    values = {"side_id": "east", "length": 200, "distance": 8}
    open_plan = plan(
        ("SearchAndDetect", {"target_description": "mole"}, "Find the mole."),
        ("Transit", {"target_position": OPEN}, "Go to the mole."),
        ("ParallelStructurePass", values, prompt),
    )
    waiting = (2, 3) if told != prompt else (2,)
    assert open_places(open_plan, USV) == [OpenPlace("mole", waiting)]
    filled = resolve(open_plan, {"mole": (60, 40.5)}, USV)
    assert filled["tasks"][2]["task_prompt"].endswith(told)
    assert filled["tasks"][1]["task_prompt"] == "Go to the mole."
    assert open_plan["tasks"][2]["task_prompt"] == prompt


def test_every_task_that_is_told_a_place_in_degrees_waits_for_it() -> None:
    degrees = "50 06.35 N 005 02.90 W"
    told = plan(
        ("Transit", {"target_position": OPEN}, f"Go to {degrees}."),
        ("KeepStation", {"duration": 60}, f"Hold at {degrees}."),
        ("Diagnostics", {}, "Check the sensors."),
    )
    assert open_places(told, USV) == [OpenPlace(degrees, (1, 2))]
    filled = resolve(told, {degrees: (40.0, 30.0)}, USV)
    assert filled["tasks"][0]["parameters"] == {"target_position": [40, 30]}
    assert filled["tasks"][1]["task_prompt"] == "Hold at [40, 30]."


def test_a_limit_in_degrees_makes_no_task_wait() -> None:
    limit = "Keep at least 80 m from the wreck at 53.5460 N 9.9500 E."
    assert (
        open_places(plan(("Transit", {"target_position": [4, 5]}, f"Go to [4, 5]. {limit}")), USV)
        == []
    )
