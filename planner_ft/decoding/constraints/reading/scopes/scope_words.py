"""How task inputs word the steps that something runs in: the patterns by which `scopes` reads them,
on text in small letters.
"""

from __future__ import annotations

import re

from planner_ft.decoding.constraints.reading.rows.movement_words import (
    ARC,
    DRIFT,
    FACE,
    GOTO,
    HOLD,
    NUDGE,
    VISUAL,
    WAIT,
)

LAST = -1


def whole_words(pattern: str) -> re.Pattern[str]:
    return re.compile(rf"\b(?:{pattern})\b")


CHANGED = re.compile(
    r"\b(?:i|we) (?:said|asked|told|wanted|wrote)\b|\bmake (?:that|it)"
    r" (?:the|both|all|one|two)\b|\bcorrection\b|\bno, (?:while|on|in|at|during|the|only)\b|"
    r"\btake (?:that|it) back\b|\b(?:two|three|four|five|six|[2-6]) (?:stops|halts|pauses|waits)"
    r" of\b|"
    r"\bas (?:at|on|in) (?:the )?(?:@|\d|first|second)|\bnothing of the"
    r" sort|\b(?:arriving|waiting|leaving),|\bi mean\b|\brather not\b"
)
"""Words of texts that take a scope back, give it by what was said of another step, or by single
words.
"""

# ---------------------------------------------------------------- what the text as a whole says of
# its movements
MANY = whole_words(
    r"grids?|lawn-?\w*|mow\w*|lanes?|lines|squares?|circle"
    r" of|points|waypoints|stations|zig-?zag|spiral|triang\w+|sectors?|evenly|"
    r"steps of|in (?:\w+ ){0,2}steps|survey\w*|inspect\w*|all the way round|length|\w+ (?:equal )?"
    r"(?:rotations|pans|turns|nudges|steps)(?="
    r" (?:of|to|each|at|by)\b)|times|again|twice|repeat\w*|once more|each|headings|bearings|"
    r"pass|passes|track|transect|straight|line|all sides|one after the other|"
    r"in (?:that|this) order|in turn|along|parallel|full (?:turn|circle|rotation)|right round|work"
    r" your way|strips?|rows|same|as before|"
    r"and (?:then )?(?:\w+ )?to \d+|every|alternat\w+|"
    r"hexagon\w*|octagon\w*|pentagon\w*|\w+gon|ring|round"
    r" (?:it|the)|(?:four|five|six|seven|eight|nine|ten|twelve)(?! (?:min|sec|hour|"
    r"met|m\b|deg|and a half|point|hundred|thousand|or )\w*)|\d+ (?:of|pans|turns|nudges)|run \w+"
    r" (?:m|metres?|meters?)"
)
"""Words for a movement of several steps, or for one that is done again: steps cannot be counted by
movements.
"""
UNORDERED = whole_words(
    r"before|after (?!that|this|which)|once|preceded|followed|precedes|comes|backwards|but"
    r" first|earlier|having|until then|first of all|"
    r"last of all|alternat\w+|on the way to @|reverse"
)
ELLIPTIC = whole_words(
    r"as the (?:first|second|third|last|former|one)|likewise|ditto|as before|another"
    r" (?:at|in|on|for|one)|"
    r"same (?:again|there|as)|and again"
)
RUNS = re.compile(r"@|\b(?:home|back|return\w*|base|target|goal|start|centre|berth)\b")
"""Words for places to go to; the same one may be named twice."""
PAUSED = re.compile(
    r"\b(?:paus|stop|hold|wait|stay|station|stand)\w*\b[^.;]{0,60}\b(?:each|every)\b|\b(?:each|every)\b[^.;]{0,40}\b(?:paus|stop|hold|wait|stay)\w*"
)
HOME = whole_words(r"home|base")
HOMEWARDS = whole_words(r"home|base|return\w*|back")
STEP = whole_words(r"steps?")
BARE = re.compile(
    r"(?:first|second|third|fourth|fifth|sixth|last|latter|former|final|1st|2nd|3rd|ones?)$"
)
STOPS = whole_words(r"stop\w*|paus\w+|wait\w*|hold(?:ing)?(?! the)")
SCOPED = whole_words(
    r"before|after|once|until|through|with(?= the \w+"
    r" (?:only|alone))|only|alone|rest|back|both|either|each|then|while|second|two|three|"
    r"four|five|six|first|last|in [a-d]\b|on the (?:grid|square|lanes|way)|off|the"
    r" (?:drift|hold|turn|run|trip)|this|that|home|there|"
    r"next|finally|afterwards|no"
)
"""Words of texts in which a skill may be meant for some steps only."""
RUN_ON = re.compile(
    r"\b\d{1,3}(?:°| degrees)?(?:, then|, and then| and then|, | and) \d{1,3}(?:,| and|"
    r" then|[.;]|$)|(?:north|south|east|"
    r"west)\w*(?:, then|, and then| and then|,| and) (?:north|south|east|west)|\b\d{2,3},? then"
    r" \d{1,3}\b|\b(?:run|follow|drive|track|"
    r"pass|sail|go)\w*\b[^.;]{0,60}\bfrom"
    r" @|\b(?:run|follow|track)\w*\b[^.;]{0,30}\b(?:length|distance|cable|course)\b|"
    r"\bfollow(?:ing)? (?:a |the )?(?:cable|course|heading|\d)|\d ?(?:m|metres?|meters?)"
    r" (?:on|along|due)\b|"
    r"\bfollow\w*\b[^.;]{0,40}?\d+ ?(?:m|metres?)\b|@,? (?:and |then |and then )?@|\bvia"
    r" @|\b(?:run|go|drive|sail|"
    r"move)\w*\b[^.;,@]{0,20}?\d+ ?(?:m|metres?|meters?|km)\b|(?:from|between)"
    r" @[^.;]{0,20}?\b(?:to|and)\b @|@ (?:to|and) @|"
    r"\band back (?=by |\d)|degrees?[^.;]{0,25}?(?:,|and|then)(?: then| and)? (?:by )?[\w-]+"
    r" degrees?|°[^.;]{0,20}?(?:,|and|then)[^.;]{0,12}?\d+ ?°"
)

