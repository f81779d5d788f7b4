"""Charts as inline SVG, in a wide form and in a narrow one for phones; colours come from the page's
style sheet.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from planner_ft.report.charts import Bar, Bars, Dots, Lines, Point, Series, number, ticks
from planner_ft.report.markup import Markup, join, tag

WIDE, NARROW = 860, 340
"""Widths in pixels at which a chart is drawn; letters keep their size because the page shows one or
the other.
"""
LETTER = 7.2
"""Mean width of a letter at 12 pixels."""
COLOURS = 8
"""Series colours in the style sheet: classes s0 to s7."""
DASHES = (None, "7 4", "2 3", "9 3 2 3")


def both_widths(draw: Callable[[float], Markup]) -> Markup:
    """A chart in its two forms, of which the page shows one."""
    return join([tag("div", draw(WIDE), class_="wide"), tag("div", draw(NARROW), class_="narrow")])


def draw(chart: Bars | Lines | Dots, width: float) -> Markup:
    """A chart at a width in pixels."""
    if isinstance(chart, Bars):
        return bars(chart, width)
    return lines(chart, width) if isinstance(chart, Lines) else dots(chart, width)


def bars(chart: Bars, width: float) -> Markup:
    """Horizontal bars with whiskers, and lines in a panel of their own on the right."""
    keys = _legend(chart.groups if len(chart.groups) > 1 else [], width)
    frame = _Frame(width, [bar.label for bar in chart.bars], top=keys.height + 14)
    whole = frame.right
    frame.right = frame.left + (whole - frame.left) * 0.66 if chart.has_second else whole
    # The figure stands behind the longest whisker.
    scale = _scale(frame.left, frame.right - 5 * LETTER, 1.0)
    steps = [0, 0.25, 0.5, 0.75, 1.0] if frame.above else [0, 0.2, 0.4, 0.6, 0.8, 1.0]
    parts = [*keys.parts, *frame.grid(steps, scale, chart.axis)]
    for index, bar in enumerate(chart.bars):
        parts += _bar(frame, index, bar, _colour(chart, bar), scale)
    if chart.has_second:
        steps = ticks(max(bar.second or 0 for bar in chart.bars), 3)
        second = _scale(frame.right + 8, whole, steps[-1])
        parts += frame.grid(steps, second, chart.second_axis)
        for group in chart.groups:
            for run in chart.lines(group):
                parts += _second_line(chart, run, frame, second)
    return frame.svg(parts, chart.title)


def _colour(chart: Bars, bar: Bar) -> int:
    return chart.groups.index(bar.group) % COLOURS if bar.group else 0


def _bar(
    frame: _Frame, index: int, bar: Bar, colour: int, scale: Callable[[float], float]
) -> list[Markup]:
    y = frame.y(index)
    parts = frame.label(index)
    if bar.value is None:
        return parts
    muted = " muted" if bar.muted else ""
    parts.append(
        tag(
            "rect",
            x=frame.left,
            y=y - 8,
            width=max(scale(bar.value) - frame.left, 1),
            height=16,
            rx=2,
            class_=f"bar s{colour}{muted}",
        )
    )
    end = bar.value
    if bar.low is not None and bar.high is not None:
        parts.append(_whisker(scale(bar.low), scale(bar.high), y))
        end = max(end, bar.high)
    parts.append(tag("text", f"{bar.value:.2f}", x=scale(end) + 6, y=y + 4, class_="value"))
    return parts


def _whisker(low: float, high: float, y: float) -> Markup:
    return tag(
        "path",
        d=f"M{low:.1f} {y}H{high:.1f}M{low:.1f} {y - 4}v8M{high:.1f} {y - 4}v8",
        class_="whisker",
    )


def _second_line(
    chart: Bars, run: list[int], frame: _Frame, scale: Callable[[float], float]
) -> list[Markup]:
    """Marks joined by a line."""
    colour = _colour(chart, chart.bars[run[0]])
    places = [(scale(chart.bars[index].second or 0), frame.y(index)) for index in run]
    path = "L".join(f"{x:.1f} {y:.1f}" for x, y in places)
    muted = " muted" if chart.bars[run[0]].muted else ""
    parts = [
        tag(
            "path",
            d=f"M{path}",
            class_=f"line s{colour}{muted}",
            stroke_dasharray=DASHES[colour % len(DASHES)],
        )
    ]
    return parts + [
        _mark(colour, x, y, f"{chart.bars[index].label}: {number(chart.bars[index].second)}")
        for index, (x, y) in zip(run, places, strict=True)
    ]


def dots(chart: Dots, width: float) -> Markup:
    """Rows of marks joined by a thin line, a legend above."""
    keys = _legend(chart.marks, width)
    frame = _Frame(
        width,
        [row.label for row in chart.rows],
        top=keys.height + 24,
        after=max((len(row.note) for row in chart.rows), default=0),
    )
    steps = ticks(
        chart.high
        if chart.high is not None
        else max(
            (value for row in chart.rows for value in row.values if value is not None), default=1
        )
    )
    scale = frame.scale(steps[-1])
    parts = [*keys.parts, *frame.grid(steps, scale, chart.axis)]
    for index, row in enumerate(chart.rows):
        y = frame.y(index)
        parts += frame.label(index)
        known = [scale(value) for value in row.values if value is not None]
        if len(known) > 1:
            parts.append(tag("path", d=f"M{min(known):.1f} {y}H{max(known):.1f}", class_="range"))
        # Equal values lie on each other: the first mark is the smallest and is drawn last.
        for mark, value in reversed(list(enumerate(row.values))):
            if value is not None:
                parts.append(
                    _mark(
                        mark, scale(value), y, f"{row.label}, {chart.marks[mark]}: {number(value)}"
                    )
                )
        if row.note:
            parts.append(
                tag("text", row.note, x=width - 2, y=y + 4, class_="tick", text_anchor="end")
            )
    if chart.note_heading:
        parts.append(
            tag(
                "text",
                chart.note_heading,
                x=width - 2,
                y=frame.top - 8,
                class_="tick",
                text_anchor="end",
            )
        )
    return frame.svg(parts, chart.title)


def lines(chart: Lines, width: float) -> Markup:
    """Lines with dots and intervals, a legend above."""
    keys = _legend([series.label for series in chart.series], width)
    points = [point for series in chart.series for point in series.points]
    top, left, bottom, right = keys.height + 26, 44.0, 40, width - 10
    height = top + (300 if width > NARROW else 230) + bottom
    steps = ticks(max((point.high or point.y for point in points), default=1))
    # A single long number of tasks must not squeeze the others: x runs over the numbers that there
    # are.
    first, last = min(point.x for point in points), max(point.x for point in points)
    span = max(last - first, 1)

    def x(value: float) -> float:
        return left + 14 + (right - left - 28) * (value - first) / span

    def y(value: float) -> float:
        return height - bottom - (height - bottom - top) * value / steps[-1]

    parts = [*keys.parts, tag("text", chart.y_axis, x=0, y=keys.height + 12, class_="axis")]
    for step in steps:
        parts.append(tag("path", d=f"M{left} {y(step):.1f}H{right}", class_="grid"))
        parts.append(
            tag("text", number(step), x=left - 6, y=y(step) + 4, class_="tick", text_anchor="end")
        )
    for value in sorted({point.x for point in points}):
        parts.append(
            tag(
                "text",
                number(value),
                x=x(value),
                y=height - bottom + 18,
                class_="tick",
                text_anchor="middle",
            )
        )
    parts.append(
        tag(
            "text",
            chart.x_axis,
            x=(left + right) / 2,
            y=height - 4,
            class_="axis",
            text_anchor="middle",
        )
    )
    for index, series in enumerate(chart.series):
        parts += _line(index, series, x, y)
    return _svg(width, height, parts, chart.title)


def _line(
    index: int, series: Series, x: Callable[[float], float], y: Callable[[float], float]
) -> list[Markup]:
    path = "L".join(f"{x(point.x):.1f} {y(point.y):.1f}" for point in series.points)
    parts = [
        tag(
            "path",
            d=f"M{path}",
            class_=f"line s{index % COLOURS}",
            stroke_dasharray=DASHES[index % len(DASHES)],
        )
    ]
    for point in series.points:
        if point.low is not None and point.high is not None:
            # Strokes of several series at the same place stand beside each other.
            aside = x(point.x) + 3 * ((index + 1) // 2) * (-1) ** index
            parts.append(
                tag(
                    "path",
                    d=f"M{aside:.1f} {y(point.low):.1f}V{y(point.high):.1f}",
                    class_=f"spread s{index % COLOURS}",
                )
            )
        parts.append(_mark(index, x(point.x), y(point.y), _point_title(series, point)))
    return parts


def _point_title(series: Series, point: Point) -> str:
    return f"{series.label}, {number(point.x)}: {number(point.y)} (n = {point.n})"


def _mark(index: int, x: float, y: float, title: str) -> Markup:
    """A mark in its series' colour and shape: nobody has to tell series by colour alone."""
    shapes = (
        f"M{x - 4:.1f} {y:.1f}a4 4 0 1 0 8 0a4 4 0 1 0 -8 0",
        f"M{x - 5.5:.1f} {y - 5.5:.1f}h11v11h-11z",
        f"M{x:.1f} {y - 6:.1f}l6 10h-12z",
        f"M{x:.1f} {y - 6:.1f}l6 6l-6 6l-6 -6z",
        f"M{x:.1f} {y + 6:.1f}l6 -10h-12z",
    )
    return tag(
        "path",
        tag("title", title),
        d=shapes[index % len(shapes)],
        class_=f"mark s{index % COLOURS}",
    )


