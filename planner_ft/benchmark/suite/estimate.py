"""The time that a suite has left: its remaining queries, at the pace of those that were done."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Literal

Kind = Literal["answers", "latency"]
NEAREST = (
    ("candidate", "level", "configuration", "kind"),
    ("candidate", "level", "kind"),
    ("level", "configuration", "kind"),
    ("level", "kind"),
    (),
)
"""The fields that queries share, from the same queries to any."""


@dataclass(frozen=True)
class Work:
    """Queries of one kind. `parameters` is the candidate's size, if it is known."""

    candidate: str
    level: str
    configuration: str
    kind: Kind
    count: int = 0
    parameters: int | None = None

    def scale(self, measured: Work) -> float:
        """The factor from the pace of another candidate to this one, in proportion to the sizes."""
        if self.candidate == measured.candidate or not (self.parameters and measured.parameters):
            return 1.0
        return self.parameters / measured.parameters


@dataclass
class Pace:
    """Seconds and queries as they were measured, and seconds that a process took beside its
    queries (loading, scoring), by candidate.
    """

    measured: dict[Work, tuple[float, int]] = field(default_factory=dict)
    overheads: dict[str, list[float]] = field(default_factory=lambda: defaultdict(list))

    def add(self, work: Work, seconds: float) -> None:
        """Note that the queries of `work` took so long."""
        key = replace(work, count=0)
        before, count = self.measured.get(key, (0.0, 0))
        self.measured[key] = before + seconds, count + work.count

    def add_overhead(self, candidate: str, seconds: float) -> None:
        """Note the seconds of one process beside its queries."""
        self.overheads[candidate].append(max(0.0, seconds))

    def seconds_per_query(self, work: Work) -> float | None:
        """The pace of the nearest queries that were measured."""
        for same in NEAREST:
            rates = [
                seconds / count * work.scale(key)
                for key, (seconds, count) in self.measured.items()
                if count and all(getattr(key, name) == getattr(work, name) for name in same)
            ]
            if rates:
                return sum(rates) / len(rates)
        return None

    def overhead(self, candidate: str) -> float:
        """Seconds of the next process of a candidate beside its queries."""
        everything = [seconds for found in self.overheads.values() for seconds in found]
        known = self.overheads.get(candidate) or everything
        return sum(known) / len(known) if known else 0.0


def time_left(pace: Pace, work: Iterable[Work], processes: Iterable[str]) -> float | None:
    """Seconds for the queries that are left and the `processes` (by candidate) that are not begun;
    None while nothing was measured.
    """
    left = [(pace.seconds_per_query(part), part.count) for part in work if part.count]
    queries = [rate * count for rate, count in left if rate is not None]
    if len(queries) < len(left):
        return None
    return sum(queries) + sum(map(pace.overhead, processes))
