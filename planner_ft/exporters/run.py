"""Exporting a plan, from a shell or the page of a review: read it, look up its approval, write the
file and the report of its losses.
"""

import functools
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.document import read_document
from planner_ft.exporters.formats import DRAFT, Format, PlanExport, known_formats, load_format
from planner_ft.exporters.ledger import MOVEMENT, Account, ranges
from planner_ft.exporters.ledger import Path as Place
from planner_ft.planning.frame import doubt, origin_of
from planner_ft.review.approval import approval_of
from planner_ft.review.log import log_beside
from planner_ft.support.errors import PlannerError, QuestionError
from planner_ft.support.files import write_text
from planner_ft.support.geodesy import Origin, parse_origin
from planner_ft.support.terminal import plain
from planner_ft.vocabulary import load_vocabulary

ALL = "all"
REPORT = ".losses.md"


@dataclass(frozen=True)
class PlanExportSettings:
    """The plan file, the formats by name ("all": every one), and where [0, 0] lies.

    `out` is the file of a single format, by default the plan's name with the format's extension.
    `log` is the approval log, by default the one beside the plan; `draft` exports a plan that is
    not approved, and marks it. `vocabulary` is the file of a vocabulary that is not bundled.
    `sure`: the origin is right, whatever speaks against it.
    """

    plan: Path
    formats: tuple[str, ...]
    origin: Origin | None = None
    out: Path | None = None
    log: Path | None = None
    draft: bool = False
    vocabulary: str | None = None
    overwrite: bool = False
    sure: bool = False


@dataclass(frozen=True)
class ExportedPlan:
    """A written file, the report beside it, its account, and where [0, 0] lies."""

    format: Format
    file: Path
    report: Path
    account: Account
    origin: str


def export_plan(settings: PlanExportSettings) -> list[ExportedPlan]:
    """Write an approved plan in every format asked for, each with its report; all are made before
    any is written.

    Raises PlannerError for a plan that is not approved (without `draft`), and for what a format
    cannot take; QuestionError for an origin that speaks against itself (without `sure`).
    """
    formats, plan = _formats(settings), _plan(settings)
    doubtful = doubt(plan.document["command"], plan.origin) if plan.origin else None
    if doubtful and not settings.sure:
        raise QuestionError(doubtful, "If it is right, give --origin-is-right.")
    needing = next((chosen.name for chosen in formats if chosen.needs_origin), None)
    if needing and plan.origin is None:
        where = "where the plan's [0, 0] lies, such as 59.9075,10.7231"
        raise PlannerError(f"--format {needing}: needs --origin LAT,LON, {where}")
    files = [_file(settings, chosen, draft=plan.approval is None) for chosen in formats]
    made = []
    for chosen in formats:
        try:
            made.append(chosen.write(plan))
        except PlannerError as error:
            raise PlannerError(f"--format {chosen.name}: {error}") from error
    done, where = [], " ".join(origin_words(plan))
    for chosen, file, written in zip(formats, files, made, strict=True):
        report = file.with_name(file.name + REPORT)
        write_text(file, written.text)
        write_text(report, loss_report(plan, chosen, file.name, written.account))
        done.append(ExportedPlan(chosen, file, report, written.account, where))
    return done


def _formats(settings: PlanExportSettings) -> list[Format]:
    known = list(known_formats())
    names = [name for given in settings.formats for name in (known if given == ALL else [given])]
    if not names:
        raise PlannerError(f"--format: say for which vehicle; there is {', '.join(known)}, or all")
    formats = [load_format(name) for name in dict.fromkeys(names)]
    if settings.out is not None and len(formats) > 1:
        asked = f"names one file, and {len(formats)} formats are asked for"
        raise PlannerError(f"--out {settings.out}: {asked}; leave it out, or give one --format")
    return formats


def _plan(settings: PlanExportSettings) -> PlanExport:
    plan = read_plan(settings, f"a file that is marked {DRAFT}")
    planned = origin_of(plan.document)
    if planned and settings.origin not in (None, planned):
        problem = f"the plan was made with {planned.latitude:g},{planned.longitude:g} ({planned})"
        given = f"{settings.origin.latitude:g},{settings.origin.longitude:g}"
        raise PlannerError(f"--origin {given}: {problem}; leave it out, or plan anew")
    return plan


def read_plan(asked: Any, marked: str, *, altered: bool = True) -> PlanExport:
    """The approved plan of settings with `plan`, `log`, `vocabulary`, `origin` and `draft`, which
    also takes others, `altered` ones too, for what is `marked`. Raises PlannerError.
    """
    vocabulary = load_vocabulary(asked.vocabulary) if asked.vocabulary else None
    document = read_document(asked.plan, vocabulary)
    approval = approval_of(document, asked.log or log_beside(asked.plan))
    if approval.status == "altered" and not altered:
        hint = "look at it and approve it again with `plannerft review`"
        raise PlannerError(f"{asked.plan}: {approval.text}; {hint}")
    approved = approval.status == "approved"
    if not approved and not asked.draft:
        ways = f"approve it with `plannerft review {asked.plan}`, or give --draft for {marked}"
        raise PlannerError(f"{asked.plan}: {approval.text}; {ways}")
    vocabulary = vocabulary or load_vocabulary(document["vocabulary"]["name"])
    words = f"{approval.text}; digest {approval.digest}" if approved else None
    return PlanExport(document, vocabulary, asked.origin or origin_of(document), words)


