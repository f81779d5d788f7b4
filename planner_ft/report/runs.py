"""Reading the folders of runs, whatever of them is there: old runs and scored predictions, too."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from planner_ft.benchmark.folder import BASELINES, PREDICTIONS, RESULTS, RUN, SCORES
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import iterate_jsonl, read_json, sha256_file
from planner_ft.support.tables import RowKind
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level, check_level

Record = dict[str, Any]
Key = tuple[str, str]
"""Candidate and configuration."""
Lines = dict[Key, dict[str, list[Record]]]
"""Lines by system, then by sample: several where a sample was repeated."""
DEEPEST = 3  # levels of folders below one: a suite has level, data set and candidate


@dataclass(frozen=True)
class System:
    """One row of a run: a candidate in a configuration, with its scores and answers by sample id.

    `name` is its own alone; `alias` is the candidate, marked where several runs have the same row.
    `repeats` has all scores, `answers` the first ones. `jobs` are the digests (of model, adapter,
    data ...) that the answers depend on, by job name.
    """

    name: str
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

    @property
    def kind(self) -> RowKind:
        """The kind of its rows in tables."""
        return "baseline" if self.is_baseline else "measured"

    @property
    def configuration(self) -> str:
        """Its configuration, such as lora+grounded."""
        return str(self.row.get("configuration"))

    def metric(self, name: str) -> Record:
        """Value and bounds of a metric, None where it was not measured."""
        found = self.row.get("metrics", {}).get(name)
        return found if isinstance(found, dict) else {"value": None, "low": None, "high": None}


@dataclass(frozen=True)
class TestSet:
    """Systems measured on the same data; `samples` is empty where the data is gone."""

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
    scores: Lines
    answers: Lines
    notes: list[str]

    @property
    def predictions(self) -> Record:
        """Path and digest of the file that `plannerft score` read."""
        return dict(within(self.results, "manifest", "inputs", "predictions"))

    @property
    def vocabulary(self) -> str:
        """The vocabulary's file where the run names one, else its name."""
        file = within(_optional(self.folder / RUN), "settings", "vocabulary")
        return str(
            file or within(self.results, "manifest", "configuration", "vocabulary", "name") or ""
        )


def within(record: Any, *keys: str) -> Any:
    """The value below these keys, {} where one is missing."""
    for key in keys:
        record = record.get(key, {})
    return record


def load_test_sets(folders: Sequence[Path], data: Sequence[Path] = ()) -> list[TestSet]:
    """The runs in these folders (or below them), grouped by the data that they were measured on.

    `data` are files to look for test data in beside the path that a run names; only one with the
    recorded SHA-256 is used. Raises PlannerError for a folder without results and damaged files.
    """
    groups: dict[tuple[str, str, int, str], list[_Run]] = {}
    for run in map(_load, _run_folders(folders)):
        found, level = run.results["data"], run.results["level"]
        # The same file with --limit is another test set: its figures are not of the same samples.
        key = (level, found.get("sha256", ""), found.get("n", 0), run.vocabulary)
        groups.setdefault(key, []).append(run)
    return [_test_set(members, data) for members in groups.values()]


def _run_folders(folders: Sequence[Path]) -> list[Path]:
    found: list[Path] = []
    for folder in folders:
        below = list(_below(folder, DEEPEST))
        if not below:
            way = "give the folder of a finished `plannerft bench` or of `plannerft score --out`"
            raise PlannerError(f"{folder}: no {RESULTS} in it or below it; {way}")
        found += below
    return list(dict.fromkeys(found))


def _below(folder: Path, depth: int) -> Iterator[Path]:
    """Folders of runs; the data sets of a suite in its own order."""
    parts = _parts(folder / RESULTS)
    if parts is None:
        yield folder
    elif depth and folder.is_dir():
        children = [child for child in folder.iterdir() if child.is_dir()]
        order = {name: number for number, name in enumerate(parts)}
        for child in sorted(children, key=lambda one: (order.get(one.name, len(order)), one.name)):
            if not child.is_symlink():
                yield from _below(child, depth - 1)


def _parts(path: Path) -> list[str] | None:
    """The data sets of a suite in its results.json, if any; None for the results of a run."""
    results = read_json(path) if path.is_file() else {"parts": []}
    if not isinstance(results, dict) or "rows" in results:
        return None
    parts = results.get("parts")
    if not isinstance(parts, list):
        return None
    return [str(part.get("name")) for part in parts if isinstance(part, dict)]


def _load(folder: Path) -> _Run:
    results = read_json(folder / RESULTS)
    fits = isinstance(results, dict) and isinstance(results.get("rows"), list)
    if not fits or not isinstance(results.get("data"), dict):
        expected = "an object with level, data and rows is expected"
        raise PlannerError(f"{folder / RESULTS}: no results of a run ({expected})")
    check_level(results.get("level", ""))
    run = _Run(folder, results, {}, {}, [])
    paths = [folder / name for name in (SCORES, BASELINES)]
    run.scores.update(_lines([path for path in paths if path.is_file()]))
    if not paths[0].is_file():
        what = "failures, confusions and single samples cannot be shown"
        run.notes.append(f"{paths[0]} is not there: {what}.")
    run.answers.update(_lines(_answer_files(run)))
    return run


