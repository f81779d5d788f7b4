"""Limits of a plan: what they hold for, the words that they came from, and the filters they are.

They are the canonical sentences among the plan's constraints (planner_ft.vocabulary.limits).
"""

import copy
import dataclasses
import re
from collections.abc import Iterable, Iterator
from typing import Any

from planner_ft.document.language import language, read_clauses
from planner_ft.document.ontology import named_places
from planner_ft.facts import WAYPOINT, Facts, Span, read
from planner_ft.planning.frame import frame_of
from planner_ft.planning.limits import holds_for, limits_in, time_left
from planner_ft.planning.locations import ARTICLE
from planner_ft.vocabulary import Entry, Parameter, Vocabulary
from planner_ft.vocabulary.limits import Limit, Limits, load_limits

UNITS = {"distance": "m", "speed": "m/s", "duration": "s"}
MARK = re.compile(r" (?:[a-z]?\d+[a-z]?|[a-z])$")  # the letter or number of a thing
MOVING = ("go", "arc", "drift")  # motions in which a filter has something to do


def limits_of(document: Entry, vocabulary: Vocabulary) -> list[dict[str, Any]]:
    """The limits of a plan document as its key `limits` has them, without the words."""
    known = load_limits(vocabulary)
    found = limits_in(list(document.get("constraints", ())), known)
    placed = [_placed(limit, document, vocabulary) for limit in found]
    return [_entry(limit, known, document["tasks"]) for limit in placed]


def _placed(limit: Limit, document: Entry, vocabulary: Vocabulary) -> Limit:
    """The limit; one that names a thing alone with the place of the one thing that ends with this
    name: home, or one of the command, the chart, or what the operator has located.
    """
    if "object" not in limit.values or "position" in limit.values:
        return limit
    thing = _bare(limit.values["object"])
    named = [*document.get("structures", {}).items(), *document.get("located", {}).items()]
    if language(vocabulary).words["home"].fullmatch(thing):
        named.append((thing, list(vocabulary.home)))
    for words, place in named_places(frame_of(document).spoken, vocabulary, thing):
        named.append((words, [place.x, place.y]))
    name = f" {thing}"
    bare = [(f" {_bare(words)}", at) for words, at in named]
    # "Turbine A1" is the turbine.
    places = [at for words, at in bare if name in (words[-len(name) :], MARK.sub("", words))]
    if not places or any(at != places[0] for at in places):
        return limit
    return dataclasses.replace(limit, values={**limit.values, "position": places[0]})


def _bare(name: str) -> str:
    return ARTICLE.sub("", name.strip()).casefold()


def with_words(document: Entry, vocabulary: Vocabulary) -> list[dict[str, Any]]:
    """The limits of a plan document, each with the words of the command that it came from."""
    frame = frame_of(document)
    found = limits_of(document, vocabulary)
    for limit in found:
        span = _words(limit, frame.spoken, vocabulary)
        if span:
            start, end = frame.span(*span)
            limit["spans"] = [[start, end]]
            limit["words"] = document["command"][start:end]
    return found


def _entry(limit: Limit, known: Limits, tasks: list[dict[str, Any]]) -> dict[str, Any]:
    kind = known[limit.kind]
    held = [
        place for place, task in enumerate(tasks, start=1) if holds_for(limit, task["title"], tasks)
    ]
    entry = {"kind": limit.kind, "values": limit.values, "text": limit.text, "tasks": held}
    entry |= {"filter": kind.filter} if kind.filter else {}
    place = "position" in limit.values or "object" not in limit.values
    if limit.kind == "return" and time_left(limit.values) is None:
        entry["unchecked"] = "the plan has no time of day"
    elif not place:
        entry["unchecked"] = f"where {limit.values['object']} is, is not known"
    return entry


def _words(limit: Entry, command: str, vocabulary: Vocabulary) -> Span | None:
    """The clauses of the command that have the values of a limit."""
    facts = read(command)
    spans = list(_mentions(limit["values"], facts))
    if not spans:
        return None
    first, last = min(start for start, _end in spans), max(end for _start, end in spans)
    clauses = read_clauses(command, vocabulary)
    start = max((one.start for one in clauses if one.start <= first), default=first)
    end = min((one.end for one in clauses if one.end >= last), default=last)
    text = command[start:end]
    return start + len(text) - len(text.lstrip(" ,;")), end - (len(text) - len(text.rstrip(" ,;")))


