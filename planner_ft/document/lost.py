"""Quantities with a unit, courses and coordinates that a command states and that stand nowhere in
its plan.
"""

from __future__ import annotations

import bisect
import itertools
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.benchmark.metrics.values import is_number
from planner_ft.data.quantities import Quantity, close, positions, quantities
from planner_ft.document.clauses import Clause, read_clauses
from planner_ft.document.language import language
from planner_ft.document.offsets import read_offsets
from planner_ft.document.said import Piece, Said, is_place
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import step_skills

COURSE = re.compile(r"\b(?:heading|bearing|course)(?: of)?\W{1,3}$", re.IGNORECASE)
CLOCK = re.compile(r"\s*(?:o['’]?clock|am\b|pm\b|utc\b|gmt\b|zulu\b|local\b|ago\b)", re.IGNORECASE)
MOMENT = re.compile(r"(?:an? (?:\w+ )?)?(?:second|minute|moment|day)", re.IGNORECASE)
"""Words that are no time to be kept: "a second", "a good day"."""
NO = re.compile(r"\W*\bno\b\W*", re.IGNORECASE)
"""All that stands between a value and the one that takes its place: "45 minutes, no, ten
minutes".
"""


def lost_values(
    said: Said, tasks: Sequence[Mapping[str, Any]], texts: Iterable[str], vocabulary: Vocabulary
) -> Iterator[str]:
    """The words for each such value. It stands in a plan when a parameter of `tasks` or of their
    skills has it, or one of `texts` says it.

    What the command rules out, takes back or only tells of is no loss.
    """
    held, alone, places = _held(tasks, texts)
    wanted = Wanted(
        read_clauses(said.command, vocabulary), language(vocabulary).words["correction"]
    )
    home = (float(vocabulary.home[0]), float(vocabulary.home[1]))
    for piece in said.pieces:
        offsets = [
            offset for offset in read_offsets(piece.text, home) if _near(offset.place, places)
        ]
        told = [(offset.start, offset.end) for offset in offsets]
        for words, values, start in _stated(piece, wanted):
            if not any(_among(value, held) for value in values) and not any(
                begin <= start < end for begin, end in told
            ):
                yield words
        for words, options in _stated_places(piece, wanted):
            if any(offset.base in options for offset in offsets):
                continue
            known = any(_near(option, places) for option in options)
            # In brackets it is a place as a whole, whatever its signs; else its numbers may stand
            # apart.
            written = f"[{words}]" in piece.text or f"({words})" in piece.text
            apart = all(_among(part, held) for part in options[0])
            if not known and not (
                apart
                and (
                    not written
                    or all(_among(part, alone) for part in options[0])
                    or _mirrored(options[0], places)
                )
            ):
                yield words


def _held(
    tasks: Sequence[Mapping[str, Any]], texts: Iterable[str]
) -> tuple[list[float], list[float], list[tuple[float, float]]]:
    """The numbers of tasks with their skills, and of texts, sorted; those of them that are no
    coordinates of a task; and the places.
    """
    skills = (
        skill
        for task in tasks
        for step in task.get("skill_sequence") or ()
        for _role, skill in step_skills(step)
    )
    values = [value for owner in (*tasks, *skills) for value in owner["parameters"].values()]
    numbers = {float(number) for value in values for number in _flat(value)}
    alone = {float(value) for value in values if is_number(value)}
    places = [
        (value[0], value[1])
        for value in values
        if isinstance(value, list) and len(value) == 2 and all(map(is_number, value))
    ]
    for text in texts:
        said = {
            number for quantity in quantities(text) for number in (quantity.value, quantity.said)
        }
        numbers, alone = numbers | said, alone | said
        places += [(x, y) for x, y, _start, _end in positions(text)]
    return sorted(numbers), sorted(alone), list(dict.fromkeys(places))


