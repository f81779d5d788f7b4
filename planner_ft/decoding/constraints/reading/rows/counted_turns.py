"""Rotations whose number a task input gives instead of each one: so many headings round the
compass, parts of a whole angle, steps from one to another.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading.rows import turn_forms as f
from planner_ft.decoding.constraints.reading.rows.ranged_turns import ranged
from planner_ft.decoding.constraints.reading.rows.turn_parts import (
    CURVED,
    MOST,
    NUDGE,
    ROTATE,
    Found,
    Uncertain,
    blank,
    heading,
)

_START = f.compiled(
    r"\b(?:from|start\w*(?: (?:at|with|from|in|on))?|beginn?\w*(?: (?:at|with|from|in|on))?|on"
    r" from)(?: (?:the|due|heading|a heading of|bearing|"
    r"facing))* (?P<v>[DNC]\d+(?:\.\d+)?)"
    r"|(?P<w>[DNC]\d+(?:\.\d+)?) first\b"
    r"|\bthe first (?:it|heading|bearing|of (?:them|these))(?: is| being| at| on| to| the| due|"
    r" towards|,)* (?P<u>[DNC]\d+(?:\.\d+)?)"
)
_SECTORS = f.compiled(
    r"\bN(?P<count>\d+) (?:(?:even|equal|evenly spaced|equally"
    r" spaced|regular|sector|different|compass|equidistant|evenly-spaced) )*(?:headings|"
    r"sectors|directions|bearings|views)\b(?! ?[,:-]? ?[DNC][\d.]+(?![\d.])(?!"
    r" (?:apart|from|between)))"
    r"|\bround in N(?P<steps>\d+) (?:equal|even) steps\b"
    r"|\bdivide the (?:compass|horizon|circle) into N(?P<parts>\d+)\b"
)
_WAY_ROUND = f.compiled(r"(?:(?:counter|anti)[- ]?)?clock-?wise|\bto the (?:left|right)\b")
_APART = f.compiled(
    r"\b(?:each )?D(?P<step>\d+(?:\.\d+)?) (?:apart|intervals?|spacing|spaced|from (?:one to )?the"
    r" next|between (?:them|headings|each))\b|"
    r"\bin steps of D(?P<steps>\d+(?:\.\d+)?)"
)
_ALL_ROUND = f.compiled(
    r"\b(?:all (?:the way )?round|full circle|whole circle|round the"
    r" (?:compass|horizon|clock)|evenly|equal\w*|even|compass|horizon|sectors|sector|"
    r"right round|panorama|round in|clock-?wise)\b"
)
_RANGE = f.compiled(
    rf"\bfrom (?:due )?(?P<a>{f.V})(?: (?:through|via) (?:due )?(?P<via>{f.V}))? (?:to|round to|"
    rf"up to) (?:due )?(?P<b>{f.V})(?P<between>[^.;]*?)\b(?:in steps of|steps of|every)"
    r" (?P<step>D\d+(?:\.\d+)?)(?: steps)?"
)
_EVERY = f.compiled(r"\bevery D(?P<step>\d+(?:\.\d+)?)")
_FULL_TURN = f.compiled(
    r"(?:(?P<ahead>"
    + f.SIDE
    + r")[ ,]*)?\b(?:full turn|full circle|full rotation|(?:all the way|right|once|completely|once"
    r" all the way) round|a?round once|D360|"
    r"(?:one|N1) revolution|complete (?:turn|circle|rotation|revolution)|whole"
    r" (?:turn|circle)|spin)\b"
    r"(?P<between>[^.;]*?)\bin N(?P<count>\d+) (?:(?:equal|even|equally sized)"
    r" )*(?:steps|parts|pans|turns|nudges|rotations|"
    r"goes)\b(?: of D(?P<each>\d+(?:\.\d+)?)\b)?(?P<behind>[ ,]*(?:" + f.SIDE + r"))?"
)
_PARTS = f.compiled(
    r"\b(?P<verb>(?:pan|turn|swing|rotat|nudg|yaw|sweep|scan|twist|pivot|spin|slew)(?:e|ing|ning|ting)?)\b(?P<lead>[^.;:~DNCPL]{0,40}?) "
    r"D(?P<width>\d+(?:\.\d+)?),?(?P<behind>[^.;:~DNCPL]{0,30}?),? (?:in|divided into|split"
    r" into|cut into) N(?P<count>\d+) "
    r"(?:(?:equal|even|equally large|equal-sized|identical)"
    r" (?:parts|steps|stages|portions|pieces|goes|nudges|pans|turns|rotations)|"
    r"(?:parts|portions|pieces|stages))\b(?! of [DN])"
)
"""A whole angle that is turned in parts."""
_LISTED_FIRST = f.compiled(
    rf"(?:^|[.;] )(?P<list> ?(?:due )?{f.V}(?:(?: ?,| ?/| ?-| and| then)+ (?:due )?{f.V})+)(?: in"
    r" that order)?[ :,-]*(?:turn to|face|look at|"
    rf"point to|(?:with )?the bow on|turn onto) "
    r"(?:each|them|all|these)\b(?: of (?:them|these))?(?: in (?:that|this) order)?"
)
_UNTIL_WIDTH = f.compiled(
    rf"(?P<before>{f.SIDE})?[ ,]*(?:by |in steps of )?D(?P<step>\d+(?:\.\d+)?)(?:"
    rf" (?P<behind>{f.SIDE}))? at a time,?(?: (?P<last>{f.SIDE}))? "
    r"until (?:you have covered )?D(?P<width>\d+(?:\.\d+)?)(?: (?:has been|have been|is|are)"
    r" (?:covered|reached|scanned|done))?"
)


def counted(text: str) -> Iterator[Found]:
    """Rotations whose number the text gives instead of each one."""
    for match in _UNTIL_WIDTH.finditer(text):
        step, width = float(match["step"]), float(match["width"])
        side = match["before"] or match["behind"] or match["last"] or ""
        if not step or width % step:
            raise Uncertain
        yield Found(
            match.start(), match.end(), ((NUDGE, f.sign(side) * step),) * int(width // step)
        )
    for match in _PARTS.finditer(text):
        yield _in_parts(match, text)
    text = _PARTS.sub(f.mask, text)
    for match in _FULL_TURN.finditer(text):
        sides = [
            side
            for side in (match["ahead"], *re.findall(f.SIDE, match["between"]), match["behind"])
            if side
        ]
        if _START.search(text[match.end() :].partition(". ")[0]):
            raise Uncertain
        if match["each"] and int(match["count"]) * float(match["each"]) != 360:
            raise Uncertain
        if (
            len(sides) > 1
            or int(match["count"]) < 2
            or re.search("[DC][+-]?[0-9]", match["between"])
        ):
            raise Uncertain
        value = (f.sign(sides[0]) if sides else 1) * 360 / int(match["count"])
        yield Found(match.start(), match.end(), ((NUDGE, value),) * int(match["count"]))
    ranges = [*ranged(text)]
    yield from ranges
    text = blank(text, [(found.start, found.end) for found in ranges])
    for match in _RANGE.finditer(text):
        yield _range(match, text)
    for match in _LISTED_FIRST.finditer(text):
        values = re.findall(f.V, match["list"])
        yield Found(
            match.start("list"), match.end(), tuple(heading(float(value[1:])) for value in values)
        )
    text = _FULL_TURN.sub(f.mask, _RANGE.sub(f.mask, text))
    yield from _every(text)
    yield from _sectors(text)


def _in_parts(match: re.Match[str], text: str) -> Found:
    """The parts of an angle: "pan left across 120 degrees in three equal parts"."""
    begins = max(text.rfind(mark, 0, match.start()) for mark in (". ", "; ")) + 1
    sides = re.findall(f.SIDE, f"{match['lead']} | {match['behind']}")
    rest = re.match(rf"[ ,]*({f.SIDE})", text[match.end() :])
    sides += [rest[1]] if rest else []
    count, width = int(match["count"]), float(match["width"])
    if (
        len(sides) > 1
        or not 2 <= count <= MOST
        or not 0 < width <= 360
        or CURVED.search(text[begins:].partition(". ")[0].replace("sweep", ""))
    ):
        raise Uncertain
    turns = ((NUDGE, g.tidy((f.sign(sides[0]) if sides else 1) * width / count)),) * count
    return Found(match.start(), match.end() + (rest.end() if rest else 0), turns)


def _range(match: re.Match[str], text: str) -> Found:
    first, last, step = float(match["a"][1:]), float(match["b"][1:]), float(match["step"][1:])
    sides = {f.sign(side) for side in re.findall(r"(?:(?:counter|anti)[- ]?)?clock-?wise", text)}
    if len(sides) != 1 or not step:
        raise Uncertain
    sign = sides.pop()
    extent = (sign * (last - first)) % 360
    if extent % step or not extent:
        raise Uncertain
    found = [(first + sign * step * index) % 360 for index in range(int(extent // step) + 1)]
    if match["via"] and float(match["via"][1:]) not in found:
        raise Uncertain
    return Found(match.start(), match.end(), tuple((ROTATE, value) for value in found))


def _every(text: str) -> Iterator[Found]:
    """Headings round the whole compass so many degrees apart: "on headings every 45 degrees,
    clockwise from north, right round".
    """
    for match in _EVERY.finditer(text):
        rest = re.split(r"[.;] ", text[match.end() :])[0]
        start, sides = (
            _START.search(rest),
            re.findall(r"(?:(?:counter|anti)[- ]?)?clock-?wise", rest),
        )
        step = float(match["step"])
        if (
            not start
            or len(sides) != 1
            or not step
            or 360 % step
            or not re.search(r"round|full circle|compass", rest)
        ):
            raise Uncertain
        first = float((start["v"] or start["w"] or start["u"])[1:])
        turns = tuple(
            (ROTATE, (first + f.sign(sides[0]) * step * index) % 360)
            for index in range(int(360 // step))
        )
        yield Found(match.start(), match.end() + start.end(), turns)


def _sectors(text: str) -> Iterator[Found]:
    """Headings evenly round the compass, or a stated angle apart, from the stated one on."""
    found = [*_SECTORS.finditer(text)]
    if not found:
        return
    match = found[0]
    left = max(text.rfind(mark, 0, match.start()) for mark in (". ", "; ", "-1")) + 1
    sentence = re.split(r"[.;] ", text[left:])[0]
    starts, apart = [*_START.finditer(sentence)], _APART.search(sentence)
    ways = [*_WAY_ROUND.finditer(sentence)]
    count = int(match["count"] or match["parts"] or match["steps"])
    if (
        len(found) > 1
        or len(starts) != 1
        or len(ways) > 1
        or not 2 <= count <= MOST
        or not (apart or _ALL_ROUND.search(sentence))
    ):
        raise Uncertain
    first = float((starts[0]["v"] or starts[0]["w"] or starts[0]["u"])[1:])
    step = float(apart["step"] or apart["steps"]) if apart else 360 / count
    if apart and abs(step * count - 360) > 0.01 and not ways:
        raise Uncertain
    sign = f.sign(ways[0][0]) if ways else 1
    said = [
        (left + part.start(), left + part.end())
        for part in (starts[0], *ways, *([apart] if apart else []))
    ]
    spans = [match.span(), *said]
    turns = tuple((ROTATE, g.tidy((first + sign * step * index) % 360)) for index in range(count))
    start, end = min(span[0] for span in spans), max(span[1] for span in spans)
    if re.search(f.V, blank(text, spans)[start:end]):
        raise Uncertain
    yield Found(start, end, turns)
