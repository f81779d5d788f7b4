"""How task inputs word their movements one after the other: the patterns by which `sequence` reads
them, over the one form of a text (`turn_forms`).
"""

from __future__ import annotations

from planner_ft.decoding.constraints.reading.rows import turn_forms as f

T, L, P = r"T[\d.]+", r"L[\d.]+", r"\bP\d+\b"
V = r"[DNC][+-]?\d+(?:\.\d+)?"
D = r"[DN][+-]?\d+(?:\.\d+)?"
VISUAL = "VISUAL"

# ---------------------------------------------------------------- one form

MOTION = f.compiled(
    r"\b(?:pitch(?:es|ing)?|rolls?|rolling) (?:and|or|&) (?:rolls?|rolling|pitch(?:es|ing)?)\b(?:"
    r" motions?)?"
)
TWO_TIMES = f.compiled(
    r"\bT(?P<one>[\d.]+) (?:(?:and |, )?T(?P<other>[\d.]+)|N(?P<bare>[1-5]\d|[1-9])(?!"
    r" ?(?:degrees|times|[a-z]+s\b|[NDCL\d]|to |left|right|port|starboard)))"
)
_FRAME = r"(?:the |its |your )?(?:frame|picture|image|view|shot|screen|camera|field of view)"
_IN_FRAME = (
    r"(?:(?:bang |dead |right |exactly |well )?(?:centred|centered)(?: (?:in|on)"
    rf" {_FRAME})?|(?:bang |right |exactly )?in (?:the )?"
    rf"(?:(?:very )?(?:centre|center|middle) of )?{_FRAME}|in (?:visual"
    r" )?(?:sight|view|shot|frame)|mid-?frame|on screen)"
)
IN_VIEW = f.compiled(
    rf"\b(?:keep(?:ing)?|hold(?:ing)?|have|having|get(?:ting)?|maintain(?:ing)?|put|bring)"
    rf" (?!station|position|your|the heading|the bow|arrived|"
    rf"reached|come|got|to|been|stopped|passed)"
    r"(?:(?! (?:read|what|then|go|turn|at|hold|while|as|when|whenever|if|until) )[^.;:,]){1,60}?"
    rf" {_IN_FRAME}(?: again| and (?:keep|hold) (?:it|her|him|"
    rf"them) (?:there|so)|"
    rf" all the time| steadily)*\b|"
    rf"(?<![^.;:,]"
    rf" )\b(?!(?:keep|hold|have|get|put|bring|go|turn|with|while|as|when|and)\b)[a-z][a-z"
    rf" -]{{2,30}} (?:stays|is kept|is to stay|kept) "
    rf"(?:centred|centered|in (?:the )?(?:centre|center|middle) of {_FRAME})\b|"
    rf"\bcent(?:re|er) (?:the |on the )?[a-z][^.;:,]{{1,30}}? in {_FRAME}"
)
"""A target kept in the picture."""
ENGINES_OFF = f.compiled(
    r"\b(?:with )?(?:the |your |her"
    r" )?(?:engines?|motors?|propulsion|thrusters?|power|screws|propellers?|props) (?:are |is"
    r" |being )?(?:off|stopped|cut|"
    r"out(?! (?:to|for|towards|from|past|as far)\b)|shut down|idle)\b|"
    r"\b(?:cut|kill|stop|switch off|shut off|shut down|turn off|out of|without|no) (?:the |your"
    r" |her |all )?(?:engines?|motors?|propulsion|thrusters?|"
    r"power|propellers?|screws|props)"
    r"(?: off| down)?\b"
)
_THINGS = r"(?:everything|anything|everybody|anybody|all|any|every|obstacles?|traffic|other|whatever|things)"
CLEARED = f.compiled(
    rf"(?:\b(?:with|at|keep(?:ing)?|hold(?:ing)?|maintain(?:ing)?|observ(?:e|ing)|leav(?:e|ing)|by|on)"
    rf" )?(?:\b(?:a|an|the|no) )?\b(?:(?:safety|"
    rf"obstacle|minimum|sea) )?(?:clearances?|margins?|distance)"
    rf"(?: (?:of|is|at least|to {_THINGS}|from {_THINGS}|obstacles))* {L}(?:"
    rf" (?:to|from|around|round) {_THINGS}(?: \w+)?)?|"
    rf"(?:\b(?:with|at|keep(?:ing)?|hold(?:ing)?|maintain(?:ing)?|observ(?:e|ing)|leav(?:e|ing)|stay(?:ing)?|by)"
    rf" )?(?:\b(?:a|an|the|at least|"
    rf"about) )*\b{L}[ -]?(?:of |in )?(?:(?:safety|obstacle|minimum|sea) )?"
    rf"(?:clearances?|margins?|minimum distance|clear\b(?: (?:of|from) {_THINGS}(?: \w+)?)?|to"
    rf" spare|room|(?:away )?(?:from|off|to) {_THINGS}(?: \w+)?)"
)
"""A clearance."""
_PARTS = (
    r"(?:holds?|turns?|turnings?|nudges?|pans?|drifts?|drifting|legs?|runs?|waits?|waiting|sweeps?|arcs?|steps?|stages?|parts?|movements?|moves?|"
    r"phases?|stops?|"
    r"rotations?|transits?|stays?|way|time|stretch|stretches|passages?|swings?|circles?|curves?|stations?|points?|waypoints?|halts?|pauses?|"
    r"visual hold|headings?|"
    r"spots?|places?|bends?|moment|while|beginning|start|end|holding|turning|settling|approach|trip|float)"
)
_WHICH = (
    r"(?:nth|first|second|third|fourth|fifth|last|final|next|other|former|latter|N\d+|two|three|four|same|whole|entire|long|short|quiet|later|"
    r"earlier|of|the|these)"
)
_GERUNDS = (
    r"(?:(?:hold|turn|drift|mov|wait|sail|go|driv|transit|runn|rotat|swing|float|stay|keep|sweep|nudg|pann|steam|head|settl|sitt|com|approach|follow|"
    r"lie|ly)ing|holds?|"
    r"turns?|drifts?|moves?|waits?|goes|runs|floats?|stays?|sweeps?|settles?|lies?|sits?|steadies|adrift|afloat|on"
    r" station|under way|there|at it|on the move)"
)
SCOPES = (
    f.compiled(
        r"\b(?:but |and )?(?:not )?(?:for|on|during|in) the"
        r" (?:runs?|legs?|ways?|transits?|passages?|trips?) (?:in )?between(?: (?:them|the"
        r" (?:two|three|"
        r"drifts|holds|stations|stops|points)))?\b|"
        r"\b(?:in|on|during|for) (?:all|both) (?:N\d+|of them)(?= _|[ .,;:]|$)|"
        r"\b(?:the )?(?:whole|entire) (?:time|way|trip)\b|\ball (?:the time|along|the while|the"
        r" way(?! round)|through)\b|"
        rf"\bbefore (?:the|that) {_PARTS} (?=nothing\b|no\b|none\b)|"
        r"\bat all times\b|"
        r"\bthroughout(?: both)?\b|\bboth times\b|"
        r"\b(?:and )?at no other times?\b|\b(?:and )?not (?:before|earlier|after|later|until"
        r" then|sooner)(?: that)?\b|\b(?:in|on|for|during|throughout|"
        r"at) both\b(?! (?:turns|holds|legs|the|of))|"
        r"\b(?:this|that|the (?:nth|first|last|second|final|third))"
        r" (?:part|step|phase|stage)\b|\b[a-z]+ (?:step|part|leg|hold|phase) only\b"
    ),
    f.compiled(
        rf"\b(?:(?:but |and |not )?(?!on the spot\b|after"
        rf" th(?:at|is)\b)(?:in|on|during|for|at|over|throughout|with|of|between|along|after|"
        rf"through)(?: (?:in|on|during|only|just|at|for))? "
        rf"(?:the|this|that|these|those|each|every|both|all|either|its|any|one)|both|all|each|every|the"
        rf" (?=nth|first|second|last|N\d|two|"
        rf"three))(?: {_WHICH})* {_PARTS}\b(?! round\b)"
        r"(?: (?:only|alone|in))?"
    ),
    f.compiled(
        rf"\b(?:while|whilst|as|when|whenever|as long as|so long as|during|by)(?: (?:you|she|it|the"
        rf" boat|the usv|the vehicle|doing))?(?: (?:are|is|"
        rf"be))? {_GERUNDS}\b"
        rf"(?: (?:there|so|to|on|in|only))?"
    ),
)
"""Words for the steps in which something runs."""
BUFFERED = f.compiled(
    rf"\b(?:last|preceding|previous|past|latest|final|every|each)(?: of)?(?: the)? {T}|{T}"
    r" (?:of|from) (?:the )?(?:video|buffer|film|footage)"
)

