"""One table model with writers for Markdown, CSV, LaTeX and the terminal.

The benchmark's tables, comparisons and suites, the report's page and the model cards are all made
of it. Imports nothing else of the package.
"""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from rich.table import Table as RichTable

RowKind = Literal["measured", "published", "baseline", "section"]
Bounds = tuple[float | None, float | None, float | None]

NOTHING = "–"
TEX: dict[str, str] = json.loads(Path(__file__).with_name("tex.json").read_text(encoding="utf-8"))
"""What LaTeX is given for characters that it reads or lacks."""


@dataclass(frozen=True)
class Cell:
    """A figure as text, its interval, and a mark that says whether a difference is real. `bounds`
    are (value, low, high) as numbers for CSV; `heat` (0 to 6) shades the cell.
    """

    text: str
    interval: str = ""
    mark: str = ""
    heat: int | None = None
    bounds: Bounds | None = None

    def plain(self) -> str:
        """Everything in one line."""
        return " ".join(part for part in (self.text, self.interval, self.mark) if part)


@dataclass(frozen=True)
class TableRow:
    """A row with its heading. A row of kind "section" is a heading over the rows that follow."""

    heading: str
    cells: tuple[Cell, ...] = ()
    kind: RowKind = "measured"


@dataclass(frozen=True)
class Table:
    """A table: headings of `columns` behind `corner`, of which the first `texts` hold words and
    stand left; with a file name, a title, and a caption that says how to read it where it has them.
    """

    corner: str
    columns: Sequence[str]
    rows: Sequence[TableRow]
    texts: int = 0
    name: str = ""
    title: str = ""
    caption: str = ""


def row(heading: str, *cells: Cell | str, kind: RowKind = "measured") -> TableRow:
    """A row of cells, plain texts being cells without interval and mark."""
    made = tuple(Cell(cell) if isinstance(cell, str) else cell for cell in cells)
    return TableRow(heading, made, kind)


def figure(
    value: float | None,
    low: float | None = None,
    high: float | None = None,
    *,
    scale: float = 1,
    decimals: int = 2,
    mark: str = "",
    sign: bool = False,
) -> Cell:
    """A figure in the unit of its column (`scale` times the value), its interval in brackets."""

    def text(number: float | None) -> str:
        plus = "+" if sign else ""
        return NOTHING if number is None else f"{number * scale:{plus}.{decimals}f}"

    shown = value is not None and (low is not None or high is not None)
    scaled = [None if number is None else number * scale for number in (value, low, high)]
    interval = f"[{text(low)}, {text(high)}]" if shown else ""
    return Cell(text(value), interval, mark, bounds=(scaled[0], scaled[1], scaled[2]))


def markdown_table(table: Table) -> str:
    """The table under its title and caption, as far as it has them."""
    above = f"**{table.title}** {table.caption}".strip() if table.title else table.caption
    lines = [*([above, ""] if above else []), _line((table.corner, *table.columns))]
    right = len(table.columns) - table.texts
    lines.append("|---|" + "---|" * table.texts + "---:|" * right)
    for one in table.rows:
        if one.kind == "section":
            lines.append(_line([f"**{_md(one.heading)}**", *[""] * len(table.columns)]))
            continue
        heading = _md(one.heading)
        shown = f"*{heading}*" if one.kind != "measured" and heading else heading
        lines.append(_line([shown, *(_md(cell.plain()) for cell in one.cells)]))
    return "\n".join(lines) + "\n"


