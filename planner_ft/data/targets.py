"""What a command speaks of: places, structures and moving things, drawn and mentioned, and places
and sizes that it leaves to arithmetic ("mid(P1,P2)" in the plan of a template).
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from random import Random
from typing import Any

from planner_ft.data.numbers import PLACES, pick, position
from planner_ft.data.templates.grammar import fail
from planner_ft.data.templates.render import PIECE, article_for
from planner_ft.data.values import WordLists, draw_number, draw_point
from planner_ft.facts.geometry import Point, offset, point, tidy
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.limits import written

ALIGNED = 0.5
"""Share of the positions that share a coordinate with another one of the command, or with home."""
SIDES = (20, 300)
"""Metres between two corners, each way."""
BESIDE = re.compile(r"[xy]\d+|on\d+_\d+")
HOME = "Home"
UNPLACED = frozenset(("a", "one", "look", "nouns"))
"""Options of mentions that carry no position."""


@dataclass(frozen=True)
class Target:
    """A place, structure or moving thing that a command speaks of; `key` tells those of one command
    apart.

    `description` is written as in the plan, `text` is said, both without article; `article`: texts
    put "the" before it. `identity` is the id of something to follow. `spot` marks a docking place,
    `on_site` that the vehicle lies there already.
    """

    key: str
    description: str | None = None
    position: Point | None = None
    article: bool = True
    text: str = ""
    identity: str | None = None
    spot: bool = False
    doubtful: bool = False
    whereabouts: str = ""
    on_site: bool = False
    noun: str = ""

    @property
    def must_be_found(self) -> bool:
        """Whether only a search can tell where it is."""
        known = self.position is not None or self.identity is not None
        return not (known or self.spot or self.on_site)

    @property
    def name(self) -> str:
        """The target as the plan's texts call it: "the green barrel", "[45, 10]"."""
        if self.description is None:
            return self.identity or written(self.position or (0, 0))
        return f"the {self.description}" if self.article else self.description

    @property
    def place(self) -> str:
        """The name with its place: "the met mast at [120, -35]"."""
        if self.description is None or self.position is None:
            return self.name
        return f"{self.name} at {written(self.position)}"

    def mention(
        self, options: frozenset[str], rng: Random, form: str | None, *, with_place: bool = False
    ) -> list[PIECE]:
        """The target as it is spoken of; ordinary words are no values: they can be mistyped."""
        text = self.description or self.text
        if "nouns" in options:
            ending = "es" if self.noun.endswith(("s", "x", "ch", "sh")) else "s"
            return [(f"{self.noun}{ending}", False)]
        if "look" in options or "one" in options:
            return [(self.text if "look" in options else f"the {self.text} one", False)]
        kept = is_name(text) or rng.random() < 0.6
        if "a" in options:
            return [(f"{article_for(text)} ", False), (text, kept)]
        named = f"the {text}" if self.article and "bare" not in options else text
        if not with_place or self.position is None:
            return [(named, kept)]
        sense = "doubtful" if self.doubtful else "known"
        before, _brace, after = pick(PLACES[sense], rng).partition("{}")
        place = position(self.position, rng, form).text
        if before.endswith("(") and place[0] in "[(":
            before, after = " at ", ""
        return [(named, kept), (before, False), (place, True), (after, False)]


def described(
    key: str, kind: str, words: WordLists, rng: Random, *, fixed: bool, common: bool
) -> Target:
    """A target of a word list; `fixed` takes an article and no "with ..." phrase, `common` no
    name.
    """
    for _ in range(20):
        value = words.noun(kind, rng)
        article = value.text != value.value
        unfit = fixed and (not article or " with " in value.value)
        if not unfit and not (common and is_name(value.value)):
            break
    return Target(key, value.value, article=article, text=value.value)


def alike(words: WordLists, rng: Random) -> list[Target]:
    """Targets with one noun, which does not end in y, that differ in their look."""
    while (noun := words.entry("pair", rng)).endswith("y"):
        continue
    looks = words.entry("looks", rng).split("/")
    if rng.random() < 0.5:
        looks[:2] = looks[1::-1]
    return [Target("", f"{look} {noun}", text=look, noun=noun) for look in looks]


def is_name(text: str) -> bool:
    """Whether a text has capitals, figures or an article within, so that a slip or a telegram would
    make it another.
    """
    within = {"a", "an", "the"} & set(text.split()[1:])
    return not text.islower() or bool(within) or any(mark.isdigit() for mark in text)


