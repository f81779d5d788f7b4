"""From the raw text of an answer to a plan."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, NoReturn


@dataclass(frozen=True)
class Parsed:
    """An answer read as JSON: the object, or None and why the answer is not one JSON object."""

    plan: dict[str, Any] | None
    problem: str | None = None


def parse_output(output: str | dict[str, Any] | None) -> Parsed:
    """Read an answer as one JSON object; white space around it is allowed, nothing else.

    The published definition is "parses as one JSON object". A Markdown fence, a sentence before the object, a second
    object or a cut end therefore do not parse, whatever they contain. An answer that is an object already is taken
    as it is. NaN and Infinity are not JSON.
    """
    if isinstance(output, dict):
        return Parsed(output)
    text = (output or "").strip()
    if not text:
        return Parsed(None, "empty")
    try:
        value = json.loads(text, parse_constant=_refuse)
    except json.JSONDecodeError as error:
        return Parsed(None, f"not JSON ({error.msg} at character {error.pos})")
    except (ValueError, RecursionError) as error:
        # A number of thousands of digits, NaN, or nesting deeper than the parser follows.
        return Parsed(None, f"not JSON ({str(error).split(';')[0] or 'nested too deeply'})")
    if not isinstance(value, dict):
        return Parsed(None, "JSON, but no object")
    return Parsed(value)


def _refuse(constant: str) -> NoReturn:
    raise ValueError(f"{constant} is no JSON number")
