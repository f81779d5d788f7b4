"""Calibration: scored answers to validation data become the probability that a part is right."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.benchmark.figures import confidence_figures
from planner_ft.benchmark.folder import PREDICTIONS, RUN, records_by_key
from planner_ft.benchmark.runner import run_bench
from planner_ft.benchmark.samples import BenchData, Sample, load_bench_data
from planner_ft.benchmark.scoring import SampleScore, score_sample
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.confidence.calibration import KINDS, Calibration, Curve, log_features
from planner_ft.confidence.parts import Part, from_json, parts
from planner_ft.planning.settings import PlanSettings, choose_agents
from planner_ft.support import files
from planner_ft.support.errors import PlannerError
from planner_ft.support.manifest import build_manifest
from planner_ft.support.terminal import Report, silent
from planner_ft.training.samples import Split, tests_within
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level

FEATURES = ("lowest", "total", "margin", "overruled", "tokens")
"""What tells right parts from wrong ones, chosen on the development sets (docs/metrics.md)."""
LEAST = 20  # answers below which nothing is fitted
FOLDS = 5
DATA = "data.jsonl"


@dataclass(frozen=True)
class Judged:
    """A part of an answer, whether it is right, and the family of its sample."""

    part: Part
    right: bool
    family: str


def calibrate(
    level: Level,
    data: Sequence[Path],
    out: Path,
    progress: Report = silent,
    *,
    overwrite: bool = False,
    **named: Any,
) -> tuple[Path, dict[str, Any]]:
    """Calibrate an agent on files of validation data and write the calibration beside its adapter,
    or in its candidate's folder; returns the file and its manifest, which names under `tests` the
    test sets among the data. `named` are those of PlanSettings. Answers are kept in `out`, and
    those that are there are not made again. Raises PlannerError, also for a calibration that is
    there already, without `overwrite`.
    """
    settings = PlanSettings(**named)
    vocabulary = load_vocabulary(settings.vocabulary)
    if not data:
        raise PlannerError("name at least one file of validation data")
    read = [load_bench_data(path, level, vocabulary) for path in data]
    _check_ids(read)
    agent = choose_agents(settings, vocabulary)[level]
    if agent.calibration.is_file() and not overwrite:
        there = "a calibration is there already; give --overwrite to replace it"
        raise PlannerError(f"{agent.calibration}: {there}")
    held_for = agent.held_for(vocabulary)
    texts = [files.read_text(path).rstrip() for path in data]
    digest = files.sha256_text(files.compact_json([held_for, *map(files.sha256_file, data)]))[:12]
    folder = out / f"{agent.candidate.slug}-{level}-{digest}"
    joined = folder / "in" / DATA
    files.write_text(joined, "".join(f"{text}\n" for text in texts))
    samples = load_bench_data(joined, level, vocabulary)
    run = BenchSettings(
        *(level, (settings.candidate,), (agent.configuration.name,), joined, folder / "run"),
        adapters=(str(agent.adapter),) if agent.adapter else (),
        vocabulary=settings.vocabulary,
        device=settings.device,
        quantization=agent.quantization,
        latency_samples=0,
        resume=True,
    )
    run_bench(run, progress)
    (key,) = files.read_json(run.folder / RUN)["keys"].values()
    lines = records_by_key(run.folder / PREDICTIONS).get(key, {})
    calibration = fitted(level, samples, lines, vocabulary, ", ".join(map(str, data)))
    manifest = build_manifest(
        "calibrate",
        seed=None,
        configuration={"level": level, "features": dict.fromkeys(KINDS, FEATURES)},
        inputs={str(path): path for path in data},
        agent=held_for,
        tests=test_sets(read, vocabulary),
        **calibration.manifest,
    )
    path = agent.calibration
    files.write_json(path, Calibration(level, calibration.curves, manifest).to_json())
    return path, manifest


def _check_ids(read: Sequence[BenchData]) -> None:
    """Raise PlannerError for an id that two files hold."""
    first: dict[str, Path] = {}
    for path, one in ((data.path, one.id) for data in read for one in data.samples):
        if one in first:
            found = f"id {one!r} stands in {first[one]} already; leave one of them out"
            raise PlannerError(f"{path}: {found}")
        first[one] = path


def test_sets(read: Sequence[BenchData], vocabulary: Vocabulary) -> dict[str, str]:
    """The known test sets whose inputs are among the data, and how many: "25 of 25"."""
    found: dict[str, str] = {}
    for data in read:
        records = [one.record for one in data.samples]
        found |= tests_within([Split(data.path, data.level, vocabulary, records, data.sha256)])
    # The challenge sets of eval are for development but for the unseen ones.
    development = {path for path in found if Path(path).match("eval/challenge/*.jsonl")}
    return {path: found[path] for path in found if path not in development or "unseen" in path}


def fitted(
    level: Level,
    data: BenchData,
    lines: dict[str, dict[str, Any]],
    vocabulary: Vocabulary,
    named: str = "",
) -> Calibration:
    """The curves of predictions by sample id; the manifest has the figures of plans that were not
    fitted on, out of FOLDS folds that no phrasing family crosses. Raises PlannerError where too few
    answers have log-probabilities; errors name the data as it was `named`.
    """
    named = named or str(data.path)
    judged = [one for sample in data.samples for one in judge(level, sample, lines, vocabulary)]
    of_kind = {kind: [one for one in judged if one.part.kind == kind] for kind in KINDS}
    if len(of_kind["plan"]) < LEAST:
        known = f"{len(of_kind['plan'])} of {len(data.samples)} answers have log-probabilities"
        way = f"at least {LEAST} are needed: give more data, or another candidate"
        raise PlannerError(f"{named}: {known}; {way}")
    if lacking := [kind for kind in KINDS if not of_kind[kind]]:
        known = f"no answer has a part of the kind {lacking[0]}, so that nothing can be calibrated"
        raise PlannerError(f"{named}: {known}; give more data, or a candidate that is trained")
    curves = {kind: _curve(found) for kind, found in of_kind.items()}
    figures = {kind: _held_out(found) for kind, found in of_kind.items()}
    return Calibration(level, curves, {"n": len(of_kind["plan"]), "held_out": figures})


def judge(
    level: Level, sample: Sample, lines: dict[str, dict[str, Any]], vocabulary: Vocabulary
) -> Iterator[Judged]:
    """The parts of an answer, as far as its log-probabilities are known and it can be read."""
    line = lines.get(sample.id, {})
    choices = from_json(line.get("logprobs"), line.get("output", ""))
    if choices is None or line.get("parsed") is None:
        return
    score = score_sample(level, sample, line, vocabulary)
    of_entries = _right(level, score, vocabulary)
    entry = -1
    for part in parts(level, line["output"], choices):
        if part.kind == "plan":
            yield Judged(part, score.failure is None, sample.family)
            continue
        entry += part.kind == "entry"
        if entry < len(of_entries):
            whole, values = of_entries[entry]
            named = part.path[-1] in values
            yield Judged(part, whole if part.kind == "entry" else named, sample.family)


def _right(level: Level, score: SampleScore, vocabulary: Vocabulary) -> list[tuple[bool, set[str]]]:
    """Per predicted entry whether name and parameters are right, and the names of right values."""
    found: list[tuple[bool, set[str]]] = [(False, set()) for _ in score.alignment.predicted]
    for ours, theirs in score.alignment.pairs:
        wanted, given = score.alignment.expected[ours], score.alignment.predicted[theirs]
        values = {"title" if level == "mission" else "name", *wanted.agreeing(given, vocabulary)}
        found[theirs] = not wanted.changed(given, vocabulary), values
    return found


def _curve(judged: Sequence[Judged]) -> Curve:
    from sklearn.linear_model import LogisticRegression

    features, right = [log_features(one.part) for one in judged], [one.right for one in judged]
    share = sum(right) / len(right)
    if share in (0, 1):
        # Nothing to tell apart: Laplace's rule of succession.
        odds = (sum(right) + 1) / (len(right) - sum(right) + 1)
        return Curve({}, math.log(odds), len(right), share)
    table = [[row[name] for name in FEATURES] for row in features]
    model = LogisticRegression(max_iter=1000).fit(table, right)
    weights = dict(zip(FEATURES, map(float, model.coef_[0]), strict=True))
    return Curve(weights, float(model.intercept_[0]), len(right), share)


def _held_out(judged: Sequence[Judged]) -> dict[str, Any]:
    """The figures of parts by curves that were fitted on the other folds."""
    families = sorted({one.family for one in judged})
    fold = {family: place % FOLDS for place, family in enumerate(families)}
    found: list[tuple[float, bool]] = []
    for number in range(min(FOLDS, len(families))):
        inside = [one for one in judged if fold[one.family] == number]
        outside = [one for one in judged if fold[one.family] != number]
        curve = _curve(outside or inside)
        found += [(curve.probability(one.part), one.right) for one in inside]
    figures = confidence_figures(*zip(*found, strict=True)) if found else {}
    return {name: value for name, value in figures.items() if name not in ("curve", "bins")}
