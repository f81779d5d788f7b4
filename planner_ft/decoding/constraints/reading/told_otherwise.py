"""Ways and movements that a task input tells by way of others, written out for all readers: "to A
via B", "the same again to port", "where the drift began".

Nothing is guessed here: a wording that does not name everything that is needed stays as it is.
"""

from __future__ import annotations

import re
from typing import Any

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading.paths.halfway import with_middles

_NUMBER = r"[-−–]?\d+(?:\.\d+)?"
PLACE = rf"[\[(]\s*{_NUMBER}\s*[,;]\s*{_NUMBER}\s*[\])]"
_PLACE = re.compile(rf"[\[(]\s*({_NUMBER})\s*[,;]\s*({_NUMBER})\s*[\])]")
_OWN = (
    r"(?:the )?(?:(?:given|task['’]s|stated) )?(?:target|goal|berth|destination)(?:"
    r" (?:position|point|place|location))?(?! of)"
)
_CALLED = r"(?:(?!(?:to|then|and|via|through|of|is|by|from)\b)[\w'’-]+ ){0,6}?(?:at )?"
_GO = (
    r"(?:go|head|proceed|sail|steam|motor|run|drive|transit|move|make|return|come|navigate|cross|travel|back|set"
    r" off|set out)(?: "
    r"(?:out|over|up|down|on|back|in|straight|for it|across))?"
)

# ---------------------------------------------------------------- ways over other places

_VIA_LIST = rf"{_CALLED}{PLACE}(?:(?:, and|,| and) {_CALLED}{PLACE}){{0,3}}"
VIA = re.compile(
    rf"\b(?P<go>{_GO}) (?:(?P<home>home|to base|back to base)|(?:to|for|towards)"
    rf" (?P<goal>{_CALLED}{PLACE}|{_OWN}|home|base))"
    r",? (?:going |passing |running |and go |but go )?(?:via|by way of|through|past|passing(?: by|"
    rf" over)?) (?P<via>{_VIA_LIST})(?: on (?:the|your) way)?"
    r"(?! ?(?:,|and|or)? ?(?:then )?(?:via|by way of|through|past)\b)",
    re.IGNORECASE,
)
VIA_FIRST = re.compile(
    r"(?P<before>^|[.;:] |\bthen )(?:go(?:ing)? |passing )?(?:via|by way of|through)"
    rf" (?P<via>{_VIA_LIST}),? (?P<go>{_GO} (?:to|for|home|towards)\b)",
    re.IGNORECASE,
)

# ---------------------------------------------------------------- places of movements

