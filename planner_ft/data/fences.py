"""Fences and areas as operators give them: three to six corners in many notations, or two."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

from planner_ft.data.numbers import Value, digits, pick, polygon, position
from planner_ft.data.task.values import draw_point, draw_polygon
from planner_ft.facts.geometry import Point, point

BOXED = 0.3
"""Share of the boxes that are said by two of their corners."""
CORNERS = (
    *("[{x}, {y}]",) * 4,
    *("({x}, {y})",) * 3,
    *("{x},{y}",) * 4,
    *("({x},{y})", "[{x},{y}]", "{x}/{y}", "{x} {y}", "x={x} y={y}"),
)
JOINTS = (", ", ", ", " ", " - ", "; ", " and ")


def corners(rng: Random) -> Value:
    """Three to six corners in one of many notations, or a box by two of them."""
    points, roll = draw_polygon(rng), rng.random()
    if roll < 0.2:
        width, height = 10 * rng.randrange(4, 50), 10 * rng.randrange(4, 50)
        points = [point(0, 0), point(width, 0), point(width, height), point(0, height)]
    elif roll < 0.32:
        points = _hexagon(rng)
    elif roll < 0.45:
        x, y = draw_point(rng)
        shifts = [(0, 0), (60, -10), (80, 40), (20, 70)]
        size = pick((0.5, 1, 2, 4), rng)
        points = [point(x + size * dx, y + size * dy) for dx, dy in shifts]
    listed = [list(corner) for corner in points]
    if rng.random() < 0.35:
        value = polygon(points, rng)
        if value.noun and rng.random() < BOXED:
            return Value(listed, value.noun)
        return Value(listed, value.text)
    form, joint = pick(CORNERS, rng), pick(JOINTS, rng)
    if form in ("{x} {y}", "x={x} y={y}") and joint == " ":
        joint = ", "
    texts = [form.format(x=digits(x), y=digits(y)) for x, y in points]
    if len(points) == 4 and rng.random() < BOXED and _is_box(points):
        low, high = points[0], max(points, key=sum)
        first, last = (position(corner, rng, "({x}, {y})").text for corner in (low, high))
        return Value(listed, f"{first} {pick(('to', 'and', 'up to', '-'), rng)} {last}")
    if joint == " and ":
        return Value(listed, ", ".join(texts[:-1]) + joint + texts[-1])
    return Value(listed, joint.join(texts))


def _is_box(points: Sequence[Point]) -> bool:
    """Whether the corners are those of a box that begins in the south-west."""
    xs, ys = {x for x, _y in points}, {y for _x, y in points}
    return len(xs) == len(ys) == 2 and points[0] == (min(xs), min(ys))


def _hexagon(rng: Random) -> list[Point]:
    x, y, step = 10 * rng.randrange(-15, 15), 10 * rng.randrange(-15, 15), 10 * rng.randrange(2, 12)
    shape = ((0, 0), (2, 0), (3, 1), (2, 2), (0, 2), (-1, 1))
    return [point(x + step * dx, y + step * dy) for dx, dy in shape]
