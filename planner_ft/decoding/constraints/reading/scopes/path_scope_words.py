"""How task inputs word places on a path that is known: the patterns by which `path_spots` reads
them.
"""

from __future__ import annotations

import re

from planner_ft.decoding.constraints.reading.scopes import scope_words as w

_POINTS = r"(?:waypoints?|points?|wpts?|wps?|positions?|stops?|stations?)"
_SIDE = r"(?P<side>north|south|east|west)(?:ern)? (?:side|edge)\b"
_CORNER = (
    r"(?P<corner>(?:north|south)[ -]?(?:east|west))(?:ern)? (?:corner|(?:corner"
    r" )?waypoint|(?:corner )?point)\b"
)
_MID = r"(?:middle|mid-?point|centre|midway point)(?: waypoint| point)?"
_LINE = r"(?:lanes?|transects?|swaths?|rows?)"
SQUARE: tuple[tuple[str, str], ...] = (
    ("mid", rf"\b(?:at|on|in|for|from) (?:the )?{_MID} (?:of|on) (?:the |its ){_SIDE}"),
    (
        "mid",
        (
            r"\b(?:at|on|in|for) (?:the |its"
            rf" )?{_SIDE.replace('(?:side|edge)', 'mid-?(?:side|point)')}"
        ),
    ),
    (
        "side",
        (
            rf"\b(?:at|on|along|for|over) (?:all )?(?:the )?(?:three |3 )?(?:{_POINTS}"
            rf" (?:of|on|along) )?(?:the |its ){_SIDE}"
        ),
    ),
    ("corner", rf"\b(?:at|on|in|for) (?:the |its ){_CORNER}"),
    (
        "corners",
        (
            r"\b(?:at|on|in|for) (?:only |just )?(?:all |each |every |any )?(?:of )?(?:the |its"
            r" )?(?:four |4 )?corners?(?: (?:waypoints?|points?))?\b(?! of)"
        ),
    ),
    (
        "mids",
        r"\b(?:at|on|in|for) (?:only |just )?(?:all |each |every )?(?:of )?(?:the |its )?(?:four |4"
        r" )?(?:mid-? ?(?:sides?|points?)|"
        r"side (?:middles|centres|mid-?points)|"
        r"(?:middles?|centres?|mid-?points?) of (?:the |each |every |all )(?:four"
        r" )?(?:sides?|edges?))\b",
    ),
)
"""Places of a survey square."""
GRID: tuple[tuple[str, str], ...] = (
    (
        "lane ends",
        (
            rf"\b(?:at|on|for) (?:both |the two |all )?(?:of )?(?:the )?(?:two )?(?:{_POINTS}|ends)"
            rf" (?:of|on) (?:the )?(?P<ord>{w.ORD}) {_LINE}\b"
        ),
    ),
    (
        "lane run",
        r"\b(?:on|during|for) the (?:run|way|leg) (?:from the (?:start|beginning) of the"
        rf" (?P<ord>{w.ORD}) {_LINE} to its end|"
        rf"along the (?P<ord2>{w.ORD}) {_LINE})\b",
    ),
)
"""Places of a grid."""
_START = (
    r"(?:the |its )?(?:start(?:ing)?(?: (?:point|waypoint|position|end))?|(?:first|start)"
    r" (?:waypoint|point|end|lane|position|station|corner)|beginning)"
)
_WAY = r"(?:way|run|leg|transit|approach|passage|trip|drive|transfer|ride)"
_POINT = r"(?:point|waypoint|position|end|station)"
ANY: tuple[tuple[str, str], ...] = (
    (
        "start",
        rf"\b(?:on|during|for|in) the {_WAY} (?:out |over |up |in )?(?:to|towards) {_START}\b",
    ),
    (
        "start",
        rf"\b(?:while (?:you |she |it"
        rf" )?)?(?:go|goes|going|driving|running|heading|coming|steaming|getting|moving) (?:out"
        rf" |over |up )?(?:to|"
        rf"towards) {_START}\b",
    ),
    ("start", rf"\b(?:the|its) {_WAY} (?:out |over |up |in )?to {_START}\b"),
    (
        "start",
        (
            rf"\b(?:until|till|before|up to|as far as) {_START}(?: (?:is|has been) reached| lies"
            r" (?:behind|astern))?"
        ),
    ),
    (
        "start",
        (
            r"\b(?:until|till|before) (?:you|she|it) (?:reach|reaches|have reached|has reached|are"
            rf" at|is at) {_START}\b"
        ),
    ),
    (
        "beyond",
        rf"(?<!metres )(?<!meters )(?<!\dm )(?<!\d m )"
        rf"\b(?:from|beyond|past|after|starting (?:at|from)) {_START}(?: on(?:wards?|(?=[,.;]|$))|"
        r" to the (?:very )?end\b|(?=,))",
    ),
    (
        "beyond",
        (
            rf"\bonce (?:{_START} (?:is|has been) (?:reached|passed)|(?:you|she)"
            rf" (?:have|has|are|is) (?:reached|passed|at|past) {_START})\b"
        ),
    ),
    (
        "first",
        (
            rf"\b(?:at|on) (?:the |its )?(?:very )?(?:(?:start(?:ing)?|first) {_POINT}|first"
            r" one|start)\b(?! (?:of|to)\b)"
        ),
    ),
    (
        "final",
        (
            r"\b(?:at|on) (?:the |its )?(?:very )?(?:(?:end|last|final|finishing)"
            rf" {_POINT}|(?:last|final) one)\b(?! (?:of|to)\b)"
        ),
    ),
    (
        "home",
        (
            r"\b(?:on|during|for|in) the (?:(?:way|run|leg|trip|drive|passage) (?:back )?home|way"
            r" back|(?:homeward|return) (?:leg|run|trip|way))\b(?! to)"
        ),
    ),
    (
        "shape",
        r"\b(?:on|along|over|during|for|in|throughout) (?:the |its )(?:whole |entire |full"
        r" )?(?:(?:survey )?square|grid|lanes|survey|transects|circuit)\b"
        r"(?: itself| proper)?(?:,? (?:including|and) (?:its|the) (?:closing|last|final)"
        r" (?:point|leg|waypoint))?(?: only| alone)?"
        r"(?! (?:of|at|from|about|around|round|over|with|to|as)\b)",
    ),
    (
        "between",
        (
            r"\bfrom (?:the moment (?:you are at |you leave )?)?@ (?:to|until(?: you"
            r" reach)?|till(?: you reach)?|up to) @"
        ),
    ),
    ("between", r"\bbetween @ and @"),
    (
        "second",
        (
            r"\b(?:on|in|over|during|for) (?:that|this)"
            r" (?:run|leg|pass|line|track|stretch|cable|course)\b(?! (?:to|back|home))(?: only|"
            r" alone| itself)?"
        ),
    ),
    (
        "second",
        r"\b(?:in )?between the two(?: points| ends| waypoints)?\b|\bbetween (?:them|these two)\b",
    ),
    (
        "second",
        (
            r"\b(?:on|along|over|during) the (?:cable|track|pass|pipe\w*|line)"
            r" (?:itself|proper|only|alone)\b|\bthere, (?:and )?not before\b"
        ),
    ),
    (
        "bound",
        r"\b(?:on the )?(?P<way>north|south|east|west)(?:bound|wards?)(?:"
        r" (?:run|leg|pass|lane)s?)?\b|\bon the (?:way|run|leg) (?P<way2>north|"
        r"south|east|west)\b",
    ),
    (
        "legs",
        (
            r"\b(?:on|during|for|in) legs? (?P<cards>[1-9](?:(?:, [1-9])*(?:,? and | &"
            r" |\+)[1-9])?)\b(?! ?(?:m|met\w+)\b)"
        ),
    ),
    (
        "last",
        (
            r"\b(?:on|during|for|in) the (?:last|final) leg\b|\bat the (?:last|final)"
            r" (?:waypoint|point|position)\b"
        ),
    ),
)
"""Places of any path."""
EVERYWHERE = re.compile(
    rf"\b(?:at|on) (?:every(?: single)?|each|all)(?: of)?(?: the| these| its)?(?:"
    rf" (?:two|three|four|five|six|seven|eight|nine|ten|"
    rf"\d+))?(?: {_POINTS}\b|(?=[.,;]|$| (?:and|only)\b))|"
    r"\bthroughout\b|\ball the (?:time|way|while)\b|\bthe whole (?:time|way)\b|\bfrom start to"
    r" finish\b|\bat all times\b|\ball along\b"
)
BEGINS = re.compile(
    r"\b(?:start\w*|begin\w*|clockwise|first|enter\w*|commenc\w+|from)(?:,?"
    r" (?:at|on|in|from|with|is|the|it|being))*,? ?$"
)
"""Words before a place that say where the path begins."""
RULED_OUT = re.compile(
    r"\b(?:not|nor|never|none|neither|nothing|no|without|nowhere|no \w+|not \w+|neither of"
    r" them)(?:,? (?:while|when|yet|either|at|it|them|of))*,? ?$"
)
RULES_OUT = re.compile(
    r"^,?(?:"
    r" (?:it|they|she|you|we|i|that|is|are|log|take|run|record|use|have|do|want|need|goes|go))*,? ?"
    r"(?:not\b(?!"
    r" (?:only|before|otherwise|on|in|at|while|elsewhere))|(?:none|nothing|no|without|off)\b(?!"
    r" (?:\w+ )?(?:afterwards|thereafter|"
    r"elsewhere|otherwise|else|"
    r"after|before|between|on|in|at|during)\b)|rests?\b|sleeps?\b)"
)
DONE = re.compile(r"\b(?:run|pass|go|head|track|follow|sail|then|drive|turn)\b|@")
GOES_HOME = re.compile(
    r"\b(?:come|head|go|return|run|back|sail|steam|motor|drive)\w*(?:"
    r" (?:straight|back|directly|on|over|in|then|for)){0,2} (?:home|(?:to )?base)\b"
)
NOT_ALL = re.compile(
    r"\b(?:between|hops|turns|across|hold\w*|stop\w*|half|first|second|third|except|but)\b"
)
"""Words by which a sentence about a grid or square is about a part of it."""
BOUND_WAY = re.compile(
    r"\b(?:north|south|east|west)bound (?:run|leg|pass|lane)s?\b|\bon the way to (?:its|the)"
    r" start\b"
)
"""Words for a way that no movement is asked for by."""
BOTH_WAYS = re.compile(
    r"\bnorth\w*\b.*\bsouthbound|\bsouth\w*\b.*\bnorthbound|\beast\w*\b.*\bwestbound|\bwest\w*\b.*\beastbound"
)
"""Words for a way and back in one text."""
BOTH_WAYS_SAID = re.compile(
    r"\b(?:northbound|northwards?)\b.*\bsouth|\bsouth\w*\b.*\bnorth|\beast\w*\b.*\bwest|\bwest\w*\b.*\beast"
)
"""The same in one sentence."""
