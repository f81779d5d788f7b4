"""How task inputs word the places that are gone to: the patterns by which `destinations` reads
them.
"""

from __future__ import annotations

import re

from planner_ft.decoding.constraints.reading.paths.run_wordings import whole_words

_VERB = (
    r"(?:go(?:es|ing)?|head(?:s|ing|ed)?|proceed(?:s|ing)?|transit(?:s|ing)?|driv(?:es?|ing)|sail(?:s|ing)?|motor(?:s|ing)?|steam(?:s|ing)?|"
    r"cruis(?:es?|ing)|"
    r"mov(?:es?|ing)|navigat(?:es?|ing)|run(?:s|ning)?|travel(?:s|ling)?|return(?:s|ing)?|com(?:es?|ing)|mak(?:es?|ing)|get(?:s|ting)?|"
    r"set(?:ting)?|"
    r"steer(?:s|ing)?|tak(?:es?|ing)|bring(?:s|ing)?|position(?:s|ing)?|put(?:s|ting)?|plac(?:es?|ing)|shift(?:s|ing)?|chang(?:es?|ing)|"
    r"relocat(?:es?|ing)|"
    r"continu(?:es?|ing)|carry(?:ing)? on|push(?:ing)? on|press(?:ing)?"
    r" on|leav(?:es?|ing)|cross(?:es|ing)?|berth(?:s|ing)?|dock(?:s|ing)?|"
    r"pass(?:es|ing)?|start(?:s|ing)?|begin(?:s|ning)?|follow(?:s|ing)?|track(?:s|ing)?|trac(?:es?|ing)|end(?:s|ing)?|finish(?:es|ing)?|stop(?:s|"
    r"ping)?|"
    r"moor(?:s|ing)?|tie|back|out|over|away|across|straight|onward|line up|lin(?:es?|ing)"
    r" up|send(?:ing)?|call|walk|transfer(?:s|ring)?|swing by|"
    r"drop (?:down|over)|ease|nose|close)"
)
_TO = r"(?:to|for|into|onto|towards?|via|by way of|through)"
_NOUN = (
    r"(?:(?:the |a |its"
    r" )?(?:position|point|spot|way-?points?|coordinates|co-ordinates|location|berth|dock|place|mark|station|buoy|"
    r"site)(?: (?:at|of|on))?\s*,?:?\s*)?"
)
TO_PLACE = re.compile(
    rf"\b{_VERB}\b(?:(?! (?:to|for|until|after|from|at) )(?:[^.;:,\d§]|,(?!"
    rf" and))){{0,40}}?\s+{_TO}\s+{_NOUN}$",
    re.IGNORECASE,
)
"""Words that lead to the place behind them: "proceed to the point"."""
AT_PLACE = re.compile(
    rf"\b(?:start\w*|begin\w*|end(?:ing)?(?: it|"
    rf" up)?|finish\w*|stop|be|berth\w*|dock\w*|moor\w*|arriv\w+|call|(?:position|place|put)"
    rf" (?:it|her|"
    rf"yourself|the (?:boat|vessel|craft|vehicle|usv))|"
    rf"line (?:her )?up|lin(?:es?|ing) up|hold|wait|stand|ending)\s+(?:at|from|on|with)\s+{_NOUN}$",
    re.IGNORECASE,
)
"""Words for a stop, a start or an end at the place behind them."""
REACHING = re.compile(
    rf"\b(?:reach|visit|approach|mak(?:e|ing)|via|attain|berth|gain)(?:es|ing|ed)?\s+{_NOUN}$",
    re.IGNORECASE,
)
"""Verbs that a place follows directly: "reach", "visit"."""
FROM_PLACE = re.compile(
    rf"\b(?:run|go|drive|sail|pass|follow|track|trace|steam|motor|move|cruise|cross|line|leg|transect|straight|proceed|travel|stretch|make|along|"
    rf"face|head)\w*\b"
    rf"[^.;:\d§]{{0,40}}?\bfrom\s+{_NOUN}$",
    re.IGNORECASE,
)
"""A run from the place behind these words."""
OPENING = re.compile(
    rf"^\W*(?:and\s+|then\s+|now\s+|first(?:ly)?,?\s+|second(?:ly)?,?\s+|third(?:ly)?,?\s+|finally,?\s+|next,?\s+)*(?:{_TO}\s+|from\s+|on"
    r" to\s+|"
    rf"out to\s+|over to\s+|back to\s+|at\s+)?{_NOUN}$",
    re.IGNORECASE,
)
"""A place that opens a clause, with a preposition or without one."""
FROM_OPENING = re.compile(
    r"^\W*(?:and\s+|then\s+)*(?:from|starting (?:at|from)|beginning (?:at|from)|to|on to|out"
    r" to)\s+(?:the )?$",
    re.IGNORECASE,
)
"""A clause that opens with "from" or "to"."""
LINK = re.compile(
    rf"^[\s,§/–—>-]*(?:(?:and|then|next|after that|afterwards|finally|lastly|followed"
    rf" by|on|over|out|across|along|back|up|down|"
    rf"(?<!home )(?<!steady )(?<!settled )(?<!settle )(?<!centred )(?<!hold )(?<!free"
    rf" )again|first|from there|in turn|straight|direct\w*)\b[\s,]*)*"
    rf"(?:(?:in a straight line\s+)?{_TO}\s+)?{_NOUN}[\s>-]*$",
    re.IGNORECASE,
)
"""What may stand between two places of one list."""
LISTED = re.compile(
    r"(?:^|[,;:]|\bthen\b|\s[-–—>]+)\s*(?:(?:and|then|next|to|at|on to)\s+)*(?:the )?$",
    re.IGNORECASE,
)
"""Before an item of a list."""
LISTED_BEHIND = re.compile(r"^\s*(?:[,;.:)–—>-]|and\b|then\b|first\b|last\b|$)", re.IGNORECASE)
"""Behind an item of a list."""
SEQUENCE = re.compile(
    r"\b(?:trip|route|tour|rounds?|legs|stops|waypoints|points|order|destinations?|list|moves)\b"
    r"[^.;§]{0,20}(?:by|via|:|,|through|over|[-–—])?\s*$",
    re.IGNORECASE,
)
"""Words before places to be visited one after the other."""
TO_THING = re.compile(
    rf"\b{_VERB}\b(?:(?! (?:to|for|until|after|from|at) )(?:[^.;:,\d§]|,(?!"
    rf" and))){{0,40}}?\s+(?:{_TO}|from)\s+(?:the |an? |our |"
    rf"its )(?:[\w'’-]+ ){{1,4}}?(?:at|on)\s+$",
    re.IGNORECASE,
)
"""On the way to a thing whose place follows: "go to the pile at"."""
TO_THING_NEXT = re.compile(
    r"^\W*(?:(?:and|then)\s+)*(?:to|from|for)\s+(?:the |an? )(?:[\w'’-]+"
    r" ){1,4}?(?:at|on)\s+$|§[^.;:§]{0,3}\bto (?:the |"
    r"an? )(?:[\w'’-]+ ){1,4}?at\s+$",
    re.IGNORECASE,
)
"""The same in a list."""
DONE_AT = re.compile(
    r"\b(?:snapshots?|sound\w*|pins?|mark\w*|photo\w*|pictures?|stills?|depths?|fix(?:es)?|readings?|holds?(?!"
    r" position)|stops?|stations?|"
    r"measure\w*|recording|profiles?|snaps?|drop\w*|check\w*|"
    r"shots?|labelled|called|named|noted)\b[^.;:§]{0,30}\b(?:at|to|as far as|off|for)\s+$|\b(?:as"
    r" far as|up to|until|on to|out to|over to|"
    r"back to|by way of)\s+$",
    re.IGNORECASE,
)
"""Something that is done at a place, and so leads there."""

