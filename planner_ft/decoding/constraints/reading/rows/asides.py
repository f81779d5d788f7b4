"""What people say beside their orders: the weather, others about their business, what was
yesterday, call signs, courtesies, what something is good for.

Taken out of a text in one form (`turn_forms`) before its movements are read. Nothing is taken out
that names a place or speaks to the vehicle.
"""

from __future__ import annotations

import re

from planner_ft.decoding.constraints.reading.rows import turn_forms as f

_OTHERS = (
    r"(?:helicopter|chopper|ferry|ferries|pilot(?: boat| cutter)?|crane|tugs?|tug"
    r" ?boat|crew|divers?|skipper|captain|harbour ?master|harbour office|"
    r"port office|"
    r"lock ?keeper|coast"
    r" ?guard|kettle|coffee|forecast|radio|client|customer|office|boss|trawlers?|yachts?|regatta|kayakers?|swimmers?|anglers?|fishermen|"
    r"students?|father|mother|brother|sister|chief|cook|mate|bus|train|truck|van|lorry|taxi|plane|cruise"
    r" ship|container ship|cargo ship|freighter|tanker|barge|"
    r"life ?boat|convoy|sailing"
    r" club|school|children|kids|seals?|gulls?|dog|cat|lunch|dinner|breakfast|supper|tea|meeting|shift|briefing|crew"
    r" transfer|"
    r"crew change|slack water|high water|low water|sunset|sunrise|dredger|dinghy"
    r" race|race|professor|inspector|surveyors?|engineers?|technicians?|students?|"
    r"visitors?|guests?|press|mayor|market|pub|battery|charger|neighbours?)"
)
_WEATHER = r"(?:sun(?:light|shine)?|rain|drizzle|fog|mist|haze|wind|breeze|swell|tide|ebb|flood|visibility|seas?|weather|glare|waves?|sky|air|water|current)"
_IS = (
    r"(?:is|are|was|were|isn't|aren't|wasn't|has|have|had|comes?|came|coming|leaves?|left|sails?|sailed|pass(?:es|ed)?|goes|went|lands?|landed|starts?|started|"
    r"ends?|arrives?|arrived|departs?|departed|opens?|opened|closes?|closed|will|won't|does|doesn't|did|didn't|works?|worked|blows?|blew|gets?|got|looks?|"
    r"may|might|can|should|must be|turned|shows?|sets in|set"
    r" in|rises|falls|drops|eases|backs|veers|picks up|runs|makes|turns(?! (?:you|it|her|the"
    r" boat))|"
    r"says|said|thinks|'s|stands)"
)
_AT = r"(?:(?:the|our|my|his|her|their|your|that|this|a|an|another|some|no|all|first|second|next|last|morning|evening|big|old|new|little|local|harbour) )*"
_ABOUT = (
    # "The helicopter comes in nine minutes", "wind is from the left".
    rf"(?:{_AT}{_OTHERS}|{_AT}{_WEATHER})(?: (?:out there|over there|aboard|on"
    rf" board|here|outside|today|tonight|now))? ?{_IS}\b(?! (?:to )?(?:be )?(?:kept|"
    rf"held|"
    r"centred|centered|in view|in frame))",
    # "It's blowing from the south", "blowing a good five from the left".
    r"(?:(?:it|there) ?(?:is|'s|was|will be) )?(?:still"
    r" )?(?:raining|blowing|snowing|drizzling)\b|(?:it|there) ?(?:is|'s|was|will be) (?:still |"
    r"getting )?(?:foggy|windy|"
    r"freezing|cold|hot|late|dark|misty|grey|a"
    r" (?:lovely|nice|fine|grey|rough|cold|windy|calm|quiet) (?:day|morning|evening|night))\b",
    # "We had twenty knots", "they laughed".
    r"(?:we|i|they|he|you|everybody|everyone|somebody|someone|nobody)"
    r" (?:did|had|were|was|saw|lost|got|went|came|tried|laughed|thought|found|spent|took|"
    r"used to|ran|"
    r"have (?:been|had|lost|seen)|has been)\b",
    # "She points at 350 now", "you are lying on the ring already".
    r"(?:she|you|it|we|the (?:boat|usv|vessel|vehicle|asv)|the (?:bow|nose))"
    r" ?(?:(?:now|already|currently|presently|right now) )?(?:lies?|points?|faces?|"
    r"sits?|is|are|"
    r"'re|'s|heads?)\b(?=[^,.;:]*\b(?:now|already|currently|at present|at the moment|right"
    r" now)\b|(?: already| now| currently| still)? (?:lying|sitting|"
    r"pointing|facing"
    r"|heading|afloat|moored|moving)\b)",
    r"(?:the )?time (?:now )?is\b",
    # Questions by the way.
    r"(?:did|does|has|is|are) (?:anybody|anyone|somebody|everybody|the (?!boat|usv|bow))",
)
_ASIDE = f.compiled(
    r"^[ ,(-]*(?:(?:and|but|also|well|anyway|oh|mind you|by the way|they'll tell you|i"
    rf" hear|because|since|as) )*(?:{'|'.join(_ABOUT)})"
)
_PAST = f.compiled(
    r"^[ ,(-]*(?:and |but )?(?:yesterday|(?:the )?last"
    r" (?:time|week|year|night|month|trip|season|summer|winter|spring|autumn)|this morning|earlier"
    r" today|"
    r"(?:T|N\d+ (?:days|weeks|years)|a (?:week|month|year|day) )[\d.]* ?ago)\b|"
    r"^[^,.;:]*\b(?:yesterday|last (?:time|week|year|night|month|trip|season)|ago)[ ]*$"
)
_LIKE = f.compiled(r"\b(?:as|like|same|again|repeat)\b(?! (?:raining|late|cold|hot|ever))")
_ORDERS = f.compiled(
    r"\b(?:go|head for|proceed|turn (?:to|onto|her|it|the"
    r" bow)|hold|wait|stay|keep|maintain|so|please|you|face|rotate|nudge|pan|swing|drift"
    r" for|float|let|"
    r"make|take|"
    r"VISUAL|ENGINES|settle|move|sail to|return|come to|come round|be"
    r" at|meet|[xy]|sides?|face|edge|wall|half|both)\b|P\d*\b"
)
"""Words by which a clause may be an order all the same."""
_STATES = f.compiled(
    r"^[ ,(-]*(?:and |but )?(?:she|you|it|we|the (?:boat|usv|vessel|vehicle|asv|bow|nose))\b"
)
_PURPOSE = f.compiled(
    r",? \b(?:so(?: that)?|in order that) (?!she\b|it\b|you\b|the"
    r" (?:boat|usv|vessel|vehicle|bow|nose|camera|hull)\b)(?:the |our |my |"
    r"your )?[a-z]+(?: [a-z]+){0,2}? "
    r"(?:can|may|could|might|sees?|gets?|has|have|will|hears?|knows?|finds?)\b[^,.;:()PTLDNC]*(?=[,.;:]|"
    r" and (?:then )?|$)|"
    r",? \bwhile (?:we|they|i|he|our|my|the"
    r" (?:crew|divers?|line|linesm[ae]n|pilot|others|men|team|office|ferry|tug))\b[^,.;:()PTLDNC]*(?=[,.;:]|$)|"
    r",? \buntil (?:we|they|i|he|our|my|the"
    r" (?:crew|divers?|linesm[ae]n|pilot|others|men|team|office|ferry|tug|captain|skipper))\b[^,.;:()PTLDNC]*(?=[,.;:]|$)|"
    r" \bfor (?:the (?:divers?'?s?|crew'?s?|pilot'?s?|captain'?s?|linesm[ae]n'?s?|camera"
    r" team|office|records?|client|others|men)|us|me|"
    r"everybody)(?: (?:signal|sake))?"
    r"(?=[,.;:]| to |$)"
)
"""What a movement is good for, or what goes on meanwhile."""
_TITLED = f.compiled(
    r"^ ?(?:(?:[a-z'-]+"
    r" ){0,3}(?:compass|gyro|imu|sensor|camera|thruster|handling|steering|shakedown|acceptance|sea|helm|manoeuvring|crew|training|"
    r"calibration|morning|evening|routine) )?"
    r"(?:swing|shakedown|checks?|tests?|trials?|drills?|calibration|exercise|practice|routine|run-through|warm-up|demonstration|demo)"
    r"(?: (?:after|before|for|in|of|at) (?:the |our |a )?[a-z'-]+(?: [a-z'-]+)?)? ?: "
)
"""What a task is called, before its movements."""
_WIDE_ONE = f.compiled(
    r"\b(?:on|during|in|for) the (?:whole|full|half|wide|long|short)[- ](?:width"
    r" )?(?:swing|turn|pan|sweep|nudge|rotation)(?: only| alone)?\b"
)
"""Words for one of the turns, in which something is done."""
_COURTESY = f.compiled(
    r"\bsorry (?:for|about) (?:the|my|this|that|being)(?: [a-z'-]+){1,4}(?=[.,;!]| and\b)|"
    r",? ?\b(?:if you please|if you (?:would|will|don't mind|can|like)|will you|would you|won't"
    r" you|please|pls|plz|kindly|thanks|thank you(?: very much)?|thx|"
    r"cheers|asap|as soon as (?:you can|possible)|for me|mate|my dear|good"
    r" (?:morning|evening|day)|right away|(?<!things )at once|with care|"
    r"nice and (?:slow|easy|gently))\b,?(?! (?:mind|mean))"
)
_SAID_AGAIN = f.compiled(
    r"\b(?P<said>[a-z]+(?: [a-z]+){0,5})[,.;:-]* (?:i )?say again,? (?P=said)\b"
)


def without_asides(text: str) -> str:
    """The text without what says nothing of the vehicle's movements."""
    text = _WIDE_ONE.sub(" ", _TITLED.sub(" ", _SAID_AGAIN.sub(r"\g<said>", text)))
    text = _COURTESY.sub(" ", _PURPOSE.sub(" ", text))
    return re.sub(
        r"\s+",
        " ",
        "".join(
            part if part[:1] in ".;:!?," or not _is_aside(part) else " "
            for part in _PARTS.findall(text)
        ),
    )


_PARTS = re.compile(r"[.;:!?,](?=\s|$)|(?:(?![.;:!?,](?:\s|$)).)+")


def _is_aside(clause: str) -> bool:
    """Whether a clause is about something else."""
    if _PAST.search(clause):
        return not _LIKE.search(clause) and not re.search(r"P\d*\b|VISUAL", clause)
    found = _ASIDE.match(clause)
    return found is not None and not _ORDERS.search(
        clause, found.end() if _STATES.match(clause) else 0
    )
