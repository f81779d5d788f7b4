"""The two plan forms: their content, key order and validity, and answers that are read as plans.

A mission plan is `{"tasks": [{"title", "parameters", "task_prompt"}], "assumptions",
"constraints"}`, a skill plan `{"skill_sequence": [{"navigation_skill", "filter_skills",
"perception_skills", "stop_conditions", "failure_modes", "expected_outputs"}]}`. `plan_problems` is
fast enough for every sample; schema.py states the same rules as JSON Schema, and a test compares.
"""

import json
import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Literal, NoReturn, get_args

from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.checks import are_names, is_text
from planner_ft.vocabulary.checks import is_number as is_number
from planner_ft.vocabulary.checks import is_position as is_position
from planner_ft.vocabulary.definition import Parameter, Skill, Task, Vocabulary

Level = Literal["mission", "task"]
LEVELS: tuple[Level, ...] = get_args(Level)

MISSION_KEYS = ("tasks", "assumptions", "constraints")
TASK_KEYS = ("title", "parameters", "task_prompt")
STEP_KEYS = (
    *("navigation_skill", "filter_skills", "perception_skills"),
    *("stop_conditions", "failure_modes", "expected_outputs"),
)
SKILL_KEYS = ("name", "parameters")
ENTRIES = ("tasks", "skill_sequence", "filter_skills", "perception_skills")
"""Keys of lists whose items are objects."""
WORKING = "working"
"""Stands before a skill sequence, with sums that the model needs; no part of the plan."""
LONGEST_INTEGER = 300  # digits of an integer that a float can still hold, with room
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
    """(name, parameters) of every well-formed task or skill of a plan, in order."""
    entries = _items(plan, list_key(level))
    key = "title" if level == "mission" else "name"
    if level == "task":
        entries = [skill for step in entries for _role, skill in step_skills(step)]
    for entry in entries:
        if isinstance(entry, dict) and isinstance(entry.get(key), str):
            parameters = entry.get("parameters")
            yield entry[key], parameters if isinstance(parameters, dict) else {}


def step_skills(step: Any) -> Iterator[tuple[str, dict[str, Any]]]:
    """(role, skill) for every skill of a step: navigation, filters, perception."""
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


def task_entry(task: dict[str, Any]) -> dict[str, Any]:
    """Title, parameters and prompt of a task alone."""
    return {key: task[key] for key in TASK_KEYS}


def without_working(text: str) -> tuple[str, str]:
    """The answer's text without the working before its skill sequence, and that working."""
    match = _WORKED.match(text)
    return ("{" + text[match.end() :], match[0].split('"')[3]) if match else (text, "")


@dataclass(frozen=True)
class Parsed:
    """An answer read as JSON: the object, or None and why the answer is not one JSON object."""

    plan: dict[str, Any] | None
    problem: str | None = None


def parse_output(output: str | dict[str, Any] | None) -> Parsed:
    """Read an answer (text, or an object already) as one JSON object, as the published metric does.

    White space and working before a skill sequence are allowed; fences, sentences, cut ends, NaN,
    Infinity, too large numbers and strings that are not UTF-8 are not.
    """
    if output is None or (isinstance(output, str) and not output.strip()):
        return Parsed(None, "empty")
    try:
        text = json.dumps(output) if isinstance(output, dict) else output
        value = json.loads(text, parse_constant=_refuse, parse_float=_float, parse_int=_int)
        if "\\u" in text:
            json.dumps(value, ensure_ascii=False).encode()
    except json.JSONDecodeError as error:
        return Parsed(None, f"not JSON ({error.msg} at character {error.pos})")
    except UnicodeEncodeError:
        return Parsed(None, "not JSON (half of a surrogate pair in a string)")
    except RecursionError:
        return Parsed(None, "not JSON (nested too deeply)")
    except ValueError as error:
        return Parsed(None, f"not JSON ({error})")
    if not isinstance(value, dict):
        return Parsed(None, "JSON, but no object")
    if "skill_sequence" in value and isinstance(value.get(WORKING), str):
        value.pop(WORKING)
    return Parsed(value)


def _refuse(constant: str) -> NoReturn:
    raise ValueError(f"{constant} is no JSON number")