# What is no destination, or not for certain
AT = re.compile(rf"\b(?:at|on|in|from|of|by|with|to)\s+{_NOUN}$", re.IGNORECASE)
"""A preposition before a place."""
NOUN_WAY = re.compile(
    r"\b(?:legs?|ways?|runs?|trips?|passages?|transits?|stretch(?:es)?|routes?|approach(?:es)?|parts?|stages?|moves?|rides?|journeys?|drives?|"
    r"get(?:ting)?|"
    r"one|ones|course|steps?|sail|going)\s+(?:(?:on|out|back|over|home|up|down|there|only|leading)\s+)*(?:to|from|towards|into|at|before|after|"
    r"for)\s+(?:the )?$",
    re.IGNORECASE,
)
"""The way as a thing: "on the leg to", "getting to"."""
ARTICLE_WAY = re.compile(
    r"\b(?:the|each|every|that|this|all|both|either"
    r" way|any|first|second|third|last|next|one|two|three|on|during|in)\s+(?:\w+\s+)?$",
    re.IGNORECASE,
)
"""What stands before a way as a thing."""
SUBORDINATE = re.compile(
    r"\b(?:while|when|whilst|whenever|as|once|after|before|until|till|during|as soon"
    r" as|where|having|by the time|the moment)\b[^.;:,§]{0,60}$",
    re.IGNORECASE,
)
"""A place in a clause beside another: "while you go to"."""
NEGATED = re.compile(
    r"\b(?:not|n't|never|no|without|except|nothing|none|nor|neither|n’t|don't|don’t|besides|other"
    r" than)\b[^.;:§]{0,40}$",
    re.IGNORECASE,
)
"""A place that is ruled out."""
MENTION = re.compile(
    r"\b(?:(?:stay|remain|keep|hold)\w*(?: \w+)? (?:\w+"
    r" )?(?:of|from|within|to)|lies|is|are|was|were|stands|sits|seen|spotted|reported|located|"
    r"found|centred|centered|around|about|round|"
    r"circle|orbit|of|look\w*|fac(?:e|ing)|point\w*|towards|between|near|past|clear of|relative"
    r" to|off|anchored|moored|bow \w+|known)\s*(?:at |"
    r"on |in )?(?:the (?:point|position) )?(?:at )?$",
    re.IGNORECASE,
)
"""What stands before a place that is no destination."""
BETWEEN_HERE = re.compile(
    r"\bbetween (?:here|there|(?:the|your|our) (?:present|current) (?:position|place)|where \w+"
    r" (?:are|is)) and $",
    re.IGNORECASE,
)
""""Between here and" a place."""
ROUND = re.compile(
    r"\b(?:round|around|circling|orbiting|circle|orbit)\s+(?:the \w+ at )?$", re.IGNORECASE
)
"""A place that is circled."""
OFF_PLACE = re.compile(r"\d\s?(?:m|met(?:re|er)s?) off\s+(?:the \w+ at )?$", re.IGNORECASE)
"""A place that some way is kept off."""

