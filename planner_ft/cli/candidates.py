"""`plannerft candidates` and `plannerft doctor`: the models, and the installation."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from planner_ft.cli.options import Options, command
from planner_ft.support.terminal import show, terminal

if TYPE_CHECKING:
    from rich.table import Table
    from rich.text import Text

ESTIMATES = (
    "Estimates, not measurements. Memory: 4-bit weights, batch size 1; to train an adapter on 1024"
    " tokens, to run it on 2048 tokens. * with gradient checkpointing. Time on the study's RTX"
    " 4070: the published trainings (minutes for missions, hours for tasks), a mission's answer in"
    " seconds."
)
PAGE = "https://huggingface.co/REPOSITORY"
GATED = f" (gated ones: first accept the licence at {PAGE} and run `hf auth login`)"
OFFLINE = "Without a network, copy it to a sub-folder of its name in a folder that PLANNERFT_MODELS"
FIGURES = (
    *("weights", "train, GiB", "GPU, GB", "run, GiB", "GPU, GB"),
    *("mission, min", "task, h", "answer, s"),
)
SHORTENED = (" Community", " License", " (non-commercial)")


@command
def candidates(o: Options) -> None:
    """List the models."""
    from planner_ft.candidates import all_candidates, resolve_candidate
    from planner_ft.candidates.diagnosis import describe
    from planner_ft.support.files import indented_json

    chosen = [resolve_candidate(name) for name in o.names] if o.names else all_candidates()
    rows = [describe(candidate) for candidate in chosen]
    if o.json:
        show(indented_json(rows), end="")
        return
    if o.markdown:
        lines = [("candidate", *FIGURES), ("---", *["---:"] * len(FIGURES)), *map(_figures, rows)]
        text = "\n".join(f"| {' | '.join(line)} |" for line in lines).replace("*", "\\*")
        show(f"{text}\n\n{ESTIMATES}")
        return
    console = terminal(soft_wrap=True)
    console.print(_table(rows), soft_wrap=False)
    console.print(ESTIMATES, soft_wrap=False)
    missing = [row for row in rows if row["command"]]
    for row in rows:
        if note := row["problem"] or (row["get"] if row not in missing else None):
            console.print(f"{row['name']}: {note}", style="yellow")
    if missing:
        gated = GATED if any(row["gated"] for row in missing) else ""
        console.print(f"\nTo get one that is not here{gated}:")
        for row in missing:
            console.print(f"  {row['command']}", markup=False)
        console.print(f"{OFFLINE} names.")


@command
def doctor(o: Options) -> None:
    """Check this installation."""
    from planner_ft.candidates.diagnosis import diagnose
    from planner_ft.support.files import indented_json

    found = diagnose()
    if o.json:
        show(indented_json({**found.sections, "warnings": found.warnings}), end="")
        return
    for title, entries in found.sections.items():
        show(title)
        for name, value in entries.items():
            show(f"  {name}: {_text(value)}")
    show(f"warnings: {len(found.warnings) or 'none'}")
    for warning in found.warnings:
        show(f"  - {warning}")


def _text(value: Any) -> str:
    if isinstance(value, dict):
        shown = [item for item in value.items() if item[1] is not None and item[1] is not False]
        return ", ".join(f"{name} {_text(item)}" for name, item in shown)
    return "not set" if value is None else "yes" if value is True else str(value)


def _table(rows: list[dict[str, Any]]) -> Table:
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    table = Table(box=SIMPLE_HEAD, show_edge=False, pad_edge=False, padding=(0, 1, 0, 0))
    table.add_column("candidate", no_wrap=True)
    for heading in FIGURES:
        table.add_column(heading.replace(", ", "\n"), justify="right", no_wrap=True)
    table.add_column("licence", overflow="fold")
    table.add_column("here", overflow="fold")
    for row in rows:
        licence = row["licence"]
        for part in SHORTENED:
            licence = licence.replace(part, "")
        table.add_row(*_figures(row), licence, _here(row))
    return table


def _figures(row: dict[str, Any]) -> tuple[str, ...]:
    """The name of a candidate and its FIGURES as cells."""
    return row["name"], _count(row["parameters"]), *_memory(row["memory"]), *_times(row["times"])


def _times(times: dict[str, Any] | None) -> tuple[str, str, str]:
    """Cells: minutes and hours of the published trainings, seconds of an answer."""
    if times is None:
        return "?", "?", "?"
    minutes, hours = times["train_mission_s"] / 60, times["train_task_s"] / 3600
    return f"{minutes:.0f}", f"{hours:.1f}", f"{times['answer_s']:.0f}"


def _here(row: dict[str, Any]) -> Text:
    from rich.text import Text

    if row["problem"]:
        return Text("incomplete", "red")
    if row["standin"]:
        return Text("stand-in", "yellow")
    if row["here"]:
        return Text(row["source"], "green")
    return Text("no, gated" if row["gated"] else "no")


def _count(parameters: int | None) -> str:
    if parameters is None:
        return "?"
    return f"{parameters / 1e9:.2f} B" if parameters >= 1e9 else f"{parameters / 1e6:.2f} M"


def _memory(memory: dict[str, Any] | None) -> tuple[str, str, str, str]:
    """Cells: GiB to train, the smallest GPU for it, GiB to run, the smallest GPU for that."""
    if memory is None:
        return "?", "?", "?", "?"

    def smallest(kind: str, *unfit: str) -> str:
        fits = (gpu for gpu, fit in memory[f"{kind}_fits"].items() if fit not in unfit)
        return next(fits, "").replace(" GB", "")

    plain, saving = smallest("train", "no", "checkpointing"), smallest("train", "no")
    gpus = plain if saving == plain else f"{plain} {saving}*".strip()
    return (
        f"{memory['train_gib']:.1f} {memory['train_checkpointing_gib']:.1f}*",
        gpus or "larger",
        f"{memory['infer_gib']:.1f}",
        smallest("infer", "no") or "larger",
    )
