"""What the command says and the plan has not: limits, rows of positions, repeats; contradictions.

Facts of the text are compared with values of the plan; which words limit or repeat is data
(planner_ft/document/english.toml).
"""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from planner_ft.document.language import Clause, Language, language, read_clauses
from planner_ft.document.ontology import named_places
from planner_ft.document.warnings.warning import Warning, named, quoted, warning
from planner_ft.facts import Input, Number, Position, is_number, is_place, near, read_input
from planner_ft.facts.numbers import neighbours, read_numbers
from planner_ft.facts.places import read_positions, without_geographic
from planner_ft.planning.frame import frame_of
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import step_skills

PAIR = re.compile(r"[-−–]?\d+(?:\.\d+)?\s?[,/]\s?[-−–]?\d+(?:\.\d+)?")
BESIDE = re.compile(r"[\s,;\])\[(]*(?:and|to|then)?[\s,;\])\[(]*")
"""What stands between the positions of a row."""
COURSE = re.compile(r"\b(?:heading|bearing|course)(?: of)?\W{1,3}$", re.IGNORECASE)
CLOCK = re.compile(r"\s*(?:o['’]?clock|am\b|pm\b|utc\b|gmt\b|zulu\b|local\b|ago\b)", re.IGNORECASE)
MOMENT = re.compile(r"(?:an? (?:\w+ )?)?(?:second|minute|moment|day)", re.IGNORECASE)
"""Words that are no time to be kept: "a second", "a good day"."""
NO = re.compile(r"\W*\bno\b\W*", re.IGNORECASE)
"""Stands between a value and its correction: "45 minutes, no, ten minutes"."""
ROW = 3
CORRECTED = 30
"""Characters between a value and its correction."""
FULL = 360.0
REPEATED = 16
"""Characters behind a count in which the word for what is repeated stands."""


def said_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """One per limit, row, position and repeat that the plan lacks, and per contradiction."""
    if not document["tasks"]:
        return
    command = read_input({"prompt": frame_of(document).spoken}, vocabulary)
    text = without_geographic(command.facts.text)
    clauses, spoken = read_clauses(text, vocabulary), language(vocabulary)
    plan, pairs = _Plan(document, command), _pairs(text)
    if not command.facts.unread:
        yield from _lost_measures(text, clauses, spoken, plan)
    rows = [row for row in _rows(text, pairs) if len(row) >= ROW]
    yield from _lost_rows(text, rows, clauses, spoken, plan)
    in_rows = {place for row in rows for place in row}
    for place in pairs:
        wanted = _is_wanted(clauses, place.start)
        if wanted and place not in in_rows and not plan.has(place):
            yield _lost(text[place.start : place.end])
    for clause in clauses:
        if not any(clause.start <= row[0].start < clause.end for row in rows):
            yield from _lost_limit(clause, text, pairs, spoken, plan)
    yield from _lost_repeats(text, clauses, pairs, spoken, plan)
    yield from _there_and_not(clauses, pairs)
    yield from _misnamed(document, text, vocabulary)


