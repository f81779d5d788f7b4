"""The row of the movements that the steps of skills are told against, and whether a plan must go by
it.
"""

from __future__ import annotations

import re

from planner_ft.decoding.constraints.reading.rows import movement_words as m
from planner_ft.decoding.constraints.reading.rows.movement_rows import Plain, Row
from planner_ft.decoding.constraints.reading.rows.told_movements import row_of, unread_places
from planner_ft.decoding.constraints.reading.scopes.anchors import Found, scopes_of
from planner_ft.decoding.constraints.reading.scopes.skill_mentions import sentence_at
from planner_ft.decoding.constraints.reading.scopes.skill_words import SKILL_WORDS
from planner_ft.decoding.constraints.reading.scopes.text_items import sentences
from planner_ft.decoding.constraints.reading.scopes.where import Anchor

_REPEATED = re.compile(
    r"\b(?:repeat\w*|back and forth|to and fro|alternat\w+|once more|over and over|each of"
    r" (?:these|them|which)|in reverse|backwards|"
    r"the other way round|scratch|"
    r"correction|make that|no wait|sorry|i mean|rather not|instead)\b"
)
"""Words of texts whose movements are not told one after the other, or are taken back."""
_PAUSED = re.compile(
    r"\b(?:hold|stop|wait|pause|stay|halt|turn|pan|nudge|face|rotate)\w*\b[^.;]{0,50}\b(?:at|on|in|after|behind|between)"
    r" (?:each|every|all|both|either)\b|"
    r"\b(?:at|on|after|behind|between) (?:each|every|all|both) (?!turns?\b,? (?:get|have)|"
    r"hold)[^.;]{0,40}\b(?<!the )(?<!each )(?<!every )(?<!in"
    r" )(?:hold|stop|wait|pause|stay|halt|turn|pan|face)(?:s|ing|ping)?\b"
)
_ORDER = re.compile(
    r"\bbut (?:first|before)|\bbefore"
    r" (?:\w+ing\b|that|you|this|it|going|turning|the)|\bpreceded\b|\bfirst of all\b|\bafter"
    r" (?:you|having|the)\b|"
    r"\bprior to\b|(?<!not )(?<!no )\bearlier\b"
)
_STRUCTURE = re.compile(
    r"\b(?:face|wall|side|quay|cable|pipe\w*|edge|breakwater|pontoon|hull|barge|jetty|line|structure|array|boom|pier|dam)\b[^.;@]{0,30}"
    r"\b(?:runs?|goes|lies|extends|stretches|starts|begins|leaves|leads)\b[^.;]{0,20}@"
)
"""A structure's course, whose places are not gone to as they are told."""
_ACROSS = re.compile(r"\bfrom @ (?:across|over|straight|on|direct(?:ly)?) to @")
"""A run whose beginning is gone to as well."""
_LIKE_MOVEMENTS = ("FitCylinderModel", "LockHeading", "LogLidarSlice", "ObstacleAvoidance")
"""Skills whose words could be those of movements."""
_FREELY = re.compile(
    r"(?:up to|as far as) @"
    r" (?:you|she|we|it)\b[^.;,]{0,20}\b(?:no|not|nothing|without|freely|needn't)\b"
)
"""What stands at the beginning of a way on which nothing runs."""
_LEG = re.compile(
    r"\b\d[\d.]* ?(?:m|metres?|meters?|km|yards?|feet)\b(?: further| more| out)? (?:on (?:an?"
    r" )?(?:the )?(?:bearing|course|heading)|due|"
    r"(?:to the |further )?(?:north|south|east|west)\w*)\b"
)
"""A leg by its length and bearing, that is a movement."""
_ORDERED = re.compile(
    r"^\W*(?:and )?(?:first(?:ly)?|second(?:ly)?|third(?:ly)?|next|then|lastly|finally|after"
    r" that|afterwards|from there|on arrival)\b,?"
)


