"""From log-probabilities to levels: what is read, and what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner_ft.confidence.calibration import (
    AGENT,
    NO_LOGPROBS,
    Calibration,
    Curve,
    judge_answer,
    plan_confidence,
    read_calibration,
    sureness,
)
from planner_ft.confidence.parts import Choice, Choices
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import write_json

AGENT_OF = dict.fromkeys(AGENT, "a")
CURVE = Curve({"total": -1.0}, 6.0, 100, 0.9)
CURVES = {"plan": CURVE, "entry": CURVE, "value": CURVE}
CALIBRATION = Calibration("mission", CURVES, {"agent": AGENT_OF})
TEXT = (
    '{"tasks":[{"title":"Transit","parameters":{"target_position":[4,-2]},"task_prompt":"Go."}],'
    '"assumptions":[],"constraints":[]}'
)


def written(unlikely: str, other: str, logprob: float = -0.7) -> Choices:
    """The text in three tokens, the middle one in doubt."""
    before = TEXT.index(unlikely)
    rest = len(TEXT) - before - len(unlikely)
    doubt = Choice(len(unlikely), logprob, ((other, -0.9),))
    return (Choice(before, -0.001), doubt, Choice(rest, -0.001))


def test_a_doubt_lowers_what_it_is_in_and_names_the_alternative() -> None:
    judged = judge_answer(CALIBRATION, "", TEXT, written("[4,-2]", "[-99"))
    value = ("tasks", 0, "parameters", "target_position")
    assert judged.parts[value] < judged.parts["tasks", 0, "title"]
    assert judged.others == {value: (("[-99", pytest.approx(0.4066, abs=1e-3)),)}


def test_the_less_likely_the_less_sure() -> None:
    held = [
        plan_confidence(CALIBRATION, TEXT, written("[4,-2]", "[-99", logprob))
        for logprob in (-0.01, -0.7, -4.0)
    ]
    assert held == sorted(held, reverse=True)
    assert len(set(held)) == 3


def test_what_is_not_known_says_why() -> None:
    assert judge_answer(CALIBRATION, "", TEXT, None).reason == NO_LOGPROBS
    assert judge_answer(None, "not calibrated", TEXT, written("4", "5")).reason == "not calibrated"
    assert plan_confidence(CALIBRATION, "no plan", written("4", "5")) is None


def test_a_calibration_is_read_as_it_was_written_and_for_its_agent_alone(tmp_path: Path) -> None:
    path = tmp_path / "confidence.json"
    assert read_calibration(path, AGENT_OF)[0] is None
    write_json(path, CALIBRATION.to_json())
    assert read_calibration(path, AGENT_OF) == (CALIBRATION, "")
    for field in AGENT:
        found, reason = read_calibration(path, {**AGENT_OF, field: "another"})
        assert found is None and "other weights or settings" in reason


@pytest.mark.parametrize("content", [{}, [], {**CALIBRATION.to_json(), "version": 99}])
def test_a_damaged_calibration_is_one_sentence(tmp_path: Path, content: object) -> None:
    write_json(tmp_path / "confidence.json", content)
    with pytest.raises(PlannerError, match="make it again with plannerft calibrate"):
        read_calibration(tmp_path / "confidence.json", AGENT_OF)


def test_three_levels() -> None:
    assert [sureness(one) for one in (0.99, 0.95, 0.9, 0.7, 0.5)] == [
        *("sure", "sure", "check", "check", "unsure")
    ]
