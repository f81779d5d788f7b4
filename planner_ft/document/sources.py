"""Where a value of a plan is from: command, located place, rule, vehicle, operator or model."""

from typing import Any

from planner_ft.document.entered import short
from planner_ft.document.language import language
from planner_ft.facts import Evidence, Input, Span, read_input
from planner_ft.planning.frame import frame_of
from planner_ft.vocabulary import Entry, Parameter, Vocabulary

UNREAD = "the command could not be read with certainty"
Source = dict[str, Any]
"""{"kind": one of SOURCES, "spans": [[start, end], ...] of the command, "note"}."""


def sources(document: Entry, vocabulary: Vocabulary) -> list[dict[str, Source]]:
    """Per task, in order, {parameter: source}; the mention nearest to the task's others."""
    frame = frame_of(document)
    command = read_input({"prompt": frame.spoken}, vocabulary)
    before = document.get("proposed", document)["tasks"]
    proposed = {task["id"]: task["parameters"] for task in before}
    found, place = [], 0
    for task in document["tasks"]:
        of_task, place = _of_task(task, proposed.get(task["id"]), command, place)
        for source in of_task.values() if frame.swaps else ():
            if "spans" in source:
                source["spans"] = [list(frame.span(*span)) for span in source["spans"]]
        found.append(of_task)
    return found


def _of_task(
    task: Entry, proposed: Entry | None, command: Input, place: int
) -> tuple[dict[str, Source], int]:
    """The sources of a task's parameters, and where in the command the task is spoken of."""
    known = command.vocabulary.task[task["title"]].by_name
    fixed: dict[str, Source] = {}
    open_values: dict[str, Evidence] = {}
    for name, value in task["parameters"].items():
        source = _edited(task, name, proposed)
        if name not in known:
            source = _from("model", note="no parameter of this task")
        if source is None:
            evidence = command.evidence(value, known[name])
            source = _by_rule(value, known[name], evidence, command)
            open_values[name] = evidence
        if source is not None:
            fixed[name] = source
    mentions = {name: found.mentions for name, found in open_values.items() if name not in fixed}
    certain = [found[0][0][0] for found in mentions.values() if len(found) == 1]
    certain += [source["spans"][0][0] for source in fixed.values() if source.get("spans")]
    anchor = sum(certain) / len(certain) if certain else place
    for name, found in mentions.items():
        if found:
            nearest = min(found, key=lambda spans: abs(spans[0][0] - anchor))
            fixed[name] = _from("command", nearest)
        elif open_values[name].given:
            fixed[name] = _from("command")
        else:
            unread = open_values[name].given is None
            fixed[name] = _from("model", note=UNREAD if unread else "the command does not say it")
    starts = [source["spans"][0][0] for source in fixed.values() if source.get("spans")]
    return {name: fixed[name] for name in task["parameters"]}, max(starts, default=place)


def _edited(task: Entry, name: str, proposed: Entry | None) -> Source | None:
    """The source of a value that the model did not propose."""
    if name in task.get("defaults", {}):
        return _from("vehicle", note="the vehicle's value where none is stated")
    if name in task.get("located", {}):
        return _from("located", note=f"resolved location {task['located'][name]}")
    if proposed is None:
        return _from("operator", note="inserted")
    if name not in proposed:
        return _from("operator", note="added")
    if proposed[name] != task["parameters"][name]:
        return _from("operator", note=f"proposed: {short(str(proposed[name]), 60)}")
    return None


def _by_rule(value: Any, parameter: Parameter, evidence: Evidence, command: Input) -> Source | None:
    """The source of a value that the vehicle's places, parts of a circle or arithmetic give."""
    text = command.facts.text
    if evidence.kind == "vehicle":
        if tuple(value) == command.vocabulary.unresolved:
            return _from("derived", note="unresolved location: the command gives no coordinates")
        if command.facts.evidence(value, parameter).mentions:
            return _from("command", command.facts.evidence(value, parameter).spans)
        home = language(command.vocabulary).words["home"].finditer(text)
        words = tuple(match.span() for match in home)[-1:]
        if words:
            return _from("derived", words, "home")
        return _from("model", note="home, which the command does not speak of")
    if evidence.kind == "derived" and parameter.unit == "deg" and evidence.spans:
        start, end = evidence.spans[0]
        note = f"{text[start:end]} of a circle is {abs(value):g} degrees"
        return _from("derived", evidence.spans, note)
    if evidence.kind == "derived" and not evidence.spans:
        return _from("derived", note="follows from what the command says")
    return None


def _from(kind: str, spans: tuple[Span, ...] = (), note: str = "") -> Source:
    source: Source = {"kind": kind}
    if spans:
        source["spans"] = [list(span) for span in spans]
    return {**source, "note": note} if note else source
