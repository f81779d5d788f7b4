"""Synthetic missions: what a template says, the plan that follows, and every line of the files."""

import itertools
import json
import random
import re
from collections import Counter
from dataclasses import replace
from pathlib import Path

import jsonschema
import pytest

from planner_ft.data.mission_binding import bind
from planner_ft.data.missions import MissionSampler, mission_sampler, sample_missions
from planner_ft.data.rules import rule_problems
from planner_ft.data.targets import is_formula, worked_out
from planner_ft.data.templates.records import Template, template_files, templates
from planner_ft.data.templates.render import plain
from planner_ft.facts.places import read_positions
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import plan_names, plan_problems, value_problem

USV, DRONE = load_vocabulary(), load_vocabulary("inspection_drone")
VEHICLES = [USV, DRONE]
READ = 12
"""Of so many lines one is read again, by the label rules."""


def template(command, plan, **remarks):
    lists = {name: tuple(lines) for name, lines in remarks.items()}
    return Template("made-1", "train", command, plan, "made.jsonl:1", **lists)


def draws(command, plan, count=25, vehicle=USV, **remarks):
    """(text, tasks as (title, parameters), plan) of a template."""
    made, sampler = template(command, plan, **remarks), mission_sampler(vehicle)
    for seed in range(count):
        command = sampler.compose([made], random.Random(seed))
        text, expected = command.text, command.expected
        tasks = [(task["title"], task["parameters"]) for task in expected["tasks"]]
        yield plain(text), tasks, expected


def titles(tasks):
    return [title for title, _parameters in tasks]


# ---------------------------------------------------------------- every line


@pytest.mark.parametrize("vehicle", VEHICLES, ids=lambda vehicle: vehicle.name)
def test_every_line_draws_commands_that_follow_the_label_rules(vehicle):
    """Values that the text leaves to arithmetic stand in the plan as literals or formulas and are
    not checked here; searches and returns that a record asks for in other words are few.
    """
    sampler = MissionSampler(vehicle)
    lines = list(itertools.chain(*sampler.groups))
    exceptions = 0
    unread: list[str] = []
    for number, line in enumerate(lines):
        calls = [step.call for step in bind(line, sampler).tasks]
        literal = {
            one.name
            for call in calls
            for one in call.arguments
            if one.kind == "literal" or (one.kind == "slot" and is_formula(str(one.value)))
        } | {
            str(vehicle.task[title].position_parameter)
            for call in calls
            for title in (call.name, vehicle.transit)
            if any(map(is_formula, call.of("object")))
        }
        command = sampler.compose([line], random.Random(f"{line.id}0"))
        text, expected = command.text, command.expected
        assert text, line.where
        assert plan_problems("mission", expected, vehicle, strict=True) == [], line.where
        if number % READ:
            continue
        problems = rule_problems(expected, vehicle, plain(text))
        values = [
            problem
            for problem in problems
            if "does not follow from" in problem or "not in the command" in problem
        ]
        left = [item for item in values if item.split(", ")[1].split(":")[0] not in literal]
        unread += [f"{line.where}: {plain(text)}: {item}" for item in left]
        exceptions += len(problems) > len(values)
    assert exceptions < 0.04 * len(lines) / READ + 1
    # "x 6, y 91 and half as long": a text may be read in another way.
    assert len(unread) < 0.008 * len(lines) / READ + 1, unread


@pytest.mark.parametrize("vehicle", VEHICLES, ids=lambda vehicle: vehicle.name)
def test_records_are_of_the_schema_and_their_ids_of_their_file(vehicle):
    schema = read_json("schemas/templates.schema.json")
    check = jsonschema.Draft202012Validator(schema)
    ident = re.compile(schema["properties"]["id"]["pattern"])
    for kind in ("commands", "prompts"):
        seen = Counter()
        for path in template_files(vehicle, kind):
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines()):
                record = json.loads(line)
                assert ident.match(record["id"]), f"{path}: {record['id']}"
                assert number % 9 or check.is_valid(record), f"{path}: {record['id']}"
                if path.parent.name.endswith(kind):
                    assert record["id"].startswith(f"{path.stem}-")
                seen[record["id"]] += 1
        assert max(seen.values(), default=1) == 1


