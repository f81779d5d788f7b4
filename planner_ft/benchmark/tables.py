"""The tables of a run: table.md, table.csv and table.tex.

Figures stand in the long form, a row per candidate and configuration. Tables with a column per
system (figures per name, substitutions ...) are written for each candidate.
"""

import itertools
from collections import Counter
from collections.abc import Hashable, Mapping, Sequence
from typing import Any, TypeVar

from planner_ft.benchmark import layout
from planner_ft.benchmark.catalogue import COLUMNS, MAIN, METRIC, RIGHT, SECTIONS, Columns
from planner_ft.benchmark.contrasts import DECISIVE, Contrasts, baseline_name
from planner_ft.benchmark.metrics.answers import FAILURES, PUBLISHED
from planner_ft.benchmark.paired import MARKS, difference_cell, verdict
from planner_ft.benchmark.results import Results, Row
from planner_ft.benchmark.statistics import Estimate
from planner_ft.support import tables as written
from planner_ft.support.resources import memory_size
from planner_ft.support.tables import NOTHING, Cell, Table, row

SHOWN_PAIRS, SHOWN_IDS, SHOWN_OTHERS = 15, 3, 10
LONGEST_NAME = 80
"""Characters of a name that a model wrote."""
F1 = (("", "f1", 1, 2),)
COUNTED = {
    "substitutions": (("expected", "predicted"), ("Expected", "predicted"), "(nothing)"),
    "stops": (("condition", "title"), ("Stops for want of", "at"), "(no plan)"),
}
"""Parts of a breakdown that count pairs: their keys, their headings, and the word for nothing."""
Key = TypeVar("Key", bound=Hashable)
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


def detail_tables(results: Results) -> list[Table]:
    """The tables behind the first ones, those that the results have figures for."""
    ours = layout.lines(results, beside=False)
    metrics = (layout.metric_table(names, ours, corner=title) for title, names in SECTIONS.items())
    found = [table for table in metrics if len(table.columns) > 2]
    for of_candidate in layout.by_candidate(results.rows):
        found += [_names(of_candidate, by) for by in ("role", "name")]
        found += [_counted(of_candidate, part) for part in COUNTED]
        found.append(_examples(of_candidate))
    found.append(_confidence(ours))
    found += cost_tables({one.name: one.costs for one in results.rows if one.costs})
    found += _differences(results.contrasts)
    found += repeat_tables({one.name: one.repeats for one in results.rows if one.repeats})
    found += [*change_tables(results.changes), *group_tables(results.groups)]
    return _filled(*found)


def _filled(*found: Table) -> list[Table]:
    return [table for table in found if table.rows]


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


def _names(rows: Sequence[Row], by: str) -> Table:
    """F1 of roles or names, and how often each was expected; all others are in results.json."""
    figures = [{line[by]: line for line in one.breakdown.get(f"per_{by}", ())} for one in rows]
    every = (line for of_row in reversed(figures) for line in of_row.values())
    support = {line[by]: line["expected"] for line in every}
    ordered = sorted(support, key=lambda name: (-support[name], name))
    extra = [name for name in ordered if not support[name]][:SHOWN_OTHERS]
    body = []
    for name in [*(name for name in ordered if support[name]), *extra]:
        cells = (_cells(of_row.get(name, {}), F1) for of_row in figures)
        body.append(row(_name(name), str(support[name]), *itertools.chain(*cells)))
    return Table(f"F1 per {by} ↑", ("expected", *(one.name for one in rows)), body)


def _name(text: str) -> str:
    return text if len(text) <= LONGEST_NAME else f"{text[:LONGEST_NAME]}…"


def _counted(rows: Sequence[Row], part: str) -> Table:
    """The most frequent substitutions, or conditions that stop mission plans."""
    keys, heads, nothing = COUNTED[part]
    counts = [
        Counter({tuple(_name(line[key] or "") for key in keys): line["n"] for line in found})
        for found in (one.breakdown.get(part, ()) for one in rows)
    ]
    total: Counter[tuple[str, ...]] = sum(counts, Counter())
    frequent = sorted(total, key=lambda pair: (-total[pair], pair))[:SHOWN_PAIRS]
    body = [
        row(one or nothing, other or nothing, *(str(found[one, other]) for found in counts))
        for one, other in frequent
    ]
    return Table(heads[0], (heads[1], *(one.name for one in rows)), body, texts=1)


def _examples(rows: Sequence[Row]) -> Table:
    """Ids of wrong answers by kind."""
    figures = [one.breakdown.get("failure_examples", {}) for one in rows]
    body = [
        row(kind, *(", ".join(found.get(kind, [])[:SHOWN_IDS]) or NOTHING for found in figures))
        for kind in FAILURES
        if any(kind in examples for examples in figures)
    ]
    return Table("Examples of wrong answers", [one.name for one in rows], body, texts=len(rows))


