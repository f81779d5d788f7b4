"""The time that a suite has left: what is left to do, at the pace of what was done."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Literal

Kind = Literal["answers", "latency"]


@dataclass(frozen=True)
class Work:
    """Queries of one kind. `parameters` is the candidate's size, if it is known."""

    candidate: str
    level: str
    configuration: str
    kind: Kind
    count: int = 0
    parameters: int | None = None


@dataclass
class Pace:
    """Seconds per query as they were measured, and seconds that a process took beside its queries
    (loading, scoring).
    """

    measured: dict[Work, tuple[float, int]] = field(default_factory=dict)
    overheads: dict[str, list[float]] = field(default_factory=dict)

    def add(self, work: Work, seconds: float) -> None:
        """Note that the queries of `work` took so long."""
        key = _key(work)
        before, count = self.measured.get(key, (0.0, 0))
        self.measured[key] = before + seconds, count + work.count

    def add_overhead(self, candidate: str, seconds: float) -> None:
        """Note what one process took beside its queries."""
        self.overheads.setdefault(candidate, []).append(max(0.0, seconds))

    def seconds_per_query(self, work: Work) -> float | None:
        """The pace of the nearest thing that was measured, from the same queries to any; of another
        candidate, in proportion to its size.
        """
        known = [(key, seconds / count) for key, (seconds, count) in self.measured.items() if count]
        for same in (
            ("candidate", "level", "configuration", "kind"),
            ("candidate", "level", "kind"),
            ("level", "configuration", "kind"),
            ("level", "kind"),
            (),
        ):
            found = [
                _scaled(rate, key, work)
                for key, rate in known
                if all(getattr(key, name) == getattr(work, name) for name in same)
            ]
            if found:
                return sum(found) / len(found)
        return None

    def overhead(self, candidate: str) -> float:
        """What the next process of a candidate takes beside its queries."""
        known = self.overheads.get(candidate) or [
            seconds for all_of in self.overheads.values() for seconds in all_of
        ]
        return sum(known) / len(known) if known else 0.0


def time_left(pace: Pace, work: Iterable[Work], processes: Iterable[str]) -> float | None:
    """Seconds for the queries that are left and the `processes` (by candidate) that are not begun;
    None while nothing was measured.
    """
    total = 0.0
    for part in work:
        if part.count:
            rate = pace.seconds_per_query(part)
            if rate is None:
                return None
            total += rate * part.count
    return total + sum(pace.overhead(candidate) for candidate in processes)


def _key(work: Work) -> Work:
    return Work(
        work.candidate, work.level, work.configuration, work.kind, parameters=work.parameters
    )


def _scaled(rate: float, measured: Work, wanted: Work) -> float:
    if measured.candidate == wanted.candidate or not measured.parameters or not wanted.parameters:
        return rate
    return rate * wanted.parameters / measured.parameters
