"""The steps that a scope means by the number of a movement: "on the second leg", "in steps 2 and
3", "from the third point onwards", "in all but the last".
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from planner_ft.decoding.constraints.reading.rows.movement_rows import Row
from planner_ft.decoding.constraints.reading.scopes import scope_words as w
from planner_ft.decoding.constraints.reading.scopes import step_scope_words as s
from planner_ft.decoding.constraints.reading.scopes.step_kinds import kinds_of, units_of
from planner_ft.decoding.constraints.reading.scopes.where import Anchor, Phrase, Where, at


def numbered(phrase: Phrase) -> Where | None:
    """ "In step 2", "at waypoints 1 and 3"."""
    row, noun = (
        phrase.row,
        re.sub(r"^(?:w(?:pt|p)s?|marks?|waypoints?|points?)$", "points", phrase.noun or ""),
    )
    places, numbers = units_of(row, kinds_of(noun)), _cardinals(phrase.group("cards") or "")
    if any(number >= len(places) for number in numbers) or not _singles(row, places):
        return None
    return at([places[number] for number in numbers])


def ordinal(phrase: Phrase) -> Where | None:
    """ "On the second leg", "in the first and the last"."""
    before, behind_several = (
        phrase.before,
        bool(phrase.before) and phrase.before[-1].kind == "several",
    )
    again = _again(phrase, before[-1]) if before else None
    return again or _nth(
        phrase, None if phrase.group("noun") is None and behind_several else phrase.last
    )


def several(phrase: Phrase) -> Where | None:
    """ "In the last two steps"."""
    places, many = (
        units_of(phrase.row, kinds_of(phrase.noun or "")),
        w.COUNTS[phrase.group("count") or ""],
    )
    fits = len(places) > many and _singles(phrase.row, places)
    return (
        at(places[:many] if phrase.group("side") == "first" else places[-many:]) if fits else None
    )


def outer(phrase: Phrase) -> Where | None:
    """ "On the outer leg": the first of two."""
    places = units_of(phrase.row, kinds_of(phrase.noun or ""))
    return at([places[0 if phrase.group("side") == "outer" else 1]]) if len(places) == 2 else None


def beyond(phrase: Phrase) -> Where | None:
    """ "From the second point onwards", "once (4, 5) is reached"."""
    row, ords = phrase.row, phrase.group("ords")
    if "@" in phrase.words:
        reached = [
            index
            for index in phrase.goes
            if row.units[index].single and row.units[index].place == phrase.place
        ]
    else:
        reached = _numbered(row, "points", ords) if ords else []
    return at(range(reached[0] + 1, phrase.count)) if len(reached) == 1 else None


def since(phrase: Phrase) -> Where | None:
    """ "From the second leg on"."""
    first = _numbered(phrase.row, phrase.noun or "", phrase.group("ords"))
    return at(range(first[0], phrase.count)) if len(first) == 1 else None


def all_but(phrase: Phrase) -> Where | None:
    """ "In all holds but the last"."""
    row, cards = phrase.row, phrase.group("cards")
    noun = phrase.group("all") or phrase.noun or "step"
    among = units_of(row, kinds_of(noun))
    barred = (
        [among[number] for number in _cardinals(cards) if number < len(among)]
        if cards
        else _numbered(row, noun, phrase.group("ords"))
    )
    return _less(among, barred)


def everywhere_except(phrase: Phrase) -> Where | None:
    """ "Throughout except on the turn"."""
    row, noun, ords = phrase.row, phrase.noun or "", phrase.group("ords")
    gerund = next((name for name in s.GERUNDS if phrase.group(name)), None)
    barred = units_of(row, s.GERUNDS[gerund] if gerund else kinds_of(noun))
    if ords:
        barred = _numbered(row, noun, ords)
    elif not gerund and len(barred) > 1 and not noun.endswith("s"):
        barred = []
    return _less(range(phrase.count), barred)


def _less(among: Sequence[int], barred: Sequence[int]) -> Where | None:
    """Movements without some of them, if any are named and any are left."""
    return at(frozenset(among) - frozenset(barred)) if barred else None


def _singles(row: Row, units: Sequence[int]) -> bool:
    """Whether each of some movements is one step."""
    return all(row.units[index].single for index in units)


def _cardinals(words: str) -> list[int]:
    """The numbers of "2 and 3", from nought."""
    return [w.CARDINAL[word] for word in re.findall(r"\w+", words) if word in w.CARDINAL]


def _numbered(
    row: Row, noun: str, ords: str | None, among: Sequence[int] | None = None
) -> list[int]:
    """The movements that ordinals name among those of a noun."""
    places = list(among) if among is not None else units_of(row, kinds_of(noun))
    if ords is None:
        return places if len(places) == 1 else []
    if "middle" in ords and (len(places) % 2 == 0 or len(places) < 3):
        return []
    numbers = [
        len(places) // 2 if word == "middle" else w.ORDINAL[word]
        for word in re.findall(rf"\b(?:{w.ORD}|middle)\b", ords)
    ]
    if not _singles(row, places) or any(
        not -len(places) <= number < len(places) for number in numbers
    ):
        return []
    return [places[number] for number in numbers]


def _again(phrase: Phrase, last: Anchor) -> Where | None:
    """ "In the first hold ...; in the second ...": the noun that was said before."""
    noun = re.search(rf" ({s.NOUN})(?: only| alone)?$", phrase.said.text[last.start : last.end])
    if (
        phrase.group("noun") is not None
        or last.kind != "ordinal"
        or noun is None
        or not noun[1].isalpha()
        or noun[1].startswith("one")
    ):
        return None
    return at(_numbered(phrase.row, noun[1], phrase.group("ords")))


def _nth(phrase: Phrase, last: Where | None) -> Where | None:
    """The movements that ordinals name, among those of their noun or of what was spoken of
    `last`.
    """
    row, noun, ords = phrase.row, phrase.group("noun"), phrase.group("ords")
    if noun is None or noun.startswith(("one", "of ")):
        among = _spoken_of(phrase, last)
        return at(_numbered(row, "", ords, among)) if among and (noun or len(among) > 1) else None
    kinds = kinds_of(noun)
    if kinds == s.ANY and any(unit.chained and unit.kind == s.FACE for unit in row.units):
        # "The first part" may be all turns of a list.
        return None
    return at(_numbered(row, noun, ords)) if len(units_of(row, kinds)) > 1 else None


def _spoken_of(phrase: Phrase, last: Where | None) -> list[int]:
    """What "the second" is the second of: several movements spoken of at once, else all of them if
    they are of one kind; none where that is not told.
    """
    words = (phrase.group("noun") or "").split()
    number = next((value for word, value in w.COUNTS.items() if word in words), None)
    everything = list(range(phrase.count))
    if number == phrase.count:
        return everything
    among = sorted(last.units) if last and last.units and len(last.units) > 1 else everything
    kinds = phrase.kinds_at(among)
    return among if len(kinds) <= 1 or kinds <= s.TURNS else []
