"""Results of a run: rows of metrics, made from answers and timed queries, or read from
results.json.
"""

from __future__ import annotations

import functools
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields, replace
from typing import Any, get_args

from planner_ft.benchmark.baselines import make_baselines
from planner_ft.benchmark.breakdown import Breakdown, breakdown
from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.changes import changes
from planner_ft.benchmark.contrasts import Contrasts, Question, contrasts, system_key
from planner_ft.benchmark.costs import cost_figures
from planner_ft.benchmark.samples import BenchData, Sample
from planner_ft.benchmark.scoring import score_sample
from planner_ft.benchmark.statistics import Estimate
from planner_ft.benchmark.summary import failure_counts, group_figures, pass_figures, summarise
from planner_ft.benchmark.verdicts import Comparison
from planner_ft.support.tables import NOTHING, Cell, RowKind
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

Record = dict[str, Any]
Lines = Mapping[str, Mapping[str, Any]]
"""Lines of predictions.jsonl or latency.jsonl by sample id."""


@dataclass(frozen=True)
class System:
    """A candidate in one configuration, or somebody's predictions.

    `label` is its name in tables, `published` its name in the published tables. `with_vocabulary`
    says whether the prompt held the vocabulary, `pretrained` whether the candidate was pretrained
    on plans of this vocabulary; both are None or False for predictions of unknown origin. `seen` are
    the samples that its adapter was trained on. `repeat` numbers the answers of a system that was
    asked several times; a row is of all of them.
    """

    candidate: str
    configuration: str
    label: str
    published: str | None = None
    is_standin: bool = False
    pretrained: bool = False
    with_vocabulary: bool | None = None
    adapter: str | None = None
    seen: int = 0
    repeat: int | None = None
    is_baseline: bool = False


@dataclass(frozen=True)
class Row:
    """The figures of one system. `missing` are the samples without a prediction, which count as
    empty outputs.

    With repeats, `metrics` and `failures` are over all answers to the `n` samples, and `repeats`
    holds pass^k. `breakdown` has the row taken apart, `costs` are time and memory. `quoted` figures
    are published ones, not measured here; `marks` are those of tables by metric.
    """

    system: System
    n: int
    metrics: dict[str, Estimate]
    failures: dict[str, int] = field(default_factory=dict)
    finish_reasons: dict[str, int] = field(default_factory=dict)
    missing: tuple[str, ...] = ()
    latency_n: int = 0
    repeats: dict[str, Any] | None = None
    breakdown: Breakdown = field(default_factory=dict)
    costs: dict[str, Any] = field(default_factory=dict)
    quoted: bool = False
    marks: Mapping[str, str] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """Label and configuration, as tables name a row."""
        label = self.system.label
        return label if self.system.is_baseline else f"{label}, {self.configuration}"

    @property
    def configuration(self) -> str:
        """The configuration as the published tables write it."""
        return NOTHING if self.system.is_baseline else heading(self.system.configuration)

    @property
    def kind(self) -> RowKind:
        return "published" if self.quoted else "baseline" if self.system.is_baseline else "measured"

    @property
    def key(self) -> str:
        """The row's name in comparisons."""
        return system_key((self.system.candidate, self.system.configuration))

    def figure(self, metric: str) -> Estimate:
        """A metric, without a value where it was not measured."""
        return self.metrics.get(metric, Estimate(None))

    def cells(self, metrics: Iterable[str]) -> list[Cell]:
        """The figures and marks of these metrics, as tables show them."""
        return [
            METRIC[one].cell(self.figure(one), self.marks.get(one, ""), published=self.quoted)
            for one in metrics
        ]

    def to_json(self) -> Record:
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

    @classmethod
    def from_json(cls, record: Record) -> Row:
        """A row of results.json, also of an earlier version, which says less."""
        rest = {"label": str(record.get("candidate")), **record}
        own = {one.name: rest.pop(one.name) for one in fields(System) if one.name in rest}
        own |= {name: str(own.get(name)) for name in ("candidate", "configuration", "label")}
        figures = {name: Estimate(**one) for name, one in rest.pop("metrics", {}).items()}
        known = {one.name for one in fields(cls)}
        return cls(
            System(**own),
            rest.pop("n", 0),
            figures,
            rest.pop("failures", {}),
            rest.pop("finish_reasons", {}),
            tuple(rest.pop("missing", ())),
            breakdown={name: one for name, one in rest.items() if name not in known},
            **{name: one for name, one in rest.items() if name in known},
        )


