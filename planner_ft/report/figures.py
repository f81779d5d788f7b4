"""The figures of a test set, from scores and answers to charts; words in figures.toml."""

from __future__ import annotations

import tomllib
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from planner_ft.benchmark.costs import QUANTILES
from planner_ft.benchmark.metrics.failures import FAILURES, PUBLISHED
from planner_ft.benchmark.results import heading
from planner_ft.benchmark.statistics import quantile
from planner_ft.report.charts import Bar, Bars, Chart, DotRow, Dots, Lines, Matrix, Point, Series
from planner_ft.report.differences import Confusion, confusion
from planner_ft.report.metrics import estimate, published_label, published_rows
from planner_ft.report.runs import Record, System, TestSet
from planner_ft.vocabulary.plans import list_key

UNIT = {"mission": "tasks", "task": "steps"}
AGENT = {"mission": "Mission Agent", "task": "Task Agent"}
WORDS: Record = tomllib.loads(Path(__file__).with_name("figures.toml").read_text("utf-8"))


def charts(tests: TestSet) -> list[Chart]:
    """The figures over all systems for which the runs hold something, in the order of the page."""
    makers = (f1_bars, failure_matrix, stop_matrix, latency_dots, planning_lines, latency_lines)
    found: list[Chart | None] = [maker(tests) for maker in makers]
    return [chart for chart in found if chart is not None]


def system_charts(tests: TestSet, system: System) -> list[Chart]:
    """The figures of one system: names one by one, and substitutions."""
    counts = confusion(tests, system)
    if counts is None:
        return []
    replaced = substitution_matrix(tests, system, counts)
    return [name_dots(tests, system, counts), *([replaced] if replaced else [])]


def _words(tests: TestSet, kind: str, **values: object) -> tuple[str, str, str]:
    """Name, title and caption of a figure; that of one system ends with the system's slug."""
    ending = f"-{slug(str(values['system']))}" if "system" in values else ""
    title, caption = (WORDS[kind][key].format(**values) for key in ("title", "caption"))
    return f"{tests.key}-{kind}{ending}", title, caption


def f1_bars(tests: TestSet) -> Bars | None:
    """F1 as bars, latency as a line, published models beside."""
    if not tests.systems:
        return None
    bars, theirs = [], published_rows(tests)
    for system in tests.systems:
        f1, seconds = estimate(system, "f1"), estimate(system, "latency_s").value
        group = "baseline" if system.is_baseline else heading(system.configuration)
        bound = f1.low, f1.high
        bars.append(Bar(system.name, f1.value, *bound, seconds, system.is_baseline, group))
        key = (str(system.row.get("published")), system.configuration)
        if key in theirs:
            bars.append(_published_bar(key, theirs.pop(key)))
    bars += [_published_bar(key, figures) for key, figures in theirs.items()]
    name, title, caption = _words(tests, "f1")
    caption += WORDS["f1"]["compared"] if any(bar.muted for bar in bars) else ""
    return Bars(name, title, caption, "F1", "seconds per query", tuple(bars))


def _published_bar(key: tuple[str, str], figures: dict[str, float]) -> Bar:
    f1, seconds = figures.get("f1"), figures.get("latency_s")
    return Bar(published_label(key), f1, second=seconds, muted=True, group=heading(key[1]))


def failure_matrix(tests: TestSet) -> Matrix | None:
    """Wrong answers by kind and system, and the published analysis of the published test set."""
    rows = {system.name: system.row.get("failures") for system in tests.candidates}
    found: dict[str, Mapping[str, int]] = {name: counts for name, counts in rows.items() if counts}
    if not found:
        return None
    every = dict.fromkeys([*FAILURES, *(kind for counts in found.values() for kind in counts)])
    if tests.level == "mission" and published_rows(tests):
        counts = {str(kind): count for kind, count in PUBLISHED.items()}
        found["Mission Agent (published, 25 answers)"] = counts
    kinds = [kind for kind in every if any(counts.get(kind) for counts in found.values())]
    kinds = kinds or list(every)
    cells = tuple(tuple(counts.get(kind, 0) for kind in kinds) for counts in found.values())
    words = _words(tests, "failures", n=tests.n)
    return Matrix(*words, "System", tuple(found), tuple(kinds), cells)


def latency_dots(tests: TestSet) -> Dots | None:
    """Median, 90th and 99th percentile of timed queries."""
    rows = []
    for system in tests.systems:
        found = [_seconds(score) for score in system.scores.values()]
        seconds = [value for value in found if value is not None]
        if seconds:
            values = tuple(quantile(seconds, share).value for _name, share in QUANTILES)
            rows.append(DotRow(system.name, values, f"n = {len(seconds)}"))
    marks = tuple(name for name, _share in QUANTILES)
    return Dots(*_words(tests, "latency"), "seconds", marks, tuple(rows)) if rows else None


