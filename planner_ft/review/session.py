"""Review in a terminal: the plan is shown, then the reviewer approves, rejects, edits or quits."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Collection, Sequence

from rich.console import Console
from rich.text import Text

from planner_ft.document import differences
from planner_ft.document.tree import plain
from planner_ft.review.commands import HELP
from planner_ft.review.desk import Desk
from planner_ft.review.log import Appended
from planner_ft.review.store import ChangedError
from planner_ft.review.view import Line, review_lines
from planner_ft.support.errors import PlannerError

PROMPT = "approve, reject, an edit (help shows them), show or quit: "
WIDEST = 120

Read = Callable[[str], str]


def terminal() -> Console:
    """A console that shows texts as they are: no markup, no emoji names, no colours that nobody
    asked for.
    """
    return Console(markup=False, highlight=False, emoji=False, soft_wrap=True)


def say(console: Console, text: str, style: str = "") -> None:
    """Print one line with its control characters spelt out."""
    console.print(Text(plain(text), style))


def show(desk: Desk, console: Console) -> None:
    """The whole plan."""
    braille = (console.encoding or "").lower().startswith("utf")
    for line in review_lines(
        desk.document,
        desk.approval(),
        desk.vocabulary,
        columns=min(console.width, WIDEST),
        braille=braille,
    ):
        _print(console, line)


def make_edit(desk: Desk, text: str, console: Console) -> None:
    """One edit, and what it changed. Raises PlannerError."""
    changed = desk.edit(text)
    for difference in changed:
        say(console, f" - {difference.text}", "cyan")
    if not changed:
        say(console, "nothing is different")
    say(console, f"saved; {_warnings(desk)}")


def tell_decision(done: Appended, desk: Desk, console: Console) -> None:
    """What was recorded, and where."""
    record = done.record
    if done.set_aside is not None:
        say(
            console,
            f"{desk.log}: its last line was never finished and so never confirmed; it was moved to"
            f" {done.set_aside}",
            "yellow",
        )
    say(
        console,
        f"{record['event']} by {record['reviewer']}: record {record['sequence']} of {desk.log}",
        "bold green" if record["event"] == "approved" else "bold red",
    )


def decide(
    desk: Desk,
    console: Console,
    *,
    adopt: bool,
    edits: Sequence[str],
    approve: bool,
    acknowledged: Collection[str],
    reason: str | None,
) -> None:
    """What was asked for on the command line, in this order: adopt, edits, approval or rejection.
    Raises PlannerError at the first that cannot be.
    """
    if adopt:
        _adopt(desk, console)
    for text in edits:
        make_edit(desk, text, console)
    if approve:
        tell_decision(desk.approve(desk.by or "", acknowledged), desk, console)
    elif reason is not None:
        tell_decision(desk.reject(desk.by or "", reason), desk, console)


def converse(desk: Desk, console: Console, read: Read) -> None:
    """Show the plan and do what the reviewer types, until a decision is recorded or they leave
    (also by the end of the input).
    """
    show(desk, console)
    with contextlib.suppress(EOFError):
        while not _step(desk, console, read):
            pass


def _step(desk: Desk, console: Console, read: Read) -> bool:
    """One line of the reviewer; whether it was the last one."""
    text = read(PROMPT).strip()
    word = text.lower()
    try:
        if word in ("approve", "a"):
            return _approve(desk, console, read)
        if word in ("reject", "r"):
            tell_decision(desk.reject(_name(desk, read), read("reason: ")), desk, console)
            return True
        if word in ("quit", "q"):
            return True
        if word in ("show", "s"):
            show(desk, console)
        elif word == "adopt":
            _adopt(desk, console)
        elif word in ("edit", "e", "help", "h", "?"):
            _help(console)
        elif text:
            make_edit(desk, text, console)
    except ChangedError as error:
        say(console, str(error), "bold red")
        desk.read()
        show(desk, console)
    except PlannerError as error:
        say(console, str(error), "red")
    return False


def _adopt(desk: Desk, console: Console) -> None:
    desk.adopt()
    for difference in differences(desk.document):
        say(console, f" - {difference.text}", "cyan")
    say(console, f"what was changed by hand is an edit of the plan now; saved; {_warnings(desk)}")


def _approve(desk: Desk, console: Console, read: Read) -> bool:
    acknowledged = []
    for number, warning in enumerate(desk.document["warnings"], start=1):
        say(console, f"{number}/{len(desk.document['warnings'])} {warning['text']}", "yellow")
        if read("acknowledged? y or n: ").strip().lower() not in ("y", "yes"):
            say(console, "not approved")
            return False
        acknowledged.append(warning["id"])
    tell_decision(desk.approve(_name(desk, read), acknowledged), desk, console)
    return True


def _name(desk: Desk, read: Read) -> str:
    if not desk.by:
        desk.by = read("your name: ").strip() or None
    return desk.by or ""


def _warnings(desk: Desk) -> str:
    count = len(desk.document["warnings"])
    return f"{count or 'no'} warning{'s' if count != 1 else ''}"


def _help(console: Console) -> None:
    width = max(len(example) for example, _what in HELP)
    for example, what in (*HELP, ("adopt", "take over what was changed in the file by hand")):
        say(console, f"  {example:{width}}  {what}")


def _print(console: Console, line: Line) -> None:
    console.print(Text(line.text, line.style))