# The task's own place
_OWN_ADJECTIVE = (
    r"(?:(?:task'?s?|given|planned|stated|goal|target(?:['’]s)?|start(?:ing)?|cable|ordered|named|set|designated|final|pass|track|last"
    r" known|"
    r"last reported|known|"
    r"reported|specified|intended|search|panned|orbit|circle|survey|area|docking) )*"
)
OWN = re.compile(
    r"\b(?:the |its |her |our |my"
    rf" )?{_OWN_ADJECTIVE}(?P<noun>target|goal|cent(?:re|er)|start|position|point|berth|location|destination|beginning|coordinates)"
    r"(?: (?:of|in|for|from|on|to) (?:the |its |this"
    r" )?(?:task|cable|track|run|order|survey|orbit|area|planned track|planned run|circle|"
    r"begin \w+))?(?! (?:feature|id\b|mark|list|of\b|in frame|centred|cloud))\b(?!['’]s)",
    re.IGNORECASE,
)
"""The task's own place, by its noun."""
LAST_SEEN = re.compile(
    r"\bwhere (?:it|he|she|they|the target|\w+ \w+) (?:was|were|had been|has been) (?:last"
    r" )?(?:seen|reported|located|found|"
    r"spotted)(?: last)?",
    re.IGNORECASE,
)
""""Where it was last seen"."""
GIVEN_PLACE = re.compile(
    r"\b(?:planned|given|stated|goal|docking|target|task|start)"
    r" (?:position|point|start|berth|location)\b",
    re.IGNORECASE,
)
"""The task's place by its full name."""
HERE = whole_words(
    r"(?:your|this|our|present|current) \w+|^position|^point|^the (?:position|point)$|^start$"
)
"""A place of the vehicle's own, or of nothing in particular."""
NAMES_NEXT = re.compile(r"^\W*(?:(?:at|of|which is|is|namely|that is|in)\s+)?§", re.IGNORECASE)
"""A stated place right behind."""
NO_OWN = re.compile(
    r"\b(?:keep|hold(?! (?:position"
    r" )?(?:at|off|on)\b)|centre\w*|point\w*|look\w*|turn\w*|rotat\w+|fac\w+|bow|pose|pixel|error|offset|relative|distance|"
    r"respect|lock\w*|listen\w*|watch\w*|steady on|stay(?! at))\b[^.;:,]{0,40}$",
    re.IGNORECASE,
)
"""Words before a target that is watched, not gone to."""
NO_OWN_BEHIND = re.compile(
    r"^ (?:to (?:follow|be|track|watch)|feature|id|mark|description|centred|in (?:view|the"
    r" (?:picture|frame)))\b",
    re.IGNORECASE,
)
"""The target as a thing that is looked at."""
FROM_TO = re.compile(r"^ to (?:the )?(?:finish|end)\b", re.IGNORECASE)
""""From start to finish"."""
BARE_START = re.compile(r"^start$", re.IGNORECASE)
""""Start" without an article: mostly a verb."""
BACK_START = re.compile(r"\b(?:back|return\w*)\b[^.;,]*$", re.IGNORECASE)
"""Back to the start: of the track, or of everything."""

