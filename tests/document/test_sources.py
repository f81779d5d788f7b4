"""Where values are from: the words of the command, a place that was located, a rule, the operator,
the model.
"""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.document import PlanDocument, apply
from tests.documents import DRONE, USV, document, task


def source(command: str, title: str, parameters: dict[str, Any], name: str) -> dict[str, Any]:
    plan = document([task(title, parameters, None)], command=command)
    found: dict[str, Any] = plan["tasks"][0]["sources"][name]
    return found


def words(plan: PlanDocument, index: int, name: str) -> list[str]:
    return [
        plan["command"][start:end]
        for start, end in plan["tasks"][index]["sources"][name].get("spans", [])
    ]


@pytest.mark.parametrize(
    ("command", "title", "parameters", "said"),
    [
        ("Hold for half an hour.", "KeepStation", {"duration": 1800}, ["half an hour"]),
        (
            "Hold for two minutes and thirty seconds.",
            "KeepStation",
            {"duration": 150},
            ["two minutes and thirty seconds"],
        ),
        ("Drift for twenty minuets.", "DriftAudit", {"duration": 1200}, ["twenty minuets"]),
        ("Go to x=-40, y=12 now.", "Transit", {"target_position": [-40, 12]}, ["-40, y=12"]),
        (
            "Go 120 east 45 south.",
            "Transit",
            {"target_position": [120, -45]},
            ["120 east 45 south"],
        ),
        (
            "Find the grean barell.",
            "SearchAndDetect",
            {"target_description": "green barrel"},
            ["grean barell"],
        ),
        (
            "There are two buoys. Inspect the red one.",
            "SearchAndDetect",
            {"target_description": "red buoy"},
            ["buoys", "red"],
        ),
        (
            "Send the sonar log, then the photos.",
            "SmartDataHarvest",
            {"target_list": ["sonar log", "photos"]},
            ["sonar log", "photos"],
        ),
        (
            "Shoot a panorama and wait minute at each.",
            "HorizontalPanorama",
            {"wait": 60},
            ["minute"],
        ),
        (
            "Pass it at one metre per second.",
            "ParallelStructurePass",
            {"speed": 1},
            ["one metre per second"],
        ),
    ],
)
def test_the_narrowest_words_that_say_a_value(
    command: str, title: str, parameters: dict[str, Any], said: list[str]
) -> None:
    plan = document([task(title, parameters, None)], command=command)
    name = next(iter(parameters))
    assert plan["tasks"][0]["sources"][name]["kind"] == "command"
    assert words(plan, 0, name) == said


def test_a_compass_direction_is_a_heading_and_a_part_of_a_circle_an_arc() -> None:
    cable = document(
        [task("SubseaCableTrack", {"start": [1, 2], "heading": 315}, None)],
        command="Track the cable from [1, 2] to the north-west.",
    )
    assert words(cable, 0, "heading") == ["north-west"]
    orbit = source(
        "Half a circle round the pier at [1, 2], south wall too.",
        "PerformOrbit",
        {"center": [1, 2], "arc": 180},
        "arc",
    )
    assert orbit == {
        "kind": "derived",
        "spans": [[0, 4]],
        "note": "Half of a circle is 180 degrees",
    }


def test_a_value_that_is_said_twice_is_from_the_words_near_its_task() -> None:
    command = "Circle the pier at [10, 20] at 12 m, then circle the mast at [50, 60] at 12 m."
    tasks = [
        task("PerformOrbit", {"center": center, "radius": 12}, None)
        for center in ([10, 20], [50, 60])
    ]
    plan = document(tasks, command=command)
    assert plan["tasks"][0]["sources"]["radius"]["spans"] == [
        [command.index("12 m"), command.index("12 m") + 4]
    ]
    assert plan["tasks"][1]["sources"]["radius"]["spans"] == [
        [command.rindex("12 m"), command.rindex("12 m") + 4]
    ]


def test_home_and_open_places_are_derived() -> None:
    plan = document(
        [
            task("Transit", {"target_position": [-99, -99]}, None),
            task("Transit", {"target_position": [0, 0]}, None),
        ],
        command="Visit it, come home.",
    )
    assert [entry["sources"]["target_position"]["kind"] for entry in plan["tasks"]] == [
        "derived",
        "derived",
    ]
    assert words(plan, 1, "target_position") == ["come home"]


def test_what_nobody_said_is_the_model_s() -> None:
    assert (
        source(
            "Circle the pier at [1, 2].", "PerformOrbit", {"center": [1, 2], "radius": 25}, "radius"
        )["kind"]
        == "model"
    )
    assert (
        source(
            "Circle the pier at [1, 25].",
            "PerformOrbit",
            {"center": [1, 25], "radius": 20},
            "radius",
        )["kind"]
        == "model"
    )
    assert (
        source("Go out.", "Transit", {"target_position": [0, 0]}, "target_position")["kind"]
        == "model"
    )


