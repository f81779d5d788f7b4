"""How task inputs word lines and the passes beside them: the patterns by which `faces` reads
them.
"""

from __future__ import annotations

import re

_NUMBER = r"(?:(?:minus|negative) |[-−–])?\d+(?:\.\d+)?"
_WAY = r"(?:north[ -]?(?:east|west)|south[ -]?(?:east|west)|north|south|east|west)"
_THINGS = (
    r"(?:face|wall|edge|quay\w*|jetty|pier|breakwater|mole|groyne|side|hull|structure|berth|bulkhead|dolphins?|caisson|platform|boom|barge|front|"
    r"pipeline|pipe|cable|dam|dyke|dike|pontoon|sheet piling|piling|net"
    r" pen|pen|ferry|fence|bank|embankment|raft|ramp|causeway|weir|lock|wreck|"
    r"ship|tanker|lighter|slipway|kerb|revetment|row of \w+)"
)


def _words(pattern: str) -> re.Pattern[str]:
    return re.compile(rf"\b(?:{pattern})\b", re.IGNORECASE)


def number(text: str) -> float:
    """A number with whatever stands for its sign."""
    return float(re.sub(r"^(?:minus |negative |[−–])", "-", text, flags=re.IGNORECASE))


def clause(before: str) -> str:
    """What stands behind the last full stop or semicolon."""
    return re.split(r"[.;]\s", before)[-1]


def sentence(text: str, at: int) -> tuple[int, int]:
    """Where the sentence around a place in the text begins and ends."""
    begin, end = at - len(clause(text[:at])), re.search(r"[.;](?:\s|$)", text[at:])
    return begin, at + end.start() if end else len(text)


def sentence_at(text: str, at: int) -> str:
    """The sentence around a place in the text."""
    begin, end = sentence(text, at)
    return text[begin:end]


