"""`plannerft train`, `learning-curve` and `calibrate`."""

from __future__ import annotations

import inspect
import shlex
from collections.abc import Callable
from contextlib import nullcontext
from typing import TYPE_CHECKING, Annotated, Any

import typer

from planner_ft.cli.options import (
    OPTION,
    Options,
    command,
    interruptible,
    resume_command,
    set_parameters,
    status,
    typed,
)
from planner_ft.support.alone import alone
from planner_ft.support.errors import PlannerError
from planner_ft.support.ranks import Ranks, helped, join_ranks
from planner_ft.support.resources import clock, memory_size
from planner_ft.support.terminal import show, terminal
from planner_ft.training.settings import ABOUT, FIELDS, default_text, kind_of
from planner_ft.vocabulary.definition import DEFAULT
from planner_ft.vocabulary.plans import check_level

if TYPE_CHECKING:
    from rich.console import Console


def add_settings(function: Callable[..., None], *without: str) -> None:
    """An option for every training setting `without` some: flags and settings cannot differ."""
    own = inspect.signature(function).parameters.values()
    names = [name for name in FIELDS if name not in without]
    # Shown, the --no- forms would leave too little room for the names of options.
    off = [_off(name) for name in names if kind_of(name)[0] is bool]
    set_parameters(function, [*own, *map(_option, names), *off])


def _off(name: str) -> inspect.Parameter:
    """The flag against a setting that a recipe turns on."""
    flag = typer.Option(typed([f"no_{name}"]), help=f"Without {typed([name])}.", hidden=True)
    return inspect.Parameter(f"no_{name}", OPTION, default=False, annotation=Annotated[bool, flag])


def _given(o: Options) -> dict[str, Any]:
    """The settings that were given."""
    values = {name: value for name, value in vars(o).items() if name in FIELDS}
    values |= {name: False for name in values if getattr(o, f"no_{name}", False)}
    return {name: value for name, value in values.items() if value is not None}


def _option(name: str) -> inspect.Parameter:
    (kind, choices), default, about = kind_of(name), default_text(name), ABOUT[name]
    # Not as a metavar, which would leave too little room for the names of options.
    unnamed = choices if any(choice not in about["help"] for choice in choices) else ()
    text = about["help"] + (f" One of {', '.join(unnamed)}." if unnamed else "")
    text += f" Default: {default}." if default else ""
    flags = (typed([name]),) if kind is bool else ()
    shown = typer.Option(*flags, help=text, rich_help_panel=about["panel"])
    return inspect.Parameter(name, OPTION, default=None, annotation=Annotated[kind | None, shown])


@command
def train(o: Options) -> None:
    """Fine-tune a LoRA adapter on a 4-bit base."""
    from planner_ft.training.request import RUN_KEYS, build_request

    ranks, rerun = join_ranks(), o.take("recipe", "overwrite", "resume")
    with ranks.one_voice():
        request = build_request(o.take(*RUN_KEYS), _given(o), **rerun, ranks=ranks)
    console = terminal(soft_wrap=True)
    if not (o.preview or o.preview_id):
        _train(request, console, ranks)
    elif ranks.leads:
        _preview(request, o.preview_id, console)


add_settings(train)


def _train(request: Any, console: Console, ranks: Ranks) -> None:
    from planner_ft.benchmark.judge import Judge
    from planner_ft.training.loop import InterruptedRunError
    from planner_ft.training.run import train as run_training

    is_helped = ranks.world == 1 and request.is_helped
    try:
        with helped() if is_helped else nullcontext(ranks) as ranks:
            manifest = run_training(request, console, Judge, ranks)
    except InterruptedRunError as stop:
        if ranks.leads:
            done = f"stopped at step {stop.step} of {stop.total}, all saved"
            console.print(f"{done}; continue with:\n  {resume_command()}")
        raise typer.Exit(128 + stop.signal_number) from None
    if manifest:
        for line in _result(request, manifest["result"]):
            console.print(line)


