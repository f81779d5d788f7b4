"""How task inputs word places, paths and sizes: the patterns by which `itinerary` reads them."""

from __future__ import annotations

import re

MOST_LANES = 32
_BEARINGS: dict[str, float] = {
    "north": 0,
    "northeast": 45,
    "east": 90,
    "southeast": 135,
    "south": 180,
    "southwest": 225,
    "west": 270,
    "northwest": 315,
}
_BEARINGS |= {
    "northnortheast": 22.5,
    "eastnortheast": 67.5,
    "eastsoutheast": 112.5,
    "southsoutheast": 157.5,
}
_BEARINGS |= {
    "southsouthwest": 202.5,
    "westsouthwest": 247.5,
    "westnorthwest": 292.5,
    "northnorthwest": 337.5,
}
_WAY = (
    r"(?:(?:north|south|east|west)[ -](?:north|south)[ -]?(?:east|west)|north["
    r" -]?(?:east|west)|south[ -]?(?:east|west)|north|south|east|west)(?:ern|wards?)?"
)
_NUMBER = r"[-−–]?\d+(?:\.\d+)?"
OPENS = r"[\[(]?(?:[-−–]|(?:minus|negative) )?"
"""Between a word and the first digit of a place."""
_PAIR = rf"[\[(]\s*{_NUMBER}\s*,\s*{_NUMBER}\s*[\])]"


def _words(pattern: str) -> re.Pattern[str]:
    return re.compile(rf"\b(?:{pattern})\b", re.IGNORECASE)


def bearing_of(way: str) -> float:
    """Degrees of a compass direction as `WAY_BEHIND` finds it."""
    return _BEARINGS[re.sub(r"ern$|wards?$|[ -]", "", way.lower())]