@dataclass(frozen=True)
class Results:
    """Everything that results.json holds. `data` is path, sha256 and n of the test data.

    `baselines` are the rows of systems without a model, made from `training` (path, sha256, n).
    `scores` and `baseline_scores` are the lines of scores.jsonl and baselines.jsonl,
    `baseline_notes` notes for the reader. `recorded` are the comparisons and groups of results that
    were read from a file.
    """

    level: Level
    data: Record
    rows: tuple[Row, ...]
    manifest: Record = field(default_factory=dict)
    scores: tuple[Record, ...] = ()
    baselines: tuple[Row, ...] = ()
    baseline_scores: tuple[Record, ...] = ()
    baseline_notes: tuple[str, ...] = ()
    training: Record | None = None
    recorded: Record = field(default_factory=dict)

    def to_json(self) -> Record:
        return {
            "level": self.level,
            "data": self.data,
            "rows": [row.to_json() for row in self.rows],
            "changes": self.changes,
            "groups": self.groups,
            "comparisons": {
                question: [one.to_json() for one in found]
                for question, found in self.contrasts.items()
            },
            "baselines": [row.to_json() for row in self.baselines],
            "training": self.training,
            "manifest": self.manifest,
        }

    @classmethod
    def from_json(
        cls, record: Record, scores: Sequence[Record] = (), baselines: Sequence[Record] = ()
    ) -> Results:
        """results.json with the lines of scores.jsonl and baselines.jsonl."""
        ours, theirs = (
            tuple(map(Row.from_json, record.get(part) or ())) for part in ("rows", "baselines")
        )
        known = {key: record[key] for key in ("comparisons", "groups") if record.get(key)}
        return cls(
            record["level"],
            record["data"],
            ours,
            record.get("manifest") or {},
            tuple(scores),
            baselines=theirs,
            baseline_scores=tuple(baselines),
            training=record.get("training"),
            recorded=known,
        )

    @property
    def seed(self) -> int:
        return int(self.manifest.get("seed") or 0)

    @functools.cached_property
    def contrasts(self) -> Contrasts:
        """Differences between configurations, models, and everything and the baselines, paired by
        sample.
        """
        if known := self.recorded.get("comparisons"):
            return {
                key: [*map(Comparison.from_json, known.get(key, ()))] for key in get_args(Question)
            }
        return contrasts(self.scores, self.baseline_scores, self.seed)

    @functools.cached_property
    def changes(self) -> list[Record]:
        """Differences between each strength and free decoding, paired by sample."""
        return changes(self.scores, self.seed)

    @property
    def groups(self) -> list[Record]:
        """Figures per group of the test data."""
        return self.recorded.get("groups") or group_figures(self.scores)

    def row(self, candidate: str, configuration: str) -> Row:
        """The row of a candidate and configuration."""
        wanted = system_key((candidate, configuration))
        return next(row for row in self.rows if row.key == wanted)


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
    manifest: Record,
) -> Results:
    """Score every system on the samples of `data`, and the baselines; a sample without a prediction
    counts as an empty output. Repeats of a system make one row.
    """

    def scored(system: System, answers: list[tuple[Lines, Lines]]) -> tuple[Row, list[Record]]:
        return score_system(data.level, system, data.samples, answers, vocabulary, seed=seed)

    rows, scores, families = [], [], {sample.id: sample.family for sample in data.samples}
    systems: dict[tuple[str, str], list[Measured]] = {}
    for entry in measured:
        systems.setdefault((entry.system.candidate, entry.system.configuration), []).append(entry)
    for entries in systems.values():
        first, answers = entries[0], [(entry.predictions, entry.timed) for entry in entries]
        row, of_samples = scored(first.system, answers)
        timed = {sample: line for entry in entries for sample, line in entry.timed.items()}
        costs = cost_figures(timed, families, first.costs, first.planning, seed)
        rows.append(replace(row, costs=costs))
        scores += of_samples
    baselines, beside, beside_scores = make_baselines(data, vocabulary), [], []
    for label, lines in baselines.answers.items():
        system = System(label, "baseline", label=f"{label} (baseline)", is_baseline=True)
        row, of_samples = scored(system, [(lines, {})])
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
) -> tuple[Row, list[Record]]:
    """Score one system's (predictions, timed queries), both by sample id: one pair, or one per
    repeat. Returns its row and the scores per answer.
    """
    asked = [(sample, *lines) for lines in answers for sample in samples]
    scores = [
        score_sample(level, sample, predictions.get(sample.id), vocabulary, timed.get(sample.id))
        for sample, predictions, timed in asked
    ]
    known = [lines.get(sample.id, {}).get("finish_reason") for sample, lines, _timed in asked]
    reasons = Counter(str(reason) for reason in known if reason)
    missing = dict.fromkeys(sample.id for sample, lines, _timed in asked if sample.id not in lines)
    several, n = len(answers) > 1, len(samples)
    row = Row(
        system=replace(system, repeat=None),
        n=n,
        metrics=summarise(scores, seed),
        failures=failure_counts(scores),
        finish_reasons=dict(sorted(reasons.items())),
        missing=tuple(missing),
        latency_n=sum(score.values["latency_s"] is not None for score in scores),
        repeats=pass_figures(scores, seed) if several else None,
        breakdown=breakdown(scores),
    )
    named = {"candidate": system.candidate, "configuration": system.configuration}
    return row, [
        {**named, **({"repeat": index // n + 1} if several else {}), **score.to_json()}
        for index, score in enumerate(scores)
    ]