SPOTS = re.compile(
    rf"(?P<before>^|[.;:!] )(?:there are |visit |the |these |our"
    rf" )?(?:(?P<n>two|three|four|five|six|[2-6]) )?(?:[a-z-]+ ){{0,2}}?"
    r"(?:spots|places|points|positions|stations|stops|marks|locations|waypoints|sites)(?P<where>"
    r" (?:[\w'’-]+ ){0,6}?[\w'’-]+)?\s?(?:[:,]|\bat|\bare)? "
    rf"(?P<list>{PLACE}(?:(?:, and|,| and|;) {PLACE}){{1,7}})(?P<end>[.;] )",
    re.IGNORECASE,
)
VISITED = re.compile(
    r"\b(?P<v>visit|go to|go only to|do|take in|call at) (?:(?:only|just|these|the|all|following)"
    r" )*(?:two|three|four|five|six|[2-6])(?: [a-z-]+)? (?:spots|"
    r"places|points|positions|stations|stops|"
    r"marks|locations|waypoints|sites)(?: in turn| in this order| only)?[:,] ?(?=(?:first"
    rf" )?{PLACE})",
    re.IGNORECASE,
)
"""Before a list of places to go to."""
BOW_AT = re.compile(
    r"\b(?P<p>point|put|set|start with) the (?P<bow>bow|nose|heading) (?:at|on) (?=\d{3}\b(?! ?m))",
    re.IGNORECASE,
)
_COUNTS = {"two": 2, "three": 3, "four": 4, "five": 5, "six": 6}
EACH_BEHIND = re.compile(
    r"\W*(?:hold\w* [^.;]*|stay\w* [^.;]*|wait\w* [^.;]*)?\b(?:at|on|in)"
    r" (?:each|every|all)\b|\W*(?:each|every)\b",
    re.IGNORECASE,
)
"""What has to follow a list of places that nothing else sends the vehicle to."""
AT_EACH = re.compile(
    r"\b(?P<at>at (?:each|every one) of (?:them|these|those|the \w+) )(?P<order>[^.;]*?),? before"
    r" (?:you |moving |going |carrying )[\w ]+(?=[.;]|$)",
    re.I,
)
DRIFT_BEGAN = re.compile(
    r"\b(?P<to>to|at|for) (?:the )?(?:very )?(?:same )?(?:point |place |spot |position"
    r" )?(?:(?:where|at which|from which) (?:you |she |it |the (?:boat|usv|"
    r"vessel) )"
    r"(?:started|began|begun|start|begin|commenced|had started|had begun) (?:the |your |her |its"
    r" |to )?(?:drift|drifting|float|floating)|"
    r"(?:where|at which) the (?:drift|float) (?:began|started|begins|starts)|"
    r"(?:where|at which) (?:you |she |it )(?:cut|stopped|killed|switched off) (?:the |her |your"
    r" )?(?:engines?|motors?)|"
    r"(?:the )?(?:start|starting (?:point|place|position)|beginning) of the (?:drift|float))\b",
    re.IGNORECASE,
)
_DRIFTS = re.compile(r"\b(?:drift\w*|float\w*|adrift|afloat|engines?|motors)\b", re.IGNORECASE)
_ONE = r"(?:one|the first|the first one|the first drift)"
_NEXT = (
    r"(?:one|the next|the next one|the second|the second one|the other|another|the other one|the"
    r" second drift)"
)
_BEGINS = (
    r"(?: ?(?:beginning|starting|begins|starts|to begin|to start|begun|is|released|let go))*(?:"
    r" (?:at|from|in|off))? "
)
DRIFTS = re.compile(
    r"\b(?:(?:do|make|carry out|run|perform) )?two (?:separate )?(?:(?P<length>\w+)[-"
    r" ](?P<unit>minute|second) )?drifts(?: of "
    rf"(?P<time>[^,:.;\[(]{{3,30}}?))?(?: each)?"
    rf"[,:;]? {_ONE}{_BEGINS}(?P<a>{PLACE}),?(?: and| then| and then)?"
    rf" {_NEXT}{_BEGINS}(?P<b>{PLACE})"
    r"(?:[;,.] (?:and )?(?:motor|go|run|drive|head|transit|sail|steam) to (?:each|the)"
    r" (?:start|starting point|of them|one|place|point)s?(?: of (?:the|each) "
    r"drift)?"
    r"(?: first)?(?=[.;]))?",
    re.IGNORECASE,
)
DRIFT_FROM = re.compile(
    rf"\bdrift (?P<time>for [^,:.;\[(]{{3,30}}?) (?:from|at) (?P<a>{PLACE}),?(?: and)?(?: then)?"
    rf" (?:again |once more |another time )(?:from|at) (?P<b>{PLACE})",
    re.I,
)

# ---------------------------------------------------------------- coordinates

