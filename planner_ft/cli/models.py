"""`plannerft candidates` and `plannerft doctor`: the models, and the installation."""

from __future__ import annotations

import sys
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import typer

from planner_ft.cli.options import Options, command, typed
from planner_ft.support.errors import PlannerError, QuestionError
from planner_ft.support.files import indented_json
from planner_ft.support.terminal import show, terminal
from planner_ft.vocabulary.plans import check_level

if TYPE_CHECKING:
    from rich.table import Table
    from rich.text import Text

ESTIMATES = (
    "Estimates, not measurements. Memory: 4-bit weights, batch size 1; to train an adapter on 1024"
    " tokens, to run it on 2048 tokens. * with gradient checkpointing. Time on the study's RTX"
    " 4070: the published trainings (minutes for missions, hours for tasks), a mission's answer in"
    " seconds."
)
PAGE = "https://huggingface.co/REPOSITORY"
GATED = f" (gated ones: first accept the licence at {PAGE} and run `hf auth login`)"
OFFLINE = "Without a network, copy it to a sub-folder of its name in a folder that PLANNERFT_MODELS"
FIGURES = (
    *("weights", "train, GiB", "GPU, GB", "run, GiB", "GPU, GB"),
    *("mission, min", "task, h", "answer, s"),
)
SHORTENED = (" Community", " License", " (non-commercial)")


@command
def candidates(o: Options) -> None:
    """List the models."""
    from planner_ft.candidates import all_candidates, resolve_candidate
    from planner_ft.candidates.diagnosis import describe

    chosen = [resolve_candidate(name) for name in o.names] if o.names else all_candidates()
    rows = [describe(candidate) for candidate in chosen]
    if o.json:
        show(indented_json(rows), end="")
        return
    if o.markdown:
        lines = [("candidate", *FIGURES), ("---", *["---:"] * len(FIGURES)), *map(_figures, rows)]
        text = "\n".join(f"| {' | '.join(line)} |" for line in lines).replace("*", "\\*")
        show(f"{text}\n\n{ESTIMATES}")
        return
    console = terminal(soft_wrap=True)
    console.print(_table(rows), soft_wrap=False)
    console.print(ESTIMATES, soft_wrap=False)
    missing = [row for row in rows if row["command"]]
    for row in rows:
        if note := row["problem"] or (row["get"] if row not in missing else None):
            console.print(f"{row['name']}: {note}", style="yellow")
    if missing:
        gated = GATED if any(row["gated"] for row in missing) else ""
        console.print(f"\nTo get one that is not here{gated}:")
        for row in missing:
            console.print(f"  {row['command']}", markup=False)
        console.print(f"{OFFLINE} names.")


@command
def doctor(o: Options) -> None:
    """Check this installation."""
    from planner_ft.candidates.diagnosis import diagnose

    found = diagnose()
    if o.json:
        show(indented_json({**found.sections, "warnings": found.warnings}), end="")
        return
    for title, entries in found.sections.items():
        show(title)
        for name, value in entries.items():
            show(f"  {name}: {_text(value)}")
    show(f"warnings: {len(found.warnings) or 'none'}")
    for warning in found.warnings:
        show(f"  - {warning}")


def _text(value: Any) -> str:
    if isinstance(value, dict):
        shown = [item for item in value.items() if item[1] is not None and item[1] is not False]
        return ", ".join(f"{name} {_text(item)}" for name, item in shown)
    return "not set" if value is None else "yes" if value is True else str(value)


def _table(rows: list[dict[str, Any]]) -> Table:
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    table = Table(box=SIMPLE_HEAD, show_edge=False, pad_edge=False, padding=(0, 1, 0, 0))
    table.add_column("candidate", no_wrap=True)
    for heading in FIGURES:
        table.add_column(heading.replace(", ", "\n"), justify="right", no_wrap=True)
    table.add_column("licence", overflow="fold")
    table.add_column("here", overflow="fold")
    for row in rows:
        licence = row["licence"]
        for part in SHORTENED:
            licence = licence.replace(part, "")
        table.add_row(*_figures(row), licence, _here(row))
    return table


def _figures(row: dict[str, Any]) -> tuple[str, ...]:
    """The name of a candidate and its FIGURES as cells."""
    return row["name"], _count(row["parameters"]), *_memory(row["memory"]), *_times(row["times"])


def _times(times: dict[str, Any] | None) -> tuple[str, str, str]:
    """Cells: minutes and hours of the published trainings, seconds of an answer."""
    if times is None:
        return "?", "?", "?"
    minutes, hours = times["train_mission_s"] / 60, times["train_task_s"] / 3600
    return f"{minutes:.0f}", f"{hours:.1f}", f"{times['answer_s']:.0f}"


