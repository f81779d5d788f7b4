"""The charts of a test set: tables of figures, and how they are drawn. The kind of each, its
columns, what it shows and how to read it stand in figures.toml.
"""

import tomllib
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import astuple, dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np

from planner_ft.benchmark.figures import QUANTILES
from planner_ft.benchmark.layout import lines, shows_published
from planner_ft.benchmark.metrics.answers import FAILURES, PUBLISHED
from planner_ft.benchmark.results import Row
from planner_ft.benchmark.statistics import quantile
from planner_ft.report.runs import Record, TestSet
from planner_ft.support.tables import NOTHING, Cell, Table, TableRow, row
from planner_ft.vocabulary.plans import list_key

F1 = ("f1", "latency_s")
POINTS = 40  # of a curve, at most
HEATS = 6  # shades of a count, beside none
FIGURES: Record = tomllib.loads(Path(__file__).with_name("figures.toml").read_text("utf-8"))
LEVELS: Record = FIGURES["levels"]

Counts = Mapping[str, Sequence[int | None]]  # by the heading of a row
Rows = Iterator[TableRow]
Kind = Literal["bars", "lines", "dots", "matrix"]


@dataclass(frozen=True)
class Chart:
    """A table whose cells hold numbers as (value, low, high), and how it is drawn.

    bars: a row each, the first column from 0 to 1 and the second on an axis of its own, in the
    colour of the row's group; rows that were not measured are pale. lines: a row per point, under
    the line's name, with x, y and n. dots: a row each, a mark per column, and a note in the last
    one. matrix: counts, None where a cell does not apply.
    """

    kind: Kind
    table: Table
    axis: str = ""
    groups: tuple[str, ...] = ()
    high: float | None = None


def charts(tests: TestSet) -> list[Chart]:
    """The figures over all systems for which the runs hold something, in the order of the page."""
    found = [_f1(tests), _failures(tests), _stops(tests)]
    found += [_chart(tests, kind, list(points(tests))) for kind, points in POINTS_OF.items()]
    return [chart for chart in found if chart.table.rows]


def system_charts(tests: TestSet, system: Row) -> list[Chart]:
    """The figures of one system: names one by one, and substitutions."""
    found = [_chart(tests, "names", list(_names(system)), system=system.name)]
    found.append(_substitutions(tests, system))
    return [chart for chart in found if chart.table.rows]


def number(value: float | None) -> str:
    """A figure for people: three significant digits, no exponent for everyday sizes."""
    if value is None:
        return NOTHING
    if value != 0 and not 1e-4 <= abs(value) < 1e7:
        return f"{value:.2e}"
    if abs(value) >= 100:
        return f"{value:,.0f}"
    return f"{value:.3g}" if value else "0"


def slug(name: str) -> str:
    """A name for a file."""
    kept = (letter if letter.isalnum() and letter.isascii() else " " for letter in name.lower())
    return "-".join("".join(kept).split())


def cell(value: float | None, low: float | None = None, high: float | None = None) -> Cell:
    """A figure with its interval."""
    interval = "" if low is None and high is None else f"[{number(low)}, {number(high)}]"
    return Cell(number(value), interval, bounds=(value, low, high))


def _chart(
    tests: TestSet,
    name: str,
    rows: Sequence[TableRow],
    heads: Sequence[str] | None = None,
    **values: object,
) -> Chart:
    """Rows under the words of figures.toml; a chart of one system ends with the system's slug.
    `heads` stand for those that the runs say.
    """
    about: Record = FIGURES[name]
    words = LEVELS[tests.level] | {"n": tests.n, **values}
    title, caption = (about[key].format(**words) for key in ("title", "caption"))
    heads = heads or [one.format(**words) for one in about["heads"]]
    ending = f"-{slug(str(values['system']))}" if "system" in values else ""
    table = Table(heads[0], heads[1:], rows, 0, f"{tests.key}-{name}{ending}", title, caption)
    return Chart(about["kind"], table, about.get("axis", ""), high=about.get("high"))


def _f1(tests: TestSet) -> Chart:
    shown = lines(tests.results, beside=tests.beside)
    rows = [
        row(one.name, *(cell(*astuple(one.figure(key))) for key in F1), kind=one.kind)
        for one in shown
    ]
    return replace(_chart(tests, "f1", rows), groups=tuple(one.heading for one in shown))


