"""Scoring predictions that somebody else made, or that a run has written: no model is needed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from planner_ft.benchmark.assembly import Measured, assemble
from planner_ft.benchmark.folder import LATENCY, PREDICTIONS
from planner_ft.benchmark.record import measured_in, read_run
from planner_ft.benchmark.results import Results, System
from planner_ft.benchmark.samples import BenchData, joined, load_bench_data
from planner_ft.candidates import all_candidates
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import iterate_jsonl
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary import Vocabulary, load_vocabulary

CONFIGURATION = "submitted"
"""Configuration of predictions that name none."""

Predictions = dict[tuple[str, str, int | None], dict[str, dict[str, Any]]]


def score_predictions(
    path: Path, data: BenchData, vocabulary: Vocabulary, *, seed: int = 0, name: str | None = None
) -> Results:
    """Score the predictions in `path` against `data`.

    A line needs `id` and `output` (text, or the plan as an object); `candidate` and `configuration`
    group lines, `repeat` (from 1) numbers the answers of a system that was asked several times,
    `tokens`, `latency_s` and `finish_reason` are used where they are given. `name` stands for lines
    without `candidate`. For the predictions.jsonl of a run, its latency.jsonl is read, too. Raises
    PlannerError that names the lines of malformed, double and unknown predictions.
    """
    groups = read_predictions(path, data.ids, name or path.stem)
    measured = []
    timed = _timed(path)
    for (candidate, configuration, repeat), predictions in groups.items():
        system = replace(_system(candidate, configuration, predictions, vocabulary), repeat=repeat)
        queries = {
            **timed.get((candidate, configuration, repeat), {}),
            **{key: line for key, line in predictions.items() if _is_timed(line)},
        }
        measured.append(Measured(system, predictions, queries))
    manifest = build_manifest(
        "score",
        seed=seed,
        configuration={
            "level": data.level,
            "vocabulary": {"name": vocabulary.name, "sha256": vocabulary.sha256},
        },
        inputs={"predictions": path, "data": data.path},
    )
    return assemble(data, vocabulary, measured, seed=seed, manifest=manifest)


def score_run(folder: Path, data_path: Path | None = None, *, seed: int | None = None) -> Results:
    """Score the answers in a run folder again, with the data that they were made for; no model is
    needed.

    `data_path` says where the data lies now if it was moved. Raises PlannerError when it is not the
    same data.
    """
    record = read_run(folder)
    settings = record.settings
    vocabulary = load_vocabulary(settings["vocabulary"])
    data = load_bench_data(
        data_path or settings["data"], settings["level"], vocabulary, settings["limit"]
    )
    if data.sha256 != settings["data_sha256"]:
        raise PlannerError(
            f"{data.path}: is not the data that {folder} was run on; give that file with --data"
        )
    for name, parts in record.jobs.items():
        if parts.get("vocabulary") != vocabulary.sha256:
            raise PlannerError(
                f"{folder}: {name} was run with another version of the vocabulary"
                f" {vocabulary.name}; restore it to score the run again"
            )
    seed = settings["seed"] if seed is None else seed
    configuration = {
        **settings,
        "vocabulary": {"name": vocabulary.name, "sha256": vocabulary.sha256},
    }
    manifest = build_manifest(
        "score",
        seed=seed,
        configuration=configuration,
        inputs={"data": data.path},
        jobs=record.jobs,
        costs=record.costs,
    )
    return assemble(data, vocabulary, measured_in(folder, record), seed=seed, manifest=manifest)


def read_predictions(path: Path, known: frozenset[str], name: str) -> Predictions:
    """Predictions by (candidate, configuration, repeat), then by sample id; `known` are the ids of
    the test data.
    """
    groups: Predictions = {}
    lines: dict[tuple[str, str, int | None, str], int] = {}
    problems: list[str] = []
    line: Any
    for number, line, problem in iterate_jsonl(path):
        problem = problem or _problem(line, known)
        if problem is None:
            key = (
                str(line.get("candidate") or name),
                str(line.get("configuration") or CONFIGURATION),
                line.get("repeat"),
                line["id"],
            )
            if key in lines:
                problem = (
                    f"id {line['id']!r} has a prediction on line {lines[key]} already (further"
                    " answers to a sample need a number as repeat)"
                )
        if problem is not None:
            problems.append(f"{path}:{number}: {problem}")
            continue
        lines[key] = number
        groups.setdefault(key[:3], {})[line["id"]] = line
    if problems:
        raise PlannerError(joined(problems))
    if not groups:
        raise PlannerError(
            f"{path}: holds no predictions; one JSON object per line with id and output is expected"
        )
    return groups


def _system(
    candidate: str,
    configuration: str,
    predictions: dict[str, dict[str, Any]],
    vocabulary: Vocabulary,
) -> System:
    """What is known of a system by its name, and from its lines whether it is a stand-in."""
    known = next((entry for entry in all_candidates() if entry.name == candidate), None)
    standin = any(line.get("standin") is True for line in predictions.values())
    label = (known and known.published) or candidate
    return System(
        candidate,
        configuration,
        label=f"{label} (stand-in)" if standin else label,
        published=known.published if known else None,
        is_standin=standin,
        pretrained=bool(known and known.knows(vocabulary)),
    )


def _timed(path: Path) -> Predictions:
    """The timed queries of a run by (candidate, configuration, repeat) and sample id; none for
    other files.
    """
    timed: Predictions = {}
    beside = path.with_name(LATENCY)
    if path.name != PREDICTIONS or not beside.is_file():
        return timed
    for _number, line, _problem_there in iterate_jsonl(beside):
        if isinstance(line, dict) and _is_timed(line):
            timed.setdefault(
                (str(line.get("candidate")), str(line.get("configuration")), line.get("repeat")), {}
            )[str(line.get("id"))] = line
    return timed


def _is_timed(line: dict[str, Any]) -> bool:
    return isinstance(line.get("latency_s"), int | float)


def _problem(line: Any, known: frozenset[str]) -> str | None:
    if not isinstance(line, dict):
        return f"a JSON object is expected, not {type(line).__name__}"
    if not isinstance(line.get("id"), str):
        return "id is missing or no text"
    if "output" not in line or not isinstance(line["output"], str | dict | None):
        return "output is missing, or neither text nor object nor null"
    if line["id"] not in known:
        return f"id {line['id']!r} is not in the test data"
    if line.get("tokens") is not None and not isinstance(line["tokens"], int | float):
        return "tokens is no number"
    if "repeat" in line and (type(line["repeat"]) is not int or line["repeat"] < 1):
        return "repeat must be a whole number from 1"
    return None
