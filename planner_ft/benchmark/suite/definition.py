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
SUITE_KEYS: dict[str, type] = {
    "title": str,
    "candidates": list,
    "configurations": list,
    "parts": list,
    "vocabulary": str,
    "quantization": str,
    "latency_samples": int,
    "max_new_tokens": int,
    "stall_minutes": int,
    "adapters": dict,
}
PART_KEYS: dict[str, type] = {
    "name": str,
    "level": str,
    "data": str,
    "apart": bool,
    "limit": int,
    "configurations": list,
    "latency_samples": int,
    "max_new_tokens": int,
    "planning_samples": int,
}
REQUIRED = {
    "suite": ("title", "candidates", "configurations", "parts"),
    "part": ("name", "level", "data"),
}


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
    parts: list[Any] = raw["parts"] if isinstance(raw.get("parts"), list) else []
    for index, part in enumerate(parts):
        where = f"parts[{index}]"
        problems += (
            [f"{where} must be a table"]
            if not isinstance(part, dict)
            else [f"{where}: {text}" for text in _part_problems(part)]
        )
    names = [part.get("name") for part in parts if isinstance(part, dict)]
    problems += [
        f"two parts are named {name}" for name in dict.fromkeys(names) if names.count(name) > 1
    ]
    problems += [
        f"{key} is empty" for key in ("candidates", "configurations", "parts") if raw.get(key) == []
    ]
    for key in ("candidates", "configurations"):
        problems += [
            f"{key}: {value!r} is no text"
            for value in _list(raw.get(key))
            if not isinstance(value, str)
        ]
    if raw.get("quantization") not in (None, "nf4", "none"):
        problems.append("quantization must be nf4 or none")
    if problems:
        raise PlannerError(f"{path}: {'; '.join(problems)}")
    return _suite(path, raw)


def _problems(raw: dict[str, Any], kind: str, keys: dict[str, type]) -> list[str]:
    problems = [f"{key} is missing" for key in REQUIRED[kind] if key not in raw]
    problems += [
        f"unknown key {key!r} (there are {', '.join(keys)})" for key in raw if key not in keys
    ]
    problems += [
        f"{key} must be a {keys[key].__name__}"
        for key, value in raw.items()
        if key in keys and type(value) is not keys[key]
    ]
    low = {
        "limit": 1,
        "max_new_tokens": 1,
        "stall_minutes": 1,
        "latency_samples": 0,
        "planning_samples": 0,
    }
    problems += [
        f"{key} must be at least {low[key]}"
        for key, value in raw.items()
        if key in low and type(value) is int and value < low[key]
    ]
    return problems + [
        text
        for value in _list(raw.get("configurations"))
        if isinstance(value, str)
        for text in _configuration_problem(value)
    ]


def _part_problems(part: dict[str, Any]) -> list[str]:
    problems = _problems(part, "part", PART_KEYS)
    if isinstance(part.get("name"), str) and not NAME.fullmatch(part["name"]):
        problems.append(f"name {part['name']!r} becomes a folder: letters, digits, - and _ alone")
    if isinstance(part.get("level"), str) and part["level"] not in LEVELS:
        problems.append(f"level {part['level']!r} must be {' or '.join(LEVELS)}")
    if part.get("planning_samples") and part.get("level") == "task":
        problems.append("planning_samples belongs to a part of the mission level")
    return problems


def _configuration_problem(text: str) -> list[str]:
    try:
        parse_configuration(text)
    except PlannerError as error:
        return [str(error).removeprefix("--")]
    return []


def _list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else []


def _suite(path: Path, raw: dict[str, Any]) -> Suite:
    common = {key: raw[key] for key in ("latency_samples", "max_new_tokens") if key in raw}
    here = path.parent
    parts = []
    for part in raw["parts"]:
        configurations = tuple(
            parse_configuration(text).name
            for text in part.get("configurations", raw["configurations"])
        )
        parts.append(
            Part(
                **{
                    **common,
                    **part,
                    "data": here / part["data"],
                    "configurations": tuple(dict.fromkeys(configurations)),
                }
            )
        )
    vocabulary = raw.get("vocabulary", "usv")
    adapters = {
        candidate: {level: here / folder for level, folder in folders.items()}
        for candidate, folders in raw.get("adapters", {}).items()
    }
    return Suite(
        path,
        raw["title"],
        tuple(dict.fromkeys(raw["candidates"])),
        tuple(parts),
        vocabulary=str(here / vocabulary) if vocabulary.endswith(".toml") else vocabulary,
        quantization=raw.get("quantization"),
        stall_minutes=raw.get("stall_minutes", Suite.stall_minutes),
        adapters=adapters,
    )
