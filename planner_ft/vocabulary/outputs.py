"""From the raw text of an answer to a plan."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from typing import Any, NoReturn

from planner_ft.vocabulary.plans import WORKING

LONGEST_INTEGER = 300
"""Digits of an integer that a float can still hold, with room."""


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
