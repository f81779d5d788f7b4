"""`plannerft learning-curve`: what more training samples bring. Growing parts of a training set are
each trained on and benchmarked; then come the table and, in words, what more samples would bring.
"""

from __future__ import annotations

import itertools
import shutil
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from random import Random
from typing import Any

from planner_ft.benchmark import folder
from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.contrasts import Scores, by_system, sentences
from planner_ft.benchmark.figures import OF_GROUPS, summarise
from planner_ft.benchmark.paired import Comparison, adjusted, paired
from planner_ft.benchmark.samples import BenchData, default_data, load_bench_data
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.benchmark.statistics import Estimate
from planner_ft.benchmark.units import UNIT, State, Unit, Units, arguments
from planner_ft.candidates.loading import require_folder
from planner_ft.candidates.location import weights_sha256
from planner_ft.decoding.configurations import STRENGTHS, parse_configuration
from planner_ft.support import files
from planner_ft.support.errors import IncompleteError, PlannerError
from planner_ft.support.manifest import build_manifest
from planner_ft.support.tables import NOTHING, Table, csv_table, markdown_table, row
from planner_ft.training.output import differing
from planner_ft.training.request import TrainRequest, refusal
from planner_ft.training.samples import Split, read_split
from planner_ft.vocabulary.plans import Level

BEGUN, RUNS, RESULT = "curve.json", "runs", "learning_curve.json"
TESTED = 4  # A benchmarked sample takes about as long as training on this many
SEED = 0  # of the bootstrap
SHOWN = ("f1", "exact_sequence", "whole_plan")
STANDIN = (
    "is a tiny, randomly initialised model: the curve says nothing about the real candidate, nor"
    " about how many samples are worth writing."
)
SAMPLES: dict[Level, str] = {"mission": "commands", "task": "task inputs"}


@dataclass(frozen=True)
class Curve:
    """`request` is the training on the whole set, `settings` the flags of `train` given."""

    request: TrainRequest
    train: Split
    data: BenchData
    sizes: tuple[int, ...]
    seeds: int
    strength: str
    out: Path
    limit: int | None
    settings: dict[str, Any]

    @property
    def units(self) -> list[Trained]:
        """Seed after seed, so that every size is there early."""
        pairs = [(0, 0)] if 0 in self.sizes else []
        pairs += [(size, seed) for seed in range(self.seeds) for size in self.sizes if size]
        units = []
        for size, seed in pairs:
            name = f"{size} samples, seed {seed}" if size else "0 samples"
            place, trained = self.out / RUNS / f"{size}-{seed}", size * self.request.settings.epochs
            work = len(self.data.samples), TESTED, trained
            units.append(Trained(name, place, *work, curve=self, size=size, seed=seed))
        return units

    def asked(self) -> dict[str, Any]:
        """Everything that the figures depend on but sizes and seeds, which may become more."""
        request, checked = self.request, self.request.validation_file
        weights = weights_sha256(require_folder(request.candidate))
        validation = files.sha256_file(checked) if checked else None
        fingerprint = request.fingerprint(self.train.sha256, validation, weights)
        tested = {"test_data": self.data.sha256, "limit": self.limit, "strength": self.strength}
        return {**fingerprint, **tested}


def prepare(
    request: TrainRequest,
    out: Path,
    sizes: tuple[int, ...] | None = None,
    seeds: int = 3,
    strength: str = "schema",
    data: Path | None = None,
    limit: int | None = None,
    settings: dict[str, Any] | None = None,
) -> Curve:
    """A checked curve; without `sizes` 0, 8, 16, ... and the whole set. Raises PlannerError."""
    vocabulary, problems = request.vocabulary, list[str]()
    require_folder(request.candidate)
    train = read_split(request.train_file, request.level, vocabulary, problems)
    if train is None or problems:
        raise refusal("the data has", problems)
    most = len(train.records)
    doubled = [2**power for power in range(3, most.bit_length()) if 2**power < most]
    chosen = tuple(sorted({*(sizes if sizes is not None else (0, *doubled, most))}))
    if not chosen or chosen[0] < 0 or chosen[-1] > most:
        given = ",".join(map(str, chosen))
        problems.append(f"--sizes {given}: must be between 0 and {most}, the training samples")
    if strength not in STRENGTHS:
        problems.append(f"--strength {strength}: must be one of {', '.join(STRENGTHS)}")
    if seeds < 1:
        problems.append(f"--seeds {seeds}: must be at least 1")
    if problems:
        raise refusal("the configuration has", problems)
    beside = request.train_file.with_name("test.jsonl")
    path = data or (beside if beside.is_file() else default_data(request.level, vocabulary))
    tests = load_bench_data(path, request.level, vocabulary, limit)
    return Curve(request, train, tests, chosen, seeds, strength, out, limit, settings or {})


