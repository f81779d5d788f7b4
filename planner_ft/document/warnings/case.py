"""The kinds of warnings (kinds.toml): how grave each is, its name, its sentences; and a plan with
its command, read once for all checks.
"""

from __future__ import annotations

import bisect
import functools
import itertools
import math
import re
from collections.abc import Callable, Container, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, Literal

from planner_ft.document.language import Clause, language, read_clauses
from planner_ft.document.structures import ROUND, said_off
from planner_ft.document.track import Point, Track, bearing, place_of
from planner_ft.facts import Input, Number, Position, is_number, is_place, near, read_input
from planner_ft.facts.geographic import without_geographic
from planner_ft.facts.geometry import corners_of
from planner_ft.facts.inputs import SIDES
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.places import read_positions, rows_of, rows_of_sizes, written_positions
from planner_ft.facts.units import in_base_units
from planner_ft.planning.frame import frame_of
from planner_ft.support.files import read_toml
from planner_ft.vocabulary import Entry, Vocabulary
from planner_ft.vocabulary.essentials import essentials_of
from planner_ft.vocabulary.plans import step_skills

Severity = Literal["danger", "caution", "note"]
SEVERITIES: tuple[Severity, ...] = ("danger", "caution", "note")  # the gravest first
Warning = dict[str, Any]
"""{"id", "kind", "task", "parameter", "text"}; edits elsewhere leave the id as it is."""
TABLE: dict[str, dict[str, Any]] = read_toml(Path(__file__).with_name("kinds.toml"))
KINDS = tuple(TABLE)  # in the order in which a plan has them
NOTES = tuple(kind for kind, entry in TABLE.items() if entry["severity"] == "note")
SERIOUS = tuple(kind for kind in KINDS if kind not in NOTES)
"""Kinds that a plan should not be approved with unread."""
LONGEST = 120  # characters of the command that are quoted
ROW, CORNERS = 3, 3
FULL = 360.0
STEM = 5
LONGER = re.compile(r"[a-z]{4,}", re.IGNORECASE)
"""Words that say something, and the letters by which one is found again."""


def meaning(kind: str) -> tuple[Severity, str]:
    """Severity and name of a kind; one that is not known, as of another version, is a caution."""
    entry = TABLE.get(kind)
    named = kind.replace("-", " ").capitalize()
    return (entry["severity"], entry["name"]) if entry else ("caution", named)


def gravest_first(warnings: Iterable[Entry]) -> list[Entry]:
    """Dangers, then cautions, then notes, each in the order that they have."""
    return sorted(warnings, key=lambda one: SEVERITIES.index(meaning(one["kind"])[0]))


def warning(
    kind: str,
    sentence: str = "",
    task: Entry | None = None,
    parameter: str | None = None,
    about: str = "",
    **values: Any,
) -> Warning:
    """A warning about a task, a parameter or the plan, in a sentence of its kind that is filled
    with `values`; `about` tells several of a kind apart.
    """
    entry, name = TABLE[kind], task["id"] if task else None
    written = entry["texts"][sentence] if sentence else entry["text"]
    text = written.format(task=named(task) if task else "", **values)
    return {
        "id": ":".join(part for part in (kind, name, parameter, about) if part),
        "kind": kind,
        "task": name,
        "parameter": parameter,
        "text": text[:1].upper() + text[1:],
    }


def quoted(words: str) -> str:
    """Words of the command on one line, not too many."""
    text = " ".join(words.split())
    return text if len(text) <= LONGEST else f"{text[:LONGEST].rsplit(' ', 1)[0]} ..."


def named(task: Entry) -> str:
    """A task as sentences name it, by its `number` in the plan."""
    return f"task {task['number']}, {task['title']}"


def lost(words: str, clause: str = "") -> Warning:
    """A value of the command that the plan has not, shown with the clause that it stands in."""
    told, about = quoted(clause.strip(" ,;.:!?")), words.casefold()
    if told.casefold() == about or words not in told:
        return warning("value-lost", "value", about=about, words=words)
    return warning("value-lost", "within", about=about, words=words, clause=told)


