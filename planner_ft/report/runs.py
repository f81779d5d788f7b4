"""Reading the folders of runs, whatever of them is there: old runs and scored predictions, too."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from planner_ft.benchmark.contrasts import by_system, system_key
from planner_ft.benchmark.folder import PREDICTIONS, RESULTS, RUN, SCORES, read_results
from planner_ft.benchmark.results import Results, Row
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, read_jsonl, sha256_file
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level

Record = dict[str, Any]
Answers = dict[str, dict[str, Record]]
"""The first answers by system ("candidate configuration"), then by sample."""
DEEPEST = 3  # levels of folders below one: a suite has level, data set and candidate


@dataclass(frozen=True)
class Run:
    """A folder of results: `record` is results.json as it is, `adapters` are digests by system."""

    folder: Path
    results: Results
    record: Record
    answers: Answers
    adapters: dict[str, str]
    notes: tuple[str, ...]

    @property
    def vocabulary(self) -> str:
        """The vocabulary's file where the run names one, else its name."""
        named = within(self.record, "manifest", "configuration", "vocabulary", "name")
        return str(within(_optional(self.folder / RUN), "settings", "vocabulary") or named or "")

    def renamed(self, ending: str) -> Run:
        """The run with an ending behind the names of its candidates."""

        def named(row: Row) -> Row:
            return replace(row, label=row.label + ending, candidate=row.candidate + ending)

        def of_systems(values: dict[str, Any]) -> dict[str, Any]:
            parts = ((*key.rpartition(" ")[::2], value) for key, value in values.items())
            return {f"{name}{ending} {configuration}": one for name, configuration, one in parts}

        every = self.results.scores
        scores = tuple({**line, "candidate": f"{line['candidate']}{ending}"} for line in every)
        results = replace(self.results, rows=tuple(map(named, self.results.rows)), scores=scores)
        answers, adapters = of_systems(self.answers), of_systems(self.adapters)
        return replace(self, results=results, answers=answers, adapters=adapters)


@dataclass(frozen=True)
class TestSet:
    """Systems on the same data, each with a name of its own; without `samples` if it is gone."""

    __test__ = False

    level: Level
    path: str
    sha256: str
    n: int
    results: Results
    runs: tuple[Run, ...]
    vocabulary: Vocabulary | None
    samples: dict[str, Record]
    answers: Answers
    adapters: dict[str, str]
    notes: tuple[str, ...]

    @property
    def title(self) -> str:
        """Level and data in words."""
        return f"{self.level.capitalize()} level, {self.n} samples of {Path(self.path).name}"

    @property
    def key(self) -> str:
        """A short name for files and anchors."""
        stem = "".join(letter if letter.isalnum() else "-" for letter in Path(self.path).stem)
        return f"{self.level}-{stem}-{self.sha256[:6]}"

    @property
    def beside(self) -> bool:
        """Whether the data is the level's test split: published figures compare with no other."""
        return Path(self.path).stem == "test"

    @functools.cached_property
    def scores(self) -> Answers:
        """The score of the first answer to each sample, by system."""
        every = by_system([*self.results.scores, *self.results.baseline_scores])
        return {
            system_key(system): {name: dict(found[0]) for name, found in of_system.items()}
            for system, of_system in every.items()
        }


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
    found = {folder: list(_below(folder, DEEPEST)) for folder in folders}
    for folder in (folder for folder, below in found.items() if not below):
        way = "give the folder of a finished `plannerft bench` or of `plannerft score --out`"
        raise PlannerError(f"{folder}: no {RESULTS} in it or below it; {way}")
    groups: dict[tuple[str, str, int, str], list[Run]] = {}
    for run in map(_load, dict.fromkeys(one for below in found.values() for one in below)):
        about = run.results.data
        # The same file with --limit is another test set: its figures are not of the same samples.
        key = (run.results.level, about.get("sha256", ""), about.get("n", 0), run.vocabulary)
        groups.setdefault(key, []).append(run)
    return [_test_set(members, data) for members in groups.values()]


def _below(folder: Path, depth: int) -> Iterator[Path]:
    """Folders of runs; the data sets of a suite in its own order."""
    path = folder / RESULTS
    results = read_json(path) if path.is_file() else {"parts": []}
    parts = results.get("parts") if isinstance(results, dict) else None
    if not isinstance(parts, list) or "rows" in results:
        yield folder
    elif depth and folder.is_dir():
        order = {part.get("name"): number for number, part in enumerate(parts)}
        children = [one for one in folder.iterdir() if one.is_dir() and not one.is_symlink()]
        for child in sorted(children, key=lambda one: (order.get(one.name, len(order)), one.name)):
            yield from _below(child, depth - 1)


