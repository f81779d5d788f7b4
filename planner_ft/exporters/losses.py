"""The report of what a file does not hold as the plan says it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from planner_ft.document.tree import plain
from planner_ft.exporters.formats import Format, Handover
from planner_ft.exporters.ledger import Account, Loss, ranges


def loss_summary(account: Account) -> str:
    """One line: how much of the plan is in the file, and which tasks do not move as planned."""
    lost, changed = len(account.lost_paths), len(account.changed_paths)
    total = len(account.carried) + lost
    still = sorted(
        {
            int(path[1]) + 1
            for path in account.lost_paths
            if path[4:] == ("navigation_skill", "name")
        }
    )
    movements = (
        f"; MOVEMENTS LOST in task{'s' if len(still) > 1 else ''} {ranges(still)}" if still else ""
    )
    return (
        f"{len(account.carried)} of {total} entries carried, {changed} of them in another form;"
        f" {lost} lost{movements}"
    )


def loss_lines(account: Account) -> Iterator[str]:
    """The losses, then what is carried in another form; one line per task and reason."""
    yield from (f"lost     {_line(loss)}" for loss in account.lost)
    yield from (f"changed  {_line(loss)}" for loss in account.changed)


def loss_report(handover: Handover, written: Format, file: str, account: Account) -> str:
    """The report as Markdown."""
    parts = [
        f"# What {_cell(file)} does not hold",
        f"{_cell(written.description)}. {_cell(handover.mark)}.",
        loss_summary(account) + ".",
    ]
    parts += _section("Lost", "Why", account.lost)
    parts += _section("Carried in another form", "How", account.changed)
    return "\n\n".join(parts) + "\n"


def _section(title: str, column: str, losses: Sequence[Loss]) -> list[str]:
    if not losses:
        return []
    rows = [
        f"| {loss.task or 'plan'} | {_cell(loss.what)} | {_cell(loss.why)} |" for loss in losses
    ]
    return [f"## {title}", "\n".join([f"| Task | What | {column} |", "|---|---|---|", *rows])]


def _line(loss: Loss) -> str:
    return plain(f"{loss.task or 'plan'}: {loss.what} - {loss.why}")


def _cell(text: str) -> str:
    """Text of a command in a table: no line of its own, no column, no markup."""
    return "".join(f"\\{sign}" if sign in "\\`*_[]<>|#" else sign for sign in plain(text))