@pytest.mark.parametrize("vehicle", VEHICLES, ids=lambda vehicle: vehicle.name)
def test_the_templates_cover_tasks_empty_plans_corrections_and_refusals(vehicle):
    lines = list(itertools.chain(*templates(vehicle, "commands", "train")))
    named = {step.call.name for line in lines for step in line.steps}
    assert {task.title for task in vehicle.tasks} | {"Home"} <= named
    assert any(not line.plan and line.constraints for line in lines)
    assert any("{~" in line.text for line in lines)
    assert any("no task for" in text for line in lines for text in line.constraints)
    assert any(line.excluded for line in lines)


def test_bad_lines_are_named_by_file_and_line(tmp_path):
    (tmp_path / "rover.toml").write_text(
        DRONE.path.read_text().replace("inspection_drone", "rover")
    )
    lines = tmp_path / "rover.commands.jsonl"
    good = {"id": "a-1", "split": "train", "command": "Fly to {P1}.", "plan": "FlyToPoint P1"}
    for bad, problem in (
        ("{", "not JSON"),
        ({**good, "split": "held"}, "split 'held'"),
        ({**good, "texts": "x"}, "unknown field texts"),
        ({**good, "plan": 3}, "plan is missing"),
    ):
        text = bad if isinstance(bad, str) else json.dumps(bad)
        lines.write_text(json.dumps(good) + "\n" + text + "\n")
        rover = load_vocabulary(tmp_path / "rover.toml")
        with pytest.raises(PlannerError, match=rf"rover\.commands\.jsonl:2: .*{problem}"):
            from planner_ft.data.templates.records import read_templates

            read_templates.cache_clear()
            list(sample_missions(1, 3, rover))


@pytest.mark.parametrize(
    ("command", "plan", "problem"),
    [
        ("Hold (a|b.", "KeepStation here", "a bracket is not closed"),
        ("Hold.", "Hold here", "there is no task Hold"),
        ("Hold for {radius}.", "KeepStation here radius", "has no parameter radius"),
        ("Hold.", "KeepStation", "has no place"),
        ("Hold for {duration}.", "KeepStation here", "belongs to no task"),
        ("Hold at {P1}.", "KeepStation P1 duration", "stands in the plan and not in the text"),
        ("Hold.", "KeepStation?now here", "the label ?now stands only"),
        ("Survey ({T1}|it).", "SurveyTarget T1", "not every alternative"),
        ("Go {P1}, {P2 x3}.", "Transit P1; Transit P2", "x3 names no place"),
        ("Survey {T1:ghost}.", "SurveyTarget T1", "no word list ghost"),
        ("Survey {T1}.", 'SurveyTarget T1 radius="5', "is no slot, number"),
    ],
)
def test_mistakes_are_named(command, plan, problem):
    with pytest.raises(PlannerError) as error:
        list(draws(command, plan))
    assert str(error.value).startswith("made.jsonl:1: ") and problem in str(error.value)


# ---------------------------------------------------------------- labels


def test_a_described_target_is_searched_once_before_its_first_use():
    for _text, tasks, expected in draws(
        "{T1 lost}: survey at {radius}, orbit at {radius2}, home.",
        "SurveyTarget T1 radius; PerformOrbit T1 radius=radius2; Home",
    ):
        assert titles(tasks) == ["SearchAndDetect", "SurveyTarget", "PerformOrbit", "Transit"]
        assert tasks[1][1]["target_position"] == [-99, -99] == tasks[2][1]["center"]
        assert tasks[3][1] == {"target_position": [0, 0]}
        assert len(expected["constraints"]) == 1 and "must be found" in expected["constraints"][0]
        assert expected["assumptions"][-1] == "Home is [0, 0]."


def test_a_target_with_coordinates_is_searched_only_on_request():
    for text, tasks, _expected in draws("Survey {T1 located}.", "SurveyTarget T1"):
        assert titles(tasks) == ["SurveyTarget"]
        assert tasks[0][1]["target_position"] != [-99, -99]
        assert any(mark.isdigit() for mark in text)
    for _text, tasks, _expected in draws("Find {T1 located}.", "SearchAndDetect T1"):
        assert titles(tasks) == ["SearchAndDetect"]