def _load(folder: Path) -> Run:
    results, record = read_results(folder)
    notes = []
    if not (folder / SCORES).is_file():
        what = "failures, confusions and single samples cannot be shown"
        notes.append(f"{folder / SCORES} is not there: {what}.")
    scored = within(record, "manifest", "inputs", "predictions")
    answers: Answers = {}
    for path in _answer_files(folder, scored, notes):
        for line in read_jsonl(path) if path.stat().st_size else ():
            answers.setdefault(_key(line), {}).setdefault(str(line.get("id")), line)
    # Answers without candidate or configuration are those of a run's only row.
    nameless = [key for key in answers if "None" in key.split()]
    if len(nameless) == len(results.rows) == 1:
        answers[results.rows[0].key] = answers[nameless[0]]
    jobs: Record = dict(within(record, "manifest", "jobs") or {})
    made = [] if jobs else [folder / RUN]
    # Predictions that were scored again lie beside the run that made them.
    made += [Path(scored["path"]).parent / RUN] if scored.get("path") else []
    for path in [*made, *sorted(folder.glob(f"*/{RUN}"))]:
        jobs |= _optional(path).get("jobs", {})
    used = [job for job in jobs.values() if isinstance(job, dict) and job.get("adapter")]
    adapters = {_key(job): str(job["adapter"]) for job in reversed(used)}
    return Run(folder, results, record, answers, adapters, tuple(notes))


def _answer_files(folder: Path, scored: Record, notes: list[str]) -> list[Path]:
    """The predictions of a run, of a suite's candidates, or the scored file if it is unchanged."""
    own = folder / PREDICTIONS
    paths = [own] if own.is_file() else sorted(folder.glob(f"*/{PREDICTIONS}"))
    if not paths and scored.get("path"):
        own = Path(scored["path"])
        paths = [own] if own.is_file() else []
        if paths and sha256_file(own) != scored.get("sha256"):
            notes.append(f"{own} has changed since it was scored: answers are not shown.")
            return []
    if not paths:
        notes.append(f"{own} is not there: answers are not shown.")
    return paths


def _key(line: Mapping[str, Any]) -> str:
    """The system of a score, an answer or a job."""
    return system_key((str(line.get("candidate")), str(line.get("configuration"))))


def _optional(path: Path) -> Record:
    found: Record = read_json(path) if path.is_file() else {}
    return found


def _test_set(runs: list[Run], data: Sequence[Path]) -> TestSet:
    names = [row.key for run in runs for row in run.results.rows]
    if len(set(names)) < len(names):
        short = len({run.folder.name for run in runs}) == len(runs)
        runs = [run.renamed(f" ({run.folder.name if short else run.folder})") for run in runs]
    results = runs[0].results
    if len(runs) > 1:  # baselines once
        beside = next((run.results for run in runs if run.results.baselines), results)
        rows = tuple(row for run in runs for row in run.results.rows)
        scores = tuple(line for run in runs for line in run.results.scores)
        theirs = (beside.baselines, beside.baseline_scores)
        results = Results(results.level, results.data, rows, results.manifest, scores, *theirs)
    notes = [note for run in runs for note in run.notes]
    about, vocabulary = results.data, _vocabulary(runs[0].vocabulary, notes)
    path, sha256 = str(about.get("path", "")), str(about.get("sha256", ""))
    samples = _samples([Path(path), *data], sha256, notes)
    scored = {str(line.get("id")) for line in (*results.scores, *results.baseline_scores)}
    return TestSet(
        *(results.level, path, sha256, int(about.get("n", 0)), results, tuple(runs), vocabulary),
        samples={name: one for name, one in samples.items() if not scored or name in scored},
        answers={key: lines for run in runs for key, lines in run.answers.items()},
        adapters={key: digest for run in runs for key, digest in run.adapters.items()},
        notes=tuple(dict.fromkeys(notes)),
    )


def _samples(paths: Sequence[Path], sha256: str, notes: list[str]) -> dict[str, Record]:
    """The test samples by id, from the first of the files that has the digest."""
    for path in paths:
        if path.is_file() and sha256_file(path) == sha256:
            return {str(line.get("id")): line for line in read_jsonl(path)}
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
