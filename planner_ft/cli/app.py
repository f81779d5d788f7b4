"""The typer application: every command, in the order in which a newcomer meets them."""

from __future__ import annotations

from typing import Annotated

import typer

from planner_ft.cli.bench import bench, score
from planner_ft.cli.candidates import candidates
from planner_ft.cli.compare import compare
from planner_ft.cli.doctor import doctor
from planner_ft.cli.export import export
from planner_ft.cli.gen_data import gen_data
from planner_ft.cli.plan import plan
from planner_ft.cli.report import report
from planner_ft.cli.review import review
from planner_ft.cli.train import train
from planner_ft.cli.validate import validate
from planner_ft.cli.verify import verify
from planner_ft.cli.vocabulary import vocabulary

app = typer.Typer(
    name="plannerft",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help=(
        "Fine-tune small language models into mission planners for unmanned surface vehicles, and"
        " measure them honestly."
    ),
    epilog=(
        "First steps: plannerft gen-data, plannerft train --level mission, plannerft bench --level"
        " mission. --debug shows tracebacks."
    ),
)


def _version(value: bool) -> None:
    if value:
        import planner_ft

        print(f"planner_ft {planner_ft.__version__}")
        raise typer.Exit


@app.callback()
def options(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_version, is_eager=True, help="Show the version and exit."
        ),
    ] = False,
) -> None:
    """Options of every command."""


for command in (
    plan,
    review,
    verify,
    gen_data,
    validate,
    candidates,
    train,
    bench,
    score,
    compare,
    report,
    export,
    vocabulary,
    doctor,
):
    app.command(command.__name__.replace("_", "-"))(command)
