"""A task input written in one form, for reading its rotations (`turns`): numbers become `D40`
(degrees), `N40` (bare), `C45` (compass directions), lengths `L`, times `T` and places `P`; and the
patterns for what is measured, sailed or swept, which is no rotation.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

from planner_ft.data.quantities import COMPASS, SHORT, quantities
from planner_ft.data.stated import POINT, radio_digits
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.values.clocks import without_clock_times


def compiled(pattern: str) -> re.Pattern[str]:
    """A pattern of a text in the one form, which is in small letters but for the tokens."""
    return re.compile(pattern)


# ---------------------------------------------------------------- how a text is written in one form

_QUOTED = compiled(r"\"[^\"]*\"|“[^”]*”|‘[^’]*’|(?<!\w)'[^']*'(?!\w)")
_ID = compiled(r"(?<![\w°])(?![xyXY][-−]?\d)[A-Za-z_]+[-_]?[A-Za-z_]*\d[\w-]*(?![\w.]*°)")
_NUMBER = r"[-−–+]?\d+(?:\.\d+)?"
_PAIR = rf"\(\s*{_NUMBER}\s*[,;/ ]\s*{_NUMBER}\s*\)|\[\s*{_NUMBER}\s*[,;/ ]\s*{_NUMBER}\s*\]"
_AXES = rf"\bx\s*[=:]?\s*{_NUMBER}\s*(?:m\b)?[\s,;/]*(?:and )?y\s*[=:]?\s*{_NUMBER}"
_GEO = (
    rf"{_NUMBER}\s?(?:m|met(?:re|er)s)?\s?(?:[EWNS]|east|west|north|south)\b[\s,;/]*(?:and"
    rf" )?{_NUMBER}\s?(?:m|met(?:re|er)s)?\s?(?:[EWNS]|east|"
    rf"west|north|south)\b(?! of)"
)
_PLACE = re.compile(
    rf"{_PAIR}|{_AXES}|{_GEO}|\b(?:minus|negative) \d[\d.]*, (?:minus |negative )?\d[\d.]*\b",
    re.IGNORECASE,
)
_ONE = re.compile(
    r"\b(every|each|this|that|the|which|no|any|first|second|third|fourth|last|next|other|nth)"
    r" one\b",
    re.IGNORECASE,
)
_IN_ORDER = re.compile(r"\bone (?:after (?:the other|another)|by one)\b", re.IGNORECASE)
_ORDINAL = re.compile(r"\b(\d+)(?:st|nd|rd|th)\b", re.IGNORECASE)
_SUFFIX = r"(?:erly|wards?|[ -]?bound)?"
_PLAIN_COMPASS = re.compile(
    r"(?<![\w-])(?:(?:north|south|east|west)[\s-]?)?(?:(?:north|south)[\s-]?(?:east|west)|north|south|east|"
    r"west)" + _SUFFIX + r"(?![\w])",
    re.IGNORECASE,
)
_LETTERS = compiled(r"(?<=[ ,/(-])(?:[NESW]|[NS][EW]|[NS][NS][EW]|[EW][NS][EW])(?=[ ,.;:/)-]|$)")
_TIMES_SIGN = compiled(r"(?<=\d)\s?[x×]\s?(?=\d+(?:\.\d+)?\s?(?:°|deg))")
_CELSIUS = compiled(r"^\s*(?:celsius|centigrade|c\b|°\s?c)")
_SIDED = (
    r"(?:side|edge|face|wall|corner|end|bank|quay|pier|wind|swell|current|sea|half|part|point"
    r" of|mole|breakwater|basin|berth|jetty|dock|slope|"
    r"cardinal)"
)


_PART_OF_TURN = {"half": 180, "third": 120, "quarter": 90, "sixth": 60, "eighth": 45}
_IN_FRACTIONS = re.compile(
    r"\b(two|three|four|five|six|seven|eight|[2-8]) (half|third|quarter|sixth|eighth)[-"
    r" ](turns|rotations|swings|pans|nudges)\b",
    re.IGNORECASE,
)
"""Several turns of a fraction of the whole."""


_POINT_IS = re.compile(
    r"[,(]? ?\b(?:(?:a|one|each|the) )?points? (?:being|is|are|equals?|makes?|=|of)"
    r" (?:11[.,]25|eleven and a quarter) ?(?:°|deg\w*)(?: each)?[),]?",
    re.IGNORECASE,
)
"""What explains the unit."""
_IN_POINTS = re.compile(
    r"\b(?P<count>\d+(?:\.\d+)?|an?|one|two|three|four|five|six|seven|eight|nine|ten|twelve|sixteen)(?P<half>"
    r" and a half)? points?"
    r"(?= (?:\w+ )?(?:(?:on|to|towards) (?:the"
    r" )?)?(?:port|starboard|left|right|(?:(?:counter|anti)-?)?clockwise)\b)(?! (?:on|off) the)",
    re.IGNORECASE,
)
"""Turns in points of the compass: "two points to starboard"."""
_CARDINAL = re.compile(
    r"\b(?:(?:to |at )?each (?:one )?of |all (?:of )?)?(?:the )?(?:four |4 )?cardinal"
    r" (?:points|directions|headings|bearings)(?: of the compass)?|"
    r"\b(?:each (?:one )?of |all (?:of )?)?(?:the )?four (?:quarters|points) of the compass",
    re.IGNORECASE,
)
_EIGHT_POINTS = re.compile(
    r"\b(?:each (?:one )?of |all (?:of )?)?(?:the )?(?:eight|8) (?:(?:principal|main|compass)"
    r" )+(?:points|directions|headings|bearings)(?: of the compass)?",
    re.IGNORECASE,
)
_SIDE_WORD = r"(?:port|starboard|left|right|(?:(?:counter|anti)[- ]?)?clockwise)"
_OF_A_TURN = re.compile(
    r"(?<!every )(?<!each )(?<!the )(?<!this )(?<!that )(?<!second )(?<!first )(?<!last"
    r" )\b(?:an? )?"
    r"(?P<part>three[ -]quarters?|half|quarter|third|eighth|sixth)(?:[- ](?:of )?an?)?(?: full|"
    r" whole)?[ -](?P<noun>turn|rotation|circle|revolution)\b"
    rf"(?=(?: on the spot| in place| back| round)?,? (?:(?:to|towards) (?:the )?)?{_SIDE_WORD}\b)",
    re.IGNORECASE,
)
"""A part of a turn with its side: "quarter turn to starboard"."""
_PART_BEHIND = re.compile(
    rf"(?P<side>\b{_SIDE_WORD}\b,? (?:(?:by|through|of|for|over) )?)(?:an? )?(?P<part>three["
    r" -]quarters?|half|quarter|third|eighth|sixth) (?:of )?(?:an? |"
    rf"one )?"
    r"(?:full |whole |complete )?(?P<noun>turn|rotation|circle|revolution)\b",
    re.IGNORECASE,
)
"""The same behind its side: "a sweeping turn to port, three quarters of a full circle"."""
_PARTS_OF_TURN = {"half": 180, "third": 120, "quarter": 90, "sixth": 60, "eighth": 45}


def _in_degrees(match: re.Match[str]) -> str:
    """A part of a turn in degrees, with its noun where it is one."""
    part = match["part"].lower()
    return f"{_PARTS_OF_TURN.get(part, 270)} degrees" + (
        " turn" if match["noun"].lower() == "turn" else ""
    )


def _points(match: re.Match[str]) -> str:
    """Points of the compass in degrees."""
    count = match["count"].lower()
    number = (
        float(count)
        if count[0].isdigit()
        else (
            max(quantities(count), key=lambda one: one.value).value
            if count not in ("a", "an")
            else 1.0
        )
    )
    return f"{(number + 0.5 * bool(match['half'])) * POINT:g} degrees"


def plain(text: str, parameters: dict[str, Any], *, measured: bool = False) -> str:
    """The text in one form, in small letters but for the tokens; `measured`: lengths and times have
    their values, and places are those in brackets alone.
    """
    text = without_clock_times(text)
    text = _MISSPELT_WORD.sub(lambda match: _MISSPELT.get(match[0], match[0]), text)
    for short, word in _SHORT.items():
        text = re.sub(rf"(?<![\w/])(?:{short})(?![\w/])", word, text, flags=re.IGNORECASE)
    text = w.LIST_MARK.sub(lambda mark: ";" + " " * (len(mark[0]) - 1), radio_digits(text))
    text = _PLACE.sub(
        " \x01 ",
        _ID.sub(
            "ident", _ORDINAL.sub("nth", _IN_ORDER.sub("in order", _QUOTED.sub("quote", text)))
        ),
    )
    text = _ONE.sub(lambda match: f"{match[1]} it", text)
    text = _EIGHT_POINTS.sub(
        "eight evenly spaced headings", _CARDINAL.sub("four evenly spaced headings", text)
    )
    text = _IN_POINTS.sub(_points, _POINT_IS.sub(" ", text))
    text = _PART_BEHIND.sub(
        lambda match: f"{match['side']}{_PARTS_OF_TURN.get(match['part'].lower(), 270)} degrees",
        text,
    )
    text = _OF_A_TURN.sub(_in_degrees, _TIMES_SIGN.sub(" times ", text))
    text = _IN_FRACTIONS.sub(
        lambda match: f"{match[1]} {match[3]} of {_PART_OF_TURN[match[2].lower()]:g} degrees", text
    )
    text = re.sub(r"\b[Tt]wice\b", "2 times", re.sub(r"\b[Tt]hrice\b", "3 times", text))
    text = _LETTERS.sub(
        lambda match: (
            COMPASS[SHORT.index(match[0])] if _is_direction(text[: match.start()]) else match[0]
        ),
        text,
    )
    pieces, at = [], 0
    for quantity in quantities(text):
        pieces += [
            _words(text[at : quantity.start]),
            _token(
                quantity.unit,
                quantity.said,
                text[quantity.end :],
                text[quantity.start : quantity.end],
            ),
        ]
        if measured and quantity.unit in ("m", "s"):
            pieces[-1] = f" {'L' if quantity.unit == 'm' else 'T'}{quantity.value:g} "
        at = quantity.end
    text = "".join([*pieces, _words(text[at:])])
    text = _SIGN.sub(_signed, re.sub(r"\s+", " ", text))
    text = text if measured else _BARE_PAIR.sub(r"\1 P", text)
    return re.sub(r"\s+", " ", _own_values(text, parameters)) + " "


def written_places(text: str) -> list[str]:
    """What the tokens for places stand for, in their order (where the text is `measured`)."""
    return [
        match[0]
        for match in _PLACE.finditer(
            _ID.sub(
                "ident", _ORDINAL.sub("nth", _IN_ORDER.sub("in order", _QUOTED.sub("quote", text)))
            )
        )
    ]


def _misspellings(words: str) -> dict[str, str]:
    """Slips of the keys in the words that decide: two letters swapped, one dropped or doubled, the
    first one kept.
    """
    found: dict[str, str] = {}
    for word in words.split():
        for place in range(1, len(word)):
            dropped = word[:place] + word[place + 1 :] if place + 1 < len(word) else word
            swapped = word[:place] + word[place + 1 : place + 2] + word[place] + word[place + 2 :]
            found |= dict.fromkeys(
                (dropped, swapped, word[:place] + word[place] + word[place:]), word
            )
    return {slip: word for slip, word in found.items() if slip not in words.split()}


_MISSPELT = _misspellings(
    "rotate rotating nudge degrees starboard clockwise anticlockwise heading headings bearing pivot"
    " swing towards sectors nudging panning evenly steps twice radius nudges rotations position"
    " station drift engines"
) | {
    "timmes": "times",
    "trun": "turn",
    "tunr": "turn",
    "prot": "port",
    "adn": "and",
    "tehn": "then",
    "rigth": "right",
    "lfet": "left",
    "wiht": "with",
    "whlie": "while",
    "roud": "round",
    "hodl": "hold",
    "hlod": "hold",
    "hodling": "holding",
    "wiat": "wait",
    "kepe": "keep",
}
_SHORT = {
    r"ccw|acw|c/cw|a/cw": "anticlockwise",
    r"cw": "clockwise",
    r"stbd|stbrd|sbd|stb|s'board": "starboard",
    r"hdgs?": "heading",
    r"brgs?": "bearing",
    r"pt": "port",
}
_MISSPELT_WORD = compiled(r"\b[a-z]{3,}\b")
_SIGN = compiled(r"(?:(\+)|minus|negative|[-−–]) ?([DN])(-?)(?=\d)")
_BARE_PAIR = compiled(
    r"\b((?:go|drive|head|run|sail|steer|leave|transit|proceed|move|shift|take|change"
    r" position|return|approach|visit|cross|steam|set course|make)"
    r"(?: (?!turn|rotat|bow|nose|heading|fac)[a-z]+){0,4}?"
    r" (?:to|for|at|via|over|from|position|waypoint)) N-?[\d.]+ ?[,/]? ?N-?[\d.]+(?! ?(?:,|and|"
    r"then) ?N)"
)


def _signed(match: re.Match[str]) -> str:
    """A sign before an angle; a hyphen before one without a minus is a dash."""
    if match[1]:
        return f"{match[2]}+"
    return f" {match[2]}-" if match[3] else match[0]


def _is_direction(before: str) -> bool:
    """Whether a capital letter behind this text may stand for a direction: not "stream E" or "phase
    N".
    """
    return (
        re.search(
            r"(?:\b(?i:to|face|facing|towards?|heading|bearing|headings|bearings|look|and|then|due)|,|[NESW]|/|"
            r":)[\s,/-]*$",
            before,
        )
        is not None
    )


def _words(text: str) -> str:
    return _PLAIN_COMPASS.sub(_compass, text).lower().replace("\x00", "C").replace("\x01", "P")


def _compass(match: re.Match[str]) -> str:
    name = re.sub(
        r"[\s-]|erly$|wards?$|-?bound$", "", re.sub(_SUFFIX[:-1] + "$", "", match[0].lower())
    )
    known = {direction.replace("-", ""): 22.5 * index for index, direction in enumerate(COMPASS)}
    return f" \x00{known[name]:g} " if name in known else match[0]


def _token(unit: str | None, said: float, behind: str, text: str) -> str:
    if unit is None and re.search(r"half|third|quarter", text.lower()):
        return " fraction "
    if unit in ("deg", None) and said > 0 and re.match(r"[-−–]", text):
        said = -said
    if unit == "deg":
        return " X " if _CELSIUS.match(behind.lower()) else f" D{said:g} "
    return {"m": " L ", "s": " T ", None: f" N{said:g} "}.get(unit, " X ")


_GIVEN = r"(?:(?:full|given|planned|set|whole|stated|task's|cable's|track's|cable|track|scan|own) )"
_OWN_HEADING = compiled(
    rf"\b(?:the|its) {_GIVEN}+(?:heading|bearing|course)(?: of the (?:task|cable|track))?|\bthe"
    r" (?:heading|bearing) of the (?:task|"
    rf"cable|track)"
)
_OWN_WIDTH = compiled(
    rf"\b(?:the|its) {_GIVEN}+width(?: of the (?:scan|task))?|\bthe width of the (?:scan|task)"
)
_OWN_COUNT = compiled(
    rf"\b(?:the |its )?(?:{_GIVEN}+number of (?:sectors|headings)|{_GIVEN}+sectors|number of"
    r" (?:sectors|headings) (?:of|in) the task|"
    rf"sectors of the task)"
)


def _own_values(text: str, parameters: dict[str, Any]) -> str:
    """The text with the task's own values in place of the words that refer to them."""
    own = (
        (_OWN_HEADING, "heading", "C{:g}"),
        (_OWN_WIDTH, "scan_width_degrees", "D{:g}"),
        (_OWN_COUNT, "sectors", "N{:g} sectors"),
    )
    for pattern, name, token in own:
        value = parameters.get(name)
        text = pattern.sub(
            token.format(value) if isinstance(value, int | float) else "unknown heading", text
        )
    return text


