"""Places and sizes that a command leaves to arithmetic: "mid(P1,P2)" in the plan of a template."""

import ast
import re
from collections.abc import Callable, Iterator
from typing import Any

from planner_ft.data.templates.grammar import fail
from planner_ft.facts.geometry import Point, offset, point, tidy


def _mid(one: Point, other: Point) -> Point:
    return point((one[0] + other[0]) / 2, (one[1] + other[1]) / 2)


def _from(east: int, north: int) -> Callable[[Point, float, float], Point]:
    """The middle of an area that extends so from its corner, by its width and length."""
    return lambda corner, width, length: point(
        corner[0] + east * width / 2, corner[1] + north * length / 2
    )


FORMULAS: dict[str, Callable[..., Any]] = {
    "mid": _mid,
    "sw_ne": _mid,
    "nw_se": _mid,
    "dx": lambda one, other: tidy(abs(other[0] - one[0])),
    "dy": lambda one, other: tidy(abs(other[1] - one[1])),
    "move": lambda start, distance, heading: offset(start, heading, distance),
    "from_sw": _from(1, 1),
    "from_se": _from(-1, 1),
    "from_nw": _from(1, -1),
    "from_ne": _from(-1, -1),
    "new_x": lambda place, x: point(x, place[1]),
    "new_y": lambda place, y: point(place[0], y),
    "mixed": lambda one, other: point(one[0], other[1]),
    "swapped": lambda place: point(place[1], place[0]),
    "mirror_x": lambda place: point(-place[0], place[1]),
}
CORNERS = {"mid": ((1, 1), (1, -1), (-1, 1), (-1, -1)), "sw_ne": ((1, 1),), "nw_se": ((1, -1),)}
WINDS = (0, 90, 180, 270) * 3 + (45, 135, 225, 315)
"""Directions of moves: mostly along an axis."""
HOME = "Home"


def is_formula(key: str) -> bool:
    """Whether an argument of a plan is to be worked out."""
    return "(" in key


def operands(key: str) -> set[str]:
    """The slots that a formula needs; of a slot, the slot itself. Raises TemplateError."""
    if not is_formula(key):
        return {key}
    try:
        nodes = list(ast.walk(ast.parse(key, mode="eval")))
    except SyntaxError:
        fail(f"{key} is no formula")
    return {node.id for node in nodes if isinstance(node, ast.Name)} - {*FORMULAS, HOME}


def worked_out(key: str, value: Callable[[str], Any]) -> Any:
    """What a formula comes to; `value` gives position or number of a slot, and of Home. Raises
    KeyError for an unknown formula.
    """
    return _value(ast.parse(key, mode="eval").body, value)


def _value(node: ast.expr, value: Callable[[str], Any]) -> Any:
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        return FORMULAS[node.func.id](*(_value(one, value) for one in node.args))
    return value(node.id if isinstance(node, ast.Name) else "")


def opposite(plan: str) -> Iterator[tuple[str, str, tuple[tuple[int, int], ...]]]:
    """The pairs of slots that a plan takes for opposite corners, the first one said first, and the
    ways (east, north) that may lead from the first to the second.
    """
    for name, one, other in re.findall(r"(mid|sw_ne|nw_se)\((\w+),(\w+)\)", plan):
        if f"dx({one},{other})" in plan:
            yield one, other, CORNERS[name]


def directions(plan: str) -> set[str]:
    """The slots of a plan that say where a move goes."""
    return set(re.findall(r",(\w+)\)", plan)) if "move(" in plan else set()
