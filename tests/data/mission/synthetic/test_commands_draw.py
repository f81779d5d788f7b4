"""Commands drawn from templates: the text says what the plan holds, and the plan follows the
labelling rules.
"""

import re
from random import Random

import pytest

from planner_ft.data.mission.synthetic.commands import file_problems, main
from planner_ft.data.mission.synthetic.commands_check import FOLDER, parse_template
from planner_ft.data.mission.synthetic.commands_draw import draw_command
from planner_ft.data.mission.synthetic.commands_text import joined
from planner_ft.data.mission.synthetic.numbers import draw_style


def draws(row: str, count: int = 60):
    template = parse_template(row, "subject", 1)
    for seed in range(count):
        rng = Random(seed)
        text, expected, _ = draw_command(template, rng, draw_style(rng))
        yield text, expected


def tasks(expected):
    return [(task["title"], task["parameters"]) for task in expected["tasks"]]


def titles(expected):
    return [task["title"] for task in expected["tasks"]]


@pytest.mark.parametrize("path", sorted(FOLDER.glob("*.txt")), ids=lambda path: path.stem)
def test_shipped_files_have_no_problems(path):
    assert [str(problem) for problem in file_problems(path)[1]] == []


def test_targets_without_position_are_searched_and_others_are_not():
    seen = set()
    for text, expected in draws("Circle {T1} at {radius}. => PerformOrbit T1 radius"):
        searched = titles(expected) == ["SearchAndDetect", "Transit", "PerformOrbit"]
        assert searched or titles(expected) == ["Transit", "PerformOrbit"]
        if searched:
            assert tasks(expected)[0][1]["target_description"].lower() in text.lower()
        seen.add(searched)
    assert seen == {True, False}


def test_a_parameter_is_planned_only_where_it_is_said():
    for text, expected in draws("Hold at {P1}( for {duration}|). => KeepStation P1 duration"):
        assert (" for " in text) == ("duration" in expected["tasks"][-1]["parameters"])


def test_an_optional_intent_goes_with_its_alternative():
    for text, expected in draws(
        "Survey {T1 located}(, then come home{+h}|). => SurveyTarget T1; Home +h"
    ):
        assert titles(expected) == (
            ["SurveyTarget", "Transit"] if "home" in text else ["SurveyTarget"]
        )


def test_what_is_taken_back_is_said_but_not_planned():
    for text, expected in draws(
        "Wait here for {~duration}, no, make that {duration}. => KeepStation here duration"
    ):
        wrong, right = re.match(r"Wait here for (.*), no, make that (.*)\.", text).groups()
        assert wrong != right
        assert titles(expected) == ["KeepStation"]


def test_an_indefinite_target_has_its_article_and_no_position():
    for text, expected in draws("There is {a T1} off the point. Circle it. => PerformOrbit T1"):
        name = expected["tasks"][0]["parameters"]["target_description"]
        assert (
            f"There is {'an' if name[0] in 'aeiou' else 'a'} {name} off the point." in text
            or "uni" in name
            or name.startswith(("RO", "RI", "us"))
        )
        assert titles(expected)[0] == "SearchAndDetect"


def test_a_target_can_have_its_position_in_a_slot_of_its_own():
    for _, expected in draws("The {bare T1} lies at {P1}. Hold there. => KeepStation T1 P1"):
        assert titles(expected) == ["Transit", "KeepStation"]
        assert expected["tasks"][0]["parameters"]["target_position"] != [-99, -99]


def test_the_position_is_said_once():
    for text, expected in draws(
        "Survey {T1 located}, then circle {T1}. => SurveyTarget T1; PerformOrbit T1"
    ):
        again = text.rstrip(".").split(", then circle ")[-1]
        assert text.startswith((f"Survey {again}", "Survey the "))
        assert not re.search(r"[\[(=]| (?:at|position|near) ", again)
        assert titles(expected) == ["SurveyTarget", "PerformOrbit"]


def test_what_the_vehicle_lies_at_needs_no_way():
    for _, expected in draws("You are at {T1}: take a panorama. => HorizontalPanorama here T1"):
        assert titles(expected) == ["HorizontalPanorama"]
        assert expected["assumptions"][-1].startswith("The vehicle lies at ")


