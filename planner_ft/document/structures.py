"""Structures that a plan keeps off, and areas that it keeps to.

A structure is a place that command or operator name as a thing: what a search looks for, what a
task goes round, what a task prompt names beside a position, a point of a chart, what a limit keeps
the vehicle away from. A place of the water ("waypoint", bare coordinates), a berth and the middle
of an area or a line that is gone over are none, but for a point of the chart that nobody names and
what stands in the middle of the area ("the platform").
"""

import itertools
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.document.language import language, read_clauses
from planner_ft.document.limits import limits_of
from planner_ft.document.ontology import is_thing, named_lines, named_places, stands
from planner_ft.document.track import Leg, Point, circle_of, place_of, point_of, shown
from planner_ft.document.vehicle import STAND_OFF
from planner_ft.facts import Position, is_number, near
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.places import read_positions
from planner_ft.planning.frame import frame_of
from planner_ft.vocabulary import Entry, Vocabulary

LINE = "line"
ROUND, OVER = ("orbit", "square"), ("lawnmower", LINE)
"""Patterns of tasks that go round their place, and of those that go over it."""
FACING = ("sweep", "pass")
"""Patterns of tasks that look at a structure from where the vehicle has gone to."""
FOLLOWING = "follow"
"""The pattern of a task that goes up to its place and no closer than its filters let it."""
LEAST = 0.2  # the part of the stand-off below which a stated distance is hardly meant
SAME = 0.6  # metres within which a waypoint is a structure itself
MARGIN = 0.5
"""Metres that an added waypoint lies farther off than it must, and that a leg may come closer."""
ALONGSIDE = 3.0  # metres within which a structure is the berth's own quay or pontoon
MOST_PARTS = 60  # circles by which a line is kept clear of
CORNERS = 12  # waypoints of a full way round a structure
MOVING = ("go", "arc")
Allowed = Callable[[Point, Point], bool]  # whether a straight leg may be gone


@dataclass(frozen=True)
class Structure:
    """A thing in the water, and the distance in metres that is kept from it."""

    name: str
    position: Point
    standoff: float

    @property
    def slack(self) -> float:
        """Metres that a leg may come closer: arcs are drawn as chords."""
        return max(MARGIN, 0.005 * self.standoff)

    def blocks(self, start: Point, goal: Point) -> bool:
        """Whether a straight leg comes too close."""
        return way_off(self.position, start, goal) < self.standoff - self.slack

    def corners(self) -> list[Point]:
        """Waypoints of a way round at the stand-off."""
        radius = (self.standoff + MARGIN) / math.cos(math.pi / CORNERS)
        angles = [2 * math.pi * number / CORNERS for number in range(CORNERS)]
        x, y = self.position
        return [(x + radius * math.sin(one), y + radius * math.cos(one)) for one in angles]


def structures(document: Entry, vocabulary: Vocabulary) -> list[Structure]:
    """The known structures of a plan, each with the stand-off that is stated or the vehicle's."""
    own = (document.get("vehicle") or {}).get("stand_off", STAND_OFF)
    least, kept, named = 0.0, dict[Point, float](), dict[Point, str]()
    tall, berths = set[Point](), set[Point]()
    for limit in limits_of(document, vocabulary):
        values = limit["values"]
        if limit["kind"] == "clearance":
            least = max(least, values["distance"])
        elif limit["kind"] == "keep_out" and "position" in values:
            at = point_of(values["position"])
            kept[at] = max(kept.get(at, 0.0), values["distance"])
            named[at] = values.get("object", "")
    excluded, stated = {vocabulary.home}, dict[Point, list[float]]()
    told = " ".join([document["command"], *(task["task_prompt"] for task in document["tasks"])])
    spoken = named_places(frame_of(document).spoken, vocabulary)
    # Places of the command beside which no thing is named are the vehicle's own.
    called = [(at.x, at.y) for _words, at in spoken]
    bare = {(at.x, at.y) for at in read_positions(frame_of(document).spoken)}.difference(called)
    chart = document.get("structures", {}).items()
    charted = {point_of(at) for name, at in chart if name.casefold() not in told.casefold()}
    for task in document["tasks"]:
        known, place = vocabulary.task.get(task["title"]), place_of(task, vocabulary)
        beside = [
            (words, (at.x, at.y)) for words, at in named_places(task["task_prompt"], vocabulary)
        ]
        if known is not None and known.pattern in FACING:
            named |= {at: words for words, at in beside if at not in named and at not in bare}
        if known is None or place is None:
            continue
        things = [words for words, at in beside if math.dist(at, place) < SAME]
        over = known.pattern in OVER and place not in charted
        said = [words for words, at in spoken if math.dist((at.x, at.y), place) < SAME]
        upright = known.pattern != LINE and any(stands(one, vocabulary) for one in things + said)
        if known.docks or (over and not upright):
            excluded.add(place)
        # What another task goes to stands also in the middle of an area.
        berths |= {place} if known.docks else set()
        tall |= {place} if upright and not known.docks else set()
        if known.pattern in ROUND:
            named.setdefault(place, "")
        for words in things:
            named[place] = named.get(place) or words
        if circle := circle_of(task, vocabulary):
            stated.setdefault(place, []).append(circle[1])
        elif known.pattern == FOLLOWING and (margin := _margin(task, vocabulary)) > own:
            stated.setdefault(place, []).append(margin)
    _of_command(document, own, kept, named, vocabulary)
    for at, metres in said_off(document, vocabulary):
        stated.setdefault(at, [metres])
    for name, position in (*chart, *document.get("located", {}).items()):
        if is_thing(name, vocabulary):
            named[point_of(position)] = named.get(point_of(position)) or name
    return [
        Structure(name or shown(at), at, max(kept.get(at) or min(stated.get(at, [own])), least))
        for at, name in named.items()
        if at in kept or at not in excluded or at in tall - berths
    ]


