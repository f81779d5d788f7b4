"""The rotations that a task input leaves no choice about, in order: headings to turn to and angles
to turn by.

The text is first written in one form (`turn_forms`). What is measured, an arc or the course of a
run is then taken out, and each angle that is left has to be told by the words on both sides of it.
None where one cannot be, or where a word for a turn is left over.
"""

from __future__ import annotations

import re
from typing import Any

from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.rows import angle_wordings as a
from planner_ft.decoding.constraints.reading.rows import turn_forms as f
from planner_ft.decoding.constraints.reading.rows.asides import without_asides
from planner_ft.decoding.constraints.reading.rows.counted_turns import counted as counted_turns
from planner_ft.decoding.constraints.reading.rows.turn_angles import read_angles
from planner_ft.decoding.constraints.reading.rows.turn_parts import (
    MOST,
    NUDGE,
    ROTATE,
    Found,
    Turn,
    Uncertain,
    blank,
)
from planner_ft.decoding.constraints.reading.rows.turn_wordings import explained
from planner_ft.vocabulary import Vocabulary

_TAKEN_BACK = f.compiled(
    r"\b(?:sorry|i mean|i meant|correction|rather|instead|actually|make"
    r" (?:that|it)|scratch|cancel|forget|strike|disregard|skip|leave out|drop the|"
    r"no longer|if|unless|either|"
    r"or rather|wrong|changed? my mind|undo|vice versa|other way|opposite|reverse\w*|backwards|any"
    r" (?:heading|bearing|direction)|alternat\w+|"
    r"reciprocal|end with the (?:nose|bow) on|back (?:to )?where|way-?points?"
    r" (?:every|each)|mirror\w*)\b|\bno, |\?|"
    r"\b(?:not|n't|never|no|without|nor|don't|neither)"
    r" (?:(?!during|in|on|while|when|for|at|until|after|before|of)[a-z]+ ){0,2}?"
    r"(?:turn|rotat|pan\b|panning|nudg|yaw|swing|pivot|fac(?:e|ing)|spin)\w*|\b(?:not|n't) (?:to"
    r" )?[DNC]-?\d"
)
_ONE_OR_MORE = f.compiled(
    r"\brounds of \w+:|"
    r"\breturn(?:ing)?\b(?! (?:home|to (?:base|home|where|P|the (?!heading|bearing|first))))|"
    r"(?<!all )\btimes\b|"
    r"(?<!long )(?<!look )(?<!hold )(?<!wait )(?<!check )(?<!stay )(?<!measure )(?<!centred"
    r" )(?<!still )(?<!home )(?<!record )\bagain\b|"
    r"\bafter the [a-z0-9N]+ and (?:after )?the\b|\b(?:repeat\w*|the same|same again|once more|as"
    r" (?:much|far|many)|laps?|each way|both ways|either side|"
    r"another|"
    r"(?<!wait )(?<!hold )(?<!stay )likewise|ditto|back (?:by|"
    r"again)|"
    r"and back(?! (?:home|to|at|here|in))|swing back|turn back|rotate back|pan"
    r" back|halves|cycle|(?<!along )(?<!on )(?<!at )that (?:heading|"
    r"bearing)|previous|original|initial)\b"
)
_BARE_VERB = f.compiled(
    r"(?<!the )(?<!each )(?<!every )(?<!this )(?<!that )(?<!first )(?<!second )(?<!third"
    r" )(?<!fourth )(?<!fifth )(?<!last )"
    r"(?<!next )(?<!either )(?<!in )(?<!nth )"
    r"(?<!middle )(?<!final )(?<!other )(?<!later )(?<!earlier )(?<!per )(?<!while you )(?<!as you"
    r" )(?<!when you )(?<!before you )"
    r"(?<!once you )(?<!one )(?<!only )(?<!between )(?<!fraction )(?<!it )(?<!she )(?<!may )"
    r"(?<!as she )(?<!while she )(?<!when she"
    r" )\b(?:turn|rotate|rotation|pan|nudge|yaw|swing|twist|spin|pivot|swivel|slew|face|scan"
    r" (?:through|"
    r"across|all|to|left|right|round|about)|(?<!clearance )sweep|look(?!"
    r" (?:for|out|at|after|again|in(?:to)? (?:the|on)\b))|panorama|"
    r"compass|swings|rotates)\b|\b(?:come (?:round|about)|go about|square up|lin(?:e|ed|ing)"
    r" up|point (?:the|her|it|your)|bow to|bow on|nose to|"
    r"headings? [a-z]+ly|"
    r"sectors|directions|unknown"
    r" heading|cardinal|spins?|about-turn|u-turn|turnabout)\b|\b(?:turns|pans|nudges|rotations|swings|headings)"
    r" of\b"
)
_LONE_SIDE = f.compiled(
    r"(?<!pans )(?<!pan )(?<!turn )(?<!turns )(?<!nudge )(?<!nudges )(?<!rotation )(?<!swing )\bto"
    r" (?:the )?(?:port|starboard|left|"
    r"right)\b(?= ?(?:$|[.,;:~)-]|and\b|then\b|by\b|with\b|while\b))|"
    r"\b(?:(?:counter|anti)[- ]?)?clock-?wise\b"
)
_EMPTY = f.compiled(
    r"\b(?:turn\w*|rotat\w*|pan|pans|panning|panorama\w*|nudg\w*|yaw\w*|swing\w*|twist\w*|spin\w*|pivot\w*|swivel\w*|slew\w*|fac(?:e|es|ing)|"
    r"headings?|bearings?|bow|nose|"
    r"degrees?|compass|port|starboard|left|right|(?:counter|anti)?-?clockwise|round|around|look|looking|lin(?:e|ed|ing)"
    r" up|square up|aim\w*|"
    r"scan\w*|sweep\w*|sector\w*|"
    r"direction\w*|angle\w*|point(?:ing)? |about|stern|again|times|same|revolutions?)\b|[DC]-?\d"
)
_BARE = f.compiled(r"N-?\d+(?:\.\d+)?")
_AROUND = f.compiled(r"\b(?:panorama|look all round|look round)\b")
_PAIR_OR_TWO = f.compiled(
    r"\bcom(?:e|ing) (?:in |over |up |out |back )?to N-?[\d.]+ ?, ?N-?[\d.]+(?! ?(?:,|and|then)(?:"
    r" then)? ?[DNC]\d)"
)
_SAY_AGAIN = f.compiled(rf"(?P<v>{f.V})[ ,.]*(?:i )?(?:say again|repeat),? (?P=v)")


