"""Where each value of a plan is from: words of the command, a located place, a rule, the operator,
or the model alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from planner_ft.document.language import language
from planner_ft.document.said import Mention, Said, Span, read_command
from planner_ft.vocabulary import Parameter, Vocabulary

Source = dict[str, Any]
"""{"kind": one of SOURCES, "spans": [[start, end], ...] of the command, "note"}."""


def sources(document: Mapping[str, Any], vocabulary: Vocabulary) -> list[dict[str, Source]]:
    """Per task, in order, {parameter: source}.

    A value that the command says in several places is from the one that is nearest to the other
    values of its task.
    """
    said = read_command(document["command"], vocabulary)
    proposed = {
        task["id"]: task["parameters"]
        for task in document.get("proposed", {"tasks": document["tasks"]})["tasks"]
    }
    found, place = [], 0
    for task in document["tasks"]:
        of_task, place = _of_task(task, proposed.get(task["id"]), said, vocabulary, place)
        found.append(of_task)
    return found


def _of_task(
    task: Mapping[str, Any],
    proposed: Mapping[str, Any] | None,
    said: Said,
    vocabulary: Vocabulary,
    place: int,
) -> tuple[dict[str, Source], int]:
    """The sources of a task's parameters, and where in the command the task is spoken of."""
    known = vocabulary.task[task["title"]].by_name
    options: dict[str, list[Mention]] = {}
    fixed: dict[str, Source] = {}
    for name, value in task["parameters"].items():
        source = (
            _apart(task, name, proposed, said, vocabulary)
            if name in known
            else _from("model", note="no parameter of this task")
        )
        if source is not None:
            fixed[name] = source
        else:
            options[name] = (
                said.mentions(value, known[name])
                if said.states(value, known[name]) is not False
                else []
            )
    certain = [mentions[0].start for mentions in options.values() if len(mentions) == 1]
    certain += [source["spans"][0][0] for source in fixed.values() if source.get("spans")]
    anchor = sum(certain) / len(certain) if certain else place
    chosen: dict[str, Source] = {}
    for name, value in task["parameters"].items():
        if name in fixed:
            chosen[name] = fixed[name]
        elif options[name]:
            nearest = min(options[name], key=lambda mention: abs(mention.start - anchor))
            chosen[name] = _from("command", nearest.spans)
        else:
            chosen[name] = _unplaced(value, known[name], said)
    starts = [source["spans"][0][0] for source in chosen.values() if source.get("spans")]
    return chosen, max(starts, default=place)


def _apart(
    task: Mapping[str, Any],
    name: str,
    proposed: Mapping[str, Any] | None,
    said: Said,
    vocabulary: Vocabulary,
) -> Source | None:
    """The source of a value that is not looked for among the command's values; None for every
    other.
    """
    value, parameter = task["parameters"][name], vocabulary.task[task["title"]].by_name[name]
    if name in task.get("located", {}):
        return _from("located", note=f"resolved location {task['located'][name]}")
    if proposed is None:
        return _from("operator", note="inserted")
    if name not in proposed or proposed[name] != value:
        return _from(
            "operator", note=f"proposed: {_shown(proposed[name])}" if name in proposed else "added"
        )
    if parameter.type == "position" and tuple(value) == vocabulary.unresolved:
        return _from("derived", note="unresolved location: the command gives no coordinates")
    if (
        parameter.type == "position"
        and tuple(value) == vocabulary.home
        and not said.mentions(value, parameter)
    ):
        return _home(said, vocabulary)
    if parameter.unit == "deg" and not any(
        mention.rank == 0 for mention in said.mentions(value, parameter)
    ):
        span = said.turn(abs(value))
        return (
            _from(
                "derived",
                (span,),
                f"{said.command[span[0] : span[1]]} of a circle is {value:g} degrees",
            )
            if span
            else None
        )
    return None


def _home(said: Said, vocabulary: Vocabulary) -> Source:
    words = [match.span() for match in language(vocabulary).words["home"].finditer(said.command)]
    return (
        _from("derived", tuple(words[-1:]), "home")
        if words
        else _from("model", note="home, which the command does not speak of")
    )


def _unplaced(value: Any, parameter: Parameter, said: Said) -> Source:
    """The source of a value of which no words were found."""
    verdict = said.states(value, parameter)
    if verdict:
        return _from("command")
    return (
        _from("model", note="the command could not be read with certainty")
        if verdict is None
        else _from("model", note="the command does not say it")
    )


def _from(kind: str, spans: tuple[Span, ...] = (), note: str = "") -> Source:
    return {
        "kind": kind,
        **({"spans": [list(span) for span in spans]} if spans else {}),
        **({"note": note} if note else {}),
    }


def _shown(value: Any) -> str:
    return str(value) if len(str(value)) <= 60 else f"{str(value)[:60]} ..."
