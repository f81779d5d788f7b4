"""Refusals and the worst case over paraphrases, by hand."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.benchmark.figures import worst_cases
from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.scoring import score_sample
from planner_ft.vocabulary import load_vocabulary

SOME: dict[str, Any] = {"tasks": [{"title": "Transit", "parameters": {}}]}
NONE: dict[str, Any] = {"tasks": [], "constraints": ["Nothing here can be done."]}


@pytest.mark.parametrize(
    ("plan", "expected", "right", "wrong"),
    [
        (NONE, NONE, True, None),
        (SOME, NONE, False, None),
        (None, NONE, False, None),
        ({}, NONE, False, None),
        (NONE, SOME, None, True),
        (SOME, SOME, None, False),
        (None, SOME, None, False),
    ],
)
def test_refusals(
    plan: dict[str, Any] | None, expected: dict[str, Any], right: bool | None, wrong: bool | None
) -> None:
    """An output that does not parse refuses nothing."""
    sample = Sample("a", "a", {"id": "a", "prompt": "Go.", "expected": expected})
    values = score_sample("mission", sample, {"output": plan}, load_vocabulary()).values
    assert (values["right_refusal"], values["wrong_refusal"]) == (right, wrong)


def test_the_worst_of_each_family_counts_and_families_of_one_do_not() -> None:
    assert worst_cases([1.0, 0.5, 0.8, 0.9, 0.2], list("12345"), ["a", "b", "b", "a", "c"]) == {
        "a": 0.9,
        "b": 0.5,
    }
    assert worst_cases([True, False, True, True], list("1234"), ["a", "a", "b", "b"]) == {
        "a": False,
        "b": True,
    }


def test_repeats_of_one_sample_are_no_paraphrases() -> None:
    assert worst_cases([1.0, 0.5, 0.3], ["1", "1", "1"], ["a", "a", "a"]) == {}
    assert worst_cases([1.0, 0.5, 0.3], ["1", "1", "2"], ["a", "a", "a"]) == {"a": 0.3}
