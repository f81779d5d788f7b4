"""Times of day in a task input: none of them is a heading, a place or a count, and two of them can say how long something lasts."""

from __future__ import annotations

import re

_TIME = r"(?:[01]?\d|2[0-3]):[0-5]\d(?!\d)"
_CLOCK = re.compile(
    rf"\b{_TIME}(?: ?(?:hrs?|hours|h|am|pm|utc|local|zulu|z|o'clock)\b)?|(?<=\bsince )[0-2]\d[0-5]\d\b(?! ?m)|\b[0-2]\d[0-5]\d (?:hrs|hours|utc|zulu|"
    rf"local time)\b|"
    r"\b\d{1,2} (?:o'clock|am|pm)\b",
    re.IGNORECASE,
)
_NOW = re.compile(
    rf"\b(?:time (?:is )?now(?: is)?|the time(?: now)? is|time is|it is(?: now)?|it's(?: now)?|now is|now it is|now,?|from|at present) (?P<t>{_TIME})",
    re.IGNORECASE,
)
_UNTIL = re.compile(rf"\b(?:until|till|up to|to) (?P<t>{_TIME})", re.IGNORECASE)


def with_durations(text: str) -> str:
    """The text with a duration where it says until when something lasts, and what time it is."""
    now, until = [*_NOW.finditer(text)], [*_UNTIL.finditer(text)]
    if len(now) != 1 or len(until) != 1:
        return text
    minutes = (_minutes(until[0]["t"]) - _minutes(now[0]["t"])) % (24 * 60)
    if not 0 < minutes <= 12 * 60:
        return text
    return text[: until[0].start()] + f"for {minutes} minutes" + text[until[0].end() :]


def without_clock_times(text: str) -> str:
    """The text with a word in place of each time of day."""
    return _CLOCK.sub("clocktime", text)


def _minutes(clock: str) -> int:
    hours, minutes = clock.split(":")
    return int(hours) * 60 + int(minutes)