# ---------------------------------------------------------------- clauses

CLAUSE = f.compiled(
    r"[.;:!?](?=\s|$)|,|\bbefore (?=(?!that|this|the|it|each|every)\w+ing\b)|\b(?:and |but"
    r" )?(?:then|next|after (?:that|this|which)|afterwards|thereafter|"
    r"subsequently|finally|lastly|followed by|and)\b|/|->|→|—|–| - "
)
FILLER = f.compiled(
    r"^(?:[ ,:)(-]|(?:please|now|nth|(?:straight |right |directly )?after (?:it|which|the turn|the"
    r" hold|the arc|the sweep|the drift)|first(?:ly|"
    r" of all| off)?|second(?:ly)?|third(?:ly)?|final|last(?:ly| of all)?|begin(?:ning)?"
    r" (?:with|by)|start(?:ing)? (?:with|by)|"
    r"finish(?:ing)? (?:with|by|off with)|end(?:ing)? (?:with|by|in)|"
    r"to (?:begin|start|finish) (?:with|by)|from the (?:last|nth|second|third) (?:of"
    r" (?:them|these|those)|one)|(?:one|two|three|N\d+) (?:moves|steps|"
    r"things|parts)|that done|this done|there|here|you|also|so|just|right|ok|okay|"
    r"(?:once|when|as soon as) (?:there|done|arrived|(?:you|she|it)(?: is|'s| are|'re| have| has|"
    r" get| gets)? ?(?:there|arrived?|arrives?|done|"
    r"in position|on the spot))|"
    r"(?:up)?on (?:arrival|arriving)|having arrived|arrived(?: there)?|when (?:that|this|it)"
    r" (?:is|has been) (?:done|over|finished)|with that (?:done|"
    r"behind you)|"
    r"from (?:there|that point|this point|where you are)|(?:at|on|from) (?:that|this)"
    r" (?:point|place|position|spot|heading)|at the end(?: of (?:it|"
    r"that))?|to (?:begin|start) with|"
    r"to finish(?: with)?|in the end|at last|let (?:her|it|the (?:boat|usv|vehicle|vessel))(?!"
    r" settle| steady| drift| float| lie| get| come| calm)|"
    r"(?:the (?:boat|usv|vehicle|vessel)|you|she|it) (?:should|must|is to|are to|shall|will|can)|i"
    r" want you to|i'd like you to|would you|could you|can you|"
    r"the order is|that is|namely|steps|step n\d+|leg n\d+|as before)(?=\W|$))+"
)
SIDE = f.SIDE

