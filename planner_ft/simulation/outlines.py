"""Outlines of structures on request: `--outline NAME=SHAPE`, for runs that see more than a pile.

A shape is a radius ("3"), a box of so many metres east and north ("16x4"), or an L or T in such a
box ("L8x8", "T10x8"). A plan knows structures as points; an outline is part of the simulated world.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from planner_ft.simulation.fast import Floats
from planner_ft.support.errors import PlannerError

CORNERS = 48
"""Corners of a round outline."""
ARM = 3 / 8
"""How broad the arms of an L or T are, of the shorter side. ASSUMPTION."""
LARGEST = 200.0
SHAPES = ("", "L", "T")


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


def reach(outline: Floats) -> float:
    """How far an outline reaches from its centre, in m."""
    return float(np.linalg.norm(outline, axis=1).max())


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
