"""Everything wrong with a parsed definition and the files beside it, in words."""

from __future__ import annotations

import functools
import itertools
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.support.files import read_json, read_toml

if TYPE_CHECKING:
    from planner_ft.vocabulary.definition import Parameter, Skill, Task, Vocabulary

Entry = Mapping[str, Any]  # an object of a plan, of a document, of a parsed file


@functools.cache
def _keys() -> dict[str, Any]:
    """What may stand where (shapes/definition.toml)."""
    return read_toml(Path(__file__).parent / "shapes" / "definition.toml")


def is_number(value: Any) -> bool:
    """Whether a JSON value is a finite number that a float holds, and no boolean."""
    number = isinstance(value, int | float) and not isinstance(value, bool)
    return number and abs(value) <= sys.float_info.max


def is_position(value: Any) -> bool:
    """Whether a JSON value is a position [x, y]."""
    return isinstance(value, list) and len(value) == 2 and all(map(is_number, value))


def is_text(value: Any) -> bool:
    """Whether a JSON value is a text that is not blank."""
    return isinstance(value, str) and bool(value.strip())


def is_name(value: Any) -> bool:
    """Whether a JSON value is such a text in one line, without blanks at its ends."""
    return is_text(value) and value == value.strip() and value.isprintable()


def are_names(value: Any) -> bool:
    """Whether a JSON value is a list of such texts."""
    return isinstance(value, list) and all(map(is_text, value))


def _are_tables(value: Any) -> bool:
    entries = value.values() if isinstance(value, dict) else value
    return isinstance(value, dict | list) and all(isinstance(entry, dict) for entry in entries)


KINDS: dict[str, tuple[str, Callable[[Any], bool]]] = {
    "text": ("a text", is_text),
    "name": ("a text in one line, without blanks at its ends", is_name),
    "flag": ("true or false", lambda value: isinstance(value, bool)),
    "number": ("a number", is_number),
    "position": ("a position [x, y]", is_position),
    "names": ("a list of names", are_names),
}
"""Per kind of value its name in words, and whether a value is of it."""
NESTED = {"task": ("parameters", "skills"), "skill": ("parameters",)}
"""Keys that hold tables themselves."""
LISTS = ("gives", "needs", "yields")  # of a task in the logic file


# ---------------------------------------------------------------- the shape of a definition


def shape_problems(raw: Entry, phrases: Entry) -> Iterator[str]:
    """Problems of keys and kinds of values in definition and phrases; names are not looked up."""
    yield from (f"unknown key {key!r}" for key in raw if key not in ("vehicle", *NESTED))
    vehicle = raw.get("vehicle")
    if isinstance(vehicle, dict):
        problems = list(_table(vehicle, "vehicle", "[vehicle]"))
        yield from problems
        if not problems and vehicle["home"] == vehicle["unresolved"]:
            yield "[vehicle]: home and unresolved are the same position"
    else:
        yield "a table [vehicle] is needed"
    yield from _entries(raw, "task", "title")
    yield from _entries(raw, "skill", "name")
    for kind in NESTED:
        if not isinstance(known := phrases.get(kind, {}), dict) or not _are_tables(known):
            yield f"the phrase file needs tables [{kind}.NAME]"


def _table(table: Entry, kind: str, where: str) -> Iterator[str]:
    """Problems of keys and values of a table, without its subtables."""
    needed = _keys()[kind]["needed"]
    known = {**needed, **_keys()[kind].get("optional", {})}
    missing = [name for name in needed if name not in table]
    if missing:
        yield f"{where}: lacks {', '.join(missing)}"
    for name, value in table.items():
        if name in NESTED.get(kind, ()):
            continue
        choices = known.get(name)
        if choices is None:
            yield f"{where}: unknown key {name!r}"
        elif isinstance(choices, list) and value not in choices:
            yield f"{where}: {name} = {value!r} must be one of {', '.join(choices)}"
        elif isinstance(choices, str) and not KINDS[choices][1](value):
            yield f"{where}: {name} = {value!r} must be {KINDS[choices][0]}"


def _entries(raw: Entry, kind: str, key: str) -> Iterator[str]:
    entries = raw.get(kind)
    if not isinstance(entries, list) or not entries or not _are_tables(entries):
        yield f"at least one [[{kind}]] is needed"
        return
    for number, entry in enumerate(entries, 1):
        where = f"{kind} {entry.get(key, number)}"
        yield from _table(entry, kind, where)
        yield from _parameters(entry.get("parameters", []), where)
        if kind == "task":
            yield from _fitting_skills(entry.get("skills"), where)


