"""From answers and timed queries to results: the one place where bench, score and suites meet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from planner_ft.benchmark.results import Lines, Results, System, score_system
from planner_ft.benchmark.samples import BenchData
from planner_ft.vocabulary import Vocabulary


@dataclass(frozen=True)
class Measured:
    """One system with its answers and timed queries, both by sample id."""

    system: System
    predictions: Lines
    timed: Lines = field(default_factory=dict)


def assemble(data: BenchData, vocabulary: Vocabulary, measured: Sequence[Measured], *, seed: int, manifest: dict[str, Any]) -> Results:
    """Score every system on the samples of `data`; a sample without a prediction counts as an empty output. Repeats of a system make one row."""
    rows, scores = [], []
    systems: dict[tuple[str, str], list[Measured]] = {}
    for entry in measured:
        systems.setdefault((entry.system.candidate, entry.system.configuration), []).append(entry)
    for entries in systems.values():
        answers = [(entry.predictions, entry.timed) for entry in entries]
        row, of_samples = score_system(data.level, entries[0].system, data.samples, answers, vocabulary, seed=seed)
        rows.append(row)
        scores += of_samples
    return Results(data.level, data.summary(), tuple(rows), manifest, tuple(scores))