def _mentions(values: Entry, facts: Facts) -> Iterator[Span]:
    for name, value in values.items():
        if name in UNITS:
            yield from facts.evidence(value, Parameter(name, "number", UNITS[name])).spans[:1]
        elif name == "position":
            yield from facts.evidence(value, WAYPOINT).spans[:1]
        elif name == "polygon":
            for corner in value:
                yield from facts.evidence(corner, WAYPOINT).spans[:1]
        elif (at := facts.text.casefold().find(value.casefold())) >= 0:
            yield at, at + len(value)


def carried(document: Entry, vocabulary: Vocabulary) -> list[dict[str, Any]]:
    """The tasks of a plan with every limit that has a filter in each step that moves or has one."""
    known = load_limits(vocabulary)
    limits = [limit for limit in limits_of(document, vocabulary) if "filter" in limit]
    tasks: list[dict[str, Any]] = list(document["tasks"])
    if not limits:
        return tasks
    done = []
    for place, task in enumerate(tasks, start=1):
        own_limits = [limit for limit in limits if place in limit["tasks"]]
        steps, marks = copy.deepcopy(task.get("skill_sequence")), list(task.get("added", ()))
        for number, step in enumerate(steps or ()):
            filters = {own["name"] for own in step["filter_skills"]}
            for limit in own_limits if not task.get("stale") else ():
                if moves(step, vocabulary) or limit["filter"] in filters:
                    marks += _filter(number, step, limit, known, vocabulary)
        entry = {**task, "skill_sequence": steps}
        done.append({**entry, "added": marks} if marks else entry)
    return done


def without_filters(tasks: Iterable[dict[str, Any]]) -> list[dict[str, Any]]:
    """The tasks without the filters that limits have brought."""
    done = []
    for task in tasks:
        entry = copy.deepcopy(task)
        marks = entry.pop("added", [])
        for mark in (mark for mark in marks if mark["kind"] == "limit"):
            filters = entry["skill_sequence"][mark["step"]]["filter_skills"]
            for own in [one for one in filters if one["name"] == mark["name"]][-1:]:
                if "parameter" in mark:
                    own["parameters"].pop(mark["parameter"], None)
                else:
                    filters.remove(own)
        kept = [mark for mark in marks if mark["kind"] != "limit"]
        done.append({**entry, "added": kept} if kept else entry)
    return done


def moves(step: Entry, vocabulary: Vocabulary) -> bool:
    """Whether a step moves the vehicle."""
    motion = vocabulary.motion.of(step["navigation_skill"]["name"])
    return motion is not None and motion.kind in MOVING


def _filter(
    number: int, step: dict[str, Any], limit: Entry, known: Limits, vocabulary: Vocabulary
) -> Iterable[dict[str, Any]]:
    """Have a step keep a limit by its filter; the mark where that changes it."""
    kind, name = known[limit["kind"]], limit["filter"]
    given = {own: limit["values"][value] for own, value in kind.parameters.items()}
    mark = {"step": number, "role": "filter", "name": name, "kind": "limit", "note": limit["text"]}
    standing = [own for own in step["filter_skills"] if own["name"] == name]
    for own in standing:
        if all(_keeps(own["parameters"].get(key), value) for key, value in given.items()):
            return []
        if not given.keys() & own["parameters"].keys():
            own["parameters"] |= copy.deepcopy(given)
            return [{**mark, "parameter": key} for key in given]
    step["filter_skills"].append({"name": name, "parameters": copy.deepcopy(given)})
    text = vocabulary.skill[name].failure
    if text and text not in step["failure_modes"]:
        step["failure_modes"].append(text)
    return [mark]


def _keeps(own: Any, value: Any) -> bool:
    """Whether a filter's value is as strict as the limit: the same, or a greater distance."""
    if isinstance(own, (int, float)) and isinstance(value, (int, float)):
        return own >= value
    return bool(own == value)
