"""Noise: what arrives of a text, and what no change touches."""

import random

from planner_ft.data.templates import render as noise
from planner_ft.data.templates.render import VALUE_CLOSE, VALUE_OPEN, plain


def marked(text):
    return text.replace("<", VALUE_OPEN).replace(">", VALUE_CLOSE)


TEXT = marked("Please survey <the Grey Lady at [120, -35]> from <12.5 m>, then turn north slowly.")


def changed(change, seed, keep=frozenset()):
    pieces = change(noise._split(TEXT, keep), random.Random(seed))
    return plain(noise._joined(pieces))


def test_most_texts_stay_clean_and_values_always_stand():
    texts = [noise.noisy(TEXT, random.Random(seed)) for seed in range(600)]
    assert 0.65 < sum(text == TEXT for text in texts) / 600 < 0.85
    for text in texts:
        assert "the Grey Lady at [120, -35]" in plain(text) or text.isupper()
        assert "12.5" in text and "north" in text.lower()


def test_a_telegram_in_capitals_can_be_ruled_out():
    texts = [noise.noisy(TEXT, random.Random(seed), shout=False) for seed in range(600)]
    assert not any(text.isupper() for text in texts)
    assert any(noise.noisy(TEXT, random.Random(seed)).isupper() for seed in range(600))


def test_slips_change_a_word_and_spare_kept_ones():
    assert any(changed(noise.slipped, seed) != plain(TEXT) for seed in range(5))
    keep = frozenset({"survey", "from", "then", "turn", "slowly"})
    assert all(changed(noise.slipped, seed, keep) == plain(TEXT) for seed in range(20))


def test_small_letters_leave_names_alone():
    text = changed(noise.small, 0)
    assert text.startswith("please survey the Grey Lady") and text.endswith("slowly")


def test_dictation_has_no_marks_and_a_telegram_no_articles():
    assert changed(noise.dictated, 0).endswith("12.5 m then turn north slowly")
    assert changed(noise.telegraphed, 0).startswith("Survey the Grey Lady")


def test_a_greeting_stands_once():
    once = noise.greeted(noise._split(TEXT, frozenset()), random.Random(1))
    assert plain(noise._joined(once)) != plain(TEXT)
    assert len(noise.greeted(noise._split("Hello there.", frozenset()), random.Random(1))) == 3