def draw_place(
    known: Sequence[Point],
    vocabulary: Vocabulary,
    rng: Random,
    corner: Point | None = None,
    ways: Sequence[tuple[int, int]] = (),
) -> Point:
    """A position that is none of those known. Some share coordinates with these, as the corners of
    a box do; with a corner it lies opposite, one of the ways (east, north) off.
    """
    while True:
        place = draw_point(rng)
        if known and rng.random() < ALIGNED:
            others = [vocabulary.home, *known]
            (x, _), (_, y) = pick(others, rng), pick(others, rng)
            place = pick(((x, place[1]), (place[0], y), (x, y)), rng)
        if corner is not None:
            sides = (way * draw_number(rng, *SIDES) for way in pick(ways, rng))
            place = point(*(one + side for one, side in zip(corner, sides, strict=True)))
        if place not in (vocabulary.home, vocabulary.unresolved, *known):
            return place


def place_beside(
    options: Iterable[str], worth: Callable[[str], Any], taken: Collection[Any], rng: Random
) -> Point:
    """A position with the x or the y of other places ("x1", "y2"; 0 is home), a side away along the
    other axis, or the next one in a row of two ("on1_2"); `worth` gives the place of a slot. Raises
    TemplateError.
    """
    shared: dict[str, float] = {}
    start = worth(HOME)
    for option in sorted(options):
        numbers = re.findall(r"\d+", option) if BESIDE.fullmatch(option) else ["?"]
        try:
            start, *second = (worth(HOME if one == "0" else f"P{one}") for one in numbers)
        except KeyError:
            fail(f"{option} names no place that is said before")
        if second:
            return point(*(2 * there - one for one, there in zip(start, *second, strict=True)))
        shared[option[0]] = start["xy".index(option[0])]
    while True:
        sides = (pick((-1, 1), rng) * draw_number(rng, *SIDES) for _ in start)
        moved = zip("xy", start, sides, strict=True)
        place = point(*(shared.get(axis, one + side) for axis, one, side in moved))
        if len(shared) == 2 or place not in taken:
            return place


# ---------------------------------------------------------------- formulas


def _mid(one: Point, other: Point) -> Point:
    return point((one[0] + other[0]) / 2, (one[1] + other[1]) / 2)


def _from(east: int, north: int) -> Callable[[Point, float, float], Point]:
    """The middle of an area that extends so from its corner, by its width and length."""
    return lambda corner, width, length: point(
        corner[0] + east * width / 2, corner[1] + north * length / 2
    )


FORMULAS: dict[str, Callable[..., Any]] = {
    "mid": _mid,
    "sw_ne": _mid,
    "nw_se": _mid,
    "dx": lambda one, other: tidy(abs(other[0] - one[0])),
    "dy": lambda one, other: tidy(abs(other[1] - one[1])),
    "move": lambda start, distance, heading: offset(start, heading, distance),
    "from_sw": _from(1, 1),
    "from_se": _from(-1, 1),
    "from_nw": _from(1, -1),
    "from_ne": _from(-1, -1),
    "new_x": lambda place, x: point(x, place[1]),
    "new_y": lambda place, y: point(place[0], y),
    "mixed": lambda one, other: point(one[0], other[1]),
    "swapped": lambda place: point(place[1], place[0]),
    "mirror_x": lambda place: point(-place[0], place[1]),
}
CORNERS = {"mid": ((1, 1), (1, -1), (-1, 1), (-1, -1)), "sw_ne": ((1, 1),), "nw_se": ((1, -1),)}
WINDS = (0, 90, 180, 270) * 3 + (45, 135, 225, 315)
"""Directions of moves: mostly along an axis."""


def is_formula(key: str) -> bool:
    """Whether an argument of a plan is to be worked out."""
    return "(" in key


def operands(key: str) -> set[str]:
    """The slots that a formula needs; of a slot, the slot itself. Raises TemplateError."""
    if not is_formula(key):
        return {key}
    try:
        nodes = list(ast.walk(ast.parse(key, mode="eval")))
    except SyntaxError:
        fail(f"{key} is no formula")
    return {node.id for node in nodes if isinstance(node, ast.Name)} - {*FORMULAS, HOME}


def worked_out(key: str, value: Callable[[str], Any]) -> Any:
    """What a formula comes to; `value` gives position or number of a slot, and of Home. Raises
    KeyError for an unknown formula.
    """
    return _value(ast.parse(key, mode="eval").body, value)


def _value(node: ast.expr, value: Callable[[str], Any]) -> Any:
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        return FORMULAS[node.func.id](*(_value(one, value) for one in node.args))
    return value(node.id if isinstance(node, ast.Name) else "")


def opposite(plan: str) -> Iterator[tuple[str, str, tuple[tuple[int, int], ...]]]:
    """The pairs of slots that a plan takes for opposite corners, the first one said first, and the
    ways (east, north) that may lead from the first to the second.
    """
    for name, one, other in re.findall(r"(mid|sw_ne|nw_se)\((\w+),(\w+)\)", plan):
        if f"dx({one},{other})" in plan:
            yield one, other, CORNERS[name]


def directions(plan: str) -> set[str]:
    """The slots of a plan that say where a move goes."""
    return set(re.findall(r",(\w+)\)", plan)) if "move(" in plan else set()
