"""Wordings of movements put into those that `sequence` reads: the task's own values, other verbs
for going, arcs told in pieces, what was done before.

Over a text in one form with numbered places (`sequence_text`).
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any

from planner_ft.decoding.constraints.reading.rows import sequence_words as w
from planner_ft.decoding.constraints.reading.rows import turn_forms as f

# ---------------------------------------------------------------- the task's own values

_SET = r"(?:ordered|agreed|specified|required|given|set|planned|stated|prescribed|requested|allotted|usual|task's|commanded|tasked)"
_THAT_IS_SET = (
    rf"(?:(?:that|which) (?:is|was|has been) {_SET}|{_SET}|of the (?:task|order|job)|in the"
    r" (?:task|order|job)|asked for|(?:that|which) the (?:task|order) "
    r"(?:gives|states|says|sets|names))"
)
_TIMES = (
    (
        "duration",
        f.compiled(
            rf"\b(?:the |its |your )(?:{_SET} )+(?:duration|time|period|minutes)\b|\bthe"
            rf" (?:duration|time|period) {_THAT_IS_SET}(?! \w+ing\b)"
        ),
    ),
    (
        "wait",
        f.compiled(
            rf"\b(?:the |its |your )(?:{_SET} )+(?:wait|pause|waiting time|wait time)\b|\bthe"
            rf" (?:wait|pause|waiting time) {_THAT_IS_SET}"
        ),
    ),
)
_RADIUS = f.compiled(
    rf"\b(?:the |its |a )?(?:{_SET} )+(?:turning )?radius\b|\bthe radius {_THAT_IS_SET}"
)

# ---------------------------------------------------------------- going somewhere

_WAY = r"(?:over|up|out|down|across|back|in|on|along|straight|directly|round)"
_GOING = f.compiled(
    rf"(?<![\w'-])(?:goto|enter|stand|upstream|downstream|upriver|downriver|upwind|downwind|outbound|inbound|outward|inward|inshore|offshore|ashore|report|"
    rf"show up|"
    rf"(?:take|bring|get|bear|work|haul) (?:her|the (?:boat|usv|vessel|asv)|yourself|it)|make your"
    rf" way|find your way|pick your way|first call|creep|ease|"
    rf"edge|nose|"
    r"hurry|rush|dash|scoot|putter|potter|trundle|chug|crawl|amble|stroll|nip|whizz|zip|sneak|swim|float)(?:"
    rf" {_WAY})*"
    rf"(?: (?:to|at|for|towards|into|by))? (?=(?:the |a |an |our |my |your"
    rf" )?(?:(?!and\b|then\b|of\b)[a-z'-]+,? ){{0,5}}?[(]?P\d)"
)
_STARTS_AT = f.compiled(
    r"(?:^ ?|(?<=[.;:,] ))(?:and )?(?:you|she|it|we|the (?:boat|usv|vessel|vehicle|asv))"
    r" ?(?:(?:now|already|currently) )?(?:are|is|'re|'s|lie|lies|sit|sits|"
    r"float|floats)"
    r"(?: (?:now|already|currently|lying|sitting|moored|waiting|afloat|anchored|berthed|floating|here|there|still))*,?"
    r" (?:at|in|on|off|by|near) "
    r"(?:the |your |our )?(?:[a-z-]+ ){0,3}?(?:at )?P\d+(?: (?:now|already|at present|at the"
    r" moment))?(?= ?[,.;:]| ?$| and )"
)
_FROM = f.compiled(
    r"\b(?:starting |leaving |departing |coming )?(?:from|leave) (?:your |where you"
    r" (?:are|lie|sit|float)(?: now)?,? )(?:[a-z-]+ ){0,3}?(?:at |in |"
    r", )?P\d+ ?,? (?:and )?"
    r"(?=(?:go|run|sail|head|proceed|drive|move|steam|motor|transit|turn|drift|nudge|make|then)\b)|"
    r"\bfrom P\d+ ?,? (?:which is |that is |i\.e\.,? )?where you (?:are|lie|sit|float)(?: now|"
    r" already)?,? "
)

# ---------------------------------------------------------------- what was done before

_DONE = f.compiled(
    r"(?:,? ?\b(?:and |but )?(?:once|when|as soon as|after) (?:that|this|it|all (?:of"
    r" )?(?:that|this)|you) ?(?:is|'s|has been|has|have been|have|are|'re|"
    r"was)(?: all)? "
    r"(?:done|over|finished|complete|completed|held|drifted|turned|behind you|through|up)(?:"
    r" (?:so|it|that|with (?:it|that)))?|"
    r",? ?\b(?:and )?having"
    r" (?:held|done|turned|drifted|waited|finished|floated|paused|stayed|nudged|arced|settled|rotated|stopped|swung)"
    r"(?: (?:it|that|this|so|there|here|still|that long|for that long|station|position))*|"
    r",? ?\b(?:and )?(?:with )?(?:that|this|all that|the (?:hold|turn|drift|wait|arc|stop))(?:"
    r" being)? (?:done|finished|behind you|completed|over)|"
    r"(?:^|(?<=[.;:,] ))(?:done|finish|finished|and then finish|when finished|once finished|when"
    r" done|once done))(?=,|:| (?:then )?(?:go|turn|hold|face|"
    r"nudge|wait|stay|drift|"
    r"return|head|proceed|keep|pan|rotate|swing|make|float|sail|move|run)\b),?:?"
)

_AFTER_THIRD = f.compiled(
    r"\bafter the fraction(?= (?:of (?:them|these|those)|it|one|point|stop|place|mark)\b| ?,)"
)
_AFTER_LAST = f.compiled(
    r"(?:^|(?<=[.;:,] ))(?:and )?after the (?:last|final)(?: (?:of (?:them|these|those|the"
    r" N\d+)|it|one|point|stop|place|mark|hold|turn|drift))? ?,"
)

# ---------------------------------------------------------------- arcs

_ARC_NOUN = (
    r"(?:arc turn|sweeping turn|wide turn|sweeping arc|arc|curve|bend|wide sweep|sweeping"
    r" curve|wide arc)"
)
_ARC_PIECE = (
    r"(?:(?:also |again |this time |but |all |and )?(?:to the |to"
    rf" )?(?:{f.SIDE})|(?:(?:through|of|by|for|over|sweeping|turning) )*(?:a |"
    rf"an )?{w.D}(?: degrees)?(?: (?:of )?(?:arc|turn))?|"
    r"(?:(?:at|with|on|of|in|and) )*(?:a |an |the )?(?:turning )?(?:radius (?:of |is |being"
    rf" )?{w.L}|{w.L}(?: (?:turning )?radius)?|"
    rf"same radius)(?: as before)?)"
)
_ARC_IN_PIECES = f.compiled(
    rf"\b{_ARC_NOUN}(?:[ ,:]{{1,3}}{_ARC_PIECE}){{1,4}}(?="
    r" ?(?:[.,;:]|$|and\b|then\b|with\b|while\b|before\b|after\b))"
)
_PIECE_MARK = f.compiled(r"(?<!\d)[,:](?!\d)|(?<=\d)[,:] ")

# ---------------------------------------------------------------- the rest

_RADIANS = f.compiled(r"\b[ND](?P<n>\d+(?:\.\d+)?) ?(?:rad|radians?)\b")
_HEADINGS = f.compiled(
    rf"(?:^|(?<=[.;:,] ))(?:(?:N\d+|the following|these|the|your)"
    rf" )?(?:headings|bearings|directions)(?: are|,|:| in turn[,:]?|"
    rf" to face[,:]?)? ?(?={f.V} ?(?:,|and|then))"
)
_LOOKING = f.compiled(
    r"\b(?:stay|stop|remain|wait|hold) (?:here|there|where you (?:are|lie|sit)|put|in place)(?:,?"
    r" and| to) (?:search|look|watch|scan|listen|observe|film|"
    r"record|monitor|detect)"
    rf"(?: (?:from )?(?:here|there|this spot|that spot))?(?=,? for {w.T})"
)
_KEPT_ON = f.compiled(
    r"\b(?:maintain|hold|keep) (?:your |the |this )?(?:position|station),? (?=T\d)"
)
_LABEL = f.compiled(
    r"\b(?P<kind>(?:register|enter|note|log|record|add)(?: down)? (?:the |an |this |your"
    r" )?(?:observation|remark|entry|finding)[,:]?|(?:labelled|named|"
    r"called|tagged|"
    r"with the (?:label|tag|note|name)|under the (?:tag|label|name)|the (?:label|tag))[,:]?)"
    r" (?!of\b|as\b|in\b|it\b|that\b|is\b|from\b|with\b|and\b)"
    r"(?:(?!and\b|then\b|at (?:every|each|both|the|P)|on (?:every|each|both|the)|in"
    r" (?:every|each|both|the)|during\b|while\b|when\b|before\b|after\b|hold\b|"
    r"for T)"
    r"(?:[a-z][a-z'-]*|N\d+) ?){1,6}(?=[.,;:]|and"
    r" (?:drop|take|log|register|check|save|record|mark|note|read|measure|put|set|fetch|give|get|have|verify)\b|$)"
)
"""A text that is written down."""
_OCCASION = f.compiled(
    r"\b(?:pre|post)-? ?(?:survey|departure|dive|mission|transit|docking|mooring|sailing|start)\b"
)
_QUALITY = f.compiled(r"\b(?:picture|image|frame|camera) (?:quality|sharpness|focus)\b")
_SPEND = f.compiled(rf"\bspend (?:a |another )?(?={w.T})")
_AT_EACH = f.compiled(
    rf"(?:(?<=[,;:] )|(?<=\band )|(?<=\bwith ))(?:a )?(?P<t>{w.T}) (?P<each>(?:at|on)"
    r" (?:each|every|both)\b)"
)
_AS_FAR = f.compiled(
    r"\bcome back as far as (?:the |our )?(?=(?:[a-z'-]+ ){0,3}?P\d)|\b(?:back|out|up|down|in|over)"
    r" as far as (?=(?:[a-z'-]+ ){0,3}?P\d)"
)


def in_plain_words(text: str, parameters: Mapping[str, Any]) -> str:
    """The text with wordings that `sequence` reads."""
    text = re.sub(r"\s+", " ", text)
    for name, pattern in _TIMES:
        value = parameters.get(name)
        if isinstance(value, int | float):
            text = pattern.sub(f"T{value:g}", text)
    radius = parameters.get("radius")
    if isinstance(radius, int | float):
        text = _RADIUS.sub(f"L{radius:g} radius", text)
    text = _RADIANS.sub(lambda match: f"D{round(math.degrees(float(match['n'])), 2):g}", text)
    text = _GOING.sub("go to ", _FROM.sub(" ", _STARTS_AT.sub(" ", _AS_FAR.sub("go to ", text))))
    text = _KEPT_ON.sub("hold for ", _LOOKING.sub("hold", _HEADINGS.sub("turn to ", text)))
    text = _AT_EACH.sub(r"hold \g<t> \g<each>", _SPEND.sub("hold for ", text))
    text = _ARC_IN_PIECES.sub(
        lambda match: re.sub(r"\s+", " ", _PIECE_MARK.sub(" ", match[0])), text
    )
    text = _QUALITY.sub("quality", _OCCASION.sub(" ", _LABEL.sub(r"\g<kind>", text)))
    if len(re.findall(r"\bP\d", text)) == 3:
        text = _AFTER_THIRD.sub("after the last", text)
    text = _AFTER_LAST.sub(" then ", re.sub(r"\s+", " ", text))
    return re.sub(r"\s+", " ", _DONE.sub(" then ", text))
