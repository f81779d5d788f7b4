"""`plannerft plan`."""

from __future__ import annotations

import contextlib
import sys
import threading
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from planner_ft.cli.options import Options, command, interruptible, typed
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import indented_json
from planner_ft.support.geodesy import parse_origin
from planner_ft.support.resources import open_torch, uncollected
from planner_ft.support.terminal import Report, show, terminal
from planner_ft.vocabulary import Vocabulary, load_vocabulary

if TYPE_CHECKING:
    from planner_ft.document import PlanDocument

PATIENCE = 3.0
"""Seconds without an answer before progress is shown: a short wait needs none."""


@command
@uncollected()
def plan(o: Options) -> None:
    """Plan a command with both agents."""
    from planner_ft.document import write_document
    from planner_ft.document.tree import plan_tree
    from planner_ft.planning.planner import new_file

    if o.out is not None:
        new_file(o.out, overwrite=o.overwrite)
    open_torch()
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
    from planner_ft.document.losses import lost
    from planner_ft.document.ontology import check
    from planner_ft.document.vehicle import check_area, load_vehicle
    from planner_ft.document.warnings.asked import other_language
    from planner_ft.planning.locations import parse_locations, read_area, read_places
    from planner_ft.planning.planner import Planner, check_command, read_command
    from planner_ft.planning.settings import PlanSettings, untrained

    origin = parse_origin(o.origin) if o.origin is not None else None
    locations = parse_locations(o.locate or [])
    chart = read_places(o.locate_file, origin) if o.locate_file else {}
    corners = check_area(read_area(o.area, origin)) if o.area else None
    text = check_command(read_command(sys.stdin.buffer) if o.command == "-" else o.command)
    with (
        interruptible() as report,
        patient(report) as progress,
        Planner(o.into(PlanSettings), progress, lost) as planner,
    ):
        profile = load_vehicle(o.vehicle, planner.vocabulary)
        profile = replace(profile, area=corners) if corners else profile
        # Loading a model leaves Python to others, who read the words of the language meanwhile.
        reading = threading.Thread(target=_read, args=(planner.vocabulary,), daemon=True)
        reading.start()
        planner.agents.load("mission")
        reading.join()
        if doubt := other_language(text):
            show(doubt, error=True)
        for question in check(text, planner.vocabulary)["questions"]:
            show(f"the command does not say: {question}", error=True)
        for doubt in untrained(planner.agents.agents, planner.vocabulary):
            show(doubt, error=True)
        planned = planner.plan(text, locations, origin=origin, chart=chart)
        return build(planned, planner.vocabulary, profile)


def _read(vocabulary: Vocabulary) -> None:
    from planner_ft.document.language import language

    with contextlib.suppress(PlannerError):  # The first check raises it again.
        language(vocabulary)


@contextlib.contextmanager
def patient(report: Report) -> Iterator[Report]:
    """Progress that is shown once PATIENCE is over."""
    last: list[tuple[str, int, int]] = []

    def speak() -> None:
        with contextlib.suppress(KeyboardInterrupt):  # The main thread has its own.
            for state in last:
                report(*state)

    timer = threading.Timer(PATIENCE, speak)
    timer.daemon = True

    def reporting(label: str, done: int, total: int) -> None:
        last[:] = [(label, done, total)]
        if timer.finished.is_set():
            report(label, done, total)

    timer.start()
    try:
        yield reporting
    finally:
        timer.cancel()


DECISIONS = ("show", "adopt", "edit", "approve", "acknowledge", "reject")
SERVING = ("port", "host", "no_browser")
HARVESTING = ("out", "overwrite")


@command
def review(o: Options) -> None:
    """Read, edit, approve or reject a plan."""
    if o.harvest:
        from planner_ft.review.harvest import harvest_files

        _refuse("--harvest", o, "web", "origin", *DECISIONS, *SERVING)
        how = o.take("overwrite", "vocabulary")
        for line in harvest_files(o.plans or [], o.log, o.out, **how).lines():
            show(line)
    elif o.web:
        _refuse("--web", o, *DECISIONS, *HARVESTING)
        _serve(o)
    else:
        _refuse("a review in the terminal", o, *SERVING, *HARVESTING)
        _review(o)


def _refuse(mode: str, o: Options, *names: str) -> None:
    """Raise PlannerError for options that this kind of review has no use for."""
    for name in o.given(*names):
        raise PlannerError(f"{typed([name])} does not go with {mode}; leave one of them out")


