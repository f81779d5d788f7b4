"""Waypoints of the movements that task plans are made of, and values that follow from stated ones
by arithmetic: headings evenly round the compass, points a stated way off, points of shapes.

Frame: metres, x east, y north; headings in degrees clockwise from north. Waypoints are rounded to
two decimals, whole numbers as ints.
"""

import functools
import itertools
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

Point = tuple[float, float]
Area = tuple[Point, float, float]
"""Middle, width along x, length along y."""
Corner = Literal["south-west", "south-east", "north-east", "north-west"]
Axis = Literal["x", "y"]

CORNERS: tuple[Corner, ...] = ("south-west", "south-east", "north-east", "north-west")

# Counter-clockwise round the square from the middle of its east side, in units of half a side.
SQUARE: tuple[tuple[str, int, int], ...] = (
    ("east", 1, 0),
    ("north-east", 1, 1),
    ("north", 0, 1),
    ("north-west", -1, 1),
    ("west", -1, 0),
    ("south-west", -1, -1),
    ("south", 0, -1),
    ("south-east", 1, -1),
)
SQUARE_STARTS = tuple(name for name, _x, _y in SQUARE)

MOST_SECTORS = 36
MOST_STARTS = 8  # stated angles up to which parts of them, and even turns from them, are derived
CLOSE = 0.02  # metres by which a computed coordinate, which has two decimals, can be off
SQUARELY = (0.0, 90.0, 180.0, 270.0)  # turns from a bearing: ahead, to either side, back


def tidy(value: float) -> float:
    """Two decimals at most, whole numbers as ints, no negative zero."""
    rounded = round(value, 2)
    return int(rounded) if rounded == int(rounded) else rounded


def point(x: float, y: float) -> Point:
    """The point with tidy coordinates."""
    return tidy(x), tidy(y)


def offset(start: Point, heading: float, distance: float) -> Point:
    """The point `distance` metres from `start` on `heading`."""
    angle = math.radians(heading)
    return point(start[0] + distance * math.sin(angle), start[1] + distance * math.cos(angle))


def straight_line(start: Point, heading: float, length: float) -> list[Point]:
    """Start and end of a pass or a cable track."""
    return [point(*start), offset(start, heading, length)]


def survey_square(
    center: Point, half_side: float, start: str = "east", *, clockwise: bool = False
) -> list[Point]:
    """Mid-sides and corners of the square from the named one on ("east": a mid-side)."""
    first = SQUARE_STARTS.index(start)
    step = -1 if clockwise else 1
    ring = (SQUARE[(first + step * index) % len(SQUARE)] for index in range(len(SQUARE)))
    return [point(center[0] + x * half_side, center[1] + y * half_side) for _name, x, y in ring]


def rectangle(corners: Sequence[Point]) -> Area | None:
    """The area of four corners with sides along the axes; None where they are no such."""
    if len(corners) != len(CORNERS):
        return None
    (west, *_, east), (south, *_, north) = (sorted(axis) for axis in zip(*corners, strict=True))
    crossed = set(itertools.product({west, east}, {south, north}))
    if len(crossed) != len(CORNERS) or set(corners) != crossed:
        return None
    return point((west + east) / 2, (south + north) / 2), tidy(east - west), tidy(north - south)


def corners_of(middle: Sequence[float], width: float, length: float) -> list[Point]:
    """The corners of an area."""
    ways = itertools.product((-0.5, 0.5), repeat=2)
    return [(middle[0] + east * width, middle[1] + north * length) for east, north in ways]


def lane_count(extent: float, spacing: float) -> int | None:
    """Lanes over `extent` where `spacing` divides it: only then all count the same; else None."""
    lanes = extent / spacing
    return round(lanes) + 1 if abs(lanes - round(lanes)) < 1e-9 else None


