"""What the command says and the plan has not: limits, rows of positions, repeats; contradictions.

Facts of the text are compared with values of the plan; which words limit or repeat is data
(planner_ft/document/english.toml).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from planner_ft.document.language import Clause, Language, language, read_clauses
from planner_ft.document.ontology import named_places
from planner_ft.document.positions import positions_of, rows_of
from planner_ft.document.warnings.measures import (
    clause_at,
    is_wanted,
    lost,
    lost_bare,
    lost_measures,
)
from planner_ft.document.warnings.places import ROW, uneven_rows, unvisited
from planner_ft.document.warnings.plan_values import PlanValues, same_place
from planner_ft.document.warnings.warning import Warning, named, quoted, warning
from planner_ft.facts import Number, Position, is_place, near, read_input
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.places import without_geographic
from planner_ft.planning.frame import frame_of
from planner_ft.vocabulary import Vocabulary

REPEATED = 16
"""Characters behind a count in which the word for what is repeated stands."""


def said_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """One per limit, row, position and repeat that the plan lacks, and per contradiction."""
    if not document["tasks"]:
        return
    command = read_input({"prompt": frame_of(document).spoken}, vocabulary)
    text = without_geographic(command.facts.text)
    clauses, spoken = read_clauses(text, vocabulary), language(vocabulary)
    plan, pairs = PlanValues(document, command), positions_of(text)
    if not command.facts.unread:
        yield from lost_measures(text, clauses, spoken, plan)
    yield from lost_bare(text, clauses, pairs, spoken, plan, vocabulary)
    rows = [row for row in rows_of(text, pairs) if len(row) >= ROW]
    yield from _lost_rows(text, rows, clauses, spoken, plan)
    yield from uneven_rows(rows, document, vocabulary)
    yield from unvisited(clauses, document, vocabulary)
    in_rows = {place for row in rows for place in row}
    for place in pairs:
        wanted = is_wanted(clauses, place.start)
        if wanted and place not in in_rows and not plan.has(place):
            yield lost(text[place.start : place.end])
    for clause in clauses:
        if not any(clause.start <= row[0].start < clause.end for row in rows):
            yield from _lost_limit(clause, text, pairs, spoken, plan)
    yield from _lost_repeats(text, clauses, pairs, spoken, plan)
    yield from _there_and_not(clauses, pairs)
    yield from _misnamed(document, text, vocabulary)


def _lost_rows(
    text: str,
    rows: Sequence[list[Position]],
    clauses: Sequence[Clause],
    spoken: Language,
    plan: PlanValues,
) -> Iterator[Warning]:
    """Rows of positions that are neither the corners of an area nor a route."""
    for row in rows:
        clause = clause_at(clauses, row[0].start)
        limiting = clause is not None and spoken.words["limit"].search(clause.text)
        visited = all(plan.has(place) for place in row)
        if plan.encloses(row) or (visited and not limiting):
            continue
        words = text[row[0].start : row[-1].end]
        missing = "no limit of the plan has that area" if limiting else "the plan has not all of it"
        said = f'The command says "{quoted(words)}", and {missing}.'
        yield warning("limit-lost" if limiting else "value-lost", said, about=words.casefold())


def _lost_limit(
    clause: Clause, text: str, pairs: Sequence[Position], spoken: Language, plan: PlanValues
) -> Iterator[Warning]:
    """A clause that limits with a number or a position that no limit and no task has."""
    if clause.corrected or not spoken.words["limit"].search(clause.text):
        return
    inside = [place for place in pairs if clause.start <= place.start < clause.end]
    whole = spoken.words["whole_limit"].search(clause.text)
    numbers = [one for one in read_numbers(text) if clause.start <= one.start < clause.end]
    apart = [n for n in numbers if not any(one.start <= n.start < one.end for one in inside)]
    measures = [n for n in apart if n.unit in ("m", "s", "m/s") or _is_coordinate(n, text)]
    known = plan.limited if whole else [*plan.limited, *plan.numbers]
    kept = all(any(near(one.value, other) for other in known) for one in measures)
    away = spoken.words["away"].search(clause.text)
    if not measures and away:
        limited = [(value[0], value[1]) for value in plan.limits if is_place(value)]
        kept = all(any(same_place(place, at) for at in limited) for place in inside)
        if not inside:
            kept = plan.speaks_of(clause.text[away.end() :])
    by_time = spoken.words["by_time"].search(clause.text)
    if by_time and clause.text[by_time.end() :].lstrip()[:1].isdigit():
        kept = plan.timed
    if not kept:
        words = _with_clock(clause, text).strip(" ,;")
        said = f'The command says "{quoted(words)}", and no limit of the plan has that.'
        yield warning("limit-lost", said, about=words.casefold())


def _is_coordinate(number: Number, text: str) -> bool:
    """Whether a number is said as one coordinate: "x = 120"."""
    return re.search(r"(?<![a-z])[xy]\s?[=:]?\s?$", text[: number.start].casefold()) is not None


def _with_clock(clause: Clause, text: str) -> str:
    """The words of a clause; a time of day in it goes on behind its colon."""
    clock = re.compile(r":\d\d").match(text, clause.end)
    return text[clause.start : clock.end() if clock else clause.end]


def _lost_repeats(
    text: str,
    clauses: Sequence[Clause],
    pairs: Sequence[Position],
    spoken: Language,
    plan: PlanValues,
) -> Iterator[Warning]:
    """Counts of rounds or times that nothing in the plan is done so often."""
    found: dict[int, tuple[float, int, int]] = {}
    for number in read_numbers(text):
        behind = spoken.words["repeats"].search(text, number.end, number.end + REPEATED)
        if behind and number.unit is None and _is_count(number, text, behind.start()):
            found[behind.end()] = (number.value, number.start, behind.end())
    for count, name in ((2.0, "twice"), (3.0, "thrice")):
        spans = [match.span() for match in spoken.words[name].finditer(text)]
        found |= {end: (count, start, end) for start, end in spans}
    for count, start, end in found.values():
        clause = clause_at(clauses, start)
        if not clause or not is_wanted(clauses, start):
            continue
        places = [place for place in pairs if clause.start <= place.start < clause.end]
        if not plan.repeats(count, places):
            words = text[start:end]
            said = f'The command says "{words}", and the plan does nothing so often.'
            yield warning("repeat-lost", said, about=words.casefold())


def _is_count(number: Number, text: str, until: int) -> bool:
    between = text[number.end : until].split()
    return number.value >= 2 and number.value.is_integer() and len(between) <= 1


def _there_and_not(clauses: Sequence[Clause], pairs: Sequence[Position]) -> Iterator[Warning]:
    """A position that one clause asks for and another rules out."""
    for place in pairs:
        clause = clause_at(clauses, place.start)
        others = [
            (clause_at(clauses, one.start), one)
            for one in pairs
            if one is not place and same_place(place, (one.x, one.y))
        ]
        asked = any(other and other.wants(one.start) for other, one in others)
        if asked and clause and not clause.corrected and not clause.wants(place.start):
            words = quoted(clause.text.strip(" ,;"))
            text = f'The command asks for [{place.x:g}, {place.y:g}], and says "{words}".'
            yield warning("contradiction", text, about=f"{place.x:g},{place.y:g}")


def _misnamed(document: Mapping[str, Any], text: str, vocabulary: Vocabulary) -> Iterator[Warning]:
    """A task prompt that puts one thing of the command where the command has another."""
    said = [(words.casefold(), place) for words, place in named_places(text, vocabulary)]
    names = {words for words, _place in said}
    for task in document["tasks"]:
        for words, place in named_places(task["task_prompt"], vocabulary):
            there = {name for name, at in said if same_place(at, (place.x, place.y))}
            if there and words.casefold() in names - there:
                where = f"[{place.x:g}, {place.y:g}]"
                text = f"{named(task)} speaks of {words} at {where}, and the command has"
                yield warning("contradiction", f"{text} {min(there)} there.", task)
