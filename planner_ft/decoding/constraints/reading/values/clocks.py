"""Times of day in a task input: none of them is a heading, a place or a count, and two of them can
say how long something lasts.

"It is 14:10 now, hold until 14:52" and "from 09:00 to 09:20" say "for 42 minutes" and "for 20
minutes".
"""

from __future__ import annotations

import re

_HOURS = r"(?: ?(?:hours|hrs|h|local|utc)\b)"
_CLOCK = (
    r"(?P<{0}h>[01]\d|2[0-3]|\d(?=:)):?(?P<{0}m>[0-5]\d)(?!\d|"
    rf" ?(?:m|met\w+|%|deg\w*|°)\b){_HOURS}?"
)
NOW = re.compile(
    r"\b(?:(?:the )?(?:time|clock)(?: now)?(?: is| says| shows|:)?(?: now)?|it(?:['’]s| is)(?:"
    r" now)?|now(?: it(?:['’]s| is)| is|:)?|we have) "
    rf"(?:now )?{_CLOCK.format('a')}(?: now)?[.,;]? ?",
    re.IGNORECASE,
)
UNTIL = re.compile(rf"\b(?:until|till) {_CLOCK.format('b')}", re.IGNORECASE)
SPAN = re.compile(
    rf"\b(?:from|between) (?=\d?\d:|\d{{4}} ?(?:h|hrs|hours|to \d{{4}} ?h)){_CLOCK.format('a')},?"
    rf" (?:to|until|till|and) {_CLOCK.format('b')}",
    re.IGNORECASE,
)

_TIME = r"(?:[01]?\d|2[0-3]):[0-5]\d(?!\d)"
_ANY_TIME = re.compile(
    rf"\b{_TIME}(?: ?(?:hrs?|hours|h|am|pm|utc|local|zulu|z|o'clock)\b)?|(?<=\bsince"
    r" )[0-2]\d[0-5]\d\b(?! ?m)|\b[0-2]\d[0-5]\d (?:hrs|hours|utc|zulu|"
    rf"local time)\b|"
    r"\b\d{1,2} (?:o'clock|am|pm)\b",
    re.IGNORECASE,
)


def with_durations(text: str) -> str:
    """The text with durations for times of day; as it is where none can be told."""
    text = SPAN.sub(
        lambda span: _lasting(_minutes(span, "b") - _minutes(span, "a")) or span[0], text
    )
    now, until = NOW.findall(text), UNTIL.findall(text)
    if len(now) != 1 or len(until) != 1:
        return text
    begun, ended = NOW.search(text), UNTIL.search(text)
    lasting = (
        _lasting(_minutes(ended, "b") - _minutes(begun, "a"))
        if begun and ended and begun.start() < ended.start()
        else None
    )
    return NOW.sub("", UNTIL.sub(lasting, text)).lstrip() if lasting else text


def without_clock_times(text: str) -> str:
    """The text with a word in place of each time of day."""
    return _ANY_TIME.sub("clocktime", text)


def _minutes(time: re.Match[str], name: str) -> int:
    return int(time[f"{name}h"]) * 60 + int(time[f"{name}m"])


def _lasting(minutes: int) -> str | None:
    minutes %= 24 * 60
    return f"for {minutes} minutes" if 0 < minutes <= 12 * 60 else None
