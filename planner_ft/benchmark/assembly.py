"""From answers and timed queries to results: the one place where bench, score and suites meet."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from planner_ft.benchmark.baselines import Baselines, make_baselines
from planner_ft.benchmark.costs import cost_figures
from planner_ft.benchmark.results import Lines, Results, System, score_system
from planner_ft.benchmark.samples import BenchData
from planner_ft.vocabulary import Vocabulary


@dataclass(frozen=True)
class Measured:
    """One system with its answers and timed queries, both by sample id.

    `costs` is what run.json has on its candidate, `planning` its lines of planning.jsonl.
    """

    system: System
    predictions: Lines
    timed: Lines = field(default_factory=dict)
    costs: Mapping[str, Any] = field(default_factory=dict)
    planning: Sequence[Mapping[str, Any]] = ()


def assemble(
    data: BenchData,
    vocabulary: Vocabulary,
    measured: Sequence[Measured],
    *,
    seed: int,
    manifest: dict[str, Any],
) -> Results:
    """Score every system on the samples of `data`; a sample without a prediction counts as an empty
    output. Repeats of a system make one row.
    """
    rows, scores = [], []
    systems: dict[tuple[str, str], list[Measured]] = {}
    for entry in measured:
        systems.setdefault((entry.system.candidate, entry.system.configuration), []).append(entry)
    for entries in systems.values():
        answers = [(entry.predictions, entry.timed) for entry in entries]
        row, of_samples = score_system(
            data.level, entries[0].system, data.samples, answers, vocabulary, seed=seed
        )
        timed = {sample: line for entry in entries for sample, line in entry.timed.items()}
        costs = cost_figures(
            timed,
            {sample.id: sample.family for sample in data.samples},
            entries[0].costs,
            entries[0].planning,
            seed,
        )
        rows.append(replace(row, costs=costs))
        scores += of_samples
    results = Results(data.level, data.summary(), tuple(rows), manifest, tuple(scores))
    return _with_baselines(results, make_baselines(data, vocabulary), data, vocabulary, seed)


def _with_baselines(
    results: Results, baselines: Baselines, data: BenchData, vocabulary: Vocabulary, seed: int
) -> Results:
    """The results with the rows of the baselines; a line of their scores also holds what was
    answered.
    """
    rows, scores = [], []
    for baseline in baselines.found:
        row, of_samples = score_system(
            data.level,
            baseline.system,
            data.samples,
            [(baseline.predictions, {})],
            vocabulary,
            seed=seed,
        )
        rows.append(row)
        scores += [{**score, **baseline.predictions[score["id"]]} for score in of_samples]
    return replace(
        results,
        baselines=tuple(rows),
        baseline_scores=tuple(scores),
        baseline_notes=baselines.notes,
        training=baselines.training,
    )
