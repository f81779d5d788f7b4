"""Movements that an input asks for beyond doubt, by its words: a hold of so many minutes, a wait
until the vehicle lies steadily, a drift, an arc.

Places and rotations are read elsewhere. What is said to be left out, or under a condition, is not
asked for.
"""

from __future__ import annotations

import re

from planner_ft.decoding.constraints.reading.skills.evidence import readable, variants
from planner_ft.vocabulary import Vocabulary

_SMALL = r"an?|one|two|three|four|five|six|seven|eight|nine|ten|eleven|twelve|fifteen|twenty|thirty|forty|fifty|sixty|ninety"
_NUMBER = (
    r"(?:\d+(?:[.,]\d+)?|half(?: an?)?|(?:a|three) quarters?(?: of)?(?: an?)?|a (?:hundred|couple"
    rf" of|few)|{_SMALL})"
)
_DURATION = (
    rf"{_NUMBER}(?:[ -](?:and a (?:half|quarter)|{_SMALL}|half)){{0,2}}["
    r" -]?(?:s|secs?|seconds?|mins?|minutes?|hrs?|h|hours?)\b"
)
_HERE = (
    r"(?: (?:position|station|still|there|here|put|tight|on (?:the spot|station)|at"
    r" (?:it|(?:that|the) (?:point|place|waypoint|position|spot))))?"
)
_STEADY = r"(?:stead(?:y|ier|ied)|stable|settled|settles|calm(?:er)?|quiet(?:er)?)"
_UNSEEN = (
    r"(?![^.;]*\b(?:visual\w*|camera|cent(?:re|er)\w*|fram\w+|picture|view|sight|on (?:the|a|an) ))"
)
_PATTERNS = {
    "hold": (
        (
            rf"\b(?:hold|holding|keep station|stay|sit|remain|linger|loiter|pause){_HERE},? (?:for"
            rf" )?(?:about |exactly |another |a full |the full )?{_DURATION}"
        ),
        rf"\b{_DURATION}(?: of)? (?:on station|hold\b|on the spot|holding|station[ -]keeping)",
        rf"\b(?:hold|holding|maintain|keep) (?:position|station)\b{_UNSEEN}",
    ),
    "wait": (
        (
            r"\b(?:wait|hold|pause|stay|hang"
            rf" on)\b[^.;,]{{0,30}}\b(?:until|till)\b[^.;]{{0,40}}\b{_STEADY}"
        ),
        r"\blet (?:her|it|the (?:boat|vehicle|hull)|yourself) (?:settle|steady)",
        (
            r"\bwait for (?:stability|(?:it|her|the (?:boat|vehicle)) to (?:settle|steady|be"
            rf" {_STEADY})|a (?:stable|steady) platform)"
        ),
    ),
    "drift": (
        rf"\bdrift(?:ing)?\b(?! (?:log|report|track|data))[^.;]{{0,25}}{_DURATION}",
        rf"{_DURATION} (?:of )?(?:drift|drifting|adrift)\b",
        r"\bdrift (?:freely )?with the current\b",
    ),
    "arc": (
        r"\b(?:arc|curve|bend) (?:turn )?(?:of|through) [^.;]{0,30}(?:degrees|°)",
        r"\barc turn\b",
    ),
    "visual": (
        r"\b(?:keep|hold|maintain)(?:ing)? (?:the |a |an )?[^.;,:]{1,40} "
        r"(?:centred|centered|in the (?:centre|center|middle) of the"
        r" (?:frame|picture|image|view))\b",
        r"\b(?:hold(?:ing)? (?:position|station)|station[ -]keep\w*) visually on\b",
        (
            r"(?:^|[.;] ?)[a-z][a-z -]{2,30} (?:stays|is kept|is to stay) in (?:the"
            r" )?(?:centre|center|middle) of (?:the )?(?:frame|picture|image)\b"
        ),
    ),
}
ASKS = {
    motion: re.compile("|".join(wordings), re.IGNORECASE) for motion, wordings in _PATTERNS.items()
}
_WITHOUT = re.compile(
    r"\b(?:no|not|don'?t|never|without|nobody|nothing|neither|nor|instead of|rather"
    r" than|skip|forget|unless|if|than|scrap|cancel\w*|was|were|had|been|"
    r"usual\w*)\b|n't\b",
    re.IGNORECASE,
)
_CLAUSE = re.compile(r"[.;:!?]")
_BEFORE = 40


def asked_movements(text: str, vocabulary: Vocabulary) -> frozenset[str]:
    """Names of the navigation skills that a text asks for in plain words."""
    if not readable(text):
        return frozenset()
    spelt = variants(text)
    said = {motion for motion, asks in ASKS.items() if any(_asks(one, asks) for one in spelt)}
    return frozenset(
        skill.name for skill in vocabulary.skills_in_role("navigation") if skill.motion in said
    )


def _asks(text: str, asks: re.Pattern[str]) -> bool:
    """Whether a text holds a wording without a word around it that takes it back."""
    for match in asks.finditer(text):
        before = _CLAUSE.split(text[max(0, match.start() - _BEFORE) : match.start()])[-1]
        if not _WITHOUT.search(before) and not _WITHOUT.search(match[0]):
            return True
    return False
