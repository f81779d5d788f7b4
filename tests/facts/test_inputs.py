"""Where a value is from: the text, the task, the vehicle, arithmetic, nobody."""

from __future__ import annotations

import itertools
from dataclasses import replace
from typing import Any

import pytest

from planner_ft.benchmark.metrics.alignment import plan_entries
from planner_ft.benchmark.metrics.facts import given_values
from planner_ft.data.missions import sample_missions
from planner_ft.data.task.sampler import Split, sample_tasks
from planner_ft.facts import SCORING, WAYPOINT, read_input
from planner_ft.facts.geometry import Ground, turned
from planner_ft.support.files import read_jsonl
from planner_ft.vocabulary import Parameter, load_vocabulary
from planner_ft.vocabulary.plans import Level

USV = load_vocabulary()
PLACE, FENCE = Parameter("center", "position", "m"), Parameter("fence", "polygon", "m")
TIME, HEADING = Parameter("time", "number", "s"), Parameter("heading", "number", "deg")
GRID = {"center": [10, 20], "width": 20, "length": 10, "spacing": 10}


def kind(prompt: str, value: Any, parameter: Parameter, **record: Any) -> str:
    return read_input({"prompt": prompt, **record}, USV).evidence(value, parameter).kind


@pytest.mark.parametrize(
    ("prompt", "value", "parameter", "expected"),
    [
        ("Go out.", [0, 0], PLACE, "vehicle"),
        ("Go out.", [-99, -99], PLACE, "vehicle"),
        ("Go out.", [4, 5], PLACE, "nobody"),
        ("Go 30 m north of [4, 5].", [4, 35], PLACE, "derived"),
        ("Stay in the box from (1, 2) to (40, 20).", [[1, 2], [40, 2], [40, 20], [1, 20]], FENCE,
         "derived"),
        ("Stay in a 30 m square round [5, 5].", [[-25, -25], [35, -25], [35, 35], [-25, 35]], FENCE,
         "derived"),
        ("Stay in the box.", [[1, 2], [40, 2], [40, 20]], FENCE, "nobody"),
        ("Hold a minute, then twice as long.", 120, TIME, "derived"),
        ("Hold a minute, then as long.", 120, TIME, "nobody"),
    ],
)  # fmt: skip
def test_values_of_a_mission(prompt: str, value: Any, parameter: Parameter, expected: str) -> None:
    assert kind(prompt, value, parameter) == expected


@pytest.mark.parametrize(
    ("prompt", "parameters", "point", "before", "expected"),
    [
        ("Run the grid.", GRID, [0, 15], [], "derived"),
        ("Run the grid.", GRID, [5, 25], [(0, 15)], "nobody"),
        ("Run the grid.", GRID, [10, 20], [], "stated"),
        ("Run a zigzag.", GRID, [7, 7], [], "unread"),
        ("Stop 30 m north of there.", {"target_position": [10, 0]}, [10, 30], [], "derived"),
        ("Stop 30 m north of there.", {"target_position": [10, 0]}, [10, 31], [], "nobody"),
        ("20 m north, 30 m east.", {"target_position": [10, 0]}, [40, 20], [(10, 20)], "derived"),
        ("Survey it.", {"target_position": [10, 10], "radius": 5}, [15, 15], [], "derived"),
        ("Six points round it.", {"center": [0, 10], "radius": 10}, [8.66, 15], [], "derived"),
        ("Six points round it.", {"center": [0, 10], "radius": 10}, [8, 16], [], "nobody"),
        ("[11, 0] to [51, 0] in five points.", {}, [21, 0], [], "derived"),
    ],
)
def test_waypoints(
    prompt: str, parameters: Any, point: list[float], before: Any, expected: str
) -> None:
    record = {"prompt": prompt, "task": "Transit", "parameters": parameters}
    if "width" in parameters:
        record["task"] = "BathymetryGridSurvey"
    if "radius" in parameters:
        record["task"] = "SurveyTarget" if "target_position" in parameters else "PerformOrbit"
    assert read_input(record, USV).evidence(point, WAYPOINT, before=before).kind == expected


