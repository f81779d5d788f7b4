"""Commands about several places: one thing at all of them, the same with other figures, or each
with things of its own.
"""

from __future__ import annotations

import re
from dataclasses import replace
from random import Random
from typing import Any

from planner_ft.data.mission.synthetic.commands_text import article_for
from planner_ft.data.mission.synthetic.composed_wishes import (
    VALUE,
    Wish,
    chosen,
    clauses,
    draw_ending,
    may_say_it,
    new_wish,
    phrases,
)

EVERYWHERE = {
    "SurveyTarget": 18,
    "PerformOrbit": 15,
    "KeepStation": 14,
    "HorizontalPanorama": 11,
    "DriftAudit": 10,
    "ThermalHotspotLocalizer": 8,
    "ThermalTimeLapse": 7,
    "BoatLandingClearanceSweep": 6,
    "BathymetryGridSurvey": 6,
    "FeatureStare": 5,
    "ParallelStructurePass": 5,
    "GlareFreeApproach": 3,
}
"""How often each task is done at several places."""
NAMELESS = ("FeatureStare", "GlareFreeApproach", "BathymetryGridSurvey")
"""Tasks whose short name does not say enough: of what, of how much."""
PLACE = re.compile(r"(?:(?:at|round|around|on|of|along) )?@")
ENDING_SHARE, PASSIVE_SHARE = 0.45, 0.15
Told = tuple[str, list[Wish]]


def tell_targets(rng: Random) -> Told:
    """The text of a command with slots, and its wishes in the order of execution."""
    text, wishes = rng.choices(*_FORMS)[0](rng)
    opening = rng.choice(phrases("targets")["opening"])
    text = (
        _after(opening, text) if opening and not text.startswith(("I ", "I'd ")) else opening + text
    )
    if rng.random() < ENDING_SHARE:
        last = draw_ending(rng, 9)
        text += chosen(rng.choice(phrases("targets")["ending"]), rng).replace(
            "<Z imp>", last.tell(rng, "imp")
        )
        wishes = [*wishes, last]
    return text, wishes


def _title(rng: Random, *, but: tuple[str, ...] = ()) -> str:
    while (title := rng.choices(tuple(EVERYWHERE), tuple(EVERYWHERE.values()))[0]) in but:
        pass
    return title


def _count(rng: Random) -> int:
    return rng.choice((2, 2, 2, 2, 3, 3, 4))


def _say(rng: Random, name: str, **words: str) -> str:
    text = chosen(rng.choice(phrases("targets")[name]), rng)
    for mark, word in words.items():
        text = text.replace(mark, word)
    return text


def _after(joint: str, text: str) -> str:
    """A joint and what follows it, in small letters unless a sentence ends there."""
    return joint + (text if joint.endswith(". ") else text[:1].lower() + text[1:])


def _listed(rng: Random, places: list[str]) -> str:
    if len(places) == 2:
        return _say(rng, "two", **{"{1}": places[0], "{2}": places[1]})
    return ", ".join(places[:-1]) + _say(rng, "many") + places[-1]


def _at(wish: Wish, number: int, **changes: Any) -> Wish:
    """The same at another place, with the same values unless `changes` says which are new."""
    kind = wish.place[:1] if wish.place[:1] in ("T", "P") else "T"
    names = [*VALUE.findall(wish.values), "F", "S", "arc", "sectors"]
    return replace(
        wish,
        number=number,
        place=f"{kind}{number}",
        shared={name: wish.shared.get(name, wish.number) for name in names} | changes,
        said={},
    )


def _copies(rng: Random, wish: Wish, count: int) -> list[Wish]:
    """The wish at `count` places, some of which are positions."""
    wishes = [wish]
    for number in range(2, count + 1):
        other = _at(wish, number)
        if clauses()[wish.title]["at"] == "TP" and rng.random() < 0.2:
            other = replace(other, place=f"{'P' if other.place[0] == 'T' else 'T'}{number}")
        wishes.append(other)
    return wishes


def _said_as(wish: Wish, wishes: list[Wish]) -> list[Wish]:
    """All wishes with what was told of the first."""
    for other in wishes:
        for name in wish.said:
            other.said[name] = None
    return wishes


