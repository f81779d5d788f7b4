"""Whether the vehicle can carry the plan out: order, endurance, return; and whether steps perform
their task: a grid covers its area, a pass has its length, a panorama looks in all its directions.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.document.track import place_of, shown
from planner_ft.document.warnings.case import Case
from planner_ft.document.warnings.kinds import Warning, named, warning
from planner_ft.facts.places import read_geographic, read_positions
from planner_ft.planning.limits import without_limits
from planner_ft.planning.shapes import goal_of, shape_problem
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import is_number
from planner_ft.vocabulary.replay import START, Condition, stops

KIND_OF: dict[Condition, tuple[str, str]] = {
    "target located": ("used-before-found", ""),
    "vehicle at the place": ("not-at-place", "replayed"),
    "position known": ("position-missing", ""),
    "data collected": ("data-not-collected", ""),
}
"""Per condition that a replay finds unmet, the kind of its warning and its sentence."""
MUCH = 0.5
"""The part of the endurance from which parts of unknown length matter."""
MOST_LISTED = 6


def open_places(case: Case) -> Iterator[Warning]:
    """One per place that is not known."""
    for place in case.document.get("open_places", ()):
        name, first = place["name"], case.tasks[place["tasks"][0] - 1]
        tasks = f"task{'s' * (len(place['tasks']) > 1)} {', '.join(map(str, place['tasks']))}"
        sentence = "geographic" if read_geographic(name) else "named"
        made = warning("unresolved-location", sentence, about=name, name=name, tasks=tasks)
        parameter = case.vocabulary.task[first["title"]].position_parameter
        yield {**made, "task": first["id"], "parameter": parameter}


def order(case: Case) -> Iterator[Warning]:
    """Tasks at a place of their prompt that no task before goes to, and unmet conditions."""
    progress, known = START, case.vocabulary
    for task in case.tasks:
        definition = known.task[task["title"]]
        text = without_limits(task["task_prompt"], known)
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
    last, home = _last_away(case), case.words["home"]
    if last is not None and any(any(clause.spans(home)) for clause in case.typed):
        yield warning("missing-return", last=named(last))


def endurance(case: Case) -> Iterator[Warning]:
    """Time against endurance, the way home included."""
    lasts, known = case.vehicle.get("endurance"), case.document.get("estimate") or {}
    if not lasts or not known:
        return
    home, away = case.vocabulary.home, _last_away(case) is not None
    back = math.dist(case.path.last(home), home) / case.vehicle["cruise_speed"] if away else 0.0
    taken = _minutes(known["seconds"])
    taken += f" and {_minutes(back)} for the way home" if back >= 60 else ""
    names, more = known["open"], len(known["open"]) - MOST_LISTED
    listed = ", ".join(names[:MOST_LISTED]) + (f" and {more} more tasks" if more > 0 else "")
    unknown = f" Not counted is what is not known of {listed}." if names else ""
    words: dict[str, Any] = {"taken": taken, "limit": _minutes(lasts), "unknown": unknown}
    if known["seconds"] + back > lasts:
        yield warning("over-endurance", **words)
    elif unknown and known["seconds"] + back > MUCH * lasts:
        yield warning("endurance-open", **words)


def _last_away(case: Case) -> Mapping[str, Any] | None:
    """The last task that takes place somewhere, unless that is home or a dock."""
    task: Mapping[str, Any]
    for task in reversed(case.tasks):
        known = case.vocabulary.task[task["title"]]
        docks = known.docks or (known.arrival == "none" and known.pattern == "visual")
        if docks or place_of(task, case.vocabulary) == case.vocabulary.home:
            return None
        if known.arrival != "none":
            return task
    return None


def _minutes(seconds: float) -> str:
    return f"{math.ceil(seconds / 60):,} min"


# ---------------------------------------------------------------- the steps of a task


MEASURES = ("m", "s", "m/s", "count")
"""Units of what cannot be nothing; an angle and a share can."""
TURNS = ("turn-to", "turn-by")


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
        elif problem := _problem(task, names, known):
            yield warning("not-performed", "shape", task, problem=problem)


def _problem(task: Mapping[str, Any], names: list[str], known: Vocabulary) -> str | None:
    """How waypoints and turns of a task (`names`: its movements) differ from its values."""
    if known.task[task["title"]].pattern == "sectors":
        count, motions = task["parameters"].get("sectors"), map(known.motion.of, names)
        turns = sum(motion is not None and motion.kind in TURNS for motion in motions)
        few = is_number(count) and turns < count - 1
        return f"it turns {turns} times for {count:g} sectors" if few else None
    clearance = {mark["step"] for mark in task.get("added", ()) if mark["kind"] == "clearance"}
    goals = [goal_of(step, known) for step in task["skill_sequence"]]
    points = [goal for at, goal in enumerate(goals) if goal and at not in clearance]
    return shape_problem(task, points, known)