def scopes_and_row(said: Plain) -> tuple[Found, Row]:
    """The scopes of a text, and the row of its movements apart from these."""
    found = _scopes_only(
        said,
        [(kind, match) for kind, match in scopes_of(said.text) if not _goes_freely(said, match)],
    )
    masked = [
        match.span() for name in _LIKE_MOVEMENTS for match in SKILL_WORDS[name].finditer(said.text)
    ]
    return found, row_of(said, [*_taken(found), *masked])


def goes_by(said: Plain, row: Row, found: Found) -> bool:
    """Whether the movements of a text are told one after the other, and all of them are read."""
    text = said.text
    bounds = [match.span() for kind, match in found if kind in ("upto", "beyond")]
    return not (
        not row.units
        or _repeated(text, row, found)
        or any(pattern.search(text) for pattern in (_PAUSED, _ORDER, _ACROSS, _STRUCTURE))
        or _unread_movement(text, row, found)
        or _unread_leg(text, row)
        or unread_places(said, row, bounds)
    )


def _goes_freely(said: Plain, match: re.Match[str]) -> bool:
    """Whether words name a place that nothing else leads to, and so is gone to: "as far as @ no
    care is needed".
    """
    place = said.places.get(match.end() - 1)
    return (
        _FREELY.match(said.text[match.start() :]) is not None
        and place is not None
        and list(said.places.values()).count(place) == 1
    )


def _taken(found: Found) -> list[tuple[int, int]]:
    """The parts of a text that are scopes and tell no movement: a place in most of them may be gone
    to.
    """
    return [
        match.span()
        for kind, match in found
        if "@" not in match[0] or kind in ("upto", "beyond", "place")
    ]


def _scopes_only(said: Plain, found: Found) -> Found:
    """The scopes of a text without words of order before a movement ("after that hold on") and
    places that nothing else leads to ("as far as @").
    """
    row, places = row_of(said, _taken(found)), list(said.places.values())

    def leads(kind: str, match: re.Match[str]) -> bool:
        if kind == "rest":
            begins = re.search(r"(?:^|[.;] |\band |, )$", said.text[: match.start()]) is not None
            return begins and any(
                unit.start - match.end() in (1, 2) and not unit.chained for unit in row.units
            )
        if kind == "upto" and re.match("as far|up to", match[0]):
            place = said.places.get(match.start() + match[0].find("@"))
            return (
                places.count(place) == 1
                and not any(
                    unit.kind == m.GOTO and unit.start < match.start() for unit in row.units
                )
                if place
                else False
            )
        return False

    return [(kind, match) for kind, match in found if not leads(kind, match)]


def _repeated(text: str, row: Row, found: Found) -> bool:
    """Whether movements are repeated or taken back. "At the third no sonar, drop a pin instead" is
    about skills.
    """
    for match in _REPEATED.finditer(text):
        begin, end = sentence_at(text, match.start())
        if (
            match[0] != "instead"
            or any(begin <= unit.start < end for unit in row.units)
            or not any(begin <= scope.start() < end for _kind, scope in found)
        ):
            return True
    return False


def _unread_movement(text: str, row: Row, found: Found) -> bool:
    """Whether a sentence begins with a word of order and tells no movement that is read."""
    if len(re.findall(r"\bengines? (?:off|stopped|on)\b", text)) > 1:
        return True
    scopes = [Anchor(match.start(), match.end(), True, None) for _kind, match in found]
    told = [*(unit.start for unit in row.units), *(scope.start for scope in scopes)]
    return any(
        _ORDERED.match(text[begin:end]) and not any(begin <= start < end for start in told)
        for begin, end in sentences(text, scopes)
    )


def _unread_leg(text: str, row: Row) -> bool:
    """Whether a text tells a leg that is no movement of its row."""
    return any(
        not any(unit.start <= match.end() and match.start() <= unit.end + 1 for unit in row.units)
        for match in _LEG.finditer(text)
    )
