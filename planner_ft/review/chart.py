"""A sketch of a plan's track for a terminal: braille dots, or points where there are none."""

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence

from planner_ft.document.track import Point, Track

DOTS = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))
"""Bits of the dots of a braille character (U+2800 and on), by row and column."""
CIRCLE_STEPS = 72
LARGEST = 1e9
"""Metres from home beyond which nothing is drawn."""
MARGIN = 0.05


class _Canvas:
    """Dots, 2 by 4 in a character, over the area of `points`, with letters on top."""

    def __init__(self, points: Sequence[Point], columns: int, rows: int) -> None:
        west, east = min(x for x, _y in points), max(x for x, _y in points)
        south, north = min(y for _x, y in points), max(y for _x, y in points)
        width, height = east - west, north - south
        # Room to the right for the numbers that stand beside points.
        metres = max(width / (2 * columns - 12), height / (4 * rows - 4), 1e-6) * (1 + MARGIN)
        self.metres = metres
        """Per dot, in both directions."""
        self.columns = columns
        self.rows = min(rows, math.ceil(height / metres / 4) + 2)
        self.west, self.north = west - 2 * metres, north + (4 * self.rows * metres - height) / 2
        self.cells: dict[tuple[int, int], int] = defaultdict(int)
        self.letters: dict[tuple[int, int], str] = {}

    def place(self, point: Point) -> tuple[float, float]:
        """Column and row of a point, in dots."""
        return (point[0] - self.west) / self.metres, (self.north - point[1]) / self.metres

    def line(self, start: Point, end: Point) -> None:
        (x, y), (to_x, to_y) = self.place(start), self.place(end)
        steps = max(1, math.ceil(max(abs(to_x - x), abs(to_y - y))))
        for step in range(steps + 1):
            share = step / steps
            column, row = int(x + (to_x - x) * share), int(y + (to_y - y) * share)
            self.cells[column // 2, row // 4] |= DOTS[row % 4][column % 2]

    def write(self, point: Point, text: str) -> None:
        """Write a text to the right of a point, unless something is written there already."""
        x, y = self.place(point)
        places = [(int(x) // 2 + offset, int(y) // 4) for offset in range(len(text))]
        if not any(place in self.letters for place in places):
            self.letters.update(zip(places, text, strict=True))

    def lines(self, braille: bool) -> list[str]:
        dots = {cell: chr(0x2800 + bits) if braille else "." for cell, bits in self.cells.items()}
        shown = dots | self.letters
        return [
            "".join(shown.get((column, row), " ") for column in range(self.columns)).rstrip()
            for row in range(self.rows)
        ]


def chart(
    track: Track,
    tasks: Sequence[str],
    home: Point,
    *,
    columns: int = 78,
    rows: int = 22,
    braille: bool = True,
) -> list[str]:
    """Lines of the track, scale and legend; `tasks` are ids, a number is where that task ends."""
    shapes = [shape for shape in _shapes(track) if all(map(_drawable, shape))]
    missing = [f"not located yet: {item.name}" for item in track.targets if item.position is None]
    if not any(math.dist(point, home) > 0 for shape in shapes for point in shape):
        return ["(nothing moves that can be drawn)", *missing]
    canvas = _Canvas([home, *(point for shape in shapes for point in shape)], columns, rows)
    for shape in shapes:
        for start, end in zip(shape, shape[1:] or shape, strict=False):
            canvas.line(start, end)
    canvas.write(home, "H")
    known = []
    for target in track.targets:
        if target.position is not None:
            x, y = target.position
            known.append(f"* {target.name} at [{x:g}, {y:g}]")
            if _drawable(target.position):
                canvas.write(target.position, "*")
    ends = {leg.task: leg.points[-1] for leg in track.legs if leg.points}
    for task, point in ends.items():
        if task in tasks and _drawable(point):
            canvas.write(point, str(tasks.index(task) + 1))
    return [*canvas.lines(braille), _scale(canvas.metres, braille), *known, *missing]


def _shapes(track: Track) -> Iterator[tuple[Point, ...]]:
    yield from (leg.points for leg in track.legs if leg.points)
    yield from ((*boundary.polygon, boundary.polygon[0]) for boundary in track.boundaries)
    for circle in track.circles:
        angles = (2 * math.pi * step / CIRCLE_STEPS for step in range(CIRCLE_STEPS + 1))
        (x, y), radius = circle.center, circle.radius
        yield tuple((x + radius * math.sin(turn), y + radius * math.cos(turn)) for turn in angles)
    yield from ((target.position,) for target in track.targets if target.position is not None)


def _drawable(point: Point) -> bool:
    return all(abs(value) <= LARGEST for value in point)


def _scale(metres: float, braille: bool) -> str:
    """A bar of a round length, about a quarter of the chart."""
    wanted = 40 * metres
    power = 10.0 ** math.floor(math.log10(wanted))
    length = max(step * power for step in (1, 2, 5) if step * power <= wanted * 1.0001)
    count = round(length / metres / 2)
    bar = f"├{'─' * count}┤" if braille else f"|{'-' * count}|"
    return f"{bar} {length:g} m   north is up   H home   1, 2, ... where that task ends"
