"""`plannerft bench`, `score`, `compare` and `report`."""

from __future__ import annotations

import tempfile
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.cli.options import (
    AGAIN,
    Options,
    command,
    resume_command,
    show_table,
    status,
    typed,
    working,
)
from planner_ft.support.alone import alone
from planner_ft.support.errors import IncompleteError, PlannerError
from planner_ft.support.files import indented_json, write_json, write_text
from planner_ft.support.geodesy import Origin
from planner_ft.support.ranks import helped, join_ranks, started_with_others
from planner_ft.support.terminal import show, terminal
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import check_level

if TYPE_CHECKING:
    from planner_ft.benchmark.field.cases import Case, Outcome
    from planner_ft.benchmark.results import Results
    from planner_ft.benchmark.settings import BenchSettings
    from planner_ft.planning import Planner

RUN = (
    *("level", "candidates", "configurations", "data", "limit", "adapter", "quantization"),
    *("max_new_tokens", "latency_samples", "planning_samples", "vocabulary"),
    *("repeats", "temperature", "top_p"),
)
"""Options that say what is run; a suite or gate file says it itself."""
SERVER = ("endpoint", "model", "api_key_env", "concurrency", "timeout", "retries")
RERUN = ("resume", "overwrite")


@command
def bench(o: Options) -> None:
    """Benchmark candidates, run a suite or gate file, or field cases."""
    if o.cases and not o.field:
        where = "files stand behind --field; test data is given by --data"
        raise PlannerError(f"{o.cases[0]}: {where}")
    try:
        o.batch_size = None if o.batch_size == "auto" else int(o.batch_size)
    except ValueError:
        raise PlannerError(f"--batch-size {o.batch_size}: must be a number or auto") from None
    named = o.given(*RUN, *SERVER)
    if o.processes > 1 and o.suite is None:
        way_out = "start a single run with `accelerate launch`, or give --suite"
        raise PlannerError(f"--processes {o.processes}: shares the parts of a suite; {way_out}")
    if o.field or o.level == "both":
        run_whole(o, named)
    elif o.suite is not None:
        _check_file_alone("suite", o.suite, named, ("limit", "latency_samples"))
        _run_suite(o)
    elif o.gate is not None:
        _check_file_alone("gate", o.gate, named)
        _run_gate(o)
    else:
        _run(_settings(o), report=not o.no_report)


@command
def score(o: Options) -> None:
    """Score any system's outputs, or a bench run again."""
    from planner_ft.benchmark import folder
    from planner_ft.benchmark.samples import default_data, load_bench_data
    from planner_ft.benchmark.submission import score_predictions, score_run

    with alone(o.out, "--out", "a benchmark"):
        if o.out is not None:
            folder.check_folder(o.out, folder.SCORED, AGAIN, overwrite=o.overwrite)
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


@command
def compare(o: Options) -> None:
    """Compare rows of finished runs."""
    from planner_ft.benchmark import compare
    from planner_ft.benchmark.folder import check_folder

    if o.same and o.against is not None:
        kinds = f"--same compares rows of the same name and --against {o.against} one row with all"
        raise PlannerError(f"{kinds}: give one of them")
    how = o.take("against", "same", "common", "seed")
    with alone(o.out, "--out", "a comparison"):
        if o.out is not None:
            check_folder(o.out, ("comparison.json",), AGAIN, overwrite=o.overwrite)
        report = compare.compare_runs(o.runs, o.metric, **how)
        if o.out is not None:
            for name, text in compare.render_report(report).items():
                write_text(o.out / name, text)
            write_json(o.out / "comparison.json", report.to_json())
    if o.json:
        show(indented_json(report.to_json()), end="")
    else:
        compare.print_report(report, terminal())


@command
def report(o: Options) -> None:
    """Write the report of runs."""
    if o.card is not None:
        from planner_ft.report.write import write_card

        show(f"{o.card / 'README.md'}: {write_card(o.card, o.runs)} measured figures")
        return
    if o.out is None and len(o.runs) > 1:
        raise PlannerError("--out is missing: with several runs, name a folder for the report")
    from planner_ft.report.write import write_report

    target, how = o.out or o.runs[0], o.take("overwrite", "title", "pictures")
    with alone(target, "--out", "a report"):
        written = write_report(o.runs, target, data=o.data or (), **how)
    counts = [sum(path.parent.name == name for path in written) for name in ("figures", "tables")]
    show(f"{target}/: report.html, figures/ ({counts[0]} files), tables/ ({counts[1]} files)")


