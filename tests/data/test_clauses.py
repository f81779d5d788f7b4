"""Clauses of commands: every line of the files, what they add to a plan, and what they leave alone."""

import itertools
import json
import random

import jsonschema
import pytest

from planner_ft.data.drawing import Drawing
from planner_ft.data.mission_binding import bind
from planner_ft.data.missions import MissionSampler, mission_sampler, missions_with_skills
from planner_ft.data.numbers import pick
from planner_ft.data.task.sampler import mission_tasks
from planner_ft.data.templates.records import Template, template_files, templates
from planner_ft.data.templates.render import plain
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.limits import load_limits, read_limit
from planner_ft.vocabulary.plans import plan_problems

USV, DRONE = load_vocabulary(), load_vocabulary("inspection_drone")
VEHICLES = [USV, DRONE]
SAMPLERS = {vehicle: MissionSampler(vehicle, split=None) for vehicle in VEHICLES}


def clause(text, plan, form="order", **lists):
    return Template("made-1", "train", text, plan, "made.jsonl:1", form, **lists)


def with_clause(made, command="Survey {T1 located}.", plan="SurveyTarget T1", count=12):
    """(text, plan, skills beside the tasks) of a command with one clause."""
    base = Template("base-1", "train", command, plan, "base.jsonl:1")
    for seed in range(count):
        found = mission_sampler(USV).compose([base], random.Random(seed), 1, only=made)
        if found.clauses:
            yield plain(found.text), found.expected, found.beside


# ---------------------------------------------------------------- every line


@pytest.mark.parametrize("vehicle", VEHICLES, ids=lambda vehicle: vehicle.name)
def test_every_line_makes_a_limit_or_a_demand(vehicle):
    sampler, limits = SAMPLERS[vehicle], load_limits(vehicle)
    for line in itertools.chain(*sampler.clauses):
        for seed in range(200):
            rng = random.Random(seed)
            made = sampler.compose([pick(sampler.short, rng)], rng, 1, only=line)
            if made.clauses:
                break
        assert made.clauses == 1, line.where
        assert plan_problems("mission", made.expected, vehicle, strict=True) == [], line.where
        prompts = " ".join(task["task_prompt"] for task in made.expected["tasks"])
        if line.steps and line.steps[0].call.name in limits:
            read = read_limit(made.expected["constraints"][-1], limits)
            assert read and read.kind == line.steps[0].call.name, line.where
        elif line.steps:
            assert any(made.beside), line.where
        else:
            assert made.expected["constraints"][-1] in prompts, line.where


@pytest.mark.parametrize("vehicle", VEHICLES, ids=lambda vehicle: vehicle.name)
def test_records_are_of_the_schema_and_splits_share_no_text(vehicle):
    check = jsonschema.Draft202012Validator(read_json("schemas/templates.schema.json"))
    for path in template_files(vehicle, "clauses"):
        for line in path.read_text(encoding="utf-8").splitlines():
            assert check.is_valid(json.loads(line)), line
    lines = list(itertools.chain(*templates(vehicle, "clauses")))
    texts = {
        split: {x.text for x in lines if x.split == split} for split in ("train", "validation")
    }
    assert len({line.id for line in lines}) == len(lines)
    assert texts["validation"] and not texts["train"] & texts["validation"]
    assert len(lines) >= (200 if vehicle is USV else 40)


def test_a_limit_of_one_task_stands_in_its_prompt_alone():
    made = clause("no faster than {speed} there", "speed speed scope=task", "phrase")
    command, plan = "Go to {P1}, then survey {T1 located}.", "Transit P1; SurveyTarget T1"
    assert not list(with_clause(made, command, plan))
    for _text, expected, _beside in with_clause(made):
        (limit,) = expected["constraints"]
        assert limit.endswith(" m/s during SurveyTarget.")
        told = [one["title"] for one in expected["tasks"] if "Go no faster" in one["task_prompt"]]
        assert told == ["SurveyTarget"]


@pytest.mark.parametrize(
    ("text", "plan", "problem"),
    [
        ("keep off", "keep_off", "no kind of limit and no skill"),
        ("keep off {T1}", "keep_out T1 distance", "distance stands in the plan and not"),
        ("keep {distance} off {T1}", "keep_out T1", "belongs to no task, limit or demand"),
        ("film", "SetStreamRecording scope=legs", "scope=legs: must be"),
        ("keep {colour} off", "keep_out colour", "keep_out needs distance and position"),
    ],
)
def test_mistakes_are_named(text, plan, problem):
    with pytest.raises(PlannerError) as error:
        list(with_clause(clause(text, plan)))
    assert "made.jsonl:1: " in str(error.value) and problem in str(error.value)


# ---------------------------------------------------------------- labels