_IN_KM = re.compile(
    r"\bx ?[=:]? ?(?P<xs>minus |negative |[-−–])?(?P<x>\d+(?:\.\d+)?)"
    r" ?(?:km|kilomet(?:re|er)s?),?(?: and)? y ?[=:]? ?(?P<ys>minus |negative |[-−–])?"
    r"(?:(?P<y>\d+(?:\.\d+)?) ?(?:km|kilomet(?:re|er)s?)\b|(?P<o>0|zero|nought|nil)\b(?!\.\d))",
    re.IGNORECASE,
)
_X_NIL_KM = re.compile(
    r"\bx ?[=:]? ?(?:0|zero|nought|nil),?(?: and)? y ?[=:]? ?(?P<ys>minus |negative"
    r" |[-−–])?(?P<y>\d+(?:\.\d+)?) ?(?:km|kilomet(?:re|er)s?)\b",
    re.IGNORECASE,
)
_DIGITS = {
    word: str(value)
    for value, words in enumerate(
        (
            "zero oh nought",
            "one wun",
            "two",
            "three tree",
            "four fower",
            "five fife",
            "six",
            "seven",
            "eight ait",
            "nine niner",
        )
    )
    for word in words.split()
}
_DIGIT = f"(?:{'|'.join(_DIGITS)})"
_SAID = rf"(?:(?:minus|negative) )?(?:{_DIGIT}(?:[- ]{_DIGIT}){{0,2}}|\d{{1,4}})"
SAID_AGAIN = re.compile(
    rf"\b(?P<x>{_SAID})(?:,| and) ?(?P<y>{_SAID})[,.;:]? (?:i )?(?:say again|repeat|that is|i"
    rf" spell)[,:]? (?:to )?(?:x ?)?(?P<x2>{_SAID}),?(?: and)? (?:y "
    rf"?)?(?P<y2>{_SAID})\b",
    re.IGNORECASE,
)
SPOKEN_XY = re.compile(
    rf"\bx ?[=:]? ?(?P<x>{_SAID}),?(?: and)? y ?[=:]? ?(?P<y>{_SAID})(?![\w.-]|"
    rf" (?:{_DIGIT}|k?m|metres|meters|point|decimal)\b)",
    re.IGNORECASE,
)
SPOKEN_PAIR = re.compile(
    rf"\b(?P<to>to|for|at|position|point|via) (?P<x>{_SAID}), ?(?P<y>(?:minus|negative)"
    rf" {_SAID}|{_SAID}(?<=[a-z]))(?![\w-]| (?:{_DIGIT}|m|metres|degrees|"
    r"and|seconds|minutes)\b)",
    re.I,
)
CABLE_IS = re.compile(
    r",? ?[(–-]\s?(?:(?:a|one|1) cable (?:is|being|=|equals|makes) [^()]{3,60}|(?:tenths? of a"
    r" nautical mile|185(?:\.2)? m))\s?[)–-]",
    re.IGNORECASE,
)

SPOKEN_UNIT = re.compile(
    rf"\b{_DIGIT}(?:-{_DIGIT}){{1,2}}(?= (?:seconds?|minutes?|met(?:re|er)s?|degrees?)\b)",
    re.IGNORECASE,
)
LINE_UP = re.compile(rf"\b(?P<l>l)ine up (?:at )(?={_CALLED}{PLACE})", re.IGNORECASE)
"""To a place from which something is approached."""
ONE_EVERY = re.compile(
    r"\bone (?=(?:heading|bearing|look|stop|shot|still|picture|view) (?:every|per|each)\b)",
    re.IGNORECASE,
)
NO_WAIT = re.compile(
    r"(?P<before>^|[.;!] )(?:please )?(?:skip|leave out|omit|drop|forget|never mind|no need for)"
    r" (?:the |any )?(?:wait(?:ing)?|pauses?|stops?|holds?)"
    r"(?: (?:today|this time|now|between (?:the )?\w+|at each \w+|of the task))*(?:[.;]|$)",
    re.IGNORECASE,
)
BEFORE_ALL = re.compile(
    r"^\W*before (?:(?:you )?(?:do )?anything(?: else)?|(?:you )?(?:start|starting|moving|setting"
    r" off|going anywhere|move|set off|go anywhere)),? "
    r"(?=wait|hold|stay|turn|go|rotate|face|let)",
    re.IGNORECASE,
)