class Case:
    """A revised plan document, its track, and what its command says.

    `source` are the facts of the command in local metres, `text` is that without geographic
    positions; `command` is as it was typed, with the clauses `typed`. Places, numbers and clauses
    are those of `text`; `rows` have at least ROW positions. Tasks have their `number` from 1.
    """

    def __init__(self, document: Entry, path: Track, vocabulary: Vocabulary) -> None:
        self.document, self.path, self.vocabulary = document, path, vocabulary
        self.tasks = [{**one, "number": at} for at, one in enumerate(document["tasks"], start=1)]
        self.by_id = {task["id"]: task for task in self.tasks}
        self.command: str = document["command"]
        self.limits: list[dict[str, Any]] = document.get("limits", [])
        self.vehicle: dict[str, Any] = document.get("vehicle") or {}
        self.spoken = language(vocabulary)
        self.words = self.spoken.words
        self.source = read_input({"prompt": frame_of(document).spoken}, vocabulary)
        self.text = without_geographic(self.source.facts.text)
        self.clauses, self.typed = (
            read_clauses(one, vocabulary) for one in (self.text, self.command)
        )
        self.numbers, self.positions = read_numbers(self.text), written_positions(self.text)
        self.rows = [row for row in rows_of(self.text, self.positions) if len(row) >= ROW]

    @functools.cached_property
    def plan(self) -> PlanValues:
        return PlanValues(self.document, self.source, self.positions)

    @property
    def texts(self) -> list[str]:
        """Constraints and assumptions of the plan."""
        return [*self.document.get("constraints", ()), *self.document.get("assumptions", ())]

    def is_coordinate(self, number: Number) -> bool:
        """Whether a number of the text is half of what is a place of the plan."""
        pairs = (one for one in read_positions(self.text) if one.start <= number.start < one.end)
        return any(same_place(one, at) for one in pairs for at in self.plan.places)

    def clause_at(self, place: int) -> Clause | None:
        """The clause in which a place of the text is."""
        at = bisect.bisect(self.clauses, place, key=lambda one: one.start) - 1
        return self.clauses[at] if at >= 0 and place < self.clauses[at].end else None

    def lost(self, start: int, end: int) -> Warning:
        """Words of the text as a value that the plan has not."""
        clause = self.clause_at(start)
        return lost(self.text[start:end], clause.text if clause else "")

    def wants(self, place: int) -> bool:
        """Whether words at a place of the text are neither ruled out nor taken back."""
        clause = self.clause_at(place)
        if clause is None or clause.corrected:
            return clause is None
        return clause.wants(place) or (clause.resumed is not None and place >= clause.resumed)


def skills_of(task: Entry) -> Iterator[tuple[str, dict[str, Any]]]:
    """(role, skill) of all steps of a task."""
    return (pair for step in task.get("skill_sequence") or () for pair in step_skills(step))


Check = Callable[[Case], Iterator[Warning]]


def _own_values(task: Entry, vocabulary: Vocabulary) -> Iterator[dict[str, Any]]:
    """The values of a task's skills, but for those that the vehicle takes where none is stated."""
    known = essentials_of(task["title"], vocabulary).skills
    for _role, skill in skills_of(task):
        taken, given = known.get(skill["name"], {}), skill["parameters"].items()
        yield {name: value for name, value in given if taken.get(name) != value}


