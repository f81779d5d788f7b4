"""The strict schema of a plan in the words that servers' grammar compilers understand, and the ways
of asking for one.

Compilers differ: llama.cpp's reads no unanchored pattern and takes `anyOf` instead of the
properties beside it. The form here admits the same plans but for one thing: a text that must not be
blank must only not be empty.
"""

from __future__ import annotations

import json
from typing import Any

from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level
from planner_ft.vocabulary.schema import NON_BLANK, Schema, plan_schema

FORMS = ("json_schema", "json_object")
"""Ways of asking: OpenAI's (vLLM, Ollama, llama.cpp), then the older one of llama.cpp and its
Python server.
"""
PROBE_ANSWER = {"probe": "buoy 41"}
"""What no model answers unless it is held to a schema."""
PROBE_SCHEMA: Schema = {
    "type": "object",
    "properties": {"probe": {"const": "buoy 41"}},
    "required": ["probe"],
    "additionalProperties": False,
}


def served_schema(level: Level, vocabulary: Vocabulary) -> Schema:
    """The strict schema of a level's plans, as it is sent."""
    schema: Schema = _translated(
        {
            key: value
            for key, value in plan_schema(level, vocabulary, strict=True).items()
            if key not in ("$schema", "title")
        }
    )
    return schema


def response_format(form: str, schema: Schema) -> dict[str, Any]:
    """The request's `response_format` field in one of FORMS."""
    if form == "json_object":
        return {"type": "json_object", "schema": schema}
    return {
        "type": "json_schema",
        "json_schema": {"name": "plan", "strict": True, "schema": schema},
    }


def is_probe_answer(text: str) -> bool:
    """Whether an answer is the one that the probe's schema leaves."""
    try:
        return bool(json.loads(text) == PROBE_ANSWER)
    except ValueError:
        return False


def _translated(schema: Any) -> Any:
    if isinstance(schema, list):
        return [_translated(entry) for entry in schema]
    if not isinstance(schema, dict):
        return schema
    if schema == NON_BLANK:
        return {"type": "string", "minLength": 1}
    if "anyOf" in schema and "properties" in schema:
        rest = {key: value for key, value in schema.items() if key != "anyOf"}
        return {
            "anyOf": [
                _translated({**rest, "required": [*rest.get("required", []), *_new(rest, other)]})
                for other in schema["anyOf"]
            ]
        }
    return {key: _translated(value) for key, value in schema.items()}


def _new(schema: Schema, other: Schema) -> list[str]:
    return [name for name in other["required"] if name not in schema.get("required", [])]
