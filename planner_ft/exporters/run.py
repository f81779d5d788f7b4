"""Exporting a plan: read it, look up its approval, write the file and the report of its losses."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from planner_ft.document import read_document
from planner_ft.exporters.formats import (
    DRAFT,
    Format,
    PlanExport,
    Written,
    format_names,
    load_format,
)
from planner_ft.exporters.geodesy import Origin
from planner_ft.exporters.ledger import Account
from planner_ft.exporters.losses import loss_report
from planner_ft.review.log import log_beside
from planner_ft.review.verify import approval_of
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import write_text
from planner_ft.vocabulary import load_vocabulary

ALL = "all"
REPORT = ".losses.md"


@dataclass(frozen=True)
class PlanExportSettings:
    """The plan file, the formats by name ("all": every one), and where [0, 0] lies.

    `out` is the file of a single format, by default the plan's name with the format's extension.
    `log` is the approval log, by default the one beside the plan; `draft` exports a plan that is
    not approved, and marks it. `vocabulary` is the file of a vocabulary that is not bundled.
    """

    plan: Path
    formats: tuple[str, ...]
    origin: Origin | None = None
    out: Path | None = None
    log: Path | None = None
    draft: bool = False
    vocabulary: str | None = None
    overwrite: bool = False


@dataclass(frozen=True)
class ExportedPlan:
    """A file that was written, the report beside it, and the account of what the file holds."""

    format: Format
    file: Path
    report: Path
    account: Account


def export_plan(settings: PlanExportSettings) -> list[ExportedPlan]:
    """Write an approved plan in every format that was asked for, each with its report; all are made
    before any is written.

    Raises PlannerError for a plan that is not approved (without `draft`), and for what a format
    cannot take.
    """
    formats = _formats(settings)
    plan = _plan(settings)
    files = [_file(settings, chosen, draft=plan.approval is None) for chosen in formats]
    made = [_write(chosen, plan) for chosen in formats]
    done = []
    for chosen, file, written in zip(formats, files, made, strict=True):
        report = file.with_name(file.name + REPORT)
        write_text(file, written.text)
        write_text(report, loss_report(plan, chosen, file.name, written.account))
        done.append(ExportedPlan(chosen, file, report, written.account))
    return done


def _formats(settings: PlanExportSettings) -> list[Format]:
    known = format_names()
    names = [name for given in settings.formats for name in (known if given == ALL else [given])]
    if not names:
        raise PlannerError(f"--format: say for which vehicle; there is {', '.join(known)}, or all")
    formats = [load_format(name) for name in dict.fromkeys(names)]
    if settings.out is not None and len(formats) > 1:
        raise PlannerError(
            f"--out {settings.out}: names one file, and {len(formats)} formats are asked for; leave"
            " it out, or give one --format"
        )
    needing = next((chosen.name for chosen in formats if chosen.needs_origin), None)
    if needing and settings.origin is None:
        raise PlannerError(
            f"--format {needing}: needs --origin LAT,LON, where the plan's [0, 0] lies, such as"
            " 59.9075,10.7231"
        )
    return formats


def _plan(settings: PlanExportSettings) -> PlanExport:
    vocabulary = load_vocabulary(settings.vocabulary) if settings.vocabulary else None
    document = read_document(settings.plan, vocabulary)
    approval = approval_of(document, settings.log or log_beside(settings.plan))
    approved = approval.status == "approved"
    if not approved and not settings.draft:
        raise PlannerError(
            f"{settings.plan}: {approval.text}; approve it with `plannerft review {settings.plan}`,"
            f" or give --draft for a file that is marked {DRAFT}"
        )
    vocabulary = vocabulary or load_vocabulary(document["vocabulary"]["name"])
    words = f"{approval.text}; digest {approval.digest}" if approved else None
    return PlanExport(document, vocabulary, settings.origin, words)


def _file(settings: PlanExportSettings, chosen: Format, *, draft: bool) -> Path:
    """The path of a format's file. A draft's own name says so, too: some ground stations show no
    more of a mission than that.
    """
    name = f"{settings.plan.stem}{'.DRAFT' if draft else ''}{chosen.extension}"
    file = settings.out or settings.plan.with_name(name)
    if file.resolve() == settings.plan.resolve():
        raise PlannerError(f"--out {file}: is the plan itself; give another file")
    for path in (file, file.with_name(file.name + REPORT)):
        if path.is_dir():
            raise PlannerError(f"--out {path}: is a folder; give a file")
        if path.exists() and not settings.overwrite:
            raise PlannerError(
                f"{path}: exists; give --overwrite to replace it, or another file with --out"
            )
    return file


def _write(chosen: Format, plan: PlanExport) -> Written:
    try:
        return chosen.write(plan)
    except PlannerError as error:
        raise PlannerError(f"--format {chosen.name}: {error}") from error
