"""`plannerft bench` and `plannerft score`."""

from __future__ import annotations

import tempfile
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

from planner_ft.cli.options import command, given, typed
from planner_ft.cli.progress import interruptible, resume_command, status
from planner_ft.support.alone import alone
from planner_ft.support.errors import IncompleteError, PlannerError
from planner_ft.support.terminal import show, terminal

if TYPE_CHECKING:
    from planner_ft.benchmark.results import Results
    from planner_ft.benchmark.settings import BenchSettings, EndpointSettings
    from planner_ft.benchmark.suite.session import State

RUN = (
    *("level", "candidates", "configurations", "data", "limit", "adapter", "quantization"),
    *("max_new_tokens", "latency_samples", "planning_samples", "vocabulary"),
    *("repeats", "temperature", "top_p"),
)
"""Options that say what is run; a suite or gate file says it itself."""
SERVER = ("endpoint", "model", "api_key_env", "concurrency", "timeout", "retries")
OUTPUT = "give --overwrite or another --out"


@command
def bench(**options: Any) -> None:
    """Benchmark candidates, run a suite or gate file, or field cases."""
    named, served = given(options, *RUN), given(options, *SERVER)
    generation = {name: options[name] for name in ("device", "seed")}
    generation["batch_size"] = _batch_size(options["batch_size"])
    rerun = {name: options[name] for name in ("resume", "overwrite")}
    out, cases, field = options["out"], options["cases"], options["field"]
    suite, gate, report = options["suite"], options["gate"], not options["no_report"]
    if cases and not field:
        raise PlannerError(f"{cases[0]}: files stand behind --field; test data is given by --data")
    if field or options["level"] == "both":
        from planner_ft.cli.field import run_whole

        whole = named | served | ({"resume": True} if rerun["resume"] else {})
        whole["device"], found = options["device"], (cases or []) if field else None
        run_whole(found, out, whole, overwrite=rerun["overwrite"])
    elif suite is not None:
        _check_file_alone("suite", suite, named | served, ("limit", "latency_samples"))
        how = {"processes": options["processes"], **rerun}
        _run_suite(suite, out, generation | named, how, report=report)
    elif gate is not None:
        _check_file_alone("gate", gate, named | served)
        _run_gate(gate, out, generation | rerun)
    else:
        _run(_settings(named, served, out=out, **generation, **rerun), report=report)


@command
def score(**options: Any) -> None:
    """Score any system's outputs, or a bench run again."""
    from planner_ft.benchmark import folder
    from planner_ft.benchmark.samples import default_data, load_bench_data
    from planner_ft.benchmark.submission import score_predictions, score_run
    from planner_ft.vocabulary import load_vocabulary
    from planner_ft.vocabulary.plans import check_level

    o = SimpleNamespace(**options)
    with alone(o.out, "--out", "a benchmark"):
        if o.out is not None:
            folder.check_folder(o.out, () if o.overwrite else folder.SCORED, OUTPUT)
        if o.run is not None and o.predictions is None and o.level is None:
            results = score_run(o.run, o.data, seed=o.seed)
        elif o.level is not None and o.predictions is not None and o.run is None:
            level, vocabulary = check_level(o.level), load_vocabulary(o.vocabulary)
            data = o.data or default_data(level, vocabulary)
            samples = load_bench_data(data, level, vocabulary, o.limit)
            named = {"seed": o.seed, "name": o.name}
            results = score_predictions(o.predictions, samples, vocabulary, **named)
        else:
            ways = "score needs either --level and --predictions, or --run alone"
            raise PlannerError(f"{ways}; try: plannerft score --run eval/runs/mission")
        if o.out is not None:
            folder.write_results(o.out, results)
    _show(results, o.out)


def _batch_size(text: str) -> int | None:
    try:
        return None if text == "auto" else int(text)
    except ValueError:
        raise PlannerError(f"--batch-size {text}: must be a number or auto") from None


def _settings(named: dict[str, Any], served: dict[str, Any], **common: Any) -> BenchSettings:
    """Settings from the flags that were given."""
    from planner_ft.benchmark.settings import BenchSettings
    from planner_ft.vocabulary.plans import check_level

    values, server = _with_endpoint(named, served)
    if "level" not in values or "candidates" not in values:
        example = "plannerft bench --level mission --candidates embedded"
        raise PlannerError(f"bench needs --level and --candidates (or --gate FILE); try: {example}")
    level, adapters = check_level(values.pop("level")), tuple(values.pop("adapter", ()))
    for name in {"candidates", "configurations"} & set(values):
        values[name] = tuple(part.strip() for part in values[name].split(",") if part.strip())
    return BenchSettings(level=level, adapters=adapters, endpoint=server, **values, **common)


