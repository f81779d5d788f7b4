"""The motion file beside a definition: what is read, what is refused, and that it changes nothing
else.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from planner_ft.facts.words import known_words
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.definition import BUNDLED, bundled_vocabularies


def drone(folder: Path, motion: str) -> Path:
    shutil.copy(BUNDLED / "inspection_drone.toml", folder / "mine.toml")
    (folder / "mine.motion.toml").write_text(motion)
    return folder / "mine.toml"


@pytest.mark.parametrize("name", bundled_vocabularies())
def test_every_navigation_skill_of_a_bundled_vehicle_has_a_motion(name: str) -> None:
    vocabulary = load_vocabulary(name)
    assert [
        skill.name
        for skill in vocabulary.skills_in_role("navigation")
        if vocabulary.motion.of(skill.name) is None
    ] == []


def test_roles_name_the_parameters_of_a_skill() -> None:
    motion = load_vocabulary().motion.of("ArcTurn")
    assert motion is not None and motion.kind == "arc"
    assert motion.value("angle", {"radius": 5, "delta_yaw": -90}) == -90
    assert motion.value("time", {"radius": 5}) is None


def test_the_digest_of_a_vocabulary_is_that_of_its_definition_alone(tmp_path: Path) -> None:
    """Adapters are refused for another digest."""
    vocabulary = load_vocabulary(drone(tmp_path, '[skill.Hover]\nmotion = "hold"\n'))
    assert vocabulary.motion.of("FlyToXY") is None
    assert vocabulary.sha256 == load_vocabulary("inspection_drone").sha256


def test_words_of_companion_files_are_no_known_words() -> None:
    """Decoding with strength grounded corrects words that are not known: these files must not
    change answers.
    """
    for ending, word in (
        ("motion", "exporting"),
        ("ontology", "summarize"),
        ("vehicle", "estimates"),
    ):
        assert word in (BUNDLED / f"usv.{ending}.toml").read_text()
        assert word not in known_words()


@pytest.mark.parametrize(
    ("motion", "said"),
    [
        ('[skill.Sail]\nmotion = "go"\n', "skill Sail: it is not defined"),
        ('[skill.Hover]\nmotion = "swim"\n', "motion = 'swim' must be one of go, hold"),
        ('[skill.FlyToXY]\nmotion = "go"\nx = "x"\n', "go needs y"),
        (
            '[skill.Hover]\nmotion = "hold"\ntime = "duration"\n',
            "time = 'duration' must name a parameter of type number",
        ),
        ('[skill.Hover]\nmotion = "hold"\nspeed = "time"\n', "unknown key 'speed'"),
        (
            '[skill.Hover]\nmotion = "boundary"\npolygon = "time"\n',
            "does not fit the role navigation",
        ),
        ('[task.TowerOrbit]\ncenter = "center"\n', "a stand-off needs radius"),
        (
            '[task.TowerOrbit]\ncenter = "radius"\nradius = "radius"\n',
            "center = 'radius' must name a parameter of type position",
        ),
        ("skill = 3\n", "needs tables [skill.NAME]"),
        ("[skills]\n", "unknown key 'skills'"),
    ],
)
def test_a_motion_file_with_mistakes_is_refused(tmp_path: Path, motion: str, said: str) -> None:
    with pytest.raises(PlannerError) as caught:
        load_vocabulary(drone(tmp_path, motion))
    assert said in str(caught.value)
