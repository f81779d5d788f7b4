"""The content of figures, apart from how `pictures` draws it, and the same as tables."""

from __future__ import annotations

from dataclasses import dataclass

from planner_ft.support.tables import NOTHING, Cell, Table, TableRow, row

HEATS = 6  # shades of a count, beside none


@dataclass(frozen=True)
class Bar:
    """A figure with its interval; `second` is shown on an axis of its own. `muted` bars are there
    for comparison. Bars of a `group` (a configuration) have a colour and are joined by a line.
    """

    label: str
    value: float | None
    low: float | None = None
    high: float | None = None
    second: float | None = None
    muted: bool = False
    group: str = ""


@dataclass(frozen=True)
class _Named:
    """A chart's file name, title, and caption."""

    name: str
    title: str
    caption: str


@dataclass(frozen=True)
class Bars(_Named):
    """Bars from 0 to 1, and lines beside them on an axis of their own."""

    axis: str
    second_axis: str
    bars: tuple[Bar, ...]

    @property
    def groups(self) -> list[str]:
        """The groups in the order in which they first appear."""
        return list(dict.fromkeys(bar.group for bar in self.bars))

    def lines(self, group: str) -> list[list[int]]:
        """Indices of a group's bars with a second figure, measured and compared ones apart."""
        members = [index for index, bar in enumerate(self.bars) if bar.group == group]
        found = [index for index in members if self.bars[index].second is not None]
        runs = [[at for at in found if self.bars[at].muted == muted] for muted in (False, True)]
        return [run for run in runs if run]


@dataclass(frozen=True)
class Point:
    """A point of a line with the interval of its y value."""

    x: float
    y: float
    low: float | None = None
    high: float | None = None
    n: int = 1


@dataclass(frozen=True)
class Series:
    """A line with its points in order of x."""

    label: str
    points: tuple[Point, ...]


@dataclass(frozen=True)
class Lines(_Named):
    """Lines over whole numbers, y from 0."""

    x_axis: str
    y_axis: str
    series: tuple[Series, ...]


@dataclass(frozen=True)
class DotRow:
    """One value per mark; `note` is written behind."""

    label: str
    values: tuple[float | None, ...]
    note: str = ""


@dataclass(frozen=True)
class Dots(_Named):
    """Rows with several marks on one axis from 0 to `high` (None: the largest value)."""

    axis: str
    marks: tuple[str, ...]
    rows: tuple[DotRow, ...]
    note_heading: str = ""
    high: float | None = None


@dataclass(frozen=True)
class Matrix(_Named):
    """`counts[row][column]`, None where a cell does not apply; `corner` says what rows are."""

    corner: str
    rows: tuple[str, ...]
    columns: tuple[str, ...]
    counts: tuple[tuple[int | None, ...], ...]

    @property
    def largest(self) -> int:
        """The largest count."""
        return max((count or 0 for row in self.counts for count in row), default=0)


Chart = Bars | Lines | Dots | Matrix


def number(value: float | None) -> str:
    """A figure for people: three significant digits, no exponent for everyday sizes."""
    if value is None:
        return NOTHING
    if value != 0 and not 1e-4 <= abs(value) < 1e7:
        return f"{value:.2e}"
    if abs(value) >= 100:
        return f"{value:,.0f}"
    return f"{value:.3g}" if value else "0"


def chart_table(chart: Chart) -> Table:
    """The figures of a chart as a table; counts are shaded."""
    if isinstance(chart, Matrix):
        made = []
        for name, counts in zip(chart.rows, chart.counts, strict=True):
            cells = [_count(count, chart.largest or 1) for count in counts]
            made.append(row(name, *cells, kind="published" if "(published" in name else "measured"))
        words = chart.name, chart.title, chart.caption
        return Table(*words, chart.corner, chart.columns, tuple(made))
    heads: tuple[str, ...]
    if isinstance(chart, Bars):
        heads = ("System", chart.axis, "95 % interval", chart.second_axis)
        rows = tuple(_bar_row(bar) for bar in chart.bars)
    elif isinstance(chart, Dots):
        heads = ("", *chart.marks, chart.note_heading or "samples")
        rows = tuple(row(one.label, *map(number, one.values), one.note) for one in chart.rows)
    else:
        heads = ("Line", chart.x_axis, chart.y_axis, "samples")
        rows = tuple(
            row(series.label, number(point.x), number(point.y), str(point.n))
            for series in chart.series
            for point in series.points
        )
    return Table(f"{chart.name}-data", chart.title, "", heads[0], heads[1:], rows)


def _bar_row(bar: Bar) -> TableRow:
    interval = NOTHING if bar.low is None else f"[{number(bar.low)}, {number(bar.high)}]"
    return row(bar.label, number(bar.value), interval, number(bar.second))


def _count(count: int | None, largest: int) -> Cell:
    if count is None:
        return Cell(NOTHING)
    return Cell(str(count), heat=-(-HEATS * count // largest), bounds=(count, None, None))
