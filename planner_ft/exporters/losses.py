"""The report of what a file does not hold as the plan says it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from planner_ft.document.tree import plain
from planner_ft.exporters.formats import Format, PlanExport
from planner_ft.exporters.ledger import Account, Loss, ranges


def loss_summary(account: Account) -> str:
    """One line: how much of the plan is in the file, and which tasks do not move as planned."""
    carried, lost, changed = map(len, (account.carried, account.lost_paths, account.changed_paths))
    movement = ("navigation_skill", "name")
    still = sorted({int(path[1]) + 1 for path in account.lost_paths if path[4:] == movement})
    ending = f"; MOVEMENTS LOST in task{'s' if len(still) > 1 else ''} {ranges(still)}"
    return (
        f"{carried} of {carried + lost} entries carried, {changed} of them in another form;"
        f" {lost} lost{ending if still else ''}"
    )


def loss_lines(account: Account) -> Iterator[str]:
    """The losses, then what is carried in another form; one line per task and reason."""
    for word, losses in (("lost     ", account.lost), ("changed  ", account.changed)):
        for loss in losses:
            yield word + plain(f"{loss.task or 'plan'}: {loss.what} - {loss.why}")


def loss_report(plan: PlanExport, written: Format, file: str, account: Account) -> str:
    """The report as Markdown."""
    parts = [
        f"# What {_cell(file)} does not hold",
        f"{_cell(written.description)}. {_cell(plan.mark)}.",
        loss_summary(account) + ".",
        *_section("Lost", "Why", account.lost),
        *_section("Carried in another form", "How", account.changed),
    ]
    return "\n\n".join(parts) + "\n"


def _section(title: str, column: str, losses: Sequence[Loss]) -> list[str]:
    rows = [f"| {one.task or 'plan'} | {_cell(one.what)} | {_cell(one.why)} |" for one in losses]
    table = "\n".join([f"| Task | What | {column} |", "|---|---|---|", *rows])
    return [f"## {title}", table] if losses else []


def _cell(text: str) -> str:
    """Text of a command in a table: no line of its own, no column, no markup."""
    return "".join(f"\\{sign}" if sign in "\\`*_[]<>|#" else sign for sign in plain(text))
