"""Whether the vehicle can carry the plan out: order, endurance, return, boundaries, area, reach,
structures; and whether steps perform their task: a grid covers its area, a pass has its length, a
panorama looks in all its directions.
"""

import functools
import math
import re
from collections.abc import Iterable, Iterator
from typing import Any

from planner_ft.document.language import Clause
from planner_ft.document.structures import LEAST, MOVING, Structure, close_legs
from planner_ft.document.track import Leg, Point, circle_of, place_of, shown
from planner_ft.document.vehicle import STAND_OFF
from planner_ft.document.warnings.case import Case, Warning, named, warning
from planner_ft.facts.geographic import read_geographic, without_geographic
from planner_ft.facts.places import read_positions
from planner_ft.planning.limits import last_away, without_limits
from planner_ft.planning.passes import face_of
from planner_ft.planning.shapes import goal_of, shape_problem
from planner_ft.vocabulary import Entry, Vocabulary
from planner_ft.vocabulary.plans import is_number
from planner_ft.vocabulary.replay import START, Condition, stops

KIND_OF: dict[Condition, tuple[str, str]] = {
    "target located": ("used-before-found", ""),
    "vehicle at the place": ("not-at-place", "replayed"),
    "position known": ("position-missing", ""),
    "data collected": ("data-not-collected", ""),
}
"""Per condition that a replay finds unmet, the kind of its warning and its sentence."""
MUCH = 0.5  # the part of the endurance from which parts of unknown length matter
MOST_LISTED = 6
MEASURES = ("m", "s", "m/s", "count")  # units of what cannot be nothing; an angle and a share can
TURNS = ("turn-to", "turn-by")
TOLERANCE = 0.5  # metres beyond a boundary that are its line still
BACK = re.compile(r"(?i)(?P<way>.*[\d\])])\s+(?:and|then)\s+back(?:\s+[a-z]+)?\s*", re.DOTALL)
CLOSE = 40  # characters before "and back" in which its way is said
INSIDE = re.compile(r"(?i)\b(?:inside|within|boundary|fence|geofence|box|polygon|leave)\b")


def open_places(case: Case) -> Iterator[Warning]:
    """One per place that is not known."""
    for place in case.document.get("open_places", ()):
        name, first = place["name"], case.tasks[place["tasks"][0] - 1]
        tasks = f"task{'s' * (len(place['tasks']) > 1)} {', '.join(map(str, place['tasks']))}"
        there = read_geographic(name)
        real = all(abs(one.latitude or 0) <= 90 and abs(one.longitude or 0) <= 180 for one in there)
        sentence = "named" if not there else "geographic" if real else "nowhere"
        made = warning("unresolved-location", sentence, about=name, name=name, tasks=tasks)
        parameter = case.vocabulary.task[first["title"]].position_parameter
        yield {**made, "task": first["id"], "parameter": parameter}


def order(case: Case) -> Iterator[Warning]:
    """Tasks at a place of their prompt that no task before goes to, and unmet conditions."""
    progress, known = START, case.vocabulary
    for task in case.tasks:
        definition = known.task[task["title"]]
        text = without_geographic(without_limits(task["task_prompt"], known))
        places = [(place.x, place.y) for place in read_positions(text) if place.certain]
        if definition.arrival == "transit" and places and progress.here not in places:
            where = {"place": shown(places[0]), "transit": known.transit}
            yield warning("not-at-place", "prompt", task, **where)
        progress = progress.after(definition, task["parameters"], known)
    for stop, _missing in stops({"tasks": case.tasks}, known):
        if stop.condition in KIND_OF:
            yield warning(*KIND_OF[stop.condition], case.tasks[stop.index], reason=stop.reason)


def missing_return(case: Case) -> Iterator[Warning]:
    """A command that speaks of coming home, and a plan that ends elsewhere."""
    last = last_away(case.tasks, case.vocabulary)
    if last is not None and any(_asks_for_home(clause, case) for clause in case.typed):
        yield warning("missing-return", last=named(last))


def _asks_for_home(clause: Clause, case: Case) -> bool:
    """Whether a clause speaks of coming home, and not of a way that begins there."""
    away = [clause.start + at.end() for at in case.words["from_home"].finditer(clause.text)]
    ways = case.words["elsewhere"].finditer(clause.text)
    away += [clause.start + at.start() + len("return") for at in ways]
    # "To 180,0 and back please", but not "from 0,40 to 180,0 and back".
    if back := BACK.fullmatch(case.command, max(0, clause.start - CLOSE), clause.end):
        return not clause.corrected and len(read_positions(back["way"])) == 1
    return any(end not in away for _start, end in clause.spans(case.words["home"]))


