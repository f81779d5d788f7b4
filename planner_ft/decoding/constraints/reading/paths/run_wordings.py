"""How task inputs word movements, places and ways off them: patterns that the readers of paths
share.
"""

from __future__ import annotations

import re

_NUMBER = r"[-−–]?\d+(?:\.\d+)?"
COMPASS = r"(?:north[ -]?(?:east|west)|south[ -]?(?:east|west)|north|south|east|west)"
WAY = re.compile(rf"\b({COMPASS})(?:ern|wards?|erly|bound)?\b", re.IGNORECASE)
"""A compass direction."""
SIXTEENTH = re.compile(
    r"\b(?:north|south|east|west)[ -](?:north|south)[ -]?(?:east|west)", re.IGNORECASE
)
"""A compass point between those that are read."""


def whole_words(pattern: str) -> re.Pattern[str]:
    return re.compile(rf"\b(?:{pattern})\b", re.IGNORECASE)


# Places
EXPLICIT = re.compile(
    rf"[\[(]\s*(?:x\s*[=:]?\s*)?(?P<a>{_NUMBER})\s*[,;/]?\s*(?:y\s*[=:]?\s*)?(?<=[\s,;/=:y])(?P<b>{_NUMBER})\s*[\])]"
    rf"|\bx\s*[=:]?\s*(?P<c>{_NUMBER})\s*(?:,|and|/|;)?\s*y\s*[=:]?\s*(?P<d>{_NUMBER})"
    rf"|(?<![\w.])(?P<e>{_NUMBER})\s?(?:m|met(?:re|er)s?)?\s?(?P<f>east|west|north|south)\s*(?:,|and)?\s*(?P<h>{_NUMBER})\s?(?:m|met(?:re|"
    rf"er)s?)?\s?"
    rf"(?P<i>east|west|north|south)\b(?! (?:of|from|off) (?:[\[(]|x\b))(?P<j> (?:of|from) (?:the"
    rf" )?\w+)?",
    re.IGNORECASE,
)
"""A place that can be taken for nothing else: in brackets, with its axes, or with the directions of
both numbers.
"""
OF_HOME = re.compile(r" (?:of|from) (?:the )?(?:home|here|base|origin)$", re.IGNORECASE)
"""Coordinates counted from home."""
OF_OWN_HOME = re.compile(r"\bof (?P<home>home|base|the origin)\b", re.IGNORECASE)
"""Home as what a way off is counted from."""
SIGNED = re.compile(r"\b(?:minus|negative)\b|(?:^|[\s,(])[-−–]\d", re.IGNORECASE)
"""A number with a sign before it."""
SIGN_BEFORE = re.compile(r"(?:(?:minus|negative)\s+|[-−–])?$", re.IGNORECASE)
"""The sign of a number, in a word or as a mark."""
MEASURED = re.compile(
    r"^\s?(?:°|deg|s\b|secs?\b|seconds|m\b|met|min|%|hours?|kn|times)", re.IGNORECASE
)
"""A unit that no coordinate has."""
ANGLES = re.compile(
    r"\b(?:turn\w*|rotat\w+|headings?|bearings?|bow|sectors?|fac(?:e|ing)|look\w*|degrees?|nudg\w*|pan\w*|yaw\w*|point\w*|swing\w*|spin\w*|"
    r"directions?)\b(?:[^.;,§]|(?<=[\d°]),){0,50}$",
    re.IGNORECASE,
)
"""What stands before numbers that are angles."""
ANGLE_UNIT = re.compile(r"deg|°|:", re.IGNORECASE)
"""Marks of angles and times."""
IS_BEHIND = re.compile(
    r"^\s*(?:,? ?(?:which|that) )?(?:lies|stands|sits|is|are|was|marks|bears)\b", re.IGNORECASE
)
"""Behind a place that is described."""
UNPLACED = re.compile(
    r"(?:^|[:;,.]|\band)\s*(?:then )?(?:on |out |back |over )?to (?:the|a)"
    r" (?!start|target|goal|cent|position|point|spot|berth|beginning|"
    r"(?:planned|given|stated|cable) |north|south|east|west|"
    r"left|right|same|way|end|last|first|next|second|third|other|full|nearest|port|starboard)[^.;:,§]*(?:[.;:,]|$|\band"
    r" to\b)|\b(?:second|other|"
    r"next) (?:one|pass|run|leg) (?:goes |is )?(?:back|from)\b|"
    r"\b(?:once|when|after) (?:it|he|she|they) (?:has|have|is|was|are|were) (?:been"
    r" )?(?:found|located|detected)",
    re.IGNORECASE,
)
"""A destination that is named without its place, and one that depends on what was found."""
UNPLACED_NEXT = re.compile(
    r"§,? (?:and|then|and then) (?:to )?the"
    r" (?!start|target|goal|cent|position|point|spot|berth|beginning|planned|given|stated|same|way|end|last|"
    r"first|next|second|third|other|rest|lens|bow|"
    r"depth|\w+ (?:leg|part|step|stage))[\w-]+(?: [\w-]+)?[.,;]|"
    r"\b(?:position|put|place|take|bring)\w* (?:it|her|yourself|the"
    r" (?:boat|vessel|craft|vehicle|usv)) (?:at|to|off|by|near) the (?!start|target|"
    r"goal|cent|position|point|spot|berth|beginning|planned|given|"
    r"stated|same|way)[\w-]+(?: [\w-]+)?[.,;]",
    re.IGNORECASE,
)
"""A thing to go to that stands behind a place, without a place of its own."""

