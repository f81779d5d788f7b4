"""Review in a terminal: the plan is shown, then the reviewer approves, rejects, edits or quits."""

import contextlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

from rich.console import Console
from rich.text import Text

from planner_ft.document import PlanDocument, differences
from planner_ft.document.confidence import choice_lines, confidence_lines
from planner_ft.document.edits import Difference
from planner_ft.document.track import track
from planner_ft.document.tree import brief, constraint_lines, origin_line, overview_lines, task_tree
from planner_ft.document.warnings.case import gravest_first, meaning
from planner_ft.review.approval import Approval, tampered
from planner_ft.review.chart import chart
from planner_ft.review.commands import HELP
from planner_ft.review.desk import ChangedError, Desk
from planner_ft.review.log import Appended
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.support.resources import clock
from planner_ft.support.terminal import plain
from planner_ft.vocabulary import Vocabulary

PROMPT = "approve, reject, an edit (help shows them), show or quit: "
ADOPT = {"adopt": "take over what was changed by hand"}
WIDEST = 120
SHOWN_CHANGES = 40
SEVERITY_STYLES = {"danger": "bold red", "caution": "yellow", "note": ""}
STYLES = {"approved": "bold green", "unknown": ""}

Read = Callable[[str], str]
Texts = Sequence[str]
Line = tuple[str, str]
"""A text, and its style for rich."""


def review_lines(
    document: PlanDocument, approval: Approval, vocabulary: Vocabulary, **drawing: Any
) -> Iterator[Line]:
    """Everything about a plan, in the order of a review; `drawing` are keywords of `chart`."""
    status, *changed = approval_text(approval)
    yield status, STYLES.get(approval.status, "bold red")
    yield from ((text, "") for text in changed)
    if (foreign := tampered(document, vocabulary)) is not None:
        text = "the file was altered by hand: its content is not what its digest says"
        yield f"{text}; --adopt takes the changes over as an edit", "bold red"
        yield from ((f" - {change.text}", "bold red") for change in foreign[:SHOWN_CHANGES])
    course = track(document, vocabulary)
    short = brief(document, course, vocabulary)
    yield from (("", ""), ("What will happen", "bold"))
    yield from ((line, "") for line in overview_lines(document, short))
    yield from _warnings(document)
    yield from ((text, "bold") for text in confidence_lines(document))
    yield from ((f" ? {text}", "yellow") for text in choice_lines(document))
    tasks = [task["id"] for task in document["tasks"]]
    sections: dict[str, Iterable[str]] = {
        "Not checked": (f" - {text}" for text in short.unchecked),
        "Command": [*document["command"].splitlines(), *origin_line(document)],
        "Tasks": task_tree(document),
        "Where values come from": _sources(document),
        "Assumptions": (f" - {text}" for text in document["assumptions"]),
        "Constraints": (f" - {text}" for text in constraint_lines(document)),
        "Track": chart(course, tasks, vocabulary.home, **drawing),
        "Estimate": [_estimate(document)],
        "Changed since the model proposed it": (f" - {one.text}" for one in differences(document)),
    }
    for heading, lines in sections.items():
        if shown := list(lines):
            yield from (("", ""), (heading, "bold"), *((line, "") for line in shown))


def approval_text(approval: Approval) -> list[str]:
    """The decision in the log, and the differences from what was approved, one a line."""
    more = len(approval.changes) - SHOWN_CHANGES
    rest = [f" - ... and {more} more; plannerft verify --json shows all"] if more > 0 else []
    shown = [f" - {plain(change.text)}" for change in approval.changes[:SHOWN_CHANGES]]
    return [approval.text, *shown, *rest]


def _warnings(document: PlanDocument) -> Iterator[Line]:
    warnings = document["warnings"]
    style = "bold yellow" if warnings else "bold"
    yield from (("", ""), (_counted(document, "No"), style))
    for warning in gravest_first(warnings):
        severity, name = meaning(warning["kind"])
        text = f" - {severity}: {name}. {warning['text']}  [{warning['id']}]"
        yield text, SEVERITY_STYLES[severity]
    questions = [*document.get("questions", ()), *document["ontology"]["questions"]]
    yield from ((f" ? {question}", "") for question in questions)


def _counted(document: PlanDocument, none: str) -> str:
    count = len(document["warnings"])
    return f"{count or none} warning{'s' if count != 1 else ''}"


def _sources(document: PlanDocument) -> Iterator[str]:
    command = document["command"]
    for number, task in enumerate(document["tasks"], start=1):
        given, known = task["parameters"], task["sources"]
        for name, source in ((name, known[name]) for name in known if name in given):
            words = ", ".join(f'"{command[start:end]}"' for start, end in source.get("spans", ()))
            why = "; ".join(filter(None, (words, source.get("note"))))
            origin = f"{source['kind']} ({why})" if why else source["kind"]
            yield f"{number:2d} {name} = {compact_json(given[name])}: {origin}"


