"""Tables as HTML, Markdown, CSV and LaTeX."""

from __future__ import annotations

import csv
import io

from rich.console import Console

from planner_ft.report.charts import number
from planner_ft.report.write import templates
from planner_ft.support.tables import (
    Cell,
    Table,
    TableRow,
    csv_table,
    figure,
    latex_table,
    markdown_table,
    row,
    terminal_table,
)

TABLE = Table(
    "System",
    ("F1 ↑", "A & B (%)"),
    (
        TableRow(
            "one|two <x>", (Cell("0.50", "[0.25, 0.75]", "▲", bounds=(0.5, 0.25, 0.75)), Cell("12"))
        ),
        TableRow("theirs", (Cell("0.61", bounds=(0.61, None, None)), Cell("–")), "published"),
    ),
    title="A table",
    caption="Read it.",
)


def test_html_is_escaped_and_names_its_rows_and_columns() -> None:
    text = str(templates().get_template("table.html.j2").module.html_table(TABLE))
    assert "one|two &lt;x&gt;" in text
    assert text.count('scope="col"') == 3
    assert text.count('scope="row"') == 2
    assert "<caption" in text
    assert 'tabindex="0"' in text


def test_markdown_has_a_line_per_row_and_its_bars_are_escaped() -> None:
    lines = markdown_table(TABLE).splitlines()
    assert "| one\\|two <x> | 0.50 [0.25, 0.75] ▲ | 12 |" in lines
    assert "| *theirs* | 0.61 | – |" in lines


def test_csv_reads_back_with_bounds_as_numbers() -> None:
    rows = list(csv.DictReader(io.StringIO(csv_table(TABLE))))
    assert (rows[0]["F1 ↑"], rows[0]["F1 ↑_low"], rows[0]["F1 ↑_high"], rows[0]["F1 ↑_mark"]) == (
        "0.5",
        "0.25",
        "0.75",
        "▲",
    )
    assert (rows[1]["kind"], rows[1]["F1 ↑_low"], rows[1]["A & B (%)"]) == ("published", "", "")


def test_latex_is_escaped_and_balanced() -> None:
    text = latex_table(TABLE)
    assert "A \\& B (\\%)" in text
    assert "$\\blacktriangle$" in text
    body = [line for line in text.splitlines() if line.endswith("\\\\")]
    assert {line.count(" & ") for line in body} == {2}


def test_numbers_are_short() -> None:
    assert [number(value) for value in (None, 0, 0.12345, 12.345, 1234.5, 1e9)] == [
        "–",
        "0",
        "0.123",
        "12.3",
        "1,234",
        "1.00e+09",
    ]


def test_sections_head_the_rows_that_follow_in_every_form() -> None:
    rows = (row("Data", kind="section"), row("ours", "lora", figure(0.5, 0.25, 0.75, scale=100)))
    table = Table("Model", ("Configuration", "F1 (%)"), rows, texts=1)
    assert "| **Data** |  |  |" in markdown_table(table).splitlines()
    assert "\\multicolumn{3}{l}{\\textit{Data}} \\\\" in latex_table(table)
    assert list(csv.DictReader(io.StringIO(csv_table(table)))) == [
        {
            "section": "Data",
            "Model": "ours",
            "kind": "measured",
            "Configuration": "lora",
            "F1 (%)": "50",
            "F1 (%)_low": "25",
            "F1 (%)_high": "75",
        }
    ]
    console = Console(width=60, file=io.StringIO(), record=True)
    console.print(terminal_table(table))
    shown = console.export_text()
    assert "50.00" in shown
    assert "[25.00, 75.00]" in shown
