"""JSON Schemas (Draft 2020-12) of plans, records and manifests, derived from a vocabulary;
the vocabulary as text, for the prompt of base models and as a page of the documentation.

`properties` are in the order of serialisation. Alternatives are `anyOf` with inline `const` names,
the form that grammar compilers take.
"""

import functools
import json
from pathlib import Path
from typing import Any

from planner_ft.support.files import indented_json, read_text, write_json
from planner_ft.vocabulary.definition import ROLES, Parameter, Role, Skill, Task, Vocabulary
from planner_ft.vocabulary.essentials import load_essentials
from planner_ft.vocabulary.plans import LEVELS, MISSION_KEYS, STEP_KEYS, Level

DRAFT = "https://json-schema.org/draft/2020-12/schema"
SHAPES = Path(__file__).parent / "shapes"
Schema = dict[str, Any]

NON_BLANK: Schema = {"type": "string", "pattern": "\\S"}
TEXT: Schema = {"type": "string"}
COUNT: Schema = {"type": "integer", "minimum": 0}
OBJECT: Schema = {"type": "object"}
TEXTS: Schema = {"type": "array", "items": TEXT}
POSITION: Schema = {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}
VALUES: dict[str, Schema] = {
    "id": {"anyOf": [NON_BLANK, {"type": "integer"}]},
    "text": NON_BLANK,
    "texts": {"type": "array", "items": NON_BLANK},
    "position": POSITION,
    "polygon": {"type": "array", "items": POSITION, "minItems": 3},
}
"""Per type of parameter, except for numbers, the schema of a value."""
ELEMENTS = ("objective", "target", "sensor", "constraint")
"""Elements of a well-formed command: objective, target, sensor and data, constraint."""
FORMAT = "planner_ft plan"
VERSION = 1
TASK_KEYS = (
    *("id", "title", "parameters", "defaults", "task_prompt", "skill_sequence", "added", "stale"),
    *("waits_for", "asks", "located", "sources", "confidence", "assumptions", "problems"),
    "output",
)
"""The keys of a document's task in their order."""

PAGE = SHAPES / "vocabulary.md.j2"
ROLE_HEADINGS: dict[Role, str] = {
    "navigation": "navigation skills (exactly one per step; it moves or holds the vehicle and its"
    " end ends the step)",
    "filter": "filter skills (run beside the navigation skill and constrain it)",
    "perception": "perception skills (run beside the navigation skill and gather data)",
}
FORMS = {
    "position": "[x, y]",
    "polygon": "[[x, y], ...]",
    "texts": '["...", ...]',
    "text": '"..."',
    "id": '"..."',
}
"""How values of a type are written, except for numbers."""


def plan_schema(level: Level, vocabulary: Vocabulary, *, strict: bool) -> Schema:
    """The schema of a plan: the structure, or also names, roles, parameters, types and ranges."""
    if level == "mission":
        task: Schema = {"anyOf": [_named(task, task_prompt=TEXT) for task in vocabulary.tasks]}
        if not strict:
            task = object_schema({"title": TEXT, "parameters": OBJECT, "task_prompt": TEXT})
        properties = {"tasks": _array(task), **dict.fromkeys(MISSION_KEYS[1:], TEXTS)}
    else:
        properties = {"skill_sequence": _array(step_schema(vocabulary, strict))}
    strength = "strict" if strict else "structure only"
    return {
        "$schema": DRAFT,
        "title": f"{level} plan of the {vocabulary.title}, {strength}",
        **object_schema(properties, strict=strict),
    }


