"""How task inputs word places, legs and returns one after the other: the patterns by which `chains`
reads them.
"""

from __future__ import annotations

import re

# Places
_SELF = r"(?:you|u|we|she|he|it|the (?:boat|vessel|craft|usv|vehicle|ship))"
_ARE = r"(?:['’]re| are| r|['’]s| is| lies?| lay| sits?| waits?| float\w*| stands?| starts?)"
LYING = re.compile(
    rf"\b{_SELF}{_ARE}(?: (?:already|now|currently|lying|stopped|at"
    r" rest|waiting|sitting|moored|anchored|still|berthed|off|there|right|made fast))*,? "
    rf"(?:at|on|in)\s+$|"
    r"\b(?:your|our|her|the|its) (?:(?:present|current|own|starting)"
    r" )*(?:position|place|spot|berth|mooring|anchorage|jetty|slip|pontoon)(?: is| being|"
    r",|:)?(?: (?:now|here))?"
    r"(?: at)?[,:]?\s+$|"
    rf"\bwhere {_SELF}{_ARE}(?: (?:now|already|lying|moored))*(?: at|,|:|,? (?:that|which)"
    r" is)*\s+$|"
    r"\b(?:lying|moored|anchored|berthed)(?: \w+)? at\s+$|\bfrom (?:here|where you are)(?:,| at|"
    r" \()*\s*$",
    re.IGNORECASE,
)
"""Before the place where the vehicle lies."""
LYING_BEHIND = re.compile(
    r"[\s,(–-]*(?:which is |that is |that'?s |being |i\.?e\.? )?(?:(?:the place |the point |the"
    rf" spot |the berth |right |just )?where {_SELF}{_ARE}|"
    rf"{_SELF}{_ARE} (?:already |now |lying |right )*"
    r"(?:there|here)|(?:your|our|the|her) (?:present|current|own)"
    r" (?:position|place|spot|berth|mooring))(?: (?:now|already|at the moment|lying|moored|"
    r"at present|right now))*[,)–-]*",
    re.IGNORECASE,
)
"""Behind it."""
PLACE_LED = re.compile(
    r"(?:^|[.,;:]|\b(?:to|at|via|from|through|reach|reaching|visit|leave|leaves|leaving|first|then|datum|start|begin|end|finish|on|onto|is|for|and|"
    r"position|point|past|as far as)\b)[\s,:]*"
    r"(?:(?:the|its|a|an|your|her) )?(?:(?:[\w'’-]+ ){0,5}?(?:at|to|is|,)\s*)?$",
    re.IGNORECASE,
)
"""Before a place that is gone to."""
NO_PLACE = re.compile(
    r"\b(?:of|off|around|round|about|between|near|by|past|towards?|facing|relative to|not|from"
    r" (?:the|any|all|every) [\w -]+|clear of|away from|until|"
    r"when|once|after|before|while|between|beyond|till|behind)"
    r"(?: [\w'’-]+){0,3}\s*$",
    re.IGNORECASE,
)
"""Before a place that is told for something else."""
LOOKED_AT = re.compile(
    r"\b(?:point(?:s|ing)?(?= (?:the"
    r" (?:bow|camera|lens|nose)|it\b|her\b|at\b|to\b|towards))|bow|fac(?:e|es|ing)|look\w*|aim\w*|nose|camera|turn\w*|"
    r"lens|bearing)\b",
    re.IGNORECASE,
)
"""In a clause with a place that is only looked at."""
FROM_START = re.compile(
    r"\b(?:go |run |head |proceed |steam |from|at|leav\w+|first |begin\w* |start\w*"
    r" )*(?:from|at|to|leaving|leave|reach) (?:the|its) (?:(?:given|"
    r"planned|stated|cable|pipe|pipeline|track)(?:['’]s)? )*start(?:ing)?(?:["
    r" -](?:point|position))?"
    r"(?: of (?:the|its) (?:cable|pipe\w*|track|line|run))?(?: first)?\b(?! (?:at|is|of)\b)(?!,?"
    r" ?(?:§|\())",
    re.IGNORECASE,
)
"""The task's own start as the place to go to."""

# Legs
FROM_LAST = re.compile(
    r" from (?:it|there|the (?:second|third|fourth|last|previous)(?:"
    r" (?:one|point|corner|way-?point))?)(?=[.,;])",
    re.IGNORECASE,
)
"""Behind a leg: what it is counted from in any case."""
DROPPED = re.compile(
    r"[.,;]?\s*(?:(?:actual?ly|no|wait|and|but|on second"
    r" thoughts?|please|sorry),?\s+)*(?:drop|skip|forget|leave out|cancel|scrap|omit) the (?:last|"
    r"final) (?:one|leg)\b(?:,? the tide is turning| of (?:them|these|the legs))?",
    re.IGNORECASE,
)
PAIR_OF_WAYS = re.compile(r"\b(?:for|towards|at|to|position|point|is|over to)\s+$", re.IGNORECASE)
LEG_BEFORE = re.compile(
    r"(?:[\])\d]|\b(?:legs?|then|square|search|there|run|steam|north|south|east|west|home|on|follow\w*|point|from"
    r" it|where|box))[\s,:;.]*(?:and |then |"
    r"first |go |run |steam )*(?=$)",
    re.IGNORECASE,
)
"""Before legs in two directions, which might be the coordinates of a place."""
BARE_WAY = re.compile(
    r"\d(?: more| further)? (?:due |to the )?(?:north|south|east|west)\b", re.IGNORECASE
)
"""A leg without a unit."""

