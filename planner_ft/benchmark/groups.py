"""Figures per group of the test data, where its records name one (the challenge sets are grouped by
kind of difficulty).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

FIGURES = ("n", "f1", "exact_sequence", "parameters", "whole_plan", "strict_valid")


def group_figures(scores: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Per candidate, configuration and group: `n` and means without interval (groups are small).
    Empty where no sample has a group.
    """
    found: dict[tuple[str, str, str], list[dict[str, Any]]] = {}
    for score in scores:
        if score.get("group"):
            found.setdefault(
                (score["candidate"], score["configuration"], score["group"]), []
            ).append(score)
    return [
        {
            "candidate": candidate,
            "configuration": configuration,
            "group": group,
            **_figures(members),
        }
        for (candidate, configuration, group), members in found.items()
    ]


def _figures(scores: list[dict[str, Any]]) -> dict[str, float | None]:
    n = len(scores)
    matched = sum(score["parameters_matched"] for score in scores)
    return {
        "n": n,
        "f1": sum(score["f1"] for score in scores) / n,
        "exact_sequence": sum(score["exact_sequence"] for score in scores) / n,
        "parameters": (
            sum(score["parameters_right"] for score in scores) / matched if matched else None
        ),
        "whole_plan": sum(score["failure"] is None for score in scores) / n,
        "strict_valid": sum(score["strict_valid"] for score in scores) / n,
    }


def groups_markdown(figures: Sequence[dict[str, Any]]) -> list[str]:
    """A table in Markdown: one line per group and configuration."""
    if not figures:
        return []
    lines = [
        "| Group | n | System | F1 | Exact sequence (%) | Parameters right (%) | Whole plan right"
        " (%) | Strictly valid (%) |"
    ]
    lines.append("|---|---:|---|---:|---:|---:|---:|---:|")
    for entry in sorted(figures, key=lambda entry: entry["group"]):
        rates = ("–" if entry[name] is None else f"{100 * entry[name]:.0f}" for name in FIGURES[2:])
        system = f"{entry['candidate']}, {entry['configuration']}"
        lines.append(
            f"| {entry['group']} | {entry['n']} | {system} | {entry['f1']:.2f} |"
            f" {' | '.join(rates)} |"
        )
    return [*lines, ""]
