"""Whole-prompt templates: what a line says, and the steps that it asks for."""

import itertools
import math
import random
import re

import pytest

from planner_ft.data.task.binding import bind, binding, titles
from planner_ft.data.task.draw import Context, draw_template
from planner_ft.data.task.phrasebook import Phrasebook
from planner_ft.data.templates.grammar import TemplateError
from planner_ft.data.templates.records import Template, templates
from planner_ft.data.templates.render import plain
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.definition import load_vocabulary
from planner_ft.vocabulary.plans import plan_problems

USV = load_vocabulary("usv")
BOOK = Phrasebook(USV, unseen=False)


def made(source):
    """The template of "TASK | TEXT => STEPS"."""
    task, _bar, rest = source.partition(" | ")
    text, _arrow, steps = rest.rpartition(" => ")
    return Template("made-1", "train", text, steps, "made.jsonl:1", tasks=(task,))


def samples(source, count=40):
    """(prompt, task parameters, steps) of a line; a step is (name, parameters, filters,
    perceptions).
    """
    rng = random.Random(7)
    task = USV.task[source.partition(" | ")[0]]
    bound = bind(made(source), task, BOOK)
    for _ in range(count):
        context = Context(BOOK, task, rng)
        drawn = draw_template(bound, context)
        if drawn:
            steps = [
                (
                    step["navigation_skill"]["name"],
                    step["navigation_skill"]["parameters"],
                    step["filter_skills"],
                    step["perception_skills"],
                )
                for step in drawn.steps
            ]
            yield plain(drawn.text), context.parameters(), steps


def test_a_value_stands_in_the_text_and_in_its_step():
    for prompt, _parameters, steps in samples(
        "KeepStation | Hold for {time adj}s, then for {time2}. => StationKeep time; StationKeep"
        " time2 &GetGPSLocation"
    ):
        assert [name for name, *_rest in steps] == ["StationKeep", "StationKeep"]
        assert steps[0][1]["time"] != steps[1][1]["time"] and "{" not in prompt
        assert [call["name"] for call in steps[1][3]] == ["GetGPSLocation"] and steps[0][3] == []


def test_a_value_that_is_taken_back_is_another_one_and_stands_in_no_step():
    for prompt, _parameters, [(_name, given, _filters, _calls)] in samples(
        "KeepStation | Hold {~radius num} no {radius num}. => StationKeep radius", 10
    ):
        wrong, right = prompt.removeprefix("Hold ").rstrip(".").split(" no ")
        assert wrong != right and list(given) == ["radius"]


def test_a_slot_in_an_alternative_counts_only_when_it_was_chosen():
    seen = set()
    for prompt, _parameters, [(_name, given, _filters, _calls)] in samples(
        "KeepStation | Stay here(, within {radius}|). => StationKeep radius"
    ):
        assert ("radius" in given) == ("within" in prompt)
        seen.add("radius" in given)
    assert seen == {True, False}


def test_a_flag_brings_a_skill_when_its_alternative_was_chosen():
    for prompt, _parameters, [(*_rest, calls)] in samples(
        "KeepStation | Stay here(, filming{?film}|). => StationKeep &SetStreamRecording?film"
    ):
        assert bool(calls) == ("filming" in prompt)


def test_the_tasks_own_parameter_is_copied():
    source = "KeepStation | Hold for {param.duration}. => StationKeep time=param.duration"
    for prompt, parameters, [(_name, given, _filters, _calls)] in samples(source):
        assert given == {"time": parameters["duration"]}
        assert not re.search(r"\d", prompt)


def test_left_and_right_give_the_sign_and_the_side_is_said_once():
    for prompt, _parameters, [(_name, given, *_rest)] in samples(
        "FeatureStare | Ease the bow {delta_yaw left} to port. => NudgeYaw delta_yaw"
    ):
        assert given["delta_yaw"] < 0 and len(re.findall("port|left|anticlockwise", prompt)) == 1
    for prompt, _parameters, [(_name, given, *_rest)] in samples(
        "FeatureStare | Nudge it {delta_yaw right}. => NudgeYaw delta_yaw"
    ):
        assert given["delta_yaw"] > 0 and re.search("right|starboard|clockwise", prompt)


def test_all_runs_in_every_step_and_in_the_order_of_the_line():
    source = (
        "Transit | {P1}, then {P2}. => ALL +LockHeading &GetGPSLocation; GoToXY P1; GoToXY P2"
        " &GetSeabedDepth"
    )
    for _prompt, _parameters, steps in samples(source, 5):
        assert [[call["name"] for call in filters] for *_rest, filters, _calls in steps] == [
            ["LockHeading"]
        ] * 2
        assert [[call["name"] for call in calls] for *_rest, calls in steps] == [
            ["GetGPSLocation"],
            ["GetGPSLocation", "GetSeabedDepth"],
        ]


def test_shapes_take_what_they_need_from_the_task():
    for _prompt, given, steps in samples(
        "PerformOrbit | Four points round the centre. => Ring count=4 / StationKeep &GetThermalStats"
    ):
        (x, y), radius = given["center"], given["radius"]
        points = [(step[1]["x"], step[1]["y"]) for step in steps[::2]]
        assert points == [
            pytest.approx(point, abs=0.006)
            for point in ((x + radius, y), (x, y + radius), (x - radius, y), (x, y - radius))
        ]
        assert [name for name, *_rest in steps[1::2]] == ["StationKeep"] * 4