def _all_alike(rng: Random) -> Told:
    """One thing at all places, with the same values; now and then in an order that is said
    afterwards.
    """
    wish = new_wish(rng, 1, _title(rng))
    wishes = _copies(rng, wish, _count(rng))
    values, wish.values = wish.values, ""
    mood, opening = (
        ("got", rng.choice(("I want ", "We need ", "I'd like ", "Please get ")))
        if rng.random() < PASSIVE_SHARE
        else ("imp", "")
    )
    text = opening + wish.tell(
        rng, mood, _listed(rng, [other.place_words(rng) for other in wishes])
    )
    if values and not wish.said:
        text += (
            " "
            + wish.numbered(values)
            + (
                f" {_say(rng, 'each')}"
                if rng.random() < 0.45 and VALUE.search(values) and "each" not in values
                else ""
            )
        )
    _said_as(wish, wishes)
    if rng.random() < 0.3 and not re.search(r"\b(?:then|finally|after)\b", text):
        return _reordered(rng, text, wishes)
    return f"{text}.", wishes


def _reordered(rng: Random, text: str, wishes: list[Wish]) -> Told:
    if rng.random() < 0.35:
        return f"{text}{_say(rng, 'turned')}.", wishes[::-1]
    index = int(rng.random() * (len(wishes) - 1)) + 1
    if rng.random() < 0.5:
        return f"{text}{_say(rng, 'first_of_two', Y=f'{{{wishes[index].place}}}')}.", [
            wishes[index],
            *wishes[:index],
            *wishes[index + 1 :],
        ]
    last = index - 1
    return f"{text}{_say(rng, 'last_of_many', Y=f'{{{wishes[last].place}}}')}.", [
        *wishes[:last],
        *wishes[last + 1 :],
        wishes[last],
    ]


def _valued(rng: Random, *, plain: bool = False) -> Wish:
    """A wish with values; `plain` with a single one."""
    while True:
        wish = new_wish(rng, 1, _title(rng))
        found = VALUE.findall(wish.values)
        if found and not (plain and (len(found) > 1 or wish.values.startswith("("))):
            return wish


def _own_values(rng: Random) -> Told:
    """The same thing, every place with its own values: "hold at A for 3 min and at B for 5"."""
    first = _valued(rng)
    others = [
        replace(first, number=number, place=f"{first.place[0]}{number}", said={})
        for number in range(2, _count(rng) + 1)
    ]
    form = _form_without_values(rng, first)
    placed = PLACE.search(form)
    assert placed is not None
    parts = [first.numbered(f"{form} {first.values}".replace("@", first.place_words(rng)))]
    for wish in others:
        wish.said |= {
            name.replace("1", str(wish.number)): None for name in first.said if name[0] in "FS"
        }
        parts.append(
            wish.numbered(f"{placed[0]} {wish.values}".replace("@", wish.place_words(rng)))
        )
    _own_parts(first, others)
    joint = rng.choice((", ", ", ", "; ", ", then "))
    return (
        (
            f"{joint.join(parts[:-1])}{rng.choice((' and ', ' and then ', ', then ', ', and '))}{parts[-1]}."
        ),
        [first, *others],
    )


def _own_parts(first: Wish, others: list[Wish]) -> None:
    """A feature or side that is said once holds for all."""
    for wish in others:
        for name in [name for name in wish.said if name[0] in "FS"]:
            del wish.said[name]
        for name in first.said:
            if name[0] in "FS":
                wish.said[name] = None


def _form_without_values(rng: Random, wish: Wish) -> str:
    while True:
        form = chosen(rng.choice(clauses()[wish.title]["imp"]), rng)
        if not VALUE.search(form):
            return form


def _respectively(rng: Random) -> Told:
    """Places first, their values after: "at A, B and C for 2, 4 and 6 minutes respectively"."""
    first = _valued(rng, plain=True)
    wishes = [
        first,
        *(
            replace(first, number=number, place=f"{first.place[0]}{number}", said={})
            for number in range(2, rng.choice((2, 2, 3)) + 1)
        ),
    ]
    base = VALUE.findall(first.values)[0]
    form = _form_without_values(rng, first)
    values = [wish.numbered(f"{{{base}}}") for wish in wishes]
    places = [wish.place_words(rng) for wish in wishes]
    text = first.numbered(form.replace("@", f"{', '.join(places[:-1])} and {places[-1]}"))
    _own_parts(first, wishes[1:])
    listed = first.values.replace(
        f"{{{base}}}", f"{', '.join(values[:-1])} and {values[-1]}"
    ).lstrip(", ")
    return (
        (
            f"{text},"
            f" {listed}{rng.choice((' respectively', ', respectively', ', in that order', ''))}."
        ),
        wishes,
    )


