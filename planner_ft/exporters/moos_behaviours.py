"""The behaviours of MOOS-IvP's helm for movements, boundaries and clearances of a plan, and lines
of its file.

Sources: "An Overview of MOOS-IvP and a Users Guide to the IvP Helm"
(https://oceanai.mit.edu/ivpman) and the behaviours' own sources
(https://github.com/moos-ivp/moos-ivp, ivp/src/lib_behaviors-marine). The helm steers a course and a
speed and stops the vehicle when no behaviour asks for both, so that every movement asks for both.
BHV_OpRegionV24 takes convex polygons alone; BHV_AvoidObstacleV24 is spawned by alerts of
pObstacleMgr.

A line ends a statement; "//" begins a comment anywhere in it; a backslash at its end, even a
comment's, takes the next line in; a line holds fewer than 5000 characters ("The Helm Behavior
File"; lib_helmivp/Populator_BehaviorSet.cpp and lib_mbutil/FileBuffer.cpp). `$[NAME]` in a
flag is a macro of the helm, `$(NAME)` and `%(NAME)` are macros of nsplug.
"""

import re
import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any

from planner_ft.document.track import Leg
from planner_ft.exporters.formats import TABLES, Action

WIDTH, POINTS_PER_LINE, LONGEST_LINE = 160, 20, 4000
CONTROL = re.compile("[\x00-\x1f\x7f\x85\u2028\u2029\ud800-\udfff]+")
MACRO = re.compile(r"([$%])(?=[\[({])")

Point = tuple[float, float]
Settings = Sequence[tuple[str, str]]
"""Keys and values in order; a key may stand there several times."""


def block(kind: str, name: str, settings: Settings) -> list[str]:
    """The lines of a behaviour such as BHV_Waypoint, broken where the helm joins them again."""
    lines = [f"  {key} = {value}" for key, value in (("name", name), *settings)]
    parts = (
        "\\\n".join(line[at : at + LONGEST_LINE] for at in range(0, len(line), LONGEST_LINE))
        for line in lines
    )
    return [f"Behavior = {kind}", "{", *parts, "}"]


def words(text: str) -> str:
    """Text without line ends, comments, continuations, macros and conditions of the helm."""
    plain = MACRO.sub(r"\1 ", CONTROL.sub(" ", text).replace("\\", "/")).replace("[if]", "[ if ]")
    while "//" in plain:
        plain = plain.replace("//", "/ /")
    return plain


def quoted(text: str) -> str:
    """Text as the value of a flag or a variable."""
    return '"{}"'.format(words(text).replace('"', "'"))


def comment(text: str) -> list[str]:
    """Text as comment lines."""
    lines = textwrap.wrap(words(text), WIDTH - 3, break_on_hyphens=False)
    return [f"// {line}" for line in lines] or ["//"]


def number(value: float) -> str:
    """A number to the millimetre, without an exponent."""
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def points(corners: Iterable[Point]) -> str:
    """Points as "x,y : x,y", broken into lines that the helm joins again."""
    found = [f"{number(x)},{number(y)}" for x, y in corners]
    starts = range(0, len(found), POINTS_PER_LINE)
    return " : \\\n    ".join(" : ".join(found[one : one + POINTS_PER_LINE]) for one in starts)


def variable(name: str) -> str:
    """A MOOS variable for a skill: "DetectObjects" is SKILL_DETECT_OBJECTS."""
    snake = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).upper()
    return "SKILL_" + re.sub(r"[^A-Z0-9]+", "_", snake).strip("_")


