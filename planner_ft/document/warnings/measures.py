"""Numbers of the command that the plan lacks: measures, courses, values of parameters."""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Iterator, Sequence

from planner_ft.document.language import Clause, Language
from planner_ft.document.warnings.plan_values import PlanValues
from planner_ft.document.warnings.warning import Warning, warning
from planner_ft.facts import Number, Position, near
from planner_ft.facts.numbers import neighbours, read_numbers, rows_of_sizes
from planner_ft.vocabulary import Vocabulary

COURSE = re.compile(r"\b(?:heading|bearing|course)(?: of)?\W{1,3}$", re.IGNORECASE)
CLOCK = re.compile(r"\s*(?:o['’]?clock|am\b|pm\b|utc\b|gmt\b|zulu\b|local\b|ago\b)", re.IGNORECASE)
MOMENT = re.compile(r"(?:an? (?:\w+ )?)?(?:second|minute|moment|day)", re.IGNORECASE)
"""Words that are no time to be kept: "a second", "a good day"."""
SIZES = re.compile(r"\d\s?[x×*]\s?$")
"""Stands before the second and third of "20 x 20 x 5"."""
LONGEST_NAME = 24
"""Characters in which the name of a parameter stands before its value."""
NO = re.compile(r"\W*\bno\b\W*", re.IGNORECASE)
"""Stands between a value and its correction: "45 minutes, no, ten minutes"."""
CORRECTED = 30
"""Characters between a value and its correction."""


def lost(words: str) -> Warning:
    """A value of the command that the plan has not."""
    said = f'The command says "{words}", and no task has it.'
    return warning("value-lost", said, about=words.casefold())


def lost_measures(
    text: str, clauses: Sequence[Clause], spoken: Language, plan: PlanValues
) -> Iterator[Warning]:
    """Measures and courses, but for those that are ruled out, taken back or only told of.

    One that a later clause replaces by a value that the plan has is taken back. Sizes that are said
    together must be values of one task.
    """
    numbers = read_numbers(text)
    instead = _instead(numbers, clauses, spoken, plan)
    apart = {size.start for row in rows_of_sizes(text) for size in plan.missing_sizes(row)}
    for number, following in itertools.zip_longest(numbers, numbers[1:]):
        if not _is_measure(text, number) or not is_wanted(clauses, number.start):
            continue
        between = text[number.end : following.start] if following else ""
        replaced = spoken.words["correction"].search(between) or NO.fullmatch(between)
        if replaced and len(between) <= CORRECTED:
            continue
        wholes = [*neighbours(numbers, number.unit), number]
        wholes = [one for one in wholes if one.start <= number.start and number.end <= one.end]
        if number.start not in apart and any(plan.says(one.value) for one in wholes):
            continue
        other = next((one for one in instead if _replaces(one, number)), None)
        if other is None:
            yield lost(text[wholes[0].start : wholes[0].end])
        else:
            instead.remove(other)


def _instead(
    numbers: Sequence[Number], clauses: Sequence[Clause], spoken: Language, plan: PlanValues
) -> list[Number]:
    """Numbers of clauses that replace something, which are values of the plan."""
    found = []
    for number in numbers:
        clause = clause_at(clauses, number.start)
        if clause and spoken.words["replaced"].search(clause.text):
            values = {number.value, number.value * 60, number.value * 3600}
            known = values if number.unit is None else {number.value}
            if any(near(one, other) for one in known for other in plan.numbers):
                found.append(number)
    return found


def _replaces(later: Number, number: Number) -> bool:
    """Whether a number can stand for an earlier one: of its unit, or without one."""
    return later.start > number.end and later.unit in (None, number.unit)


def lost_bare(
    text: str,
    clauses: Sequence[Clause],
    pairs: Sequence[Position],
    spoken: Language,
    plan: PlanValues,
    vocabulary: Vocabulary,
) -> Iterator[Warning]:
    """Numbers without a unit that are values all the same: behind the name of a parameter
    ("radius 15"), in a row of sizes ("20x20x5"), or in place of an earlier value.
    """
    for number in read_numbers(text):
        clause = clause_at(clauses, number.start)
        inside = any(place.start <= number.start < place.end for place in pairs)
        if number.unit is not None or inside or not is_wanted(clauses, number.start):
            continue
        before = text[max(0, number.start - LONGEST_NAME) : number.start]
        bare = _parameters(vocabulary).search(before) or SIZES.search(before)
        instead = clause and spoken.words["replaced"].match(clause.text.strip(" ,"))
        if (bare or instead) and not plan.says(number.value) and not plan.says(number.value * 60):
            yield lost(text[number.start : number.end])


@functools.lru_cache(maxsize=16)
def _parameters(vocabulary: Vocabulary) -> re.Pattern[str]:
    """The names of number parameters, at the end of what stands before their value."""
    parameters = [one for task in vocabulary.tasks for one in task.parameters if one.unit]
    names = sorted({re.escape(one.name).replace("_", r"[ _]") for one in parameters})
    return re.compile(rf"(?i)\b(?:{'|'.join(names)})(?: (?:of|is|at))?\s*[:=]?\s*$")


def _is_measure(text: str, number: Number) -> bool:
    """Whether a number is a measure or a course. Counts, ids, parts and times of day are none."""
    moment = MOMENT.fullmatch(text, number.start, number.end)
    if moment or number.unit == "%" or CLOCK.match(text, number.end):
        return False
    course = COURSE.search(text, max(0, number.start - 20), number.start)
    return number.unit is not None or course is not None


def is_wanted(clauses: Sequence[Clause], place: int) -> bool:
    """Whether words at a place are neither ruled out nor taken back."""
    clause = clause_at(clauses, place)
    return clause is None or (clause.wants(place) and not clause.corrected)


def clause_at(clauses: Sequence[Clause], place: int) -> Clause | None:
    """The clause in which a place of the command is."""
    return next((one for one in clauses if one.start <= place < one.end), None)
