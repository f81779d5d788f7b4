"""The four elements of a command, and what is asked where one is missing."""

from __future__ import annotations

import pytest

from planner_ft.document.language import language, pattern
from planner_ft.document.ontology import check
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_jsonl
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.definition import BUNDLED
from tests.documents import DRONE, USV


def elements(command: str) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for entry in check(command, USV)["elements"]:
        assert command[entry["start"] : entry["end"]] == entry["text"]
        found.setdefault(entry["element"], []).append(entry["text"])
    return found


def test_all_four_are_found() -> None:
    found = elements(
        "Circle the old lighthouse at [40, 12] with the thermal camera, keep clear of the divers"
        " and come home."
    )
    assert found["target"][0] == "the old lighthouse at [40, 12]"
    assert "Circle" in found["objective"]
    assert any("thermal" in text for text in found["sensor"])
    assert found["constraint"] == ["keep clear of the divers", "come home."[:-1]]
    assert check("Circle the pier with the camera and come home.", USV)["missing"] == []


def test_what_is_missing_is_asked() -> None:
    asked = check("Circle the pier.", USV)
    assert asked["missing"] == ["sensor", "constraint"]
    assert asked["questions"][0].startswith("Which sensor")


def test_what_is_ruled_out_is_a_limit_and_no_objective() -> None:
    found = elements("Skip the panorama, film the ladder.")
    assert found["constraint"] == ["Skip the panorama"]
    assert not any("panorama" in text for text in (*found["objective"], *found["sensor"]))


@pytest.mark.parametrize(
    "command",
    [
        "...",
        "?",
        "检查浮标 然后返回",
        "<a href='x'>[]</a>",
        "the the the",
        "a " * 3000,
        "[1, 2] " * 2000,
    ],
)
def test_any_text_is_checked(command: str) -> None:
    assert set(check(command, USV)) == {"elements", "missing", "questions"}


def test_another_vehicle_has_its_own_words() -> None:
    assert "sensor" not in check("Scan the roof at [1, 2] for defects.", DRONE)["missing"]


def test_marked_commands_are_mostly_read_as_marked() -> None:
    """The floor of what benchmarks/command_check.py measures."""
    records = read_jsonl("data/mission/validation.jsonl")
    for element, least in (("target", 20), ("sensor", 10), ("constraint", 7)):
        marked = [
            record["prompt"]
            for record in records
            if element in {span["element"] for span in record["spans"]}
        ]
        assert sum(element not in check(prompt, USV)["missing"] for prompt in marked) >= least


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('[[ask]]\nwords = ["fly"]\n', "needs the lists words and tasks"),
        ('[[ask]]\nwords = ["fly"]\ntasks = ["Swim"]\n', "'Swim', which is no task"),
        ("[sensor]\nwords = 3\n", "[sensor] needs the list words"),
        ("[senses]\n", "unknown key 'senses'"),
    ],
)
def test_an_ontology_file_with_mistakes_is_refused(tmp_path, text: str, said: str) -> None:  # type: ignore[no-untyped-def]
    (tmp_path / "mine.toml").write_text((BUNDLED / "inspection_drone.toml").read_text())
    (tmp_path / "mine.ontology.toml").write_text(text)
    with pytest.raises(PlannerError) as caught:
        language(load_vocabulary(tmp_path / "mine.toml"))
    assert said in str(caught.value)


def test_phrases_are_whole_words_with_endings_and_gaps() -> None:
    said = pattern(["track ... cable", "survey*"])
    assert said.search("track the export cable") and said.search("Surveying it")
    assert not said.search("backtrack the cable") and not pattern([]).search("anything")
