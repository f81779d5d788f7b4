"""Targets, features, docking places and items: real nouns with words that suit them, names and ids;
an invented word is rare.
"""

from __future__ import annotations

import functools
import re
from pathlib import Path
from random import Random

from planner_ft.data.mission.synthetic import lexicon
from planner_ft.data.mission.synthetic.intents import Target
from planner_ft.data.mission.synthetic.lexicon_targets import (
    ADJECTIVES,
    COLOURS,
    NOUNS,
    PLACED,
    STRUCTURE_PREFIXES,
    WITH_LOOKS,
    WITH_OTHERS,
    WITH_PARTS,
)
from planner_ft.data.mission.synthetic.names import (
    LETTERS,
    call_sign,
    code,
    fill_pattern,
    person,
    place_name,
    proper_name,
    pseudo_word,
    ship_name,
)
from planner_ft.data.mission.synthetic.positions import Position, draw_position

__all__ = [
    "adjective",
    "call_sign",
    "code",
    "data_item",
    "description",
    "dock_mark",
    "dock_spot",
    "feature",
    "fill_pattern",
    "moving_thing",
    "noun",
    "person",
    "place_name",
    "proper_name",
    "pseudo_word",
    "ship_name",
    "side",
    "structure",
    "things",
    "with_phrase",
]

GROUP_OF = {noun: group for group, nouns in NOUNS.items() for noun in nouns}
GROUPS = ("mark", "vessel", "structure", "thing", "nature")
GROUP_WEIGHTS = (24, 25, 36, 12, 3)
INVENTED = 0.025
"""Share of nouns that are invented words."""
COMPOUND = 0.12
"""Share of nouns, features and data items whose first word is any thing's name, so that names are
read and not remembered: "mushroom barge".
"""
_THINGS = Path(__file__).parents[2] / "things.txt"
_MEANS_MORE = re.compile(
    r"inspect\w*|search\w*|survey\w*|scan\w*|dock\w*|berth\w*|home\w*|base\w*|(?:north|south|east|west)\w*|port|starboard|hold\w*|drift\w*|film\w*|test\w*|check\w*|"
    r"track\w*|circ\w*|orbit\w*|level|second|left|right|hot\w*|therm\w*|temp\w*|glare|sonar|depth|sound\w*|report\w*|log|record\w*|half|quarter|double|single|once|"
    r"round|full|whole|dead|moving|missing|lost|stray|near\w*|far\w*|next|last|first"
)
"""Words of orders, numbers and directions: no part of a name without more."""
ITEMS = tuple(item for item in lexicon.DATA_ITEMS if "report" not in item and item != "summary")
MARKS = (
    "cross",
    "board",
    "lamp",
    "marker",
    "triangle",
    "square",
    "tag",
    "beacon",
    "disc",
    "panel",
    "diamond",
    "circle",
    "arrow",
    "stripe",
    "light",
)
MARK_LOOKS = (
    *COLOURS,
    "striped",
    "flashing",
    "chequered",
    "reflective",
    "lit",
    "upper",
    "lower",
    "big",
    "double",
    "fluorescent",
    "round",
    "infrared",
)
RECORDINGS = (
    "log",
    "pictures",
    "files",
    "scan",
    "video",
    "readings",
    "frames",
    "data",
    "stills",
    "clips",
    "photos",
    "close-ups",
    "images",
    "footage",
)
SUBJECTS = (
    "weld",
    "pile",
    "hull",
    "deck",
    "ladder",
    "mooring",
    "chain",
    "anode",
    "turbine",
    "blade",
    "seabed",
    "quay",
    "cable",
    "buoy",
    "bridge",
    "net",
    "wreck",
    "sonar",
    "LiDAR",
    "thermal",
    "radar",
    "drift",
    "wave",
    "current",
    "wind",
    "landing",
    "intake",
    "outfall",
    "crane",
    "berth",
    "pier",
    "fender",
    "sluice",
    "scour",
    "nacelle",
    "ballast",
    "battery",
    "engine",
    "GPS",
    "compass",
    "camera",
    "harbour",
    "traffic",
    "wildlife",
    "spill",
    "rudder",
    "propeller",
)
FEATURE_LOOKS = (
    "cracked",
    "bent",
    "rusty",
    "corroded",
    "loose",
    "broken",
    "damaged",
    "dented",
    "leaking",
    "torn",
    "worn",
    "missing",
    "upper",
    "lower",
    "outer",
    "inner",
    "left",
    "right",
    "forward",
    "aft",
    "main",
    "second",
    "third",
    "red",
    "white",
    "yellow",
    "blue",
    "new",
    "old",
    "painted",
    "frayed",
    "port",
    "starboard",
    "middle",
    "topmost",
    "lowest",
    "front",
    "rear",
    "northern",
    "southern",
    "big",
    "small",
    "repaired",
)
MATERIALS = frozenset(
    (
        "steel",
        "wooden",
        "concrete",
        "stone",
        "brick",
        "plastic",
        "rubber",
        "aluminium",
        "fibreglass",
        "sheet",
        "floating",
        "brick",
    )
)
ALIVE = frozenset(
    (
        "swimmer",
        "seal",
        "surfer",
        "windsurfer",
        "kite surfer",
        "paddle boarder",
        "whale",
        "dolphin pod",
        "porpoise",
        "basking shark",
        "turtle",
        "rescue swimmer",
        "open-water swimmer",
        "barge under tow",
    )
)
AFLOAT = (
    *COLOURS,
    "old",
    "small",
    "big",
    "drifting",
    "unmarked",
    "unknown",
    "suspicious",
    "white-hulled",
    "grey-hulled",
    "second",
    "nearest",
    "wooden",
    "unmanned",
    "abandoned",
    "empty",
    "Danish",
    "Dutch",
    "listing",
    "private",
    "loose",
    "slow",
    "fast",
    "unlit",
    "overloaded",
    "two-masted",
    "inbound",
    "outbound",
)


