"""What stands in the slots of a template: targets, positions, parts, ids, data and values,
realistic for the task.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from random import Random

from planner_ft.data.mission.synthetic import words
from planner_ft.data.mission.synthetic.intents import Target
from planner_ft.data.mission.synthetic.lexicon_targets import COLOURS
from planner_ft.data.mission.synthetic.numbers import (
    COMPASS,
    Said,
    Style,
    say_count,
    say_degrees,
    say_duration,
    say_heading,
    say_interval,
    say_length,
    say_percent,
    say_speed,
)
from planner_ft.data.mission.synthetic.parameters import ARCS, SCANS, say_wait
from planner_ft.data.mission.synthetic.plan_texts import _plural
from planner_ft.data.mission.synthetic.positions import Position, draw_coordinate, draw_position
from planner_ft.data.mission.synthetic.scene import AREAS, CABLES

Sayer = Callable[[Random, Style], Said]

BUOYS = (
    "buoy",
    "can buoy",
    "nun buoy",
    "wreck buoy",
    "mooring buoy",
    "cardinal buoy",
    "fairway buoy",
    "weather buoy",
    "wave buoy",
    "marker buoy",
    "spar buoy",
    "data buoy",
    "channel buoy",
    "bell buoy",
    "light buoy",
    "safe-water buoy",
    "special mark",
    "racing mark",
    "wave rider",
    "pick-up buoy",
)
LANDINGS = (
    "turbine",
    "wind turbine",
    "monopile",
    "transition piece",
    "jacket",
    "substation",
    "converter platform",
    "platform",
    "gas platform",
    "met mast",
    "lighthouse",
    "tidal turbine",
    "research platform",
    "beacon",
    "wellhead platform",
    "service platform",
    "mooring dolphin",
    "lightvessel",
)


NATIONS = re.compile("German|Dutch|Norwegian|Danish|Polish")
NAMED = re.compile(r"[A-ZÅØÖÄÉ]|\d")


def draw_target(
    rng: Random, key: int, kind: str, *, located: bool, plain: bool, common: bool = False
) -> Target:
    """A target of a kind; `plain` keeps to descriptions that take an article and have no "with ..."
    phrase, `common` to those without names.
    """
    place = draw_position(rng) if located else None
    for _ in range(12):
        target = _TARGETS[kind](rng, key)
        text = target.description or ""
        if _plural(text) or (plain and (not target.article or " with " in text)):
            continue
        if common and (
            not target.article
            or NAMED.search(NATIONS.sub("", text.replace("ROV", "").replace("RIB", "")))
        ):
            continue
        break
    return replace(target, position=place, whereabouts="")


def _structure(rng: Random, key: int) -> Target:
    return words.structure(rng, key, located=False)


def _boat(rng: Random, key: int) -> Target:
    return words.moving_thing(rng, key, located=False)


def _of(pool: tuple[str, ...]) -> Callable[[Random, int], Target]:
    def draw(rng: Random, key: int) -> Target:
        base = rng.choice(pool)
        text, article = words.description(rng, base)
        return Target(key, text, article=article, noun=base)

    return draw


def _cable(rng: Random, key: int) -> Target:
    roll = rng.random()
    name = rng.choice(CABLES)
    if roll < 0.2:
        return Target(key, f"{name} {words.code(rng)}", article=False, noun="cable")
    if roll < 0.35:
        name = f"{words.proper_name(rng)} {name}"
    return Target(key, name, noun="cable")


def _area(rng: Random, key: int) -> Target:
    name = (
        rng.choice(AREAS)
        if rng.random() < 0.7
        else (
            f"{words.proper_name(rng)}"
            f" {rng.choice(('basin', 'channel', 'bank', 'bight', 'reach', 'sound'))}"
        )
    )
    return Target(key, name, area=True, noun=name)


def _dock(rng: Random, key: int) -> Target:
    spot = words.dock_spot(rng)
    return Target(key, spot, article=not spot[-1].isdigit() and not spot[-1].isupper(), spot=True)


FLOATING = (
    "shipping container",
    "container",
    "barrel",
    "oil drum",
    "crate",
    "pallet",
    "buoyancy tank",
    "fender",
    "fishing net",
    "ghost net",
    "tree trunk",
    "log",
    "raft",
    "life raft",
    "life jacket",
    "life ring",
    "surfboard",
    "paddle board",
    "tarpaulin",
    "pontoon",
    "dinghy",
    "canoe",
    "kayak",
    "plank",
    "tank",
    "buoy",
    "mooring buoy",
    "drum",
    "refrigerator",
    "sail bag",
    "oil boom",
    "gas bottle",
    "cable drum",
    "fish box",
    "lobster pot",
    "inflatable",
    "float",
)


_TARGETS: dict[str, Callable[[Random, int], Target]] = {
    "structure": _structure,
    "boat": _boat,
    "buoy": _of(BUOYS),
    "cable": _cable,
    "area": _area,
    "landing": _of(LANDINGS),
    "dock": _dock,
    "thing": _of(FLOATING),
}

LOOK_PAIRS = (
    ("northern", "southern", "middle"),
    ("eastern", "western", "middle"),
    ("inner", "outer", "middle"),
    ("left-hand", "right-hand", "middle"),
    ("big", "small", "medium-sized"),
    ("old", "new", "half-finished"),
    ("lit", "unlit", "flashing"),
    ("near", "far", "middle"),
    ("upstream", "downstream", "middle"),
    ("tall", "short", "middle"),
    ("wooden", "steel", "concrete"),
    ("rusty", "freshly painted", "grey"),
    ("long", "short", "square"),
    ("first", "second", "third"),
)


def draw_look_alikes(rng: Random, count: int) -> list[Target]:
    """Up to three targets with one noun that differ in their look; keys from 1."""
    while True:
        base = words.noun(rng)
        if not _plural(base):
            break
    looks = rng.choice(LOOK_PAIRS) if rng.random() < 0.4 else tuple(rng.sample(COLOURS[:9], 3))
    if rng.random() < 0.5:
        looks = (looks[1], looks[0], looks[2])
    return [Target(key, f"{look} {base}", noun=base) for key, look in enumerate(looks[:count], 1)]


LENGTHS = {
    ("PerformOrbit", "radius"): (4, 80),
    ("SurveyTarget", "radius"): (4, 60),
    ("ParallelStructurePass", "length"): (15, 300),
    ("ParallelStructurePass", "distance"): (3, 40),
    ("BathymetryGridSurvey", "width"): (20, 300),
    ("BathymetryGridSurvey", "length"): (20, 300),
    ("BathymetryGridSurvey", "spacing"): (2, 25),
    ("VisualDockingApproach", "distance"): (1, 9),
}
OTHERS: dict[str, Sayer] = {
    "speed": say_speed,
    "sectors": say_count,
    "overlap": say_percent,
    "wait": say_wait,
    "heading": say_heading,
    "interval": say_interval,
    "scan": lambda rng, style: say_degrees(rng, style, SCANS),
    "arc": lambda rng, style: say_degrees(rng, style, ARCS),
    "max_dist": lambda rng, style: say_length(rng, style, 100, 950, far=True),
}


def draw_value(
    rng: Random, style: Style, title: str, base: str, *, attributive: bool = False, kind: str = ""
) -> Said:
    """A value for the slot `base` of a task, with words in the speaker's manner."""
    while True:
        said = _draw_value(rng, style, title, base)
        if attributive and not said.attributive:
            continue
        if base == "duration" and said.text == "quarter of an hour":
            continue
        if base == "heading" and kind and (kind == "words") != _in_points(said.text):
            continue
        return said