# Text that is not read
STOP = whole_words(
    r"two (?:north|south|east|west)[\w-]* lines|degrees to the (?:left|right) of (?:the|that)|"
    r"zig-?zag|spiral|triang\w+|hexagon\w*|pentagon\w*|octagon\w*|figure|ellip\w+|oval|diamond|ring|lawn-?mow\w*|grids?|lanes?|mow\w*|"
    r"boustrophedon|"
    r"spacing|mapped|apart|wide|\d ?m by|met(?:re|er)s? by|creeping|sector"
    r" search|expanding|rectangle(?! from {4,})|mirror\w*|squares?|"
    r"half[ -]?way|mid-?point|midway|(?<!of the )survey(?!"
    r" (?:centre|center|begins|vessel|boat|team|data|start\w*|complete\w*|company))|"
    r"surveying|inspecting|lines \d|(?:waypoints|points|stops|stations|places) (?:evenly |equally"
    r" )?(?:spaced |spread )?(?:round|around|about|"
    r"on (?:the|a) circle|evenly)|"
    r"(?:\d+|three|four|five|six|eight|ten|twelve) (?:even\w* |equally |spaced"
    r" )*(?:way)?points(?!\W*(?:minus |x |\(|\[|-?\d+(?:\.\d+)?,))|"
    r"inspect(?:s|ing)?|(?:evenly|equally) spaced|"
    r"hops?|stairs?|circle of|way-?points? (?:every|each) (?:\d+ ?(?:deg\w*|°)|quarter)|the way you"
    r" came|points? in a row|reciprocal|dog[- ]?leg|"
    r"star (?:on|round|from)|o['’]clock of|"
    r"turn(?:ing|s)? back|middle of the line|in the middle|negative, (?!\d)|"
    r"(?:two|three|four|\d) (?:\w+ )?(?:passes|rounds)|correction|rather|instead|actually|sorry|i"
    r" mean|scrap|scratch that|no, |hang on|"
    r"make (?:it|that)|backwards|vice versa|"
    r"between the (?:two|buoys|piles)|if|unless|skip(?:s|ping)?|leave out|leaving out|in the"
    r" order \w+"
)
"""Other shapes, corrections and conditions: where they are, nothing is read."""
SHAPE_NAMES = (
    "square",
    "survey",
    "inspect",
    "lawnmower",
    "spiral",
    "triangle",
    "rectangle",
    "instead",
    "before",
)
"""Names of shapes and corrections that a typing error may hide."""
BOUNDS = re.compile(
    r"\b(?:corners?|bound\w*|\w*fence\w*|polygon|limits?|perimeter)\b", re.IGNORECASE
)
"""Words that make a row of places an area."""
ORDER = whole_words(
    r"but (?:first|before)|before (?:that|this|it|which|then|all|you"
    r" (?:do|go)|anything|setting|leaving)|(?:that|this|it) comes? (?:first|last|"
    r"before)|"
    r"(?<=\w )(?<!the )(?<!in )first(?=[.;](?! then\b)|$|, (?!then|and then))|but"
    r" (?:call|go|visit|via|not (?:before|until|to)|only after)|twice|"
    r"(?<!home )(?<!steady )(?<!settled )(?<!settle )(?<!centred )(?<!hold )(?<!free"
    r" )again|repeat\w*|laps?|there and back|out and back(?! not)|"
    r"and back(?=[.,;]|$)|(?<!come )(?<!go )(?<!head )(?<!sail )(?<!run )(?<!brought"
    r" )back(?=[.,;]|$)|on the way (?:there )?(?:call|stop|visit|take|go)\w*|"
    r"one first|one last|"
    r"begins with|clos(?:e|es|ing) (?:the|it|with)|"
    r"in both directions|back and forth|either way|(?<!logged )(?<!them )(?<!recording )both"
    r" ways|last of all|preceded|"
    r"in reverse|reversed?|the other way|ends? with|prior|(?:three|four|five|\d+) times|once"
    r" more|come[s]? before|afterwards? (?:only|you)|"
    r"first of all|preced\w+"
)
"""Words that turn the order of the text round, or repeat a part of it."""
AFTER_INSIDE = re.compile(
    r"\w[^.;:]*?,?\s\b(?:after|once|when|as soon as|having)\b[^.;]*$", re.IGNORECASE
)
"""A clause with another one before it that happens later: "Go to B after the run to A"."""
BEFORE_FIRST = re.compile(
    r"(?:^|[.;:]\s*)(?:right |just |shortly |immediately |but"
    r" )?(?:before|until|prior)\b[^.;:,]*(?:[\d\])]|home|start|target|position|\bto\b|"
    r"reach\w*)",
    re.IGNORECASE,
)
"""A sentence that begins with what comes later: "Before going to B, go to A"."""
FIRST_LAST = re.compile(
    r"\b(?:last|finally|second)\b[^.;]{0,30}\bfirst\b|\bpreced\w+|\bbefore (?:she|he|it|they)\b",
    re.IGNORECASE,
)
"""What comes first is said last."""

