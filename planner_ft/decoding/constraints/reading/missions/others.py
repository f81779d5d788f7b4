"""Places that a command only tells of: where another vessel is at work, what is none of this
vehicle's business.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from planner_ft.data.numerals import signed
from planner_ft.decoding.constraints.reading.missions.apart import PLACE, sentences

Position = tuple[float, float]
_NO_BUSINESS = re.compile(
    r"\b(?:(?:none|neither|not|no) (?:of (?:this|that|it|them|these|those) )?(?:is |are |of |one of"
    r" )?(?:any (?:of )?)?(?:your|our) (?:affair"
    r"|business|concern|job|task|problem|worry|work)"
    r"|(?:neither|nothing|none of (?:it|this|that)|not) (?:is |are )?(?:for|meant for|addressed"
    r" to|to do with) you\b"
    r"|(?:is|are)(?:n['’]t| not) (?:yours|for you|your \w+)|no concern of yours|never ?mind"
    r" (?:her|him|them|that one)|pay (?:it|her|them|that) no (?:heed|mind)"
    r"|(?:ignore|disregard) (?:her|them|it|that|this|those|these|that one|her movements|their"
    r" traffic)\b|do not concern you|does not concern you"
    r"|doesn['’]t concern you"
    r"|leave (?:her|them) (?:be|alone|to it))",
    re.IGNORECASE,
)
_OTHER_VESSEL = re.compile(
    r"^\s*(?:(?:the|our) )?(?P<who>[A-Z][a-z]+|[A-Z][a-z]+ [A-Z][a-z]+|[A-Z][a-z]+[ -]\d+|[Tt]he"
    r" other (?:boat|vehicle|drone|USV|vessel)"
    r"|sister (?:boat|ship|vessel))"
    r" (?:keeps (?:holding|going|working|surveying)|holds|stays|docks|works|is"
    r" (?:working|surveying|holding|docking|busy|inspecting|circling|lying"
    r"|anchored|already|at work)|"
    r"has (?:already|been)|will"
    r" (?:be|hold|dock|stay|survey|take|handle|do|go|work)|takes|handles|surveys|inspects|circles|looks"
    r" after|does|goes|returns)\b"
)
_YOU = re.compile(r"\b(?:you|your)\b", re.IGNORECASE)
_NO_NAME = frozenset(
    {
        "It",
        "That",
        "This",
        "She",
        "He",
        "There",
        "What",
        "Who",
        "Which",
        "Nobody",
        "Everyone",
        "Someone",
        "Harbour",
        "Traffic",
        "Wind",
        "Home",
        "Berth",
    }
)


def places_of_others(text: str) -> Iterator[Position]:
    """The places of sentences about others, which no other sentence names."""
    told = list(sentences(text))
    about = {number for number, sentence in enumerate(told) if _of_others(number, told)}
    ours = {
        place
        for number, sentence in enumerate(told)
        if number not in about
        for place in _places(sentence)
    }
    yield from (
        dict.fromkeys(
            place
            for number in sorted(about)
            for place in _places(told[number])
            if place not in ours
        )
        if ours
        else ()
    )


def _of_others(number: int, row: list[str]) -> bool:
    sentence = row[number]
    if not PLACE.search(sentence):
        return False
    denied = _NO_BUSINESS.search(sentence)
    if denied is None and number + 1 < len(row) and not PLACE.search(row[number + 1]):
        following = _NO_BUSINESS.search(row[number + 1])
        denied = following if following and following.start() < 25 else None
        if denied and _asks(sentence):
            return False
    if denied:
        return not _asks(sentence)
    vessel = _OTHER_VESSEL.match(sentence)
    told = vessel is not None and vessel["who"] not in _NO_NAME and not _YOU.search(sentence)
    return told and any(_YOU.search(other) for place, other in enumerate(row) if place != number)


def _asks(sentence: str) -> bool:
    """Whether a sentence begins with an order."""
    return (
        re.match(
            r"\s*(?:please |then |now"
            r" )?(?:go|hold|dock|survey|inspect|circle|orbit|film|find|take|keep|stay|do|make|run|head|proceed|transit|sweep"
            r"|follow|get|give|track|drift|send|at|from)\b",
            sentence,
            re.IGNORECASE,
        )
        is not None
    )


def _places(sentence: str) -> list[Position]:
    return [(signed(match[1]), signed(match[2])) for match in PLACE.finditer(sentence)]
