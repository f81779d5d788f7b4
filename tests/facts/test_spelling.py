"""Slips of the keyboard and sounds that are no words."""

import pytest

from planner_ft.facts.spelling import fluent, spelt


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("inpsect the bouy and retrun", "inspect the bouy and return"),
        ("a raport on the clearence", "a report on the clearance"),
        ("Folow the rduder. Surevy it", "Follow the rudder. Survey it"),
        ("serch off Inpsect-2, target_inpsect", "search off Inpsect-2, target_inpsect"),
    ],
)
def test_a_slip_of_a_usual_word_is_put_right(written: str, meant: str) -> None:
    assert spelt(written) == meant


@pytest.mark.parametrize(
    "word", ["marlin", "powder", "coarse", "spudcan", "Inpsect", "kohlrabi", "rebar", "comms"]
)
def test_other_words_names_and_codes_stay(word: str) -> None:
    assert spelt(f"find the {word} at 40,20") == f"find the {word} at 40,20"


def test_a_sound_is_blanks_and_moves_nothing() -> None:
    said = "um go to, uh, forty er comma twenty; Erin and umbra stay"
    assert fluent(said) == "   go to,     forty    comma twenty; Erin and umbra stay"
