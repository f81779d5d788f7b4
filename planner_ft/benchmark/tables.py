"""The tables of a run: table.md, table.csv and table.tex.

Figures stand in the long form, a row per candidate and configuration. Tables with a column per
system (figures per name, substitutions ...) are written for each candidate.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from planner_ft.benchmark import layout
from planner_ft.benchmark.catalogue import COLUMNS, MAIN, METRIC, RIGHT, SECTIONS, Columns
from planner_ft.benchmark.contrasts import DECISIVE, Contrasts, baseline_name
from planner_ft.benchmark.metrics.failures import FAILURES, PUBLISHED
from planner_ft.benchmark.paired import MARKS, difference_cell, verdict
from planner_ft.benchmark.results import Results, Row
from planner_ft.benchmark.statistics import Estimate
from planner_ft.support import tables as written
from planner_ft.support.resources import memory_size
from planner_ft.support.tables import NOTHING, Cell, Table, row

SHOWN_PAIRS, SHOWN_IDS, SHOWN_OTHERS = 15, 3, 10
COUNTED = (
    ("substitutions", ("expected", "predicted"), ("Expected", "predicted"), "(nothing)"),
    ("stops", ("condition", "title"), ("Stops for want of", "at"), "(no plan)"),
)
"""Parts of a breakdown that count pairs: their keys, their headings, and the word for nothing."""
Figures = Mapping[str, Any]


def render_tables(results: Results) -> dict[str, str]:
    """The texts of table.md, table.csv and table.tex."""
    shown, below = layout.lines(results), layout.notes(results)
    texts = [written.markdown_table(table) for table in tables(results)]
    commented = "".join(f"% {note}\n" for note in below)
    return {
        "table.md": "\n".join([*texts, *(f"- {note}" for note in below)]) + "\n",
        "table.csv": written.csv_table(layout.figures_table(shown)),
        "table.tex": written.latex_table(layout.metric_table(MAIN, shown)) + commented,
    }


def tables(results: Results) -> list[Table]:
    """Every table of table.md: the published metrics first."""
    shown = layout.lines(results)
    ours = [line for line in shown if line.kind != "published"]
    first = [layout.metric_table(MAIN, shown), layout.metric_table(RIGHT, ours), _failures(results)]
    return [*first, *detail_tables(results)]


def detail_tables(results: Results) -> Iterator[Table]:
    """The tables behind the first ones."""
    ours = layout.lines(results, beside=False)
    for title, names in SECTIONS.items():
        table = layout.metric_table(names, ours, corner=title)
        if len(table.columns) > 2:
            yield table
    for of_candidate in layout.by_candidate(results.rows):
        yield from names_tables(of_candidate)
        yield from counted_tables(of_candidate)
        yield from examples_tables(of_candidate)
    yield from confidence_tables(ours)
    yield from cost_tables({one.name: one.costs for one in results.rows if one.costs})
    yield from difference_tables(results.contrasts)
    yield from repeat_tables({one.name: one.repeats for one in results.rows if one.repeats})
    yield from change_tables(results.changes)
    yield from group_tables(results.groups)


def _cells(record: Figures, columns: Columns) -> list[Cell]:
    """The figures of a record, with their intervals where they have any."""
    cells = []
    for _heading, place, scale, decimals in columns:
        found: Any = record
        for key in place.split("."):
            found = (found or {}).get(key)
        figure = Estimate(**found) if isinstance(found, dict) else Estimate(found)
        cells.append(figure.cell(scale=scale, decimals=decimals))
    return cells


def _heads(table: str) -> list[str]:
    return [heading for heading, *_ in COLUMNS[table]]


def _failures(results: Results) -> Table:
    rows = [
        row(one.name, str(one.n), *(str(one.failures.get(kind, 0)) for kind in FAILURES))
        for one in results.rows
    ]
    if results.level == "mission" and layout.shows_published(results):
        counts = (str(PUBLISHED.get(kind, 0)) for kind in FAILURES)
        rows.append(row("mission agent (published)", "25", *counts, kind="published"))
    return Table("Wrong answers by kind", ("n", *FAILURES), rows)


def names_tables(rows: Sequence[Row]) -> Iterator[Table]:
    """F1 of roles and names, and how often each was expected; all others are in results.json."""
    for part, key in (("per_role", "role"), ("per_name", "name")):
        figures = [{line[key]: line for line in one.breakdown.get(part, ())} for one in rows]
        support = {
            name: line["expected"] for of_row in reversed(figures) for name, line in of_row.items()
        }
        ordered = sorted(support, key=lambda name: (-support[name], name))
        extra = [name for name in ordered if not support[name]][:SHOWN_OTHERS]
        body = []
        for name in [*(name for name in ordered if support[name]), *extra]:
            found = (of_row.get(name, {}) for of_row in figures)
            cells = [cell for line in found for cell in _cells(line, (("", "f1", 1, 2),))]
            body.append(row(name, str(support[name]), *cells))
        if body:
            yield Table(f"F1 per {key} ↑", ("expected", *(one.name for one in rows)), body)


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
            yield Table(heads[0], (heads[1], *(one.name for one in rows)), body, texts=1)


def examples_tables(rows: Sequence[Row]) -> Iterator[Table]:
    """Ids of wrong answers by kind."""
    figures = [one.breakdown.get("failure_examples", {}) for one in rows]
    body = [
        row(kind, *(", ".join(found.get(kind, [])[:SHOWN_IDS]) or NOTHING for found in figures))
        for kind in FAILURES
        if any(kind in examples for examples in figures)
    ]
    if body:
        yield Table("Examples of wrong answers", [one.name for one in rows], body, texts=len(rows))


def confidence_tables(rows: Sequence[Row]) -> Iterator[Table]:
    """Whether a system knows when it is wrong, where it says how sure it is."""
    body = []
    for one in rows:
        if found := one.breakdown.get("confidence"):
            by_chance = found["aurc_random"]
            known = {**found, "of_random": found["aurc"] / by_chance if by_chance else None}
            how = "calibrated" if found["calibrated"] else "not calibrated"
            counts = str(found["n"]), str(found["wrong"])
            body.append(row(one.name, how, *counts, *_cells(known, COLUMNS["confidence"])))
    if body:
        yield Table("How sure", ("", "n", "wrong", *_heads("confidence")), body, texts=1)


def cost_tables(known: Mapping[str, Figures]) -> Iterator[Table]:
    """A line per system, and planning time by number of tasks."""
    body = []
    planning: dict[tuple[str, str], Cell] = {}
    for name, costs in known.items():
        memory = costs.get("peak_memory_bytes")
        size = NOTHING if memory is None else memory_size(memory)
        body.append(row(name, str(costs.get("n", 0)), *_cells(costs, COLUMNS["costs"]), size))
        for entry in costs.get("planning", ()):
            text = f"{entry['seconds']['value']:.2f} (n = {entry['n']})"
            planning[name, str(entry["tasks"])] = Cell(text)
    if body:
        yield Table("Cost", ("timed queries", *_heads("costs"), "Peak memory"), body)
    if planning:
        most = max(int(tasks) for _name, tasks in planning)
        corner = "Seconds to plan a mission of m tasks, both agents; m ="
        yield _pivot(corner, planning, {str(m): str(m) for m in range(1, most + 1)})


def difference_tables(found: Contrasts) -> Iterator[Table]:
    """Differences between the configurations of a model, and of every row from the baselines."""
    if ours := found["configuration"]:
        columns = {one.metric: METRIC[one.metric].heading for one in ours}
        cells = {(f"{one.second} against {one.first}", one.metric): one.cell() for one in ours}
        yield _pivot("Difference, paired by sample", cells, columns)
    if beside := found["baseline"]:
        columns = {
            f"{metric} {first}": f"{METRIC[metric].heading} against {baseline_name(first)}"
            for metric in DECISIVE
            for first in dict.fromkeys(one.first for one in beside)
        }
        cells = {(one.second, f"{one.metric} {one.first}"): one.cell() for one in beside}
        yield _pivot("Against the baselines", cells, columns)


def _pivot(corner: str, cells: Mapping[tuple[str, str], Cell], columns: Mapping[str, str]) -> Table:
    """A table from cells by (row, column)."""
    names = dict.fromkeys(name for name, _column in cells)
    body = [row(name, *(cells.get((name, key), NOTHING) for key in columns)) for name in names]
    return Table(corner, list(columns.values()), body)


def repeat_tables(figures: Mapping[str, Figures]) -> Iterator[Table]:
    """pass^k (all of k answers are right) and pass@k (at least one is): k = 1, 2, 4 ..., last."""
    shown = {name: found for name, found in figures.items() if found.get("k", 0) > 1}
    if not shown:
        return
    last = {found["k"] for found in shown.values()}
    ks = sorted({2**power for power in range(10) if 2**power < max(last)} | last)
    columns = [(f"pass^{k}", f"all_of_k.{k}", 100, 1) for k in ks]
    columns += [(f"pass@{k}", f"any_of_k.{k}", 100, 1) for k in ks if k > 1]
    body = [
        row(f"{name}, {found['k']} answers per sample", *_cells(found, columns))
        for name, found in shown.items()
    ]
    caption = "pass^k: all of k answers are right; pass@k: at least one of k is (pass@1 is pass^1)."
    yield Table("Whole plan right (%)", [heading for heading, *_ in columns], body, caption=caption)


def change_tables(changes: Sequence[Figures]) -> Iterator[Table]:
    """Differences by enforcing, and the outcomes that changed."""
    body, moved = [], []
    for change in changes:
        name = f"{change['candidate']}, {change['before']} → {change['after']}"
        cells: list[Cell | str] = []
        for metric, p in zip(DECISIVE, change["p_adjusted"], strict=True):
            found = Estimate(**change[metric])
            cells.append(difference_cell(metric, found, MARKS[verdict(metric, found, p)]))
        ratios = (change["seconds"], change["forward_passes"])
        cells += [NOTHING if ratio is None else f"× {ratio:.2f}" for ratio in ratios]
        body.append(row(name, str(change["n"]), *cells))
        moved += [
            row(name, one["before"], one["after"], str(one["n"]))
            for one in change["outcomes"]
            if one["before"] != one["after"]
        ]
    if body:
        heads = ["n", "F1 (difference)", "Whole plan right (difference, points)"]
        heads += ["Latency (ratio)", "Forward passes (ratio)"]
        yield Table("Changes by enforcing", heads, body)
    if moved:
        columns = ("free", "enforced", "samples")
        yield Table("Outcome, sample by sample", columns, moved, texts=2)


def group_tables(figures: Sequence[Figures]) -> Iterator[Table]:
    """One line per group of the data and system."""
    body = []
    for entry in sorted(figures, key=lambda entry: str(entry["group"])):
        system = f"{entry['candidate']}, {entry['configuration']}"
        body.append(row(entry["group"], system, str(entry["n"]), *_cells(entry, COLUMNS["groups"])))
    if body:
        yield Table("Group", ("System", "n", *_heads("groups")), body, texts=1)
