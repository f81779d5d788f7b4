"""The units of a suite: one candidate on one data set, each a process and a run folder of its
own.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.benchmark.folder import LATENCY, PLANNING, PREDICTIONS, RESULTS
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
from planner_ft.vocabulary import Vocabulary

UNIT = "unit.json"


@dataclass(frozen=True)
class Flags:
    """What the command line adds to a suite; `processes` share each run."""

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

    part: Part
    candidate: Candidate
    data: BenchData
    folder: Path
    configurations: tuple[str, ...]
    failed: dict[str, str]
    adapter: Path | None
    flags: Flags
    vocabulary: str
    quantization: str | None

    @property
    def name(self) -> str:
        return f"{self.part.name}, {self.candidate.name}"

    @property
    def latency_samples(self) -> int:
        """Samples whose queries are timed."""
        asked = (
            self.part.latency_samples
            if self.flags.latency_samples is None
            else self.flags.latency_samples
        )
        return min(50 if asked is None else asked, len(self.data.samples))

    def arguments(self) -> list[str]:
        """The arguments of `plannerft` that run this unit: whoever wants to can run it alone with
        them.
        """
        values: dict[str, Any] = {
            "level": self.part.level,
            "candidates": self.candidate.folder
            if self.candidate.source == "path"
            else self.candidate.name,
            "configurations": ",".join(self.configurations),
            "data": self.part.data,
            "out": self.folder,
            "adapter": self.adapter,
            "limit": _smaller(self.part.limit, self.flags.limit),
            "latency-samples": self.latency_samples,
            "max-new-tokens": self.part.max_new_tokens,
            "planning-samples": self.part.planning_samples,
            "vocabulary": self.vocabulary,
            "quantization": self.quantization,
            "device": self.flags.device,
            "batch-size": self.flags.batch_size or "auto",
            "seed": self.flags.seed,
        }
        return [
            "bench",
            *(
                str(item)
                for name, value in values.items()
                if value is not None
                for item in (f"--{name}", value)
            ),
            "--resume",
            "--no-report",
        ]

    def fingerprint(self, vocabulary: Vocabulary) -> dict[str, Any]:
        """Everything that the figures of this unit depend on, apart from the code that scores."""
        folder = require_folder(self.candidate)
        return {
            "arguments": [text for text in self.arguments() if text != str(self.folder)],
            "data": self.data.sha256,
            "model": weights_sha256(folder),
            "adapter": sha256_tree(self.adapter, (WEIGHTS, CONFIG)) if self.adapter else None,
            "vocabulary": vocabulary.sha256,
            "prompt format": PROMPT_VERSION,
        }

    def finished(self, vocabulary: Vocabulary) -> bool:
        """Whether an earlier session finished exactly this unit."""
        if not (self.folder / UNIT).is_file() or not (self.folder / RESULTS).is_file():
            return False
        return bool(
            read_json(self.folder / UNIT).get("fingerprint") == self.fingerprint(vocabulary)
        )

    def finish(self, vocabulary: Vocabulary, seconds: float) -> None:
        """Note that the unit is finished."""
        write_json(
            self.folder / UNIT,
            {"fingerprint": self.fingerprint(vocabulary), "seconds": round(seconds, 1)},
        )

    def progress(self) -> Written:
        """What the unit's process has written so far."""
        return Written([PREDICTIONS, LATENCY, PLANNING], self.folder)


class Written:
    """Reads the records of a run folder as they are written, each once."""

    def __init__(self, names: list[str], folder: Path) -> None:
        self.offsets = {folder / name: 0 for name in names}

    def new(self) -> list[tuple[str, dict[str, Any]]]:
        """(file name, record) of the whole lines that were written since the last call."""
        found = []
        for path, offset in self.offsets.items():
            if not path.is_file():
                continue
            with open(path, "rb") as stream:
                stream.seek(offset)
                text = stream.read()
            whole = text[: text.rfind(b"\n") + 1]
            self.offsets[path] += len(whole)
            found += [
                (path.name, record) for line in whole.splitlines() for record in _record(line)
            ]
        return found


def _record(line: bytes) -> list[dict[str, Any]]:
    try:
        record = json.loads(line)
    except ValueError:
        return []
    return [record] if isinstance(record, dict) else []


def make_units(suite: Suite, vocabulary: Vocabulary, out: Path, flags: Flags) -> list[Unit]:
    """Every candidate on every data set, a candidate's after one another. Raises PlannerError for
    what no run could start with.
    """
    data = {
        part.name: load_bench_data(
            part.data, part.level, vocabulary, _smaller(part.limit, flags.limit)
        )
        for part in suite.parts
    }
    candidates = [resolve_candidate(_path(suite, name)) for name in suite.candidates]
    slugs = [candidate.slug for candidate in candidates]
    double = next((slug for slug in slugs if slugs.count(slug) > 1), None)
    if double:
        raise PlannerError(
            f"{suite.path}: two candidates are named {double}; leave one out, or rename its folder"
        )
    return [
        _unit(suite, part, candidate, data[part.name], vocabulary, out, flags)
        for candidate in candidates
        for part in suite.parts
    ]


def _path(suite: Suite, name: str) -> str:
    """A folder relative to the suite file, else the name as it is (a hub id)."""
    return str(suite.path.parent / name) if (suite.path.parent / name).is_dir() else name


def _unit(
    suite: Suite,
    part: Part,
    candidate: Candidate,
    data: BenchData,
    vocabulary: Vocabulary,
    out: Path,
    flags: Flags,
) -> Unit:
    needs = {name for name in part.configurations if parse_configuration(name).adapter}
    adapter, failed = None, {}
    try:
        require_folder(candidate)
    except PlannerError as error:
        failed = dict.fromkeys(part.configurations, str(error))
    if needs and not failed:
        given = (suite.adapters or {}).get(candidate.name, {}).get(part.level)
        adapter = (
            given or find_adapter(candidate, part.level) or adapter_folder(candidate, part.level)
        )
        try:
            check_adapter(adapter, candidate, level=part.level, vocabulary=vocabulary)
        except PlannerError as error:
            adapter, failed = None, dict.fromkeys(needs, str(error))
    runs = tuple(name for name in part.configurations if name not in failed)
    folder = out / part.name / candidate.slug
    return Unit(
        part,
        candidate,
        data,
        folder,
        runs,
        failed,
        adapter,
        flags,
        suite.vocabulary,
        suite.quantization,
    )


def _smaller(first: int | None, second: int | None) -> int | None:
    return min((value for value in (first, second) if value is not None), default=None)
