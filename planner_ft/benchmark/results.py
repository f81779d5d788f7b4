"""Results of a run: rows of metrics, made from answers and timed queries."""

from __future__ import annotations

import functools
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from planner_ft.benchmark.baselines import make_baselines
from planner_ft.benchmark.breakdown import Breakdown, breakdown
from planner_ft.benchmark.changes import Change, changes
from planner_ft.benchmark.contrasts import Question, contrasts
from planner_ft.benchmark.costs import cost_figures
from planner_ft.benchmark.samples import BenchData, Sample
from planner_ft.benchmark.scoring import score_sample
from planner_ft.benchmark.statistics import Estimate
from planner_ft.benchmark.summary import failure_counts, group_figures, pass_figures, summarise
from planner_ft.benchmark.verdicts import Comparison
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

Lines = Mapping[str, Mapping[str, Any]]
"""Lines of predictions.jsonl or latency.jsonl by sample id."""


@dataclass(frozen=True)
class System:
    """A candidate in one configuration, or somebody's predictions.

    `label` is its name in tables, `published` its name in the published tables. `with_vocabulary`
    says whether the prompt held the vocabulary, `pretrained` whether the candidate was pretrained
    on plans of this vocabulary; both are None or False for predictions of unknown origin. `repeat`
    numbers the answers of a system that was asked several times; a row is of all of them.
    """

    candidate: str
    configuration: str
    label: str
    published: str | None = None
    is_standin: bool = False
    pretrained: bool = False
    with_vocabulary: bool | None = None
    adapter: str | None = None
    repeat: int | None = None
    is_baseline: bool = False


@dataclass(frozen=True)
class Row:
    """The figures of one system. `missing` are the samples without a prediction, which count as
    empty outputs.

    With repeats, `metrics` and `failures` are over all answers to the `n` samples, and `repeats`
    holds pass^k. `breakdown` has the row taken apart, `costs` are time and memory.
    """

    system: System
    n: int
    metrics: dict[str, Estimate]
    failures: dict[str, int]
    finish_reasons: dict[str, int]
    missing: tuple[str, ...] = ()
    latency_n: int = 0
    repeats: dict[str, Any] | None = None
    breakdown: Breakdown = field(default_factory=dict)
    costs: dict[str, Any] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """Label and configuration, as tables name a row."""
        return f"{self.system.label}, {heading(self.system.configuration)}"

    def to_json(self) -> dict[str, Any]:
        system = asdict(self.system)
        del system["repeat"]
        return {
            "candidate": system.pop("candidate"),
            "configuration": system.pop("configuration"),
            "n": self.n,
            "metrics": {name: estimate.to_json() for name, estimate in self.metrics.items()},
            "failures": self.failures,
            **self.breakdown,
            "finish_reasons": self.finish_reasons,
            "missing": list(self.missing),
            "latency_n": self.latency_n,
            **({"repeats": self.repeats} if self.repeats else {}),
            **({"costs": self.costs} if self.costs else {}),
            **system,
        }


@dataclass(frozen=True)
class Results:
    """Everything that results.json holds. `data` is path, sha256 and n of the test data.

    `baselines` are the rows of systems without a model, made from `training` (path, sha256, n).
    `baseline_scores` are the lines of baselines.jsonl, `baseline_notes` notes for the reader.
    """

    level: Level
    data: dict[str, Any]
    rows: tuple[Row, ...]
    manifest: dict[str, Any] = field(default_factory=dict)
    scores: tuple[dict[str, Any], ...] = ()
    baselines: tuple[Row, ...] = ()
    baseline_scores: tuple[dict[str, Any], ...] = ()
    baseline_notes: tuple[str, ...] = ()
    training: dict[str, Any] | None = None

    def to_json(self) -> dict[str, Any]:
        return {
            "level": self.level,
            "data": self.data,
            "rows": [row.to_json() for row in self.rows],
            "changes": [change.to_json() for change in self.changes],
            "groups": self.groups,
            "comparisons": {
                question: [one.to_json() for one in found]
                for question, found in self.contrasts.items()
            },
            "baselines": [row.to_json() for row in self.baselines],
            "training": self.training,
            "manifest": self.manifest,
        }

    @property
    def seed(self) -> int:
        return int(self.manifest.get("seed") or 0)

    @functools.cached_property
    def contrasts(self) -> dict[Question, list[Comparison]]:
        """Differences between configurations, models, and everything and the baselines, paired by
        sample.
        """
        return contrasts(self.scores, self.baseline_scores, self.seed)

    @functools.cached_property
    def changes(self) -> list[Change]:
        """Differences between each strength and free decoding, paired by sample."""
        return changes(self.scores, self.seed)

    @property
    def groups(self) -> list[dict[str, Any]]:
        """Figures per group of the test data."""
        return group_figures(self.scores)

    def row(self, candidate: str, configuration: str) -> Row:
        """The row of a candidate and configuration."""
        wanted = candidate, configuration
        systems = ((row.system.candidate, row.system.configuration) for row in self.rows)
        return self.rows[list(systems).index(wanted)]


