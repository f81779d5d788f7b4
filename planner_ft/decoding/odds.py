"""What the model itself holds of the tokens of an answer: their log-probabilities over the whole
vocabulary, whatever a constraint allows, so that forcing is no certainty.
"""

from __future__ import annotations

from typing import NamedTuple

import torch
from torch import Tensor

LIKELIEST = 4
"""Tokens of a place whose log-probabilities are kept."""


class Odds(NamedTuple):
    """A place of an answer: the log of its normaliser, and the likeliest tokens with their logits,
    the likeliest first.
    """

    norm: float
    ids: list[int]
    logits: list[float]


class Score(NamedTuple):
    """A token's log-probability (nats), and the likeliest others with theirs."""

    logprob: float
    others: tuple[tuple[int, float], ...]


def odds(logits: Tensor) -> list[Odds]:
    """The odds of every row of logits in float32, shape (places, tokens)."""
    values, ids = logits.topk(min(LIKELIEST, logits.shape[-1]))
    return [
        Odds(*row)
        for row in zip(
            torch.logsumexp(logits, -1).tolist(), ids.tolist(), values.tolist(), strict=True
        )
    ]


def score(token: int, place: Odds, logits: Tensor) -> Score:
    """The score of a token at a place with these logits, shape (tokens)."""
    known = dict(zip(place.ids, place.logits, strict=True))
    own = known.pop(token) if token in known else float(logits[token])
    others = tuple((other, value - place.norm) for other, value in known.items())
    return Score(own - place.norm, others[: LIKELIEST - 1])