class PlanValues:
    """The values of a plan: of tasks with their skills, of limits, and places in texts. `gone` are
    its waypoints in order, `meant` the places that tasks and limits have, each as `spot`s.
    Coordinates of positions that the command says (`said`) are no numbers.
    """

    def __init__(self, document: Entry, command: Input, said: Sequence[Position]) -> None:
        tasks, limits = document["tasks"], document.get("limits", ())
        skills = [skill for task in tasks for _role, skill in skills_of(task)]
        given = [task["parameters"] for task in tasks]
        given += [own for task in tasks for own in _own_values(task, command.vocabulary)]
        own = [value for values in given for value in values.values()]
        gone = [(values["x"], values["y"]) for values in given if {"x", "y"} <= values.keys()]
        self.gone = gone
        self.limits = [value for limit in limits for value in limit["values"].values()]
        # Coordinates are places, not numbers: 40 east of one and 40 north of another say no place.
        self.numbers = [
            float(value)
            for values in given
            for name, value in values.items()
            if is_number(value) and not (name in ("x", "y") and {"x", "y"} <= values.keys())
        ]
        self.owners = [list(filter(is_number, task["parameters"].values())) for task in tasks]
        by_name = [command.vocabulary.task[task["title"]].by_name for task in tasks]
        by_name += [command.vocabulary.skill[skill["name"]].by_name for skill in skills]
        base = [one for pair in zip(given, by_name, strict=True) for one in in_base_units(*pair)]
        self.numbers += base
        self.limited = [float(value) for value in self.limits if is_number(value)]
        self.polygons = [value for value in (*own, *self.limits) if _is_polygon(value)]
        places = [tuple(value) for value in own if is_place(value)]
        # The same task at other places is not done again.
        where, last = list[Any](), None
        for task in tasks:
            last = place_of(task, command.vocabulary) or last
            where.append((task["title"], str(task["parameters"]), last))
            # "Once at 30 m, a second lap at 20 m."
            if command.vocabulary.task[task["title"]].pattern in ROUND:
                where.append((task["title"], "", last))
        self.often = [*(gone or places), *where]
        texts = [*document.get("constraints", ()), *document.get("assumptions", ())]
        texts += [task["task_prompt"] for task in tasks]
        read = [(place.x, place.y) for line in texts for place in read_positions(line)]
        corners = [tuple(corner) for polygon in self.polygons for corner in polygon]
        # A command that gives an area by its corners says these.
        corners += [corner for task in tasks for corner in area_corners(task["parameters"])]
        self.places = [*places, *gone, *read, *corners, *filter(is_place, self.limits)]
        prompted = [place for task in tasks for place in read_positions(task["task_prompt"])]
        meant = [*places, *corners, *filter(is_place, self.limits)]
        self.meant = {*map(spot, meant), *(spot((one.x, one.y)) for one in prompted)}
        stated = {spot((one.x, one.y)) for one in said}
        self.sizes = [[one.value for one in row] for line in texts for row in rows_of_sizes(line)]
        self.anywhere = {*self.numbers, *self.limited}
        self.anywhere |= {metres for _at, metres in said_off(document, command.vocabulary)}
        self.anywhere |= {part for line in texts for part in _spoken(line, stated)}
        derived = (at for at in (*places, *gone, *corners) if spot(at) not in stated)
        self.anywhere |= {part for at in derived for part in at}
        self.anywhere |= set(_ways([*places, *read], command))
        if any(command.vocabulary.task[task["title"]].pattern == "sectors" for task in tasks):
            self.anywhere.add(FULL)
        self.texts = " ".join(texts).casefold()
        self.words = " ".join([self.texts, *map(str, own)]).casefold()
        self.timed = any(limit["kind"] in ("return", "duration") for limit in limits)

    def says(self, value: float) -> bool:
        """Whether a number is anywhere in the plan, or a way that it goes, up to its sign."""
        return any(near(abs(value), abs(number)) for number in self.anywhere)

    def missing_sizes(self, row: Sequence[Number]) -> list[Number]:
        """The sizes of a row that the task with most of them lacks; none where no task has any, or
        a text has them together.
        """
        wanted = [one.value for one in row]
        alike = [sorted(sizes) for sizes in self.sizes if len(sizes) == len(wanted)]
        together = (all(map(near, sorted(wanted), sizes)) for sizes in alike)
        rests = []
        for owner in () if any(together) else self.owners:
            left, rest = list(owner), list[Number]()
            for one in row:
                held = next((value for value in left if near(value, one.value)), None)
                if held is None:
                    rest.append(one)
                else:
                    left.remove(held)
            rests.append(rest)
        fewest = min(rests, key=len, default=[])
        return fewest if len(fewest) < len(row) else []

    def speaks_of(self, words: str) -> bool:
        """Whether a text of the plan has one of the longer words."""
        return any(word[:STEM] in self.texts for word in LONGER.findall(words.casefold()))

    def has(self, place: Position) -> bool:
        """Whether a position is anywhere in the plan, or its numbers are values of it."""
        if any(same_place(place, other) for other in self.places):
            return True
        return all(any(near(part, one) for one in self.numbers) for part in (place.x, place.y))

    def encloses(self, row: Sequence[Position]) -> bool:
        """Whether the positions of a row are the corners of one polygon."""
        return any(
            all(any(same_place(place, corner) for corner in polygon) for place in row)
            for polygon in self.polygons
        )

    def repeats(self, count: float, places: Sequence[Position], row: Sequence[Position]) -> bool:
        """Whether something is done just so often: an arc, each place, else any place or task, and
        all of a row of which the plan goes to one again. A round begins where it began, so the
        first of a row is not gone to less often than the last.
        """
        if any(near(abs(value), FULL * count) for value in self.numbers):
            return True
        points = [item for item in self.often if is_number(item[0])]
        visits = [sum(same_place(at, one) for one in points) for at in row or places]
        if row and (places or max(visits) > 1):
            return min(visits) == count and visits[0] >= visits[-1]
        if places:
            return min(visits) == count
        return any(self.often.count(item) == count for item in set(self.often))