def _estimate(document: PlanDocument) -> str:
    estimate, speed = document["estimate"], document["vehicle"]["cruise_speed"]
    numbers = {task["id"]: number for number, task in enumerate(document["tasks"], start=1)}
    unknown = [str(numbers.get(name, name)) for name in estimate["open"]]
    plural = "s" if len(unknown) > 1 else ""
    more = f", and what is not known of task{plural} {', '.join(unknown)}" if unknown else ""
    more += f"; ends {estimate['away']:g} m from home" if "away" in estimate else ""
    time = clock(estimate["seconds"])
    return f"{estimate['length']:.0f} m, {time} at a cruise speed of {speed:g} m/s{more}"


class Conversation:
    """A reviewer at a desk: each action prints its result. Raises PlannerError."""

    def __init__(self, desk: Desk, console: Console, read: Read = input) -> None:
        self.desk, self.console, self.read = desk, console, read

    def show(self) -> None:
        """The whole plan."""
        desk, width = self.desk, min(self.console.width, WIDEST)
        braille = (self.console.encoding or "").lower().startswith("utf")
        plan = desk.document, desk.approval(), desk.vocabulary
        for text, style in review_lines(*plan, columns=width, braille=braille):
            self.say(text, style)

    def decide(
        self, adopt: bool, edits: Texts, approve: bool, acknowledged: Texts, reason: str | None
    ) -> None:
        """The actions of a command line, in this order: adopt, edits, approval or rejection."""
        if adopt:
            self.adopt()
        for text in edits:
            self.edit(text)
        if approve:
            self._decided(self.desk.approve(self.desk.by or "", acknowledged))
        elif reason is not None:
            self._decided(self.desk.reject(self.desk.by or "", reason))

    def converse(self) -> None:
        """Show the plan and do what is typed, until a decision, `quit` or the end of the input."""
        self.show()
        with contextlib.suppress(EOFError):
            while not self._step():
                pass

    def edit(self, text: str) -> None:
        """One edit, and the differences that it made."""
        changed = self.desk.edit(text)
        self._saved(changed, "" if changed else "nothing is different\n")

    def adopt(self) -> None:
        """Changes by hand become an edit."""
        self.desk.adopt()
        what = "what was changed by hand is an edit of the plan now; "
        self._saved(differences(self.desk.document), what)

    def _saved(self, changed: Iterable[Difference], what: str) -> None:
        for one in changed:
            self.say(f" - {one.text}", "cyan")
        for line in f"{what}saved; {_counted(self.desk.document, 'no')}".splitlines():
            self.say(line)

    def say(self, text: str, style: str = "") -> None:
        """Print one line with its control characters spelt out."""
        self.console.print(Text(plain(text), style))

    def _step(self) -> bool:
        """One line of the reviewer; whether it was the last one."""
        text = self.read(PROMPT).strip()
        try:
            match text.lower():
                case "":
                    pass
                case "approve" | "a":
                    return self._approve()
                case "reject" | "r":
                    self._decided(self.desk.reject(self._name(), self.read("reason: ")))
                    return True
                case "quit" | "q":
                    return True
                case "show" | "s":
                    self.show()
                case "adopt":
                    self.adopt()
                case "edit" | "e" | "help" | "h" | "?":
                    for example, effect in (HELP | ADOPT).items():
                        self.say(f"  {example:{max(map(len, HELP))}}  {effect}")
                case _:
                    self.edit(text)
        except ChangedError as error:
            self.say(str(error), "bold red")
            self.desk.read()
            self.show()
        except PlannerError as error:
            self.say(str(error), "red")
        return False

    def _approve(self) -> bool:
        warnings = self.desk.document["warnings"]
        for number, warning in enumerate(warnings, start=1):
            self.say(f"{number}/{len(warnings)} {warning['text']}", "yellow")
            if self.read("acknowledged? y or n: ").strip().lower() not in ("y", "yes"):
                self.say("not approved")
                return False
        acknowledged = [warning["id"] for warning in warnings]
        self._decided(self.desk.approve(self._name(), acknowledged))
        return True

    def _name(self) -> str:
        if not self.desk.by:
            self.desk.by = self.read("your name: ").strip() or None
        return self.desk.by or ""

    def _decided(self, done: Appended) -> None:
        """The record, and its place."""
        record, log = done.record, self.desk.log
        if done.set_aside is not None:
            text = f"{log}: its last line was never finished and so never confirmed"
            self.say(f"{text}; it was moved to {done.set_aside}", "yellow")
        style = "bold green" if record["event"] == "approved" else "bold red"
        number = record["sequence"]
        self.say(f"{record['event']} by {record['reviewer']}: record {number} of {log}", style)
