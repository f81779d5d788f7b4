"""The JSON Schema of a plan document, derived from a vocabulary (schemas/plan.schema.json)."""

from __future__ import annotations

from planner_ft.vocabulary.definition import Task, Vocabulary
from planner_ft.vocabulary.schema import (
    DRAFT,
    ELEMENTS,
    NON_BLANK,
    POSITION,
    TEXTS,
    Schema,
    manifest_schema,
    object_schema,
    parameters_schema,
    step_schema,
)

FORMAT = "planner_ft plan"
VERSION = 1

DIGEST: Schema = {"type": "string", "pattern": "^[0-9a-f]{64}$"}
COUNT: Schema = {"type": "integer", "minimum": 0}
AMOUNT: Schema = {"type": "number", "minimum": 0}
PROBLEMS: dict[str, Schema] = {"problems": TEXTS, "output": {"type": "string"}}
NULL: Schema = {"type": "null"}
SOURCES = ("command", "located", "derived", "operator", "model")
"""Where a value comes from: words of the command, a resolved location, a rule, the operator, or the
model alone.
"""


def document_keys() -> tuple[str, ...]:
    """The keys of a document in their order."""
    return (
        "format",
        "version",
        "command",
        "vocabulary",
        "vehicle",
        "ontology",
        "valid",
        "complete",
        "warnings",
        "tasks",
        "assumptions",
        "constraints",
        "open_places",
        "located",
        "problems",
        "output",
        "estimate",
        "edits",
        "proposed",
        "usage",
        "peak_memory_bytes",
        "manifest",
        "digest",
    )


def task_keys() -> tuple[str, ...]:
    """The keys of a document's task in their order."""
    return (
        "id",
        "title",
        "parameters",
        "task_prompt",
        "skill_sequence",
        "stale",
        "waits_for",
        "located",
        "sources",
        "assumptions",
        "problems",
        "output",
    )


def document_schema(vocabulary: Vocabulary) -> Schema:
    """The schema of what `plannerft plan` writes: a command with its tasks and skills, where each
    value is from, and what a reviewer must know.
    """
    schema = _document(_task(vocabulary, derived=True), _task(vocabulary, derived=False))
    shared = {"step": step_schema(vocabulary, strict=True), "source": _source()}
    return {"$schema": DRAFT, "title": f"plan of the {vocabulary.title}", **schema, "$defs": shared}


def frame_schema() -> Schema:
    """The schema of a document but for what the vocabulary says of tasks and skills: titles,
    parameters and steps are of any kind.
    """
    anything: Schema = {"type": "object"}
    steps = {"anyOf": [NULL, _array(anything)]}
    tasks = [_framed(NON_BLANK, anything, steps, derived=derived) for derived in (True, False)]
    return {"$schema": DRAFT, **_document(*tasks), "$defs": {"source": _source()}}


def _document(task: Schema, proposed_task: Schema) -> Schema:
    place = object_schema(
        {
            "name": NON_BLANK,
            "tasks": {"type": "array", "items": {"type": "integer", "minimum": 1}, "minItems": 1},
        },
        strict=True,
    )
    located: Schema = {"type": "object", "additionalProperties": POSITION}
    proposed = {
        "tasks": _array(proposed_task),
        "assumptions": TEXTS,
        "constraints": TEXTS,
        "located": located,
    }
    edit = object_schema(
        {
            "time": {"type": "string"},
            "by": {"type": ["string", "null"]},
            "edit": {"type": "object", "required": ["kind"]},
        },
        strict=True,
    )
    named = object_schema({"name": NON_BLANK, "sha256": DIGEST}, strict=True)
    kinds: dict[str, Schema] = {
        "format": {"const": FORMAT},
        "version": {"const": VERSION},
        "command": NON_BLANK,
        "vocabulary": named,
        "vehicle": _vehicle(),
        "ontology": _ontology(),
        "valid": {"type": "boolean"},
        "complete": {"type": "boolean"},
        "warnings": _array(_warning()),
        "tasks": _array(task),
        "assumptions": TEXTS,
        "constraints": TEXTS,
        "open_places": _array(place),
        "located": located,
        **PROBLEMS,
        "estimate": _estimate(),
        "edits": _array(edit),
        "proposed": object_schema(proposed, strict=True),
        "usage": object_schema(
            {"mission": _use(), "task": _use()}, strict=True, required=["mission"]
        ),
        "peak_memory_bytes": COUNT,
        "manifest": {key: value for key, value in manifest_schema().items() if key != "$schema"},
        "digest": DIGEST,
    }
    properties = {name: kinds[name] for name in document_keys()}
    return object_schema(
        properties, strict=True, required=[name for name in properties if name not in PROBLEMS]
    )


