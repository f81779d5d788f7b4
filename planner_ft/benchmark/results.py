"""Results of a run: rows of metrics, made from answers and timed queries, or read again."""

from __future__ import annotations

import functools
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields, replace
from typing import Any, get_args

from planner_ft.benchmark import summary
from planner_ft.benchmark.baselines import make_baselines
from planner_ft.benchmark.breakdown import Breakdown, breakdown
from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.contrasts import Contrasts, Question, changes, contrasts, system_key
from planner_ft.benchmark.metrics.failures import FAILURES
from planner_ft.benchmark.paired import Comparison
from planner_ft.benchmark.samples import BenchData
from planner_ft.benchmark.scoring import score_sample
from planner_ft.benchmark.statistics import Estimate
from planner_ft.support.tables import NOTHING, Cell, RowKind
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

Record = dict[str, Any]
Lines = Mapping[str, Mapping[str, Any]]  # lines of predictions.jsonl or latency.jsonl by sample id


@dataclass(frozen=True)
class System:
    """A candidate in one configuration, or somebody's predictions.

    `label` is its name in tables, `published` its name in the published tables. `with_vocabulary`
    says whether the prompt held the vocabulary, `pretrained` whether the candidate was pretrained
    on plans of this vocabulary; both are None or False for predictions of unknown origin. `seen`
    are the samples that its adapter was trained on. `repeat` numbers the answers of a system that
    was asked several times; a row is of all of them.
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

    @property
    def key(self) -> str:
        """Its name in comparisons."""
        return system_key((self.candidate, self.configuration))


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
    metrics: dict[str, Estimate] = field(default_factory=dict)
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
        return self.system.key

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
        named = {name: system.pop(name) for name in ("candidate", "configuration")}
        metrics = {name: estimate.to_json() for name, estimate in self.metrics.items()}
        figures = {**named, "n": self.n, "metrics": metrics, "failures": self.failures}
        counts = {"finish_reasons": self.finish_reasons, "missing": list(self.missing)}
        beside = {"repeats": self.repeats, "costs": self.costs}
        known = {name: one for name, one in beside.items() if one}
        return figures | self.breakdown | counts | {"latency_n": self.latency_n} | known | system

    @classmethod
    def from_json(cls, record: Record) -> Row:
        """A row of results.json, also of an earlier version, which says less."""
        rest = {"label": str(record.get("candidate")), "n": 0, **record}
        own = {one.name: rest.pop(one.name) for one in fields(System) if one.name in rest}
        own |= {name: str(own.get(name)) for name in ("candidate", "configuration", "label")}
        known = {one.name: rest.pop(one.name) for one in fields(cls) if one.name in rest}
        known["metrics"] = {k: Estimate(**one) for k, one in known.get("metrics", {}).items()}
        known["missing"] = tuple(known.get("missing", ()))
        return cls(System(**own), breakdown=rest, **known)


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
        compared = {key: [one.to_json() for one in made] for key, made in self.contrasts.items()}
        return {
            "level": self.level,
            "data": self.data,
            "rows": [row.to_json() for row in self.rows],
            "changes": self.changes,
            "groups": self.groups,
            "comparisons": compared,
            "baselines": [row.to_json() for row in self.baselines],
            "training": self.training,
            "manifest": self.manifest,
        }

    @classmethod
    def from_json(
        cls, record: Record, scores: Sequence[Record] = (), baselines: Sequence[Record] = ()
    ) -> Results:
        """results.json with the lines of scores.jsonl and baselines.jsonl."""
        ours = tuple(map(Row.from_json, record.get("rows") or ()))
        theirs = tuple(map(Row.from_json, record.get("baselines") or ()))
        beside = tuple(scores), theirs, tuple(baselines)
        return cls(
            *(record["level"], record["data"], ours, record.get("manifest") or {}, *beside),
            training=record.get("training"),
            recorded={key: record[key] for key in ("comparisons", "groups") if record.get(key)},
        )

    @property
    def seed(self) -> int:
        return int(self.manifest.get("seed") or 0)

    @functools.cached_property
    def contrasts(self) -> Contrasts:
        """Differences of configurations, models, and all from the baselines, paired by sample."""
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
        return self.recorded.get("groups") or summary.group_figures(self.scores)


@dataclass(frozen=True)
class Measured:
    """A system with answers and timed queries by sample id, its costs and planning times."""

    system: System
    predictions: Lines
    timed: Lines = field(default_factory=dict)
    costs: Mapping[str, Any] = field(default_factory=dict)
    planning: Sequence[Mapping[str, Any]] = ()


def heading(configuration: str) -> str:
    """A configuration as the published tables write it."""
    return {"base": "Base", "lora": "LoRA"}.get(configuration, configuration)


def assemble(
    data: BenchData, vocabulary: Vocabulary, measured: Sequence[Measured], manifest: Record
) -> Results:
    """Score every system and the baselines; repeats of a system make one row."""
    systems, seed = dict[str, list[Measured]](), manifest["seed"]
    for entry in measured:
        systems.setdefault(entry.system.key, []).append(entry)
    baselines = make_baselines(data, vocabulary)
    without_model = [
        Measured(System(label, "baseline", f"{label} (baseline)", is_baseline=True), lines)
        for label, lines in baselines.answers.items()
    ]
    ours = [score_system(data, entries, vocabulary, seed) for entries in systems.values()]
    theirs = [score_system(data, [one], vocabulary, seed) for one in without_model]
    answers = [line for one in without_model for line in one.predictions.values()]
    scored = (line for _row, lines in theirs for line in lines)
    return Results(
        data.level,
        data.summary(),
        tuple(row for row, _lines in ours),
        manifest,
        tuple(line for _row, lines in ours for line in lines),
        baselines=tuple(row for row, _lines in theirs),
        baseline_scores=tuple(
            {**line, **answer} for line, answer in zip(scored, answers, strict=True)
        ),
        baseline_notes=baselines.notes,
        training=baselines.training,
    )


def score_system(
    data: BenchData, entries: Sequence[Measured], vocabulary: Vocabulary, seed: int
) -> tuple[Row, list[Record]]:
    """The row of one system, measured once or once per repeat, and its scores per answer."""
    asked = [
        (sample, one.predictions.get(sample.id), one.timed.get(sample.id))
        for one in entries
        for sample in data.samples
    ]
    scores = [score_sample(data.level, one, found, vocabulary, took) for one, found, took in asked]
    known = [answer.get("finish_reason") for _sample, answer, _timed in asked if answer]
    reasons = Counter(str(reason) for reason in known if reason)
    missing = [sample.id for sample, answer, _timed in asked if answer is None]
    failures = Counter(score.failure for score in scores)
    several, n, first = len(entries) > 1, len(data.samples), entries[0]
    named: Record = {name: getattr(first.system, name) for name in ("candidate", "configuration")}
    lines = [
        {**named, **({"repeat": index // n + 1} if several else {}), **score.to_json()}
        for index, score in enumerate(scores)
    ]
    families = {sample.id: sample.family for sample in data.samples}
    timed = {sample: line for one in entries for sample, line in one.timed.items()}
    row = Row(
        replace(first.system, repeat=None),
        n,
        summary.summarise(lines, seed),
        {kind: failures[kind] for kind in FAILURES},
        dict(sorted(reasons.items())),
        tuple(dict.fromkeys(missing)),
        latency_n=sum(line["latency_s"] is not None for line in lines),
        repeats=summary.pass_figures(lines, seed) if several else None,
        breakdown=breakdown(scores),
        costs=summary.cost_figures(timed, families, first.costs, first.planning, seed),
    )
    return row, lines
