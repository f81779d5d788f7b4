"""What the command says and the plan has not: limits, rows of positions, repeats; contradictions.

Facts of the text are compared with values of the plan; which words limit or repeat is data
(planner_ft/document/english.toml).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from planner_ft.document.language import Clause, Language, language, read_clauses
from planner_ft.document.track import place_of
from planner_ft.document.warnings.warning import Warning, quoted, warning
from planner_ft.facts import Number, Position, is_number, is_place, near
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.places import read_positions, without_geographic
from planner_ft.planning.frame import frame_of
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import step_skills

PAIR = re.compile(r"[-−–]?\d+(?:\.\d+)?\s?,\s?[-−–]?\d+(?:\.\d+)?")
BESIDE = re.compile(r"[\s,;\])\[(]*(?:and|to|then)?[\s,;\])\[(]*")
"""What stands between the positions of a row."""
ROW = 3
STEM = 5
"""First letters by which a word is found again."""
FULL = 360.0
REPEATED = 16
"""Characters behind a count in which the word for what is repeated stands."""


def said_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """One per limit, row, position and repeat that the plan lacks, and per contradiction."""
    if not document["tasks"]:
        return
    text = without_geographic(frame_of(document).spoken)
    clauses, spoken = read_clauses(text, vocabulary), language(vocabulary)
    plan, pairs = _Plan(document), _pairs(text)
    rows = [row for row in _rows(text, pairs) if len(row) >= ROW]
    yield from _lost_rows(text, rows, clauses, spoken, plan)
    in_rows = {place for row in rows for place in row}
    for place in pairs:
        clause = _clause_at(clauses, place.start)
        wanted = clause is None or (clause.wants(place.start) and not clause.corrected)
        if wanted and place not in in_rows and not plan.has(place):
            words = text[place.start : place.end]
            said = f'The command says "{words}", and no task has it.'
            yield warning("value-lost", said, about=words.casefold())
    for clause in clauses:
        if not any(clause.start <= row[0].start < clause.end for row in rows):
            yield from _lost_limit(clause, text, pairs, spoken, plan)
    instructions = [clause for clause in clauses if _instructs(clause, spoken)]
    if len(instructions) > _own_tasks(document["tasks"], vocabulary):
        for clause in instructions:
            yield from _lost_instruction(clause, spoken, plan)
    yield from _lost_repeats(text, clauses, pairs, spoken, plan)
    yield from _there_and_not(clauses, pairs)
    yield from _home_and_not(clauses, spoken, document, vocabulary)


class _Plan:
    """The values of a plan: of tasks with their skills, of limits, and places in texts."""

    def __init__(self, document: Mapping[str, Any]) -> None:
        tasks, limits = document["tasks"], document.get("limits", ())
        steps = [step for task in tasks for step in task.get("skill_sequence") or ()]
        skills = [skill for step in steps for _role, skill in step_skills(step)]
        own = [value for owner in (*tasks, *skills) for value in owner["parameters"].values()]
        self.limits = [value for limit in limits for value in limit["values"].values()]
        # Coordinates are places, not numbers: 40 east of one and 40 north of another say no place.
        named = [
            item
            for owner in (*tasks, *skills)
            for item in owner["parameters"].items()
            if not ({"x", "y"} <= owner["parameters"].keys() and item[0] in ("x", "y"))
        ]
        self.numbers = [float(value) for _name, value in named if is_number(value)]
        self.limited = [float(value) for value in self.limits if is_number(value)]
        self.polygons = [value for value in (*own, *self.limits) if _is_polygon(value)]
        self.visited = [tuple(value) for value in own if is_place(value)]
        gone = [
            (values["x"], values["y"])
            for values in (skill["parameters"] for skill in skills)
            if {"x", "y"} <= values.keys()
        ]
        self.often: list[Any] = [*(gone or self.visited)]
        self.often += [(task["title"], str(task["parameters"])) for task in tasks]
        self.visited += gone
        texts = [*document.get("constraints", ()), *document.get("assumptions", ())]
        texts += [task["task_prompt"] for task in tasks]
        read = [place for line in texts for place in read_positions(line)]
        self.written = [(place.x, place.y) for place in read]
        self.timed = any(limit["kind"] in ("return", "duration") for limit in limits)
        own_texts = [value for value in own if isinstance(value, str)]
        lists = [item for value in own if isinstance(value, list) for item in value]
        self.text = " ".join([*texts, *own_texts, *map(str, lists)]).casefold()

    def has(self, place: Position) -> bool:
        """Whether a position is anywhere in the plan, or its numbers are values of it."""
        corners = [corner for polygon in self.polygons for corner in polygon]
        known = [*self.visited, *corners, *self.written, *filter(is_place, self.limits)]
        if any(_same(place, (other[0], other[1])) for other in known):
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
        if not clause or clause.corrected or not clause.wants(start):
            continue
        places = [place for place in pairs if clause.start <= place.start < clause.end]
        if not plan.repeats(count, places):
            words = text[start:end]
            said = f'The command says "{words}", and the plan does nothing so often.'
            yield warning("repeat-lost", said, about=words.casefold())


def _is_count(number: Number, text: str, until: int) -> bool:
    between = text[number.end : until].split()
    return number.value >= 2 and number.value.is_integer() and len(between) <= 1


def _instructs(clause: Clause, spoken: Language) -> bool:
    """Whether a clause begins with an instruction that stands, other than to come home."""
    begins = spoken.words["verb"].match(clause.text.strip())
    stands = begins is not None and not clause.corrected and clause.excluded is None
    return stands and not spoken.words["home"].search(clause.text)


def _own_tasks(tasks: Sequence[Mapping[str, Any]], vocabulary: Vocabulary) -> int:
    """The tasks that such an instruction stands for: not those that look for a place, go to one for
    the task behind them, or go home.
    """
    behind = [vocabulary.task[task["title"]].arrival for task in tasks[1:]] + ["none"]
    return sum(
        task["title"] != vocabulary.locate
        and place_of(task, vocabulary) != vocabulary.home
        and not (task["title"] == vocabulary.transit and arrival == "transit")
        for task, arrival in zip(tasks, behind, strict=True)
    )


def _lost_instruction(clause: Clause, spoken: Language, plan: _Plan) -> Iterator[Warning]:
    """An instruction of which no word and no fact is in the plan."""
    text = clause.text.strip()
    verb = spoken.words["verb"].match(text)
    known = [
        spoken.words["impossible"],
        spoken.words["home"],
        spoken.words["here"],
        spoken.sensors,
        spoken.words["stay"],
    ]
    known += [ask.said for ask in spoken.asks]
    if not verb or read_numbers(text):
        return
    if any(words.search(text) for words in known):
        return
    said_words = re.findall(r"[a-z]{4,}", text[verb.end() :].casefold())
    empty = [spoken.words[name] for name in ("nothing", "water", "boundary", "determiner")]
    named = [word for word in said_words if not any(one.fullmatch(word) for one in empty)]
    if named and not any(word[:STEM] in plan.text for word in said_words):
        said = f'The command asks: "{quoted(text)}"; no task of the plan does that.'
        yield warning("not-planned", said, about=text.casefold())


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


def _home_and_not(
    clauses: Sequence[Clause], spoken: Language, document: Mapping[str, Any], vocabulary: Vocabulary
) -> Iterator[Warning]:
    """A command that asks for home and rules it out, and a plan that ends there."""
    said = [
        (clause.wants(clause.start + match.start()), clause)
        for clause in clauses
        if not clause.corrected
        for match in spoken.words["home"].finditer(clause.text)
    ]
    last = document["tasks"][-1]
    if {wanted for wanted, _clause in said} == {True, False}:
        words = next(clause.text for wanted, clause in said if not wanted).strip(" ,;")
        ends = (
            "ends there" if place_of(last, vocabulary) == vocabulary.home else "does not end there"
        )
        text = f'The command speaks of coming home, and says "{quoted(words)}"; the plan {ends}.'
        yield warning("contradiction", text, about="home")


def _clause_at(clauses: Sequence[Clause], place: int) -> Clause | None:
    return next((one for one in clauses if one.start <= place < one.end), None)


def _same(place: Position, other: Sequence[float]) -> bool:
    return near(place.x, other[0]) and near(place.y, other[1])


def _is_polygon(value: Any) -> bool:
    return isinstance(value, list) and len(value) >= ROW and all(map(is_place, value))
