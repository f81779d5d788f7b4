"""A straight way with its halfway point: "from [0, 0] to [60, 0] with a stop halfway", "run to the
halfway point of the track, then on to its end".

The way leads from one stated place to another, or is the task's own track. None where anything else
is said that could lead somewhere.
"""

from __future__ import annotations

import re
from typing import Any

from planner_ft.data.numerals import signed
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading.paths.itinerary import plain_text, without_fences
from planner_ft.decoding.constraints.reading.paths.shapes import Point, stated_lengths

Path = tuple[Point, ...]
_NUMBER = r"[-−–]?\d+(?:\.\d+)?"
_PLACE = rf"[\[(]\s*{_NUMBER}\s*[,;]\s*{_NUMBER}\s*[\])]"
PLACE = re.compile(rf"[\[(]\s*(?P<x>{_NUMBER})\s*[,;]\s*(?P<y>{_NUMBER})\s*[\])]")
OWN = re.compile(
    r"\b(?P<the>(?:the |its )?(?:(?:given|task['’]s|stated)"
    r" )?)(?P<what>target|goal|berth|start(?:ing)?) (?:position|point|place)\b(?! (?:of|at|is)\b)",
    re.IGNORECASE,
)
_OWN_NAMES = {
    "target": ("target_position",),
    "goal": ("goal_position",),
    "berth": ("goal_position",),
    "start": ("start",),
    "starting": ("start",),
}
_MIDDLE = (
    r"(?:(?:the |its )?(?:half-?way (?:point|mark|position|spot)|mid-?point|mid-?way"
    r" (?:point|mark)|point half-?way|middle(?: point)?)|half-?way|mid-?way)"
)
MIDDLE_OF = re.compile(
    rf"\b{_MIDDLE}(?: of (?:the |a )?(?:line|leg|way|run|stretch))?(?: (?:along )?(?:the line"
    rf" )?(?:between|from))? (?P<one>{_PLACE}) (?:and|to) "
    rf"(?P<two>{_PLACE})",
    re.IGNORECASE,
)
MIDDLE = re.compile(
    rf"\b{_MIDDLE}(?: (?:of|along|on|down) (?:the |its |that |this"
    r" )?(?:(?:max(?:imum)?|full|whole|given|set|stated|planned) )*(?:distance|length|track|line|"
    r"leg|way|run|route|cable|pipe\w*|stretch|transect|course|it)"
    r"| there| along| between (?:them|the two)| out)?\b|\b(?:for |over )?half (?:of )?(?:the |its"
    r" )?(?:(?:max(?:imum)?|full|whole|given|set|stated|planned) "
    r")*(?:distance|length|way|track|run|route)\b",
    re.IGNORECASE,
)
TO_END = re.compile(
    r"\b(?:to|at|reach(?:ing)?|for|do|finish|run|complete|over|along) (?:the |its"
    r" )?(?:(?:very|far|other|final) )*(?:end(?:point| point)?|full (?:distance|"
    r"length|way)|maximum(?: distance)?|(?:second|other|remaining) half|rest(?: of (?:it|the "
    r"(?:way|track|run|line|cable|distance)))?)\b|\b(?:all the way|the rest of the"
    r" (?:way|distance|track)|to the full)\b|\bto (?:its|the) end\b",
    re.IGNORECASE,
)
TO_START = re.compile(
    r"\b(?:back|return\w*)(?: (?:again|straight|along it|the same way|directly))* to (?:the |its"
    r" |your )?(?:start\w*|beginning)(?: (?:point|position))?\b",
    re.IGNORECASE,
)
ELSEWHERE = re.compile(
    r"\b(?:home|base|twice|laps?|again|port|starboard|left|right|off"
    r" (?:it|the)|abeam|parallel|beside|grid|square|lanes|zig-?zag|arc|circle|if|unless|"
    r"instead|rather|sorry|lighter|quarter|third|"
    r"every|each|stations|turn (?:round|back)|retrace|there and back|north of|south of|east of|west"
    r" of|ring|corner\w*|drift\w*|from there|reverse\w*|"
    r"backwards|far end|slow\w*|speed)\b",
    re.IGNORECASE,
)
SCOPE = re.compile(
    r"\b(?:until|till|up to|as far as|only (?:on|to|until)|before|after|past|beyond|from|between|on"
    r" the (?:first|second)|in the|for the|during the|the "
    r"first|over the|on the|along the)(?: \w+){0,2} $",
    re.IGNORECASE,
)
"""Before a half that is only told for what is done there."""