def _flat(value: Any) -> Iterator[float]:
    if is_number(value):
        yield value
    elif isinstance(value, list):
        for item in value:
            yield from _flat(item)


@dataclass(frozen=True)
class Wanted:
    """What of a command counts: not what it rules out, nor what its next words take back."""

    clauses: tuple[Clause, ...]
    correction: re.Pattern[str]

    def at(self, place: int) -> bool:
        """Whether words at this place are wanted."""
        index = bisect.bisect_right(self.clauses, place, key=lambda clause: clause.start) - 1
        clause = self.clauses[index] if index >= 0 else None
        return clause is None or (
            not clause.corrected and (clause.excluded is None or place < clause.excluded)
        )


def _mirrored(place: tuple[float, float], places: Iterable[tuple[float, float]]) -> bool:
    return any(abs(place[0]) == abs(x) and abs(place[1]) == abs(y) for x, y in places)


def _near(place: tuple[float, float], places: Iterable[tuple[float, float]]) -> bool:
    return any(abs(place[0] - x) <= 0.01 and abs(place[1] - y) <= 0.01 for x, y in places)


def _stated(piece: Piece, wanted: Wanted) -> Iterator[tuple[str, tuple[float, ...], int]]:
    """(words, the numbers that they can stand for, where they begin) of the measures of a text.
    Counts, ids, parts and times of day are none.
    """
    found = quantities(piece.text)
    used: set[int] = set()
    for index, quantity in enumerate(found):
        following = found[index + 1] if index + 1 < len(found) else None
        if (
            index in used
            or not _is_measure(piece.text, quantity)
            or not wanted.at(piece.offset + quantity.start)
        ):
            continue
        if following and _replaced(piece.text[quantity.end : following.start], wanted):
            continue
        values, end = [quantity.value], quantity.end
        if (
            following
            and quantity.unit == following.unit == "s"
            and following.start - quantity.end <= 5
        ):
            values.append(quantity.value + following.value)
            used.add(index + 1)
            end = following.end
        elif (
            following
            and quantity.unit == "s"
            and following.unit is None
            and following.start - quantity.end <= 1
            and quantity.said
        ):
            # "five minutes forty"
            values.append(quantity.value + following.value * quantity.value / quantity.said / 60)
            end = following.end
        yield piece.text[quantity.start : end], tuple(values), quantity.start


def _replaced(between: str, wanted: Wanted) -> bool:
    """Whether the words between two values say that the second takes the place of the first."""
    return len(between) <= 30 and (
        wanted.correction.search(between) is not None or NO.fullmatch(between) is not None
    )


def _is_measure(text: str, quantity: Quantity) -> bool:
    if (
        CLOCK.match(text, quantity.end)
        or quantity.unit == "%"
        or MOMENT.fullmatch(text, quantity.start, quantity.end)
    ):
        return False
    return (
        quantity.unit is not None
        or COURSE.search(text, max(0, quantity.start - 20), quantity.start) is not None
    )


def _stated_places(piece: Piece, wanted: Wanted) -> Iterator[tuple[str, list[tuple[float, float]]]]:
    """(words, what they can stand for) of what certainly are coordinates."""
    for (start, end), group in itertools.groupby(
        positions(piece.text), key=lambda item: (item[2], item[3])
    ):
        if is_place(piece.text, start, end) and wanted.at(piece.offset + start):
            following = quantities(piece.text[end : end + 40])
            taken_back = following and wanted.correction.search(
                piece.text[end : end + 40], 0, following[0].start
            )
            if not taken_back:
                yield piece.text[start:end], [(x, y) for x, y, _start, _end in group]


def _among(value: float, held: list[float]) -> bool:
    """Whether a number is among sorted ones, up to rounding and sign."""
    for number in (value, -value):
        index = bisect.bisect_left(held, number)
        if any(
            close(number, near) or abs(number - near) <= 1e-4 * abs(number)
            for near in held[max(0, index - 1) : index + 1]
        ):
            return True
    return False
