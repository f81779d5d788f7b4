"""Charts drawn with matplotlib: as PNG and SVG files, and as SVG inside the page.

Colours can be told apart by colour-blind people, and every series has a mark and a line style of
its own; letters stay text. The page's style sheet gives its drawings their colours, dark or light.
"""

import io
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import astuple
from itertools import groupby
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.curve import SHOWN, Point
from planner_ft.report.charts import FIGURES, Chart, cell
from planner_ft.support.files import atomic_writer
from planner_ft.support.tables import NOTHING, Bounds, Cell, Table, TableRow, printable

WIDE, NARROW = 860, 340
"""Widths in pixels, which are points here: letters keep their size on a phone."""
LETTER = 7.2  # mean width of a letter at 12 pixels
PALETTE = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#555555", "#b8a000")
"""Okabe and Ito's colours (2008), the brightest yellow darkened for white paper."""
INK, SOFT = "#1b2128", "#55606c"
NOT_KEPT = ("", "font", "font-family", "font-size", "clip-path")
"""Styles of a drawing that are the page's affair, or that name nothing there."""
MARKERS = ("o", "s", "^", "D", "v")
STYLES = ("-", "--", ":", "-.")
STYLE = Path(__file__).with_name("figures.mplstyle")


def picture(chart: Chart) -> dict[str, bytes]:
    """The bytes of a chart as "png" and "svg"; the same chart gives the same bytes."""
    with _drawn(chart, WIDE, chart.table.title) as figure:
        return {
            "png": _saved(figure, "png", {"dpi": 110, "metadata": {"Software": None}}),
            "svg": _saved(figure, "svg", {"metadata": {"Date": None}}),
        }


def saved(chart: Chart, folder: Path) -> Iterator[Path]:
    """Write a chart into a folder as NAME.png and NAME.svg; yields the files."""
    for suffix, content in picture(chart).items():
        path = folder / f"{chart.table.name}.{suffix}"
        with atomic_writer(path, "wb") as stream:
            stream.write(content)
        yield path


def inline_svg(chart: Chart, width: int) -> str:
    """A chart as an element of a page that allows no style but its own, which knows its colours."""
    with _drawn(chart, width) as figure:
        root = ElementTree.fromstring(_saved(figure, "svg", {"facecolor": "none"}))
    for parent in list(root.iter()):
        for child in list(parent):
            if child.tag.endswith(("}metadata", "}style", "}clipPath")):
                parent.remove(child)
    for node in root.iter():
        node.tag = node.tag.rpartition("}")[2]
        styles = (entry.partition(":")[::2] for entry in node.attrib.pop("style", "").split(";"))
        pairs = [(key.rpartition("}")[2].strip(), value) for key, value in node.attrib.items()]
        pairs += [(key.strip(), value.strip()) for key, value in styles]
        node.attrib.clear()
        node.attrib.update({key: value for key, value in pairs if key not in NOT_KEPT})
        if node.tag == "g":
            node.attrib.pop("id", None)
    _x, _y, *size = root.attrib["viewBox"].split()
    root.attrib.update(zip(("width", "height"), size, strict=True))
    root.attrib.update({"role": "img", "aria-label": chart.table.title})
    return ElementTree.tostring(root, encoding="unicode")


@contextmanager
def _drawn(chart: Chart, width: int, title: str = "") -> Iterator[Any]:
    import matplotlib
    from matplotlib.figure import Figure

    # Ids of one drawing are those of no other.
    salt = {"svg.hashsalt": f"{chart.table.name}-{width}"}
    with matplotlib.rc_context(salt, STYLE), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph")  # names may hold any letters
        figure = Figure(layout="constrained")
        across, height = DRAW[chart.kind](figure, chart, width)
        if title:
            figure.suptitle(fitted(title, 100), x=0.01, ha="left", fontweight="bold")
        figure.set_size_inches(across / 72, (height + 30 * bool(title)) / 72)
        yield figure


def _saved(figure: Any, suffix: str, options: dict[str, Any]) -> bytes:
    buffer = io.BytesIO()
    figure.savefig(buffer, format=suffix, **options)
    return buffer.getvalue()


def fitted(label: str, longest: int = 44) -> str:
    """A label that leaves room for the figure, on one line."""
    shown = printable(label)
    return shown if len(shown) <= longest else f"{shown[: longest - 1]}…"


