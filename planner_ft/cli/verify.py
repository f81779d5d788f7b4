"""`plannerft verify`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def verify(
    plan: Annotated[
        Path | None,
        typer.Argument(
            help="Plan document; without one the log alone is checked.", show_default=False
        ),
    ] = None,
    log: Annotated[
        Path | None,
        typer.Option(help="Approval log.", show_default="approvals.jsonl beside the plan"),
    ] = None,
    json: Annotated[bool, typer.Option("--json", help="Print JSON instead of text.")] = False,
    vocabulary: Annotated[
        str | None,
        typer.Option(
            help="Vocabulary: a bundled name or a TOML file.",
            show_default="the plan's, if it is bundled",
        ),
    ] = None,
) -> None:
    """Check that a plan is exactly what a person approved, and that nothing was removed from the
    log or changed in it.

    Exits with 0 for a plan that is approved and unchanged, with 1 otherwise (what was altered is
    named), with 2 for a file that cannot be read or a log that is broken.
    """
    from planner_ft.support.errors import PlannerError

    if plan is not None:
        _verify_plan(plan, log, json, vocabulary)
    elif log is not None:
        _verify_log(log, json)
    else:
        raise PlannerError(
            "nothing to verify: give a plan, such as plannerft verify plan.json, or a log with"
            " --log"
        )


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
        typer.echo(indented_json({"plan": str(plan), **approval.as_json()}), nl=False)
    else:
        typer.echo("\n".join(approval_text(approval)))
    raise typer.Exit(0 if approval.status == "approved" else 1)


def _verify_log(log: Path, json: bool) -> None:
    from planner_ft.review.log import check_log, existing_log, way_out
    from planner_ft.support.files import indented_json

    chain = check_log(existing_log(log))
    if json:
        problems = [{"line": problem.line, "text": problem.text} for problem in chain.problems]
        typer.echo(
            indented_json(
                {
                    "log": str(log),
                    "records": chain.lines,
                    "problems": problems,
                    "unfinished_bytes": len(chain.torn),
                }
            ),
            nl=False,
        )
    else:
        for problem in chain.problems:
            typer.echo(f"{log}:{problem.line}: {problem.text}")
        state = (
            f"broken; {way_out(log)}" if chain.problems else "nothing removed, changed or reordered"
        )
        unfinished = (
            f"; the last line was never finished ({len(chain.torn)} bytes), and the next decision"
            " moves it aside"
            if chain.torn
            else ""
        )
        typer.echo(f"{log}: {chain.lines} records: {state}{unfinished}")
    raise typer.Exit(2 if chain.problems else 0)
