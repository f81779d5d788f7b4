"""Text on a terminal: what models, servers and files brought is shown, never obeyed."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console

Report = Callable[[str, int, int], None]
"""Progress: called with a label, how many are done and how many there are in all of that part."""


def silent(_label: str, _done: int, _total: int) -> None:
    """No progress."""


def under(name: str, report: Report) -> Report:
    """The progress of a part of that name."""
    return lambda label, done, total: report(f"{name}: {label}", done, total)


def plain(text: str, kept: str = "") -> str:
    """The text, what a terminal would obey or cannot show as JSON's escapes, but for `kept`."""
    if text.isprintable():
        return text
    # Of what is not printable, the wider and narrower spaces do nothing.
    return "".join(
        one
        if one.isprintable() or one in kept or (one.isspace() and one > "\x85" and one < "\u2028")
        else json.dumps(one)[1:-1]
        for one in text
    )


def show(text: str, *, error: bool = False, end: str = "\n") -> None:
    """Print lines, for `error` on standard error."""
    stream = sys.stderr if error else sys.stdout
    print(plain(text, "\n\t"), file=stream, end=end, flush=True)


def terminal(*, stderr: bool = False, **settings: Any) -> Console:
    """A console for tables, colours and progress. Texts are plain, and no markup."""
    from rich.console import Console
    from rich.segment import Segment

    class PlainConsole(Console):
        def render(self, *arguments: Any, **values: Any) -> Any:
            for text, style, control in super().render(*arguments, **values):
                yield Segment(text if control else plain(text, "\n"), style, control)

    return PlainConsole(stderr=stderr, markup=False, highlight=False, emoji=False, **settings)