def record_schema(vocabulary: Vocabulary) -> Schema:
    """The schema of a dataset record; `expected` may hold names and parameters alone."""
    titles, names = list(vocabulary.task), list(vocabulary.skill)
    task = object_schema({"title": {"enum": titles}, "parameters": OBJECT}, required=["title"])
    skill = object_schema({"name": {"enum": names}, "parameters": OBJECT}, required=["name"])
    step = object_schema(
        {"navigation_skill": skill, **dict.fromkeys(STEP_KEYS[1:3], _array(skill))},
        required=["navigation_skill"],
    )
    span = {"element": {"enum": list(ELEMENTS)}, "start": COUNT, "end": COUNT, "text": TEXT}
    common = {
        **dict.fromkeys(("id", "family", "prompt"), NON_BLANK),
        "spans": _array(object_schema(span, strict=True)),
        "tags": TEXTS,
    }
    of_task = {"task": {"enum": titles}, "parameters": OBJECT}
    mission = {**common, "expected": object_schema({"tasks": _array(task)})}
    sequence = {**common, **of_task, "expected": object_schema({"skill_sequence": _array(step)})}
    needed = ["id", "prompt", "expected"]
    return {
        "$schema": DRAFT,
        "title": f"dataset record of the {vocabulary.title}",
        "anyOf": [
            object_schema(mission, required=needed),
            object_schema(sequence, required=[*needed[:2], *of_task, "expected"]),
        ],
    }


def manifest_schema() -> Schema:
    """The schema of a run manifest."""
    return {"$schema": DRAFT, **frame_schema()["properties"]["manifest"]}


def all_schemas(vocabulary: Vocabulary) -> dict[str, Schema]:
    """Every schema by file name."""
    schemas: dict[str, Schema] = {}
    for level in LEVELS:
        schemas[level] = plan_schema(level, vocabulary, strict=False)
        schemas[f"{level}.strict"] = plan_schema(level, vocabulary, strict=True)
    schemas |= {"record": record_schema(vocabulary), "plan": document_schema(vocabulary)}
    schemas["manifest"] = manifest_schema()
    schemas["field"] = json.loads(read_text(SHAPES / "field.schema.json"))
    return {f"{name}.schema.json": schema for name, schema in schemas.items()}


def write_schemas(folder: Path, vocabulary: Vocabulary) -> list[Path]:
    """Write every schema into `folder`; return the files."""
    schemas = all_schemas(vocabulary)
    for name, schema in schemas.items():
        write_json(folder / name, schema)
    return [folder / name for name in schemas]


def stale_schemas(folder: Path, vocabulary: Vocabulary) -> list[str]:
    """Names of schema files in `folder` that are missing or stale."""
    return [
        name
        for name, schema in all_schemas(vocabulary).items()
        if not (folder / name).is_file() or read_text(folder / name) != indented_json(schema)
    ]


def parameter_schema(parameter: Parameter) -> Schema:
    """The schema of one parameter's value."""
    if parameter.type not in ("number", "integer"):
        return VALUES[parameter.type]
    bounds = {"minimum": parameter.minimum, "maximum": parameter.maximum}
    known = {key: value for key, value in bounds.items() if value is not None}
    return {"type": parameter.type, **known}


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
    anything = object_schema({"name": TEXT, "parameters": OBJECT})
    navigation, *beside = (
        {"anyOf": [_named(skill) for skill in vocabulary.skills_in_role(role)]}
        if strict
        else anything
        for role in ROLES
    )
    skills = [navigation, *map(_array, beside)]
    texts = dict.fromkeys(STEP_KEYS[3:], TEXTS)
    return object_schema({**dict(zip(STEP_KEYS[:3], skills, strict=True)), **texts}, strict=strict)


def object_schema(
    properties: dict[str, Schema], *, strict: bool = False, required: list[str] | None = None
) -> Schema:
    """An object with these properties (and no others if `strict`), by default all required."""
    schema: Schema = {
        "type": "object",
        "properties": properties,
        "required": list(properties) if required is None else required,
    }
    return {**schema, "additionalProperties": False} if strict else schema


def _array(items: Schema) -> Schema:
    return {"type": "array", "items": items}


def _named(owner: Task | Skill, **more: Schema) -> Schema:
    """A task or a skill as plans have it, called by its name."""
    key, name = ("title", owner.title) if isinstance(owner, Task) else ("name", owner.name)
    own = {key: {"const": name}, "parameters": parameters_schema(owner), **more}
    return object_schema(own, strict=True)


@functools.cache
def frame_schema() -> Schema:
    """The schema of a document with titles, parameters and steps of any kind."""
    frame: Schema = json.loads(read_text(SHAPES / "document.schema.json"))
    return frame


