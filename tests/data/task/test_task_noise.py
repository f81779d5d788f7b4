"""Task prompts as they arrive: what is changed around their values, and what never is."""

from __future__ import annotations

import re
from random import Random

import pytest

from planner_ft.data.task.noise import CHANGES, noisy
from planner_ft.data.templates.render import VALUE_CLOSE, VALUE_OPEN, plain

SAID = (
    "Turn to \x02the north-west\x03, then hold before the \x02Orca quay\x03 for \x02twenty-five"
    " seconds\x03. Please measure the distance to starboard."
)
KEPT = ["the north-west", "Orca quay", "twenty-five seconds", "before", "starboard"]


def changed(count: int, **options: bool) -> list[str]:
    return [
        text
        for text in (noisy(SAID, Random(seed), **options) for seed in range(count))
        if text != SAID
    ]


def test_most_prompts_stay_as_they_are() -> None:
    assert 0.6 < 1 - len(changed(3000)) / 3000 < 0.85


def test_values_and_words_that_decide_are_never_touched() -> None:
    for text in changed(3000):
        # A telegram in capitals has them in capitals too.
        words = [word.upper() for word in KEPT] if text.isupper() else KEPT
        assert all(word in text for word in words), text
        assert [len(re.findall(mark, text)) for mark in (VALUE_OPEN, VALUE_CLOSE)] == [3, 3]


@pytest.mark.parametrize("style", ["telegram", "stop", "slip", "small", "greeting", "dictated"])
def test_every_kind_of_noise_comes(style: str) -> None:
    found = {
        "telegram": lambda text: text.isupper(),
        "stop": lambda text: " STOP" in text,
        "slip": lambda text: not re.search("measure", text, re.IGNORECASE) and "to" in text,
        "small": lambda text: text.startswith("turn"),
        "greeting": lambda text: not text.lower().startswith("turn"),
        "dictated": lambda text: "." not in text and "," not in text,
    }[style]
    assert any(found(plain(text)) for text in changed(3000))


def test_a_plan_with_text_has_no_prompt_all_in_capitals() -> None:
    assert any(text.isupper() for text in changed(3000))
    assert not any(text.isupper() for text in changed(3000, capitals=False))


def test_the_shares_are_no_more_than_all() -> None:
    assert sum(share for share, _change in CHANGES) < 0.5
