"""Reading the folders of runs, whatever of them is there: old runs, scored predictions and runs
without timed queries give a report, too.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from planner_ft.benchmark.folder import BASELINES, PREDICTIONS, RESULTS, RUN, SCORES
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import iterate_jsonl, read_json, sha256_file
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level, check_level

Record = dict[str, Any]
DEEPEST = 3
"""How far below a folder its runs are looked for (a suite has one folder per level, data set and
candidate).
"""


@dataclass(frozen=True)
class System:
    """One row of a run: a candidate in a configuration, with its scores and answers by sample id.
    `name` tells it from all others.

    Where a system answered several times, `repeats` has all scores and `answers` the first answers.
    `jobs` are what the run's answers depend on (digests of model, adapter, data ...), by job name.
    `alias` is the candidate, told from that of other runs where several have the same row.
    """

    name: str
    run: Path
    row: Record
    repeats: dict[str, list[Record]] = field(default_factory=dict)
    answers: dict[str, Record] = field(default_factory=dict)
    jobs: dict[str, Any] = field(default_factory=dict)
    alias: str = ""

    @functools.cached_property
    def scores(self) -> dict[str, Record]:
        """The score of the first answer to each sample."""
        return {name: lines[0] for name, lines in self.repeats.items()}

    @property
    def is_baseline(self) -> bool:
        """Whether it is no candidate but something that a candidate must beat."""
        return bool(self.row.get("is_baseline"))

    def metric(self, name: str) -> Record:
        """Value and bounds of a metric, None where it was not measured."""
        found = self.row.get("metrics", {}).get(name)
        return found if isinstance(found, dict) else {"value": None, "low": None, "high": None}


@dataclass(frozen=True)
class TestSet:
    """What was measured on the same data: systems of one or more runs. `samples` is empty where the
    data is not there any more.
    """

    __test__ = False

    level: Level
    path: str
    sha256: str
    n: int
    vocabulary: Vocabulary | None
    systems: tuple[System, ...]
    results: tuple[Record, ...]
    samples: dict[str, Record]
    notes: tuple[str, ...]

    @property
    def candidates(self) -> tuple[System, ...]:
        """The systems without the baselines."""
        return tuple(system for system in self.systems if not system.is_baseline)

    @property
    def title(self) -> str:
        """Level and data in words."""
        return f"{self.level.capitalize()} level, {self.n} samples of {Path(self.path).name}"

    @property
    def key(self) -> str:
        """A short name for files and anchors."""
        stem = "".join(letter if letter.isalnum() else "-" for letter in Path(self.path).stem)
        return f"{self.level}-{stem}-{self.sha256[:6]}"


@dataclass(frozen=True)
class _Run:
    folder: Path
    results: Record
    scores: list[Record]
    answers: list[Record]
    notes: list[str]


def load_test_sets(folders: Sequence[Path], data: Sequence[Path] = ()) -> list[TestSet]:
    """The runs in these folders (or in folders below them), grouped by the data that they were
    measured on.

    `data` are files to look for test data in beside the path that a run names; only a file with the
    recorded SHA-256 is used. Raises PlannerError for a folder without results and for damaged
    files.
    """
    runs = [_load(folder) for folder in _run_folders(folders)]
    groups: dict[tuple[str, str, int, str], list[_Run]] = {}
    for run in runs:
        found = run.results["data"]
        # The same file with --limit is another test set: its figures are not of the same samples.
        groups.setdefault(
            (
                run.results["level"],
                found.get("sha256", ""),
                found.get("n", 0),
                _vocabulary_name(run),
            ),
            [],
        ).append(run)
    return [_test_set(members, data) for members in groups.values()]


def _run_folders(folders: Sequence[Path]) -> list[Path]:
    found: list[Path] = []
    for folder in folders:
        below = list(_below(folder, DEEPEST))
        if not below:
            raise PlannerError(
                f"{folder}: no {RESULTS} in it or below it; give the folder of a finished"
                " `plannerft bench` or of `plannerft score --out`"
            )
        found += below
    return list(dict.fromkeys(found))


def _below(folder: Path, depth: int) -> Iterator[Path]:
    if (folder / RESULTS).is_file() and not _is_overview(folder / RESULTS):
        yield folder
    elif depth and folder.is_dir():
        for child in sorted(
            folder.iterdir(),
            key=lambda child: (_order(folder).get(child.name, math.inf), child.name),
        ):
            if child.is_dir() and not child.is_symlink():
                yield from _below(child, depth - 1)


def _order(folder: Path) -> dict[str, int]:
    """The data sets of a suite by its own order: the published sizes stand before what is reported
    apart.
    """
    path = folder / RESULTS
    parts = read_json(path)["parts"] if path.is_file() and _is_overview(path) else []
    return {
        str(part.get("name")): number for number, part in enumerate(parts) if isinstance(part, dict)
    }


def _is_overview(path: Path) -> bool:
    """Whether it sums up a suite, whose results lie in a folder for each data set."""
    results = read_json(path)
    return (
        isinstance(results, dict)
        and "rows" not in results
        and isinstance(results.get("parts"), list)
    )


def _load(folder: Path) -> _Run:
    path = folder / RESULTS
    results = read_json(path)
    if (
        not isinstance(results, dict)
        or not isinstance(results.get("rows"), list)
        or not isinstance(results.get("data"), dict)
    ):
        raise PlannerError(
            f"{path}: no results of a run (an object with level, data and rows is expected)"
        )
    check_level(results.get("level", ""))
    notes: list[str] = []
    scores = [
        line
        for name in (SCORES, BASELINES)
        if (folder / name).is_file()
        for line in _lines(folder / name)
    ]
    if not (folder / SCORES).is_file():
        notes.append(
            f"{folder / SCORES} is not there: failures, confusions and single samples cannot be"
            " shown."
        )
    return _Run(folder, results, scores, _answers(folder, results, notes), notes)


def _answers(folder: Path, results: Record, notes: list[str]) -> list[Record]:
    """The predictions of a run: its own, those of a suite's candidates, or the file that `plannerft
    score` read, if it is still the same.
    """
    named = results.get("manifest", {}).get("inputs", {}).get("predictions", {})
    paths = (
        [folder / PREDICTIONS]
        if (folder / PREDICTIONS).is_file()
        else sorted(folder.glob(f"*/{PREDICTIONS}"))
    )
    if not paths and named.get("path"):
        paths = [Path(named["path"])]
        if paths[0].is_file() and sha256_file(paths[0]) != named.get("sha256"):
            notes.append(f"{paths[0]} has changed since it was scored: answers are not shown.")
            return []
    if not any(path.is_file() for path in paths):
        notes.append(
            f"{paths[0] if paths else folder / PREDICTIONS} is not there: answers are not shown."
        )
    return [line for path in paths if path.is_file() for line in _lines(path)]


def _lines(path: Path) -> list[Record]:
    records = []
    for number, value, problem in iterate_jsonl(path):
        if problem or not isinstance(value, dict):
            raise PlannerError(f"{path}:{number}: {problem or 'a JSON object is expected'}")
        records.append(value)
    return records


def _vocabulary_name(run: _Run) -> str:
    """The vocabulary's file where the run names one, else its name."""
    name = (
        run.results.get("manifest", {})
        .get("configuration", {})
        .get("vocabulary", {})
        .get("name", "")
    )
    record = read_json(run.folder / RUN) if (run.folder / RUN).is_file() else {}
    return str(record.get("settings", {}).get("vocabulary") or name)


def _test_set(runs: list[_Run], data: Sequence[Path]) -> TestSet:
    first = runs[0].results
    notes = [note for run in runs for note in run.notes]
    samples = _samples(
        [Path(first["data"].get("path", "")), *data], first["data"].get("sha256", ""), notes
    )
    systems = _systems(runs)
    if samples:
        scored = {name for system in systems for name in system.scores}
        samples = {name: record for name, record in samples.items() if not scored or name in scored}
    return TestSet(
        first["level"],
        str(first["data"].get("path", "")),
        str(first["data"].get("sha256", "")),
        int(first["data"].get("n", 0)),
        _vocabulary(_vocabulary_name(runs[0]), notes),
        tuple(systems),
        tuple(run.results for run in runs),
        samples,
        tuple(dict.fromkeys(notes)),
    )


def _samples(paths: Iterable[Path], sha256: str, notes: list[str]) -> dict[str, Record]:
    """The test samples by id, from the first of the files that has the digest."""
    first: Path | None = None
    for path in paths:
        first = first or path
        if path.is_file() and sha256_file(path) == sha256:
            return {str(line.get("id")): line for line in _lines(path)}
    state = "has changed since the run" if first and first.is_file() else "is not there"
    notes.append(
        f"{first} {state}: commands and expected plans are not shown (give the file with --data)."
    )
    return {}


def _vocabulary(name: str, notes: list[str]) -> Vocabulary | None:
    try:
        return load_vocabulary(name)
    except PlannerError:
        notes.append(
            f"The vocabulary {name or '(not named)'} is not there: plans are compared without its"
            " parameter types."
        )
        return None


def _systems(runs: list[_Run]) -> list[System]:
    """The rows of all runs, baselines once and last."""
    folders = [run.folder for run in runs]
    rows = [(run, row) for run in runs for row in run.results["rows"]]
    labels = [_label(row) for _run, row in rows]
    baselines = {
        _label(row): (run, row)
        for run in reversed(runs)
        for row in run.results.get("baselines", [])
    }
    systems = []
    for run, row in [*rows, *reversed(baselines.values())]:
        key, label = (str(row.get("candidate")), str(row.get("configuration"))), _label(row)
        told = f" ({_tail(run.folder, folders)})" if labels.count(label) > 1 else ""
        scores, answers = (
            _all_by_system(run.scores).get(key, {}),
            _by_system(run.answers).get(key) or _nameless(run),
        )
        systems.append(
            System(
                f"{label}{told}", run.folder, row, scores, answers, _jobs(run), f"{key[0]}{told}"
            )
        )
    return systems


def _jobs(run: _Run) -> dict[str, Any]:
    """The jobs of the manifest; for predictions that were scored again, those of the run that made
    them.
    """
    named = run.results.get("manifest", {}).get("inputs", {}).get("predictions", {}).get("path")
    folders = [
        run.folder,
        *(path.parent for path in sorted(run.folder.glob(f"*/{RUN}"))),
        *([Path(named).parent] if named else []),
    ]
    found: dict[str, Any] = dict(run.results.get("manifest", {}).get("jobs") or {})
    for path in (folder / RUN for folder in folders if not found or folder != run.folder):
        found |= read_json(path).get("jobs", {}) if path.is_file() else {}
    return found


def _label(row: Record) -> str:
    from planner_ft.benchmark.layout import heading

    label, configuration = (
        str(row.get("label") or row.get("candidate")),
        str(row.get("configuration")),
    )
    return (
        label
        if row.get("is_baseline") or configuration == "submitted"
        else f"{label}, {heading(configuration)}"
    )


def _all_by_system(lines: Iterable[Record]) -> dict[tuple[str, str], dict[str, list[Record]]]:
    """Lines by candidate and configuration, then by sample: several where a sample was repeated."""
    found: dict[tuple[str, str], dict[str, list[Record]]] = {}
    for line in lines:
        found.setdefault(
            (str(line.get("candidate")), str(line.get("configuration"))), {}
        ).setdefault(str(line.get("id")), []).append(line)
    return found


def _by_system(lines: Iterable[Record]) -> dict[tuple[str, str], dict[str, Record]]:
    """Like `_all_by_system`, with the first line of each sample."""
    return {
        key: {name: of_sample[0] for name, of_sample in found.items()}
        for key, found in _all_by_system(lines).items()
    }


def _nameless(run: _Run) -> dict[str, Record]:
    """Answers that name no candidate or configuration belong to the only row that can have made
    them.
    """
    rest = [lines for key, lines in _by_system(run.answers).items() if "None" in key]
    return rest[0] if len(run.results["rows"]) == len(rest) == 1 else {}


def _tail(folder: Path, others: list[Path]) -> str:
    """The last parts of a path that tell it from the others."""
    for count in range(1, len(folder.parts) + 1):
        tail = folder.parts[-count:]
        if sum(other.parts[-count:] == tail for other in others) == 1:
            return "/".join(tail)
    return str(folder)
