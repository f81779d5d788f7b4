"""Results of a run: rows of metrics."""

from __future__ import annotations

import functools
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from planner_ft.benchmark.breakdown import Breakdown, breakdown
from planner_ft.benchmark.changes import Change, changes
from planner_ft.benchmark.contrasts import Question, contrasts
from planner_ft.benchmark.groups import group_figures
from planner_ft.benchmark.repeats import pass_figures
from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.scoring import score_sample
from planner_ft.benchmark.statistics import Estimate
from planner_ft.benchmark.summary import failure_counts, summarise
from planner_ft.benchmark.verdicts import Comparison
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

Lines = Mapping[str, Mapping[str, Any]]
"""Lines of predictions.jsonl or latency.jsonl by sample id."""


@dataclass(frozen=True)
class System:
    """What was measured: a candidate in one configuration, or somebody's predictions.

    `label` is its name in tables, `published` its name in the published tables. `with_vocabulary`
    says whether the prompt held the vocabulary, `pretrained` whether the candidate was pretrained
    on plans of this vocabulary; both are None or False for predictions of unknown origin. `repeat`
    is which answers of a system that was asked several times these are; a row is of all of them.
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
    holds pass^k (see `repeats`). `breakdown` has the row taken apart (see `breakdown`), `costs` are
    time and memory (see `costs`).
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

    `baselines` are the rows of what needs no model, made from `training` (path, sha256, n); they
    are no candidates. `baseline_scores` are the lines of baselines.jsonl, `baseline_notes` say what
    a reader must know.
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
        figures: dict[str, Any] = {
            "rows": [row.to_json() for row in self.rows],
            "changes": [change.to_json() for change in self.changes],
            "groups": self.groups,
        }
        figures["comparisons"] = {
            question: [one.to_json() for one in found] for question, found in self.contrasts.items()
        }
        figures |= {
            "baselines": [row.to_json() for row in self.baselines],
            "training": self.training,
        }
        return {"level": self.level, "data": self.data, **figures, "manifest": self.manifest}

    @functools.cached_property
    def contrasts(self) -> dict[Question, list[Comparison]]:
        """Which differences of the table are real: configurations, models, and everything against
        the baselines, paired by sample.
        """
        return contrasts(self.scores, self.baseline_scores, int(self.manifest.get("seed") or 0))

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
        return next(
            row
            for row in self.rows
            if (row.system.candidate, row.system.configuration) == (candidate, configuration)
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
        [
            score_sample(
                level, sample, predictions.get(sample.id), vocabulary, timed.get(sample.id)
            )
            for sample in samples
        ]
        for predictions, timed in answers
    ]
    every = [score for of_repeat in scores for score in of_repeat]
    reasons = Counter(
        str(lines[sample.id]["finish_reason"])
        for lines, _timed in answers
        for sample in samples
        if lines.get(sample.id, {}).get("finish_reason")
    )
    row = Row(
        system=replace(system, repeat=None),
        n=len(samples),
        metrics=summarise(every, seed),
        failures=failure_counts(every),
        finish_reasons=dict(sorted(reasons.items())),
        missing=tuple(
            dict.fromkeys(
                sample.id
                for lines, _timed in answers
                for sample in samples
                if sample.id not in lines
            )
        ),
        latency_n=sum(score.values["latency_s"] is not None for score in every),
        repeats=pass_figures(every, seed) if len(answers) > 1 else None,
        breakdown=breakdown(every),
    )
    repeats = [
        {"repeat": repeat} if len(answers) > 1 else {} for repeat in range(1, len(answers) + 1)
    ]
    named = {"candidate": system.candidate, "configuration": system.configuration}
    return row, [
        {**named, **repeat, **score.to_json()}
        for repeat, of_repeat in zip(repeats, scores, strict=True)
        for score in of_repeat
    ]
