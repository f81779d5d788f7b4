"""Values and positions that are said far from their task: stated once ahead, in brackets, at the
end, or put right later.
"""

from __future__ import annotations

import re
from random import Random

from planner_ft.data.mission.synthetic.commands_format import Line
from planner_ft.data.mission.synthetic.composed_wishes import (
    VALUE,
    Wish,
    chosen,
    clauses,
    draw_ending,
    draw_titles,
    may_say_it,
    new_wish,
    phrases,
)

SHARED = {
    "radius": ("SurveyTarget", "PerformOrbit", "SurveyTarget"),
    "duration": ("KeepStation", "DriftAudit", "FeatureStare"),
    "sectors": ("HorizontalPanorama",),
    "speed": ("PerformOrbit", "ParallelStructurePass"),
    "distance": ("ParallelStructurePass",),
}
SHARED_WEIGHTS = (40, 32, 10, 8, 10)
ALONE = {
    "radius": "at {radius}",
    "duration": "for {duration}",
    "sectors": "in {sectors} sectors",
    "speed": "at {speed}",
    "distance": "{distance} off",
}
JOINTS = (
    ", then ",
    " and then ",
    ", ",
    ". Then ",
    "; ",
    ", after that ",
    ". After that, ",
    ", and after that ",
)
NOUN_SHARE, NOUN_OPENINGS = (
    0.2,
    ("I want ", "We need ", "I'd like ", "", "On the list: ", "Today's programme: ", "Wanted: "),
)
NOUN_JOINTS = (", then ", " and then ", ", after that ", ", followed by ", "; then ")
ORDINALS = (
    ("the first", "the second", "the third"),
    ("the former", "the latter"),
    ("the first one", "the last one"),
)


def chained(rng: Random, wishes: list[Wish], last: str = "", *, nouns: float = NOUN_SHARE) -> str:
    """The clauses in the order of execution; `last` is the place that was spoken of before, `nouns`
    the share of "I want the lap round ...".
    """
    mood = "np" if rng.random() < nouns else "imp"
    text = rng.choice(NOUN_OPENINGS) if mood == "np" else ""
    joints = NOUN_JOINTS if mood == "np" else JOINTS
    for index, wish in enumerate(wishes):
        again = bool(wish.place) and wish.place == last and may_say_it(wish) and rng.random() < 0.75
        told = wish.tell(rng, mood, "it" if again else None)
        joint = rng.choice(joints)
        text += (joint if index else "") + told
        last = wish.place
    return text


def stated_apart(rng: Random, wishes: list[Wish]) -> str:
    """The values of the wishes that are told apart, as a sentence of their own or in brackets; ""
    where there are none.
    """
    stated = statements(rng, [wish for wish in wishes if wish.apart])
    if not stated:
        return ""
    opening = rng.choice(
        (
            "",
            "",
            "",
            "Figures: ",
            "The numbers: ",
            "Details: ",
            "To be exact: ",
            "As for the figures: ",
        )
    )
    text = ("" if len(stated) == 1 else opening) + rng.choice((", ", "; ")).join(stated)
    return f" {text}." if rng.random() < 0.75 else f" ({text[0].upper()}{text[1:]}.)"


def statements(rng: Random, wishes: list[Wish]) -> list[str]:
    """One short statement per value, "12 m for the lap"."""
    told = []
    ordinals = rng.choice(ORDINALS) if rng.random() < 0.25 and len(wishes) == 2 else ()
    for index, wish in enumerate(wishes):
        name = ordinals[index] if ordinals else wish.call(rng)
        for base in VALUE.findall(wish.values):
            told.append(
                wish.numbered(chosen(rng.choice(phrases("values")["stated"][base]), rng)).replace(
                    "X", name
                )
            )
    if rng.random() < 0.3:
        rng.shuffle(told)
    return told


def _valued(rng: Random, number: int, title: str) -> Wish:
    """A wish that has a value."""
    while True:
        wish = new_wish(rng, number, title)
        if VALUE.search(wish.values):
            return wish


def _with_values(title: str) -> bool:
    return any(VALUE.search(text) for text in clauses()[title]["with"])


def tell_apart(rng: Random) -> tuple[str, list[Wish]]:
    """Things to do, then their figures; now and then the figures come first."""
    titles = [title for title in draw_titles(rng, rng.choice((2, 3, 4))) if _with_values(title)][
        :3
    ] or ["BathymetryGridSurvey"]
    wishes = [_valued(rng, number, title) for number, title in enumerate(titles, 1)]
    for wish in wishes:
        wish.apart = True
    if rng.random() < 0.25:
        text = chained(rng, wishes, nouns=0)
        lead = rng.choice(("; ", ", ")).join(statements(rng, wishes))
        return (
            (
                f"{lead}:"
                f" {rng.choice(('those are the figures. Now', 'bear that in mind, then', 'noted? Then', 'with these'))}"
                f" {text}."
            ),
            wishes,
        )
    return f"{chained(rng, wishes)}.{stated_apart(rng, wishes)}", wishes


