"""How task inputs word straight runs, tracks and ways to a place: the patterns by which `runs` reads them."""

from __future__ import annotations

import re

_NUMBER = r"[-−–]?\d+(?:\.\d+)?"
_WAY = r"(?:north[ -]?(?:east|west)|south[ -]?(?:east|west)|north|south|east|west)"
WAY = re.compile(rf"\b({_WAY})(?:ern|wards?|erly|bound)?\b", re.IGNORECASE)
"""A compass direction."""


def _words(pattern: str) -> re.Pattern[str]:
    return re.compile(rf"\b(?:{pattern})\b", re.IGNORECASE)


# Places
EXPLICIT = re.compile(
    rf"[\[(]\s*(?:x\s*[=:]?\s*)?(?P<a>{_NUMBER})\s*[,;/]?\s*(?:y\s*[=:]?\s*)?(?<=[\s,;/=:y])(?P<b>{_NUMBER})\s*[\])]"
    rf"|\bx\s*[=:]?\s*(?P<c>{_NUMBER})\s*(?:,|and|/|;)?\s*y\s*[=:]?\s*(?P<d>{_NUMBER})"
    rf"|(?<![\w.])(?P<e>{_NUMBER})\s?(?:m|met(?:re|er)s?)?\s?(?P<f>east|west|north|south)\s*(?:,|and)?\s*(?P<h>{_NUMBER})\s?(?:m|met(?:re|"
    rf"er)s?)?\s?"
    rf"(?P<i>east|west|north|south)\b(?! (?:of|from|off) (?:[\[(]|x\b))(?P<j> (?:of|from) (?:the )?\w+)?",
    re.IGNORECASE,
)
"""A place that can be taken for nothing else: in brackets, with its axes, or with the directions of both numbers."""
OF_HOME = re.compile(r" (?:of|from) (?:the )?(?:home|here|base|origin)$", re.IGNORECASE)
"""Coordinates counted from home."""
SIGNED = re.compile(r"\b(?:minus|negative)\b|(?:^|[\s,(])[-−–]\d", re.IGNORECASE)
"""A number with a sign before it."""

# Text that is not read
STOP = _words(
    r"two (?:north|south|east|west)[\w-]* lines|degrees to the (?:left|right) of (?:the|that)|"
    r"zig-?zag|spiral|triang\w+|hexagon\w*|pentagon\w*|octagon\w*|figure|ellip\w+|oval|diamond|ring|lawn-?mow\w*|grids?|lanes?|mow\w*|"
    r"boustrophedon|"
    r"spacing|mapped|apart|wide|\d ?m by|met(?:re|er)s? by|creeping|sector search|expanding|rectangle(?! from {4,})|mirror\w*|squares?|"
    r"half[ -]?way|mid-?point|midway|(?<!of the )survey(?! (?:centre|center|begins|vessel|boat|team|data|start\w*|complete\w*|company))|"
    r"surveying|inspecting|lines \d|(?:waypoints|points|stops|stations|places) (?:evenly |equally )?(?:spaced |spread )?(?:round|around|about|"
    r"on (?:the|a) circle|evenly)|"
    r"(?:\d+|three|four|five|six|eight|ten|twelve) (?:even\w* |equally |spaced )*(?:way)?points(?!\W*(?:minus |x |\(|\[|-?\d+(?:\.\d+)?,))|"
    r"inspect(?:s|ing)?|(?:evenly|equally) spaced|"
    r"hops?|stairs?|circle of|way-?points? (?:every|each) (?:\d+ ?(?:deg\w*|°)|quarter)|the way you came|points? in a row|reciprocal|dog[- ]?leg|"
    r"star (?:on|round|from)|o['’]clock of|"
    r"turn(?:ing|s)? back|middle of the line|in the middle|negative, (?!\d)|"
    r"(?:two|three|four|\d) (?:\w+ )?(?:passes|rounds)|correction|rather|instead|actually|sorry|i mean|scrap|scratch that|no, |hang on|"
    r"make (?:it|that)|backwards|vice versa|"
    r"between the (?:two|buoys|piles)|if|unless|skip(?:s|ping)?|leave out|leaving out|in the order \w+"
)
"""Other shapes, corrections and conditions: where they are, nothing is read."""
ORDER = _words(
    r"but (?:first|before)|before (?:that|this|it|which|then|all|you (?:do|go)|anything|setting|leaving)|(?:that|this|it) comes? (?:first|last|"
    r"before)|"
    r"(?<=\w )(?<!the )(?<!in )first(?=[.;](?! then\b)|$|, (?!then|and then))|but (?:call|go|visit|via|not (?:before|until|to)|only after)|twice|"
    r"(?<!home )(?<!steady )(?<!settled )(?<!settle )(?<!centred )(?<!hold )(?<!free )again|repeat\w*|laps?|there and back|out and back(?! not)|"
    r"and back(?=[.,;]|$)|(?<!come )(?<!go )(?<!head )(?<!sail )(?<!run )(?<!brought )back(?=[.,;]|$)|on the way (?:there )?(?:call|stop|visit|take|go)\w*|"
    r"one first|one last|"
    r"begins with|clos(?:e|es|ing) (?:the|it|with)|"
    r"in both directions|back and forth|either way|(?<!logged )(?<!them )(?<!recording )both ways|last of all|preceded|"
    r"in reverse|reversed?|the other way|ends? with|prior|(?:three|four|five|\d+) times|once more|come[s]? before|afterwards? (?:only|you)|"
    r"first of all|preced\w+"
)
"""Words that turn the order of the text round, or repeat a part of it."""
AFTER_INSIDE = re.compile(r"\w[^.;:]*?,?\s\b(?:after|once|when|as soon as|having)\b[^.;]*$", re.IGNORECASE)
"""A clause with another one before it that happens later: "Go to B after the run to A"."""
BEFORE_FIRST = re.compile(
    r"(?:^|[.;:]\s*)(?:right |just |shortly |immediately |but )?(?:before|until|prior)\b[^.;:,]*(?:[\d\])]|home|start|target|position|\bto\b|"
    r"reach\w*)",
    re.IGNORECASE,
)
"""A sentence that begins with what comes later: "Before going to B, go to A"."""
FIRST_LAST = re.compile(r"\b(?:last|finally|second)\b[^.;]{0,30}\bfirst\b|\bpreced\w+|\bbefore (?:she|he|it|they)\b", re.IGNORECASE)
"""What comes first is said last."""