def _length(labels: Sequence[str]) -> float:
    """Pixels of the longest label."""
    return max((LETTER * len(fitted(label)) for label in labels), default=0.0)


def _bounds(table: Table, column: int) -> list[Bounds]:
    """(value, low, high) of a column, row by row."""
    return [row.cells[column].bounds or (None, None, None) for row in table.rows]


def _rows(figure: Any, chart: Chart, axis: str, width: float, panels: int) -> tuple[Any, float]:
    """Axes with a row per heading, on a narrow page below it, and their height."""
    labels, narrow = [fitted(row.heading) for row in chart.table.rows], width <= NARROW
    ratios = [2, 1][:panels]
    axes = figure.subplots(1, panels, sharey=True, squeeze=False, width_ratios=ratios)[0]
    axes[0].set_yticks(range(len(labels)), [""] * len(labels) if narrow else labels)
    for index, label in enumerate(labels if narrow else ()):
        place, frame = (0, index - 0.28), ("axes fraction", "data")
        axes[0].annotate(label, place, xycoords=frame, va="bottom").set_in_layout(False)
    axes[0].set_ylim(len(labels) - 0.4, -1 if narrow else -0.6)
    for one in axes:
        one.tick_params(axis="y", length=0, labelleft=one is axes[0])
        one.grid(axis="x")
        one.locator_params(axis="x", nbins=3 if panels > 1 and one is not axes[0] else 6)
    axes[0].set_xlabel(axis)
    return axes, (42 if narrow else 28) * len(labels) + 64


