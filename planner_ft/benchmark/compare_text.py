"""A comparison of runs as Markdown, CSV, LaTeX and in a terminal."""

from __future__ import annotations

import csv
import io

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from planner_ft.benchmark.catalogue import CATALOGUE
from planner_ft.benchmark.compare import Report
from planner_ft.benchmark.tables import tex_text
from planner_ft.benchmark.verdicts import EXPLAINED, NEITHER, UNBOUNDED, Comparison, p_text, signed

RATES = frozenset(metric.name for metric in CATALOGUE if metric.kind != "mean")
COLORS = {"better": "green", "worse": "red"}
COLUMNS = (
    "first",
    "second",
    "metric",
    "n",
    "families",
    "first_value",
    "second_value",
    "difference",
    "low",
    "high",
    "p",
    "p_mcnemar",
    "p_adjusted",
    "verdict",
)


def render_report(report: Report) -> dict[str, str]:
    """The texts of comparison.md, comparison.csv and comparison.tex."""
    return {
        "comparison.md": markdown(report),
        "comparison.csv": csv_text(report),
        "comparison.tex": latex(report),
    }


def markdown(report: Report) -> str:
    """A table per pair of rows, then notes."""
    lines = []
    for (first, second), found in _by_pair(report).items():
        lines += [
            f"**{second}** against **{first}**",
            "",
            "| Metric | n | against | this | Difference | p | p, Holm | |",
            "|---|---:|---:|---:|---:|---:|---:|---|",
        ]
        lines += [f"| {' | '.join(_cells(comparison))} |" for comparison in found]
        lines.append("")
    return "\n".join([*lines, *(f"- {note}" for note in notes(report))]) + "\n"


def csv_text(report: Report) -> str:
    """One line per comparison, all figures unrounded, rates as fractions."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(COLUMNS)
    for comparison in report.comparisons:
        values = comparison.to_json()
        difference = values.pop("difference")
        values |= {
            "difference": difference["value"],
            "low": difference["low"],
            "high": difference["high"],
        }
        writer.writerow(["" if values[name] is None else values[name] for name in COLUMNS])
    return stream.getvalue()


def latex(report: Report) -> str:
    """A tabular with all comparisons."""
    lines = ["% Needs \\usepackage{booktabs}.", "\\begin{tabular}{llrrrrrl}", "\\toprule"]
    lines.append("System & Metric & n & Against & This & Difference & $p$ (Holm) & \\\\")
    for (first, second), found in _by_pair(report).items():
        lines += [
            "\\midrule",
            f"\\multicolumn{{8}}{{l}}{{{tex_text(second)} against {tex_text(first)}}} \\\\",
        ]
        for comparison in found:
            metric, n, one, other, difference, _p, holm, verdict = _cells(comparison, mark=False)
            lines.append(
                " & ".join(
                    [
                        "",
                        *(tex_text(cell) for cell in (metric, n, one, other, difference)),
                        holm.replace("<", "$<$"),
                        verdict,
                    ]
                )
                + " \\\\"
            )
    return (
        "\n".join(
            [*lines, "\\bottomrule", "\\end{tabular}", *(f"% {note}" for note in notes(report))]
        )
        + "\n"
    )


def print_report(report: Report, console: Console) -> None:
    """Print a table per pair of rows, and notes; fits 80 columns."""
    for (first, second), found in _by_pair(report).items():
        console.print(Text.assemble((second, "bold"), " against ", (first, "bold")))
        table = Table(box=SIMPLE_HEAD, show_edge=False, pad_edge=False, padding=(0, 1, 0, 0))
        for heading in ("metric", "n", "against", "this", "difference", "p, Holm", ""):
            table.add_column(
                heading,
                justify="left" if heading in ("metric", "") else "right",
                no_wrap=heading not in ("metric", ""),
            )
        for comparison in found:
            metric, n, one, other, difference, _p, holm, verdict = _cells(comparison)
            table.add_row(
                metric,
                n,
                one,
                other,
                difference.replace(" [", "\n["),
                holm,
                Text(verdict, style=COLORS.get(comparison.verdict, "dim")),
            )
        console.print(table)
    for note in notes(report):
        console.print(Text(note, style="dim"))


def notes(report: Report) -> list[str]:
    """What a reader must know to read the comparison rightly."""
    count = sum(comparison.p_adjusted is not None for comparison in report.comparisons)
    families = max((comparison.paired.families for comparison in report.comparisons), default=0)
    return [
        (
            f"Paired by sample, whole phrasing families kept together ({families} families at"
            f" most). {EXPLAINED}."
        ),
        (
            "Differences: this minus against, 95 % bootstrap intervals. p: families swapped at"
            " random (for rates of independent samples the exact McNemar test), adjusted for the"
            f" {count} comparisons of this table. Seed {report.settings.seed}. Rates in percent."
        ),
        *report.notes,
    ]


def _by_pair(report: Report) -> dict[tuple[str, str], list[Comparison]]:
    found: dict[tuple[str, str], list[Comparison]] = {}
    for comparison in report.comparisons:
        found.setdefault((comparison.first, comparison.second), []).append(comparison)
    return found


def _cells(comparison: Comparison, *, mark: bool = True) -> tuple[str, ...]:
    """Metric, n, both values, difference, p, adjusted p, verdict."""
    paired = comparison.paired
    scale, decimals = (
        (100, 1)
        if paired.metric in RATES
        else (1, 2 if paired.metric in UNBOUNDED | NEITHER else 3)
    )
    values = (
        "–" if value is None else f"{value * scale:.{decimals}f}"
        for value in (paired.first, paired.second)
    )
    verdict = f"{comparison.mark} {comparison.verdict}".strip() if mark else comparison.verdict
    return (
        paired.metric,
        str(paired.n),
        *values,
        signed(paired.difference, scale, decimals),
        p_text(paired.p),
        p_text(comparison.p_adjusted),
        verdict,
    )