# ---------------------------------------------------------------- scopes
_ORDINALS = (
    ("first", "1st", "initial"),
    ("second", "2nd"),
    ("third", "3rd"),
    ("fourth", "4th"),
    ("fifth", "5th"),
    ("sixth", "6th"),
    ("seventh", "7th"),
    ("eighth", "8th"),
    ("ninth", "9th"),
    ("tenth", "10th"),
)
_NUMBERS = ("one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")
ORDINAL = {word: index for index, words in enumerate(_ORDINALS) for word in words} | {
    "last": LAST,
    "final": LAST,
    "latter": LAST,
    "former": 0,
    "closing": LAST,
    "opening": 0,
}
COUNTS = {"both": 2, "two": 2, "three": 3, "four": 4, "five": 5, "2": 2, "3": 3, "4": 4, "5": 5}
BARE_COUNTS = {"both": 2, "two": 2, "three": 3, "four": 4, "five": 5, "six": 6}
CARDINAL = (
    {word: index for index, word in enumerate(_NUMBERS)}
    | {str(index + 1): index for index in range(10)}
    | {letter: index for index, letter in enumerate("abcdef")}
)
NOUNS: dict[str, tuple[frozenset[str], frozenset[str]]] = {
    r"steps?|parts?|stages?|phases?|ones?(?! (?:hundred|and a|or"
    r" two|minute|second|hour|min|sec|s)\b)|moves?|movements?|manoeuvres?|of them|of these|"
    r"of those|sections?|elements?|actions?|lines?(?= \d)": (frozenset(), frozenset()),
    r"legs?|runs?|transits?|approach(?:es)?|drives?|trips?|crossings?|stretch(?:es)?|straights?|transfers?": (
        frozenset({GOTO}),
        frozenset(),
    ),
    r"lanes?": (frozenset({GOTO}), frozenset()),
    r"waypoints?|points|corners?": (frozenset({GOTO}), frozenset({HOLD})),
    r"stops?": (frozenset({HOLD}), frozenset({VISUAL, GOTO})),
    r"holds?|station[- ]keep(?:s|ing)?": (frozenset({HOLD}), frozenset({VISUAL})),
    r"pauses?": (frozenset({HOLD}), frozenset({WAIT})),
    r"visual holds?|visual station keep(?:ing)?|visual part|centring": (
        frozenset({VISUAL}),
        frozenset(),
    ),
    r"drifts?|floats?": (frozenset({DRIFT}), frozenset()),
    r"turns?|swings?": (frozenset({FACE}), frozenset({NUDGE, ARC})),
    r"rotations?": (frozenset(), frozenset({NUDGE, FACE})),
    r"headings?|bearings?|facings?": (frozenset({FACE}), frozenset({NUDGE, HOLD})),
    r"nudges?|pans?": (frozenset({NUDGE}), frozenset()),
    r"arcs?|curves?|bends?|sweeping turns?|arc turns?|quarter circles?": (
        frozenset({ARC}),
        frozenset(),
    ),
    r"sweeps?": (frozenset({ARC}), frozenset({NUDGE})),
    r"waits?|settling|waiting": (frozenset({WAIT}), frozenset({HOLD})),
}
"""Nouns of scopes, with the navigation skills that they mean and those that they may mean as well;
none: any step.
"""
MOVEMENT_KINDS = tuple(re.compile(pattern) for pattern in NOUNS)
_NOUN = "(?:" + "|".join(NOUNS) + ")"
_KIND_NOUN = (
    "(?:" + "|".join(pattern for pattern, (sure, maybe) in NOUNS.items() if sure or maybe) + ")"
)
ORD = "(?:" + "|".join(ORDINAL) + ")"
_ORDS = (
    rf"{ORD}(?:(?:, (?:the )?{ORD})*,? (?:and|or) (?:(?:in|on|for|during) )?(?:the )?{ORD}(?!"
    r" (?:is|goes|runs|has)\b))?"
)
_CARDS = r"(?:one|two|three|four|five|six|seven|eight|[1-9])"
_CARDLIST = rf"{_CARDS}(?:(?:, {_CARDS})*(?:,? and |\+| & |/){_CARDS})?"
_PREP = r"(?:in|on|during|for|at|through|throughout|over|of|to|with|within)"
_THE = r"(?:the |this |that |its |these |those )"
_END = (
    r"(?=\s*(?:$|[,.;:)(]|only\b|alone\b|and\b|but\b|not\b|as\b|too\b|then\b|please|is\b|are\b|goes|runs|has\b|keeps?\b|needs?\b|do\b|"
    r"may\b|just\b|you\b|i\b|tnx\b|thx\b|thanks\b|pls\b|over\b(?=\W*$)))"
)
SCOPES: tuple[tuple[str, re.Pattern[str]], ...] = (
    (
        "except",
        re.compile(
            rf"\b(?:{_PREP} )?(?:all|every(?:thing|where)?|each|any|whichever)(?: of)?(?: the| them| these)?(?: \w+)??(?: (?P<before>{_NOUN}))? ?(?:but|"
            rf"except|bar|save|apart from|is not)(?: for)?(?: {_PREP})? "
            rf"(?:the |this )?(?P<ords>{_ORDS})(?: (?P<noun>{_NOUN}))?\b"
        ),
    ),
    (
        "but",
        re.compile(
            rf"\b(?:only |just )?(?:{_PREP} )?(?:every(?:where|thing|time)?|all(?: the (?:time|while|way))?|throughout|always|anywhere) ?(?:but|except|bar|"
            rf"save|apart from)(?: for)?(?: {_PREP})?(?: the| its)? (?:(?P<noun>{_KIND_NOUN})\b(?! (?:of|to|that|between|back|from|it|out|home|up|in|on)\b)|"
            rf"(?:while |when )?(?:(?P<drift>adrift|drifting|floating|afloat)|(?P<face>turning|rotating|swinging)|(?P<hold>holding|on station|stopped)|"
            rf"(?P<goto>under way|driving|moving|sailing|running))\b)"
        ),
    ),
    (
        "to",
        re.compile(
            r"\b(?:all|every\w*|each|any|whichever)\b(?: (?!and\b|then\b)[\w-]+){0,4}? (?:but|exc\w{2,4}t|bar|save|apart from)\b[^.;,]{0,40}|"
            r"\bthe \w+ that is not the \w+"
        ),
    ),
    (
        "range",
        re.compile(
            rf"\b(?:only |just )?(?:(?P<since>from|starting (?:with|at|on)|(?:begin|start)s? (?:with|on|at)) the (?P<ord1>{ORD} )?(?P<noun1>{_NOUN})\b"
            rf"(?: (?:on(?:wards?)?(?! the)|to the (?:very )?end)\b)?|"
            rf"(?P<through>(?:until|till|up to|to|before) (?:the end of|the close of)|up to and including|ends? with|stops? with|"
            rf"through to) the (?P<ord2>{ORD} )?"
            rf"(?P<noun2>{_NOUN})\b|(?:until|till|before) the (?P<ord3>{ORD} )?(?P<noun3>{_NOUN}) is (?:over|done|finished)\b|"
            rf"(?P<behind>after|from the end of|once|as soon as|when) the (?P<ord4>{ORD} )?(?P<noun4>{_NOUN})(?: is (?:over|done|finished|through|"
            rf"behind (?:you|us)))?\b"
            rf"(?! (?:is|are|to|of|from|back|home|begins|starts)\b))"
        ),
    ),
    ("middle", re.compile(rf"\b(?:only |just )?{_PREP} the middle (?P<noun>{_NOUN})\b")),
    (
        "return",
        re.compile(
            r"\b(?:only |just )?(?:(?:on|during|for|in) (?:the|its|your) (?:way (?:back|home)|(?:leg|run|trip|drive|way) home|"
            r"(?:return|homeward) (?:leg|run|trip)|"
            r"homeward (?:leg|run|trip))|homeward bound|inbound)(?= only\b| alone\b|\W*$|[,.;:]| and (?:that|nothing|no)\b)"
        ),
    ),
    (
        "numbered",
        re.compile(
            rf"\b(?:{_PREP} )?(?P<noun>steps?|parts?|stages?|legs?|lines?) (?P<cards>{_CARDLIST})\b(?! ?(?:m|metres?|meters?|degrees?|°|s|min\w*|"
            rf"sec\w*)\b)"
        ),
    ),
    (
        "numbered",
        re.compile(r"^\W*(?:in |during )?(?P<noun>phase|part|stage|step) (?P<cards>[a-f])\b"),
    ),
    (
        "several",
        re.compile(
            rf"\b(?:(?:only |just )?{_PREP} )?(?:{_THE})?(?P<side>first|last|other|next|outer|inner|middle|final|remaining) (?P<count>two|three|"
            rf"four|five|[2-5])\b(?! ?(?:min|sec|s\b|m\b|met|hour|°|deg))(?: {_NOUN}\b)?"
        ),
    ),
    (
        "ordinal",
        re.compile(
            rf"\b(?:(?:only |just )?{_PREP} )?(?<!from )(?<!until )(?<!till )(?<!after )(?<!before )(?<!up to )(?:{_THE})(?!final approach|"
            rf"last sweep|latest)(?P<ords>{_ORDS}) (?:of (?:the |these |those )?)?(?:(?!(?:way)?points?\b|place|position|"
            rf"corner)\w+ )??(?P<noun>{_NOUN})\b(?! to (?:the )?{ORD}\b)"
        ),
    ),
    (
        "ordinal",
        re.compile(
            rf"(?:^\W*|\b(?:only |just )?{_PREP} )(?!final approach|last sweep|latest)(?P<ords>{_ORDS}) (?P<noun>{_NOUN})\b"
        ),
    ),
    (
        "ordinal",
        re.compile(rf"\b(?:only |just )?(?:in|on|during|for|at) (?:{_THE})(?P<ords>{_ORDS}){_END}"),
    ),
    (
        "ordinal",
        re.compile(
            rf"(?:^\W*|(?<=, ))the (?P<ords>{ORD})(?= (?:goes|runs|is|has|leads|keeps|needs|takes|one|gets|lasts|to)\b)"
        ),
    ),
    (
        "that",
        re.compile(
            rf"\b(?:in|on|during|for|throughout) (?:this|that|the same|these) (?P<noun>{_NOUN})\b|\b(?:while|when|as) (?:you are )?"
            rf"(?:doing (?:so|that|this)|you do(?: so| that| this)?)\b|\bduring (?:this|that)(?=,)|\bmeanwhile\b|\bas you do\b|\bin the meantime\b"
        ),
    ),
    (
        "all",
        re.compile(
            rf"\b(?:{_PREP} )?(?:throughout )?(?:both|all|every|each|either|each and every)(?: (?:single|of))?(?: the| them| these| those|"
            rf" its)?(?: (?:two|three|four|five|six|seven|eight|nine|ten|\d+))?(?: of)?"
            rf"(?: (?:them|these))?(?: (?!case|time|way|other|second|third|stay|with|on|at|in|to|for|of|"
            rf"by)[\w-]+)?? (?P<noun>{_NOUN})\b(?! (?:in which|where|when|that|which|but|bar|save|not the))"
        ),
    ),
    (
        "everywhere",
        re.compile(
            r"\b(?:throughout(?! the)|throughout the (?:whole|task|mission|plan|run)|(?:for |during |at )?(?:the (?:whole|entire|"
            r"full) (?:\w+ )?(?:time|task|way|way through|mission|plan|thing|trip|job)|all the (?:time|while|way)(?: through)?|"
            r"all times)|from (?:the )?(?:start to (?:the )?finish|beginning to (?:the )?end|start to (?:the )?end|"
            r"first (?:step )?to (?:the )?last(?: step)?)|all along|during everything|without a break|the whole way(?: through)?|"
            r"all through)" + _END
        ),
    ),
    (
        "while",
        re.compile(
            r"\b(?:only |but |just )?(?:while|when|whilst|as long as|for as long as|as(?= you| she| it| the))(?: only)?(?: (?:you|she|it|"
            r"the \w+|we)(?: is| are)?)?(?: only)? (?P<gerund>"
            r"(?P<goto>driv\w*|mov\w+|under way|transit\w*|sail\w*|travel\w*|steer\w*|en route)|(?P<hold>hold(?:ing|s)?|on station|"
            r"station[- ]keeping|keep\w* station|stopped|on the spot|stay(?:ing|s)?)|"
            r"(?P<visual>(?:keeping )?(?:it |the \w+ )?(?:is )?(?:centred|in (?:the )?(?:picture|frame)))|(?P<drift>drift\w*|adrift|"
            r"float\w*|afloat|(?:the )?engines? (?:are )?off)|"
            r"(?P<face>turn\w*|rotat\w+|com(?:e|es|ing) round|swing\w*)|(?P<nudge>pann?(?:ing|s)?|nudg\w+)|(?P<arc>arc\w*|sweeping|curving|"
            r"round(?:ing)? the bend)|(?P<still>l(?:ie|ies|ying) (?:still|there)|sit(?:s|ting)? (?:still|tight))|(?P<wait>wait\w*(?: for stability)?|settl\w+))\b"
            r"(?! (?:within|inside|clear|away|no|\d[\w.]*|to|for|the|on|out|at|in|by|through|an?|round|into|in a|back|up|off|and \w+ing|"
            r"recording|over|straight|directly|past|along|down|between)\b)(?! ?@)|\b(?P<goto2>under way|on the move|on the way(?! (?:in|out|back|"
            r"to|home|there|from|between|up)\b))\b|\b(?P<drift2>adrift)\b(?! for)"
        ),
    ),
    (
        "bare",
        re.compile(
            r"\b(?:in|on|for|during|at) (?P<bare>both|each|all(?: (?:of them|two|three|four|five|six|of these))?)"
            + _END
        ),
    ),
    (
        "kind",
        re.compile(
            rf"\b(?:(?:only |just |but )?(?:in|on|during|throughout|for the duration of|through)|(?:along|round)(?= the (?:straight|curve|"
            rf"bend|arc))|only) (?:the |your )(?:two |three |four |five |whole |single |actual )?(?P<noun>{_NOUN})\b(?! (?:of|to|that|"
            rf"between|back|from|proper|it|out|home|up|in|on)\b)"
        ),
    ),
    (
        "place",
        re.compile(
            r"\bonly (?:to|until|up to|as far as|from|after|before|between|at) (?:the \w+ )?@|\bout and home\b"
        ),
    ),
    (
        "way",
        re.compile(
            r"\b(?:only |just )?(?:on|during|for|in) (?:the|its|your) (?:way|run|leg|transit|approach|drive|trip|crossing|stretch|return|"
            r"homeward \w+|outward \w+|\w+ward leg)"
            r" (?:to|of|from|back|home|out|in|there)\b(?: (?:the [\w-]+|(?!and\b|or\b)[\w-]+))?(?: @)?"
        ),
    ),
    ("place", re.compile(rf"\b(?:in|on|during|for) the (?!same|whole)[\w-]+ {_NOUN}\b")),
    (
        "to",
        re.compile(
            rf"\b(?:in|on|during|for) (?:the|its|each|every) (?:[\w-]+ )?{_NOUN} (?:of|to|that|between|back|from|proper|it|which|after|before|at|"
            rf"by)\b"
        ),
    ),
    (
        "to",
        re.compile(
            r"\b(?:on|during|for|in) the (?:hold|turn|nudge|pan|stretch|leg|part|rest|remainder) (?:to|of|from|back|home|out|between|in|"
            r"after|before)\b(?: @| the [\w-]+| \w+)?|"
            r"\b(?:as soon as|begins?\b|ends\b|until|till|up to|as far as|(?:from|until|up to|to) (?:there|then|that|here|the (?:first|second|"
            r"third|moment|turn|wait|"
            r"hold|settling|change|\w+ on))|after|before|between|past|beyond|once|homewards?|"
            r"outwards?|onwards?|(?<!in )(?<!out )there|thereafter|later|earlier|where|wherever|whenever|on it\b|at (?:the |its )?(?:very |"
            r"far )?(?:start|end|finish|"
            r"corners?|mid-?sides?|stops?|beginning)|at @|"
            r"(?:while|when) \w+ing and \w+ing|every (?:other|second|third)|alternate|(?:while|when|as) (?:it|she|you|the [\w-]+|we) (?:is |"
            r"are )?\w+|in [1-9]\b|(?:goes|go) with|belongs? to|(?:first|second|third|last|1st|2nd|3rd|each|both) times?|corners|"
            r"mid-?sides?|odd|even|middle (?:one|\w+)(?= (?:only|alone)|$|[,.])|outer|inner|(?:the|on|any) others?|neither|either|none|"
            r"nowhere|elsewhere|northward|southward|"
            r"eastward|westward|else|along the way|en route|on arrival|at rest|homeward|outward|the (?:former|latter)|now and then|"
            r"in the end|(?:first|second|other|last) half|on station|as (?:the|before)|likewise|ditto)\b"
        ),
    ),
)
"""Phrases that say in which steps something runs; "that" and "to" are scopes that are not read."""
GERUNDS = {
    "goto": (GOTO, (ARC,)),
    "hold": (HOLD, (VISUAL,)),
    "still": (HOLD, (VISUAL,)),
    "visual": (VISUAL, ()),
    "drift": (DRIFT, ()),
    "face": (FACE, (NUDGE, ARC)),
    "nudge": (NUDGE, ()),
    "arc": (ARC, ()),
    "wait": (WAIT, (HOLD,)),
    "goto2": (GOTO, (ARC,)),
    "drift2": (DRIFT, ()),
}
NOT_BEFORE = re.compile(
    r"\b(?:except|save|bar|apart from|other than|e\w{3,}e but)(?: for)?\W{0,2}$|"
    r"\b(?:not|never|nor|none|neither|no|nothing|without)(?: (?:[\w-]+|on the \w+)){0,2}\W{0,2}$"
)
JOINT = re.compile(
    r"^\s*(?:only|alone)?\s*(?:,?\s*(?:but |and )?(?:not|never|nor|neither)|and|or|as well"
    r" as|as|,)?\s*(?:also |only |just )?(?:in|on|during)?\s*$"
)
"""What stands between two scopes of one phrase."""

