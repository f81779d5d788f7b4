"""table.md, table.csv and table.tex, in the layout of the published tables: per metric the
configurations side by side.
"""

from __future__ import annotations

import csv
import io

from planner_ft.benchmark import sections
from planner_ft.benchmark.changes import changes_markdown
from planner_ft.benchmark.contrasts_text import contrasts_markdown
from planner_ft.benchmark.costs_text import costs_markdown
from planner_ft.benchmark.groups import groups_markdown
from planner_ft.benchmark.layout import (
    COLUMNS,
    MORE_COLUMNS,
    NOTHING,
    Column,
    TableRow,
    baseline_rows,
    configurations,
    heading,
    measured_configurations,
    measured_rows,
    notes,
    shows_published,
    system_name,
    table_rows,
)
from planner_ft.benchmark.metrics import FAILURES
from planner_ft.benchmark.metrics.failures import PUBLISHED
from planner_ft.benchmark.repeats import repeats_markdown
from planner_ft.benchmark.results import Results
from planner_ft.benchmark.statistics import Estimate


def render_tables(results: Results) -> dict[str, str]:
    """The texts of table.md, table.csv and table.tex."""
    return {
        "table.md": markdown(results),
        "table.csv": csv_table(results),
        "table.tex": latex(results),
    }


def markdown(results: Results) -> str:
    """table.md: the published layout, what it leaves out, failures by kind, names, order and
    parameters apart, notes.
    """
    lines = [*_markdown_table(table_rows(results), COLUMNS, configurations(results)), ""]
    lines += [
        *_markdown_table(
            [*measured_rows(results), *baseline_rows(results)],
            MORE_COLUMNS,
            measured_configurations(results),
        ),
        "",
    ]
    lines += [
        "| Wrong answers by kind | n | " + " | ".join(FAILURES) + " |",
        "|---|" + "---:|" * (len(FAILURES) + 1),
    ]
    lines += [
        f"| {system_name(row)} | {row.n} | "
        + " | ".join(str(row.failures[kind]) for kind in FAILURES)
        + " |"
        for row in results.rows
    ]
    if results.level == "mission" and shows_published(results):
        lines.append(
            "| mission agent (published) | 25 | "
            + " | ".join(str(PUBLISHED.get(kind, 0)) for kind in FAILURES)
            + " |"
        )
    lines += ["", *(line for part in sections.PARTS for line in part(results))]
    lines += costs_markdown({system_name(row): row.costs for row in results.rows})
    lines += [
        *contrasts_markdown(results),
        *repeats_markdown({system_name(row): row.repeats or {} for row in results.rows}),
    ]
    lines += [*changes_markdown(results.changes), *groups_markdown(results.groups)]
    lines += [f"- {note}" for note in notes(results)]
    return "\n".join(lines) + "\n"


def csv_table(results: Results) -> str:
    """table.csv: the published columns (rates in percent) with interval bounds, then the other
    metrics.
    """
    names = configurations(results)
    columns = {
        column.metric: column for column in (*COLUMNS, *MORE_COLUMNS, *sections.section_columns())
    }.values()
    keys = [(column, configuration) for column in columns for configuration in names]
    rows = table_rows(results)
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(
        [
            "model",
            "source",
            "n",
            *(
                f"{column.metric}_{configuration}{bound}"
                for column, configuration in keys
                for bound in ("", "_low", "_high")
            ),
            *_marked(rows),
        ]
    )
    for row in rows:
        values: list[str] = []
        for column, configuration in keys:
            estimate = row.cells.get((column.metric, configuration), Estimate(None))
            values += [
                "" if bound is None else f"{bound * column.scale:.6g}"
                for bound in (estimate.value, estimate.low, estimate.high)
            ]
        writer.writerow([row.model, row.source, row.n, *values, *_marked(rows, row)])
    return stream.getvalue()


def _marked(rows: list[TableRow], row: TableRow | None = None) -> list[str]:
    """The headings of the columns with marks, or a row's marks."""
    keys = list(dict.fromkeys(key for one in rows for key in one.marks))
    return (
        [row.marks.get(key, "") for key in keys]
        if row
        else [f"{metric}_{configuration}_mark" for metric, configuration in keys]
    )


def latex(results: Results) -> str:
    """table.tex: a tabular in the published layout."""
    names = configurations(results)
    width = len(names)
    first = " & ".join(
        f"\\multicolumn{{{width}}}{{c}}{{{tex_text(f'{column.heading} {column.better}'.strip())}}}"
        for column in COLUMNS
    )
    rules = " ".join(
        f"\\cmidrule(lr){{{2 + index * width}-{1 + (index + 1) * width}}}"
        for index in range(len(COLUMNS))
    )
    second = " & ".join(tex_text(heading(name)) for _column in COLUMNS for name in names)
    lines = [
        "% Needs \\usepackage{booktabs, amssymb}.",
        f"\\begin{{tabular}}{{l{'r' * width * len(COLUMNS)}}}",
        "\\toprule",
        f"Model & {first} \\\\",
        rules,
        f" & {second} \\\\",
        "\\midrule",
    ]
    for row in table_rows(results):
        cells = [_tex_cell(column, row, name) for column in COLUMNS for name in names]
        model = (
            f"\\textit{{{tex_text(row.model)}}}"
            if row.source == "published"
            else tex_text(row.model)
        )
        lines.append(f"{model} & {' & '.join(cells)} \\\\")
    lines += ["\\bottomrule", "\\end{tabular}", *(f"% {note}" for note in notes(results))]
    return "\n".join(lines) + "\n"


def _markdown_table(
    rows: list[TableRow], columns: tuple[Column, ...], names: list[str]
) -> list[str]:
    pairs = [(column, name) for column in columns for name in names]
    lines = [
        "| Model | n | "
        + " | ".join(
            f"{column.heading} {column.better} {heading(name)}".replace("  ", " ")
            for column, name in pairs
        )
        + " |"
    ]
    lines.append("|---|---:|" + "---:|" * len(pairs))
    for row in rows:
        cells = [_cell(column, row, name) for column, name in pairs]
        lines.append(f"| {row.model} | {row.n} | " + " | ".join(cells) + " |")
    return lines


def _cell(column: Column, row: TableRow, name: str) -> str:
    estimate = row.cells.get((column.metric, name), Estimate(None))
    return (
        f"{column.text(estimate.value, source=row.source)} {column.interval(estimate)}"
        f" {row.marks.get((column.metric, name), '')}".rstrip()
    )


def _tex_cell(column: Column, row: TableRow, name: str) -> str:
    estimate = row.cells.get((column.metric, name), Estimate(None))
    interval = column.interval(estimate)
    return (
        column.text(estimate.value, source=row.source).replace(NOTHING, "--")
        + (f" {{\\scriptsize {interval}}}" if interval else "")
        + tex_text(row.marks.get((column.metric, name), ""))
    )


TEX = {
    "▲": "$\\blacktriangle$",
    "▼": "$\\blacktriangledown$",
    "≈": "$\\approx$",
    "·": "$\\cdot$",
    "★": "$\\star$",
    "\\": "\\textbackslash{}",
    "~": "\\textasciitilde{}",
    "^": "\\textasciicircum{}",
    "↑": "$\\uparrow$",
    "↓": "$\\downarrow$",
    **{character: f"\\{character}" for character in "&%$#_{}"},
}


def tex_text(text: str) -> str:
    return "".join(TEX.get(character, character) for character in text)