def _of_command(
    document: Entry,
    own: float,
    kept: dict[Point, float],
    named: dict[Point, str],
    vocabulary: Vocabulary,
) -> None:
    """Add the things that the command itself names, and the distances that are kept from them."""
    of_one_name = dict[str, list[Point]]()
    for words, beside in named_places(frame_of(document).spoken, vocabulary):
        named.setdefault((beside.x, beside.y), words)
        of_one_name.setdefault(words, []).append((beside.x, beside.y))
    # What is kept off one of "the pens at" is kept off all of them.
    for places in of_one_name.values():
        if distances := [kept[at] for at in places if at in kept]:
            kept |= {at: max(distances) for at in places if at not in kept}
    for words, one, other in bars(document, vocabulary):
        parts = along((one.x, one.y), (other.x, other.y), own)
        named |= {at: words for at in parts if at not in named}
        # The circles of a long thing are larger: they leave no gap.
        kept |= {at: apart for at in parts if (apart := math.dist(*parts[:2])) > own + MARGIN}


def said_off(document: Entry, vocabulary: Vocabulary) -> Iterator[tuple[Point, float]]:
    """(place, metres) of things from which the command keeps a distance that no task has as its
    own: "film the mast at 40,30 from 25 m away", by clauses with one thing and one such length. One
    that is hardly meant is none.
    """
    text, words = frame_of(document).spoken, language(vocabulary).words
    least = LEAST * (document.get("vehicle") or {}).get("stand_off", STAND_OFF)
    owned = [
        task["parameters"].get(one.name)
        for task in document["tasks"]
        if task["title"] in vocabulary.task
        for one in vocabulary.task[task["title"]].parameters
        if one.unit == "m"
    ]
    lengths = [
        one
        for one in read_numbers(text)
        if one.unit == "m"
        and one.value >= least
        and words["off_it"].match(text[one.end :].lstrip())
        and not any(is_number(value) and near(one.value, value) for value in owned)
    ]
    named = named_places(text, vocabulary) if lengths else ()
    for clause in read_clauses(text, vocabulary) if lengths else ():
        places = [at for _words, at in named if clause.start <= at.start < clause.end]
        said = [one.value for one in lengths if clause.start <= one.start < clause.end]
        if len(places) == len(said) == 1 and not clause.corrected:
            yield (places[0].x, places[0].y), said[0]


def _margin(task: Entry, vocabulary: Vocabulary) -> float:
    """The largest distance that a filter of a task keeps from obstacles, 0 for none."""
    filters = [own for step in task.get("skill_sequence") or () for own in step["filter_skills"]]
    motions = [(vocabulary.motion.of(own["name"]), own["parameters"]) for own in filters]
    kept = [motion.value("distance", own) for motion, own in motions if motion is not None]
    return max((float(metres) for metres in kept if metres), default=0.0)


