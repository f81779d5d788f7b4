"""The sizes of an area, written out for the readers of grids: extents along an axis or between two
directions, and figures without a unit.

"40 m in x and 24 m in y", "80 m east to west by 30 m north to south" and "25 x 15, lane spacing 5"
become "40 m wide and 24 m long" and "25 m by 15 m, lane spacing 5 m". Corners that are told by up
and down and by left and right get their names as well.
"""

from __future__ import annotations

import re

_NUMBER = r"\d+(?:\.\d+)?"
_METRES = r" ?(?:m|met(?:re|er)s?)\b"
_X = (
    r"(?:east(?:[ -]to)?[ /-](?:and[ -])?west|west(?:[ -]to)?[ /-](?:and[ -])?east|E ?[-/]? ?W|W"
    r" ?[-/] ?E|(?:the )?x(?:[- ](?:axis|direction))?)"
)
_Y = (
    r"(?:north(?:[ -]to)?[ /-](?:and[ -])?south|south(?:[ -]to)?[ /-](?:and[ -])?north|N ?[-/]?"
    r" ?S|S ?[-/] ?N|(?:the )?y(?:[- ](?:axis|direction))?)"
)
IN_LETTERS = (
    (
        re.compile(
            r"(?<![\w\"'])(?:[EW] ?[-/] ?[EW]|EW)(?![\w\"'])|(?<![\w\"'])(?:e-w|w-e)(?![\w\"'])"
        ),
        "east-west",
    ),
    (
        re.compile(
            r"(?<![\w\"'])(?:[NS] ?[-/] ?[NS]|NS)(?![\w\"'])|(?<![\w\"'])(?:n-s|s-n)(?![\w\"'])"
        ),
        "north-south",
    ),
)
"""The two ways that lanes can run, in letters."""
_EXTENT = (
    r"(?P<size>{number}{metres})[ ,]*(?:\(? ?(?:in|along|from)? ?{way} ?\)?|measured {way})(?="
    r" ?[.,;)]| (?:and|by|x|with|in|at|centred|around|about|round)\b|$)"
)
WIDE = re.compile(_EXTENT.format(number=_NUMBER, metres=_METRES, way=_X), re.IGNORECASE)
LONG = re.compile(_EXTENT.format(number=_NUMBER, metres=_METRES, way=_Y), re.IGNORECASE)
SIZED = re.compile(
    r"\b(?P<name>width|length|(?:(?:lane|line|track|leg) )?spacing|half[- ]side)(?P<is>\s?(?:is"
    rf" |of |=|:)?\s?)(?P<size>{_NUMBER})\b"
    r"(?! ?(?:m\b|k?m|met|ft|feet|foot|yd|yards?|fathoms?|cables?|deg|°|%|\.\d|x\b|by\b))",
    re.IGNORECASE,
)
"""A size without a unit."""
BY = re.compile(
    rf"(?<![\w.,-])(?<!spacing )(?P<one>{_NUMBER}) ?(?:x|×|by) ?(?P<two>{_NUMBER})(?![\w.]\d|\w)(?!"
    r" ?(?:k?m\b|met|ft|feet|yd|yards?|grid of|lanes|lines|"
    rf"points))",
    re.I,
)
"""Width and length without a unit: "25 x 15"."""
BY_METRES = re.compile(
    rf"(?<![\w.,-])(?P<one>{_NUMBER}) ?(?:x|×) ?(?P<two>{_NUMBER})(?={_METRES})", re.IGNORECASE
)
AXIS_BEFORE = re.compile(
    r"\b((?:east|west|north|south)[ -](?:to[ -]|and[ -])?(?:east|west|north|south)|[xy](?:[-"
    rf" ]axis)?|lanes?|lines?),? (?=(?:every |at )?{_NUMBER}{_METRES})",
    re.I,
)
"""What lanes run along, right before a figure that is no coordinate."""
HANDS = {
    "top": "north",
    "upper": "north",
    "bottom": "south",
    "lower": "south",
    "left": "west",
    "right": "east",
}
CORNER = re.compile(
    r"\b(top|upper|bottom|lower)[ -](left|right)(?:[ -]hand)?\b(?! (?:of (?:the"
    r" )?(?:picture|frame|image|screen)))",
    re.IGNORECASE,
)
EDGE = re.compile(
    r"\b(top|upper|bottom|lower|left|right)(?:[ -]?hand)?(?:most)?"
    r" (edge|side|end|lane|line|boundary)\b(?! of (?:the )?(?:picture|frame|image|screen))",
    re.I,
)
FROM_TOP = re.compile(
    r"\bfrom (?:the )?(top|bottom|left|right)\b(?= (?:to|down|up|upwards?|downwards?)\b|[.,;]|$)",
    re.IGNORECASE,
)
UPWARDS = re.compile(
    r"\b((?:work|step|mov|progress|go)\w*) (?:(?:your|its|the) way )?(up|down)(?:wards?)?(?: the"
    r" (?:area|box|grid|patch|block))?(?=[.,;]|$| (?:from there|"
    r"lane|line))",
    re.I,
)


def extents(text: str) -> str:
    """The text with its sizes and corners written out."""
    for letters, words in IN_LETTERS:
        text = letters.sub(words, text)
    text = LONG.sub(r"\g<size> long", WIDE.sub(r"\g<size> wide", text))
    text = SIZED.sub(r"\g<name>\g<is>\g<size> m", text)
    text = BY_METRES.sub(r"\g<one> m by \g<two>", BY.sub(r"\g<one> m by \g<two> m", text))
    text = CORNER.sub(lambda match: f"{HANDS[match[1].lower()]}-{HANDS[match[2].lower()]}", text)
    text = EDGE.sub(lambda match: f"{HANDS[match[1].lower()]} {match[2]}", text)
    text = FROM_TOP.sub(lambda match: f"from the {HANDS[match[1].lower()]} end", text)
    text = UPWARDS.sub(
        lambda match: f"{match[1]} {'north' if match[2].lower() == 'up' else 'south'}", text
    )
    return AXIS_BEFORE.sub(r"\1, at ", text)
