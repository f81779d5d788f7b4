"""JSON Schemas (Draft 2020-12) of plans, dataset records and manifests, derived from a vocabulary.

Key order in `properties` is the order in which plans are serialised. Alternatives are `anyOf` with
inline `const` names, the form that grammar compilers for constrained decoding take.
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
    """The schema of a plan: its structure alone, or also names, roles, parameter names, types and
    ranges.
    """
    if level == "mission":
        task = (
            {"anyOf": [_task(task) for task in vocabulary.tasks]} if strict else _structural_task()
        )
        properties: dict[str, Schema] = {
            "tasks": {"type": "array", "items": task},
            **dict.fromkeys(MISSION_KEYS[1:], TEXTS),
        }
    else:
        properties = {"skill_sequence": {"type": "array", "items": step_schema(vocabulary, strict)}}
    return {
        "$schema": DRAFT,
        "title": (
            f"{level} plan of the {vocabulary.title}, {'strict' if strict else 'structure only'}"
        ),
        **object_schema(properties, strict=strict),
    }


def record_schema(vocabulary: Vocabulary) -> Schema:
    """The schema of a dataset record of either level; `expected` may hold names and parameters
    alone.
    """
    task = _named("title", [task.title for task in vocabulary.tasks])
    skill = _named("name", [skill.name for skill in vocabulary.skills])
    step: Schema = {
        "type": "object",
        "properties": {
            "navigation_skill": skill,
            "filter_skills": {"type": "array", "items": skill},
            "perception_skills": {"type": "array", "items": skill},
        },
        "required": ["navigation_skill"],
    }
    bound: Schema = {"type": "integer", "minimum": 0}
    span = object_schema(
        {
            "element": {"enum": list(ELEMENTS)},
            "start": bound,
            "end": bound,
            "text": {"type": "string"},
        },
        strict=True,
    )
    common = {
        "id": NON_BLANK,
        "family": NON_BLANK,
        "prompt": NON_BLANK,
        "spans": {"type": "array", "items": span},
        "tags": TEXTS,
    }
    mission = {
        "type": "object",
        "properties": {"tasks": {"type": "array", "items": task}},
        "required": ["tasks"],
    }
    sequence = {
        "type": "object",
        "properties": {"skill_sequence": {"type": "array", "items": step}},
        "required": ["skill_sequence"],
    }
    of_task = {
        "task": {"enum": [task.title for task in vocabulary.tasks]},
        "parameters": {"type": "object"},
    }
    return {
        "$schema": DRAFT,
        "title": f"dataset record of the {vocabulary.title}",
        "anyOf": [
            {
                "type": "object",
                "properties": {**common, "expected": mission},
                "required": ["id", "prompt", "expected"],
            },
            {
                "type": "object",
                "properties": {**common, **of_task, "expected": sequence},
                "required": ["id", "prompt", "task", "parameters", "expected"],
            },
        ],
    }


def _named(key: str, names: list[str]) -> Schema:
    return {
        "type": "object",
        "properties": {key: {"enum": names}, "parameters": {"type": "object"}},
        "required": [key],
    }


ELEMENTS = ("objective", "target", "sensor", "constraint")
"""The elements of a well-formed command: objective, target or location, sensor and data,
operational constraint.
"""


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
            "inputs": {
                "type": "object",
                "additionalProperties": object_schema(
                    {"path": {"type": "string"}, "sha256": digest}, strict=True
                ),
            },
            "outputs": {"type": "object", "additionalProperties": digest},
            "versions": {
                "type": "object",
                "additionalProperties": {"type": ["string", "null"]},
                "required": ["python"],
            },
            "commit": {"type": ["string", "null"]},
            "dirty": {"type": ["boolean", "null"]},
            "hardware": {"type": "object"},
            "command": {"type": "string"},
        },
        "required": [
            "kind",
            "planner_ft",
            "created",
            "seed",
            "configuration",
            "inputs",
            "versions",
            "commit",
            "dirty",
            "hardware",
            "command",
        ],
    }


def all_schemas(vocabulary: Vocabulary) -> dict[str, Schema]:
    """Every schema by file name."""
    from planner_ft.vocabulary.document_schema import document_schema

    plans = [(level, strict) for level in LEVELS for strict in (False, True)]
    schemas = {
        f"{level}.{'strict.' if strict else ''}schema.json": plan_schema(
            level, vocabulary, strict=strict
        )
        for level, strict in plans
    }
    others = {
        "record": record_schema(vocabulary),
        "plan": document_schema(vocabulary),
        "manifest": manifest_schema(),
    }
    return {**schemas, **{f"{name}.schema.json": schema for name, schema in others.items()}}


def write_schemas(folder: Path, vocabulary: Vocabulary) -> list[Path]:
    """Write every schema into `folder`; return the files."""
    paths = []
    for name, schema in all_schemas(vocabulary).items():
        write_json(folder / name, schema)
        paths.append(folder / name)
    return paths


def stale_schemas(folder: Path, vocabulary: Vocabulary) -> list[str]:
    """Names of the schema files in `folder` that are missing or differ from what the vocabulary
    gives.
    """
    return [
        name
        for name, schema in all_schemas(vocabulary).items()
        if not (folder / name).is_file() or read_text(folder / name) != indented_json(schema)
    ]


def parameter_schema(parameter: Parameter) -> Schema:
    """The schema of one parameter's value."""
    if parameter.type in ("number", "integer"):
        bounds = {"minimum": parameter.minimum, "maximum": parameter.maximum}
        return {
            "type": parameter.type,
            **{key: value for key, value in bounds.items() if value is not None},
        }
    if parameter.type == "id":
        return {"anyOf": [NON_BLANK, {"type": "integer"}]}
    if parameter.type == "texts":
        return {"type": "array", "items": NON_BLANK}
    if parameter.type == "polygon":
        return {"type": "array", "items": POSITION, "minItems": 3}
    return POSITION if parameter.type == "position" else NON_BLANK


