"""The text of a task input as `sequence` takes it apart: places by number, a target in the picture
as VISUAL, stopped engines as ENGINES.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from planner_ft.data.quantities import positions
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading.rows import sequence_words as w
from planner_ft.decoding.constraints.reading.rows import turn_forms as f
from planner_ft.decoding.constraints.reading.rows.asides import without_asides
from planner_ft.decoding.constraints.reading.rows.sequence_forms import in_plain_words
from planner_ft.decoding.constraints.reading.rows.turn_wordings import explained


@dataclass(frozen=True)
class Prepared:
    """A text, the places that its tokens P0, P1 ... stand for, and the whole time that its holds
    may share.
    """

    text: str
    places: tuple[g.Point, ...]
    total: float | None


def prepare(prompt: str, parameters: Mapping[str, Any]) -> Prepared | None:
    """The text without what says nothing of movements; None where it cannot be read clause by
    clause.
    """
    text = _HESITATION.sub(
        " ", w.MOTION.sub("motion", f.plain(prompt, dict(parameters), measured=True))
    )
    stated = [_place(one) for one in f.written_places(prompt)]
    places = [place for place in stated if place is not None]
    if len(re.findall(r"\bP\b", text)) != len(places) or len(places) < len(stated):
        return None
    text = _placed(_BOUNDED.sub(" ", _HEADING_LOCKED.sub(" ", text)), places, parameters)
    text = in_plain_words(explained(without_asides(text)), parameters)
    text = _in_the_unit(text, prompt)
    text = w.TWO_TIMES.sub(_sum_of_times, _WITHOUT_MARK.sub(r"\1 ", _STOP_AND.sub("hold", text)))
    text = w.IN_VIEW.sub(
        " VISUAL ", w.ENGINES_OFF.sub(" ENGINES ", w.CLEARED.sub(" ", w.BUFFERED.sub(" ", text)))
    )
    text = _OFF_FOR.sub(_drift, text)
    text = _FULL.sub(r"D360 \g<noun>", _AT_SPEED.sub(" ", text))
    own = parameters.get("duration")
    total = own if isinstance(own, int | float) else None
    if shared := _SHARED.search(text):
        total = float((shared["t"] or shared["t2"])[1:])
        text = text.replace(shared[0], " ")
    text = re.sub(r"\s+", " ", text)
    if (
        _OTHERWISE.search(text)
        or _ADJACENT.search(text)
        or re.search(r"\b[TL]0(?!\.)\b|\bNo?\d+ T\d", text)
    ):
        return None
    return Prepared(text, tuple(places), total)


def _placed(text: str, places: list[g.Point], parameters: Mapping[str, Any]) -> str:
    """The text with a number for each place: those written in figures, those spelt out, and the
    task's own, which are added to the places.
    """
    number = iter(range(len(places)))
    text = re.sub(r"\bP\b", lambda _match: f"P{next(number)}", text)

    def spelt(match: re.Match[str]) -> str:
        places.append(g.point(float(match["x"]), float(match["y"])))
        return f" P{len(places) - 1} "

    text = _SPELT.sub(spelt, text)
    for name, called in _OWN_PLACES.items():
        value = parameters.get(name)
        if (
            isinstance(value, list)
            and len(value) == 2
            and all(isinstance(one, int | float) for one in value)
        ):
            places.append(g.point(*value))
            text = re.sub(_OWN_PLACE.format(called), rf"\1 P{len(places) - 1} ", text)
    return text


def _in_the_unit(text: str, prompt: str) -> str:
    """ "Six minutes at the lock, then hold for two": a time without its unit has the only one that
    the text names.
    """
    named = [seconds for seconds, unit in _UNITS if unit.search(prompt)]
    if len(named) != 1:
        return text
    return _NO_UNIT.sub(
        lambda match: f"{match['verb'] or ''} T{float(match['n'] or match['m']) * named[0]:g}", text
    )


def _drift(match: re.Match[str]) -> str:
    """ "Engines off for ten minutes" is a drift, where none is spoken of before it."""
    drifting = w.DRIFTING.search(match.string[: match.start()].rpartition(". ")[2])
    return match[0] if drifting else f" drift {match['t']} "


def _sum_of_times(match: re.Match[str]) -> str:
    """ "One minute and thirty seconds" as one time."""
    one, other = float(match["one"]), float(match["other"] or 0)
    if match["bare"]:
        number = float(match["bare"])
        unit = 3600 if one % 3600 == 0 else 60 if one % 60 == 0 else 0
        return f"T{one + number * unit / 60:g}" if unit and one else match[0]
    joined = (one % 3600 == 0 and other % 60 == 0 and other < 3600) or (
        one % 60 == 0 and other < 60
    )
    return f"T{one + other:g}" if joined and one else match[0]


def _place(text: str) -> g.Point | None:
    found = list(dict.fromkeys((x, y) for x, y, _start, _end in positions(text)))
    return g.point(*found[-1]) if found else None


_UNITS = (
    (1, re.compile(r"(?:\d|\b)(?:s|secs?|seconds?)\b", re.IGNORECASE)),
    (
        60,
        re.compile(
            r"(?:\d ?|\b)(?:mins?|minutes?)\b|\d ?m(?=[ ,.;](?:hold|station|there))", re.IGNORECASE
        ),
    ),
    (3600, re.compile(r"(?:\d ?|\b)(?:h|hrs?|hours?)\b", re.IGNORECASE)),
)
_NO_UNIT = f.compiled(
    r"\b(?P<verb>(?:hold|stay|wait|drift|float|remain|pause|loiter|keep station|hold position)(?:"
    r" (?:there|here|position|station|still|adrift))*(?: for|"
    r" another)?|another|"
    r"a further) N(?P<n>[1-9]\d?)(?= (?:more|there|here|longer|then|and|within|in a|before)\b|"
    r" ?[.,;:]| ?$)|(?<=\bthen )N(?P<m>[1-9]\d?)(?= at P\d)"
)
_OTHERWISE = f.compiled(
    r"\b(?:actually|too (?:much|far|long|little)|plenty|second thoughts?|instead|"
    r"series|strike|put in|(?:last|final) it first|make (?:that|it) (?:[a-z]+ )?[NTLDC][\d.]*|"
    r"or make|"
    r"or rather|leave|P\d+ (?:last|in the middle)|vice versa|"
    r"other way)\b"
)
_OFF_FOR = f.compiled(rf"\bENGINES ?[,:]? ?(?:for )?(?P<t>{w.T})")
_HESITATION = f.compiled(r"\b(?:um+|uh+|erm?|you know|okay so|ok so)\b,?|\blike (?=[TDNL]\d)")
_HEADING_LOCKED = f.compiled(
    r"\bwith (?:the |her |your )?(?:heading|bow|nose|yaw)(?: (?:kept|held|being))?"
    r" (?:locked|fixed|free|unlocked)\b"
)
_BOUNDED = f.compiled(
    r"\b(?:(?:she|it|you|the boat) )?(?:(?:has|have|is|are) to |must |should |shall |will"
    r" )?(?:always |strictly )?(?:stay|remain|"
    r"keep)(?:ing)? (?:always |strictly |well )?(?:inside|within|in)"
    r" (?:(?:the|this|these|that|a|its|your) )?(?:(?:given|same|safety|stated)"
    r" )?(?:box|fence|polygon|boundary|boundaries|limits|area|zone|rectangle|"
    r"perimeter|corners|region|triangle)\b(?: with corners)?|"
    r"\b(?:(?:she|it|you|the boat) )?(?:(?:has|have|is|are) to |must |should |shall )?(?:always"
    r" |strictly )?(?:stay|remain|keep)(?:ing)? (?:always |"
    r"strictly |well )?(?:inside|within)(?= ?[,.;:]| and\b|$)"
)
"""A boundary, whose corners are taken out before."""
_WITHOUT_MARK = f.compiled(
    r"(\b(?:(?:pan|turn|nudge|yaw|swing|rotate)(?: in place| on the spot)?(?=:)|(?:sweeping"
    r" turn|wide turn|arc|curve|bend|sweep)(?: to (?:port|"
    r"starboard|the left|the right)| clockwise|"
    r" anticlockwise| counter-?clockwise)?(?=, ?(?:[DL]\d|radius|through|of|on a|at a))))[:,]"
)
_STOP_AND = f.compiled(r"\b(?:stop|halt|pause|wait|finish|end) (?:and hold|(?:in|with) a hold)\b")
_SPELT = f.compiled(
    r"\bx ?[=:]? ?N(?P<x>-?\d[\d.]*?)[ ,;]*(?:and )?y ?[=:]? ?N(?P<y>-?\d+(?:\.\d+)?)"
)
_OWN_PLACE = (
    r"((?:\b(?<!back"
    r" )(?:go|drive|proceed|sail|head|run|transit|move|come|get|steam|approach|out|up|over|on|down|way|course|navigate|(?:bring|take|"
    r"get) (?:her|yourself|"
    r"it|the (?:boat|usv|vessel)))(?: (?:over|up|out|in|along|straight|down|on))?|(?:^ ?|[.;:,]"
    r" |\bthen |\band |\bnext |\bfinally ))(?: ?to| for|"
    r" towards)) the "
    r"(?:(?:task's|given|planned|stated|set) )*{}(?: (?:position|point|location|place))?(?: of the"
    r" (?:cable|pipeline|pipe|track|run|"
    r"route)(?! track))?(?! (?:of|point|is|for|and back|that|which|at|in|on|itself))\b"
)
_OWN_PLACES = {
    "target_position": "target",
    "goal_position": "(?:goal|berth|docking|destination)",
    "start": "(?:start|starting)",
}
"""The place of the task."""
_FULL = f.compiled(
    r"\b(?:an? |one )?(?:full|complete|whole) (?:circle as )?(?:a |one )?(?P<noun>(?:sweeping|wide)"
    r" (?:turn|circle)|arc|sweep)\b"
)
_AT_SPEED = f.compiled(r"(?:,? ?\bat|,) X(?= |$|[.,;])")
_SHARED = f.compiled(
    r"\b(?:split|divide|share|spread) (?:the |these |your |up the )*(?P<t>T[\d.]+)(?: (?:in"
    r" two|equally|evenly|up|between (?:the |these )?(?:two|"
    r"N2)(?: \w+)?))*:?|"
    r"(?:^ ?|[.;] )the (?P<t2>T[\d.]+) (?:is|are|will be) (?:shared|split|divided)[^.;:]*[:;.]"
)
_ADJACENT = f.compiled(
    r"\bN-?[\d.]+ ?,? ?-? ?N-\d|(?:\b(?:to|for|at|reach) |: |^)N-?[\d.]+ ?, ?N-?[\d.]+(?!"
    r" ?(?:,|and|then|,? and) ?[ND])(?=[ .,;]|$)|\bN-?[\d.]+ N-?[\d.]+"
)
"""Two numbers that may be a place."""
