"""Whether the vehicle can carry the plan out: order, boundaries, area, range, endurance, return."""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from planner_ft.document.language import language, read_clauses
from planner_ft.document.track import Leg, Point, TaskEntry, Track, place_of
from planner_ft.document.warnings.warning import Warning, named, warning
from planner_ft.facts.places import read_geographic, read_positions
from planner_ft.planning.limits import without_limits
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.replay import START, Condition, stops

KIND_OF: dict[Condition, str] = {
    "target located": "used-before-found",
    "vehicle at the place": "not-at-place",
    "position known": "position-missing",
    "data collected": "data-not-collected",
}
TOLERANCE = 0.5
"""Metres beyond a boundary that are its line still."""
MUCH = 0.5
"""The part of the endurance from which parts of unknown length matter."""
MOST_LISTED = 6
INSIDE = re.compile(r"(?i)\b(?:inside|within|boundary|fence|geofence|box|polygon|leave)\b")


# ---------------------------------------------------------------- order


def order_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """One per open place, and per condition that a replay of the plan finds unmet."""
    tasks = document["tasks"]
    for place in document.get("open_places", ()):
        name, first = place["name"], tasks[place["tasks"][0] - 1]
        needed = f"task{'s' * (len(place['tasks']) > 1)} {', '.join(map(str, place['tasks']))}"
        missing = f"{needed} cannot be carried out before it is located"
        text = f"Where {name} is, is not known; {missing}."
        if read_geographic(name):
            text = f"{name} is a geographic position (latitude, longitude); {missing}: give"
            text += " --origin LAT,LON, where the plan's [0, 0] lies."
        parameter = vocabulary.task[first["title"]].position_parameter
        made = warning("unresolved-location", text, about=name)
        yield {**made, "task": first["id"], "parameter": parameter}
    for index, reason in _elsewhere(tasks, vocabulary):
        yield _not_there("not-at-place", tasks[index], reason)
    for stop, _missing in stops({"tasks": tasks}, vocabulary):
        if stop.condition in KIND_OF:
            yield _not_there(KIND_OF[stop.condition], tasks[stop.index], stop.reason)


def _not_there(kind: str, task: TaskEntry, reason: str) -> Warning:
    return warning(kind, f"{named(task)} cannot be carried out there: {reason}.", task)


def _elsewhere(tasks: list[TaskEntry], vocabulary: Vocabulary) -> Iterator[tuple[int, str]]:
    """(index, reason) of tasks at a place of their prompt that no task before goes to."""
    progress, transit = START, vocabulary.transit
    for index, task in enumerate(tasks):
        known, text = (
            vocabulary.task[task["title"]],
            without_limits(task["task_prompt"], vocabulary),
        )
        places = [(place.x, place.y) for place in read_positions(text) if place.certain]
        if known.arrival == "transit" and places and progress.here not in places:
            x, y = places[0]
            yield index, f"its prompt names [{x:g}, {y:g}], and no {transit} goes there before it"
        progress = progress.after(known, task["parameters"], vocabulary)


# ---------------------------------------------------------------- space


def space_warnings(
    document: Mapping[str, Any], path: Track, vocabulary: Vocabulary
) -> Iterator[Warning]:
    """Waypoints outside their boundary, outside the vehicle's area, or too far away to return."""
    tasks = {task["id"]: task for task in document["tasks"]}
    vehicle = document.get("vehicle") or {}
    for name, step, polygon in _boundaries(document, path, vocabulary):
        reached = _reached(path.legs, name, step)
        yield from _outside("boundary", tasks[name], reached, polygon, "its boundary")
    for name, task in tasks.items():
        place = place_of(task, vocabulary)
        reached = [*([place] if place else ()), *_reached(path.legs, name)]
        if vehicle.get("area"):
            area = _polygon(vehicle["area"])
            yield from _outside("area", task, reached, area, "the vehicle's area")
        yield from _too_far(task, reached, vehicle, vocabulary)


def _outside(
    kind: str, task: TaskEntry, points: list[Point], area: Any, what: str
) -> Iterator[Warning]:
    from shapely import intersects_xy

    outside = next((point for point in points if not intersects_xy(area, *point)), None)
    if outside:
        text = f"{named(task)} goes to {_shown(outside)}, which is outside {what}."
        yield warning(f"outside-{kind}", text, task)


def _too_far(
    task: TaskEntry, reached: Iterable[Point], vehicle: Mapping[str, Any], vocabulary: Vocabulary
) -> Iterator[Warning]:
    if not vehicle.get("endurance"):
        return
    reach = vehicle["cruise_speed"] * vehicle["endurance"] / 2
    farthest = max(reached, key=lambda point: math.dist(point, vocabulary.home), default=None)
    away = math.dist(farthest, vocabulary.home) if farthest else 0.0
    if farthest and away > reach:
        goes = f"{named(task)} goes to {_shown(farthest)}, {away:.0f} m from home"
        limit = f"the vehicle comes {reach:.0f} m far and back"
        yield warning("out-of-reach", f"{goes}; {limit}.", task)