def document_keys() -> tuple[str, ...]:
    """The keys of a document in their order."""
    return tuple(frame_schema()["properties"])


def document_schema(vocabulary: Vocabulary) -> Schema:
    """The schema of the documents that `plannerft plan` writes."""
    frame = frame_schema()
    properties = frame["properties"]
    proposed = properties["proposed"]
    inner = {**proposed["properties"], "tasks": _tasks(proposed, vocabulary)}
    return {
        "$schema": DRAFT,
        "title": f"plan of the {vocabulary.title}",
        **{key: value for key, value in frame.items() if key not in ("$schema", "$defs")},
        "properties": {
            **properties,
            "tasks": _tasks(frame, vocabulary),
            "proposed": {**proposed, "properties": inner},
        },
        "$defs": {"step": step_schema(vocabulary, strict=True), **frame["$defs"]},
    }


def task_schema(vocabulary: Vocabulary) -> Schema:
    """The schema of one task as it is proposed or edited: without the sources of its values."""
    tasks = _tasks(frame_schema()["properties"]["proposed"], vocabulary)
    return {**tasks["items"], "$defs": document_schema(vocabulary)["$defs"]}


def _tasks(frame: Schema, vocabulary: Vocabulary) -> Schema:
    """The schema of the tasks in a part of the frame: one alternative per task title."""
    one = frame["properties"]["tasks"]["items"]
    steps = {"anyOf": [{"type": "null"}, {"type": "array", "items": {"$ref": "#/$defs/step"}}]}
    alternatives = []
    for task in vocabulary.tasks:
        own = {"title": {"const": task.title}, "parameters": parameters_schema(task)}
        properties = {**one["properties"], **own, "skill_sequence": steps}
        alternatives.append({**one, "properties": properties})
    return {"type": "array", "items": {"anyOf": alternatives}}


def prompt_text(level: Level, vocabulary: Vocabulary) -> str:
    """Names and parameters of this level, one a line, as base models are shown them."""
    if level == "mission":
        return "\n".join(map(_line, vocabulary.tasks))
    return "\n".join(
        line
        for role, heading in ROLE_HEADINGS.items()
        for line in (f"{heading}:", *map(_line, vocabulary.skills_in_role(role)))
    )


def _line(owner: Task | Skill) -> str:
    name = owner.title if isinstance(owner, Task) else owner.name
    return f"- {name}({', '.join(map(_written, owner.parameters))}): {owner.description}"


def _written(parameter: Parameter) -> str:
    number = parameter.type in ("number", "integer")
    unit = f" in {parameter.unit}" if parameter.unit and number else ""
    return f"{parameter.name}: {FORMS.get(parameter.type, parameter.type)}{unit}"


def documentation_page(vocabulary: Vocabulary) -> str:
    """docs/vocabulary.md: tasks by category, then skills by role, each with its parameters."""
    import jinja2

    environment = jinja2.Environment(undefined=jinja2.StrictUndefined)
    template = environment.from_string(read_text(PAGE))
    categories = dict.fromkeys(task.category for task in vocabulary.tasks)
    page = template.render(
        vocabulary=vocabulary,
        categories=categories,
        headings=ROLE_HEADINGS,
        notes=_notes,
        essentials=load_essentials(vocabulary),
    )
    return page.rstrip() + "\n"


def _notes(parameter: Parameter, owner: Task | Skill) -> str:
    """Type, unit and range of a parameter, and whether it is required."""
    notes: list[str] = [parameter.type]
    if parameter.unit:
        notes.append(parameter.unit)
    if parameter.minimum is not None and parameter.maximum is not None:
        notes.append(f"{parameter.minimum:g} to {parameter.maximum:g}")
    if parameter.required:
        notes.append("required")
    elif parameter.name in owner.require_any:
        notes.append("one of these required")
    return ", ".join(notes)


def stale_page(path: Path, vocabulary: Vocabulary) -> bool:
    """Whether the page at `path` is missing or differs from what the vocabulary gives."""
    return not path.is_file() or read_text(path) != documentation_page(vocabulary)
