"""From answers and timed queries to results: the one place where bench, score and suites meet."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from planner_ft.benchmark.results import Results, System, score_system
from planner_ft.benchmark.samples import BenchData
from planner_ft.vocabulary import Vocabulary

Lines = Mapping[str, Mapping[str, Any]]
"""Lines of predictions.jsonl or latency.jsonl by sample id."""


@dataclass(frozen=True)
class Measured:
    """One system with its answers and timed queries, both by sample id."""

    system: System
    predictions: Lines
    timed: Lines = field(default_factory=dict)


def assemble(data: BenchData, vocabulary: Vocabulary, measured: Sequence[Measured], *, seed: int, manifest: dict[str, Any]) -> Results:
    """Score every system on the samples of `data`; a sample without a prediction counts as an empty output."""
    rows, scores = [], []
    for entry in measured:
        row, of_samples = score_system(data.level, entry.system, data.samples, entry.predictions, vocabulary, seed=seed, timed=entry.timed)
        rows.append(row)
        scores += of_samples
    return Results(data.level, data.summary(), tuple(rows), manifest, tuple(scores))