def lawnmower(
    center: Point,
    width: float,
    length: float,
    spacing: float,
    corner: Corner = "south-west",
    lanes_along: Axis = "y",
    *,
    uneven: bool = False,
) -> list[Point]:
    """Ends of the lanes in the order in which they are run, two per lane, each lane against the one
    before.

    `width` lies along x and `length` along y. The first lane starts at `corner`; lanes step away
    from it. Where `spacing` does not divide the extent across the lanes, the last one may be nearer
    to the one before (`uneven`); else raises ValueError.
    """
    axis, size = (0 if lanes_along == "y" else 1), (width, length)
    sides = (1 if "east" in corner else -1), (1 if "north" in corner else -1)
    lanes = lane_count(size[axis], spacing)
    if lanes is None and not uneven:
        raise ValueError(f"lanes {spacing} m apart do not fill {size[axis]} m")
    lanes = lanes or math.ceil(size[axis] / spacing) + 1
    reach = sides[1 - axis] * size[1 - axis] / 2
    points = []
    for lane in range(lanes):
        step = center[axis] + sides[axis] * (size[axis] / 2 - min(lane * spacing, size[axis]))
        for end in (reach, -reach) if lane % 2 == 0 else (-reach, reach):
            run = center[1 - axis] + end
            points.append(point(step, run) if axis == 0 else point(run, step))
    return points


def circle(
    center: Point, radius: float, count: int, start_bearing: float, *, clockwise: bool
) -> list[Point]:
    """`count` points evenly round the circle; the first at `start_bearing` from the centre."""
    step = 360 / count if clockwise else -360 / count
    return [offset(center, start_bearing + step * index, radius) for index in range(count)]


def sector_headings(count: int, start: float = 0, *, clockwise: bool = True) -> list[float]:
    """`count` headings evenly round the compass from `start` on, each in 0 up to 360."""
    step = 360 / count if clockwise else -360 / count
    return [tidy((start + step * index) % 360) for index in range(count)]


# ---------------------------------------------------------------- what follows from stated values


def sector_counts(numbers: Iterable[float]) -> frozenset[int]:
    """The numbers into which a turn or a line can be divided."""
    return frozenset(int(number) for number in numbers if number in range(2, MOST_SECTORS + 1))


def turned(said: Sequence[float], counts: Iterable[int]) -> Iterator[float]:
    """Angles in degrees that follow from stated ones: parts of them, turns to port, headings to the
    side and back, and evenly round the compass.
    """
    said, counts = list(dict.fromkeys(said)), sorted({2, *counts})
    few = said if len(said) <= MOST_STARTS else []
    steps = [360 / count for count in counts if count > 2]
    parts = [value / count for value in few for count in counts]
    yield from itertools.chain(steps, parts)
    yield from (-value for value in (*said, *steps, *parts))
    yield from ((value + turn) % 360 for value in few for turn in SQUARELY)
    for start, step in itertools.product({0.0, *(value % 360 for value in few)}, steps):
        yield from ((start + number * step) % 360 for number in range(round(360 / step)))