# ---------------------------------------------------------------- places

_GO = (
    r"(?:go|going|head|heading|proceed(?:ing)?|sail(?:ing)?|transit(?:ing)?|steam(?:ing)?|driv(?:e|ing)|run(?:ning)?|mov(?:e|ing)|shift(?:ing)?|cross(?:ing)?|"
    r"return(?:ing)?|com(?:e|ing)|motor(?:ing)?|navigat(?:e|ing)|steer(?:ing)?|travel(?:ling)?|carry(?:ing)?"
    r" on|continu(?:e|ing)|get|getting|set (?:a )?course|"
    r"make (?:your |her"
    r" )?(?:way)?|clos(?:e|ing)|approach(?:ing)?|reach(?:ing)?|visit(?:ing)?|dock(?:ing)?|tak(?:e|ing)|bring|leg|be|drop|slip|pop|nip|"
    r"hop|push|press|lead|stop|call|set off|set out|start out|yourself|herself|"
    r"off|down|up|out|over|on|back|in|through|via|straight|directly|ahead|away|across|her|the"
    r" (?:boat|craft|usv|vessel|vehicle))"
)
GO_TO = f.compiled(
    rf"^(?:{_GO}\b ?)*(?:(?:to|for|at|into|via|through|towards|on|in)\b ?)?(?:[a-z'-]+"
    rf" ){{0,6}}?[(,]? ?{P}\)?"
)
GOING = f.compiled(rf"^(?:{_GO}\b ?)+")
OPENS_GOAL = f.compiled(
    rf"^(?:{P}|{_GO}\b|(?:to|for|at|into|via|through|towards|on|in|the|a|an|our|your|this|berth|that"
    r" is|namely|waypoints?|wpt|wp|point|position|next)\b)"
)
"""How a clause begins that goes somewhere."""
PLACED_AT = f.compiled(
    rf"^(?:{_GO}\b ?)*(?:to|for|into|on|with)? ?(?:the|a|an|our|your|this|that|its)? ?(?:[a-z'-]+"
    rf" ){{0,5}}?(?:at|,|\() ?{P}"
)
NO_GOAL_AT = f.compiled(
    r"\b(?:from|round|around|about|past|off|side|face|end|edge|corner|(?:north|south|east|west)\w*|turn\w*|hold|fac\w+|keep\w*|not|no|never|until|"
    r"square|grid|survey\w*|cent(?:re|er)\w*|if|but)\b"
)
NO_GOAL = f.compiled(
    r"\b(?:from|of|round|around|about|past|off|near|between|cent(?:re|er|red|ered)|square|grid|survey\w*|turn\w*|hold\w*|fac\w+|stay\w*|keep\w*|"
    r"wait\w*|drift\w*|not|no|never|"
    r"until|till|inside|within|box|fence|area|corner\w*|limits?|while|half|short|along|line|track|follow\w*|cable|pipeline|pass|lanes?|orbit\w*|"
    r"circle\w*|starts?|"
    r"starting|begins?|beginning|ends?|ending|target|contact|tracks?|look\w*|is|was|are|lies|mark\w*|pin|label\w*|north|south|east|west|opposite|"
    r"beyond|before|after|if|"
    r"rather|instead|both|each|every|again|leav\w+)\b"
)
"""Words before a place by which it is none to go to."""
HOME = f.compiled(
    r"^(?:(?:go|going|head|heading|return|returning|come|coming|sail|run|transit|proceed|drive|steam|motor|back|straight|all"
    r" the way|"
    r"then)\b ?)*(?:back )?(?:home|to (?:home|base)|"
    r"return to base)(?: again)?\b(?! (?:berth|base|waters|port|position))"
)
YAW = f.compiled(
    rf"^ ?(?:with|at|on|,)? ?(?:a |your |the |its )?(?:(?:final |arrival )?yaw|heading on"
    rf" arrival|final heading|arrival heading)(?: (?:of|on|at|is|"
    rf"upon|arrival|set|to|being))* (?P<v>{V})"
    r"(?: (?:on|at|upon) arrival)?|^ ?arriv(?:e|ing) (?:there )?(?:with|at|on) (?:a |the |your"
    rf" )?(?:yaw|heading|bearing|bow)(?: (?:of|on|at))* (?P<w>{V})"
)
YAW_BEHIND = f.compiled(
    r"^(?:with )?(?:a |your |the )?(?:(?:final )?yaw|final heading)(?: (?:on|at|upon) arrival)?(?:"
    rf" (?:of|is|at|to be))* (?P<v>{V})(?: (?:on|at|"
    rf"upon) arrival)?$|"
    r"^arriv(?:e|ing) (?:there )?(?:with|at|on) (?:a |the |your )?(?:yaw|heading|bearing|bow)(?:"
    rf" (?:of|on|at))* (?P<w>{V})$"
)

