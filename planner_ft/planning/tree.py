"""A plan as a tree that a person can read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from planner_ft.planning.result import AgentUse, Planned, PlannedTask
from planner_ft.support.files import compact_json
from planner_ft.support.resources import memory_size
from planner_ft.vocabulary.plans import step_skills

INDENT = "   "
SHOWN_PROBLEMS, SHOWN_TEXT = 5, 400
"""Problems and characters of an answer that is not valid."""


def plan_tree(planned: Planned) -> str:
    """The plan, what it takes for granted, what is open and what it cost, one line each. Control characters are spelt out."""
    return "\n".join(map(_plain, _lines(planned)))


def _lines(planned: Planned) -> Iterator[str]:
    yield planned.command
    if planned.mission.plan is None:
        yield from _invalid("the Mission Agent's answer is not a valid plan", planned.mission.problems, planned.mission.text)
    elif not planned.tasks:
        yield "no tasks"
    if planned.located:
        yield f"Located: {', '.join(f'{name} at {compact_json(position)}' for name, position in planned.located.items())}"
    for number, task in enumerate(planned.tasks, start=1):
        yield from _task_lines(number, task)
    plan = planned.mission.plan or {}
    yield from _list_lines("Assumptions", [*plan.get("assumptions", []), *planned.mission.notes])
    yield from _list_lines("Constraints", plan.get("constraints", []))
    open_places = [f"{place.name}: task{'s' if len(place.tasks) > 1 else ''} {_numbers(place.tasks)}" for place in planned.open_places]
    yield from _list_lines('Open places (fill in with --locate "NAME=x,y")', open_places)
    yield ""
    for agent, use in planned.usage.items():
        yield f"{agent.capitalize()} Agent  {_use(use)}"
    yield f"peak memory {memory_size(planned.peak_memory)}"


def _task_lines(number: int, task: PlannedTask) -> Iterator[str]:
    yield f"{number:2d} {call(task.title, task.parameters)}"
    yield f"{INDENT}{task.task_prompt}"
    if task.waits_for is not None:
        yield f"{INDENT}(skills wait for the position of {task.waits_for})"
    elif task.answer is None:
        return
    elif task.answer.plan is None:
        yield from _invalid(f"{INDENT}the Task Agent's answer is not a valid plan", task.answer.problems, task.answer.text)
    else:
        for place, step in enumerate(task.answer.plan["skill_sequence"], start=1):
            yield f"{INDENT}{place:2d}. {_step(step)}"
        yield from (f"{INDENT}({note})" for note in task.answer.notes)


def _step(step: dict[str, Any]) -> str:
    """The navigation skill, filters after "|", what gathers data after "+"."""
    signs = {"navigation": "", "filter": " | ", "perception": " + "}
    return "".join(signs[role] + call(skill["name"], skill["parameters"]) for role, skill in step_skills(step))


def call(name: str, parameters: dict[str, Any]) -> str:
    """A task or skill as it is called: "GoToXY(x=12, y=-4)"."""
    return f"{name}({', '.join(f'{key}={compact_json(value)}' for key, value in parameters.items())})"


def _list_lines(heading: str, items: Iterable[str]) -> Iterator[str]:
    told = list(items)
    if told:
        yield f"{heading}:"
        yield from (f" - {item}" for item in told)


def _use(use: AgentUse) -> str:
    adapter = f"adapter {use.adapter}" if use.adapter else "no adapter"
    loaded = f" (loaded in {use.load_seconds:.1f} s)" if use.load_seconds else ""
    did = f"{use.queries} answer{'s' if use.queries != 1 else ''}, {use.tokens} tokens, {use.forward_passes} forward passes, {use.seconds:.2f} s"
    return f"{use.candidate} {use.configuration}, {adapter}: {did}{loaded}"


def _plain(line: str) -> str:
    """The line with control characters (a command may bring some) as escapes, so that none reaches a terminal."""
    return "".join(char if char.isprintable() else repr(char)[1:-1] for char in line)


def _numbers(numbers: Iterable[int]) -> str:
    return ", ".join(str(number) for number in numbers)


def _invalid(what: str, problems: Iterable[str], text: str) -> Iterator[str]:
    """What is wrong, and how the answer begins: one that is cut at the limit fills screens."""
    listed = list(problems)
    more = f" (and {len(listed) - SHOWN_PROBLEMS} more)" if len(listed) > SHOWN_PROBLEMS else ""
    yield f"{what}: {'; '.join(listed[:SHOWN_PROBLEMS])}{more}"
    yield f"{INDENT}{text[:SHOWN_TEXT]}{f' ... ({len(text)} characters; --json prints all)' if len(text) > SHOWN_TEXT else ''}"
