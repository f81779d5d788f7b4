"""report.html: one file that holds everything and asks nobody for anything."""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from planner_ft.report.answers import index, parts, script_json
from planner_ft.report.charts import Bars, Chart, Dots, Lines, Matrix
from planner_ft.report.contents import Section, Sentence
from planner_ft.report.figures import chart_rows
from planner_ft.report.html_table import html_table
from planner_ft.report.markup import Markup, join, tag
from planner_ft.report.runs import TestSet
from planner_ft.report.svg import both_widths, draw
from planner_ft.report.tables import Cell, Table, TableRow

ASSETS = Path(__file__).parent / "assets"
HEATS = 6


def page(sections: Sequence[Section], title: str, provenance: Sequence[tuple[str, str]]) -> str:
    """The whole document. The policy lets only this style sheet and this script run, and nothing be
    loaded from anywhere.
    """
    style, script = (
        (ASSETS / name).read_text(encoding="utf-8") for name in ("report.css", "report.js")
    )
    policy = (
        f"default-src 'none'; style-src {_hash(style)}; script-src {_hash(script)}; base-uri"
        " 'none'; form-action 'none'"
    )
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", http_equiv="Content-Security-Policy", content=policy),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("meta", name="color-scheme", content="light dark"),
        tag("title", title),
        tag("style", Markup(style)),
    )
    main = tag(
        "main",
        [_section(section, number) for number, section in enumerate(sections)],
        _provenance(provenance),
        id="main",
    )
    body = tag(
        "body",
        tag("a", "Skip to the figures", href="#main", class_="skip"),
        _header(title, sections),
        main,
        tag("script", Markup(script)),
    )
    return f"<!doctype html>\n{tag('html', head, body, lang='en')}\n"


def _hash(content: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(content.encode()).digest()).decode()}'"


def _header(title: str, sections: Sequence[Section]) -> Markup:
    several = len(sections) > 1
    links = []
    for section in sections:
        key = section.tests.key
        inner = [
            tag("a", label, href=f"#{key}-{part}")
            for part, label in (
                ("table", "Metrics"),
                ("figures", "Figures"),
                ("samples", "Every sample"),
            )
        ]
        links.append(
            tag(
                "li",
                tag("a", section.tests.title, href=f"#{key}") if several else None,
                [tag("span", link) for link in inner],
            )
        )
    links.append(tag("li", tag("a", "How it was measured", href="#provenance")))
    return tag("header", tag("h1", title), tag("nav", tag("ul", links), aria_label="Contents"))


def _section(section: Section, number: int) -> Markup:
    tests = section.tests
    parts_ = [
        tag("h2", tests.title),
        _sentences(section.summary),
        tag("h3", "Metrics", id=f"{tests.key}-table"),
        html_table(section.main),
        tag("p", section.legend, class_="legend") if section.legend else None,
        _notes(section.notes),
        [html_table(table) for table in section.extra],
        (
            tag(
                "details",
                tag("summary", "Which differences are real"),
                html_table(section.differences),
            )
            if section.differences
            else None
        ),
        tag(
            "details",
            tag("summary", "All metrics"),
            [html_table(table) for table in section.all_metrics],
        ),
        tag("h3", "Figures", id=f"{tests.key}-figures"),
        [_figure(chart) for chart in section.charts],
        [
            _per_system(name, charts, opened=position == 0)
            for position, (name, charts) in enumerate(section.per_system)
        ],
        _explorer(tests, number),
    ]
    return tag(
        "section", join([part for part in parts_ if part is not None]), id=tests.key, class_="tests"
    )


def _sentences(sentences: Sequence[Sentence]) -> Markup | None:
    if not sentences:
        return None
    return tag(
        "ul",
        [tag("li", tag("strong", sentence.lead), " ", sentence.text) for sentence in sentences],
        class_="summary",
    )


def _notes(notes: Sequence[str]) -> Markup | None:
    return (
        tag(
            "details",
            tag("summary", f"Notes ({len(notes)})"),
            tag("ul", [tag("li", note) for note in notes]),
            class_="notes",
        )
        if notes
        else None
    )


def _figure(chart: Chart) -> Markup:
    if isinstance(chart, Matrix):
        return tag("figure", html_table(matrix_table(chart)), id=chart.name)
    caption = tag("figcaption", tag("strong", chart.title), " ", chart.caption)
    return tag(
        "figure",
        caption,
        both_widths(lambda width: draw(chart, width)),
        _as_table(chart),
        id=chart.name,
    )


def _as_table(chart: Bars | Lines | Dots) -> Markup:
    columns, rows = chart_rows(chart)
    table = Table(
        f"{chart.name}-data",
        chart.title,
        "",
        columns[0],
        columns[1:],
        tuple(TableRow(row[0], tuple(Cell(text) for text in row[1:])) for row in rows),
    )
    return tag(
        "details",
        tag("summary", "The same in figures"),
        html_table(table, title=False),
        class_="data",
    )


def matrix_table(chart: Matrix) -> Table:
    """Counts as a shaded table."""
    largest = chart.largest or 1
    rows = tuple(
        TableRow(
            name,
            tuple(_count(count, largest) for count in counts),
            "published" if "(published" in name else "measured",
        )
        for name, counts in zip(chart.rows, chart.counts, strict=True)
    )
    return Table(chart.name, chart.title, chart.caption, chart.corner, chart.columns, rows)


def _count(count: int | None, largest: int) -> Cell:
    return (
        Cell("–")
        if count is None
        else Cell(str(count), heat=-(-HEATS * count // largest), bounds=(count, None, None))
    )


def _per_system(name: str, charts: Sequence[Chart], *, opened: bool) -> Markup:
    return tag(
        "details",
        tag("summary", f"Tasks and skills one by one: {name}"),
        [_figure(chart) for chart in charts],
        class_="system",
        open=opened,
    )


def _explorer(tests: TestSet, number: int) -> Markup:
    """The place of the samples: the script fills it from the data below."""
    found = index(tests)
    data = [
        tag("script", Markup(script_json(found)), type="application/json", id=f"index-{number}")
    ]
    data += [
        tag("script", Markup(part), type="text/plain", id=f"part-{number}-{position}")
        for position, part in enumerate(parts(tests))
    ]
    return join(
        [
            tag("h3", "Every sample", id=f"{tests.key}-samples"),
            tag(
                "noscript",
                tag(
                    "p",
                    "The samples need JavaScript; predictions.jsonl and scores.jsonl hold them, too.",
                ),
            ),
            tag("div", class_="explorer", data_number=number, data_label=tests.title),
            data,
        ]
    )


def _provenance(entries: Sequence[tuple[str, Any]]) -> Markup:
    rows = [[tag("dt", name), tag("dd", value)] for name, value in entries]
    return tag("section", tag("h2", "How it was measured"), tag("dl", rows), id="provenance")