@dataclass(frozen=True)
class Ground:
    """What waypoints are derived from: known places, centres of shapes (those that are the
    `corners` of areas among them), lengths, bearings, numbers of lanes or points; `spacing` is that
    of all lanes where the task has one.
    """

    places: tuple[Point, ...]
    centres: tuple[Point, ...]
    lengths: tuple[float, ...]
    bearings: tuple[float, ...]
    counts: tuple[int, ...]
    sizes: tuple[tuple[float, float], ...]
    corners: bool = False
    spacing: float | None = None

    def leads_to(self, point: Point, before: Iterable[Point] = ()) -> bool:
        """Whether a waypoint is a known place, a point of a line, a grid, a square or a ring, or a
        stated way off a known place or one of the waypoints `before` it.
        """
        bases = tuple(dict.fromkeys((*self.places, *before)))
        return (
            all(any(abs(point[axis] - base[axis]) <= CLOSE for base in bases) for axis in (0, 1))
            or any(self.is_way_off(point, base) for base in bases)
            or any(_divides(point, *line, self.counts) for line in self._lines)
            or self.has_shape_through(point)
        )

    def has_shape_through(self, point: Point) -> bool:
        """Whether a point is on a square, a ring or a grid."""
        for centre in self.centres:
            x, y = point[0] - centre[0], point[1] - centre[1]
            if any(_on_square(x, y, half) for half in self.lengths) or self._on_ring(x, y):
                return True
        return any(
            _ends_lane(point[0] - x, point[1] - y, width, length, spacing)
            or _ends_lane(point[1] - y, point[0] - x, length, width, spacing)
            for x, y, width, length in self.areas
            for spacing in self.spacings(width, length)
        )

    def is_way_off(self, point: Point, base: Point) -> bool:
        """Whether a point is a stated way off another in a stated direction, or squarely to it."""
        length = math.dist(point, base)
        return any(abs(length - known) <= CLOSE for known in self.lengths) and any(
            math.dist(point, offset(base, bearing + turn, length)) <= CLOSE
            for bearing in (*self.bearings, *self._courses)
            for turn in SQUARELY
        )

    def away(self, bases: Iterable[Point]) -> Iterator[Point]:
        """The points a stated way off some others in a stated direction."""
        ways = itertools.product(bases, self.bearings, self.lengths)
        return itertools.starmap(offset, ways)

    def _on_ring(self, x: float, y: float) -> bool:
        radius, bearing = math.hypot(x, y), math.degrees(math.atan2(x, y))
        if not any(abs(radius - length) <= CLOSE for length in self.lengths):
            return False
        slack = math.degrees(CLOSE / radius)
        ways = itertools.product({*self.bearings, *SQUARELY}, self.counts)
        return any((bearing - start + slack) % (360 / count) <= 2 * slack for start, count in ways)

    @functools.cached_property
    def _lines(self) -> list[tuple[Point, Point]]:
        return list(itertools.combinations(self.places, 2))

    @functools.cached_property
    def _courses(self) -> list[float]:
        ways = ((end[0] - start[0], end[1] - start[1]) for start, end in self._lines)
        return [math.degrees(math.atan2(*way)) for way in ways]

    @functools.cached_property
    def areas(self) -> list[tuple[float, float, float, float]]:
        """Middle, width and length of every area that can be meant."""
        found = []
        corners = self.corners and not self._has_rectangle
        signs = [(0, 0), *(itertools.product((1, -1), repeat=2) if corners else ())]
        ways = itertools.product(self.places, self.sizes, signs)
        for (x, y), (width, length), (right, up) in ways:
            found.append((x + right * width / 2, y + up * length / 2, width, length))
        for one, other in itertools.combinations(self.centres, 2):
            middle = (one[0] + other[0]) / 2, (one[1] + other[1]) / 2
            found.append((*middle, abs(one[0] - other[0]), abs(one[1] - other[1])))
        return [area for area in dict.fromkeys(found) if area[2] and area[3]]

    @property
    def _has_rectangle(self) -> bool:
        """Whether four of the centres are the corners of an area, which then is said whole."""
        pairs = itertools.combinations(self.centres, 2)
        across = ((one, two) for one, two in pairs if one[0] != two[0] and one[1] != two[1])
        return any({(one[0], two[1]), (two[0], one[1])} <= {*self.centres} for one, two in across)

    @property
    def sides(self) -> list[float]:
        """Widths and lengths in metres of the areas between two places."""
        pairs = itertools.combinations(self.centres, 2)
        sides = (abs(one[axis] - other[axis]) for one, other in pairs for axis in (0, 1))
        return sorted(set(filter(None, sides)))

    def spacings(self, width: float, length: float) -> tuple[float, ...]:
        """Distances between the lanes of an area."""
        if self.spacing:
            return (self.spacing,)
        shares = (side / (count - 1) for count in self.counts for side in (width, length))
        return tuple(dict.fromkeys((*self.lengths, *shares)))


def _divides(point: Point, start: Point, end: Point, counts: Iterable[int]) -> bool:
    """Whether a point is in the middle of a line, or one of several evenly along it."""
    (x, y), (dx, dy) = start, (end[0] - start[0], end[1] - start[1])
    parts = {2, *counts, *(count - 1 for count in counts)}
    shares = ((step / count) for count in parts for step in range(1, count))
    return any(math.dist(point, (x + dx * share, y + dy * share)) <= CLOSE for share in shares)


def _on_square(x: float, y: float, half: float) -> bool:
    """Whether a point seen from the centre is a corner or mid-side of the square."""
    parts = [min(abs(abs(part) - half), abs(part)) <= CLOSE for part in (x, y)]
    return all(parts) and max(abs(x), abs(y)) >= half - CLOSE


def _ends_lane(across: float, along: float, width: float, length: float, spacing: float) -> bool:
    """Whether a point seen from the middle of an area is the end of a lane."""
    lanes, place = width / spacing, (across + width / 2) / spacing
    return (
        abs(lanes - round(lanes)) < 1e-6
        and abs(place - round(place)) * spacing <= CLOSE
        and abs(across) <= width / 2 + CLOSE
        and abs(abs(along) - length / 2) <= CLOSE
    )