def _same_at(rng: Random) -> Told:
    """One or two things at the first place, "the same at" the next, perhaps with another value."""
    wishes = [_valued(rng)]
    if rng.random() < 0.35:
        second = new_wish(rng, 3, _title(rng, but=(wishes[0].title, *NAMELESS)))
        second.place = (
            wishes[0].place
            if may_say_it(wishes[0]) and clauses()[second.title]["at"] != "P"
            else second.place
        )
        wishes = [*wishes, second] if second.place == wishes[0].place else wishes
    text = wishes[0].tell(rng, "imp") + "".join(
        f"{rng.choice((' and ', ', then ', ' and then '))}{wish.tell(rng, 'imp', 'it')}"
        for wish in wishes[1:]
    )
    again = [
        replace(_at(wish, wish.number), place=f"{wishes[0].place[0]}2", said=dict(wish.said))
        for wish in wishes
    ]
    changed = ""
    values = [name for name in wishes[0].said if VALUE.fullmatch("{" + name.rstrip("0123456789"))]
    if len(wishes) == 1 and values and rng.random() < 0.4:
        changed, again = _with_one_changed(rng, wishes[0], again, rng.choice(values))
    same = _after(_say(rng, "joint"), _say(rng, "same", Y=f"{{{again[0].place}}}"))
    return f"{text}{same}{changed}.", [*wishes, *again]


def _with_one_changed(
    rng: Random, wish: Wish, again: list[Wish], name: str
) -> tuple[str, list[Wish]]:
    base = name.rstrip("0123456789")
    ways = {
        "duration": "for {}",
        "radius": "at {}",
        "distance": "at {}",
        "sectors": "in {} sectors",
        "speed": "at {}",
        "overlap": "with {} overlap",
    }
    if base not in ways:
        return "", again
    new = f"{base}2"
    said: dict[str, None] = {new if other == name else other: None for other in wish.said}
    return _say(rng, "but", V=ways[base].format(f"{{{new}}}")), [replace(again[0], said=said)]


def _blocks(rng: Random) -> Told:
    """Place by place, each with one to three things of its own."""
    told: list[Wish] = []
    parts: list[str] = []
    number = 0
    for block in range(1, rng.choice((2, 2, 3)) + 1):
        place = f"{'T' if rng.random() < 0.75 else 'P'}{block}"
        block_wishes: list[Wish] = []
        for _ in range(rng.choice((1, 1, 2, 2, 3)) if place[0] == "T" else rng.choice((1, 2))):
            number += 1
            block_wishes.append(
                _at_place(rng, number, place, {wish.title for wish in block_wishes})
            )
        clauses_told = ", ".join(_elliptic(rng, wish) for wish in block_wishes)
        parts.append(_say(rng, "later" if block > 1 else "block", Y=f"{{{place}}}", X=clauses_told))
        told += block_wishes
    joint = rng.choice((". ", ". ", "; "))
    return f"{parts[0]}{''.join(_after(joint, part) for part in parts[1:])}.", told


def _at_place(rng: Random, number: int, place: str, taken: set[str]) -> Wish:
    while True:
        title = _title(rng, but=tuple(taken))
        if place[0] == "T" or title in ("KeepStation", "HorizontalPanorama", "DriftAudit"):
            return new_wish(rng, number, title, place=place)
        if len(taken) >= 3:
            taken = set()


def _elliptic(rng: Random, wish: Wish) -> str:
    """The clause without its place, which was just named: "hold for 3 min", "circle it"."""
    told = wish.tell(rng, "imp", "@" if may_say_it(wish) or wish.place[0] == "P" else None)
    return re.sub(r"(\{F\d+\}) of @", r"\1 on it", told.replace(" at @", "")).replace("@", "it")