@pytest.mark.parametrize(
    ("command", "plan", "wanted"),
    [
        ("Hold at {P1}.", "KeepStation P1", "Transit KeepStation"),
        ("Hold at {P1}, drift.", "KeepStation P1; DriftAudit P1", "Transit KeepStation DriftAudit"),
        ("Hold.", "KeepStation here", "KeepStation"),
        ("Check {T1}, you lie there.", "KeepStation T1 here", "KeepStation"),
        (
            "{P1}, {P2}, {P1}.",
            "KeepStation P1; KeepStation P2; KeepStation P1",
            "Transit KeepStation Transit KeepStation Transit KeepStation",
        ),
        (
            "Hold at {P1}, check, hold again.",
            "KeepStation P1; Diagnostics; KeepStation P1",
            "Transit KeepStation Diagnostics KeepStation",
        ),
        (
            "Depths at {P1}, then hold there.",
            "BathymetryGridSurvey P1; KeepStation P1",
            "BathymetryGridSurvey Transit KeepStation",
        ),
        ("Find {T1 lost}.", "SearchAndDetect T1", "SearchAndDetect"),
        ("Find {T1 lost}, go.", "SearchAndDetect T1; Transit T1", "SearchAndDetect Transit"),
        ("Follow {ID1}.", "FollowTarget ID1", "FollowTarget"),
        ("Follow {T1:boat lost}.", "FollowTarget T1", "SearchAndDetect FollowTarget"),
        ("Dock at {T1:dock lost}.", "DockingApproach T1", "DockingApproach"),
        (
            "Dock on the {mark1}, hold.",
            "KeepStation P1; VisualDockingApproach target_feature=mark1; KeepStation P1",
            "Transit KeepStation VisualDockingApproach Transit KeepStation",
        ),
    ],
)
def test_searches_and_transits_follow_the_rules(command, plan, wanted):
    command = command if "P1" not in plan or "{P1}" in command else f"{{P1}}: {command}"
    for _text, tasks, _expected in draws(command, plan, 8):
        assert titles(tasks) == wanted.split()


@pytest.mark.parametrize(
    ("command", "plan", "works"),
    [
        (
            "Sound {P1} to {P2}.",
            "BathymetryGridSurvey mid(P1,P2) width=dx(P1,P2) length=dy(P1,P2)",
            lambda task: [
                {2 * middle - side, 2 * middle + side}
                for middle, side in zip(
                    task["center"], (task["width"], task["length"]), strict=True
                )
            ],
        ),
        (
            "Corner {P1}, {width} by {length}, {P2}.",
            "BathymetryGridSurvey from_sw(P1,width,length) width length; Transit P2",
            lambda task: [
                {2 * middle - side}
                for middle, side in zip(
                    task["center"], (task["width"], task["length"]), strict=True
                )
            ],
        ),
    ],
)
def test_areas_lie_between_their_corners(command, plan, works):
    """The doubled coordinates of the corners, worked out from the plan, are those of the text."""
    bound = 0
    for text, tasks, _plan in draws(command, plan, 60):
        said = [{2 * place.x, 2 * place.y} for place in read_positions(text)[:2]]
        for side, sides in enumerate(works(tasks[0][1])):
            known = {round(number, 1) for place in said for number in place}
            bound += {round(number, 1) for number in sides} <= known
            assert side < 2
    assert bound >= 100


@pytest.mark.parametrize(("heading", "step"), [(0, (0, 50)), (90, (50, 0)), (180, (0, -50))])
def test_a_move_ends_so_far_from_where_it_began(heading, step):
    place = {"P1": (10, 20), "length": 50, "heading": heading}
    once = worked_out("move(P1,length,heading)", place.__getitem__)
    assert once == (10 + step[0], 20 + step[1])
    twice = worked_out("mid(P1,move(move(P1,length,heading),length,heading))", place.__getitem__)
    assert twice == once