def endurance(case: Case) -> Iterator[Warning]:
    """Time against endurance, the way home included."""
    lasts, known = case.vehicle.get("endurance"), case.document.get("estimate") or {}
    if not lasts or not known:
        return
    home, away = case.vocabulary.home, last_away(case.tasks, case.vocabulary) is not None
    back = math.dist(case.path.last(home), home) / case.vehicle["cruise_speed"] if away else 0.0
    taken = _minutes(known["seconds"])
    taken += f" and {_minutes(back)} for the way home" if back >= 60 else ""
    numbers = [str(case.by_id[name]["number"]) for name in known["open"] if name in case.by_id]
    more, several = len(numbers) - MOST_LISTED, "s" * (len(numbers) > 1)
    listed = ", ".join(numbers[:MOST_LISTED]) + (f" and {more} more" if more > 0 else "")
    unknown = f" Not counted is what is not known of task{several} {listed}." if numbers else ""
    words: dict[str, Any] = {"taken": taken, "limit": _minutes(lasts), "unknown": unknown}
    if known["seconds"] + back > lasts:
        yield warning("over-endurance", **words)
    elif unknown and known["seconds"] + back > MUCH * lasts:
        yield warning("endurance-open", **words)


def _minutes(seconds: float) -> str:
    return f"{math.ceil(seconds / 60):,} min"


def performed(case: Case) -> Iterator[Warning]:
    """One per task without a step that fits it, or whose waypoints are not those of its values.

    Waypoints that were added for clearance count with neither.
    """
    known = case.vocabulary
    for task in case.tasks:
        definition, steps = known.task[task["title"]], task["skill_sequence"] or []
        for item in definition.parameters:
            if item.unit in MEASURES and task["parameters"].get(item.name) == 0:
                yield warning("not-performed", "nothing", task, item.name, name=item.name)
        # A search may go anywhere.
        if not steps or task.get("stale") or task["title"] == known.locate:
            continue
        names = [step["navigation_skill"]["name"] for step in steps]
        if not {*names} & {*definition.skills.get("navigation", ())}:
            yield warning("not-performed", "else", task)
        elif problem := _problem(task, names, known) or _repeated(task, case):
            yield warning("not-performed", "shape", task, problem=problem)


def _repeated(task: Entry, case: Case) -> str | None:
    """Whether a grid goes over its lanes again, of which its prompt says nothing."""
    if case.vocabulary.task[task["title"]].pattern != "lawnmower":
        return None
    points = own_waypoints(task, case.vocabulary)
    twice = len(points) - len(set(points))
    said = case.words["again"].search(task["task_prompt"])
    return None if said or not twice else f"it goes to {twice} of its waypoints again"


def own_waypoints(task: Entry, known: Vocabulary) -> list[Point]:
    """The waypoints of a task, but for those that were added for clearance."""
    clearance = {mark["step"] for mark in task.get("added", ()) if mark["kind"] == "clearance"}
    goals = [goal_of(step, known) for step in task["skill_sequence"] or ()]
    return [(goal[0], goal[1]) for at, goal in enumerate(goals) if goal and at not in clearance]


def _problem(task: Entry, names: list[str], known: Vocabulary) -> str | None:
    """How waypoints and turns of a task (`names`: its movements) differ from its values."""
    if known.task[task["title"]].pattern == "sectors":
        count, motions = task["parameters"].get("sectors"), map(known.motion.of, names)
        turns = sum(motion is not None and motion.kind in TURNS for motion in motions)
        off = is_number(count) and not count - 1 <= turns <= count + 1
        return f"it turns {turns} times for {count:g} sectors" if off else None
    goals = (goal_of(step, known) for step in task["skill_sequence"])
    could = any(skill.coordinates for skill in known.skills)
    if task["title"] == known.transit and could and not any(goals):
        return "none of its steps goes anywhere"
    return shape_problem(task, own_waypoints(task, known), known)


# ---------------------------------------------------------------- boundaries, area, reach


def boundaries(case: Case) -> Iterator[Warning]:
    """Waypoints outside their boundary: of their step, their task or the plan's constraints."""
    for name, step, polygon in _boundaries(case):
        yield from _outside("boundary", case.by_id[name], _reached(case, name, step), polygon)


