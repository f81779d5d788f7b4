"""The two plan forms: what stands in them, in which order, and what makes one valid.

A mission plan is `{"tasks": [{"title", "parameters", "task_prompt"}], "assumptions",
"constraints"}`, a skill plan `{"skill_sequence": [{"navigation_skill", "filter_skills",
"perception_skills", "stop_conditions", "failure_modes", "expected_outputs"}]}`. `plan_problems`
says what is wrong with one in words and is fast enough for every sample that the sampler writes;
schema.py states the same rules as JSON Schema, and a test holds the two together.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from typing import Any, Literal, get_args

from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.definition import Parameter, Skill, Task, Vocabulary

Level = Literal["mission", "task"]
LEVELS: tuple[Level, ...] = get_args(Level)

MISSION_KEYS = ("tasks", "assumptions", "constraints")
TASK_KEYS = ("title", "parameters", "task_prompt")
STEP_KEYS = (
    "navigation_skill",
    "filter_skills",
    "perception_skills",
    "stop_conditions",
    "failure_modes",
    "expected_outputs",
)
SKILL_KEYS = ("name", "parameters")
WORKING = "working"
"""Stands before a skill sequence where a model writes sums down before it needs their results. No
part of the plan.
"""
_WORKED = re.compile(rf'\s*\{{"{WORKING}":"[^"\\]*",(?="skill_sequence")')


def check_level(level: str) -> Level:
    """`level` itself. Raises PlannerError when it is neither mission nor task."""
    for known in LEVELS:
        if level == known:
            return known
    raise PlannerError(f"--level {level}: must be {' or '.join(LEVELS)}")


def list_key(level: Level) -> str:
    """The key under which a plan of this level keeps its entries."""
    return "tasks" if level == "mission" else "skill_sequence"


def named_entries(level: Level, plan: Any) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield (name, parameters) of every task or skill of a plan in order; entries of another form
    are passed over.
    """
    for entry in _items(plan, list_key(level)):
        if level == "mission":
            if isinstance(entry, dict) and isinstance(entry.get("title"), str):
                yield entry["title"], _object(entry, "parameters")
            continue
        for _role, skill in step_skills(entry):
            if isinstance(skill.get("name"), str):
                yield skill["name"], _object(skill, "parameters")


