"""A plan as a reviewer reads it in a terminal: what needs a decision first."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from planner_ft.document import PlanDocument, altered, differences
from planner_ft.document.track import track
from planner_ft.document.tree import plain, task_tree
from planner_ft.review.chart import chart
from planner_ft.review.verify import Approval
from planner_ft.support.files import compact_json
from planner_ft.support.resources import clock
from planner_ft.vocabulary import Vocabulary

SHOWN_CHANGES = 40


class Line(NamedTuple):
    """A line of text without control characters, and how it is shown: a style of the library rich,
    "" for none.
    """

    text: str
    style: str = ""


def review_lines(
    document: PlanDocument,
    approval: Approval,
    vocabulary: Vocabulary,
    *,
    columns: int = 78,
    braille: bool = True,
) -> Iterator[Line]:
    """Everything about a plan, in the order in which a reviewer needs it."""
    for text, style in _lines(document, approval, vocabulary, columns, braille):
        yield Line(plain(text), style)


def _lines(
    document: PlanDocument, approval: Approval, vocabulary: Vocabulary, columns: int, braille: bool
) -> Iterator[Line]:
    yield from approval_lines(approval)
    if altered(document):
        yield Line(
            "the file was altered by hand: its content is not what its digest says; --adopt takes"
            " the changes over as an edit",
            "bold red",
        )
    yield from _warnings(document)
    yield from _section("Command", document["command"].splitlines())
    yield from _section("Tasks", task_tree(document))
    yield from _section("Where values come from", _sources(document))
    for key in ("assumptions", "constraints"):
        yield from _section(key.capitalize(), (f" - {text}" for text in document[key]))
    sketch = chart(
        track(document, vocabulary),
        [task["id"] for task in document["tasks"]],
        vocabulary.home,
        columns=columns,
        braille=braille,
    )
    yield from _section("Track", sketch)
    yield from _section("Estimate", [_estimate(document)])
    yield from _section(
        "Changed since the model proposed it",
        (f" - {difference.text}" for difference in differences(document)),
    )


def approval_lines(approval: Approval) -> Iterator[Line]:
    """What the log says about the plan, and what is different from what was approved."""
    yield Line(
        approval.text, {"approved": "bold green", "unknown": ""}.get(approval.status, "bold red")
    )
    yield from (Line(f" - {plain(change.text)}") for change in approval.changes[:SHOWN_CHANGES])
    if len(approval.changes) > SHOWN_CHANGES:
        yield Line(
            f" - ... and {len(approval.changes) - SHOWN_CHANGES} more; plannerft verify --json"
            " shows all"
        )


def _section(heading: str, lines: Any) -> Iterator[Line]:
    told = list(lines)
    if told:
        yield Line("")
        yield Line(heading, "bold")
        yield from map(Line, told)


def _warnings(document: PlanDocument) -> Iterator[Line]:
    warnings, questions = document["warnings"], document["ontology"]["questions"]
    yield Line("")
    if not warnings:
        yield Line("No warnings", "bold")
    else:
        yield Line(f"{len(warnings)} warning{'s' if len(warnings) > 1 else ''}", "bold yellow")
        yield from (
            Line(f" - {warning['text']}  [{warning['id']}]", "yellow") for warning in warnings
        )
    yield from (Line(f" ? {question}") for question in questions)


def _sources(document: PlanDocument) -> Iterator[str]:
    for number, task in enumerate(document["tasks"], start=1):
        for name, source in task["sources"].items():
            if name in task["parameters"]:
                yield (
                    f"{number:2d} {name} = {compact_json(task['parameters'][name])}:"
                    f" {_source(source, document['command'])}"
                )


def _source(source: dict[str, Any], command: str) -> str:
    words = ", ".join(f'"{command[start:end]}"' for start, end in source.get("spans", ()))
    parts = [part for part in (words, source.get("note", "")) if part]
    return f"{source['kind']} ({'; '.join(parts)})" if parts else str(source["kind"])


def _estimate(document: PlanDocument) -> str:
    estimate, vehicle = document["estimate"], document["vehicle"]
    numbers = {task["id"]: number for number, task in enumerate(document["tasks"], start=1)}
    unknown = [str(numbers.get(name, name)) for name in estimate["open"]]
    more = (
        f", and what is not known of task{'s' if len(unknown) > 1 else ''} {', '.join(unknown)}"
        if unknown
        else ""
    )
    return (
        f"{estimate['length']:.0f} m, {clock(estimate['seconds'])} at a cruise speed of"
        f" {vehicle['cruise_speed']:g} m/s{more}"
    )
