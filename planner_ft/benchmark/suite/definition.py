"""Suite files (TOML): which candidates, in which configurations, on which data."""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.candidates.registry import Quantization
from planner_ft.decoding.configurations import parse_configuration
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_text
from planner_ft.vocabulary.plans import LEVELS, Level

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]*")
REQUIRED = {
    "suite": ("title", "candidates", "configurations", "parts"),
    "part": ("name", "level", "data"),
}
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
"""The smallest value of a number, else 0."""


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
    adapters: dict[str, dict[str, Path]] | None = None


def load_suite(path: Path) -> Suite:
    """Read a suite file; the paths in it are relative to it. Raises PlannerError that lists every
    mistake.
    """
    try:
        raw = tomllib.loads(read_text(path))
    except tomllib.TOMLDecodeError as error:
        raise PlannerError(f"{path}: not TOML: {error}") from None
    problems = _problems(raw, "suite", SUITE_KEYS)
    if raw.get("quantization") not in (None, "nf4", "none"):
        problems.append("quantization must be nf4 or none")
    names: list[Any] = []
    for index, part in enumerate(_list(raw.get("parts"))):
        where = f"parts[{index}]"
        if not isinstance(part, dict):
            problems.append(f"{where} must be a table")
            continue
        problems += [f"{where}: {text}" for text in _part_problems(part)]
        if part.get("name") in names:
            problems.append(f"two parts are named {part['name']}")
        names.append(part.get("name"))
    if problems:
        raise PlannerError(f"{path}: {'; '.join(problems)}")
    return _suite(path, raw)


def _problems(raw: dict[str, Any], kind: str, keys: dict[str, type]) -> list[str]:
    problems = [f"{key} is missing" for key in REQUIRED[kind] if key not in raw]
    for key, value in raw.items():
        if key not in keys:
            problems.append(f"unknown key {key!r} (there are {', '.join(keys)})")
        elif type(value) is not keys[key]:
            problems.append(f"{key} must be a {keys[key].__name__}")
        elif type(value) is int and value < LOWEST.get(key, 0):
            problems.append(f"{key} must be at least {LOWEST.get(key, 0)}")
        elif value == []:
            problems.append(f"{key} is empty")
    for key in ("candidates", "configurations"):
        texts = [value for value in _list(raw.get(key)) if isinstance(value, str)]
        others = [value for value in _list(raw.get(key)) if not isinstance(value, str)]
        problems += [f"{key}: {value!r} is no text" for value in others]
        for text in texts if key == "configurations" else ():
            try:
                parse_configuration(text)
            except PlannerError as error:
                problems.append(str(error).removeprefix("--"))
    return problems


def _part_problems(part: dict[str, Any]) -> list[str]:
    problems, name, level = _problems(part, "part", PART_KEYS), part.get("name"), part.get("level")
    if isinstance(name, str) and not NAME.fullmatch(name):
        problems.append(f"name {name!r} becomes a folder: letters, digits, - and _ alone")
    if isinstance(level, str) and level not in LEVELS:
        problems.append(f"level {level!r} must be {' or '.join(LEVELS)}")
    if part.get("planning_samples") and level == "task":
        problems.append("planning_samples belongs to a part of the mission level")
    return problems


def _list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else []


def _suite(path: Path, raw: dict[str, Any]) -> Suite:
    common = {key: raw[key] for key in COMMON if key in raw}
    here = path.parent
    parts = []
    for own in raw["parts"]:
        part = {**common, **own}
        names = (parse_configuration(text).name for text in part.pop("configurations"))
        part["data"] = here / part["data"]
        parts.append(Part(**part, configurations=tuple(dict.fromkeys(names))))
    vocabulary = raw.get("vocabulary", "usv")
    return Suite(
        path,
        raw["title"],
        tuple(dict.fromkeys(raw["candidates"])),
        tuple(parts),
        vocabulary=str(here / vocabulary) if vocabulary.endswith(".toml") else vocabulary,
        quantization=raw.get("quantization"),
        stall_minutes=raw.get("stall_minutes", Suite.stall_minutes),
        adapters={
            candidate: {level: here / folder for level, folder in folders.items()}
            for candidate, folders in raw.get("adapters", {}).items()
        },
    )
