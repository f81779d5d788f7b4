"""Times of day: "from half past eight to nine" and "from 0810 to 0815" are spans of time."""

import itertools
import re
from collections.abc import Iterator

from planner_ft.facts.together import WRITTEN, Number
from planner_ft.facts.words import SMALL

TIME = re.compile(r"(?<![\d:])(\d{1,3}):([0-5]\d)(?![\d:])")
DAY, HALF_DAY = 86400, 43200
_BETWEEN = re.compile(r"\D{1,9}")
_HOURS = [word for word, value in SMALL.items() if 1 <= value <= 12 and word != "couple"]
_MINUTES = {"five": 5, "ten": 10, "quarter": 15, "twenty": 20, "half": 30}
_SAID = rf"(?:({'|'.join(_MINUTES)}) (past|to) )?({'|'.join(_HOURS)}|noon|midnight)"
_WORDS = re.compile(rf"\b{_SAID} (?:to|till|until|and) {_SAID}\b", re.IGNORECASE)
_HUNDREDS = r"([01]\d|2[0-3])([0-5]\d)(?:h| hours)?"
_FIGURES = re.compile(
    rf"\b(?:from|between) {_HUNDREDS} (?:to|till|until|and) {_HUNDREDS}(?![\w.])", re.IGNORECASE
)


def read_times(text: str) -> Iterator[Number]:
    """ "2:30" as minutes or hours; "from 11:10 to 11:30" as their difference, over midnight too,
    and so "from 1110 to 1130" and "half past eight to nine"; "eight to nine" alone counts.
    """
    times = list(TIME.finditer(text))
    for one, two in itertools.zip_longest(times, times[1:]):
        first = 60 * int(one[1]) + int(one[2])
        for seconds in (first, 60 * first):
            yield Number(seconds, WRITTEN, one.start(), one.end(), "s")
        if two and _BETWEEN.fullmatch(text, one.end(), two.start()):
            seconds = (60 * int(two[1]) + int(two[2]) - first) * 60 % DAY
            yield Number(seconds, WRITTEN, one.start(), two.end(), "s", seconds)
    for span in _FIGURES.finditer(text):
        hours, minutes, later, past = map(int, span.groups())
        seconds = (60 * (later - hours) + past - minutes) * 60 % DAY
        yield Number(seconds, WRITTEN, *span.span(), "s", seconds)
    for span in _WORDS.finditer(text):
        said = [part and part.lower() for part in span.groups()]
        if said[0] or said[3] or {said[2], said[5]} & {"noon", "midnight"}:
            seconds = (_minutes(*said[3:]) - _minutes(*said[:3])) * 60 % HALF_DAY
            yield Number(seconds, WRITTEN, *span.span(), "s", seconds)


def _minutes(minutes: str | None, way: str | None, hour: str) -> int:
    """The minutes since twelve of a time in words."""
    sign = -1 if way == "to" else 1
    return int(60 * SMALL.get(hour, 0)) + sign * _MINUTES.get(minutes or "", 0)
