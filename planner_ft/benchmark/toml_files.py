"""Gate and suite files: TOML with the settings of runs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from planner_ft.benchmark.settings import BenchSettings
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.plans import check_level

Kind = type | list[type]
"""The type of a key's value; [str] is a list of texts."""
NUMBERS = ("limit", "max_new_tokens", "latency_samples", "planning_samples")


def key_problems(
    raw: Mapping[str, Any], kinds: Mapping[str, Kind], required: Iterable[str]
) -> list[str]:
    """Missing, unknown and empty keys, and values of another type."""
    problems = [f"{key} is missing" for key in required if key not in raw]
    for key, value in raw.items():
        kind = kinds.get(key)
        if kind is None:
            problems.append(f"unknown key {key!r} (there are {', '.join(kinds)})")
        elif value == []:
            problems.append(f"{key} is empty")
        elif isinstance(kind, list):
            if type(value) is not list or {*map(type, value)} != {*kind}:
                problems.append(f"{key} must be a list of {kind[0].__name__}")
        elif type(value) is not kind:
            problems.append(f"{key} must be a {kind.__name__}")
    return problems


def run_settings(raw: Mapping[str, Any], here: Path, **given: Any) -> BenchSettings:
    """The settings of a run that a file in the folder `here` describes; paths are relative to it.
    Raises PlannerError.
    """
    if raw.get("limit", 1) < 1:
        raise PlannerError(f"--limit {raw['limit']}: must be at least 1")
    vocabulary = raw.get("vocabulary", "usv")
    return BenchSettings(
        level=check_level(raw["level"]),
        data=here / raw["data"] if "data" in raw else None,
        vocabulary=str(here / vocabulary) if vocabulary.endswith(".toml") else vocabulary,
        **given | {name: raw[name] for name in NUMBERS if name in raw},
    )
