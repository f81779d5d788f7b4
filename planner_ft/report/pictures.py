"""Charts drawn with matplotlib: as PNG and SVG files, and as SVG inside the page.

Colours can be told apart by colour-blind people, and every series has a mark and a line style of
its own; letters stay text. The page's style sheet gives its drawings their colours, dark or light.
"""

from __future__ import annotations

import io
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any
from xml.etree import ElementTree

from planner_ft.report.charts import Bars, Chart, Dots, Lines, Matrix

WIDE, NARROW = 860, 340
"""Widths in pixels, which are points here: letters keep their size on a phone."""
LETTER = 7.2  # mean width of a letter at 12 pixels
PALETTE = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#555555", "#b8a000")
"""Okabe and Ito's colours (2008), the brightest yellow darkened for white paper."""
INK, SOFT, LINE = "#1b2128", "#55606c", "#d5dbe1"
ROLES = {colour: f"s{index}" for index, colour in enumerate(PALETTE)}
ROLES |= {INK: "ink", SOFT: "soft", LINE: "line"}
"""Names of the style sheet's colours."""
NOT_KEPT = ("", "font", "font-family", "font-size", "clip-path")
"""Styles of a drawing that are the page's affair, or that name nothing there."""
MARKERS = ("o", "s", "^", "D", "v")
STYLES = ("-", "--", ":", "-.")
SETTINGS: dict[str, Any] = {
    "svg.fonttype": "none",
    "svg.hashsalt": "planner_ft",
    "text.parse_math": False,
}
SETTINGS |= {"font.size": 12, "axes.titlesize": 12, "axes.facecolor": "none"}
SETTINGS |= {"axes.spines.top": False, "axes.spines.right": False, "axes.axisbelow": True}
SETTINGS |= {"text.color": INK, "ytick.labelcolor": INK, "grid.color": LINE}
SETTINGS |= dict.fromkeys(("axes.edgecolor", "axes.labelcolor", "xtick.color", "ytick.color"), SOFT)
SETTINGS["legend.frameon"] = False


def picture(chart: Chart) -> dict[str, bytes]:
    """The bytes of a chart as "png" and "svg"; the same chart gives the same bytes."""
    with _drawn(chart, WIDE, title=chart.title) as figure:
        return {
            "png": _saved(figure, "png", {"dpi": 110, "metadata": {"Software": None}}),
            "svg": _saved(figure, "svg", {"metadata": {"Date": None}}),
        }


def inline_svg(chart: Chart, width: int) -> str:
    """A chart as an element of a page that allows no style but its own: colours are classes."""
    with _drawn(chart, width) as figure:
        root = ElementTree.fromstring(_saved(figure, "svg", {"facecolor": "none"}))
    for parent in list(root.iter()):
        for child in list(parent):
            if child.tag.endswith(("}metadata", "}style", "}clipPath")):
                parent.remove(child)
    for node in root.iter():
        _restyle(node, f"{chart.name}-{width}-")
    _x, _y, *size = root.attrib["viewBox"].split()
    root.attrib.update(zip(("width", "height"), size, strict=True))
    root.attrib.update({"role": "img", "aria-label": chart.title})
    return ElementTree.tostring(root, encoding="unicode")


def _restyle(node: ElementTree.Element, prefix: str) -> None:
    """Styles as classes and attributes, and ids that no other drawing has."""
    node.tag = node.tag.rpartition("}")[2]
    found: dict[str, str] = {}
    classes = []
    styles = [entry.partition(":") for entry in node.attrib.pop("style", "").split(";")]
    for key, _, value in [(key, ":", value) for key, value in node.attrib.items()] + styles:
        name, text = key.strip().rpartition("}")[2], value.strip()
        if name in ("fill", "stroke") and text in ROLES:
            classes.append(f"{name}-{ROLES[text]}")
        elif name == "href":
            found[name] = text.replace("#", f"#{prefix}")
        elif name == "id":
            found |= {} if node.tag == "g" else {"id": prefix + text}
        elif name not in NOT_KEPT:
            found[name] = text
    node.attrib.clear()
    node.attrib.update(found | ({"class": " ".join(classes)} if classes else {}))


@contextmanager
def _drawn(chart: Chart, width: int, title: str = "") -> Iterator[Any]:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib.figure import Figure

    with matplotlib.rc_context(SETTINGS), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph")  # names may hold any letters
        sheet = _Sheet(Figure(), width, top=40 if title else 24)
        DRAW[type(chart)](sheet, chart)
        if title:
            sheet.figure.suptitle(fitted(title, 100), x=0.01, ha="left", fontweight="bold")
        yield sheet.figure


