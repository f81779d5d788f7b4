"""`plannerft train`."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Annotated, Any, Literal, get_args, get_origin

import typer

from planner_ft.training.settings import ABOUT, FIELDS, PANELS, TYPES, default_text

RUN = "Data and output"


def _with_settings(function: Callable[..., None]) -> Callable[..., None]:
    """Give the command an option for every training setting, so that flags, recipes and settings
    cannot drift apart.
    """
    signature = inspect.signature(function, eval_str=True)
    own = [
        parameter
        for parameter in signature.parameters.values()
        if parameter.kind is not inspect.Parameter.VAR_KEYWORD
    ]
    options = [
        inspect.Parameter(
            name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=_option(name)
        )
        for name in FIELDS
    ]
    parameters = [
        parameter.replace(kind=inspect.Parameter.KEYWORD_ONLY) for parameter in own
    ] + options
    function.__signature__ = signature.replace(parameters=parameters)  # type: ignore[attr-defined]
    function.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    return function


def _option(name: str) -> Any:
    annotation = TYPES[name]
    default = default_text(name)
    help_text = ABOUT[name]["help"] + (f" Default: {default}." if default else "")
    kind: Any = (
        str
        if get_origin(annotation) is Literal
        else next((part for part in get_args(annotation) if part is not type(None)), annotation)
    )
    metavar = "|".join(get_args(annotation)) if get_origin(annotation) is Literal else None
    flag = f"--{name.replace('_', '-')}"
    option = typer.Option(
        f"{flag}/--no-{flag[2:]}" if kind is bool else flag,
        help=help_text,
        metavar=metavar,
        rich_help_panel=PANELS[ABOUT[name]["panel"]],
        show_default=False,
    )
    return Annotated[kind | None, option]


@_with_settings
def train(
    level: Annotated[
        str | None,
        typer.Option(
            help="mission (commands to tasks) or task (tasks to skills).",
            show_default=False,
            rich_help_panel=RUN,
        ),
    ] = None,
    candidate: Annotated[
        str | None,
        typer.Option(
            help="A name that `plannerft candidates` lists, a folder, or a hub id.",
            show_default=False,
            rich_help_panel=RUN,
        ),
    ] = None,
    recipe: Annotated[
        str | None,
        typer.Option(
            help="Recipe file (TOML) or the name of a bundled one; flags overrule it.",
            show_default=False,
            rich_help_panel=RUN,
        ),
    ] = None,
    data_dir: Annotated[
        str | None,
        typer.Option(
            help="Folder with train.jsonl and validation.jsonl. Default: data/LEVEL.",
            show_default=False,
            rich_help_panel=RUN,
        ),
    ] = None,
    train_file: Annotated[
        str | None,
        typer.Option(
            help="Training split, instead of --data-dir.", show_default=False, rich_help_panel=RUN
        ),
    ] = None,
    validation_file: Annotated[
        str | None,
        typer.Option(
            help="Validation split; none: no validation.", show_default=False, rich_help_panel=RUN
        ),
    ] = None,
    corrections: Annotated[
        str | None,
        typer.Option(
            help="JSONL of `review --harvest`, added to the training split alone.",
            show_default=False,
            rich_help_panel=RUN,
        ),
    ] = None,
    vocabulary: Annotated[
        str | None,
        typer.Option(
            help="Vocabulary: a bundled name or a TOML file. Default: usv.",
            show_default=False,
            rich_help_panel=RUN,
        ),
    ] = None,
    output: Annotated[
        str | None,
        typer.Option(
            help="Adapter folder. Default: adapters/CANDIDATE/LEVEL.",
            show_default=False,
            rich_help_panel=RUN,
        ),
    ] = None,
    overwrite: Annotated[
        bool,
        typer.Option(
            "--overwrite",
            help="Remove what an earlier run left in the output folder.",
            rich_help_panel=RUN,
        ),
    ] = False,
    resume: Annotated[
        bool,
        typer.Option(
            "--resume",
            help="Continue an interrupted run: same losses as without the interruption.",
            rich_help_panel=RUN,
        ),
    ] = False,
    preview: Annotated[
        bool,
        typer.Option(
            "--preview",
            help="Show the first sample with the trained part in colour, and stop.",
            rich_help_panel=RUN,
        ),
    ] = False,
    preview_id: Annotated[
        str | None,
        typer.Option(
            help="Show the sample of this id, and stop.", show_default=False, rich_help_panel=RUN
        ),
    ] = None,
    **settings: Any,
) -> None:
    """Fine-tune a LoRA adapter on a 4-bit base. Only level and candidate are needed: the published
    settings are the defaults.
    """
    from rich.console import Console

    from planner_ft.training.request import build_request

    names = {
        "level": level,
        "candidate": candidate,
        "vocabulary": vocabulary,
        "data_dir": data_dir,
        "train_file": train_file,
    }
    names |= {"validation_file": validation_file, "corrections": corrections, "output": output}
    request = build_request(names, settings, recipe=recipe, overwrite=overwrite, resume=resume)
    console = Console()
    if preview or preview_id:
        _preview(request, preview_id, console)
        return
    _train(request, console)


def _train(request: Any, console: Any) -> None:
    from planner_ft.training.loop import InterruptedRunError
    from planner_ft.training.run import train as run_training

    try:
        manifest = run_training(request, console)
    except InterruptedRunError as stop:
        console.print(
            f"stopped at step {stop.step} of {stop.total}, all saved; continue with:\n "
            f" {_resume_command()}",
            markup=False,
            highlight=False,
            soft_wrap=True,
        )
        raise typer.Exit(128 + stop.signal_number) from None
    if manifest:
        _print_result(request, manifest, console)


def _resume_command() -> str:
    """The command line of this process with --resume instead of --overwrite."""
    import shlex
    import sys

    return shlex.join(
        [
            "plannerft",
            *(word for word in sys.argv[1:] if word not in ("--overwrite", "--resume")),
            "--resume",
        ]
    )


def _print_result(request: Any, manifest: dict[str, Any], console: Any) -> None:
    from planner_ft.support.resources import clock, memory_size

    result = manifest["result"]
    speed = (
        f"{result['steps']} steps, {result['tokens']:,} tokens in {clock(result['seconds'])}"
        f" ({result['tokens_per_s']:.0f} tokens/s)"
    )
    best = (
        f", best validation loss {result['validation_loss']:.4f} after epoch"
        f" {result['best_epoch']:g}"
        if result["validation_loss"] is not None
        else ""
    )
    lines = [
        f"{speed}, peak memory {memory_size(result['peak_memory_bytes'])}{best}",
        (
            f"adapter: {request.output} ({result['adapter_bytes'] / 1e6:.1f} MB); loss curve in"
            " loss.png, log in train_log.jsonl"
        ),
        (
            f"next: plannerft bench --level {request.level} --candidates {request.candidate.name}"
            f" --configurations base,lora --adapter {request.output}"
        ),
    ]
    for line in lines:
        console.print(line, markup=False, highlight=False, soft_wrap=True)


def _preview(request: Any, sample_id: str | None, console: Any) -> None:
    from planner_ft.training.preview import preview_caption, preview_text
    from planner_ft.training.run import preview_sample

    sample, tokenizer = preview_sample(request, sample_id)
    console.print(preview_text(sample, tokenizer), soft_wrap=True)
    console.print(preview_caption(sample), markup=False, highlight=False)