def _boundaries(
    document: Mapping[str, Any], path: Track, vocabulary: Vocabulary
) -> Iterator[tuple[str, int | None, Any]]:
    """(task, step or None for all, polygon) of filter skills, task parameters and constraints."""
    fences = [
        [tuple(map(float, corner)) for corner in limit["values"]["polygon"]]
        for limit in document.get("limits", ())
        if "polygon" in limit["values"]
    ]
    for boundary in path.boundaries:
        if list(boundary.polygon) not in fences:
            yield boundary.task, boundary.step, _polygon(boundary.polygon)
    limits = {limit["text"] for limit in document.get("limits", ())}
    texts = [text for text in document.get("constraints", ()) if text not in limits]
    plan = [corners for text in texts for corners in _corners(text)]
    for task in document["tasks"]:
        parameters = vocabulary.task[task["title"]].parameters
        own = [task["parameters"].get(item.name) for item in parameters if item.type == "polygon"]
        yield from ((task["id"], None, _polygon(corners)) for corners in (*own, *plan) if corners)


def _corners(text: str) -> Iterator[list[Point]]:
    """The corners that a constraint names: "Stay inside [0, 0], [80, 0], [80, 50], [0, 50]."."""
    places = read_positions(text)
    found = [place for place in places if text[place.start - 1 : place.start] in ("[", "(")]
    corners = list(dict.fromkeys((place.x, place.y) for place in found))
    if len(corners) >= 3 and INSIDE.search(text):
        yield corners


def _reached(legs: Iterable[Leg], task: str, step: int | None = None) -> list[Point]:
    """The points that legs of a task lead to; where a leg begins was reached before."""
    own = [leg for leg in legs if leg.task == task and step in (None, leg.step)]
    return [point for leg in own for point in leg.points[leg.kind in ("go", "arc") :]]


def _polygon(corners: Iterable[Any]) -> Any:
    return _prepared(tuple((float(x), float(y)) for x, y in corners))


@functools.lru_cache(maxsize=512)
def _prepared(corners: tuple[Point, ...]) -> Any:
    """The area with its line; corners with crossing sides enclose every reading of them."""
    from shapely import Polygon, make_valid, prepare

    shape = Polygon(corners)
    whole = shape if shape.is_valid else make_valid(shape).union(shape.convex_hull)
    area = whole.buffer(TOLERANCE)
    prepare(area)
    return area


def _shown(point: Point) -> str:
    return f"[{point[0]:.6g}, {point[1]:.6g}]"


# ---------------------------------------------------------------- range and return


def range_warnings(
    document: Mapping[str, Any], path: Track, vocabulary: Vocabulary
) -> Iterator[Warning]:
    """Time against endurance, the way home included, and a return that is missing."""
    away = _last_away(document["tasks"], vocabulary)
    yield from _over_endurance(document, path, vocabulary, away is not None)
    if away is None:
        return
    command, words = document["command"], language(vocabulary).words
    if any(any(clause.spans(words["home"])) for clause in read_clauses(command, vocabulary)):
        text = f"coming home or back, and the plan ends with {named(away)} and no return."
        yield warning("missing-return", f"The command speaks of {text}")


def _over_endurance(
    document: Mapping[str, Any], path: Track, vocabulary: Vocabulary, away: bool
) -> Iterator[Warning]:
    vehicle, known = document.get("vehicle") or {}, document.get("estimate") or {}
    endurance = vehicle.get("endurance")
    if not endurance or not known:
        return
    last = next((leg.points[-1] for leg in reversed(path.legs) if leg.points), vocabulary.home)
    home = math.dist(last, vocabulary.home) / vehicle["cruise_speed"] if away else 0.0
    taken = _minutes(known["seconds"])
    taken += f" and {_minutes(home)} for the way home" if home >= 60 else ""
    limit, names = _minutes(endurance), known["open"]
    more = len(names) - MOST_LISTED
    listed = ", ".join(names[:MOST_LISTED]) + (f" and {more} more tasks" if more > 0 else "")
    unknown = f" Not counted is what is not known of {listed}." if names else ""
    if known["seconds"] + home > endurance:
        text = f"The plan takes at least {taken}, and the vehicle lasts {limit}.{unknown}"
        yield warning("over-endurance", text)
    elif unknown and known["seconds"] + home > MUCH * endurance:
        text = f"The known part of the plan takes {taken} of the vehicle's {limit}.{unknown}"
        yield warning("endurance-open", text)


def _last_away(tasks: list[TaskEntry], vocabulary: Vocabulary) -> TaskEntry | None:
    """The last task that takes place somewhere, unless that is home or a dock."""
    for task in reversed(tasks):
        known = vocabulary.task[task["title"]]
        docks = known.docks or (known.arrival == "none" and known.pattern == "visual")
        if docks or place_of(task, vocabulary) == vocabulary.home:
            return None
        if known.arrival != "none":
            return task
    return None


def _minutes(seconds: float) -> str:
    return f"{math.ceil(seconds / 60):,} min"
