"""The tables of what a system costs, as Markdown."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from planner_ft.benchmark.costs import QUANTILES
from planner_ft.support.resources import memory_size

HEADINGS = (
    *(f"Latency {name} (s)" for name, _share in QUANTILES),
    "First token (s)",
    "Tokens/s",
    "Load (s)",
    "Adapter switch (s)",
    "Peak memory",
)


def costs_markdown(costs: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """A line per system, and planning time by number of tasks; `costs` are those of rows by name.
    Nothing where nothing was measured.
    """
    known = {name: figures for name, figures in costs.items() if figures}
    if not known:
        return []
    lines = [
        "| Cost | timed queries | " + " | ".join(HEADINGS) + " |",
        "|---|---:|" + "---:|" * len(HEADINGS),
    ]
    lines += [
        f"| {name} | {figures.get('n', 0)} | " + " | ".join(_cells(figures)) + " |"
        for name, figures in known.items()
    ]
    return [
        *lines,
        "",
        *_planning(
            {
                name: figures["planning"]
                for name, figures in known.items()
                if figures.get("planning")
            }
        ),
    ]


def _cells(figures: Mapping[str, Any]) -> list[str]:
    latency = figures.get("latency_s", {})
    memory, load, swap = (
        figures.get("peak_memory_bytes"),
        figures.get("load_s"),
        figures.get("adapter_swap_s"),
    )
    return [
        *(_estimate(latency.get(name), 2) for name, _share in QUANTILES),
        _estimate(figures.get("first_token_s"), 3),
        _estimate(figures.get("tokens_per_s"), 0),
        "–" if load is None else f"{load:.1f}",
        "–" if swap is None else f"{swap:.4f}",
        "–" if memory is None else memory_size(memory),
    ]


def _planning(planning: Mapping[str, list[dict[str, Any]]]) -> list[str]:
    if not planning:
        return []
    most = max(entry["tasks"] for entries in planning.values() for entry in entries)
    numbers = range(1, most + 1)
    lines = [
        "| Seconds to plan a mission of m tasks, both agents; m = | "
        + " | ".join(map(str, numbers))
        + " |",
        "|---|" + "---:|" * most,
    ]
    for name, entries in planning.items():
        by_tasks = {
            entry["tasks"]: f"{entry['seconds']['value']:.2f} (n = {entry['n']})"
            for entry in entries
        }
        lines.append(
            f"| {name} | " + " | ".join(by_tasks.get(number, "–") for number in numbers) + " |"
        )
    return [*lines, ""]


def _estimate(found: Mapping[str, Any] | None, decimals: int) -> str:
    if not found or found.get("value") is None:
        return "–"
    low, high = (
        "" if found.get(bound) is None else f"{found[bound]:.{decimals}f}"
        for bound in ("low", "high")
    )
    return f"{found['value']:.{decimals}f}" + (
        f" [{low or '–'}, {high or '–'}]" if low or high else ""
    )
