"""What the helm of MOOS-IvP is to do for one movement of a plan: behaviours, and what becomes of
the skill's parameters.

Sources: "An Overview of MOOS-IvP and a Users Guide to the IvP Helm"
(https://oceanai.mit.edu/ivpman) and the behaviours' own sources
(https://github.com/moos-ivp/moos-ivp, ivp/src/lib_behaviors-marine). The helm steers a course and a
speed and stops the vehicle when no behaviour asks for both, so that every movement asks for both.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from planner_ft.document.track import Leg, Point
from planner_ft.exporters.moos_text import number, points
from planner_ft.vocabulary.motion import Motion

Settings = list[tuple[str, str]]

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

NO_HEADING = "the helm does not arrive on a heading"
NO_ALTITUDE = "the helm moves in the plane"
NO_RADIUS = "the behaviour's own watch circle stands: one of 0 m cannot be held"
UNENDED = "the plan says no time: whoever sees that the step is over posts the next MISSION_STEP"
TURN_FORM = f"at {number(TURN_SPEED)} m/s, not on the spot, for {number(LONGEST_TURN)} s at most"


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


def move_of(
    motion: Motion | None, parameters: Mapping[str, Any], leg: Leg | None, cruise_speed: float
) -> Move | None:
    """The behaviours of a movement, None where the plan does not say enough for one. Speeds are
    m/s.

    `motion` is None for a task without skills, and for a skill that nothing is declared for; `leg`
    is the movement in the plan's track, None where the track does not know it.
    """
    kind = motion.kind if motion else "go"
    given = (
        {role: motion.value(role, parameters) for role in motion.parameters}
        if motion
        else dict(zip("xy", leg.points[-1], strict=True))
        if leg
        else {}
    )
    speed = leg.metres / leg.seconds if leg and leg.metres and leg.seconds else cruise_speed
    return MOVES[kind](
        leg, {role: value for role, value in given.items() if value is not None}, speed
    )


def _waypoints(corners: Sequence[Point], speed: float) -> tuple[str, Settings]:
    settings = [
        ("speed", number(speed)),
        ("capture_radius", number(CAPTURE_RADIUS)),
        ("slip_radius", number(SLIP_RADIUS)),
    ]
    return "BHV_Waypoint", [*settings, ("points", points(corners))]


def _go(_leg: Leg | None, given: Mapping[str, Any], speed: float) -> Move | None:
    if "x" not in given or "y" not in given:
        return None
    losses = {
        role: why
        for role, why in (("heading", NO_HEADING), ("altitude", NO_ALTITUDE))
        if role in given
    }
    return Move(
        (_waypoints([(given["x"], given["y"])], speed),), forms={"x": "", "y": ""}, losses=losses
    )


def _arc(leg: Leg | None, given: Mapping[str, Any], speed: float) -> Move | None:
    if leg is None:
        return None
    form = f"as {len(leg.points) - 1} waypoints on the circle"
    if "angle" not in given:
        form += ", as far round as the vehicle's profile says: the plan says no angle"
    elif abs(given["angle"]) > DRAWN:
        form += f", which end after {number(DRAWN)} degrees"
    return Move((_waypoints(leg.points[1:], speed),), forms={"radius": form, "angle": form})


def _hold(_leg: Leg | None, given: Mapping[str, Any], speed: float) -> Move:
    settings = [
        ("center_activate", "true"),
        ("outer_speed", number(speed)),
        ("transit_speed", number(speed)),
    ]
    radius, forms, losses = given.get("radius"), {"time": ""}, {}
    if radius:
        settings += [("inner_radius", number(radius / 2)), ("outer_radius", number(radius))]
        forms["radius"] = ""
    elif radius is not None:
        losses["radius"] = NO_RADIUS
    return _timed(
        "BHV_StationKeep", settings, given.get("time"), Move((), forms=forms, losses=losses)
    )


def _drift(_leg: Leg | None, given: Mapping[str, Any], _speed: float) -> Move:
    # A full stop asks for no speed; without the delay it would be complete, and the step over, as
    # soon as the vehicle has stopped.
    time = given.get("time")
    return _timed(
        "BHV_FullStop", [("delay_complete", number(time or 0))], time, Move((), forms={"time": ""})
    )


def _timed(kind: str, settings: Settings, time: float | None, move: Move) -> Move:
    """The behaviour for a time; without one until MISSION_STEP changes, however often the behaviour
    finds itself complete.
    """
    more = [("perpetual", "true")] if time is None else [("duration", number(time))]
    return Move(
        ((kind, [*settings, *more]),), ends=time is not None, forms=move.forms, losses=move.losses
    )


def _turn_to(leg: Leg | None, given: Mapping[str, Any], speed: float) -> Move:
    if "heading" not in given:
        return _turn_by(leg, {}, speed)
    heading = [
        ("heading", number(given["heading"] % 360)),
        ("complete_thresh", number(TURN_THRESHOLD)),
        ("duration", number(LONGEST_TURN)),
    ]
    return Move(
        (("BHV_ConstantHeading", heading), ("BHV_ConstantSpeed", [("speed", number(TURN_SPEED))])),
        forms={"heading": TURN_FORM},
    )


def _turn_by(_leg: Leg | None, given: Mapping[str, Any], _speed: float) -> Move:
    angle = given.get("angle", 0)
    turn = [
        ("fix_turn", number(abs(angle))),
        ("turn_dir", "star" if angle >= 0 else "port"),
        ("speed", number(TURN_SPEED)),
        ("timeout", number(LONGEST_TURN)),
    ]
    return Move((("BHV_FixedTurn", turn),), forms={"angle": TURN_FORM})


DRAWN = 3600.0
"""Degrees of an arc that a plan's track holds."""
MOVES: dict[str, Callable[[Leg | None, Mapping[str, Any], float], Move | None]] = {
    "go": _go,
    "arc": _arc,
    "hold": _hold,
    "wait": _hold,
    "drift": _drift,
    "turn-to": _turn_to,
    "turn-by": _turn_by,
}
