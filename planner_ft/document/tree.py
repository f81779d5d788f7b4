"""A plan document as a tree that a person can read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from planner_ft.document.files import PlanDocument
from planner_ft.support.files import compact_json
from planner_ft.support.resources import memory_size
from planner_ft.vocabulary.plans import step_skills

INDENT = "   "
SHOWN_PROBLEMS, SHOWN_TEXT = 5, 400
"""Problems and characters of an answer that is not valid."""


def plan_tree(document: PlanDocument) -> str:
    """The plan, what it takes for granted, what is open and what it cost, one line each. Control
    characters are spelt out.
    """
    return "\n".join(map(plain, _lines(document)))


def _lines(document: PlanDocument) -> Iterator[str]:
    yield document["command"]
    yield from task_tree(document)
    yield from _list_lines("Assumptions", document["assumptions"])
    yield from _list_lines("Constraints", document["constraints"])
    open_places = [
        f"{place['name']}: task{'s' if len(place['tasks']) > 1 else ''} {_numbers(place['tasks'])}"
        for place in document["open_places"]
    ]
    yield from _list_lines('Open places (fill in with --locate "NAME=x,y")', open_places)
    yield from _list_lines("Warnings", [warning["text"] for warning in document["warnings"]])
    yield ""
    for agent, use in document["usage"].items():
        yield f"{agent.capitalize()} Agent  {_use(use)}"
    yield f"peak memory {memory_size(document['peak_memory_bytes'])}"


def task_tree(document: PlanDocument) -> Iterator[str]:
    """The lines of the tasks with their skills, or what is wrong with the Mission Agent's
    answer.
    """
    if "problems" in document:
        yield from _invalid(
            "the Mission Agent's answer is not a valid plan",
            document["problems"],
            document["output"],
        )
    elif not document["tasks"]:
        yield "no tasks"
    if document["located"]:
        yield (
            "Located:"
            f" {', '.join(f'{name} at {compact_json(position)}' for name, position in document['located'].items())}"
        )
    for number, task in enumerate(document["tasks"], start=1):
        yield from _task_lines(number, task)


def _task_lines(number: int, task: dict[str, Any]) -> Iterator[str]:
    yield f"{number:2d} {call(task['title'], task['parameters'])}"
    yield f"{INDENT}{task['task_prompt']}"
    if "waits_for" in task:
        yield f"{INDENT}(skills wait for the position of {task['waits_for']})"
    if "problems" in task:
        yield from _invalid(
            f"{INDENT}the Task Agent's answer is not a valid plan", task["problems"], task["output"]
        )
    if task.get("stale"):
        yield f"{INDENT}(the skills were planned before the task was edited)"
    for place, step in enumerate(task["skill_sequence"] or (), start=1):
        yield f"{INDENT}{place:2d}. {_step(step)}"
    yield from (f"{INDENT}({note})" for note in task.get("assumptions", ()))


def _step(step: dict[str, Any]) -> str:
    """The navigation skill, filters after "|", what gathers data after "+"."""
    signs = {"navigation": "", "filter": " | ", "perception": " + "}
    return "".join(
        signs[role] + call(skill["name"], skill["parameters"]) for role, skill in step_skills(step)
    )


def call(name: str, parameters: dict[str, Any]) -> str:
    """A task or skill as it is called: "GoToXY(x=12, y=-4)"."""
    return (
        f"{name}({', '.join(f'{key}={compact_json(value)}' for key, value in parameters.items())})"
    )


def _list_lines(heading: str, items: Iterable[str]) -> Iterator[str]:
    told = list(items)
    if told:
        yield f"{heading}:"
        yield from (f" - {item}" for item in told)


def _use(use: dict[str, Any]) -> str:
    adapter = f"adapter {use['adapter']}" if use["adapter"] else "no adapter"
    loaded = f" (loaded in {use['load_seconds']:.1f} s)" if use["load_seconds"] else ""
    did = (
        f"{use['queries']} answer{'s' if use['queries'] != 1 else ''}, {use['tokens']} tokens,"
        f" {use['forward_passes']} forward passes, {use['seconds']:.2f} s"
    )
    return f"{use['candidate']} {use['configuration']}, {adapter}: {did}{loaded}"


def plain(line: str) -> str:
    """The line with control characters (a command may bring some) as escapes, so that none reaches
    a terminal.
    """
    return "".join(char if char.isprintable() else repr(char)[1:-1] for char in line)


def _numbers(numbers: Iterable[int]) -> str:
    return ", ".join(str(number) for number in numbers)


def _invalid(what: str, problems: Iterable[str], text: str) -> Iterator[str]:
    """What is wrong, and how the answer begins: one that is cut at the limit fills screens."""
    listed = list(problems)
    more = f" (and {len(listed) - SHOWN_PROBLEMS} more)" if len(listed) > SHOWN_PROBLEMS else ""
    yield f"{what}: {'; '.join(listed[:SHOWN_PROBLEMS])}{more}"
    yield (
        f"{INDENT}{text[:SHOWN_TEXT]}{f' ... ({len(text)} characters; --json prints all)' if len(text) > SHOWN_TEXT else ''}"
    )
