"""Where along the waypoints of one grid or square the vehicle holds, turns or drifts: at each of
them, at the corners alone, behind each lane, at the end.

None where the input asks for none of it, or where a sentence that does so does not say where.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from planner_ft.data.task.geometry import Point

Halts = frozenset[str]
"""Some of "each", "corners", "mid-sides", "lanes" and "end"."""

MOVES = re.compile(
    r"\b(?:hold(?!\w* (?:the |your |its |her"
    r" )?(?:heading|bow|course|nose|camera|lens))\w*|holding|wait\w*|paus\w*|loiter\w*|remain\w*|linger\w*|"
    r"stay\w*(?! (?:\w+ ){0,2}(?:inside|within|"
    r"clear|away|out of|off|locked|on|in))|(?:keep|on) station|station[-"
    r" ]?keep\w*|stationary|turn\w*|rotat\w*|swing\w*|spin\w*|pivot\w*|nudg\w*|pan(?:s|"
    r"ning)?|drift\w*|float\w*|arcs?|"
    r"fac(?:e|ing) (?:\d|north|south|east|west)|bow to|steady|(?<!each )(?<!every )(?<!all )(?<!the"
    r" )stops?(?= (?:at|of|for|and|on)\b)|stopping|halt(?:s|"
    r"ing)?|settle\w*)\b",
    re.IGNORECASE,
)
"""Words of a step that goes to no waypoint."""
SAME_HOLD = re.compile(
    r"\b(?:in|during|on|for|throughout|while|over)"
    r" (?:this|that|these|those|the|each|every|all|both)(?: (?:of the )?\w+)?(?: \w+)?"
    r" (?:hold|wait|pause|"
    r"stay|turn|drift)\w*\b|"
    r"\b(?:while|when|whilst|whenever) (?:\w+"
    r" )?(?:hold|wait|paus|stay|turn|drift)\w*|\b(?:the|that|this|each|every|these|those) (?:\w+"
    r" )?(?:hold|wait|"
    r"pause|turn|drift)s?\b(?! (?:to|of|for) )|"
    r"\bno (?:hold|turn|wait|stop)\w*|\b(?:do not|don['’]t|without|never|not|nor) (?:\w+"
    r" )?(?:hold|stop|wait|turn|paus)\w*|\bas it turns\b|\bturn(?:s|"
    r"ing)? out\b|"
    r"\bhold(?:ing)? (?:it|that|this|the line)\b|\bturn(?:ing|s)? (?:on|off)\b|\bin turn\b|\bby"
    r" turns?\b|\bturning points?\b|\bclockwise turn\b",
    re.IGNORECASE,
)
"""The hold as a thing that was spoken of, none, and other senses."""
_ALL = (
    r"(?:at|on|in|after|upon|reaching|behind|for|of) (?:each|every|any|all|the)(?:"
    r" (?:single|one|of|the|its|four|eight|4|8))*"
)
_ALL_TOLD = (
    r"(?:at|on|in|after|upon|reaching|behind|for) (?:each|every|all)(?:"
    r" (?:single|one|of|the|its|four|eight|4|8))*"
)
CORNERS = re.compile(
    rf"\b{_ALL} (?:corners?(?! of)|corner (?:points?|waypoints?))\b|\b(?:corners?|four corners)"
    r" (?:only|alone)\b",
    re.IGNORECASE,
)
MID_SIDES = re.compile(
    rf"\b{_ALL} (?:mid-?sides?|mid-?points?(?: of (?:the|each|every) sides?)?|middles? of"
    r" (?:the|each|every|all)(?: four)? sides?)\b",
    re.IGNORECASE,
)
EACH = re.compile(
    rf"\b{_ALL_TOLD} (?:way-?points?|points?|stops?|stations?|positions?|(?:one|two|\d)? ?(?:of"
    r" them)|leg|places?)\b|\beach time\b|\bafter each\b(?=[.,;]|$)",
    re.IGNORECASE,
)
LANES = re.compile(
    r"\b(?:(?:at|on) the (?:far )?ends? of (?:each|every|all the|the)"
    r" (?:lane|line|leg|run|track|transect)s?|(?:after|behind|between|"
    r"on finishing) (?:each|every|all|the) (?:lane|line|leg|run|track|transect)s?)\b",
    re.IGNORECASE,
)
END = re.compile(
    r"\b(?:when|once|after|as soon"
    r" as|upon|on)\b[^.;]*\b(?:last|finish\w*|done|complet\w*|end(?:ed|s)?|through|over|(?:the|that|this|whole)"
    r" (?:grid|"
    r"square|survey|round|lanes?|area|pattern|circuit|"
    r"sounding|work)|that|this)\b|"
    r"\b(?:then|finally|lastly|at the end|in the end|to finish|afterwards|after that|followed"
    r" by|end(?:ing)? with|finish(?:ing)? with|conclud\w+)\b|"
    r"\b(?:at|on) the (?:very )?(?:last|final) (?:way-?point|point|corner|one|stop)\b|\bwhere"
    r" (?:it|the \w+) ends\b",
    re.IGNORECASE,
)
SENTENCE = re.compile(r"[.;!](?:\s|$)|,? (?:and )?(?=then\b|finally\b|lastly\b|afterwards\b)")


def read_halts(text: str) -> Halts | None:
    """At which waypoints the vehicle does something else than go on."""
    found: set[str] = set()
    for sentence in SENTENCE.split(text):
        if not MOVES.search(SAME_HOLD.sub(" ", sentence)):
            continue
        places = {
            name
            for name, words in (
                ("corners", CORNERS),
                ("mid-sides", MID_SIDES),
                ("lanes", LANES),
                ("each", EACH),
            )
            if words.search(sentence)
        }
        places = places or ({"end"} if END.search(sentence) else set())
        if len(places) != 1:
            return None
        found |= places
    return frozenset(found) or None


def halts_at(halts: Halts, path: Sequence[Point], done: int) -> bool | None:
    """Whether something is done behind the first `done` waypoints of a path; None where it may
    be.
    """
    if not done:
        return False
    sides = [{point[axis] for point in path} for axis in (0, 1)]
    point = path[done - 1]
    corner = all(point[axis] in (min(sides[axis]), max(sides[axis])) for axis in (0, 1))
    due = (
        "each" in halts
        or ("corners" in halts and corner)
        or ("mid-sides" in halts and not corner)
        or ("lanes" in halts and done % 2 == 0)
    )
    return (
        due or done == len(path)
        if "end" in halts or due
        else None
        if done == len(path) and "lanes" in halts
        else False
    )