def _saved(figure: Any, suffix: str, options: dict[str, Any]) -> bytes:
    buffer = io.BytesIO()
    figure.savefig(buffer, format=suffix, **options)
    return buffer.getvalue()


def fitted(label: str, longest: int = 44) -> str:
    """A label that leaves room for the figure, on one line."""
    shown = "".join(letter if letter.isprintable() else " " for letter in label)
    shown = " ".join(shown.split())
    return shown if len(shown) <= longest else f"{shown[: longest - 1]}…"


def _length(labels: Sequence[str]) -> float:
    return max((LETTER * len(fitted(label)) for label in labels), default=0.0)


Labels = Sequence[str]
Ratios = Sequence[float]


@dataclass
class _Sheet:
    """A figure with margins in pixels, which cost no layout."""

    figure: Any
    width: float
    top: float

    @property
    def narrow(self) -> bool:
        return self.width <= NARROW

    def panels(
        self, height: float, left: float, below: float, right: float = 12, ratios: Ratios = (1,)
    ) -> list[Any]:
        """Axes beside each other, `height` high, with room for the x axis and `below`."""
        bottom = 44 + below
        whole = self.top + height + bottom
        self.figure.set_size_inches(self.width / 72, whole / 72)
        edges = {"left": left / self.width, "right": 1 - right / self.width}
        edges |= {"bottom": bottom / whole, "top": 1 - self.top / whole}
        grid = {**edges, "width_ratios": ratios, "wspace": 0.06}
        options = {"sharey": True, "squeeze": False, "gridspec_kw": grid}
        return list(self.figure.subplots(1, len(ratios), **options)[0])

    def rows(
        self, labels: Labels, axis: str, keys: Labels, right: float = 12, ratios: Ratios = (1,)
    ) -> list[Any]:
        """Axes with a row per label, the first on top; labels stand beside or above their rows."""
        shown = [fitted(label) for label in labels]
        height = (42 if self.narrow else 28) * len(labels) + 10
        left = 12 if self.narrow else _length(labels) + 12
        first, *others = self.panels(height, left, self.legend_height(keys), right, ratios)
        first.set_yticks(range(len(labels)), [""] * len(labels) if self.narrow else shown)
        for index, label in enumerate(shown if self.narrow else ()):
            place = (0, index - 0.28)
            first.annotate(label, place, xycoords=("axes fraction", "data"), va="bottom")
        first.set_ylim(len(labels) - 0.4, -1 if self.narrow else -0.6)
        for axes in (first, *others):
            axes.tick_params(axis="y", length=0, labelleft=axes is first)
        self.measure(first, axis, 4 if self.narrow else 8)
        return [first, *others]

    def measure(self, axes: Any, axis: str, steps: int) -> None:
        axes.set_xlabel(axis)
        axes.grid(axis="x")
        axes.locator_params(axis="x", nbins=steps)

    def legend(self, handles: Sequence[Any], labels: Sequence[str]) -> None:
        columns = self._columns(labels)
        shown = [fitted(label) for label in labels]
        if shown:
            self.figure.legend(handles, shown, loc="lower left", ncols=columns)

    def _columns(self, labels: Sequence[str]) -> int:
        return max(1, min(4, int(self.width / (_length(labels) + 50))))

    def legend_height(self, labels: Sequence[str]) -> float:
        return -(-len(labels) // self._columns(labels)) * 20


def _bars(sheet: _Sheet, chart: Bars) -> None:
    keys = [name or "–" for name in chart.groups] if len(chart.groups) > 1 else []
    second_panel = any(bar.second is not None for bar in chart.bars)
    ratios = [2, 1] if second_panel else [1]
    labels = [bar.label for bar in chart.bars]
    axes, *others = sheet.rows(labels, chart.axis, keys, ratios=ratios)
    axes.set_xlim(0, 1.15)
    colours = {name: PALETTE[at % len(PALETTE)] for at, name in enumerate(chart.groups)}
    for index, bar in enumerate(chart.bars):
        if bar.value is None:
            continue
        alpha = 0.35 if bar.muted else 1
        axes.barh(index, bar.value, height=0.5, color=colours[bar.group], alpha=alpha)
        if bar.low is not None and bar.high is not None:
            reach = [[bar.value - bar.low], [bar.high - bar.value]]
            axes.errorbar(bar.value, index, xerr=reach, color=INK, capsize=3, linewidth=1.5)
        end = max(bar.value, bar.high or 0)
        text = f"{bar.value:.2f}"
        axes.annotate(text, (end, index), (4, 0), textcoords="offset points", va="center")
    for second in others:
        sheet.measure(second, chart.second_axis, 3)
        for at, name in enumerate(chart.groups):
            style, marker = STYLES[at % len(STYLES)], MARKERS[at % len(MARKERS)]
            for run in chart.lines(name):
                values = [chart.bars[index].second for index in run]
                alpha = 0.5 if chart.bars[run[0]].muted else 1
                second.plot(values, run, style, marker=marker, color=colours[name], alpha=alpha)
        second.set_xlim(left=0)
    if keys:
        from matplotlib.patches import Patch

        sheet.legend([Patch(color=colour) for colour in colours.values()], keys)


def _lines(sheet: _Sheet, chart: Lines) -> None:
    keys = [series.label for series in chart.series]
    (axes,) = sheet.panels(230 if sheet.narrow else 300, 62, sheet.legend_height(keys))
    handles = []
    for index, series in enumerate(chart.series):
        colour, style = PALETTE[index % len(PALETTE)], STYLES[index % len(STYLES)]
        x, y = [point.x for point in series.points], [point.y for point in series.points]
        marker = MARKERS[index % len(MARKERS)]
        handles += axes.plot(x, y, style, marker=marker, color=colour)
        for point in series.points:
            if point.low is not None:
                axes.vlines(point.x, point.low, point.high, color=colour, alpha=0.5)
    axes.set(xlabel=chart.x_axis, ylabel=chart.y_axis)
    axes.set_ylim(bottom=0)
    places = sorted({point.x for series in chart.series for point in series.points})
    axes.set_xticks(places if len(places) <= 12 else places[:: len(places) // 8])
    axes.grid()
    sheet.legend(handles, keys)


def _dots(sheet: _Sheet, chart: Dots) -> None:
    labels, notes = [row.label for row in chart.rows], [row.note for row in chart.rows]
    (axes,) = sheet.rows(labels, chart.axis, chart.marks, right=_length(notes) + 16)
    beside: dict[str, Any] = {"xycoords": ("axes fraction", "data"), "color": SOFT, "va": "center"}
    for index, row in enumerate(chart.rows):
        known = [value for value in row.values if value is not None]
        if len(known) > 1:
            axes.hlines(index, min(known), max(known), color=SOFT, linewidth=2, zorder=1)
        axes.annotate(row.note, (1.01, index), **beside)
    heading = {"xycoords": "figure fraction", "color": SOFT, "ha": "right", "va": "top"}
    axes.annotate(chart.note_heading, (0.99, 0.995), **heading)
    handles = []
    # Equal values lie on each other: the first mark is drawn last.
    for mark in reversed(range(len(chart.marks))):
        values = [row.values[mark] for row in chart.rows]
        found = [(value, index) for index, value in enumerate(values) if value is not None]
        style = {"marker": MARKERS[mark], "color": PALETTE[mark], "zorder": 3}
        handles.append(axes.scatter([x for x, _y in found], [y for _x, y in found], s=40, **style))
    axes.set_xlim(0, chart.high * 1.02 if chart.high else None)
    sheet.legend(handles[::-1], chart.marks)


def _matrix(sheet: _Sheet, chart: Matrix) -> None:
    left, below = _length(chart.rows) + 16, 0.65 * _length(chart.columns)
    sheet.width = max(left + 48 * len(chart.columns) + 30, 0.8 * left + _length(chart.columns))
    (axes,) = sheet.panels(28 * len(chart.rows), left, below)
    values = [[float("nan") if count is None else count for count in row] for row in chart.counts]
    axes.imshow(values, cmap="Blues", vmin=0, vmax=max(chart.largest, 1) * 1.15, aspect="auto")
    columns = [fitted(name) for name in chart.columns]
    axes.set_xticks(range(len(columns)), columns, rotation=40, ha="right", rotation_mode="anchor")
    axes.set_yticks(range(len(chart.rows)), [fitted(name) for name in chart.rows])
    axes.tick_params(length=0)
    for row, counts in enumerate(chart.counts):
        for column, count in enumerate(counts):
            if count:
                colour = "white" if count > 0.6 * chart.largest else INK
                axes.text(column, row, str(count), ha="center", va="center", color=colour)


DRAW: dict[type, Callable[[_Sheet, Any], None]]
DRAW = {Bars: _bars, Lines: _lines, Dots: _dots, Matrix: _matrix}