def begin(curve: Curve, *, resume: bool, overwrite: bool) -> None:
    """Take the folder that the caller holds. Raises PlannerError, also for another curve."""
    out, asked = curve.out, curve.asked()
    folder.check_folder(out, (BEGUN,), resume=resume, overwrite=overwrite)
    if overwrite and (out / BEGUN).is_file():
        for done in (out / RUNS).glob(f"*/{UNIT}"):  # first: a kill leaves no half that looks whole
            done.unlink()
        shutil.rmtree(out / RUNS, ignore_errors=True)
    elif (out / BEGUN).is_file() and (found := differing(files.read_json(out / BEGUN), asked)):
        way = "undo that, or start again with --overwrite"
        other = f"the curve in {out} was another one ({'; '.join(found)})"
        raise PlannerError(f"--resume: {other}; {way}")
    (out / RESULT).unlink(missing_ok=True)
    files.write_json(out / BEGUN, asked)


def run_units(curve: Curve, report: Callable[[State], None]) -> None:
    """Train and benchmark missing units, a process a step. Raises IncompleteError: go on later."""
    for unit, step, problem, log in Units(curve.units, report).run():
        kept = "what is finished is kept; go on with --resume"
        raise IncompleteError(f"{unit.name}: {step}: {problem} ({log}); {kept}")


@dataclass(frozen=True, kw_only=True)
class Trained(Unit):
    """Training on the first `size` samples (0: none) with a seed, and the benchmark after it."""

    curve: Curve
    size: int
    seed: int

    def steps(self) -> Iterator[tuple[str, list[str], Path]]:
        curve, request, here = self.curve, self.curve.request, self.folder
        adapter, vocabulary = here / "adapter", str(request.vocabulary.source)
        named = request.candidate.given_as
        if self.size:
            # The samples of a size are the first ones of the same order: parts of each other.
            records = list(curve.train.records)
            Random(f"learning curve {self.seed}").shuffle(records)
            files.write_jsonl(here / "train.jsonl", records[: self.size])
            flags: dict[str, Any] = {"level": request.level, "candidate": named}
            flags |= {"vocabulary": vocabulary, "train-file": here / "train.jsonl"}
            flags |= {"output": adapter, "seed": self.seed}
            flags |= {"validation-file": checked} if (checked := request.validation_file) else {}
            flags |= curve.settings
            given = itertools.chain.from_iterable(given_as(*flag) for flag in flags.items())
            yield "train", ["train", *given, "--resume"], here / "train.log"
        name = parse_configuration(f"{'lora' if self.size else 'base'}+{curve.strength}").name
        settings = BenchSettings(
            *(request.level, (named,), (name,), curve.data.path, here / "bench", curve.limit),
            *((str(adapter),) if self.size else (), vocabulary, request.settings.device),
            quantization=curve.settings.get("quantization"),
            latency_samples=0,
        )
        yield "bench", arguments(settings), here / "bench.log"


@dataclass(frozen=True)
class Point:
    """Figures of one size, each adapter's values (`by_seed`), scores by sample id."""

    size: int
    metrics: dict[str, Estimate]
    by_seed: tuple[dict[str, float | None], ...]
    scores: Scores

    def to_json(self) -> dict[str, Any]:
        figures = {name: one.to_json() for name, one in self.metrics.items()}
        answers = sum(map(len, self.scores.values()))
        return {"size": self.size, "n": answers, "metrics": figures, "by_seed": list(self.by_seed)}


def read_points(curve: Curve) -> list[Point]:
    """The figures of every size, smallest first, from the units' benchmarks."""
    found: dict[int, list[Scores]] = {}
    for unit in curve.units:
        results, _record = folder.read_results(unit.folder / "bench")
        found.setdefault(unit.size, []).extend(by_system(results.scores).values())
    return [_point(size, runs) for size, runs in sorted(found.items())]


