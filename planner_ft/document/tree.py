"""A plan document as a tree that a person can read; and in short, for who decides about it: a line
per task, where it ends, what it rests on, and what no program has checked.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from planner_ft.document.build import PlanDocument
from planner_ft.document.confidence import choice_lines, confidence_lines, doubtful_text, in_unit
from planner_ft.document.limits import limits_of
from planner_ft.document.structures import SAME, Structure, structures
from planner_ft.document.track import Track
from planner_ft.planning.essentials import added_text
from planner_ft.planning.frame import origin_of
from planner_ft.support.files import compact_json
from planner_ft.support.resources import clock, memory_size
from planner_ft.support.terminal import plain
from planner_ft.vocabulary import Entry, Vocabulary
from planner_ft.vocabulary.plans import step_skills

INDENT = "   "
LANGUAGE = "unknown-language"
CHOICES = "What is meant? (type the number and letter in the review)"
SHOWN_PROBLEMS, SHOWN_TEXT = 5, 400
"""Problems and characters of an answer that is not valid."""
SIGNS = {"navigation": "", "filter": " | ", "perception": " + "}
NEVER = "Wind, waves, current, depth and traffic: the program knows nothing of them."


def plan_tree(document: PlanDocument) -> str:
    """The plan, its assumptions, open places and cost as lines without control characters."""
    return "\n".join(map(plain, _lines(document)))


def _lines(document: PlanDocument) -> Iterator[str]:
    yield document["command"]
    yield from origin_line(document)
    yield from (one["text"] for one in document["warnings"] if one["kind"] == LANGUAGE)
    yield from confidence_lines(document)
    yield from task_tree(document)
    places = []
    for place in document["open_places"]:
        numbers = ", ".join(map(str, place["tasks"]))
        places.append(f"{place['name']}: task{'s' * (len(place['tasks']) > 1)} {numbers}")
    sections = {
        CHOICES: list(choice_lines(document)),
        "Assumptions": document["assumptions"],
        "Constraints": list(constraint_lines(document)),
        "Questions (answer in the command, or in the review as TASK.PARAMETER=VALUE)": [
            *document.get("questions", ())
        ],
        'Open places (fill in with --locate "NAME=x,y")': places,
        "Warnings": [
            one["text"]
            for one in document["warnings"]
            if one["kind"] not in ("value-asked", LANGUAGE)
        ],
    }
    for heading, items in sections.items():
        yield from (f"{heading}:", *(f" - {item}" for item in items)) if items else ()
    if "away" in document["estimate"]:
        yield f"Ends {document['estimate']['away']:g} m from home."
    yield ""
    for agent, use in document["usage"].items():
        yield f"{agent.capitalize()} Agent  {_use(use)}"
    yield f"peak memory {memory_size(document['peak_memory_bytes'])}"


def origin_line(document: PlanDocument) -> list[str]:
    """Where [0, 0] lies, in a line; none where nobody has said it."""
    origin = origin_of(document)
    return [f"Origin of [0, 0]: {origin}"] if origin else []


def constraint_lines(document: PlanDocument) -> Iterator[str]:
    """The constraints; limits with the words that they came from and what keeps them."""
    limits = {limit["text"]: limit for limit in document.get("limits", ())}
    for text in document["constraints"]:
        limit = limits.get(text, {})
        notes = [f'from "{limit["words"]}"'] if "words" in limit else []
        notes += [f"kept by {limit['filter']}"] if "filter" in limit else []
        notes += [f"not checked: {limit['unchecked']}"] if "unchecked" in limit else []
        yield f"{text} ({'; '.join(notes)})" if notes else text


def task_tree(document: PlanDocument) -> Iterator[str]:
    """The lines of tasks and skills, or what is wrong with the Mission Agent's answer."""
    if "problems" in document:
        yield from _invalid("the Mission Agent's answer", document)
    elif not document["tasks"]:
        yield "no tasks"
    if document["located"]:
        places = [f"{name} at {compact_json(at)}" for name, at in document["located"].items()]
        yield f"Located: {', '.join(places)}"
    for number, task in enumerate(document["tasks"], start=1):
        yield from _task_lines(number, task)


