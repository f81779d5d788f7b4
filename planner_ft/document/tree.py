"""A plan document as a tree that a person can read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from planner_ft.document.build import PlanDocument
from planner_ft.document.confidence import choice_lines, confidence_lines, doubtful_text
from planner_ft.planning.essentials import added_text
from planner_ft.planning.frame import origin_of
from planner_ft.support.files import compact_json
from planner_ft.support.resources import memory_size
from planner_ft.support.terminal import plain
from planner_ft.vocabulary.plans import step_skills

INDENT = "   "
LANGUAGE = "unknown-language"
CHOICES = "What is meant? (type the number and letter in the review)"
SHOWN_PROBLEMS, SHOWN_TEXT = 5, 400
"""Problems and characters of an answer that is not valid."""
SIGNS = {"navigation": "", "filter": " | ", "perception": " + "}


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
