"""The tables of a run: table.md, table.csv and table.tex.

Figures stand in the long form, a row per candidate and configuration. Tables with a column per
system (figures per name, substitutions ...) are written for each candidate.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from planner_ft.benchmark.catalogue import MAIN, METRIC, RIGHT, SECTIONS
from planner_ft.benchmark.contrasts import DECISIVE, Contrasts, baseline_name
from planner_ft.benchmark.costs import QUANTILES
from planner_ft.benchmark.layout import (
    by_candidate,
    figures_table,
    lines,
    metric_table,
    notes,
    shows_published,
)
from planner_ft.benchmark.metrics.failures import FAILURES, PUBLISHED
from planner_ft.benchmark.results import Results, Row
from planner_ft.benchmark.statistics import Estimate
from planner_ft.benchmark.verdicts import MARKS, Comparison, difference_cell, verdict
from planner_ft.support.resources import memory_size
from planner_ft.support.tables import (
    NOTHING,
    Cell,
    Table,
    TableRow,
    csv_table,
    figure,
    latex_table,
    markdown_table,
    row,
)

SHOWN_PAIRS, SHOWN_IDS, SHOWN_OTHERS = 15, 3, 10
COUNTED = (
    ("substitutions", ("expected", "predicted"), ("Expected", "predicted"), "(nothing)"),
    ("stops", ("condition", "title"), ("Stops for want of", "at"), "(no plan)"),
)
"""Parts of a breakdown that count pairs: their keys, their headings, and the word for nothing."""
Figures = Mapping[str, Any]


def render_tables(results: Results) -> dict[str, str]:
    """The texts of table.md, table.csv and table.tex."""
    shown, below = lines(results), notes(results)
    texts = [markdown_table(table) for table in tables(results)]
    return {
        "table.md": "\n".join([*texts, *(f"- {note}" for note in below)]) + "\n",
        "table.csv": csv_table(figures_table(shown)),
        "table.tex": latex_table(metric_table(MAIN, shown))
        + "".join(f"% {note}\n" for note in below),
    }


def tables(results: Results) -> list[Table]:
    """Every table of table.md: the published metrics first."""
    shown = lines(results)
    ours = [line for line in shown if line.kind != "published"]
    first = [metric_table(MAIN, shown), metric_table(RIGHT, ours), _failures(results)]
    return [*first, *detail_tables(results)]


def detail_tables(results: Results) -> Iterator[Table]:
    """The tables behind the first ones."""
    ours = lines(results, beside=False)
    for title, names in SECTIONS:
        table = metric_table(names, ours, corner=title)
        if len(table.columns) > 2:
            yield table
    for of_candidate in by_candidate(results.rows):
        yield from names_tables(of_candidate)
        yield from counted_tables(of_candidate)
        yield from examples_tables(of_candidate)
    yield from confidence_tables(ours)
    yield from cost_tables({one.name: one.costs for one in results.rows if one.costs})
    yield from difference_tables(results.contrasts)
    yield from repeat_tables({one.name: one.repeats for one in results.rows if one.repeats})
    yield from change_tables(results.changes)
    yield from group_tables(results.groups)


def _failures(results: Results) -> Table:
    rows = [
        row(one.name, str(one.n), *(str(one.failures.get(kind, 0)) for kind in FAILURES))
        for one in results.rows
    ]
    if results.level == "mission" and shows_published(results):
        counts = (str(PUBLISHED.get(kind, 0)) for kind in FAILURES)
        rows.append(row("mission agent (published)", "25", *counts, kind="published"))
    return _table("Wrong answers by kind", ("n", *FAILURES), rows)


def _table(corner: str, columns: Iterable[str], rows: Iterable[TableRow], texts: int = 0) -> Table:
    return Table(corner, "", "", corner, tuple(columns), tuple(rows), texts)


def names_tables(rows: Sequence[Row]) -> Iterator[Table]:
    """F1 of each role and name with its interval, and its support: the occurrences expected. All
    names that were predicted and nowhere expected are in results.json.
    """
    for part, key in (("per_role", "role"), ("per_name", "name")):
        figures = [{line[key]: line for line in one.breakdown.get(part, ())} for one in rows]
        support = {
            name: line["expected"] for of_row in reversed(figures) for name, line in of_row.items()
        }
        ordered = sorted(support, key=lambda name: (-support[name], name))
        extra = [name for name in ordered if not support[name]][:SHOWN_OTHERS]
        body = []
        for name in [*(name for name in ordered if support[name]), *extra]:
            cells = [_estimate(of_row.get(name, {}).get("f1")) for of_row in figures]
            body.append(row(name, str(support[name]), *cells))
        if body:
            yield _table(f"F1 per {key} ↑", ("expected", *(one.name for one in rows)), body)


def counted_tables(rows: Sequence[Row]) -> Iterator[Table]:
    """The most frequent substitutions, and the conditions that stop mission plans."""
    for part, keys, heads, nothing in COUNTED:
        counts = [
            Counter({tuple(line[key] or "" for key in keys): line["n"] for line in found})
            for found in (one.breakdown.get(part, ()) for one in rows)
        ]
        total: Counter[tuple[str, ...]] = sum(counts, Counter())
        frequent = sorted(total, key=lambda pair: (-total[pair], pair))[:SHOWN_PAIRS]
        body = [
            row(one or nothing, other or nothing, *(str(found[one, other]) for found in counts))
            for one, other in frequent
        ]
        if body:
            yield _table(heads[0], (heads[1], *(one.name for one in rows)), body, texts=1)


def examples_tables(rows: Sequence[Row]) -> Iterator[Table]:
    """Ids of wrong answers by kind."""
    figures = [one.breakdown.get("failure_examples", {}) for one in rows]
    kinds = [kind for kind in FAILURES if any(kind in examples for examples in figures)]
    body = [
        row(kind, *(", ".join(found.get(kind, [])[:SHOWN_IDS]) or NOTHING for found in figures))
        for kind in kinds
    ]
    if kinds:
        yield _table("Examples of wrong answers", [one.name for one in rows], body, texts=len(rows))


def confidence_tables(rows: Sequence[Row]) -> Iterator[Table]:
    """Whether a system knows when it is wrong, where it says how sure it is."""
    body = []
    for one in rows:
        if found := one.breakdown.get("confidence"):
            area, by_chance = found["aurc"], found["aurc_random"]
            cells = [
                figure(found["ece"], decimals=3),
                figure(area, decimals=3),
                figure(area / by_chance if by_chance else None),
                figure(found["least_sure_tenth"], scale=100, decimals=0),
                figure(found["approved_99"], scale=100, decimals=0),
            ]
            how = "calibrated" if found["calibrated"] else "not calibrated"
            body.append(row(one.name, how, str(found["n"]), str(found["wrong"]), *cells))
    if body:
        heads = ["n", "wrong", "Calibration error ↓", "Area under risk-coverage ↓"]
        heads += ["of random order ↓", "Wrong plans in the least sure tenth (%) ↑"]
        heads += ["To approve at 99 % right (%) ↑"]
        yield _table("How sure", ("", *heads), body, texts=1)


def _estimate(found: Figures | None, scale: float = 1, decimals: int = 2) -> Cell:
    """A figure of results.json with its interval."""
    bounds = [(found or {}).get(name) for name in ("value", "low", "high")]
    return figure(*bounds, scale=scale, decimals=decimals)


def cost_tables(known: Mapping[str, Figures]) -> Iterator[Table]:
    """A line per system, and planning time by number of tasks."""
    body = []
    for name, costs in known.items():
        latency, memory = costs.get("latency_s", {}), costs.get("peak_memory_bytes")
        cells = [
            *(_estimate(latency.get(quantile)) for quantile, _share in QUANTILES),
            _estimate(costs.get("first_token_s"), decimals=3),
            _estimate(costs.get("tokens_per_s"), decimals=0),
            figure(costs.get("load_s"), decimals=1),
            figure(costs.get("adapter_swap_s"), decimals=4),
        ]
        size = NOTHING if memory is None else memory_size(memory)
        body.append(row(name, str(costs.get("n", 0)), *cells, size))
    if body:
        heads = [f"Latency {name} (s)" for name, _share in QUANTILES]
        heads += ["First token (s)", "Tokens/s", "Load (s)", "Adapter switch (s)", "Peak memory"]
        yield _table("Cost", ("timed queries", *heads), body)
    planning: dict[tuple[str, str], Cell] = {}
    for name, costs in known.items():
        for entry in costs.get("planning", ()):
            text = f"{entry['seconds']['value']:.2f} (n = {entry['n']})"
            planning[name, str(entry["tasks"])] = Cell(text)
    if planning:
        most = max(int(tasks) for _name, tasks in planning)
        numbers = {str(tasks): str(tasks) for tasks in range(1, most + 1)}
        corner = "Seconds to plan a mission of m tasks, both agents; m ="
        yield _pivot(corner, planning, numbers)


def difference_tables(found: Contrasts) -> Iterator[Table]:
    """Differences between the configurations of a model, and of every row from the baselines."""

    def of_pair(one: Comparison) -> str:
        return f"{one.second} against {one.first}"

    if ours := found["configuration"]:
        columns = {one.paired.metric: METRIC[one.paired.metric].heading for one in ours}
        by_metric = {(of_pair(one), one.paired.metric): one.difference() for one in ours}
        yield _pivot("Difference, paired by sample", by_metric, columns)
    if beside := found["baseline"]:
        columns = {
            f"{metric} {first}": f"{METRIC[metric].heading} against {baseline_name(first)}"
            for metric in DECISIVE
            for first in dict.fromkeys(one.first for one in beside)
        }
        cells = {
            (one.second, f"{one.paired.metric} {one.first}"): one.difference() for one in beside
        }
        yield _pivot("Against the baselines", cells, columns)


def _pivot(corner: str, cells: Mapping[tuple[str, str], Cell], columns: Mapping[str, str]) -> Table:
    """A table from cells by (row, column)."""
    names = dict.fromkeys(name for name, _column in cells)
    body = [row(name, *(cells.get((name, key), NOTHING) for key in columns)) for name in names]
    return _table(corner, columns.values(), body)


def repeat_tables(figures: Mapping[str, Figures]) -> Iterator[Table]:
    """pass^k (all of k answers are right) and pass@k (at least one is), for k = 1, 2, 4 ... and the
    last.
    """
    shown = {name: found for name, found in figures.items() if found.get("k", 0) > 1}
    if not shown:
        return
    last = {found["k"] for found in shown.values()}
    ks = sorted({2**power for power in range(10) if 2**power < max(last)} | last)
    asked = [("all_of_k", k) for k in ks] + [("any_of_k", k) for k in ks if k > 1]
    body = [
        row(
            f"{name}, {found['k']} answers per sample",
            *(_estimate(found[kind].get(str(k)), 100, 1) for kind, k in asked),
        )
        for name, found in shown.items()
    ]
    heads = [f"pass{'^' if kind == 'all_of_k' else '@'}{k}" for kind, k in asked]
    caption = "pass^k: all of k answers are right; pass@k: at least one of k is (pass@1 is pass^1)."
    corner = "Whole plan right (%)"
    yield Table("repeats", "", caption, corner, tuple(heads), tuple(body))


def change_tables(changes: Sequence[Figures]) -> Iterator[Table]:
    """Differences by enforcing, and the outcomes that changed."""
    body, moved = [], []
    for change in changes:
        name = f"{change['candidate']}, {change['before']} → {change['after']}"
        differences = []
        for metric, p in zip(("f1", "whole_plan"), change["p_adjusted"], strict=True):
            found = Estimate(**change[metric])
            differences.append(difference_cell(metric, found, MARKS[verdict(metric, found, p)]))
        ratios = [
            NOTHING if change[key] is None else f"× {change[key]:.2f}"
            for key in ("seconds", "forward_passes")
        ]
        body.append(row(name, str(change["n"]), *differences, *ratios))
        moved += [
            row(name, one["before"], one["after"], str(one["n"]))
            for one in change["outcomes"]
            if one["before"] != one["after"]
        ]
    if body:
        heads = ("n", "F1 (difference)", "Whole plan right (difference, points)")
        ratio_heads = ("Latency (ratio)", "Forward passes (ratio)")
        yield _table("Changes by enforcing", (*heads, *ratio_heads), body)
    if moved:
        columns = ("free", "enforced", "samples")
        yield _table("Outcome, sample by sample", columns, moved, texts=2)


def group_tables(figures: Sequence[Figures]) -> Iterator[Table]:
    """One line per group of the data and system."""
    names = ("exact_sequence", "parameters", "whole_plan", "strict_valid")
    body = []
    for entry in sorted(figures, key=lambda entry: str(entry["group"])):
        shares = [figure(entry[name], scale=100, decimals=0) for name in names]
        system = f"{entry['candidate']}, {entry['configuration']}"
        body.append(row(entry["group"], system, str(entry["n"]), f"{entry['f1']:.2f}", *shares))
    if body:
        heads = ("System", "n", "F1", *(METRIC[name].heading for name in names))
        yield _table("Group", heads, body, texts=1)