# Ways to a place
_VERB = (
    r"(?:go(?:es|ing)?|head(?:s|ing|ed)?|proceed(?:s|ing)?|transit(?:s|ing)?|driv(?:es?|ing)|sail(?:s|ing)?|motor(?:s|ing)?|steam(?:s|ing)?|"
    r"cruis(?:es?|ing)|"
    r"mov(?:es?|ing)|navigat(?:es?|ing)|run(?:s|ning)?|travel(?:s|ling)?|return(?:s|ing)?|com(?:es?|ing)|mak(?:es?|ing)|get(?:s|ting)?|"
    r"set(?:ting)?|"
    r"steer(?:s|ing)?|tak(?:es?|ing)|bring(?:s|ing)?|position(?:s|ing)?|put(?:s|ting)?|plac(?:es?|ing)|shift(?:s|ing)?|chang(?:es?|ing)|"
    r"relocat(?:es?|ing)|"
    r"continu(?:es?|ing)|carry(?:ing)? on|push(?:ing)? on|press(?:ing)? on|leav(?:es?|ing)|cross(?:es|ing)?|berth(?:s|ing)?|dock(?:s|ing)?|"
    r"pass(?:es|ing)?|start(?:s|ing)?|begin(?:s|ning)?|follow(?:s|ing)?|track(?:s|ing)?|trac(?:es?|ing)|end(?:s|ing)?|finish(?:es|ing)?|stop(?:s|"
    r"ping)?|"
    r"moor(?:s|ing)?|tie|back|out|over|away|across|straight|onward|line up|lin(?:es?|ing) up|send(?:ing)?|call|walk|transfer(?:s|ring)?|swing by|"
    r"drop (?:down|over)|ease|nose|close)"
)
_TO = r"(?:to|for|into|onto|towards?|via|by way of|through)"
_NOUN = (
    r"(?:(?:the |a |its )?(?:position|point|spot|way-?points?|coordinates|co-ordinates|location|berth|dock|place|mark|station|buoy|"
    r"site)(?: (?:at|of|on))?\s*,?:?\s*)?"
)
TO_PLACE = re.compile(rf"\b{_VERB}\b(?:(?! (?:to|for|until|after|from|at) )(?:[^.;:,\d§]|,(?! and))){{0,40}}?\s+{_TO}\s+{_NOUN}$", re.IGNORECASE)
"""Words that lead to the place behind them: "proceed to the point"."""
AT_PLACE = re.compile(
    rf"\b(?:start\w*|begin\w*|end(?:ing)?(?: it| up)?|finish\w*|stop|be|berth\w*|dock\w*|moor\w*|arriv\w+|call|(?:position|place|put) (?:it|her|"
    rf"yourself|the (?:boat|vessel|craft|vehicle|usv))|"
    rf"line (?:her )?up|lin(?:es?|ing) up|hold|wait|stand|ending)\s+(?:at|from|on|with)\s+{_NOUN}$",
    re.IGNORECASE,
)
"""Words for a stop, a start or an end at the place behind them."""
REACHING = re.compile(rf"\b(?:reach|visit|approach|mak(?:e|ing)|via|attain|berth|gain)(?:es|ing|ed)?\s+{_NOUN}$", re.IGNORECASE)
"""Verbs that a place follows directly: "reach", "visit"."""
FROM_PLACE = re.compile(
    rf"\b(?:run|go|drive|sail|pass|follow|track|trace|steam|motor|move|cruise|cross|line|leg|transect|straight|proceed|travel|stretch|make|along|"
    rf"face|head)\w*\b"
    rf"[^.;:\d§]{{0,40}}?\bfrom\s+{_NOUN}$",
    re.IGNORECASE,
)
"""A run from the place behind these words."""
OPENING = re.compile(
    rf"^\W*(?:and\s+|then\s+|now\s+|first(?:ly)?,?\s+|second(?:ly)?,?\s+|third(?:ly)?,?\s+|finally,?\s+|next,?\s+)*(?:{_TO}\s+|from\s+|on to\s+|"
    rf"out to\s+|over to\s+|back to\s+|at\s+)?{_NOUN}$",
    re.IGNORECASE,
)
"""A place that opens a clause, with a preposition or without one."""
LINK = re.compile(
    rf"^[\s,§/–—>-]*(?:(?:and|then|next|after that|afterwards|finally|lastly|followed by|on|over|out|across|along|back|up|down|"
    rf"(?<!home )(?<!steady )(?<!settled )(?<!settle )(?<!centred )(?<!hold )(?<!free )again|first|from there|in turn|straight|direct\w*)\b[\s,]*)*"
    rf"(?:(?:in a straight line\s+)?{_TO}\s+)?{_NOUN}[\s>-]*$",
    re.IGNORECASE,
)
"""What may stand between two places of one list."""
NOUN_WAY = re.compile(
    r"\b(?:legs?|ways?|runs?|trips?|passages?|transits?|stretch(?:es)?|routes?|approach(?:es)?|parts?|stages?|moves?|rides?|journeys?|drives?|"
    r"get(?:ting)?|"
    r"one|ones|course|steps?|sail|going)\s+(?:(?:on|out|back|over|home|up|down|there|only|leading)\s+)*(?:to|from|towards|into|at|before|after|"
    r"for)\s+(?:the )?$",
    re.IGNORECASE,
)
"""The way as a thing: "on the leg to", "getting to"."""
ARTICLE_WAY = re.compile(
    r"\b(?:the|each|every|that|this|all|both|either way|any|first|second|third|last|next|one|two|three|on|during|in)\s+(?:\w+\s+)?$", re.IGNORECASE
)
"""What stands before a way as a thing."""
SUBORDINATE = re.compile(
    r"\b(?:while|when|whilst|whenever|as|once|after|before|until|till|during|as soon as|where|having|by the time|the moment)\b[^.;:,§]{0,60}$", re.IGNORECASE
)
"""A place in a clause beside another: "while you go to"."""
NEGATED = re.compile(
    r"\b(?:not|n't|never|no|without|except|nothing|none|nor|neither|n’t|don't|don’t|besides|other than)\b[^.;:§]{0,40}$",
    re.IGNORECASE,
)
"""A place that is ruled out."""
MENTION = re.compile(
    r"\b(?:(?:stay|remain|keep|hold)\w*(?: \w+)? (?:\w+ )?(?:of|from|within|to)|lies|is|are|was|were|stands|sits|seen|spotted|reported|located|"
    r"found|centred|centered|around|about|round|"
    r"circle|orbit|of|look\w*|fac(?:e|ing)|point\w*|towards|between|near|past|clear of|relative to|off|anchored|moored|bow \w+|known)\s*(?:at |"
    r"on |in )?(?:the (?:point|position) )?(?:at )?$",
    re.IGNORECASE,
)
"""What stands before a place that is no destination."""
AT = re.compile(rf"\b(?:at|on|in|from|of|by|with|to)\s+{_NOUN}$", re.IGNORECASE)
"""A preposition before a place."""

