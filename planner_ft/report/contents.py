"""What a report holds, test set by test set, before it is drawn."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields

from planner_ft.benchmark.layout import notes as table_notes
from planner_ft.benchmark.results import Results, Row, heading
from planner_ft.benchmark.results import System as RowSystem
from planner_ft.report.charts import Chart
from planner_ft.report.figures import charts, system_charts
from planner_ft.report.metrics import cost_table, estimate, group_table, main_table, metric_tables
from planner_ft.report.runs import Record, System, TestSet
from planner_ft.report.significance import Significance, significance
from planner_ft.support.tables import Table


@dataclass(frozen=True)
class Sentence:
    """A sentence of the summary under the name of its subject."""

    lead: str
    text: str


@dataclass(frozen=True)
class Section:
    """Everything about one test set. `per_system` are charts of one system each."""

    tests: TestSet
    summary: tuple[Sentence, ...]
    main: Table
    legend: str
    extra: tuple[Table, ...]
    differences: Table | None
    all_metrics: tuple[Table, ...]
    charts: tuple[Chart, ...]
    per_system: tuple[tuple[str, tuple[Chart, ...]], ...]
    notes: tuple[str, ...]

    @property
    def tables(self) -> tuple[Table, ...]:
        """Every table, in the order of the page."""
        differences = [self.differences] if self.differences else []
        return (self.main, *self.extra, *differences, *self.all_metrics)

    @property
    def figures(self) -> tuple[Chart, ...]:
        """Every chart, in the order of the page."""
        return (*self.charts, *(chart for _name, charts in self.per_system for chart in charts))


def section(tests: TestSet) -> Section:
    """The content of a test set's section."""
    found = significance(tests)
    of_systems = [(one.name, tuple(system_charts(tests, one))) for one in tests.candidates]
    notes = [note for results in tests.results for note in table_notes(as_results(results))]
    return Section(
        tests,
        summary=tuple(_summary(tests, found)),
        main=main_table(tests, found.marks),
        legend=found.legend,
        extra=tuple(table for table in (cost_table(tests), group_table(tests)) if table),
        differences=found.table,
        all_metrics=tuple(metric_tables(tests)),
        charts=tuple(charts(tests)),
        per_system=tuple((name, of_system) for name, of_system in of_systems if of_system),
        notes=tuple(dict.fromkeys([*notes, *tests.notes])),
    )


def _summary(tests: TestSet, found: Significance) -> Iterator[Sentence]:
    for system in tests.candidates:
        text = f"{_in_words(tests, system)} {found.sentences.get(system.name, '')}"
        yield Sentence(f"{system.name}.", text.strip())
    for entry in (entry for results in tests.results for entry in results.get("failed") or []):
        lead = f"{entry.get('label')}, {heading(str(entry.get('configuration')))}."
        yield Sentence(lead, f"Not measured: {entry.get('reason')}.")


def _in_words(tests: TestSet, system: System) -> str:
    """How many plans are right, and why the others are not."""
    whole, n = estimate(system, "whole_plan"), int(system.row.get("n", tests.n))
    if whole.value is None:
        return f"{n} answers."
    span = ""
    if whole.low is not None and whole.high is not None:
        span = f", 95 % interval {100 * whole.low:.0f} to {100 * whole.high:.0f} %"
    n *= max((len(lines) for lines in system.repeats.values()), default=1)
    right = f"{round(whole.value * n)} of {n} plans are right in every name, order and value"
    text = f"{right} ({100 * whole.value:.0f} %{span})."
    kinds = failure_words(system)
    return f"{text} Wrong: {kinds}." if kinds else text


def failure_words(system: System) -> str:
    """Wrong answers by kind, the most frequent first: "wrong order 3, parameter propagation 1"."""
    found = system.row.get("failures", {}).items()
    order = sorted((-count, kind) for kind, count in found if count)
    return ", ".join(f"{kind} {-count}" for count, kind in order)


def as_results(record: Record) -> Results:
    """results.json as an object, as far as the notes of tables need it."""
    rows = tuple(_row(row) for row in record["rows"])
    return Results(record["level"], record["data"], rows, record.get("manifest", {}))


def _row(record: Record) -> Row:
    known = {field.name for field in fields(RowSystem)}
    named = {name: value for name, value in record.items() if name in known}
    system = RowSystem(**{"label": str(record.get("candidate")), **named})
    failures, reasons = record.get("failures", {}), record.get("finish_reasons", {})
    missing, timed = tuple(record.get("missing", ())), record.get("latency_n", 0)
    return Row(system, record.get("n", 0), {}, failures, reasons, missing, timed)


def provenance(sets: Sequence[TestSet]) -> list[tuple[str, str]]:
    """What the runs depended on, in words."""
    entries: list[tuple[str, str]] = []
    for tests in sets:
        entries.append((tests.title, f"{tests.path}, SHA-256 {tests.sha256}"))
        for results in tests.results:
            entries += _of_run(results.get("manifest", {}))
    return list(dict.fromkeys(entries))


def _of_run(manifest: Record) -> list[tuple[str, str]]:
    def listed(key: str) -> str:
        return ", ".join(f"{name} {value}" for name, value in manifest.get(key, {}).items())

    commit = str(manifest.get("commit") or "unknown")
    commit += " with local changes" if manifest.get("dirty") else ""
    keys = (("Command", "command"), ("Made", "created"), ("Seed", "seed"))
    entries = [(name, str(manifest.get(key, ""))) for name, key in keys]
    entries.append(("planner_ft", f"{manifest.get('planner_ft', '')}, commit {commit}"))
    entries += [("Versions", listed("versions")), ("Hardware", listed("hardware"))]
    for name, job in manifest.get("jobs", {}).items():
        if isinstance(job, dict) and job.get("adapter"):
            entries.append((f"Adapter of {name}", f"SHA-256 {job['adapter']}"))
    return [(name, value) for name, value in entries if value]