def _line(cells: Iterable[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def printable(text: str) -> str:
    """A text of somebody else's on one line, without characters that a terminal would obey."""
    return " ".join("".join(one if one.isprintable() else " " for one in text).split())


def _md(text: str) -> str:
    """A text on one line that cannot end its cell."""
    return printable(text).replace("|", "\\|")


def csv_text(rows: Iterable[Sequence[Any]]) -> str:
    """Lines of comma-separated values; None is an empty field."""
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerows(rows)
    return stream.getvalue()


def csv_table(table: Table) -> str:
    """Comma-separated values: per column the figure, and its bounds and mark where any row has
    them. A section's heading stands in a column of its own before its rows.
    """
    body = [one for one in table.rows if one.kind != "section"]
    parts = [_parts([one.cells[index] for one in body]) for index in range(len(table.columns))]
    columns = zip(table.columns, parts, strict=True)
    sections = ["section"] if len(body) < len(table.rows) else []
    head = [f"{name}{part}" for name, of_column in columns for part in of_column]
    lines: list[list[str]] = [[*sections, table.corner, "kind", *head]]
    section: list[str] = []
    for one in table.rows:
        if one.kind == "section":
            section = [one.heading]
            continue
        cells = zip(one.cells, parts, strict=True)
        values = [_csv_value(cell, part) for cell, of_column in cells for part in of_column]
        lines.append([*section, one.heading, one.kind, *values])
    return csv_text(lines)


def _parts(cells: list[Cell]) -> list[str]:
    bounded = any(cell.bounds and cell.bounds[1] is not None for cell in cells)
    marked = any(cell.mark for cell in cells)
    return ["", *(["_low", "_high"] if bounded else []), *(["_mark"] if marked else [])]


def _csv_value(cell: Cell, part: str) -> str:
    if part == "_mark":
        return cell.mark
    if cell.bounds is None:
        return "" if part or cell.text == NOTHING else cell.text
    value = cell.bounds[("", "_low", "_high").index(part)]
    return "" if value is None else f"{value:.6g}"


def latex_table(table: Table) -> str:
    """A tabular for booktabs."""
    width = 1 + len(table.columns)
    lines = [
        f"% {table.title}. Needs \\usepackage{{booktabs, amssymb}}.".replace("% . ", "% "),
        f"\\begin{{tabular}}{{{'l' * (1 + table.texts)}{'r' * (width - 1 - table.texts)}}}",
        "\\toprule",
        " & ".join(tex_text(name) for name in (table.corner, *table.columns)) + " \\\\",
    ]
    if not table.rows or table.rows[0].kind != "section":
        lines.append("\\midrule")
    for one in table.rows:
        heading = tex_text(one.heading)
        if one.kind == "section":
            lines += ["\\midrule", f"\\multicolumn{{{width}}}{{l}}{{\\textit{{{heading}}}}} \\\\"]
            continue
        shown = f"\\textit{{{heading}}}" if one.kind != "measured" and heading else heading
        lines.append(" & ".join([shown, *(_tex_cell(cell) for cell in one.cells)]) + " \\\\")
    return "\n".join([*lines, "\\bottomrule", "\\end{tabular}", ""])


def tex_text(text: str) -> str:
    """A text with the characters that LaTeX reads escaped."""
    return "".join(TEX.get(character, character) for character in text)


def _tex_cell(cell: Cell) -> str:
    interval = f" {{\\scriptsize {tex_text(cell.interval)}}}" if cell.interval else ""
    mark = f" {tex_text(cell.mark)}" if cell.mark else ""
    return f"{tex_text(cell.text)}{interval}{mark}"


def terminal_table(table: Table) -> RichTable:
    """A table for a rich console: intervals below figures, published and baseline rows dim."""
    from rich.box import SIMPLE_HEAD
    from rich.table import Table as RichTable
    from rich.text import Text

    shown = RichTable(box=SIMPLE_HEAD, show_edge=False, pad_edge=False, padding=(0, 1, 0, 0))
    shown.add_column(table.corner, overflow="fold")
    for index, name in enumerate(table.columns):
        left = index < table.texts
        shown.add_column(name, justify="left" if left else "right", no_wrap=not left)
    for one in table.rows:
        style = {"section": "bold", "published": "dim", "baseline": "italic"}.get(one.kind)
        cells = [
            Text.assemble(
                f"{cell.text} {cell.mark}".strip(),
                *([("\n" + cell.interval, "dim")] if cell.interval else []),
            )
            for cell in one.cells
        ]
        shown.add_row(Text(one.heading), *cells, style=style)
    return shown
