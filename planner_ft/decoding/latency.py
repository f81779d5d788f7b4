"""Latency: the time of one query, one at a time, after warm-up."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.decoding.generate import generate
from planner_ft.decoding.limits import Limits


@dataclass(frozen=True)
class Latency:
    """Seconds from prompt ids to the complete answer, and the number of generated tokens."""

    seconds: float
    tokens: int


def measure_latency(model: Any, prompts: Sequence[list[int]], limits: Limits) -> Iterator[tuple[int, Latency]]:
    """Yield (index of the prompt, latency), one query after the other.

    A whole query runs first and is not counted: kernels are chosen and 4-bit weights are packed then.
    """
    if prompts:
        generate(model, prompts[:1], limits)
    for index, prompt in enumerate(prompts):
        started = time.perf_counter()
        (answer,) = generate(model, [prompt], limits)
        # `generate` has read the last token from the device: nothing is left running.
        yield index, Latency(time.perf_counter() - started, len(answer.ids))