# ---------------------------------------------------------------- clauses, and what stands in them
SENTENCE = re.compile(r"[.!?](?=\s|$)|\n")
CLAUSE = re.compile(
    r";|\s[-–—]\s|,?\s*\b(?:and|but)? ?(?:(?<!by )(?<!until )(?<!till )(?<!from )(?<!since"
    r" )then|next|after that|after which|afterwards|"
    r"finally|lastly)\b,?|(?:^|(?<=\s))(?:\(\d\)|\d[.)]|\*)(?=\s)|,? before (?=\w+ing\b)"
)
PLACE = re.compile(
    r"(?:\b(?:x|minus|\+)\s*=?\s*|[\[({]|\b(?:position|waypoint|point)\s+|[-−–=]\s?(?=[-−–]?@))*@(?:[\])}]|(?:"
    r" (?:north|south|east|"
    r"west))+\b|[a-z]\b)*"
)
SPACES = re.compile(r"[ \t]+([,.;:!?]?)")
IDLE = re.compile(
    r"^\W*(?:\d{1,2}|and|please|for the [\w ]+|over|here|roger|ok|thanks|that is all|that's"
    r" all|nothing (?:else|more))?\W*$"
)
BESIDES = re.compile(r"^\W*(?:with|while|without|keeping|having|staying|under|\w+ing)\b")
AFTER_THAT = re.compile(
    r"^\W*(?:and )?(?:from there|at (?:the|its|that) (?:very |far )?end|once"
    r" there|there|afterwards|thereafter|later)$"
)
"""Words that put a movement behind the one before and say nothing of skills."""
NO_MOVE = re.compile(
    r"\b(?:from|until|till) the (?:\w+ )?to the\b|\b(?:when|while) \w+ing and \w+ing\b|\band"
    r" (?:after|before) (?:that|it)\b"
)
"""Words by which a movement is spoken of, not asked for."""
REFUSED = re.compile(r"\b(?:no|not|none|nothing|free|may|need|needn't|off)\b")
INSERTED = re.compile(r"^\s*(?:only|alone)?\s*,")
PERIOD = re.compile(
    r"\b(?:once )?every (?:[\w.]+ ){1,5}?(?:s|sec\w*|min\w*|hours?)\b|\bstraight"
    r" (?:to|over|after|for|away)\b|"
    r"(?<!cable )(?<!planned )(?<!given )(?<!the )\btrack(?:ing)? (?!the cable|from|to\b)(?=\w)"
)
"""Words that `MANY` would take for movements."""
GOES_ON = re.compile(
    r" (?:and|or) (?:at|near|from|until|till|after|before|on (?!board)|in|\w+ing)\b"
)
"""A second place for what runs in a scope, that was not read as one."""
TO_OWN_PLACE = re.compile(r" to the (?:target|goal) (?:position|point)\b")
"""What makes a movement of "the final run", where none is told beside it."""
HEADER = re.compile(r"^[^:]{0,60}:")
TWO_STEPS = re.compile(
    r"^\W*(?:(?:in )?(?:two|three|four|five|six|both|\d))"
    r" (?:steps?|parts?|stages?|legs?|phases?)\W*$"
)