def spot(place: Sequence[float]) -> tuple[float, ...]:
    """A place to a decimetre."""
    return tuple(round(part, 1) for part in place)


def _spoken(line: str, stated: Container[tuple[float, ...]]) -> Iterator[float]:
    """The numbers of a text, as they are said and in their units, but for those of positions that
    the command has `stated`.
    """
    known = [one for one in written_positions(line) if spot((one.x, one.y)) in stated]
    for number in read_numbers(line):
        if not any(one.start <= number.start < one.end for one in known):
            yield from (number.value, number.said)


def area_corners(values: Entry) -> list[tuple[float, float]]:
    """The corners of the area of a task that has sides and a middle."""
    middle = next(filter(is_place, values.values()), None)
    sides = [float(values[name]) for name in SIDES if is_number(values.get(name))]
    return [] if middle is None or len(sides) < len(SIDES) else corners_of(middle, *sides)


def _ways(places: Sequence[Sequence[float]], command: Input) -> Iterator[float]:
    """The lengths by which places of a plan lie a stated way off stated ones."""
    ground = command.plain_ground
    for (x, y), base in itertools.product(set(map(tuple, places)), ground.places if ground else ()):
        away = x - base[0], y - base[1]
        # The way from home to a stated place is that place.
        told = ground and (ground.is_way_off((x, y), base) or (any(base) and away in ground.places))
        if any(away) and told:
            yield from (*away, math.hypot(*away), bearing(base, (x, y)))


def done_at(case: Case) -> dict[Point, set[str]]:
    """The titles of the tasks at each place, but for the ways to it."""
    done, at = dict[Point, set[str]](), None
    for task in case.tasks:
        at = place_of(task, case.vocabulary) or at
        if at is not None:
            own = {task["title"]} - {case.vocabulary.transit, case.vocabulary.locate}
            key = next((one for one in done if all(map(near, one, at))), at)
            done[key] = done.get(key, set()) | own
    return done


def same_place(place: Position, other: Sequence[float]) -> bool:
    """Whether a position of the command is one of the plan."""
    return near(place.x, other[0]) and near(place.y, other[1])


def _is_polygon(value: Any) -> bool:
    return isinstance(value, list) and len(value) >= CORNERS and all(map(is_place, value))
