"""The rows of the tables: measured, published and baselines, with the notes that belong to them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from planner_ft.benchmark import published
from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.contrasts import contrast_notes, marks, system_key
from planner_ft.benchmark.results import Results, Row, heading
from planner_ft.benchmark.statistics import Estimate
from planner_ft.support.tables import NOTHING, Cell, RowKind, Table, row


class Line(NamedTuple):
    """A row of figures: measured, published or a baseline."""

    model: str
    configuration: str
    n: int
    kind: RowKind
    metrics: Mapping[str, Estimate]
    marks: Mapping[str, str]

    def cells(self, names: Sequence[str]) -> list[Cell]:
        return [
            METRIC[name].cell(
                self.metrics.get(name, Estimate(None)),
                self.marks.get(name, ""),
                published=self.kind == "published",
            )
            for name in names
        ]


def lines(results: Results) -> list[Line]:
    """Measured rows, each candidate's followed by its published ones, then the baselines and the
    other published rows.
    """
    known = marks(results.contrasts)
    theirs = _published(results)
    found: list[Line] = []
    for of_candidate in by_candidate(results.rows):
        for one in of_candidate:
            key = system_key((one.system.candidate, one.system.configuration))
            own = {metric: mark for (system, metric), mark in known.items() if system == key}
            label, name = one.system.label, heading(one.system.configuration)
            found.append(Line(label, name, one.n, "measured", one.metrics, own))
        system = of_candidate[0].system
        found += theirs.pop(system.published or "", []) if not system.is_standin else []
    for one in results.baselines:
        found.append(Line(one.system.label, NOTHING, one.n, "baseline", one.metrics, {}))
    return [*found, *(line for of_model in theirs.values() for line in of_model)]


def shows_published(results: Results) -> bool:
    """Whether published figures stand beside: for real candidates and the vehicle that they are
    about.
    """
    vocabulary = results.manifest.get("configuration", {}).get("vocabulary", {}).get("name")
    real = any(not one.system.is_standin for one in results.rows)
    return real and vocabulary == published.VOCABULARY


def _published(results: Results) -> dict[str, list[Line]]:
    """Published rows by model, in the configurations of the run if it has any of theirs."""
    if not shows_published(results):
        return {}
    ours = {one.system.configuration for one in results.rows}
    shown = [name for name in published.CONFIGURATIONS if name in ours]
    found: dict[str, list[Line]] = {}
    for one in published.published_rows(results.level):
        for name in shown or published.CONFIGURATIONS:
            metrics = {
                metric: Estimate(value)
                for (metric, configuration), value in one.figures.items()
                if configuration == name
            }
            n, label = published.SAMPLES[results.level], f"{one.model} (published)"
            line = Line(label, heading(name), n, "published", metrics, {})
            found.setdefault(one.model, []).append(line)
    return found


def metric_table(
    name: str,
    names: Sequence[str],
    shown: Sequence[Line],
    *,
    headings: Sequence[str] = (),
    corner: str = "Model",
) -> Table:
    """A row per line with these metrics; a metric that no line has a figure for is left out."""
    known = [
        (metric, headings[index] if headings else METRIC[metric].title)
        for index, metric in enumerate(names)
        if headings or any(has_figure(line, metric) for line in shown)
    ]
    metrics = [metric for metric, _title in known]
    rows = tuple(
        row(line.model, line.configuration, str(line.n), *line.cells(metrics), kind=line.kind)
        for line in shown
    )
    columns = ("configuration" if headings else "Configuration", "n", *(text for _m, text in known))
    return Table(name, "", "", "model" if headings else corner, columns, rows, texts=1)


def has_figure(line: Line, metric: str) -> bool:
    return line.metrics.get(metric, Estimate(None)).value is not None


def notes(results: Results) -> list[str]:
    """What a reader must know to read the tables rightly."""
    rows = results.rows
    counted = "as hallucinated" if results.level == "mission" else "as not hallucinated"
    found = [
        f"{results.level} level, n = {results.data['n']} samples of {results.data['path']}. In"
        " brackets: 95 % intervals (rates: Wilson, n being the effective number of samples where"
        " phrasings of one family agree; means: bootstrap, whole families resampled).",
        f"Hallucination counts an output that does not parse {counted}, as the published table of"
        " this level does; table.md has both readings.",
    ]
    if timed := max((one.latency_n for one in rows), default=0):
        found.append(
            f"Latency: one query at a time after warm-up, mean over {timed} samples on the machine"
            " in results.json."
        )
    if shows_published(results):
        source = published.source(results.level)
        found.append(f"(published): figures of the {source}; not measured here.")
    if any(one.system.configuration.endswith("+grounded") for one in rows):
        found.append(
            "+grounded decodes with the reader that groundedness is scored with: its share of"
            " values that somebody gave is 100 % by construction."
        )
    found += contrast_notes(results.contrasts, results.baseline_notes)
    for system in {one.system.candidate: one.system for one in rows}.values():
        if system.pretrained:
            found.append(
                f"{system.label} was pretrained on synthetic plans of this vocabulary: its Base"
                " figures are not those of a general model."
            )
        if system.is_standin:
            found.append(
                f"{system.label} is a tiny, randomly initialised model: its figures say nothing"
                " about the real candidate."
            )
    for one in rows:
        cut, failed = (one.finish_reasons.get(reason) for reason in ("length", "error"))
        if one.missing:
            found.append(
                f"{one.name}: {len(one.missing)} of {one.n} samples have no prediction and count as"
                " empty outputs."
            )
        if cut:
            found.append(f"{one.name}: {cut} of {one.n} outputs were cut at the token limit.")
        if failed:
            found.append(
                f"{one.name}: {failed} of {one.n} samples failed and count as empty outputs (see"
                " predictions.jsonl)."
            )
    return found


def by_candidate(rows: Iterable[Row]) -> list[list[Row]]:
    found: dict[str, list[Row]] = {}
    for one in rows:
        found.setdefault(one.system.candidate, []).append(one)
    return list(found.values())