def _file(settings: PlanExportSettings, chosen: Format, *, draft: bool) -> Path:
    """The path of a format's file. A draft's own name says so, too: some ground stations show no
    more of a mission than that.
    """
    file = settings.out or settings.plan.with_suffix(chosen.extension)
    if draft and "DRAFT" not in file.name:
        file = file.with_name(f"{file.stem}.DRAFT{file.suffix}")
    if file.resolve() == settings.plan.resolve():
        raise PlannerError(f"--out {file}: is the plan itself; give another file")
    for path in (file, file.with_name(file.name + REPORT)):
        if path.is_dir():
            raise PlannerError(f"--out {path}: is a folder; give a file")
        if path.exists() and not settings.overwrite:
            hint = "give --overwrite to replace it, or another file with --out"
            raise PlannerError(f"{path}: exists; {hint}")
    return file


# ------------------------------------------------------------ the report of losses


def stop_words(account: Account) -> list[str]:
    """What stops the mission, or takes it another way: "waits for the operator at tasks 1, 3"."""
    still = {path for path in account.lost_paths if path[4:] == MOVEMENT}
    waits = {path for path in account.stops if path in account.carried}
    ends = account.stops - waits
    found = [_tasks("waits for the operator at", waits), _tasks("ends before", ends)]
    return [one for one in (*found, _tasks("does not move as planned in", still - ends)) if one]


def loss_summary(account: Account) -> str:
    """One line: what stops the mission first, then how much of the plan is in the file."""
    carried, lost, changed = map(len, (account.carried, account.lost_paths, account.changed_paths))
    entries = f"{carried} of {carried + lost} entries carried, {changed} of them in another form"
    return "; ".join([*stop_words(account), f"{entries}, {lost} lost"])


def _tasks(what: str, paths: Collection[Place]) -> str:
    numbers = sorted({int(path[1]) + 1 for path in paths})
    plural = "s" if len(numbers) > 1 else ""
    return f"{what} task{plural} {ranges(numbers)}" if numbers else ""


def loss_lines(account: Account) -> Iterator[str]:
    """What stops the mission or takes it another way, the other losses, then what is carried in
    another form; one line per task and reason.
    """
    words = [("lost     ", one) for one in account.lost]
    words += [("changed  ", one) for one in account.changed]
    for word, loss in sorted(words, key=lambda pair: not pair[1].stops):
        yield word + plain(f"{loss.task or 'plan'}: {loss.what} - {loss.why}")


def loss_report(plan: PlanExport, written: Format, file: str, account: Account) -> str:
    """The report as Markdown."""
    about = [f"{written.description}.", f"{plan.mark}.", *origin_words(plan)]
    parts = [f"# What {_cell(file)} does not hold", " ".join(map(_cell, about))]
    parts.append(loss_summary(account) + ".")
    lost, changed = account.lost, account.changed
    for title, column, losses, stops in (
        ("Stops or diverts the mission", "Why", (*lost, *changed), True),
        ("Lost", "Why", lost, False),
        ("Carried in another form", "How", changed, False),
    ):
        chosen = [one for one in losses if one.stops == stops]
        rows = [
            f"| {one.task or 'plan'} | {_cell(one.what)} | {_cell(one.why)} |" for one in chosen
        ]
        table = "\n".join([f"| Task | What | {column} |", "|---|---|---|", *rows])
        parts += [f"## {title}", table] if rows else []
    return "\n\n".join(parts) + "\n"


def origin_words(plan: PlanExport) -> list[str]:
    """Sentences on where [0, 0] lies, and what speaks against it."""
    if plan.origin is None:
        return []
    doubtful = doubt(plan.document["command"], plan.origin)
    return [f"[0, 0] lies at {plan.origin}.", *([doubtful] if doubtful else [])]


def _cell(text: str) -> str:
    """Text of a command in a table: no line of its own, no column, no markup."""
    return "".join(f"\\{sign}" if sign in "\\`*_[]<>|#" else sign for sign in plain(text))


# ---------------------------------------------------------------- export from the page of a review


@functools.cache
def formats() -> list[dict[str, Any]]:
    """Name, description and extension of every format, and whether it needs an origin."""
    found = []
    for name in known_formats():
        try:
            one = load_format(name)
        except PlannerError:
            continue  # a format of somebody's own that does not load: the terminal says why
        about = {"description": one.description, "extension": one.extension}
        found.append({"name": name, **about, "needs_origin": one.needs_origin})
    return found


def hand_over(
    plan: Path, log: Path, names: list[str], origin: str, *, overwrite: bool, sure: bool
) -> list[dict[str, Any]]:
    """Write an approved plan in these formats; `sure`: a doubtful origin is right all the same.

    Raises QuestionError and PlannerError as `export_plan`.
    """
    place = parse_origin(origin) if origin.strip() else None
    settings = PlanExportSettings(
        plan, tuple(names), place, log=log, overwrite=overwrite, sure=sure
    )
    return [
        {
            "format": done.format.name,
            "file": done.file.name,
            "report": done.report.name,
            "text": done.file.read_text(encoding="utf-8"),
            "stops": stop_words(done.account),
            "lines": list(loss_lines(done.account)),
        }
        for done in export_plan(settings)
    ]