@functools.cache
def things() -> tuple[str, ...]:
    """Words that name any thing or how it looks, and nothing of an order."""
    words = dict.fromkeys(_THINGS.read_text(encoding="utf-8").split())
    return tuple(
        word
        for word in words
        if len(word) > 2 and word.isalpha() and not _MEANS_MORE.fullmatch(word)
    )


def _compound(rng: Random, head: str) -> str:
    """A thing's name before the last word of another: "mushroom barge"."""
    last = head.split()[-1]
    word = rng.choice(things())
    return head if word == last else f"{word} {last}"


def noun(rng: Random) -> str:
    """A thing on the water or ashore."""
    if rng.random() < INVENTED:
        return (
            pseudo_word(rng)
            if rng.random() < 0.6
            else f"{pseudo_word(rng)} {rng.choice(NOUNS[rng.choice(GROUPS)]).split()[-1]}"
        )
    base = rng.choice(NOUNS[rng.choices(GROUPS, GROUP_WEIGHTS)[0]])
    return _compound(rng, base) if rng.random() < COMPOUND else base


def group_of(base: str) -> str:
    """The group of a noun: mark, vessel, structure or thing."""
    if base in GROUP_OF:
        return GROUP_OF[base]
    return GROUP_OF.get(
        base.split()[-1], "vessel" if base in lexicon.MOVING_TARGETS else "structure"
    )


def adjective(rng: Random, base: str = "") -> str:
    """A word that tells one thing from another and suits the noun `base`."""
    roll = rng.random()
    if roll < 0.3:
        return rng.choice(COLOURS)
    if roll < 0.45:
        return rng.choice(PLACED)
    if roll < 0.458:
        return pseudo_word(rng)
    while True:
        word = rng.choice(ADJECTIVES[group_of(base) if base else rng.choice(GROUPS)])
        if not (word in MATERIALS and base.split(" ")[0] in MATERIALS):
            return word


def description(rng: Random, base: str) -> tuple[str, bool]:
    """A target description on the noun `base`, and whether texts put "the" before it."""
    roll = rng.random()
    if roll < 0.32:
        return f"{adjective(rng, base)} {base}", True
    if roll < 0.37:
        return f"{_uncoloured(rng, base)} {rng.choice(COLOURS)} {base}", True
    if roll < 0.51 and group_of(base) != "thing":
        return f"{base} {proper_name(rng)}", rng.random() < 0.45
    if roll < 0.65:
        return f"{base} {code(rng)}", rng.random() < 0.2
    if roll < 0.69:
        return f"{proper_name(rng)} {base}", True
    if roll < 0.79:
        extra = with_phrase(rng, base)
        return (
            f"{adjective(rng, base)} {base} {extra}" if rng.random() < 0.3 else f"{base} {extra}"
        ), True
    if roll < 0.81:
        return f"{adjective(rng, base)} {base} {proper_name(rng)}", True
    if roll < 0.825:
        return f"{base} number {rng.randint(1, 40)}", False
    return base, True


def _uncoloured(rng: Random, base: str) -> str:
    while True:
        look = rng.choice((*ADJECTIVES[group_of(base)], *PLACED))
        if (
            "-hulled" not in look
            and "-and-" not in look
            and not (look in MATERIALS and base.split(" ")[0] in MATERIALS)
        ):
            return look


def with_phrase(rng: Random, base: str = "") -> str:
    """A "with ..." phrase that belongs to a description."""
    if rng.random() < 0.25:
        return rng.choice(WITH_OTHERS)
    look, part = (
        rng.choice(WITH_LOOKS),
        rng.choice(WITH_PARTS[group_of(base) if base else rng.choice(GROUPS)]),
    )
    article = rng.choice(("the", "an" if look[0] in "aeiou" else "a"))
    return f"with {article} {look} {part}"