def tell_shared(rng: Random) -> tuple[str, list[Wish]]:
    """One value for everything, ahead, in brackets or at the end."""
    base = rng.choices(tuple(SHARED), SHARED_WEIGHTS)[0]
    wishes = []
    for number in range(1, rng.choice((2, 2, 3)) + 1):
        wish = new_wish(rng, number, rng.choice(SHARED[base]), shared={base: 1})
        wish.values, wish.apart = ALONE[base], True
        wishes.append(wish)
    text = chained(rng, wishes)
    roll = rng.random()
    kind = "ahead" if roll < 0.4 else "shared"
    stated = chosen(rng.choice(phrases("values")[kind][base]), rng)
    for wish in wishes:
        stated_now = wish.numbered(stated)
    if kind == "ahead":
        return f"{stated_now} {text}.", wishes
    return (
        f"{text} ({stated_now})."
        if roll < 0.55
        else f"{text}, {stated_now}."
        if roll < 0.75
        else f"{text}. {stated_now}."
    ), wishes


def tell_placed(rng: Random) -> tuple[str, list[Wish]]:
    """Where a thing lies is said in a sentence of its own."""
    wishes = [
        new_wish(rng, number, title)
        for number, title in enumerate(_placed_titles(rng, rng.choice((1, 1, 2))), 1)
    ]
    for wish in wishes:
        wish.place, wish.shared = f"T{wish.number}", {"position": wish.number}
        wish.apart = bool(wish.values) and rng.random() < 0.3
    more = _placed_titles(rng, 1)[0]
    told = list(wishes)
    if len(wishes) == 1 and more != wishes[0].title and rng.random() < 0.6:
        told.append(new_wish(rng, 5, more, place="T1", shared={"position": 1}))
    before = len(wishes) == 1 and rng.random() < 0.4
    text = chained(rng, told, wishes[0].place if before else "")
    where = [_where(rng, wish, "before" if before else "after") for wish in wishes]
    if before:
        return f"{where[0]} {text}.{stated_apart(rng, told)}", told
    if len(where) == 1 and rng.random() < 0.25:
        beside = (
            chosen(rng.choice(phrases("values")["place"]["beside"]), rng)
            .replace("{name}", "{bare T1}")
            .replace("{P}", "{P1}")
        )
        return f"{text.replace('{T1}', beside, 1)}.{stated_apart(rng, told)}", told
    return f"{text}.{stated_apart(rng, told)} {' '.join(where)}", told


def _where(rng: Random, wish: Wish, kind: str) -> str:
    text = chosen(rng.choice(phrases("values")["place"][kind]), rng)
    return text.replace("{name}", f"{{bare T{wish.number}}}").replace("{P}", f"{{P{wish.number}}}")


def _placed_titles(rng: Random, count: int) -> list[str]:
    return rng.sample(
        [title for title, entry in clauses().items() if entry["at"] in ("T", "TP")], count
    )


def tell_corrected(rng: Random) -> tuple[str, list[Wish]]:
    """A value is put right after other things have been said."""
    base = rng.choice(("radius", "duration", "duration", "sectors", "distance"))
    first = new_wish(rng, 1, rng.choice(SHARED[base]))
    first.values = ALONE[base]
    second = new_wish(rng, 2, next(title for title in draw_titles(rng, 2) if title != first.title))
    wishes = [first, second] if rng.random() < 0.7 else [second, first]
    text = re.sub(rf"\{{{base}1( adj)?\}}", rf"{{~{base}1\1}}", chained(rng, wishes))
    put_right = first.numbered(
        chosen(rng.choice(phrases("values")["corrected"][base]), rng)
    ).replace("X", first.call(rng))
    return f"{text}. {put_right}", wishes


def tell_dropped(rng: Random) -> tuple[str, list[Wish], list[Line]]:
    """One of several things is taken back, or two are swapped."""
    dropped = phrases("values")["dropped"]
    if rng.random() < 0.35:
        wishes = [
            new_wish(rng, number, title) for number, title in enumerate(draw_titles(rng, 2), 1)
        ]
        return (
            (
                f"{wishes[0].tell(rng, 'imp')}, then {wishes[1].tell(rng, 'imp')}."
                f" {rng.choice(dropped['swapped'])}"
            ),
            wishes[::-1],
            [],
        )
    wishes = [
        new_wish(rng, number, title)
        for number, title in enumerate(draw_titles(rng, rng.choice((2, 3))), 1)
    ]
    if rng.random() < 0.5:
        wishes.append(draw_ending(rng, 8))
    text = chained(rng, wishes)
    out = wishes.pop(int(rng.random() * len(wishes)))
    return (
        f"{text}. {chosen(rng.choice(dropped['any']), rng).replace('X', out.call(rng))}",
        wishes,
        [Line("Not", (out.title,))],
    )
