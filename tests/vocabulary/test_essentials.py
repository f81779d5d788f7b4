"""The essentials file beside a definition: what is read, what is refused."""

from __future__ import annotations

import shutil
from pathlib import Path

from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.definition import BUNDLED
from planner_ft.vocabulary.essentials import essentials_of, load_essentials
from planner_ft.vocabulary.schema import documentation_page


def drone(folder: Path, essentials: str) -> Path:
    shutil.copy(BUNDLED / "inspection_drone.toml", folder / "mine.toml")
    (folder / "mine.essentials.toml").write_text(essentials)
    return folder / "mine.toml"


def test_the_vessels_essentials_are_read_and_listed() -> None:
    usv = load_vocabulary()
    survey = essentials_of("SurveyTarget", usv)
    assert list(survey.skills) == ["SetStreamRecording", "GetGPSLocation"]
    assert survey.defaults == {"radius": 10}
    assert essentials_of("BathymetryGridSurvey", usv).asks == ("width", "length")
    assert "| SetStreamRecording, GetGPSLocation | radius 10 |" in documentation_page(usv)


def test_the_digest_stays_and_a_vehicle_without_the_file_adds_nothing(tmp_path: Path) -> None:
    mine = load_vocabulary(drone(tmp_path, "[task.RoofScan]\ndefaults = { spacing = 4 }\n"))
    assert essentials_of("RoofScan", mine).defaults == {"spacing": 4}
    assert mine.sha256 == load_vocabulary("inspection_drone").sha256
    (tmp_path / "bare").mkdir()
    drone(tmp_path / "bare", "").with_name("mine.essentials.toml").unlink()
    assert load_essentials(load_vocabulary(tmp_path / "bare" / "mine.toml")) == {}
