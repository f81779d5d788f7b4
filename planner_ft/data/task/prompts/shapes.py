"""Steps that stand for a whole shape: what each needs, what is drawn for it, and its waypoints or
headings.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from planner_ft.data.numbers import COMPASS, Value, bearing, count_text, length, position, rotation
from planner_ft.data.task.steps import Step
from planner_ft.data.task.values import Draw, draw_bearing, draw_number, draw_point, draw_rotation
from planner_ft.data.templates.grammar import TemplateError
from planner_ft.facts import geometry as g

COMPASS_WORDS = {name: degrees for degrees, name in COMPASS.items()}
TURNS = {"clockwise": True, "counter-clockwise": False, "anticlockwise": False}
Values = Mapping[str, Any]


@dataclass(frozen=True)
class Shape:
    """`roles`: what it needs, with the place that a task parameter can fill (see `links` of the
    phrase file); `options`: what may be said.
    """

    motion: str
    roles: Mapping[str, str]
    options: frozenset[str]
    expand: Callable[[Values], list[Any]]


def _grid(values: Values) -> list[g.Point]:
    spacing = values.get("spacing")
    axis: g.Axis = "x" if values.get("axis") == "x" else "y"
    across = values["width"] if axis == "y" else values["length"]
    if spacing is None:
        spacing = across / (values["count"] - 1)
    return g.lawnmower(
        values["point"],
        values["width"],
        values["length"],
        spacing,
        values.get("start", "south-west"),
        axis,
    )


def _square(values: Values) -> list[g.Point]:
    return g.survey_square(
        values["point"],
        values["radius"],
        values.get("start", "east"),
        clockwise=values.get("turn", False),
    )


def _ring(values: Values) -> list[g.Point]:
    start = COMPASS_WORDS[values.get("start", "east")]
    return g.circle(
        values["point"],
        values["radius"],
        int(values["count"]),
        start,
        clockwise=values.get("turn", False),
    )


def _line(values: Values) -> list[g.Point]:
    return g.straight_line(values["point"], values["heading"], values["length"])


def _offset(values: Values) -> list[g.Point]:
    return [g.offset(values["point"], values["heading"], values["length"])]


def _sectors(values: Values) -> list[float]:
    return g.sector_headings(
        int(values["count"]), values.get("heading", 0), clockwise=values.get("turn", True)
    )


def _turns(values: Values) -> list[float]:
    return [values["delta_yaw"]] * int(values["count"])


SHAPES: Mapping[str, Shape] = {
    "Grid": Shape(
        "goto",
        {
            "point": "lawnmower.center",
            "width": "lawnmower.width",
            "length": "lawnmower.length",
            "spacing": "lawnmower.spacing",
        },
        frozenset({"start", "axis", "count"}),
        _grid,
    ),
    "Square": Shape(
        "goto",
        {"point": "square.center", "radius": "square.radius"},
        frozenset({"start", "turn"}),
        _square,
    ),
    "Ring": Shape(
        "goto",
        {"point": "orbit.center", "radius": "orbit.radius", "count": ""},
        frozenset({"start", "turn"}),
        _ring,
    ),
    "Line": Shape(
        "goto",
        {"point": "line.start", "heading": "line.heading", "length": "line.length"},
        frozenset(),
        _line,
    ),
    "Offset": Shape(
        "goto", {"point": "GoToXY.xy", "heading": "", "length": ""}, frozenset(), _offset
    ),
    "Return": Shape("goto", {}, frozenset(), lambda _values: []),
    "Sectors": Shape(
        "turn_to", {"count": "sectors.sectors"}, frozenset({"heading", "turn"}), _sectors
    ),
    "Turns": Shape("turn_by", {"count": "", "delta_yaw": ""}, frozenset(), _turns),
}

# What a slot, or the name before "=", stands for in a shape.
ROLE_OF = {
    "P": "point",
    "P1": "point",
    "center": "point",
    "centre": "point",
    "start_point": "point",
    "radius": "radius",
    "width": "width",
    "length": "length",
    "spacing": "spacing",
    "lanes": "count",
    "count": "count",
    "points": "count",
    "number": "count",
    "direction": "heading",
    "heading": "heading",
    "yaw": "heading",
    "bearing": "heading",
    "distance": "length",
    "max_dist": "length",
    "corner": "start",
    "side": "start",
    "start": "start",
    "turn": "turn",
    "axis": "axis",
    "along": "axis",
    "delta_yaw": "delta_yaw",
    "target_position": "point",
    "goal_position": "point",
    "sectors": "count",
    "arc": "delta_yaw",
}


def role_of(shape: str, base: str) -> str | None:
    """The role of a slot or named argument in this shape, or None when it has none there."""
    role = ROLE_OF.get(base)
    if shape in ("Square", "Ring"):
        role = {"length": "radius", "heading": "start"}.get(role or "", role)
    known = SHAPES[shape]
    return role if role in known.roles or role in known.options else None


def word_role(shape: str, word: str) -> str | None:
    """The role of a bare word such as "north-west" or "clockwise"."""
    if word in TURNS:
        return role_of(shape, "turn")
    if word in COMPASS_WORDS:
        return role_of(shape, "heading") or role_of(shape, "start")
    return None


def steps_of(
    shape: str, values: Values, motions: Mapping[str, str], keys: Mapping[str, str], home: g.Point
) -> list[Step]:
    """The navigation steps. `motions`: motion to skill name; `keys`: motion to the parameter of a
    turn. Raises ValueError when lanes do not fill.
    """
    name = motions[SHAPES[shape].motion]
    if shape == "Return":
        return [(name, {"x": home[0], "y": home[1]})]
    found = SHAPES[shape].expand(values)
    if SHAPES[shape].motion == "goto":
        return [(name, {"x": x, "y": y}) for x, y in found]
    return [(name, {keys[SHAPES[shape].motion]: value}) for value in found]


# ---------------------------------------------------------------- values


def _words(*options: str) -> Draw:
    return lambda rng: (lambda word: Value(word, word, word))(
        options[int(rng.random() * len(options))]
    )


def direction(rng: random.Random) -> Value:
    """A compass direction in words, mostly one of the four: "north", "due south", "south-west"."""
    degrees = 90 * rng.randrange(4) if rng.random() < 0.8 else 45 + 90 * rng.randrange(4)
    name = COMPASS[degrees]
    return Value(
        degrees,
        f"due {name}" if degrees % 90 == 0 and rng.random() < 0.25 else name,
        name,
        way=name,
    )


def _turn(rng: random.Random) -> Value:
    word = rng.choice(("clockwise", "anticlockwise", "counter-clockwise"))
    return Value(TURNS[word], word, word)


def _count(*numbers: int) -> Draw:
    def draw(rng: random.Random) -> Value:
        number = numbers[int(rng.random() * len(numbers))]
        return Value(number, count_text(number, rng), str(number))

    return draw


def _length(low: float, high: float) -> Draw:
    return lambda rng: length(draw_number(rng, low, high), rng)


DRAWS: Mapping[tuple[str, str], Draw] = {
    ("Ring", "count"): _count(4, 8, 6, 12, 4, 3, 6, 8),
    ("Sectors", "count"): _count(3, 4, 4, 5, 6, 6, 8, 8, 9, 10, 12),
    ("Turns", "count"): _count(2, 3, 3, 4, 4, 5, 6, 8),
    ("", "point"): lambda rng: position(draw_point(rng), rng),
    ("", "radius"): _length(4, 60),
    ("", "length"): _length(5, 150),
    ("Line", "heading"): lambda rng: bearing(draw_bearing(rng), rng),
    ("Sectors", "heading"): lambda rng: bearing(rng.choice((0, 0, 45, 90, 180, 270)), rng),
    ("", "heading"): direction,
    ("", "turn"): _turn,
    ("", "axis"): _words("x", "y"),
    ("Grid", "start"): _words(*g.CORNERS),
    ("Square", "start"): _words(*g.SQUARE_STARTS),
    ("Ring", "start"): _words("north", "east", "south", "west"),
    ("", "delta_yaw"): lambda rng: rotation(draw_rotation(rng, 90), rng),
}


JOINT = frozenset({("Grid", role) for role in ("width", "length", "spacing", "count")})
"""Drawn together, so that the lanes fill the area."""


def value_draw(shape: str, role: str, base: str) -> Draw:
    """How the value of a slot in a shape is drawn; the sides and the corners of a square are told
    apart by the slot's name.
    """
    if shape == "Square" and role == "start" and base in ("corner", "side"):
        return _words(*(name for name in g.SQUARE_STARTS if ("-" in name) == (base == "corner")))
    if base == "direction" and role == "heading":
        return direction
    draw = DRAWS.get((shape, role)) or DRAWS.get(("", role))
    if draw is None:
        raise TemplateError(f"{shape} cannot draw a {role}")
    return draw


def grid_size(rng: random.Random, *, free: bool) -> tuple[float, float, float]:
    """Width, length and spacing of a grid, mostly of few lanes; `free`: the length need not be a
    multiple of the spacing.
    """
    spacing = rng.choice((2, 2.5, 3, 4, 5, 5, 6, 7.5, 8, 10, 10, 12, 15, 20, 25))
    lanes = rng.choice((2, 2, 3, 3, 3, 4, 4, 5, 5, 6, 7, 8, 9, 11))
    width = g.tidy(spacing * (lanes - 1))
    if free and rng.random() < 0.6:
        along = (
            g.tidy(5 * rng.randrange(1, 31))
            if rng.random() < 0.7
            else g.tidy(float(rng.randrange(5, 120)))
        )
    else:
        along = g.tidy(spacing * rng.randrange(1, 11))
    return width, along, spacing