def test_places_share_coordinates_where_the_text_says_so():
    text = "{P1 x0}, {P2 y1}, {P3 x2}, {P4 x1 y3}, {P5 on1_2}"
    for _text, tasks, _expected in draws(text, "; ".join(f"Transit P{n}" for n in range(1, 6))):
        first, second, third, fourth, fifth = (task[1]["target_position"] for task in tasks)
        assert first[0] == 0 and first[1] == second[1] and second[0] == third[0]
        assert fourth == [first[0], third[1]] and fourth not in (first, second, third)
        assert fifth[0] == pytest.approx(2 * second[0], abs=0.01) and fifth[1] == first[1]


def test_a_command_has_limits_of_its_own_and_docks_without_a_name():
    command = "Mind {T1:hazard located}, {distance} off it. {P1}. Dock."
    plan = 'Transit P1; DockingApproach spot="dock"; keep_out T1 distance'
    for _text, tasks, expected in draws(command, plan):
        assert titles(tasks) == ["Transit", "DockingApproach"]
        assert tasks[1][1] == {"goal_position": [-99, -99]}
        (limit,) = expected["constraints"]
        assert limit.startswith("The vehicle stays at least ")
        asked = limit.replace("The vehicle stays", "Keep")
        assert all(task["task_prompt"].endswith(asked) for task in expected["tasks"])


def test_a_limit_of_single_tasks_stands_in_their_prompts_alone():
    command = "Go to {P1}, then circle {T1 located}, at most {speed} as you circle, then home."
    for _text, _tasks, expected in draws(
        command, 'Transit P1; PerformOrbit T1; Home; speed speed of="PerformOrbit"'
    ):
        (limit,) = expected["constraints"]
        assert limit.endswith(" during PerformOrbit.")
        limited = [task["title"] for task in expected["tasks"] if "faster" in task["task_prompt"]]
        assert limited == ["PerformOrbit"]
    with pytest.raises(PlannerError, match="there is no task Orbit to limit"):
        next(draws("{P1}, at most {speed}.", 'Transit P1; speed speed of="Orbit"'))


def test_what_is_taken_back_is_said_but_not_planned():
    for text, tasks, _expected in draws(
        "Hold at {P1} for {~duration}, no, {duration}. Not {T1 bare}.",
        "KeepStation P1 duration ~T1",
    ):
        assert titles(tasks) == ["Transit", "KeepStation"] and ", no, " in text


def test_a_number_is_said_without_its_unit_where_its_figure_is_asked_for():
    for text, _tasks, expected in draws(
        r"Hold at \[{length1 figure}, {length2 figure}\], I mean minus {length2 figure}.",
        "KeepStation swapped(mirror_x(new_x(new_y(Home,length1),length2)))",
    ):
        x, y = expected["tasks"][0]["parameters"]["target_position"]
        assert text == f"Hold at [{x}, {-y}], I mean minus {-y}."


def test_labels_and_optional_slots_follow_their_alternative():
    seen = set()
    for text, tasks, _expected in draws(
        "(Check{?a}|Report{?b}) and survey {T1 located}( at {radius}|).",
        "Diagnostics?a; AutoGenerateReportSummary?b; SurveyTarget T1 radius",
        60,
    ):
        first = "Diagnostics" if text.startswith("Check") else "AutoGenerateReportSummary"
        assert titles(tasks) == [first, "SurveyTarget"]
        assert ("radius" in tasks[1][1]) == text.rstrip(".").endswith(
            ("m", "metres", "meters", "metre", "feet", "ft")
        )
        seen.add((first, "radius" in tasks[1][1]))
    assert len(seen) == 4


def test_remarks_become_constraints_and_assumptions():
    for _text, tasks, expected in draws(
        "No report. Keep {radius} from {T1 lost}. Nothing else.",
        "",
        5,
        excluded=["AutoGenerateReportSummary"],
        constraints=["The vehicle stays {radius} from {T1}."],
        assumptions=["there is nothing else"],
    ):
        assert tasks == [] and expected["assumptions"] == ["There is nothing else."]
        assert expected["constraints"][0] == "No report is written."
        assert expected["constraints"][-1].startswith("The command rules out everything")
    assert next(draws("Hello.", ""))[2]["constraints"] == [
        "The command asks for nothing that the vehicle has a task for."
    ]


