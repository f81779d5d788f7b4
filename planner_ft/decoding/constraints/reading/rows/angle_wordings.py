"""How task inputs word an angle to turn by and a heading to turn to: the patterns by which
`turn_angles` reads them, on text in one form (`turn_forms`).
"""

from __future__ import annotations

from planner_ft.decoding.constraints.reading.rows import turn_forms as f

VERB = (
    r"(?:re-?)?(?:turn|rotat|pivot|swing|spin|swivel|slew|twist|yaw|pan|nudg|eas|trim|correct|adjust|offset|tweak|shift|com|bring|put|point|set|"
    r"aim|align|squar|lin|"
    r"chang|alter|tak|mak|go|mov|scan|sweep)(?:e|ing|ning|ting|ed|ned)?"
)
OBJECT = (
    r"(?:the|her|its|it|your|us|me|my|she|yourself|herself|boat|usv|vessel|vehicle|craft|ship|bow|nose|head|heading|camera|view|yaw|image|round|"
    r"around|about|in place|on the spot|"
    r"back|slowly|gently|smartly|carefully|smoothly|now|up|over|then|next|first|on|onwards?|out|further|small|rotation|turn|pan|nudge|swing|of|a|"
    r"an|course|"
    r"another|just|again|direct|directly|straight|in|hull|stern|asv|us)"
)
TO = (
    r"(?:to face|to|onto|on|towards?|until (?:the bow|she|it|you|the heading)(?: is| are)?(?:"
    r" points?| faces?| on| facing)*(?: to(?:wards)?)?|"
    r"through the)"
)
NOUN = (
    r"(?:(?:a|the|its|her|each of|all of) )*(?:(?:(?:compass|new)"
    r" )?(?:headings?|bearings?|courses?|directions?)(?: of)?[:,]? )?(?:each of )?"
)
TURN_WORD = (
    rf"(?:{VERB}(?: (?:{OBJECT}))*(?: on the spot| in"
    r" place)?|(?:pans?|nudges?|turns?|rotations?|twists?|swings?|yaws?)(?: of| by|,|:)?)"
)
TRAVEL = (
    r"(?:go|going|head|drive|driving|sail|run|transit|proceed|approach|steer|course for|leave|make"
    r" for|get|return|moor|close in|move|shift|"
    r"cross)"
)

# A heading to turn to
HEAD_LEAD = f.compiled(
    rf"(?:\b{VERB}(?: (?:{OBJECT}|{f.SIDE}))*,? {TO} {NOUN}|\b(?:fac(?:e|ing)|look(?:ing)?|"
    r"(?<!first )(?<!the )(?<!each )point(?:ing)?)(?: (?:the|her|bow|nose|round|up|it))*(?:"
    rf" (?:to|towards|along|due|on|at))? {NOUN}"
    rf"|\b(?:bow|nose) (?:must|should|shall|is to|has to|to) (?:look|point|face|be on|go to|come"
    rf" to|be at)(?: (?:to|towards|due))* "
    rf"|\b(?:turn|rotate|swing|go|step|work)(?:ing)? (?:round )?through (?:the"
    rf" (?:headings|bearings) )?|\b(?:both|all|N\d+|these|the|"
    rf"following) (?:headings|bearings|directions)[,:]? |\b(?:headings|bearings): "
    rf"|\b(?:bow|nose)(?: (?:round|on|to|at|onto|towards|first))*[: ]+{NOUN}|\b(?:take up|come"
    r" to|go to|set|adopt|steady on|steady up on|"
    rf"look along|assume|turn) {NOUN}"
    rf"|(?:^|[.;:] ?)(?:then |next )?(?:headings?|bearings?):? )(?:due )?$"
)
STRONG = f.compiled(
    r"turn|rotat|pivot|sw[iu]ng|spin|swivel|slew|twist|fac|bow|nose|heading|bearing|course|com|point|aim|lin|squar|align|look|yaw|"
    r"direction|steady"
)
"""What a movement to a heading is named by; "take her to 145, 30" may be a place."""
TURNS_THERE = f.compiled(r"turn|rotat|pivot|swing|spin|swivel|slew|twist|^(?: |,|then|and)*come")
LEADING = f.compiled(
    rf"\b(?:{TURN_WORD}|look(?:ing)?|fac(?:e|ing)|point(?:ing)?)[ ,]*(?:in |to |through |at |all"
    r" )?$|\bsame again (?:to |at |on |"
    rf"facing |towards )?$"
)
NEXT = f.compiled(
    r"(?:(?:^|[.;,]|and) ?(?:and )?(?:then|next|finally|lastly|after that),?|\bsame again|\bthe"
    r" same|\blikewise)(?: (?:to|onto|on to|round to|at|"
    r"on|facing|towards))? (?:due )?$"
)
NO_HEADING = f.compiled(
    rf"^ ?(?:{f.SIDE}|(?:apart|each|at a"
    r" time|steps?|times|headings|sectors|directions|pans|turns|degrees? of)\b)"
)
ENDS = f.compiled(
    r"^ ?(?:$|[.,;:!?)/~-]|(?:and|then|with|while|in|on|for|at|hold|before|after|to|as|or|when|true|degrees|where|without|both|only|"
    r"finally)\b)"
)

