"""Two programs on the same work in one process, taking turns, so that what else the machine does
falls on both alike.
"""

from __future__ import annotations

import gc
import statistics
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True)
class Turn:
    """What one program did in one round: its amount of work, seconds on the clock and of the
    processor, and what it found.
    """

    work: float
    seconds: float
    cpu_seconds: float
    found: Any = None


def take_turns(
    programs: dict[str, Callable[[], tuple[float, Any]]], rounds: int, say: Callable[[str], None]
) -> dict[str, list[Turn]]:
    """Run every program once uncounted, then `rounds` times in turn. A program returns its amount
    of work and what it found.
    """
    turns: dict[str, list[Turn]] = {name: [] for name in programs}
    for number in range(rounds + 1):
        for name, program in programs.items():
            gc.collect()
            clock, processor = time.perf_counter(), time.process_time()
            work, found = program()
            turn = Turn(work, time.perf_counter() - clock, time.process_time() - processor, found)
            if number:
                turns[name].append(turn)
            say(
                f"{name}: {'round ' + str(number) if number else 'warm-up'}:"
                f" {work / turn.cpu_seconds:.2f} a CPU second, {work / turn.seconds:.2f} a second"
            )
    return turns


def rates(turns: list[Turn]) -> dict[str, Any]:
    """Medians of work per second, by the clock and by the processor, with every turn."""
    return {
        "per_second": statistics.median(turn.work / turn.seconds for turn in turns),
        "per_cpu_second": statistics.median(turn.work / turn.cpu_seconds for turn in turns),
        "turns": [
            {name: value for name, value in asdict(turn).items() if name != "found"}
            for turn in turns
        ],
    }


def ratios(ours: list[Turn], theirs: list[Turn]) -> dict[str, float]:
    """Our rate over theirs, the median over rounds: neighbours in time are compared."""

    def ratio(seconds: str) -> float:
        pairs = zip(ours, theirs, strict=True)
        rates = [
            (one.work / getattr(one, seconds)) / (other.work / getattr(other, seconds))
            for one, other in pairs
        ]
        return float(statistics.median(rates))

    return {"by_clock": ratio("seconds"), "by_cpu": ratio("cpu_seconds")}
