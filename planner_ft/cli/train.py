"""`plannerft train`."""

from __future__ import annotations

import inspect
import shlex
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any

import typer

from planner_ft.cli.options import command, set_parameters
from planner_ft.cli.progress import resume_command
from planner_ft.support.ranks import Ranks, join_ranks
from planner_ft.support.terminal import terminal
from planner_ft.training.settings import ABOUT, FIELDS, default_text, kind_of
from planner_ft.vocabulary.definition import DEFAULT

if TYPE_CHECKING:
    from rich.console import Console


def with_settings(*without: str) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """An option for every training setting `without` some, so that flags, recipes and settings
    cannot differ.
    """

    def decorate(function: Callable[..., None]) -> Callable[..., None]:
        own, kind = inspect.signature(function).parameters.values(), inspect.Parameter.KEYWORD_ONLY
        settings = (
            inspect.Parameter(name, kind, default=None, annotation=_option(name))
            for name in FIELDS
            if name not in without
        )
        set_parameters(function, [*own, *settings])
        return function

    return decorate


def _option(name: str) -> Any:
    (kind, choices), default = kind_of(name), default_text(name)
    flag = name.replace("_", "-")
    flags = f"--{flag}/--no-{flag}" if kind is bool else f"--{flag}"
    return Annotated[
        kind | None,
        typer.Option(
            flags,
            help=ABOUT[name]["help"] + (f" Default: {default}." if default else ""),
            metavar="|".join(choices) or None,
            rich_help_panel=ABOUT[name]["panel"],
        ),
    ]


@with_settings()
@command
def train(
    level: str | None = None,
    candidate: str | None = None,
    recipe: str | None = None,
    data_dir: str | None = None,
    train_file: str | None = None,
    validation_file: str | None = None,
    corrections: str | None = None,
    vocabulary: str | None = None,
    output: str | None = None,
    overwrite: bool = False,
    resume: bool = False,
    preview: bool = False,
    preview_id: str | None = None,
    **settings: Any,
) -> None:
    """Fine-tune a LoRA adapter on a 4-bit base."""

    from planner_ft.training.request import RUN_KEYS, build_request

    options, ranks = locals(), join_ranks()
    names = {name: options[name] for name in RUN_KEYS}
    with ranks.one_voice():
        request = build_request(
            names, settings, recipe=recipe, overwrite=overwrite, resume=resume, ranks=ranks
        )
    console = terminal(soft_wrap=True)
    if not (preview or preview_id):
        _train(request, console, ranks)
    elif ranks.leads:
        _preview(request, preview_id, console)


def _train(request: Any, console: Console, ranks: Ranks) -> None:
    from planner_ft.benchmark.judge import Judge
    from planner_ft.training.loop import InterruptedRunError
    from planner_ft.training.run import train as run_training

    try:
        manifest = run_training(request, console, Judge, ranks)
    except InterruptedRunError as stop:
        if not ranks.leads:
            raise typer.Exit(128 + stop.signal_number) from None
        done = f"stopped at step {stop.step} of {stop.total}, all saved"
        console.print(f"{done}; continue with:\n  {resume_command()}", markup=False)
        raise typer.Exit(128 + stop.signal_number) from None
    if manifest:
        for line in _result(request, manifest["result"]):
            console.print(line, markup=False)


def _result(request: Any, result: dict[str, Any]) -> list[str]:
    from planner_ft.support.resources import clock, memory_size

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
    console.print(f"{sample.id}: {sample.length} tokens, {trained}", markup=False)
