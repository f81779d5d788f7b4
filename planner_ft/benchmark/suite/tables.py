"""The files of a suite: a folder per data set, and one overview of all."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from planner_ft.benchmark import folder
from planner_ft.benchmark.catalogue import METRICS
from planner_ft.benchmark.layout import heading
from planner_ft.benchmark.results import Row
from planner_ft.benchmark.statistics import Estimate
from planner_ft.benchmark.suite.combine import PartResults
from planner_ft.benchmark.tables import TEX, render_tables
from planner_ft.support.files import write_json, write_jsonl, write_text

FIGURES = (
    ("f1", "F1", 1, 2),
    ("whole_plan", "whole plan right %", 100, 1),
    ("latency_s", "latency s", 1, 2),
)
"""Metric, heading, scale and decimals of the overview."""
GROUPS = (
    (False, "Published-size splits"),
    (True, "Reported apart: data beyond the published size"),
)


def write_suite(
    out: Path, title: str, parts: Sequence[PartResults], manifest: dict[str, Any]
) -> None:
    """Write PART/ and the overview of all parts into `out`; results.json last, so that it is there
    only when all is.
    """
    for part in parts:
        _write_part(out / part.part.name, part)
    write_text(out / "table.md", overview_markdown(title, parts))
    write_text(out / "table.csv", overview_csv(parts))
    write_text(out / "table.tex", overview_latex(parts))
    write_json(
        out / folder.RESULTS,
        {"title": title, "parts": [_part_json(part) for part in parts], "manifest": manifest},
    )


def overview_markdown(title: str, parts: Sequence[PartResults]) -> str:
    """F1, whole plans and latency of everything on one page; what could not be measured is named
    with the reason.
    """
    lines = [f"# {title}", ""]
    for apart, name in GROUPS:
        shown = [part for part in parts if part.part.apart is apart]
        if shown:
            lines += [f"## {name}", ""]
        for part in shown:
            lines += [
                f"### {part.part.name}: {part.part.level} level, n = {part.results.data['n']}",
                "",
                *_markdown_part(part),
                "",
            ]
    failed = [(part, entry) for part in parts for entry in part.failed]
    if failed:
        lines += [
            "## Not measured",
            "",
            *_failed_lines([(part.part.name, entry) for part, entry in failed]),
            "",
        ]
    lines += [
        "In brackets 95 % intervals. Every metric, published figures and notes: table.md in the"
        " folder of each data set."
    ]
    return "\n".join(lines) + "\n"


def overview_csv(parts: Sequence[PartResults]) -> str:
    """A line per data set, candidate and configuration with every metric; rates are fractions.
    Failed ones have a reason and no figures.
    """
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    bounds = ("", "_low", "_high")
    writer.writerow(
        [
            "data",
            "level",
            "apart",
            "n",
            "model",
            "candidate",
            "configuration",
            "status",
            "reason",
            *(f"{name}{end}" for name in METRICS for end in bounds),
        ]
    )
    for part in parts:
        common = [part.part.name, part.part.level, int(part.part.apart), part.results.data["n"]]
        for row in (*part.results.rows, *part.results.baselines):
            estimates = [row.metrics.get(name, Estimate(None)) for name in METRICS]
            figures = [
                "" if value is None else f"{value:.6g}"
                for found in estimates
                for value in (found.value, found.low, found.high)
            ]
            status = "baseline" if row.system.is_baseline else "measured"
            writer.writerow(
                [
                    *common,
                    row.system.label,
                    row.system.candidate,
                    row.system.configuration,
                    status,
                    "",
                    *figures,
                ]
            )
        for entry in part.failed:
            writer.writerow(
                [
                    *common,
                    entry.label,
                    entry.candidate,
                    entry.configuration,
                    "failed",
                    entry.reason,
                    *[""] * (3 * len(METRICS)),
                ]
            )
    return stream.getvalue()


def overview_latex(parts: Sequence[PartResults]) -> str:
    """A tabular with the overview, data sets one below the other."""
    lines = [
        "% Needs \\usepackage{booktabs}.",
        f"\\begin{{tabular}}{{ll{'r' * len(FIGURES)}}}",
        "\\toprule",
    ]
    lines.append(
        " & ".join(
            [
                "Model",
                "Configuration",
                *(_tex(name) for _metric, name, _scale, _decimals in FIGURES),
            ]
        )
        + " \\\\"
    )
    for part in sorted(parts, key=lambda part: part.part.apart):
        where = (
            f"{part.part.name}: {part.part.level} level, n ="
            f" {part.results.data['n']}{', reported apart' if part.part.apart else ''}"
        )
        lines += [
            "\\midrule",
            f"\\multicolumn{{{2 + len(FIGURES)}}}{{l}}{{\\textit{{{_tex(where)}}}}} \\\\",
        ]
        for row in part.results.rows:
            lines.append(
                " & ".join(
                    _tex(text)
                    for text in [
                        row.system.label,
                        heading(row.system.configuration),
                        *_figures(row),
                    ]
                )
                + " \\\\"
            )
        for row in part.results.baselines:
            lines.append(
                " & ".join(_tex(text) for text in [row.system.label, "", *_figures(row)]) + " \\\\"
            )
        for entry in part.failed:
            reason = f"\\multicolumn{{{len(FIGURES)}}}{{l}}{{not measured}}"
            lines += [
                f"{_tex(entry.label)} & {_tex(heading(entry.configuration))} & {reason} \\\\ %"
                f" {entry.reason}"
            ]
    return "\n".join([*lines, "\\bottomrule", "\\end{tabular}"]) + "\n"


def _write_part(where: Path, part: PartResults) -> None:
    where.mkdir(parents=True, exist_ok=True)
    write_jsonl(where / folder.SCORES, part.results.scores)
    write_jsonl(where / folder.BASELINES, part.results.baseline_scores)
    texts = render_tables(part.results) if part.results.rows else dict.fromkeys(folder.TABLES, "")
    for name, text in texts.items():
        write_text(where / name, text + _not_measured(name, part))
    write_json(where / folder.RESULTS, _part_json(part) | part.results.to_json())


def _not_measured(name: str, part: PartResults) -> str:
    """What a table of one data set says about the systems that it lacks."""
    if not part.failed:
        return ""
    if name == "table.md":
        return (
            "\n".join(
                [
                    "",
                    "Not measured:",
                    "",
                    *_failed_lines([(part.part.name, entry) for entry in part.failed]),
                ]
            )
            + "\n"
        )
    if name == "table.tex":
        return "".join(
            f"% not measured: {entry.label}, {heading(entry.configuration)}: {entry.reason}\n"
            for entry in part.failed
        )
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    for entry in part.failed:
        writer.writerow(
            [
                entry.label,
                f"not measured ({entry.configuration}): {entry.reason}",
                part.results.data["n"],
            ]
        )
    return stream.getvalue()


def _part_json(part: PartResults) -> dict[str, Any]:
    failed = [
        {
            "candidate": entry.candidate,
            "label": entry.label,
            "configuration": entry.configuration,
            "reason": entry.reason,
        }
        for entry in part.failed
    ]
    rows = [row.to_json() for row in part.results.rows]
    return {
        "name": part.part.name,
        "apart": part.part.apart,
        "level": part.part.level,
        "data": part.results.data,
        "rows": rows,
        "failed": failed,
    }


def _markdown_part(part: PartResults) -> list[str]:
    lines = [
        "| Model | Configuration | "
        + " | ".join(name for _metric, name, _scale, _decimals in FIGURES)
        + " |",
        "|---|---|" + "---:|" * len(FIGURES),
    ]
    lines += [
        f"| {row.system.label} | {heading(row.system.configuration)} | "
        + " | ".join(_figures(row))
        + " |"
        for row in part.results.rows
    ]
    lines += [
        f"| {row.system.label} | – | " + " | ".join(_figures(row)) + " |"
        for row in part.results.baselines
    ]
    return lines + [
        f"| {entry.label} | {heading(entry.configuration)} | not measured |"
        + " |" * (len(FIGURES) - 1)
        for entry in part.failed
    ]


def _figures(row: Row) -> list[str]:
    texts = []
    for metric, _name, scale, decimals in FIGURES:
        found = row.metrics.get(metric, Estimate(None))
        value, *bounds = (
            "–" if number is None else f"{number * scale:.{decimals}f}"
            for number in (found.value, found.low, found.high)
        )
        texts.append(value if found.low is None else f"{value} [{', '.join(bounds)}]")
    return texts


def _failed_lines(failed: Sequence[tuple[str, Any]]) -> list[str]:
    lines = ["| Data | Model | Configuration | Why |", "|---|---|---|---|"]
    return lines + [
        f"| {part} | {entry.label} | {heading(entry.configuration)} |"
        f" {entry.reason.replace('|', '/')} |"
        for part, entry in failed
    ]


def _tex(text: str) -> str:
    return "".join(TEX.get(character, character) for character in text)