# An angle to turn by
BY = f.compiled(
    rf"\b(?:(?:turn|rotat|pivot|swing|spin|swivel|slew|twist|yaw|pan|nudg|eas|trim|correct|adjust|offset|tweak|shift|chang|alter|com|bring|mov|"
    rf"scan|sweep)(?:e|ing|ning|ed)?"
    rf"(?: (?:{OBJECT}))*(?: on the spot| in"
    r" place)?|(?:pans?|nudges?|turns?|rotations?|twists?|swings?|yaws?)(?: of| by|,|:)?)"
    r",?(?: (?:by|through|of|across|another|a further|some|about|the view|slowly))*(?<! on) $"
)
SIDE_BEFORE = f.compiled(
    rf"(?:^|[ ,])(?P<side>{f.SIDE})(?:,|:)?(?: (?:by|of|through|another|a"
    r" further|once|for|some|about|turn|pan|nudge|rotation|"
    rf"on the spot))* $"
)
SIDE_BEHIND = f.compiled(
    rf"^ ?(?:turn |pan |nudge |rotation |yaw |swing |twist |of (?:yaw|rotation|turn) |more |on the"
    rf" spot |round |"
    rf"(?:right )?back |across |over |further )?,? ?(?P<side>{f.SIDE})"
)
IN_PLACE = f.compiled(
    r"nudg|\bpan|yaw|twist|rotat|bow|nose|heading|on the spot|in"
    r" place|pivot|spin|swivel|trim|\beas(?:e|ing)\b|sweep [DN][\d.]+ across"
)
WIDE = f.compiled(
    rf"\b(?:swing|sweep|com|bend|go|curv)(?:e|ing)? (?:wide|round|around)(?: (?:{f.SIDE}))?(?:"
    rf" (?:by|through))? {f.D}(?! ?(?:,|\.|and|"
    rf"then) ?{f.V})(?: degrees)? (?:{f.SIDE})"
)
"""A turn that may be an arc."""
THAT_IS = f.compiled(r"[ ,(]*(?:to|onto|on|until|till|so|i\.?e|that is|which|namely|meaning|=)\b")
"""What leads from an angle to the heading that it ends at."""
LOOSE_END = f.compiled(
    rf"^ ?,? ?(?:N\d+ (?!(?:back |across |over |further )?(?:{f.SIDE}))[a-z]+|"
    r"(?:with|on|at|in)(?: a| the)? L (?!clear|margin|of clear|of margin|safety|between|minimum|in"
    r" hand|of room|spare))"
)
"""Another count, or a radius, right behind an angle."""
SAME_TO = f.compiled(
    rf"\b(?:(?:{VERB}|back|by|as|and) )*(?:the same|as much|as far|that much|the same"
    r" (?:angle|amount))(?: (?:angle|amount|again|"
    rf"back))* (?P<side>{f.SIDE})"
    rf"|\bback (?P<back>{f.SIDE}) (?:by )?(?:the same|as much|as far|that much)(?:"
    r" (?:angle|amount|again))*|\bback(?: again)? by (?:the same|"
    rf"as much)(?: (?:angle|amount|again))*"
)

# How often
TIMES_BEHIND = f.compiled(
    r"^[ ,]*(?:(?:each|at a time),? ?)?N(\d+) times?(?: over| in a row| running)?\b|^[ ,]*in N(\d+)"
    r" (?:turns|pans|steps|"
    r"goes)\b(?! of)"
)
TIMES_BEFORE = f.compiled(
    r"\bN(\d+)(?: (?:equal|separate|single|successive|small|even))?"
    r" (?:times|pans|nudges|turns|rotations|steps|twists|swings|yaws)(?: (?:on|over|"
    r"in a row|round))*"
    rf"(?: (?:{f.SIDE}))?,?(?: (?:by|of|at|through|,|:))* ?$"
)
ONCE_MORE = f.compiled(r"^ (?:once more|again|more|once again)\b")
"""Behind an angle that is said a second time."""
EACH = f.compiled(r"^[ ,]*(?:each|apiece|at a time|per step|every)\b")
OF_MANY = f.compiled(r"\b(?:steps|times|pans|nudges|turns|rotations|twists|swings) (?:of|by) $")
IS_COUNT = f.compiled(
    r" ?(?:times|pans|nudges|turns|rotations|steps|(?:equal|separate|single|successive|small|even)"
    r" (?:steps|turns|pans))\b"
)

# Lists, and what is said in passing
SEPARATOR = f.compiled(
    r"^ ?(?:[,;/.]|->|→|-|and|then|finally|lastly|last|next|after"
    rf" that|afterwards|on|again|round|{VERB}|fac(?:e|ing)|to|onto|towards|due|on to|"
    rf"the|bow|heading|bearing| )* ?$"
)
LISTED_BEHIND = f.compiled(r" ?(?:,|and|then)[ ,a-z]{0,9} D")
IN_PASSING = f.compiled(
    r"\b(?:while|when|whilst|as"
    r" (?:you|she)|during|in|on|once|after|only|at|until|with|for|whenever|before)(?:"
    r" (?:you|she|it|the|a|her|are|is))* $"
)