def _confidence(rows: Sequence[Row]) -> Table:
    """Whether a system knows when it is wrong, where it says how sure it is."""
    body = []
    for name, found in ((one.name, one.breakdown.get("confidence")) for one in rows):
        if found:
            by_chance = found["aurc_random"]
            known = {**found, "of_random": found["aurc"] / by_chance if by_chance else None}
            how = "calibrated" if found["calibrated"] else "not calibrated"
            cells = _cells(known, COLUMNS["confidence"])
            body.append(row(name, how, str(found["n"]), str(found["wrong"]), *cells))
    return Table("How sure", ("", "n", "wrong", *_heads("confidence")), body, texts=1)


def cost_tables(known: Mapping[str, Figures]) -> list[Table]:
    """A line per system, and planning time by number of tasks."""
    body, planning = [], dict[tuple[str, int], Cell]()
    for name, costs in known.items():
        memory = costs.get("peak_memory_bytes")
        size = NOTHING if memory is None else memory_size(memory)
        body.append(row(name, str(costs.get("n", 0)), *_cells(costs, COLUMNS["costs"]), size))
        for entry in costs.get("planning", ()):
            text = f"{entry['seconds']['value']:.2f} (n = {entry['n']})"
            planning[name, entry["tasks"]] = Cell(text)
    most = max((tasks for _name, tasks in planning), default=0)
    corner = "Seconds to plan a mission of m tasks, both agents; m ="
    whole = Table("Cost", ("timed queries", *_heads("costs"), "Peak memory"), body)
    numbers = {tasks: str(tasks) for tasks in range(1, most + 1)}
    return _filled(whole, _pivot(corner, planning, numbers))


def _differences(found: Contrasts) -> list[Table]:
    """Differences between the configurations of a model, and of every row from the baselines."""
    ours, beside = found["configuration"], found["baseline"]
    metrics = {one.metric: METRIC[one.metric].heading for one in ours}
    cells = {(f"{one.second} against {one.first}", one.metric): one.cell() for one in ours}
    theirs = {
        (metric, first): f"{METRIC[metric].heading} against {baseline_name(first)}"
        for metric in DECISIVE
        for first in dict.fromkeys(one.first for one in beside)
    }
    against = {(one.second, (one.metric, one.first)): one.cell() for one in beside}
    return [
        _pivot("Difference, paired by sample", cells, metrics),
        _pivot("Against the baselines", against, theirs),
    ]


def _pivot(corner: str, cells: Mapping[tuple[str, Key], Cell], columns: Mapping[Key, str]) -> Table:
    """A table from cells by (row, column)."""
    names = dict.fromkeys(name for name, _column in cells)
    body = [row(name, *(cells.get((name, key), NOTHING) for key in columns)) for name in names]
    return Table(corner, list(columns.values()), body)


def repeat_tables(figures: Mapping[str, Figures]) -> list[Table]:
    """pass^k (all of k answers are right) and pass@k (at least one is): k = 1, 2, 4 ..., last."""
    shown = {name: found for name, found in figures.items() if found.get("k", 0) > 1}
    last = {found["k"] for found in shown.values()}
    ks = sorted({2**power for power in range(10) if 2**power < max(last, default=0)} | last)
    columns = [(f"pass^{k}", f"all_of_k.{k}", 100, 1) for k in ks]
    columns += [(f"pass@{k}", f"any_of_k.{k}", 100, 1) for k in ks if k > 1]
    body = [
        row(f"{name}, {found['k']} answers per sample", *_cells(found, columns))
        for name, found in shown.items()
    ]
    heads = [heading for heading, *_ in columns]
    caption = "pass^k: all of k answers are right; pass@k: at least one of k is (pass@1 is pass^1)."
    return _filled(Table("Whole plan right (%)", heads, body, caption=caption))


def change_tables(changes: Sequence[Figures]) -> list[Table]:
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
    heads = ["n", "F1 (difference)", "Whole plan right (difference, points)"]
    heads += ["Latency (ratio)", "Forward passes (ratio)"]
    outcomes = Table("Outcome, sample by sample", ("free", "enforced", "samples"), moved, texts=2)
    return _filled(Table("Changes by enforcing", heads, body), outcomes)


def group_tables(figures: Sequence[Figures]) -> list[Table]:
    """One line per group of the data and system."""
    body = []
    for entry in sorted(figures, key=lambda entry: str(entry["group"])):
        system = f"{entry['candidate']}, {entry['configuration']}"
        body.append(row(entry["group"], system, str(entry["n"]), *_cells(entry, COLUMNS["groups"])))
    return _filled(Table("Group", ("System", "n", *_heads("groups")), body, texts=1))
