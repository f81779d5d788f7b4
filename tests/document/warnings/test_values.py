"""Values in steps and tasks that nobody said, and how they are shown."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.document import apply, revise

from ...documents import USV, document, step, task


def texts(plan: dict[str, Any], kind: str = "skill-value-not-said") -> list[str]:
    return [one["text"] for one in plan["warnings"] if one["kind"] == kind]


def to(*steps: dict[str, Any], prompt: str = "Go to [30, 40].") -> dict[str, Any]:
    return task("Transit", {"target_position": [30, 40]}, [*steps], prompt)


@pytest.mark.parametrize(
    ("said", "count"), [("offset 5 m, 40 m of it", 1), ("40 m off, 40 m of it", 0)]
)
def test_a_number_that_is_said_once_is_one_value(said: str, count: int) -> None:
    values = {"side_id": "north", "length": 40, "distance": 40}
    along = task("ParallelStructurePass", values, None)
    plan = document([along], command=f"Along the north side of the hulk at 77,31, {said}.")
    assert len(texts(plan, "value-not-said")) == count


def test_words_of_one_value_are_no_part_of_another() -> None:
    look = task("HorizontalPanorama", {"sectors": 8}, None)
    for place, count in (([30, 98], 1), ([30, 90], 0)):
        plan = document(
            [task("Transit", {"target_position": place}, None), look],
            command="Go to thirty ninety eight sectors there.",
        )
        found = [one for one in texts(plan, "value-not-said") if "some words" in one]
        assert len(found) == count


@pytest.mark.parametrize(
    ("command", "arc", "count"),
    [
        ("Once round the barge at [9, 9] at 8 m, wait, too close, eighteen.", 18, 1),
        ("Round the barge at [9, 9] through 180 at 8 m.", 180, 0),
        ("Round the barge at [9, 9], 180 degrees, at 8 m.", 180, 0),
        ("Half round the barge at [9, 9] at 8 m.", 180, 0),
        ("Round the barge east of the pier, [9, 9], at 8 m.", 90, 1),
        ("A quarter of the way round the barge at [9, 9] from the east at 8 m.", 90, 0),
    ],
)
def test_a_turn_is_no_bare_number(command: str, arc: float, count: int) -> None:
    orbit = task("PerformOrbit", {"center": [9, 9], "radius": 8, "arc": arc}, None)
    assert len(texts(document([orbit], command=command), "value-not-said")) == count


@pytest.mark.parametrize(
    ("command", "count"),
    [
        ("Tail vessel 7, don't get within 30 m of him.", 1),
        ("Tail vessel 7, but stay within 30 m of home.", 0),
        ("Tail vessel 7, no farther out than 30 m.", 0),
    ],
)
def test_what_is_kept_off_something_is_no_way_from_home(command: str, count: int) -> None:
    follow = task("FollowTarget", {"target_id": "vessel 7"}, None)
    limit = "The vehicle stays within 30 m of home."
    plan = document([follow], command=command, constraints=[limit])
    assert len([one for one in texts(plan, "value-not-said") if "within 30 m" in one]) == count


def test_a_coordinate_is_no_distance_to_keep() -> None:
    limit = "The vehicle keeps at least 150 m from every obstacle."
    for command, count in (("Go from 150,0 to 30,40.", 1), ("Keep 150 m off all, go 150,0.", 0)):
        plan = document([to(GO)], command=command, constraints=[limit])
        found = [one for one in texts(plan, "value-not-said") if "150 m from every" in one]
        assert len(found) == count


GO = step("GoToXY", {"x": 30, "y": 40})
COMMAND = "Go to [30, 40]."


@pytest.mark.parametrize(
    ("steps", "said"),
    [
        ([GO], []),
        ([GO, step("StationKeep", {"time": 45})], ["StationKeep has time 45 s"]),
        (
            [GO, step("StationKeep", {"time": 45, "radius": 3})],
            ["StationKeep has time 45 s", "StationKeep has radius 3 m"],
        ),
        ([GO, step("GoToXY", {"x": 31, "y": 40})], ["GoToXY has waypoint [31, 40]"]),
        ([step("GoToXY", {"x": 30, "y": 40, "yaw": 77})], ["GoToXY has yaw 77 deg"]),
    ],
)
def test_values_of_steps_are_shown_with_their_unit(
    steps: list[dict[str, Any]], said: list[str]
) -> None:
    found = texts(document([to(*steps)], command=COMMAND))
    assert [one.split(": ")[1].split(",")[0] for one in found if "[" not in one] == [
        one for one in said if "[" not in one
    ]
    assert len(found) == len(said)


def test_what_was_said_added_or_set_is_not_questioned() -> None:
    hold = step("StationKeep", {"time": 45})
    assert texts(document([to(GO, hold)], command="Go to [30, 40], wait 45 s.")) == []
    assert texts(document([to(GO, hold, prompt="Wait 45 s at [30, 40].")], command=COMMAND)) == []
    plan = document([to(GO, hold)], command=COMMAND)
    where = {"kind": "skill", "task": "t1", "role": "navigation", "index": 0}
    moved = apply(plan, {**where, "step": 0, "name": "yaw", "value": 9}, USV)
    assert len(texts(moved)) == 1, "the hold is still the model's"
    held = apply(plan, {**where, "step": 1, "name": "radius", "value": 9}, USV)
    assert len(texts(held)) == 1 and "45 s" in texts(held)[0]
    assert texts(apply(plan, {**where, "step": 1, "name": "time", "value": 50}, USV)) == []
    skills = {"kind": "skills", "task": "t1", "skill_sequence": [GO, hold, hold]}
    assert len(texts(apply(plan, skills, USV))) == 1
    stale = apply(plan, {"kind": "prompt", "task": "t1", "text": "Go."}, USV)
    assert texts(stale) == []
    marked = {
        **plan,
        "tasks": [
            {
                **plan["tasks"][0],
                "added": [
                    {
                        "step": 1,
                        "role": "navigation",
                        "name": "StationKeep",
                        "kind": "vehicle",
                        "note": "",
                    }
                ],
            }
        ],
    }
    assert texts(revise(marked, USV)) == []


@pytest.mark.parametrize(
    ("name", "value", "shown"),
    [
        ("sectors", 7, "sectors is 7,"),
        ("wait", 9.5, "wait is 9.5 s,"),
        ("overlap", 30, "overlap is 30 %,"),
    ],
)
def test_values_of_tasks_are_shown_with_their_unit(name: str, value: float, shown: str) -> None:
    turns = [step("RotateToHeading", {"heading": heading}) for heading in (0, 180)]
    look = task("HorizontalPanorama", {name: value}, turns)
    found = texts(document([look], command="Take a panorama."), "value-not-said")
    assert [one for one in found if shown in one]


def test_a_long_text_that_nobody_said_is_cut_to_60_characters() -> None:
    for count in (60, 61):
        search = task("SearchAndDetect", {"target_description": "x" * count}, [step("StationKeep")])
        (found,) = texts(document([search], command="Find it."), "value-not-said")
        assert found.count("x") == 60


@pytest.mark.parametrize(
    ("command", "limit", "count"),
    [
        ("Film the pier from casting off to coming home.", "Nothing is recorded.", 1),
        ("Go there and record nothing.", "Nothing is recorded.", 0),
        ("Go there, never over 4 knots.", "The vehicle goes no faster than 2.06 m/s.", 0),
        ("Go there, never over 4 knots.", "The vehicle goes no faster than 5 m/s.", 1),
        ("Stay 9 m off the dredgr.", "The vehicle stays at least 9 m from the dredger.", 0),
        ("Stay 9 m off the rig.", "The vehicle stays at least 9 m from the far keel.", 1),
    ],
)
def test_a_limit_is_one_of_the_command(command: str, limit: str, count: int) -> None:
    plan = document([to(GO)], command=command, constraints=[limit])
    assert len([one for one in texts(plan, "value-not-said") if "has the limit" in one]) == count


def test_a_time_has_a_unit_that_is_said() -> None:
    hold = [task("KeepStation", {"duration": 5}, [step("StationKeep", {"time": 5})])]
    for command, count in (("Hold for five.", 1), ("Hold for five seconds.", 0)):
        found = texts(document(hold, command=command), "value-not-said")
        assert len([one for one in found if "no unit" in one]) == count


def test_a_unit_that_is_not_known_is_told() -> None:
    circle = task("PerformOrbit", {"center": [9, 9], "radius": 20}, None)
    for said, word in (
        *(("20 mSv/cm²", "mSv/cm²"), ("20 qt/ac", "qt/ac"), ("20 kGy", "kGy")),
        *(("20", ""), ("20 m", ""), ("20 metrs", ""), ("20 off", ""), ("20 rnd", "")),
        *(("20 ccw", ""), ("20 counterclockwise", ""), ("20 bxq", "")),
    ):
        plan = document([circle], command=f"Circle the barge at [9, 9] at a radius of {said}.")
        found = [one for one in texts(plan, "value-not-said") if "not known" in one]
        own = f'Task 1, PerformOrbit: radius is 20 m, and the command says it in "{word}", a unit'
        assert found == ([f"{own} that is not known."] if word else []), said


def test_a_place_that_follows_is_named_only_where_a_value_is_lost() -> None:
    command = "Go to [30, 40], then 10 m further north{}."
    tasks = [
        to(GO),
        task("Transit", {"target_position": [30, 50]}, [step("GoToXY", {"x": 30, "y": 50})]),
    ]
    whole = document(tasks, command=command.format(""))
    assert texts(whole, "value-not-said") == []
    lost = document(tasks, command=command.format(", hold ten minutes"))
    assert texts(lost, "value-not-said") == [
        "Task 2, Transit: target_position is [30, 50], which is worked out and not said."
    ]


@pytest.mark.parametrize(("x", "count"), [(70, 0), (71, 1)])
def test_a_waypoint_follows_from_the_one_before_it(x: float, count: int) -> None:
    places = [(30, 40), (30, 47), (50, 47), (50, 54), (x, 54)]
    way = [step("GoToXY", {"x": east, "y": north}) for east, north in places]
    prompt = "Go to [30, 40], then twice 7 m north and 20 m east."
    assert len(texts(document([to(*way, prompt=prompt)], command=COMMAND))) == count


def test_a_command_with_what_could_not_be_read_has_a_note() -> None:
    kinds = [one["kind"] for one in document([to(GO)], command=COMMAND)["warnings"]]
    assert "unread-command" not in kinds


@pytest.mark.parametrize(
    ("command", "told"),
    [("Do three lengths between 20,0 and 20,80.", 2), ("Map 20 by 80 m at 20,80.", 0)],
)
def test_a_coordinate_is_no_measure(command: str, told: int) -> None:
    values = {"center": [20, 0], "width": 20, "length": 80, "spacing": 10}
    grid = task("BathymetryGridSurvey", values, None, "Map it.")
    said = texts(document([grid], command=command), "value-not-said")
    assert sum("width" in one or "length" in one for one in said) == told


def test_an_area_that_is_said_by_its_corners_is_said() -> None:
    command = "Map the box 20,20 / 100,20 / 100,80 / 20,80, 10 m lines{}."
    values = {"center": [60, 50], "width": 80, "length": 60, "spacing": 10}
    for own, lost, count in (
        (values, "", 0),
        (values, ", hold an hour", 0),
        ({"width": 20}, "", 2),
    ):
        grid = task("BathymetryGridSurvey", values | own, None, "Map it.")
        plan = document([grid], command=command.format(lost))
        assert len(texts(plan, "value-not-said")) == count


def test_a_place_that_follows_is_named_where_a_place_is_only_told_of() -> None:
    near = task("Transit", {"target_position": [30, 50]}, [step("GoToXY", {"x": 30, "y": 50})])
    command = "Go to [30, 40], then 10 m further north. A boom lies from 90,0 to 90,20."
    (found,) = texts(document([to(GO), near], command=command), "value-not-said")
    assert "[30, 50], which is worked out" in found


@pytest.mark.parametrize(
    ("command", "constraint", "kind", "count"),
    [
        ("Go to [30, 40]. There's a mast in the middle.", "", "thing-not-mentioned", 1),
        ("Go to [30, 40]. There's a mast in it.", "Mind the mast.", "thing-not-mentioned", 0),
        ("Go to [30, 40]. I want the boat back soon.", "", "thing-not-mentioned", 0),
        ("Go to [30, 40]. Circle the mast.", "", "thing-not-mentioned", 0),
        ("Go to [30, 40].", "The vehicle has no task for shopping.", "value-not-said", 1),
        ("Go for [30, 40].", "The vehicle has no task for forecasting.", "value-not-said", 1),
        ("Shop, go to [30, 40].", "The vehicle has no task for shopping.", "value-not-said", 0),
        ("Jam it, go to [30, 40].", "The vehicle has no task for jamming.", "value-not-said", 0),
    ],
)
def test_things_and_tasks_that_are_not_there_are_those_of_the_command(
    command: str, constraint: str, kind: str, count: int
) -> None:
    assert len(texts(document([to()], command=command, constraints=[constraint]), kind)) == count


def test_a_lost_value_is_shown_with_its_clause() -> None:
    found = texts(document([to()], command="Go to [30, 40], hold for 5 minutes."), "value-lost")
    assert found == ['The command says "5 minutes" ("hold for 5 minutes"), and no task has it.']


def test_the_spacing_of_a_grid_is_not_its_size() -> None:
    def told(command: str, **sizes: float) -> list[str]:
        given = {"center": [80, 80], "spacing": 10, **sizes}
        grid = task("BathymetryGridSurvey", given, None, "Map it.")
        found = texts(document([grid], command=command), "value-not-said")
        return [text for text in found if "width" in text or "length" in text]

    once = "Depth survey, centre 80,80, lines ten metres apart."
    assert len(told(once, width=10, length=10)) == 2
    assert (
        told(
            "Depth survey, centre 80,80, ten by ten metres, lines ten metres apart.",
            width=10,
            length=10,
        )
        == []
    )
    assert told("Depths around 80,80, 40 by 20 m, lines 10 m.", width=40, length=20) == []


def test_a_short_word_is_not_near_every_other_one() -> None:
    prompts = (("Go to the rț at [30, 40].", 1), ("Go to the rig at [30, 40].", 0))
    for prompt, count in prompts:
        plan = document([to(GO, prompt=prompt)], command="Go on to the rig at [30, 40].")
        plan["proposed"] = {"tasks": [dict(one) for one in plan["tasks"]]}
        found = texts(revise(plan, USV), "value-not-said")
        assert len([text for text in found if "its prompt says" in text]) == count