def task_schema(vocabulary: Vocabulary) -> Schema:
    """The schema of one task as it is proposed or edited: without the sources of its values."""
    return {
        **_task(vocabulary, derived=False),
        "$defs": {"step": step_schema(vocabulary, strict=True)},
    }


def _task(vocabulary: Vocabulary, *, derived: bool) -> Schema:
    return {"anyOf": [_one_task(task, derived=derived) for task in vocabulary.tasks]}


def _one_task(task: Task, *, derived: bool) -> Schema:
    return _framed(
        {"const": task.title},
        parameters_schema(task),
        {"anyOf": [NULL, _array({"$ref": "#/$defs/step"})]},
        derived=derived,
    )


def _framed(title: Schema, parameters: Schema, skills: Schema, *, derived: bool) -> Schema:
    always = {
        "id": NON_BLANK,
        "title": title,
        "parameters": parameters,
        "task_prompt": {"type": "string"},
        "skill_sequence": skills,
    }
    sources = {"type": "object", "additionalProperties": {"$ref": "#/$defs/source"}}
    then = {
        "stale": {"const": True},
        "waits_for": NON_BLANK,
        "located": {"type": "object", "additionalProperties": NON_BLANK},
        "assumptions": TEXTS,
        **PROBLEMS,
    }
    return object_schema(
        {**always, **then, **({"sources": sources} if derived else {})},
        strict=True,
        required=[*always, *(["sources"] if derived else [])],
    )


def _source() -> Schema:
    pair = {"type": "array", "items": COUNT, "minItems": 2, "maxItems": 2}
    return object_schema(
        {"kind": {"enum": list(SOURCES)}, "spans": _array(pair), "note": {"type": "string"}},
        strict=True,
        required=["kind"],
    )


def _ontology() -> Schema:
    element: Schema = {"enum": list(ELEMENTS)}
    span = object_schema(
        {"element": element, "start": COUNT, "end": COUNT, "text": {"type": "string"}}, strict=True
    )
    return object_schema(
        {"elements": _array(span), "missing": _array(element), "questions": TEXTS}, strict=True
    )


def _warning() -> Schema:
    maybe: Schema = {"type": ["string", "null"]}
    return object_schema(
        {"id": NON_BLANK, "kind": NON_BLANK, "task": maybe, "parameter": maybe, "text": NON_BLANK},
        strict=True,
    )


def _vehicle() -> Schema:
    area = {"anyOf": [NULL, {"type": "array", "items": POSITION, "minItems": 3}]}
    positive: Schema = {"type": "number", "exclusiveMinimum": 0}
    amounts = dict.fromkeys(("cruise_speed", "endurance", "turn_rate", "orbit_angle"), positive)
    return object_schema({"name": NON_BLANK, **amounts, "area": area}, strict=True)


def _estimate() -> Schema:
    return object_schema({"length": AMOUNT, "seconds": AMOUNT, "open": TEXTS}, strict=True)


def _use() -> Schema:
    return object_schema(
        {
            "candidate": NON_BLANK,
            "configuration": NON_BLANK,
            "adapter": {"type": ["string", "null"]},
            "load_seconds": AMOUNT,
            "queries": COUNT,
            "prompt_tokens": COUNT,
            "tokens": COUNT,
            "forward_passes": COUNT,
            "seconds": AMOUNT,
        },
        strict=True,
    )


def _array(items: Schema) -> Schema:
    return {"type": "array", "items": items}
