"""Results of a run: rows of metrics."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from planner_ft.benchmark.changes import Change, changes
from planner_ft.benchmark.groups import group_figures
from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.scoring import SampleScore, score_sample
from planner_ft.benchmark.statistics import Estimate
from planner_ft.benchmark.summary import failure_counts, summarise
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level


@dataclass(frozen=True)
class System:
    """What was measured: a candidate in one configuration, or somebody's predictions.

    `label` is its name in tables, `published` its name in the published tables. `with_vocabulary` says whether the
    prompt held the vocabulary, `pretrained` whether the candidate was pretrained on plans of this vocabulary; both are
    None or False for predictions of unknown origin.
    """

    candidate: str
    configuration: str
    label: str
    published: str | None = None
    is_standin: bool = False
    pretrained: bool = False
    with_vocabulary: bool | None = None
    adapter: str | None = None


@dataclass(frozen=True)
class Row:
    """The figures of one system. `missing` are the samples without a prediction, which count as empty outputs."""

    system: System
    n: int
    metrics: dict[str, Estimate]
    failures: dict[str, int]
    finish_reasons: dict[str, int]
    missing: tuple[str, ...] = ()
    latency_n: int = 0

    def to_json(self) -> dict[str, Any]:
        system = asdict(self.system)
        return {
            "candidate": system.pop("candidate"),
            "configuration": system.pop("configuration"),
            "n": self.n,
            "metrics": {name: estimate.to_json() for name, estimate in self.metrics.items()},
            "failures": self.failures,
            "finish_reasons": self.finish_reasons,
            "missing": list(self.missing),
            "latency_n": self.latency_n,
            **system,
        }


@dataclass(frozen=True)
class Results:
    """Everything that results.json holds. `data` is path, sha256 and n of the test data."""

    level: Level
    data: dict[str, Any]
    rows: tuple[Row, ...]
    manifest: dict[str, Any] = field(default_factory=dict)
    scores: tuple[dict[str, Any], ...] = ()

    def to_json(self) -> dict[str, Any]:
        figures = {"rows": [row.to_json() for row in self.rows], "changes": [change.to_json() for change in self.changes], "groups": self.groups}
        return {"level": self.level, "data": self.data, **figures, "manifest": self.manifest}

    @property
    def changes(self) -> list[Change]:
        """What each strength changes against free decoding, paired by sample."""
        return changes(self.scores, int(self.manifest.get("seed", 0)))

    @property
    def groups(self) -> list[dict[str, Any]]:
        """Figures per group of the test data."""
        return group_figures(self.scores)

    def row(self, candidate: str, configuration: str) -> Row:
        """The row of a candidate and configuration."""
        return next(row for row in self.rows if (row.system.candidate, row.system.configuration) == (candidate, configuration))


def score_system(
    level: Level,
    system: System,
    samples: Sequence[Sample],
    predictions: Mapping[str, Mapping[str, Any]],
    vocabulary: Vocabulary,
    *,
    seed: int,
    timed: Mapping[str, Mapping[str, Any]] | None = None,
) -> tuple[Row, list[dict[str, Any]]]:
    """Score one system's predictions (by sample id); return its row and the scores per sample. `timed` holds its timed queries."""
    timed = timed or {}
    scores: list[SampleScore] = [score_sample(level, sample, predictions.get(sample.id), vocabulary, timed.get(sample.id)) for sample in samples]
    reasons = Counter(str(predictions[sample.id]["finish_reason"]) for sample in samples if predictions.get(sample.id, {}).get("finish_reason"))
    row = Row(
        system=system,
        n=len(scores),
        metrics=summarise(scores, seed),
        failures=failure_counts(scores),
        finish_reasons=dict(sorted(reasons.items())),
        missing=tuple(sample.id for sample in samples if sample.id not in predictions),
        latency_n=sum(score.values["latency_s"] is not None for score in scores),
    )
    return row, [{"candidate": system.candidate, "configuration": system.configuration, **score.to_json()} for score in scores]
