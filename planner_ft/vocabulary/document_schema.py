"""The JSON Schema of a plan document: shapes/document.schema.json with a vocabulary's tasks."""

from __future__ import annotations

import functools
import json
from pathlib import Path

from planner_ft.support.files import read_text
from planner_ft.vocabulary.definition import Vocabulary
from planner_ft.vocabulary.schema import DRAFT, Schema, parameters_schema, step_schema

FORMAT = "planner_ft plan"
VERSION = 1
TASK_KEYS = (
    *("id", "title", "parameters", "defaults", "task_prompt", "skill_sequence", "added", "stale"),
    *("waits_for", "asks", "located", "sources", "confidence", "assumptions", "problems"),
    "output",
)
"""The keys of a document's task in their order."""


@functools.cache
def frame_schema() -> Schema:
    """The schema of a document with titles, parameters and steps of any kind."""
    frame: Schema = json.loads(read_text(Path(__file__).parent / "shapes" / "document.schema.json"))
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
    return {**tasks["items"], "$defs": {"step": step_schema(vocabulary, strict=True)}}


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
