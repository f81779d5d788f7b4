"""Values that a task input tells by a parameter's name, in figures: "half the scan width to port",
"the given radius due north of it", "make the spacing 12".

A size that is put in the place of the task's own ("the spacing in the form is too fine, make it
12") is said in the readers' words.
"""

from __future__ import annotations

import re
from typing import Any

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading.wordings import bearing_of

_NUMBER = r"\d+(?:\.\d+)?"
_SIDE = r"(?:to (?:the )?)?(?:port|starboard|left|right|(?:counter|anti)-?clockwise|clockwise)\b"
_WAY = r"(?:north|south|east|west)(?:[ -]?(?:east|west))?"
_OWN = r"(?:given|stated|set|planned|whole|full|entire|total|usual|specified|task['’]s)"
WIDTH = re.compile(
    r"(?P<led>\b(?:by|through|across) )?\b(?P<half>half (?:of )?)?(?:(?:the|that|its|this|a)"
    rf" )?(?:{_OWN} )*(?P<what>(?:scan(?:ning)?|sector|search)[ "
    r"-]?width|width|angle)"
    rf"(?P<behind> (?:(?:back|over|across|round|again) )*{_SIDE})?",
    re.IGNORECASE,
)
HALF_OF_IT = re.compile(
    rf"\bhalf (?:of )?(?:it|that)(?= (?:(?:back|over|across|round|again) )*{_SIDE})", re.IGNORECASE
)
ENDS_ON = re.compile(
    r",? (?:so that|so|which means|and) (?:you|she|the bow|it|the boat)"
    r" (?:end|ends|finish|finishes|come|comes|is|are|will be)(?: up)?(?: back)? (?:on|at|"
    r"facing) (?:heading )?\d{1,3}"
    r"(?: degrees)?(?: again| once more)(?=[.,;]|$)",
    re.IGNORECASE,
)
"""A heading that is only said to be reached."""
_SIZES = ("radius", "distance", "length", "width", "spacing", "max_dist")
_CALLED = {
    "radius": "radius",
    "distance": "(?:stand-?off )?distance|stand-?off",
    "length": "length",
    "width": "width",
    "spacing": "(?:lane )?spacing",
}
OFF = re.compile(
    rf"\b(?:at |by )?(?P<half>half (?:of )?|twice |double )?(?:the|its|one|a) (?:{_OWN}"
    r" )*(?P<what>radius|distance|length|width|spacing|stand-?off)(?: of "
    r"the task)?"
    rf"(?= (?:(?:due|to the|straight|directly|out) )*{_WAY}(?:wards?)? (?:(?:and (?:due )?{_WAY}"
    r" )?(?:of|from))\b)",
    re.IGNORECASE,
)
"""A parameter as the length of a way."""
_POINT = r"(?:(?:the|a|one|another) )?(?:(?:one|point|spot|place|position|waypoint)s? )?"
FROM_OWN = re.compile(
    rf"\b{_POINT}(?P<length>{_NUMBER}) m (?:(?:due|to the|straight|directly|out)"
    rf" )*(?P<way>{_WAY})(?:wards?)? (?:of|from) "
    r"(?P<base>the target(?: position)?\b|it\b|the goal(?: position)?\b|the"
    r" (?:mast|pile|monopile|buoy|turbine|target|structure|mark)\b)",
    re.IGNORECASE,
)
POINTS = re.compile(
    rf"\b(?:the )?(?:two |both )?(?:points|places|spots|positions) (?={_NUMBER} m (?:due )?{_WAY}"
    rf" and (?:due )?{_WAY} (?:of|from))",
    re.IGNORECASE,
)
TWO_WAYS = re.compile(
    rf"\b(?P<length>{_NUMBER} m) (?:due )?(?P<one>{_WAY}) and (?:due )?(?P<two>{_WAY})"
    r" (?P<of>of|from) (?P<base>the target(?: position)?|it)\b",
    re.IGNORECASE,
)
_SHAPE = r"(?:square|grid|ring|survey|circuit|round|lawn-?mower)"
NO_SHAPE = re.compile(
    r"(?P<before>^|[.;:!] )(?:please )?(?:skip|forget|leave out|never"
    r" mind|no|not|omit|drop|don['’]t (?:do|run)) (?:the |a |any )?(?:(?:full|usual|whole|"
    r"survey|standard|normal|complete) )*"
    rf"{_SHAPE}(?: (?:today|this time|now))?(?:[.;:]|,? (?:and|but|just|only)(?="
    r" (?:visit|go|just|only)))|\b(?:instead of|rather than) (?:the |a "
    rf")?(?:(?:full|usual|whole|survey|standard) )*{_SHAPE},? "
    r"(?=(?:just |only )?(?:visit|go|run))",
    re.IGNORECASE,
)
_TOO = r"(?:too|a bit too|rather|far too|much too|a bit|way too)"
_FORM = (
    r"(?: (?:in|on|of|from) (?:the|this|my|your)"
    r" (?:form|task|sheet|order|ticket|plan|job|system|table|header|parameters)| given| as given|"
    r" stated)?"
)
RENEWED = re.compile(
    r"\b(?:the |its )?(?:given |stated |planned |lane |line |track"
    rf" )*(?P<what>spacing|width|length|radius){_FORM} (?:is|looks|seems) (?:{_TOO} )?(?:fine|"
    r"coarse|wide|small|large|tight|short|long|narrow|"
    r"close|big|wrong|generous|dense|ambitious)(?: (?:for (?:this|that|the"
    r" [\w-]+)|here|today|now))?(?:[,;:]| –| -|,? so|[.])+ ?(?:so |please |just "
    r")*(?:make|use|take|set|go|let|try|put|change|we want|i want)"
    r"(?: (?:it|that|this|the (?:spacing|width|length|radius)|be|for|with|to|down|up|instead|at))*"
    rf" (?P<value>{_NUMBER})(?: ?(?:m|met(?:re|er)s?))?\b(?: "
    r"instead)?(?! ?(?:k?m\b|ft|feet|yards?|x|by))",
    re.IGNORECASE,
)
MADE = re.compile(
    r"\b(?:,? ?but )?(?:please )?(?:make|set|change|with|put|take|keep|use)(?: the| its)? (?:lane"
    rf" |line )?(?P<what>spacing|width|length|radius){_FORM} "
    r"(?:to |at |be |as |of |is )?"
    rf"(?P<value>{_NUMBER})(?: ?(?:m|met(?:re|er)s?))?\b(?!"
    r" ?(?:k?m\b|ft|feet|yards?|x|by))(?P<instead>,? ?(?:instead of|and not|not|rather than) "
    rf"[^.;,]{{1,40}}| instead)?",
    re.IGNORECASE,
)
AS_SIZE = re.compile(
    rf"\b(?:,? ?but )?(?:with |use |take |using )?(?P<value>{_NUMBER})(?: ?(?:m|met(?:re|er)s?))?"
    r" (?:as|for) (?:the |its )?(?:lane |line )?(?P<what>spacing|"
    r"width|length|radius)\b"
    r"(?P<instead>,? ?(?:instead of|and not|not|rather than) [^.;,]{1,40}?(?=[.;,]|$)| instead)?",
    re.IGNORECASE,
)
INSTEAD = re.compile(
    rf"(?P<said>\b(?P<what>spacing|radius|width|length|apart)\b[^.;]{{0,20}}?{_NUMBER}"
    rf" ?m(?:et(?:re|er)s?)?\b|{_NUMBER} ?(?:m|met(?:re|er)s?) (?:apart|"
    r"spacing|radius))"
    r",? (?:instead of|rather than|and not|not) (?:the"
    rf" )?(?:(?:given|planned|stated|usual|normal|original) )*(?:one given|{_NUMBER}(?:"
    r" ?(?:m|met(?:re|"
    r"er)s?))?|one|value|figure|radius|spacing|width|length)"
    rf"(?: (?:given|planned|stated|in the (?:form|task|sheet)|{_NUMBER}(?: ?m\b)?))?(?=[.;,]|$|"
    r" and\b| but\b)",
    re.IGNORECASE,
)
MULTIPLE = re.compile(
    rf"\b(?P<times>twice|double|half) (?:the |its )?(?:{_OWN} )*(?:lane |line"
    r" )?(?P<what>spacing|radius)\b|\b(?:the |its )?(?:lane |line "
    r")?(?P<other>spacing|radius) (?P<done>doubled|halved)\b",
    re.I,
)


