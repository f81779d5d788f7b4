"""The shape of a definition file: which keys stand where, with values of which kind."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any, Literal, get_args

Role = Literal["navigation", "filter", "perception"]
ParameterType = Literal["position", "polygon", "number", "integer", "text", "id", "texts"]
Arrival = Literal["transit", "self", "none"]
Motion = Literal["goto", "hold", "turn_to", "turn_by", "arc", "drift", "visual", "wait"]
ROLES: tuple[Role, ...] = get_args(Role)

Check = Callable[[Any], str | None]
"""What a value should have been, or None when it is that."""


def _text(value: Any) -> str | None:
    return None if isinstance(value, str) and value.strip() else "a text"


def _flag(value: Any) -> str | None:
    return None if isinstance(value, bool) else "true or false"


def _number(value: Any) -> str | None:
    return (
        None
        if isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
        else "a number"
    )


def _position(value: Any) -> str | None:
    return (
        None
        if isinstance(value, list) and len(value) == 2 and not any(map(_number, value))
        else "a position [x, y]"
    )


def _names(value: Any) -> str | None:
    return None if isinstance(value, list) and not any(map(_text, value)) else "a list of names"


def _one_of(*choices: str) -> Check:
    return lambda value: None if value in choices else f"one of {', '.join(choices)}"


Keys = Mapping[str, Check]
VEHICLE: Keys = {
    "name": _text,
    "title": _text,
    "frame": _text,
    "home": _position,
    "unresolved": _position,
    "transit": _text,
    "locate": _text,
}
PARAMETER: Keys = {
    "name": _text,
    "type": _one_of(*get_args(ParameterType)),
    "unit": _text,
    "required": _flag,
    "minimum": _number,
    "maximum": _number,
    "description": _text,
}
TASK: Keys = {
    "title": _text,
    "category": _text,
    "description": _text,
    "arrival": _one_of(*get_args(Arrival)),
    "pattern": _text,
    "leaves": _flag,
    "require_any": _names,
}
SKILL: Keys = {
    "name": _text,
    "category": _text,
    "role": _one_of(*ROLES),
    "description": _text,
    "motion": _one_of(*get_args(Motion)),
    "require_any": _names,
    "stop": _text,
    "failure": _text,
    "output": _text,
}
NEEDED = {
    "task": ("title", "category", "description", "arrival", "pattern", "skills"),
    "skill": ("name", "category", "role", "description"),
}


def shape_problems(raw: Mapping[str, Any], phrases: Mapping[str, Any]) -> list[str]:
    """Everything wrong with the shape of a parsed definition and of its phrase file; names are not
    looked up.
    """
    problems = [f"unknown key {key!r}" for key in raw if key not in ("vehicle", "task", "skill")]
    vehicle = raw.get("vehicle")
    if isinstance(vehicle, dict):
        problems += _keys(vehicle, VEHICLE, tuple(VEHICLE), "[vehicle]")
        if not problems and vehicle["home"] == vehicle["unresolved"]:
            problems.append("[vehicle]: home and unresolved are the same position")
    else:
        problems.append("a table [vehicle] is needed")
    problems += _entries(raw, "task", "title", TASK)
    problems += _entries(raw, "skill", "name", SKILL)
    for kind in ("task", "skill"):
        if not isinstance(phrases.get(kind, {}), dict) or not all(
            isinstance(entry, dict) for entry in phrases.get(kind, {}).values()
        ):
            problems.append(f"the phrase file needs tables [{kind}.NAME]")
    return problems


def _entries(raw: Mapping[str, Any], kind: str, key: str, keys: Keys) -> Iterator[str]:
    entries = raw.get(kind)
    if (
        not isinstance(entries, list)
        or not entries
        or not all(isinstance(entry, dict) for entry in entries)
    ):
        yield f"at least one [[{kind}]] is needed"
        return
    for number, entry in enumerate(entries, 1):
        where = f"{kind} {entry.get(key, number)}"
        more = ("parameters", "skills") if kind == "task" else ("parameters",)
        yield from _keys(
            {name: value for name, value in entry.items() if name not in more},
            keys,
            tuple(set(NEEDED[kind]) - set(more)),
            where,
        )
        yield from _parameters(entry.get("parameters", []), where)
        if kind == "task":
            yield from _skills(entry.get("skills"), where)


def _keys(
    table: Mapping[str, Any], keys: Keys, needed: tuple[str, ...], where: str
) -> Iterator[str]:
    missing = [name for name in keys if name in needed and name not in table]
    if missing:
        yield f"{where}: lacks {', '.join(missing)}"
    for name, value in table.items():
        wanted = keys[name](value) if name in keys else None
        if name not in keys:
            yield f"{where}: unknown key {name!r}"
        elif wanted:
            yield f"{where}: {name} = {value!r} must be {wanted}"


def _parameters(parameters: Any, where: str) -> Iterator[str]:
    if not isinstance(parameters, list) or not all(
        isinstance(parameter, dict) for parameter in parameters
    ):
        yield f"{where}: parameters must be a list of tables"
        return
    names = [str(parameter.get("name")) for parameter in parameters]
    yield from (
        f"{where}: parameter {name} is defined twice"
        for name in sorted({name for name in names if names.count(name) > 1})
    )
    for name, parameter in zip(names, parameters, strict=True):
        here = f"{where}, parameter {name}"
        problems = list(_keys(parameter, PARAMETER, ("name", "type"), here))
        yield from problems
        bounds = [parameter[bound] for bound in ("minimum", "maximum") if bound in parameter]
        if problems or not bounds:
            continue
        if parameter["type"] not in ("number", "integer"):
            yield f"{here}: only numbers have a minimum and a maximum"
        elif len(bounds) == 1 or bounds[0] > bounds[1]:
            yield f"{here}: minimum and maximum stand together, the smaller one first"


def _skills(skills: Any, where: str) -> Iterator[str]:
    if not isinstance(skills, dict):
        yield f"{where}: skills must be a table of lists by role"
        return
    for role, names in skills.items():
        if role not in ROLES:
            yield f"{where}: skills.{role} is none of {', '.join(ROLES)}"
        elif _names(names):
            yield f"{where}: skills.{role} must be a list of names"
    if not skills.get("navigation"):
        yield f"{where}: needs at least one navigation skill"
