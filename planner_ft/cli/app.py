"""The typer application: every command, in the order in which a newcomer meets them."""

from typing import Annotated

import typer

from planner_ft.cli.bench import bench, compare, report, score
from planner_ft.cli.data import gen_data, validate, vehicle, vocabulary
from planner_ft.cli.models import candidates, doctor, export, push
from planner_ft.cli.review import plan, review, verify
from planner_ft.cli.simulate import simulate, skill
from planner_ft.cli.train import calibrate, learning_curve, train
from planner_ft.support.terminal import show

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

        show(f"planner_ft {planner_ft.__version__}")
        raise typer.Exit


SHOWN = "Show the version and exit."
VERSION = typer.Option("--version", callback=_version, is_eager=True, help=SHOWN)


@app.callback()
def options(version: Annotated[bool, VERSION] = False) -> None:
    """Options of every command."""


PLANS = (plan, review, verify, simulate, skill, gen_data, validate)
MEASURING = (candidates, train, calibrate, bench, score, compare, learning_curve, report)
for command in (*PLANS, *MEASURING, export, push, vocabulary, vehicle, doctor):
    app.command(command.__name__.replace("_", "-"))(command)