# ---------------------------------------------------------------- turns

_TURN = r"(?:re-?)?(?:turn|rotat|pivot|sw[iu]ng|spin|swivel|slew|twist|yaw|com|bring|point|aim|set|put|get|chang|alter|align|veer)(?:e|ing|ning|ting)?\b"
_OBJECT = (
    r"(?:the|her|it|its|your|boat|usv|vessel|vehicle|craft|ship|asv|bow|nose|head|heading|course|camera|view|image|round|around|about|on"
    r" the spot|"
    r"in place|back|"
    r"slowly|gently|smartly|carefully|up|over|there|here|then|further|again|now|on)"
)
TURN_TO = f.compiled(
    rf"^(?:{_TURN}(?: (?:{_OBJECT}|{SIDE}))* (?:to face|to point|to|onto|on"
    rf" to|on|towards?|due|until facing)|{_TURN}(?: {_OBJECT})*(?= C\d)|(?:fac(?:e|ing)|"
    rf"look(?:ing)?)(?: (?:to|towards|due|the))*|"
    rf"(?:(?:the|her|its) )?(?:bow|nose)(?: (?:round|on|to|at|onto|towards|due))*|headings?(?: to|"
    rf" of)?|bearings?|steady (?:up )?on|adopt|take up|"
    rf"assume|a turn (?:to|onto))"
    r"(?: (?:a|the|new|compass|due|headings?|bearings?|course|direction|of|true|bow|on))*,?"
    rf" (?P<v>{V})(?! ?(?:{SIDE}|times|apart|each))(?: degrees)?"
    r"(?: on the spot| in place| there| true)*"
)
LISTED_TO = f.compiled(
    rf"^(?:(?:to|onto|on to|on|round to|due|on|back to|last|the) )*(?P<v>{V})(?!"
    rf" ?(?:{SIDE}|times|apart|each))"
    rf"(?: degrees| on the spot| last| there| in order| in turn| in (?:that|this) order)*(?=$|"
    rf" for T[\d.]+$)"
)
_NUDGE = (
    r"(?:(?:turn|rotat|pivot|sw[iu]ng|spin|swivel|slew|twist|yaw|pan|nudg|eas|trim|correct|adjust|offset|tweak|shift|com|bring|mov|chang|alter)(?:e|"
    r"ing|ning)?\b|"
    r"(?:an? |another |one )?(?:turn|nudge|pan|rotation|swing|twist|yaw)\b(?: of| by)?)"
)
TURN_BY = f.compiled(
    rf"^(?:(?:and|back|then) )?(?P<verb>{_NUDGE}(?: {_OBJECT})*,?:? ?)?(?:(?:the )?(?:camera )?view"
    rf" )?(?:(?P<before>{SIDE}),?(?: {_OBJECT})* "
    rf"?)?(?:(?:by|through|of|another|a further|about) )*"
    rf"(?P<v>{D})(?: degrees)?(?: (?:turn|pan|nudge|rotation|swing|back|across|over|more|further|of"
    r" (?:yaw|rotation)|on the spot|in place|round|again))*"
    rf"(?:,? ?(?P<behind>{SIDE}))?(?P<spot>(?: (?:on the spot|in place|where (?:you|she)"
    r" (?:are|lie|is|lies)|there|again|once more))*)"
)