def _answer_files(run: _Run) -> list[Path]:
    """The predictions of a run, of a suite's candidates, or the scored file if it is unchanged."""
    own, named = run.folder / PREDICTIONS, run.predictions
    paths = [own] if own.is_file() else sorted(run.folder.glob(f"*/{PREDICTIONS}"))
    if not paths and named.get("path"):
        own = Path(named["path"])
        paths = [own] if own.is_file() else []
        if paths and sha256_file(own) != named.get("sha256"):
            run.notes.append(f"{own} has changed since it was scored: answers are not shown.")
            return []
    if not paths:
        run.notes.append(f"{own} is not there: answers are not shown.")
    return paths


def _records(path: Path) -> Iterator[Record]:
    for number, value, problem in iterate_jsonl(path):
        if problem or not isinstance(value, dict):
            raise PlannerError(f"{path}:{number}: {problem or 'a JSON object is expected'}")
        yield value


def _lines(paths: Iterable[Path]) -> Lines:
    found: Lines = {}
    for path in paths:
        for line in _records(path):
            of_system = found.setdefault(key_of(line), {})
            of_system.setdefault(str(line.get("id")), []).append(line)
    return found


def key_of(line: Record) -> Key:
    """The system of a row, a score or an answer."""
    return str(line.get("candidate")), str(line.get("configuration"))


def _optional(path: Path) -> Record:
    found: Record = read_json(path) if path.is_file() else {}
    return found


def _test_set(runs: list[_Run], data: Sequence[Path]) -> TestSet:
    first = runs[0].results
    found, notes = first["data"], [note for run in runs for note in run.notes]
    path, sha256 = str(found.get("path", "")), str(found.get("sha256", ""))
    samples = _samples([Path(path), *data], sha256, notes)
    systems = tuple(_systems(runs))
    scored = {name for system in systems for name in system.scores}
    samples = {name: record for name, record in samples.items() if not scored or name in scored}
    vocabulary = _vocabulary(runs[0].vocabulary, notes)
    results = tuple(run.results for run in runs)
    count, said = int(found.get("n", 0)), tuple(dict.fromkeys(notes))
    return TestSet(first["level"], path, sha256, count, vocabulary, systems, results, samples, said)


def _samples(paths: Sequence[Path], sha256: str, notes: list[str]) -> dict[str, Record]:
    """The test samples by id, from the first of the files that has the digest."""
    for path in paths:
        if path.is_file() and sha256_file(path) == sha256:
            return {str(line.get("id")): line for line in _records(path)}
    state = "has changed since the run" if paths[0].is_file() else "is not there"
    what = "commands and expected plans are not shown"
    notes.append(f"{paths[0]} {state}: {what} (give the file with --data).")
    return {}


def _vocabulary(name: str, notes: list[str]) -> Vocabulary | None:
    try:
        return load_vocabulary(name)
    except PlannerError:
        what = "plans are compared without its parameter types"
        notes.append(f"The vocabulary {name or '(not named)'} is not there: {what}.")
        return None


def _systems(runs: list[_Run]) -> Iterator[System]:
    """The rows of all runs, baselines once and last."""
    folders = [run.folder for run in runs]
    rows = [(run, row) for run in runs for row in run.results["rows"]]
    labels = [_label(row) for _run, row in rows]
    beside = [(run, row) for run in reversed(runs) for row in run.results.get("baselines", [])]
    baselines = {_label(row): (run, row) for run, row in beside}
    for run, row in [*rows, *reversed(baselines.values())]:
        key, label = key_of(row), _label(row)
        place = f" ({_tail(run.folder, folders)})" if labels.count(label) > 1 else ""
        answers = run.answers.get(key) or _nameless(run)
        first = {name: lines[0] for name, lines in answers.items()}
        known = row, run.scores.get(key, {}), first, _jobs(run)
        yield System(f"{label}{place}", *known, f"{key[0]}{place}")


def _jobs(run: _Run) -> dict[str, Any]:
    """The jobs of the manifest, or of the run that made predictions which were scored again."""
    found: dict[str, Any] = dict(within(run.results, "manifest", "jobs") or {})
    paths = [] if found else [run.folder / RUN]
    paths += sorted(run.folder.glob(f"*/{RUN}"))
    if run.predictions.get("path"):
        paths.append(Path(run.predictions["path"]).parent / RUN)
    for path in paths:
        found |= _optional(path).get("jobs", {})
    return found


def _label(row: Record) -> str:
    from planner_ft.benchmark.results import heading

    label, configuration = str(row.get("label") or row.get("candidate")), key_of(row)[1]
    plain = row.get("is_baseline") or configuration == "submitted"
    return label if plain else f"{label}, {heading(configuration)}"


def _nameless(run: _Run) -> dict[str, list[Record]]:
    """Answers without candidate or configuration are those of a run's only row."""
    rest = [lines for key, lines in run.answers.items() if "None" in key]
    return rest[0] if len(run.results["rows"]) == len(rest) == 1 else {}


def _tail(folder: Path, others: list[Path]) -> str:
    """The last parts of a path that tell it from the others."""
    for count in range(1, len(folder.parts) + 1):
        tail = folder.parts[-count:]
        if sum(other.parts[-count:] == tail for other in others) == 1:
            return "/".join(tail)
    return str(folder)