def read_turns(record: dict[str, Any], vocabulary: Vocabulary) -> tuple[Turn, ...] | None:
    """Every rotation of the answer in order, where the input leaves no choice; None where it does,
    () where there is certainly none.
    """
    if not {ROTATE, NUDGE} <= set(vocabulary.skill):
        return None
    given = record.get("parameters")
    text = f.plain(str(record.get("prompt", "")), given if isinstance(given, dict) else {})
    if not _EMPTY.search(text) and not any(
        not 0 < float(match[0][1:]) <= 12 for match in _BARE.finditer(text)
    ):
        return ()
    orbits = str(record.get("task")) in ("PerformOrbit", "GlareFreeApproach") or (
        "radius" in text and "square" not in text
    )
    text = _SAY_AGAIN.sub(r"\g<v>", explained(without_asides(text)))
    if _TAKEN_BACK.search(text) or _PAIR_OR_TWO.search(text):
        return None
    try:
        counted = sorted(counted_turns(text), key=lambda one: one.start)
        text = f.without(
            blank(text, ((one.start, one.end) for one in counted)),
            (f.COUNTED, f.ARC, f.SENSED, f.SIDES_OF_THINGS, f.YAW, f.RUN),
        )
        found = _same_again(
            text, sorted([*counted, *read_angles(text, orbits=orbits)], key=lambda one: one.start)
        )
    except Uncertain:
        return None
    if any(one.turns[0][0] == ROTATE for one in counted):
        text = _AROUND.sub(f.mask, text)
    rest = blank(text, ((_from_verb(text, one.start), one.end) for one in found))
    if not found or _left_over(rest) or not _orderly(text, found):
        return None
    turns = tuple(turn for one in _without_notes(found) for turn in one.turns)
    return turns if len(turns) <= MOST else None


