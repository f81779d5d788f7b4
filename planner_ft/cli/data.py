"""`plannerft gen-data`, `validate`, `vocabulary` and `vehicle`."""

import sys
from pathlib import Path

import typer

from planner_ft.cli.options import Options, command, interruptible
from planner_ft.support.alone import alone
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import write_text
from planner_ft.support.terminal import show, terminal
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import check_level


@command
def gen_data(o: Options) -> None:
    """Make the training data."""
    from planner_ft.data.generate import GenerationSettings, generate
    from planner_ft.prompts import chat_messages

    out = o.out or load_vocabulary(o.vocabulary).data
    settings = o.into(GenerationSettings, out=out)
    with alone(out, "--out", "gen-data"), interruptible(lines=False) as progress:
        results = generate(settings, progress, chat_messages)
    for result in results:
        counts = ", ".join(f"{split} {count}" for split, count in result.counts.items())
        show(f"{result.folder}: {counts}{'' if result.written else ' (up to date)'}")
        total = sum(result.counts.values())
        stages = (_stage(stage, seconds, total) for stage, seconds in result.seconds.items())
        show(f"  {', '.join(stages)}")


def _stage(stage: str, seconds: float, count: int) -> str:
    sampled = stage.startswith("sampling") and seconds
    rate = f" ({count / seconds:.0f} records/s)" if sampled else ""
    return f"{stage} {seconds:.1f} s{rate}"


@command
def validate(o: Options) -> None:
    """Check files of samples."""
    from planner_ft.data.validation import validate_file

    definition, checked = load_vocabulary(o.vocabulary), check_level(o.level) if o.level else None
    status = 0
    for path in o.files:
        try:
            report = validate_file(path, definition, checked, complete=o.complete)
        except PlannerError as error:
            show(f"plannerft: {error}", error=True)
            status = 2
            continue
        for problem in report.problems:
            show(str(problem))
        counts = report.counts.items()
        held = [f"{count} {kind}{'s' if count > 1 else ''}" for kind, count in counts]
        number = len(report.problems)
        found = f"{number or 'no'} problem{'' if number == 1 else 's'}"
        show(f"{path}: {', '.join(held) or 'nothing'}: {found}", error=True)
        status = max(status, 1 if report.problems else 0)
    raise typer.Exit(status)


@command
def vocabulary(o: Options) -> None:
    """Show the vocabulary, or write the schemas and the documentation page that derive from it."""
    from planner_ft.vocabulary.schema import (
        documentation_page,
        stale_page,
        stale_schemas,
        write_schemas,
    )

    definition = load_vocabulary(o.vocabulary)
    if o.check:
        folder, page = o.schemas or Path("schemas"), o.docs or Path("docs") / "vocabulary.md"
        stale = [str(folder / name) for name in stale_schemas(folder, definition)]
        stale += [str(page)] if stale_page(page, definition) else []
        again = f"plannerft vocabulary --schemas {folder} --docs {page}"
        for name in stale:
            show(f"{name}: stale; write it again with {again}")
        raise typer.Exit(1 if stale else 0)
    if o.schemas is not None:
        for path in write_schemas(o.schemas, definition):
            show(str(path))
    text = documentation_page(definition)
    if o.docs is not None:
        write_text(o.docs, text)
        show(str(o.docs))
    elif o.schemas is None:
        _show_page(text)


@command
def vehicle(o: Options) -> None:
    """Begin a vehicle of one's own, or check it."""
    from planner_ft.document.own_vehicle import check_vehicle, new_vehicle
    from planner_ft.simulation.checking import check_simulation

    if o.action == "new":
        for path in new_vehicle(o.name, o.out):
            show(str(path))
    elif o.action == "check":
        with interruptible(lines=False) as progress:
            parts = check_vehicle(o.name, check_simulation, progress)
        for part in parts:
            show(str(part))
        raise typer.Exit(any(part.state == "wrong" for part in parts))
    else:
        raise PlannerError(f"plannerft vehicle {o.action}: must be new or check")


def _show_page(page: str) -> None:
    if not sys.stdout.isatty():
        show(page, end="")
        return
    from rich.markdown import Markdown

    terminal().print(Markdown(page.replace("<br>", "; ")))