_OWN_ADJECTIVE = (
    r"(?:(?:task'?s?|given|planned|stated|goal|target(?:['’]s)?|start(?:ing)?|cable|ordered|named|set|designated|final|pass|track|last known|"
    r"last reported|known|"
    r"reported|specified|intended|search|panned|orbit|circle|survey|area|docking) )*"
)
OWN = re.compile(
    rf"\b(?:the |its |her |our |my )?{_OWN_ADJECTIVE}(?P<noun>target|goal|cent(?:re|er)|start|position|point|berth|location|destination|beginning|coordinates)"
    r"(?: (?:of|in|for|from|on|to) (?:the |its |this )?(?:task|cable|track|run|order|survey|orbit|area|planned track|planned run|circle|"
    r"begin \w+))?(?! (?:feature|id\b|mark|list|of\b|in frame|centred|cloud))\b(?!['’]s)",
    re.IGNORECASE,
)
"""The task's own place, by its noun."""
OWN_LEADS = re.compile(r"\b(?:to|from|at|reach) (?:the|its) (?:waypoint|start)\b(?=\s*(?:[.,;:-]|$|(?:and|then|on|along)\b))", re.IGNORECASE)
"""Words that lead to the task's own place, or on from it."""
LAST_SEEN = re.compile(
    r"\bwhere (?:it|he|she|they|the target|\w+ \w+) (?:was|were|had been|has been) (?:last )?(?:seen|reported|located|found|"
    r"spotted)(?: last)?",
    re.IGNORECASE,
)
""""Where it was last seen"."""
HOME = _words(
    r"(?<!\bway )(?<!\bof )(?<!\brelative to )(?<!\bpose to )(?<!\bat )(?<!\bis )(?<!\bfrom )(?<!\bleg )(?<!\bthe one )"
    r"(?<!\bthe run )(?<!\btrip )(?<!\bpart )(?<!\bstretch )(?<!\bpassage )(?<!\bthe drive )(?<!\bleft )(?<!\bways )(?<!\bout and )(?<!\btransit )"
    r"home(?!:)(?! (?:leg|run|stretch|trip|way|is|berth|port))|"
    r"(?:go|head|sail|come|run|return|get|drive) (?:back )?to (?:the )?base|return(?= (?:[.;,]|in the end|at the end|then))|(?:come|go|head|"
    r"sail|run) back(?=\s*(?:[.,;:]|$|with|while|at \d))|"
    r"return(?=\s*(?:[.,;]|$))"
)
"""The way home, where it is no thing that is spoken of."""

