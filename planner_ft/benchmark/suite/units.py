"""The units of a suite: one candidate on one data set, each a process and a run folder of its
own.
"""

from __future__ import annotations

import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.benchmark.folder import RESULTS
from planner_ft.benchmark.samples import BenchData, load_bench_data
from planner_ft.benchmark.suite.definition import Part, Suite
from planner_ft.candidates import Candidate, resolve_candidate
from planner_ft.candidates.adapters import (
    CONFIG,
    WEIGHTS,
    adapter_folder,
    check_adapter,
    find_adapter,
)
from planner_ft.candidates.loading import require_folder
from planner_ft.candidates.location import weights_sha256
from planner_ft.decoding.configurations import parse_configuration
from planner_ft.prompts.render import PROMPT_VERSION
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, sha256_tree, write_json
from planner_ft.support.resources import end_with_parent
from planner_ft.vocabulary import Vocabulary

UNIT, LOG = "unit.json", "log.txt"
PATIENCE = 20.0
"""Seconds that an ended process has to go by itself."""
LAUNCH = (
    *("--num_machines", "1", "--mixed_precision", "no", "--dynamo_backend", "no"),
    "--multi_gpu",
)


@dataclass(frozen=True)
class Flags:
    """Flags that the command line adds to a suite; `processes` share each run."""

    device: str = "auto"
    batch_size: int | None = None
    seed: int = 0
    limit: int | None = None
    latency_samples: int | None = None
    processes: int = 1


@dataclass(frozen=True)
class Unit:
    """One candidate on one data set. `configurations` are those that can be run, `failed` the
    reasons for the others.
    """

    suite: Suite
    part: Part
    candidate: Candidate
    data: BenchData
    folder: Path
    configurations: tuple[str, ...]
    failed: dict[str, str]
    adapter: Path | None
    flags: Flags

    @property
    def name(self) -> str:
        return f"{self.part.name}, {self.candidate.name}"

    @property
    def latency_samples(self) -> int:
        """Samples whose queries are timed."""
        asked = (self.flags.latency_samples, self.part.latency_samples, 50)
        return min(next(one for one in asked if one is not None), len(self.data.samples))

    def arguments(self) -> list[str]:
        """The arguments of `plannerft` that run this unit, also alone."""
        folder, named = self.candidate.folder, self.candidate.name
        values: dict[str, Any] = {
            "level": self.part.level,
            "candidates": folder if self.candidate.source == "path" else named,
            "configurations": ",".join(self.configurations),
            "data": self.part.data,
            "out": self.folder,
            "adapter": self.adapter,
            "limit": _limit(self.part, self.flags),
            "latency-samples": self.latency_samples,
            "max-new-tokens": self.part.max_new_tokens,
            "planning-samples": self.part.planning_samples,
            "vocabulary": self.suite.vocabulary,
            "quantization": self.suite.quantization,
            "device": self.flags.device,
            "batch-size": self.flags.batch_size or "auto",
            "seed": self.flags.seed,
        }
        given = [(f"--{name}", str(value)) for name, value in values.items() if value is not None]
        return ["bench", *(text for pair in given for text in pair), "--resume", "--no-report"]

    def fingerprint(self, vocabulary: Vocabulary) -> dict[str, Any]:
        """Everything that the figures of this unit depend on, apart from the code that scores."""
        return {
            "arguments": [text for text in self.arguments() if text != str(self.folder)],
            "data": self.data.sha256,
            "model": weights_sha256(require_folder(self.candidate)),
            "adapter": sha256_tree(self.adapter, (WEIGHTS, CONFIG)) if self.adapter else None,
            "vocabulary": vocabulary.sha256,
            "prompt format": PROMPT_VERSION,
        }

    def finished(self, vocabulary: Vocabulary) -> bool:
        """Whether an earlier session finished exactly this unit."""
        if not all((self.folder / name).is_file() for name in (UNIT, RESULTS)):
            return False
        recorded = read_json(self.folder / UNIT).get("fingerprint")
        return bool(recorded == self.fingerprint(vocabulary))

    def finish(self, vocabulary: Vocabulary, seconds: float) -> None:
        """Note that the unit is finished."""
        recorded = {"fingerprint": self.fingerprint(vocabulary), "seconds": round(seconds, 1)}
        write_json(self.folder / UNIT, recorded)


