"""Estimated time to train an adapter and to answer, from a model's dimensions: never a measurement.

Answers: the study's own latencies with an adapter, divided by tokens and blocks, are 1.41 to 1.47
ms for all seven candidates, whatever the width: a block's many small kernels are started one by
one. Training: a pass through a block takes that long at least, else its multiplications and the
unpacking of its 4-bit weights on the study's GPU (NVIDIA's Ada white paper). A frozen weight is
multiplied twice a step, forwards and backwards, and a third time with gradient checkpointing.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from planner_ft.candidates.memory import NF4_BITS
from planner_ft.candidates.registry import Candidate

GPU = "RTX 4070"
BLOCK_SECONDS = 1.43e-3
"""Of one token or one short pass, with an adapter; the seven published latencies."""
OPERATIONS, BANDWIDTH = 58.3e12, 504e9
"""Of the GPU: 16-bit tensor operations with 32-bit sums, and bytes, a second."""
EFFICIENCY = 0.4
"""Share of the operations that short samples reach; an assumption."""
PASSES = 3
ANSWER_TOKENS = 150
"""Of a curated mission plan: 467 characters at 3.2 a token."""


class Length(NamedTuple):
    """Samples of a published training set, passes over them, tokens of a sample (ours)."""

    samples: int
    epochs: int
    tokens: int


RUNS = {"mission": Length(125, 5, 270), "task": Length(10_000, 2, 420)}


def expected_times(candidate: Candidate) -> dict[str, Any] | None:
    """Estimated seconds of the published trainings and of an answer; None: dimensions unknown."""
    dimensions = candidate.dimensions
    if dimensions is None:
        return None
    weights = dimensions.linear_parameters / dimensions.layers
    # Read packed, written unpacked, read again by the product.
    unpacking = weights * (NF4_BITS / 8 + 2 + 2) / BANDWIDTH

    def training(level: str) -> int:
        run = RUNS[level]
        product = 2 * weights * run.tokens / (EFFICIENCY * OPERATIONS)
        step = PASSES * dimensions.layers * max(BLOCK_SECONDS, product + unpacking)
        return round(run.samples * run.epochs * step)

    answer = ANSWER_TOKENS * dimensions.layers * BLOCK_SECONDS
    return {
        "gpu": GPU,
        "train_mission_s": training("mission"),
        "train_task_s": training("task"),
        "answer_s": round(answer, 1),
    }