def _plans(o: Options, way_out: str, *counts: int) -> list[Path]:
    plans: list[Path] = o.plans or []
    if len(plans) not in counts:
        raise PlannerError(f"{len(plans)} plans are given; {way_out}")
    return plans


def _review(o: Options) -> None:
    from planner_ft.review.desk import open_desk
    from planner_ft.review.terminal import Conversation

    way_out = "one is reviewed at a time, such as plannerft review plan.json"
    (plan,) = _plans(o, way_out, 1)
    edits, acknowledged = o.edit or [], o.acknowledge or []
    if o.origin is not None:
        edits = [f"origin {o.origin}", *edits]
    desk = open_desk(plan, o.log, o.vocabulary, o.name, o.candidate, o.device)
    reviewer = Conversation(desk, terminal(soft_wrap=True))
    if o.approve and o.reject is not None:
        raise PlannerError("--approve and --reject exclude each other; leave one of them out")
    if o.adopt or edits or o.approve or o.reject is not None:
        reviewer.decide(o.adopt, edits, o.approve, acknowledged, o.reject)
    elif acknowledged:
        raise PlannerError("--acknowledge goes with --approve; give both")
    elif o.show or not (sys.stdin.isatty() and sys.stdout.isatty()):
        reviewer.show()
    else:
        try:
            reviewer.converse()
        except KeyboardInterrupt:
            show("\ninterrupted; every edit and every decision that was confirmed is saved")
            raise typer.Exit(130) from None


def _serve(o: Options) -> None:
    from planner_ft.exporters import run as exporting
    from planner_ft.review.desk import planning_of
    from planner_ft.review.web import WebSettings, serve
    from planner_ft.simulation.run import run_live

    way_out = "one is opened, and the page offers the others of its folder"
    plan = next(iter(_plans(o, way_out, 0, 1)), None)
    given = o.given("host", "port", "log")
    if o.origin is not None:
        given["origin"] = parse_origin(o.origin)
    given |= {"reviewer": o.name or "", "exporting": exporting, "runner": run_live}
    planning = planning_of(plan, o.vocabulary, o.candidate, o.device)
    serve(plan, WebSettings(planning=planning, open_browser=not o.no_browser, **given))


@command
def verify(o: Options) -> None:
    """Check that a plan is exactly what a person approved."""
    if o.plan is not None:
        _verify_plan(o.plan, o.log, o.json, o.vocabulary)
    elif o.log is not None:
        _verify_log(o.log, o.json)
    else:
        ways = "give a plan, such as plannerft verify plan.json, or a log with --log"
        raise PlannerError(f"nothing to verify: {ways}")


def _verify_plan(plan: Path, log: Path | None, json: bool, vocabulary: str | None) -> None:
    from planner_ft.document import read_document
    from planner_ft.review.approval import approval_of
    from planner_ft.review.log import existing_log, log_beside
    from planner_ft.review.terminal import approval_text

    document = read_document(plan, load_vocabulary(vocabulary) if vocabulary else None)
    approval = approval_of(document, existing_log(log) if log else log_beside(plan))
    if json:
        show(indented_json({"plan": str(plan), **asdict(approval)}), end="")
    else:
        show("\n".join(approval_text(approval)))
    raise typer.Exit(0 if approval.status == "approved" else 1)


def _verify_log(log: Path, json: bool) -> None:
    from planner_ft.review.log import check_log, existing_log, way_out

    chain = check_log(existing_log(log))
    torn = len(chain.torn)
    if torn and not chain.lines and not chain.torn.startswith(b"{"):
        raise PlannerError(f"{log}: is no approval log; give the one that `plannerft review` wrote")
    if json:
        problems = [problem._asdict() for problem in chain.problems]
        found = {"records": chain.lines, "problems": problems, "unfinished_bytes": torn}
        show(indented_json({"log": str(log), **found}), end="")
    else:
        for problem in chain.problems:
            show(f"{log}:{problem.line}: {problem.text}")
        broken = f"broken; {way_out(log)}"
        state = broken if chain.problems else "nothing removed, changed or reordered"
        if torn:
            state += f"; the last line was never finished ({torn} bytes)"
            state += ", and the next decision moves it aside"
        show(f"{log}: {chain.lines} records: {state}")
    raise typer.Exit(2 if chain.problems else 0)
