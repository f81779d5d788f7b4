"""A vehicle of one's own: the files to start from need nothing, and what is lacking is named."""

from __future__ import annotations

import json
import re
from itertools import islice
from pathlib import Path

import pytest

from planner_ft.data.missions import sample_missions
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.data.templates.checking import checked_templates
from planner_ft.document import own_vehicle
from planner_ft.document.own_vehicle import check_vehicle, new_vehicle
from planner_ft.simulation.checking import check_simulation
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary

OPTIONAL = {f"my_rover.{name}.toml" for name in ("phrases", "logic", "simulation")}


@pytest.fixture
def rover(tmp_path: Path) -> Path:
    new_vehicle("my_rover", tmp_path / "rover")
    return tmp_path / "rover" / "my_rover.toml"


def states(rover: Path) -> dict[str, str]:
    return {part.file: part.state for part in check_vehicle(str(rover))}


def test_a_new_vehicle_has_what_it_needs_and_is_written_once(rover: Path) -> None:
    found = states(rover)
    assert {file for file, state in found.items() if state != "ready"} == OPTIONAL
    lines = [path.read_text() for path in rover.parent.glob("mission/*.jsonl")]
    assert sum(text.count("\n") for text in lines) == 10
    assert not any("my_vehicle" in path.read_text() for path in rover.parent.glob("*.*"))
    with pytest.raises(PlannerError, match="exists; give a new folder with --out"):
        new_vehicle("my_rover", rover.parent)
    for name, why in (("usv", "a bundled vehicle"), ("My Rover", "a name has"), ("../x", "a-z")):
        with pytest.raises(PlannerError, match=f"{why}.*take another one"):
            new_vehicle(name, rover.parent / "other")


def test_what_is_wrong_and_what_is_lacking_is_named(rover: Path) -> None:
    (rover.parent / "mission" / "test.jsonl").unlink()
    rover.with_suffix(".vehicle.toml").write_text("cruise_speed = 1\n")
    rover.with_suffix(".motion.toml").unlink()
    commands = rover.with_suffix(".commands.jsonl")
    commands.write_text(commands.read_text().replace("Wait P1 duration", "Linger P1 duration"))
    parts = {part.file: part for part in check_vehicle(str(rover))}
    assert parts["mission/"].state == "missing" and "test.jsonl" in parts["mission/"].text
    assert parts["my_rover.motion.toml"].state == "missing"
    assert "name must be a text" in parts["my_rover.vehicle.toml"].text
    assert "my_rover.commands.jsonl:2" in parts["my_rover.commands.jsonl"].text


def test_samples_stay_within_the_bounds_of_the_skill_that_goes(rover: Path) -> None:
    """Also where the place that is not known yet is out of bounds, and one end has no bound."""
    text, wide = rover.read_text(), "minimum = -100000, maximum = 100000"
    for x, y in (("minimum = -60, maximum = 60",) * 2, ("minimum = 300", "maximum = 60")):
        rover.write_text(text.replace(wide, x, 1).replace(wide, y, 1))
        assert states(rover)["my_rover.commands.jsonl"] == "ready"
        samples = sample_tasks(load_vocabulary(str(rover)), 0, 100, "train")
        assert len(list(samples)) == 100


def test_a_task_prompt_in_another_unit_is_named(rover: Path) -> None:
    path = rover.with_suffix(".missions.toml")
    path.write_text(path.read_text().replace("{duration} seconds", "{duration} minutes"))
    parts = {part.file: part for part in check_vehicle(str(rover))}
    problem = "prompt: duration is in s, not minutes"
    assert problem in parts["my_rover.commands.jsonl"].text
    with pytest.raises(PlannerError, match=r"my_rover\.missions\.toml: \[task\.Wait\]"):
        list(sample_missions(0, 100, load_vocabulary(str(rover))))


def test_a_task_without_a_prompt_says_its_values(rover: Path) -> None:
    path, own = (
        rover.with_suffix(".missions.toml"),
        'prompt = ["Wait {at}[ for {duration} seconds]."]\n',
    )
    assert own in path.read_text()
    path.write_text(path.read_text().replace(own, ""))
    made = list(sample_missions(0, 100, load_vocabulary(str(rover))))
    tasks = [task for one in made for task in one["expected"]["tasks"] if task["title"] == "Wait"]
    timed = [task for task in tasks if "duration" in task["parameters"]]
    assert timed and all(
        f"duration {task['parameters']['duration']}" in task["task_prompt"] for task in timed
    )