def test_a_task_s_own_values_are_stated() -> None:
    record = {"task": "KeepStation", "parameters": {"duration": 240, "note": ["red mark"]}}
    assert kind("Hold for the duration.", 240, TIME, **record) == "stated"
    assert kind("Hold.", "red mark", Parameter("label", "text"), **record) == "stated"
    assert kind("Hold.", "mark", Parameter("label", "text"), **record) == "stated"
    assert kind("Hold.", 120, TIME, **record) == "nobody"


def test_even_turns_and_the_way_back_follow() -> None:
    record = {"task": "HorizontalPanorama", "parameters": {"sectors": 4}}
    assert kind("Turn to each heading.", 270, HEADING, **record) == "derived"
    assert kind("Turn to each heading.", 200, HEADING, **record) == "nobody"
    assert {45.0, 135.0, 225.0, 315.0} <= set(turned([45], [4]))


def nobodys(level: Level, records: list[dict[str, Any]]) -> tuple[int, int]:
    """Labelled values that nobody gave, of those that could be judged."""
    kinds = []
    for record in records:
        source = read_input(record if level == "task" else {"prompt": record["prompt"]}, USV)
        before: list[tuple[float, float]] = []
        for given in given_values(plan_entries(level, record["expected"]), USV):
            place = given.parameter.name == WAYPOINT.name
            parameter = WAYPOINT if place else given.parameter
            kinds.append(source.evidence(given.value, parameter, SCORING, before).kind)
            before += [tuple(given.value)] if place else []
    return kinds.count("nobody"), len(kinds) - kinds.count("unread")


def test_labelled_values_of_missions_have_evidence() -> None:
    splits = ("train", "validation", "test")
    curated = [record for split in splits for record in read_jsonl(f"data/mission/{split}.jsonl")]
    assert nobodys("mission", curated) == (0, 615)
    drawn = [record for seed in (5, 6, 7) for record in sample_missions(seed, 300)]
    missed, judged = nobodys("mission", drawn)
    assert missed <= judged / 200  # Sums in words ("from ten to half past") are not computed.


@pytest.mark.parametrize("split", ["train", "test"])
def test_labelled_values_of_tasks_have_evidence(split: Split) -> None:
    missed, judged = nobodys("task", list(itertools.islice(sample_tasks(USV, 3, None, split), 150)))
    assert missed <= judged / 60


def test_turns_of_a_list_that_takes_them_up_are_bounded() -> None:
    values = [45.0]
    values += itertools.islice(turned(values, {4}), 1000)
    assert len(values) < 100
    assert len(list(turned([float(angle) for angle in range(500)], {4, 36}))) < 1000


def test_points_of_an_area_follow_from_its_middle_its_corners_and_its_lanes() -> None:
    nothing = {"places": (), "centres": (), "lengths": (), "bearings": (), "counts": ()}
    between = Ground(**nothing | {"centres": ((0, 0), (20, 10))}, sizes=())
    assert between.areas == [(10, 5, 20, 10)]
    cornered = Ground(**nothing | {"places": ((0, 0),)}, sizes=((20, 10),), corners=True)
    quarters = {(x, y, 20, 10) for x in (10, -10) for y in (5, -5)}
    assert set(cornered.areas) == {(0, 0, 20, 10), *quarters}
    middle = Ground(**nothing | {"places": ((0, 0),)}, sizes=((20, 10),), spacing=5)
    assert middle.spacings(20, 10) == (5,)
    ends = {(x, y) for x in range(-20, 21, 5) for y in range(-20, 21, 5)}
    lanes = {(x, y) for x in (-10, -5, 0, 5, 10) for y in (-5, 5)}
    lanes |= {(x, y) for x in (-10, 10) for y in (-5, 0, 5)}
    assert {end for end in ends if middle.has_shape_through(end)} == lanes
    shared = Ground(**nothing | {"counts": (5,)}, sizes=())
    assert shared.spacings(20, 10) == (5, 2.5)


