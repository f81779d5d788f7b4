"""What a system costs: latency and its quantiles, time to first token, tokens per second, memory,
loading, planning time.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from typing import Any

from planner_ft.benchmark.statistics import CONFIDENCE, Estimate, bootstrap_mean, bootstrap_ratio

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
    """Everything that a row's `costs` hold in results.json; empty where nothing was measured.

    `timed` are lines of latency.jsonl by sample id, `families` the phrasing families of samples,
    `beside` what run.json has on the candidate, `planning` the row's lines of planning.jsonl.
    """
    lines = [
        (line, families.get(sample, sample))
        for sample, line in timed.items()
        if isinstance(line.get("latency_s"), int | float)
    ]
    figures: dict[str, Any] = {}
    if lines:
        seconds = [float(line["latency_s"]) for line, _family in lines]
        clusters = [family for _line, family in lines]
        figures["latency_s"] = {
            name: quantile(seconds, share).to_json() for name, share in QUANTILES
        }
        first = [
            (float(line["first_token_s"]), family)
            for line, family in lines
            if line.get("first_token_s") is not None
        ]
        if first:
            figures["first_token_s"] = bootstrap_mean(
                [value for value, _family in first], [family for _value, family in first], seed
            ).to_json()
        if all(isinstance(line.get("tokens"), int | float) for line, _family in lines):
            figures["tokens_per_s"] = bootstrap_ratio(
                [float(line["tokens"]) for line, _family in lines], seconds, clusters, seed
            ).to_json()
        figures["n"] = len(lines)
    figures |= {name: beside[name] for name in BESIDE if beside.get(name) is not None}
    if planning:
        figures["planning"] = planning_times(planning, seed)
    return figures


def quantile(values: Sequence[float], share: float) -> Estimate:
    """The smallest value that at least `share` of the values do not exceed, with a
    distribution-free 95 % interval.

    The bounds are order statistics (David and Nagaraja, Order Statistics, 2003, section 7.1): the
    number of values below the true quantile is binomial. A bound that no order statistic can give
    with that confidence is None: the largest of 25 values is no upper bound for the 99th
    percentile.
    """
    from scipy.special import bdtr

    if not values:
        return Estimate(None)
    ordered, n, tail = sorted(values), len(values), (1 - CONFIDENCE) / 2
    # Rounding would lift the rank where n * share is whole: 0.9 * 10 must give 9.
    rank = max(1, -int(-round(n * share, 9) // 1))
    below = [count for count in range(1, n + 1) if bdtr(count - 1, n, share) <= tail]
    above = [count for count in range(1, n + 1) if bdtr(count - 1, n, share) >= 1 - tail]
    return Estimate(
        ordered[rank - 1],
        ordered[below[-1] - 1] if below else None,
        ordered[above[0] - 1] if above else None,
    )


def planning_times(lines: Sequence[Mapping[str, Any]], seed: int) -> list[dict[str, Any]]:
    """Seconds to plan a mission with both agents, by the number of tasks that were planned:
    commands whose plan has m tasks count for m.

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
            **{
                name: sum(line[name] for line in found) / len(found)
                for name in ("mission_s", "task_s")
            },
        }
        for tasks, found in sorted(by_tasks.items())
    ]