def with_own_places(record: dict[str, Any]) -> dict[str, Any] | None:
    """The input with coordinates in place of the words for the task's own places; None where there
    are no such words.
    """
    given, prompt = record.get("parameters"), str(record.get("prompt", ""))
    parameters = given if isinstance(given, dict) else {}

    def place(match: re.Match[str]) -> str:
        value = next(
            (parameters[name] for name in _OWN_NAMES[match["what"].lower()] if name in parameters),
            None,
        )
        known = (
            isinstance(value, list)
            and len(value) == 2
            and all(isinstance(one, int | float) for one in value)
        )
        return f"[{value[0]:g}, {value[1]:g}]" if known and value else match[0]

    text = OWN.sub(place, prompt)
    return {**record, "prompt": text} if text != prompt else None


def with_middles(text: str) -> str:
    """The text with coordinates for the middle between two stated places."""

    def middle(match: re.Match[str]) -> str:
        one, two = (_point(PLACE.fullmatch(match[name])) for name in ("one", "two"))
        x, y = g.point((one[0] + two[0]) / 2, (one[1] + two[1]) / 2)
        return f"[{x:g}, {y:g}]"

    return MIDDLE_OF.sub(middle, text)


def _point(match: re.Match[str] | None) -> Point:
    assert match
    return g.point(*(signed(match[axis]) for axis in "xy"))


def read_halfway(record: dict[str, Any]) -> Path | None:
    """The waypoints of such a way."""
    given, prompt = record.get("parameters"), str(record.get("prompt", ""))
    parameters = given if isinstance(given, dict) else {}
    if len(prompt) > LONGEST:
        return None
    text = without_fences(plain_text(prompt))
    middles, places = [*MIDDLE.finditer(text)], [*PLACE.finditer(text)]
    if (
        len(middles) != 1
        or ELSEWHERE.search(PLACE.sub(" ", TO_START.sub(" ", text)))
        or SCOPE.search(re.split(r"[.;,] ", text[: middles[0].start()])[-1])
    ):
        return None
    if len(places) == 2:
        return _between(text, places, middles[0])
    return _on_track(text, places, middles[0], parameters)


def _between(text: str, places: list[re.Match[str]], middle: re.Match[str]) -> Path | None:
    """From one place over the middle to the other."""
    one, two = map(_point, places)
    joined = text[places[0].end() : places[1].start()]
    led = re.search(
        r"\b(?:from|at|leav\w+|start\w*)\s+(?:the [\w ]{2,30} at )?$",
        text[: places[0].start()],
        re.IGNORECASE,
    )
    if (
        one == two
        or not led
        or re.search(r"[.;]\s", joined)
        or not re.search(r"\b(?:to|for)\s+(?:the [\w ]{2,30} at )?$", joined, re.IGNORECASE)
    ):
        return None
    if any(
        not re.search(
            r"margin|clear|within|radius|circle|off\b",
            text[max(0, start - 25) : end + 25],
            re.IGNORECASE,
        )
        for _value, start, end in stated_lengths(text, [])
    ):
        return None
    at = g.point((one[0] + two[0]) / 2, (one[1] + two[1]) / 2)
    return (one, at, two)


def _on_track(
    text: str, places: list[re.Match[str]], middle: re.Match[str], parameters: dict[str, Any]
) -> Path | None:
    """Along the task's own track."""
    start, heading, length = (parameters.get(name) for name in ("start", "heading", "max_dist"))
    if (
        not isinstance(start, list)
        or not isinstance(heading, int | float)
        or not isinstance(length, int | float)
    ):
        return None
    if any(_point(place) != g.point(*start) or place.start() > middle.start() for place in places):
        return None
    bearings = re.findall(r"\b(?:bearing|heading|course)(?: of)? (\d{1,3})\b", text, re.IGNORECASE)
    if any(float(said) != heading for said in bearings) or stated_lengths(PLACE.sub(" ", text), []):
        return None
    behind = text[middle.end() :]
    ends, back = TO_END.search(behind), TO_START.search(behind)
    if (ends and back) or TO_END.search(text[: middle.start()]):
        return None
    path = [g.point(*start), g.offset(g.point(*start), heading, length / 2)]
    path += (
        [g.offset(g.point(*start), heading, length)] if ends else [g.point(*start)] if back else []
    )
    return tuple(path)