def _point(size: int, runs: Sequence[Scores]) -> Point:
    every = {name: [line for run in runs for line in run[name]] for name in runs[0]}
    answers = [line for lines in every.values() for line in lines]
    of_runs = ([line for lines in run.values() for line in lines] for run in runs)
    by_seed = ({name: METRIC[name].value(lines) for name in OF_GROUPS} for lines in of_runs)
    figures = summarise(answers, SEED, OF_GROUPS)
    return Point(size, figures, tuple(by_seed), every)


def compared(found: Sequence[Point]) -> list[list[Comparison]]:
    """The largest size against each smaller one by SHOWN, paired, p adjusted over the three."""
    *smaller, last = found
    made = []
    for one in smaller:
        how = one.scores, last.scores, SEED, (str(one.size), str(last.size))
        made.append(adjusted([paired(METRIC[name], *how) for name in SHOWN]))
    return made


def answer(found: Sequence[Point], comparisons: Sequence[Sequence[Comparison]], what: str) -> str:
    """How many more samples (`what`) are worth writing, in words (templates/curve.txt.j2)."""
    final = comparisons[-1] if comparisons else ()
    better = [one for one in final if one.verdict == "better"]
    gains = [(METRIC[one.metric].heading, one.cell()) for one in better]
    as_good = (
        point.size
        for point, pairs in zip(found, comparisons, strict=False)
        if not any(one.verdict == "better" for one in pairs)
    )
    return sentences(
        "curve",
        what=what,
        sizes=[point.size for point in found],
        tests=len(found[-1].scores),
        gains=[f"{name} {replace(one, mark='').plain()}" for name, one in gains],
        verdicts=list(dict.fromkeys(one.verdict for one in final)),
        enough=next(as_good, None),
        room=max((100 * (one.difference.high or 0) for one in final), default=0),
    )[0]


def write_curve(curve: Curve) -> list[Point]:
    """Write table.md (a row per size), table.csv and, last, learning_curve.json."""
    request, found = curve.request, read_points(curve)
    comparisons, what, rows = compared(found), SAMPLES[request.level], []
    for point in found:
        values = [one["f1"] for one in point.by_seed if one["f1"] is not None]
        spread = f"{min(values):.2f} to {max(values):.2f}" if len(values) > 1 else NOTHING
        figures = [METRIC[name].cell(point.metrics[name]) for name in OF_GROUPS]
        rows.append(row(str(point.size), *figures, spread))
    heads = (*(METRIC[name].title for name in OF_GROUPS), "F1 by seed")
    table, said = Table(what.capitalize(), heads, rows), answer(found, comparisons, what)
    how = f"95 % intervals over the answers of {curve.seeds} adapters of each size to the test set."
    if request.candidate.is_standin:
        how += f"\n\n{request.candidate.row_name} {STANDIN}"
    files.write_text(curve.out / "table.md", f"{markdown_table(table)}\n{said}\n\n{how}\n")
    files.write_text(curve.out / "table.csv", csv_table(table))
    record: dict[str, Any] = {"level": request.level, "data": curve.data.summary()}
    record["is_standin"] = request.candidate.is_standin
    record |= {"answer": said, "points": [point.to_json() for point in found]}
    record["comparisons"] = [one.to_json() for pairs in comparisons for one in pairs]
    inputs: dict[str, Path | str] = {"training": request.train_file, "data": curve.data.path}
    inputs |= {"validation": request.validation_file} if request.validation_file else {}
    sizes = {"sizes": list(curve.sizes), "seeds": curve.seeds, "given": curve.settings}
    asked = {**curve.asked(), **sizes}
    manifest = build_manifest("learning-curve", seed=SEED, configuration=asked, inputs=inputs)
    files.write_json(curve.out / RESULT, {**record, "manifest": manifest})
    return found


def given_as(name: str, value: object) -> list[str]:
    """A setting of `train` as it is given on the command line."""
    flag = name.replace("_", "-")
    if isinstance(value, bool):
        return [f"--{flag}" if value else f"--no-{flag}"]
    return [f"--{flag}", str(value)]
