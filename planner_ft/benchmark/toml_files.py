"""Reading gate and suite files."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_text


def read_toml(path: Path) -> dict[str, Any]:
    """The content of a TOML file. Raises PlannerError."""
    try:
        return tomllib.loads(read_text(path))
    except tomllib.TOMLDecodeError as error:
        raise PlannerError(f"{path}: not TOML: {error}") from None


def key_problems(
    raw: Mapping[str, Any],
    types: Mapping[str, type],
    required: Iterable[str],
    lowest: Mapping[str, int],
) -> list[str]:
    """Missing, unknown and empty keys, values of another type, and numbers below the lowest of
    their key, which is 0 unless it is named.
    """
    problems = [f"{key} is missing" for key in required if key not in raw]
    for key, value in raw.items():
        if key not in types:
            problems.append(f"unknown key {key!r} (there are {', '.join(types)})")
        elif type(value) is not types[key]:
            problems.append(f"{key} must be a {types[key].__name__}")
        elif type(value) is int and value < lowest.get(key, 0):
            problems.append(f"{key} must be at least {lowest.get(key, 0)}")
        elif value == []:
            problems.append(f"{key} is empty")
    return problems
