"""How a command speaks of its targets: in full at first, with a pronoun or a short form later."""

from __future__ import annotations

from random import Random

from planner_ft.data.mission.synthetic.intents import Target
from planner_ft.data.mission.synthetic.numbers import Style
from planner_ft.data.mission.synthetic.positions import position_words, say_position

VOWELS = "aeiouAEIOU"


def name_of(target: Target) -> str:
    """The target as the plan's texts call it: "the green barrel at [45, 10]" without the place."""
    if target.description is None:
        return target.identity or position_words(target.position or (0, 0))
    return f"the {target.description}" if target.article else target.description


def indefinite(text: str) -> str:
    """`text` with "a" or "an"."""
    return f"{'an' if text[0] in VOWELS else 'a'} {text}"


def plural(text: str) -> str:
    """The noun for more than one."""
    if text.endswith("y") and text[-2] not in "aeiou":
        return f"{text[:-1]}ies"
    return f"{text}es" if text.endswith(("s", "x", "ch", "sh")) else f"{text}s"


def full_mention(
    target: Target,
    rng: Random,
    style: Style,
    *,
    clipped: bool = False,
    spoken: bool = False,
    wrong: str = "",
) -> str:
    """The target as it is first spoken of, with its place; `clipped` drops the article, `wrong` is
    said and put right first.
    """
    if target.identity is not None:
        return spoken_identity(target)
    if target.position is None:
        text = wrong + described(target, rng, clipped=clipped)
        return f"{text} {target.whereabouts}" if target.whereabouts else text
    place = wrong + say_position(target.position, rng, style, spoken=spoken)
    if target.description is None:
        bracketed = place[0] in "[("
        return (
            place
            if bracketed or rng.random() < 0.8
            else (
                f"{rng.choice(('position', 'the point', 'grid', 'waypoint', 'the spot', 'the position', 'point'))}"
                f" {place}"
            )
        )
    text = described(target, rng, clipped=clipped)
    if target.doubtful:
        return rng.choice(DOUBTS).format(text=text, place=place)
    return rng.choice(PLACED).format(text=text, place=place)


def spoken_identity(target: Target) -> str:
    """The id as it is said: "call sign Tern 5" where the plan holds "Tern 5"."""
    return f"{target.said_as} {target.identity}" if target.said_as else str(target.identity)


def described(target: Target, rng: Random, *, clipped: bool = False) -> str:
    """The description with its article, as the operator writes it."""
    text = target.said_as or target.description or ""
    if clipped or not target.article:
        return text
    return f"the {text}" if rng.random() < 0.985 else f"that {text}"


PLACED = (
    *("{text} at {place}",) * 20,
    "{text} ({place})",
    "{text}, which is at {place},",
    "{text} lying at {place}",
    "{text} over at {place}",
    "{text} out at {place}",
    "{text} at position {place}",
    "{text}, at {place},",
    "{text} located at {place}",
)
DOUBTS = (
    "{text} somewhere near {place}",
    "{text} at about {place}",
    "{text} around {place}",
    "{text} at roughly {place}",
    "{text}, at {place} if I remember right,",
    "{text}, which should be at {place},",
    "{text} at {place}, I think,",
    "{text}, probably at {place},",
    "{text} at {place} or thereabouts",
    "{text}, at {place} more or less,",
)


def short_mention(target: Target, rng: Random, style: Style, *, spoken: bool = False) -> str:
    """A target of before, spoken of again when something else came between."""
    if target.identity is not None:
        return spoken_identity(target)
    if target.description is None:
        return say_position(target.position or (0, 0), rng, style, spoken=spoken)
    text = target.description
    if target.noun and rng.random() < 0.15 and not target.area:
        text = target.noun if target.article else text
    return f"the {text}" if target.article else text


AREA_AGAIN = (
    "its centre",
    "the centre of the area",
    "the centre of the grid",
    "the middle of it",
    "the centre point",
    "that same centre point",
    "the centre of the survey",
)
TRACK_AGAIN = (
    "the start of the track",
    "the start point",
    "where the track began",
    "the starting point",
    "the start of the cable run",
    "the beginning of the track",
)