def make_units(suite: Suite, vocabulary: Vocabulary, out: Path, flags: Flags) -> list[Unit]:
    """Every candidate on every data set, a candidate's after one another. Raises PlannerError for
    problems that no run could start with.
    """
    data = {
        part.name: load_bench_data(part.data, part.level, vocabulary, _limit(part, flags))
        for part in suite.parts
    }
    candidates: dict[str, Candidate] = {}
    for name in suite.candidates:
        # A folder relative to the suite file, else a name or a hub id.
        folder = suite.path.parent / name
        candidate = resolve_candidate(str(folder) if folder.is_dir() else name)
        if candidate.slug in candidates:
            way = "leave one out, or rename its folder"
            raise PlannerError(f"{suite.path}: two candidates are named {candidate.slug}; {way}")
        candidates[candidate.slug] = candidate
    units = []
    for slug, candidate in candidates.items():
        for part in suite.parts:
            adapter, failed = _adapter(suite, part, candidate, vocabulary)
            runs = tuple(name for name in part.configurations if name not in failed)
            where, samples = out / part.name / slug, data[part.name]
            units.append(Unit(suite, part, candidate, samples, where, runs, failed, adapter, flags))
    return units


def _limit(part: Part, flags: Flags) -> int | None:
    return min((one for one in (part.limit, flags.limit) if one is not None), default=None)


def _adapter(
    suite: Suite, part: Part, candidate: Candidate, vocabulary: Vocabulary
) -> tuple[Path | None, dict[str, str]]:
    """The adapter of a candidate, if a configuration needs it, and why configurations cannot be
    run.
    """
    needs = [name for name in part.configurations if parse_configuration(name).adapter]
    concerned: list[str] = list(part.configurations)
    try:
        require_folder(candidate)
        if not needs:
            return None, {}
        concerned = needs
        given = suite.adapters.get(candidate.name, {}).get(part.level)
        usual = adapter_folder(candidate, part.level)
        adapter = given or find_adapter(candidate, part.level) or usual
        check_adapter(adapter, candidate, level=part.level, vocabulary=vocabulary)
    except PlannerError as error:
        return None, dict.fromkeys(concerned, str(error))
    return adapter, {}


class Process:
    """The process of a running unit: the same command line, ended with its parent, its output kept
    in a log. Leaving the `with` block ends it if it has not ended itself.
    """

    def __init__(self, arguments: list[str], log: Path, processes: int = 1) -> None:
        self.log = log
        log.parent.mkdir(parents=True, exist_ok=True)
        with open(log, "wb") as stream:
            self.child = subprocess.Popen(
                command(arguments, processes),
                stdin=subprocess.DEVNULL,
                stdout=stream,
                stderr=subprocess.STDOUT,
                preexec_fn=end_with_parent,
            )

    def running(self) -> bool:
        return self.child.poll() is None

    def end(self) -> None:
        """End it: politely, then for good."""
        self.child.terminate()
        try:
            self.child.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self.child.kill()
            self.child.wait()

    def problem(self) -> str | None:
        """Why it failed, in one line: the sentence with which a command refused, else its last
        line; None when it did not.
        """
        code = self.child.wait()
        if code == 0:
            return None
        if code < 0:
            hint = ", most likely for want of memory" if -code == signal.SIGKILL else ""
            return f"its process was ended by {signal.Signals(-code).name}{hint}"
        text = self.log.read_text(encoding="utf-8", errors="replace")
        lines = [line.strip() for line in text.splitlines() if line.strip()]
        ours = [line for line in lines if line.startswith("plannerft: ")] or lines
        return ours[-1].removeprefix("plannerft: ") if ours else f"its process ended with {code}"

    def __enter__(self) -> Process:
        return self

    def __exit__(self, *_: object) -> None:
        if self.running():
            self.end()


def command(arguments: list[str], processes: int = 1) -> list[str]:
    """The command of a unit; with several processes, accelerate starts them."""
    launcher = ["-m", "accelerate.commands.launch", "--num_processes", str(processes), *LAUNCH]
    shared = launcher if processes > 1 else []
    return [sys.executable, *shared, "-m", "planner_ft", *arguments]
