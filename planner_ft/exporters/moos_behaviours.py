"""The behaviours of MOOS-IvP's helm for movements, boundaries and clearances of a plan.

Sources: "An Overview of MOOS-IvP and a Users Guide to the IvP Helm"
(https://oceanai.mit.edu/ivpman) and the behaviours' own sources
(https://github.com/moos-ivp/moos-ivp, ivp/src/lib_behaviors-marine). The helm steers a course and a
speed and stops the vehicle when no behaviour asks for both, so that every movement asks for both.
BHV_OpRegionV24 takes convex polygons alone; BHV_AvoidObstacleV24 is spawned by alerts of
pObstacleMgr.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any

from planner_ft.document.track import Leg
from planner_ft.exporters.formats import TABLES
from planner_ft.exporters.moos_text import Point, Settings, number, points
from planner_ft.vocabulary.motion import Motion

TABLE: dict[str, Any] = TABLES["moos"]
LOSSES: dict[str, str] = TABLE["losses"]
CAPTURE_RADIUS = 2.0
"""Metres from a waypoint at which it counts as reached."""
SLIP_RADIUS = 6.0
"""Metres from a waypoint within which it counts as passed once the distance grows."""
TURN_SPEED = 0.5
"""Metres per second in a turn by heading: most hulls need water past the rudder to turn."""
TURN_THRESHOLD = 5.0
"""Degrees from the heading at which a turn is complete."""
LONGEST_TURN = 120.0
"""Seconds after which the helm goes on from a turn that it did not complete."""
TURN_FORM = TABLE["turn"].format(speed=number(TURN_SPEED), time=number(LONGEST_TURN))
DRAWN = 3600.0
"""Degrees of an arc that a plan's track holds."""
AVOIDANCE = {
    "min_util_cpa_dist": 1,
    "max_util_cpa_dist": 2,
    "pwt_inner_dist": 2,
    "pwt_outer_dist": 4,
    "completed_dist": 5,
}
"""Settings of BHV_AvoidObstacleV24 as multiples of the clearance, which is the closest approach
that it accepts.
"""


@dataclass(frozen=True)
class Move:
    """The behaviours of one movement, as (kind, settings): the first ends it when `ends`.

    `forms` says, per role of the skill's parameters, how the file holds it ("" as the plan says
    it), `losses` why it does not.
    """

    behaviours: tuple[tuple[str, Settings], ...]
    ends: bool = True
    forms: Mapping[str, str] = field(default_factory=dict)
    losses: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Guard:
    """A behaviour that runs beside the movements `first` to `last`."""

    first: int
    last: int
    behaviour: str
    name: str
    settings: Settings


def move_of(
    motion: Motion | None, parameters: Mapping[str, Any], leg: Leg | None, cruise_speed: float
) -> Move | None:
    """The behaviours of a movement, None where the plan does not say enough for one. Speeds are
    m/s.

    `motion` is None for a task without skills; `leg` is the movement in the plan's track, None
    where the track does not know it.
    """
    speed = leg.metres / leg.seconds if leg and leg.metres and leg.seconds else cruise_speed
    if motion is None:
        return _go(dict(zip("xy", leg.points[-1], strict=True)) if leg else {}, speed)
    values = {role: motion.value(role, parameters) for role in motion.parameters}
    given = {role: value for role, value in values.items() if value is not None}
    match motion.kind:
        case "go":
            return _go(given, speed)
        case "arc":
            return _arc(leg, given, speed)
        case "hold" | "wait":
            return _hold(given, speed)
        case "drift":
            # A full stop asks for no speed; without the delay it would be complete, and the step
            # over, as soon as the vehicle has stopped.
            delay = ("delay_complete", number(given.get("time") or 0))
            return _timed("BHV_FullStop", [delay], given, {"time": ""}, {})
        case "turn-to" if "heading" in given:
            return _turn_to(given["heading"])
        case _:
            return _turn_by(given.get("angle", 0))


def _waypoints(corners: Sequence[Point], speed: float) -> tuple[str, Settings]:
    settings = [
        ("speed", number(speed)),
        ("capture_radius", number(CAPTURE_RADIUS)),
        ("slip_radius", number(SLIP_RADIUS)),
    ]
    return "BHV_Waypoint", [*settings, ("points", points(corners))]


def _go(given: Mapping[str, Any], speed: float) -> Move | None:
    if "x" not in given or "y" not in given:
        return None
    losses = {role: LOSSES[role] for role in ("heading", "altitude") if role in given}
    goal = _waypoints([(given["x"], given["y"])], speed)
    return Move((goal,), forms={"x": "", "y": ""}, losses=losses)


def _arc(leg: Leg | None, given: Mapping[str, Any], speed: float) -> Move | None:
    if leg is None:
        return None
    form = f"as {len(leg.points) - 1} waypoints on the circle"
    if "angle" not in given:
        form += ", as far round as the vehicle's profile says: the plan says no angle"
    elif abs(given["angle"]) > DRAWN:
        form += f", which end after {number(DRAWN)} degrees"
    return Move((_waypoints(leg.points[1:], speed),), forms={"radius": form, "angle": form})