TABLE: dict[str, Any] = TABLES["moos"]
LOSSES: dict[str, str] = TABLE["losses"]
STEP = "MISSION_STEP"
CAPTURE_RADIUS = 2.0  # metres from a waypoint at which it counts as reached
SLIP_RADIUS = 6.0  # metres from it within which it counts as passed once the distance grows
RADII = 1 / 4, 3 / 4  # of the way there, or of the arc's radius: both at most, in that order
LEAST_RADIUS = 0.01  # metres
TURN_SPEED = 0.5  # metres per second at most: most hulls need water past the rudder to turn
TURN_THRESHOLD = 5.0  # degrees from the heading at which a turn is complete
LONGEST_TURN = 120.0  # seconds after which the helm goes on from a turn that is not complete
ROUNDED = 1e-5  # share of a region's area by which corners rounded to millimetres may dent it
DRAWN = 3600.0  # degrees of an arc that a plan's track holds


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


def move_of(action: Action, cruise_speed: float) -> Move | None:
    """The behaviours of a movement, None where the plan says too little. Metres, seconds."""
    leg, given, motion = action.leg, action.given, action.motion
    speed = leg.metres / leg.seconds if leg and leg.metres and leg.seconds else cruise_speed
    way, turn_speed = leg.metres if leg else 0.0, min(TURN_SPEED, cruise_speed)
    if not action.step:
        return _go(dict(zip("xy", leg.points[-1], strict=True)) if leg else {}, speed, way)
    if motion is None:
        return None
    match motion.kind:
        case "go":
            return _go(given, speed, way)
        case "arc":
            return _arc(leg, given, speed)
        case "hold" | "wait":
            return _hold(given, speed)
        case "drift":
            # A full stop asks for no speed; without the delay it would be complete, and the step
            # over, as soon as the vehicle has stopped.
            return _timed("BHV_FullStop", given, delay_complete=given.get("time") or 0)
        case "turn-to" if "heading" in given:
            return _turn_to(given["heading"], turn_speed)
        case _:
            return _turn_by(given.get("angle", 0), turn_speed)


def _settings(**values: float | str) -> list[tuple[str, str]]:
    return [(key, one if isinstance(one, str) else number(one)) for key, one in values.items()]


def _waypoints(corners: Sequence[Point], speed: float, reach: float) -> tuple[tuple[str, Settings]]:
    """A behaviour for waypoints that lie `reach` metres off (0: not known, or at hand)."""
    usual = (CAPTURE_RADIUS, SLIP_RADIUS)
    most = [max(reach * part, LEAST_RADIUS) for part in RADII] if reach else usual
    capture, slip = map(min, usual, most)
    radii = {"capture_radius": capture, "slip_radius": slip}
    return (("BHV_Waypoint", _settings(speed=speed, **radii, points=points(corners))),)


def _go(given: Mapping[str, Any], speed: float, way: float) -> Move | None:
    if "x" not in given or "y" not in given:
        return None
    losses = {role: LOSSES[role] for role in ("heading", "altitude") if role in given}
    goal = _waypoints([(given["x"], given["y"])], speed, way)
    return Move(goal, forms={"x": "", "y": "", "speed": ""}, losses=losses)


def _arc(leg: Leg | None, given: Mapping[str, Any], speed: float) -> Move | None:
    if leg is None:
        return None
    form = f"as {len(leg.points) - 1} waypoints on the circle"
    if "angle" not in given:
        form += ", as far round as the vehicle's profile says: the plan says no angle"
    elif abs(given["angle"]) > DRAWN:
        form += f", which end after {number(DRAWN)} degrees"
    goals = _waypoints(leg.points[1:], speed, given.get("radius") or 0.0)
    return Move(goals, forms={"radius": form, "angle": form, "speed": ""})


def _hold(given: Mapping[str, Any], speed: float) -> Move:
    radius = given.get("radius")
    radii = {"inner_radius": radius / 2, "outer_radius": radius} if radius else {}
    speeds = {"outer_speed": speed, "transit_speed": speed}
    return _timed("BHV_StationKeep", given, center_activate="true", **speeds, **radii)