def _float(text: str) -> float:
    value = float(text)
    return value if math.isfinite(value) else _refuse(text[:20])


def _int(text: str) -> int:
    return int(text) if len(text) <= LONGEST_INTEGER else _refuse(f"{text[:20]}...")


# ---------------------------------------------------------------- canonical form


def canonical_plan(level: Level, plan: dict[str, Any], vocabulary: Vocabulary) -> dict[str, Any]:
    """The plan in fixed key order, parameters as defined, whole floats as integers.

    Training targets have this form, which a grammar can produce. Missing free texts become empty,
    unknown keys are dropped.
    """
    if level == "task":
        steps = [_canonical_step(step, vocabulary) for step in plan["skill_sequence"]]
        return {"skill_sequence": steps}
    tasks = []
    for task in plan["tasks"]:
        parameters = _ordered(task, vocabulary.task.get(task["title"]))
        values = (task["title"], parameters, task.get("task_prompt", ""))
        tasks.append(dict(zip(TASK_KEYS, values, strict=True)))
    return {"tasks": tasks, **{key: list(plan.get(key, [])) for key in MISSION_KEYS[1:]}}


def canonical_parameters(parameters: dict[str, Any], owner: Task | Skill | None) -> dict[str, Any]:
    """Parameters in the order of the definition (unknown ones last), whole floats as integers."""
    known = [name for name in (owner.by_name if owner else ()) if name in parameters]
    names = dict.fromkeys((*known, *parameters))
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
        known = vocabulary.skill.get(entry["name"])
        return {"name": entry["name"], "parameters": _ordered(entry, known)}

    return {
        "navigation_skill": skill(step["navigation_skill"]),
        **{key: [skill(entry) for entry in step.get(key, [])] for key in STEP_KEYS[1:3]},
        **{key: list(step.get(key, [])) for key in STEP_KEYS[3:]},
    }


def _ordered(entry: dict[str, Any], owner: Task | Skill | None) -> dict[str, Any]:
    return canonical_parameters(entry.get("parameters", {}), owner)


def _items(value: Any, key: str) -> list[Any]:
    items = value.get(key) if isinstance(value, dict) else None
    return items if isinstance(items, list) else []


# ---------------------------------------------------------------- validity


def plan_problems(level: Level, plan: Any, vocabulary: Vocabulary, *, strict: bool) -> list[str]:
    """Problems of `plan`; empty when it is schema-valid (`strict`: strictly valid).

    Schema-valid: the structure. Strictly valid: also names, roles, parameters, types and ranges.
    """
    if not isinstance(plan, dict):
        return [f"a JSON object is expected, not {_kind(plan)}"]
    key = list_key(level)
    keys = MISSION_KEYS if level == "mission" else (key,)
    check = _task_problems if level == "mission" else _step_problems
    problems = list(_object_problems(plan, keys, "", strict, lists=keys))
    for index, entry in enumerate(_items(plan, key)):
        problems += check(entry, f"{key}[{index}]", vocabulary, strict)
    return problems


def task_problems(task: dict[str, Any], vocabulary: Vocabulary) -> list[str]:
    """What keeps one task of a mission plan from being strictly valid."""
    found = _task_problems(task_entry(task), "", vocabulary, True)
    return [problem.lstrip(".: ") for problem in found]


def _task_problems(entry: Any, where: str, vocabulary: Vocabulary, strict: bool) -> Iterator[str]:
    yield from _object_problems(entry, TASK_KEYS, where, strict, texts=("title", "task_prompt"))
    if isinstance(entry, dict):
        known = vocabulary.task.get(str(entry.get("title")))
        yield from _parameter_problems(entry, known, "title", where, strict)


def _step_problems(entry: Any, where: str, vocabulary: Vocabulary, strict: bool) -> Iterator[str]:
    yield from _object_problems(entry, STEP_KEYS, where, strict, lists=STEP_KEYS[1:])
    if isinstance(entry, dict) and "navigation_skill" in entry:
        key = "navigation_skill"
        yield from _skill_problems(entry[key], "navigation", f"{where}.{key}", vocabulary, strict)
    for role in ("filter", "perception"):
        for index, skill in enumerate(_items(entry, f"{role}_skills")):
            path = f"{where}.{role}_skills[{index}]"
            yield from _skill_problems(skill, role, path, vocabulary, strict)


