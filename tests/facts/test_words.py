"""Known words, misspellings and phrases."""

from __future__ import annotations

import pytest

from planner_ft.facts import corrections, is_known, missing_words, read, unknown_words
from planner_ft.facts.words import edit_distance, known_words, normalised


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("grean", "green"),
        ("barell", "barrel"),
        ("bouy", "buoy"),
        ("woden", "wooden"),
        ("yelow", "yellow"),
        ("craked", "cracked"),
        ("thermla", "thermal"),
        ("nmae", "name"),
        ("phoots", "photos"),
        ("bollrd", "bollard"),
        ("txt", "text"),
        ("thrml", "thermal"),
        ("filles", "files"),
        ("ankor", "anchor"),
    ],
)
def test_misspellings_are_put_right(written: str, meant: str) -> None:
    assert meant in corrections(written)
    assert meant in corrections(written.upper())


@pytest.mark.parametrize("word", ["green", "buoy", "Buoys", "inspected", "it", "Xqzzwv", "中文"])
def test_known_words_and_names_stay(word: str) -> None:
    assert corrections(word) == ()


def test_the_lists_know_words_of_commands_and_of_the_vocabularies() -> None:
    assert all(
        map(is_known, ("inspect", "Buoys", "panorama", "hover", "metres", "seventy", "buoy's"))
    )
    assert not is_known("Stuckquounnous")
    assert len(known_words()) > 2000


def test_words_of_a_phrase_are_found_with_their_spelling_put_right() -> None:
    text = "Find teh grean barell by the pier's end, contact T142."
    assert missing_words(text, "green barrel", misspelt=True) == []
    assert missing_words(text, "green barrel", misspelt=False) == ["green", "barrel"]
    assert missing_words(text, "contact T143", misspelt=True) == ["t143"]
    assert missing_words(text, "pier", misspelt=False) == []


def test_a_phrase_is_where_it_stands_or_where_its_words_are() -> None:
    text = "There are two buoys. Inspect the red one, then the green barrel."
    spans = read(text).phrases.spans
    assert [text[start:end] for start, end in spans("green barrel")[0]] == ["green barrel"]
    assert [text[start:end] for start, end in spans("red buoy")[0]] == ["buoys", "red"]
    assert spans("yellow whale") == []


def test_unknown_words_are_counted_without_letters_and_designations() -> None:
    text = "Go to x 5 and inspect the zorbl of mast-qwrt, tag b2."
    assert unknown_words(text) == (["zorbl", "mast-qwrt"], 2 / 9)
    assert unknown_words("") == ([], 0)


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("The Old  PIER", "old pier"),
        ("an anchor", "anchor"),
        ("a", "a"),
        ("the", "the"),
        ("of the pier", "of the pier"),
        (" ", ""),
    ],
)
def test_a_phrase_is_compared_without_case_spacing_and_leading_article(
    text: str, plain: str
) -> None:
    assert normalised(text) == plain


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        # Up to five letters one edit, from six on two; of five, two where nothing else is near.
        ("gre", None),
        ("gr", ()),
        ("bouy", "buoy"),
        ("bvvy", ()),
        ("cabel", "cable"),
        ("cabbla", "cable"),
        ("pooin", "point"),
        ("xoxnt", ()),
        ("minuet", "minute"),
        ("mnuute", "minute"),
        ("mxnxtx", ()),
        ("pinxx", "pin"),
        ("sectrs", "sectors"),
        ("mnt", "minute"),
        ("mn", ()),
    ],
)
def test_a_misspelling_is_one_or_two_edits_away(
    written: str, meant: str | tuple[()] | None
) -> None:
    found = corrections(written)
    assert found == meant if meant == () else (meant is None or meant in found)
    assert len(corrections(written, 2)) <= 2 <= len(corrections("gre")) <= 6


def test_the_nearest_word_comes_first_and_of_equals_the_usual_one() -> None:
    count = known_words()
    for written in ("hous", "metrs", "pointt"):
        found = corrections(written)
        order = [(edit_distance(written, one, 2), -count[one], one) for one in found]
        assert order == sorted(order) and len(found) > 1
    assert [edit_distance("pier", other, 1) for other in ("pier", "peir", "pint")] == [0, 1, 2]


SAID = "Inspect the old pier's ladder, then old-time cable T142 and the pier again."


@pytest.mark.parametrize(
    ("phrase", "words"),
    [
        ("the old pier", ["old pier"]),
        ("pier", ["pier", "pier"]),
        ("ladders", ["ladder"]),
        ("piers ladder", ["pier's ladder"]),
        ("cable ladder", ["ladder", "cable"]),
        ("T142", ["T142"]),
        ("t143", []),
        ("lader", ["ladder"]),
        ("ladderr", ["ladder"]),
        ("peir", ["pier"]),
        ("old tower of steel", []),
        ("old tower", ["old"]),
        ("ier ladder", ["pier's ladder"]),
        ("the", ["the", "the"]),
    ],
)
def test_where_a_phrase_is_said(phrase: str, words: list[str]) -> None:
    spans = read(SAID).phrases.spans(phrase)
    assert [SAID[start:end] for one in spans for start, end in one] == words


def test_only_places_near_each_other_make_a_phrase_and_not_more_than_100_are_looked_at() -> None:
    def found(gap: int) -> list[str]:
        text = f"red {'.' * gap} pier"
        return [
            text[start:end] for one in read(text).phrases.spans("red pier") for start, end in one
        ]

    assert found(115) == ["red", "pier"] and found(116) == ["pier"]
    many = read("red " * 150).phrases
    assert len(many.places("red")) == len(many.spans("red")) == 100
    nearest = "red x. red y. pier, far, red"
    ((red, pier),) = read(nearest).phrases.spans("red pier")
    assert (red, pier) == ((7, 10), (14, 18))
    for text, start in (
        ("red x. old pier, then red", 0),
        ("red x. pier, red", 13),
        ("pier, red", 6),
    ):
        spans = read(text).phrases.spans("red pier")[0]
        assert (start, start + 3) in spans and len(spans) == 2


def test_of_a_long_text_only_unknown_words_can_be_misspelt() -> None:
    """Every word of a short text may be meant as another one: "form" as "from"."""
    few, many = ("form ladders " + " ".join(f"q{n}" for n in range(count)) for count in (397, 399))
    assert read(few).phrases.missing("from") == []
    assert read(many).phrases.missing("from") == ["from"]


def test_a_phrase_is_no_part_of_a_longer_word() -> None:
    text = "xpier, piers, pierx, pier5 and pier_ or pier"
    spans = read(text).phrases.spans("pier")
    assert [start for ((start, _end),) in spans] == [text.index("pier_"), len(text) - 4]
    assert read("pier").phrases.spans("pier") == [((0, 4),)]


def test_letters_for_directions_say_their_names() -> None:
    said = read("Along the N face and the SW wall, no S-bend").phrases
    assert not said.missing("north", misspelt=False) + said.missing("south-west", misspelt=False)
    assert said.missing("south", misspelt=False) == ["south"]