def test_a_slot_that_nothing_fills_is_named(rover: Path) -> None:
    commands = rover.with_suffix(".commands.jsonl")
    commands.write_text(commands.read_text().replace("{duration}.", "{nonsense} {duration}.", 1))
    text = next(part.text for part in check_vehicle(str(rover)) if part.file == commands.name)
    assert "my_rover.commands.jsonl:2: {nonsense} is no target, parameter or word list" in text


def test_a_task_that_nobody_asks_for_is_named(rover: Path) -> None:
    commands = rover.with_suffix(".commands.jsonl")
    kept = [line for line in commands.read_text().splitlines() if "Report" not in line]
    commands.write_text("".join(f"{line}\n" for line in kept))
    text = next(part.text for part in check_vehicle(str(rover)) if part.file == commands.name)
    assert text.endswith("; no command asks for Report")


def test_a_broken_definition_is_all_that_is_said(rover: Path) -> None:
    rover.write_text(rover.read_text().replace('arrival = "none"', 'arrival = "nowhere"'))
    (part,) = check_vehicle(str(rover))
    assert part.state == "wrong" and "arrival = 'nowhere'" in part.text


@pytest.mark.parametrize("broken", [False, True])
def test_a_mistake_in_one_file_hides_none_in_another(rover: Path, broken: bool) -> None:
    """Beside a definition that is right or wrong itself."""
    motion, own = (rover.with_suffix(f".{kind}.toml") for kind in ("motion", "vehicle"))
    motion.write_text(f"{motion.read_text()}\n[skill.Nobody]\nmotion = 'hold'\n")
    rover.with_suffix(".phrases.toml").write_text("[task\n")
    own.write_text("cruise_speed =\n")
    if broken:
        text = rover.read_text()
        rover.write_text(text.replace('navigation = ["', 'navigation = ["Flight", "', 1))
    parts = {part.file: part for part in check_vehicle(str(rover))}
    wrong = {file: part.text for file, part in parts.items() if part.state == "wrong"}
    files = {f"my_rover.{kind}.toml" for kind in ("motion", "phrases", "vehicle")}
    assert files <= wrong.keys() and (rover.name in wrong) == broken
    assert "skill Nobody: it is not defined" in wrong["my_rover.motion.toml"]
    assert "Flight" not in wrong["my_rover.motion.toml"]
    assert broken or parts["mission/"].state == "ready"


def test_a_folder_is_its_one_definition(rover: Path, tmp_path: Path) -> None:
    assert check_vehicle(str(rover.parent)) == check_vehicle(str(rover))
    for source in (tmp_path, tmp_path / "nowhere"):
        with pytest.raises(PlannerError, match="give the TOML file of a vehicle") as raised:
            check_vehicle(str(source))
        assert "--vocabulary" not in str(raised.value)


def test_what_a_definition_hardly_means_is_told(rover: Path) -> None:
    horn = (
        '[[skill]]\nname = "Horn"\ncategory = "Data"\nrole = "perception"\ndescription = "Horn"\n'
    )
    text = rover.read_text().replace('unit = "s"', 'unit = "ticks of a clock"', 1)
    rover.write_text(f"{text}\n{horn}")
    first = check_vehicle(str(rover))[0]
    assert first.state == "ready" and "no task lists the skill Horn" in first.text
    assert "the unit 'ticks of a clock' is not known" in first.text


def test_names_that_are_in_no_definition_are_told_file_by_file(rover: Path) -> None:
    for ending, table in (("missions", "[task.Wate]"), ("simulation", "[skill.Wate]")):
        path = rover.with_name(f"my_rover.{ending}.toml")
        old = path.read_text() if path.is_file() else ""
        path.write_text(f"{old}\n{table}\n")
    found = {part.file: part for part in check_vehicle(str(rover))}
    for ending, table in (("missions", "[task.Wate]"), ("simulation", "[skill.Wate]")):
        part = found[f"my_rover.{ending}.toml"]
        assert part.state == "wrong" and f"{table}: the definition has no such name" in part.text
    assert found["my_rover.motion.toml"].state == "ready"


def test_a_search_for_nothing_is_named(rover: Path) -> None:
    text = re.sub(r'locate = "\w+"', 'locate = "Report"', rover.read_text())
    rover.write_text(text)
    parts = {part.file: part for part in check_vehicle(str(rover))}
    commands = parts["my_rover.commands.jsonl"]
    assert commands.state == "wrong" and "needs a parameter of type text" in commands.text


def test_a_pattern_that_means_nothing_is_told(rover: Path) -> None:
    rover.write_text(rover.read_text().replace('pattern = "square"', 'pattern = "fly"'))
    assert "the pattern 'fly' of" in check_vehicle(str(rover))[0].text


