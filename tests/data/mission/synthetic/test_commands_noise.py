"""Noise on written commands: mostly none, and never where only copying can tell."""

from random import Random

from planner_ft.data.mission.synthetic import sample_missions
from planner_ft.data.mission.synthetic.commands_noise import (
    dictated,
    garbled,
    greeted,
    noisy,
    slipped,
    telegraphed,
    uncapitalised,
)


def test_most_commands_stay_clean():
    text = "Circle the old lightvessel Theodora at 30 metres, then come home."
    kept = sum(
        noisy(text, Random(seed), ("old lightvessel Theodora",)) == text for seed in range(2000)
    )
    assert 0.68 < kept / 2000 < 0.8


def test_slips_spare_names_ids_and_numbers():
    text = "Follow barge skrimvold KX-07 for twenty minutes."
    for seed in range(200):
        told = slipped(text, Random(seed), ("barge skrimvold KX-07",), 2)
        assert "skrimvold KX-07" in told and "twenty" in told


def test_small_letters_leave_names_alone():
    assert (
        uncapitalised("Go to Barge Theodora B7 At Once.", ("Theodora B7",))
        == "go to barge Theodora B7 at once."
    )


def test_a_greeting_stands_once():
    assert greeted("Hello, come home.", Random(1)) == "Hello, come home."
    assert greeted("Come home.", Random(1)).endswith((", come home.", ". Come home."))
    assert greeted("Barge Theodora is adrift.", Random(1)).endswith(". Barge Theodora is adrift.")


def test_garbled_and_dictated_text_keeps_what_only_copying_can_tell():
    text = (
        "Please follow barge skrimvold KX-07 from [12, -3] for twenty minutes, then write the"
        " report."
    )
    for seed in range(200):
        told = garbled(text, Random(seed), ("barge skrimvold KX-07",))
        assert "skrimvold KX-07" in told and "[12, -3]" in told and "twenty" in told
    assert (
        dictated(text, Random(0), ("barge skrimvold KX-07",))
        == "please follow barge skrimvold KX-07 from [12, -3] for twenty minutes then write the"
        " report"
    )


def test_a_telegram_has_no_articles_but_those_of_a_value():
    text = "Please film the weld at the quay, then come home."
    short = {telegraphed(text, Random(seed), ("weld",)) for seed in range(50)}
    assert {"Film weld at quay, then come home.", "FILM WELD AT QUAY, THEN COME HOME."} <= short
    assert (
        telegraphed("Film the weld on the ladder.", Random(0), ("weld on the ladder",)).lower()
        == "film the weld on the ladder."
    )


def test_four_of_five_samples_are_written_commands():
    families = [record["family"] for record in sample_missions(9, 1500)]
    written = sum(family.startswith("synthetic-command-") for family in families)
    assert 0.73 < written / len(families) < 0.83
