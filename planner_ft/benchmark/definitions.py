"""Gate and suite files (TOML): what they may hold, and the runs that they describe."""

import re
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.results import Results, Row
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.decoding.configurations import parse_configuration
from planner_ft.support.errors import GateError, PlannerError
from planner_ft.support.files import read_toml
from planner_ft.vocabulary.plans import check_level

Kind = type | list[type]  # the type of a key's value; [str] is a list of texts
NUMBERS = ("limit", "max_new_tokens", "latency_samples", "planning_samples")
REQUIRED = ("level", "candidate", "configuration", "thresholds")
KEYS: dict[str, Kind] = {
    "thresholds": dict,
    **dict.fromkeys((*REQUIRED[:3], "data", "adapter", "vocabulary"), str),
    **dict.fromkeys(NUMBERS[:3], int),
}
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]*")
OF_BOTH: dict[str, Kind] = {"configurations": [str], "latency_samples": int, "max_new_tokens": int}
SHARED: dict[str, Kind] = {"candidates": [str], "vocabulary": str, "quantization": str, **OF_BOTH}
OWN: dict[str, Kind] = {"title": str, "parts": [dict], "stall_minutes": int, "adapters": dict}
PART: dict[str, Kind] = dict.fromkeys(("name", "level", "data"), str)
COUNTS: dict[str, Kind] = {"apart": bool, "limit": int, "planning_samples": int}


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
    """The run that a file in the folder `here`, its paths' base, describes. Raises PlannerError."""
    if raw.get("limit", 1) < 1:
        raise PlannerError(f"--limit {raw['limit']}: must be at least 1")
    vocabulary = raw.get("vocabulary", "usv")
    return BenchSettings(
        level=check_level(raw["level"]),
        data=here / raw["data"] if "data" in raw else None,
        vocabulary=str(here / vocabulary) if vocabulary.endswith(".toml") else vocabulary,
        **given | {name: raw[name] for name in NUMBERS if name in raw},
    )


@dataclass(frozen=True)
class Gate:
    """A gate file (TOML): one candidate in one configuration, and by metric the bounds "min" and
    "max" in the unit of results.json: rates are fractions.
    """

    path: Path
    settings: BenchSettings
    thresholds: dict[str, dict[str, float]]


def load_gate(path: Path) -> Gate:
    """Read a gate file; paths are relative to it. Raises PlannerError with every mistake."""
    raw, here = read_toml(path), path.parent
    if problems := key_problems(raw, KEYS, REQUIRED):
        raise PlannerError(f"{path}: {'; '.join(problems)}")
    if not raw["thresholds"]:
        example = "write for example schema_valid = { min = 0.98 }"
        raise PlannerError(f"{path}: [thresholds] names no metric; {example}")
    for metric, bounds in raw["thresholds"].items():
        if problem := _bounds_problem(metric, bounds):
            raise PlannerError(f"{path}: {problem}")
    settings = run_settings(
        {"latency_samples": 25 if "latency_s" in raw["thresholds"] else 0, **raw},
        here,
        candidates=(raw["candidate"],),
        configurations=(raw["configuration"],),
        adapters=(str(here / raw["adapter"]),) if "adapter" in raw else (),
    )
    return Gate(path, settings, raw["thresholds"])


def check_gate(gate: Gate, results: Results) -> None:
    """Raise GateError that names the figures of the gate's run which fall short."""
    row = results.rows[0]
    found = (_shortfall(row, *threshold) for threshold in gate.thresholds.items())
    if shortfalls := [text for text in found if text]:
        where = f"{gate.path}: {row.label}, {row.configuration}"
        raise GateError(f"{where}: {'; '.join(shortfalls)}")


def _shortfall(row: Row, metric: str, bounds: dict[str, float]) -> str | None:
    """How a row misses the bounds of a metric, or None."""
    value = row.metrics[metric].value
    if value is None:
        return f"{metric} was not measured"
    if value < bounds.get("min", value):
        return f"{metric} is {value:.4g}, below the minimum {bounds['min']:g}"
    if value > bounds.get("max", value):
        return f"{metric} is {value:.4g}, above the maximum {bounds['max']:g}"
    return None


def _bounds_problem(metric: str, bounds: Any) -> str | None:
    if metric not in METRIC:
        return f"unknown metric {metric!r}; there are {', '.join(METRIC)}"
    values = bounds if isinstance(bounds, dict) else {}
    if not values or values.keys() - {"min", "max"} or {*map(type, values.values())} - {int, float}:
        example = f"such as {metric} = {{ min = 0.98 }}"
        return f"{metric} must be a table of numbers with min or max, {example}"
    if METRIC[metric].fraction and any(not 0 <= value <= 1 for value in values.values()):
        return f"{metric} is a fraction between 0 and 1, as in results.json, not a percentage"
    return None


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
    run: dict[str, Any] = {"candidates": tuple(values["candidates"])}
    run |= {"configurations": tuple(names), "quantization": values.get("quantization")}
    return Part(values["name"], run_settings(values, here, **run), values.get("apart", False))