# ---------------------------------------------------------------- movements again

_SIDE = r"(?:to (?:the )?(?:port|starboard|left|right)|(?:counter|anti)-?clockwise|clockwise)"
AGAIN = re.compile(
    r"(?P<join>,? (?:(?:and|then|followed by|and then|immediately followed by) )?)(?:(?:do |make"
    r" |repeat )?(?:the same(?: thing)?(?: again| once more)?|"
    r"same again|again the same|"
    r"once more|repeat (?:it|that|this)|the same (?:arc|turn|circle|half circle|sweep)))"
    rf" (?P<side>{_SIDE}|(?:the other|the opposite) way(?: round)?|in the "
    r"(?:other|opposite) direction)",
    re.IGNORECASE,
)
_ARC = re.compile(
    r"\b(?:arc|arcs|sweeping turn|wide turn|circle|curve|bend|orbit|radius|sweep)\b", re.IGNORECASE
)
_ONE_SIDE = re.compile(rf"\b{_SIDE}\b", re.IGNORECASE)
_CUT = re.compile(
    r"[.;:!] |,? (?:and )?then |, and |\b(?:after that|next|finally),? |, (?=hold|wait|stay)",
    re.IGNORECASE,
)
_OTHER = {
    "port": "starboard",
    "starboard": "port",
    "left": "right",
    "right": "left",
    "clockwise": "anticlockwise",
}
FINISH_FACING = re.compile(
    r"(?P<before>[.;!] )(?:and )?(?:then )?(?:finish|end|end up|finish up|finally)(?: there)?,?"
    r" (?:with (?:the |her |your |its )?(?:bow|nose|heading)"
    r"(?: (?:facing|pointing|turned|looking))?|facing|pointing)(?: (?:due|to|to"
    r" the|towards|at|on))? "
    r"(?P<way>(?:north|south|east|west)(?:[ -]?(?:east|west))?|\d{3})(?:"
    r" degrees)?(?=\s*(?:[.;]|$))",
    re.IGNORECASE,
)
BEFORE_GOING = re.compile(
    r"(?P<before>^|[.;!] )(?:but )?before (?:you |she )?(?:go|going|head|heading|move|moving|set"
    r" off|setting off|run|running|sail|sailing|proceed|"
    r"proceeding)(?: out)? (?:to|for|towards) "
    r"(?:the|that|this) (?:line-?up|first|starting|start|lining-up)(?:"
    r" (?:point|place|waypoint|position|spot|one))?, (?P<rest>[^.;]+)(?:[.;]|$)",
    re.IGNORECASE,
)
"""A sentence about what comes before all movements."""
OLD_FIGURE = re.compile(
    r"(?P<before>^|[.;,:] )(?:and |but )?(?:please )?(?:(?:ignore|forget|disregard|never"
    r" mind|scrap) )?the (?:older|old|earlier|previous|former|outdated) "
    r"(?:figure|value|number|time|"
    r"duration|setting|radius|distance|length|spacing)(?: of| was|,|:)? (?P<value>[^.;,]{1,30}?)(?:"
    r" (?:is|was) (?:now )?(?:obsolete|wrong|out of date|void|"
    r"outdated|superseded|"
    r"no longer (?:valid|wanted|needed|right)|a mistake|a typo|withdrawn|dead))?(?=[.;,]|$)",
    re.IGNORECASE,
)
_TAKEN_BACK = re.compile(
    r"\b(?:ignore|forget|disregard|never mind|scrap|obsolete|wrong|out of"
    r" date|void|outdated|superseded|no longer|mistake|typo|withdrawn|dead)\b",
    re.I,
)


