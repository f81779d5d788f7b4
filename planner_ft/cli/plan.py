"""`plannerft plan`."""

from __future__ import annotations

import sys
import threading
from typing import TYPE_CHECKING

import typer

from planner_ft.cli.options import Options, command
from planner_ft.cli.progress import interruptible
from planner_ft.support.terminal import Report, show

if TYPE_CHECKING:
    from planner_ft.document import PlanDocument

PLANNING = (
    *("candidate", "mission_candidate", "task_candidate", "mission_adapter", "task_adapter"),
    *("configuration", "mission_configuration", "task_configuration"),
    *("vocabulary", "device", "quantization", "mission_only"),
)
"""Options that are settings of the planner."""
PATIENCE = 3.0
"""Seconds without an answer before progress is shown: a short wait needs none."""


@command
def plan(o: Options) -> None:
    """Plan a command with both agents."""
    from planner_ft.document import write_document
    from planner_ft.document.tree import plan_tree
    from planner_ft.planning.planner import new_file
    from planner_ft.support.files import indented_json

    if o.out is not None:
        new_file(o.out, overwrite=o.overwrite)
    document = _plan(o)
    show(indented_json(document) if o.json else plan_tree(document), end="" if o.json else "\n")
    if o.out is not None:
        write_document(o.out, document)
        show(f"{o.out}: next, plannerft review {o.out}", error=True)
    if not document["valid"]:
        raise typer.Exit(1)


def _plan(o: Options) -> PlanDocument:
    """Check the options, then plan."""
    from dataclasses import replace

    from planner_ft.document import build
    from planner_ft.document.ontology import check
    from planner_ft.document.vehicle import check_area, load_vehicle
    from planner_ft.document.warnings.asked import other_language
    from planner_ft.planning.locations import parse_locations, read_area, read_places
    from planner_ft.planning.planner import Planner, check_command, read_command
    from planner_ft.planning.settings import PlanSettings
    from planner_ft.support.geodesy import parse_origin

    origin = parse_origin(o.origin) if o.origin is not None else None
    locations = parse_locations(o.locate or [])
    chart = read_places(o.locate_file, origin) if o.locate_file else {}
    corners = check_area(read_area(o.area, origin)) if o.area else None
    text = check_command(read_command(sys.stdin.buffer) if o.command == "-" else o.command)
    with (
        interruptible() as report,
        Patient(report) as patient,
        Planner(PlanSettings(**o.take(*PLANNING)), patient) as planner,
    ):
        profile = load_vehicle(o.vehicle, planner.vocabulary)
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
