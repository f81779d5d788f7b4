"""`plannerft review` and `plannerft verify`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import typer

from planner_ft.cli.options import command, typed
from planner_ft.support.errors import PlannerError
from planner_ft.support.terminal import show, terminal

DECISIONS = ("show", "adopt", "edit", "approve", "acknowledge", "reject")
SERVING = ("port", "host", "no_browser")
HARVESTING = ("out", "overwrite")


@command
def review(**options: Any) -> None:
    """Read, edit, approve or reject a plan."""
    if options["harvest"]:
        _refuse("--harvest", options, "web", "origin", *DECISIONS, *SERVING)
        _harvest(options)
    elif options["web"]:
        _refuse("--web", options, *DECISIONS, *HARVESTING)
        _serve(options)
    else:
        _refuse("a review in the terminal", options, *SERVING, *HARVESTING)
        _review(options)


def _refuse(mode: str, options: dict[str, Any], *names: str) -> None:
    """Raise PlannerError for options that this kind of review has no use for."""
    for name in names:
        if options[name] not in (None, False, []):
            raise PlannerError(f"{typed([name])} does not go with {mode}; leave one of them out")


def _review(options: dict[str, Any]) -> None:
    from planner_ft.review.desk import open_desk
    from planner_ft.review.terminal import Conversation

    plans = options["plans"] or []
    if len(plans) != 1:
        way_out = "one is reviewed at a time, such as plannerft review plan.json"
        raise PlannerError(f"{len(plans)} plans are given; {way_out}")
    named = [options[key] for key in ("log", "vocabulary", "name", "candidate", "device")]
    adopt, approve, reason = options["adopt"], options["approve"], options["reject"]
    edits, acknowledged = options["edit"] or [], options["acknowledge"] or []
    if options["origin"] is not None:
        edits = [f"origin {options['origin']}", *edits]
    reviewer = Conversation(open_desk(plans[0], *named), terminal(soft_wrap=True))
    if approve and reason is not None:
        raise PlannerError("--approve and --reject exclude each other; leave one of them out")
    if adopt or edits or approve or reason is not None:
        reviewer.decide(adopt, edits, approve, acknowledged, reason)
    elif acknowledged:
        raise PlannerError("--acknowledge goes with --approve; give both")
    elif options["show"] or not (sys.stdin.isatty() and sys.stdout.isatty()):
        reviewer.show()
    else:
        try:
            reviewer.converse()
        except KeyboardInterrupt:
            show("\ninterrupted; every edit and every decision that was confirmed is saved")
            raise typer.Exit(130) from None


def _serve(options: dict[str, Any]) -> None:
    from planner_ft.exporters import page as exporting
    from planner_ft.review.desk import planning_of
    from planner_ft.review.web import WebSettings, serve
    from planner_ft.simulation.live import run_live
    from planner_ft.support.geodesy import parse_origin

    plans = options["plans"] or []
    if len(plans) > 1:
        way_out = "one is opened, and the page offers the others of its folder"
        raise PlannerError(f"{len(plans)} plans are given; {way_out}")
    plan = plans[0] if plans else None
    planning = planning_of(plan, *(options[key] for key in ("vocabulary", "candidate", "device")))
    given = {key: options[key] for key in ("host", "port", "log") if options[key] is not None}
    if options["origin"] is not None:
        given["origin"] = parse_origin(options["origin"])
    given |= {"reviewer": options["name"] or "", "exporting": exporting, "runner": run_live}
    serve(plan, WebSettings(planning=planning, open_browser=not options["no_browser"], **given))


def _harvest(options: dict[str, Any]) -> None:
    from planner_ft.review.harvest import harvest_files

    files = options["plans"] or [], options["log"], options["out"]
    settings = {key: options[key] for key in ("overwrite", "vocabulary")}
    for line in harvest_files(*files, **settings).lines():
        show(line)


@command
def verify(
    plan: Path | None = None,
    log: Path | None = None,
    json: bool = False,
    vocabulary: str | None = None,
) -> None:
    """Check that a plan is exactly what a person approved."""
    if plan is not None:
        _verify_plan(plan, log, json, vocabulary)
    elif log is not None:
        _verify_log(log, json)
    else:
        ways = "give a plan, such as plannerft verify plan.json, or a log with --log"
        raise PlannerError(f"nothing to verify: {ways}")


def _verify_plan(plan: Path, log: Path | None, json: bool, vocabulary: str | None) -> None:
    from planner_ft.document import read_document
    from planner_ft.review.log import existing_log, log_beside
    from planner_ft.review.terminal import approval_text
    from planner_ft.review.verify import approval_of
    from planner_ft.support.files import indented_json
    from planner_ft.vocabulary import load_vocabulary

    document = read_document(plan, load_vocabulary(vocabulary) if vocabulary else None)
    approval = approval_of(document, existing_log(log) if log else log_beside(plan))
    if json:
        show(indented_json({"plan": str(plan), **approval.as_json()}), end="")
    else:
        show("\n".join(approval_text(approval)))
    raise typer.Exit(0 if approval.status == "approved" else 1)


def _verify_log(log: Path, json: bool) -> None:
    from planner_ft.review.log import check_log, existing_log, way_out
    from planner_ft.support.files import indented_json

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