def _settings(o: Options) -> BenchSettings:
    """Settings from the flags that were given; the model of --endpoint is the candidate."""
    from planner_ft.benchmark.settings import BenchSettings, EndpointSettings

    values, served = o.given(*RUN), o.given(*SERVER)
    server = None
    if served:
        if "endpoint" not in served or "model" not in served:
            wanted = "a server needs both --endpoint URL and --model NAME"
            raise PlannerError(f"{typed(served)}: {wanted}")
        if "candidates" in values:
            places = "--candidates are loaded here and --endpoint is asked over the network"
            raise PlannerError(f"{places}: give one of them")
        server = EndpointSettings(served.pop("endpoint"), **served)
        # Only the user knows whether a server's model was fine-tuned, and so needs no vocabulary.
        values = {"configurations": "base"} | values | {"candidates": o.model.replace(",", " ")}
    if "level" not in values or "candidates" not in values:
        example = "plannerft bench --level mission --candidates embedded"
        raise PlannerError(f"bench needs --level and --candidates (or --gate FILE); try: {example}")
    values |= {"level": check_level(o.level), "adapters": tuple(values.pop("adapter", ()))}
    for name in {"candidates", "configurations"} & set(values):
        values[name] = tuple(names(values[name]))
    common = o.take("out", "device", "seed", "batch_size", *RERUN)
    return BenchSettings(endpoint=server, **values, **common)


def names(text: str | None) -> list[str]:
    """Names that are separated by commas."""
    return [part.strip() for part in (text or "").split(",") if part.strip()]


def _run(settings: BenchSettings, *, report: bool) -> None:
    from planner_ft.benchmark.folder import PREDICTIONS
    from planner_ft.benchmark.plan import is_helped
    from planner_ft.benchmark.runner import help_bench, run_bench
    from planner_ft.report.write import report_beside

    ranks = join_ranks()
    if not ranks.leads:
        help_bench(settings, ranks)
        return
    shares = helped() if ranks.world == 1 and is_helped(settings) else nullcontext(ranks)
    with working(settings.folder, PREDICTIONS) as progress, shares as ranks:
        results = run_bench(settings, progress, ranks)
        _show(results, settings.folder)
        if report:
            show(report_beside(settings.folder))


def _check_file_alone(
    kind: str, path: Path, named: dict[str, Any], allowed: tuple[str, ...] = ()
) -> None:
    """Raise PlannerError without the suite or gate file, for flags that it sets itself, and under
    accelerate.
    """
    if not path.exists():
        way_out = f"name one of yours, or start in a checkout, which has some in eval/{kind}s"
        raise PlannerError(f"--{kind} {path}: no such file; {way_out}")
    if started_with_others():
        way_out = "a suite shares its runs itself with --processes N"
        raise PlannerError(f"--{kind} is started once, not by accelerate; {way_out}")
    if extra := [name for name in named if name not in allowed]:
        way_out = f"leave out {typed(extra)} or change the file"
        raise PlannerError(f"--{kind} {path} says itself what is run; {way_out}")


def _run_suite(o: Options) -> None:
    """Run a suite, and exit with 1 when a candidate could not be measured."""
    from planner_ft.benchmark.definitions import load_suite
    from planner_ft.benchmark.layout import print_warnings
    from planner_ft.benchmark.suite import run_suite
    from planner_ft.report.write import report_beside

    suite, folder = load_suite(o.suite), o.out or Path("eval/runs") / o.suite.stem
    changes = o.take("device", "seed", "batch_size") | o.given("limit", "latency_samples")
    with (
        alone(folder, "--out", "a suite"),
        status(lambda: f"go on with: {resume_command()}") as said,
    ):
        how = o.take("processes", *RERUN)
        parts = run_suite(
            suite, folder, changes, lambda state: said(state.number, str(state)), **how
        )
    show((folder / "table.md").read_text(encoding="utf-8"))
    for part in parts:
        print_warnings(part.results, terminal(stderr=True))
    files = "table.md, table.csv, table.tex, results.json"
    show(f"{folder}/: {files}; a folder for each of {', '.join(one.part.name for one in parts)}")
    if not o.no_report:
        show(report_beside(folder))
    failed = [
        f"{entry['candidate']} {entry['configuration']} ({part.part.name})"
        for part in parts
        for entry in part.failed
    ]
    if failed:
        problem = f"{len(failed)} of the suite could not be measured: {', '.join(failed)}"
        raise IncompleteError(f"{problem}; the reasons are in {folder / 'table.md'}")


