"""Latency: the time of one query, one at a time, after warm-up."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from planner_ft.decoding.generate import PLAIN, Method, Query, generate
from planner_ft.decoding.limits import Limits
from planner_ft.decoding.passes import Decoder


@dataclass(frozen=True)
class Latency:
    """Seconds from prompt ids to the complete answer, the number of generated tokens, and the
    forward passes that they took.

    `first_token_s` are the seconds until the first token was known.
    """

    seconds: float
    tokens: int
    forward_passes: int
    first_token_s: float | None = None


def measure_latency(
    decoder: Decoder, queries: Sequence[Query], limits: Limits, method: Method = PLAIN
) -> Iterator[tuple[int, Latency]]:
    """Yield (index of the query, latency), one query after the other.

    A whole query runs first and is not counted: kernels are chosen, 4-bit weights packed and
    grammars compiled then.
    """
    if queries:
        generate(decoder, queries[:1], limits, method)
    for index, query in enumerate(queries):
        started = time.perf_counter()
        (answer,) = generate(decoder, [query], limits, method)
        # `generate` has read the last token from the device: nothing is left running.
        yield (
            index,
            Latency(
                time.perf_counter() - started,
                len(answer.ids),
                answer.forward_passes,
                answer.first_token_s,
            ),
        )