def _with_endpoint(
    named: dict[str, Any], served: dict[str, Any]
) -> tuple[dict[str, Any], EndpointSettings | None]:
    """The run's flags with --endpoint's model as candidate, and the server. Raises PlannerError."""
    if not served:
        return named, None
    from planner_ft.benchmark.settings import EndpointSettings

    if "endpoint" not in served or "model" not in served:
        raise PlannerError(f"{typed(served)}: a server needs both --endpoint URL and --model NAME")
    if "candidates" in named:
        places = "--candidates are loaded here and --endpoint is asked over the network"
        raise PlannerError(f"{places}: give one of them")
    # Only the user knows whether a server's model was fine-tuned, and so needs no vocabulary.
    model = {"candidates": served["model"].replace(",", " ")}
    url = served.pop("endpoint")
    return {"configurations": "base", **named, **model}, EndpointSettings(url, **served)


def _run(settings: BenchSettings, *, report: bool) -> None:
    from planner_ft.benchmark.runner import help_bench, run_bench
    from planner_ft.support.ranks import join_ranks

    ranks = join_ranks()
    if not ranks.leads:
        help_bench(settings, ranks)
        return
    with alone(settings.folder, "--out", "a benchmark"):
        with interruptible(lambda: _kept(settings.folder)) as progress:
            results = run_bench(settings, progress, ranks)
        _show(results, settings.folder)
        if report:
            _report(settings.folder)


def _check_file_alone(
    kind: str, path: Path, named: dict[str, Any], allowed: tuple[str, ...] = ()
) -> None:
    """Raise PlannerError for flags that a suite or gate file sets itself, and under accelerate."""
    from planner_ft.support.ranks import started_with_others

    if started_with_others():
        way_out = "a suite shares its runs itself with --processes N"
        raise PlannerError(f"--{kind} is started once, not by accelerate; {way_out}")
    if extra := [name for name in named if name not in allowed]:
        way_out = f"leave out {typed(extra)} or change the file"
        raise PlannerError(f"--{kind} {path} says itself what is run; {way_out}")


def _run_suite(
    path: Path, out: Path | None, changes: dict[str, Any], how: dict[str, Any], *, report: bool
) -> None:
    """Run a suite, and exit with 1 when a candidate could not be measured."""
    from planner_ft.benchmark.layout import print_warnings
    from planner_ft.benchmark.suite.definition import load_suite
    from planner_ft.benchmark.suite.run import run_suite

    if how["resume"] and how["overwrite"]:
        problem = "--resume keeps former results and --overwrite removes them"
        raise PlannerError(f"{problem}: give one of them")
    suite = load_suite(path)
    folder = out or Path("eval/runs") / path.stem
    with (
        alone(folder, "--out", "a suite"),
        status(lambda: f"go on with: {resume_command()}") as step,
    ):

        def shown(state: State) -> None:
            step(state.unit, _state_line(state))

        parts = run_suite(suite, folder, changes, shown, **how)
    show((folder / "table.md").read_text(encoding="utf-8"))
    for part in parts:
        print_warnings(part.results, terminal(stderr=True))
    names = ", ".join(part.part.name for part in parts)
    files = "table.md, table.csv, table.tex, results.json"
    show(f"{folder}/: {files}; a folder for each of {names}")
    if report:
        _report(folder)
    failed = [
        f"{entry['candidate']} {entry['configuration']} ({part.part.name})"
        for part in parts
        for entry in part.failed
    ]
    if failed:
        problem = f"{len(failed)} of the suite could not be measured: {', '.join(failed)}"
        raise IncompleteError(f"{problem}; the reasons are in {folder / 'table.md'}")


def _state_line(state: State) -> str:
    """The progress of a suite, in a line."""
    from planner_ft.support.resources import clock

    left = f", {clock(state.left)} left in all" if state.left is not None else ""
    return f"({state.unit}/{state.units}) {state.name}: {state.done}/{state.total} queries{left}"


def _run_gate(path: Path, out: Path | None, common: dict[str, Any]) -> None:
    from planner_ft.benchmark.gate import load_gate, run_gate

    gate = load_gate(path)
    with tempfile.TemporaryDirectory() as temporary:
        target = out or Path(temporary) / "gate"
        with (
            alone(target, "--out", "a benchmark"),
            interruptible((lambda: _kept(target)) if out else None) as progress,
        ):
            run_gate(gate, target, progress, lambda results: _show(results, out), **common)
    show(f"{path}: passed ({', '.join(threshold.metric for threshold in gate.thresholds)})")


def _kept(folder: Path) -> str:
    from planner_ft.benchmark.runner import resume_hint

    return f"{resume_hint(folder)}; go on with: {resume_command()}"


def _report(folder: Path) -> None:
    """Write the report of a finished run or suite beside its results."""
    from planner_ft.report.write import report_beside

    show(report_beside(folder))


def _show(results: Results, out: Path | None) -> None:
    """Print the table, the samples without a prediction and the names of the files."""
    from planner_ft.benchmark.folder import TABLES
    from planner_ft.benchmark.layout import print_results, print_warnings

    print_results(results, terminal())
    print_warnings(results, terminal(stderr=True))
    if out is not None:
        show(f"\n{out}/: results.json, scores.jsonl, {', '.join(TABLES)}")
