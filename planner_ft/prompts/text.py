"""What the two agents are told, in words: system instruction and user message."""

from __future__ import annotations

from typing import Any

from planner_ft.data.task.working import working_of
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import WORKING, Level, canonical_parameters, canonical_plan
from planner_ft.vocabulary.text import prompt_text

INSTRUCTIONS: dict[Level, str] = {
    "mission": (
        "You are the Mission Agent of an {vehicle}. Turn the command into a mission plan as JSON."
    ),
    "task": "You are the Task Agent of an {vehicle}. Turn the task into a skill sequence as JSON.",
}

FORMS: dict[Level, str] = {
    "mission": (
        "Answer with one JSON object and nothing"
        ' else:\n{{"tasks":[{{"title":"...","parameters":{{...}},"task_prompt":"..."}}],"assumptions":["..."],"constraints":["..."]}}\ntasks'
        " stand in the order of execution. task_prompt says in one or two sentences what the task"
        " is to do. Positions are in the {frame}; home is {home}. A place without known coordinates"
        " is {unresolved}. Lengths are in metres, durations in seconds, angles in degrees. Write"
        " only parameters that the command states.\nThese tasks exist, and no others:\n{vocabulary}"
    ),
    "task": (
        "Answer with one JSON object and nothing"
        ' else:\n{{"skill_sequence":[{{"navigation_skill":{{"name":"...","parameters":{{...}}}},"filter_skills":[],"perception_skills":[],"stop_conditions":["..."],"failure_modes":["..."],"expected_outputs":["..."]}}]}}\nSteps'
        " stand in the order of execution; the skills of one step run at the same time. Positions"
        " are in the {frame}. Write only parameters that the task states.\nThese skills exist, and"
        " no others:\n{vocabulary}"
    ),
}

PLAIN_FORM = "{system}\n\n### Input\n{user}\n\n### Plan\n"
"""The prompt of a model without a chat template."""


def system_text(level: Level, vocabulary: Vocabulary, *, with_vocabulary: bool) -> str:
    """The instruction of an agent; base models are also told the answer's form and the
    vocabulary.
    """
    instruction = INSTRUCTIONS[level].format(vehicle=vocabulary.title)
    if not with_vocabulary:
        return instruction
    form = FORMS[level].format(
        frame=vocabulary.frame,
        home=list(vocabulary.home),
        unresolved=list(vocabulary.unresolved),
        vocabulary=prompt_text(level, vocabulary),
    )
    return f"{instruction}\n{form}"


def user_text(level: Level, record: dict[str, Any], vocabulary: Vocabulary) -> str:
    """What the agent gets: the command, or a task's title, parameters and task prompt on three
    lines.
    """
    if level == "mission":
        return str(record["prompt"])
    parameters = canonical_parameters(
        record.get("parameters", {}), vocabulary.task.get(record["task"])
    )
    return f"{record['task']}\n{compact_json(parameters)}\n{record['prompt']}"


def completion_text(level: Level, plan: dict[str, Any], vocabulary: Vocabulary) -> str:
    """The canonical plan as compact JSON."""
    return compact_json(canonical_plan(level, plan, vocabulary))


def answer_text(level: Level, record: dict[str, Any], vocabulary: Vocabulary) -> str:
    """The answer that is trained: the record's `expected` plan, behind the sums that its waypoints
    need (see `planner_ft.data.task.working`).
    """
    text = completion_text(level, record["expected"], vocabulary)
    working = working_of(record, vocabulary) if level == "task" else ""
    return f"{{{compact_json(WORKING)}:{compact_json(working)},{text[1:]}" if working else text
