"""How tables show which differences are real: marks beside figures, two tables, sentences about the
baselines.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from planner_ft.benchmark.contrasts import DECISIVE
from planner_ft.benchmark.verdicts import EXPLAINED, Comparison, p_text, signed

if TYPE_CHECKING:
    from planner_ft.benchmark.results import Results

BEST = "★"
SCALES = {"f1": (1, 3)}
"""Scale and decimals of a metric's difference; others are shares in points."""


def marks(results: Results) -> dict[tuple[str, str], str]:
    """Marks by (system, metric): against the configuration that the row is compared with, and ★ for
    the best of a column and its equals.
    """
    found = {
        (one.second, one.paired.metric): one.mark for one in results.contrasts["configuration"]
    }
    best = {(one.first, one.paired.metric) for one in results.contrasts["best"]}
    best |= {
        (one.second, one.paired.metric)
        for one in results.contrasts["best"]
        if one.verdict in ("equal", "not told apart", "better")
    }
    for key in best:
        found[key] = found.get(key, "") + BEST
    return found


def contrast_notes(results: Results) -> list[str]:
    """What the marks mean, and whether each row beats the baselines."""
    lines = []
    if results.contrasts["configuration"]:
        lines.append(
            "Marks, paired by sample with the model's first configuration (enforced with free):"
            f" {EXPLAINED}."
        )
    if results.contrasts["best"]:
        lines.append(
            f"{BEST}: the best of its column, or not shown to be worse (same tests, adjusted for"
            " all models and metrics)."
        )
    lines += results.baseline_notes
    lines += _sentences(results.contrasts["baseline"])
    return lines


def contrasts_markdown(results: Results) -> list[str]:
    """Differences between the configurations of a model, and of every row from the baselines;
    nothing where there are none.
    """
    lines: list[str] = []
    if found := results.contrasts["configuration"]:
        metrics = list(dict.fromkeys(one.paired.metric for one in found))
        lines += _table(
            "Difference, paired by sample",
            found,
            [(metric, metric) for metric in metrics],
            lambda one: one.paired.metric,
        )
    if found := results.contrasts["baseline"]:
        columns = [
            (f"{metric} against {first}", f"{metric} {first}")
            for metric in DECISIVE
            for first in dict.fromkeys(_plain(one.first) for one in found)
        ]
        lines += _table(
            "Against the baselines",
            found,
            columns,
            lambda one: f"{one.paired.metric} {_plain(one.first)}",
            by_first=False,
        )
    return lines


def _table(
    title: str,
    found: Sequence[Comparison],
    columns: Sequence[tuple[str, str]],
    key: object,
    *,
    by_first: bool = True,
) -> list[str]:
    assert callable(key)
    rows: dict[str, dict[str, Comparison]] = {}
    for one in found:
        rows.setdefault(f"{one.second} against {one.first}" if by_first else one.second, {})[
            key(one)
        ] = one
    lines = [
        f"| {title} | " + " | ".join(_heading(text) for text, _key in columns) + " |",
        "|---|" + "---:|" * len(columns),
    ]
    lines += [
        f"| {name} | " + " | ".join(_cell(row.get(column)) for _text, column in columns) + " |"
        for name, row in rows.items()
    ]
    return [*lines, ""]


def _heading(text: str) -> str:
    metric = text.split(" ")[0]
    return text.replace("_", " ") if metric in SCALES else f"{text.replace('_', ' ')} (points)"


def _cell(one: Comparison | None) -> str:
    if one is None or one.paired.difference.value is None:
        return "–"
    scale, decimals = SCALES.get(one.paired.metric, (100, 1))
    return f"{signed(one.paired.difference, scale, decimals)} {one.mark}".strip()


def _plain(name: str) -> str:
    return name.removesuffix(" baseline")


def _sentences(found: Iterable[Comparison]) -> list[str]:
    """One sentence per row: which baselines it beats, and by what."""
    rows: dict[str, list[Comparison]] = {}
    for one in found:
        rows.setdefault(one.second, []).append(one)
    lines = []
    for name, comparisons in rows.items():
        beaten, others = (
            _said([one for one in comparisons if (one.verdict == "better") is kind])
            for kind in (True, False)
        )
        parts = ([f"beats {beaten}"] if beaten else []) + (
            [f"is not shown to beat {others}"] if others else []
        )
        lines.append(f"{name} {', but '.join(parts)}.")
    return lines


def _said(comparisons: Sequence[Comparison]) -> str:
    """Baselines with the metrics in brackets."""
    by_first: dict[str, list[str]] = {}
    for one in comparisons:
        by_first.setdefault(_plain(one.first), []).append(
            f"{one.paired.metric.replace('_', ' ')}: p {p_text(one.p_adjusted)}"
        )
    return " and ".join(f"the {name} ({', '.join(found)})" for name, found in by_first.items())
