"""Constructions whose waypoints are not derived: the places and paths of `waypoints` do not hold
them, and readings of plain itineraries take them for others.

Where one of them is not read as a whole by the reader that knows it, any waypoint may be meant.
"""

from __future__ import annotations

import re

_WAY = r"(?:north|south|east|west)"
_SIDE = rf"{_WAY}(?:[ -]?(?:east|west))?(?:ern)?"
_LENGTH = r"\d+(?:\.\d+)? ?(?:m|met(?:re|er)s?)\b"
MISREAD = re.compile(
    # "20 east, 5 south, 20 west": lengths, which look like a place as well
    rf"\b\d+(?:\.\d+)? {_WAY}, ?\d+(?:\.\d+)? {_WAY}, ?\d+(?:\.\d+)? {_WAY}\b|"
    # "15 m east-west, 70 m north-south": sizes
    rf"{_LENGTH} (?:east-west|north-south|e-w|n-s)\b,? (?:and |by )?{_LENGTH}"
    r" (?:east-west|north-south|e-w|n-s)\b|"
    # "two minutes forty, forty-five to starboard": no place
    r"\bminutes? [\w-]+, [\w-]+ to (?:port|starboard)\b|"
    # "[-110, 9] from its north-east side at 30 metres": a place off the one that is stated
    rf"\bfrom (?:its|the|that|the same) (?:{_SIDE} )?side at\b|\bat (?:[\w.]+ ){{1,3}}from"
    rf" (?:its|the) {_SIDE} side\b|"
    # "and then the same distance and direction once more"
    r"\bthe same"
    r" (?:distance|way|length|step|leg|stretch|vector|again|direction)\b(?=[^.;]{0,24}\b(?:again|more|further|on|beyond|back)\b)|\bas"
    r" far again\b|"
    # "red is P, green is Q, yellow is R. From west to east"
    rf"(?:^|[.;:,] )(?:in order )?from (?:the )?{_SIDE} to (?:the )?{_SIDE}\b,?(?: please|"
    rf" thanks)?\W*$|\b{_SIDE}(?:ern)?most (?:one )?first\b|"
    # "move to the ferry at yaw 210": the task's own place
    r"\bto the (?!goal|target|start|berth|cent|given|planned)\w+(?: \w+)? (?:at|with) (?:a"
    r" )?(?:yaw|heading)\b|"
    # "keeping it on your right": which way round
    r"\bkeep\w* (?:it|the \w+) (?:always )?(?:on|to) (?:your|the) (?:left|right|port|starboard)\b|"
    # "25 m and then 8 m east of P": both from P
    rf"{_LENGTH} and (?:then )?{_LENGTH} {_WAY}\w* of\b|\beach (?:one )?measured from\b|"
    # "40 m further on the same heading", "in two equal legs"
    r"\bfurther on the same\b|\bin (?:two|three|four|five|[2-5]) equal\b|"
    # "run 30 m east, turn to starboard, 30 m", "round the rectangle P to Q"
    r"\bturn (?:and run\b|to (?:port|starboard),? \d)|\bright angles\b|\bround the"
    r" rectangle\b|\brectangle from\b[^.;]{0,60}\boutline\b|"
    # "with the target on the starboard hand": which way round
    r"\bon (?:the|your) (?:port|starboard|left|right) hand\b|"
    # "half-side 11", "how wide: 30 m": sizes that are not read
    r"\bhalf-side \d+(?:\.\d+)?(?! ?m)\b|\bhow (?:wide|long|tall|close)\b ?:|"
    # "0, 270, 180 and 90", "one reading in one, 225 in two": no places
    r"(?<![\d.\[(-])\d{1,3}, \d{1,3}, \d{1,3}(?:,| and) \d{1,3}\b(?! ?[\])])|\bin one, \d|"
    # "stay inside the fence [...] from P to Q, then go on to R without it"
    r"\b(?:inside|within) (?:the |this |that"
    r" )?(?:fence|boundary|polygon|box|area)\b[^.;]{0,120}\][^.;\[(]{0,3} from [\[(]?[-−]?\d",
    re.IGNORECASE,
)
"""What a reading of stated places takes for something else."""
OPEN = re.compile(
    r"\bdiagonals?\b|\b(?:enlarged|grown|widened|shrunk|reduced|extended|moved in|set in)"
    r" by\b|\b(?:enlarged|shrunk)|\bm \w+ (?:its|the) walls?\b|"
    r"\b(?:inside|outside) (?:its|the|their) (?:walls?|edges?|limits)\b|"
    r"\ball the way round at\b|\bcorners? (?:at )?[\[(]?-?\d[^;.]{0,40}\bround\b|\bcorners"
    r" clockwise\b|"
    r"\b(?:run|follow|trace) (?:its|the) (?:edge|outline|border)\b|"
    r"\b(?:half|halves|quarters?|thirds?) of (?:it|its|the)\b|\b(?:middle|midpoint) (?:at"
    r" [\[(x]|outwards?)|\bto (?:the|its) (?:middle|midpoint)\b(?! of)|"
    rf"\babeam of\b|{_LENGTH} (?:to|on|off) its {_SIDE}\b|\ba (?:second|third)"
    r" time\b|\b(?:home|base) (?:is|lies) (?:\S+ ){1,4}of\b|"
    r"\bthe course (?:goes|turns|bends|changes)\b|\bon for (?:\S+"
    r" ){1,2}(?:m|met\w+|yards|feet)\b|\bdouble (?:that|it)\b|\btwice (?:that|as far)\b|"
    r"\bthe same (?:again|ag\w+) (?:back|on)\b|\bplan\w* len\w+\b|\bn-s\b|\be-w\b|\bleave the"
    r" (?:loop|round|ring) open\b|\bclose the (?:round|loop|ring)\b|"
    r"\b(?:x-?ray|yankee)\b|\bcomma minus\b|\byou began\b|\bback to it\b|\bcovering (?:\S+"
    r" ){1,2}(?:m|met\w+) in [xy]\b|"
    r"\bpast the [^.;]{1,30} on its\b|\b[xy] (?:stays|goes from)\b|"
    r"\bend(?:s|ed)? up\b|\balong the [xy][ -]axis\b|\bexpanding\b|\bfirst (?:lane|leg|line) of"
    r" the\b|\bfirst corner\b|"
    r"\bmiddle of (?:the|a|its) [\w -]{1,30}?(?: is|:|,| at) ?[\[(]?-?\d|"
    r"\bof width and (?:\S+ ){1,2}of length\b|\bstart to end\b",
    re.IGNORECASE,
)
"""What the derived places and paths do not hold."""