@dataclass(frozen=True)
class Measured:
    """One system with its answers and timed queries, both by sample id.

    `costs` are the figures of run.json on its candidate, `planning` its lines of planning.jsonl.
    """

    system: System
    predictions: Lines
    timed: Lines = field(default_factory=dict)
    costs: Mapping[str, Any] = field(default_factory=dict)
    planning: Sequence[Mapping[str, Any]] = ()


def heading(configuration: str) -> str:
    """A configuration as the published tables write it."""
    return {"base": "Base", "lora": "LoRA"}.get(configuration, configuration)


def assemble(
    data: BenchData,
    vocabulary: Vocabulary,
    measured: Sequence[Measured],
    *,
    seed: int,
    manifest: dict[str, Any],
) -> Results:
    """Score every system on the samples of `data`, and the baselines; a sample without a prediction
    counts as an empty output. Repeats of a system make one row.
    """
    rows: list[Row] = []
    scores: list[dict[str, Any]] = []
    families = {sample.id: sample.family for sample in data.samples}
    systems: dict[tuple[str, str], list[Measured]] = {}
    for entry in measured:
        systems.setdefault((entry.system.candidate, entry.system.configuration), []).append(entry)
    for entries in systems.values():
        first, answers = entries[0], [(entry.predictions, entry.timed) for entry in entries]
        row, of_samples = score_system(
            data.level, first.system, data.samples, answers, vocabulary, seed=seed
        )
        timed = {sample: line for entry in entries for sample, line in entry.timed.items()}
        costs = cost_figures(timed, families, first.costs, first.planning, seed)
        rows.append(replace(row, costs=costs))
        scores += of_samples
    baselines = make_baselines(data, vocabulary)
    beside: list[Row] = []
    beside_scores: list[dict[str, Any]] = []
    for label, lines in baselines.answers.items():
        system = System(label, "baseline", label=f"{label} (baseline)", is_baseline=True)
        row, of_samples = score_system(
            data.level, system, data.samples, [(lines, {})], vocabulary, seed=seed
        )
        beside.append(row)
        beside_scores += [{**score, **lines[score["id"]]} for score in of_samples]
    return Results(
        data.level,
        data.summary(),
        tuple(rows),
        manifest,
        tuple(scores),
        baselines=tuple(beside),
        baseline_scores=tuple(beside_scores),
        baseline_notes=baselines.notes,
        training=baselines.training,
    )


def score_system(
    level: Level,
    system: System,
    samples: Sequence[Sample],
    answers: Sequence[tuple[Lines, Lines]],
    vocabulary: Vocabulary,
    *,
    seed: int,
) -> tuple[Row, list[dict[str, Any]]]:
    """Score one system's (predictions, timed queries), both by sample id: one pair, or one per
    repeat. Returns its row and the scores per answer.
    """
    scores = [
        score_sample(level, sample, predictions.get(sample.id), vocabulary, timed.get(sample.id))
        for predictions, timed in answers
        for sample in samples
    ]
    several, n = len(answers) > 1, len(samples)
    asked = [(sample.id, lines) for lines, _timed in answers for sample in samples]
    reasons = Counter(str(lines.get(name, {}).get("finish_reason") or "") for name, lines in asked)
    del reasons[""]
    row = Row(
        system=replace(system, repeat=None),
        n=n,
        metrics=summarise(scores, seed),
        failures=failure_counts(scores),
        finish_reasons=dict(sorted(reasons.items())),
        missing=tuple(dict.fromkeys(name for name, lines in asked if name not in lines)),
        latency_n=sum(score.values["latency_s"] is not None for score in scores),
        repeats=pass_figures(scores, seed) if several else None,
        breakdown=breakdown(scores),
    )
    named = {"candidate": system.candidate, "configuration": system.configuration}
    return row, [
        {**named, **({"repeat": index // n + 1} if several else {}), **score.to_json()}
        for index, score in enumerate(scores)
    ]