# The text and its parts
LIST_MARK = re.compile(r"(?:(?<=^)|(?<=[.;:!?]\s))(?:\(\d{1,2}\)|\d{1,2}[.):])(?=\s)")
PART = re.compile(
    r"[.;](?=\s|$)|\s[-–—]\s|,?\s*(?:and )?\b(?:then|next|finally|after"
    r" (?:that|this|which)|afterwards|at the end|"
    r"to begin with|lastly)\b,?|\b(?:first|last),|,? (?:and|before)"
    r" (?=(?:going|heading|returning|proceeding)\b)",
    re.IGNORECASE,
)
UNORDERED = _words(
    r"(?:far|other) end|wrong way|backwards|start\w* at (?:the|its) end|from (?:the |its )?end"
    r" (?:back )?to|before|but|first(?=[.,;]?$)|twice|times|again|"
    r"repeat\w*|laps?|half ?way|after(?! (?:that|this|which))|between(?! (?:the )?(?:lanes?|"
    r"lines?|tracks?))|(?:start|finish) (?:and|to)|vice|"
    r"(?:begins|starts) with|ends? with|one last|on the way (?:there"
    r" )?(?:call|stop|visit|take|go)\w*|(?:last|final) one first|(?:first|last) half of the \d+|"
    r"middle of the line|the way you came|"
    r"reciprocal|hops?|dog[- ]?leg|stairs?|circle of|way-?points? (?:every|each) (?!\d+(?:\.\d+)?"
    r" ?m)|points? in a row|clos(?:e|es|ing) (?:the|it|"
    r"with)|reverse|o['’]clock of|"
    r"correction|rather|instead|actually|sorry|no, |i mean|not (?:go|at|to)|two"
    r" (?:grids|squares)|both (?:\d|"
    r"the)|go there|start point|from the (?:given |planned )?start|set course|start position"
)
UNSURE = re.compile(
    r"\b(?:same|that) [xy]\b|\b(?:displaced|shifted) (?:by )?\d|\bshift"
    r" (?:the|that|it)\b|\bstand-?off (?:of )?\d|\b(?:given|planned|stated|set) maximum\b|"
    r"\b(?:headings|bearings) on the spot\b|\borbit(?:ing)? (?:the|that|it)\b|[\])\d]"
    r" (?:last|first|in the middle)(?=[,.;])|\(-?\d[\d.]*;|\[[\[(]-?\d|"
    r"\bthe [xy] of\b|\ben route to\b|\bpass(?:ing)? by [xX\[(\d]|\b(?:each|every) time\b|\bhalf"
    r" (?:as|that) (?:far|way|distance)\b|\bouter lanes\b|"
    r"\b(?:just|only) the \w+(?:-\w+)? (?:side|half|edge) of\b|\bon the other side\b|\babeam\b|\bby"
    r" (?:its |the )?(?:north|south|east|west)\w* side\b|"
    r"\bcable off\b|"
    r"\d ?(?:m|met(?:re|er)s?) (?:north|south|east|west)\w* and \d[\d.]* ?(?:m|met(?:re|er)s?)"
    r" (?:north|south|east|west)\w* of the\b|"
    r"\bdestination is\b|\bfrom the cent(?:re|er)\b|\bof it:|\b(?:one|two|three)"
    r" sides\b|\b[A-D]-[A-D]\b|"
    r"\b(?:north|south|east|west)[a-z-]* of (?:x ?=? ?)?[\[(]?-?\d[^.;]{1,20}? (?:at|by)"
    r" (?!\()(?:\d|[a-z]+ (?:metres?|meters?|yards|feet)\b)",
    re.IGNORECASE,
)
"""Ways to tell a point from another, an order or a figure that are not read here, and lists of
corners that no word makes a fence.
"""
COUNTS = re.compile(
    r"\b(?:steps?|parts?|stages?|legs?|headings?|bearings?|through|look\w*|bow to|"
    r"(?:turn|swing|rotate|pivot|swivel|spin) to|facing|face)\s[\d.,\s]*(?:and )?(?:then )?$",
    re.IGNORECASE,
)
"""What stands before numbers that count steps or are headings."""
TURNED = re.compile(
    rf"\b(?:turn\w*|rotat\w+|fac\w+|swing|pivot|line up|spin|yaw|come round)\b[^.;]{{0,20}}?"
    rf" (?:to|on|onto|towards?) (?:due |"
    rf"heading |a heading of )?(?:(\d{{1,3}})\b|({_WAY})\b)",
    re.IGNORECASE,
)
THAT_BEARING = _words(r"(?:that|this|the same) (?:bearing|heading|course)")
CLAUSE = re.compile(r"[.;,:]")
ROW = re.compile(
    rf"[\[(]?{_PAIR}(?:\s*(?:,|;|and|,\s*and|to)?\s*{_PAIR}){{2,}}[\])]?", re.IGNORECASE
)
BOX = re.compile(rf"{_PAIR}\s*to\s*{_PAIR}")
FENCE = re.compile(
    r"\b(?:\w*fence\w*|fecne|bound\w*|box|polygon|rectangle|limit\w*|inside|outside|within|zone|keep\w*"
    r" (?:to|in|on)|corners|perimeter|region|leav\w+|"
    r"stray\w*)\b[^.;]{0,60}$",
    re.IGNORECASE,
)
FENCE_BEHIND = re.compile(
    r"^[\])]?\s*[-–—,:]?\s*(?:(?:these|the|those|this|that|which|it|as|is|are|be|being|form\w*|mak\w+|mark\w*|of|a|an|your|our|her|my|its|must|shall|should|will|may|to|not|"
    r"never|hard|outer|absolute|strict|virtual|area|box|polygon|square|rectangle|triangle|corners?|points?)"
    r" ){0,8}(?:\w*fence\w*|bound\w*|limits?|edges?|"
    r"cordon|left(?! (?:at|for|to|of|alone|turn|and))|crossed|exceeded)\b",
    re.IGNORECASE,
)
"""A boundary that is named behind its corners."""
IN_LETTERS = re.compile(
    r"(?<=\d)(\s?(?:m|met(?:re|er)s?)) ([NSEW]{1,3})\b(?=\s*(?:of\b|[.,;]|and\b|then\b|from\b|$))"
)
"""A direction in letters behind a length: "70 m SW of"."""
NOT_HOME = re.compile(
    r"\b(?:no|not|never|don['’]t|do not|without|no need (?:to|for)|rather than|instead of)"
    r" (?:go(?:ing)?|com(?:e|ing)|return(?:ing)?|head(?:ing)?|run|"
    r"sail(?:ing)?)"
    r" (?:back )?(?:home|to base)\b",
    re.IGNORECASE,
)
"""The way home, ruled out."""
SCOPE = re.compile(
    r"\b(?:until|till|once|when|as soon as|from the moment|by the time|while)(?:"
    r" [\w'’]+){1,5}|\bonly on [^.;]{1,80}",
    re.IGNORECASE,
)
"""A clause about when something is done."""
SCOPE_CUE = _words(
    r"between|until|till|as far as|up to|beyond|only|from the moment|no"
    r" further|legs?|ways?|runs?|stretch|homewards?|throughout|to the end|on"
)
"""Words about where something is done."""
COMING_BACK = _words(
    r"back|return\w*|again|same|clos\w*|home|start\w*|patrol\w*|there and|to and fro|circuit|round"
    r" trip|once more|revisit\w*"
)
OTHER_LENGTH = _words(
    r"radius|arcs?|bends?|curv\w+|turn\w*|orbit\w*|circl\w*|sweep\w*|swing\w*|round|drift\w*|deep|depth|tall|high|error|visib\w+|rang\w+|bridge|"
    r"fov|sector|precision|good to|better than|worse"
    r" than|below|under|over|above|exceed\w*|limit\w*|threshold|safety|gap|every|each|apart|between|"
    r"vessel|wave|waves|swell|current|tide|room|spare|everything|"
    r"anything|nothing|tolerance|no closer|watch circle|(?:off|from|of) (?:all|any|other|the other)"
)
"""What a length is said of that is no way."""
_NAMED_PLACE = rf"\b(?P<name>[A-Z])\s?(?:=|:|is(?: at)?)\s*(?P<place>{_PAIR})"
NAMED_PLACE = re.compile(_NAMED_PLACE)
NAME_LIST = re.compile(r"\b[A-Z]\b(?:(?:\s*(?:,|;|->|→|–|-)|\s+(?:then|and|to)\b)*\s*\b[A-Z]\b)+")
CENTRE = re.compile(
    r"\b(?:cent(?:re|er)|middle|mid-?point)(?: of (?:the|its)"
    rf" \w+)?\s*(?:is|at|of|on|in)?\s*[:=]?\s*{OPENS}$",
    re.IGNORECASE,
)
"""Before the centre of a shape."""
BACK_ALONE = re.compile(
    r"(?<!brought )(?<!read )(?<!report )\bback(?=\s*(?:[,.;:]|$|and\b|then\b|along\b|the way\b))",
    re.IGNORECASE,
)
"""Back to where one came from, wherever that is."""
WAY_HOME = re.compile(
    r"\b(?:(?:way|leg|run|passage|trip|stretch|transit) (?:back )?home|homewards?|home leg|way"
    r" back)\b",
    re.IGNORECASE,
)
"""The way home as a thing."""
TO_BASE = re.compile(r"\bRTB\b")
FURTHER = _words(r"further|farther|another|more|east|west|north|south|hops?|first half")
"""Words that a length is a way with."""
TURNING = _words(r"headings?|bearings?|degrees?|turn\w*|look\w*|fac(?:e|ing)|bow|rotat\w+|swing\w*")
BARE_PAIR = re.compile(r"\d+(?:\.\d+)?\s*(?:,|and|,\s*and)?\s*\d+(?:\.\d+)?")
TO_BEFORE = re.compile(
    r"(?<!bow )(?<!turn )(?<!look )(?<!face"
    r" )\b(?:to|at|for|via|from|of|reach|point|position|waypoint|via)\s*$",
    re.IGNORECASE,
)
THEN_IN = re.compile(r"\b(then|and) (?:straight )?in(?=\s*(?:[.,;]|$))", re.IGNORECASE)
"""Into the berth, without a verb."""
QUOTED = re.compile(r"\"[^\"]*\"|(?<!\w)'[^']*'(?!\w)|[“‘][^”’]*[”’]")
"""Notes, labels and file tags."""

