"""A table as HTML."""

from __future__ import annotations

import re

from planner_ft.report.markup import Markup, join, tag
from planner_ft.report.tables import Cell, Table


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