# ---------------------------------------------------------------- other movements

ARC_WORD = f.compiled(
    r"\b(?:arcs?|arcing|sweep|sweeps|sweeping|curve|curves|curving|(?<!s-)bends?|wheel|wide"
    r" turn|arc turn)\b"
)
ARC_VALUE = f.compiled(
    rf"(?P<angle>(?:(?:through|by|of|for|a|an) )*(?P<v>{D})(?: degrees)?(?: (?:turn|arc|sweep|of"
    rf" arc)\b)?)|(?P<side>{SIDE})|"
    r"(?P<radius>(?:(?:at|with|in|on|of|a|an|the|,) )*(?:(?:turning )?radius (?:of |being"
    rf" )?)?(?P<l>{L})(?: (?:turning )?radius| circle| out)?(?: arc|"
    rf" curve| turn)?)"
)
ARC_REST = f.compiled(
    r"^(?:["
    r" ,:()-]|(?:as|X|make|do|run|take|follow|describe|perform|swing|come|go|turn|round|around|in|on|a|an|one|single|another|the|arc|arcs|arcing|"
    r"turn|turns|sweep|sweeping|"
    r"sweeps|wide|curve|curving|bend|bends|wheel|away|of|at|with|through|by|for|to|radius|turning|gentle|long|big|slow|steady|out|there|about|s-bend|that|"
    r"same|further|also|again|this|time|all|more|second|next|last|full|"
    r"it)\b)*$"
)
HOLD = f.compiled(
    rf"^(?:(?:hold(?:ing)?|keep(?:ing)?|maintain(?:ing)?)(?: (?:your|the|her|this|that|its|on))?"
    rf" (?:position|station|place|spot)|hold(?:ing)?\b|"
    rf"station[- ]?keep(?:ing)?|"
    r"stay(?:ing)?(?: (?:put|on station|in place|in position|on the"
    r" spot|still|stationary))?|remain(?:ing)?(?: (?:in position|on station|in place|"
    r"stationary|still))?|"
    r"wait(?:ing)?|paus(?:e|ing)|sit(?:ting)?(?:"
    r" (?:tight|still|there))?|loiter(?:ing)?|linger(?:ing)?|dwell|stop(?:ping)?|halt|stand by|lie"
    r" still|park|hover|"
    rf"(?:an? |another |one )?(?P<t>{T})(?:,? (?:of )?(?:hold\w*|on station|station[- ]?keep\w*|on"
    r" the spot|pause|wait|stay|stop|halt|there|here|"
    rf"at (?:it|that point)))|"
    rf"(?:a|an|another) (?:hold|stay|pause|stop|wait)(?: of)?|(?P<bare>{T})(?:$|(?= at P\d)))"
    r"(?: (?:and hold|position|station|put|still|there|here|on the spot|in place|in position|on"
    r" station|tight|where you are|at (?:it|(?:that|the|"
    r"this) (?:point|place|spot|position|berth|"
    r"buoy|waypoint|mark))|(?:on|at) (?:that|this|the new) (?:heading|spot)|like that|so|again))*"
)
FOR_TIME = f.compiled(
    r"(?:\b(?:for|of|during|about|exactly|another|a further|a full|the next|just|only|up to)"
    rf" )*(?P<t>{T})(?: (?:more|or so|there|on station|in all|long))?"
)
_RADIUS = r"(?:radius|radii|circle|watch circle|ring|tolerance)"
WITHIN = f.compiled(
    rf"(?:\b(?:with|on|at|in|inside|within|and|of|to|straying|no further than|not more than|no more"
    rf" than|at most) )*(?:\b(?:a|an|the|its) )?"
    rf"(?:\b{_RADIUS}(?: (?:of|is|at most|being|with))* (?P<l>{L})|(?P<m>{L})[ -]?(?:watch |station"
    rf" )?{_RADIUS}|\b(?:within|inside|to within) (?:a |"
    rf"an )?(?P<n>{L}))"
    rf"(?:(?: of)? (?:it|that (?:point|spot|place)|the (?:spot|point|place|berth)|there|here|of the"
    rf" (?:spot|point)))?"
)
WAIT = f.compiled(
    r"^(?:(?:wait|hold|pause|stay|remain|hang|rest|lie|stand"
    r" by|let|give|stop)\b[^.;:]*?\b(?:until|till|for|to|so long until|time"
    r" to|get|gets|come)\b[^.;:]*?"
    r"\b(?:stead\w*|stab\w*|settle\w*|calm\w*|quiet\w*|motion|still|pitch\w*|roll\w*|level)\b|"
    r"(?:let (?:her|it|the (?:boat|vehicle|hull|usv|vessel)|yourself) |she should"
    r" )?(?:settle|steady)\b(?: (?:down|up|first))?(?! on)|"
    r"wait for stability|until (?:the boat|she|it|you)"
    r"(?: is| lies| are)? (?:steady|stable|settled))"
)
WAIT_REST = f.compiled(
    rf"^(?:["
    rf" ,()-]|(?:motion|pitch|roll|are|is|has|have|been|to|be|below|under|within|less|than|lower|drop|drops|dropped|fall|falls|fallen|come|comes|"
    rf"down|off|of|in|both|"
    rf"steady|steadier|stable|settled|settle|steadies|again|at|or|better|first|before|there|enough|lie|lies|lying|she|it|the|boat|usv|vehicle|vessel|"
    rf"hull|for|up|"
    rf"a|most|maximum|allow|no|longer|more|about|max|motions|stays|stay|remain|remains|quiet|calm|level|her|you|until|for|held|degrees)\b|{D}|{T})*$"
)
DRIFT = f.compiled(
    rf"^(?:(?:let (?:her|it|the (?:boat|vehicle|usv|vessel)|yourself)"
    rf" )?(?:drift(?:ing)?|float(?:ing)?|go adrift|lie adrift|be adrift|be carried|"
    rf"go)\b(?: (?:freely|free|passively|along|with|on|in|by|"
    rf"the|tidal|current|tide|stream|ebb|flood|engines|off|there|adrift|about|downstream))*|let"
    rf" (?:the )?(?:current|tide|stream|ebb|flood|wind|water|"
    rf"tidal stream)(?: \w+)? "
    rf"(?:carry|take|move|push|set)(?: (?:you|her|it|the (?:boat|vehicle|usv|vessel)))?(?:"
    rf" (?:along|away|off|with it))?|"
    rf"(?:a |an |another )?(?P<t>{T})(?:,? (?:of )?(?:drift\w*|adrift|float\w*|afloat))(?:"
    r" (?:with|in|on) the (?:current|tide|stream))?|(?:a|"
    rf"another) drift(?: of)?|"
    rf"adrift|afloat|ENGINES)"
)
DRIFTING = f.compiled(r"\b(?:drift|float|adrift)")
DRIFTS = f.compiled(r"\b(?:drift|float|adrift|afloat|carr(?:y|ied)|current|tide|stream|ENGINES)")
TAIL = f.compiled(
    r"^(?:["
    r" ,()!-]|(?:there|here|again|please|thanks|thank|you|over|out|it|so|only|alone|in|all|at|the|end|on|spot|station|place|position|arrival|"
    r"exactly|now|as|usual|"
    r"one after (?:another|the other)|in"
    r" (?:this|that|turn|order)|order|this|first|berth|buoy|point|steady|that's|that|is|to|finish|too|slowly|gently|"
    r"quietly|carefully|still|clear|straight|directly|just|then)\b)*$"
)
"""What may stand behind a movement and says nothing."""