class _Plan:
    """The values of a plan: of tasks with their skills, of limits, and places in texts."""

    def __init__(self, document: Mapping[str, Any], command: Input) -> None:
        tasks, limits = document["tasks"], document.get("limits", ())
        steps = [step for task in tasks for step in task.get("skill_sequence") or ()]
        skills = [skill for step in steps for _role, skill in step_skills(step)]
        given = [owner["parameters"] for owner in (*tasks, *skills)]
        own = [value for values in given for value in values.values()]
        gone = [(values["x"], values["y"]) for values in given if {"x", "y"} <= values.keys()]
        self.limits = [value for limit in limits for value in limit["values"].values()]
        # Coordinates are places, not numbers: 40 east of one and 40 north of another say no place.
        self.numbers = [
            float(value)
            for values in given
            for name, value in values.items()
            if is_number(value) and not (name in ("x", "y") and {"x", "y"} <= values.keys())
        ]
        self.limited = [float(value) for value in self.limits if is_number(value)]
        self.polygons = [value for value in (*own, *self.limits) if _is_polygon(value)]
        places = [tuple(value) for value in own if is_place(value)]
        self.often = [
            *(gone or places),
            *((task["title"], str(task["parameters"])) for task in tasks),
        ]
        texts = [*document.get("constraints", ()), *document.get("assumptions", ())]
        texts += [task["task_prompt"] for task in tasks]
        read = [(place.x, place.y) for line in texts for place in read_positions(line)]
        corners = [tuple(corner) for polygon in self.polygons for corner in polygon]
        self.places = [*places, *gone, *read, *corners, *filter(is_place, self.limits)]
        spoken = [number for line in texts for number in read_numbers(line)]
        self.anywhere = {*_flat(own), *(part for one in spoken for part in (one.value, one.said))}
        self.anywhere |= set(_ways([*places, *read], command))
        self.timed = any(limit["kind"] in ("return", "duration") for limit in limits)

    def says(self, value: float) -> bool:
        """Whether a number is anywhere in the plan, or a way that it goes, up to its sign."""
        return any(near(abs(value), abs(number)) for number in self.anywhere)

    def has(self, place: Position) -> bool:
        """Whether a position is anywhere in the plan, or its numbers are values of it."""
        if any(_same(place, other) for other in self.places):
            return True
        return all(any(near(part, one) for one in self.numbers) for part in (place.x, place.y))

    def encloses(self, row: Sequence[Position]) -> bool:
        """Whether the positions of a row are the corners of one polygon."""
        return any(
            all(any(_same(place, corner) for corner in polygon) for place in row)
            for polygon in self.polygons
        )

    def repeats(self, count: float, places: Sequence[Position]) -> bool:
        """Whether something is done so often: an arc, each place, else any place or task."""
        if any(near(abs(value), FULL * count) for value in self.numbers):
            return True
        if places:
            points = [item for item in self.often if is_number(item[0])]
            return all(sum(_same(at, one) for one in points) >= count for at in places)
        return any(self.often.count(item) >= count for item in set(self.often))


def _flat(value: Any) -> Iterator[float]:
    if is_number(value):
        yield float(value)
    elif isinstance(value, list):
        for item in value:
            yield from _flat(item)


def _ways(places: Sequence[Sequence[float]], command: Input) -> Iterator[float]:
    """The lengths by which places of a plan lie a stated way off stated ones."""
    ground = command.ground
    for (x, y), base in itertools.product(set(map(tuple, places)), ground.places if ground else ()):
        away = x - base[0], y - base[1]
        if ground and any(away) and (ground.is_way_off((x, y), base) or away in ground.places):
            yield from (*away, math.hypot(*away))


def _pairs(text: str) -> list[Position]:
    """Positions that are written as such: certain ones, and "40,25"; none overlaps another."""
    numbers = {number.end: number for number in read_numbers(text) if number.unit}
    chosen = list[Position]()
    options = [
        place
        for place in read_positions(text)
        if place.certain
        or (PAIR.fullmatch(text, place.start, place.end) and place.end not in numbers)
    ]
    tight = sorted(options, key=lambda place: (not place.certain, place.end - place.start))
    for place in tight:
        if all(place.end <= one.start or one.end <= place.start for one in chosen):
            chosen.append(place)
    return sorted(chosen, key=lambda place: place.start)


def _rows(text: str, pairs: Sequence[Position]) -> Iterator[list[Position]]:
    row = list[Position]()
    for place in pairs:
        if row and not BESIDE.fullmatch(text, row[-1].end, place.start):
            yield row
            row = []
        row.append(place)
    if row:
        yield row


def _lost(words: str) -> Warning:
    said = f'The command says "{words}", and no task has it.'
    return warning("value-lost", said, about=words.casefold())