class _Legend:
    """Marks with their labels, in as many lines as they need."""

    def __init__(self, parts: list[Markup], height: float) -> None:
        self.parts, self.height = parts, height


def _legend(labels: Iterable[str], width: float) -> _Legend:
    parts: list[Markup] = []
    x, y = 8.0, 12.0
    for index, label in enumerate(labels):
        needed = 30 + LETTER * len(label)
        if x > 8 and x + needed > width:
            x, y = 8.0, y + 20
        parts += [
            _mark(index, x, y, label),
            tag("text", fitted(label, width - 24), x=x + 12, y=y + 4, class_="key"),
        ]
        x += needed
    return _Legend(parts, y + 8 if parts else 0)


class _Frame:
    """Rows with labels in a gutter on the left, or above each row where the chart is narrow."""

    def __init__(self, width: float, labels: list[str], *, top: float, after: int = 0) -> None:
        self.width, self.labels, self.top = width, labels, top
        self.above = width <= NARROW
        longest = max((len(label) for label in labels), default=0)
        self.left = 8.0 if self.above else min(longest * LETTER + 12, width * 0.4)
        self.right = width - (14 if not after else 16 + after * LETTER)
        self.step = 42 if self.above else 28
        self.height = top + self.step * len(labels) + 40

    def scale(self, high: float) -> Callable[[float], float]:
        """From a value to its x coordinate."""
        return _scale(self.left, self.right, high)

    def y(self, index: int) -> float:
        """The middle of a row's marks."""
        return self.top + self.step * index + (30 if self.above else 14)

    def label(self, index: int) -> list[Markup]:
        """The label of a row."""
        label = self.labels[index]
        if self.above:
            return [
                tag(
                    "text",
                    fitted(label, self.width - 16),
                    x=self.left,
                    y=self.y(index) - 13,
                    class_="label",
                )
            ]
        return [
            tag(
                "text",
                tag("title", label),
                fitted(label, self.left - 8),
                x=self.left - 8,
                y=self.y(index) + 4,
                class_="label",
                text_anchor="end",
            )
        ]

    def grid(
        self, steps: Sequence[float], scale: Callable[[float], float], axis: str
    ) -> list[Markup]:
        """Vertical lines with their values below, and the name of the axis."""
        bottom = self.top + self.step * len(self.labels) + 4
        parts = []
        for step in steps:
            parts.append(
                tag("path", d=f"M{scale(step):.1f} {self.top - 2}V{bottom}", class_="grid")
            )
            parts.append(
                tag(
                    "text",
                    number(step),
                    x=scale(step),
                    y=bottom + 15,
                    class_="tick",
                    text_anchor="middle",
                )
            )
        middle = (scale(0) + scale(max(steps))) / 2
        return [
            *parts,
            tag("text", axis, x=middle, y=bottom + 32, class_="axis", text_anchor="middle"),
        ]

    def svg(self, parts: list[Markup], title: str) -> Markup:
        return _svg(self.width, self.height, parts, title)


def _scale(left: float, right: float, high: float) -> Callable[[float], float]:
    return lambda value: left + (right - left) * value / (high or 1)


def fitted(label: str, width: float) -> str:
    """A label cut to a width in pixels."""
    letters = max(int(width / LETTER), 3)
    return label if len(label) <= letters else f"{label[: letters - 1]}…"


def _svg(width: float, height: float, parts: list[Markup], title: str) -> Markup:
    return tag(
        "svg",
        parts,
        role="img",
        aria_label=title,
        viewBox=f"0 0 {width:g} {height:g}",
        width=width,
        height=height,
    )
