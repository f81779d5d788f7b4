"""What a figure shows, apart from how it is drawn: the page draws it as SVG, figures.py with
matplotlib.

Every chart has a `name` (file name), a `title` and a `caption` that says what to see in it.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Bar:
    """A figure with its interval; `second` is shown on an axis of its own. `muted` bars are there
    for comparison: published, baselines.

    Bars of a `group` (a configuration) have a colour, and their second figures are joined by a
    line.
    """

    label: str
    value: float | None
    low: float | None = None
    high: float | None = None
    second: float | None = None
    muted: bool = False
    group: str = ""


@dataclass(frozen=True)
class Bars:
    """Bars from 0 to 1, and lines beside them on an axis of their own."""

    name: str
    title: str
    caption: str
    axis: str
    second_axis: str
    bars: tuple[Bar, ...]

    @property
    def groups(self) -> list[str]:
        """The groups in the order in which they first appear."""
        return list(dict.fromkeys(bar.group for bar in self.bars if bar.group))

    @property
    def has_second(self) -> bool:
        """Whether any bar has a second figure."""
        return any(bar.second is not None for bar in self.bars)

    def lines(self, group: str) -> list[list[int]]:
        """Indices of a group's bars with a second figure, measured and compared ones apart: a line
        joins what was measured alike.
        """
        found = [
            index
            for index, bar in enumerate(self.bars)
            if bar.group == group and bar.second is not None
        ]
        return [
            run
            for muted in (False, True)
            if (run := [index for index in found if self.bars[index].muted == muted])
        ]


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
class Lines:
    """Lines over whole numbers, y from 0."""

    name: str
    title: str
    caption: str
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
class Dots:
    """Rows with several marks on one axis that starts at 0; `high` is its end, the largest value
    where it is None.
    """

    name: str
    title: str
    caption: str
    axis: str
    marks: tuple[str, ...]
    rows: tuple[DotRow, ...]
    note_heading: str = ""
    high: float | None = None


@dataclass(frozen=True)
class Matrix:
    """Counts; `counts[row][column]`. `corner` says what rows and columns are. Cells that are None
    do not apply.
    """

    name: str
    title: str
    caption: str
    corner: str
    rows: tuple[str, ...]
    columns: tuple[str, ...]
    counts: tuple[tuple[int | None, ...], ...]

    @property
    def largest(self) -> int:
        """The largest count."""
        return max((count or 0 for row in self.counts for count in row), default=0)


Chart = Bars | Lines | Dots | Matrix


def ticks(high: float, count: int = 5) -> list[float]:
    """About `count` round steps from 0 to the first that is not below `high`."""
    if high <= 0:
        return [0.0, 1.0]
    magnitude = 10.0 ** _exponent(high / count)
    step = next(
        factor * magnitude
        for factor in (1, 2, 2.5, 5, 10)
        if factor * magnitude * count >= high * 0.999999
    )
    steps = [0.0]
    while steps[-1] < high * 0.999999:
        steps.append(round(len(steps) * step, 10))
    return steps


def _exponent(value: float) -> int:
    return int(f"{value:e}".partition("e")[2])


def number(value: float | None) -> str:
    """A figure for people: three significant digits, no exponent for everyday sizes."""
    if value is None:
        return "–"
    if value != 0 and not 1e-4 <= abs(value) < 1e7:
        return f"{value:.2e}"
    if abs(value) >= 100:
        return f"{value:,.0f}"
    return f"{value:.3g}" if value else "0"
