"""Commands whose order of telling is not the order of doing: "before you do that ...", "leave it
for last".
"""

from __future__ import annotations

import re
from functools import cache
from itertools import pairwise
from random import Random

from planner_ft.data.mission.synthetic.composed_values import stated_apart
from planner_ft.data.mission.synthetic.composed_wishes import (
    AUXILIARIES,
    Wish,
    chosen,
    clauses,
    draw_ending,
    draw_titles,
    may_say_it,
    new_wish,
    phrases,
)

TAG = re.compile(r"<([A-DZ]) (imp|ger|np|done|call|got|has|is|tobe)>")
TURNED, SAME_PLACE, DOUBLE, AROUND, APART = 0.8, 0.25, 0.2, 0.25, 0.12


@cache
def frames(*, turned: bool) -> tuple[tuple[str, bool], ...]:
    """The frames in which the first thing is (not) said first, and whether other sentences may
    stand around each.
    """
    found = (
        (frame, name == "open") for name in ("open", "whole") for frame in phrases("orders")[name]
    )
    return tuple(
        (frame, is_open)
        for frame, is_open in found
        if turned == (frame.find("<A") > frame.find("<B"))
    )


def tell_order(rng: Random) -> tuple[str, list[Wish]]:
    """The text of a command with slots, and its wishes in the order of execution."""
    pool = frames(turned=rng.random() < TURNED)
    frame, is_open = pool[int(rng.random() * len(pool))]
    frame = chosen(frame, rng)
    letters = sorted({match[1] for match in TAG.finditer(frame)})
    wishes = _wishes(rng, len(letters))
    groups = {letter: [wish] for letter, wish in zip(letters, wishes, strict=True)}
    if "<A np>" not in frame and wishes[0].place and rng.random() < DOUBLE:
        groups["A"] = [*groups["A"], _beside(rng, wishes[0], 7)]
    if rng.random() < APART:
        for wish in wishes:
            wish.apart = bool(wish.values)
    text = _filled(rng, frame, groups)
    told = [wish for letter in letters for wish in groups[letter]]
    if is_open and rng.random() < AROUND:
        text, told = _around(rng, text, told)
    return text + stated_apart(rng, told), told


def _wishes(rng: Random, count: int) -> list[Wish]:
    """In the order of execution: a check may open, a return, report or upload may end."""
    wishes = [
        new_wish(rng, number, title) for number, title in enumerate(draw_titles(rng, count), 1)
    ]
    if rng.random() < 0.16:
        wishes[0] = new_wish(rng, 1, "Diagnostics" if rng.random() < 0.75 else "SmartDataHarvest")
    if rng.random() < 0.34:
        wishes[-1] = draw_ending(rng, count)
        if wishes[0].title == wishes[-1].title:
            wishes[0] = new_wish(rng, 1, "Diagnostics")
    for before, wish in pairwise(wishes):
        if may_share(before, wish) and rng.random() < SAME_PLACE:
            wish.place = before.place
    return wishes


def may_share(first: Wish, second: Wish) -> bool:
    """Whether both can be done at the first one's place."""
    return (
        first.place.startswith("T")
        and ":" not in first.place
        and clauses()[second.title]["at"] in ("T", "TP")
    )


def _beside(rng: Random, wish: Wish, number: int) -> Wish:
    """Another thing to do, at the same place if possible."""
    while True:
        other = new_wish(rng, number, draw_titles(rng, 1)[0])
        if other.title != wish.title:
            break
    if may_share(wish, other):
        other.place = wish.place
    return other


def _filled(rng: Random, frame: str, groups: dict[str, list[Wish]]) -> str:
    last: list[str] = []
    repeated = len(TAG.findall(frame)) > len(groups)

    def tell(match: re.Match[str]) -> str:
        if match[2] == "call":
            return groups[match[1]][0].call(rng)
        clauses_told = []
        for wish in groups[match[1]]:
            again = (
                bool(last)
                and wish.place == last[-1]
                and may_say_it(wish)
                and not repeated
                and match[2] not in AUXILIARIES
            )
            clauses_told.append(
                wish.tell(rng, match[2], "it" if again and rng.random() < 0.8 else None)
            )
            last.append(wish.place)
        return _joined(rng, clauses_told, match[2])

    return TAG.sub(tell, frame)


def _joined(rng: Random, told: list[str], mood: str) -> str:
    return (
        told[0]
        if len(told) == 1
        else (
            f"{told[0]}{' and then ' if mood == 'imp' and rng.random() < 0.6 else ' and '}{told[1]}"
        )
    )


def _around(rng: Random, text: str, told: list[Wish]) -> tuple[str, list[Wish]]:
    """With a sentence before or after it, for something done before or after all that."""
    if rng.random() < 0.5 and told[0].title != "Diagnostics":
        wish = (
            new_wish(rng, 9, "Diagnostics")
            if rng.random() < 0.25
            else new_wish(rng, 9, draw_titles(rng, 1)[0])
        )
        frame = chosen(rng.choice(phrases("orders")["before"]), rng)
        return _filled(rng, frame, {"Z": [wish]}) + text, [wish, *told]
    used = {wish.title for wish in told}
    wish = draw_ending(rng, 9)
    if used & {"Home", "DockingApproach", "VisualDockingApproach", wish.title}:
        return text, told
    return text + _filled(
        rng, chosen(rng.choice(phrases("orders")["after"]), rng), {"Z": [wish]}
    ), [*told, wish]
