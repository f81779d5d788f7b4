"""Areas and squares told otherwise than by a centre and the sizes of their kind, written out for
the readers of grids and squares.

"South-west corner at [0, 0] and north-east corner at [30, 50]" becomes a centre with width and
length, "sides of 24 m" a radius of 12 m, "around home" the coordinates of home. Sides and corners
of a square at which only something is done or kept ("at the three points of the west side") are
taken out: they tell no beginning.
"""

from __future__ import annotations

import re
from typing import Any

from planner_ft.data.numerals import signed
from planner_ft.data.quantities import quantities
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths.shapes import (
    Point,
    named_corner,
    named_sizes,
    stated_sizes,
)

_NUMBER = r"[-−–]?\d+(?:\.\d+)?"
_PAIR = rf"[\[(]\s*(?:{_NUMBER})\s*[,;/]\s*(?:{_NUMBER})\s*[\])]"
PAIR = re.compile(rf"[\[(]\s*(?P<x>{_NUMBER})\s*[,;/]\s*(?P<y>{_NUMBER})\s*[\])]")
HOME = re.compile(
    r"\b(?P<of>around|round|about|over|centred (?:on|at|in|around|about)|centered"
    r" (?:on|at|in|around|about)|(?:cent(?:re|er)|middle)(?: is| at|:| =)*) "
    r"(?:home|the origin)\b(?! (?:port|berth|leg|side))",
    re.IGNORECASE,
)
IN_BRACKETS = re.compile(r"\((width|length)\)", re.IGNORECASE)
_CORNER = r"(?:(?:north|south)[ -]?(?:east|west)(?:ern|erly)?|NE|NW|SE|SW)"
_AT = r"\s*(?:is |are |lies |lying |sits )?(?:at|on|=|:|is)?\s*"
NAMED = re.compile(
    r"\b(?:(?:has|have|having|with|by|from|between) )?(?:(?:the|its|a|one|their)"
    rf" )?(?P<corner>{_CORNER})(?: corners?)?{_AT}(?P<pair>{_PAIR})",
    re.IGNORECASE,
)
"""A corner with where it is."""
BEHIND = re.compile(
    rf"(?P<pair>{_PAIR}) ?\(?(?:is |being |as |at |= ?)?(?:the |its )?(?P<corner>{_CORNER})(?:"
    r" corner)?\)?(?![ -]\w)",
    re.IGNORECASE,
)
"""A place that is called a corner behind it: "[0, 0] (south-west)"."""
OPPOSITE = re.compile(
    r"\b(?:opposite|diagonal\w*(?: opposite)?|two|outer|both) corners?(?: of (?:it|the"
    rf" \w+))?{_AT}(?P<one>{_PAIR})(?:,| and|;| to|,? with| /| "
    rf"-)*\s*(?P<two>{_PAIR})"
    rf"(?! ?,? ?(?:and )?{_PAIR})|"
    rf"\b(?:area|box|block|rectangle|patch|field|plot|basin|polygon|square)(?: (?:that|which)"
    rf" (?:goes|runs|reaches|stretches|extends|lies|is))?(?: "
    rf"(?:goes|runs|reaches|"
    rf"stretches|extends|lies|is|spans))? "
    rf"(?:from|between|of) (?P<three>{_PAIR}) (?:up to|to|and|across to|over to)"
    rf" (?P<four>{_PAIR})(?! ?,? ?(?:and )?{_PAIR})",
    re.IGNORECASE,
)
BEGINNING = re.compile(
    r"\b(?:start\w*|begin\w*|enter\w*|entry|commenc\w*|first|from|in|open\w*)\b[^.;,]*$",
    re.IGNORECASE,
)
"""Before a corner that is said to be where the grid begins."""
KEEP_IN = re.compile(
    r"\b(?:fence|bound\w*|limit\w*|stay\w*|inside|leav\w+|within|keep\w*)\b", re.IGNORECASE
)

