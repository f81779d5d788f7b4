"""The essentials file beside a definition: what is read, what is refused."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.definition import BUNDLED
from planner_ft.vocabulary.essentials import essentials_of, load_essentials
from planner_ft.vocabulary.text import documentation_page


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


@pytest.mark.parametrize(
    ("essentials", "said"),
    [
        ("[fact.data]\n", "unknown key 'fact'"),
        ("[task.Sail]\n", "[task.Sail]: the vehicle has no such task"),
        ("[task.RoofScan]\nneeds = []\n", "[task.RoofScan]: unknown key 'needs'"),
        ("[task.RoofScan]\nskills = { Dive = {} }\n", "skills: the vehicle has no skill 'Dive'"),
        ('[task.RoofScan]\nskills = ["TakePhoto"]\n', "skills must be a table of skills"),
        ("[task.RoofScan]\nskills = { Hover = { time = -1 } }\n", "Hover: time = -1 is not"),
        ('[task.RoofScan]\nduring = ["swim"]\n', "during: 'swim' is not a motion"),
        ('[task.RoofScan]\nasks = ["depth"]\n', "asks: 'depth' is not a parameter"),
        ("[task.RoofScan]\ndefaults = { depth = 1 }\n", "defaults: no parameter 'depth'"),
        ('[task.RoofScan]\ntakes = { Hover = { time = "x" } }\n', "takes: Hover.time = 'x' must"),
        (
            '[task.RoofScan]\ndefaults = { width = 1 }\nasks = ["width"]\n',
            "width has a default and is asked for",
        ),
    ],
)
def test_what_is_wrong_is_said(tmp_path: Path, essentials: str, said: str) -> None:
    with pytest.raises(PlannerError) as error:
        load_essentials(load_vocabulary(drone(tmp_path, essentials)))
    assert said in str(error.value)
    assert "mine.essentials.toml" in str(error.value) or "inspection_drone" in str(error.value)