# Home
HOME = whole_words(
    r"(?<!\bway )(?<!\bof )(?<!\brelative to )(?<!\bpose to )(?<!\bat )(?<!\bis )(?<!\bfrom"
    r" )(?<!\bleg )(?<!\bthe one )"
    r"(?<!\bthe run )(?<!\btrip )(?<!\bpart )(?<!\bstretch )(?<!\bpassage )(?<!\bthe drive"
    r" )(?<!\bleft )(?<!\bways )(?<!\bout and )(?<!\btransit )"
    r"home(?!:)(?! (?:leg|run|stretch|trip|way|is|berth|port))|"
    r"(?:go|head|sail|come|run|return|get|drive) (?:back )?to (?:the )?base|return(?= (?:[.;,]|in"
    r" the end|at the end|then))|(?:come|go|head|"
    r"sail|run) back(?=\s*(?:[.,;:]|$|with|while|at \d))|"
    r"return(?=\s*(?:[.,;]|$))"
)
"""The way home, where it is no thing that is spoken of."""
NO_HOME = re.compile(
    r"\b(?:relative|pose|distance|range|readings?|offset|bearing)\b[^.;,]{0,25}$", re.IGNORECASE
)
"""Home as what something is measured to."""
GO_IN = re.compile(
    r"\b(?:go|going|come|coming|run|head)\b in\b(?=\s*(?:[.,;:]|$|and|then|while|with (?:the"
    r" )?(?:heading|bow)))",
    re.IGNORECASE,
)
"""Into the berth."""