def _parameters(parameters: Any, where: str) -> Iterator[str]:
    if not isinstance(parameters, list) or not _are_tables(parameters):
        yield f"{where}: parameters must be a list of tables"
        return
    names = [str(parameter.get("name")) for parameter in parameters]
    yield from (f"{where}: parameter {name} is defined twice" for name in _repeated(names))
    for name, parameter in zip(names, parameters, strict=True):
        here = f"{where}, parameter {name}"
        problems = list(_table(parameter, "parameter", here))
        yield from problems
        bounds = [parameter[bound] for bound in ("minimum", "maximum") if bound in parameter]
        if problems or not bounds:
            continue
        if parameter["type"] not in ("number", "integer"):
            yield f"{here}: only numbers have a minimum and a maximum"
        elif len(bounds) == 1 or bounds[0] > bounds[1]:
            yield f"{here}: minimum and maximum stand together, the smaller one first"


def _fitting_skills(skills: Any, where: str) -> Iterator[str]:
    if not isinstance(skills, dict):
        yield f"{where}: skills must be a table of lists by role"
        return
    roles = _keys()["skill"]["needed"]["role"]
    for role, names in skills.items():
        if role not in roles:
            yield f"{where}: skills.{role} is none of {', '.join(roles)}"
        elif not are_names(names):
            yield f"{where}: skills.{role} must be a list of names"
    if not skills.get("navigation"):
        yield f"{where}: needs at least one navigation skill"


def _repeated(names: Iterable[str]) -> list[str]:
    return sorted(name for name, count in Counter(names).items() if count > 1)


def reference_problems(vocabulary: Vocabulary) -> Iterator[str]:
    """Names that are defined twice or not at all."""
    names = {
        "task": [task.title for task in vocabulary.tasks],
        "skill": [skill.name for skill in vocabulary.skills],
    }
    for kind, known in names.items():
        yield from (f"{kind} {name} is defined twice" for name in _repeated(known))
    for key in ("transit", "locate"):
        if getattr(vocabulary, key) not in vocabulary.task:
            yield f"[vehicle] {key} = {getattr(vocabulary, key)!r} is no task"
    transit = vocabulary.task.get(vocabulary.transit)
    if transit and transit.position_parameter is None:
        needs = "brings the vehicle to a place and needs a parameter of type position"
        yield f"task {transit.title}: {needs}"
    owners: list[Task | Skill] = [*vocabulary.tasks, *vocabulary.skills]
    for name, owner in zip(itertools.chain(*names.values()), owners, strict=True):
        kind = "task" if hasattr(owner, "title") else "skill"
        for needed in owner.require_any:
            if needed not in owner.by_name:
                yield f"{kind} {name}: require_any names {needed!r}, which is no parameter"
    for task in vocabulary.tasks:
        for role, name in ((role, name) for role, fit in task.skills.items() for name in fit):
            skill = vocabulary.skill.get(name)
            if skill is None:
                yield f"task {task.title}: skill {name!r} is not defined"
            elif skill.role != role:
                yield f"task {task.title}: skill {name!r} has the role {skill.role}, not {role}"
    for kind, known in names.items():
        for name in sorted(set(vocabulary.phrases.get(kind, {})) - set(known)):
            yield f"the phrase file has phrases for {kind} {name!r}, which is not defined"


# ---------------------------------------------------------------- the files beside a definition


def shape_of_file(raw: Entry, ending: str) -> str | None:
    """What is wrong with the shape of NAME + `ending` (shapes/beside.schema.json)."""
    if (validator := _shapes().get(ending)) is None:
        return None
    from jsonschema.exceptions import best_match

    found = best_match(validator.iter_errors(raw))
    return found and f"{found.json_path.removeprefix('$.')}: {found.message[:200]}"


@functools.cache
def _shapes() -> dict[str, Any]:
    """The validator of each kind of file beside a definition, by its ending."""
    import jsonschema

    schema = read_json(Path(__file__).parent / "shapes" / "beside.schema.json")
    made = jsonschema.Draft202012Validator
    return {
        one: made({"$ref": f"#/$defs/{one}", "$defs": schema["$defs"]}) for one in schema["$defs"]
    }


