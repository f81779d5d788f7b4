"""How sure the agents are of what they proposed, in a document: three levels for readers, with the
probability behind each, and questions for the least sure choices.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.confidence.calibration import Judgement, sureness
from planner_ft.planning.result import Doubt, Planned, PlannedTask
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary

Entry = dict[str, Any]
LEVELS = ("unsure", "check", "sure")  # the least sure first
LETTERS = "abc"


def held(probability: float) -> Entry:
    """A level with its probability."""
    return {"level": sureness(probability), "probability": round(probability, 4)}


def plan_confidence(planned: Planned) -> Entry:
    """How sure the agents are of the whole plan: that all their answers are right, as if each were
    wrong for itself; or the `reason` why that is not known.
    """
    answers = [("Mission", planned.mission)]
    answers += [("Task", task.answer) for task in planned.tasks if task.answer]
    for agent, answer in answers:
        if reason := answer.judged.reason:
            return {"reason": f"{agent} Agent: {reason}"}
    return held(math.prod(answer.judged.parts[()] for _agent, answer in answers))


def task_confidence(number: int, task: PlannedTask, mission: Judgement) -> dict[str, Any]:
    """How sure the agents are of a task (from 1), of each of its values, the title among them, and
    of its skills; empty where nothing is known.
    """
    path, found = ("tasks", number - 1), dict[str, Any]()
    if path in mission.parts:
        values = {
            str(one[-1]): held(probability)
            for one, probability in mission.parts.items()
            if one[:2] == path
            and len(one) > 2
            and (one[-1] == "title" or one[-1] in task.parameters)
        }
        found = {"task": held(mission.parts[path]), "values": values}
    return found | (skills_confidence(task.answer.judged) if task.answer else {})


def skills_confidence(judged: Judgement) -> dict[str, Any]:
    """How sure the Task Agent is of a skill sequence."""
    return {"skills": held(judged.parts[()])} if () in judged.parts else {}


def choices(doubts: tuple[Doubt, ...]) -> list[Entry]:
    """The choices that the Mission Agent proposed without being sure of them."""
    return [
        {"task": f"t{doubt.task + 1}", "parameter": doubt.name, "value": doubt.value}
        | {"others": list(doubt.others)}
        for doubt in doubts
    ]


def open_choices(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Entry]:
    """The proposed choices that stand as they were proposed, each with its question as `text`."""
    tasks = {task["id"]: (number, task) for number, task in enumerate(document["tasks"], start=1)}
    for choice in document["proposed"].get("choices", ()):
        number, task = tasks.get(choice["task"], (0, {}))
        name, value = choice["parameter"], choice["value"]
        now = task.get("title") if name is None else task.get("parameters", {}).get(name)
        if now == value:
            yield {**choice, "text": _question(number, task, choice, vocabulary)}


def _question(number: int, task: Mapping[str, Any], choice: Entry, vocabulary: Vocabulary) -> str:
    title, name, unknown = task["title"], choice["parameter"], list(vocabulary.unresolved)
    unit = vocabulary.task[title].by_name[name].unit if name else None
    written = [
        "not known yet" if one == unknown else in_unit(one, unit)
        for one in (choice["value"], *choice["others"])
    ]
    about = f", {title}: {name}" if name else ":"
    return f"Task {number}{about} {', '.join(written[:-1])} or {written[-1]}?"


def in_unit(value: Any, unit: str | None = None) -> str:
    """A value of a plan as sentences have it: "12 m"."""
    text = value if isinstance(value, str) else compact_json(value)
    return text if unit in (None, "count") else f"{text} {unit}"


def kept_confidence(task: Mapping[str, Any], proposed: Mapping[str, Any]) -> dict[str, Any]:
    """What still holds of a task's confidence: nothing is said of what an operator changed."""
    found = dict(task.get("confidence", {}))
    now, before = ({"title": one["title"], **one["parameters"]} for one in (task, proposed))
    if "values" in found:
        same = {name for name in found["values"] if now.get(name) == before.get(name)}
        found["values"] = {name: one for name, one in found["values"].items() if name in same}
        if now != before:
            found.pop("task", None)
    if task.get("stale"):
        found.pop("skills", None)
    return {name: one for name, one in found.items() if one}


def confidence_lines(document: Mapping[str, Any]) -> Iterator[str]:
    """How sure the agents were of the plan; nothing of a document that does not say."""
    found = document.get("confidence")
    if found is None:
        return
    if "reason" in found:
        yield f"How sure: not known ({found['reason']})"
        return
    doubtful = [
        f"task {number} {level}"
        for number, task in enumerate(document["tasks"], start=1)
        if (level := least_sure(task)) in LEVELS[:2]
    ]
    yield f"How sure: {found['level']}" + (f" ({', '.join(doubtful)})" if doubtful else "")


def least_sure(task: Mapping[str, Any]) -> str | None:
    """The lowest level of a task, of its values and of its skills; None where none is known."""
    found = task.get("confidence", {})
    levels = [one["level"] for name in ("task", "skills") if (one := found.get(name))]
    levels += [one["level"] for one in found.get("values", {}).values()]
    return min(levels, key=LEVELS.index, default=None)


def doubtful_text(task: Mapping[str, Any]) -> str:
    """What the agents are not sure of in a task: "unsure: radius unsure, skills check"."""
    found = task.get("confidence", {})
    named = {**found.get("values", {}), **{key: found[key] for key in ("skills",) if key in found}}
    listed = [f"{name} {one['level']}" for name, one in named.items() if one["level"] != "sure"]
    whole = found.get("task", {}).get("level", "sure")
    return ": ".join(filter(None, (whole * (whole != "sure"), ", ".join(listed))))


def choice_lines(document: Mapping[str, Any]) -> Iterator[str]:
    """The questions, each alternative with what is typed in the review for it."""
    for number, choice in enumerate(document.get("choices", ()), start=1):
        keys = zip(LETTERS, choice["others"], strict=False)
        typed = ", ".join(f"{number}{letter} for {in_unit(value)}" for letter, value in keys)
        yield f"{choice['text']} ({typed})"
