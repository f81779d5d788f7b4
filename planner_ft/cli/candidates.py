"""`plannerft candidates`: which models there are, what they need and where they are."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table


def candidates(
    names: Annotated[
        list[str] | None,
        typer.Argument(
            help="Only these: names, hub ids (org/name) or folders. Default: every registered one.",
            show_default=False,
        ),
    ] = None,
    json: Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")] = False,
) -> None:
    """List the models that can be trained and benchmarked: size, licence, estimated memory, and
    where they are or how to get them.
    """
    from planner_ft.candidates import all_candidates, resolve_candidate
    from planner_ft.candidates.listing import describe

    descriptions = [
        describe(candidate)
        for candidate in (
            [resolve_candidate(name) for name in names] if names else all_candidates()
        )
    ]
    if json:
        from json import dumps

        print(dumps(descriptions, indent=2, ensure_ascii=False))
        return
    from rich.console import Console

    console = Console(highlight=False)
    console.print(_table(descriptions))
    console.print(
        "Estimates: 4-bit weights, batch size 1; to train an adapter on 1024 tokens, to run it on"
        " 2048 tokens. * with gradient checkpointing."
    )
    for description in descriptions:
        if note := description["problem"] or (
            description["get"] if not description["command"] else None
        ):
            console.print(f"{description['name']}: {note}", style="yellow", soft_wrap=True)
    _print_downloads(
        console, [description for description in descriptions if description["command"]]
    )


def _print_downloads(console: Console, missing: list[dict[str, Any]]) -> None:
    if not missing:
        return
    gated = (
        " (gated ones: first accept the licence at https://huggingface.co/REPOSITORY and run `hf"
        " auth login`)"
    )
    console.print(
        "\nTo get one that is not"
        f" here{gated if any(description['gated'] for description in missing) else ''}:",
        soft_wrap=True,
    )
    for description in missing:
        console.print(f"  {description['command']}", soft_wrap=True, markup=False)
    console.print(
        "Without a network, copy it to a sub-folder of its name in a folder that PLANNERFT_MODELS"
        " names.",
        soft_wrap=True,
    )


def _table(descriptions: list[dict[str, Any]]) -> Table:
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    table = Table(box=SIMPLE_HEAD, show_edge=False, pad_edge=False, padding=(0, 1, 0, 0))
    table.add_column("candidate", no_wrap=True)
    for heading in ("weights", "train\nGiB", "GPU\nGB", "run\nGiB", "GPU\nGB"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("licence", overflow="fold")
    table.add_column("here", overflow="fold")
    for description in descriptions:
        licence = (
            description["licence"]
            .replace(" Community", "")
            .replace(" License", "")
            .replace(" (non-commercial)", "")
        )
        table.add_row(
            description["name"],
            _count(description["parameters"]),
            *_memory(description["memory"]),
            licence,
            _here(description),
        )
    return table


def _here(description: dict[str, Any]) -> str:
    if description["problem"]:
        return "[red]incomplete[/red]"
    if description["standin"]:
        return "[yellow]stand-in[/yellow]"
    return (
        f"[green]{description['source']}[/green]"
        if description["here"]
        else f"no{', gated' if description['gated'] else ''}"
    )


def _count(parameters: int | None) -> str:
    if parameters is None:
        return "?"
    return f"{parameters / 1e9:.2f} B" if parameters >= 1e9 else f"{parameters / 1e6:.2f} M"


def _memory(memory: dict[str, Any] | None) -> tuple[str, str, str, str]:
    """Cells: GiB to train, the smallest GPU for it, GiB to run, the smallest GPU for that."""
    if memory is None:
        return "?", "?", "?", "?"
    train = [gpu for gpu, fits in memory["train_fits"].items() if fits == "yes"][:1]
    saving = [f"{gpu}*" for gpu, fits in memory["train_fits"].items() if fits != "no"][:1]
    gpus = train if saving == [f"{gpu}*" for gpu in train] else [*train, *saving]
    infer = [gpu for gpu, fits in memory["infer_fits"].items() if fits == "yes"][:1]
    amount = f"{memory['train_gib']:.1f} {memory['train_checkpointing_gib']:.1f}*"
    return (
        amount,
        " ".join(gpus).replace(" GB", "") or "larger",
        f"{memory['infer_gib']:.1f}",
        "".join(infer).replace(" GB", "") or "larger",
    )