def step_skills(step: Any) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield (role, skill) for every skill of a step: the navigation skill, then filters, then
    perception skills.
    """
    if not isinstance(step, dict):
        return
    if isinstance(step.get("navigation_skill"), dict):
        yield "navigation", step["navigation_skill"]
    for role in ("filter", "perception"):
        for skill in _items(step, f"{role}_skills"):
            if isinstance(skill, dict):
                yield role, skill


def plan_names(level: Level, plan: Any) -> list[str]:
    """Task titles or skill names of a plan in order, repetitions kept."""
    return [name for name, _parameters in named_entries(level, plan)]


def canonical_plan(level: Level, plan: dict[str, Any], vocabulary: Vocabulary) -> dict[str, Any]:
    """The plan with its keys in the fixed order, parameters in the order of the definition and
    whole floats as integers.

    Training targets are serialised from this form, so that a grammar with fixed key order can
    produce every one of them. Missing free-text fields become empty; keys that the form does not
    know are dropped.
    """
    if level == "mission":
        return {
            "tasks": [
                {
                    "title": task["title"],
                    "parameters": _ordered(task, vocabulary.task.get(task["title"])),
                    "task_prompt": task.get("task_prompt", ""),
                }
                for task in plan["tasks"]
            ],
            "assumptions": list(plan.get("assumptions", [])),
            "constraints": list(plan.get("constraints", [])),
        }
    return {
        "skill_sequence": [_canonical_step(step, vocabulary) for step in plan["skill_sequence"]]
    }


def without_working(text: str) -> tuple[str, str]:
    """The text of an answer without the working before its skill sequence, and that working; no
    other text is changed.
    """
    match = _WORKED.match(text)
    return ("{" + text[match.end() :], match[0].split('"')[3]) if match else (text, "")


def canonical_parameters(parameters: dict[str, Any], owner: Task | Skill | None) -> dict[str, Any]:
    """Parameters in the order of the definition (unknown ones last), whole floats as integers."""
    order = list(owner.by_name) if owner else []
    names = [name for name in order if name in parameters] + [
        name for name in parameters if name not in order
    ]
    return {name: canonical_value(parameters[name]) for name in names}


def canonical_value(value: Any) -> Any:
    """A value with whole floats as integers, at any depth."""
    if isinstance(value, float) and value.is_integer():
        return int(value)
    if isinstance(value, list | tuple):
        return [canonical_value(item) for item in value]
    return value


def _canonical_step(step: dict[str, Any], vocabulary: Vocabulary) -> dict[str, Any]:
    def skill(entry: dict[str, Any]) -> dict[str, Any]:
        return {
            "name": entry["name"],
            "parameters": _ordered(entry, vocabulary.skill.get(entry["name"])),
        }

    return {
        "navigation_skill": skill(step["navigation_skill"]),
        "filter_skills": [skill(entry) for entry in step.get("filter_skills", [])],
        "perception_skills": [skill(entry) for entry in step.get("perception_skills", [])],
        **{key: list(step.get(key, [])) for key in STEP_KEYS[3:]},
    }


def _ordered(entry: dict[str, Any], owner: Task | Skill | None) -> dict[str, Any]:
    return canonical_parameters(entry.get("parameters", {}), owner)


def _items(value: Any, key: str) -> list[Any]:
    items = value.get(key) if isinstance(value, dict) else None
    return items if isinstance(items, list) else []


def _object(value: dict[str, Any], key: str) -> dict[str, Any]:
    item = value.get(key)
    return item if isinstance(item, dict) else {}


# ---------------------------------------------------------------- validity


def plan_problems(level: Level, plan: Any, vocabulary: Vocabulary, *, strict: bool) -> list[str]:
    """What keeps `plan` from being schema-valid, or strictly valid; empty when it is valid.

    Schema-valid: the structure alone, names are any strings. Strictly valid: also every name is in
    the vocabulary, every skill stands in its role, and every parameter has a known name, the right
    type and a value in range.
    """
    problems: list[str] = []
    if not isinstance(plan, dict):
        return [f"a JSON object is expected, not {_kind(plan)}"]
    if level == "mission":
        _check_keys(plan, MISSION_KEYS, "", strict, problems)
        _check_texts(plan, MISSION_KEYS[1:], "", problems)
        for index, task in enumerate(_list(plan, "tasks", "", problems)):
            _check_task(task, f"tasks[{index}]", vocabulary, strict, problems)
    else:
        _check_keys(plan, ("skill_sequence",), "", strict, problems)
        for index, step in enumerate(_list(plan, "skill_sequence", "", problems)):
            _check_step(step, f"skill_sequence[{index}]", vocabulary, strict, problems)
    return problems


def _check_task(
    task: Any, where: str, vocabulary: Vocabulary, strict: bool, problems: list[str]
) -> None:
    if not isinstance(task, dict):
        problems.append(f"{where}: an object is expected, not {_kind(task)}")
        return
    _check_keys(task, TASK_KEYS, where, strict, problems)
    for key in ("title", "task_prompt"):
        if key in task and not isinstance(task[key], str):
            problems.append(f"{where}.{key}: a string is expected, not {_kind(task[key])}")
    _check_parameters(
        task,
        vocabulary.task.get(str(task.get("title"))),
        task.get("title"),
        "task title",
        where,
        strict,
        problems,
    )


def _check_step(
    step: Any, where: str, vocabulary: Vocabulary, strict: bool, problems: list[str]
) -> None:
    if not isinstance(step, dict):
        problems.append(f"{where}: an object is expected, not {_kind(step)}")
        return
    _check_keys(step, STEP_KEYS, where, strict, problems)
    _check_texts(step, STEP_KEYS[3:], where, problems)
    if "navigation_skill" in step:
        _check_skill(
            step["navigation_skill"],
            "navigation",
            f"{where}.navigation_skill",
            vocabulary,
            strict,
            problems,
        )
    for role in ("filter", "perception"):
        for index, skill in enumerate(_list(step, f"{role}_skills", where, problems)):
            _check_skill(
                skill, role, f"{where}.{role}_skills[{index}]", vocabulary, strict, problems
            )


def _check_skill(
    skill: Any, role: str, where: str, vocabulary: Vocabulary, strict: bool, problems: list[str]
) -> None:
    if not isinstance(skill, dict):
        problems.append(f"{where}: an object is expected, not {_kind(skill)}")
        return
    _check_keys(skill, SKILL_KEYS, where, strict, problems)
    name = skill.get("name")
    if "name" in skill and not isinstance(name, str):
        problems.append(f"{where}.name: a string is expected, not {_kind(name)}")
    known = vocabulary.skill.get(str(name))
    if strict and known is not None and known.role != role:
        problems.append(f"{where}: {name} cannot stand as {role} skill, only as {known.role} skill")
    _check_parameters(skill, known, name, "skill name", where, strict, problems)


def _check_parameters(
    entry: dict[str, Any],
    owner: Task | Skill | None,
    name: Any,
    what: str,
    where: str,
    strict: bool,
    problems: list[str],
) -> None:
    parameters = entry.get("parameters", {})
    if not isinstance(parameters, dict):
        problems.append(f"{where}.parameters: an object is expected, not {_kind(parameters)}")
        return
    if not strict:
        return
    if owner is None:
        if isinstance(name, str):
            problems.append(f"{where}: {name!r} is no {what} of the vocabulary")
        return
    for key, value in parameters.items():
        parameter = owner.by_name.get(key)
        problem = (
            f"is no parameter of {name}" if parameter is None else value_problem(value, parameter)
        )
        if problem:
            problems.append(f"{where}.parameters.{key}: {problem}")
    problems.extend(
        f"{where}: {name} needs {parameter.name}"
        for parameter in owner.parameters
        if parameter.required and parameter.name not in parameters
    )
    if owner.require_any and not any(key in parameters for key in owner.require_any):
        problems.append(f"{where}: {name} needs {' or '.join(owner.require_any)}")


def value_problem(value: Any, parameter: Parameter) -> str | None:
    """Why `value` is none of this parameter, or None when it is one."""
    kind = parameter.type
    if kind in ("number", "integer"):
        if not _is_number(value) or (kind == "integer" and value != int(value)):
            return f"{value!r} is no {'whole number' if kind == 'integer' else 'number'}"
        # The two bounds stand together in a definition, or neither does.
        if (
            parameter.minimum is not None
            and parameter.maximum is not None
            and not parameter.minimum <= value <= parameter.maximum
        ):
            return f"{value!r} is not between {parameter.minimum:g} and {parameter.maximum:g}"
    elif kind == "text" and not _is_text(value):
        return f"{value!r} is no text"
    elif kind == "id" and not (_is_text(value) or (_is_number(value) and value == int(value))):
        return f"{value!r} is no identifier"
    elif kind == "texts" and not (
        isinstance(value, list) and all(_is_text(item) for item in value)
    ):
        return f"{value!r} is no list of texts"
    elif kind == "position" and not _is_position(value):
        return f"{value!r} is no position [x, y]"
    elif kind == "polygon" and not (
        isinstance(value, list) and len(value) >= 3 and all(_is_position(item) for item in value)
    ):
        return f"{value!r} is no polygon of at least three positions"
    return None


def _is_number(value: Any) -> bool:
    # False for NaN and infinity, and for whole numbers too large to be calculated with.
    return (
        isinstance(value, int | float)
        and not isinstance(value, bool)
        and abs(value) <= sys.float_info.max
    )


def _is_text(value: Any) -> bool:
    return isinstance(value, str) and bool(value.strip())


def _is_position(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 2 and all(_is_number(item) for item in value)


def _check_keys(
    value: dict[str, Any], keys: tuple[str, ...], where: str, strict: bool, problems: list[str]
) -> None:
    prefix = f"{where}: " if where else ""
    problems.extend(f"{prefix}{key} is missing" for key in keys if key not in value)
    if strict:
        problems.extend(f"{prefix}unknown key {key!r}" for key in value if key not in keys)


def _check_texts(
    value: dict[str, Any], keys: tuple[str, ...], where: str, problems: list[str]
) -> None:
    for key in keys:
        for index, item in enumerate(_list(value, key, where, problems)):
            if not isinstance(item, str):
                problems.append(
                    f"{where}.{key}[{index}]: a string is expected, not {_kind(item)}".lstrip(".")
                )


def _list(value: dict[str, Any], key: str, where: str, problems: list[str]) -> list[Any]:
    if key not in value:
        return []
    if not isinstance(value[key], list):
        problems.append(f"{where}.{key}: a list is expected, not {_kind(value[key])}".lstrip("."))
        return []
    items: list[Any] = value[key]
    return items


def _kind(value: Any) -> str:
    return {
        dict: "an object",
        list: "a list",
        str: "a string",
        bool: "a boolean",
        int: "a number",
        float: "a number",
        type(None): "null",
    }[type(value)]
