"""`plannerft plan`."""

from __future__ import annotations

import sys
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from planner_ft.cli.options import command
from planner_ft.cli.progress import Report, interruptible
from planner_ft.support.terminal import show

if TYPE_CHECKING:
    from planner_ft.document import PlanDocument

PLANNING = (
    *("candidate", "mission_candidate", "task_candidate", "mission_adapter", "task_adapter"),
    *("configuration", "mission_configuration", "task_configuration"),
    *("vocabulary", "device", "quantization", "mission_only"),
)
"""Options that are settings of the planner."""
PLACES = ("locate", "locate_file", "origin", "area")
PATIENCE = 3.0
"""Seconds without an answer before progress is shown: a short wait needs none."""


@command
def plan(command: str, **options: Any) -> None:
    """Plan a command with both agents."""
    from planner_ft.document import write_document
    from planner_ft.document.tree import plan_tree
    from planner_ft.planning.planner import new_file
    from planner_ft.support.files import indented_json

    out, json = options["out"], options["json"]
    if out is not None:
        new_file(out, overwrite=options["overwrite"])
    named = {name: options[name] for name in PLANNING}
    places = {name: options[name] for name in PLACES}
    document = _plan(command, options["vehicle"], named, places)
    show(indented_json(document) if json else plan_tree(document), end="" if json else "\n")
    if out is not None:
        write_document(out, document)
        show(f"{out}: next, plannerft review {out}", error=True)
    if not document["valid"]:
        raise typer.Exit(1)


def _plan(
    command: str, vehicle: Path | None, named: dict[str, Any], places: dict[str, Any]
) -> PlanDocument:
    """Check the options, then plan."""
    from dataclasses import replace

    from planner_ft.document import build
    from planner_ft.document.ontology import check
    from planner_ft.document.vehicle import check_area, load_vehicle
    from planner_ft.document.warnings.command import other_language
    from planner_ft.planning.chart import read_area, read_places
    from planner_ft.planning.locations import parse_locations
    from planner_ft.planning.planner import Planner, check_command, read_command
    from planner_ft.planning.settings import PlanSettings
    from planner_ft.support.geodesy import parse_origin

    origin = parse_origin(places["origin"]) if places["origin"] is not None else None
    locations = parse_locations(places["locate"] or [])
    chart = read_places(places["locate_file"], origin) if places["locate_file"] else {}
    corners = check_area(read_area(places["area"], origin)) if places["area"] else None
    text = check_command(read_command(sys.stdin.buffer) if command == "-" else command)
    with (
        interruptible() as report,
        Patient(report) as patient,
        Planner(PlanSettings(**named), patient) as planner,
    ):
        profile = load_vehicle(vehicle, planner.vocabulary)
        profile = replace(profile, area=corners) if corners else profile
        if doubt := other_language(text):
            show(doubt, error=True)
        for question in check(text, planner.vocabulary)["questions"]:
            show(f"the command does not say: {question}", error=True)
        planned = planner.plan(text, locations, origin=origin, chart=chart)
        return build(planned, planner.vocabulary, profile)


class Patient:
    """Progress that is shown once PATIENCE is over."""

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
