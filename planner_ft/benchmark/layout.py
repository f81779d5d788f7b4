"""What stands in the tables: columns, rows measured and published, and notes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from planner_ft.benchmark import published
from planner_ft.benchmark.contrasts import system_key
from planner_ft.benchmark.contrasts_text import contrast_notes, marks
from planner_ft.benchmark.results import Results, Row
from planner_ft.benchmark.statistics import Estimate
from planner_ft.vocabulary.plans import Level

NOTHING = "–"


@dataclass(frozen=True)
class Column:
    """How a metric is shown. `scale` is 100 for rates in percent."""

    metric: str
    heading: str
    better: str
    scale: int = 1
    decimals: int = 2
    published_decimals: int = 2

    def text(self, value: float | None, *, source: str = "measured") -> str:
        """A figure in the unit of the column; published ones with the decimals that they have."""
        decimals = self.published_decimals if source == "published" else self.decimals
        return NOTHING if value is None else f"{value * self.scale:.{decimals}f}"

    def interval(self, estimate: Estimate) -> str:
        """The interval in brackets, or nothing where there is none."""
        return (
            ""
            if estimate.low is None or estimate.high is None
            else f"[{self.text(estimate.low)}, {self.text(estimate.high)}]"
        )


COLUMNS = (
    Column("f1", "F1", "↑"),
    Column("hallucination", "Hallucination (%)", "↓", 100, 1, 1),
    Column("schema_valid", "Schema valid (%)", "↑", 100, 1, 1),
    Column("strict_valid", "Strictly valid (%)", "↑", 100, 1, 1),
    Column("latency_s", "Latency (s)", "↓", 1, 2, 1),
    Column("tokens", "Tokens", "", 1, 1, 1),
)
"""The published columns, and strict validity."""
MORE_COLUMNS = (
    Column("exact_sequence", "Exact sequence (%)", "↑", 100, 1, 1),
    Column("parameters", "Parameters right (%)", "↑", 100, 1, 1),
    Column("whole_plan", "Whole plan right (%)", "↑", 100, 1, 1),
    Column("forward_passes", "Forward passes", "↓", 1, 1, 1),
    Column("parsed", "Parses (%)", "↑", 100, 1, 1),
    Column("hallucination_with_unparsed", "Hallucination, unparsed counted (%)", "↓", 100, 1, 1),
    Column(
        "hallucination_without_unparsed", "Hallucination, unparsed not counted (%)", "↓", 100, 1, 1
    ),
)
"""What the published tables leave out."""


@dataclass(frozen=True)
class TableRow:
    """One model: measured, published or a baseline, with its figures by (metric, configuration),
    and marks of real differences (see `contrasts_text`).
    """

    model: str
    source: str
    n: int
    cells: dict[tuple[str, str], Estimate]
    marks: dict[tuple[str, str], str] = field(default_factory=dict)


def measured_configurations(results: Results) -> list[str]:
    """The configurations of a run, in its order."""
    return list(dict.fromkeys(row.system.configuration for row in results.rows))


def configurations(results: Results) -> list[str]:
    """The columns of the table: a run's configurations, after the published ones where it has none
    of those.
    """
    ours = measured_configurations(results)
    alien = not set(ours) & set(published.CONFIGURATIONS)
    return [*published.CONFIGURATIONS, *ours] if alien and shows_published(results) else ours


def heading(configuration: str) -> str:
    """A configuration as the published tables write it."""
    return {"base": "Base", "lora": "LoRA"}.get(configuration, configuration)


def measured_rows(results: Results) -> list[TableRow]:
    """A row per candidate with all its configurations."""
    rows: dict[str, TableRow] = {}
    known = marks(results)
    for row in results.rows:
        entry = rows.setdefault(
            row.system.candidate, TableRow(row.system.label, "measured", row.n, {})
        )
        entry.cells.update(
            {
                (metric, row.system.configuration): estimate
                for metric, estimate in row.metrics.items()
            }
        )
        name = system_key((row.system.candidate, row.system.configuration))
        entry.marks.update(
            {
                (metric, row.system.configuration): known[name, metric]
                for metric in row.metrics
                if (name, metric) in known
            }
        )
    return list(rows.values())


def baseline_rows(results: Results) -> list[TableRow]:
    """What needs no model; it knows neither base nor LoRA, so its figure stands in every column
    that was measured.
    """
    names = measured_configurations(results)
    return [
        TableRow(
            row.system.label,
            "baseline",
            row.n,
            {
                (metric, name): estimate
                for metric, estimate in row.metrics.items()
                for name in names
            },
        )
        for row in results.baselines
    ]


def shows_published(results: Results) -> bool:
    """Published figures stand only beside real candidates and for the vehicle that they are
    about.
    """
    vocabulary = results.manifest.get("configuration", {}).get("vocabulary", {}).get("name")
    return vocabulary == published.VOCABULARY and any(
        not row.system.is_standin for row in results.rows
    )


def table_rows(results: Results) -> list[TableRow]:
    """Measured rows, each followed by its published one, then the baselines and the other published
    rows.
    """
    measured = measured_rows(results)
    if not shows_published(results):
        return [*measured, *baseline_rows(results)]
    theirs = {
        row.model: _published_row(row, results.level)
        for row in published.published_rows(results.level)
    }
    names = {
        row.system.candidate: row.system.published
        for row in results.rows
        if not row.system.is_standin
    }
    ordered: list[TableRow] = []
    for candidate, row in zip(
        dict.fromkeys(row.system.candidate for row in results.rows), measured, strict=True
    ):
        ordered.append(row)
        ordered += [theirs.pop(name) for name in [names.get(candidate)] if name in theirs]
    return [*ordered, *baseline_rows(results), *theirs.values()]


def notes(results: Results) -> list[str]:
    """What a reader must know to read the table rightly."""
    rows = results.rows
    counted = "as hallucinated" if results.level == "mission" else "as not hallucinated"
    lines = [
        (
            f"{results.level} level, n = {results.data['n']} samples of {results.data['path']}. In"
            " brackets: 95 % intervals (rates: Wilson, n being the effective number of samples"
            " where phrasings of one family agree; means: bootstrap, whole families resampled)."
        ),
        (
            f"Hallucination counts an output that does not parse {counted}, as the published table"
            " of this level does; both readings are in the second table of table.md."
        ),
    ]
    if any(row.latency_n for row in rows):
        lines.append(
            "Latency: one query at a time after warm-up, mean over"
            f" {max(row.latency_n for row in rows)} samples on the machine in results.json."
        )
    if shows_published(results):
        lines.append(
            f"(published): figures of the {published.source(results.level)}; not measured here."
        )
    lines += contrast_notes(results)
    for row in _first(rows):
        if row.system.pretrained:
            lines.append(
                f"{row.system.label} was pretrained on synthetic plans of this vocabulary: its Base"
                " column is not that of a general model."
            )
        if row.system.is_standin:
            lines.append(
                f"{row.system.label} is a tiny, randomly initialised model: its figures say nothing"
                " about the real candidate."
            )
    for row in rows:
        if row.missing:
            lines.append(
                f"{system_name(row)}: {len(row.missing)} of {row.n} samples have no prediction and"
                " count as empty outputs."
            )
        if row.finish_reasons.get("length"):
            lines.append(
                f"{system_name(row)}: {row.finish_reasons['length']} of {row.n} outputs were cut at"
                " the token limit."
            )
        if row.finish_reasons.get("error"):
            lines.append(
                f"{system_name(row)}: {row.finish_reasons['error']} of {row.n} samples failed and"
                " count as empty outputs (see predictions.jsonl)."
            )
    return lines


def system_name(row: Row) -> str:
    """Candidate and configuration in words."""
    return f"{row.system.label}, {heading(row.system.configuration)}"


def _first(rows: Iterable[Row]) -> list[Row]:
    """One row per candidate."""
    return list({row.system.candidate: row for row in rows}.values())


def _published_row(row: published.PublishedRow, level: Level) -> TableRow:
    return TableRow(
        f"{row.model} (published)",
        "published",
        published.SAMPLES[level],
        {key: Estimate(value) for key, value in row.figures.items()},
    )
