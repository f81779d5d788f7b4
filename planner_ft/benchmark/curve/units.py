"""Learning curves: growing parts of a training set, each trained on and benchmarked, resumable."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from typing import Any

from planner_ft.benchmark import folder
from planner_ft.benchmark.samples import BenchData, default_data, load_bench_data
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.benchmark.units import UNIT, State, Unit, Units, arguments
from planner_ft.candidates.loading import require_folder
from planner_ft.candidates.location import weights_sha256
from planner_ft.decoding.configurations import STRENGTHS, parse_configuration
from planner_ft.support.errors import IncompleteError, PlannerError
from planner_ft.support.files import read_json, sha256_file, write_json, write_jsonl
from planner_ft.training.output import differing
from planner_ft.training.request import TrainRequest, refusal
from planner_ft.training.samples import Split, read_split

BEGUN, RUNS, RESULT = "curve.json", "runs", "learning_curve.json"
TESTED = 4
"""A benchmarked sample takes about as long as training on this many."""


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
        base = [self._unit(0, 0)] if 0 in self.sizes else []
        sizes = [size for size in self.sizes if size]
        return base + [self._unit(size, seed) for seed in range(self.seeds) for size in sizes]

    def _unit(self, size: int, seed: int) -> Trained:
        name = f"{size} samples, seed {seed}" if size else "0 samples"
        place, tests = self.out / RUNS / f"{size}-{seed}", len(self.data.samples)
        trained = size * self.request.settings.epochs
        known: dict[str, Any] = {
            "weight": TESTED,
            "before": trained,
            "curve": self,
            "size": size,
            "seed": seed,
        }
        return Trained(name, place, tests, **known)

    def asked(self) -> dict[str, Any]:
        """Everything that the figures depend on but sizes and seeds, which may become more."""
        request, checked = self.request, self.request.validation_file
        weights = weights_sha256(require_folder(request.candidate))
        validation = sha256_file(checked) if checked else None
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
    path = data or default_data(request.level, vocabulary)
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
    elif (out / BEGUN).is_file() and (found := differing(read_json(out / BEGUN), asked)):
        way = "undo that, or start again with --overwrite"
        other = f"the curve in {out} was another one ({'; '.join(found)})"
        raise PlannerError(f"--resume: {other}; {way}")
    (out / RESULT).unlink(missing_ok=True)
    write_json(out / BEGUN, asked)


def run_units(curve: Curve, report: Callable[[State], None]) -> None:
    """Train and benchmark missing units, a process a step. Raises IncompleteError: go on later."""
    for unit, step, problem, log in Units(curve.units, report).run():
        kept = "what is finished is kept; go on with --resume"
        raise IncompleteError(f"{unit.name}: {step}: {problem} ({log}); {kept}")


@dataclass(frozen=True)
class Trained(Unit):
    """Training on the first `size` samples (0: none) with a seed, and the benchmark after it."""

    curve: Curve = field(kw_only=True)
    size: int = field(kw_only=True)
    seed: int = field(kw_only=True)

    def is_finished(self) -> bool:
        return (self.folder / UNIT).is_file()

    def steps(self) -> Iterator[tuple[str, list[str], Path]]:
        curve, request, here = self.curve, self.curve.request, self.folder
        adapter, vocabulary = here / "adapter", str(request.vocabulary.source)
        named = request.candidate.given_as
        if self.size:
            # The samples of a size are the first ones of the same order: parts of each other.
            records = list(curve.train.records)
            Random(f"learning curve {self.seed}").shuffle(records)
            write_jsonl(here / "train.jsonl", records[: self.size])
            files: dict[str, Any] = {"level": request.level, "candidate": named}
            files["vocabulary"] = vocabulary
            files |= {"train-file": here / "train.jsonl", "output": adapter, "seed": self.seed}
            files |= {"validation-file": checked} if (checked := request.validation_file) else {}
            flags = {**files, **curve.settings}.items()
            given = [
                part for name, one in flags for part in (f"--{name.replace('_', '-')}", str(one))
            ]
            yield "train", ["train", *given, "--resume"], here / "train.log"
        weights = "lora" if self.size else "base"
        settings = BenchSettings(
            request.level,
            (named,),
            (parse_configuration(f"{weights}+{curve.strength}").name,),
            curve.data.path,
            here / "bench",
            curve.limit,
            (str(adapter),) if self.size else (),
            vocabulary,
            curve.request.settings.device,
            quantization=curve.settings.get("quantization"),
            latency_samples=0,
        )
        yield "bench", arguments(settings), here / "bench.log"