def _seconds(score: Record) -> float | None:
    found = score.get("latency_s")
    return found if isinstance(found, int | float) else None


def stop_matrix(tests: TestSet) -> Matrix | None:
    """Where replayed plans stop, and for want of what."""
    found: dict[str, dict[str, int]] = {}
    total: Counter[str] = Counter()
    for system in tests.candidates:
        stops = system.row.get("stops")
        if isinstance(stops, list):
            found[system.name] = {_stop(stop): stop["n"] for stop in stops}
            for stop in stops:
                total[_stop(stop)] += stop["n"]
    if not total:
        return None
    rows = tuple(name for name, _count in total.most_common())
    cells = tuple(tuple(counts.get(row, 0) for counts in found.values()) for row in rows)
    return Matrix(*_words(tests, "stops"), "Missing", rows, tuple(found), cells)


def _stop(stop: Record) -> str:
    return f"{stop['condition']}, at {stop['title']}" if stop.get("title") else "no plan"


def planning_lines(tests: TestSet) -> Lines | None:
    """Seconds to plan a mission of m tasks with both agents, where a run has timed it."""
    series = []
    for system in tests.systems:
        points = []
        for entry in (system.row.get("costs") or {}).get("planning") or []:
            found = entry["seconds"]
            ends = found["low"], found["high"]
            points.append(Point(entry["tasks"], found["value"], *ends, n=entry["n"]))
        series += [Series(system.name, tuple(points))] if points else []
    axes = "tasks in the plan", "seconds"
    return Lines(*_words(tests, "planning"), *axes, tuple(series)) if series else None


def latency_lines(tests: TestSet) -> Lines | None:
    """Mean time of a query by the number of tasks (steps) of the expected plan."""
    series = []
    for system in tests.systems:
        timed: dict[int, list[float]] = {}
        for name, score in system.scores.items():
            entries = tests.samples.get(name, {}).get("expected", {}).get(list_key(tests.level))
            seconds = _seconds(score)
            if seconds is not None and isinstance(entries, list):
                timed.setdefault(len(entries), []).append(seconds)
        points = tuple(_point(size, timed[size]) for size in sorted(timed))
        series += [Series(system.name, points)] if points else []
    unit, agent = UNIT[tests.level], AGENT[tests.level]
    words = _words(tests, "latency-by-size", unit=unit, agent=agent)
    axes = f"{unit} in the expected plan", "seconds"
    return Lines(*words, *axes, tuple(series)) if series else None


def _point(size: int, seconds: Sequence[float]) -> Point:
    low, high = (min(seconds), max(seconds)) if len(seconds) > 1 else (None, None)
    return Point(size, float(np.mean(seconds)), low, high, len(seconds))


def name_dots(tests: TestSet, system: System, counts: Confusion) -> Dots:
    """Precision and recall per task or skill, the most frequent first."""
    rows = []
    for label, found in sorted(counts.names.items(), key=lambda one: (-one[1].expected, one[0])):
        precision = found.precision if found.predicted else None
        recall = found.recall if found.expected else None
        note = f"{found.right} / {found.predicted} / {found.expected}"
        rows.append(DotRow(label, (precision, recall), note))
    what = "task" if tests.level == "mission" else "skill"
    words = _words(tests, "names", what=what, system=system.name)
    marks, note = ("precision", "recall"), "right / planned / expected"
    return Dots(*words, "share", marks, tuple(rows), note, 1.0)


def substitution_matrix(tests: TestSet, system: System, counts: Confusion) -> Matrix | None:
    """Names in the place of expected ones; omissions in the last column, additions last row."""
    found = counts.substitutions
    if not found:
        return None
    rows, columns = _by_frequency(found, 0), _by_frequency(found, 1)
    cells = tuple(
        tuple(None if row is column is None else found.get((row, column), 0) for column in columns)
        for row in rows
    )
    ours = tuple(row or "(added)" for row in rows)
    theirs = tuple(column or "(left out)" for column in columns)
    words = _words(tests, "substitutions", system=system.name)
    return Matrix(*words, "Expected", ours, theirs, cells)


def _by_frequency(found: Counter[tuple[str | None, str | None]], side: int) -> list[str | None]:
    """Names of one side, the most frequent first, nothing last."""
    totals: Counter[str | None] = Counter()
    for pair, count in found.items():
        totals[pair[side]] += count
    return sorted(totals, key=lambda name: (name is None, -totals[name], name or ""))


def slug(name: str) -> str:
    """A name for a file."""
    kept = (letter if letter.isalnum() and letter.isascii() else " " for letter in name.lower())
    return "-".join("".join(kept).split())