def _result(request: Any, result: dict[str, Any]) -> list[str]:

    loss, tokens, seconds = result["validation_loss"], result["tokens"], result["seconds"]
    best = ""
    if loss is not None:
        best = f", best validation loss {loss:.4f} after epoch {result['best_epoch']:g}"
    return [
        f"{result['steps']} steps, {tokens:,} tokens in {clock(seconds)}"
        f" ({result['tokens_per_s']:.0f} tokens/s), peak memory"
        f" {memory_size(result['peak_memory_bytes'])}{best}",
        *([f"the adapter is {result['change']}"] if "change" in result else []),
        f"adapter: {request.output} ({result['adapter_bytes'] / 1e6:.1f} MB); loss curve in"
        " loss.png, log in train_log.jsonl",
        f"next: plannerft bench {shlex.join(_next(request))}",
    ]


def _next(request: Any) -> list[str]:
    """The arguments of `bench` for the trained adapter: this vehicle's, on the data trained on."""
    vocabulary, candidate = request.vocabulary, request.candidate
    named = str(candidate.folder) if candidate.source == "path" else candidate.name
    words = ["--level", request.level, "--candidates", named, "--configurations", "base,lora"]
    words += ["--adapter", str(request.output)]
    if vocabulary.source != DEFAULT:
        words += ["--vocabulary", vocabulary.source]
    tests = request.train_file.parent / "test.jsonl"
    if tests.is_file() and tests != vocabulary.data / request.level / "test.jsonl":
        words += ["--data", str(tests)]
    return words


def _preview(request: Any, sample_id: str | None, console: Console) -> None:
    from planner_ft.training.run import preview_sample
    from planner_ft.training.samples import preview_text

    sample, tokenizer = preview_sample(request, sample_id)
    console.print(preview_text(sample, tokenizer))
    trained = f"{sample.completion_length} of them trained (between ⟦ and ⟧)"
    console.print(f"{sample.id}: {sample.length} tokens, {trained}")


NAMED = ("level", "candidate", "vocabulary", "data_dir")


@command
def learning_curve(o: Options) -> None:
    """Train on growing parts of the training set and benchmark each."""
    from planner_ft.benchmark.curve import SAMPLES, begin, prepare, run_units, write_curve
    from planner_ft.report.pictures import write_figure
    from planner_ft.training.request import build_request

    flags = _given(o)
    request = build_request(o.given(*NAMED), flags)
    how = o.seeds, o.strength, o.data, o.limit
    curve = prepare(request, o.out, _sizes(o.sizes), *how, flags)
    with alone(o.out, "--out", "a learning curve"):
        begin(curve, resume=o.resume, overwrite=o.overwrite)
        with status(lambda: f"go on with: {resume_command()}") as said:
            run_units(curve, lambda state: said((state.number, state.step), str(state)))
            said("end", "tables and figure")
            write_figure(write_curve(curve), SAMPLES[request.level], o.out)
    show((o.out / "table.md").read_text(encoding="utf-8"))
    figures = "learning-curve.png, learning-curve.svg"
    show(f"{o.out}/: table.md, table.csv, learning_curve.json, {figures}")


add_settings(learning_curve, "seed", "max_samples", "keep_checkpoints")


def _sizes(text: str | None) -> tuple[int, ...] | None:
    try:
        return None if text is None else tuple(int(part) for part in text.split(","))
    except ValueError:
        raise PlannerError(f"--sizes {text}: must be numbers such as 0,8,16") from None


SHOWN = {"plan": "plans", "entry": "tasks or skills", "value": "values"}


@command
def calibrate(o: Options) -> None:
    """Calibrate a candidate's confidence."""
    from planner_ft.benchmark.calibrate import calibrate as run

    level = check_level(o.level)
    named = {f"{level}_configuration": o.configuration, f"{level}_adapter": o.adapter}
    named |= o.take("candidate", "vocabulary", "device", "quantization", "overwrite")
    with alone(o.out, "--out", "a calibration"), interruptible() as report:
        path, manifest = run(level, o.data, o.out, report, **named)
    for kind, found in manifest["held_out"].items():
        right = f"{found['n'] - found['wrong']} of {found['n']} {SHOWN[kind]} right"
        area = f"area under risk-coverage {found['aurc']:.4f}, random {found['aurc_random']:.4f}"
        show(f"{right}; calibration error {found['ece']:.3f}; {area}")
    show(f"{path}: how sure the {level} agent is, of these weights")
    for tests, count in manifest["tests"].items():
        worthless = "figures that are measured on them are worthless; calibrate on other data"
        show(f"warning: {count} inputs of {tests} were calibrated on: {worthless}", error=True)
