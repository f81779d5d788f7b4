"""Phrases that say in which steps something runs, for `step_scopes`: by the kind of a movement, its
number, its place, or what was said before.
"""

from __future__ import annotations

import re

from planner_ft.decoding.constraints.reading.rows import movement_words as m
from planner_ft.decoding.constraints.reading.scopes import scope_words as w

GOTO, HOLD, FACE, NUDGE, ARC = m.GOTO, m.HOLD, m.FACE, m.NUDGE, m.ARC
DRIFT, VISUAL, WAIT = m.DRIFT, m.VISUAL, m.WAIT
TURNS = frozenset({FACE, NUDGE, ARC})
ANY = frozenset(m.KINDS)
NOUNS: tuple[tuple[str, frozenset[str]], ...] = (
    (
        r"legs?|runs?|transits?|approach(?:es)?|drives?|trips?|crossings?|stretch(?:es)?|straights?|passages?|lanes?|waypoints?|points?|ways?|transects?|hops?",
        frozenset({GOTO}),
    ),
    (
        r"holds?|stops?|stays?|halts?|pauses?|watch(?:es)?|station[- ]keep(?:ing|s)?|breaks?",
        frozenset({HOLD}),
    ),
    (r"drifts?|floats?|drifting", frozenset({DRIFT})),
    (r"arcs?|curves?|bends?|sweeping turns?|arc turns?|sweeps?", frozenset({ARC})),
    (r"nudges?|pans?", frozenset({NUDGE})),
    (r"turns?|rotations?|headings?|bearings?|swings?|directions?", TURNS),
    (r"waits?|settling", frozenset({WAIT})),
    (r"visual holds?|stares?", frozenset({VISUAL})),
    (
        r"steps?|parts?|stages?|phases?|sections?|ones?|moves?|movements?|manoeuvres?|positions?|places?|of (?:these|them|those)(?: (?:two|three|"
        r"four|five))?",
        ANY,
    ),
)
"""Nouns of scopes with the movements that they mean."""
NOUN = "(?:" + "|".join(pattern for pattern, _kinds in NOUNS) + ")"
_ORD = rf"(?:{w.ORD}|middle)"
_ORDS = rf"{_ORD}(?:(?:, (?:the )?{_ORD})*,? (?:and|or) (?:(?:in|on|for|during) )?(?:the )?{_ORD})?"
_PREP = r"(?:in|on|during|for|at|through|throughout|within|over|along|round)"
_CARD = r"(?:one|two|three|four|five|six|seven|eight|[1-9])"
_CARDS = rf"{_CARD}(?:(?:, {_CARD})*(?:,? and |\+| & |/){_CARD})?"
_LIMIT = r"(?:only |just |but |solely )?"
_DO = r"(?:(?:she|you|it|we|the boat|the vessel|the usv)(?: is| are|'s|'re)? )?"
_GERUNDS = (
    (
        "hold",
        r"hold(?:ing|s)?|on station|station[- ]keeping|keep(?:ing|s)? (?:station|position)|stopped|stationary|at rest|stay(?:ing|s) (?:put|"
        r"there)|waiting there|"
        r"(?:stand|sit|l)(?:ting|ing|ying) still",
    ),
    (
        "drift",
        r"drift(?:ing|s)?|float(?:ing|s)?|adrift|afloat|(?:the )?engines? (?:are )?(?:off|stopped)",
    ),
    ("arc", r"(?:in the |round the )(?:arc|bend|curve)|arcing|curving"),
    (
        "turn",
        r"turn(?:ing|s)?|rotat(?:ing|es?)|swing(?:ing|s)?|pivot(?:ing|s)?|com(?:ing|es) round",
    ),
    ("nudge", r"panning|nudging"),
    (
        "goto",
        r"under way|on the move|moving|sailing|driving|running|in transit|transiting|travelling|steaming|en route|motoring",
    ),
    (
        "wait",
        r"settling|waits?(?= ?[,.;]|$)|waiting(?= ?[,.;]|$)|waiting for (?:stability|her to settle)|(?:the boat|she) settles",
    ),
)
GERUNDS = {
    "hold": frozenset({HOLD, VISUAL}),
    "drift": frozenset({DRIFT}),
    "arc": frozenset({ARC}),
    "turn": TURNS,
    "nudge": frozenset({NUDGE}),
    "goto": frozenset({GOTO}),
    "wait": frozenset({WAIT}),
}
_GERUND = "|".join(f"(?P<{name}>{pattern})" for name, pattern in _GERUNDS)
_BEHIND = r"(?! (?:to|of|from|back to|towards|into|with|the|a|an|it|her|@|\d)\b)(?! @)"
_OFF = r"(?! (?:of|to|from|that|which|is|are|goes|it|between|@|in|out|home|back)\b)(?! @)"