def _hold(given: Mapping[str, Any], speed: float) -> Move:
    settings = [
        ("center_activate", "true"),
        ("outer_speed", number(speed)),
        ("transit_speed", number(speed)),
    ]
    radius = given.get("radius")
    if not radius:
        losses = {} if radius is None else {"radius": LOSSES["radius"]}
        return _timed("BHV_StationKeep", settings, given, {"time": ""}, losses)
    settings += [("inner_radius", number(radius / 2)), ("outer_radius", number(radius))]
    return _timed("BHV_StationKeep", settings, given, {"time": "", "radius": ""}, {})


def _timed(
    kind: str,
    settings: Settings,
    given: Mapping[str, Any],
    forms: Mapping[str, str],
    losses: Mapping[str, str],
) -> Move:
    """The behaviour for a time; without one until MISSION_STEP changes, however often the behaviour
    finds itself complete.
    """
    time = given.get("time")
    more = ("perpetual", "true") if time is None else ("duration", number(time))
    return Move(((kind, [*settings, more]),), time is not None, forms, losses)


def _turn_to(heading: float) -> Move:
    settings = [
        ("heading", number(heading % 360)),
        ("complete_thresh", number(TURN_THRESHOLD)),
        ("duration", number(LONGEST_TURN)),
    ]
    speed = [("speed", number(TURN_SPEED))]
    behaviours = (("BHV_ConstantHeading", settings), ("BHV_ConstantSpeed", speed))
    return Move(behaviours, forms={"heading": TURN_FORM})


def _turn_by(angle: float) -> Move:
    settings = [
        ("fix_turn", number(abs(angle))),
        ("turn_dir", "star" if angle >= 0 else "port"),
        ("speed", number(TURN_SPEED)),
        ("timeout", number(LONGEST_TURN)),
    ]
    return Move((("BHV_FixedTurn", settings),), forms={"angle": TURN_FORM})


# ------------------------------------------------------------ boundaries and clearances


def guard_form(kind: str, value: Any) -> tuple[bool, str]:
    """(whether a behaviour stands for a boundary's polygon or a clearance's distance, how it does
    or why not).
    """
    if kind == "clearance":
        return True, TABLE["clearance"]
    if not value:
        return False, TABLE["no_polygon"]
    return (True, "") if is_region(value) else (False, TABLE["not_convex"])


def guards(filters: Iterable[tuple[int, str, Any]]) -> Iterator[Guard]:
    """One behaviour per run of movements that keep the same boundary or clearance, of (movement's
    number, kind, polygon or distance).
    """
    by_value: dict[tuple[str, str], tuple[Any, list[int]]] = {}
    for movement, kind, value in filters:
        by_value.setdefault((kind, repr(value)), (value, []))[1].append(movement)
    spans = [
        (run[0], run[-1], kind, value)
        for (kind, _text), (value, numbers) in by_value.items()
        for run in _runs(numbers)
    ]
    ordered = sorted(spans, key=lambda span: span[:3])
    for count, (first, last, kind, value) in enumerate(ordered, start=1):
        name = f"{kind}_{count}_"
        if kind == "boundary":
            region = [("save_poly", points(_corners(value)))]
            yield Guard(first, last, "BHV_OpRegionV24", name, region)
        else:
            settings = [("templating", "spawn"), ("updates", f"OBSTACLE_ALERT_{count}")]
            if value:
                settings += [(key, number(value * times)) for key, times in AVOIDANCE.items()]
            yield Guard(first, last, "BHV_AvoidObstacleV24", name, settings)


def _runs(numbers: list[int]) -> Iterator[list[int]]:
    """Consecutive numbers together."""
    distinct = sorted(set(numbers))
    for _offset, run in groupby(enumerate(distinct), key=lambda pair: pair[1] - pair[0]):
        yield [number for _index, number in run]


def is_region(polygon: Sequence[Sequence[float]]) -> bool:
    """Whether the helm takes a polygon as a region: it has an area, and turns one way alone, once
    around. A file with another is refused.
    """
    corners = _corners(polygon)
    turns = [_turn(corners, index) for index in range(len(corners))]
    return len(corners) > 2 and (min(turns) > 0 or max(turns) < 0) and _goes_once_around(corners)


def _corners(polygon: Sequence[Sequence[float]]) -> list[Point]:
    """The corners as they are written, without those that repeat another one or lie on a side: the
    helm refuses some.
    """
    rounded = [(round(float(x), 3), round(float(y), 3)) for x, y in polygon]
    distinct = [point for index, point in enumerate(rounded) if point != rounded[index - 1]]
    distinct = distinct or rounded
    return [corner for index, corner in enumerate(distinct) if _turn(distinct, index)]


def _turn(corners: list[Point], index: int) -> float:
    """To which side the way round turns at a corner: above 0 to the left, 0 within a square
    millimetre of straight on.
    """
    around = (corners[(index + offset) % len(corners)] for offset in (-1, 0, 1))
    (ax, ay), (bx, by), (cx, cy) = around
    turn = (bx - ax) * (cy - by) - (by - ay) * (cx - bx)
    return turn if abs(turn) > 1e-6 else 0.0


def _goes_once_around(corners: list[Point]) -> bool:
    """Whether the sides change their direction along x twice: a star with five points does so more
    often.
    """
    ahead = [corner > corners[index - 1] for index, corner in enumerate(corners)]
    return sum(one != ahead[index - 1] for index, one in enumerate(ahead)) == 2