# Shapes
GRID = _words(
    r"grid|lawn-?mow\w*|mow(?:ing)? the (?:lawn|planned area|given"
    r" area|area)|boustrophedon|back-and-forth|lanes|(?:east-west|north-south) lines"
)
SQUARE = _words(r"square")
MENTIONS = _words(
    r"(?:on|during|along|of|off|not) (?:the|its|each|every|all)"
    r" (?:grid|lanes?|square|lawnmower)|between (?:the )?lanes|square up"
)
OTHER_SHAPE = _words(
    r"zig-?zag|spiral|triang\w+|hexagon\w*|pentagon\w*|octagon\w*|figure|ellip\w+|oval|diamond|ring|circle"
    r" of|points? (?:round|around|evenly)|stations|"
    r"creeping|sector search|expanding|parallel lanes|rectangle|points|mirror\w*"
)
SHAPED = _words(
    r"zig-?zag|spiral|triang\w+|hexagon\w*|pentagon\w*|octagon\w*|figure|ellip\w+|oval|diamond|ring|circle of|"
    r"points? (?:round|around|evenly)|stations|waypoints? (?:round|around)|"
    r"survey\w*|inspect\w*|map (?:the|a)|mapped|mapping|comb|sweep \d|sweep a|circle \W?\d|four"
    r" (?:sides|points|"
    r"corners)|from two sides|lanes?|lines|lawn\w*|lwn\w*|search|cover\w*|creeping|mow\w*|"
    r"(?:\d+|four|five|six|eight|ten|twelve)"
    r" (?:waypoints|points|stops)|spacing|(?:m|metres?|meters?) by|in x|"
    r"area around|area of|depth survey|from the (?:north|south|east|west)\w* and stop"
)
"""What a path may be meant by, where no grid and no square is named."""
AT_CORNER = re.compile(
    r"\b(?:corner|start\w*|begin\w*|edge|side|end)(?: of (?:the|its|an?)"
    r" (?:area|box|block|grid|patch|field|square|rectangle))?"
    rf"\s+(?:at|from|in|is|being|on)?\s*{OPENS}$",
    re.IGNORECASE,
)
EIGHT = _words(r"(?:all )?eight|8|standard")
NO_SQUARE = _words(
    r"four|clos(?:e|es|ed|ing)|half the|corners? (?:and|only)|mid-?sides?"
    r" (?:and|only)|never|leaving|left|limits?|fence|use a"
)
SQUARE_RUN = _words(
    r"(?:go|goes|going|drive|driving|run|running|survey\w*|inspect\w*|look\w*)\b[^.;]{0,60}"
    r" (?:on|in|with|from) (?:the|its|a) (?:[\w-]+ ){0,2}square"
)
CORNER = re.compile(
    r"\b(north|south)[ -]?(east|west)(?:ern|erly)?\b|\b(NE|NW|SE|SW)\b", re.IGNORECASE
)
COMPASS = re.compile(r"\b(?:north|south|east|west)\w*\b", re.IGNORECASE)
BEGINS = _words(r"start\w*|begin\w*|corner (?:to|and)|from the (?:other|far|near)")
LANES_X = _words(
    r"east(?:[- –]to)?[- –](?:and[- ])?west|west(?:[- –]to)?[- –]east|(?:along|parallel to) (?:the"
    r" )?x(?:[- ]axis)?"
)
LANES_Y = _words(
    r"north(?:[- –]to)?[- –](?:and[- ])?south|south(?:[- –]to)?[- –]north|(?:along|parallel to)"
    r" (?:the )?y(?:[- ]axis)?"
)
EXTENT = re.compile(
    r"(\b(?:wide|broad|long|width|length|extent|across)\W{0,3})(?:east|west|north|south)(?:[-"
    r" –]to)?[- –](?:and[- ])?(?:west|east|south|north)\b",
    re.IGNORECASE,
)
"""An extent with the direction in which it is measured: "40 m wide (east-west)"."""
BARE_SIZE = re.compile(r"^ ?(?:(?P<width>wide|broad|across)|(?P<length>long))\b", re.IGNORECASE)
"""An extent without a unit: "15 wide and 24 long"."""
STEP = re.compile(
    r"\b(?:step\w*|work\w*|progress\w*|shift\w*|advanc\w*|mov\w+) (?:to(?:wards)? (?:the"
    r" )?)?(?:lane by lane )?(north|south|east|west)(?:wards?)?\b",
    re.IGNORECASE,
)
SIDE = re.compile(
    r"\b(?:(?:middle|centre|center|mid-?point) of (?:the |its )?)?(north|south|east|west)(?:ern)?["
    r" -]?(?:side|edge|mid-?side|face)\b"
    r"|\b(?:from|in|on|at|starting|start) (?:the |its )?(?:middle of the"
    r" )?(north|south|east|west)\b",
    re.IGNORECASE,
)
CLOCKWISE = re.compile(
    r"\b(?:(counter|anti|[ac](?=cw\b))[- ]?)?(?:clock-?wise|cw)\b", re.IGNORECASE
)