LENGTH, HOURS, COUNT = (Parameter("it", "number", unit) for unit in ("m", "h", None))
SPEED, TURN = Parameter("it", "number", "m/s"), Parameter("it", "number", "deg")
PANORAMA = {"task": "HorizontalPanorama", "parameters": {"sectors": 3}}
STAY = {"task": "KeepStation", "parameters": {"duration": 240}}


@pytest.mark.parametrize(
    ("prompt", "record", "parameter", "values"),
    [
        ("At 5 m.", {}, LENGTH, {5}),
        ("At 5 m, then twice as far.", {}, LENGTH, {5, 10}),
        ("At 5 m, then half the distance, then thrice.", {}, LENGTH, {5, 2.5, 15}),
        ("Hold 5 s, then twice as long.", {}, TIME, {5, 10}),
        ("At 5 m/s, then twice as fast.", {}, SPEED, {5}),
        ("Hold.", STAY, TIME, {240}),
        ("Hold twice as long.", STAY, TIME, {240, 480}),
        ("Hold.", STAY, HOURS, {240 / 3600}),
        ("Hold.", STAY, LENGTH, set()),
        ("Hold.", STAY, COUNT, {240}),
        ("Hold.", {"task": "Sail", "parameters": {"it": [7, "8", [9]]}}, LENGTH, {7}),
        ("Turn east, half round.", {}, TURN, {90, 180, 0.5}),
        ("Turn.", PANORAMA, TURN, {-120, 0, 120, 240}),
    ],
)
def test_the_numbers_that_a_parameter_can_have(
    prompt: str, record: Any, parameter: Parameter, values: set[float]
) -> None:
    assert set(read_input({"prompt": prompt, **record}, USV).values(parameter)) == values


PERIMETER = {"task": "BathymetryGridSurvey", "parameters": GRID}


@pytest.mark.parametrize(
    ("prompt", "record", "given"),
    [
        ("Go out.", {}, {"places": ((0, 0),), "centres": ((0, 0),)}),
        (
            "Go 5 m east of [3, 4] or back, three buoys.",
            {},
            {
                "places": ((3, 4), (0, 0)),
                "centres": ((3, 4),),
                "lengths": (5,),
                "bearings": (3, 90),  # A bare number may be a heading.
                "counts": (3, 4, 5),
                "sizes": ((5, 5),),
            },
        ),
        (
            "Steer 45 degrees for 5 m, later 6 m, twice as far from the corner.",
            {},
            {
                "places": ((0, 0),),
                "centres": ((0, 0),),
                "lengths": (5, 6, 10, 12),
                "bearings": (45,),
                "counts": (5, 6),
                "sizes": tuple(itertools.product((5, 6, 10, 12), repeat=2)),
                "corners": True,
            },
        ),
        (
            "Run the grid.",
            PERIMETER,
            {
                "places": ((10, 20), (0, 0)),
                "centres": ((10, 20),),
                "lengths": (10, 20),
                "sizes": ((20, 10),),
                "spacing": 10,
            },
        ),
        # Another length than the task's own: it may be of another area.
        (
            "Run the grid, 7 m around [0, 0].",
            PERIMETER,
            {
                "places": ((10, 20), (0, 0)),
                "centres": ((10, 20),),
                "lengths": (7, 10, 20),
                "counts": (7,),
                "sizes": tuple(itertools.product((7, 10, 20), repeat=2)),
            },
        ),
        ("Turn.", PANORAMA, {"places": ((0, 0),), "centres": ((0, 0),), "counts": (3,)}),
        ("Back off -5 m, later 0 m.", {}, {"places": ((0, 0),), "centres": ((0, 0),)}),
        (
            "Steer 390 degrees for 5 m.",
            {},
            {
                "places": ((0, 0),),
                "centres": ((0, 0),),
                "lengths": (5,),
                "bearings": (30,),
                "counts": (5,),
                "sizes": ((5, 5),),
            },
        ),
        ("Run a zigzag.", {}, None),
        ("Go to x 40, then on.", {}, None),
        ("Go three furlongs.", {}, None),
        (" and ".join(f"{n} m" for n in range(1, 11)), {}, None),
        (" to ".join(f"[{n}, 7]" for n in range(1, 13)), {}, None),
    ],
)
def test_what_waypoints_are_derived_from(prompt: str, record: Any, given: Any) -> None:
    found = read_input({"prompt": prompt, **record}, USV).ground
    empty = {**dict.fromkeys(("lengths", "bearings", "counts", "sizes"), ()), **(given or {})}
    assert found == (Ground(**empty) if given is not None else None)