def logic_problems(raw: Entry, tasks: Mapping[str, Task]) -> Iterator[str]:
    """Problems of a parsed logic file, for a vocabulary with these tasks by title."""
    facts, entries = raw.get("fact", {}), raw.get("task", {})
    here = "the logic file"
    yield from (f"{here} has an unknown key {key!r}" for key in raw.keys() - {"fact", "task"})
    if not all(isinstance(one, dict) and _are_tables(one) for one in (facts, entries)):
        yield f"{here} needs tables [fact.NAME] and [task.TITLE]"
        return
    for name, fact in facts.items():
        if set(fact) != {"lacking"} or not is_text(fact["lacking"]):
            yield f"{here}: fact {name} must have a text lacking, and nothing else"
    for title, entry in entries.items():
        where = f"{here}: task {title}"
        if title not in tasks:
            yield f"{where}: it is not defined"
            continue
        for key, value in entry.items():
            if key == "sends":
                yield from _names_parameter(where, key, value, tasks[title].by_name, "texts")
            elif key not in LISTS:
                yield f"{where}: unknown key {key!r}"
            elif not are_names(value):
                yield f"{where}: {key} = {value!r} must be a list of names"
            elif key != "yields":
                for name in value:
                    if name not in facts:
                        yield f"{where}: {key} names the fact {name!r}, which is not declared"
    lists = (entry.get("gives") for entry in entries.values())
    given = [name for names in lists if isinstance(names, list) for name in names]
    yield from (f"{here}: no task gives the fact {name!r}" for name in facts if name not in given)


def motion_problems(
    raw: Entry, tasks: Mapping[str, Task], skills: Mapping[str, Skill]
) -> Iterator[str]:
    """Problems of a parsed motion file, for a vocabulary with these tasks and skills by name."""
    here = "the motion file"
    yield from (f"{here} has an unknown key {key!r}" for key in raw.keys() - {"skill", "task"})
    for kind in ("skill", "task"):
        if not isinstance(own := raw.get(kind, {}), dict) or not _are_tables(own):
            yield f"{here} needs tables [{kind}.NAME]"
            return
    for name, entry in raw.get("skill", {}).items():
        yield from _motion(entry, skills.get(name), f"{here}: skill {name}")
    for title, entry in raw.get("task", {}).items():
        where = f"{here}: task {title}"
        if title not in tasks:
            yield f"{where}: it is not defined"
        else:
            keys, known = _keys()["standoff"], tasks[title].by_name
            alone = {*keys["alone"]}
            if entry and entry.keys() <= alone:
                keys = {**keys, "needed": []}  # names no circle
            yield from _roles(entry, keys, known, where, "a stand-off")
            ring = {role: name for role, name in entry.items() if role not in alone}
            yield from _units(ring, known, where)


def _motion(entry: Entry, skill: Skill | None, where: str) -> Iterator[str]:
    kinds, kind = _keys()["motion"], entry.get("motion")
    if skill is None:
        yield f"{where}: it is not defined"
    elif not isinstance(kind, str) or kind not in kinds:
        yield f"{where}: motion = {kind!r} must be one of {', '.join(kinds)}"
    else:
        if (skill.role == "filter") != kinds[kind].get("filter", False):
            yield f"{where}: motion = {kind!r} does not fit the role {skill.role}"
        roles = {role: name for role, name in entry.items() if role != "motion"}
        yield from _roles(roles, kinds[kind], skill.by_name, where, kind)
        own = {*kinds[kind].get("needed", ()), *kinds[kind].get("optional", ())}
        yield from _units({one: roles[one] for one in own & {*roles}}, skill.by_name, where)


def _roles(
    entry: Entry, keys: Entry, parameters: Mapping[str, Parameter], where: str, owner: str
) -> Iterator[str]:
    """Problems of {role: name of a parameter}."""
    needed, optional = keys.get("needed", []), keys.get("optional", [])
    missing = [role for role in needed if role not in entry]
    yield from (f"{where}: {owner} needs {role} = the name of a parameter" for role in missing)
    for role, name in entry.items():
        if role not in (*needed, *optional):
            yield f"{where}: unknown key {role!r}"
        else:
            kind = {"polygon": "polygon", "center": "position"}.get(role, "number")
            yield from _names_parameter(where, role, name, parameters, kind)


def _units(entry: Entry, parameters: Mapping[str, Parameter], where: str) -> Iterator[str]:
    """Parameters of movements in other units than those that movements are drawn and flown in."""
    for unit, roles in _keys()["units"].items():
        for role in roles:
            found = parameters.get(entry[role]) if isinstance(entry.get(role), str) else None
            if found and found.unit not in (None, unit, *_keys()["spellings"][unit]):
                way = f"movements are in {unit}: define it, its bounds and its templates so"
                yield f"{where}: {role} = {found.name!r} is in {found.unit}, and {way}"


def _names_parameter(
    where: str, key: str, name: Any, parameters: Mapping[str, Parameter], kind: str
) -> Iterator[str]:
    parameter = parameters.get(name) if isinstance(name, str) else None
    if parameter is None or parameter.type != kind:
        yield f"{where}: {key} = {name!r} must name a parameter of type {kind}"
