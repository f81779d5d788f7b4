"""What the command asks for and the plan has not, and the other way round, in exact words."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from planner_ft.document.warnings.asked import other_language
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.definition import BUNDLED

from ...documents import document, step, task

KINDS = ("not-planned", "contradiction", "data-not-planned", "missing-return", "value-not-said")


def to(x: float, y: float, prompt: str = "Go there.") -> dict[str, Any]:
    go = step("GoToXY", {"x": x, "y": y})
    return task("Transit", {"target_position": [x, y]}, [go], prompt)


def hold(seconds: float, prompt: str = "Hold.") -> dict[str, Any]:
    return task(
        "KeepStation", {"duration": seconds}, [step("StationKeep", {"time": seconds})], prompt
    )


TURNS = [step("RotateToHeading", {"heading": heading}) for heading in (0, 180)]
PANORAMA = task("HorizontalPanorama", {}, TURNS)
SURVEY = task("SurveyTarget", {"target_position": [30, 40]}, [step("StationKeep")])
REPORT = task("AutoGenerateReportSummary", {}, [step("StationKeep")])
SEARCH = task("SearchAndDetect", {"target_description": "buoy"}, [step("StationKeep")], "Search.")
THERE, BACK = to(30, 40), to(0, 0)


def round_it(prompt: str) -> dict[str, Any]:
    return task("PerformOrbit", {"center": [30, 40], "radius": 9, "arc": 360}, None, prompt)


def told(command: str, *tasks: dict[str, Any], **planned_as: Any) -> list[str]:
    plan = document(tasks, command=command, **planned_as)
    return [one["id"] for one in plan["warnings"] if one["kind"] in KINDS]


@pytest.mark.parametrize(
    ("command", "tasks", "ids"),
    [
        (
            "Go to [30, 40], take a panorama, and come home.",
            [THERE, BACK],
            ["not-planned:panorama"],
        ),
        ("Go to [30, 40], take a panorama, and come home.", [THERE, PANORAMA, BACK], []),
        ("Go to [30, 40], weld the rail and come home.", [THERE, BACK], ["not-planned:weld"]),
        ("Weld the rail.", [], []),
        ("Go to [30, 40], here we want no panorama, come home.", [THERE, BACK], []),
        (
            "Take a panorama but no report, go to [30, 40], come home.",
            [THERE, BACK],
            ["not-planned:panorama"],
        ),
        ("Go to [30, 40] and never weld the rail, come home.", [THERE, BACK], []),
        ("Go to [30, 40], weld, no, scratch that, come home.", [THERE, BACK], []),
        ("Go to [30, 40], dock, and come home.", [THERE, BACK], ["not-planned:dock"]),
        ("Go to [30, 40] by the dock, and come home.", [THERE, BACK], []),
        ("Go to [30, 40] by the old dry dock, and come home.", [THERE, BACK], []),
        (
            "Go to [30, 40] by the very old dry dock, and come home.",
            [THERE, BACK],
            ["not-planned:dock"],
        ),
        ("Go to [30, 40], send the panorama and come home.", [THERE, BACK], ["not-planned:send"]),
        (
            "Go to [30, 40], make some coffee, and come home.",
            [THERE, BACK],
            ["not-planned:make some coffee"],
        ),
        (
            "Go to [30, 40], make some coffee, and come home.",
            [THERE, BACK | {"task_prompt": "Make coffee."}],
            [],
        ),
        ("Go to [30, 40], make for it, and come home.", [THERE, BACK], []),
        ("Go to [30, 40], make 3 knots, and come home.", [THERE, BACK], []),
        ("Go to [30, 40], record nothing, and come home.", [THERE, BACK], []),
        (
            "Go to [30, 40], find the buoy, make coffee, and come home.",
            [SEARCH, THERE, BACK],
            ["not-planned:make coffee"],
        ),
        (
            "Hold here, make coffee, and come home.",
            [to(9, 9), hold(600), BACK],
            [
                "not-planned:make coffee",
                "value-not-said:t1:target_position",
                "value-not-said:t2:duration",
            ],
        ),
        (
            "Hold here, make coffee, and come home.",
            [hold(600), hold(600), BACK],
            ["value-not-said:t1:duration", "value-not-said:t2:duration", "value-not-said:t2:asked"],
        ),
        (
            "Go to [30, 40]. Come home, but do not come home.",
            [THERE],
            ["contradiction:home", "missing-return"],
        ),
        ("Go to [30, 40]. Come home, but do not come home.", [THERE, BACK], ["contradiction:home"]),
        ("Go to [30, 40]. No, do not come home.", [THERE], []),
        ("Go to [30, 40], the stop nearest home.", [THERE], []),
        ("Go to [30, 40], then home.", [THERE], ["missing-return"]),
        ("To [30, 40] and back please.", [THERE], ["missing-return"]),
        ("Go to [30, 40] and return to the first spot.", [THERE], []),
        ("Do not go 150 m from home. Go to [30, 40], home.", [THERE, BACK], []),
        (
            "Look all round. No panorama after all.",
            [PANORAMA],
            ["contradiction:t1:no panorama after all"],
        ),
        ("No panorama. Take a panorama.", [PANORAMA], []),
        ("Take a panorama. No need to hurry or to be late, panorama.", [PANORAMA], []),
        ("Go on and read the gauge.", [PANORAMA], ["value-not-said:t1:asked"]),
        ("Look all round.", [PANORAMA], []),
        ("Go to [31, 40], come home.", [THERE, BACK], ["value-not-said:t1:target_position"]),
        ("Go to 30 40, hold it.", [THERE, hold(40)], ["value-not-said:t2:duration"]),
        ("Go to 30 40, hold it 40 s.", [THERE, hold(40)], []),
        (
            "Go to [30, 40], hold it 40 s.",
            [THERE, hold(40, "Hold 50 s.")],
            ["contradiction:t2:duration"],
        ),
        ("Go to [30, 40], hold it 40 s.", [THERE, hold(40, "Hold 40 s.")], []),
        ("Go to [30, 40], hold it 40 s.", [THERE, hold(40, "Hold at 7 m.")], []),
        ("Go to [30, 40].", [to(30, 40, "Go to [30, 41].")], ["contradiction:t1:target_position"]),
        (
            "Go to [30, 40], next [5, 6], last of all home.",
            [THERE, to(5, 6), THERE, BACK],
            ["value-not-said:t3:asked"],
        ),
        ("Go to [30, 40], then back.", [THERE, BACK], []),
        ("Go to [30, 40], next [5, 6], then again.", [THERE, to(5, 6), THERE], []),
        (
            "Go to [30, 40], then [5, 6]. No, reverse the two.",
            [THERE, to(5, 6)],
            ["contradiction:reverse the two"],
        ),
        ("Go to [30, 40], then [5, 6]. No, reverse the two.", [to(5, 6), THERE], []),
        ("Go to [30, 40]. No, swap the two, [40, 30].", [to(40, 30)], []),
        ("Inspect [30, 40].", [SURVEY, SURVEY], ["value-not-said:t2:asked"]),
        ("Inspect [30, 40] twice.", [SURVEY, SURVEY], []),
        ("Go to [30, 40], [5, 6], [30, 40].", [THERE, to(5, 6), THERE], []),
        ("Go to [30, 40], [5, 6], hold 40 s.", [THERE, to(5, 6), THERE, hold(40)], []),
        (
            "Go to [30, 40]. Summarise. Upload the thermal data.",
            [THERE, REPORT],
            ["not-planned:upload"],
        ),
        ("Go to [30, 40]. Summarise. Upload it.", [THERE, REPORT], []),
        ("Go to [30, 40]. Upload a report on the thermal data.", [THERE, REPORT], []),
        ("Go to [30, 40], take pictures.", [THERE], ["data-not-planned:pictures"]),
        ("Go to [30, 40], no pictures.", [THERE], []),
        ("Go to [30, 40], no pictures, take pictures.", [THERE], ["data-not-planned:pictures"]),
        ("Go to [30, 40], take pictures, scratch that.", [THERE], []),
        (
            "Skip the panorama, go to [30, 40], come home.",
            [PANORAMA, THERE, BACK],
            ["contradiction:t1:skip the panorama"],
        ),
        (
            "A panorama... you know what, forget it. Go to [30, 40], come home.",
            [PANORAMA, THERE, BACK],
            ["contradiction:t1:forget it"],
        ),
    ],
)
def test_what_is_asked_and_what_is_planned(
    command: str, tasks: list[dict[str, Any]], ids: list[str]
) -> None:
    assert told(command, *tasks) == ids


def test_the_words_that_are_quoted() -> None:
    plan = document([THERE, BACK], command="Go to [30, 40], please weld the rail, come home.")
    assert not [one for one in plan["warnings"] if one["kind"] == "not-planned"]
    plan = document([THERE, BACK], command="Go to [30, 40] and weld the rail, then come home.")
    (found,) = [one["text"] for one in plan["warnings"] if one["kind"] == "not-planned"]
    assert found == 'The command asks: "weld the rail"; no task of the plan does that.'
    both = "Go to [30, 40]. Come home, but do not come home."
    for tasks, ends in (([THERE], "does not end there"), ([THERE, BACK], "ends there")):
        plan = document(tasks, command=both)
        (found,) = [one["text"] for one in plan["warnings"] if one["kind"] == "contradiction"]
        assert found.endswith(f'says "do not come home"; the plan {ends}.')
    plan = document([THERE], command="Weld the rail, then go to [30, 40].")
    assert 'asks: "Weld the rail"' in str(plan["warnings"])


@pytest.mark.parametrize(
    ("command", "unknown"),
    [
        ("fnord gruffle go to", 0),
        ("gruffle fnordo blivet go wait", 3),
        ("gruffle fnordo blivet zorb", 3),
        ("Go fnord blah", 2),
    ],
)
def test_three_words_are_named_where_more_than_half_are_not_known(
    command: str, unknown: int
) -> None:
    found = other_language(command)
    assert (found or "").count('"') == 2 * unknown and (found is None) == (unknown == 0)


def gathering(x: float, *skills: str, prompt: str = "Go.") -> dict[str, Any]:
    one = to(x, 20, prompt)
    own = [{"name": name, "parameters": {}} for name in skills]
    one["skill_sequence"][0]["perception_skills"] = own
    return one


def test_data_of_every_place_are_gathered_at_each() -> None:
    command = "Go to [40, 20], then [80, 20]. Log the depth on both legs."
    once, never = gathering(40, "GetSeabedDepth"), gathering(80)
    both = gathering(80, "GetSeabedDepth")
    about = "data-not-planned:log the depth on both legs"
    assert told(command, once, never) == told(command, never, once)[:1] == [about]
    assert told(command, once, both) == [] and told(command, once) == []
    assert told(command, once, hold(60)) == ["value-not-said:t2:duration"]
    other = command.replace("the depth", "data")
    assert told(other, once, never) == []


def test_data_that_are_ruled_out_are_told_with_the_skills_that_gather_them() -> None:
    def found(command: str, *skills: str) -> list[str]:
        plan = document([gathering(40, *skills)], command=command)
        return [one["text"] for one in plan["warnings"] if one["kind"] == "data-ruled-out"]

    both = ("SetStreamRecording", "CaptureGeoSnapshot")
    (text,) = found("Go to [40, 20] but record nothing.", *both)
    assert text.endswith("have CaptureGeoSnapshot, SetStreamRecording.")
    assert found("Go to [40, 20] but record nothing.", "GetSeabedDepth") == []
    assert found("Go to [40, 20].", *both) == []


@pytest.mark.parametrize(
    ("command", "texts", "lost"),
    [
        ("Go to [30, 40] if all is green.", [], "if all is green"),
        ("Weather permitting, go to [30, 40].", [], "Weather permitting"),
        ("If the battery is above half, go to [30, 40].", [], "If the battery is above half"),
        (
            "Go to the wind turbine if the wind drops.",
            ["The wind turbine is big."],
            "if the wind drops",
        ),
        ("Unless the ferry is in, go to [30, 40].", ["Only while the ferry is out."], None),
        ("Go to [30, 40] if the swell is low.", ["Only if the swell is low."], None),
        ("Go to [30, 40], if I remember right.", [], None),
        ("Go to [30, 40] if possible.", [], None),
        ("If all is green, no wait, go to [30, 40] now.", [], None),
    ],
)
def test_a_condition_that_no_text_of_the_plan_has(
    command: str, texts: list[str], lost: str | None
) -> None:
    plan = document([THERE], command=command, constraints=texts)
    said = [one["text"] for one in plan["warnings"] if one["kind"] == "condition-lost"]
    assert [f'"{lost}"' in text for text in said] == [True] * (lost is not None)


@pytest.mark.parametrize(
    ("constraint", "found"),
    [
        ("The vehicle does not dock.", True),
        ("The vehicle does not dock at the east pontoon.", False),
        ("The vehicle does not return home.", False),
    ],
)
def test_a_task_that_a_constraint_of_the_plan_rules_out_is_told(
    constraint: str, found: bool
) -> None:
    dock = task("DockingApproach", {"goal_position": [9, 9]}, [step("GoToXY", {"x": 9, "y": 9})])
    plan = document([THERE, dock], command="Go to 30, 40.", constraints=[constraint])
    assert any(one["kind"] == "contradiction" for one in plan["warnings"]) == found


@pytest.mark.parametrize(("words", "asked"), [("fly to", False), ("take ... sample*", True)])
def test_an_own_file_asks_a_task_for_what_others_cannot_do(
    words: str, asked: bool, tmp_path: Path
) -> None:
    for kind in ("", ".vehicle"):
        text = (BUNDLED / f"inspection_drone{kind}.toml").read_text()
        (tmp_path / f"mine{kind}.toml").write_text(text)
    ask = f'[[ask]]\nwords = ["{words}"]\ntasks = ["FlyToPoint"]\n'
    (tmp_path / "mine.ontology.toml").write_text(ask)
    drone = load_vocabulary(tmp_path / "mine.toml")
    flown = task("FlyToPoint", {"target_position": [3, 4]}, None, "Go.")
    plan = document([flown], drone, command="Take the blood samples to [3, 4].")
    assert ("not-planned" not in {one["kind"] for one in plan["warnings"]}) is asked


@pytest.mark.parametrize(
    ("prompt", "count"),
    [("Circle it at [30, 40] anticlockwise at 9 m.", 0), ("Circle it at [30, 40] at 9 m.", 1)],
)
def test_the_side_on_which_it_is_kept_is_the_sense_of_a_round(prompt: str, count: int) -> None:
    command = "Circle the pile at [30, 40] at 9 m. Keep it to port."
    found = told(command, THERE, round_it(prompt))
    assert len([one for one in found if "keep it to port" in one]) == count