# Returns
_GO = (
    r"(?:go|goes|come|comes|run|runs|head|steam|sail|return|proceed|get|make|motor|drive|make your"
    r" way|turn(?: round| around)?|be|finish|end)"
)
ORIGIN = re.compile(
    r"\b(?:(?:and|then|finally|from there|straight|direct|directly|right|turn(?: round|"
    rf" around)?|{_GO}|bring (?:it|her)|back|all the way|"
    rf"up)[\s,]+)*(?:back to|to|at|for|by returning to)\s+(?:"
    r"(?:the |its |your |her |that |this |our )?(?:very |same )?(?:start(?!ing"
    r" to\b)(?:ing)?|beginning|origin|departure|first|place of departure)(?:[ "
    r"-](?:point|position|place|spot|waypoint|corner|of the (?:first )?(?:leg|run)))*\b(?!"
    r" (?:of|end|leg|run|the|at|on|recording|logging))|"
    r"(?:the|that|this|its|your|her|our) (?:very |same |old |own"
    r" )*(?:place|spot|berth|mooring|anchorage|slip)\b(?! (?:at|of|where|that|which|you|"
    r"you['’]\w+|she|it)\b)|"
    r"(?:the )?(?:point|place|spot|position|berth|one|waypoint)?\s?(?:where |that |which |from"
    rf" which |from where )?{_SELF} (?:(?:have |had |first "
    rf")?(?:started|began|begun|set out|set off|left|came|departed|lay)|starts?|begins?|lies?|are"
    rf" lying|are now|are|is|leave|left|set out)(?: (?:from|"
    rf"off|out|at|now))?)",
    re.IGNORECASE,
)
"""Back to where the whole began."""
STRAIGHT_BACK = re.compile(
    rf"(?:\b(?:and|then|finally|from there|turn(?: round| around)?)\b[\s,]*)+(?:{_GO}"
    r" )?(?:(?:straight|right|direct(?:ly)?|all the way) )+back(?: "
    rf"again)?(?=\s*(?:[.,;:]|$))|"
    rf"\b(?:and|then)\b[\s,]*(?:{_GO} )?(?:straight |right |direct(?:ly)? )*back(?:"
    rf" again)?(?=\s*(?:[.;:]|$))|\b{_GO} (?:straight |right |directly "
    rf")*back(?: again)?(?=\s*(?:[.;:]|$))",
    re.IGNORECASE,
)
"""Back, without a word of where to: read where there is one leg."""
BEGIN = re.compile(
    rf"\b(?:(?:and|then|finally|from there|straight|direct|directly|right|{_GO}|back|turn(?: round|"
    r" around)?|all the way)[\s,]+)*to (?:where|the "
    rf"(?:point|place|spot) where|the (?:start|beginning) of) "
    r"(?:the |that |this |your )?(?:run|leg|line|pass|track|transect|tow|first leg|last leg)\b(?:"
    r" (?:began|begins|started|starts|begun|set out))?",
    re.IGNORECASE,
)
"""Back to where a run began."""
_LINE = (
    r"(?:the |that |this )?(?:very )?(?:same|own)"
    r" (?:line|way|track|path|route|leg|course|run|transect|legs)"
)
RETRACE = re.compile(
    r"\b(?:(?:and|then|finally|from there|straight|direct|directly|right|turn(?: round|"
    rf" around)?|{_GO})[\s,]+)*(?:{_LINE} (?:straight )?back(?: again)?|"
    rf"(?:back|return\w*)(?: again)? (?:by |along |on |over |down |up |in )?{_LINE}|back (?:again"
    r" )?(?:along|over|down|on|up) (?:it|the (?:line|leg|"
    rf"track|run|cable|pipe\w*))|"
    rf"(?:retrac\w+|revers\w+) (?:it|that|(?:the|this|that|your|both|its) (?:\w+"
    rf" )?(?:legs?|run|line|track|way|course|steps?|route))|"
    rf"(?:back )?the way {_SELF} (?:came|went)|there and back|out and back|and back again)(?:"
    r" back)?\b",
    re.IGNORECASE,
)
ALONG_SAME = re.compile(rf"[\s,]*(?:(?:by|along|on|over|in) )?{_LINE}\b", re.IGNORECASE)
"""Behind a return to a place."""
HALF = re.compile(
    r"\b(?:(?:and|then|finally|from there|straight|turn(?: round|"
    rf" around)?|{_GO})[\s,]+)*(?:(?:half (?:of )?(?:that|it|the (?:way|distance|length|leg|"
    rf"run))|half-?way) (?:straight )?back(?: again)?(?: (?:along|on|over) {_LINE}|"
    rf" (?:along|on) it)?|back (?:again )?(?:(?:along|on|over|by|down) (?:{_LINE}|it|the"
    r" (?:line|leg|track|run))(?: for)?,? )?(?:for )?(?:half (?:of "
    rf")?(?:that|it|the (?:way|distance|length|leg|run))|half-?way)"
    rf"(?: (?:along|on|over) {_LINE})?)\b",
    re.IGNORECASE,
)
"""Back along the last leg, half of it."""

