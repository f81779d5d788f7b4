"""How sure an agent is of one answer, part by part, and what it would have written instead."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from planner_ft.confidence.calibration import Calibration
from planner_ft.confidence.choices import Choices
from planner_ft.confidence.parts import Part, Path

LEAST = 0.02
"""Probability from which on another token is worth a question."""
NO_LOGPROBS = "the model gives no log-probabilities that can be believed"


@dataclass(frozen=True)
class Judgement:
    """Probabilities that parts of an answer are right, by path, that of the plan under (); none
    where that is not known, and then `reason` says why.

    `others` are beginnings of what the model might have written in place of a value (JSON), each
    with its probability, the likeliest first.
    """

    reason: str = ""
    parts: Mapping[Path, float] = field(default_factory=dict)
    others: Mapping[Path, tuple[tuple[str, float], ...]] = field(default_factory=dict)


NOT_JUDGED = Judgement(NO_LOGPROBS)


def judge_answer(
    calibration: Calibration | None, reason: str, text: str, choices: Choices | None
) -> Judgement:
    """The judgement of an answer that is one JSON object; `reason` says why there is no
    calibration.
    """
    if choices is None:
        return Judgement(NO_LOGPROBS)
    if calibration is None:
        return Judgement(reason)
    found = calibration.probabilities(text, choices)
    others = {part.path: other_beginnings(text, part) for part, _ in found if part.kind == "value"}
    known = {path: of for path, of in others.items() if of}
    return Judgement("", {part.path: probability for part, probability in found}, known)


def other_beginnings(text: str, part: Part) -> tuple[tuple[str, float], ...]:
    """What the model might have begun to write in place of a value: from its start on to the end of
    another token, with the probability of that token.
    """
    found: dict[str, float] = {}
    before = text[: part.span.start]
    for start, choice in zip(part.starts, part.choices, strict=True):
        for token, logprob in choice.others:
            begun = text[:start] + token
            # A token that begins before the value must write the same up to there.
            if len(begun) > len(before) and begun.startswith(before) and math.exp(logprob) > LEAST:
                found.setdefault(begun[len(before) :], math.exp(logprob))
    return tuple(sorted(found.items(), key=lambda pair: -pair[1]))
