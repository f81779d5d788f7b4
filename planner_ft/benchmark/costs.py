"""Costs of a system: latency and its quantiles, time to first token, tokens per second, memory,
loading, planning time.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from typing import Any

from planner_ft.benchmark.statistics import bootstrap_mean, bootstrap_ratio, quantile

QUANTILES = (("median", 0.5), ("p90", 0.9), ("p99", 0.99))
BESIDE = ("load_s", "adapter_swap_s", "peak_memory_bytes")
"""Figures of a candidate that do not belong to a query: run.json has them."""


def cost_figures(
    timed: Mapping[str, Mapping[str, Any]],
    families: Mapping[str, Hashable],
    beside: Mapping[str, Any],
    planning: Sequence[Mapping[str, Any]],
    seed: int,
) -> dict[str, Any]:
    """The `costs` of a row in results.json; empty where nothing was measured.

    `timed` are lines of latency.jsonl by sample id, `families` the phrasing families of samples,
    `beside` the figures of run.json on the candidate, `planning` the row's lines of planning.jsonl.
    """
    lines = [
        (families.get(sample, sample), line)
        for sample, line in timed.items()
        if isinstance(line.get("latency_s"), int | float)
    ]
    figures: dict[str, Any] = {}
    if lines:
        seconds = [float(line["latency_s"]) for _family, line in lines]
        figures["latency_s"] = {
            name: quantile(seconds, share).to_json() for name, share in QUANTILES
        }
        first = [one for one in lines if one[1].get("first_token_s") is not None]
        if first:
            times = [float(line["first_token_s"]) for _family, line in first]
            own = [family for family, _line in first]
            figures["first_token_s"] = bootstrap_mean(times, own, seed).to_json()
        if all(isinstance(line.get("tokens"), int | float) for _family, line in lines):
            tokens = [float(line["tokens"]) for _family, line in lines]
            clusters = [family for family, _line in lines]
            rate = bootstrap_ratio(tokens, seconds, clusters, seed)
            figures["tokens_per_s"] = rate.to_json()
        figures["n"] = len(lines)
    figures |= {name: beside[name] for name in BESIDE if beside.get(name) is not None}
    if planning:
        figures["planning"] = _planning_times(planning, seed)
    return figures


def _planning_times(lines: Sequence[Mapping[str, Any]], seed: int) -> list[dict[str, Any]]:
    """Seconds to plan a mission with both agents, by the number of tasks that were planned.

    `mission_s` and `task_s` are the mean seconds of either agent. A plan that is not valid has no
    number of tasks and is left out.
    """
    by_tasks: dict[int, list[Mapping[str, Any]]] = {}
    for line in lines:
        if line.get("tasks"):
            by_tasks.setdefault(int(line["tasks"]), []).append(line)
    return [
        {
            "tasks": tasks,
            "n": len(found),
            "seconds": bootstrap_mean(
                [line["seconds"] for line in found], [line["id"] for line in found], seed
            ).to_json(),
            "mission_s": sum(line["mission_s"] for line in found) / len(found),
            "task_s": sum(line["task_s"] for line in found) / len(found),
        }
        for tasks, found in sorted(by_tasks.items())
    ]
