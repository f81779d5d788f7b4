"""Headings from one to another in equal steps, told in any order: "begin facing 090 and work
anticlockwise through north to 270, a heading every 45 " "degrees".
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from planner_ft.decoding.constraints.reading.rows import turn_forms as f
from planner_ft.decoding.constraints.reading.rows.turn_parts import MOST, ROTATE, Found

_LEADS = r"(?: (?:the|due|on|at|with|from|facing|heading|bearing|a heading of|to))*"
_BEGIN = f.compiled(rf"\b(?:from|start\w*|begin\w*|first (?:face|facing)){_LEADS} (?P<v>{f.V})")
_END = f.compiled(
    r"\b(?:(?:round |back |over )?to|as far as|until(?: you (?:face|reach|are on))?|up"
    rf" to|end\w*|finish\w*|stop\w*){_LEADS} (?P<v>{f.V})"
)
_THROUGH = f.compiled(rf"\b(?:through|via|by way of|over|past){_LEADS} (?P<v>{f.V})")
_STEP = f.compiled(
    r"\bevery (?P<a>D\d+(?:\.\d+)?)|\b(?:in |by )?(?:steps|intervals|increments|turns|jumps) of"
    r" (?P<b>D\d+(?:\.\d+)?)|"
    r"\b(?:in |by )?(?P<c>D\d+(?:\.\d+)?)(?:[- ](?:steps|intervals|increments|spacing|jumps)|"
    r" apart| at a time| each time)"
)
_WAY_ROUND = f.compiled(
    r"(?:(?:counter|anti)[- ]?)?clock-?wise|\bto (?:port|starboard|the left|the right)\b"
)
_ONE = f.compiled(r"\bN1 (?=(?:heading|bearing|stop|look|direction|turn|shot|picture|still)\b)")
_HEADINGS = f.compiled(
    r"\b(?:turn\w*|rotat\w+|headings?|bearings?|fac(?:e|ing)|bow|pan\w*|swing\w*|look\w*|pivot\w*|spin\w*|work\w*|step\w*)\b"
)
_OTHERWISE = f.compiled(
    r"\b(?:~a|radius|circle|orbit|arc|steer\w*|course|metres|waypoints?|run|line)\b"
)


def ranged(text: str) -> Iterator[Found]:
    """The headings of each sentence that tells both ends, the step and the way round, and no other
    angle.
    """
    at = 0
    for sentence in re.split(r"(?<=[.;]) ", text):
        start, at = at, at + len(sentence) + 1
        found = _headings(_ONE.sub(f.mask, sentence))
        if found:
            yield Found(
                start + found[0], start + found[1], tuple((ROTATE, value) for value in found[2])
            )


def _headings(sentence: str) -> tuple[int, int, list[float]] | None:
    """Where a sentence tells such headings, and which."""
    steps, ways = [*_STEP.finditer(sentence)], [*_WAY_ROUND.finditer(sentence)]
    if (
        len(steps) != 1
        or len(ways) != 1
        or not _HEADINGS.search(sentence)
        or _OTHERWISE.search(sentence)
    ):
        return None
    rest = _STEP.sub(f.mask, sentence)
    through = [*_THROUGH.finditer(rest)]
    plain = _THROUGH.sub(f.mask, rest)
    begins = [*_BEGIN.finditer(plain)]
    ends = [*_END.finditer(_BEGIN.sub(f.mask, plain))]
    angles = [*re.finditer(f.V, rest)]
    if len(begins) != 1 or len(ends) != 1 or len(through) > 1 or len(angles) != 2 + len(through):
        return None
    first, last = float(begins[0]["v"][1:]), float(ends[0]["v"][1:])
    step, sign = float(next(value for value in steps[0].groups() if value)[1:]), f.sign(ways[0][0])
    extent = (sign * (last - first)) % 360
    if not step or not extent or extent % step or extent // step >= MOST:
        return None
    found = [(first + sign * step * index) % 360 for index in range(int(extent // step) + 1)]
    if through and float(through[0]["v"][1:]) % 360 not in found:
        return None
    spans = [part.span() for part in (*steps, *ways, *begins, *ends, *through)]
    begin = min(span[0] for span in spans)
    begin -= len(re.split(r"[,:] |\bthen ", sentence[:begin])[-1])
    return begin, max(span[1] for span in spans), found