# What leads nowhere, and what may be told otherwise
SCOPES = re.compile(
    r"\b(?:"
    r"(?:while |when |on |during |in )?(?:going|getting|running|coming|moving) (?:out |over"
    r" )?(?:to|towards) (?:the |its )?(?:start\w*|beginning|first|"
    r"it|there)(?: (?:point|position|place|waypoint))?|"
    r"(?:the )?(?:run|way|leg|transit|passage|trip|approach)(?: out| over| up| in)? (?:to|towards)"
    r" (?:(?:the |its )?(?:start\w*|beginning|first)(?: "
    r"(?:point|position|waypoint))?|it|there))\b",
    re.IGNORECASE,
)
"""Words for the way to the start, which say where something is done."""
NOTHING = re.compile(
    r"\b(?:expanding square(?: search)?|box search|triang\w+|dog[- ]?leg|"
    r"(?:(?:two|three|four|five|six|[2-6]) )?(?:straight )?(?:legs?|runs?|lines?)(?:"
    r" (?:one|two|three|four|five|[1-6]))?(?= ?[:,(]| (?:from|is|of|on|"
    r"to)\b|\s*(?:\d|$))|"
    r"(?:first|second|third|fourth|fifth|next|last|final) (?:leg|run|line)\b(?=[:,. ]|"
    r" is)|(?:start(?:ing)?|first)[ -]?(?:point|position|corner)?[\s:,]*(?=§)|"
    r"(?:so |and )?(?:go|head|proceed|run|get) there(?: first)?(?=[.,;]| and\b)|"
    r"(?:not|nor|never) (?:before|after|until|on the (?:way|run) (?:there|out))(?:"
    r" (?:it|that|this|then|them))?|"
    r"(?:on|for|during|in) (?:that|this|the|these|those|each|all|every|both) (?:\w+"
    r" )?(?:run|leg|line|way|pass)s?\b(?: (?:out|back|home|only|alone))?|"
    r"from the (?:start|starting|first) (?:point |place"
    r" )?on(?:wards?)?|(?:first|second|third|last|next|other) (?:leg|run|corner|one)|with"
    r" (?:that|the "
    r"\w+) (?:leg|run) done)\b",
    re.IGNORECASE,
)
"""Words that add nothing to what was read."""
LEAD_IN = re.compile(
    r"(?:\b(?:then|and|next|now|finally|go|goes|run|runs|running|steam|steer|sail|head|proceed|continue|carry|move|moves|shift|drive|motor|make|do|"
    r"follow|following|track|take|take it|in|get|onto|"
    r"from|that|this|there|point|place|here|to|at|on|along|out|straight|another|further|a|an|the|it|leg|line|first|via|for|over|up|down|with|of|by|"
    r"cross|set|your|her|way|due|on to|"
    r"leave|leaves|leaving|start|starts|starting|begin|begins|beginning|stop|return|back|come|pick|cable|pipe|pipeline|is|are|you|she|we|trawl|retrace|"
    r"turn|round)\b[\s,:;]*)+$",
    re.IGNORECASE,
)
BETWEEN = re.compile(
    r"\b(?:port|starboard|left|right|each|twice|times|repeat\w*|half|but|if|unless|instead|rather|sorry|or|abeam|parallel|beside|zig-?zag|grid|square|"
    r"lanes|reciprocal|opposite|every|"
    r"alternat\w*|spaced|apart|arc|circle|orbit|(?:do|does)? ?not"
    r" (?:go|run|return)|midpoint|middle)\b",
    re.IGNORECASE,
)
"""In a sentence with a leg: it may be told otherwise."""
BESIDE = re.compile(
    r"\b(?:to|on|off|along) (?:the|its|your)"
    r" (?:right|left|port|starboard|(?:north|south|east|west)(?:[ -]?(?:east|west))?(?:ern)?)"
    r" (?:of|side|hand|"
    r"face)\b|\boff (?:it|the)\b|"
    r"\b(?:parallel|abeam|beside|alongside|shifted|displaced|offset|stand-?off|mirror\w*)\b",
    re.IGNORECASE,
)
"""Words of a run that does not go where it is told, but beside it."""