def in_figures(text: str, parameters: dict[str, Any]) -> str:
    """The text with the values that it refers to in figures."""
    sizes = {
        name: value
        for name in _SIZES
        if isinstance(value := parameters.get(name), int | float) and not isinstance(value, bool)
    }
    width = parameters.get("scan_width_degrees")
    if isinstance(width, int | float):
        text = _widths(text, width)
    if "radius" in sizes or "spacing" in sizes or "distance" in sizes:
        text = OFF.sub(lambda said: _off(said, sizes), text)
        text = _points(text, parameters)
    if "spacing" in sizes or "radius" in sizes:
        text = (
            NO_SHAPE.sub(lambda said: said["before"] or "", text) if _POINTS.search(text) else text
        )
        text = INSTEAD.sub(r"\g<said>", text)
        for wording in (RENEWED, MADE, AS_SIZE):
            text = wording.sub(lambda said: _sized(said, sizes), text)
        text = MULTIPLE.sub(lambda said: _multiple(said, sizes), text)
    return re.sub(r"  +", " ", text).strip() if text else text


_POINTS = re.compile(r"[\[(]\s*[-−–]?\d")


def _widths(text: str, width: float) -> str:
    """The width of a scan in degrees, where it is turned by."""

    def degrees(match: re.Match[str]) -> str:
        bare = match["what"].lower() in ("width", "angle")
        if not (match["led"] or match["behind"]) or (
            bare and not match["half"] and not re.search(_OWN, match[0], re.IGNORECASE)
        ):
            return match[0]
        return (
            f"{match['led'] or ''}{g.tidy(width / 2 if match['half'] else width):g}"
            f" degrees{match['behind'] or ''}"
        )

    made = WIDTH.sub(degrees, text)
    return (
        ENDS_ON.sub("", HALF_OF_IT.sub(f"{g.tidy(width / 2):g} degrees", made))
        if made != text
        else text
    )