# Sizes
ANGLED = re.compile(r"^[^\[(]*(?:\d\s?°|(?:\b|\d)deg)", re.IGNORECASE)
"""Two numbers that are angles."""
FAR = re.compile(r"kilom|km\b|mile", re.IGNORECASE)
"""Units in which a place is not read."""
SIZE = re.compile(
    r"\d\s?(?:ft|feet|yd|yards?)\b|^\d+ and \d+$|^[a-z]+(?:[- ][a-z]+)? and [a-z]+(?:[-"
    r" ][a-z]+)?$|\bby\b|;|\d\s?k?m\b|met(?:re|er)s?\b|\bmin|\bsec|"
    r"\d\s?s\b|hour",
    re.IGNORECASE,
)
MARGIN = _words(
    r"keep\w*|stay\w*|from (?:the"
    r" (?!north|south|east|west|start)|it|any|every|all|obst)|clear\w*|margin|distance|"
    r"nearer|closer|least|within|obstacle\w*|threshold|accura\w*|avoid\w*|buffer|anything|geotag\w*|gps|allow\w*|"
    r"berth"
)
BY = re.compile(r"\s?(?:m|metres?|meters?)?\s?(?:\(x\)|wide|in x)?\s?(?:by|x|×)\s?", re.IGNORECASE)
IS_WIDTH = re.compile(
    r"^\s?(?:m|metres?|meters?)?[ -]?(?:wide\b|in width|width|along x|in x|\(x\)|from (?:west to"
    r" east|east to west))",
    re.IGNORECASE,
)
IS_LENGTH = re.compile(
    r"^\s?(?:m|metres?|meters?)?[ -]?(?:long|in length|length|along y|in y|\(y\)|from (?:north to"
    r" south|south to north))",
    re.IGNORECASE,
)
IS_SPACING_BEHIND = re.compile(
    r"^\s?(?:m|metres?|meters?)?[ -]?(?:apart|spacing|line spacing|lane spacing|pitch|(?:in"
    r" )?between (?:the )?(?:lanes|lines|them)|line to line)",
    re.IGNORECASE,
)
IS_SPACING_BEFORE = re.compile(
    r"\b(?:spacing (?:is |of |at )?|spaced (?:at )?|lanes? (?:every|at)|lines? every|(?:one|a)"
    r" (?:lane|line|track) (?:every|each|to every|per)|"
    r"line spacing(?: is| of)?|"
    r"spacing to be|pitch (?:of )?|lane every|apart by|lanes) ?$",
    re.IGNORECASE,
)
OWN_SIZE = _words(
    r"given|planned|task'?s?|stated|its|standard|usual|the (?:survey|inspection) square"
)