def test_lengths_of_a_task_in_another_unit_are_metres() -> None:
    orbit = USV.task["PerformOrbit"]
    far = replace(orbit.by_name["radius"], unit="km")
    vehicle = replace(USV, tasks=(replace(orbit, parameters=(orbit.by_name["center"], far)),))
    own = {"task": "PerformOrbit", "parameters": {"center": [5, 5], "radius": 0.5}}
    ground = read_input({"prompt": "Circle it.", **own}, vehicle).ground
    assert ground is not None and ground.lengths == (500,)


def test_nine_lengths_and_twelve_places_are_not_too_many() -> None:
    lengths, places = (
        read_input({"prompt": prompt}, USV).ground
        for prompt in (
            " and ".join(f"{n} m" for n in range(1, 10)),
            " to ".join(f"[{n}, 7]" for n in range(1, 12)),
        )
    )
    assert lengths is not None and len(lengths.lengths) == 9
    assert places is not None and len(places.places) == 12


@pytest.mark.parametrize(
    ("prompt", "value", "parameter", "record", "expected"),
    [
        ("Hold.", 241, TIME, STAY, "nobody"),
        ("Hold 2.", 2, Parameter("it", "integer"), STAY, "stated"),
        ("Hold.", "240", TIME, STAY, "nobody"),
        ("Hold.", [10, 20], PLACE, PERIMETER, "stated"),
        ("Hold.", [10, 21], PLACE, PERIMETER, "nobody"),
        ("Hold.", [0, 0], WAYPOINT, PERIMETER, "vehicle"),
        ("Hold.", [0, 0], WAYPOINT, {}, "vehicle"),
        ("Hold.", [-99, -99], WAYPOINT, {}, "nobody"),
        ("Hold.", "x", WAYPOINT, {}, "nobody"),
        ("Hold.", "x", PLACE, {}, "nobody"),
        ("Hold at x 40, then on.", [7, 8], WAYPOINT, {}, "unread"),
        ("Hold at x 40, then on.", [[7, 8]], FENCE, {}, "unread"),
        ("Run a zigzag.", [[7, 8]], FENCE, {}, "nobody"),
        ("From [5, 6] to [8, 9].", [[5, 6], [8, 9]], FENCE, {}, "stated"),
        ("From [5, 6] to [8, 9].", [[0, 0], [8, 9]], FENCE, {}, "derived"),
        ("The red buoy.", ["buoy", "mark"], Parameter("it", "texts"),
         {"task": "Sail", "parameters": {"note": "old mark"}}, "stated"),
        ("The red buoy.", ["buoy", "pier"], Parameter("it", "texts"),
         {"task": "Sail", "parameters": {"note": "old mark"}}, "nobody"),
        ("The buoy.", "THE old  mark", Parameter("it", "text"),
         {"task": "Sail", "parameters": {"note": "old mark"}}, "stated"),
        ("The buoy.", "mark", Parameter("it", "text"), {}, "nobody"),
        ("Go 30 m north of [4, 5].", [4, 36], PLACE, {}, "nobody"),
        ("Hold a minute, then twice as long.", 121, TIME, {}, "nobody"),
        ("Hold a minute, then twice as long.", "120", TIME, {}, "nobody"),
    ],
)  # fmt: skip
def test_kinds_of_evidence(
    prompt: str, value: Any, parameter: Parameter, record: Any, expected: str
) -> None:
    assert kind(prompt, value, parameter, **record) == expected


