"""Charts as PNG and SVG."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from io import BytesIO

import pytest

from planner_ft.report.charts import Chart, cell
from planner_ft.report.pictures import NARROW, PALETTE, WIDE, inline_svg, picture
from planner_ft.support.tables import Cell, Table, TableRow, row

HOSTILE = "<b> $x_1$ & " + 60 * "long "


def table(name: str, columns: tuple[str, ...], *rows: TableRow) -> Table:
    return Table("", columns, rows, name=name, title=name.capitalize())


CHARTS = [
    Chart(
        "bars",
        table(
            "bars",
            ("F1", "seconds"),
            row("one", cell(0.5, 0.4, 0.6), cell(1.5)),
            row(HOSTILE, cell(None), cell(None)),
            row("three", cell(1), cell(2), kind="baseline"),
        ),
        groups=("Base", "", "Base"),
    ),
    Chart(
        "lines",
        table(
            "lines",
            ("tasks", "seconds", "samples"),
            row("one", cell(1), cell(0.5, 0.4, 0.7), "3"),
            row("one", cell(4), cell(1.5), "1"),
            row(HOSTILE, cell(2), cell(0), "1"),
        ),
    ),
    Chart(
        "dots",
        table(
            "dots",
            ("precision", "recall", "right"),
            row("one", cell(0.5), cell(None), "1 / 2"),
            row(HOSTILE, cell(1), cell(1), ""),
        ),
        "share",
        high=1.0,
    ),
    Chart("matrix", table("matrix", ("two",), row("one", cell(3)), row(HOSTILE, Cell("–")))),
]


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("chart", CHARTS, ids=lambda chart: chart.table.name)
def test_a_chart_is_a_png_and_an_svg_whose_letters_stay_text(chart: Chart) -> None:
    files = picture(chart)
    assert files["png"].startswith(b"\x89PNG")
    texts = [
        "".join(node.itertext())
        for node in (
            ElementTree.parse(BytesIO(files["svg"]))
            .getroot()
            .iter("{http://www.w3.org/2000/svg}text")
        )
    ]
    assert "one" in texts
    assert chart.table.title in texts
    assert any(text.startswith("<b> $x_1$ & long") for text in texts)


def test_the_same_chart_gives_the_same_bytes() -> None:
    assert picture(CHARTS[3]) == picture(CHARTS[3])


@pytest.mark.parametrize("chart", CHARTS[:3], ids=lambda chart: chart.table.name)
@pytest.mark.parametrize("width", [WIDE, NARROW])
def test_a_drawing_in_the_page_has_its_width_and_no_style_of_its_own(
    chart: Chart, width: int
) -> None:
    root = ElementTree.fromstring(inline_svg(chart, width))
    assert (root.tag, root.get("width"), root.get("aria-label")) == (
        "svg",
        str(width),
        chart.table.title,
    )
    nodes = list(root.iter())
    assert not [node for node in nodes if node.get("style") or node.tag in ("style", "metadata")]
    assert any(node.get("fill") == PALETTE[0] for node in nodes)
    ids = {node.get("id") for node in nodes if node.get("id")}
    assert {node.get("href") for node in nodes if node.get("href")} <= {f"#{one}" for one in ids}
    other = ElementTree.fromstring(inline_svg(chart, WIDE + NARROW - width))
    assert not ids & {node.get("id") for node in other.iter()}


def test_bars_in_the_page_are_as_long_as_their_values() -> None:
    values = [row(name, cell(value), cell(None)) for name, value in (("one", 0.25), ("two", 0.5))]
    chart = Chart("bars", table("n", ("F1", "s"), *values), groups=("", ""))
    root = ElementTree.fromstring(inline_svg(chart, WIDE))
    ends = []
    for node in root.iter("path"):
        if node.get("fill") == PALETTE[0]:
            numbers = [float(part) for part in node.get("d", "").split() if part[0].isdigit()]
            ends.append(max(numbers[::2]) - min(numbers[::2]))
    assert ends[1] == pytest.approx(2 * ends[0], rel=1e-4)