def _gapped(rng: Random) -> Told:
    """ "A needs a lap at 12 m, B a hold of 5 min": the verb stands once."""
    wishes = []
    for number in range(1, rng.choice((2, 2, 3)) + 1):
        wishes.append(
            new_wish(
                rng,
                number,
                _title(rng, but=(*NAMELESS, "ParallelStructurePass")),
                place=f"T{number}",
            )
        )
    verb = _say(rng, "needs")
    parts = []
    for index, wish in enumerate(wishes):
        name = wish.call(rng).removeprefix("the ")
        words = wish.numbered(f"{article_for(name)} {name} {wish.values}")
        parts.append(f"{{{wish.place}}} {verb if not index or rng.random() < 0.3 else ''} {words}")
    return (
        f"{rng.choice((', ', '; ', ', ')).join(parts[:-1])}{_say(rng, 'gapped')}{parts[-1]}.",
        wishes,
    )


def _at_each(rng: Random) -> Told:
    """Two things at each of several places, place by place."""
    first = new_wish(rng, 1, _title(rng, but=NAMELESS), place="T1")
    second = new_wish(rng, 2, _title(rng, but=(*NAMELESS, first.title)), place="T1")
    text = (
        f"{_elliptic(rng, first)},"
        f" {rng.choice(('then ', 'and then ', 'and '))}{_elliptic(rng, second)}"
    )
    places = [f"T{number}" for number in range(1, _count(rng) + 1)]
    listed = ", ".join(f"{{{place}}}" for place in places[:-1]) + f" and {{{places[-1]}}}"
    told = [replace(wish, place=place) for place in places for wish in (first, second)]
    ahead = rng.choice(
        (
            f"At each of {listed}: {text}.",
            f"For each of {listed}, one after the other: {text}.",
            f"{listed}. At each of them, {text}.",
        )
    )
    return ahead, told


def _by_number(rng: Random) -> Told:
    """The places are listed, then spoken of as the first, the second and so on."""
    count = rng.choice((2, 2, 3))
    wishes = [
        new_wish(rng, number, _title(rng), place=f"T{number}") for number in range(1, count + 1)
    ]
    names = rng.choice(
        (
            ("the first", "the second", "the third"),
            ("the first one", "the second one", "the last"),
            ("number one", "number two", "number three"),
        )
    )
    if count == 2 and rng.random() < 0.35:
        names = ("the former", "the latter", "")
    parts = [wish.tell(rng, "imp", name) for wish, name in zip(wishes, names, strict=False)]
    listed = ", ".join(f"{{T{number}}}" for number in range(1, count)) + f" and {{T{count}}}"
    return (
        (
            f"{_say(rng, 'listed').replace('Y', listed)}"
            f" {rng.choice((', ', '; ', ', then ', '. Then ')).join(parts)}."
        ),
        wishes,
    )


def _look_alikes(rng: Random) -> Told:
    """Two things of a kind that differ in their look: "the red one", "the other one"."""
    intro = _say(rng, "pair")
    first = _valued(rng)
    first.place = "one T1"
    if rng.random() < 0.5:
        second = replace(_at(first, 2), place="one T2")
        text = first.tell(rng, "imp")
        second.said |= first.said
        text += _after(_say(rng, "joint"), _say(rng, "same", Y=_other(rng)))
    else:
        second = new_wish(rng, 2, _title(rng, but=(first.title,)), place="one T2")
        text = f"{first.tell(rng, 'imp')}{rng.choice((', then ', '; ', '. Then ', ' and '))}{second.tell(rng, 'imp', _other(rng))}"
    for wish, place in ((first, "T1"), (second, "T2")):
        wish.place = place
    if rng.random() < 0.25:
        return (
            (
                f"{intro} {text}."
                f" {rng.choice(('But the {one T2} first.', 'Begin with the {one T2}, though.')).replace('the {', '{')}"
            ),
            [second, first],
        )
    return f"{intro} {text}.", [first, second]


def _other(rng: Random) -> str:
    return "{one T2}" if rng.random() < 0.4 else _say(rng, "other")


_FORMS = (
    (
        _all_alike,
        _own_values,
        _respectively,
        _same_at,
        _blocks,
        _gapped,
        _at_each,
        _by_number,
        _look_alikes,
    ),
    (24, 14, 7, 17, 16, 8, 7, 8, 9),
)