# Movements
MOVE = re.compile(
    r"\b(?:go(?:es|ing)?|head (?:for|to|back|over|out|in|off|straight|up|down)|heading"
    r" (?:for|to|back|over|out)|proceed\w*|driv(?:e|ing)|"
    r"sail(?:ing)?|motor(?:ing)?|"
    r"steam(?:ing)?|cruis(?:e|ing)|navigat\w+|travel\w*|return\w*|set"
    r" course|steer(?:ing)?|relocat\w+|reach(?:es|ing)?|visit(?:s|ing)?|"
    r"approach(?:ing)?|(?:berth|dock)(?:ing)? (?:at|in|there|alongside|now)|"
    r"mak(?:e|ing) (?:for|your way)|get(?:ting)? (?:back |over |out )?to |mov(?:e|ing)"
    r" (?:to|on|over|off|away|out|in|the (?:boat|usv|vehicle|"
    r"craft|vessel))|com(?:e|ing) (?:back|home|in)|take (?:her|the"
    r" (?:boat|usv|vessel|vehicle|craft))|"
    r"run(?:ning)? (?:in|out|over|on|up|down|back|along|from|to|parallel|straight|a"
    r" (?:straight|line|leg|pass|transect))|transit(?:ing)? |"
    r"pass(?:ing)? (?:along|by|the|from|down|up)|"
    r"follow(?:ing)? (?:the|it|a|its|along)|track(?:ing)? the cable|cross(?:ing)?"
    r" (?:to|over)|creep|close in|stand off|back off|edge|"
    r"shift(?:ing)? (?:to|over)|"
    r"line up at|take up (?:position|station)|bring (?:her|the (?:boat|usv|vessel|vehicle|craft))"
    r" (?:to|back|in)|put (?:her|the boat) (?:at|on|"
    r"off)|further (?:on|along|out)|same direction|home|base|inspect|survey|map"
    r" (?!pin|mark)|comb|sweep the|cover|search (?:the|along))\b",
    re.IGNORECASE,
)
"""Words of a movement that leads somewhere."""
NO_MOVE = whole_words(
    r"(?:turn|hold|drift|rest|others?|it|that) goes"
    r" without|(?:first|second|third|middle|last|final|next) leg (?:passes|crosses|goes past|runs"
    r" past) [^.;,:]*|"
    r"(?:on|during|for|in|over|of|at) (?:the |each |every |both |all |either |any |this |that"
    r" )?(?:[\w-]+ )?(?:legs?|runs?|pass|passes|drives?|"
    r"way|ways|transits?|moves?)(?: (?:home|out|back|in))?\b|"
    r"the (?:\w+"
    r" )?(?:leg|run|way|part|transit|passage|stretch|trip|pass|one|ones|drive|approach)s?(?: back)?"
    r" (?:home|out|there|in)|"
    r"go(?:es|ing)? (?:(?:counter|anti)[- ]?)?clock-?wise|go(?:es|ing)? (?:all the way |right |once"
    r" )?(?:a)?round|go(?:es|ing)? (?:through|"
    r"over) (?:the )?headings|"
    r"go(?:es|ing)? (?:through|over) (?:bearings|\d+|north|south|east|west|sectors)|go (?:by"
    r" camera|in by camera|in visually|with the)|going on|"
    r"(?:is|are|be|been|as you|as she|while you|while she|when) (?:going|moving|under"
    r" way|sailing|driving|transiting)|while (?:going|moving|"
    r"sailing|driving)|when (?:going|moving)|"
    r"track (?:the |a |any )?(?!cable|from)[\w-]+|homewards?|home port|moving"
    r" parts|(?:approach|close in|dock|go in|come in|berth\w*|docking|"
    r"approaching)[^.;,]{0,30} (?:by|with|using|on) (?:the )?camera|approach (?:the"
    r" dock|visually|by|with|while|using|on sight|, keeping)|"
    r"visual approach|"
    r"motor(?:s)? (?:off|stopped|cut)|edge of|follow(?:ing)? (?:the|a|its)?"
    r" ?(?:headings?|bearings|order|sequence)|sail(?:ing)? (?:boat|yacht|"
    r"vessel|ship)s?|sailing|(?:motor|pilot|fishing) \w+|"
    r"(?:not|never|no need to|n't|without) (?:\w+"
    r" )?(?:go|going|come|coming|run|return\w*)\b[^.;,]*|(?:go|change|set|come|turn)\w* (?:to |"
    r"the )?(?:a )?heading(?: to| of)?|on the map|the map|search(?:ing)? the (?:[\w-]+"
    r" ){0,3}(?:pictures?|images?|frames?|video|area for)|"
    r"you go in|from home|steer(?:ing)? clear|stay(?:ing)? clear|let go|go(?:es)? (?:there to do"
    r" so|on record|up|with the current|out in)|"
    r"everything else is \w+ running|(?:sail|drive|make|steer|follow|run|go|move|proceed) (?:in"
    r" |along |through )?an? (?:[\w-]+ ){0,2}(?:arc|"
    r"curve|bend)|(?:on|for|during) the approach|follow(?:ing)? (?!the (?:cable|track|line|pipe|\w+"
    r" (?:cable|track|line|"
    r"pipe)))[^.;,]{1,40}(?:visually|centred|in (?:the picture|frame|view)|keeping)|follow(?:ing)?"
    r" (?:the|it)[^.;,]{1,30}, (?:keeping|centred)|"
    r"(?:begin|start)\w* (?:at|from) §*|home button|out and home|(?:way|leg|run) home|cruise"
    r" ship\w*|approaches"
)
"""Words of MOVE in another sense: runs and legs as things, turns, what is followed by camera."""
QUOTED = re.compile(r"\"[^\"]*\"|(?<!\w)'[^']*'(?!\w)|[“‘][^”’]*[”’]")
"""Notes, labels and file tags."""
OWN_LEADS = re.compile(
    r"\b(?:to|from|at|reach) (?:the|its)"
    r" (?:waypoint|start)\b(?=\s*(?:[.,;:-]|$|(?:and|then|on|along)\b))",
    re.IGNORECASE,
)
"""Words that lead to the task's own place, or on from it."""
STARTS_HOME = re.compile(r"^\W*(?:starting )?from (?:home|base)\b", re.IGNORECASE)
"""A text that starts from home."""