def _run_gate(o: Options) -> None:
    from planner_ft.benchmark.definitions import check_gate, load_gate
    from planner_ft.benchmark.folder import PREDICTIONS
    from planner_ft.benchmark.runner import run_bench

    gate, common = load_gate(o.gate), o.take("device", "seed", "batch_size", *RERUN)
    with tempfile.TemporaryDirectory() as temporary:
        target = o.out or Path(temporary) / "gate"
        with working(target, PREDICTIONS, keeps=o.out is not None) as progress:
            results = run_bench(replace(gate.settings, out=target, **common), progress)
            _show(results, o.out)
            check_gate(gate, results)
    show(f"{o.gate}: passed ({', '.join(gate.thresholds)})")


def _show(results: Results, out: Path | None) -> None:
    """Print the table, the samples without a prediction and the names of the files."""
    from planner_ft.benchmark.folder import TABLES
    from planner_ft.benchmark.layout import print_results, print_warnings

    print_results(results, terminal())
    print_warnings(results, terminal(stderr=True))
    if out is not None:
        show(f"\n{out}/: results.json, scores.jsonl, {', '.join(TABLES)}")


FLAGS = ("candidates", "configurations", "vocabulary", "quantization", "limit")
"""Options of `bench` that say what of whole plans is run."""
PLACE = (100.0, 50.0)
"""Metres: where demands take a place to be that is open; the next ones lie further east."""


def run_whole(o: Options, named: dict[str, Any]) -> None:
    """Run field cases, or the demands of --data; print the table. `named` say what is run."""
    from planner_ft.benchmark.field.cases import case_files, demands_file
    from planner_ft.benchmark.field.run import Demands, Field, run_cases
    from planner_ft.benchmark.folder import PLANS
    from planner_ft.document.losses import lost
    from planner_ft.planning.planner import Planner
    from planner_ft.planning.settings import PlanSettings

    also, flag = ((), "--field") if o.field else (("level", "data"), "--level both")
    if extra := [name for name in named if name not in (*FLAGS, *also)]:
        raise PlannerError(f"{flag} plans whole commands; leave out {typed(extra)}")
    vocabulary = load_vocabulary(o.vocabulary or "usv")
    bench: Field | Demands = Field() if o.field else Demands()
    files = case_files(o.cases or ()) if o.field else [o.data or demands_file()]
    how = {"vocabulary": vocabulary.source, **o.take("quantization", "device")}
    planners = [
        Planner(PlanSettings(candidate, configuration=one or None, **how), lost=lost)
        for candidate in names(o.candidates or "embedded")
        for one in names(o.configurations) or [""]
    ]
    folder = o.out or Path("eval/runs") / bench.kind
    with working(folder, PLANS) as progress:
        asked = files, folder, vocabulary, planners, _Plan, progress
        table = run_cases(bench, *asked, **o.take("limit", "resume", "overwrite"))
    show_table(table)
    show(f"\n{folder}/: {', '.join(bench.files)}")


class _Plan:
    """Plans a case as `plannerft plan` does; `everywhere` takes open places to be somewhere."""

    def __init__(self, planner: Planner, everywhere: bool) -> None:
        from planner_ft.document.vehicle import load_vehicle

        self.planner, self.everywhere = planner, everywhere
        self.vehicle = load_vehicle(None, planner.vocabulary)

    def __call__(self, case: Case) -> Outcome:
        from planner_ft.benchmark.field.cases import Outcome
        from planner_ft.document import build

        origin = Origin(*case.origin) if case.origin else None
        try:
            planned = self.planner.plan(case.command, case.locate, origin=origin)
            if self.everywhere and planned.open_places:
                (east, north), places = PLACE, dict(case.locate)
                for number, place in enumerate(planned.open_places, 1):
                    places[place.name] = (east * number, north)
                planned = self.planner.plan(case.command, places, origin=origin)
        except PlannerError as error:
            return Outcome({}, str(error))
        document = build(planned, self.planner.vocabulary, self.vehicle)
        parts = [] if self.everywhere else [document, *document["tasks"]]
        problems = [part["problems"][0] for part in parts if "problems" in part]
        return Outcome(document, problems[0] if problems else None)
