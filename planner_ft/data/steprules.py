"""The labelling rules that a program can check, for the skill sequence of a task.

A value is written only where the prompt states it or refers to a task parameter. Waypoints are
computed, and so are turns in equal steps; they are not checked here.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import Any

from planner_ft.data.rules import unstated
from planner_ft.facts import read_input
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import step_skills, value_problem

TURNS = ("turn_to", "turn_by")


def step_problems(record: dict[str, Any], vocabulary: Vocabulary) -> Iterator[str]:
    """What breaks a labelling rule in the expected skill sequence of a task record; invalid values
    are passed over.
    """
    parameters = record.get("parameters")
    given = parameters.values() if isinstance(parameters, dict) else ()
    said = " ".join([str(record["prompt"]), *map(str, given)])
    source = read_input(record, vocabulary)
    sequence = record["expected"].get("skill_sequence")
    steps = [list(step_skills(step)) for step in (sequence if isinstance(sequence, list) else ())]
    moves = (entry for step in steps for role, entry in step if role == "navigation")
    often = Counter(str(entry.get("name")) for entry in moves)
    for index, step in enumerate(steps):
        entries = [entry for _role, entry in step]
        for place, entry in enumerate(entries):
            skill = vocabulary.skill.get(str(entry.get("name")))
            values = entry.get("parameters", {})
            if skill is None or not isinstance(values, dict):
                continue
            where = f"skill_sequence[{index}] {skill.name}"
            if entry in entries[:place]:
                yield f"{where}: stands twice in the step with the same parameters"
            computed = skill.motion in TURNS and often[skill.name] > 2
            for name, value in values.items() if skill.motion != "goto" and not computed else ():
                parameter = skill.by_name.get(name)
                if parameter is not None and not value_problem(value, parameter):
                    found = unstated(
                        value, parameter, source, said, "the prompt or a task parameter"
                    )
                    yield from (f"{where}, {name}: {problem}" for problem in found)
