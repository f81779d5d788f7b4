"""Results of a run: rows of metrics, made from answers and timed queries, or read again."""

from __future__ import annotations

import functools
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields, replace
from typing import Any, get_args

from planner_ft.benchmark import figures
from planner_ft.benchmark.baselines import make_baselines
from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.contrasts import Contrasts, Question, changes, contrasts, system_key
from planner_ft.benchmark.metrics.answers import FAILURES
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
    are the samples that its adapter was trained on; a `merged` model has one folded in. `repeat`
    numbers the answers of a system that was asked several times; a row is of all of them.
    """

    candidate: str
    configuration: str
    label: str
    published: str | None = None
    is_standin: bool = False
    pretrained: bool = False
    merged: bool = False
    with_vocabulary: bool | None = None
    adapter: str | None = None
    seen: int = 0
    repeat: int | None = None
    is_baseline: bool = False

    @property
    def key(self) -> str:
        """Its name in comparisons."""
        return system_key((self.candidate, self.configuration))

    @property
    def heading(self) -> str:
        """The configuration as the published tables write it."""
        configuration = self.configuration
        if self.merged:  # the base of such a folder is no base alone
            configuration = configuration.replace("base", "merged", 1)
        return NOTHING if self.is_baseline else heading(configuration)

    @property
    def name(self) -> str:
        """Label and configuration, as tables name a row."""
        return self.label if self.is_baseline else f"{self.label}, {self.heading}"


@dataclass(frozen=True, kw_only=True)
class Row(System):
    """The figures of one system. `missing` are the samples without a prediction, which count as
    empty outputs.

    With repeats, `metrics` and `failures` are over all answers to the `n` samples, and `repeats`
    holds pass^k. `breakdown` has the row taken apart, `costs` are time and memory. `quoted` figures
    are published ones, not measured here; `marks` are those of tables by metric.
    """

    n: int
    metrics: dict[str, Estimate] = field(default_factory=dict)
    failures: dict[str, int] = field(default_factory=dict)
    breakdown: Record = field(default_factory=dict)
    finish_reasons: dict[str, int] = field(default_factory=dict)
    missing: tuple[str, ...] = ()
    latency_n: int = 0
    repeats: dict[str, Any] | None = None
    costs: dict[str, Any] = field(default_factory=dict)
    quoted: bool = False
    marks: Mapping[str, str] = field(default_factory=dict)

    @property
    def kind(self) -> RowKind:
        return "published" if self.quoted else "baseline" if self.is_baseline else "measured"

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
        """As results.json has it: no costs or repeats where there are none."""
        values: Record = asdict(self)
        first = ("candidate", "configuration", "n", "metrics", "failures")
        record: Record = {name: values.pop(name) for name in first} | values.pop("breakdown")
        record |= {name: values.pop(name) for name in ("finish_reasons", "missing", "latency_n")}
        beside = {name: values.pop(name) for name in ("repeats", "costs")}
        record |= {name: found for name, found in beside.items() if found}
        del values["repeat"], values["quoted"], values["marks"]
        return record | values

    @classmethod
    def from_json(cls, record: Record) -> Row:
        """A row of results.json, also of an earlier version, which says less."""
        rest = {"label": str(record.get("candidate")), "n": 0, **record}
        known = {one.name: rest.pop(one.name) for one in fields(cls) if one.name in rest}
        known |= {name: str(known.get(name)) for name in ("candidate", "configuration", "label")}
        known["metrics"] = {k: Estimate(**one) for k, one in known.get("metrics", {}).items()}
        known["missing"] = tuple(known.get("missing", ()))
        return cls(breakdown=rest, **known)


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
        return self.recorded.get("groups") or figures.group_figures(self.scores)


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
    systems = defaultdict[str, list[Measured]](list)
    for entry in measured:
        systems[entry.system.key].append(entry)
    made = make_baselines(data, vocabulary)
    without_model = [
        [Measured(System(label, "baseline", f"{label} (baseline)", is_baseline=True), lines)]
        for label, lines in made.answers.items()
    ]

    def scored(groups: Iterable[Sequence[Measured]]) -> tuple[tuple[Row, ...], tuple[Record, ...]]:
        found = [score_system(data, one, vocabulary, manifest["seed"]) for one in groups]
        return tuple(row for row, _ in found), tuple(line for _, lines in found for line in lines)

    (rows, scores), (baselines, theirs) = scored(systems.values()), scored(without_model)
    ours = data.level, data.summary(), rows, manifest, scores
    return Results(*ours, baselines, theirs, made.notes, made.training)


def score_system(
    data: BenchData, entries: Sequence[Measured], vocabulary: Vocabulary, seed: int
) -> tuple[Row, list[Record]]:
    """The row of one system, measured once or once per repeat, and its scores per answer; those of
    a baseline hold the answers, too.
    """
    asked = [
        (sample, one.predictions.get(sample.id), one.timed.get(sample.id))
        for one in entries
        for sample in data.samples
    ]
    scores = [score_sample(data.level, one, found, vocabulary, took) for one, found, took in asked]
    known = [answer.get("finish_reason") for _sample, answer, _timed in asked if answer]
    missing = [sample.id for sample, answer, _timed in asked if answer is None]
    failed = Counter(score.failure for score in scores)
    several, n, first = len(entries) > 1, len(data.samples), entries[0]
    named: Record = {name: getattr(first.system, name) for name in ("candidate", "configuration")}
    lines = [
        {**named, **({"repeat": index // n + 1} if several else {}), **score.to_json()}
        | (dict(answer or {}) if first.system.is_baseline else {})
        for index, (score, (_sample, answer, _timed)) in enumerate(zip(scores, asked, strict=True))
    ]
    families = {sample.id: sample.family for sample in data.samples}
    timed = {sample: line for one in entries for sample, line in one.timed.items()}
    row = Row(
        **vars(replace(first.system, repeat=None)),
        n=n,
        metrics=figures.summarise(lines, seed),
        failures={kind: failed[kind] for kind in FAILURES},
        breakdown=figures.breakdown(scores),
        finish_reasons=dict(sorted(Counter(str(reason) for reason in known if reason).items())),
        missing=tuple(dict.fromkeys(missing)),
        latency_n=sum(line["latency_s"] is not None for line in lines),
        repeats=figures.pass_figures(lines, seed) if several else None,
        costs=figures.cost_figures(timed, families, first.costs, first.planning, seed),
    )
    return row, lines
