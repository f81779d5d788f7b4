"""The rotations that a task input leaves no choice about, in order: headings to turn to and angles to turn by.

The text is first written in one form (`turn_forms`). What is measured, an arc or the course of a run is then taken out, and each angle that is
left has to be told by the words on both sides of it. None where one cannot be, or where a word for a turn is left over.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import Any

from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.rows import turn_forms as f
from planner_ft.decoding.constraints.reading.rows.asides import without_asides
from planner_ft.decoding.constraints.reading.rows.counted_turns import counted as counted_turns
from planner_ft.decoding.constraints.reading.rows.turn_parts import CURVED, MOST, NUDGE, ROTATE, Found, Turn, Uncertain, blank, heading
from planner_ft.decoding.constraints.reading.rows.turn_wordings import explained
from planner_ft.vocabulary import Vocabulary

# ---------------------------------------------------------------- headings and angles

_VERB = (
    r"(?:re-?)?(?:turn|rotat|pivot|swing|spin|swivel|slew|twist|yaw|pan|nudg|eas|trim|correct|adjust|offset|tweak|shift|com|bring|put|point|set|"
    r"aim|align|squar|lin|"
    r"chang|alter|tak|mak|go|mov|scan|sweep)(?:e|ing|ning|ting|ed|ned)?"
)
_OBJECT = (
    r"(?:the|her|its|it|your|us|me|my|she|yourself|herself|boat|usv|vessel|vehicle|craft|ship|bow|nose|head|heading|camera|view|yaw|image|round|"
    r"around|about|in place|on the spot|"
    r"back|slowly|gently|smartly|carefully|smoothly|now|up|over|then|next|first|on|onwards?|out|further|small|rotation|turn|pan|nudge|swing|of|a|"
    r"an|course|"
    r"another|just|again|direct|directly|straight|in|hull|stern|asv|us)"
)
_TO = (
    r"(?:to face|to|onto|on|towards?|until (?:the bow|she|it|you|the heading)(?: is| are)?(?: points?| faces?| on| facing)*(?: to(?:wards)?)?|"
    r"through the)"
)
_NOUN = r"(?:(?:a|the|its|her|each of|all of) )*(?:(?:(?:compass|new) )?(?:headings?|bearings?|courses?|directions?)(?: of)?[:,]? )?(?:each of )?"
_HEAD_LEAD = f.compiled(
    rf"(?:\b{_VERB}(?: (?:{_OBJECT}|{f.SIDE}))*,? {_TO} {_NOUN}|\b(?:fac(?:e|ing)|look(?:ing)?|"
    rf"(?<!first )(?<!the )(?<!each )point(?:ing)?)(?: (?:the|her|bow|nose|round|up|it))*(?: (?:to|towards|along|due|on|at))? {_NOUN}"
    rf"|\b(?:bow|nose) (?:must|should|shall|is to|has to|to) (?:look|point|face|be on|go to|come to|be at)(?: (?:to|towards|due))* "
    rf"|\b(?:turn|rotate|swing|go|step|work)(?:ing)? (?:round )?through (?:the (?:headings|bearings) )?|\b(?:both|all|N\d+|these|the|"
    rf"following) (?:headings|bearings|directions)[,:]? |\b(?:headings|bearings): "
    rf"|\b(?:bow|nose)(?: (?:round|on|to|at|onto|towards|first))*[: ]+{_NOUN}|\b(?:take up|come to|go to|set|adopt|steady on|steady up on|"
    rf"look along|assume|turn) {_NOUN}"
    rf"|(?:^|[.;:] ?)(?:then |next )?(?:headings?|bearings?):? )(?:due )?$"
)
_STRONG = f.compiled(
    r"turn|rotat|pivot|sw[iu]ng|spin|swivel|slew|twist|fac|bow|nose|heading|bearing|course|com|point|aim|lin|squar|align|look|yaw|"
    r"direction|steady"
)
"""What a movement to a heading is named by; "take her to 145, 30" may be a place."""
_TURNS_THERE = f.compiled(r"turn|rotat|pivot|swing|spin|swivel|slew|twist|^(?: |,|then|and)*come")
_IN_PLACE = f.compiled(r"nudg|\bpan|yaw|twist|rotat|bow|nose|heading|on the spot|in place|pivot|spin|swivel|trim|\beas(?:e|ing)\b|sweep [DN][\d.]+ across")
_SEPARATOR = f.compiled(
    rf"^ ?(?:[,;/.]|->|→|-|and|then|finally|lastly|last|next|after that|afterwards|on|again|round|{_VERB}|fac(?:e|ing)|to|onto|towards|due|on to|"
    rf"the|bow|heading|bearing| )* ?$"
)
_TURN_WORD = rf"(?:{_VERB}(?: (?:{_OBJECT}))*(?: on the spot| in place)?|(?:pans?|nudges?|turns?|rotations?|twists?|swings?|yaws?)(?: of| by|,|:)?)"
_BY = f.compiled(
    rf"\b(?:(?:turn|rotat|pivot|swing|spin|swivel|slew|twist|yaw|pan|nudg|eas|trim|correct|adjust|offset|tweak|shift|chang|alter|com|bring|mov|"
    rf"scan|sweep)(?:e|ing|ning|ed)?"
    rf"(?: (?:{_OBJECT}))*(?: on the spot| in place)?|(?:pans?|nudges?|turns?|rotations?|twists?|swings?|yaws?)(?: of| by|,|:)?)"
    r",?(?: (?:by|through|of|across|another|a further|some|about|the view|slowly))*(?<! on) $"
)
_LOOSE_END = f.compiled(
    rf"^ ?,? ?(?:N\d+ (?!(?:back |across |over |further )?(?:{f.SIDE}))[a-z]+|"
    r"(?:with|on|at|in)(?: a| the)? L (?!clear|margin|of clear|of margin|safety|between|minimum|in hand|of room|spare))"
)
"""Another count, or a radius, right behind an angle."""
_IS_COUNT = f.compiled(r" ?(?:times|pans|nudges|turns|rotations|steps|(?:equal|separate|single|successive|small|even) (?:steps|turns|pans))\b")
_LISTED_BEHIND = f.compiled(r" ?(?:,|and|then)[ ,a-z]{0,9} D")
_WIDE = f.compiled(
    rf"\b(?:swing|sweep|com|bend|go|curv)(?:e|ing)? (?:wide|round|around)(?: (?:{f.SIDE}))?(?: (?:by|through))? {f.D}(?! ?(?:,|\.|and|"
    rf"then) ?{f.V})(?: degrees)? (?:{f.SIDE})"
)
"""A turn that may be an arc."""
_THAT_IS = f.compiled(r"[ ,(]*(?:to|onto|on|until|till|so|i\.?e|that is|which|namely|meaning|=)\b")
"""What leads from an angle to the heading that it ends at."""
_EACH = f.compiled(r"^[ ,]*(?:each|apiece|at a time|per step|every)\b")
_OF_MANY = f.compiled(r"\b(?:steps|times|pans|nudges|turns|rotations|twists|swings) (?:of|by) $")
_SIDE_BEFORE = f.compiled(
    rf"(?:^|[ ,])(?P<side>{f.SIDE})(?:,|:)?(?: (?:by|of|through|another|a further|once|for|some|about|turn|pan|nudge|rotation|"
    rf"on the spot))* $"
)
_SIDE_BEHIND = f.compiled(
    rf"^ ?(?:turn |pan |nudge |rotation |yaw |swing |twist |of (?:yaw|rotation|turn) |more |on the spot |round |"
    rf"(?:right )?back |across |over |further )?,? ?(?P<side>{f.SIDE})"
)
_TIMES_BEHIND = f.compiled(
    r"^[ ,]*(?:(?:each|at a time),? ?)?N(\d+) times?(?: over| in a row| running)?\b|^[ ,]*in N(\d+) (?:turns|pans|steps|"
    r"goes)\b(?! of)"
)
_TIMES_BEFORE = f.compiled(
    r"\bN(\d+)(?: (?:equal|separate|single|successive|small|even))? (?:times|pans|nudges|turns|rotations|steps|twists|swings|yaws)(?: (?:on|over|"
    r"in a row|round))*"
    rf"(?: (?:{f.SIDE}))?,?(?: (?:by|of|at|through|,|:))* ?$"
)
_ONCE_MORE = f.compiled(r"^ (?:once more|again|more|once again)\b")
"""Behind an angle that is said a second time."""
_SAME_TO = f.compiled(
    rf"\b(?:(?:{_VERB}|back|by|as|and) )*(?:the same|as much|as far|that much|the same (?:angle|amount))(?: (?:angle|amount|again|"
    rf"back))* (?P<side>{f.SIDE})"
    rf"|\bback (?P<back>{f.SIDE}) (?:by )?(?:the same|as much|as far|that much)(?: (?:angle|amount|again))*|\bback(?: again)? by (?:the same|"
    rf"as much)(?: (?:angle|amount|again))*"
)


_NEXT = f.compiled(
    r"(?:(?:^|[.;,]|and) ?(?:and )?(?:then|next|finally|lastly|after that),?|\bsame again|\bthe same|\blikewise)(?: (?:to|onto|on to|round to|at|"
    r"on|facing|towards))? (?:due )?$"
)
_IN_PASSING = f.compiled(
    r"\b(?:while|when|whilst|as (?:you|she)|during|in|on|once|after|only|at|until|with|for|whenever|before)(?: (?:you|she|it|the|a|her|are|is))* $"
)
_NO_HEADING = f.compiled(rf"^ ?(?:{f.SIDE}|(?:apart|each|at a time|steps?|times|headings|sectors|directions|pans|turns|degrees? of)\b)")
_ENDS = f.compiled(
    r"^ ?(?:$|[.,;:!?)/~-]|(?:and|then|with|while|in|on|for|at|hold|before|after|to|as|or|when|true|degrees|where|without|both|only|"
    r"finally)\b)"
)


_TRAVEL = (
    r"(?:go|going|head|drive|driving|sail|run|transit|proceed|approach|steer|course for|leave|make for|get|return|moor|close in|move|shift|"
    r"cross)"
)


def _turns_there(lead: str, before: str) -> bool:
    """Whether a heading is one to turn to, and not the yaw on arrival at a place that the same sentence names before it: "go to P and face 040"."""
    if not _STRONG.search(lead):
        return False
    if re.match(r"\W*(?:fac|point|look)ing", lead) and before.strip(" ~,:") and not _IN_PASSING.search(before) and not before.rstrip().endswith(":"):
        return False
    if re.match(r"\W*(?:bow|nose)[ :]*$", lead) and before.strip(" ~,:") and not _LEADING.search(before):
        return False
    place = [*re.finditer(rf"\b(?:{f.GOAL}|{_TRAVEL})\b|~a", before)]
    if not place or _TURNS_THERE.search(lead):
        return True
    return re.search(r"\bthen\b|[:]", before[place[-1].end() :] + lead) is not None


@dataclass(frozen=True)
class Angle:
    """An angle of the text: the words before it in its sentence, all behind it, and what stands between it and the rotation read last."""

    token: str
    start: int
    end: int
    before: str
    behind: str
    since: str
    last: Found | None

    @property
    def bare(self) -> bool:
        """Whether no degrees are said."""
        return self.token[0] == "N"

    @property
    def signed(self) -> bool:
        """Whether a plus or minus is said."""
        return self.token[1] in "+-"

    @property
    def value(self) -> float:
        """The number."""
        return float(self.token[1:])

    def goes_on(self, turn: str, text: str | None = None) -> bool:
        """Whether the angle, or the words `text` before it, continue a list of such rotations."""
        return self.last is not None and self.last.turns[-1][0] == turn and _SEPARATOR.match(self.since if text is None else text) is not None


def _nudge(angle: Angle) -> Found | None:
    """The rotations by the angle, where it is one."""
    side_behind, side_before, by = _SIDE_BEHIND.match(angle.behind), _SIDE_BEFORE.search(angle.before), _BY.search(angle.before)
    counted = _TIMES_BEFORE.search(angle.before)
    side = side_behind or side_before
    if angle.token[0] == "C" or not (_sided(angle, side_behind, side_before) if side else _unsided(angle, by, counted)):
        return None
    if (side_behind and side_before and not counted) or (side and angle.signed):
        raise Uncertain
    value = angle.value * (f.sign(side["side"]) if side else 1)
    end = angle.end + (side_behind.end() if side_behind else 0)
    count, used = _count(angle, counted, angle.behind[end - angle.end :])
    end += used
    if angle.last and angle.last.turns[-1][0] == NUDGE and angle.last.turns[-1][1] * value > 0:
        more = _ONCE_MORE.match(angle.behind[end - angle.end :])
        end += more.end() if more else 0
    first = min((match.start() for match in (side_before, by, counted) if match), default=len(angle.before))
    if abs(value) > 360 or not value or not 1 <= count <= MOST:
        raise Uncertain
    return Found(angle.start - len(angle.before) + first, end, ((NUDGE, value),) * count, _IN_PASSING.search(angle.before[:first]) is not None)


def _sided(angle: Angle, side_behind: re.Match[str] | None, side_before: re.Match[str] | None) -> bool:
    """Whether an angle beside a word for a side is one to turn by: of a bare number a verb has to say so, or the rotation before it."""
    if not angle.bare or _BY.search(angle.before) or _TIMES_BEFORE.search(angle.before):
        return True
    if side_before and _BY.search(angle.before[: side_before.start("side")]):
        return True
    since = angle.since.rpartition(side_before["side"])[0] if side_before and not side_behind else angle.since
    return angle.goes_on(NUDGE, since)


def _unsided(angle: Angle, by: re.Match[str] | None, counted: re.Match[str] | None) -> bool:
    """Whether an angle without a side is one to turn by: "swing the bow 40 degrees", "then minus 20 degrees"."""
    if by and by[0].startswith("yaw") and angle.before[: by.start()].strip(" ;:"):
        # The yaw on arrival at a place looks the same.
        raise Uncertain
    if angle.signed and angle.goes_on(NUDGE):
        return True
    if by and angle.value > 180 and not by[0].endswith(("by ", "through ")):
        # "Rotate 270 degrees" may as well be a heading.
        raise Uncertain
    if by and not _ENDS.match(angle.behind) and not re.match(r" ?(?:N\d+ times|each|at a time)\b", angle.behind):
        raise Uncertain
    if by:
        return not angle.bare or by[0].endswith("by ")
    return counted is not None and not angle.bare and not _HEAD_LEAD.search(angle.before)


def _count(angle: Angle, counted: re.Match[str] | None, rest: str) -> tuple[int, int]:
    """How often the rotation is made, and the length of the words behind it that say so."""
    behind = _TIMES_BEHIND.match(rest)
    used = behind.end() if behind else 0
    many = _OF_MANY.search(angle.before) or _EACH.match(rest)
    listed = counted and _LISTED_BEHIND.match(rest) and re.search(r", $", angle.before)
    if (counted and behind) or (many and not counted and not behind) or listed or _LOOSE_END.match(rest[used:]):
        raise Uncertain
    return int(counted[1] if counted else (behind[1] or behind[2]) if behind else 1), used


def _is_heading(angle: Angle) -> bool:
    """Whether the vehicle is to turn to the angle: by the words before it, or as the next of a list."""
    if _NO_HEADING.match(angle.behind) or angle.signed:
        return False
    if lead := _HEAD_LEAD.search(angle.before):
        # "Turn 180" may be an angle.
        return angle.token[0] == "C" or lead[0] != "turn "
    ends = not angle.bare or _ENDS.match(angle.behind) is not None
    if angle.last and angle.last.turns[-1][0] == ROTATE and _NEXT.search(angle.before) and _ENDS.match(angle.behind):
        return not angle.bare or angle.value > 12 or angle.value == 0
    return angle.goes_on(ROTATE) and angle.since.strip(" ") != "" and ends


def _read(text: str, *, orbits: bool) -> list[Found]:
    """What each angle of the text means. Raises Uncertain when one of them cannot be told."""
    found: list[Found] = []
    taken = 0
    if _WIDE.search(text):
        raise Uncertain
    for token in re.finditer(f.V, text):
        if token.start() < taken or (token[0][0] == "N" and _IS_COUNT.match(text, token.end())):
            continue
        sentence = max(text.rfind(mark, 0, token.start()) for mark in (". ", "; ", "~")) + 1
        before = text[max(taken, sentence) : token.start()]
        angle = Angle(token[0], *token.span(), before, text[token.end() :], text[taken : token.start()], found[-1] if found else None)
        if nudge := _nudge(angle):
            in_place = _IN_PLACE.search(text[max(taken, nudge.start - 25) : nudge.end])
            if (orbits or CURVED.search(text[sentence:].partition(". ")[0])) and not in_place:
                raise Uncertain
            found.append(nudge)
        elif _is_heading(angle):
            if found and found[-1].turns[-1][0] == NUDGE and _THAT_IS.match(angle.since):
                raise Uncertain
            start = max(text.rfind(mark, 0, token.start()) for mark in (". ", "; ")) + 1
            found = [*_listed(found, angle), _turn_to(angle, text[start : token.start()], text[taken : token.start()])]
        elif angle.bare and 0 < abs(angle.value) <= 12 and not _SIDE_BEHIND.match(angle.behind) and not (found and _SEPARATOR.match(angle.since)):
            continue
        else:
            raise Uncertain
        taken = found[-1].end
    return found


def _listed(found: list[Found], angle: Angle) -> list[Found]:
    """The rotations, the last one no side note when a list goes on behind it."""
    goes_on = found and found[-1].side_note and not _HEAD_LEAD.search(angle.before)
    return [*found[:-1], replace(found[-1], side_note=False)] if goes_on else found


def _turn_to(angle: Angle, sentence: str, since: str) -> Found:
    """The rotation to the angle."""
    lead = _HEAD_LEAD.search(angle.before)
    if not lead:
        return Found(angle.start, angle.end, (heading(angle.value),))
    words = len(lead[0])
    if not _turns_there(lead[0], sentence[: len(sentence) - words]):
        raise Uncertain
    return Found(angle.start - words, angle.end, (heading(angle.value),), _IN_PASSING.search(since[: len(since) - words]) is not None)


# ---------------------------------------------------------------- what makes a reading uncertain

_TAKEN_BACK = f.compiled(
    r"\b(?:sorry|i mean|i meant|correction|rather|instead|actually|make (?:that|it)|scratch|cancel|forget|strike|disregard|skip|leave out|drop the|"
    r"no longer|if|unless|either|"
    r"or rather|wrong|changed? my mind|undo|vice versa|other way|opposite|reverse\w*|backwards|any (?:heading|bearing|direction)|alternat\w+|"
    r"reciprocal|back (?:to )?where|way-?points? (?:every|each)|mirror\w*)\b|\bno, |\?|"
    r"\b(?:not|n't|never|no|without|nor|don't|neither) (?:(?!during|in|on|while|when|for|at|until|after|before|of)[a-z]+ ){0,2}?"
    r"(?:turn|rotat|pan\b|panning|nudg|yaw|swing|pivot|fac(?:e|ing)|spin)\w*|\b(?:not|n't) (?:to )?[DNC]-?\d"
)
_ONE_OR_MORE = f.compiled(
    r"\breturn(?:ing)?\b(?! (?:home|to (?:base|home|where|P|the (?!heading|bearing|first))))|"
    r"(?<!all )\btimes\b|"
    r"(?<!long )(?<!look )(?<!hold )(?<!wait )(?<!check )(?<!stay )(?<!measure )(?<!centred )(?<!still )(?<!home )(?<!record )\bagain\b|"
    r"\bafter the [a-z0-9N]+ and (?:after )?the\b|\b(?:repeat\w*|the same|same again|once more|as (?:much|far|many)|laps?|each way|both ways|either side|"
    r"another|"
    r"(?<!wait )(?<!hold )(?<!stay )likewise|ditto|back (?:by|"
    r"again)|"
    r"and back(?! (?:home|to|at|here|in))|swing back|turn back|rotate back|pan back|halves|cycle|(?<!along )(?<!on )(?<!at )that (?:heading|"
    r"bearing)|previous|original|initial)\b"
)
_BARE_VERB = f.compiled(
    r"(?<!the )(?<!each )(?<!every )(?<!this )(?<!that )(?<!first )(?<!second )(?<!third )(?<!fourth )(?<!fifth )(?<!last )"
    r"(?<!next )(?<!either )(?<!in )(?<!nth )"
    r"(?<!middle )(?<!final )(?<!other )(?<!later )(?<!earlier )(?<!per )(?<!while you )(?<!as you )(?<!when you )(?<!before you )"
    r"(?<!once you )(?<!one )(?<!only )(?<!between )(?<!fraction )(?<!it )(?<!she )(?<!may )"
    r"(?<!as she )(?<!while she )(?<!when she )\b(?:turn|rotate|rotation|pan|nudge|yaw|swing|twist|spin|pivot|swivel|slew|face|scan (?:through|"
    r"across|all|to|left|right|round|about)|(?<!clearance )sweep|look(?! (?:for|out|at|after|again|in(?:to)? (?:the|on)\b))|panorama|"
    r"compass|swings|rotates)\b|\b(?:come (?:round|about)|go about|square up|lin(?:e|ed|ing) up|point (?:the|her|it|your)|bow to|bow on|nose to|"
    r"headings? [a-z]+ly|"
    r"sectors|directions|unknown heading|cardinal|spins?|about-turn|u-turn|turnabout)\b|\b(?:turns|pans|nudges|rotations|swings|headings) of\b"
)
_LONE_SIDE = f.compiled(
    r"(?<!pans )(?<!pan )(?<!turn )(?<!turns )(?<!nudge )(?<!nudges )(?<!rotation )(?<!swing )\bto (?:the )?(?:port|starboard|left|"
    r"right)\b(?= ?(?:$|[.,;:~)-]|and\b|then\b|by\b|with\b|while\b))|"
    r"\b(?:(?:counter|anti)[- ]?)?clock-?wise\b"
)
_BEFORE = f.compiled(
    r"\b(?:before(?! [^,.;:]*:)(?! (?:the next|each|every)\b)|prior to|ahead of|preceded by|"
    r"(?<!wait )(?<!hold )(?<!stay )(?<!waiting )(?<!remain )(?<!settle )until)\b"
)
_AFTER = f.compiled(r"\b(?:after(?! (?:that|this|which)\b)|once(?! (?:round|more))|when|preceded|as soon as)\b")
_BACKWARDS = f.compiled(
    r"\b(?:but first|first though|before (?:that|this|it|them)|beforehand|before all|to begin with|begin with|start with|ends? with|"
    r"finish(?:es)? (?:with|on)|comes? (?:first|last)|at the start|in the end|"
    r"preced\w+|in between|in that order reversed|last comes|order)\b(?<!in that order)(?<!in this order)(?<!in order)"
)
_BEFORE_OPENS = f.compiled(r"[.;] ?(?:but )?(?:before|until|prior to)\b")
"""A sentence that begins with what comes later."""
_FIRST_BEHIND = f.compiled(r"\b(?:first|beforehand|first of all)(?=[.;]| ?$)")


def _orderly(text: str, found: list[Found]) -> bool:
    """Whether the rotations run in the order in which they are said, as far as words for an order tell."""
    if len(found) < 2:
        return True
    if _BACKWARDS.search(text):
        return False
    if any(any(one.start < match.start() for one in found) for match in _BEFORE_OPENS.finditer(text)):
        return False
    for sentence in re.finditer(r"[^.;]+", text):
        inside = [one for one in found if sentence.start() <= one.start < sentence.end()]
        for match in _BEFORE.finditer(sentence[0]):
            if any(one.start >= sentence.start() + match.start() for one in inside):
                return False
        for match in _AFTER.finditer(sentence[0]):
            at = sentence.start() + match.start()
            if any(one.start >= at for one in inside) and any(one.start < at for one in found):
                return False
    return all(not any(one.start < match.start() for one in found[1:]) for match in _FIRST_BEHIND.finditer(text))


def _without_notes(found: list[Found]) -> list[Found]:
    """The rotations without those that are mentioned once more in passing: "slices while facing 090"."""
    said = [turn for one in found if not one.side_note for turn in one.turns]
    return [one for one in found if not (one.side_note and len(one.turns) == 1 and one.turns[0] in said)]


def _same_again(text: str, found: list[Found]) -> list[Found]:
    """The rotations, and those that the text gives as another one's size: "and as much to starboard"."""
    for match in _SAME_TO.finditer(text):
        last = next((one for one in reversed(found) if one.end <= match.start()), None)
        if last is None or len(last.turns) != 1 or last.turns[0][0] != NUDGE or any(match.start() <= one.start < match.end() for one in found):
            raise Uncertain
        side = match["side"] or match["back"]
        value = f.sign(side) * abs(last.turns[0][1]) if side else -last.turns[0][1]
        found = sorted([*found, Found(match.start(), match.end(), ((NUDGE, value),))], key=lambda one: one.start)
    return found