def test_remarks_become_constraints_and_assumptions():
    remarks = (
        "Cannot lifting a block; Not AutoGenerateReportSummary; Note Mind {T1}.; Assume The berth"
        " is free."
    )
    row = f"Lift the block, no report, mind {{T1}}, berth free: come home. => Home; {remarks}"
    for _, expected in draws(row, 5):
        assert expected["constraints"][:2] == [
            "The vehicle has no task for lifting a block.",
            "No report is written.",
        ]
        assert expected["constraints"][2].startswith("Mind ")
        assert "The berth is free." in expected["assumptions"]


def test_a_command_for_nothing_says_why():
    for _, expected in draws("Nice weather today. => Nothing", 3):
        assert expected == {
            "tasks": [],
            "assumptions": [],
            "constraints": ["The command asks for nothing that the vehicle has a task for."],
        }


def test_look_alikes_share_their_noun():
    row = (
        "Two {nouns T1:pair}: a {look T1} one and a {look T2:pair} one. Survey {one T1}, then the"
        " other. => SurveyTarget T1; SurveyTarget T2"
    )
    for text, expected in draws(row, 20):
        first, second = (
            task["parameters"]["target_description"]
            for task in expected["tasks"]
            if task["title"] == "SearchAndDetect"
        )
        assert first != second
        assert first.split(" ")[-1] == second.split(" ")[-1]
        assert "Survey the " in text


def test_a_series_of_readings_has_more_than_one():
    for _, expected in draws(
        "Read {T1} every {interval} for {duration}. => ThermalTimeLapse T1 interval duration", 200
    ):
        parameters = expected["tasks"][-1]["parameters"]
        assert list(parameters) == ["duration", "interval"]
        assert 2 * parameters["interval"] <= parameters["duration"]


def test_fixed_values_and_lists_are_planned():
    for _, expected in draws(
        "Half way round {T1 located}, then send the {L1} and the {L2}. => PerformOrbit T1 arc=180;"
        " SmartDataHarvest L1 L2",
        10,
    ):
        assert expected["tasks"][1]["parameters"]["arc"] == 180
        assert len(set(expected["tasks"][2]["parameters"]["target_list"])) == 2


def test_fixed_words_are_planned():
    row = (
        "Film the name board of {T1 located}, then go down its north side. => FeatureStare T1"
        " F=name_board; ParallelStructurePass T1 S=north"
    )
    for _, expected in draws(row, 5):
        assert [parameters for _, parameters in tasks(expected)[1:]] == [
            {"feature_type": "name board"},
            {"side_id": "north"},
        ]


def test_texts_are_put_in_order():
    assert (
        joined(["there is a ", "orange buoy", " at [1, 2],", ". ", "then", "  come home ."])
        == "There is an orange buoy at [1, 2]. Then come home."
    )
    assert joined(["an ", "USV", ", a ", "8-minute", " wait"]) == "A USV, an 8-minute wait"
    assert joined(["x=4 y=5", "... no, ", "x=1 y=2."]) == "x=4 y=5... no, x=1 y=2."


def test_the_check_names_file_and_line(tmp_path, capsys):
    path = tmp_path / "mine.txt"
    path.write_text("Come home. => Home\nHold at {P1}. => KeepStation\n", encoding="utf-8")
    assert main([str(path)]) == 1
    assert f"{path}:2: " in capsys.readouterr().out
    path.write_text("Come home. => Home\n", encoding="utf-8")
    assert main([str(path), "--show", "2"]) == 0
    assert capsys.readouterr().out.count("Come home.\n") == 2
    assert main([str(tmp_path / "none.txt")]) == 2


def test_a_size_without_a_unit_stands_before_metres() -> None:
    texts = [
        text
        for text, _ in draws(
            "Sound {width} by {length} at {P1}. => BathymetryGridSurvey P1 width length", 300
        )
    ]
    bare = [text for text in texts if re.match(r"Sound \d[\d.]* by", text)]
    assert len(bare) > 50
    assert [
        text
        for text in bare
        if re.search(r"(ft|feet|foot|yards?|yd|km|kilomet\w+|fathoms?|cables?) at ", text)
    ] == []
