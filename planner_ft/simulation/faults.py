"""Faults on request: `--fault KIND[=VALUE][/BEARING][@START[-END]]`."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from planner_ft.support.errors import PlannerError

KINDS = {
    "current": ("m/s, added to the drawn one; /BEARING: where it sets", 0.0, 5.0),
    "wind": ("m/s; /BEARING: where it comes from", 0.0, 40.0),
    "gps": ("no fix while it lasts", None, None),
    "lidar": ("share of the rays that is lost", 0.0, 1.0),
    "port": ("share of the port thruster's power that is left", 0.0, 1.0),
    "starboard": ("share of the starboard thruster's power that is left", 0.0, 1.0),
    "battery": ("share of the charge at the start", 0.0, 1.0),
}
"""What can fail, with the meaning and the range of its value."""
EXAMPLE = "such as current=0.3/90, gps@60-120, port=0.5@100 or battery=0.2"


@dataclass(frozen=True)
class Fault:
    """A fault from `start` to `end` in s; `bearing` in degrees from north, None: drawn per run."""

    kind: str
    value: float
    bearing: float | None
    start: float
    end: float
    text: str


@dataclass(frozen=True)
class Faults:
    """All faults of a simulation."""

    all: tuple[Fault, ...] = ()

    def active(self, kind: str, time: float) -> Iterator[Fault]:
        """The faults of a kind that are at work at a time."""
        return (one for one in self.all if one.kind == kind and one.start <= time < one.end)

    def share(self, kind: str, time: float) -> float:
        """What is left of a thruster, or the charge at the start; 1 without a fault."""
        return min((one.value for one in self.active(kind, time)), default=1.0)


def read_faults(texts: Sequence[str]) -> Faults:
    """Faults as they are typed. Raises PlannerError that says what was expected."""
    return Faults(tuple(_fault(text) for text in texts))


def _fault(text: str) -> Fault:
    head, _, span = text.partition("@")
    kind, _, words = head.partition("=")
    kind, flag = kind.strip(), f"--fault {text}"
    if kind not in KINDS:
        raise PlannerError(f"{flag}: there is {', '.join(KINDS)}; {EXAMPLE}")
    meaning, low, high = KINDS[kind]
    value, _, bearing = words.partition("/")
    try:
        number = float(value) if low is not None else 0.0
        toward = float(bearing) if bearing else None
        start, _, end = span.partition("-")
        times = float(start or 0), float(end or math.inf)
    except ValueError:
        raise PlannerError(f"{flag}: numbers are expected, {EXAMPLE}") from None
    if low is None and words:
        raise PlannerError(f"{flag}: {kind} takes no value, only times: {EXAMPLE}")
    if low is not None and high is not None and not low <= number <= high:
        raise PlannerError(f"{flag}: {kind} is {meaning}, from {low:g} to {high:g}")
    if toward is not None and (kind not in ("current", "wind") or not math.isfinite(toward)):
        raise PlannerError(f"{flag}: only current and wind have a bearing, in degrees from north")
    if not 0 <= times[0] < times[1]:
        raise PlannerError(f"{flag}: it must start at 0 s or later, and before it ends")
    return Fault(kind, number, toward, *times, text)
