"""What the scopes of a text mean: the movements of its row, kinds of movement, or every other
waypoint of a survey square.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

from planner_ft.decoding.constraints.reading.scopes import scope_words as w
from planner_ft.decoding.constraints.reading.scopes import step_kinds, step_numbers
from planner_ft.decoding.constraints.reading.scopes import step_scope_words as s
from planner_ft.decoding.constraints.reading.scopes.where import (
    EVERYWHERE,
    Phrase,
    Where,
    at,
    the_one,
)


def meaning(phrase: Phrase) -> Where | None:
    """The steps that a scope means; None where it is not read."""
    return _MEANINGS[phrase.kind](phrase)


# ---------------------------------------------------------------- all of the text, or what was told
# before


def _everywhere(phrase: Phrase) -> Where | None:
    text, begin = phrase.said.text, phrase.match.start()
    alone = any(
        not anchor.is_scope and not re.search(r"[.;]", text[anchor.end : begin])
        for anchor in phrase.before
    )
    return (
        None
        if alone and re.search(r"way|always|continuously", phrase.words) and phrase.count > 1
        else EVERYWHERE
    )


def _both(phrase: Phrase) -> Where | None:
    """ "In both": what was spoken of together, or all movements."""
    number = next((value for word, value in w.BARE_COUNTS.items() if word in phrase.words), None)
    topic = _together(phrase)
    if number not in (len(topic), None) or not (number or phrase.count > 1):
        return None
    return Where(topic, s.ANY if len(topic) == phrase.count else None)


def _each(phrase: Phrase) -> Where | None:
    """ "On each of them": the same, where they are of one kind."""
    topic = _together(phrase)
    return at(topic) if len(topic) > 1 and len(phrase.kinds_at(topic)) == 1 else None


def _together(phrase: Phrase) -> frozenset[int]:
    """Several movements that were spoken of last, else all of them."""
    last = phrase.last
    return (
        last.units
        if last and last.units and len(last.units) > 1
        else frozenset(range(phrase.count))
    )


def _ordered(phrase: Phrase) -> Where | None:
    """ "In that order": the movements of the sentence."""
    begins = max(phrase.said.text.rfind(sign, 0, phrase.match.start()) for sign in ".;!?")
    told = [index for index in phrase.passed if phrase.row.units[index].start > begins]
    return at(told) if len(told) > 1 else None


# ---------------------------------------------------------------- what was spoken of last


def _pointed(phrase: Phrase) -> Where | None:
    """ "In this hold", "in it", "meanwhile": what was spoken of last."""
    noun = phrase.noun
    if noun is None:
        sentence = phrase.match.string[: phrase.match.start()].rstrip()
        own = sentence.endswith((".", "!", "?")) and re.match(
            "meanwhile|in the meantime", phrase.words
        )
        return _sentence_before(phrase, sentence) if own else phrase.last
    kinds, many = step_kinds.kinds_of(noun), noun.endswith("s")
    last, row = phrase.last, phrase.row
    if kinds != s.ANY and many and row.of(kinds) and not noun.startswith(("pass", "cross")):
        units = (
            [index for index in last.units or () if row.units[index].kind in kinds] if last else []
        )
        return at(units) if len(units) > 1 else step_kinds.all_of(row, kinds)
    if kinds == s.ANY or last is None or last.units is None:
        return last if not many or noun.startswith("pass") else None
    return (
        step_kinds.all_of(row, kinds)
        if many and len(last.units) == 1
        else _latest(phrase, last.units, kinds)
    )


def _sentence_before(phrase: Phrase, text: str) -> Where | None:
    """A sentence of its own goes on about all of the one before, with which the text ends."""
    begins = max(text[:-1].rfind(sign) for sign in ".!?")
    told = frozenset(index for index in phrase.passed if phrase.row.units[index].start > begins)
    return Where(told, s.ANY if len(told) == phrase.count else None) if told else None


def _latest(phrase: Phrase, spoken: frozenset[int], kinds: frozenset[str]) -> Where | None:
    """Of the movements spoken of last those of some kinds, else the only earlier one."""
    units = phrase.row.units
    fitting = [
        index
        for index in spoken
        if units[index].kind in kinds or (kinds == {s.HOLD} and units[index].kind == s.VISUAL)
    ]
    return (
        at(fitting)
        if fitting
        else the_one([index for index in phrase.passed if units[index].kind in kinds])
    )


def _then(phrase: Phrase) -> Where | None:
    """ "Then", "there": the same, unless it is the place that the next movement begins at."""
    passed, units = phrase.passed, phrase.row.units
    between = bool(passed) and units[passed[-1]].kind == s.GOTO and passed[-1] + 1 < len(units)
    return None if between else _pointed(phrase)


def _onwards(phrase: Phrase) -> Where | None:
    """ "From there on"."""
    last, units = phrase.last, phrase.row.units
    if not last or not last.units:
        return None
    first = max(last.units)
    if (
        first + 1 < phrase.count
        and "there" in phrase.words
        and units[first].kind == s.GOTO
        and units[first].place
    ):
        # What begins at a place is not on the way to it.
        first += 1
    return at(range(first, phrase.count))


def _rest(phrase: Phrase) -> Where | None:
    """ "For the rest"."""
    ahead = range(max(phrase.passed) + 1, phrase.count) if phrase.passed else range(0)
    return (
        phrase.last
        if not ahead and phrase.before and phrase.before[-1].kind == "beyond"
        else at(ahead)
    )


# ---------------------------------------------------------------- ways and places


def _back(phrase: Phrase) -> Where | None:
    """ "On the way back": the last of several ways."""
    return at(phrase.goes[-1:]) if len(phrase.goes) > 1 else None


def _out(phrase: Phrase) -> Where | None:
    """ "On the way out": the first way."""
    return at(phrase.goes[:1])


def _thither(phrase: Phrase) -> Where | None:
    """ "On the way there": the only way, or the one that was told last."""
    if len(phrase.goes) == 1:
        return at(phrase.goes)
    near = [index for index in phrase.goes if phrase.row.units[index].end <= phrase.match.end()]
    return at(near[-1:]) if near and near[-1] == max(phrase.passed) else None


def _up_to(phrase: Phrase) -> Where | None:
    """ "Until (4, 5) is reached"."""
    reached = [index for index in phrase.goes if phrase.row.units[index].place == phrase.place]
    return at(range(reached[0] + 1)) if len(reached) == 1 else None


def _at_place(phrase: Phrase) -> Where | None:
    """ "At (4, 5) only", "at the last waypoint"."""
    place = phrase.place if "@" in phrase.words else None
    return the_one(
        [index for index in phrase.goes if phrase.row.units[index].place == place]
        if place
        else phrase.goes[-1:]
    )


_MEANINGS: Mapping[str, Callable[[Phrase], Where | None]] = {
    "everywhere": _everywhere,
    "both": _both,
    "each": _each,
    "ordered": _ordered,
    "that": _pointed,
    "then": _then,
    "onwards": _onwards,
    "rest": _rest,
    "kind": step_kinds.of_kind,
    "all": step_kinds.every_one,
    "while": step_kinds.meanwhile,
    "corner": step_kinds.corners,
    "numbered": step_numbers.numbered,
    "ordinal": step_numbers.ordinal,
    "several": step_numbers.several,
    "outer": step_numbers.outer,
    "beyond": step_numbers.beyond,
    "since": step_numbers.since,
    "but": step_numbers.all_but,
    "except": step_numbers.everywhere_except,
    "back": _back,
    "out": _out,
    "thither": _thither,
    "upto": _up_to,
    "place": _at_place,
}
"""What scopes mean, by how they are told (`step_scope_words.SCOPES`)."""