# ---------------------------------------------------------------- what is no rotation

V = r"[DNC][+-]?\d+(?:\.\d+)?"
D = r"[DN][+-]?\d+(?:\.\d+)?"
_LIST = (
    rf"(?:due )?{V}(?:(?:\s*(?:,|and|or|to|then))+\s*(?:(?:at|towards|to|over|bearing) )?(?:due"
    rf" )?{V})*"
)
SIDE = (
    r"(?:(?:to|towards) (?:the |her |its |your )?)?(?:port|starboard|left|right|larboard)(?:"
    r" side)?\b|(?:(?:counter|anti)[- ]?)?clock-?wise\b"
)
_RADIUS = r"(?:(?:at|with|in|on|of|,)? ?(?:a |the )?(?:radius (?:of |being )?)?L(?: radius| out)?)"
_MEASURED = (
    r"(?:sector|sectors|slice|slices|lidar|scan angle|profile|profiles|cone|fov|field of"
    r" view|closest return|returns?|range|ranges|distances?|"
    r"obstacles?|beam)"
)
SENSED = compiled(
    rf"\b(?:steady|still|settled?|stable|ahead|opening)(?: to| at| of|,)*(?: within)? {D}(?: of)?|"
    rf"\b{_MEASURED}(?: (?!turn|nudge|pan|rotat|face|swing|come|go|hold)[a-z_]+)" + r"{0,4}?"
    r" ?(?:,? ?(?:at|towards?|over|within|of|on|to|in|for|from|bearing|is|angle|the|a|an|:|=))*"
    rf" ?{_LIST}(?! ?(?:{SIDE}))|"
    rf"\b{D}[ -]*(?:wide |degree )?(?:cone|fov|field|sector|slice|opening|beam|arc of view)\b|"
    rf"\b(?:over|above|below|under|within|less than|more than|exceed\w*|beyond|threshold(?: of|"
    rf" is)?|at most|at least|no more than|hotter than|"
    rf"warmer than|"
    rf"inside|drop(?:s|ped)? to|limit(?: of| is)?|pitch and roll(?: of| to)?|roll(?: of| to)?|from)"
    rf" (?:a |an |"
    rf"about )?(?:threshold of )?{D}(?: (?:of |in )?(?:pitch|roll|tilt|upwards?|or more|or"
    r" hotter|up)\b)?"
    rf"(?! ?(?:{SIDE}|,? through))|\b{D} (?:of |in )?(?:pitch|roll|tilt|or hotter|or"
    rf" more|upwards?)\b|\b(?:overlap)(?: of)? {D}"
)
"""A value that something is measured at, or that something is compared with."""
SIDES_OF_THINGS = compiled(
    r"\b(?:current|wind|swell|tide|sun|sea|waves?|gusts?|stream)(?: [a-z]+)"
    + r"{0,4} C[\d.]+|"
    + r"\b(?:[NL](?:-?\d+(?:\.\d+)?)? (?:to the |due )?)?C[\d.]+(?:ern)?"
    rf" (?:{_SIDED}|of)\b|\b(?:start\w*|begin\w*|first (?:waypoint|point|one)|"
    rf"waypoint|corner)"
    r" (?:in|from|on|at|to|is)? ?(?:the )?(?:middle of )?(?:the )?(?:due )?C[\d.]+"
    r" (?:side|corner|of)|\bfirst (?:waypoint|point|stop)(?: (?:is|in|"
    r"at|to|the))*(?: due)? C[\d.]+|C[\d.]+ ?(?:-|to|and) ?C[\d.]+ (?:lanes|lines|legs)|"
    r"\b(?:lanes|lines|legs) (?:running |run |going )?C[\d.]+ ?(?:-|to|and)? ?C[\d.]+"
)
_ON = r"(?:on|along|at|steering|following|follow)"
RUN = compiled(
    rf"\bL (?:long )?(?:straight )?(?:away )?(?:{_ON} |to the |in the direction )?(?:a |the"
    r" )?(?:heading |bearing |course |"
    rf"track )?(?:of )?(?:due )?{V}|"
    rf"\b(?:follow|run|track|sail|drive|steer|go|steam|proceed|transit|cable|line)\w*(?:"
    rf" (?!turn|face|pan|rotat|to\b|onto\b)[a-z]+)" + r"{0,3}?"
    rf" (?:{_ON} )?(?:a |the |its )?(?:heading|bearing|course)(?: of)? {V}|"
    rf"\b{_ON} (?:a |the )?(?:(?:heading|bearing|course)(?: of)? )?(?:due )?{V} (?:for|over)"
    rf" L|\b(?:heading|course) {V},? (?:for )?L"
)
"""The course of a run."""
GOAL = (
    r"(?:P|(?:position|goal|target|berth|destination|centre|point(?!"
    r" the)|coordinates|home|start|dock|spot|landing))"
)
YAW = compiled(
    rf"{GOAL}[ ,]*(?:(?:with|and|at|on|arriv\w+|there|in|end\w*|finish\w*) )*(?:a |the |your"
    r" |its )?"
    rf"(?:yaw|heading|bow|nose|facing|pointing|orientation|lined up on|looking)(?:"
    rf" (?:of|on|is|at|pointing|facing|set|turned|to the|being|"
    rf"towards?))* ?(?:due )?{V}"
    rf"(?: (?:on|at) arrival)?|\bfinal (?:yaw|heading) {V}|\b(?:yaw|heading|bow)(?: of| at)? {V}"
    r" (?:on|at|upon) arrival|"
    rf"\barriv\w+ (?:there )?(?:on|at|with)?(?: a)?(?: (?:yaw|heading|bow)(?: of)?)? ?(?:due )?{V}"
)
"""The yaw on arrival of a run to a place."""
_IN_ARC = (
    rf"(?:["
    rf" ,:-]|\b(?:of|at|with|to|the|by|through|for|a|an|in|on|and|round|around|once|full|half|circle|radius|arc|curve|bend|it|wide|out)\b"
    rf"|\b[LP]\b|{D}|{SIDE})"
)
ARC = compiled(
    r"(?:\b(?:turn|swing|swing round|go|come|come"
    r" round|move|make|drive|run|do|take|follow|describe|sail)(?:"
    rf" (?:in|on|along|through|by|{SIDE}))*"
    rf"(?: (?:a|an|the|wide|sweeping|one|single))* )?(?:{D} ?(?:{SIDE}|-|"
    r" |degree|of|in|an|a|L|radius)*)?(?:L (?:radius )?)?\b(?:arc turns?|"
    rf"arcs?|arcing|curves?|curving|sweeping turn|arc turn|wide turn|bends?|swing wide|swing round"
    rf" in|orbit\w*|"
    rf"(?<!full )(?<!whole )circle)\b{_IN_ARC}*"
    r"|\b(?:L radius|radius of"
    rf" L)\b{_IN_ARC}*|\b(?:sweep\w*|turn|swing|come|go|round|bend|move|drive)(?:"
    r" (?:round|around|about|"
    rf"it))?,?(?: (?:{SIDE}))?(?: (?:by|through))? {D}[ ,]*(?:{SIDE})?[ ,]*{_RADIUS}"
    rf"|\b(?:sweep\w*|turn|swing|come|go|round|bend)(?: round)? {_RADIUS}[ ,]*(?:(?:through|by|of)"
    rf" )?{D}[ ,]*(?:{SIDE})?"
    rf"|{D} (?:{SIDE}),? (?:at|with a radius of|on a radius of) L|\b(?:go|drive|once|lap|all the"
    r" way) (?:once |twice |"
    rf"N\d times )?(?:right )?(?:a?round|about) (?:the |it|P|them)[^,.;]*"
)
WAYPOINTS = re.compile(
    r"\b(?:N\d+|four|six|eight)["
    r" -]?(?:points?|waypoints?|stops)\b[^.;]*|\b(?:square|grid|lawn-?mow\w*|ring|box|rectangle|polygon|fence|"
    r"boundary)\b[^.;]*|~a[^.;]*"
)
COUNTED = compiled(
    r"\b(?:steps?|parts?|stages?|legs?|phases?|tasks?|points?|panel|pile|turbine|berth|contact|boat|target|marker|tag|buoy|channel|plan"
    r" [a-z]|"
    r"no\.?|number) "
    r"N-?\d+(?:(?:\s*(?:,|and|to|or|-))+\s*N\d+)*|\bN\d+"
    r" (?=[a-z]+s\b)(?!times|degrees|headings|directions|steps|equal|pans|nudges|turns|rotations|"
    r"sectors|bearings|is\b|as\b|across\b|pass\b|views|parts|stops)"
)


def sign(side: str) -> int:
    """-1 for a side to port and for counter-clockwise."""
    return -1 if re.search(r"port|left|larboard|counter|anti", side) else 1


def without(text: str, patterns: Iterable[re.Pattern[str]]) -> str:
    for pattern in patterns:
        text = pattern.sub(_arc_mask if pattern is ARC else mask, text)
    return text


def mask(match: re.Match[str], mark: str = "") -> str:
    """As long as what it stands for: places in the text keep their order."""
    inside = match[0].strip()
    return match[0].replace(inside, mark.ljust(len(inside), "~")[: len(inside)])


def _arc_mask(match: re.Match[str]) -> str:
    return mask(match, "~a")