SCOPES: tuple[tuple[str, re.Pattern[str]], ...] = (
    (
        "but",
        re.compile(
            rf"\b(?:{_PREP} )?(?:all|every|each|both|any)(?: of)?(?: the| these| those| them| its)?(?: (?:two|three|four|five|six|\d))?(?: (?P<all>{NOUN}))?,? "
            rf"(?:but|except|bar|save|apart from|other than)(?: for)?(?: {_PREP})? (?:the )?(?:(?P<ords>{_ORDS})(?: (?P<noun>{NOUN}))?|(?P<cards>{_CARDS}))\b"
        ),
    ),
    (
        "except",
        re.compile(
            rf"\b(?:every(?:where|thing)|throughout|always|all the (?:time|way)|the whole (?:time|way)|at all times|"
            rf"(?:{_PREP} )?(?:every|each) (?:single )?(?:step|part|stage|phase|movement)|{_PREP} all (?:the |its )?(?:steps|parts|stages|phases|movements)),? "
            rf"(?:but|except|save|bar|apart from|"
            rf"other than|"
            rf"only not|just not|not)(?: for)?(?: {_PREP})? (?:while |when )?(?:the (?:(?P<ords>{_ORDS}) )?(?P<noun>{NOUN})\b|{_DO}(?:{_GERUND})\b){_OFF}"
        ),
    ),
    (
        "except",
        re.compile(
            rf"(?:^|(?<=[.;:,] )|(?<=\w ))(?:but )?(?:except|save|apart from|other than)(?: for)?(?: {_PREP})? (?:while |when )?"
            rf"(?:the (?:(?P<ords>{_ORDS}) )?(?P<noun>{NOUN})\b|{_DO}(?:{_GERUND})\b){_OFF}"
        ),
    ),
    (
        "beyond",
        re.compile(
            rf"\bfrom (?:@|the (?P<ords>{_ORD}) (?P<noun>waypoint|point|place|position)|the (?P<noun2>waypoint|point)) on(?:wards?)?\b"
        ),
    ),
    (
        "since",
        re.compile(
            rf"\b(?:from|starting with) the (?P<ords>{_ORD}) (?P<noun>{NOUN}) on(?:wards?)?\b|\bfrom the (?P<noun2>{NOUN}) on(?:wards?)?\b"
        ),
    ),
    (
        "beyond",
        re.compile(
            r"\b(?:once|when|after|as soon as|the moment|from the moment) (?:you |she |it |we )?(?:have |has |is |are )?(?:reached|reach|passed|past|"
            r"left|at|arrived at) @|"
            r"\b(?:once|when|as soon as|the moment) @ (?:is|has been|lies) (?:reached|passed|behind|astern)(?: (?:of )?(?:you|her|us))?"
        ),
    ),
    (
        "upto",
        re.compile(
            r"\b(?:until|till|before) (?:you |she |it |we )(?:have |has |is |are )?(?:reached|reach|reaches|at|pass|passed) @|\b(?:until|till|"
            r"before) @ (?:is|has been) (?:reached|passed)|"
            r"\b(?:up to|as far as|until|till) @(?: and no (?:further|farther|longer))?"
        ),
    ),
    ("ordered", re.compile(r"\bin (?:that|this|the given|the stated) order\b")),
    (
        "onwards",
        re.compile(
            r"\bfrom (?:that|this|the) (?:moment|point|time|instant|place|spot)(?: on(?:wards?)?)?\b|\bfrom (?:then|there|here|now) on(?:wards?)?\b|"
            r"\bas of then\b"
        ),
    ),
    (
        "rest",
        re.compile(
            r"\b(?:for|in|on|during|over) (?:what(?:ever)? (?:follows|comes (?:after|then|next)|is left|remains)|(?:all )?the (?:rest|remainder)|"
            r"everything (?:after|that follows|else)|"
            r"the (?:other|remaining) (?:steps|parts|legs|movements|ones|stages|two|three))\b(?! of)|\b(?:thereafter|afterwards|after that|"
            r"from there to the end)\b(?=[^,])"
        ),
    ),
    (
        "numbered",
        re.compile(
            rf"\b(?:{_LIMIT}{_PREP} |only |just )?(?P<noun>steps?|parts?|stages?|legs?|phases?|waypoints?|wpts?|wps?|points?|marks?|"
            rf"positions?) ?#?(?P<cards>{_CARDS})\b(?: only| alone)?"
            r"(?! ?(?:m|metres?|degrees?|°|s|min\w*|sec\w*)\b)(?!,? ?@)(?!:? @)(?! ?(?:to|-|–|through) ?\d)"
        ),
    ),
    (
        "several",
        re.compile(
            rf"\b{_LIMIT}(?:on the (?:way|run|leg|passage)s? (?:out )?to|{_PREP}) the (?P<side>first|last|final) (?P<count>two|three|four|five|[2-5]) "
            rf"(?P<noun>{NOUN})\b(?: only| alone)?"
        ),
    ),
    (
        "ordinal",
        re.compile(
            rf"\b{_LIMIT}(?:(?:{_PREP}|only|just) )?(?:the |this |that |its )(?:very )?(?P<ords>{_ORDS})(?:[ -](?:(?!two|three|four|five|six|"
            rf"\d)\w+[ -])??(?P<noun>{NOUN}))?\b(?: only| alone)?"
            r"(?(noun)|(?=[.,;:]|$| (?:only|alone|and|but|is|gets?|has|needs?|goes|runs|in addition|also|too|with|without|"
            r"no|take|drop|log|read|check|measure|record|save|mark|pin)\b))"
        ),
    ),
    (
        "ordinal",
        re.compile(
            rf"(?:^|(?<=[.;:] ))(?P<ords>{_ORD}) (?P<noun>{NOUN})(?=:|,| (?:only|alone|with|without|has|gets|needs|under|is|"
            rf"passes|runs|goes)\b)"
        ),
    ),
    (
        "outer",
        re.compile(
            rf"\b(?:{_PREP} |only )?the (?P<side>outer|inner) (?P<noun>{NOUN})\b(?!,? (?:to|towards) )"
        ),
    ),
    (
        "that",
        re.compile(
            rf"\b{_LIMIT}{_PREP} (?:this|that|these|those) (?:last |final |very |same )?(?P<noun>{NOUN})\b|\b(?:this|that) (?P<noun2>{NOUN})(?= (?:is|"
            rf"has|gets|runs|needs|shall|must|should))\b|"
            r"\b(?:in|on|during|for) (?:it|that|this|them)\b(?! ?(?:same|case|time|purpose|reason|way|price|respect|[a-z]+ [a-z]+\b(?<! only)))|"
            r"\bmeanwhile\b|\bin the meantime\b|"
            r"\bwhile (?:doing (?:so|that|this)|you do(?: so| that| this)?|at it)\b|\bas (?:you|she) (?:do|does)(?: so)?\b"
        ),
    ),
    (
        "all",
        re.compile(
            rf"\b(?:{_PREP} |with )?(?:all|both|each|every|either)(?: of)?(?: (?:the|its|these|those))?(?: (?:two|three|four|five|six|seven|eight|nine|"
            rf"ten|\d))?(?: of)? (?P<noun>{NOUN})\b"
            r"(?!(?: \w+)? (?:but|except|bar|save|apart)| (?:in which|where|when|that|which)\b)"
        ),
    ),
    (
        "everywhere",
        re.compile(
            r"\b(?:throughout(?! the (?!whole|task|mission|plan))|all along(?! the)|(?:for |during )?the (?:whole|entire|full) (?:time|way|mission|task|"
            r"plan|trip|job|thing)|all the (?:time|while|way)|"
            r"at all times|from (?:start to finish|beginning to end|first to last|start to end|the (?:first )?(?:start|beginning) to the (?:very )?end|"
            r"the (?:very )?(?:start|beginning|outset))|always|the whole way|"
            r"without a break|continuously|in everything)\b(?! (?:through the|of the|to))"
        ),
    ),
    (
        "both",
        re.compile(
            r"\b(?:(?:in|on|for|during|at|with) )?(?:both|all (?:two|three|four|five|six)|both times|every time|each time)(?=[.,;:]|$|"
            r" only| please| and )"
        ),
    ),
    (
        "each",
        re.compile(
            r"\b(?:on|at|in|for|during) (?:each|every one)(?: one| of (?:them|these|those))?(?=[.,;:]|$| only| please)"
        ),
    ),
    (
        "back",
        re.compile(
            r"\b(?:on|during|for|in) (?:the|its|your) (?:way (?:back|home|in again)|(?:return|homeward) (?:leg|run|trip|way)|(?:leg|run|trip|"
            r"drive) (?:back|home))\b(?! to)|\b(?:coming|going|heading|sailing) "
            r"(?:back|home)\b(?! to)|\bhomewards?\b(?! bound)|\bon the return\b|\bhomeward bound\b"
        ),
    ),
    (
        "out",
        re.compile(
            r"\b(?:on|during|for|in) the (?:way out|outward (?:leg|run|trip|way)|(?:leg|run|trip|drive) out)\b(?! to)|\b(?:going|"
            r"heading) out\b(?! to)|\boutwards?(?: bound)?\b"
        ),
    ),
    (
        "thither",
        re.compile(
            r"\b(?:(?:while |when )?(?:getting|going|coming|heading|driving|running|steaming|moving|sailing) (?:there|in|over)|on the way(?: (?:there|"
            r"over|in|across))?|en route|"
            r"(?:on|during|for|in) the (?:way|run|leg|approach|transit|passage) (?:up|in|there|over|across|down))\b(?! (?:to|from|back|home|out))(?! @)"
        ),
    ),
    (
        "place",
        re.compile(
            r"(?:(?:^|(?<=[,;:.] )|(?<=and ))at|\b(?:only|just) (?:at|for|on)) @(?: only| alone)?|\bat @ (?:only|alone)\b|"
            r"\bat the (?:last|final) (?:waypoint|place|position)\b"
        ),
    ),
    (
        "corner",
        re.compile(
            r"\b(?:(?:at|on|in|to) )?(?:only |just )?(?:the |each |every |all |its |all the |the four |"
            r"all four )?(?:(?P<corner>corners?)|(?P<side>mid-? ?(?:sides?|points?)|"
            r"(?:middles?|centres?|midpoints?) of (?:the|each|every|a) (?:sides?|edges?)|side (?:middles|centres|"
            r"midpoints)))\b(?! of)(?: only| alone)?"
        ),
    ),
    (
        "while",
        re.compile(
            rf"\b{_LIMIT}(?:while|when|whilst|as long as|for as long as|so long as|as(?= she| you| it)|"
            rf"once(?= (?:she|you|it|we)(?: is| are|'s|'re) \w+ing\b))(?: only)? ?{_DO}(?:{_GERUND})\b{_BEHIND}|"
            r"(?<=, )(?:(?P<hold2>holding|on station)|(?P<drift2>drifting|floating|adrift|afloat)|(?P<turn2>turning))(?=[,.;]|$)|\b(?P<goto2>under ?way|"
            r"on the move)\b"
        ),
    ),
    (
        "then",
        re.compile(
            r"\b(?<!until )(?<!till )(?<!before )(?:by )?then(?=[.;]|$)|(?:^|(?<=[,;] )|(?<=and )|(?<=[.;:] ))there\b(?! (?:is|are|"
            r"'s|was|will|should|may|must|and|you))"
        ),
    ),
    (
        "kind",
        re.compile(
            rf"(?:(?<=\bonce )|(?<=\bafter )|(?<=\buntil )|(?<=\btill ))the (?P<noun>{NOUN})\b(?= (?:is|has been) (?:over|done|finished|through|complete))"
        ),
    ),
    (
        "kind",
        re.compile(
            rf"\b{_LIMIT}(?:{_PREP}|only|just) (?:the |its |your )(?:actual |whole |entire |two |three |four )?(?P<noun>{NOUN})\b(?: (?:itself|proper|"
            rf"alone|only))?{_OFF}"
        ),
    ),
)
"""Scopes by how they are told, those first that the later ones would take a part of."""
UNREAD = re.compile(
    r"\b(?:until|till|up to|before|after|once|as soon as|as far"
    r" as|between|beyond|past|unless|if|alternate\w*|odd|even|every (?:other|second|third)|"
    r"half (?:the|way)|"
    r"only|alone|just|except|bar|save for|apart from|other than|but"
    r" not|bits?|\w+ward\b|(?:in|on|during|for|at|along|over|throughout) (?:the |"
    r"its )(?:[\w-]+ ){0,2}(?:" + "|".join(pattern for pattern, _kinds in NOUNS) + r")\b|"
    r"in case|each time|every time|whenever|wherever|every \d|now and then|the"
    r" (?:others?|former)|likewise|ditto|same|elsewhere|where|"
    r"at the (?:start|beginning|end)|"
    r"at (?:its|each|either) end|"
    r"(?:at|in) the (?:berth|dock|goal|target|destination|place|spot|quay|home))\b"
)
"""Words of an item that say where in another way."""
