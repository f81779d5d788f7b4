"""The four elements of a command, and what is asked where one is missing."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner_ft.document.language import language, pattern, read_clauses
from planner_ft.document.ontology import check, named_places, pieces
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


@pytest.mark.parametrize(
    ("command", "targets"),
    [
        (
            "Circle the pier (50, 60), buoy 7 and contact Alpha 12.",
            ["the pier (50, 60)", "buoy 7", "contact Alpha 12"],
        ),
        ("Go to the mast, located at [40, 12].", ["the mast, located at [40, 12]"]),
        ("Go to the mast, lying near (40, 12).", ["the mast, lying near (40, 12)"]),
        ("Go to [40, 12], the mast.", ["[40, 12]", "the mast"]),
        ("Go to 40, 12.", ["40, 12"]),
        ("Go to the mast" + " " * 33 + "at 40, 12.", ["the mast" + " " * 33 + "at 40, 12"]),
        ("Go to the mast" + " " * 40 + "at 40, 12.", ["the mast", "40, 12"]),
        (
            "Go to the one two three four five six seven, then rest.",
            ["the one two three four five six seven"],
        ),
        (
            "Go to the one two three four five six seven eight.",
            ["the one two three four five six seven"],
        ),
        (
            "Go to the wreck of the ship with the red hull.",
            ["the wreck of the ship", "the red hull"],
        ),
        ("Go to the wreck of old ships.", ["the wreck of old ships"]),
        ("Go to the wreck of the.", ["the wreck"]),
        ("Stay for the night, the panorama, and the ladder.", ["the ladder"]),
        ("Look here at target Big Ben Tower.", ["here", "target Big Ben"]),
    ],
)
def test_targets_begin_with_their_article_and_end_with_their_coordinates(
    command: str, targets: list[str]
) -> None:
    assert elements(command)["target"] == targets


@pytest.mark.parametrize(
    ("text", "longest", "cut"),
    [
        ("One. Two three. Four", 8, ["One. ", "Two ", "three. ", "Four"]),
        ("abcdefghij", 4, ["abcd", "efgh", "ij"]),
        ("ab cd ef", 5, ["ab ", "cd ef"]),
        ("abcd", 4, ["abcd"]),
        ("abcde", 4, ["abcd", "e"]),
        (" bcde", 4, [" ", "bcde"]),
        ("A? B! C; D\nE", 4, ["A? ", "B! ", "C; ", "D\nE"]),
    ],
)
def test_long_texts_are_cut_behind_sentences_or_words(
    text: str, longest: int, cut: list[str]
) -> None:
    found = list(pieces(text, longest))
    assert [part for _start, part in found] == cut
    assert all(text[start:].startswith(part) for start, part in found)


def test_a_command_of_1500_characters_is_read_at_once() -> None:
    for length, count in ((1500, 1), (1501, 2)):
        assert len(list(pieces("x" * length))) == count


@pytest.mark.parametrize(
    ("command", "clauses"),
    [
        (
            "Go to 1,2, and 3,4. Then hold; film it: yes!\nHome",
            ["Go to 1,2", "3,4", "hold", "film it", "yes", "Home"],
        ),
        ("At 14.30 go to 1, 2 after that home.", ["At 14.30 go to 1, 2", "home"]),
        ("Go 1, -3 m off", ["Go 1, -3 m off"]),
    ],
)
def test_clauses_end_at_signs_that_are_in_no_number(command: str, clauses: list[str]) -> None:
    found = read_clauses(command, USV)
    assert [one.text.strip() for one in found] == clauses
    assert [command[one.start : one.end] for one in found] == [one.text for one in found]


@pytest.mark.parametrize(
    ("command", "excluded", "corrected"),
    [
        ("Hold, no drift, go", [None, "no", None], [False] * 3),
        ("Hold 10 m, no, make that 20 m", [None, "no", None], [True, True, False]),
        ("Hold 10 m, make that 20 m", [None, None], [True, False]),
        ("Don't forget the mast, go", [None, None], [False, False]),
    ],
)
def test_what_is_ruled_out_and_taken_back(
    command: str, excluded: list[str | None], corrected: list[bool]
) -> None:
    found = read_clauses(command, USV)
    assert [one.excluded is not None for one in found] == [one is not None for one in excluded]
    for one, words in zip(found, excluded, strict=True):
        if words and one.excluded is not None:
            assert command[one.excluded :].startswith(words)
            assert one.wants(one.excluded) and not one.wants(one.excluded + 1)


def test_a_clause_that_only_tells_of_something_asks_for_nothing() -> None:
    told, asks = read_clauses("The survey was done, go", USV)
    assert not told.wants(told.start) and asks.wants(asks.start)
    assert list(told.spans(pattern(["survey"]))) == []
    held = read_clauses("Hold it, then hold", USV)[1]
    assert list(held.spans(pattern(["hold"]))) == [(14, 18)]


def test_things_beside_positions_are_no_places_of_the_water() -> None:
    command = (
        "Go to the mast at [1, 2], the waypoint at [3, 4], the middle of the channel at [5, 6],"
        " the mooring buoy at [7, 8], the lock gate at [5, 8], the gate at [4, 4]. Do the same at"
        " [9, 10]."
    )
    found = [(words, place.x, place.y) for words, place in named_places(command, USV)]
    assert found == [("the mast", 1, 2), ("the mooring buoy", 7, 8), ("the lock gate", 5, 8)]


def test_a_thing_with_a_code_stands_at_its_coordinates() -> None:
    for told in (
        "Pile P12 (75, -25): panorama.",
        "Go to pile 12 [75, -25].",
        "Go to pile A at 75, -25.",
        "Go to pile c7 at 75, -25.",
        "go to pile c seven at seventy five comma minus twenty five",
        "Go to beacon number 4 at 75, -25.",
        "Film the ladder on pier leg B at 75, -25.",
        "Rock awash at 75, -25. Waypoint 20, 20.",
        "There is a coaster at anchor at 75, -25.",
    ):
        ((_words, place),) = named_places(told, USV)
        assert (place.x, place.y) == (75, -25)


def test_where_something_begins_is_no_thing() -> None:
    for told in (
        "Cut the propulsion at [4, 5].",
        "Drift a quarter of an hour starting at [0, -30].",
        "Log it beginning at [4, 5].",
        "Hold at the boarding ground at [4, 5].",
    ):
        assert not named_places(told, USV)


def test_a_thing_in_between_is_a_thing() -> None:
    found = named_places("From [1, 0] to [1, 8], there's a pier foot in between at [1, 4].", USV)
    assert [(words, place.y) for words, place in found] == [("a pier foot", 4)]


def test_the_corners_of_an_area_are_no_things_and_four_piles_are() -> None:
    corners = "[0, 0], [40, 0], [40, 20] and [0, 20]"
    assert not named_places(f"Chart the basin {corners}.", USV)
    assert len(named_places(f"Go between the piles at {corners}.", USV)) == 4


@pytest.mark.parametrize(
    ("text", "thing"),
    [
        ("The met mast stands slap in the middle, 150,150.", "mast"),
        ("Film MV Alina, she's lying at 64,-22.", "MV Alina"),
        ("CIRCLE THE BUOY @ 40,20", "THE BUOY"),
        ("Mind the moored workboat it's lying right in between at [5, 50]", "the moored workboat"),
    ],
)
def test_a_thing_is_named_with_a_clause_between(text: str, thing: str) -> None:
    assert [words for words, _place in named_places(text, USV)] == [thing]


def test_numbered_and_sized_things_are_named_and_stations_of_something() -> None:
    command = (
        "Pile A at [1, 2], a pier with a width of 9 m at [3, 4], the pumping station at [5, 6],"
        " the tide sets at [7, 8], the station at [9, 10]."
    )
    found = [words for words, _place in named_places(command, USV)]
    assert found == ["Pile A", "a pier with a width of 9 m", "the pumping station"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("ask = 3\n", "every [[ask]] needs the lists words and tasks"),
        ('[[ask]]\nwords = []\ntasks = ["TakePhoto"]\n', "needs the lists words and tasks"),
        ('[[ask]]\nwords = [" "]\ntasks = ["TakePhoto"]\n', "needs the lists words and tasks"),
        (
            '[[ask]]\nwords = ["x"]\ntasks = ["FlyToPoint"]\nnouns = 3\n',
            "[[ask]]: nouns must be a list of words",
        ),
        ('[[data]]\nwords = ["x"]\nskills = 3\n', "[[data]]: skills must be a list of names"),
        ("sensor = 3\n", "[sensor] needs the list words"),
    ],
)
def test_every_list_of_an_ontology_is_one_of_texts(tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "mine.toml").write_text((BUNDLED / "inspection_drone.toml").read_text())
    (tmp_path / "mine.ontology.toml").write_text(text)
    with pytest.raises(PlannerError) as caught:
        language(load_vocabulary(tmp_path / "mine.toml"))
    assert said in str(caught.value)


def test_one_and_the_other_are_what_is_named_before_them() -> None:
    found = named_places("Two bridge piers, one at 9,4 the other at 9,-4. Go between.", USV)
    assert [(words, place.y) for words, place in found] == [("piers", 4), ("piers", -4)]
    assert not named_places("Two tasks, one at 9,4 the other at 9,-4.", USV)
