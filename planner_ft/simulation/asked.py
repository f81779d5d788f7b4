"""What a simulation is asked for: its settings, faults, `--fault KIND[=VALUE][/BEARING]
[@START[-END]]`, and outlines of structures, `--outline NAME=SHAPE`, for runs that see more than a
pile.

A shape is a radius ("3"), a box of so many metres east and north ("16x4"), or an L or T in such a
box ("L8x8", "T10x8"). A plan knows structures as points; an outline is part of the simulated world.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from planner_ft.document.track import Point
from planner_ft.simulation.fast import SIMULATORS, TOLERANCE, Floats
from planner_ft.support.errors import PlannerError
from planner_ft.support.geodesy import Origin

KINDS = {
    "current": ("m/s, added to the drawn one; /BEARING: where it sets", 0.0, 5.0),
    "wind": ("m/s; /BEARING: where it comes from", 0.0, 40.0),
    "gps": ("no fix while it lasts", None, None),
    "lidar": ("share of the rays that is lost", 0.0, 1.0),
    "port": ("share of the port thruster's power that is left", 0.0, 1.0),
    "starboard": ("share of the starboard thruster's power that is left", 0.0, 1.0),
    "battery": ("share of the full charge that is left at START", 0.0, 1.0),
}
"""What can fail, with the meaning and the range of its value."""
EXAMPLE = "such as current=0.3/90, gps@60-120, port=0.5@100 or battery=0.2"
CORNERS = 48  # corners of a round outline
ARM = 3 / 8  # how broad the arms of an L or T are, of the shorter side. ASSUMPTION
LARGEST = 200.0
SHAPES = ("", "L", "T")
MOST_RUNS = 500
LEARNT, GUIDANCE, WAYPOINTS = "learnt", "guidance", "waypoints"


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

    @property
    def texts(self) -> list[str]:
        """All faults as they were typed."""
        return [one.text for one in self.all]

    def active(self, kind: str, time: float) -> Iterator[Fault]:
        """The faults of a kind that are at work at a time."""
        return (one for one in self.all if one.kind == kind and one.start <= time < one.end)

    def share(self, kind: str, time: float) -> float:
        """What is left of a thruster or of a full battery; 1 without a fault."""
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
    if kind == "battery" and end:
        raise PlannerError(f"{flag}: a charge that is lost does not come back; leave out -{end}")
    return Fault(kind, number, toward, *times, text)


def read_outlines(texts: Sequence[str]) -> dict[str, Floats]:
    """Corners (n, 2) about its centre of each named structure. Raises PlannerError."""
    found = {}
    for text in texts:
        name, _sign, shape = text.rpartition("=")
        corners = _corners(shape.strip())
        if not name.strip() or corners is None:
            forms = "a radius (3), a box (16x4), or an L or T in a box (L8x8, T10x8)"
            raise PlannerError(f'--outline {text}: expected "NAME=SHAPE", SHAPE being {forms} in m')
        found[name.strip()] = corners
    return found


def _corners(shape: str) -> Floats | None:
    kind = shape[:1] if shape[:1] in SHAPES else ""
    try:
        sides = [float(side) for side in shape.removeprefix(kind).split("x")]
    except ValueError:
        return None
    if not all(0 < side <= LARGEST for side in sides) or len(sides) > 2:
        return None
    if len(sides) == 1:
        angle = np.arange(CORNERS) * 2 * math.pi / CORNERS
        round_one = sides[0] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        return None if kind else round_one
    x, y = sides[0] / 2, sides[1] / 2
    arm = ARM * min(sides)
    forms: Mapping[str, Sequence[tuple[float, float]]] = {
        "": [(-x, -y), (x, -y), (x, y), (-x, y)],
        "L": [(-x, -y), (x, -y), (x, arm - y), (arm - x, arm - y), (arm - x, y), (-x, y)],
        "T": [
            *((-arm / 2, -y), (arm / 2, -y), (arm / 2, y - arm), (x, y - arm)),
            *((x, y), (-x, y), (-x, y - arm), (-arm / 2, y - arm)),
        ],
    }
    return np.array(forms[kind], dtype=float)


@dataclass(frozen=True)
class SimulationSettings:
    """What is simulated. `locations` say where objects truly stand, `starts` where runs begin in
    turn (home without any); `mcap` is the number of runs with a ROS 2 log. `goto` is guidance,
    learnt, or the folder of a policy, `survey` waypoints, learnt, or the folder of a policy;
    `outlines` are corners (n, 2) about their places of structures by name.
    """

    plan: Path
    out: Path | None = None
    runs: int = 20
    seed: int = 0
    simulator: str = "fast"
    tolerance: float = TOLERANCE
    locations: Mapping[str, Sequence[float]] = field(default_factory=dict)
    starts: tuple[Point, ...] = ()
    faults: Faults = field(default_factory=Faults)
    origin: Origin | None = None
    mcap: int = 1
    log: Path | None = None
    draft: bool = False
    vocabulary: str | None = None
    overwrite: bool = False
    goto: str = GUIDANCE
    survey: str = WAYPOINTS
    outlines: Mapping[str, Floats] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Raise PlannerError for numbers out of range and what there is not."""
        if not 1 <= self.runs <= MOST_RUNS:
            raise PlannerError(f"--runs {self.runs}: must be from 1 to {MOST_RUNS}")
        if not 0 < self.tolerance <= 100:
            raise PlannerError(f"--tolerance {self.tolerance:g}: must be above 0 m, at most 100")
        if not 0 <= self.mcap <= self.runs:
            raise PlannerError(f"--mcap {self.mcap}: must be from 0 to the {self.runs} runs")
        if self.simulator not in SIMULATORS:
            known = ", ".join(SIMULATORS)
            raise PlannerError(f"--simulator {self.simulator}: must be one of {known}")
        for flag, value, usual, _table in self.slots:
            if value not in (usual, LEARNT) and not Path(value).is_dir():
                words = f"{usual}, {LEARNT}, or the folder of a trained policy"
                raise PlannerError(f"{flag} {value}: must be {words}")

    @property
    def slots(self) -> tuple[tuple[str, str, str, str], ...]:
        """The flag, value and usual value of each slot, and the table of what is learnt."""
        goto = "--goto", self.goto, GUIDANCE, "skill"
        return goto, ("--survey", self.survey, WAYPOINTS, "task")

    @property
    def folder(self) -> Path:
        """The folder of the results: by default the plan's name with ".simulation"."""
        return self.out or self.plan.with_suffix(".simulation")
