"""Tables once, written as HTML, Markdown, CSV and LaTeX."""

from __future__ import annotations

import csv
import io
import re
from dataclasses import dataclass
from typing import Literal

from planner_ft.benchmark.layout import NOTHING
from planner_ft.benchmark.tables import TEX
from planner_ft.report.markup import Markup, join, tag

RowKind = Literal["measured", "published", "baseline"]


@dataclass(frozen=True)
class Cell:
    """A figure as text, with its interval and a mark that says whether a difference is real. `heat`
    (0 to 6) shades it.

    `bounds` are (value, low, high) as numbers, for machines.
    """

    text: str
    interval: str = ""
    mark: str = ""
    heat: int | None = None
    bounds: tuple[float | None, float | None, float | None] | None = None

    def plain(self) -> str:
        """Everything in one line."""
        return " ".join(part for part in (self.text, self.interval, self.mark) if part)


@dataclass(frozen=True)
class TableRow:
    """A row with its heading."""

    heading: str
    cells: tuple[Cell, ...]
    kind: RowKind = "measured"


@dataclass(frozen=True)
class Table:
    """A table with a file name, a title that says what it holds, and a caption that says how to
    read it.
    """

    name: str
    title: str
    caption: str
    corner: str
    columns: tuple[str, ...]
    rows: tuple[TableRow, ...]


def html_table(table: Table, *, title: bool = True) -> Markup:
    """A table under its title; wider than the screen it scrolls by itself, also by keyboard."""
    label = f"{table.name}-caption"
    head = tag(
        "tr",
        tag("th", table.corner, scope="col"),
        [tag("th", _breakable(column), scope="col") for column in table.columns],
    )
    body = [
        tag(
            "tr",
            tag("th", _breakable(row.heading), scope="row"),
            [_html_cell(cell) for cell in row.cells],
            class_=row.kind if row.kind != "measured" else None,
        )
        for row in table.rows
    ]
    above = (
        tag("div", tag("strong", table.title), " ", table.caption, class_="above")
        if title
        else None
    )
    inner = tag(
        "table",
        tag("caption", table.title, id=label, class_="unseen"),
        tag("thead", head),
        tag("tbody", body),
    )
    return join(
        [
            above,
            tag("div", inner, class_="scroll", tabindex=0, role="region", aria_labelledby=label),
        ]
    )


def _html_cell(cell: Cell) -> Markup:
    parts = [
        cell.text,
        tag("span", cell.mark, class_="sign") if cell.mark else None,
        tag("span", cell.interval, class_="interval") if cell.interval else None,
    ]
    return tag(
        "td",
        join([part for part in parts if part is not None]),
        class_=f"heat h{cell.heat}" if cell.heat is not None else None,
    )


def _breakable(label: str) -> Markup:
    """Names in camel case may break where a capital stands."""
    pieces = re.split(r"(?<=[a-z])(?=[A-Z][a-z])", label)
    return join(
        [
            piece if index == 0 else join([Markup("<wbr>"), piece])
            for index, piece in enumerate(pieces)
        ]
    )


def markdown_table(table: Table) -> str:
    """A Markdown table under its title."""
    lines = [
        f"**{table.title}** {table.caption}".strip(),
        "",
        f"| {table.corner} | {' | '.join(_md(column) for column in table.columns)} |",
    ]
    lines.append("|---|" + "---:|" * len(table.columns))
    for row in table.rows:
        heading = f"*{_md(row.heading)}*" if row.kind != "measured" else _md(row.heading)
        lines.append(f"| {heading} | {' | '.join(_md(cell.plain()) for cell in row.cells)} |")
    return "\n".join(lines) + "\n"


def _md(value: str) -> str:
    return value.replace("|", "\\|").replace("\n", " ")


def csv_table(table: Table) -> str:
    """Comma-separated values: per column the figure, and its bounds and mark where any row has
    them.
    """
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    parts = [
        _parts([row.cells[index] for row in table.rows]) for index in range(len(table.columns))
    ]
    writer.writerow(
        [
            table.corner,
            "kind",
            *(
                f"{column}{part}"
                for column, of_column in zip(table.columns, parts, strict=True)
                for part in of_column
            ),
        ]
    )
    for row in table.rows:
        values = [
            _csv_value(cell, part)
            for cell, of_column in zip(row.cells, parts, strict=True)
            for part in of_column
        ]
        writer.writerow([row.heading, row.kind, *values])
    return stream.getvalue()


def _parts(cells: list[Cell]) -> list[str]:
    bounds = (
        ["_low", "_high"]
        if any(cell.bounds and cell.bounds[1] is not None for cell in cells)
        else []
    )
    return ["", *bounds, *(["_mark"] if any(cell.mark for cell in cells) else [])]


def _csv_value(cell: Cell, part: str) -> str:
    if part == "_mark":
        return cell.mark
    if cell.bounds is None:
        return "" if part or cell.text == NOTHING else cell.text
    value = cell.bounds[("", "_low", "_high").index(part)]
    return "" if value is None else f"{value:.6g}"


def latex_table(table: Table) -> str:
    """A tabular for booktabs."""
    lines = [
        f"% {table.title}. Needs \\usepackage{{booktabs}}.",
        f"\\begin{{tabular}}{{l{'r' * len(table.columns)}}}",
        "\\toprule",
    ]
    lines += [
        " & ".join(_tex(column) for column in (table.corner, *table.columns)) + " \\\\",
        "\\midrule",
    ]
    for row in table.rows:
        heading = (
            f"\\textit{{{_tex(row.heading)}}}" if row.kind != "measured" else _tex(row.heading)
        )
        lines.append(" & ".join([heading, *(_tex_cell(cell) for cell in row.cells)]) + " \\\\")
    return "\n".join([*lines, "\\bottomrule", "\\end{tabular}", ""])


MARKS = {
    "▲": "\\blacktriangle",
    "▼": "\\blacktriangledown",
    "≈": "\\approx",
    "·": "\\cdot",
    "★": "\\star",
}


def _tex_cell(cell: Cell) -> str:
    marks = "".join(f" ${MARKS[mark]}$" if mark in MARKS else _tex(mark) for mark in cell.mark)
    text = "".join(
        f"${MARKS[letter]}$" if letter in MARKS else _tex(letter) for letter in cell.text
    )
    return (
        text.replace("–", "--")
        + (f" {{\\scriptsize {_tex(cell.interval)}}}" if cell.interval else "")
        + marks
    )


def _tex(value: str) -> str:
    return "".join(TEX.get(character, character) for character in value)
