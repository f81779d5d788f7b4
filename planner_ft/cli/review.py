"""`plannerft review`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from planner_ft.review.desk import Desk

DECIDE, WEB, HARVEST, AGENTS = (
    "Without a conversation",
    "In the browser",
    "Training data from reviewed plans",
    "Agents",
)


def review(
    plans: Annotated[
        list[Path] | None,
        typer.Argument(help="Plan document; with --harvest several.", show_default=False),
    ] = None,
    log: Annotated[
        Path | None,
        typer.Option(help="Approval log.", show_default="approvals.jsonl beside the plan"),
    ] = None,
    name: Annotated[
        str | None, typer.Option(help="Who reviews; stands in the log.", show_default=False)
    ] = None,
    vocabulary: Annotated[
        str | None,
        typer.Option(
            help="Vocabulary: a bundled name or a TOML file.",
            show_default="the plan's, if it is bundled",
        ),
    ] = None,
    show: Annotated[
        bool, typer.Option("--show", help="Show the plan and ask nothing.", rich_help_panel=DECIDE)
    ] = False,
    adopt: Annotated[
        bool,
        typer.Option(
            "--adopt",
            help="Take over what was changed in the file by hand, as an edit.",
            rich_help_panel=DECIDE,
        ),
    ] = False,
    edit: Annotated[
        list[str] | None,
        typer.Option(
            help='Such as "2.radius=15", "remove 3", "locate green buoy=120,-35". Repeatable.',
            show_default=False,
            rich_help_panel=DECIDE,
        ),
    ] = None,
    approve: Annotated[
        bool,
        typer.Option("--approve", help="Approve the plan (needs --name).", rich_help_panel=DECIDE),
    ] = False,
    acknowledge: Annotated[
        list[str] | None,
        typer.Option(
            help="Id of a warning, or all. Repeatable.", show_default=False, rich_help_panel=DECIDE
        ),
    ] = None,
    reject: Annotated[
        str | None,
        typer.Option(
            help="Reject the plan for this reason (needs --name).",
            show_default=False,
            rich_help_panel=DECIDE,
        ),
    ] = None,
    web: Annotated[
        bool,
        typer.Option(
            "--web",
            help="Review in the browser; a new mission can be planned there, too.",
            rich_help_panel=WEB,
        ),
    ] = False,
    port: Annotated[
        int | None,
        typer.Option(help="Port of the page.", show_default="a free one", rich_help_panel=WEB),
    ] = None,
    host: Annotated[
        str | None,
        typer.Option(
            help="Address of the page.",
            show_default="127.0.0.1: this machine alone",
            rich_help_panel=WEB,
        ),
    ] = None,
    no_browser: Annotated[
        bool,
        typer.Option(
            "--no-browser", help="Print the address and open nothing.", rich_help_panel=WEB
        ),
    ] = False,
    harvest: Annotated[
        bool,
        typer.Option(
            "--harvest",
            help="Make training samples of plans that were edited and approved.",
            rich_help_panel=HARVEST,
        ),
    ] = False,
    out: Annotated[
        Path | None,
        typer.Option(
            help="JSONL file for the samples.", show_default=False, rich_help_panel=HARVEST
        ),
    ] = None,
    overwrite: Annotated[
        bool,
        typer.Option(
            "--overwrite", help="Replace a file that --out names.", rich_help_panel=HARVEST
        ),
    ] = False,
    candidate: Annotated[
        str | None,
        typer.Option(
            help="Candidate that plans.",
            show_default="the one that planned",
            rich_help_panel=AGENTS,
        ),
    ] = None,
    device: Annotated[
        str, typer.Option(help="auto, cpu, cuda or cuda:N.", rich_help_panel=AGENTS)
    ] = "auto",
) -> None:
    """Read a plan, edit it, approve or reject it. A decision is kept in the approval log, with the
    plan.

    In a terminal it asks; with --edit, --approve or --reject, or without a terminal, it does not.
    """
    decided = {
        "--show": show,
        "--adopt": adopt,
        "--edit": edit,
        "--approve": approve,
        "--acknowledge": acknowledge,
        "--reject": reject is not None,
    }
    served = {"--port": port is not None, "--host": host, "--no-browser": no_browser}
    harvested = {"--out": out, "--overwrite": overwrite}
    if harvest:
        _refuse("--harvest", {"--web": web, **decided, **served})
        _harvest(plans or [], log, out, overwrite, vocabulary)
    elif web:
        _refuse("--web", {**decided, **harvested})
        _serve(
            plans or [],
            log,
            vocabulary,
            candidate,
            device,
            {"host": host, "port": port, "open_browser": False if no_browser else None},
        )
    else:
        _refuse("a review in the terminal", {**served, **harvested})
        desk = _desk(plans or [], log, name, vocabulary, candidate, device)
        _review(desk, show, adopt, edit or [], approve, acknowledge or [], reject)


def _refuse(mode: str, given: dict[str, Any]) -> None:
    """Raise PlannerError for flags that this kind of review has no use for."""
    from planner_ft.support.errors import PlannerError

    unused = [flag for flag, value in given.items() if value]
    if unused:
        raise PlannerError(f"{unused[0]} does not go with {mode}; leave one of them out")


def _desk(
    plans: list[Path],
    log: Path | None,
    name: str | None,
    vocabulary: str | None,
    candidate: str | None,
    device: str,
) -> Desk:
    """The plan with its log and Task Agent."""
    from planner_ft.review.desk import open_desk
    from planner_ft.support.errors import PlannerError

    if len(plans) != 1:
        raise PlannerError(
            f"{len(plans)} plans are given; one is reviewed at a time, such as plannerft review"
            " plan.json"
        )
    return open_desk(plans[0], log, vocabulary, name, candidate, device)


def _review(
    desk: Desk,
    show: bool,
    adopt: bool,
    edits: list[str],
    approve: bool,
    acknowledged: list[str],
    reason: str | None,
) -> None:
    from planner_ft.review.terminal import Conversation, terminal
    from planner_ft.support.errors import PlannerError

    if approve and reason is not None:
        raise PlannerError("--approve and --reject exclude each other; leave one of them out")
    reviewer = Conversation(desk, terminal())
    if adopt or edits or approve or reason is not None:
        reviewer.decide(
            adopt=adopt, edits=edits, approve=approve, acknowledged=acknowledged, reason=reason
        )
    elif acknowledged:
        raise PlannerError("--acknowledge goes with --approve; give both")
    elif show or not (sys.stdin.isatty() and sys.stdout.isatty()):
        reviewer.show()
    else:
        try:
            reviewer.converse()
        except KeyboardInterrupt:
            typer.echo("\ninterrupted; every edit and every decision that was confirmed is saved")
            raise typer.Exit(130) from None


def _serve(
    plans: list[Path],
    log: Path | None,
    vocabulary: str | None,
    candidate: str | None,
    device: str,
    given: dict[str, Any],
) -> None:
    from planner_ft.review.desk import planning_of
    from planner_ft.review.web import WebSettings, serve
    from planner_ft.support.errors import PlannerError

    if len(plans) > 1:
        raise PlannerError(
            f"{len(plans)} plans are given; one is opened, and the page offers the others of its"
            " folder"
        )
    plan = plans[0] if plans else None
    planning = planning_of(plan, vocabulary, candidate, device)
    serve(
        plan,
        WebSettings(
            log=log,
            planning=planning,
            **{name: value for name, value in given.items() if value is not None},
        ),
    )


def _harvest(
    plans: list[Path], log: Path | None, out: Path | None, overwrite: bool, vocabulary: str | None
) -> None:
    from planner_ft.review.harvest import harvest_files

    done = harvest_files(plans, log, out, overwrite=overwrite, vocabulary=vocabulary)
    for line in done.lines():
        typer.echo(line)