def object_schema(
    properties: dict[str, Schema], *, strict: bool, required: list[str] | None = None
) -> Schema:
    """The schema of an object with these properties; all of them are required unless `required`
    says which.
    """
    schema: Schema = {
        "type": "object",
        "properties": properties,
        "required": list(properties) if required is None else required,
    }
    if strict:
        schema["additionalProperties"] = False
    return schema


def _structural_task() -> Schema:
    return object_schema(
        {
            "title": {"type": "string"},
            "parameters": {"type": "object"},
            "task_prompt": {"type": "string"},
        },
        strict=False,
    )


def _task(task: Task) -> Schema:
    return object_schema(
        {
            "title": {"const": task.title},
            "parameters": parameters_schema(task),
            "task_prompt": {"type": "string"},
        },
        strict=True,
    )


def _skill(skill: Skill) -> Schema:
    return object_schema(
        {"name": {"const": skill.name}, "parameters": parameters_schema(skill)}, strict=True
    )


def parameters_schema(owner: Task | Skill) -> Schema:
    """The schema of the parameters of a task or a skill."""
    schema = object_schema(
        {parameter.name: parameter_schema(parameter) for parameter in owner.parameters},
        strict=True,
        required=[parameter.name for parameter in owner.parameters if parameter.required],
    )
    if owner.require_any:
        schema["anyOf"] = [{"required": [name]} for name in owner.require_any]
    return schema


def step_schema(vocabulary: Vocabulary, strict: bool) -> Schema:
    """The schema of one step of a skill sequence."""
    if strict:
        of_role = {
            role: {"anyOf": [_skill(skill) for skill in vocabulary.skills_in_role(role)]}
            for role in ("navigation", "filter", "perception")
        }
    else:
        anything = object_schema(
            {"name": {"type": "string"}, "parameters": {"type": "object"}}, strict=False
        )
        of_role = dict.fromkeys(("navigation", "filter", "perception"), anything)
    skills: dict[str, Schema] = {
        "navigation_skill": of_role["navigation"],
        "filter_skills": {"type": "array", "items": of_role["filter"]},
        "perception_skills": {"type": "array", "items": of_role["perception"]},
    }
    return object_schema({**skills, **dict.fromkeys(STEP_KEYS[3:], TEXTS)}, strict=strict)
