"""Charts as PNG and SVG."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from io import BytesIO

import pytest

from planner_ft.report.charts import Bar, Bars, Chart, DotRow, Dots, Lines, Matrix, Point, Series
from planner_ft.report.pictures import NARROW, WIDE, inline_svg, picture

HOSTILE = "<b> $x_1$ & " + 60 * "long "
CHARTS: list[Chart] = [
    Bars(
        "bars",
        "Bars",
        "",
        "F1",
        "seconds",
        (
            Bar("one", 0.5, 0.4, 0.6, 1.5, group="Base"),
            Bar(HOSTILE, None),
            Bar("three", 1, second=2, muted=True, group="Base"),
        ),
    ),
    Lines(
        "lines",
        "Lines",
        "",
        "tasks",
        "seconds",
        (
            Series("one", (Point(1, 0.5, 0.4, 0.7, 3), Point(4, 1.5))),
            Series(HOSTILE, (Point(2, 0),)),
        ),
    ),
    Dots(
        "dots",
        "Dots",
        "",
        "share",
        ("precision", "recall"),
        (DotRow("one", (0.5, None), "1 / 2"), DotRow(HOSTILE, (1.0, 1.0))),
        "right",
        1.0,
    ),
    Matrix("matrix", "Matrix", "", "Expected", ("one", HOSTILE), ("two",), ((3,), (None,))),
]


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("chart", CHARTS, ids=lambda chart: chart.name)
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
    assert chart.title in texts
    assert any(text.startswith("<b> $x_1$ & long") for text in texts)


def test_the_same_chart_gives_the_same_bytes() -> None:
    assert picture(CHARTS[3]) == picture(CHARTS[3])


@pytest.mark.parametrize("chart", CHARTS[:3], ids=lambda chart: chart.name)
@pytest.mark.parametrize("width", [WIDE, NARROW])
def test_a_drawing_in_the_page_has_its_width_and_no_style_of_its_own(
    chart: Chart, width: int
) -> None:
    root = ElementTree.fromstring(inline_svg(chart, width))
    assert (root.tag, root.get("width"), root.get("aria-label")) == ("svg", str(width), chart.title)
    nodes = list(root.iter())
    assert not [node for node in nodes if node.get("style") or node.tag in ("style", "metadata")]
    assert any("-s0" in node.get("class", "") for node in nodes)
    ids = {node.get("id") for node in nodes if node.get("id")}
    assert {node.get("href") for node in nodes if node.get("href")} <= {f"#{one}" for one in ids}
    assert all(one and one.startswith(f"{chart.name}-{width}-") for one in ids)


def test_bars_in_the_page_are_as_long_as_their_values() -> None:
    chart = Bars("n", "t", "c", "F1", "s", (Bar("one", 0.25), Bar("two", 0.5)))
    root = ElementTree.fromstring(inline_svg(chart, WIDE))
    ends = []
    for node in root.iter("path"):
        if node.get("class") == "fill-s0":
            numbers = [float(part) for part in node.get("d", "").split() if part[0].isdigit()]
            ends.append(max(numbers[::2]) - min(numbers[::2]))
    assert ends[1] == pytest.approx(2 * ends[0], rel=1e-4)
