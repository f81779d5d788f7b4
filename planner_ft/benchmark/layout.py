"""The rows of the tables: measured, published and baselines, with the notes that belong to them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from planner_ft.benchmark import published
from planner_ft.benchmark.catalogue import METRIC, METRICS
from planner_ft.benchmark.contrasts import contrast_notes, marks
from planner_ft.benchmark.results import Results, Row
from planner_ft.support.tables import Table, row


def lines(results: Results, *, beside: bool = True) -> list[Row]:
    """Measured rows with their marks, each candidate's followed by its published ones, then the
    baselines and the other published rows; `beside` says whether there shall be published ones.
    """
    known = marks(results.contrasts)
    theirs = _published(results) if beside else {}
    found: list[Row] = []
    for of_candidate in by_candidate(results.rows):
        for one in of_candidate:
            own = {metric: mark for (key, metric), mark in known.items() if key == one.key}
            found.append(replace(one, marks=own))
        system = of_candidate[0].system
        found += theirs.pop(system.published or "", []) if not system.is_standin else []
    found += results.baselines
    return [*found, *(row for of_model in theirs.values() for row in of_model)]


def shows_published(results: Results) -> bool:
    """Whether published figures stand beside: for real candidates and the vehicle that they are
    about.
    """
    vocabulary = results.manifest.get("configuration", {}).get("vocabulary", {}).get("name")
    real = any(not one.system.is_standin for one in results.rows)
    return real and vocabulary == published.VOCABULARY


def _published(results: Results) -> dict[str, list[Row]]:
    """Published rows by model, in the configurations of the run if it has any of theirs."""
    if not shows_published(results):
        return {}
    every = by_candidate(published.published_rows(results.level))
    ours = {one.system.configuration for one in results.rows}
    shown = ours & {*published.CONFIGURATIONS} or {*published.CONFIGURATIONS}
    return {
        rows[0].system.candidate: [one for one in rows if one.system.configuration in shown]
        for rows in every
    }


def known_metrics(names: Iterable[str], shown: Sequence[Row]) -> list[str]:
    """Those of the metrics that any line has a figure for."""
    return [name for name in names if any(one.figure(name).value is not None for one in shown)]


def metric_table(names: Iterable[str], shown: Sequence[Row], corner: str = "Model") -> Table:
    """A row per line with these metrics; a metric that no line has a figure for is left out."""
    known = known_metrics(names, shown)
    return _figures(shown, known, corner, ("Configuration", *(METRIC[one].title for one in known)))


def figures_table(shown: Sequence[Row]) -> Table:
    """Every metric under its name in results.json, as table.csv has them."""
    return _figures(shown, METRICS, "model", ("configuration", *METRICS))


def _figures(
    shown: Sequence[Row], metrics: Sequence[str], corner: str, heads: Sequence[str]
) -> Table:
    rows = tuple(
        row(one.system.label, one.configuration, str(one.n), *one.cells(metrics), kind=one.kind)
        for one in shown
    )
    return Table(corner, "", "", corner, (heads[0], "n", *heads[1:]), rows, texts=1)


def notes(results: Results) -> list[str]:
    """What a reader must know to read the tables rightly."""
    return list(dict.fromkeys([*_about_data(results), *_about_rows(results.rows)]))


def _about_data(results: Results) -> Iterator[str]:
    rows = results.rows
    yield (
        f"{results.level} level, n = {results.data['n']} samples of {results.data['path']}. In"
        " brackets: 95 % intervals (rates: Wilson, n being the effective number of samples where"
        " phrasings of one family agree; means: bootstrap, whole families resampled)."
    )
    counted = "as hallucinated" if results.level == "mission" else "as not hallucinated"
    yield (
        f"Hallucination counts an output that does not parse {counted}, as the published table of"
        " this level does; table.md has both readings."
    )
    if timed := max((one.latency_n for one in rows), default=0):
        how = f"one query at a time after warm-up, mean over {timed} samples"
        yield f"Latency: {how} on the machine in results.json."
    if shows_published(results):
        yield f"(published): figures of the {published.source(results.level)}; not measured here."
    if any(one.system.configuration.endswith("+grounded") for one in rows):
        yield (
            "+grounded decodes with the reader that groundedness is scored with: its share of"
            " values that somebody gave is 100 % by construction."
        )
    yield from contrast_notes(results.contrasts, results.baseline_notes)


def _about_rows(rows: Sequence[Row]) -> Iterator[str]:
    for system in {one.system.candidate: one.system for one in rows}.values():
        if system.pretrained:
            what = "pretrained on synthetic plans of this vocabulary"
            general = "its Base figures are not those of a general model"
            yield f"{system.label} was {what}: {general}."
        if system.is_standin:
            why = "its figures say nothing about the real candidate"
            yield f"{system.label} is a tiny, randomly initialised model: {why}."
    for one in rows:
        empty = "count as empty outputs"
        if one.system.seen:
            yield trained_on(one)
        if one.missing:
            missing = f"{len(one.missing)} of {one.n} samples have no prediction"
            yield f"{one.name}: {missing} and {empty}."
        if cut := one.finish_reasons.get("length"):
            yield f"{one.name}: {cut} of {one.n} outputs were cut at the token limit."
        if failed := one.finish_reasons.get("error"):
            where = f"{empty} (see predictions.jsonl)"
            yield f"{one.name}: {failed} of {one.n} samples failed and {where}."


def trained_on(one: Row) -> str:
    """That an adapter was trained on samples that it is measured on."""
    seen = f"{one.system.seen} of {one.n} samples were in its adapter's training or validation data"
    return f"{one.name}: {seen}; its figures say nothing about other commands."


def by_candidate(rows: Iterable[Row]) -> list[list[Row]]:
    """Rows by candidate, in their order."""
    found: dict[str, list[Row]] = {}
    for one in rows:
        found.setdefault(one.system.candidate, []).append(one)
    return list(found.values())