# Ways off a place
WAY_BEHIND = re.compile(
    rf"^\s?(?:(?:straight|directly|due|to|the|further|farther|on|out|away)\s+)*({COMPASS})(?:wards?|erly)?\b(?!"
    r" (?:side|face|edge|end|"
    rf"wall))(\s+of\b\s*)?",
    re.IGNORECASE,
)
"""The direction of a way off behind its length, and whether it is "of" something."""
STOP_SHORT = re.compile(
    rf"§? from the ({COMPASS})(?:ern)?(?: side)?,? and (?:then"
    r" )?(?:stop|hold|halt|stay|stopping)\w*( [^.,;§]{1,40}? (?:off|short|away|from it|"
    rf"clear))\b"
    r"",
    re.IGNORECASE,
)
"""A place that is approached from one side, up to some way off."""
BY_WAY = re.compile(
    r"\b(?:by way of|via|through|after|past|first|before)\b[^.;]{0,40}$", re.IGNORECASE
)
"""Before a point that is passed on the way to the thing it is counted from."""
OF_IT = re.compile(r"^(?:it|that|there|this|the same)\b", re.IGNORECASE)
"""The thing that was named before."""
ANCHOR = re.compile(
    r"(?:the |a |an |its |this )?(?:[\w'’-]+,? ){0,4}?(?:(?:which|that) (?:stands|lies|is|sits)"
    r" |(?:lying|standing|moored|anchored) )?(?:(?:at|"
    r"on|in) )?\W*",
    re.IGNORECASE,
)
"""What may stand between "north of" and the place that is meant."""
FROM_IT = re.compile(
    r"^\s*(?:,|starting|beginning)?\s*from (?:the )?(?:[\w-]+ ){0,2}?(?:at )?$", re.IGNORECASE
)
"""Between a way off and the place that it starts at."""
JOINS = re.compile(r"\s*(?:,|and|,\s*and)\s*$", re.IGNORECASE)
"""Between the two parts of one way off."""

# Numbers
THOUSANDS = re.compile(
    r"(?<![\d.,\[(=−–-])\d{1,3}(?:,\d{3})+(?=[ -]?(?:m|met(?:re|er)s?|ft|foot|feet|yards?|yd)\b)",
    re.IGNORECASE,
)
"""A length with commas between its thousands."""
DIGITS = ("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine")
"""Digits in words."""
SPOKEN = re.compile(
    rf"\b({'|'.join(DIGITS)}|niner)[ -]({'|'.join(DIGITS)}|niner)[ -]({'|'.join(DIGITS)}|niner)\b",
    re.IGNORECASE,
)
"""A bearing that is said digit by digit."""
