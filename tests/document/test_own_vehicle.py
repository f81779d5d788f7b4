"""A vehicle of one's own: the files to start from need nothing, and what is lacking is named."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner_ft.document.own_vehicle import check_vehicle, new_vehicle
from planner_ft.support.errors import PlannerError

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
    for name in ("usv", "My Rover", "../x"):
        with pytest.raises(PlannerError, match="take another one"):
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
