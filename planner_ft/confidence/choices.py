"""The tokens of an answer as a model chose them, and whether what it says of them can be believed.

Log-probabilities are natural and over the model's whole vocabulary: under a constraint, too, they
are those of the unconstrained model, so that what was forced upon it is not taken for certain.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

LOWEST = -50.0
"""Log-probabilities below it are taken for it; servers write -9999 for zero."""
ROUNDING = 1e-3
"""By how much a log-probability may be above zero, and a sum of probabilities above one."""
DECIMALS = 4


class Choice(NamedTuple):
    """A token: its characters in the answer, its log-probability, and the text and log-probability
    of the likeliest others.
    """

    length: int
    logprob: float
    others: tuple[tuple[str, float], ...] = ()

    @property
    def margin(self) -> float:
        """Nats between the token and the likeliest other one; negative where that is likelier."""
        best = max((logprob for _text, logprob in self.others), default=LOWEST)
        return self.logprob - max(best, LOWEST)


Choices = tuple[Choice, ...]


def known(choices: Sequence[Choice] | None, text: str) -> Choices | None:
    """The choices that an answer `text` was made of; None where they cannot be: not its length, no
    numbers, above zero, together more than one, or every token entirely certain.
    """
    if not choices or sum(choice.length for choice in choices) != len(text):
        return None
    for choice in choices:
        held = [choice.logprob, *(logprob for _text, logprob in choice.others)]
        if any(not isinstance(one, int | float) or math.isnan(one) for one in held):
            return None
        if max(held) > ROUNDING or sum(map(math.exp, held)) > 1 + ROUNDING * len(held):
            return None
    if all(choice.logprob == 0 for choice in choices):
        return None
    return tuple(
        choice._replace(logprob=min(0.0, max(choice.logprob, LOWEST))) for choice in choices
    )


def as_json(choices: Choices | None) -> list[list[float]] | None:
    """Length, log-probability and margin of every token, as predictions.jsonl has them."""
    if choices is None:
        return None
    return [
        [one.length, round(one.logprob, DECIMALS), round(one.margin, DECIMALS)] for one in choices
    ]


def from_json(value: Any, text: str) -> Choices | None:
    """The choices of a line of predictions.jsonl; None where it holds none that can be."""
    try:
        found = [
            Choice(length, logprob, (("", logprob - margin),)) for length, logprob, margin in value
        ]
        return known(found, text)
    except (TypeError, ValueError):
        return None