# Straight runs
LINE = _words(
    r"from|starting|run|running|follow\w*|track\w*|trac(?:e|ing)|transect|line|pass|passing|leg|straight|go|going|sail\w*|driv\w+|steam\w*|"
    r"steer\w*|make|head|along|onwards?|proceed\w*|move|motor"
)
"""Words of a straight run."""
NO_LINE = _words(r"arc|arcs|orbit\w*|circl\w*|turn\w*|curve|rotat\w+|pan|nudge|radius|drift\w*|float\w*|round")
"""Words of an arc, a turn or a drift, whose lengths are no runs."""
HEADING = re.compile(
    r"\b(?:on|along|follow(?:ing)?|steer(?:ing)?|heading|course|bearing|direction)\s+(?:(?:a|an|the)\s+)?(?:(?:true )?(?:heading|course|bearing|"
    r"direction)(?: of)?\s+)?(?:due\s+)?"
    r"(?:(\d{1,3}(?:\.\d+)?)(?![\d.]*\s?(?:m\b|met|s\b|sec|min|%|kn|km|feet|foot|ft))|((?:north|south)[ -]?(?:east|west)|north|south|east|"
    r"west)(?:wards?)?\b)",
    re.IGNORECASE,
)
"""A bearing that is steered, in degrees or by its compass word."""
DUE = re.compile(
    rf"\b(?:due|straight|running|run|go|sail|steer|steam|drive|to the|head)\s+({_WAY})(?:wards?)?\b(?! (?:of|side|face|end|edge|wall|corner|quay))"
    rf"|\b({_WAY})(?:wards?|erly)\b(?! (?:of|side|face|end|edge))",
    re.IGNORECASE,
)
"""A compass direction that is gone in."""
OWN_HEADING = _words(
    r"(?:on|along|down|by|with|at|follow(?:ing)?|of) (?:the |its )?(?:(?:track|given|planned|stated|cable'?s?|task'?s?|set|ordered|"
    r"same) )*(?:heading|course|bearing)(?! (?:of )?(?:\d|lock|locked|north|south|east|west))"
    r"|(?:heading|bearing|course) of the (?:task|track|cable)"
)
"""The task's own heading."""
OWN_LENGTH = _words(
    r"(?:the |its |over the |for the )?(?:(?:full|set|given|planned|stated|max(?:imum)?|whole|entire|total|task'?s?|required|"
    r"ordered) )+(?:of (?:the |its )?)?"
    r"(?:(?:pass|track|run|stated|given|planned) )*(?:length|distance|maximum|extent|stretch|run)(?: of the (?:task|pass|track|run|cable))?|"
    r"(?:the (?:pass |track )?|its )(?:length|distance|maximum)(?: of the (?:task|pass|track|run)| given| set| stated)?|"
    r"(?:from start )?to (?:its|the) end"
)
"""The task's own length, or its whole track."""
WHOLE_TRACK = _words(
    r"(?:follow\w*|track\w*|run\w*|trac\w+|do|doing) (?:along )?(?:the )?(?:(?:planned|given|cable|whole|entire|set|task'?s?) )*(?:track|cable|"
    r"run|line|pass)"
    r"(?: track| run| route)?(?: (?:as (?:planned|given|stated|laid down|ordered)|from (?:its |the )?start to (?:its |the )?end|from end to end|"
    r"for its planned length|"
    r"along its whole length))|(?:run\w*|follow\w*|do|doing) (?:the|its) (?:planned|given) (?:cable )?(?:track|run|line|pass)"
)
"""The task's own track as a whole."""
MOVE = re.compile(
    r"\b(?:go(?:es|ing)?|head (?:for|to|back|over|out|in|off|straight|up|down)|heading (?:for|to|back|over|out)|proceed\w*|driv(?:e|ing)|"
    r"sail(?:ing)?|motor(?:ing)?|"
    r"steam(?:ing)?|cruis(?:e|ing)|navigat\w+|travel\w*|return\w*|set course|steer(?:ing)?|relocat\w+|reach(?:es|ing)?|visit(?:s|ing)?|"
    r"approach(?:ing)?|(?:berth|dock)(?:ing)? (?:at|in|there|alongside|now)|"
    r"mak(?:e|ing) (?:for|your way)|get(?:ting)? (?:back |over |out )?to |mov(?:e|ing) (?:to|on|over|off|away|out|in|the (?:boat|usv|vehicle|"
    r"craft|vessel))|com(?:e|ing) (?:back|home|in)|take (?:her|the (?:boat|usv|vessel|vehicle|craft))|"
    r"run(?:ning)? (?:in|out|over|on|up|down|back|along|from|to|parallel|straight|a (?:straight|line|leg|pass|transect))|transit(?:ing)? |"
    r"pass(?:ing)? (?:along|by|the|from|down|up)|"
    r"follow(?:ing)? (?:the|it|a|its|along)|track(?:ing)? the cable|cross(?:ing)? (?:to|over)|creep|close in|stand off|back off|edge|"
    r"shift(?:ing)? (?:to|over)|"
    r"line up at|take up (?:position|station)|bring (?:her|the (?:boat|usv|vessel|vehicle|craft)) (?:to|back|in)|put (?:her|the boat) (?:at|on|"
    r"off)|further (?:on|along|out)|same direction|home|base|inspect|survey|map (?!pin|mark)|comb|sweep the|cover|search (?:the|along))\b",
    re.IGNORECASE,
)
"""Words of a movement that leads somewhere."""
NO_MOVE = _words(
    r"(?:turn|hold|drift|rest|others?|it|that) goes without|(?:first|second|third|middle|last|final|next) leg (?:passes|crosses|goes past|runs past) [^.;,:]*|"
    r"(?:on|during|for|in|over|of|at) (?:the |each |every |both |all |either |any |this |that )?(?:[\w-]+ )?(?:legs?|runs?|pass|passes|drives?|"
    r"way|ways|transits?|moves?)(?: (?:home|out|back|in))?\b|"
    r"the (?:\w+ )?(?:leg|run|way|part|transit|passage|stretch|trip|pass|one|ones|drive|approach)s?(?: back)? (?:home|out|there|in)|"
    r"go(?:es|ing)? (?:(?:counter|anti)[- ]?)?clock-?wise|go(?:es|ing)? (?:all the way |right |once )?(?:a)?round|go(?:es|ing)? (?:through|"
    r"over) (?:the )?headings|"
    r"go(?:es|ing)? (?:through|over) (?:bearings|\d+|north|south|east|west|sectors)|go (?:by camera|in by camera|in visually|with the)|going on|"
    r"(?:is|are|be|been|as you|as she|while you|while she|when) (?:going|moving|under way|sailing|driving|transiting)|while (?:going|moving|"
    r"sailing|driving)|when (?:going|moving)|"
    r"track (?:the |a |any )?(?!cable|from)[\w-]+|homewards?|home port|moving parts|(?:approach|close in|dock|go in|come in|berth\w*|docking|"
    r"approaching)[^.;,]{0,30} (?:by|with|using|on) (?:the )?camera|approach (?:the dock|visually|by|with|while|using|on sight|, keeping)|"
    r"visual approach|"
    r"motor(?:s)? (?:off|stopped|cut)|edge of|follow(?:ing)? (?:the|a|its)? ?(?:headings?|bearings|order|sequence)|sail(?:ing)? (?:boat|yacht|"
    r"vessel|ship)s?|sailing|(?:motor|pilot|fishing) \w+|"
    r"(?:not|never|no need to|n't|without) (?:\w+ )?(?:go|going|come|coming|run|return\w*)\b[^.;,]*|(?:go|change|set|come|turn)\w* (?:to |"
    r"the )?(?:a )?heading(?: to| of)?|on the map|the map|search(?:ing)? the (?:[\w-]+ ){0,3}(?:pictures?|images?|frames?|video|area for)|"
    r"you go in|from home|steer(?:ing)? clear|stay(?:ing)? clear|let go|go(?:es)? (?:there to do so|on record|up|with the current|out in)|"
    r"everything else is \w+ running|(?:sail|drive|make|steer|follow|run|go|move|proceed) (?:in |along |through )?an? (?:[\w-]+ ){0,2}(?:arc|"
    r"curve|bend)|(?:on|for|during) the approach|follow(?:ing)? (?!the (?:cable|track|line|pipe|\w+ (?:cable|track|line|"
    r"pipe)))[^.;,]{1,40}(?:visually|centred|in (?:the picture|frame|view)|keeping)|follow(?:ing)? (?:the|it)[^.;,]{1,30}, (?:keeping|centred)|"
    r"(?:begin|start)\w* (?:at|from) §*|home button|out and home|(?:way|leg|run) home|cruise ship\w*|approaches"
)
"""Words of MOVE in another sense: runs and legs as things, turns, what is followed by camera."""
QUOTED = re.compile(r"\"[^\"]*\"|(?<!\w)'[^']*'(?!\w)|[“‘][^”’]*[”’]")
"""Notes, labels and file tags."""
NO_OWN = re.compile(
    r"\b(?:keep|hold(?! (?:position )?(?:at|off|on)\b)|centre\w*|point\w*|look\w*|turn\w*|rotat\w+|fac\w+|bow|pose|pixel|error|offset|relative|distance|"
    r"respect|lock\w*|listen\w*|watch\w*|steady on|stay(?! at))\b[^.;:,]{0,40}$",
    re.IGNORECASE,
)
"""Words before a target that is watched, not gone to."""
NO_OWN_BEHIND = re.compile(r"^ (?:to (?:follow|be|track|watch)|feature|id|mark|description|centred|in (?:view|the (?:picture|frame)))\b", re.IGNORECASE)
"""The target as a thing that is looked at."""
HERE = _words(r"(?:your|this|our|present|current) \w+|^position|^point|^the (?:position|point)$|^start$")
"""A place of the vehicle's own, or of nothing in particular."""
NAMES_NEXT = re.compile(r"^\W*(?:(?:at|of|which is|is|namely|that is|in)\s+)?§", re.IGNORECASE)
"""A stated place right behind."""
WAY_BEHIND = re.compile(
    rf"^\s?(?:(?:straight|directly|due|to|the|further|farther|on|out|away)\s+)*({_WAY})(?:wards?|erly)?\b(?! (?:side|face|edge|end|"
    rf"wall))(\s+of\b\s*)?",
    re.IGNORECASE,
)
"""The direction of a way off behind its length, and whether it is "of" something."""
BY_WAY = re.compile(r"\b(?:by way of|via|through|after|past|first|before)\b[^.;]{0,40}$", re.IGNORECASE)
"""Before a point that is passed on the way to the thing it is counted from."""
OF_IT = re.compile(r"^(?:it|that|there|this|the same)\b", re.IGNORECASE)
"""The thing that was named before."""
ANCHOR = re.compile(
    r"(?:the |a |an |its |this )?(?:[\w'’-]+,? ){0,4}?(?:(?:which|that) (?:stands|lies|is|sits) |(?:lying|standing|moored|anchored) )?(?:(?:at|"
    r"on|in) )?\W*",
    re.IGNORECASE,
)
"""What may stand between "north of" and the place that is meant."""
STARTING = _words(r"(?:start|beginn)\w*|begin\w*|from|out of")
"""The place behind is where a run starts."""
PARALLEL = _words(r"ending|to the end at")
"""A run whose end is stated as a place."""
SHAPE_NAMES = ("square", "survey", "inspect", "lawnmower", "spiral", "triangle", "rectangle", "instead", "before")
"""Names of shapes and corrections that a typing error may hide."""
LISTED = re.compile(r"(?:^|[,;:]|\bthen\b|\s[-–—>]+)\s*(?:(?:and|then|next|to|at|on to)\s+)*(?:the )?$", re.IGNORECASE)
"""Before an item of a list."""
LISTED_BEHIND = re.compile(r"^\s*(?:[,;.:)–—>-]|and\b|then\b|first\b|last\b|$)", re.IGNORECASE)
"""Behind an item of a list."""
ANY_TRACK = re.compile(
    r"\b(?:(?:run|follow|track|do) it (?:as|from|to|once|whole|in|at|along)|(?:follow|track|run|trac|do)(?:s|ing|e|king|ning)? (?:along |"
    r"down )?(?:the|its|your|this|that) (?:[\w'-]+ ){0,2}(?:cable|line|track|"
    r"pipe\w*)|(?:way|point)s? every|"
    r"(?:face|wall|edge|quay|jetty|pier|breakwater)\b[^.;:§]{0,30} (?:runs|is|lies|goes|stretches|extends)\b[^.;:§]{0,30} from)\b(?! to §)",
    re.IGNORECASE,
)
"""A track or a face that is not run from one stated place to another."""
MEASURED = re.compile(r"^\s?(?:°|deg|s\b|secs?\b|seconds|m\b|met|min|%|hours?|kn|times)", re.IGNORECASE)
"""A unit that no coordinate has."""
ANGLES = re.compile(
    r"\b(?:turn\w*|rotat\w+|headings?|bearings?|bow|sectors?|fac(?:e|ing)|look\w*|degrees?|nudg\w*|pan\w*|yaw\w*|point\w*|swing\w*|spin\w*|"
    r"directions?)\b(?:[^.;,§]|(?<=[\d°]),){0,50}$",
    re.IGNORECASE,
)
"""What stands before numbers that are angles."""
FROM_OPENING = re.compile(r"^\W*(?:and\s+|then\s+)*(?:from|starting (?:at|from)|beginning (?:at|from)|to|on to|out to)\s+(?:the )?$", re.IGNORECASE)
"""A clause that opens with "from" or "to"."""
ROUND = re.compile(r"\b(?:round|around|circling|orbiting|circle|orbit)\s+(?:the \w+ at )?$", re.IGNORECASE)
"""A place that is circled."""
OFF_PLACE = re.compile(r"\d\s?(?:m|met(?:re|er)s?) off\s+(?:the \w+ at )?$", re.IGNORECASE)
"""A place that some way is kept off."""
STOP_SHORT = re.compile(
    rf"§? from the ({_WAY})(?:ern)?(?: side)?,? and (?:then )?(?:stop|hold|halt|stay|stopping)\w*( [^.,;§]{{1,40}}? (?:off|short|away|from it|"
    rf"clear))\b"
    r"",
    re.IGNORECASE,
)
"""A place that is approached from one side, up to some way off."""
RUN_BEHIND = re.compile(r"^,? (?:on|along|due|to the) (?:a |the )?(?:heading|course|bearing|\d|north|south|east|west|given|planned)", re.IGNORECASE)
"""Behind the length of a run."""
RUN_BEFORE = re.compile(r"\bfor (?:about |the )?$", re.IGNORECASE)
"""Before the length of a run."""
SIGN_BEFORE = re.compile(r"(?:(?:minus|negative)\s+|[-−–])?$", re.IGNORECASE)
"""The sign of a number, in a word or as a mark."""
NO_HOME = re.compile(r"\b(?:relative|pose|distance|range|readings?|offset|bearing)\b[^.;,]{0,25}$", re.IGNORECASE)
"""Home as what something is measured to."""
UNPLACED = re.compile(
    r"(?:^|[:;,.]|\band)\s*(?:then )?(?:on |out |back |over )?to (?:the|a) (?!start|target|goal|cent|position|point|spot|berth|beginning|"
    r"(?:planned|given|stated|cable) |north|south|east|west|"
    r"left|right|same|way|end|last|first|next|second|third|other|full|nearest|port|starboard)[^.;:,§]*(?:[.;:,]|$|\band to\b)|\b(?:second|other|"
    r"next) (?:one|pass|run|leg) (?:goes |is )?(?:back|from)\b|"
    r"\b(?:once|when|after) (?:it|he|she|they) (?:has|have|is|was|are|were) (?:been )?(?:found|located|detected)",
    re.IGNORECASE,
)
"""A destination that is named without its place, and one that depends on what was found."""
SEQUENCE = re.compile(
    r"\b(?:trip|route|tour|rounds?|legs|stops|waypoints|points|order|destinations?|list|moves)\b"
    r"[^.;§]{0,20}(?:by|via|:|,|through|over|[-–—])?\s*$",
    re.IGNORECASE,
)
"""Words before places to be visited one after the other."""
BETWEEN_HERE = re.compile(
    r"\bbetween (?:here|there|(?:the|your|our) (?:present|current) (?:position|place)|where \w+ (?:are|is)) and $",
    re.IGNORECASE,
)
""""Between here and" a place."""
GO_IN = re.compile(r"\b(?:go|going|come|coming|run|head)\b in\b(?=\s*(?:[.,;:]|$|and|then|while|with (?:the )?(?:heading|bow)))", re.IGNORECASE)
"""Into the berth."""
ARRIVING = re.compile(r"\b(?:arriv\w*|final|ending|ends?|facing|finish\w*|bow|yaw|look\w*|turn\w*|pointing|pivot\w*)\b[^.;,§]{0,15}$", re.IGNORECASE)
"""Words before a bearing that the bow is to have."""
OFF = re.compile(r"^\s?(?:off|out|away|clear|wide|short)\b", re.IGNORECASE)
"""Behind a length that is kept off something."""
FROM_IT = re.compile(r"^\s*(?:,|starting|beginning)?\s*from (?:the )?(?:[\w-]+ ){0,2}?(?:at )?$", re.IGNORECASE)
"""Between a way off and the place that it starts at."""
JOINS = re.compile(r"\s*(?:,|and|,\s*and)\s*$", re.IGNORECASE)
"""Between the two parts of one way off."""
ALONG_IT = re.compile(r"\b(?:follow(?:ing)?|track(?:ing)?|along|run(?:ning)? along) (?:it|the (?:[\w-]+ )?cable)\b", re.IGNORECASE)
"""A run along the cable."""
STARTS_HOME = re.compile(r"^\W*(?:starting )?from (?:home|base)\b", re.IGNORECASE)
"""A text that starts from home."""
FROM_TO = re.compile(r"^ to (?:the )?(?:finish|end)\b", re.IGNORECASE)
""""From start to finish"."""
BARE_START = re.compile(r"^start$", re.IGNORECASE)
""""Start" without an article: mostly a verb."""
AT_SPEED = re.compile(r"\s*,?\s*for (?:about )?(?:an? |the )?", re.IGNORECASE)
"""What stands between a speed and the time for which it is kept."""
SOME_HEADING = re.compile(r"\b(?:on|along|headi?n?g?|bearing|course)\b[^.;§]{0,40}(?:degrees|°|\b\d{2,3}\b(?!\s?m))", re.IGNORECASE)
"""A bearing in words or with a typing error."""
FROM_END = re.compile(r"\b(?:from|start at|starting at|beginning at)\s+(?:the )?$", re.IGNORECASE)
"""Before the place that a run starts from."""
BACK_START = re.compile(r"\b(?:back|return\w*)\b[^.;,]*$", re.IGNORECASE)
"""Back to the start: of the track, or of everything."""
GIVEN_PLACE = re.compile(r"\b(?:planned|given|stated|goal|docking|target|task|start) (?:position|point|start|berth|location)\b", re.IGNORECASE)
"""The task's place by its full name."""
OF_OWN_HOME = re.compile(r"\bof (?P<home>home|base|the origin)\b", re.IGNORECASE)
"""Home as what a way off is counted from."""
THOUSANDS = re.compile(r"(?<![\d.,\[(=−–-])\d{1,3}(?:,\d{3})+(?=[ -]?(?:m|met(?:re|er)s?|ft|foot|feet|yards?|yd)\b)", re.IGNORECASE)
"""A length with commas between its thousands."""
DIGITS = ("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine")
"""Digits in words."""
SPOKEN = re.compile(rf"\b({'|'.join(DIGITS)}|niner)[ -]({'|'.join(DIGITS)}|niner)[ -]({'|'.join(DIGITS)}|niner)\b", re.IGNORECASE)
"""A bearing that is said digit by digit."""
ARRIVAL = re.compile(r"§,?\s*$", re.IGNORECASE)
"""A place right before a bearing."""
PLACE_FROM = re.compile(r"\b(?:from|at|of)\s+§+,?\s*$", re.IGNORECASE)
"""A place that a run starts from, right before its bearing."""
ANGLE_UNIT = re.compile(r"deg|°|:", re.IGNORECASE)
"""Marks of angles and times."""
TO_THING = re.compile(
    rf"\b{_VERB}\b(?:(?! (?:to|for|until|after|from|at) )(?:[^.;:,\d§]|,(?! and))){{0,40}}?\s+(?:{_TO}|from)\s+(?:the |an? |our |"
    rf"its )(?:[\w'’-]+ ){{1,4}}?(?:at|on)\s+$",
    re.IGNORECASE,
)
"""On the way to a thing whose place follows: "go to the pile at"."""
TO_THING_NEXT = re.compile(
    r"^\W*(?:(?:and|then)\s+)*(?:to|from|for)\s+(?:the |an? )(?:[\w'’-]+ ){1,4}?(?:at|on)\s+$|§[^.;:§]{0,3}\bto (?:the |"
    r"an? )(?:[\w'’-]+ ){1,4}?at\s+$",
    re.IGNORECASE,
)
"""The same in a list."""
DONE_AT = re.compile(
    r"\b(?:snapshots?|sound\w*|pins?|mark\w*|photo\w*|pictures?|stills?|depths?|fix(?:es)?|readings?|holds?(?! position)|stops?|stations?|"
    r"measure\w*|recording|profiles?|snaps?|drop\w*|check\w*|"
    r"shots?|labelled|called|named|noted)\b[^.;:§]{0,30}\b(?:at|to|as far as|off|for)\s+$|\b(?:as far as|up to|until|on to|out to|over to|"
    r"back to|by way of)\s+$",
    re.IGNORECASE,
)
"""Something that is done at a place, and so leads there."""
IS_BEHIND = re.compile(r"^\s*(?:,? ?(?:which|that) )?(?:lies|stands|sits|is|are|was|marks|bears)\b", re.IGNORECASE)
"""Behind a place that is described."""
UNPLACED_NEXT = re.compile(
    r"§,? (?:and|then|and then) (?:to )?the (?!start|target|goal|cent|position|point|spot|berth|beginning|planned|given|stated|same|way|end|last|"
    r"first|next|second|third|other|rest|lens|bow|"
    r"depth|\w+ (?:leg|part|step|stage))[\w-]+(?: [\w-]+)?[.,;]|"
    r"\b(?:position|put|place|take|bring)\w* (?:it|her|yourself|the (?:boat|vessel|craft|vehicle|usv)) (?:at|to|off|by|near) the (?!start|target|"
    r"goal|cent|position|point|spot|berth|beginning|planned|given|"
    r"stated|same|way)[\w-]+(?: [\w-]+)?[.,;]",
    re.IGNORECASE,
)
"""A thing to go to that stands behind a place, without a place of its own."""
SIXTEENTH = re.compile(r"\b(?:north|south|east|west)[ -](?:north|south)[ -]?(?:east|west)", re.IGNORECASE)
"""A compass point between those that are read."""
FROM_ANY = re.compile(r"\b(?:from|starting|beginning|start|begin)\b[^.;]{0,20}§", re.IGNORECASE)
"""A run whose start is stated."""
BOUNDS = re.compile(r"\b(?:corners?|bound\w*|\w*fence\w*|polygon|limits?|perimeter)\b", re.IGNORECASE)
"""Words that make a row of places an area."""
