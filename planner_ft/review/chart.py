"""A sketch of a plan's track for a terminal: dots of braille characters, or points where a terminal
has none.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from planner_ft.document.track import Point, Track

DOTS = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))
"""Bits of the dots of a braille character (U+2800 and on), by row and column."""
CIRCLE_STEPS = 72
LARGEST = 1e9
"""Metres from home beyond which nothing is drawn."""
MARGIN = 0.05


@dataclass
class _Canvas:
    """Dots, 2 by 4 in a character, over a part of the local frame; `marks` are letters that stand
    over them.
    """

    columns: int
    rows: int
    west: float
    north: float
    metres: float
    """Per dot, in both directions: a character is about twice as high as wide."""
    cells: dict[tuple[int, int], int] = field(default_factory=dict)
    marks: dict[tuple[int, int], str] = field(default_factory=dict)

    def place(self, point: Point) -> tuple[float, float]:
        """Column and row of a point, in dots."""
        return (point[0] - self.west) / self.metres, (self.north - point[1]) / self.metres

    def line(self, start: Point, end: Point) -> None:
        (x, y), (to_x, to_y) = self.place(start), self.place(end)
        steps = max(1, math.ceil(max(abs(to_x - x), abs(to_y - y))))
        for step in range(steps + 1):
            share = step / steps
            column, row = int(x + (to_x - x) * share), int(y + (to_y - y) * share)
            cell = column // 2, row // 4
            self.cells[cell] = self.cells.get(cell, 0) | DOTS[row % 4][column % 2]

    def mark(self, point: Point, text: str) -> None:
        """Write a text to the right of a point, unless something is written there already."""
        x, y = self.place(point)
        column, row = int(x) // 2, int(y) // 4
        places = [(column + offset, row) for offset in range(len(text))]
        if not any(place in self.marks for place in places):
            self.marks.update(zip(places, text, strict=True))

    def lines(self, braille: bool) -> Iterator[str]:
        for row in range(self.rows):
            yield "".join(
                self._character((column, row), braille) for column in range(self.columns)
            ).rstrip()

    def _character(self, cell: tuple[int, int], braille: bool) -> str:
        if cell in self.marks:
            return self.marks[cell]
        dots = self.cells.get(cell, 0)
        return " " if not dots else chr(0x2800 + dots) if braille else "."


def chart(
    track: Track,
    tasks: Sequence[str],
    home: Point,
    *,
    columns: int = 78,
    rows: int = 22,
    braille: bool = True,
) -> list[str]:
    """The track as lines of text at most `columns` wide, with a scale and what the signs mean;
    `tasks` are the ids in their order.

    Legs, stand-offs and boundaries are dotted lines; a number is where that task ends, H is home, *
    a target. Targets without a place are named below.
    """
    shapes = [shape for shape in _shapes(track) if all(map(_drawable, shape))]
    if not any(math.dist(point, home) > 0 for shape in shapes for point in shape):
        return ["(nothing moves that can be drawn)", *_open_targets(track)]
    canvas = _canvas([home, *(point for shape in shapes for point in shape)], columns, rows)
    for shape in shapes:
        for start, end in zip(shape, shape[1:] or shape, strict=False):
            canvas.line(start, end)
    canvas.mark(home, "H")
    for target in track.targets:
        if target.position is not None and _drawable(target.position):
            canvas.mark(target.position, "*")
    for task, point in _ends(track).items():
        if task in tasks and _drawable(point):
            canvas.mark(point, str(tasks.index(task) + 1))
    return [
        *canvas.lines(braille),
        _scale(canvas.metres, braille),
        *_known_targets(track),
        *_open_targets(track),
    ]


def _shapes(track: Track) -> Iterator[tuple[Point, ...]]:
    yield from (leg.points for leg in track.legs if leg.points)
    yield from ((*boundary.polygon, boundary.polygon[0]) for boundary in track.boundaries)
    for circle in track.circles:
        angles = (2 * math.pi * step / CIRCLE_STEPS for step in range(CIRCLE_STEPS + 1))
        (x, y), radius = circle.center, circle.radius
        yield tuple(
            (x + radius * math.sin(angle), y + radius * math.cos(angle)) for angle in angles
        )
    yield from ((target.position,) for target in track.targets if target.position is not None)


def _drawable(point: Point) -> bool:
    return all(abs(value) <= LARGEST for value in point)


def _canvas(points: Sequence[Point], columns: int, rows: int) -> _Canvas:
    """A canvas that holds the points; less high where they lie in a flat strip."""
    west, east = min(x for x, _y in points), max(x for x, _y in points)
    south, north = min(y for _x, y in points), max(y for _x, y in points)
    # Room to the right for the numbers that stand beside points.
    metres = max((east - west) / (2 * columns - 12), (north - south) / (4 * rows - 4), 1e-6) * (
        1 + MARGIN
    )
    used = min(rows, math.ceil((north - south) / metres / 4) + 2)
    return _Canvas(
        columns, used, west - 2 * metres, north + (4 * used * metres - (north - south)) / 2, metres
    )


def _ends(track: Track) -> dict[str, Point]:
    """Where each task leaves the vehicle."""
    return {leg.task: leg.points[-1] for leg in track.legs if leg.points}


def _scale(metres: float, braille: bool) -> str:
    """A bar of a round length, about a quarter of the chart."""
    wanted = 40 * metres
    power = 10.0 ** math.floor(math.log10(wanted))
    length = max(step * power for step in (1, 2, 5) if step * power <= wanted * 1.0001)
    bar = max(1, round(length / metres / 2))
    return (
        f"├{'─' * bar}┤" if braille else f"|{'-' * bar}|"
    ) + f" {length:g} m   north is up   H home   1, 2, ... where that task ends"


def _known_targets(track: Track) -> Iterator[str]:
    yield from (
        f"* {target.name} at [{target.position[0]:g}, {target.position[1]:g}]"
        for target in track.targets
        if target.position is not None
    )


def _open_targets(track: Track) -> Iterator[str]:
    yield from (
        f"not located yet: {target.name}" for target in track.targets if target.position is None
    )