# The line
RANGE = re.compile(
    rf"\b(?:from|between|spans|spanning|over)?\s*\b(?P<axis>[xy])\s?(?:=|(?:goes|runs|is|reaches|stretches|extends)?\s*(?:from|between)|"
    rf"of)?\s?(?P<one>{_NUMBER})"
    r"\s?m?\s*(?:to|and|up to|down to|as far"
    rf" as|through|till|until|\.\.+)\s*(?:(?P=axis)\s?=?\s?)?(?P<two>{_NUMBER})\b(?!\.\d)"
    rf"(?!\s*,\s*{_NUMBER}\b(?!\s?(?:m\b|met|ft|feet|yards?|yd)))",
    re.IGNORECASE,
)
"""The values between which a coordinate runs: "from y = -40 to y = 30", "x between 100 and 150"."""
FIXED = re.compile(
    r"\b(?:(?:on|along|at|line)"
    rf" +)?(?P<axis>[xy])\s?(?:=|is|equals|of|at)?\s?(?P<at>{_NUMBER})\b(?!\.\d)",
    re.IGNORECASE,
)
"""The coordinate that stays the same."""
THING = _words(rf"(?:(?:the|an?|its|this|that|our) )?(?:[\w'’-]+ ){{0,3}}?{_THINGS}")
"""Something that can be passed."""
SOLID = _words(_THINGS)
TO_OTHER_END = re.compile(
    r"\s*(?:\(?(?:\w+ )?end\)?)?,?\s*(?:(?:up|down|over|across|on|straight)\s+)?(?:to|and|as far"
    r" as|-|–|->|until|"
    r"(?:and )?the other (?:end )?(?:is )?(?:at|on|in))\s*"
    r"(?:its |the )?(?:other end (?:at|on) |\w+ end (?:at|on) )?",
    re.IGNORECASE,
)
"""Between the two ends of a line."""
IS_LAID = re.compile(
    r"\b(?:runs|is|are|lies|goes|stretches|extends|reaches|stands|leads|lying|ends|spans|was"
    r" laid|is laid|measured|laid)\b[^.;:§]{0,60}$|"
    r"\b(?:has its ends|ends at)\b[^.;:§]{0,20}$",
    re.IGNORECASE,
)
"""Before the first end of a thing that the text says is there."""
LABEL = re.compile(
    rf"\W*(?:the |our |a )?(?:[\w'’-]+ ){{0,2}}{_THINGS}(?:,| from|:| between)*\s*", re.IGNORECASE
)
"""A thing that is named at the beginning of a sentence, with its ends: "Lock wall from"."""
THING_BEHIND = re.compile(
    r"\s*,?\s*(?:lies|stands|runs|is|you find|there is) (?:the|an?|our) (?:[\w'’-]+"
    rf" ){{0,2}}?{_THINGS}\b",
    re.IGNORECASE,
)
GOES = _words(
    r"begins|starts|goes|runs|stretches|extends|reaches|leads|lies|continues|one end (?:is |lies"
    r" )?(?:at|on)"
)
"""Verbs of a thing that is described."""
BEARING = re.compile(
    rf"\b(?:on|along|bearing|heading|course|direction|lying|lies)\s+(?:a |the"
    rf" )?(?:(?:bearing|heading|course|direction)(?: of)? )?(?P<deg>\d{{1,3}})\b"
    rf"(?!\s?(?:m\b|met|ft|feet|yards?|\.\d))(?: ?(?:degrees|deg|°))?"
    rf"|\b(?:due|goes|runs|to the|straight|on|bearing|direction)\s+(?P<way>{_WAY})(?:wards?)?\b(?!["
    r" -](?:(?:side|face|end|of|wall|edge|north|south|to|"
    rf"and)\b|east|west))",
    re.IGNORECASE,
)
"""The bearing of a line."""
FACES = re.compile(r"\b(?:faces|facing|looks|looking|side|face)\s+(?:that )?$", re.IGNORECASE)
MIDDLE = re.compile(
    r"\b(?:mid-?point|middle|cent(?:re|er)|halfway point)(?: (?:of (?:it|the"
    r" \w+)))?(?:\s*(?:is|at|on|in|lies|being|over|:|=))*\s*(?:at )?$|"
    r"\b(?:cent(?:red|ered)) (?:on|at|about|in)\s*$",
    re.IGNORECASE,
)
"""Before the middle of a line."""
MIDDLE_BEHIND = re.compile(
    r"^\s*,?\s*(?:(?:being|as|is|in|at) )?(?:its|the|your) (?:middle|mid-?point|cent(?:re|er))\b",
    re.IGNORECASE,
)
OWN_LENGTH = _words(
    r"(?:given|stated|planned|set|its|task'?s?) (?:length|distance)|as long as"
    r" (?:stated|given|planned)"
)
LIES_ALONG = re.compile(
    r"\b(?:(?P<y>north[ -](?:to[ -]|and[ -])?south|along (?:the )?y)|(?P<x>east[ -](?:to[ -]|and["
    r" -])?west|west[ -](?:to[ -])?east|along (?:the )?x))\b",
    re.IGNORECASE,
)
"""A line that lies along an axis."""

