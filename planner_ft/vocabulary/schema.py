"""JSON Schemas (Draft 2020-12) of plans, dataset records, planned commands and manifests, derived from a vocabulary.

Key order in `properties` is the order in which plans are serialised. Alternatives are `anyOf` with inline `const`
names, the form that grammar compilers for constrained decoding take.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from planner_ft.support.files import indented_json, read_text, write_json
from planner_ft.vocabulary.definition import Parameter, Skill, Task, Vocabulary
from planner_ft.vocabulary.plans import LEVELS, MISSION_KEYS, STEP_KEYS, Level

DRAFT = "https://json-schema.org/draft/2020-12/schema"
Schema = dict[str, Any]

NON_BLANK: Schema = {"type": "string", "pattern": "\\S"}
TEXTS: Schema = {"type": "array", "items": {"type": "string"}}
POSITION: Schema = {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}


def plan_schema(level: Level, vocabulary: Vocabulary, *, strict: bool) -> Schema:
    """The schema of a plan: its structure alone, or also names, roles, parameter names, types and ranges."""
    if level == "mission":
        task = {"anyOf": [_task(task) for task in vocabulary.tasks]} if strict else _structural_task()
        properties: dict[str, Schema] = {"tasks": {"type": "array", "items": task}, **dict.fromkeys(MISSION_KEYS[1:], TEXTS)}
    else:
        properties = {"skill_sequence": {"type": "array", "items": _step(vocabulary, strict)}}
    return {
        "$schema": DRAFT,
        "title": f"{level} plan of the {vocabulary.title}, {'strict' if strict else 'structure only'}",
        **_object(properties, strict=strict),
    }


def record_schema(vocabulary: Vocabulary) -> Schema:
    """The schema of a dataset record of either level; `expected` may hold names and parameters alone."""
    task = _named("title", [task.title for task in vocabulary.tasks])
    skill = _named("name", [skill.name for skill in vocabulary.skills])
    step: Schema = {
        "type": "object",
        "properties": {"navigation_skill": skill, "filter_skills": {"type": "array", "items": skill}, "perception_skills": {"type": "array", "items": skill}},
        "required": ["navigation_skill"],
    }
    bound: Schema = {"type": "integer", "minimum": 0}
    span = _object({"element": {"enum": list(ELEMENTS)}, "start": bound, "end": bound, "text": {"type": "string"}}, strict=True)
    common = {"id": NON_BLANK, "family": NON_BLANK, "prompt": NON_BLANK, "spans": {"type": "array", "items": span}, "tags": TEXTS}
    mission = {"type": "object", "properties": {"tasks": {"type": "array", "items": task}}, "required": ["tasks"]}
    sequence = {"type": "object", "properties": {"skill_sequence": {"type": "array", "items": step}}, "required": ["skill_sequence"]}
    of_task = {"task": {"enum": [task.title for task in vocabulary.tasks]}, "parameters": {"type": "object"}}
    return {
        "$schema": DRAFT,
        "title": f"dataset record of the {vocabulary.title}",
        "anyOf": [
            {"type": "object", "properties": {**common, "expected": mission}, "required": ["id", "prompt", "expected"]},
            {"type": "object", "properties": {**common, **of_task, "expected": sequence}, "required": ["id", "prompt", "task", "parameters", "expected"]},
        ],
    }


def _named(key: str, names: list[str]) -> Schema:
    return {"type": "object", "properties": {key: {"enum": names}, "parameters": {"type": "object"}}, "required": [key]}


ELEMENTS = ("objective", "target", "sensor", "constraint")
"""The elements of a well-formed command: objective, target or location, sensor and data, operational constraint."""


def manifest_schema() -> Schema:
    """The schema of a run manifest."""
    digest = {"type": "string", "pattern": "^[0-9a-f]{64}$"}
    return {
        "$schema": DRAFT,
        "title": "run manifest",
        "type": "object",
        "properties": {
            "kind": {"type": "string"},
            "planner_ft": {"type": "string"},
            "created": {"type": "string", "format": "date-time"},
            "seed": {"type": ["integer", "null"]},
            "configuration": {"type": "object"},
            "inputs": {"type": "object", "additionalProperties": _object({"path": {"type": "string"}, "sha256": digest}, strict=True)},
            "outputs": {"type": "object", "additionalProperties": digest},
            "versions": {"type": "object", "additionalProperties": {"type": ["string", "null"]}, "required": ["python"]},
            "commit": {"type": ["string", "null"]},
            "dirty": {"type": ["boolean", "null"]},
            "hardware": {"type": "object"},
            "command": {"type": "string"},
        },
        "required": ["kind", "planner_ft", "created", "seed", "configuration", "inputs", "versions", "commit", "dirty", "hardware", "command"],
    }


def planned_schema(vocabulary: Vocabulary) -> Schema:
    """The schema of what `plannerft plan --json` prints: a command, its tasks with their skills, and what they cost."""
    count: Schema = {"type": "integer", "minimum": 0}
    seconds: Schema = {"type": "number", "minimum": 0}
    problems = {"problems": TEXTS, "output": {"type": "string"}}
    place = _object({"name": NON_BLANK, "tasks": {"type": "array", "items": {"type": "integer", "minimum": 1}, "minItems": 1}}, strict=True)
    use = _object(
        {
            "candidate": NON_BLANK, "configuration": NON_BLANK, "adapter": {"type": ["string", "null"]}, "load_seconds": seconds,
            "queries": count, "prompt_tokens": count, "tokens": count, "forward_passes": count, "seconds": seconds,
        },
        strict=True,
    )  # fmt: skip
    properties: dict[str, Schema] = {
        "command": NON_BLANK, "valid": {"type": "boolean"}, "complete": {"type": "boolean"},
        "tasks": {"type": "array", "items": {"anyOf": [_planned_task(task, problems) for task in vocabulary.tasks]}},
        "assumptions": TEXTS, "constraints": TEXTS, "open_places": {"type": "array", "items": place},
        "located": {"type": "object", "additionalProperties": POSITION}, **problems,
        "usage": _object({"mission": use, "task": use}, strict=True, required=["mission"]), "peak_memory_bytes": count,
        "manifest": {key: value for key, value in manifest_schema().items() if key != "$schema"},
    }  # fmt: skip
    schema = _object(properties, strict=True, required=[name for name in properties if name not in problems])
    title = f"planned command of the {vocabulary.title}"
    return {"$schema": DRAFT, "title": title, **schema, "$defs": {"step": _step(vocabulary, strict=True)}}


def _planned_task(task: Task, problems: dict[str, Schema]) -> Schema:
    sequence = {"anyOf": [{"type": "null"}, {"type": "array", "items": {"$ref": "#/$defs/step"}}]}
    always = {"title": {"const": task.title}, "parameters": _parameters(task), "task_prompt": {"type": "string"}, "skill_sequence": sequence}
    return _object({**always, "waits_for": NON_BLANK, "assumptions": TEXTS, **problems}, strict=True, required=list(always))


def all_schemas(vocabulary: Vocabulary) -> dict[str, Schema]:
    """Every schema by file name."""
    plans = [(level, strict) for level in LEVELS for strict in (False, True)]
    schemas = {f"{level}.{'strict.' if strict else ''}schema.json": plan_schema(level, vocabulary, strict=strict) for level, strict in plans}
    others = {"record": record_schema(vocabulary), "planned": planned_schema(vocabulary), "manifest": manifest_schema()}
    return {**schemas, **{f"{name}.schema.json": schema for name, schema in others.items()}}


def write_schemas(folder: Path, vocabulary: Vocabulary) -> list[Path]:
    """Write every schema into `folder`; return the files."""
    paths = []
    for name, schema in all_schemas(vocabulary).items():
        write_json(folder / name, schema)
        paths.append(folder / name)
    return paths


def stale_schemas(folder: Path, vocabulary: Vocabulary) -> list[str]:
    """Names of the schema files in `folder` that are missing or differ from what the vocabulary gives."""
    return [name for name, schema in all_schemas(vocabulary).items() if not (folder / name).is_file() or read_text(folder / name) != indented_json(schema)]


def parameter_schema(parameter: Parameter) -> Schema:
    """The schema of one parameter's value."""
    if parameter.type in ("number", "integer"):
        bounds = {"minimum": parameter.minimum, "maximum": parameter.maximum}
        return {"type": parameter.type, **{key: value for key, value in bounds.items() if value is not None}}
    if parameter.type == "id":
        return {"anyOf": [NON_BLANK, {"type": "integer"}]}
    if parameter.type == "texts":
        return {"type": "array", "items": NON_BLANK}
    if parameter.type == "polygon":
        return {"type": "array", "items": POSITION, "minItems": 3}
    return POSITION if parameter.type == "position" else NON_BLANK