def _off(match: re.Match[str], sizes: dict[str, float]) -> str:
    """A parameter as a length in metres."""
    name = re.sub(r"stand-?off", "distance", match["what"].lower())
    if name not in sizes:
        return match[0]
    factor = {"h": 0.5, "t": 2, "d": 2}[match["half"][0].lower()] if match["half"] else 1
    return f"{g.tidy(sizes[name] * factor):g} m"


def _points(text: str, parameters: dict[str, Any]) -> str:
    """Points a way off the task's own place, as places: where they are told by a parameter."""
    text = TWO_WAYS.sub(
        r"\g<length> \g<one> of \g<base> and \g<length> \g<two> of \g<base>", POINTS.sub("", text)
    )
    own = next(
        (
            parameters[name]
            for name in ("target_position", "center", "goal_position")
            if isinstance(parameters.get(name), list)
        ),
        None,
    )
    if own is None or not FROM_OWN.search(text) or len(own) != 2:
        return text
    lengths = {
        f"{value:g}"
        for name in ("radius", "distance")
        if isinstance(value := parameters.get(name), int | float)
    }
    spots = list(FROM_OWN.finditer(text))
    if any(match["length"] not in lengths for match in spots) or spots[0]["base"].lower() == "it":
        return text

    def place(match: re.Match[str]) -> str:
        x, y = g.offset(g.point(*own), bearing_of(match["way"]), float(match["length"]))
        return f"[{x:g}, {y:g}]"

    return FROM_OWN.sub(place, text)


def _sized(match: re.Match[str], sizes: dict[str, float]) -> str:
    """A new size in the readers' words; one that the task does not have stays as it is said."""
    name = match["what"].lower()
    if name not in sizes:
        return match[0]
    end = ". " if match[0].endswith(". ") else ""
    before = ", " if match[0].startswith((",", " ")) else ""
    words = {
        "spacing": f"spacing {match['value']} m",
        "radius": f"with a radius of {match['value']} m",
    }
    return (
        before
        + words.get(name, f"{match['value']} m {'wide' if name == 'width' else 'long'}")
        + end
    )


def _multiple(match: re.Match[str], sizes: dict[str, float]) -> str:
    """Twice or half a size in figures."""
    name = (match["what"] or match["other"]).lower()
    if name not in sizes:
        return match[0]
    value = sizes[name] * (
        0.5 if (match["times"] or match["done"]).lower() in ("half", "halved") else 2
    )
    return (
        f"spacing {g.tidy(value):g} m" if name == "spacing" else f"a radius of {g.tidy(value):g} m"
    )