def test_a_grid_of_stated_size_is_covered():
    text = "{width} by {length} about {P1}, {spacing} apart, from the {corner}."
    source = (
        f"BathymetryGridSurvey | {text} => Grid P1 width length spacing start=corner"
        " &LogEnvironmentState@last"
    )
    for _prompt, _parameters, steps in samples(source):
        xs = {step[1]["x"] for step in steps}
        assert len(steps) == 2 * len(xs)
        assert [bool(calls) for *_rest, calls in steps] == [False] * (len(steps) - 1) + [True]


def test_a_line_has_a_waypoint_behind_every_spacing():
    source = "SubseaCableTrack | A waypoint each {spacing}. => Line length=param.max_dist spacing"
    for _prompt, given, steps in samples(source):
        points = [(step[1]["x"], step[1]["y"]) for step in steps]
        gaps = [math.dist(one, other) for one, other in itertools.pairwise(points)]
        assert points[0] == tuple(given["start"]) and len(gaps) > 1
        assert gaps == pytest.approx([given["max_dist"] / len(gaps)] * len(gaps), abs=0.03)


def test_a_line_has_the_legs_that_the_text_counts():
    source = "Transit | {length} {direction} of {P1}, 3 legs. => Line P1 length heading=direction"
    for _prompt, _given, steps in samples(f"{source} count=3"):
        points = [(step[1]["x"], step[1]["y"]) for step in steps]
        gaps = [math.dist(one, other) for one, other in itertools.pairwise(points)]
        assert gaps == pytest.approx([gaps[0]] * 3, abs=0.03)


def test_skills_and_stops_at_every_second_waypoint():
    source = (
        "SurveyTarget | The square, {time} at corners. => Square &GetThermalStats@odd"
        " &LogEnvironmentState@even / StationKeep@even time"
    )
    for _prompt, given, steps in samples(source):
        moves = [step for step in steps if step[0] == "GoToXY"]
        assert [name for name, *_rest in steps] == ["GoToXY", "GoToXY", "StationKeep"] * 4
        for _name, at, _filters, calls in moves:
            away = {
                abs(at["x"] - given["target_position"][0]) > 0.01,
                abs(at["y"] - given["target_position"][1]) > 0.01,
            }
            at_corner = away == {True}
            assert [call["name"] for call in calls] == [
                "LogEnvironmentState" if at_corner else "GetThermalStats"
            ]


def test_an_offset_lies_in_the_named_direction():
    source = (
        "Transit | Go {distance num} {direction} of {param.target_position}. => Offset"
        " param.target_position length=distance heading=direction"
    )
    for prompt, parameters, [(_name, given, *_rest)] in samples(source):
        east, north = (
            given["x"] - parameters["target_position"][0],
            given["y"] - parameters["target_position"][1],
        )
        for word, component in (
            ("north", north),
            ("south", -north),
            ("east", east),
            ("west", -east),
        ):
            assert (component > 0) == (word in prompt)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("KeepStation | (Hold|Stay for {time}. => StationKeep time", "is not closed"),
        ("KeepStation | Hold for {time}. => StationKeep", "{time} stands in the text"),
        ("KeepStation | Hold. => StationKeep time", "not in the text"),
        ("KeepStation | Hold. => Hover", "no skill Hover"),
        ("KeepStation | Hold. => StationKeep &LockHeading", "is a filter skill"),
        (
            "KeepStation | Hold {threshold}. => StationKeep threshold",
            "StationKeep has no parameter threshold",
        ),
        ("KeepStation | Hold. => StationKeep param.radius", "KeepStation has no parameter radius"),
        ("KeepStation | Go round. => Square", "needs a point"),
        ("KeepStation | Film{?film}. => StationKeep", "the label ?film"),
        ("KeepStation | Go. => GoToXY", "needs a position"),
    ],
)
def test_a_wrong_line_is_explained(line, message):
    with pytest.raises((TemplateError, PlannerError), match=re.escape(message)):
        list(samples(line))


@pytest.mark.parametrize("name", ["usv", "inspection_drone"])
def test_every_line_of_the_vehicle_makes_valid_plans(name):
    vehicle = load_vocabulary(name)
    book = Phrasebook(vehicle, unseen=False)
    lines = list(itertools.chain(*templates(vehicle, "prompts")))
    named = {title for line in lines for title in line.tasks}
    assert {task.title for task in vehicle.tasks} <= named
    assert {line.split for line in lines} == {"train", "validation", "test"}
    for number, line in enumerate(lines):
        fitting = [
            (title, bound)
            for title in titles(line, vehicle)
            if (bound := binding(line, title, book))
        ]
        assert fitting, line.where
        drawn = []
        for seed in range(3 if number % 5 == 0 else 0):
            title, bound = fitting[seed % len(fitting)]
            context = Context(book, vehicle.task[title], random.Random(f"{line.id}{seed}"))
            drawn.append(draw_template(bound, context))
        for one in filter(None, drawn):
            plan = {"skill_sequence": one.steps}
            assert "{" not in one.text, line.where
            assert plan_problems("task", plan, vehicle, strict=True) == [], line.where
        assert not drawn or any(drawn), line.where


def test_a_wrong_record_is_named_by_file_and_line():
    for source, message in (
        ("Swim | Hold. => StationKeep", "made.jsonl:1: there is no task Swim"),
        ("KeepStation | Hold. => Hover", "made.jsonl:1: there is no skill Hover"),
    ):
        with pytest.raises(PlannerError, match=message):
            template = made(source)
            binding(template, template.tasks[0], BOOK)