def _same_again(text: str, found: list[Found]) -> list[Found]:
    """The rotations, and those that the text gives as another one's size: "and as much to
    starboard".
    """
    for match in a.SAME_TO.finditer(text):
        last = next((one for one in reversed(found) if one.end <= match.start()), None)
        if (
            last is None
            or len(last.turns) != 1
            or last.turns[0][0] != NUDGE
            or any(match.start() <= one.start < match.end() for one in found)
        ):
            raise Uncertain
        side = match["side"] or match["back"]
        value = f.sign(side) * abs(last.turns[0][1]) if side else -last.turns[0][1]
        found = sorted(
            [*found, Found(match.start(), match.end(), ((NUDGE, value),))],
            key=lambda one: one.start,
        )
    return found


def _without_notes(found: list[Found]) -> list[Found]:
    """The rotations without those that are mentioned once more in passing: "slices while facing
    090".
    """
    said = [turn for one in found if not one.side_note for turn in one.turns]
    return [
        one for one in found if not (one.side_note and len(one.turns) == 1 and one.turns[0] in said)
    ]


def _from_verb(text: str, start: int) -> int:
    """Where the words begin that lead to a rotation."""
    lead = a.LEADING.search(text[:start])
    return lead.start() if lead else start


def _left_over(rest: str) -> bool:
    """Whether words that may speak of another rotation are not read."""
    rest = w.LOCKED.sub(" ", rest)
    return (
        any(pattern.search(rest) for pattern in (_BARE_VERB, _ONE_OR_MORE))
        or _LONE_SIDE.search(f.WAYPOINTS.sub(" ", rest)) is not None
    )


# ---------------------------------------------------------------- in which order

_BEFORE = f.compiled(
    r"\b(?:before(?! [^,.;:]*:)(?! (?:the next|each|every)\b)|prior to|ahead of|preceded by|"
    r"(?<!wait )(?<!hold )(?<!stay )(?<!waiting )(?<!remain )(?<!settle )until)\b"
)
_AFTER = f.compiled(
    r"\b(?:after(?! (?:that|this|which)\b)|once(?! (?:round|more))|when|preceded|as soon as)\b"
)
_BACKWARDS = f.compiled(
    r"\b(?:but first|first though|before (?:that|this|it|them)|beforehand|before all|to begin"
    r" with|begin with|start with|ends? with|"
    r"finish(?:es)? (?:with|on)|comes? (?:first|last)|at the start|in the end|"
    r"preced\w+|in between|in that order reversed|last comes|order)\b(?<!in that order)(?<!in this"
    r" order)(?<!in order)"
)
_BEFORE_OPENS = f.compiled(r"[.;] ?(?:but )?(?:before|until|prior to)\b")
"""A sentence that begins with what comes later."""
_FIRST_BEHIND = f.compiled(r"\b(?:first|beforehand|first of all)(?=[.;]| ?$)")


def _orderly(text: str, found: list[Found]) -> bool:
    """Whether the rotations run in the order in which they are said, as far as words for an order
    tell.
    """
    if len(found) < 2:
        return True
    if _BACKWARDS.search(text):
        return False
    if any(
        any(one.start < match.start() for one in found) for match in _BEFORE_OPENS.finditer(text)
    ):
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
    return all(
        not any(one.start < match.start() for one in found[1:])
        for match in _FIRST_BEHIND.finditer(text)
    )
