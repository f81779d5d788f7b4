"""Which samples of the corpus are worth their training time: those whose answers a model is still
likely to get wrong.

A model that knows most of the generators' language has little left to learn from most samples: of
the embedded candidate's fifth stage, half of the tokens held a tenth of the loss. Measuring the
loss of every sample would cost a third of training on it, so the loss of some is measured, and a
ridge regression on the words of their inputs tells it of the others at next to no cost. What it
cannot tell from the input (a misspelt word, a slip of arithmetic) gets no emphasis, and none of the
samples is shut out: `FLOOR` of the easiest stays.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from planner_ft.support.files import atomic_writer
from planner_ft.vocabulary.plans import Level, without_working

if TYPE_CHECKING:
    from transformers import PreTrainedTokenizerBase

HASHED = 2**14
"""Features of words and pairs of words; more fall together."""
RIDGE = 3.0
FLOOR = 0.15
"""Samples are kept with this probability at least."""
SCORING_TOKENS = 4096
"""Tokens in a batch whose losses are measured."""

# Text that the metrics do not compare, or not alone, and waypoints of slanted lines, which strength
# grounded computes.
_MISSION_TEXT = re.compile(
    r'"task_prompt":"((?:[^"\\]|\\.)*)"|"assumptions":\[(.*?)\](?=,"constraints":)|"constraints":\[(.*)\]\}'
)
_MISSION_WEIGHTS = (0.3, 0.2, 0.4)
_WAYPOINT = re.compile(r'"name":"GoToXY","parameters":\{"x":([-\d.]+),"y":([-\d.]+)')
_WAYPOINT_WEIGHT = 0.3


@dataclass(frozen=True)
class Encoded:
    """A rendered sample: its level, its input as text, token ids (int64, 1-D) and how many of them
    are the prompt, or lead up to the plan.

    `worked` is None where no working stands before the plan.
    """

    level: Level
    text: str
    ids: NDArray[np.int64]
    prompt: int
    worked: int | None = None


@dataclass(frozen=True)
class Emphasis:
    """A prediction of the loss per token, as √nats, and the value of it from which on a sample is
    always kept.
    """

    weights: NDArray[np.float32]
    offset: float
    certain: float

    def probability(self, sample: Encoded) -> float:
        """The probability with which a sample is kept: in proportion to its predicted loss per
        token.
        """
        predicted = max(0.0, float(features(sample) @ self.weights) + self.offset)
        return float(min(1.0, max(FLOOR, predicted**2 / self.certain)))

    def save(self, path: Path) -> None:
        """Write the emphasis as an .npz file."""
        with atomic_writer(path, "wb") as stream:
            np.savez(stream, weights=self.weights, numbers=np.array([self.offset, self.certain]))

    @staticmethod
    def load(path: Path) -> Emphasis:
        """Read what `save` wrote."""
        with np.load(path) as data:
            return Emphasis(data["weights"], *map(float, data["numbers"]))


def features(sample: Encoded) -> NDArray[np.float32]:
    """The words of a sample's input, pairs of them, and its lengths: float32 of shape (HASHED +
    12,).
    """
    words = sample.ids[: sample.prompt]
    found = np.zeros(HASHED + 12, dtype=np.float32)
    found[words * 40503 % HASHED] = 1
    found[(words[:-1] * 4099 + words[1:]) * 2654435761 % (2**31) % HASHED] = 1
    found[:HASHED] /= np.sqrt(found[:HASHED].sum())
    asked, answered = float(sample.prompt), float(len(sample.ids) - sample.prompt)
    shape = [asked / 100, answered / 300, answered / asked / 3]
    mission = float(sample.level == "mission")
    found[HASHED:] = [
        *shape,
        *(mission * value for value in shape),
        np.log(asked) / 3,
        np.log(answered) / 3,
        np.sqrt(answered) / 15,
        mission,
        1 - mission,
        1,
    ]
    return found


def fit(samples: Sequence[Encoded], losses: Sequence[float], share: float) -> Emphasis:
    """The emphasis that keeps about `share` (0 to 1) of the tokens; `losses` are nats, one of each
    sample.
    """
    known = np.stack([features(sample) for sample in samples])
    lengths = np.array([len(sample.ids) for sample in samples])
    wanted = np.sqrt(np.asarray(losses) / lengths)
    offset = float(wanted.mean())
    kernel = (known @ known.T).astype(np.float64)
    kernel[np.diag_indices_from(kernel)] += RIDGE
    weights = (known.T @ np.linalg.solve(kernel, wanted - offset)).astype(np.float32)
    predicted = np.maximum(0.0, known @ weights + offset) ** 2
    low, high = 0.0, float(predicted.max()) / FLOOR
    for _ in range(60):
        certain = (low + high) / 2
        kept = float((np.clip(predicted / certain, FLOOR, 1.0) * lengths).sum() / lengths.sum())
        low, high = (certain, high) if kept > share else (low, certain)
    return Emphasis(weights, offset, high)


def weighted_losses(
    model: Any, samples: Sequence[Encoded], tokenizer: PreTrainedTokenizerBase
) -> list[float]:
    """The loss of each sample's answer in nats, its parts weighted by what the metrics make of
    them.
    """
    import torch

    from planner_ft.pretraining.corpus import IGNORE, rows_of

    order = sorted(range(len(samples)), key=lambda index: len(samples[index].ids))
    found = [0.0] * len(samples)
    while order:
        members = [order.pop()]
        width = len(samples[members[0]].ids)
        members += [order.pop() for _ in range(min(len(order), SCORING_TOKENS // width))]
        rows = rows_of([(samples[index].ids, samples[index].prompt) for index in members], width, 0)
        labels = torch.from_numpy(rows.labels)
        places = labels != IGNORE
        with torch.inference_mode():
            hidden = model.model(input_ids=torch.from_numpy(rows.input_ids), use_cache=False)[0][
                places
            ]
            losses = torch.nn.functional.cross_entropy(
                model.lm_head(hidden).float(), labels[places], reduction="none"
            ).numpy()
        ends = np.cumsum([len(samples[index].ids) - samples[index].prompt for index in members])
        for index, part in zip(members, np.split(losses, ends[:-1]), strict=True):
            found[index] = float(part @ token_weights(samples[index], tokenizer))
    return found


def token_weights(sample: Encoded, tokenizer: PreTrainedTokenizerBase) -> NDArray[np.float64]:
    """What each token of a sample's answer counts for: 1, less where the metrics do not look or
    strength grounded computes.
    """
    pieces = [tokenizer.decode([int(token)]) for token in sample.ids[sample.prompt :]]
    text = "".join(pieces)
    weights = np.ones(len(text) + 1)
    if sample.level == "mission":
        for match in _MISSION_TEXT.finditer(text):
            group = match.lastindex or 1
            weights[slice(*match.span(group))] = _MISSION_WEIGHTS[group - 1]
    else:
        known = sample.text + without_working(text)[1]
        for match in _WAYPOINT.finditer(text):
            for group in (1, 2):
                if match[group].lstrip("-") not in known:
                    weights[match.start(group) : match.end(group) + 1] = _WAYPOINT_WEIGHT
    ends = np.cumsum([len(piece) for piece in pieces])
    return np.asarray(weights[np.maximum(ends - 1, 0)])