def _matrix(
    tests: TestSet, name: str, heads: Sequence[str], counts: Counts, **values: object
) -> Chart:
    """Rows of counts, shaded."""
    largest = max((count or 0 for of_row in counts.values() for count in of_row), default=0) or 1

    def shaded(count: int | None) -> Cell:
        if count is None:
            return Cell(NOTHING)
        return Cell(str(count), heat=-(-HEATS * count // largest), bounds=(count, None, None))

    rows = [
        row(one, *map(shaded, of_row), kind="published" if "(published" in one else "measured")
        for one, of_row in counts.items()
    ]
    return _chart(tests, name, rows, heads, **values)


def _failures(tests: TestSet) -> Chart:
    found: dict[str, Mapping[str, int]] = {}
    for system in tests.results.rows:
        found |= {system.name: system.failures} if system.failures else {}
    every = dict.fromkeys([*FAILURES, *(kind for counts in found.values() for kind in counts)])
    if found and tests.level == "mission" and tests.beside and shows_published(tests.results):
        counts = {str(kind): count for kind, count in PUBLISHED.items()}
        found["Mission Agent (published, 25 answers)"] = counts
    kinds = [kind for kind in every if any(counts.get(kind) for counts in found.values())]
    kinds = kinds or list(every)
    cells = {name: [counts.get(kind, 0) for kind in kinds] for name, counts in found.items()}
    return _matrix(tests, "failures", ("System", *kinds), cells)


def _stops(tests: TestSet) -> Chart:
    found: dict[str, Counter[str]] = {}
    for system in tests.results.rows:
        found[system.name] = Counter()
        for stop in system.breakdown.get("stops") or ():
            at = f"{stop['condition']}, at {stop['title']}" if stop.get("title") else "no plan"
            found[system.name][at] += stop["n"]
    total = sum(found.values(), Counter[str]())
    cells = {stop: [counts[stop] for counts in found.values()] for stop, _n in total.most_common()}
    return _matrix(tests, "stops", ("Missing", *found), cells)


def _seconds(scores: Mapping[str, Record]) -> dict[str, float]:
    """Seconds of the timed queries by sample."""
    timed = {name: score.get("latency_s") for name, score in scores.items()}
    return {name: value for name, value in timed.items() if isinstance(value, int | float)}


def _latency(tests: TestSet) -> Rows:
    for system in tests.results.rows:
        if seconds := list(_seconds(tests.scores.get(system.key, {})).values()):
            cells = (cell(quantile(seconds, share).value) for _name, share in QUANTILES)
            yield row(system.name, *cells, f"n = {len(seconds)}")


def _planning(tests: TestSet) -> Rows:
    for system in tests.results.rows:
        for entry in system.costs.get("planning") or []:
            seconds = cell(*(entry["seconds"][key] for key in ("value", "low", "high")))
            yield row(system.name, cell(entry["tasks"]), seconds, str(entry["n"]))


def _latency_by_size(tests: TestSet) -> Rows:
    for system in tests.results.rows:
        timed: dict[int, list[float]] = {}
        for name, seconds in _seconds(tests.scores.get(system.key, {})).items():
            entries = tests.samples.get(name, {}).get("expected", {}).get(list_key(tests.level))
            if isinstance(entries, list):
                timed.setdefault(len(entries), []).append(seconds)
        for size, values in sorted(timed.items()):
            reach = (min(values), max(values)) if len(values) > 1 else ()
            mean = cell(float(np.mean(values)), *reach)
            yield row(system.name, cell(size), mean, str(len(values)))


def _reliability(tests: TestSet) -> Rows:
    known = [one for one in tests.results.rows if one.breakdown.get("confidence", {}).get("bins")]
    for system in known:
        for held, share, n in system.breakdown["confidence"]["bins"]:
            yield row(system.name, cell(held), cell(share), str(n))
    for at in (0, 1) if known else ():
        yield row("as sure as right", cell(at), cell(at), NOTHING)


def _risk_coverage(tests: TestSet) -> Rows:
    for system in tests.results.rows:
        found = system.breakdown.get("confidence", {})
        curve = found.get("curve") or []
        for at in range(0, len(curve), -(-len(curve) // POINTS) or 1):
            yield row(system.name, cell((at + 1) / found["n"]), cell(curve[at]), str(at + 1))
        for at in (0, 1) if curve else ():
            risk = cell(found.get("aurc_random"))
            yield row(f"{system.name}, random order", cell(at), risk, NOTHING)


POINTS_OF: dict[str, Callable[[TestSet], Rows]] = {
    "reliability": _reliability,
    "risk-coverage": _risk_coverage,
    "latency": _latency,
    "planning": _planning,
    "latency-by-size": _latency_by_size,
}


def _names(system: Row) -> Rows:
    found = system.breakdown.get("per_name") or []
    for line in sorted(found, key=lambda line: (-line["expected"], str(line["name"]))):
        right, planned, expected = (line[key] for key in ("right", "predicted", "expected"))
        shares = (cell(right / of if of else None) for of in (planned, expected))
        yield row(str(line["name"]), *shares, f"{right} / {planned} / {expected}")


def _substitutions(tests: TestSet, system: Row) -> Chart:
    """Names in the place of expected ones; omissions in the last column, additions last row."""
    lines = system.breakdown.get("substitutions") or []
    found = {(line["expected"], line["predicted"]): line["n"] for line in lines}
    ours, theirs = (_by_frequency(lines, key) for key in ("expected", "predicted"))
    cells = {
        one or "(added)": [
            None if one is other is None else found.get((one, other), 0) for other in theirs
        ]
        for one in ours
    }
    heads = ("Expected", *(other or "(left out)" for other in theirs))
    return _matrix(tests, "substitutions", heads, cells, system=system.name)


def _by_frequency(lines: Sequence[Record], key: str) -> list[str | None]:
    """Names of one side, the most frequent first, nothing last."""
    totals: Counter[str | None] = Counter()
    for line in lines:
        totals[line[key]] += line["n"]
    return sorted(totals, key=lambda name: (name is None, -totals[name], name or ""))
