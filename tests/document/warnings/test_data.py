"""Data that the command asks for and no step gathers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from planner_ft.document.language import language
from planner_ft.document.warnings.asked import other_language
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.definition import BUNDLED
from tests.documents import USV, document, step, task


def warned(
    command: str,
    *skills: str,
    prompt: str = "Go.",
    waits: bool = False,
    kind: str = "data-not-planned",
) -> list[str]:
    one: dict[str, Any] = step("GoToXY", {"x": 40, "y": 20})
    one["perception_skills"] = [{"name": name, "parameters": {}} for name in skills]
    steps = None if waits else [one]
    made = document(
        [task("Transit", {"target_position": [40, 20]}, steps, prompt)], command=command
    )
    return [item["text"] for item in made["warnings"] if item["kind"] == kind]


@pytest.mark.parametrize(
    ("command", "told"),
    [
        ("Go to [40, 20], but nothing is to be filmed.", 1),
        ("Go to [40, 20] and record video. The crane is not to be filmed.", 0),
        ("Go to [40, 20] and film.", 0),
    ],
)
def test_what_a_clause_rules_out_and_steps_gather_is_told(command: str, told: int) -> None:
    assert len(warned(command, "SetStreamRecording", kind="data-ruled-out")) == told


def test_words_for_data_that_reach_no_skill_are_named_once_per_clause() -> None:
    command = "Go to [40, 20] recording video, and log the depth."
    assert warned(command) == [
        'The command speaks of "recording", "video"; no step of the plan gathers that.',
        'The command speaks of "depth"; no step of the plan gathers that.',
    ]
    assert len(warned(command, "SetStreamRecording")) == 1
    assert warned(command, "SetStreamRecording", "GetSeabedDepth") == []


def test_a_picture_of_the_depths_is_no_picture() -> None:
    command = "Go to [40, 20], I want a depth picture."
    assert warned(command, "GetSeabedDepth") == []
    assert warned(command, "CaptureGeoSnapshot") == [
        'The command speaks of "depth picture"; no step of the plan gathers that.'
    ]


def test_data_that_are_sent_are_not_those_that_are_gathered_now() -> None:
    names = {"target_list": ["video"]}
    send = task("SmartDataHarvest", names, [step("StationKeep")], "Upload the video.")
    go = task("Transit", {"target_position": [40, 20]}, [step("GoToXY", {"x": 40, "y": 20})], "Go.")
    command = "Film the way to [40, 20], then send me the video."
    made = document([go, send], command=command)
    texts = [item["text"] for item in made["warnings"] if item["kind"] == "data-not-planned"]
    assert texts == ['The command speaks of "Film"; no step of the plan gathers that.']


@pytest.mark.parametrize(
    "command",
    [
        "Go to [40, 20].",
        "Go to [40, 20], no video.",
        "Go to [40, 20] and send the thermal pictures home.",
    ],
)
def test_what_is_ruled_out_or_sent_is_not_asked_for(command: str) -> None:
    assert warned(command) == []


def test_what_is_ruled_out_and_gathered_is_named() -> None:
    one = step("GoToXY", {"x": 40, "y": 20})
    one["perception_skills"] = [{"name": "SetStreamRecording", "parameters": {}}]
    go = task("Transit", {"target_position": [40, 20]}, [one], "Go.")
    made = document([go], command="Go to [40, 20] but record nothing.")
    (text,) = [item["text"] for item in made["warnings"] if item["kind"] == "data-ruled-out"]
    assert (
        text == 'The command says "record nothing", and steps of the plan have SetStreamRecording.'
    )


def test_a_prompt_with_data_that_its_steps_do_not_gather_is_told() -> None:
    prompt = "Go to [40, 20]. Log the depth. Look out for boats. Go no faster than 1 m/s."
    told = warned("Go to 40,20.", "GetSeabedDepth", prompt=prompt)
    assert len(told) == 1 and '"Look out for boats"' in told[0]
    assert not warned("Go to 40,20.", "GetSeabedDepth", "DetectObjects", prompt=prompt)


def test_a_task_that_waits_counts_by_its_prompt() -> None:
    command = "Go to [40, 20] and log the depth."
    assert warned(command, prompt="Go to [40, 20]. Log the depth.", waits=True) == []
    assert len(warned(command, waits=True)) == 1


def test_any_skill_that_gathers_answers_to_data() -> None:
    command = "Collect data at [40, 20]."
    assert len(warned(command)) == 1 and warned(command, "GetGPSLocation") == []


def test_an_unknown_skill_in_the_ontology_is_named(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text((BUNDLED / "inspection_drone.toml").read_text())
    words = '[[data]]\nwords = ["depth"]\nskills = ["Dive"]\n[[data]]\nskills = ["TakePhoto"]\n'
    (tmp_path / "mine.ontology.toml").write_text(words)
    with pytest.raises(PlannerError) as error:
        language(load_vocabulary(path))
    assert "[[data]] names 'Dive', which is no skill" in str(error.value)
    assert "every [[data]] needs the list words" in str(error.value)
    assert len(language(USV).data) > 5


@pytest.mark.parametrize(
    ("command", "warned"),
    [
        ("Fahre zur grünen Tonne und halte dort zehn Minuten die Position.", True),
        ("Ve a [30, 10] y vuelve a casa.", True),
        ("Go to the Kriegers Flak substation and hold for ten minutes.", False),
        ("proceeed to [45, 15], hodl postion for thre minutes and retrun home", False),
    ],
)
def test_a_command_in_unknown_words_is_told(command: str, *, warned: bool) -> None:
    assert (other_language(command) is not None) is warned
    kinds = [item["kind"] for item in document([], command=command)["warnings"]]
    assert ("unknown-language" in kinds) is warned


def test_a_clause_in_unknown_words_is_told() -> None:
    for command, count in (
        ("Proceed to [75, 9] and home, dort halten for zehn Minuten.", 1),
        ("Proceed to [75, 9] and home, hodl teh postion for zhen minuets.", 0),
        ("Proceed to [75, 9] and home by Kriegers Flak Nord.", 0),
    ):
        kinds = [item["kind"] for item in document([], command=command)["warnings"]]
        assert kinds.count("unknown-language") == count, command


def test_an_approach_by_gps_needs_no_log_of_positions() -> None:
    dock = task("DockingApproach", {"goal_position": [6, -2]}, [step("GoToXY", {"x": 6, "y": -2})])
    go = task("Transit", {"target_position": [6, -2]}, [step("GoToXY", {"x": 6, "y": -2})])
    for planned, count in ((dock, 0), (go, 1)):
        made = document([planned], command="Into the slip at [6, -2], on GPS, please.")
        assert [one["kind"] for one in made["warnings"]].count("data-not-planned") == count


def test_the_whole_way_round_is_not_the_way_there() -> None:
    turn = step("ArcTurn", {"radius": 9})
    turn["perception_skills"] = [{"name": "SetStreamRecording", "parameters": {}}]
    orbit = task("PerformOrbit", {"center": [40, 0], "radius": 9}, [turn])
    made = document([to(40), orbit], command="Once round [40, 0] at 9 m, video the whole way.")
    assert "data-not-planned" not in [item["kind"] for item in made["warnings"]]


def test_data_that_are_asked_for_everywhere_and_gathered_once_are_named() -> None:
    legs = []
    for x, skills in ((40, ["GetSeabedDepth"]), (80, [])):
        one = step("GoToXY", {"x": x, "y": 20})
        one["perception_skills"] = [{"name": name, "parameters": {}} for name in skills]
        legs.append(task("Transit", {"target_position": [x, 20]}, [one]))
    for words, count in (("on both legs", 1), ("on the way", 0)):
        made = document(legs, command=f"Go to [40, 20], then [80, 20]. Log the depth {words}.")
        texts = [one["text"] for one in made["warnings"] if one["kind"] == "data-not-planned"]
        assert len(texts) == count
        assert all("task 1, Transit alone gathers that" in text for text in texts)


@pytest.mark.parametrize(
    ("words", "skill"),
    [
        ("drop a marker on it", "CreateMapMarker"),
        ("read the name on it", "OCRScanning"),
        ("log the environment sensors", "LogEnvironmentState"),
        ("keep watching with the camera", "SetStreamRecording"),
    ],
)
def test_words_for_markers_names_cameras_and_the_environment_are_known(
    words: str, skill: str
) -> None:
    command = f"Go to [40, 20] and {words}."
    assert len(warned(command)) == 1
    assert warned(command, skill) == []


def test_a_task_that_no_words_ask_for_is_named() -> None:
    turns = [step("RotateToHeading", {"heading": heading}) for heading in (0, 90, 180, 270)]
    look = task("HorizontalPanorama", {"sectors": 4}, turns)
    said = "Task 1, HorizontalPanorama: no words of the command ask for it."
    for command, count in (("Go on and read the gauge.", 1), ("Look all round.", 0)):
        made = document([look], command=command)
        assert [one["text"] for one in made["warnings"]].count(said) == count


def unasked(command: str, *tasks: dict[str, Any]) -> list[str]:
    texts = [one["text"] for one in document([*tasks], command=command)["warnings"]]
    return [text.split(":")[0] for text in texts if "no words of the command" in text]


def to(x: float) -> dict[str, Any]:
    return task("Transit", {"target_position": [x, 0]}, [step("GoToXY", {"x": x, "y": 0})])


def test_docking_drifting_and_searching_want_words_for_it() -> None:
    dock = task("DockingApproach", {"goal_position": [60, 0]}, [step("GoToXY", {"x": 60, "y": 0})])
    assert unasked("Go to [9, 0]. A rig stands at [60, 0].", to(9), dock)
    assert not unasked("Go to [9, 0], then moor at [60, 0].", to(9), dock)
    drift = task("DriftAudit", {"duration": 60}, [step("DriftWithCurrent", {"time": 60})])
    assert unasked("The drill needs you at [9, 0] for a minute.", to(9), drift)
    assert not unasked("Float at [9, 0] for a minute.", to(9), drift)
    search = task("SearchAndDetect", {"target_description": "contract"}, [step("StationKeep")])
    assert unasked("For the contract, go to [9, 0].", search, to(9))
    assert not unasked("Find the contract, go to [9, 0].", search, to(9))
    there = task("Transit", {"target_position": [-99, -99]}, None, "Go to the contract.")
    assert not unasked("Go to the contract.", search, there)
    named = task("Transit", {"target_position": [-99, -99]}, None, "Go to the big contract.")
    assert not unasked("Go to the big contract.", search, named)


@pytest.mark.parametrize(("skills", "count"), [((), 1), (("SetStreamRecording",), 0)])
@pytest.mark.parametrize(
    "command",
    [
        "Video from start to finish: out to [40, 0], home.",
        "Out to [40, 0], home, with video the whole way, without a gap.",
    ],
)
def test_data_until_the_vehicle_is_back_are_gathered_on_every_way(
    command: str, skills: tuple[str, ...], count: int
) -> None:
    ways = []
    for x, names in ((40, ("SetStreamRecording",)), (0, skills)):
        one: dict[str, Any] = step("GoToXY", {"x": x, "y": 0})
        one["perception_skills"] = [{"name": name, "parameters": {}} for name in names]
        ways.append(task("Transit", {"target_position": [x, 0]}, [one]))
    made = document(ways, command=command)
    assert [item["kind"] for item in made["warnings"]].count("data-not-planned") == count
