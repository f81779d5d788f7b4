"""Charts as PNG and SVG, drawn with matplotlib: colours that colour-blind people can tell apart,
letters that stay text.
"""

from __future__ import annotations

import io
from typing import Any

from planner_ft.report.charts import Bars, Chart, Dots, Lines, Matrix, ticks

PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#555555", "#B8A000")
"""Okabe and Ito's colours (2008), the brightest yellow darkened for white paper."""
LONGEST = 44
"""Letters of a label."""
MARKERS = ("o", "s", "^", "D", "v")
STYLES = ("-", "--", ":", "-.")
SETTINGS = {
    "svg.fonttype": "none",
    "svg.hashsalt": "planner_ft",
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
}


def picture(chart: Chart) -> dict[str, bytes]:
    """The bytes of a chart as "png" and "svg"; the same chart gives the same bytes."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib.figure import Figure

    with matplotlib.rc_context(SETTINGS):
        figure = Figure(layout="constrained")
        _draw(figure, chart)
        # Lay out once, not for each format again.
        figure.draw_without_rendering()
        figure.set_layout_engine("none")
        return {
            "png": _saved(figure, "png", {"dpi": 150, "metadata": {"Software": None}}),
            "svg": _saved(figure, "svg", {"metadata": {"Date": None}}),
        }


def _draw(figure: Any, chart: Chart) -> None:
    if isinstance(chart, Bars):
        _bars(figure, chart)
    elif isinstance(chart, Lines):
        _lines(figure, chart)
    elif isinstance(chart, Dots):
        _dots(figure, chart)
    else:
        _matrix(figure, chart)


def _saved(figure: Any, suffix: str, options: dict[str, Any]) -> bytes:
    buffer = io.BytesIO()
    figure.savefig(buffer, format=suffix, **options)
    return buffer.getvalue()


def _rows(figure: Any, labels: list[str], title: str, axis: str, *, extra: float = 0) -> Any:
    """Axes with a row per label, the first on top."""
    figure.set_size_inches(7.2, 1.3 + extra + 0.28 * len(labels))
    axes = figure.subplots()
    _dress(axes, labels, title, axis)
    return axes


def fitted(label: str) -> str:
    """A label that leaves room for the figure, on one line; dollars would be read as formulas."""
    label = " ".join(label.split()).replace("$", "\\$")
    return label if len(label) <= LONGEST else f"{label[: LONGEST - 1]}…"


def _dress(axes: Any, labels: list[str], title: str, axis: str) -> None:
    axes.set_yticks(range(len(labels)), [fitted(label) for label in labels])
    axes.set_ylim(len(labels) - 0.4, -0.6)
    axes.set_xlabel(axis)
    axes.set_title(title, loc="left", fontsize=10, fontweight="bold")
    axes.grid(axis="x", alpha=0.3)
    axes.tick_params(axis="y", length=0)


def _bars(figure: Any, chart: Bars) -> None:
    labels = [bar.label for bar in chart.bars]
    figure.set_size_inches(7.2, 1.5 + 0.28 * len(labels))
    axes, *others = figure.subplots(
        1,
        2 if chart.has_second else 1,
        sharey=True,
        width_ratios=[2, 1] if chart.has_second else [1],
        squeeze=False,
    )[0]
    _dress(axes, labels, chart.title, chart.axis)
    axes.set_xlim(0, 1.1)
    for index, bar in enumerate(chart.bars):
        if bar.value is None:
            continue
        axes.barh(
            index,
            bar.value,
            height=0.6,
            color=_colour(chart, bar.group),
            alpha=0.35 if bar.muted else 1,
        )
        if bar.low is not None and bar.high is not None:
            axes.errorbar(
                bar.value,
                index,
                xerr=[[bar.value - bar.low], [bar.high - bar.value]],
                color="black",
                capsize=2.5,
                linewidth=1,
            )
        axes.annotate(
            f"{bar.value:.2f}",
            (max(bar.value, bar.high or 0), index),
            (4, 0),
            textcoords="offset points",
            va="center",
            fontsize=8,
        )
    for second in others:
        second.set_xlabel(chart.second_axis)
        second.grid(axis="x", alpha=0.3)
        second.tick_params(axis="y", length=0)
        for number, group in enumerate(chart.groups):
            for run in chart.lines(group):
                style = {
                    "marker": MARKERS[number % len(MARKERS)],
                    "alpha": 0.5 if chart.bars[run[0]].muted else 1,
                }
                second.plot(
                    [chart.bars[index].second for index in run],
                    run,
                    STYLES[number % len(STYLES)],
                    color=_colour(chart, group),
                    markersize=4,
                    **style,
                )
        second.set_xlim(left=0)
    if len(chart.groups) > 1:
        from matplotlib.patches import Patch

        figure.legend(
            handles=[
                Patch(color=_colour(chart, group), label=fitted(group)) for group in chart.groups
            ],
            loc="outside lower left",
            frameon=False,
            ncols=4,
            fontsize=8,
        )


def _colour(chart: Bars, group: str) -> str:
    return PALETTE[chart.groups.index(group) % len(PALETTE)] if group else PALETTE[0]


def _lines(figure: Any, chart: Lines) -> None:
    figure.set_size_inches(7.2, 4)
    axes = figure.subplots()
    for index, series in enumerate(chart.series):
        colour = PALETTE[index % len(PALETTE)]
        x, y = [point.x for point in series.points], [point.y for point in series.points]
        axes.plot(
            x,
            y,
            STYLES[index % len(STYLES)],
            marker=MARKERS[index % len(MARKERS)],
            color=colour,
            markersize=5,
            label=fitted(series.label),
        )
        spread = [point for point in series.points if point.low is not None]
        axes.vlines(
            [point.x for point in spread],
            [point.low for point in spread],
            [point.high for point in spread],
            color=colour,
            alpha=0.4,
        )
    axes.set(xlabel=chart.x_axis, ylabel=chart.y_axis)
    axes.set_title(chart.title, loc="left", fontsize=10, fontweight="bold")
    axes.set_ylim(bottom=0)
    axes.set_xticks(sorted({point.x for series in chart.series for point in series.points}))
    axes.grid(alpha=0.3)
    axes.legend(frameon=False, fontsize=8)


def _dots(figure: Any, chart: Dots) -> None:
    axes = _rows(figure, [row.label for row in chart.rows], chart.title, chart.axis, extra=0.3)
    for index, row in enumerate(chart.rows):
        known = [value for value in row.values if value is not None]
        if len(known) > 1:
            axes.hlines(index, min(known), max(known), color="#999999", linewidth=1.5, zorder=1)
        if row.note:
            axes.annotate(
                row.note,
                (1.01, index),
                xycoords=("axes fraction", "data"),
                va="center",
                fontsize=8,
                color="#555555",
                annotation_clip=False,
            )
    for mark, label in reversed(list(enumerate(chart.marks))):
        found = [
            (row.values[mark], index)
            for index, row in enumerate(chart.rows)
            if row.values[mark] is not None
        ]
        axes.scatter(
            [x for x, _y in found],
            [y for _x, y in found],
            s=34,
            marker=MARKERS[mark],
            color=PALETTE[mark],
            label=label,
            zorder=3,
        )
    axes.set_xlim(
        0,
        (
            chart.high
            or ticks(max((value or 0 for row in chart.rows for value in row.values), default=1))[-1]
        )
        * 1.02,
    )
    if chart.note_heading:
        axes.annotate(
            chart.note_heading,
            (1.01, -0.9),
            xycoords=("axes fraction", "data"),
            fontsize=8,
            color="#555555",
            annotation_clip=False,
        )
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(
        handles[::-1],
        labels[::-1],
        loc="outside lower right",
        frameon=False,
        ncols=len(labels),
        fontsize=8,
    )


def _matrix(figure: Any, chart: Matrix) -> None:
    figure.set_size_inches(2.8 + 0.5 * len(chart.columns), 1.9 + 0.3 * len(chart.rows))
    axes = figure.subplots()
    values = [[float("nan") if count is None else count for count in row] for row in chart.counts]
    axes.imshow(values, cmap="Blues", vmin=0, vmax=max(chart.largest, 1) * 1.15, aspect="auto")
    axes.set_xticks(
        range(len(chart.columns)),
        [fitted(name) for name in chart.columns],
        rotation=40,
        ha="right",
        rotation_mode="anchor",
    )
    axes.set_yticks(range(len(chart.rows)), [fitted(name) for name in chart.rows])
    axes.tick_params(length=0)
    for row, counts in enumerate(chart.counts):
        for column, count in enumerate(counts):
            if count:
                axes.text(
                    column,
                    row,
                    str(count),
                    ha="center",
                    va="center",
                    color="white" if count > 0.6 * chart.largest else "black",
                )
    axes.set_title(chart.title, loc="left", fontsize=10, fontweight="bold")