def _draw_value(rng: Random, style: Style, title: str, base: str) -> Said:
    if base == "duration":
        return say_duration(rng, style, brief=title == "FeatureStare")
    if base in OTHERS:
        return OTHERS[base](rng, style)
    low, high = LENGTHS[title, base]
    return say_length(rng, style, low, high)


def _in_points(text: str) -> bool:
    bare = text.removeprefix("due ").replace(" ", "-")
    return bare in COMPASS or bare.replace("-", "") in {name.replace("-", "") for name in COMPASS}


def arc_phrase(rng: Random, said: Said) -> str:
    """An angle as a noun phrase: "half a circle", "a full circle", "a 270-degree arc"."""
    exact = ARC_PHRASES.get(int(said.value))
    if exact and rng.random() < 0.9:
        return rng.choice(exact)
    degrees = said.attributive or said.text
    return (
        f"a {degrees} {rng.choice(('arc', 'arc', 'arc', 'sweep', 'turn'))}"
        if rng.random() < 0.75
        else f"an arc of {said.text}"
    )


ARC_PHRASES = {
    360: (
        "a full circle",
        "a full circle",
        "one full circle",
        "a complete circle",
        "a full lap",
        "one complete lap",
        "a full orbit",
        "a full 360",
    ),
    180: (
        "half a circle",
        "half a circle",
        "a half circle",
        "half a lap",
        "a semicircle",
        "a half orbit",
        "half an orbit",
    ),
    90: ("a quarter circle", "a quarter of a circle", "a quarter lap", "a quarter of an orbit"),
    270: ("three quarters of a circle", "a three-quarter circle", "three quarters of a lap"),
}


def interval_words(said: Said, before: str) -> str:
    """The time between two measurements: "minute" after "every", "one minute" elsewhere."""
    if (
        before.rstrip().lower().endswith(("every", "each", "once a", "once per", "one a", "per"))
        or said.text[0].isdigit()
    ):
        return said.text
    return {
        "minute": "one minute",
        "half minute": "half a minute",
        "hour": "one hour",
        "half hour": "half an hour",
    }.get(said.text, said.text)


def near(position: Position, rng: Random) -> Position:
    """Another position that could be mistaken for it."""
    if rng.random() < 0.4:
        return draw_position(rng)
    x, y = position
    return (x, draw_coordinate(rng)) if rng.random() < 0.5 else (draw_coordinate(rng), y)


def data_item(rng: Random) -> str:
    """Something to send that takes an article."""
    while True:
        item = words.data_item(rng)
        if "'s " not in item:
            return item


def feature(rng: Random, *, singular: bool) -> str:
    """A part of a structure; `singular` where the text goes on with "it"."""
    for _ in range(8):
        name = words.feature(rng)
        if not (singular and _plural(name)):
            return name
    return "hatch"