ROW = re.compile(
    rf"(?P<row>{_PAIR}(?:(?:\s*,\s*|\s*;\s*|\s+)(?:and |to )?{_PAIR}){{3}})", re.IGNORECASE
)
AREA_BEFORE = re.compile(
    r"\b(?:area|box|block|rectangle|patch|field|plot|basin|corners?|cover|sound|survey|mow|map)\b(?:"
    r" (?:with|whose|of|at|the|its|four|has|having|"
    r"corners?|is|are|by|between|in|formed))*[\s:,(\[]*$",
    re.IGNORECASE,
)
_AXIS = (
    r"(?:from |between )?{axis} ?=? ?(?P<{axis}1>{number}) (?:to|and|up to) (?:{axis} ?=?"
    r" ?)?(?P<{axis}2>{number})"
)
RANGES = re.compile(
    rf"\b{_AXIS.format(axis='x', number=_NUMBER)}(?:,| and|, and| by)?"
    rf" {_AXIS.format(axis='y', number=_NUMBER)}(?![\d.])",
    re.IGNORECASE,
)
"""An area by the values of both coordinates."""
SQUARE_OF = re.compile(
    r"\b(?:an? |the )?square (?:area |box |patch |block )?(?:of |with |, )?(?:sides of"
    r" )?(?P<one>\d+(?:\.\d+)? ?(?:m|met(?:re|er)s?|yards|feet))(?: "
    r"(?:sides?|side[ -]?length|edge[ -]?length|a side|on a side|each side))\b|"
    r"\b(?P<two>\d+(?:\.\d+)?)[ -]?(?P<unit>m|met(?:re|er)s?)[ -]square\b(?! met)",
    re.IGNORECASE,
)

CLOSING = re.compile(
    r"\b(?:(?:go|come|run|return|finish|finishing|end|ending|get|be|arrive|stop)\w* (?:up |right"
    r" )*(?:back )?(?:(?:to|at|on|in) )?(?:the (?:very "
    r")?(?:same )?(?:way-?point|point|place|spot|corner) )?"
    r"(?:that |from |at )?where (?:you|it|she|we|the square) (?:began|started|begins?|starts?|set"
    r" out)(?: (?:from|at|out))?|"
    r"(?:(?:go|come|run|return|get|and|then) )*back (?:to|at|on) (?:the|its) (?:first|start\w*)(?:"
    r" (?:way-?point|point|corner|one|of them))?|"
    r"(?:return|finish|end)\w* (?:to|at|on|in) (?:the|its) (?:very )?(?:first|start\w*)(?:"
    r" (?:way-?point|point|corner|one|of them))?)\b",
    re.IGNORECASE,
)
"""Words for a square that ends at its first waypoint."""
FIRST_DUE = re.compile(
    r"\b(?:first|beginning|starting|start|begin)"
    r" (?:(?:way-?point|point|one|stop|is|being|lies|the|with|at|on|from) )*(?:due |to the"
    r" )?(?P<way>north|"
    r"south|east|west)(?: of (?:it|the [\w -]+?|him))?(?=[.,;]|$| (?:and|then)\b)",
    re.IGNORECASE,
)
"""The first waypoint by its direction from the middle."""
SIDE_LENGTH = re.compile(
    r"\b(?:with |whose |of |having |has |each |every |all |its |the |four |a )*"
    r"(?:side[ -]?lengths?|edge[ -]?lengths?|length of (?:the |its |each |a"
    r" )?sides?|sides?|edges?)(?: length)?(?: (?:of|is|are|being|measur\w+|each|to "
    r"be))*\s*[:=]?\s*$",
    re.IGNORECASE,
)
"""Before the length of a square's side."""
SIDE_BEHIND = re.compile(
    r"\s?-?(?:long )?(?:(?:side[ -]?|edge[ -]?)length\b|(?:long )?sides\b|edges\b|(?:long"
    r" )?(?:on|along) (?:a|each|every|the|its) side\b|a side\b|per "
    r"side\b|from side to side|"
    r"(?:from )?corner to corner)",
    re.IGNORECASE,
)
HALF = re.compile(
    r"\b(?:half|from|middle|mid-?\w*|first|start\w*|begin\w*|east|west|north|south|centre|center|to)\b[^.;,]{0,20}$",
    re.IGNORECASE,
)
_SIDE = r"(?:north|south|east|west)(?:ern)?"
_DONE_AT = (
    r"(?:only )?(?:at|on|along|over|for|abeam of|while on|passing|off) (?:only )?(?:all |each of"
    r" |both |any of )?(?:the |its )?(?:(?:three|two|four|3|2|"
    r"4|five|one) )?"
    rf"(?:{_SIDE} )?(?:(?:way-?points?|points?|corners?|stops?|positions?|ones?|stations?)"
    r" ?(?:of|on|along|at|in) (?:the |its )?)?"
)
ON_SIDE = re.compile(
    rf"\b{_DONE_AT}(?:{_CORNER}|{_SIDE})["
    r" -](?:sides?|edges?|corners?|waypoints?|points?|half|leg)\b",
    re.IGNORECASE,
)
CLAUSES = re.compile(r"[.;!?](?:\s|$)")
BEGINS = re.compile(
    r"\b(?:start\w*|begin\w*|first|enter\w*|entry|commenc\w*|from|opening|clock-?wise|anti\w*|counter\w*|go"
    r" round|finish\w*|end\w*|middle of the|only "
    r"(?:half|the (?:four|corners)))\b",
    re.IGNORECASE,
)
"""Words of a sentence that tells how the square is run."""