def test_look_alikes_share_their_noun_and_differ_in_their_look():
    for text, tasks, _expected in draws(
        "{T1:pair one} of the {T1 nouns}, then {T2:pair one}.", "Transit T1; Transit T2"
    ):
        first, second = (tasks[number][1]["target_description"] for number in (0, 2))
        assert first != second and first.split(" ")[-1] == second.split(" ")[-1]
        assert " one of the " in text


def test_a_label_may_be_a_slot_of_the_alternative():
    for text, tasks, _expected in draws(
        "Home(. Circle {T1} at {radius}|).", "Home; PerformOrbit?T1 T1 radius"
    ):
        assert ("PerformOrbit" in titles(tasks)) == ("ircle" in text)


def test_an_id_may_be_named_by_its_parameter():
    for text, tasks, _expected in draws("At {P1}, keep on {ID1}.", "FollowTarget target_id=ID1 P1"):
        assert text.endswith(f"{tasks[0][1]['target_id']}.")


def test_a_series_has_room_for_two_readings_and_its_values_differ():
    for _text, tasks, _expected in draws(
        "{T1}: every {interval} for {duration}.", "ThermalTimeLapse T1 interval duration"
    ):
        assert 2 * tasks[-1][1]["interval"] <= tasks[-1][1]["duration"]


# ---------------------------------------------------------------- samples


def test_the_same_seed_gives_the_same_samples():
    first, second = list(sample_missions(4, 30)), list(sample_missions(4, 30))
    assert first == second and list(sample_missions(5, 30)) != first


@pytest.mark.parametrize("vehicle", VEHICLES, ids=lambda vehicle: vehicle.name)
def test_samples_are_valid_and_mostly_differ(vehicle):
    records = list(sample_missions(2, 300, vehicle))
    for record in records:
        assert plan_problems("mission", record["expected"], vehicle, strict=True) == []
        assert "  " not in record["prompt"] and record["prompt"] == record["prompt"].strip()
        tags = [] if record["expected"]["tasks"] else ["rule.empty"]
        assert record.get("tags", []) == tags and ("tags" in record) == bool(tags)
    assert len({record["prompt"] for record in records}) > 270
    named = {title for record in records for title in plan_names("mission", record["expected"])}
    assert len(named) > 0.85 * len(vehicle.tasks)
    assert any(record["family"] == "synthetic-orders" for record in records) == (vehicle is DRONE)


def test_task_prompts_state_every_value():
    for record in sample_missions(8, 200):
        for task in record["expected"]["tasks"]:
            for name, value in task["parameters"].items():
                if isinstance(value, int | float | str):
                    assert str(value) in task["task_prompt"], (name, task)


def test_a_vehicle_without_templates_is_told_what_to_write(tmp_path):
    (tmp_path / "rover.toml").write_text(
        DRONE.path.read_text().replace("inspection_drone", "rover")
    )
    with pytest.raises(PlannerError, match=r"write rover\.commands\.jsonl beside the definition"):
        next(sample_missions(0, 1, load_vocabulary(tmp_path / "rover.toml")))


@pytest.mark.parametrize(
    ("kind", "unit", "bounds"), [("polygon", "m", {}), ("number", "m/s", {"maximum": 1.0})]
)
def test_foreign_units_are_of_lengths_and_speeds_that_the_parameter_takes(kind, unit, bounds):
    sampler, rng = MissionSampler(USV), random.Random(1)
    parameter = replace(USV.tasks[1].parameters[0], name="x", type=kind, unit=unit, **bounds)
    draw = sampler.draw(USV.tasks[1], parameter)
    drawn = [draw(rng).value for _ in range(400)]
    assert not [value for value in drawn if value_problem(value, parameter)]


def test_invented_vehicles_draw_valid_missions():
    folders = [path for path in sorted(Path("data/vehicles").iterdir()) if path.is_dir()]
    assert len(folders) > 20
    for folder in folders:
        vehicle = load_vocabulary(folder / f"{folder.name}.toml")
        for record in sample_missions(7, 6, vehicle):
            assert plan_problems("mission", record["expected"], vehicle, strict=True) == []
