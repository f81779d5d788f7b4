"""Measures, courses and coordinates that a command states and that stand nowhere in its plan."""

from __future__ import annotations

import bisect
import itertools
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from planner_ft.document.language import Clause, language, read_clauses
from planner_ft.facts import Number, Position, is_number, is_place, near, read_input
from planner_ft.facts.numbers import neighbours, read_numbers
from planner_ft.facts.places import read_positions, without_geographic
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import step_skills

COURSE = re.compile(r"\b(?:heading|bearing|course)(?: of)?\W{1,3}$", re.IGNORECASE)
CLOCK = re.compile(r"\s*(?:o['’]?clock|am\b|pm\b|utc\b|gmt\b|zulu\b|local\b|ago\b)", re.IGNORECASE)
MOMENT = re.compile(r"(?:an? (?:\w+ )?)?(?:second|minute|moment|day)", re.IGNORECASE)
"""Words that are no time to be kept: "a second", "a good day"."""
NO = re.compile(r"\W*\bno\b\W*", re.IGNORECASE)
"""Stands between a value and its correction: "45 minutes, no, ten minutes"."""

Place = tuple[float, float]


def unused_facts(
    command: str, tasks: Sequence[Mapping[str, Any]], texts: Iterable[str], vocabulary: Vocabulary
) -> Iterator[str]:
    """The words for each value that neither `tasks`, their skills nor `texts` have or imply.

    Values that the command rules out, takes back or only tells of are not missing.
    """
    plan = _Plan()
    plan.add_tasks(tasks)
    plan.add_texts(texts)
    plan.add_ways(command, vocabulary)
    clauses = read_clauses(command, vocabulary)
    correction = language(vocabulary).words["correction"]
    text = without_geographic(command)
    numbers = read_numbers(text)
    found: dict[str, None] = {}
    for number, following in itertools.zip_longest(numbers, numbers[1:]):
        if not _is_measure(text, number) or not _is_wanted(clauses, number.start):
            continue
        if following and _replaced(text[number.end : following.start], correction):
            continue
        start, end, totals = number.start, number.end, neighbours(numbers, number.unit)
        sums = [total for total in totals if total.start <= start and end <= total.end]
        if not any(plan.has(one.value) for one in (number, *sums)):
            whole = (*sums, number)[0]
            found[text[whole.start : whole.end]] = None
    yield from found
    yield from _unused_places(text, plan, clauses, correction)


@dataclass
class _Plan:
    """Numbers and places of a plan: `apart` are no coordinates, `used` places imply others."""

    numbers: set[float] = field(default_factory=set)
    apart: set[float] = field(default_factory=set)
    places: dict[Place, None] = field(default_factory=dict)
    used: set[Place] = field(default_factory=set)

    def add_tasks(self, tasks: Sequence[Mapping[str, Any]]) -> None:
        """The values of tasks with their skills."""
        steps = [step for task in tasks for step in task.get("skill_sequence") or ()]
        skills = [skill for step in steps for _role, skill in step_skills(step)]
        values = [value for owner in (*tasks, *skills) for value in owner["parameters"].values()]
        self.apart |= {float(value) for value in values if is_number(value)}
        self.numbers |= {float(number) for value in values for number in _flat(value)}
        self.places |= {(value[0], value[1]): None for value in values if is_place(value)}

    def add_texts(self, texts: Iterable[str]) -> None:
        """What prompts, assumptions and constraints say."""
        for text in texts:
            for number in read_numbers(text):
                self.apart |= {number.value, number.said}
            self.places |= {(place.x, place.y): None for place in read_positions(text)}
        self.numbers |= self.apart

    def add_ways(self, command: str, vocabulary: Vocabulary) -> None:
        """The lengths by which places of the plan lie off stated ones, and those."""
        ground = read_input({"prompt": command}, vocabulary).ground
        for place, base in itertools.product(self.places, ground.places if ground else ()):
            away = place[0] - base[0], place[1] - base[1]
            if any(away) and ground and (ground.is_way_off(place, base) or away in ground.places):
                self.used.add(base)
                self.numbers |= {abs(away[0]), abs(away[1]), (away[0] ** 2 + away[1] ** 2) ** 0.5}

    def has(self, value: float, *, apart: bool = False) -> bool:
        """Whether a number is in the plan, up to rounding and sign; `apart`: as no coordinate."""
        numbers = self.apart if apart else self.numbers
        return any(near(abs(value), abs(number)) for number in numbers)

    def has_place(self, place: Position, *, mirrored: bool = False) -> bool:
        """Whether a place is in the plan; `mirrored`: with other signs, too."""
        size = abs if mirrored else float
        return any(
            near(size(place.x), size(x)) and near(size(place.y), size(y))
            for x, y in (*self.places, *self.used)
        )


def _unused_places(
    text: str, plan: _Plan, clauses: tuple[Clause, ...], correction: re.Pattern[str]
) -> Iterator[str]:
    """The words of what certainly are coordinates and stand nowhere in the plan."""
    grouped = itertools.groupby(read_positions(text), key=lambda place: (place.start, place.end))
    for (start, end), readings in grouped:
        options = list(readings)
        if not options[0].certain or not _is_wanted(clauses, start):
            continue
        behind = text[end : end + 40]
        following = read_numbers(behind)
        replaced = following and correction.search(behind, 0, following[0].start)
        if replaced or any(plan.has_place(place) for place in options):
            continue
        # In brackets it is a place as a whole, whatever its signs; else its numbers may stand
        # apart.
        first, words = options[0], text[start:end]
        written = text[start - 1 : start] in ("[", "(") and text[end : end + 1] in ("]", ")")
        as_numbers = all(plan.has(part, apart=written) for part in (first.x, first.y))
        if not as_numbers and not (written and plan.has_place(first, mirrored=True)):
            yield words


def _flat(value: Any) -> Iterator[float]:
    if is_number(value):
        yield value
    elif isinstance(value, list):
        for item in value:
            yield from _flat(item)


def _is_wanted(clauses: tuple[Clause, ...], place: int) -> bool:
    """Whether words at a place are neither ruled out nor taken back."""
    index = bisect.bisect_right(clauses, place, key=lambda clause: clause.start) - 1
    if index < 0:
        return True
    clause = clauses[index]
    return not clause.corrected and (clause.excluded is None or place < clause.excluded)


def _replaced(between: str, correction: re.Pattern[str]) -> bool:
    """Whether the words between two values say that the second takes the place of the first."""
    return len(between) <= 30 and bool(correction.search(between) or NO.fullmatch(between))


def _is_measure(text: str, number: Number) -> bool:
    """Whether a number is a measure or a course. Counts, ids, parts and times of day are none."""
    moment = MOMENT.fullmatch(text, number.start, number.end)
    if moment or number.unit == "%" or CLOCK.match(text, number.end):
        return False
    course = COURSE.search(text, max(0, number.start - 20), number.start)
    return number.unit is not None or course is not None