def _lost_measures(
    text: str, clauses: Sequence[Clause], spoken: Language, plan: _Plan
) -> Iterator[Warning]:
    """Measures and courses, but for those that are ruled out, taken back or only told of."""
    numbers = read_numbers(text)
    for number, following in itertools.zip_longest(numbers, numbers[1:]):
        if not _is_measure(text, number) or not _is_wanted(clauses, number.start):
            continue
        between = text[number.end : following.start] if following else ""
        replaced = spoken.words["correction"].search(between) or NO.fullmatch(between)
        if replaced and len(between) <= CORRECTED:
            continue
        wholes = [*neighbours(numbers, number.unit), number]
        wholes = [one for one in wholes if one.start <= number.start and number.end <= one.end]
        if not any(plan.says(one.value) for one in wholes):
            yield _lost(text[wholes[0].start : wholes[0].end])


def _is_measure(text: str, number: Number) -> bool:
    """Whether a number is a measure or a course. Counts, ids, parts and times of day are none."""
    moment = MOMENT.fullmatch(text, number.start, number.end)
    if moment or number.unit == "%" or CLOCK.match(text, number.end):
        return False
    course = COURSE.search(text, max(0, number.start - 20), number.start)
    return number.unit is not None or course is not None


def _is_wanted(clauses: Sequence[Clause], place: int) -> bool:
    """Whether words at a place are neither ruled out nor taken back."""
    clause = _clause_at(clauses, place)
    return clause is None or (clause.wants(place) and not clause.corrected)


def _lost_rows(
    text: str,
    rows: Sequence[list[Position]],
    clauses: Sequence[Clause],
    spoken: Language,
    plan: _Plan,
) -> Iterator[Warning]:
    """Rows of positions that are neither the corners of an area nor a route."""
    for row in rows:
        clause = _clause_at(clauses, row[0].start)
        limiting = clause is not None and spoken.words["limit"].search(clause.text)
        visited = all(plan.has(place) for place in row)
        if plan.encloses(row) or (visited and not limiting):
            continue
        words = text[row[0].start : row[-1].end]
        missing = "no limit of the plan has that area" if limiting else "the plan has not all of it"
        said = f'The command says "{quoted(words)}", and {missing}.'
        yield warning("limit-lost" if limiting else "value-lost", said, about=words.casefold())


def _lost_limit(
    clause: Clause, text: str, pairs: Sequence[Position], spoken: Language, plan: _Plan
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
    if not measures and spoken.words["away"].search(clause.text):
        limited = [(value[0], value[1]) for value in plan.limits if is_place(value)]
        kept = all(any(_same(place, at) for at in limited) for place in inside)
    if spoken.words["by_time"].search(clause.text) and re.search(r"\d", clause.text):
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
    text: str, clauses: Sequence[Clause], pairs: Sequence[Position], spoken: Language, plan: _Plan
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
        clause = _clause_at(clauses, start)
        if not clause or not _is_wanted(clauses, start):
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
        clause = _clause_at(clauses, place.start)
        others = [
            (_clause_at(clauses, one.start), one)
            for one in pairs
            if one is not place and _same(place, (one.x, one.y))
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
            there = {name for name, at in said if _same(at, (place.x, place.y))}
            if there and words.casefold() in names - there:
                where = f"[{place.x:g}, {place.y:g}]"
                text = f"{named(task)} speaks of {words} at {where}, and the command has"
                yield warning("contradiction", f"{text} {min(there)} there.", task)


def _clause_at(clauses: Sequence[Clause], place: int) -> Clause | None:
    return next((one for one in clauses if one.start <= place < one.end), None)


def _same(place: Position, other: Sequence[float]) -> bool:
    return near(place.x, other[0]) and near(place.y, other[1])


def _is_polygon(value: Any) -> bool:
    return isinstance(value, list) and len(value) >= ROW and all(map(is_place, value))
