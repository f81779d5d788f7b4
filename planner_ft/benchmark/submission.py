"""Scoring predictions that somebody else made, or that a run has written: no model is needed."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from planner_ft.benchmark.folder import LATENCY, PREDICTIONS, measured_in, read_run
from planner_ft.benchmark.results import Measured, Results, System, assemble
from planner_ft.benchmark.samples import BenchData, joined, load_bench_data
from planner_ft.candidates import all_candidates
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import iterate_jsonl
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import is_number

CONFIGURATION = "submitted"  # configuration of predictions that name none
COUNTS = ("tokens", "latency_s", "forward_passes")

Key = tuple[str, str, int | None]  # candidate, configuration and repeat
Lines = dict[str, dict[str, Any]]


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
    found, timed = [], _timed(path)
    for key, lines in _read(path, data.ids, name or path.stem).items():
        own = {sample: line for sample, line in lines.items() if _is_count(line.get("latency_s"))}
        system = _system(key, lines, vocabulary)
        found.append(Measured(system, lines, {**timed.get(key, {}), **own}))
    configuration = {"level": data.level, "vocabulary": vocabulary.named}
    inputs: dict[str, Path | str] = {"predictions": path, "data": data.path}
    manifest = build_manifest("score", seed=seed, configuration=configuration, inputs=inputs)
    return assemble(data, vocabulary, found, manifest)


def score_run(folder: Path, data_path: Path | None = None, *, seed: int | None = None) -> Results:
    """Score a run again, its data at `data_path` if moved. Raises PlannerError: other data."""
    record = read_run(folder)
    settings = record["settings"]
    vocabulary = load_vocabulary(settings["vocabulary"])
    path = data_path or settings["data"]
    data = load_bench_data(path, settings["level"], vocabulary, settings["limit"])
    if data.sha256 != settings["data_sha256"]:
        problem = f"is not the data that {folder} was run on; give that file with --data"
        raise PlannerError(f"{data.path}: {problem}")
    for name, parts in record["jobs"].items():
        if parts.get("vocabulary") != vocabulary.sha256:
            problem = f"was run with another version of the vocabulary {vocabulary.name}"
            way = "restore it to score the run again"
            raise PlannerError(f"{folder}: {name} {problem}; {way}")
    seed = settings["seed"] if seed is None else seed
    manifest = build_manifest(
        "score",
        seed=seed,
        configuration={**settings, "vocabulary": vocabulary.named},
        inputs={"data": data.path},
        jobs=record["jobs"],
        costs=record["costs"],
    )
    return assemble(data, vocabulary, measured_in(folder, record), manifest)


def _read(path: Path, known: frozenset[str], name: str) -> dict[Key, Lines]:
    """Predictions by system, then by sample id; `known` are the ids of the test data."""
    groups: dict[Key, Lines] = {}
    numbers: dict[tuple[Key, str], int] = {}
    problems: list[str] = []
    line: Any
    for number, line, problem in iterate_jsonl(path):
        if problem := problem or next(_problems(line, known), None):
            problems.append(f"{path}:{number}: {problem}")
            continue
        candidate = str(line.get("candidate") or name)
        key = candidate, str(line.get("configuration") or CONFIGURATION), line.get("repeat")
        if before := numbers.get((key, line["id"])):
            way = "further answers to a sample need a number as repeat"
            double = f"id {line['id']!r} has a prediction on line {before} already ({way})"
            problems.append(f"{path}:{number}: {double}")
        numbers.setdefault((key, line["id"]), number)
        groups.setdefault(key, {})[line["id"]] = line
    if problems:
        raise PlannerError(joined(problems))
    if not groups:
        expected = "one JSON object per line with id and output is expected"
        raise PlannerError(f"{path}: holds no predictions; {expected}")
    return groups


def _system(key: Key, lines: Lines, vocabulary: Vocabulary) -> System:
    """A system as its name tells, and its lines: whether it is a stand-in."""
    candidate, configuration, repeat = key
    known = next((entry for entry in all_candidates() if entry.name == candidate), None)
    standin = any(line.get("standin") is True for line in lines.values())
    label = (known and known.published) or candidate
    return System(
        candidate,
        configuration,
        label=f"{label} (stand-in)" if standin else label,
        published=known.published if known else None,
        is_standin=standin,
        pretrained=bool(known and known.knows(vocabulary)),
        repeat=repeat,
    )


def _timed(path: Path) -> dict[Key, Lines]:
    """The timed queries of a run by system and sample id; none for other files."""
    timed: dict[Key, Lines] = {}
    beside = path.with_name(LATENCY)
    if path.name == PREDICTIONS and beside.is_file():
        for _number, line, _problem_there in iterate_jsonl(beside):
            if isinstance(line, dict) and _is_count(line.get("latency_s")):
                names = str(line.get("candidate")), str(line.get("configuration"))
                timed.setdefault((*names, line.get("repeat")), {})[str(line.get("id"))] = line
    return timed


def _is_count(value: Any) -> bool:
    return is_number(value) and value >= 0


def _problems(line: Any, known: frozenset[str]) -> Iterator[str]:
    """Reasons why a line is no prediction."""
    if not isinstance(line, dict):
        yield f"a JSON object is expected, not {type(line).__name__}"
        return
    if not isinstance(line.get("id"), str):
        yield "id is missing or no text"
    elif line["id"] not in known:
        yield f"id {line['id']!r} is not in the test data"
    if "output" not in line or not isinstance(line["output"], str | dict | None):
        yield "output is missing, or neither text nor object nor null"
    for name in COUNTS:
        if line.get(name) is not None and not _is_count(line[name]):
            yield f"{name} is no number from 0"
    if "repeat" in line and (type(line["repeat"]) is not int or line["repeat"] < 1):
        yield "repeat must be a whole number from 1"
