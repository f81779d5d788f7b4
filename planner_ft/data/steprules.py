"""The labelling rules that a program can check, for the skill sequence of a task.

A value is written only where the prompt states it or refers to a task parameter. Waypoints are
computed, and so are turns in equal steps; they are not checked here.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from typing import Any

from planner_ft.facts import Input, missing_words, read_input, words
from planner_ft.vocabulary import Parameter, Vocabulary
from planner_ft.vocabulary.plans import step_skills, value_problem

TURNS = ("turn_to", "turn_by")


def step_problems(record: dict[str, Any], vocabulary: Vocabulary) -> Iterator[str]:
    """What breaks a labelling rule in the expected skill sequence of a task record; invalid values
    are passed over.
    """
    expected, prompt = record["expected"], str(record["prompt"])
    parameters = record.get("parameters")
    given = list(parameters.values()) if isinstance(parameters, dict) else []
    source = read_input(record, vocabulary)
    steps = expected.get("skill_sequence")
    often = Counter(
        entry.get("name")
        for step in (steps if isinstance(steps, list) else [])
        for role, entry in step_skills(step)
        if role == "navigation"
    )
    for index, step in enumerate(steps if isinstance(steps, list) else []):
        said: list[Any] = []
        for _role, entry in step_skills(step):
            skill = vocabulary.skill.get(str(entry.get("name")))
            if skill is None or not isinstance(entry.get("parameters", {}), dict):
                continue
            if entry in said:
                yield (
                    f"skill_sequence[{index}] {skill.name}: stands twice in the step with the same"
                    " parameters"
                )
            said.append(entry)
            for name, value in entry.get("parameters", {}).items():
                parameter = skill.by_name.get(name)
                if (
                    skill.motion == "goto"
                    or (skill.motion in TURNS and often[skill.name] > 2)
                    or parameter is None
                    or value_problem(value, parameter)
                ):
                    continue
                yield from (
                    f"skill_sequence[{index}] {skill.name}, {name}: {problem}"
                    for problem in _value_problem(
                        value, parameter, source, " ".join([prompt, *map(str, given)])
                    )
                )


def _value_problem(value: Any, parameter: Parameter, source: Input, said: str) -> Iterator[str]:
    if parameter.type in ("number", "integer"):
        # Turning left is a negative angle, and the prompt says it without the sign.
        found = [source.evidence(number, parameter).given for number in (value, -value)]
        if found == [False, False]:
            yield (
                f"{value!r}{f' {parameter.unit}' if parameter.unit else ''} follows neither from"
                " the prompt nor from a task parameter"
            )
    elif parameter.type in ("text", "id", "texts"):
        for text in value if isinstance(value, list) else [str(value)]:
            missing = missing_words(said, text, misspelt=True)
            if missing:
                yield (
                    f"{', '.join(map(repr, missing))} of {text!r} neither in the prompt nor in a"
                    " task parameter"
                )
            if words(text)[:1] in (["the"], ["a"], ["an"]) or re.search(r"^\s|[\s.,;:!?]$", text):
                yield (
                    f"{text!r} begins with an article, or ends or begins with a blank or"
                    " punctuation"
                )
