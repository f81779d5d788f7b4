"""The regression gate: a run whose figures must not fall short of thresholds."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.results import Results
from planner_ft.benchmark.runner import Progress, run_bench
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.benchmark.toml_files import Kind, key_problems, run_settings
from planner_ft.support.errors import GateError, PlannerError
from planner_ft.support.files import read_toml

REQUIRED = ("level", "candidate", "configuration", "thresholds")
KEYS: dict[str, Kind] = {
    "thresholds": dict,
    **dict.fromkeys((*REQUIRED[:3], "data", "adapter", "vocabulary"), str),
    **dict.fromkeys(("limit", "max_new_tokens", "latency_samples"), int),
}


@dataclass(frozen=True)
class Threshold:
    """Bounds of one metric, in the unit of results.json: rates are fractions."""

    metric: str
    minimum: float | None
    maximum: float | None

    def shortfall(self, results: Results) -> str | None:
        """How the gate's row misses the bounds, or None."""
        value = results.rows[0].metrics[self.metric].value
        if value is None:
            return f"{self.metric} was not measured"
        if self.minimum is not None and value < self.minimum:
            return f"{self.metric} is {value:.4g}, below the minimum {self.minimum:g}"
        if self.maximum is not None and value > self.maximum:
            return f"{self.metric} is {value:.4g}, above the maximum {self.maximum:g}"
        return None


@dataclass(frozen=True)
class Gate:
    """A gate file (TOML): one candidate in one configuration, and thresholds by metric."""

    path: Path
    settings: BenchSettings
    thresholds: tuple[Threshold, ...]


def load_gate(path: Path) -> Gate:
    """Read a gate file; `data`, `adapter` and a vocabulary's path are relative to it. Raises
    PlannerError that lists every mistake.
    """
    raw, here = read_toml(path), path.parent
    if problems := key_problems(raw, KEYS, REQUIRED):
        raise PlannerError(f"{path}: {'; '.join(problems)}")
    thresholds = tuple(_threshold(path, *item) for item in raw["thresholds"].items())
    if not thresholds:
        example = "write for example schema_valid = { min = 0.98 }"
        raise PlannerError(f"{path}: [thresholds] names no metric; {example}")
    needs_latency = any(threshold.metric == "latency_s" for threshold in thresholds)
    settings = run_settings(
        {"latency_samples": 25 if needs_latency else 0, **raw},
        here,
        candidates=(raw["candidate"],),
        configurations=(raw["configuration"],),
        adapters=(str(here / raw["adapter"]),) if "adapter" in raw else (),
    )
    return Gate(path, settings, thresholds)


def run_gate(
    gate: Gate,
    out: Path,
    progress: Progress,
    show: Callable[[Results], Any] = lambda _results: None,
    **changes: Any,
) -> Results:
    """Run the gate's benchmark into `out`; `show` gets the results. Raises GateError when a figure
    falls short of its threshold.
    """
    results = run_bench(dataclasses.replace(gate.settings, out=out, **changes), progress)
    show(results)
    found = (threshold.shortfall(results) for threshold in gate.thresholds)
    if shortfalls := [text for text in found if text]:
        system = results.rows[0].system
        where = f"{gate.path}: {system.label}, {system.configuration}"
        raise GateError(f"{where}: {'; '.join(shortfalls)}")
    return results


def _threshold(path: Path, metric: str, bounds: Any) -> Threshold:
    if metric not in METRIC:
        raise PlannerError(f"{path}: unknown metric {metric!r}; there are {', '.join(METRIC)}")
    values = bounds if isinstance(bounds, dict) else {}
    if not values or values.keys() - {"min", "max"} or {*map(type, values.values())} - {int, float}:
        expected = (
            f"must be a table of numbers with min or max, such as {metric} = {{ min = 0.98 }}"
        )
        raise PlannerError(f"{path}: {metric} {expected}")
    if METRIC[metric].fraction and any(not 0 <= value <= 1 for value in values.values()):
        unit = "is a fraction between 0 and 1, as in results.json, not a percentage"
        raise PlannerError(f"{path}: {metric} {unit}")
    return Threshold(metric, values.get("min"), values.get("max"))