def told_plainly(text: str, parameters: dict[str, Any]) -> str:
    """The text with everything that is told by way of something else written out."""
    text = CABLE_IS.sub("", OLD_FIGURE.sub(_without_figure, text))
    text = _coordinates(ONE_EVERY.sub("a ", NO_WAIT.sub(r"\g<before>", text)))
    text = with_middles(text)
    text = VIA_FIRST.sub(r"\g<before>go to \g<via>, then \g<go>", VIA.sub(_over, text))
    text = BEFORE_ALL.sub(
        "First ",
        LINE_UP.sub(
            lambda said: "Go to " if said["l"] == "L" else "go to ", SPOTS.sub(_spots, text)
        ),
    )
    text = BOW_AT.sub(
        lambda said: "Turn to " if said["p"][0].isupper() else "turn to ",
        VISITED.sub(lambda said: "Go to " if said["v"][0].isupper() else "go to ", text),
    )
    text = AT_EACH.sub(r"\g<at>\g<order>", text)
    text = DRIFT_FROM.sub(
        r"go to \g<a>, drift \g<time>, go to \g<b>, drift \g<time>", DRIFTS.sub(_drifts, text)
    )
    text = _drift_began(text, parameters)
    text = FINISH_FACING.sub(r"\g<before>Then turn to \g<way>", text)
    return _again(_first_of_all(text))


def _over(match: re.Match[str]) -> str:
    """ "To A via B" in the order in which the places come."""
    if re.search(
        r"\bpast\b", match[0][: match.start("via") - match.start()], re.IGNORECASE
    ) and not match[0].endswith("way"):
        return match[0]
    goal = (
        "go home"
        if match["home"] or match["goal"].lower() in ("home", "base")
        else f"go to {match['goal']}"
    )
    go = (
        match["go"]
        if match["go"].lower() not in ("make", "return", "come", "back")
        else "Go"
        if match["go"][0].isupper()
        else "go"
    )
    return f"{go} to {match['via']}, then {goal}"


def _spots(match: re.Match[str]) -> str:
    """A list of places at each of which something is done, as places to go to."""
    places = _PLACE.findall(match["list"])
    count = _COUNTS.get((match["n"] or "").lower()) or int(
        match["n"] if (match["n"] or "").isdigit() else len(places)
    )
    behind = match.string[match.end() :]
    if (
        count != len(places)
        or _PLACE.search(behind)
        or _PLACE.search(match.string[: match.start()])
        or not EACH_BEHIND.match(behind)
    ):
        return match[0]
    return f"{match['before']}Go to {match['list']}. "


def _drifts(match: re.Match[str]) -> str:
    """Two drifts and where each of them begins, as movements in a row."""
    time = match["time"] or (f"{match['length']} {match['unit']}s" if match["length"] else "")
    time = re.sub(r" each$", "", time)
    drift = f"drift for {time}" if time else ""
    return f"go to {match['a']}, {drift}, go to {match['b']}, {drift}" if time else match[0]


def _first_of_all(text: str) -> str:
    """What is done before the first movement, at the beginning of the text."""
    match = BEFORE_GOING.search(text)
    return (
        f"First {match['rest']}."
        f" {text[: match.start()]}{match['before'].strip()}{text[match.end() :]}"
        if match
        else text
    )


def _drift_began(text: str, parameters: dict[str, Any]) -> str:
    """The place where a drift began in figures: the last one before it."""
    match = DRIFT_BEGAN.search(text)
    drift = _DRIFTS.search(text)
    if not match or not drift or drift.start() >= match.start():
        return text
    own = parameters.get("target_position", parameters.get("goal_position"))
    places = [(place.start(), place[0]) for place in _PLACE.finditer(text, 0, drift.start())]
    if isinstance(own, list) and len(own) == 2:
        places += [
            (one.start(), f"[{own[0]}, {own[1]}]")
            for one in re.finditer(_OWN, text[: drift.start()], re.IGNORECASE)
        ]
    return (
        f"{text[: match.start()]}{match['to']} {max(places)[1]}{text[match.end() :]}"
        if places
        else text
    )


