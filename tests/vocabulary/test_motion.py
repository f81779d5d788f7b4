"""The motion file beside a definition: what is read, what is refused, and that it changes nothing
else.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from planner_ft.facts.words import known_words
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
