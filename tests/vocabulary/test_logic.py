"""The logic file beside a definition: what is read, what is refused, and that it changes nothing
else.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from planner_ft.facts.words import known_words
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.definition import BUNDLED

FACT = '[fact.data]\nlacking = "nothing was collected"\n[task.RoofScan]\ngives = ["data"]\n'


def drone(folder: Path, logic: str) -> Path:
    shutil.copy(BUNDLED / "inspection_drone.toml", folder / "mine.toml")
    (folder / "mine.logic.toml").write_text(logic)
    return folder / "mine.toml"


def test_the_bundled_logic_is_read() -> None:
    logic = load_vocabulary().logic
    assert logic.of("AutoGenerateReportSummary").needs == ("observations",)
    assert logic.of("SmartDataHarvest").sends == "target_list"
    assert "thermal" in logic.of("ThermalTimeLapse").yields
    assert logic.of("Transit").gives == ()


def test_the_digest_of_a_vocabulary_is_that_of_its_definition_alone(tmp_path: Path) -> None:
    """Adapters and candidates are refused for another digest; they do not depend on the logic."""
    with_logic = load_vocabulary(drone(tmp_path, FACT))
    assert with_logic.logic.of("RoofScan").gives == ("data",)
    assert with_logic.sha256 == load_vocabulary("inspection_drone").sha256


def test_a_vehicle_without_a_logic_file_declares_nothing(tmp_path: Path) -> None:
    drone(tmp_path, "").with_name("mine.logic.toml").unlink()
    assert load_vocabulary(tmp_path / "mine.toml").logic.tasks == {}


def test_words_of_logic_files_are_no_known_words() -> None:
    """Decoding with strength grounded corrects words that are not known: a logic file must not
    change answers.
    """
    assert "timelapse" in (BUNDLED / "usv.logic.toml").read_text()
    assert "timelapse" not in known_words()


def test_a_logic_file_that_is_no_toml_is_named(tmp_path: Path) -> None:
    with pytest.raises(PlannerError, match=r"mine.logic.toml: not TOML"):
        load_vocabulary(drone(tmp_path, "[fact\n"))