def areas(text: str, pattern: str, parameters: dict[str, Any], home: Point) -> str:
    """The text of a grid or of a square with its centre and sizes written out."""
    if pattern not in ("lawnmower", "square"):
        return text
    text = IN_BRACKETS.sub(lambda said: "wide" if said[1].lower() == "width" else "long", text)
    text = HOME.sub(lambda match: f"{match['of']} {_written(home)}", text)
    if pattern == "lawnmower":
        return _with_centre(SQUARE_OF.sub(_both_sides, text), parameters)
    if w.SQUARE.search(text):
        text = FIRST_DUE.sub(
            r"first the middle of the \g<way> side", CLOSING.sub(", and close it", text)
        )
    return _without_sides(_with_radius(text))


def _both_sides(square: re.Match[str]) -> str:
    """A square area by width and length."""
    side = square["one"] or f"{square['two']} {square['unit']}"
    return f"{side} by {side}"


def _written(point: Point) -> str:
    return f"[{point[0]:g}, {point[1]:g}]"


def _point(pair: str) -> Point:
    match = PAIR.fullmatch(pair.strip())
    assert match
    return g.point(*(signed(match[axis]) for axis in "xy"))


def _with_centre(text: str, parameters: dict[str, Any]) -> str:
    """An area that is told by corners, by its centre."""
    row, ranges = ROW.search(text), RANGES.search(text)
    if (
        row
        and len(PAIR.findall(text)) == 4
        and AREA_BEFORE.search(text[: row.start()])
        and not KEEP_IN.search(text)
    ):
        corners_of = [_point(match[0]) for match in PAIR.finditer(row["row"])]
        xs, ys = sorted({x for x, _y in corners_of}), sorted({y for _x, y in corners_of})
        if len(xs) == len(ys) == 2 and len(set(corners_of)) == 4:
            return _between(text, (xs[0], ys[0]), (xs[1], ys[1]), row.start(), row.end())
    if ranges and not PAIR.search(text) and not KEEP_IN.search(text):
        x1, x2, y1, y2 = (signed(ranges[name]) for name in ("x1", "x2", "y1", "y2"))
        return _between(text, g.point(x1, y1), g.point(x2, y2), ranges.start(), ranges.end())
    named = sorted([*NAMED.finditer(text), *BEHIND.finditer(text)], key=lambda match: match.start())
    corners = {match["corner"].lower(): match for match in named}
    if len(PAIR.findall(text)) == 2 and len(named) == 2 and len(corners) == 2:
        return _between(
            text,
            _point(named[0]["pair"]),
            _point(named[1]["pair"]),
            min(map(re.Match.start, named)),
            max(map(re.Match.end, named)),
        )
    if (
        len(PAIR.findall(text)) == 2
        and (both := OPPOSITE.search(text))
        and not KEEP_IN.search(text[max(0, both.start() - 30) : both.start()])
    ):
        one, two = both["one"] or both["three"], both["two"] or both["four"]
        return _between(text, _point(one), _point(two), both.start(), both.end())
    if len(named) == 1 and len(PAIR.findall(text)) == 1:
        return _from_corner(text, named[0], parameters)
    return text


