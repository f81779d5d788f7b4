"""Learning curves: growing parts of a training set, each trained on and benchmarked, resumable."""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any

from planner_ft.benchmark import folder
from planner_ft.benchmark.samples import BenchData, default_data, load_bench_data
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.benchmark.suite.session import POLL
from planner_ft.benchmark.suite.units import Process, arguments
from planner_ft.candidates.loading import require_folder
from planner_ft.candidates.location import weights_sha256
from planner_ft.decoding.configurations import STRENGTHS, parse_configuration
from planner_ft.support.errors import IncompleteError, PlannerError
from planner_ft.support.files import read_json, sha256_file, write_json, write_jsonl
from planner_ft.support.resources import clock
from planner_ft.training.output import differing
from planner_ft.training.request import TrainRequest, refusal
from planner_ft.training.samples import Split, read_split

BEGUN, RUNS, DONE, RESULT = "curve.json", "runs", "unit.json", "learning_curve.json"
TESTED = 4
"""A benchmarked sample takes about as long as training on this many."""


@dataclass(frozen=True)
class Unit:
    """Training on `size` samples (0: none) with a seed, and the benchmark of the adapter."""

    size: int
    seed: int

    @property
    def name(self) -> str:
        return f"{self.size} samples, seed {self.seed}" if self.size else "0 samples"


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
    def units(self) -> list[Unit]:
        """Seed after seed, so that every size is there early."""
        base = [Unit(0, 0)] if 0 in self.sizes else []
        sizes = [size for size in self.sizes if size]
        return base + [Unit(size, seed) for seed in range(self.seeds) for size in sizes]

    def folder(self, unit: Unit) -> Path:
        return self.out / RUNS / f"{unit.size}-{unit.seed}"

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
    folder.check_folder(out, () if resume or overwrite else (BEGUN,), folder.GO_ON)
    if overwrite and (out / BEGUN).is_file():
        for done in (out / RUNS).glob(f"*/{DONE}"):  # first: a kill leaves no half that looks whole
            done.unlink()
        shutil.rmtree(out / RUNS, ignore_errors=True)
    elif (out / BEGUN).is_file() and (found := differing(read_json(out / BEGUN), asked)):
        way = "undo that, or start again with --overwrite"
        other = f"the curve in {out} was another one ({'; '.join(found)})"
        raise PlannerError(f"--resume: {other}; {way}")
    (out / RESULT).unlink(missing_ok=True)
    write_json(out / BEGUN, asked)


def run_units(curve: Curve, state: Callable[[int, str], None]) -> None:
    """Train and benchmark missing units, a process a step. Raises IncompleteError: go on later."""
    units, begun = curve.units, time.monotonic()
    open_units = (unit for unit in units if not (curve.folder(unit) / DONE).is_file())
    left = {unit: _work(curve, unit) for unit in open_units}
    total = sum(left.values())
    for index, unit in enumerate(units, 1):
        if unit not in left:
            continue
        ahead = sum(left.values())
        pace = (time.monotonic() - begun) / (total - ahead) if ahead < total else None
        rest = f", about {clock(pace * ahead)} left in all" if pace else ""
        for step, (name, given) in enumerate(_commands(curve, unit)):
            log = curve.folder(unit) / f"{name}.log"
            with Process(given, log) as process:
                while process.running():
                    state(2 * index + step, f"({index}/{len(units)}) {unit.name}: {name}{rest}")
                    time.sleep(POLL)
                if problem := process.problem():
                    kept = "what is finished is kept; go on with --resume"
                    raise IncompleteError(f"{unit.name}: {name}: {problem} ({log}); {kept}")
        write_json(curve.folder(unit) / DONE, {"size": unit.size, "seed": unit.seed})
        del left[unit]


def _work(curve: Curve, unit: Unit) -> float:
    return unit.size * curve.request.settings.epochs + TESTED * len(curve.data.samples)


def _commands(curve: Curve, unit: Unit) -> Iterator[tuple[str, list[str]]]:
    """The steps of a unit: name and arguments of `plannerft`."""
    request, here = curve.request, curve.folder(unit)
    adapter, vocabulary = here / "adapter", str(request.vocabulary.source)
    named = request.candidate.given_as
    if unit.size:
        # The samples of a size are the first ones of the same order: parts of each other.
        records = list(curve.train.records)
        Random(f"learning curve {unit.seed}").shuffle(records)
        write_jsonl(here / "train.jsonl", records[: unit.size])
        files: dict[str, Any] = {"level": request.level, "candidate": named}
        files["vocabulary"] = vocabulary
        files |= {"train-file": here / "train.jsonl", "output": adapter, "seed": unit.seed}
        files |= {"validation-file": checked} if (checked := request.validation_file) else {}
        flags = {**files, **curve.settings}.items()
        given = [part for name, one in flags for part in (f"--{name.replace('_', '-')}", str(one))]
        yield "train", ["train", *given, "--resume"]
    weights = "lora" if unit.size else "base"
    settings = BenchSettings(
        request.level,
        (named,),
        (parse_configuration(f"{weights}+{curve.strength}").name,),
        curve.data.path,
        here / "bench",
        curve.limit,
        (str(adapter),) if unit.size else (),
        vocabulary,
        curve.request.settings.device,
        quantization=curve.settings.get("quantization"),
        latency_samples=0,
    )
    yield "bench", arguments(settings)