def close_legs(
    document: Entry, legs: Sequence[Leg], vocabulary: Vocabulary
) -> Iterator[tuple[str, Structure, float]]:
    """(task, structure, metres) of every leg that comes too close; docking may, where the berth
    lies as close.
    """
    known = structures(document, vocabulary)
    steering = {task["id"] for task in document["tasks"] if task.get("skill_sequence")}
    along = {task["id"] for task in document["tasks"] if runs_along(task, vocabulary)}
    berths = {task["id"]: place for task in document["tasks"] if (place := berth(task, vocabulary))}
    for last, leg in zip([None, *legs], legs, strict=False) if known else ():
        begun = leg.task in along and (last is None or last.task != leg.task)
        if leg.kind not in MOVING or leg.task not in steering or (leg.task in along and not begun):
            continue
        close = [berths[one.task] for one in (leg, last) if one and one.task in berths]
        for structure in known:
            if lies_at(structure, close):
                continue
            pairs = itertools.pairwise(leg.points)
            nearest = min(way_off(structure.position, *pair) for pair in pairs)
            ends = [point for point in (leg.points[0], leg.points[-1]) if point == vocabulary.home]
            ends += [*close, *([leg.points[-1]] if begun else [])]
            if last and last.task in along and structure.blocks(*(leg.points[0],) * 2):
                continue
            allowed = min([structure.standoff, *(math.dist(structure.position, at) for at in ends)])
            if nearest < allowed - structure.slack:
                yield leg.task, structure, nearest


def fence(document: Entry, vocabulary: Vocabulary) -> Allowed:
    """Whether a leg stays inside the plan's fences and outside of its closed areas."""
    limits = limits_of(document, vocabulary)
    inside = [limit["values"]["polygon"] for limit in limits if limit["kind"] == "fence"]
    inside += [area] if (area := (document.get("vehicle") or {}).get("area")) else []
    outside = [limit["values"]["polygon"] for limit in limits if limit["kind"] == "keep_out_area"]
    if not inside and not outside:
        return lambda _start, _goal: True
    from shapely import LineString, Polygon

    areas = [Polygon(corners).buffer(MARGIN) for corners in inside]
    closed = list(map(closed_area, outside))

    def stays(start: Point, goal: Point) -> bool:
        leg = LineString([start, goal])
        kept = all(area.covers(leg) for area in areas)
        return kept and not any(area.intersects(leg) for area in closed)

    return stays


def posts(document: Entry, vocabulary: Vocabulary) -> list[Point]:
    """Waypoints beside the corners of the plan's closed areas, by which legs lead round them."""
    limits = limits_of(document, vocabulary)
    areas = [limit["values"]["polygon"] for limit in limits if limit["kind"] == "keep_out_area"]
    if not areas:
        return []
    from shapely import Polygon, make_valid

    wider = (make_valid(Polygon(one)).buffer(2 * MARGIN, join_style="mitre") for one in areas)
    return [(x, y) for area in wider for x, y in area.convex_hull.exterior.coords[1:]]


def closed_area(corners: Sequence[Point]) -> Any:
    """The inside of an area without its edge (shapely); the line of one that has no inside."""
    from shapely import Polygon, make_valid

    area = make_valid(Polygon(corners))
    inside = area.buffer(-MARGIN)
    return area.buffer(MARGIN) if inside.is_empty else inside


def lies_at(structure: Structure, berths: Iterable[Point]) -> bool:
    """Whether a structure is what a berth lies at."""
    return any(math.dist(structure.position, place) <= ALONGSIDE for place in berths)


def berth(task: Entry, vocabulary: Vocabulary) -> Point | None:
    """Where a task docks; None for one that does not."""
    known = vocabulary.task.get(task["title"])
    return place_of(task, vocabulary) if known is not None and known.docks else None


def runs_along(task: Entry, vocabulary: Vocabulary) -> bool:
    """Whether a task passes along a face, close to it on purpose."""
    known = vocabulary.task.get(task["title"])
    return known is not None and known.pattern == "pass"


def bars(document: Entry, vocabulary: Vocabulary) -> Iterator[tuple[str, Position, Position]]:
    """What bars the way from one position of the command to another, by its words."""
    found = (place_of(task, vocabulary) for task in document["tasks"])
    places = [vocabulary.home, *(at for at in found if at is not None)]
    ways = {*itertools.pairwise(places)}
    return named_lines(frame_of(document).spoken, vocabulary, ways)


def along(start: Point, end: Point, apart: float) -> list[Point]:
    """Both ends of a line, and points between them that are no farther `apart`."""
    count = max(1, min(MOST_PARTS, math.ceil(math.dist(start, end) / max(apart, MARGIN))))
    (x, y), (a, b) = start, end
    return [(x + at / count * (a - x), y + at / count * (b - y)) for at in range(count + 1)]


def way_off(point: Point, start: Point, goal: Point) -> float:
    """The distance of a point from a straight leg."""
    (x, y), (a, b) = start, (goal[0] - start[0], goal[1] - start[1])
    square = a * a + b * b
    along = ((point[0] - x) * a + (point[1] - y) * b) / square if square else 0.0
    along = min(1.0, max(0.0, along))
    return math.dist(point, (x + along * a, y + along * b))