_EMPTY = f.compiled(
    r"\b(?:turn\w*|rotat\w*|pan|pans|panning|panorama\w*|nudg\w*|yaw\w*|swing\w*|twist\w*|spin\w*|pivot\w*|swivel\w*|slew\w*|fac(?:e|es|ing)|"
    r"headings?|bearings?|bow|nose|"
    r"degrees?|compass|port|starboard|left|right|(?:counter|anti)?-?clockwise|round|around|look|looking|lin(?:e|ed|ing) up|square up|aim\w*|"
    r"scan\w*|sweep\w*|sector\w*|"
    r"direction\w*|angle\w*|point(?:ing)? |about|stern|again|times|same|revolutions?)\b|[DC]-?\d"
)
_BARE = f.compiled(r"N-?\d+(?:\.\d+)?")
_AROUND = f.compiled(r"\b(?:panorama|look all round|look round)\b")
_LEADING = f.compiled(
    rf"\b(?:{_TURN_WORD}|look(?:ing)?|fac(?:e|ing)|point(?:ing)?)[ ,]*(?:in |to |through |at |all )?$|\bsame again (?:to |at |on |"
    rf"facing |towards )?$"
)
_PAIR_OR_TWO = f.compiled(r"\bcom(?:e|ing) (?:in |over |up |out |back )?to N-?[\d.]+ ?, ?N-?[\d.]+(?! ?(?:,|and|then)(?: then)? ?[DNC]\d)")
_SAY_AGAIN = f.compiled(rf"(?P<v>{f.V})[ ,.]*(?:i )?(?:say again|repeat),? (?P=v)")