def area_and_reach(case: Case) -> Iterator[Warning]:
    """Waypoints outside the vehicle's area, or too far away to return."""
    vehicle, home = case.vehicle, case.vocabulary.home
    for task in case.tasks:
        place = place_of(task, case.vocabulary)
        reached = [*([place] if place else ()), *_reached(case, task["id"])]
        if vehicle.get("area"):
            area = _polygon(vehicle["area"])
            found = list(_outside("area", task, reached, area))
            yield from found or _leaving(task, case.path.of(task["id"]), area)
        if not vehicle.get("endurance"):
            continue
        reach = vehicle["cruise_speed"] * vehicle["endurance"] / 2
        farthest = max(reached, key=lambda point: math.dist(point, home), default=home)
        if (away := math.dist(farthest, home)) > reach:
            where = {"place": shown(farthest), "away": away, "reach": reach}
            yield warning("out-of-reach", task=task, **where)


def _outside(kind: str, task: Entry, points: list[Point], area: Any) -> Iterator[Warning]:
    from shapely import intersects_xy

    outside = next((point for point in points if not intersects_xy(area, *point)), None)
    if outside:
        yield warning(f"outside-{kind}", "place", task, place=shown(outside))


def _leaving(task: Entry, legs: Iterable[Leg], area: Any) -> Iterator[Warning]:
    """A task with a leg that leaves the area between two waypoints in it."""
    from shapely import LineString, intersects_xy

    ways = [leg.points for leg in legs if len(leg.points) > 1]
    inside = (way for way in ways if all(intersects_xy(area, *way[end]) for end in (0, -1)))
    left = next((way for way in inside if not area.covers(LineString(way))), None)
    if left:
        yield warning("outside-area", "way", task, place=f"{shown(left[0])} to {shown(left[-1])}")


def _boundaries(case: Case) -> Iterator[tuple[str, int | None, Any]]:
    """(task, step or None for all, polygon) of filter skills, task parameters and constraints."""
    fences = [
        [tuple(map(float, corner)) for corner in limit["values"]["polygon"]]
        for limit in case.limits
        if "polygon" in limit["values"]
    ]
    for boundary in case.path.boundaries:
        if list(boundary.polygon) not in fences:
            yield boundary.task, boundary.step, _polygon(boundary.polygon)
    limits = {limit["text"] for limit in case.limits}
    texts = [text for text in case.document.get("constraints", ()) if text not in limits]
    plan = [corners for text in texts for corners in _corners(text)]
    for task in case.tasks:
        parameters = case.vocabulary.task[task["title"]].parameters
        own = [task["parameters"].get(item.name) for item in parameters if item.type == "polygon"]
        yield from ((task["id"], None, _polygon(corners)) for corners in (*own, *plan) if corners)


def _corners(text: str) -> Iterator[list[Point]]:
    """The corners that a constraint names: "Stay inside [0, 0], [80, 0], [80, 50], [0, 50]."."""
    places = read_positions(text)
    found = [place for place in places if text[place.start - 1 : place.start] in ("[", "(")]
    corners = list(dict.fromkeys((place.x, place.y) for place in found))
    if len(corners) >= 3 and INSIDE.search(text):
        yield corners


def _reached(case: Case, task: str, step: int | None = None) -> list[Point]:
    """The points that legs of a task lead to; where a leg begins was reached before."""
    own = case.path.of(task, step)
    return [point for leg in own for point in leg.points[leg.kind in MOVING :]]


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


def close_structures(case: Case) -> Iterator[Warning]:
    """One per structure that a task comes too close to and that no limit names; of what reaches
    from one place to another its nearest part.
    """
    limited = [limit["values"] for limit in case.limits]
    told = {one.get("object") for one in limited if "position" not in one}
    told |= {shown(one["position"]) for one in limited if "position" in one}
    nearest = dict[tuple[str, str], tuple[float, Structure]]()
    for name, structure, metres in close_legs(case.document, case.path.legs, case.vocabulary):
        at, bar = shown(structure.position), case.words["bars"].fullmatch(structure.name)
        key, found = (name, structure.name if bar else at), (metres, structure)
        nearest[key] = min(nearest.get(key, found), found, key=lambda one: one[0])
    for (name, _key), (metres, structure) in nearest.items():
        at = shown(structure.position)
        if structure.name not in told and at not in told:
            where = structure.name if structure.name == at else f"{structure.name} at {at}"
            values: dict[str, Any] = {"metres": metres, "name": where}
            values["standoff"] = structure.standoff
            yield warning("structure-close", task=case.by_id[name], about=at, **values)


def beside(case: Case) -> Iterator[Warning]:
    """Tasks that go round a structure, or along it, nearer than any vehicle of the kind may."""
    least = case.vehicle.get("stand_off", STAND_OFF) * LEAST
    for task in case.tasks:
        circle, face = circle_of(task, case.vocabulary), face_of(task, case.vocabulary)
        metres = circle[1] if circle else face.distance if face else least
        if 0 < metres < least:
            yield warning("structure-close", "beside", task, metres=metres)