def _legend(figure: Any, handles: Sequence[Any], labels: Sequence[str], width: float) -> float:
    """Write a legend below the axes; returns its height."""
    columns = max(1, min(4, int(width / (_length(labels) + 50))))
    if labels:
        shown = [fitted(label) for label in labels]
        figure.legend(handles, shown, loc="outside lower left", ncols=columns)
    return -(-len(labels) // columns) * 20


def _bars(figure: Any, chart: Chart, width: float) -> tuple[float, float]:
    table, groups = chart.table, list(dict.fromkeys(chart.groups))
    seconds = [value for value, _low, _high in _bounds(table, 1)]
    panels = 2 if any(value is not None for value in seconds) else 1
    axes, height = _rows(figure, chart, table.columns[0], width, panels)
    axes[0].set_xlim(0, 1.15)
    bars = zip(chart.groups, table.rows, _bounds(table, 0), seconds, strict=True)
    for index, (group, row, (value, low, high), time) in enumerate(bars):
        place, alpha = groups.index(group), 1 if row.kind == "measured" else 0.35
        style = {"color": PALETTE[place % len(PALETTE)], "alpha": alpha}
        if value is not None:
            axes[0].barh(index, value, height=0.5, **style)
            if low is not None and high is not None:
                reach = [[value - low], [high - value]]
                axes[0].errorbar(value, index, xerr=reach, color=INK, capsize=3, linewidth=1.5)
            beside: dict[str, Any] = {"textcoords": "offset points", "va": "center"}
            axes[0].annotate(f"{value:.2f}", (max(value, high or 0), index), (4, 0), **beside)
        if time is not None:
            axes[1].plot(time, index, marker=MARKERS[place % len(MARKERS)], **style)
    for second in axes[1:]:
        second.set_xlabel(table.columns[1])
        second.set_xlim(left=0)
    if len(groups) < 2:
        return width, height
    from matplotlib.patches import Patch

    colours = [Patch(color=PALETTE[at % len(PALETTE)]) for at in range(len(groups))]
    named = [group.strip(NOTHING) or "baseline" for group in groups]
    return width, height + _legend(figure, colours, named, width)


def _lines(figure: Any, chart: Chart, width: float) -> tuple[float, float]:
    axes, handles, labels, places = figure.subplots(), [], [], set[float]()
    points = zip(chart.table.rows, _bounds(chart.table, 0), _bounds(chart.table, 1), strict=True)
    series = groupby(points, key=lambda point: point[0].heading)
    for index, (label, of_line) in enumerate(series):
        found = list(of_line)
        colour, style = PALETTE[index % len(PALETTE)], STYLES[index % len(STYLES)]
        xs, ys = [x for _row, (x, *_), _y in found], [y for _row, _x, (y, *_) in found]
        handles += axes.plot(xs, ys, style, marker=MARKERS[index % len(MARKERS)], color=colour)
        for x, (_y, low, high) in zip(xs, [y for _row, _x, y in found], strict=True):
            if low is not None:
                axes.vlines(x, low, high, color=colour, alpha=0.5)
        labels.append(label)
        places.update(x for x in xs if x is not None)
    axes.set(xlabel=chart.table.columns[0], ylabel=chart.table.columns[1])
    axes.set_ylim(bottom=0)
    ticks = sorted(places)
    if all(float(tick).is_integer() for tick in ticks):
        axes.set_xticks(ticks if len(ticks) <= 12 else ticks[:: len(ticks) // 8])
    axes.grid()
    height = 290 if width <= NARROW else 360
    return width, height + _legend(figure, handles, labels, width)


def _dots(figure: Any, chart: Chart, width: float) -> tuple[float, float]:
    table = chart.table
    (axes,), height = _rows(figure, chart, chart.axis, width, 1)
    *marks, heading = table.columns
    columns = [[value for value, *_ in _bounds(table, at)] for at in range(len(marks))]
    beside: dict[str, Any] = {"xycoords": ("axes fraction", "data"), "color": SOFT, "va": "center"}
    for index, (row, values) in enumerate(zip(table.rows, zip(*columns, strict=True), strict=True)):
        known = [value for value in values if value is not None]
        if len(known) > 1:
            axes.hlines(index, min(known), max(known), color=SOFT, linewidth=2, zorder=1)
        axes.annotate(row.cells[-1].text, (1.01, index), **beside)
    axes.set_title(heading, loc="right", color=SOFT)
    handles = []
    # Equal values lie on each other: the first mark is drawn last.
    for mark in reversed(range(len(marks))):
        found = [(one, index) for index, one in enumerate(columns[mark]) if one is not None]
        style = {"marker": MARKERS[mark], "color": PALETTE[mark], "zorder": 3}
        handles.append(axes.scatter([x for x, _y in found], [y for _x, y in found], s=40, **style))
    axes.set_xlim(0, chart.high * 1.02 if chart.high else None)
    return width, height + 20 + _legend(figure, handles[::-1], marks, width)


def _matrix(figure: Any, chart: Chart, _width: float) -> tuple[float, float]:
    table, axes = chart.table, figure.subplots()
    counts = [[cell.bounds[0] if cell.bounds else None for cell in row.cells] for row in table.rows]
    largest = max((count or 0 for of_row in counts for count in of_row), default=0)
    values = [[float("nan") if count is None else count for count in of_row] for of_row in counts]
    axes.imshow(values, cmap="Blues", vmin=0, vmax=max(largest, 1) * 1.15, aspect="auto")
    columns, rows = [fitted(name) for name in table.columns], [row.heading for row in table.rows]
    axes.set_xticks(range(len(columns)), columns, rotation=40, ha="right", rotation_mode="anchor")
    axes.set_yticks(range(len(rows)), [fitted(name) for name in rows])
    axes.tick_params(length=0)
    for place, of_row in enumerate(counts):
        for column, count in enumerate(of_row):
            if count:
                colour = "white" if count > 0.6 * largest else INK
                axes.text(column, place, str(count), ha="center", va="center", color=colour)
    left, below = _length(rows) + 16, 0.65 * _length(columns)
    width = max(left + 48 * len(columns) + 30, 0.8 * left + _length(columns))
    return width, 28 * len(rows) + below + 44


DRAW: dict[str, Callable[[Any, Chart, float], tuple[float, float]]]
DRAW = {"bars": _bars, "lines": _lines, "dots": _dots, "matrix": _matrix}


def write_figure(points: Sequence[Point], what: str, out: Path) -> list[Path]:
    """Draw SHOWN by number of training samples (`what`) as learning-curve.png and .svg in `out`."""
    rows = [
        TableRow(METRIC[name].heading.removesuffix(" (%)"), (cell(point.size), figure, Cell("")))
        for name in SHOWN
        for point in points
        for figure in [cell(*astuple(point.metrics[name]))]
    ]
    words = FIGURES["learning-curve"]
    heads = (f"{what} trained on", "share", "")
    table = Table("Line", heads, rows, name="learning-curve", **words)
    return list(saved(Chart("lines", table), out))
