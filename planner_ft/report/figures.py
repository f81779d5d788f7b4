"""The figures of a test set: from scores and answers to charts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np

from planner_ft.benchmark.costs import QUANTILES, quantile
from planner_ft.benchmark.layout import heading
from planner_ft.benchmark.metrics import FAILURES
from planner_ft.benchmark.metrics.failures import PUBLISHED
from planner_ft.report.charts import Bar, Bars, Chart, DotRow, Dots, Lines, Matrix, Point, Series
from planner_ft.report.differences import Confusion, confusion
from planner_ft.report.metrics import estimate, published_label, published_rows
from planner_ft.report.runs import Record, System, TestSet
from planner_ft.vocabulary.plans import list_key

UNIT, AGENT = (
    {"mission": "tasks", "task": "steps"},
    {"mission": "Mission Agent", "task": "Task Agent"},
)


def charts(tests: TestSet) -> list[Chart]:
    """The figures over all systems for which the runs hold something, in the order of the page."""
    found = [
        f1_bars(tests),
        failure_matrix(tests),
        stop_matrix(tests),
        latency_dots(tests),
        planning_lines(tests),
        latency_lines(tests),
    ]
    return [chart for chart in found if chart is not None]


def system_charts(tests: TestSet, system: System) -> list[Chart]:
    """The figures of one system: names one by one, and what stands for what."""
    counts = confusion(tests, system)
    found = (
        []
        if counts is None
        else [name_dots(tests, system, counts), substitution_matrix(tests, system, counts)]
    )
    return [chart for chart in found if chart is not None]


def f1_bars(tests: TestSet) -> Bars | None:
    """F1 as bars, latency as a line, published models beside."""
    if not tests.systems:
        return None
    bars = []
    theirs = published_rows(tests)
    for system in tests.systems:
        found = estimate(system, "f1")
        bars.append(
            Bar(
                system.name,
                found.value,
                found.low,
                found.high,
                estimate(system, "latency_s").value,
                system.is_baseline,
                _group(system),
            )
        )
        key = (str(system.row.get("published")), str(system.row.get("configuration")))
        if key in theirs:
            bars.append(_published_bar(key, theirs.pop(key)))
    bars += [_published_bar(key, figures) for key, figures in theirs.items()]
    caption = "Bars: mean F1 over samples with its 95 % interval. Lines: mean seconds of one query."
    if any(bar.muted for bar in bars):
        caption += (
            " Pale bars are for comparison: baselines, and the published figures, which were"
            " measured elsewhere, on other samples and hardware."
        )
    return Bars(
        f"{tests.key}-f1", "F1 and latency", caption, "F1", "seconds per query", tuple(bars)
    )


def _published_bar(key: tuple[str, str], figures: dict[str, float]) -> Bar:
    return Bar(
        published_label(key),
        figures.get("f1"),
        second=figures.get("latency_s"),
        muted=True,
        group=heading(key[1]),
    )


def _group(system: System) -> str:
    return "baseline" if system.is_baseline else heading(str(system.row.get("configuration")))


def failure_matrix(tests: TestSet) -> Matrix | None:
    """Wrong answers by kind and system; in the end the published analysis, where it is about this
    test set.
    """
    rows = [system for system in tests.candidates if system.row.get("failures")]
    if not rows:
        return None
    kinds = list(
        dict.fromkeys([*FAILURES, *(kind for system in rows for kind in system.row["failures"])])
    )
    names = [system.name for system in rows]
    columns: list[Mapping[str, int]] = [system.row["failures"] for system in rows]
    if tests.level == "mission" and published_rows(tests):
        names, columns = (
            [*names, "Mission Agent (published, 25 answers)"],
            [*columns, {str(kind): count for kind, count in PUBLISHED.items()}],
        )
    kinds = [kind for kind in kinds if any(column.get(kind) for column in columns)] or kinds
    counts = tuple(tuple(column.get(kind, 0) for kind in kinds) for column in columns)
    caption = f"Every wrong answer, classified automatically; of {tests.n} answers per system."
    return Matrix(
        f"{tests.key}-failures",
        "Kinds of failure",
        caption,
        "System",
        tuple(names),
        tuple(kinds),
        counts,
    )


def latency_dots(tests: TestSet) -> Dots | None:
    """Median, 90th and 99th percentile of timed queries."""
    rows = []
    for system in tests.systems:
        seconds = [
            score["latency_s"]
            for score in system.scores.values()
            if isinstance(score.get("latency_s"), int | float)
        ]
        if seconds:
            rows.append(
                DotRow(
                    system.name,
                    tuple(quantile(seconds, share).value for _name, share in QUANTILES),
                    f"n = {len(seconds)}",
                )
            )
    if not rows:
        return None
    caption = (
        "Seconds of one query, one at a time after a warm-up. With few queries the 99th percentile"
        " is the slowest one."
    )
    return Dots(
        f"{tests.key}-latency",
        "Latency of one query",
        caption,
        "seconds",
        tuple(name for name, _share in QUANTILES),
        tuple(rows),
    )


def stop_matrix(tests: TestSet) -> Matrix | None:
    """Where replayed plans stop, and for want of what."""
    found = [
        (system, system.row.get("stops") or [])
        for system in tests.candidates
        if isinstance(system.row.get("stops"), list)
    ]
    total: Counter[str] = Counter()
    for _system, stops in found:
        for stop in stops:
            total[_stop(stop)] += stop["n"]
    if not total:
        return None
    rows = [name for name, _count in total.most_common()]
    counts = [{_stop(stop): stop["n"] for stop in stops} for _system, stops in found]
    cells = tuple(tuple(of_system.get(row, 0) for of_system in counts) for row in rows)
    caption = (
        "Plans replayed against what each task needs and gives: where they stop first, and for want"
        " of what."
    )
    return Matrix(
        f"{tests.key}-stops",
        "Plans that do not run to the end",
        caption,
        "Missing",
        tuple(rows),
        tuple(system.name for system, _stops in found),
        cells,
    )


def _stop(stop: Record) -> str:
    return f"{stop['condition']}, at {stop['title']}" if stop.get("title") else "no plan"


def planning_lines(tests: TestSet) -> Lines | None:
    """Seconds to plan a mission of m tasks with both agents, where a run has timed it."""
    series = []
    for system in tests.systems:
        entries = (system.row.get("costs") or {}).get("planning") or []
        points = tuple(
            Point(
                entry["tasks"],
                entry["seconds"]["value"],
                entry["seconds"]["low"],
                entry["seconds"]["high"],
                entry["n"],
            )
            for entry in entries
        )
        series += [Series(system.name, points)] if points else []
    if not series:
        return None
    caption = (
        "Mean seconds from a command to tasks and skills, both agents; upright strokes are 95 %"
        " intervals."
    )
    return Lines(
        f"{tests.key}-planning",
        "Planning time by number of tasks",
        caption,
        "tasks in the plan",
        "seconds",
        tuple(series),
    )


def latency_lines(tests: TestSet) -> Lines | None:
    """Mean time of a query by the number of tasks (steps) of the expected plan."""
    series = []
    for system in tests.systems:
        timed: dict[int, list[float]] = {}
        for name, score in system.scores.items():
            entries = tests.samples.get(name, {}).get("expected", {}).get(list_key(tests.level))
            if isinstance(score.get("latency_s"), int | float) and isinstance(entries, list):
                timed.setdefault(len(entries), []).append(score["latency_s"])
        points = tuple(_point(size, timed[size]) for size in sorted(timed))
        series += [Series(system.name, points)] if points else []
    if not series:
        return None
    unit, agent = UNIT[tests.level], AGENT[tests.level]
    caption = (
        f"Mean seconds of a query of the {agent} by the number of {unit} in the expected plan;"
        " upright strokes reach from the fastest to the slowest."
    )
    return Lines(
        f"{tests.key}-latency-by-size",
        f"Latency by number of {unit}",
        caption,
        f"{unit} in the expected plan",
        "seconds",
        tuple(series),
    )


def _point(size: int, seconds: Sequence[float]) -> Point:
    several = len(seconds) > 1
    return Point(
        size,
        float(np.mean(seconds)),
        min(seconds) if several else None,
        max(seconds) if several else None,
        len(seconds),
    )


def name_dots(tests: TestSet, system: System, counts: Confusion) -> Dots:
    """Precision and recall per task or skill, the most frequent first."""
    order = sorted(counts.names.items(), key=lambda entry: (-entry[1].expected, entry[0]))
    rows = tuple(
        DotRow(
            name,
            (
                found.precision if found.predicted else None,
                found.recall if found.expected else None,
            ),
            f"{found.right} / {found.predicted} / {found.expected}",
        )
        for name, found in order
    )
    what = "task" if tests.level == "mission" else "skill"
    caption = (
        f"Precision: share of the planned {what}s of a name that were expected. Recall: share of"
        " the expected ones that were planned."
    )
    title = f"Precision and recall per {what}: {system.name}"
    return Dots(
        f"{tests.key}-names-{slug(system.name)}",
        title,
        caption,
        "share",
        ("precision", "recall"),
        rows,
        "right / planned / expected",
        1.0,
    )


def substitution_matrix(tests: TestSet, system: System, counts: Confusion) -> Matrix | None:
    """What stands where something else was expected; the last column is what was left out, the last
    row what was added.
    """
    if not counts.substitutions:
        return None
    rows, columns = _by_frequency(counts.substitutions, 0), _by_frequency(counts.substitutions, 1)
    cells = tuple(
        tuple(
            None if row is column is None else counts.substitutions.get((row, column), 0)
            for column in columns
        )
        for row in rows
    )
    names = (
        tuple(row or "(added)" for row in rows),
        tuple(column or "(left out)" for column in columns),
    )
    caption = (
        "Rows: what was expected. Columns: what the answer has in its place. Where both agree"
        " nothing is counted."
    )
    title = f"Substitutions: {system.name}"
    return Matrix(
        f"{tests.key}-substitutions-{slug(system.name)}", title, caption, "Expected", *names, cells
    )


def _by_frequency(found: Counter[tuple[str | None, str | None]], side: int) -> list[str | None]:
    """Names of one side, the most frequent first, nothing last."""
    totals: Counter[str | None] = Counter()
    for pair, count in found.items():
        totals[pair[side]] += count
    return sorted(totals, key=lambda name: (name is None, -totals[name], name or ""))


def slug(name: str) -> str:
    """A name for a file."""
    return "-".join(
        "".join(
            letter if letter.isalnum() and letter.isascii() else " "
            for letter in name.lower().replace("+", " ")
        ).split()
    )