def test_a_limit_is_a_constraint_and_stands_in_the_prompt_of_every_task_that_moves():
    made = clause("keep {distance} off {T2:hazard located}", "keep_out T2 distance")
    for text, expected, beside in with_clause(
        made,
        "Survey {T1 lost}, hold at {P1}, report.",
        "SurveyTarget T1; KeepStation P1; AutoGenerateReportSummary",
    ):
        titles = [task["title"] for task in expected["tasks"]]
        assert titles == [
            "SearchAndDetect",
            "SurveyTarget",
            "Transit",
            "KeepStation",
            "AutoGenerateReportSummary",
        ]
        limit = read_limit(expected["constraints"][-1], load_limits(USV))
        assert limit.kind == "keep_out" and limit.values["object"].removeprefix("the ") in text
        for task, skills in zip(expected["tasks"][:-1], beside, strict=False):
            assert task["task_prompt"].endswith(
                f"Keep at least {limit.values['distance']:g} m from {limit.values['object']} at"
                f" [{limit.values['position'][0]:g}, {limit.values['position'][1]:g}]."
            )
            assert skills == [
                ("filter", "ObstacleAvoidance", {"min_distance": limit.values["distance"]})
            ]
            assert limit.values["distance"] not in task["parameters"].values()
            assert limit.values["position"] not in task["parameters"].values()
        assert "Keep" not in expected["tasks"][-1]["task_prompt"] and beside[-1] == []


def test_a_demand_runs_where_its_scope_says():
    base = {"command": "Circle {T1 located}, then home.", "plan": "PerformOrbit T1; Home"}
    for scope, recorded in (
        ("", [True, True, True]),
        (" scope=task", [False, True, False]),
        (" scope=way", [True, False, False]),
        (" scope=home", [False, False, True]),
    ):
        made = clause("film it", f"SetStreamRecording{scope}")
        for _text, expected, beside in with_clause(made, **base):
            assert [bool(skills) for skills in beside] == recorded
            prompts = [task["task_prompt"] for task in expected["tasks"]]
            assert ["Record video." in prompt for prompt in prompts] == recorded
            assert expected["constraints"] == []


def test_a_clause_of_one_task_does_not_stand_with_several():
    made = clause("with video", "SetStreamRecording scope=task", form="phrase")
    assert not list(
        with_clause(made, "Survey {T1}, then {T2}.", "SurveyTarget T1; SurveyTarget T2")
    )


def test_it_is_the_target_of_a_task_whose_stand_off_is_stated():
    made = clause("never closer than {distance} to {it}", "keep_out it distance", form="phrase")
    assert not list(with_clause(made))
    text, expected, beside = next(
        with_clause(made, "Survey {T1 located} at {radius}.", "SurveyTarget T1 radius")
    )
    target = expected["tasks"][0]["task_prompt"].split(" around ")[-1]
    assert " to it" in text and "Keep at least" in target
    assert beside[0][0][:2] == ("filter", "ObstacleAvoidance")


def test_a_command_names_skills_beside_its_tasks():
    made = Template(
        "made-1",
        "train",
        "Orbit {T1 located} at {radius}(, video on{?v}|).",
        "PerformOrbit T1 radius &SetStreamRecording?v",
        "made.jsonl:1",
    )
    for seed in range(12):
        command = mission_sampler(USV).compose([made], random.Random(seed))
        text, expected = command.text, command.expected
        prompts = [task["task_prompt"].endswith("Record video.") for task in expected["tasks"]]
        assert prompts == [False, "video on" in plain(text)]


def test_places_for_clauses_in_a_command_take_any_that_fits():
    made = Template(
        "host-1",
        "train",
        "Go to {P1}, {C1:phrase}, then {P2}.",
        "Transit P1 C1; Transit P2",
        "host.jsonl:1",
    )
    texts = {
        plain(mission_sampler(USV).compose([made], random.Random(seed)).text) for seed in range(20)
    }
    assert len(texts) == 20 and not any("{" in text for text in texts)


# ---------------------------------------------------------------- samples


@pytest.mark.parametrize("vehicle", VEHICLES, ids=lambda vehicle: vehicle.name)
def test_samples_have_clauses_and_no_task_of_them(vehicle):
    limits, limited, demanded = load_limits(vehicle), 0, 0
    for record, beside in missions_with_skills(11, 300, vehicle):
        expected = record["expected"]
        read = [limit for text in expected["constraints"] if (limit := read_limit(text, limits))]
        limited += bool(read)
        demanded += any(role == "perception" for skills in beside for role, *_rest in skills)
        places = [value for task in expected["tasks"] for value in task["parameters"].values()]
        for limit in read:
            assert not any(
                corner in places for corner in limit.values.get("polygon", ()) if corner != [0, 0]
            )
    assert limited > 40 and demanded > 30


def test_tasks_of_missions_carry_the_skills_of_their_clauses():
    filters, filmed = 0, 0
    for record in itertools.islice(mission_tasks(USV, 3), 300):
        for step in record["expected"]["skill_sequence"]:
            filters += any(
                skill["name"] == "BoundaryEnforcement" for skill in step["filter_skills"]
            )
            names = [skill["name"] for skill in step["perception_skills"]]
            if "Record video." in record["prompt"]:
                filmed += 1
                assert names.count("SetStreamRecording") == 1
            if "Stay inside" in record["prompt"]:
                assert step["filter_skills"][0]["name"] in (
                    "BoundaryEnforcement",
                    "ObstacleAvoidance",
                )
    assert filters > 5 and filmed > 5


def test_validation_clauses_make_commands_of_their_own():
    sampler = MissionSampler(USV)
    sampler.clauses = MissionSampler(USV, "validation").clauses
    lines = list(itertools.chain(*sampler.clauses))
    assert lines and {line.split for line in lines} == {"validation"}
    made = Drawing(sampler, bind(lines[0], sampler), random.Random(0))
    assert list(made.pieces()) and made.template is lines[0]
