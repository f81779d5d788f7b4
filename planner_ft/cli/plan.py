"""`plannerft plan`."""

from __future__ import annotations

import sys
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from planner_ft.cli.progress import Report, interruptible

if TYPE_CHECKING:
    from planner_ft.document import PlanDocument

PATIENCE = 3.0
"""Seconds without an answer after which progress is worth telling."""
AGENTS = "One agent alone"


def plan(
    command: Annotated[
        str,
        typer.Argument(
            help="What the vehicle is to do, in your own words; - reads it from standard input.",
            show_default=False,
        ),
    ],
    locate: Annotated[
        list[str] | None,
        typer.Option(
            help=(
                '"NAME=x,y": where a place lies that the plan leaves open (metres east, north).'
                " Repeatable."
            ),
            show_default=False,
        ),
    ] = None,
    json: Annotated[
        bool,
        typer.Option(
            "--json", help="Print the plan document (schemas/plan.schema.json) instead of a tree."
        ),
    ] = False,
    out: Annotated[
        Path | None,
        typer.Option(
            help="Also write the plan document into this file: what review and export take.",
            show_default=False,
        ),
    ] = None,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace a file that --out names.")
    ] = False,
    mission_only: Annotated[
        bool,
        typer.Option(
            "--mission-only", help="Ask the Mission Agent alone: tasks without their skills."
        ),
    ] = False,
    candidate: Annotated[
        str,
        typer.Option(
            help=(
                "Candidate of both agents: a name that `plannerft candidates` lists, a folder, or a"
                " hub id."
            )
        ),
    ] = "embedded",
    configuration: Annotated[
        str | None,
        typer.Option(
            help="base, lora, and +schema, +state or +grounded; of both agents.",
            show_default="lora+grounded with an adapter, else base+grounded",
        ),
    ] = None,
    vocabulary: Annotated[
        str, typer.Option(help="Vocabulary: a bundled name or a TOML file.")
    ] = "usv",
    device: Annotated[str, typer.Option(help="auto, cpu, cuda or cuda:N.")] = "auto",
    quantization: Annotated[
        str | None,
        typer.Option(
            help="nf4 (4-bit base) or none.", show_default="as the candidate is trained: nf4"
        ),
    ] = None,
    vehicle: Annotated[
        Path | None,
        typer.Option(
            help="TOML file with cruise speed, endurance and operating area of the vehicle.",
            show_default="the vocabulary's",
        ),
    ] = None,
    mission_candidate: Annotated[
        str | None,
        typer.Option(help="Instead of --candidate.", show_default=False, rich_help_panel=AGENTS),
    ] = None,
    task_candidate: Annotated[
        str | None,
        typer.Option(help="Instead of --candidate.", show_default=False, rich_help_panel=AGENTS),
    ] = None,
    mission_adapter: Annotated[
        Path | None,
        typer.Option(
            help="Adapter folder.",
            show_default="adapters/CANDIDATE/mission, else the package's",
            rich_help_panel=AGENTS,
        ),
    ] = None,
    task_adapter: Annotated[
        Path | None,
        typer.Option(
            help="Adapter folder.",
            show_default="adapters/CANDIDATE/task, else the package's",
            rich_help_panel=AGENTS,
        ),
    ] = None,
    mission_configuration: Annotated[
        str | None,
        typer.Option(
            help="Instead of --configuration.", show_default=False, rich_help_panel=AGENTS
        ),
    ] = None,
    task_configuration: Annotated[
        str | None,
        typer.Option(
            help="Instead of --configuration.", show_default=False, rich_help_panel=AGENTS
        ),
    ] = None,
) -> None:
    """Plan a command with both agents: tasks, the skills of each, what is taken for granted and
    what it cost.

    Places that the command gives no coordinates for stay open and are named; --locate fills them
    in. Exits with 1 when an answer is not valid: it is shown with what is wrong. A person approves
    a plan before anything moves.
    """
    named = {
        "candidate": candidate,
        "mission_candidate": mission_candidate,
        "task_candidate": task_candidate,
        "mission_adapter": mission_adapter,
        "task_adapter": task_adapter,
        "configuration": configuration,
        "mission_configuration": mission_configuration,
        "task_configuration": task_configuration,
        "vocabulary": vocabulary,
        "device": device,
        "quantization": quantization,
        "mission_only": mission_only,
    }
    document = _plan(command, locate or [], out, overwrite, vehicle, named)
    _print(document, json)
    if out is not None:
        from planner_ft.document import write_document

        write_document(out, document)
        typer.echo(f"{out}: next, plannerft review {out}", err=True)
    if not document["valid"]:
        raise typer.Exit(1)


def _plan(
    command: str,
    locate: list[str],
    out: Path | None,
    overwrite: bool,
    vehicle: Path | None,
    named: dict[str, Any],
) -> PlanDocument:
    """Check what was said, then plan."""
    from planner_ft.document import build
    from planner_ft.document.ontology import check
    from planner_ft.document.vehicle import load_vehicle
    from planner_ft.planning.locations import parse_locations
    from planner_ft.planning.planner import Planner, check_command, new_file, read_command
    from planner_ft.planning.settings import PlanSettings

    if out is not None:
        new_file(out, overwrite=overwrite)
    locations = parse_locations(locate)
    text = check_command(read_command(sys.stdin.buffer) if command == "-" else command)
    with (
        interruptible(None) as report,
        Patient(report) as patient,
        Planner(PlanSettings(**named), patient) as planner,
    ):
        profile = load_vehicle(vehicle, planner.vocabulary)
        for question in check(text, planner.vocabulary)["questions"]:
            typer.echo(f"the command does not say: {question}", err=True)
        return build(planner.plan(text, locations), planner.vocabulary, profile)


def _print(document: PlanDocument, json: bool) -> None:
    if json:
        from planner_ft.support.files import indented_json

        typer.echo(indented_json(document), nl=False)
        return
    from planner_ft.document.tree import plan_tree

    typer.echo(plan_tree(document))


class Patient:
    """Progress that is told once PATIENCE is over: a short wait needs no words."""

    def __init__(self, report: Report) -> None:
        self.report = report
        self.last: tuple[str, int, int] | None = None
        self.timer = threading.Timer(PATIENCE, self._speak)
        self.timer.daemon = True

    def __call__(self, label: str, done: int, total: int) -> None:
        self.last = (label, done, total)
        if self.timer.finished.is_set():
            self.report(label, done, total)

    def __enter__(self) -> Patient:
        self.timer.start()
        return self

    def __exit__(self, *_error: object) -> None:
        self.timer.cancel()

    def _speak(self) -> None:
        if self.last is not None:
            self.report(*self.last)
