"""Suite files (TOML): which candidates, in which configurations, on which data."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.benchmark.gate import Kind, key_problems, run_settings
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.decoding.configurations import parse_configuration
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_toml

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]*")
OF_BOTH: dict[str, Kind] = {"configurations": [str], "latency_samples": int, "max_new_tokens": int}
SHARED: dict[str, Kind] = {"candidates": [str], "vocabulary": str, "quantization": str, **OF_BOTH}
OWN: dict[str, Kind] = {"title": str, "parts": [dict], "stall_minutes": int, "adapters": dict}
PART: dict[str, Kind] = dict.fromkeys(("name", "level", "data"), str)
COUNTS: dict[str, Kind] = {"apart": bool, "limit": int, "planning_samples": int}


@dataclass(frozen=True)
class Part:
    """One data set of a suite, with the settings of its runs, which name all candidates; what is
    `apart` is reported after the published-size splits, under a heading of its own.
    """

    name: str
    settings: BenchSettings
    apart: bool


@dataclass(frozen=True)
class Suite:
    """A suite file. `adapters` are folders by candidate and level for those that do not lie where
    `plannerft train` writes them. A process without a new answer for `stall_minutes` is ended.
    """

    path: Path
    title: str
    candidates: tuple[str, ...]
    parts: tuple[Part, ...]
    stall_minutes: int
    adapters: dict[str, dict[str, Path]]


def load_suite(path: Path) -> Suite:
    """Read a suite file; paths are relative to it. Raises PlannerError with every mistake."""
    raw, here = read_toml(path), path.parent
    required = ("title", "candidates", "configurations", "parts")
    problems = key_problems(raw, SHARED | OWN, required)
    adapters = raw.get("adapters", {})
    by_level = adapters.values() if isinstance(adapters, dict) else [None]
    if not all(isinstance(one, dict) for one in by_level):
        problems.append("adapters must be tables of folders by level, one per candidate")
    if not problems and raw.get("stall_minutes", 1) < 1:
        problems.append("stall_minutes must be at least 1")
    parts: list[Part] = []
    shared = {key: raw[key] for key in SHARED if key in raw}
    for index, values in enumerate([] if problems else raw["parts"]):
        found = key_problems(values, PART | OF_BOTH | COUNTS, PART)
        try:
            parts += [] if found else [_part(shared | values, here)]
        except PlannerError as error:
            found = [str(error)]
        problems += [f"parts[{index}]: {text}" for text in found]
    names = Counter(part.name for part in parts)
    problems += [f"two parts are named {name}" for name, count in names.items() if count > 1]
    if problems:
        raise PlannerError(f"{path}: {'; '.join(problems)}")
    folders_of = {
        candidate: {level: here / folder for level, folder in folders.items()}
        for candidate, folders in adapters.items()
    }
    candidates, minutes = tuple(dict.fromkeys(raw["candidates"])), raw.get("stall_minutes", 60)
    return Suite(path, raw["title"], candidates, tuple(parts), minutes, folders_of)


def _part(values: dict[str, Any], here: Path) -> Part:
    if not NAME.fullmatch(values["name"]):
        way = "becomes a folder: letters, digits, - and _ alone"
        raise PlannerError(f"name {values['name']!r} {way}")
    names = dict.fromkeys(parse_configuration(text).name for text in values["configurations"])
    settings = run_settings(
        values,
        here,
        candidates=tuple(values["candidates"]),
        configurations=tuple(names),
        quantization=values.get("quantization"),
    )
    return Part(values["name"], settings, values.get("apart", False))