def _task_lines(number: int, task: dict[str, Any]) -> Iterator[str]:
    yield f"{number:2d} {call(task['title'], task['parameters'])}"
    yield f"{INDENT}{task['task_prompt']}"
    if added := added_text(task):
        yield f"{INDENT}(the vehicle's: {added})"
    if doubtful := doubtful_text(task):
        yield f"{INDENT}(how sure: {doubtful})"
    if "asks" in task:
        yield f"{INDENT}(skills wait for {' and '.join(task['asks'])})"
    if "waits_for" in task:
        yield f"{INDENT}(skills wait for the position of {task['waits_for']})"
    if "problems" in task:
        yield from _invalid(f"{INDENT}the Task Agent's answer", task)
    if task.get("stale"):
        yield f"{INDENT}(the skills were planned before the task was edited)"
    for place, step in enumerate(task["skill_sequence"] or (), start=1):
        # The navigation skill, filters after "|", what gathers data after "+".
        used = step_skills(step)
        skills = [SIGNS[role] + call(skill["name"], skill["parameters"]) for role, skill in used]
        marks = [mark["kind"] for mark in task.get("added", ()) if mark["step"] == place - 1]
        kinds = "".join(f"  ({kind})" for kind in dict.fromkeys(marks) if kind != "vehicle")
        yield f"{INDENT}{place:2d}. {''.join(skills)}{kinds}"
    yield from (f"{INDENT}({note})" for note in task.get("assumptions", ()))


def call(name: str, parameters: dict[str, Any]) -> str:
    """A task or skill as it is called: "GoToXY(x=12, y=-4)"."""
    given = [f"{key}={compact_json(value)}" for key, value in parameters.items()]
    return f"{name}({', '.join(given)})"


def _use(use: dict[str, Any]) -> str:
    adapter = f"adapter {use['adapter']}" if use["adapter"] else "no adapter"
    loaded = f" (loaded in {use['load_seconds']:.1f} s)" if use["load_seconds"] else ""
    answers = f"{use['queries']} answer{'s' if use['queries'] != 1 else ''}"
    cost = f"{use['tokens']} tokens, {use['forward_passes']} forward passes, {use['seconds']:.2f} s"
    return f"{use['candidate']} {use['configuration']}, {adapter}: {answers}, {cost}{loaded}"


def _invalid(whose: str, part: dict[str, Any]) -> Iterable[str]:
    """The problems, and how the answer begins: one that is cut at the limit fills screens."""
    problems, text = part["problems"], part["output"]
    more, cut = len(problems) - SHOWN_PROBLEMS, len(text) > SHOWN_TEXT
    listed = "; ".join(problems[:SHOWN_PROBLEMS]) + (f" (and {more} more)" if more > 0 else "")
    rest = f" ... ({len(text)} characters; --json prints all)" if cut else ""
    return f"{whose} is not a valid plan: {listed}", f"{INDENT}{text[:SHOWN_TEXT]}{rest}"


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


def brief(document: Entry, path: Track, vocabulary: Vocabulary) -> Brief:
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


def _rows(document: Entry, path: Track) -> Iterator[Row]:
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


def _end(document: Entry, path: Track, vocabulary: Vocabulary) -> str:
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


def assumed(document: Entry, vocabulary: Vocabulary) -> Iterator[str]:
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
    document: Entry, known: tuple[Structure, ...], fences: tuple[Fence, ...]
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
    if missing := [str(numbers.get(name, name)) for name in document["estimate"]["open"]]:
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


def _fences(document: Entry, vocabulary: Vocabulary) -> Iterator[Fence]:
    for limit in limits_of(document, vocabulary):
        if limit["kind"] in ("fence", "keep_out_area"):
            corners = tuple((float(x), float(y)) for x, y in limit["values"]["polygon"])
            yield Fence(corners, limit["kind"] == "fence", limit["text"])
        elif limit["kind"] == "distance":
            (x, y), far = vocabulary.home, limit["values"]["distance"]
            angles = [math.radians(5 * number) for number in range(72)]
            ring = tuple((x + far * math.sin(one), y + far * math.cos(one)) for one in angles)
            yield Fence(ring, True, limit["text"])


def overview_lines(document: Entry, made: Brief) -> Iterator[str]:
    """A line per task with length, time and used endurance, and one for the whole plan."""
    width = max((len(task["title"]) for task in document["tasks"]), default=0)
    for number, (row, task) in enumerate(zip(made.rows, document["tasks"], strict=True), start=1):
        more = "" if row.known else "  and more that is not known"
        used = "" if row.used is None else f"  {100 * row.used:4.0f} %"
        sums = f"{row.length:7.0f} m  {clock(row.seconds):>8}"
        yield f"{number:3d} {task['title']:{width}} {sums}{used}{more}"
    yield f"Ends {made.end}."