OUTRIGHT = f.compiled(
    r"^(?:(?:hold|keep|maintain)(?:ing)?(?: (?:your|the|her|this|that|its|on))?"
    r" (?:position|station|place|spot)|hold\b|stay|remain|station[- ]?keep)"
)
"""A hold that needs no time."""
PERCEIVING = f.compiled(
    r"^(?:(?:please|also|meanwhile|and|only|just|but|the|a|an|any|one|two|no|nothing|your|her|its|in"
    r" which (?:you|she)|in which|there|to|for|so that|"
    r"during which|while you|give me|i want|"
    r"i need|we want|we need|let me"
    r" have|get|have|take|taking|do|run|running|make|making|put|set|switch|switched|select|use|using|start|is|are|gets|"
    r"goes|should|must|be|being|with|this time|throughout|all|other|second|"
    r"bow|stern|port|starboard|mast|front|rear|forward|aft|keel|thermal|colour|active|video|full|new|short|quick|geotagged|minimum|smallest|relative|"
    r"pixel|visual|environmental|own|gps|lidar|"
    r"sonar|safety) )*"
    r"(?:check\w*|see|verif\w+|read\w*|record\w*|film\w*|sav\w+|log|logs|logged|logging|logger|register\w*|drop|detect\w*|look(?:ing)?"
    r" (?:for|out|"
    r"after)|lens|lenses|depth|image|quality|"
    r"horizon|tilt|stills?|snapshots?|photos?|pictures?|photograph\w*|geotag\w*|hot\w*|temperature\w*|clearances?|margins?|fence|box|polygon|boundary|"
    r"limits|sensors?|cameras?|detectors?|"
    r"tracker|trackers|track|tracking|sounder|lidar|sonar|slices?|profiles?|distance|range|fix|fixes|position"
    r" fix|environment|weather|gps|accuracy|"
    r"marker|mark|pin|label|note|observation|"
    r"buffer|stream|streams|ocr|text|pose|offset|error|cylinder|flat\w*|planarity|fit|measur\w*|determin\w*|locat\w*|monitor\w*|comput\w*|calculat\w*|"
    r"analys\w*|estimat\w*|triangle|report|tell|count|watch (?:for|out)|scan for|run the detector|"
    r"captur\w*|write|copy|preserve|store|upload|transfer|activate|nothing|needs?|pixels?|statistics|stats|readings?|copy|thanks|regards|cheers|noted)\b"
)
"""How a clause begins that speaks of what runs beside the movements."""
MOVES = f.compiled(
    r"\b(?:go|goes|going|proceed|sail|return|come|turn|rotate|swing|pivot|nudge|pan|face|hold|stay|wait|drift|float|sweep|settle|home|again|repeat|"
    r"twice|before|after|between|VISUAL|ENGINES|"
    r"square|grid|lanes|instead|if|unless|sorry|until|till|once|back|other"
    r" way|reverse|undo|motion|start(?:ing)? (?:point|position)|set time|stay so|"
    r"then|(?:view|camera|picture|lens|image|eye|eyes) (?:on|to|at)|run (?:the|a|L\d[\d.]*)|course"
    r" (?:of )?[DNC]\d+|distance of|stable|steady|"
    r"frame|from C\d+|(?:last|first) one|nth it|close|search|is the"
    r" (?:time|radius|heading)|along|as far as|to the end|circle|orbit|"
    r"survey)\b(?! (?:camera|sensor|sounder|stream|lidar|logger))"
    rf"|{T}|{P}|\b(?:track|trace|follow\w*) (?:the |its |this )?(?:\w+"
    r" )?(?:cable|pipeline|pipe|line|wall|face)"
)
"""Words in such a clause that a movement may be meant by all the same."""
KEEPS = f.compiled(
    r"^(?:keep|hold|maintain|stay)(?:ing)?\b(?! (?:(?:well |at least |always"
    r" )?(?:clear|away|inside|within|out of)|(?:the |your |her |its )?(?:heading|"
    r"bow|nose|lock|recording|log|fence|boundary|margin|"
    r"clearance|fix|record|eye|watch|tracking|note|environment|sensors?|detector)|recording|logging|on"
    r" \w+ing|track|an eye|a (?:record|log|lookout|"
    r"watch)|locked|L))"
)
"""A clause that may ask for a hold."""
CUES = f.compiled(
    r"\b(?:but|stable|frame\w*|from C\d+|end heading|for the"
    r" (?:first|second|third|last|other)|(?:last|first) one|nth it|close|search\w*|"
    r"is the"
    r" (?:time|radius|heading)|home\w*|outward|stabili[sz]\w*|nth|former|latter|undo|motion|start(?:ing)?"
    r" (?:point|position)|set time|"
    r"(?:view|camera|picture|lens|image) (?:on|to|at)|(?:headings?|bearings?|course) (?:of"
    r" )?[DNC][\d]|steer\w*|make for|carry on|continue|"
    r"navigat\w*|travel\w*|reach\w*|visit\w*|drive|driving|arriv\w*|ending|(?:target|goal|start|located|given|same|berth)"
    r" position|pursu\w*|chase|"
    r"target|contact|camera (?:to|on)|locked on|eyes? on|long as|"
    r"given|planned|duration|go|goes|going|proceed\w*|sail\w*|transit|transits|steam\w*|head"
    r" for|head to|head|heads|return\w*|come|comes|coming|"
    r"turn\w*|rotat\w*|swing\w*|swung|pivot\w*|nudg\w*|pan|pans|"
    r"panning|panorama|yaw\w*|fac(?:e|es|ing)|hold\w*|held|stay\w*|wait\w*|remain\w*|drift\w*|float\w*|adrift|afloat|arcs?|sweep\w*|circle\w*|orbit\w*|"
    r"settl\w*|stead\w*|"
    r"cent(?:re|er)\w*|picture|home|back|again|repeat\w*|twice|times|square|grid|lanes?|survey\w*|visual\w*|follow\w*|approach\w*|dock\w*|berth\w*|"
    r"moor\w*|station\w*|paus\w*|stop\w*|"
    r"halt\w*|engines?|propulsion|spin\w*|shift|move|moves|moving|loiter\w*|linger\w*|before|after|between|same|likewise|ditto|reverse\w*|backwards|"
    r"otherwise|instead|rather|skip|cancel\w*|"
    r"forget|scrap|scratch|sorry|mean|meant|correction|if|unless|half|halves|quarter|third|rest|other|remaining|remainder|another|until|till|once|"
    r"when|way|leg|legs|run|runs|pass|passes|lap|laps|round|around|look"
    r" at|bow|nose|course|bend\w*|curve\w*|wheel|radius|starboard|port|left|right|"
    r"clockwise|anticlockwise|"
    r"counter-clockwise|reciprocal|opposite|in"
    r" turn|alternat\w*|each|every|both|ENGINES|VISUAL|fraction|keep station|keep position|keep"
    r" her|sit|sits|"
    r"park|rest|take her|bring|put her|cross|"
    r"down to|up to|over"
    r" to|stretch|trip|loop|figure|spiral|zigzag|zig-zag|triangle|corner\w*|side|sides|edge|wall|face|line|cable|pipeline|track"
    r" the|"
    r"trace|along)\b"
    rf"|{T}|{L}|{P}|D[+-]?\d"
)
"""Words and values that a movement may be meant by where none was read."""
REORDERED = f.compiled(
    r"^ ?(?:but )?(?:before (?:you (?:head|go|leave|start|set off|do|sail|run|move|set"
    r" out|proceed|turn)(?: (?:there|that|this|so|it|anywhere|off|"
    r"for it))?|that|this|it|heading there|going there|"
    r"doing (?:so|that|this|it)|all (?:that|of that|this)|any of (?:that|this|it)|anything"
    r" else|everything else)(?: though| however)?(?: first)?|"
    r"first(?: though| of all| however)?,? however|"
    r"first though|beforehand|but first(?: of all)?|but beforehand|prior to (?:that|this)|first of"
    r" all)\b[ ,:]*(?P<rest>.+)$"
)
"""A sentence about what comes before what was said so far."""
BEFORE_THAT = f.compiled(
    r"^ ?(?:but )?before (?:you |she |it |the boat )?(?P<later>[^,:]+)[,:] ?(?P<rest>.+)$"
)
"""A sentence that names what comes later first."""
AFTER_EACH = f.compiled(
    r"^ ?(?:and )?(?:(?:after|at|on|in|with|upon|following|behind|for) (?:each|every|all of(?:"
    r" the)?|any|each of the)(?: (?:single|one of|of|N\d+|"
    r"nth))*(?: (?:the|these|those|them))?(?: (?:fraction|single|nudge|quarter|new))?"
    r"(?: (?:turn|heading|bearing|direction|rotation|step|stop|pan|nudge|one|them|it|sector|swing|facing|point|position|place|mark|waypoint|spot|station|"
    r"buoy|berth|pot|of them))?|"
    r"(?:on|at|after) (?:reaching )?each)\b(?: you)?[ ,:]*(?P<rest>.+)$"
)
"""What is done behind every turn."""
EACH_BEHIND = f.compiled(
    r"(?P<rest>\b(?:hold|holding|stay|staying|wait|waiting|pause|pausing|stop|stopping|sit|remain)\b[^.;,:]*?)"
    r" (?:(?:on|at|after|in|facing|"
    r"upon) (?:each|every|all)(?: (?:of|one|single|the))*"
    r"(?: (?:turn|heading|bearing|direction|rotation|step|stop|pan|nudge|one|them|sector|swing|point|facing|of"
    r" them))?|each time|every time|each|"
    r"in between|between (?:the )?(?:turns|pans|nudges|headings))\b"
)
HOLDS = f.compiled(
    r"^(?:N(?P<n>2|3)|two|three|both)(?: (?:equal|separate))? (?:holds|stays|stops|pauses|spells"
    rf" of station keeping) of (?P<t>{T})(?: each|"
    rf" apiece)?(?: {{0,1}}each)?$"
)
IN_BETWEEN = f.compiled(
    r"^(?:and |with )?(?:(?:in )?between(?: (?:them|the two|these|those|the holds|the N2|these"
    r" two))?)[ ,:]*(?P<rest>.+)$|"
    r"^(?:with )?(?P<other>.+?) (?:in between|between them|between the (?:two|holds))$"
)
HALF = f.compiled(
    r"\b(?:for |during )?(?:the (?:first|nth) (?:half|fraction)(?: of (?:it|the"
    r" (?:time|period|duration)))?|(?:half|fraction) (?:of )?(?:the|that|this|"
    r"your|its) (?:time|duration|period|stay|total|whole)|(?:half|fraction) of it|one half)\b"
)
REST = f.compiled(
    r"\b(?:for |during )?(?:the |its )?(?:rest|remainder|remaining"
    r" (?:time|half|minutes)|(?:other|second|nth|last|remaining) (?:half|fraction)|"
    r"time (?:left|remaining)|same again)(?: of (?:it|the (?:time|period|duration)|that time))?\b"
)
PORTION = f.compiled(
    r"\b(?:for |during )?the (?:first|nth|other|last|next|second|remaining|final|third)"
    r" N(?P<n>\d+)\b(?: of (?:them|these|those))?"
)
PORTION_TIME = f.compiled(
    rf"\b(?:for |during )?the (?:first|nth|other|last|next|second|remaining|final|third) (?P<t>{T})"
)
