"""`plannerft bench` and `plannerft score`."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from planner_ft.cli.endpoint import with_endpoint
from planner_ft.cli.progress import interruptible

if TYPE_CHECKING:
    from planner_ft.benchmark.results import Results
    from planner_ft.benchmark.settings import BenchSettings

VOCABULARY = Annotated[str, typer.Option(help="Vocabulary: a bundled name or a TOML file.")]
SEED = Annotated[int, typer.Option(help="Seed of the bootstrap intervals and of sampled answers.")]


def bench(
    level: Annotated[
        str | None,
        typer.Option(
            help="mission (commands to tasks) or task (tasks to skills).", show_default=False
        ),
    ] = None,
    candidates: Annotated[
        str | None,
        typer.Option(
            help=(
                "Names, folders or hub ids, separated by commas; `plannerft candidates` lists them."
            ),
            show_default=False,
        ),
    ] = None,
    configurations: Annotated[
        str | None,
        typer.Option(
            help=(
                "base (prompted with the vocabulary) or lora (fine-tuned), each alone or with"
                " +schema, +state or +grounded; separated by commas."
            ),
            show_default="base,lora",
        ),
    ] = None,
    data: Annotated[
        Path | None,
        typer.Option(
            help=(
                "Test data: any JSONL with id, prompt and expected (task level: also task and"
                " parameters)."
            ),
            show_default="data/LEVEL/test.jsonl",
        ),
    ] = None,
    limit: Annotated[
        int | None, typer.Option(help="Only the first samples of the data.", show_default="all")
    ] = None,
    adapter: Annotated[
        list[str] | None,
        typer.Option(
            help="Adapter folder; with several candidates NAME=DIR, once for each.",
            show_default="adapters/CANDIDATE/LEVEL",
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            help="Folder for predictions, results and tables.", show_default="eval/runs/LEVEL"
        ),
    ] = None,
    resume: Annotated[
        bool,
        typer.Option(
            "--resume", help="Go on with an interrupted run; what is there is not generated again."
        ),
    ] = False,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Remove an earlier run from --out first.")
    ] = False,
    device: Annotated[str, typer.Option(help="auto, cpu, cuda or cuda:N.")] = "auto",
    quantization: Annotated[
        str | None,
        typer.Option(
            help="nf4 (4-bit base) or none.", show_default="as the candidate is trained: nf4"
        ),
    ] = None,
    batch_size: Annotated[
        str,
        typer.Option(
            help=(
                "Queries generated together (quality; latency is always one at a time): a number,"
                " or auto. Halved when memory runs out."
            )
        ),
    ] = "auto",
    max_new_tokens: Annotated[
        int | None,
        typer.Option(
            help="Limit of generated tokens per answer; cut answers are counted.",
            show_default="1024 mission, 2048 task",
        ),
    ] = None,
    latency_samples: Annotated[
        int | None,
        typer.Option(
            help="Time the queries of this many samples, one at a time; 0: none.", show_default="50"
        ),
    ] = None,
    planning_samples: Annotated[
        int | None,
        typer.Option(
            help=(
                "Mission level: also time planning with both agents, this many missions of each"
                " length from 1 to 10 tasks."
            ),
            show_default="0",
        ),
    ] = None,
    vocabulary: Annotated[
        str | None,
        typer.Option(help="Vocabulary: a bundled name or a TOML file.", show_default="usv"),
    ] = None,
    repeats: Annotated[
        int | None,
        typer.Option(
            help="Sampled answers per sample: gives pass^k; needs --temperature.", show_default="1"
        ),
    ] = None,
    temperature: Annotated[
        float | None,
        typer.Option(help="Sample answers at this temperature.", show_default="0: greedy"),
    ] = None,
    top_p: Annotated[
        float | None,
        typer.Option(
            help=(
                "With --temperature: sample from the likeliest tokens that together hold this"
                " probability."
            ),
            show_default="1",
        ),
    ] = None,
    seed: SEED = 0,
    endpoint: Annotated[
        str | None,
        typer.Option(
            help=(
                "Root of a server's OpenAI chat API, such as http://127.0.0.1:8000/v1, instead of"
                " --candidates."
            ),
            show_default=False,
        ),
    ] = None,
    model: Annotated[
        str | None,
        typer.Option(
            help="With --endpoint: the name by which the server knows the model.",
            show_default=False,
        ),
    ] = None,
    api_key_env: Annotated[
        str | None,
        typer.Option(
            help="With --endpoint: the environment variable that holds the server's key.",
            show_default=False,
        ),
    ] = None,
    concurrency: Annotated[
        int | None,
        typer.Option(help="With --endpoint: questions that are open at a time.", show_default="4"),
    ] = None,
    timeout: Annotated[
        float | None,
        typer.Option(help="With --endpoint: seconds that an answer may take.", show_default="60"),
    ] = None,
    retries: Annotated[
        int | None,
        typer.Option(
            help="With --endpoint: how often a question is asked again after a failure.",
            show_default="5",
        ),
    ] = None,
    suite: Annotated[
        Path | None,
        typer.Option(
            help=(
                "Suite file (TOML): run every candidate on every data set that it names, each in a"
                " process."
            ),
            show_default=False,
        ),
    ] = None,
    processes: Annotated[
        int,
        typer.Option(
            help="With --suite: processes that share each run, started by accelerate.", min=1
        ),
    ] = 1,
    gate: Annotated[
        Path | None,
        typer.Option(
            help="Gate file (TOML): run what it names and exit with 1 when a figure falls short.",
            show_default=False,
        ),
    ] = None,
    no_report: Annotated[
        bool, typer.Option("--no-report", help="Leave out report.html and its figures.")
    ] = False,
) -> None:
    """Benchmark candidates: F1, hallucination, validity, latency and tokens with 95 % intervals,
    beside the published figures.

    Greedy decoding. --out holds predictions.jsonl (written as answers are made), results.json,
    scores.jsonl, latency.jsonl and the table as Markdown, CSV and LaTeX.
    """
    named = {
        "level": level,
        "candidates": candidates,
        "configurations": configurations,
        "data": data,
        "limit": limit,
        "adapter": adapter,
        "quantization": quantization,
        "max_new_tokens": max_new_tokens,
        "latency_samples": latency_samples,
        "vocabulary": vocabulary,
        "planning_samples": planning_samples,
        "repeats": repeats,
        "temperature": temperature,
        "top_p": top_p,
    }
    named = {name: value for name, value in named.items() if value is not None}
    common = {
        "device": device,
        "batch_size": _batch_size(batch_size),
        "seed": seed,
        "resume": resume,
        "overwrite": overwrite,
    }
    served = {
        "endpoint": endpoint,
        "model": model,
        "api_key_env": api_key_env,
        "concurrency": concurrency,
        "timeout": timeout,
        "retries": retries,
    }
    served = {name: value for name, value in served.items() if value is not None}
    if suite is not None or gate is not None:
        _check_alone("--suite" if suite is not None else "--gate")
    if suite is not None:
        _run_suite(suite, out, named | served, common, processes, report=not no_report)
        return
    if gate is not None:
        _run_gate(gate, out, named | served, common)
        return
    named, server = with_endpoint(named, served)
    settings = _settings(named, out=out, endpoint=server, **common)
    from planner_ft.benchmark.ranks import join_ranks
    from planner_ft.benchmark.runner import help_bench, run_bench

    ranks = join_ranks()
    if not ranks.leads:
        help_bench(settings, ranks)
        return
    with interruptible(settings.folder) as progress:
        results = run_bench(settings, progress, ranks)
    _show(results, settings.folder)
    if not no_report:
        _report(settings.folder)


def score(
    level: Annotated[
        str | None,
        typer.Option(
            help="mission (commands to tasks) or task (tasks to skills).", show_default=False
        ),
    ] = None,
    predictions: Annotated[
        Path | None,
        typer.Option(
            help=(
                "JSONL with id and output per line; candidate, configuration, tokens and latency_s"
                " are used if given."
            ),
            show_default=False,
        ),
    ] = None,
    run: Annotated[
        Path | None,
        typer.Option(
            help="Folder of a bench run to score again: it knows its level, data and vocabulary.",
            show_default=False,
        ),
    ] = None,
    data: Annotated[
        Path | None,
        typer.Option(
            help="Test data that the predictions were made for.",
            show_default="data/LEVEL/test.jsonl",
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            help="Folder for results.json and the tables; without it the table is only printed.",
            show_default=False,
        ),
    ] = None,
    limit: Annotated[
        int | None, typer.Option(help="Only the first samples of the data.", show_default="all")
    ] = None,
    name: Annotated[
        str | None,
        typer.Option(
            help="The system's name in the table, where lines name no candidate.",
            show_default="the file's name",
        ),
    ] = None,
    vocabulary: VOCABULARY = "usv",
    seed: SEED = 0,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace results that are in --out already.")
    ] = False,
) -> None:
    """Score any system's outputs, or a bench run again. No model is needed; a sample without a
    prediction counts as an empty output.
    """
    from planner_ft.benchmark import folder
    from planner_ft.support.errors import PlannerError

    if out is not None:
        folder.check_folder(
            out, () if overwrite else folder.SCORED, "give --overwrite or another --out"
        )
    if run is not None and predictions is None and level is None:
        from planner_ft.benchmark.submission import score_run

        results = score_run(run, data, seed=seed)
    elif level is not None and predictions is not None and run is None:
        results = _score_predictions(level, predictions, data, limit, name, vocabulary, seed)
    else:
        raise PlannerError(
            "score needs either --level and --predictions, or --run alone; try: plannerft score"
            " --run eval/runs/mission"
        )
    if out is not None:
        folder.write_results(out, results)
    _show(results, out)


def _score_predictions(
    level: str,
    predictions: Path,
    data: Path | None,
    limit: int | None,
    name: str | None,
    vocabulary: str,
    seed: int,
) -> Results:
    from planner_ft.benchmark.samples import default_data, load_bench_data
    from planner_ft.benchmark.submission import score_predictions
    from planner_ft.vocabulary import load_vocabulary
    from planner_ft.vocabulary.plans import check_level

    checked, definition = check_level(level), load_vocabulary(vocabulary)
    samples = load_bench_data(data or default_data(checked), checked, definition, limit)
    return score_predictions(predictions, samples, definition, seed=seed, name=name)


def _batch_size(text: str) -> int | None:
    from planner_ft.support.errors import PlannerError

    if text == "auto":
        return None
    try:
        return int(text)
    except ValueError:
        raise PlannerError(f"--batch-size {text}: must be a number or auto") from None


def _split(text: str) -> tuple[str, ...]:
    return tuple(part.strip() for part in text.split(",") if part.strip())


def _settings(named: dict[str, Any], **common: Any) -> BenchSettings:
    """Settings from the flags that were given."""
    from planner_ft.benchmark.settings import BenchSettings
    from planner_ft.support.errors import PlannerError
    from planner_ft.vocabulary.plans import check_level

    if "level" not in named or "candidates" not in named:
        raise PlannerError(
            "bench needs --level and --candidates (or --gate FILE); try: plannerft bench --level"
            " mission --candidates embedded"
        )
    values = {**named, "level": check_level(named["level"])}
    values |= {
        name: _split(values[name]) for name in ("candidates", "configurations") if name in values
    }
    return BenchSettings(adapters=tuple(values.pop("adapter", ())), **values, **common)


def _check_alone(flag: str) -> None:
    from planner_ft.benchmark.ranks import started_with_others
    from planner_ft.support.errors import PlannerError

    if started_with_others():
        raise PlannerError(
            f"{flag} is started once, not by accelerate; a suite shares its runs itself with"
            " --processes N"
        )


def _run_suite(
    path: Path,
    out: Path | None,
    named: dict[str, Any],
    common: dict[str, Any],
    processes: int,
    *,
    report: bool,
) -> None:
    from planner_ft.cli.suite import bench_suite
    from planner_ft.support.errors import PlannerError

    flags: dict[str, Any] = {
        name: named.pop(name) for name in ("limit", "latency_samples") if name in named
    }
    if named:
        given = ", ".join(f"--{name.replace('_', '-')}" for name in named)
        raise PlannerError(
            f"--suite {path} says itself what is run; leave out {given} or change the file"
        )
    flags |= {name: common[name] for name in ("device", "batch_size", "seed")}
    bench_suite(
        path,
        out,
        flags | {"processes": processes},
        resume=common["resume"],
        overwrite=common["overwrite"],
        finish=_report if report else None,
    )


def _run_gate(path: Path, out: Path | None, named: dict[str, Any], common: dict[str, Any]) -> None:
    from planner_ft.benchmark.gate import load_gate, run_gate
    from planner_ft.support.errors import PlannerError

    if named:
        flags = ", ".join(f"--{name.replace('_', '-')}" for name in named)
        raise PlannerError(
            f"--gate {path} says itself what is run; leave out {flags} or change the file"
        )
    gate = load_gate(path)
    with tempfile.TemporaryDirectory() as temporary:
        target = out or Path(temporary) / "gate"
        with interruptible(target if out else None) as progress:
            run_gate(gate, target, progress, lambda results: _show(results, out), **common)
    typer.echo(f"{path}: passed ({', '.join(threshold.metric for threshold in gate.thresholds)})")


def _report(folder: Path) -> None:
    """Write the report of a finished run or suite beside its results."""
    from planner_ft.report.write import report_beside

    typer.echo(report_beside(folder))


def _show(results: Results, out: Path | None) -> None:
    """Print the table, the samples without a prediction and where the files lie."""
    from rich.console import Console

    from planner_ft.benchmark.folder import TABLES
    from planner_ft.benchmark.terminal import print_missing, print_results

    print_results(results, Console())
    print_missing(results, Console(stderr=True))
    if out is not None:
        typer.echo(f"\n{out}/: results.json, scores.jsonl, {', '.join(TABLES)}")