def structure(rng: Random, key: int, *, located: bool) -> Target:
    """A structure or vessel, with coordinates when `located`."""
    if rng.random() < 0.03:
        name = fill_pattern(rng.choice(STRUCTURE_PREFIXES), rng)
        return Target(key, name, _place(rng, located), False, noun=name)
    base = noun(rng)
    text, article = description(rng, base)
    if base == "wreck" and rng.random() < 0.3:
        text, article = f"wreck of the {proper_name(rng)}", True
    return Target(
        key,
        text,
        _place(rng, located),
        article,
        noun=base,
        whereabouts="" if located or rng.random() > 0.22 else rng.choice(lexicon.WHEREABOUTS),
    )


def moving_thing(rng: Random, key: int, *, located: bool) -> Target:
    """Something that drifts or sails and can be stayed with."""
    base = rng.choice(lexicon.MOVING_TARGETS)
    text, article = base, True
    if base not in ALIVE:
        roll = rng.random()
        if roll < 0.38:
            text = f"{rng.choice(AFLOAT)} {base}" if base.split()[0] not in AFLOAT else base
        elif roll < 0.6:
            text, article = f"{base} {proper_name(rng)}", rng.random() < 0.4
        elif roll < 0.68:
            text = f"{base} {with_phrase(rng, 'trawler')}"
        elif roll < 0.74:
            text, article = f"{base} {code(rng)}", False
    whereabouts = "" if located or rng.random() > 0.3 else rng.choice(lexicon.WHEREABOUTS)
    return Target(
        key,
        text,
        _place(rng, located),
        article,
        movable=True,
        noun=base.split()[-1],
        whereabouts=whereabouts,
    )


def _place(rng: Random, located: bool) -> Position | None:
    return draw_position(rng) if located else None


def dock_spot(rng: Random) -> str:
    """A docking place by name, without article."""
    roll = rng.random()
    if roll < 0.55:
        return rng.choice(lexicon.DOCK_SPOTS)
    kind = rng.choice(
        ("berth", "pontoon", "jetty", "quay", "slip", "pier", "dock", "mooring", "float", "wharf")
    )
    if roll < 0.7:
        return f"{kind} {rng.randint(1, 30)}"
    if roll < 0.8:
        return f"{kind} {rng.choice(LETTERS)}{rng.choice(('', '', str(rng.randint(1, 9))))}"
    if roll < 0.9:
        return f"{rng.choice(DOCK_LOOKS)} {kind}"
    return f"{place_name(rng) if rng.random() < 0.5 else rng.choice(lexicon.PROPER_NAMES)} {kind}"


DOCK_LOOKS = (
    "north",
    "south",
    "east",
    "west",
    "inner",
    "outer",
    "visitor",
    "guest",
    "pilot",
    "ferry",
    "fuel",
    "service",
    "fishing",
    "naval",
    "customs",
    "old",
    "new",
    "wooden",
    "floating",
    "concrete",
    "stone",
    "long",
    "short",
    "first",
    "second",
    "third",
    "workshop",
    "charging",
    "university",
    "yacht club",
    "lifeboat",
    "coal",
    "timber",
    "grain",
    "cruise",
    "marina",
    "police",
    "rescue",
    "survey",
    "maintenance",
)


def feature(rng: Random) -> str:
    """A part of a structure that a camera can look at, without article."""
    base = rng.choice(lexicon.FEATURES)
    if rng.random() < 0.02:
        base = f"{pseudo_word(rng)} {base.split()[-1]}"
    elif rng.random() < COMPOUND:
        base = _compound(rng, base)
    if rng.random() < 0.3:
        look = rng.choice(FEATURE_LOOKS)
        base = base if base.startswith(look) else f"{look} {base}"
    return f"{base} {rng.choice(lexicon.FEATURE_PHRASES)}" if rng.random() < 0.08 else base


def dock_mark(rng: Random) -> str:
    """A mark that guides a docking by camera."""
    if rng.random() < 0.6:
        return rng.choice(lexicon.DOCK_MARKS)
    return (
        f"{rng.choice(MARK_LOOKS)}"
        f" {pseudo_word(rng) if rng.random() < 0.015 else rng.choice(MARKS)}"
    )


def side(rng: Random) -> str:
    """A side of a structure, one bare word."""
    return rng.choice(lexicon.SIDES if rng.random() < 0.5 else COMMON_SIDES)


COMMON_SIDES = (
    "north",
    "south",
    "east",
    "west",
    "port",
    "starboard",
    "seaward",
    "landward",
    "north",
    "south",
    "east",
    "west",
    "northern",
    "southern",
)


def data_item(rng: Random) -> str:
    """Something to send, without article."""
    if rng.random() < 0.65:
        return rng.choice(ITEMS)
    return (
        f"{rng.choice(things() if rng.random() < COMPOUND else SUBJECTS)} {rng.choice(RECORDINGS)}"
    )