def test_tolerance_holds_for_the_task_s_own_values_too() -> None:
    source = read_input({"prompt": "Hold.", **STAY}, USV)
    assert source.evidence(243, TIME).kind == "nobody"
    assert source.evidence(243, TIME, SCORING).kind == "stated"
    grid = read_input({"prompt": "Run it.", **PERIMETER}, USV)
    assert grid.evidence([10.2, 20.3], WAYPOINT).kind == "nobody"
    assert grid.evidence([10.2, 20.3], WAYPOINT, SCORING).kind == "stated"


@pytest.mark.parametrize(
    ("command", "place", "follows"),
    [
        ("Depth grid from [20, 20] to [120, 80].", [70, 50], True),
        ("Depth grid from [20, 20] to [120, 80].", [70, 60], False),
        ("Grid of 40 m by 20 m, its south-west corner at [10, 10].", [30, 20], True),
        ("Grid of 40 m by 20 m, its south-west corner at home.", [20, 10], True),
        ("From [40, 10] 200 m north, then 80 m east.", [40, 210], True),
        ("From [40, 10] 200 m north, then 80 m east.", [120, 210], True),
        ("From [40, 10] 200 m north, then 80 m east.", [40, 190], False),
    ],
)
def test_places_of_a_mission_follow_from_those_that_it_says(
    command: str, place: list[float], follows: bool
) -> None:
    position = USV.task["Transit"].by_name["target_position"]
    found = read_input({"prompt": command}, USV).evidence(place, position)
    assert (found.kind == "derived") is follows


def test_sides_of_an_area_follow_from_its_corners() -> None:
    survey = USV.task["BathymetryGridSurvey"].by_name
    source = read_input({"prompt": "Depth grid from [20, 20] to [120, 80]."}, USV)
    assert {100, 60} <= set(source.values(survey["width"]))
    assert not {100, 60} & set(source.values(survey["spacing"]))
    from_home = read_input({"prompt": "Sound the basin between [0,0] and [80,60]."}, USV)
    assert {80, 60} <= set(from_home.values(survey["width"]))


def test_an_area_of_four_corners_follows_among_many_other_places() -> None:
    others = " ".join(f"{at},{2 * at}" for at in range(1, 12))
    source = read_input({"prompt": f"Box 30,30 / 90,30 / 90,70 / 30,70. Not: {others}."}, USV)
    center = USV.task["BathymetryGridSurvey"].by_name["center"]
    assert source.evidence([60, 50], center).kind == "derived"
    assert {60, 40} <= set(source.values(USV.task["BathymetryGridSurvey"].by_name["width"]))


def test_places_that_are_worked_out_lie_as_far_off_as_the_numbers_reach() -> None:
    said = "Patrol between 100,0 and 100,200 three times."
    worked = read_input({"prompt": said}, USV).worked_places
    assert worked
    assert max(abs(part) for place in worked for part in place) <= 600
    far = read_input({"prompt": "Go to 40,0, then 1,200 m north."}, USV).worked_places
    assert (40, 1200) in far


@pytest.mark.parametrize(
    ("said", "place", "derived"),
    [
        ("Go to 40,188, then 16 m on heading 095.", (55.94, 186.61), True),
        ("Go to 40,188, then 16 m at 095.", (55.94, 186.61), True),
        ("Go to 40,188, then 16 m on 95 degrees.", (55.94, 186.61), True),
        ("Go to 40,188, then 16 m on 390 degrees.", (48, 201.86), True),
        ("Go to 40,188, then 16 m north.", (40, 204), True),
        ("Go 16 m north.", (0, 16), True),
        ("Map between [-119, 85] and [10, 5].", (-54.5, 45), True),
        ("Go to 40,188, 16 m off, for 95 seconds.", (55.94, 186.61), False),
        ("Circle the wreck at -119,85 69 metres off.", (-17, 77), False),
        ("Pass the north side of the cable at -103,57.", (-103, 114), False),
        ("Go to 40,188, 16 m off, 95 times.", (55.94, 186.61), False),
    ],
)
def test_places_are_worked_out_along_directions_that_are_said(
    said: str, place: tuple[float, float], derived: bool
) -> None:
    worked = read_input({"prompt": said}, USV).worked_places
    assert (place in {(round(x, 2), round(y, 2)) for x, y in worked}) == derived