def _without_figure(match: re.Match[str]) -> str:
    """Nothing for a figure that is no longer valid, if the sentence says so."""
    said = re.search(r"\d|minute|second|hour|met(?:re|er)|degree", match["value"]) is not None
    return (
        match["before"][:1].replace(",", "") + " " * bool(match["before"])
        if said and _TAKEN_BACK.search(match[0])
        else match[0]
    )


# ---------------------------------------------------------------- coordinates


def _coordinates(text: str) -> str:
    """The text with brackets round coordinates in kilometres and round those that are spelt out in
    digits.
    """
    text = _X_NIL_KM.sub(lambda said: f"[0, {_metres(said['ys'], said['y']):g}]", text)
    text = _IN_KM.sub(
        lambda said: (
            f"[{_metres(said['xs'], said['x']):g}, {_metres(said['ys'], said['y'] or '0'):g}]"
        ),
        text,
    )
    text = SAID_AGAIN.sub(_once, text)
    text = SPOKEN_XY.sub(_spoken, SPOKEN_UNIT.sub(lambda said: _figure(said[0]), text))
    return SPOKEN_PAIR.sub(
        lambda said: f"{said['to']} {_spoken(said)}" if _plainly_spoken(said) else said[0], text
    )


def _metres(sign: str | None, kilometres: str) -> float:
    return g.tidy(round((-1 if sign else 1) * float(kilometres) * 1000, 2))


def _figure(said: str) -> str:
    """A number that is spelt in digits, in figures."""
    minus = re.match(r"(?:minus|negative) ", said, re.IGNORECASE)
    words = re.split(r"[- ]", said[minus.end() :] if minus else said)
    return ("-" if minus else "") + "".join(_DIGITS.get(word.lower(), word) for word in words)


def _spoken(match: re.Match[str]) -> str:
    figures = [str(int(_figure(match[axis]))) for axis in "xy"]
    return (
        match[0]
        if not re.search(r"[a-z]{2}", match["x"] + match["y"], re.IGNORECASE)
        else f"[{figures[0]}, {figures[1]}]"
    )


def _once(match: re.Match[str]) -> str:
    """Coordinates that are said twice, once."""
    same = all(int(_figure(match[axis])) == int(_figure(match[f"{axis}2"])) for axis in "xy")
    return f"[{int(_figure(match['x']))}, {int(_figure(match['y']))}]" if same else match[0]


def _plainly_spoken(match: re.Match[str]) -> bool:
    """Whether two numbers behind "to" are no headings: one of them is negative, and one is spelt in
    digits.
    """
    minus = re.match(r"minus|negative", match["x"] + match["y"], re.IGNORECASE) or re.match(
        r"minus|negative", match["y"], re.IGNORECASE
    )
    return (
        minus is not None
        and re.search(r"[a-z][- ][a-z]", match["x"] + match["y"], re.IGNORECASE) is not None
    )


# ---------------------------------------------------------------- movements again


def _again(text: str) -> str:
    """An arc that is told as the same to the other side, in full."""
    for match in reversed([*AGAIN.finditer(text)]):
        before = text[: match.start()]
        cuts = [cut.end() for cut in _CUT.finditer(before)]
        arc = before[cuts[-1] if cuts else 0 :]
        sides = [*_ONE_SIDE.finditer(arc)]
        if len(sides) != 1 or not _ARC.search(arc) or len(arc) > 90:
            continue
        told = (
            match["side"]
            if not re.search(r"other|opposite", match["side"], re.IGNORECASE)
            else _opposite(sides[0][0])
        )
        again = arc[: sides[0].start()] + told + arc[sides[0].end() :]
        again = re.sub(r"^(?:and |also )", "", again[:1].lower() + again[1:])
        text = f"{before}, then {again}{text[match.end() :]}"
    return text


def _opposite(side: str) -> str:
    lowered = side.lower()
    if "clock" in lowered:
        return "clockwise" if lowered != "clockwise" else _OTHER["clockwise"]
    return re.sub(r"port|starboard|left|right", lambda word: _OTHER[word[0]], lowered)