def test_the_operator_s_changes_are_the_operator_s() -> None:
    plan = document(
        [task("KeepStation", {"duration": 60}, None)], command="Hold for a minute or for 90 s."
    )
    edited = apply(plan, {"kind": "parameter", "task": "t1", "name": "duration", "value": 90}, USV)
    assert edited["tasks"][0]["sources"]["duration"] == {"kind": "operator", "note": "proposed: 60"}
    inserted = apply(
        edited,
        {
            "kind": "insert",
            "at": 0,
            "title": "Transit",
            "parameters": {"target_position": [5, 5]},
            "task_prompt": "Go.",
        },
        USV,
    )
    assert inserted["tasks"][0]["sources"]["target_position"] == {
        "kind": "operator",
        "note": "inserted",
    }


def test_a_located_place_says_its_name() -> None:
    search = task("SearchAndDetect", {"target_description": "buoy"}, None)
    plan = document(
        [search, task("Transit", {"target_position": [-99, -99]}, None)],
        command="Find the buoy and go there.",
    )
    placed = apply(plan, {"kind": "locate", "name": "buoy", "position": [7, 8]}, USV)
    assert placed["tasks"][1]["sources"]["target_position"] == {
        "kind": "located",
        "note": "resolved location buoy",
    }


def test_another_vehicle() -> None:
    plan = document(
        [task("TowerOrbit", {"center": [3, 4], "radius": 9}, None)],
        DRONE,
        command="Fly round the tower at [3, 4], nine metres off.",
    )
    assert words(plan, 0, "radius") == ["nine metres"] and words(plan, 0, "center") == ["3, 4"]


HOLD = {"duration": 12}


def test_a_value_is_from_the_words_nearest_to_those_of_its_task() -> None:
    command = "Hold for 12 s here, then circle the mast at [50, 60] at 12 m for 12 s."
    tasks = [
        task("KeepStation", HOLD, None),
        task("PerformOrbit", {"center": [50, 60], "radius": 12}, None),
        task("KeepStation", HOLD, None),
    ]
    plan = document(tasks, command=command)
    spans = [one["sources"]["duration"]["spans"] for one in (plan["tasks"][0], plan["tasks"][2])]
    first, last = command.index("12 s"), command.rindex("12 s")
    assert spans == [[[first, first + 4]], [[last, last + 4]]]
    command = "Circle it at 12 m. Then go to [1, 2] and circle the mast at [50, 60], 12 m off."
    given = {"center": [50, 60], "radius": 12}
    plan = document([task("PerformOrbit", given, None)], command=command)
    assert plan["tasks"][0]["sources"]["radius"]["spans"][0][0] == command.rindex("12 m")


@pytest.mark.parametrize(
    ("command", "given", "kind", "note"),
    [
        ("Go to [0, 0], come home.", {"target_position": [0, 0]}, "command", None),
        ("Come home, go home.", {"target_position": [0, 0]}, "derived", "home"),
        (
            "Go out.",
            {"target_position": [0, 0]},
            "model",
            "home, which the command does not speak of",
        ),
        (
            "Go to [3, 4], 10 m north of it.",
            {"target_position": [3, 14]},
            "derived",
            "follows from what the command says",
        ),
        (
            "三 go to [3, 4].",
            {"target_position": [3, 14]},
            "model",
            "the command could not be read with certainty",
        ),
        ("Go to [3, 4].", {"target_position": [3, 14]}, "model", "the command does not say it"),
        (
            "Go to it.",
            {"target_position": [-99, -99]},
            "derived",
            "unresolved location: the command gives no coordinates",
        ),
    ],
)
def test_where_a_position_is_from(
    command: str, given: dict[str, Any], kind: str, note: str | None
) -> None:
    found = source(command, "Transit", given, "target_position")
    assert (found["kind"], found.get("note")) == (kind, note)


def test_home_is_from_the_last_words_that_speak_of_it_and_an_arc_has_no_sign() -> None:
    plan = document(
        [task("Transit", {"target_position": [0, 0]}, None)], command="Go home, go home."
    )
    assert plan["tasks"][0]["sources"]["target_position"]["spans"] == [[9, 16]]
    found = source("Circle a quarter of it.", "PerformOrbit", {"center": [3, 4], "arc": -90}, "arc")
    assert found["note"] == "quarter of a circle is 90 degrees"


@pytest.mark.parametrize(("count", "end"), [(60, "x"), (61, "x ...")])
def test_a_proposed_value_is_shown_to_60_characters(count: int, end: str) -> None:
    plan = document([task("SearchAndDetect", {"target_description": "x" * count}, None)])
    edit = {"kind": "parameter", "task": "t1", "name": "target_description", "value": "y"}
    note = apply(plan, edit, USV)["tasks"][0]["sources"]["target_description"]["note"]
    assert note.endswith(end) and note.count("x") == 60
    added = document([task("KeepStation", {}, None)])
    edit = {"kind": "parameter", "task": "t1", "name": "duration", "value": 9}
    assert apply(added, edit, USV)["tasks"][0]["sources"]["duration"]["note"] == "added"


def test_a_value_is_from_the_words_in_the_midst_of_the_others() -> None:
    command = "Orbit [60, 60] through 180 degrees at 20 m, then survey [90, 10] at 20 m."
    orbit = task("PerformOrbit", {"center": [60, 60], "radius": 20, "arc": 180}, None)
    survey = task("SurveyTarget", {"target_position": [90, 10], "radius": 20}, None)
    plan = document([orbit, survey], command=command)
    spans = [entry["sources"]["radius"]["spans"] for entry in plan["tasks"]]
    assert spans == [[[38, 42]], [[68, 72]]]