# The passes
TO_BEGINNING = re.compile(
    r"\b(?:go|head|proceed|steam|motor|sail|drive|get|come|move|transit)(?:"
    r" (?:first|straight|over|out|up|round|down))* to (?:the |its "
    rf")?(?P<end>{_WAY})(?:ern(?:most)?|most)? (?:end|corner|tip)"
    r"(?: (?:of (?:it|the [\w-]+)|first))?,?(?: and| and then| then| and from there| from there)?"
    r" (?=(?:run|follow|pass|go|sail|steam|drive|move|creep|"
    r"track|work|motor|cruise|continue|proceed)\b"
    r"(?: (?:it|along|beside|parallel|the|face|wall|all|way|slowly|steadily|straight))*(?: to"
    rf" (?:the |its )?(?:{_WAY}(?:ern)?|other|far) (?:end|corner|"
    r"tip)| (?:its|the) (?:whole|full) length))",
    re.IGNORECASE,
)
"""The way to the end at which the pass begins."""
APPROACH = re.compile(
    r"\b(?:(?:not |nor )?(?:on|during|in|for|with) )?(?:the |its"
    r" )?(?:approach|way|run-in|run|transit|trip|passage|leg)(?: (?:out|over|up|in))? to "
    rf"(?:(?:the |its )?(?:{_WAY}(?:ern)? )?(?:end|corner|start\w*"
    r"(?: point)?|beginning|line)|it)\b(?: (?:included|excluded|as well|too|alone|only))?",
    re.IGNORECASE,
)
"""The way to a pass, on which something is done or not done."""
ON_PASS = re.compile(
    rf"\b(?:on|during|for|in) (?:the |that )?(?:{_WAY}["
    r" -]?(?:bound|wards?|going)|first|second|outer|inner|last|return) (?:run|pass|leg|one)(?:"
    r" (?:itself|"
    r"only|alone))*|"
    rf"\b(?:nothing|none|no \w+) (?:on|during|for) the (?:{_WAY}["
    r" -]?(?:bound|wards?|going)|first|second|outer|inner|return|other|last|way)(?: (?:run|pass|"
    r"leg|one|back|out))?",
    re.IGNORECASE,
)
"""Words for one of the passes, on which something is done."""
PARTS = re.compile(
    rf"[.;:]\s+|\s[-–—]\s|,\s*(?:and )?(?={_WAY}bound"
    r" (?:at|\d|off|over|on)\b)|,?\s*(?:\band\s+)?\bthen\b|"
    r",?\s*\b(?:and\s+)?(?=(?:the |a )?second\b(?! (?:point|end|place|\w+ given)))|"
    r",?\s*\b(?:and\s+)?(?=the other (?:run|pass|leg|one)\b)|,?\s*\band\s+(?=(?:one|another)"
    r" (?:run|pass|leg|back)\b)|"
    r",?\s*\band\s+(?=(?:(?:straight|right|come|go|run|sail|all the way|turn round and|make your"
    r" way) ){0,2}(?:back|return\w*|reverse\w*)\b)",
    re.IGNORECASE,
)
"""Between the passes of a text."""
THERE_AND_BACK = re.compile(
    r"\bthere and back(?: again)?\b(?! to)|(?<!further )(?<!farther )(?<!m )(?<!metres )\bout and"
    r" back\b(?! to)",
    re.IGNORECASE,
)
ONLY_KEEPS = re.compile(
    r"^\W*(?:(?:keep|stay|hold|remain|stand)\w* )?(?:at )?(?:about )?\d+(?:\.\d+)?"
    r" ?(?:m|met(?:re|er)s?) (?:off|away|clear|from|out)\b[^.;:]{0,40}$",
    re.IGNORECASE,
)
"""A part that only says how far off the passes are."""
SHIFT_PARTS = re.compile(
    r",?\s*\b(?:and )?(?=(?:side-?step|step|move|shift|open|widen|go|come|edge|ease) (?:straight"
    r" |directly |square |sideways )?(?:further )?(?:out|off|in|"
    r"away)\b)|"
    r",?\s*\band (?=(?:run|pass|sail|go|steam|drive|head|come|do|make)\b)",
    re.IGNORECASE,
)
"""Between the passes of a text that speaks of a change of distance as well."""
SHIFT = re.compile(
    r"^\W*(?:and |then )*\d+(?:\.\d+)?(?:\s?(?:m|met(?:re|er)s?))? (?:further|farther)"
    r" (?:out|off|away|in)\b|^\W*(?:(?:and|now|there|next|from there|"
    r"at the end(?: of (?:it|the (?:run|pass)))?|on reaching the end),?"
    r" )*(?:side-?step|step|mov|shift|go|come|edg|eas|open|widen|clos|stand|back|pull|"
    r"drop|slid|haul|"
    r"crab|increas\w+ (?:the )?(?:stand-?off|distance)|extend)\w*(?: (?:it|her|the boat|the"
    r" stand-?off|the distance|straight|directly|sideways|further|"
    r"over|across|square|out|off|away|in|closer|outwards?|"
    r"inwards?|to|at|right"
    rf" angles|by|another|due|{_WAY}(?:wards?)?))*[\s,]+(?=\d|half|double|twice)",
    re.IGNORECASE,
)
"""A part of the text that only changes the distance between two passes: "step straight out to 10 m
north of it".
"""
FURTHER = re.compile(r"^\s?(?:further|farther|more)\b", re.IGNORECASE)
FURTHER_BEFORE = re.compile(r"\b(?:by|another|a further)\s+$", re.IGNORECASE)
"""A length that is added to the distance so far."""
DISTANCES = re.compile(
    r"\b(?:at|stand-?offs? of|distances? of|passes:?|runs:?|off:?|side:?|side,)\s+(?:stand-?offs?"
    r" of |distances? of )?(\d+(?:\.\d+)?(?:\s?(?:m|met(?:re|"
    r"er)s?))?"
    r"(?:(?:,| and| then|, and|, then| and then)(?: at)?"
    r" \d+(?:\.\d+)?(?:\s?(?:m|met(?:re|er)s?)\b)?)+)(?<=[ms\d])(?=\s?(?:off|from|out|away|north|south|"
    r"east|west|to the|clear of|[.,;:]|$|-))",
    re.IGNORECASE,
)
"""The distances of several passes in one list: "passes at 5, 10 and 15 m"."""
ALTERNATING = re.compile(
    r"\b(?:alternat\w+|back and forth|to and fro|up and down|there and back|out and"
    r" back|turn(?:ing)? (?:round )?at (?:each|the|either) ends?|"
    r"each (?:\w+ )?(?:in the )?(?:opposite|other|"
    r"reverse)|(?:and|then|second|other|next)(?: \w+){0,2} (?:straight )?back|in opposite"
    r" directions?|opposite (?:way|direction)s?|reversing|"
    r"(?:the )?other way)\b",
    re.IGNORECASE,
)
SAME_WAY = re.compile(
    rf"\b(?:both|each|all|every)\b[^.;]{{0,28}}?(?:\b{_WAY} (?:end )?to|{_WAY}bound|in the same"
    rf" direction|the same way|from the {_WAY})",
    re.IGNORECASE,
)
EACH_RUN = re.compile(
    r"\b(?:for|on|at|in) (?:each|every|both) (?:of the )?(?:run|pass|leg)s?[^.;]*", re.IGNORECASE
)
"""What is done on every pass."""
PASS = _words(
    r"pass(?!es\b)|passage|run|runs|running|along|beside|parallel|go|sail|drive|traverse|transect|leg|slide|glide|take"
    r" (?:her|it|the)|follow|keep|"
    r"line|cruise|steam|motor|creep"
)
ALONG = _words(
    r"along|parallel|beside|past|(?:one|a|single) (?:\w+"
    r" )?(?:pass|run)|(?:run|pass|follow|sail|drive) (?:it|its|along|down|up|the"
    r" (?!detector|camera|"
    r"recorder)[\w-]+)"
)
NUMBERED = re.compile(r"^\W*(?:the |a )?(?:first|second|third|one|another|other)\b", re.IGNORECASE)
"""A part of the text that begins with the number of a pass."""
BOTH_WAYS = _words(
    r"there and back|out and back|up and down|both ways|in both directions|forth and back|back and"
    r" forth|and back again"
)
BACK = _words(
    r"(?:straight |right )?back(?! (?:to )?home)|return\w*|reverse[sd]?|in reverse|opposite"
    r" (?:way|direction|course)|other (?:way|"
    r"direction)(?: (?:a?round|about))?|reciprocal\w*"
)
BACK_SAME = re.compile(
    r"\bback(?: again)?,? (?:(?:by|along|on|over|in) )?the same (?:way|line|track|path|route)\b",
    re.IGNORECASE,
)
"""Back where it came from, which is not the direction of the first pass."""
DIRECTION = re.compile(
    rf"\b{_WAY}(?:ern|wards?)?[ -]to[ -](?P<to>{_WAY})(?:ern|wards?)?\b|\b(?P<way>{_WAY})["
    r" -]?(?:bound|wards?|about)\b"
    rf"|\b(?:heading|going|running|run|pass|due|sail|steam|course|steer|head|go)\s+(?P<go>{_WAY})\b(?!["
    r" -](?:to|of|side|face|end|wall|edge)\b)",
    re.IGNORECASE,
)
"""The direction of a pass."""
_ENDS = r"(?:end|corner|tip|extremity|extreme|head|one)"
FROM_END = re.compile(
    r"\b(?:from|start\w*|begin\w*|enter\w*)(?: (?:at|from|on|with|in|off|abreast of|level"
    rf" with|opposite))? (?:the |its )?({_WAY})(?:ern(?:most)?|"
    rf"most)? {_ENDS}\b",
    re.IGNORECASE,
)
TO_END = re.compile(
    r"\b(?:to|towards|end\w*|finish\w*|as far as)(?: (?:at|on|in|off|abreast of|level"
    rf" with|opposite))? (?:the |its )?({_WAY})(?:ern(?:most)?|most)? {_ENDS}\b",
    re.IGNORECASE,
)
END_OF = re.compile(rf"\b{_WAY}(?:ern(?:most)?|most)? {_ENDS}\b(?: of)?", re.IGNORECASE)
GROWING = re.compile(
    r"\b(increasing|growing|rising|ascending|decreasing|falling|descending) ([xy])\b", re.IGNORECASE
)
GIVEN_ORDER = _words(
    r"in that (?:direction|order)|that way|(?:from )?end to end|(?:the )?same"
    r" (?:way|direction)|(?:in )?the (?:direction|order) (?:given|stated|"
    r"named)|from the first|"
    r"(?:from|start\w*|begin\w*)(?: (?:at|from|with|abreast of|off|level with))? the (?:first(?:"
    r" \w+)?|end|point) (?:i (?:gave|named|mentioned)|given|"
    r"stated|named|mentioned)|"
    r"(?:from|start\w*|begin\w*)(?: (?:at|from|with|abreast of|off|level with))? the"
    r" (?:first|given|stated|named) (?:end|point|one|place)"
)
STARTS_AT = re.compile(
    r"\b(?:start\w*|begin\w*)(?: (?:at|from|with|abreast of|off|level with))+ $", re.IGNORECASE
)
OTHER_ORDER = _words(
    r"(?:from|start\w*|begin\w*)(?: (?:at|from|with|abreast of|off|level with))? the"
    r" (?:second|last|far|other)(?:[- ](?:named|mentioned|"
    r"given))? (?:end|point|one|place)"
)
NAMED_SIDE = re.compile(
    rf"\b({_WAY})(?:ern)?[ -]{{1,2}}(?:side|face|wall)\b|\b(?:to|on) (?:the |its )?({_WAY})(?:ern)?"
    rf" (?:of|side)\b|\b({_WAY}) of\b"
    r"|\b(?:off|away|out|displaced|metres|meters|m|feet|ft|yards?|yd|fathoms?) (?:to )?(?:the |its"
    rf" )?({_WAY})\b(?=[.,;]|\s*$|\s+(?:and|with|of)\b)",
    re.IGNORECASE,
)
"""The side of a line by the compass."""
FACING = re.compile(
    r"\b(?:side|face)\b[^.;,§]{0,15}\b(?:faces|facing|looks|looking|towards)\s+(?:to |towards"
    rf" )?(?:(\d{{1,3}})\b|({_WAY})\b)",
    re.IGNORECASE,
)
HAND = re.compile(
    r"(?P<kept>\b(?:keep|keeping|have|having|leave|leaving|with)\s+(?:it|the [\w-]+(?:"
    r" [\w-]+)?|that [\w-]+)\s+(?:[^\s.;,]+ ){0,4}?)?"
    r"\b(?:on|to)\s+(?:the |its |your |her |our )?(?P<hand>right|left|starboard|port)(?:[-"
    r" ]hand)?(?: (?:side|hand|beam)\b|"
    r"\b(?! [a-z]{3,}(?<!side)(?<!of)(?<!it)(?<!as)))",
    re.IGNORECASE,
)
"""The side of a line as one travels; the thing itself can be what is kept there."""
OFF_BEHIND = re.compile(
    r"^\s?(?:off|out|away|(?:further|farther) (?:out|off|away)|clear of (?:it|the|that)|wide of|to"
    rf" (?:the )?{_WAY}|to (?:the |its )?(?:right|left|port|"
    rf"starboard)|from (?:it|the|that|its|"
    rf"this)|(?:due |to the )?{_WAY} of|beside|distant|abreast|stand-?off|"
    r"on (?:its|the)|(?:in )?parallel|in front of)\b",
    re.IGNORECASE,
)
OFF_BEFORE = re.compile(
    r"\b(?:at|(?:out|off|away|in|closer|back) to|stand-?off(?: distance)?(?: of)?|distance"
    r" of|displaced(?: by)?|offset(?: by)?|standing|"
    r"keeping)\s+(?:about |roughly |a |the )?$",
    re.IGNORECASE,
)
OFF_ALL = re.compile(
    r"^\s?(?:off|from|away from|clear of|clear|to|of clearance|of room|of)\s*(?:of |from"
    r" )?(?:any|every|all|obst|other|traffic|vessels|boats|"
    r"the (?:other|next|nearest))|^\s?(?:clear|of clearance|of room)\b"
    r"(?! of (?:it|the|that)\b)",
    re.IGNORECASE,
)
"""A distance that is kept from everything, not from the line."""
MARGIN_BEFORE = re.compile(
    r"\b(?:margin|clearance|at least|no (?:closer|nearer)(?: than)?|never less than|nothing"
    r" (?:closer|within)|within|obstacle\w*|accura\w*|threshold|"
    r"to better than|range)\b[^,;]{0,25}$",
    re.IGNORECASE,
)
OWN_DISTANCE = _words(
    r"(?:the |its )?(?:(?:set|given|stated|planned|usual|ordered|prescribed|task'?s?)"
    r" )+(?:distance|stand-?off|offset|clearance)|(?:distance|"
    r"stand-?off) (?:of the task|given|stated|set|as planned)|stand-?off"
)
"""The stand-off of the task."""
MULTIPLE = _words(
    r"(double|twice|half)(?: of)? (?:that|the (?:first|distance|stand-?off)|as (?:far|much))\w*"
)
COUNT = _words(r"(two|three|four|2|3|4) (?:\w+ )?(?:passes|runs|lines)")
COUNTED = {
    "two": 2,
    "three": 3,
    "four": 4,
    "five": 5,
    "six": 6,
    "seven": 7,
    "eight": 8,
    "2": 2,
    "3": 3,
    "4": 4,
}
ELSEWHERE = re.compile(
    r"\b(?:home|base|dock|half"
    r" ?way|laps?|again|but|if|instead|rather|sorry|scrap|scratch|twice|three"
    r" times|before|lanes?|grid|square|zig-?zag|spiral|"
    r"every \d|waypoints? (?:every|each)|"
    r"stop\w* every)\b",
    re.IGNORECASE,
)
"""Words of another way beside the passes."""
NOT_ELSEWHERE = _words(
    r"(?:north|south|east|west)(?:wards?|bound)? again|twice that|both times|there and back"
    r" again|back again|nothing but|not before|home port|"
    r"before (?:each|the|you|it)[^.;,]{0,30}(?:camera|lens|"
    r"recording|sensor)"
)