def _timed(kind: str, given: Mapping[str, Any], **settings: Any) -> Move:
    """The behaviour for a time; without one until MISSION_STEP changes, complete or not."""
    time, radius = given.get("time"), given.get("radius")
    forms = {"time": "", "radius": ""} if radius else {"time": ""}
    losses = {"radius": LOSSES["radius"]} if radius == 0 else {}
    more = _settings(perpetual="true") if time is None else _settings(duration=time)
    return Move(((kind, [*_settings(**settings), *more]),), time is not None, forms, losses)


def _turn_to(heading: float, speed: float) -> Move:
    ends = {"complete_thresh": TURN_THRESHOLD, "duration": LONGEST_TURN}
    turn = ("BHV_ConstantHeading", _settings(heading=heading % 360, **ends))
    way = ("BHV_ConstantSpeed", _settings(speed=speed))
    return Move((turn, way), forms={"heading": _turn_form(speed)})


def _turn_by(angle: float, speed: float) -> Move:
    turn = _settings(fix_turn=abs(angle), turn_dir="star" if angle >= 0 else "port")
    turn += _settings(speed=speed, timeout=LONGEST_TURN)
    return Move((("BHV_FixedTurn", turn),), forms={"angle": _turn_form(speed)})


def _turn_form(speed: float) -> str:
    return str(TABLE["turn"].format(speed=number(speed), time=number(LONGEST_TURN)))


# ------------------------------------------------------------ boundaries and clearances


def guard_form(kind: str, value: Any) -> tuple[bool, str]:
    """(whether a behaviour stands for a polygon or a distance, how it does or why not)."""
    if kind == "clearance":
        return True, TABLE["clearance"]
    if not value:
        return False, TABLE["no_polygon"]
    return (True, "") if _region(value) else (False, TABLE["not_convex"])


def guards(filters: Iterable[tuple[int, str, Any]]) -> Iterator[list[str]]:
    """A behaviour per run of movements with the same (number of the movement, kind, value)."""
    by_value: dict[tuple[str, str], tuple[Any, set[int]]] = {}
    for movement, kind, value in filters:
        by_value.setdefault((kind, repr(value)), (value, set()))[1].add(movement)
    spans = [
        (*span, kind, value)
        for (kind, _text), (value, numbers) in by_value.items()
        for span in _spans(numbers)
    ]
    for count, (first, last, kind, value) in enumerate(sorted(spans, key=lambda one: one[:3]), 1):
        span = f"({STEP} >= {first}) and ({STEP} <= {last})"
        base = [("pwt", "500"), ("condition", "DEPLOY = true")]
        base.append(("condition", f"{STEP} = {first}" if first == last else span))
        if kind == "boundary":
            behaviour, settings = "BHV_OpRegionV24", _settings(save_poly=points(_region(value)))
        else:
            times = {key: value * times for key, times in TABLE["avoidance"].items() if value}
            behaviour, updates = "BHV_AvoidObstacleV24", f"OBSTACLE_ALERT_{count}"
            settings = _settings(templating="spawn", updates=updates, **times)
        yield block(behaviour, f"{kind}_{count}_", [*base, *settings])


def _spans(numbers: Iterable[int]) -> Iterator[tuple[int, int]]:
    """The first and the last of consecutive numbers."""
    for _offset, group in groupby(enumerate(sorted(numbers)), key=lambda pair: pair[1] - pair[0]):
        run = [number for _index, number in group]
        yield run[0], run[-1]


def _region(polygon: Sequence[Sequence[float]]) -> list[Point]:
    """The corners of a convex polygon, the only one that the helm takes as a region: without
    repeated ones and those on a side. None of another, for which it would refuse the file.
    """
    import shapely

    corners = [(round(float(x), 3), round(float(y), 3)) for x, y in polygon]
    shape = shapely.Polygon(corners if len(corners) > 2 else None)
    hull = shapely.orient_polygons(shape.convex_hull)
    if not shape.is_valid or not shape.area or hull.area > shape.area * (1 + ROUNDED):
        return []
    return list(hull.exterior.coords)[:-1]
