"""Which log-probabilities are believed."""

from __future__ import annotations

import math

import pytest

from planner_ft.confidence.parts import LOWEST, Choice, as_json, from_json, known

TEXT = '{"tasks":[]}'
HONEST = (Choice(9, -0.02, (("x", -4.0),)), Choice(3, -0.7, (("y", -0.9), ("z", -3.0))))


def test_honest_choices_are_taken_and_kept() -> None:
    assert known(HONEST, TEXT) == HONEST
    kept = from_json(as_json(HONEST), TEXT)
    assert kept is not None
    assert [(one.length, one.logprob) for one in kept] == [(9, -0.02), (3, -0.7)]
    assert [one.margin for one in kept] == pytest.approx([3.98, 0.2])


@pytest.mark.parametrize(
    "lie",
    [
        None,
        (),
        HONEST[:1],
        (HONEST[0]._replace(logprob=math.nan), HONEST[1]),
        (HONEST[0]._replace(logprob=0.5), HONEST[1]),
        (HONEST[0], HONEST[1]._replace(others=(("y", math.nan),))),
        (HONEST[0], HONEST[1]._replace(logprob=-0.1, others=(("y", -0.1),))),
        (Choice(9, 0.0), Choice(3, 0.0)),
        (HONEST[0]._replace(logprob="-0.1"), HONEST[1]),
    ],
)
def test_what_cannot_be_is_not_known(lie: tuple[Choice, ...] | None) -> None:
    assert known(lie, TEXT) is None


def test_impossible_is_a_number() -> None:
    found = known((HONEST[0], Choice(3, -math.inf)), TEXT)
    assert found is not None
    assert found[1].logprob == LOWEST


@pytest.mark.parametrize("line", [None, 3, [[9]], [[9, None, 0], [3, -1, 0]], [["9", -1, 0]]])
def test_a_damaged_line_is_not_known(line: object) -> None:
    assert from_json(line, TEXT) is None