def _object(properties: dict[str, Schema], *, strict: bool, required: list[str] | None = None) -> Schema:
    schema: Schema = {"type": "object", "properties": properties, "required": list(properties) if required is None else required}
    if strict:
        schema["additionalProperties"] = False
    return schema


def _structural_task() -> Schema:
    return _object({"title": {"type": "string"}, "parameters": {"type": "object"}, "task_prompt": {"type": "string"}}, strict=False)


def _task(task: Task) -> Schema:
    return _object({"title": {"const": task.title}, "parameters": _parameters(task), "task_prompt": {"type": "string"}}, strict=True)


def _skill(skill: Skill) -> Schema:
    return _object({"name": {"const": skill.name}, "parameters": _parameters(skill)}, strict=True)


def _parameters(owner: Task | Skill) -> Schema:
    schema = _object(
        {parameter.name: parameter_schema(parameter) for parameter in owner.parameters},
        strict=True,
        required=[parameter.name for parameter in owner.parameters if parameter.required],
    )
    if owner.require_any:
        schema["anyOf"] = [{"required": [name]} for name in owner.require_any]
    return schema


def _step(vocabulary: Vocabulary, strict: bool) -> Schema:
    if strict:
        of_role = {role: {"anyOf": [_skill(skill) for skill in vocabulary.skills_in_role(role)]} for role in ("navigation", "filter", "perception")}
    else:
        anything = _object({"name": {"type": "string"}, "parameters": {"type": "object"}}, strict=False)
        of_role = dict.fromkeys(("navigation", "filter", "perception"), anything)
    skills: dict[str, Schema] = {
        "navigation_skill": of_role["navigation"],
        "filter_skills": {"type": "array", "items": of_role["filter"]},
        "perception_skills": {"type": "array", "items": of_role["perception"]},
    }
    return _object({**skills, **dict.fromkeys(STEP_KEYS[3:], TEXTS)}, strict=strict)
