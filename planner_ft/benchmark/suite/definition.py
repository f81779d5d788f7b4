"""Suite files (TOML): which candidates, in which configurations, on which data."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from planner_ft.benchmark.toml_files import key_problems, read_toml
from planner_ft.candidates.registry import Quantization
from planner_ft.decoding.configurations import parse_configuration
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.plans import LEVELS, Level

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]*")
COMMON: dict[str, type] = {"configurations": list, "latency_samples": int, "max_new_tokens": int}
SUITE_KEYS: dict[str, type] = {
    "title": str,
    "candidates": list,
    "parts": list,
    "vocabulary": str,
    "quantization": str,
    "stall_minutes": int,
    "adapters": dict,
    **COMMON,
}
PART_KEYS: dict[str, type] = {
    "name": str,
    "level": str,
    "data": str,
    "apart": bool,
    "limit": int,
    "planning_samples": int,
    **COMMON,
}
LOWEST = {"limit": 1, "max_new_tokens": 1, "stall_minutes": 1}


@dataclass(frozen=True)
class Part:
    """One data set of a suite. `apart` data is reported after the published-size splits, under a
    heading of its own.

    `latency_samples`, `max_new_tokens` and `planning_samples` are those of `plannerft bench`; None
    leaves its default.
    """

    name: str
    level: Level
    data: Path
    apart: bool = False
    limit: int | None = None
    configurations: tuple[str, ...] = ()
    latency_samples: int | None = None
    max_new_tokens: int | None = None
    planning_samples: int | None = None


@dataclass(frozen=True)
class Suite:
    """A suite file. `adapters` are folders by candidate and level for those that do not lie where
    `plannerft train` writes them.

    A process without a new answer for `stall_minutes` is ended.
    """

    path: Path
    title: str
    candidates: tuple[str, ...]
    parts: tuple[Part, ...]
    vocabulary: str = "usv"
    quantization: Quantization | None = None
    stall_minutes: int = 60
    adapters: dict[str, dict[str, Path]] = field(default_factory=dict)


def load_suite(path: Path) -> Suite:
    """Read a suite file; the paths in it are relative to it. Raises PlannerError that lists every
    mistake.
    """
    raw, here = read_toml(path), path.parent
    problems = _problems(raw, SUITE_KEYS, ("title", "candidates", "configurations", "parts"))
    if raw.get("quantization") not in (None, "nf4", "none"):
        problems.append("quantization must be nf4 or none")
    parts = _listed(raw, "parts")
    for index, part in enumerate(parts):
        found = _part_problems(part) if isinstance(part, dict) else ["must be a table"]
        problems += [f"parts[{index}]: {text}" for text in found]
    names = Counter(str(part.get("name")) for part in parts if isinstance(part, dict))
    problems += [f"two parts are named {name}" for name, count in names.items() if count > 1]
    if problems:
        raise PlannerError(f"{path}: {'; '.join(problems)}")
    vocabulary = raw.get("vocabulary", "usv")
    return Suite(
        path,
        raw["title"],
        tuple(dict.fromkeys(raw["candidates"])),
        tuple(
            _part({key: raw[key] for key in COMMON if key in raw} | part, here) for part in parts
        ),
        vocabulary=str(here / vocabulary) if vocabulary.endswith(".toml") else vocabulary,
        quantization=raw.get("quantization"),
        stall_minutes=raw.get("stall_minutes", Suite.stall_minutes),
        adapters={
            candidate: {level: here / folder for level, folder in folders.items()}
            for candidate, folders in raw.get("adapters", {}).items()
        },
    )


def _part(values: dict[str, Any], here: Path) -> Part:
    names = dict.fromkeys(parse_configuration(text).name for text in values["configurations"])
    return Part(**values | {"data": here / values["data"], "configurations": tuple(names)})


def _problems(raw: dict[str, Any], types: dict[str, type], required: tuple[str, ...]) -> list[str]:
    problems = key_problems(raw, types, required, LOWEST)
    for key in ("candidates", "configurations"):
        for value in _listed(raw, key):
            if not isinstance(value, str):
                problems.append(f"{key}: {value!r} is no text")
            elif key == "configurations":
                try:
                    parse_configuration(value)
                except PlannerError as error:
                    problems.append(str(error).removeprefix("--"))
    return problems


def _part_problems(part: dict[str, Any]) -> list[str]:
    problems = _problems(part, PART_KEYS, ("name", "level", "data"))
    name, level = part.get("name"), part.get("level")
    if isinstance(name, str) and not NAME.fullmatch(name):
        problems.append(f"name {name!r} becomes a folder: letters, digits, - and _ alone")
    if isinstance(level, str) and level not in LEVELS:
        problems.append(f"level {level!r} must be {' or '.join(LEVELS)}")
    if part.get("planning_samples") and level == "task":
        problems.append("planning_samples belongs to a part of the mission level")
    return problems


def _listed(raw: dict[str, Any], key: str) -> list[Any]:
    return raw[key] if isinstance(raw.get(key), list) else []
