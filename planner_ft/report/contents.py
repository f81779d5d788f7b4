"""What a report holds, test set by test set, before it is drawn."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from planner_ft.benchmark.catalogue import METRIC, METRICS, RIGHT, SECTIONS
from planner_ft.benchmark.contrasts import baseline_sentences, contrast_notes, legend
from planner_ft.benchmark.layout import lines, metric_table
from planner_ft.benchmark.layout import notes as table_notes
from planner_ft.benchmark.paired import p_text
from planner_ft.benchmark.results import Results, Row, heading
from planner_ft.benchmark.tables import cost_tables, detail_tables, group_tables
from planner_ft.report.charts import charts, slug, system_charts
from planner_ft.report.runs import TestSet
from planner_ft.support.tables import Cell, Table, row

MAIN: tuple[str, ...] = ("f1", "whole_plan", "exact_sequence", "parameters", "hallucination")
MAIN += ("schema_valid", "strict_valid", "latency_s", "tokens")
"""The first table: the published five, and the metrics that show whether a plan is right."""


def section(tests: TestSet) -> dict[str, Any]:
    """The content of a test set's section: `summary` are sentences under the names of their
    subjects, `extra` the tables that stand open, `per_system` charts of one system each; `tables`
    and `figures` are all of them in the order of the page.
    """
    results, shown = tests.results, lines(tests.results, beside=tests.beside)
    ours = [line for line in shown if line.kind != "published"]
    of_systems = [(one.name, system_charts(tests, one)) for one in results.rows]
    taken = Counter[str]()

    def named(table: Table, name: str = "", title: str = "", caption: str = "") -> Table:
        name = f"{tests.key}-{name or slug(table.corner)[:40]}"
        taken[name] += 1
        name += f"-{taken[name]}" if taken[name] > 1 else ""
        words = title or table.corner, caption or table.caption
        return replace(table, name=name, title=words[0], caption=words[1])

    costs = {one.name: one.costs for one in results.rows if one.costs}
    brackets = "In brackets 95 % intervals."
    known = {name for names in SECTIONS.values() for name in names} | set(RIGHT)
    rest = [("Whole plan", RIGHT), ("Output", [name for name in METRICS if name not in known])]
    extra = [named(one, caption=brackets) for one in cost_tables(costs)]
    small = "Groups are small: they tell where to look, not which system is better."
    extra += [named(one, "groups", "By group", small) for one in group_tables(results.groups)]
    details = [metric_table(names, ours, corner=title) for title, names in rest]
    shown_before = {table.corner for table in extra}
    details += [one for one in detail_tables(results) if one.corner not in shown_before]
    said = set(contrast_notes(results.contrasts))
    notes = [note for note in table_notes(results) if note not in said]
    main = named(metric_table(MAIN, shown), "main", "Systems", brackets)
    compared = [named(one, "differences", "Differences") for one in _differences(results)]
    all_metrics, overall = list(map(named, details)), charts(tests)
    return {
        "tests": tests,
        "summary": list(_summary(tests)),
        "main": main,
        "legend": " ".join(legend(results.contrasts)),
        "extra": extra,
        "differences": compared,
        "all_metrics": all_metrics,
        "tables": [main, *extra, *compared, *all_metrics],
        "charts": overall,
        "per_system": [(name, found) for name, found in of_systems if found],
        "figures": [*overall, *(chart for _name, found in of_systems for chart in found)],
        "notes": list(dict.fromkeys([*notes, *tests.notes])),
    }


def _summary(tests: TestSet) -> Iterator[tuple[str, str]]:
    beaten = baseline_sentences(tests.results.contrasts)
    for system in tests.results.rows:
        compared = f"It {beaten[system.key]}" if system.key in beaten else ""
        yield f"{system.name}.", f"{_in_words(system)} {compared}".strip()
    for entry in (entry for run in tests.runs for entry in run.record.get("failed") or []):
        lead = f"{entry.get('label')}, {heading(str(entry.get('configuration')))}."
        yield lead, f"Not measured: {entry.get('reason')}."


def _in_words(system: Row) -> str:
    """How many plans are right, and why the others are not."""
    whole, n = system.figure("whole_plan"), system.n
    if whole.value is None:
        return f"{n} answers."
    span = ""
    if whole.low is not None and whole.high is not None:
        span = f", 95 % interval {100 * whole.low:.0f} to {100 * whole.high:.0f} %"
    n *= (system.repeats or {}).get("k", 1)
    right = f"{round(whole.value * n)} of {n} plans are right in every name, order and value"
    kinds = failure_words(system)
    wrong = f" Wrong: {kinds}." if kinds else ""
    return f"{right} ({100 * whole.value:.0f} %{span}).{wrong}"


def failure_words(system: Row) -> str:
    """Wrong answers by kind, the most frequent first: "wrong order 3, parameter propagation 1"."""
    order = sorted((-count, kind) for kind, count in system.failures.items() if count)
    return ", ".join(f"{kind} {-count}" for count, kind in order)


def _differences(results: Results) -> list[Table]:
    rows, names = [], {one.key: one.name for one in (*results.rows, *results.baselines)}
    for one in (one for found in results.contrasts.values() for one in found):
        ends = [names.get(key) for key in (one.second, one.first)]
        if one.difference.value is not None and all(ends):
            made, p = one.cell(), one.p_adjusted
            cells = replace(made, mark=""), Cell(p_text(p), bounds=(p, None, None))
            metric, verdict = METRIC[one.metric].heading, f"{one.mark} {one.verdict}"
            rows.append(row(" against ".join(map(str, ends)), metric, *cells, verdict.strip()))
    caption = "First minus second, paired by sample, with its 95 % interval; p adjusted after Holm"
    heads = ("Metric", "Difference", "p", "Verdict")
    table = Table("Systems", heads, rows, texts=1, caption=f"{caption} for each question.")
    return [table] if rows else []