# Ways and destinations
WAY_BEHIND = re.compile(
    rf"^\s?(?:(?:straight|directly|due|to|the|further|farther)\s+)*({_WAY})\b(\s+of\b\s*)?",
    re.IGNORECASE,
)
NO_DESTINATION = re.compile(
    r"\b(?:(?:stay|remain|keep|hold)\w* \w+|(?:lies|is|are|stands|sits) (?:at|on)|way"
    r" to|after|before|until|past|when at|round|around|about|"
    r"of|circle|orbit|centred on|centered on|from|\d\s?(?:m|met(?:re|er)s?) off)\s*(?:the point"
    rf" |the position |\w+ at )?{OPENS}$",
    re.IGNORECASE,
)
_OWN = r"(?:the |its )?(?:(?:task'?s?|given|planned|stated|target|goal|start(?:ing)?|last known) )*"
_OWN_NOUN = (
    r"(?:target|goal|cent(?:re|er)|start|position|point(?! cloud)|berth|location|destination)"
)
OWN = re.compile(rf"^{_OWN}{_OWN_NOUN}\b", re.IGNORECASE)
TO_OWN = re.compile(
    rf"\bgo in\b|(?<!way )(?<!relative )\b(?:to|at|for|reach|via) {_OWN}{_OWN_NOUN}\b(?!"
    r" (?:the|an?|your|her|recording)\b)"
    rf"(?! of the (?:task|side|edge|frame|picture)|"
    rf" (?:\d|[a-z-]+ (?:m|metres?|meters?|feet)\b)| to (?:follow|be|track|watch))(?!s)",
    re.IGNORECASE,
)
OWN_OPENS = re.compile(rf"^\W*{_OWN}{_OWN_NOUN}\b\s*(?:[,;.]|$)", re.IGNORECASE)
"""The task's own place as an item of a list."""
HOME = _words(
    r"(?:go|head|return|come|back|sail|drive|steam|run|transit|proceed)\w* (?:back )?(?:home|to"
    r" base|to home)|back home"
)
LINE = _words(
    r"on (?:a"
    r" )?(?:heading|course)|run\w*|sail\w*|follow\w*|go|going|drive|track\w*|line|course|distance"
    r" of|set distance|straight|pass|steam"
)
NO_LINE = _words(r"arc|orbit|circle|pan|sweep|nudge|rotat\w+|drift\w*|hold|turn(?:ing)?|round")
OWN_LENGTH = _words(
    r"(?:the )?(?:(?:full|set|given|planned|stated|max(?:imum)?|whole|task'?s?) )+(?:pass |track"
    r" |run )?(?:length|"
    r"distance)(?: of the (?:task|pass|track|run))?|"
    r"the (?:pass |track )?(?:length|distance) of the (?:task|pass|track|run)"
)
OWN_HEADING = _words(
    r"(?:the |its )?(?:(?:track|given|planned|stated|cable'?s?|task'?s?)"
    r" )+(?:heading|course|bearing)|heading of the (?:task|track|cable)"
)
ON_DEGREES = re.compile(
    r"\b(?:on|along|steering|(?:heading|course|bearing)(?: of)?)\s+(?:a"
    r" )?(?:(?:heading|course|bearing)(?: of)? )?(\d{1,3}(?:\.\d+)?)\b(?!\s?(?:m\b|"
    r"met|s\b|sec|min|%))",
    re.IGNORECASE,
)
ON_WAY = re.compile(
    r"\b(?:due|to"
    rf" the|run|running|go|sail|steam|drive|distance|straight|heading|course)\s+({_WAY})\b",
    re.IGNORECASE,
)
UNREAD = re.compile(r"\b(?:home|base|minus)\b", re.IGNORECASE)
"""Words that speak of a place, where none was read."""
LEADS = _words(
    r"change|go(?:es|ing)?|head(?:s|ing)?"
    r" (?:for|to|home|back|over)|proceed\w*|transit\w*|drive|driv\w+|steer\w*|"
    r"sail\w*|mak(?:e|ing) (?:for|your way)|return\w*|come|coming|back|home|base|"
    r"steam\w*|cruis\w+|reach\w*|visit\w*|mov(?:e|ing)|approach\w*|cross\w*|shift\w*|berth\w*|dock\w*|run|running|"
    r"track|follow|position yourself|take (?:her|it|the)|carry on|continue|"
    r"pass|transect|leg|distance of the task|waypoints?|round|line up|out to|get"
    r" to|bring|put|place|station \d+|leave for|work along|lap|loop"
)
GOES = _words(
    r"place|point|position"
    r" [a-z]|spot|waypoints?|leg|legs|lane|lanes|route|course|way|there|away|closer|nearer|across|along|past|towards?|into|between|"
    r"[a-z]+ward|[a-z]+wards|metres? (?:ahead|astern|forward|back|further|on|off)|m"
    r" (?:ahead|astern|forward|back|off)|inspect\w*|survey\w*|"
    r"visit|set off|depart\w*|"
    r"patrol\w*|circuit|perimeter|in"
    r" turn|site|location|destination|target|goal|start|berth|slip|quay|here"
)
"""Words that a run may be meant with."""
NO_LEAD = _words(
    r"(?:on|during|for|in) (?:the |each |every |both |all |either )?(?:[\w-]+"
    r" )?(?:legs?|runs?|pass|passes|"
    r"lanes?|way)\b|back[- ]and[- ]forth|go(?:ing|es)? (?:(?:counter|anti)[-"
    r" ]?)?clock-?wise|go(?:ing|es)? round|"
    r"(?:nearest|closest|strongest|first|laser|lidar) returns?|round|run(?:ning)?"
    r" (?:the|a|over|along|your|this|that|image|ocr|gps|quality|\w+ion|"
    r"object|lanes?|north|"
    r"east|x|y)\b|"
    r"lanes running|on every leg|at (?:each|every) waypoint|at all waypoints|waypoint|carry"
    r" on|drive (?:the|a)|do the|the detector running|work(?:ing)? along|"
    r"(?:eight|8)[- ]waypoint|(?:all )?eight waypoints|the way|under way|while moving|when"
    r" moving|moving|put(?:ting)? |bring the lens|in place|take the"
)