def _between(text: str, one: Point, two: Point, start: int, end: int) -> str:
    """The text with a centre and sizes for two opposite corners; as it is where they are none."""
    width, length = g.tidy(abs(one[0] - two[0])), g.tidy(abs(one[1] - two[1]))
    if not width or not length:
        return text
    middle = g.point((one[0] + two[0]) / 2, (one[1] + two[1]) / 2)
    said = (
        f"{text[:start].rstrip()} centred on {_written(middle)}, {width:g} m wide and {length:g} m"
        " long"
    )
    return f"{said}{'' if re.match(r'[,.;:]', text[end:]) else ' '}{text[end:]}".replace("  ", " ")


def _from_corner(text: str, corner: re.Match[str], parameters: dict[str, Any]) -> str:
    """The text with the centre of an area for its one stated corner."""
    bare = text[: corner.start()] + " " * (corner.end() - corner.start()) + text[corner.end() :]
    sizes = {name: value for name, value, _used in named_sizes(bare, stated_sizes(bare, []))}
    width, length = (sizes.get(name, parameters.get(name)) for name in ("width", "length"))
    if not isinstance(width, int | float) or not isinstance(length, int | float):
        return text
    said = re.compile(w.CORNER.pattern, re.IGNORECASE).match(corner["corner"])
    if said is None:
        return text
    name, (x, y) = named_corner(said), _point(corner["pair"])
    middle = g.point(
        x + (width / 2 if name.endswith("west") else -width / 2),
        y + (length / 2 if name.startswith("south") else -length / 2),
    )
    begins = BEGINNING.search(text[: corner.start()])
    kept = f"the {name} corner, " if begins else ""
    return f"{text[: corner.start()]} {kept}centred on {_written(middle)} {text[corner.end() :]}".replace(
        "  ", " "
    )


def _with_radius(text: str) -> str:
    """A square whose side is told, by half of it."""
    for quantity in reversed(quantities(text)):
        if quantity.unit != "m" or quantity.value <= 0:
            continue
        before, behind = (
            SIDE_LENGTH.search(text[: quantity.start]),
            SIDE_BEHIND.match(text[quantity.end :]),
        )
        if (
            before
            and not HALF.search(text[: before.start()][-25:])
            and not re.match(r"\s?(?:off|out|away|from|clear)", text[quantity.end :])
        ):
            start, end = before.start(), quantity.end
            tail = re.match(r"\s?(?:long|each|in length)\b", text[end:])
            end += tail.end() if tail else 0
        elif behind:
            start, end = quantity.start, quantity.end + behind.end()
        else:
            continue
        text = f"{text[:start]} radius {quantity.value / 2:g} m{text[end:]}".replace("  ", " ")
    return text


def _without_sides(text: str) -> str:
    """A text without the sides and corners that are only told for what is done there."""
    pieces, done = [], 0
    for end in [*(match.end() for match in CLAUSES.finditer(text)), len(text)]:
        sentence = text[done:end]
        pieces.append(sentence if BEGINS.search(sentence) else ON_SIDE.sub("there", sentence))
        done = end
    return "".join(pieces)