def test_tags_that_nothing_checks_are_named(rover: Path) -> None:
    path = rover.parent / "mission" / "train.jsonl"
    first, *rest = path.read_text().splitlines()
    record = json.loads(first)
    record["tags"] = [*record["tags"], "rule.dock"]
    path.write_text("\n".join([json.dumps(record, separators=(",", ":")), *rest, ""]))
    text = {part.file: part.text for part in check_vehicle(str(rover))}["mission/"]
    assert "tags about tasks of other vehicles are not checked: rule.dock" in text


def test_every_problem_of_a_set_is_a_line(rover: Path) -> None:
    path = rover.parent / "mission" / "test.jsonl"
    right = path.read_text()
    for count in (1, 2, 30):
        path.write_text(right + "{\n" * count)
        part = {part.file: part for part in check_vehicle(str(rover))}["mission/"]
        lines = str(part).split("\n")
        assert len(lines) == count and all("test.jsonl:" in line for line in lines)


def test_a_part_is_a_line_with_what_it_serves(rover: Path) -> None:
    parts = {part.file: str(part) for part in check_vehicle(str(rover))}
    assert parts["my_rover.logic.toml"].startswith("missing  my_rover.logic.toml")
    assert parts["my_rover.logic.toml"].endswith(" (bench)")
    assert " tasks, " in parts["my_rover.toml"] and "no task lists" not in parts["my_rover.toml"]
    assert "no command asks for" not in parts["my_rover.commands.jsonl"]
    rover.with_suffix(".commands.jsonl").unlink()
    found = {part.file: part for part in check_vehicle(str(rover))}["my_rover.commands.jsonl"]
    assert found.state == "missing" and "no synthetic missions" in found.text


@pytest.mark.parametrize(
    ("kind", "content", "problem"),
    [
        ("missions", "task.Wait = []", "task.Wait: [] is not of type 'object'"),
        ("missions", "target = 'nobody'", "target = 'nobody': there is no such word list"),
        ("phrases", "skill.Stop.often = 'x'", "skill.Stop.often: 'x' is not of type 'object'"),
        ("limits", "speed = 3", "speed: 3 is not of type 'object'"),
        ("missions", "target = 'x'\nnothin = 'x'", "('nothin' was unexpected)"),
        (
            "missions",
            "demand.TakePictures = 'x'",
            "[demand] names 'TakePictures', which is no skill",
        ),
        ("missions", "task.Wait.prompt = ['{dosis}']", "[task.Wait]: {dosis} is no parameter"),
        (
            "ontology",
            "[[ask]]\nwords = ['wait']\ntasks = ['Wait']\nsend = true",
            "[[ask]]: unknown key 'send'",
        ),
        (
            "essentials",
            "task.LookAround.takes = { Stop = { time = 'radius' } }",
            "[task.LookAround]: takes: Stop.time is in s, and radius of the task in m",
        ),
        ("simulation", "skill.Stop.every = 0", "skill.Stop.every: 0 is less than or equal"),
        ("simulation", "lidar = { rays = 6, reach = 5 }", "('reach' was unexpected)"),
        ("simulation", "vessel.drive = 'wheels'", "drive = 'wheels' must be differential or free"),
        ("simulation", "vessel.mass = -60", "mass = -60 must be above 0"),
        ("simulation", "vessel.drag = [1.0]", "drag must be three numbers"),
        ("simulation", "vessel.weight = 60", "[vessel] has no key 'weight'"),
        ("simulation", "skill.Stop.measure = 'gps'", "measure = 'gps' must be one of"),
        ("simulation", "skill.Stop.implementation = 'nope'", "'nope' is not installed"),
        ("simulation", "task.Wait.learnt = 'nope'", "[task.Wait] learnt:"),
    ],
)
def test_the_shape_of_every_file_is_checked(
    rover: Path, kind: str, content: str, problem: str
) -> None:
    rover.with_suffix(f".{kind}.toml").write_text(content + "\n")
    parts = check_vehicle(str(rover), check_simulation)
    assert any(part.state == "wrong" and problem in part.text for part in parts), parts


def test_bundled_vehicles_are_ready(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of their thousands of templates, each tested elsewhere, the first few."""
    monkeypatch.setattr(
        own_vehicle, "checked_templates", lambda known: islice(checked_templates(known), 100)
    )
    for name in ("usv", "inspection_drone"):
        parts = check_vehicle(name, check_simulation)
        assert [part for part in parts if part.state == "wrong"] == []


def test_a_skill_that_a_task_does_not_list_is_told(rover: Path) -> None:
    path = rover.with_suffix(".essentials.toml")
    path.write_text("[task.Report]\nskills = { TakePicture = {} }\n")
    text = {part.file: part for part in check_vehicle(str(rover))}[path.name].text
    assert "TakePicture does not fit Report, which does not list it" in text