def _skill_problems(
    skill: Any, role: str, where: str, vocabulary: Vocabulary, strict: bool
) -> Iterator[str]:
    yield from _object_problems(skill, SKILL_KEYS, where, strict, texts=("name",))
    if isinstance(skill, dict):
        name = skill.get("name")
        known = vocabulary.skill.get(str(name))
        if strict and known is not None and known.role != role:
            yield f"{where}: {name} cannot stand as {role} skill, only as {known.role} skill"
        yield from _parameter_problems(skill, known, "name", where, strict)


def _object_problems(
    value: Any,
    keys: tuple[str, ...],
    where: str,
    strict: bool,
    texts: Iterable[str] = (),
    lists: Iterable[str] = (),
) -> Iterator[str]:
    """Problems of an object's keys, texts and lists, which but for entries hold texts."""
    if not isinstance(value, dict):
        yield f"{where}: an object is expected, not {_kind(value)}"
        return
    prefix, path = (f"{where}: ", f"{where}.") if where else ("", "")
    yield from (f"{prefix}{key} is missing" for key in keys if key not in value)
    if strict:
        yield from (f"{prefix}unknown key {key!r}" for key in value if key not in keys)
    for key in texts:
        if key in value and not isinstance(value[key], str):
            yield f"{path}{key}: a string is expected, not {_kind(value[key])}"
    for key in lists:
        if key in value and not isinstance(value[key], list):
            yield f"{path}{key}: a list is expected, not {_kind(value[key])}"
        elif key not in ENTRIES:
            for index, item in enumerate(_items(value, key)):
                if not isinstance(item, str):
                    yield f"{path}{key}[{index}]: a string is expected, not {_kind(item)}"


def _parameter_problems(
    entry: dict[str, Any], owner: Task | Skill | None, key: str, where: str, strict: bool
) -> Iterator[str]:
    parameters, name = entry.get("parameters", {}), entry.get(key)
    if not isinstance(parameters, dict):
        yield f"{where}.parameters: an object is expected, not {_kind(parameters)}"
        return
    if not strict or (owner is None and not isinstance(name, str)):
        return
    if owner is None:
        what = "task title" if key == "title" else "skill name"
        yield f"{where}: {name!r} is no {what} of the vocabulary"
        return
    for given, value in parameters.items():
        known = owner.by_name.get(given)
        problem = value_problem(value, known) if known else f"is no parameter of {name}"
        if problem:
            yield f"{where}.parameters.{given}: {problem}"
    needed = [item.name for item in owner.parameters if item.required]
    yield from (f"{where}: {name} needs {item}" for item in needed if item not in parameters)
    if owner.require_any and not any(item in parameters for item in owner.require_any):
        yield f"{where}: {name} needs {' or '.join(owner.require_any)}"


def value_problem(value: Any, parameter: Parameter) -> str | None:
    """Why `value` is none of this parameter, or None when it is one."""
    words, holds = VALUES[parameter.type]
    if not holds(value):
        return f"{value!r} is no {words}"
    # The two bounds stand together in a definition, or neither does.
    low, high = parameter.minimum, parameter.maximum
    if low is not None and high is not None and not low <= value <= high:
        return f"{value!r} is not between {low:g} and {high:g}"
    return None


def _is_whole(value: Any) -> bool:
    return is_number(value) and value == int(value)


VALUES = {
    "number": ("number", is_number),
    "integer": ("whole number", _is_whole),
    "text": ("text", is_text),
    "id": ("identifier", lambda value: is_text(value) or _is_whole(value)),
    "texts": ("list of texts", are_names),
    "position": ("position [x, y]", is_position),
    "polygon": (
        "polygon of at least three positions",
        lambda value: isinstance(value, list) and len(value) >= 3 and all(map(is_position, value)),
    ),
}
"""Per type of parameter its name in words, and whether a value is of it."""
_KINDS = {dict: "an object", list: "a list", str: "a string", bool: "a boolean", type(None): "null"}


def _kind(value: Any) -> str:
    return _KINDS.get(type(value), "a number")