def read_turns(record: dict[str, Any], vocabulary: Vocabulary) -> tuple[Turn, ...] | None:
    """Every rotation of the answer in order, where the input leaves no choice; None where it does, () where there is certainly none."""
    if not {ROTATE, NUDGE} <= set(vocabulary.skill):
        return None
    given = record.get("parameters")
    text = f.plain(str(record.get("prompt", "")), given if isinstance(given, dict) else {})
    if not _EMPTY.search(text) and not any(not 0 < float(match[0][1:]) <= 12 for match in _BARE.finditer(text)):
        return ()
    orbits = str(record.get("task")) in ("PerformOrbit", "GlareFreeApproach") or ("radius" in text and "square" not in text)
    text = _SAY_AGAIN.sub(r"\g<v>", explained(without_asides(text)))
    if _TAKEN_BACK.search(text) or _PAIR_OR_TWO.search(text):
        return None
    try:
        counted = sorted(counted_turns(text), key=lambda one: one.start)
        text = f.without(blank(text, ((one.start, one.end) for one in counted)), (f.COUNTED, f.ARC, f.SENSED, f.SIDES_OF_THINGS, f.YAW, f.RUN))
        found = _same_again(text, sorted([*counted, *_read(text, orbits=orbits)], key=lambda one: one.start))
    except Uncertain:
        return None
    if any(one.turns[0][0] == ROTATE for one in counted):
        text = _AROUND.sub(f.mask, text)
    rest = blank(text, ((_from_verb(text, one.start), one.end) for one in found))
    if not found or _left_over(rest) or not _orderly(text, found):
        return None
    turns = tuple(turn for one in _without_notes(found) for turn in one.turns)
    return turns if len(turns) <= MOST else None


def _from_verb(text: str, start: int) -> int:
    """Where the words begin that lead to a rotation."""
    lead = _LEADING.search(text[:start])
    return lead.start() if lead else start


def _left_over(rest: str) -> bool:
    """Whether words that may speak of another rotation are not read."""
    rest = w.LOCKED.sub(" ", rest)
    return any(pattern.search(rest) for pattern in (_BARE_VERB, _ONE_OR_MORE)) or _LONE_SIDE.search(f.WAYPOINTS.sub(" ", rest)) is not None