def _here(row: dict[str, Any]) -> Text:
    from rich.text import Text

    if row["problem"]:
        return Text("incomplete", "red")
    if row["standin"]:
        return Text("stand-in", "yellow")
    if row["here"]:
        return Text(row["source"], "green")
    return Text("no, gated" if row["gated"] else "no")


def _count(parameters: int | None) -> str:
    if parameters is None:
        return "?"
    return f"{parameters / 1e9:.2f} B" if parameters >= 1e9 else f"{parameters / 1e6:.2f} M"


def _memory(memory: dict[str, Any] | None) -> tuple[str, str, str, str]:
    """Cells: GiB to train, the smallest GPU for it, GiB to run, the smallest GPU for that."""
    if memory is None:
        return "?", "?", "?", "?"

    def smallest(kind: str, *unfit: str) -> str:
        fits = (gpu for gpu, fit in memory[f"{kind}_fits"].items() if fit not in unfit)
        return next(fits, "").replace(" GB", "")

    plain, saving = smallest("train", "no", "checkpointing"), smallest("train", "no")
    gpus = plain if saving == plain else f"{plain} {saving}*".strip()
    return (
        f"{memory['train_gib']:.1f} {memory['train_checkpointing_gib']:.1f}*",
        gpus or "larger",
        f"{memory['infer_gib']:.1f}",
        smallest("infer", "no") or "larger",
    )


PLAN_FLAGS = ("format", "origin", "log", "draft", "origin_is_right")
MODEL_FLAGS = ("candidate", "merge", "level", "adapter", "gguf", "outtype", "checks", "check_data")


@command
def export(o: Options) -> None:
    """Hand a plan over, or write a candidate as a model for other servers."""
    wrong = list(o.given(*(PLAN_FLAGS if o.plan is None else MODEL_FLAGS)))[:1]
    flag, shared = typed(wrong), o.given("vocabulary", "out", "overwrite")
    if wrong and o.plan is not None:
        problem = f"exports a model, and {o.plan} is a plan"
        raise PlannerError(f"{flag}: {problem}; leave one of the two out")
    if wrong:
        way_out = f"name the plan's file, as in `plannerft export plan.json {flag} ...`"
        raise PlannerError(f"{flag}: hands a plan over; {way_out}")
    if o.plan is not None:
        _export_plan(o, shared)
        return
    if o.candidate is None:
        ways = "name a plan's file with --format, or a model with --candidate and --out"
        raise PlannerError(f"nothing to export: {ways}")
    if o.out is None:
        raise PlannerError("--out: a model needs a folder to be written to; give --out DIR")
    _export_model(o.given(*MODEL_FLAGS) | shared)


def _export_plan(o: Options, shared: dict[str, Any]) -> None:
    from planner_ft.exporters import parse_origin, run

    place = parse_origin(o.origin) if o.origin is not None else None
    how = o.given("log", "draft") | shared
    asked = run.PlanExportSettings(
        o.plan, tuple(o.format or ()), place, sure=o.origin_is_right, **how
    )
    try:
        done = run.export_plan(asked)
    except QuestionError as error:
        if not (sys.stdin.isatty() and sys.stdout.isatty()):
            raise
        if not typer.confirm(error.question):
            raise PlannerError("nothing was written; give the right --origin LAT,LON") from None
        done = run.export_plan(replace(asked, sure=True))
    for one in done:
        show(f"{one.file}: {run.loss_summary(one.account)} (report: {one.report})")
        for line in run.loss_lines(one.account):
            show(f"  {line}")
    if done[0].origin:
        show(done[0].origin, error=True)


def _export_model(given: dict[str, Any]) -> None:
    from planner_ft.model_export import ExportSettings
    from planner_ft.model_export.run import export as run_export

    named = {"level": check_level(given.pop("level", "mission"))}
    settings = ExportSettings(data=given.pop("check_data", None), **given | named)
    done = run_export(settings, lambda line: show(line, error=True))
    check = done.check
    same = f"{check.same} of {check.count} answers as before"
    most = f"logits differ by at most {check.largest_logit_difference:.2g}"
    show(f"{done.folder}: {same}, {most}")
    if done.gguf is not None:
        show(f"{done.gguf}: {done.gguf.stat().st_size / 1e6:.1f} MB")
    model = f"--level {settings.named_adapter[0]} --candidates {done.folder}"
    show(f"next: plannerft bench {model} --configurations base --quantization none")


@command
def push(o: Options) -> None:
    """Upload an adapter or a data set to the Hugging Face Hub."""
    from planner_ft.model_export.hub import prepare, upload

    prepared = prepare(o.folder, o.repo, o.dataset)
    for note in prepared.notes:
        show(f"note: {note}", error=True)
    if not o.dry_run:
        show(upload(prepared, private=o.private))
        return
    for name, size in prepared.sizes():
        show(f"{size:>12,} bytes  {name}")
    show(f"{len(prepared.files)} files for {prepared.page} ({prepared.kind}); nothing was sent")
