"""The steps that a scope means by the kind of a movement: "in the hold", "on all legs", "while
turning", "at the corners".
"""

from __future__ import annotations

import re

from planner_ft.decoding.constraints.reading.rows.movement_rows import Row
from planner_ft.decoding.constraints.reading.scopes import scope_words as w
from planner_ft.decoding.constraints.reading.scopes import step_scope_words as s
from planner_ft.decoding.constraints.reading.scopes.where import (
    EVERYWHERE,
    Phrase,
    Where,
    at,
    the_one,
)

_TO_ITS_START = re.compile(
    r"\b(?:not|nor|never|none|nothing|no \w+) (?:on|during|for|in) the"
    r" (?:way|leg|run|approach|transit|trip) (?:out )?to (?:its|the|where (?:it|"
    r"the \w+)) (?:start|begin)\w*\b"
)
_FROM_CORNER = re.compile(r"\b(?:start|begin|from|first|enter)\w*\b[^.;]{0,30}\bcorner\b")
_FROM_MIDDLE = re.compile(
    r"\b(?:start|begin|from|first)\w*\b[^.;]{0,30}\b(?:middle|mid|centre of the|due"
    r" (?:north|south|east|west))"
)


def kinds_of(noun: str) -> frozenset[str]:
    """The movements that a noun means."""
    return next(kinds for pattern, kinds in s.NOUNS if re.fullmatch(pattern, noun))


def units_of(row: Row, kinds: frozenset[str]) -> list[int]:
    """The movements of some kinds; a hold may be one that keeps a target in the picture."""
    units = list(row.of(kinds))
    return list(row.of(frozenset({s.VISUAL}))) if not units and kinds == {s.HOLD} else units


def all_of(row: Row, kinds: frozenset[str]) -> Where | None:
    """All steps of some kinds; None where there are none."""
    units = units_of(row, kinds)
    if kinds == {s.HOLD} and row.of(frozenset({s.HOLD})) and row.of(frozenset({s.VISUAL})):
        # One that keeps a target in the picture may be meant as well.
        return None
    meant = frozenset(row.units[index].kind for index in units) if kinds == {s.HOLD} else kinds
    return Where(frozenset(units), meant or kinds) if units else None


def every_one(phrase: Phrase) -> Where | None:
    """ "On all legs", "in each hold", "for both moves"."""
    noun = phrase.group("noun") or ""
    kinds, words = kinds_of(noun), phrase.words.split()
    number = next((value for word, value in w.COUNTS.items() if word in words), None)
    if kinds != s.ANY:
        counted = number in (None, len(units_of(phrase.row, kinds))) or not all(
            unit.single for unit in phrase.row.units
        )
        return all_of(phrase.row, kinds) if counted else None
    if number in (None, phrase.count) or not phrase.row.units:
        return EVERYWHERE
    # "Both moves" where three things are done: those that go somewhere, if they are as many.
    return at(phrase.goes) if noun.startswith("move") and len(phrase.goes) == number else None


def meanwhile(phrase: Phrase) -> Where | None:
    """ "While turning", "as long as she floats", "under way"."""
    row = phrase.row
    name = next(name.rstrip("2") for name, value in phrase.match.groupdict().items() if value)
    name = "hold" if name == "wait" and not row.of(s.GERUNDS[name]) else name
    where = all_of(row, s.GERUNDS[name])
    if where is None or where.units is None:
        return where
    if name == "goto":
        singles = {row.units[index].single for index in where.units}
        some_runs = len(singles) > 1 or (singles == {False} and len(where.units) < phrase.count)
        return None if some_runs or row.of(frozenset({s.ARC})) else where
    return Where(where.units, s.GERUNDS[name]) if name == "hold" else where


def of_kind(phrase: Phrase) -> Where | None:
    """ "In the hold": the only one, or all holds where several are meant."""
    if (
        len(phrase.goes) < 2
        and _TO_ITS_START.search(phrase.said.text)
        and re.search(r"\b(?:run|pass|line|track|leg)s?\b", phrase.words)
    ):
        return Where(beginning=False)
    noun, row = phrase.noun or "", phrase.row
    kinds = kinds_of(noun)
    units, several = units_of(row, kinds), noun.endswith("s")
    if not units and several and kinds in ({s.DRIFT}, {s.ARC}):
        return Where(kinds=kinds)
    if (
        not units
        or kinds == s.ANY
        or (
            re.match("lane|transect", noun)
            and len({row.units[index].single for index in units}) > 1
        )
    ):
        return None
    if len(units) == 1:
        return None if several and row.units[units[0]].single else all_of(row, kinds)
    if several:
        return all_of(row, kinds) if kinds != {s.GOTO} else Where(frozenset(units), kinds)
    last = phrase.last
    near = [index for index in units if last and last.units and index in last.units]
    return the_one(near)


def corners(phrase: Phrase) -> Where | None:
    """The corners of a survey square, or the middles of its sides: every other waypoint."""
    text, is_corner = phrase.said.text, phrase.group("corner") is not None
    if (
        not re.search(r"\bsquare\b|\binspect\w*|\bsurvey\b", text)
        or text.count("@") > 2
        or re.search(r"\bgrid|\blanes?\b|lawn", text)
    ):
        return None
    begins = _FROM_CORNER.search(text) is not None and not re.search(
        r"\bat (?:the |each |every |all )?(?:four )?corners?\b[^.;]{0,10}$", text
    )
    if begins and _FROM_MIDDLE.search(text):
        return None
    return Where(parity=0 if is_corner == begins else 1)
