"""A plan in short, for who decides about it: a line per task, where it ends, what it rests on, and
what no program has checked.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from planner_ft.document.confidence import in_unit
from planner_ft.document.limits import limits_of
from planner_ft.document.structures import SAME, Structure, structures
from planner_ft.document.track import Track
from planner_ft.vocabulary import Vocabulary

Document = Mapping[str, Any]
NEVER = "Wind, waves, current, depth and traffic: the program knows nothing of them."


@dataclass(frozen=True)
class Row:
    """A task: its id, metres and seconds as far as they are known (`known`: all of them), and the
    share of the endurance that is used at its end.
    """

    task: str
    length: float
    seconds: float
    known: bool
    used: float | None


@dataclass(frozen=True)
class Fence:
    """An area that the vehicle keeps to, or with `inside` false, out of; `text` is its limit."""

    polygon: tuple[tuple[float, float], ...]
    inside: bool
    text: str


@dataclass(frozen=True)
class Brief:
    """A plan in short. `end` is where the vehicle ends, in words; `structures` and `fences` are
    what it keeps off.
    """

    rows: tuple[Row, ...]
    end: str
    assumed: tuple[str, ...]
    unchecked: tuple[str, ...]
    structures: tuple[Structure, ...]
    fences: tuple[Fence, ...]


def brief(document: Document, path: Track, vocabulary: Vocabulary) -> Brief:
    """The brief of a plan document with its track."""
    known = tuple(structures(document, vocabulary))
    kept = tuple(_fences(document, vocabulary))
    return Brief(
        tuple(_rows(document, path)),
        _end(document, path, vocabulary),
        tuple(assumed(document, vocabulary)),
        tuple(unchecked(document, known, kept)),
        known,
        kept,
    )


def _rows(document: Document, path: Track) -> Iterator[Row]:
    endurance, sofar = (document.get("vehicle") or {}).get("endurance"), 0.0
    open_tasks = set(document["estimate"]["open"])
    for task in document["tasks"]:
        legs = path.of(task["id"])
        seconds = sum(leg.seconds or 0.0 for leg in legs)
        sofar += seconds
        used = sofar / endurance if endurance else None
        yield Row(
            task["id"], sum(leg.metres for leg in legs), seconds, task["id"] not in open_tasks, used
        )


def _end(document: Document, path: Track, vocabulary: Vocabulary) -> str:
    """ "at home", "at green buoy", "478 m from home at (377, 479)", or that it is not known."""
    if not document["tasks"]:
        return "where it starts: the plan has no task"
    if (last := path.end) is None:
        return "not known: a place or the steps of a task are missing"
    away = math.dist(last, vocabulary.home)
    if away < SAME:
        return "at home"
    named = [one.name for one in path.targets if one.position and math.dist(one.position, last) < 1]
    where = f"at {named[0]}" if named else f"at ({last[0]:g}, {last[1]:g})"
    return f"{away:.0f} m from home, {where}"


def assumed(document: Document, vocabulary: Vocabulary) -> Iterator[str]:
    """What the plan takes for granted: the agents' own words, and values that nobody stated."""
    yield from document["assumptions"]
    for number, task in enumerate(document["tasks"], start=1):
        known = vocabulary.task.get(task["title"])
        for name, source in task.get("sources", {}).items():
            value = task["parameters"].get(name)
            if source["kind"] not in ("model", "vehicle") or value is None:
                continue
            unit = known.by_name[name].unit if known and name in known.by_name else None
            whose = "the vehicle's own value" if source["kind"] == "vehicle" else "the model's own"
            yield f"Task {number}, {task['title']}: {name} {in_unit(value, unit)} is {whose}."
        yield from (
            f"Task {number}, {task['title']}: {text}" for text in task.get("assumptions", ())
        )


def unchecked(
    document: Document, known: tuple[Structure, ...], fences: tuple[Fence, ...]
) -> Iterator[str]:
    """What no check has looked at: a plan without warnings is not safe for that."""
    limits = {limit["text"]: limit for limit in document.get("limits", ())}
    for text in document["constraints"]:
        if text in limits and (why := limits[text].get("unchecked")):
            yield f"{text.rstrip('.')}: {why}."
    if words := [text for text in document["constraints"] if text not in limits]:
        which = "A constraint is" if len(words) == 1 else f"{len(words)} constraints are"
        yield f"{which} no limit that a program keeps: read the list of constraints."
    numbers = {task["id"]: number for number, task in enumerate(document["tasks"], start=1)}
    if missing := [str(numbers[name]) for name in document["estimate"]["open"]]:
        plural, which = "s" * (len(missing) > 1), ", ".join(missing)
        yield f"Length, time or way of task{plural} {which}: a part of it is not known."
    if known:
        names = ", ".join(one.name for one in known[:5]) + " and others" * (len(known) > 5)
        yield f"Obstacles other than {names}: the program knows no others."
    else:
        yield "Obstacles: the program knows none; a chart gives them (--locate-file)."
    if not (document.get("vehicle") or {}).get("area") and not any(one.inside for one in fences):
        yield "Where the vehicle may be: no area was given (--area)."
    if not document.get("origin"):
        yield "Where on earth this is: no origin was given (--origin)."
    yield NEVER


def _fences(document: Document, vocabulary: Vocabulary) -> Iterator[Fence]:
    for limit in limits_of(document, vocabulary):
        if limit["kind"] in ("fence", "keep_out_area"):
            corners = tuple((float(x), float(y)) for x, y in limit["values"]["polygon"])
            yield Fence(corners, limit["kind"] == "fence", limit["text"])
        elif limit["kind"] == "distance":
            (x, y), far = vocabulary.home, limit["values"]["distance"]
            angles = [math.radians(5 * number) for number in range(72)]
            ring = tuple((x + far * math.sin(one), y + far * math.cos(one)) for one in angles)
            yield Fence(ring, True, limit["text"])


def overview_lines(document: Document, made: Brief) -> Iterator[str]:
    """A line per task with length, time and used endurance, and one for the whole plan."""
    from planner_ft.support.resources import clock

    width = max((len(task["title"]) for task in document["tasks"]), default=0)
    for number, (row, task) in enumerate(zip(made.rows, document["tasks"], strict=True), start=1):
        more = "" if row.known else "  and more that is not known"
        used = "" if row.used is None else f"  {100 * row.used:4.0f} %"
        sums = f"{row.length:7.0f} m  {clock(row.seconds):>8}"
        yield f"{number:3d} {task['title']:{width}} {sums}{used}{more}"
    yield f"Ends {made.end}."