# Movements besides waypoints
LOCKED = re.compile(
    r"\b(?:(?:hold|keep|fix|lock|maintain)\w* (?:the |your |its |her )?(?:heading|bow|nose)(?:"
    r" (?:locked|fixed|steady|on its heading|where it is))?|"
    r"(?:with (?:the |a )?)?(?:heading|bow|nose)[ -]?(?:is |stays |kept |to stay"
    r" )?(?:lock\w*|fixed)|locked (?:heading|bow)|heading hold)\b",
    re.IGNORECASE,
)
STILL = re.compile(
    r"\b(?:hold\w*|stay\w*|station(?:ary)?|stop\w*|remain\w*|wait\w*|loiter\w*|stand\w*|rest\w*|paus\w*|linger\w*|"
    r"park\w*|position for|second\w*|minute\w*|hour\w*|"
    r"\d+ ?s|min|h|cent(?:re|er)\w* (?:it|on|the|in)|centred|centered|fram\w+|picture|in"
    r" view|turn\w*|rotat\w*|"
    r"fac(?:e|es|ing)|swing\w*|spin\w*|pivot\w*|line up|lined up|yaw\w*|look\w*|"
    r"nudg\w*|pan(?:s|ning)?|twist\w*|trim|arc\w*|sweep\w*|curv\w*|bend|loop"
    r" to|orbit\w*|circl\w*|drift\w*|float\w*|"
    r"engines?|adrift|propulsion|current|steady|stab\w+|settl\w*|pitch|roll|motion|"
    r"degrees?|bearing|heading|bow|nose|course|follow\w*|track\w*|headings|panorama|"
    r"position with|in position|keep position|the position within|on the spot|square"
    r" up|view|moor\w*)\b",
    re.IGNORECASE,
)
"""What speaks of a hold, a turn, a drift or a target kept in view."""
