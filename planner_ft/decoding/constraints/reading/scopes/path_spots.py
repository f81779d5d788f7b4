"""Places on a path that is known, as a text tells them: "at the middle of the south side", "on the
last lane", "from the start point onwards".
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading.rows.movement_rows import Plain
from planner_ft.decoding.constraints.reading.scopes import path_scope_words as p
from planner_ft.decoding.constraints.reading.scopes import scope_words as w
from planner_ft.decoding.constraints.reading.scopes.skill_mentions import sentence_at

Path = Sequence[g.Point]
Holds = Callable[[Path], bool | None]
"""Whether a scope holds at the last of some waypoints."""


@dataclass(frozen=True)
class Spot:
    """Words for places on a path, and where they are; `ruled_out`: the skill does not run there."""

    start: int
    end: int
    holds: Holds
    ruled_out: bool


@dataclass(frozen=True)
class _Phrase:
    """Words for places on one of some paths, that are of one shape; none where the path is not
    known.
    """

    kind: str
    match: re.Match[str]
    said: Plain
    paths: Sequence[Path]

    @property
    def count(self) -> int:
        """How many waypoints the path has."""
        return len(self.paths[0]) if self.paths else 0

    @property
    def sentence(self) -> tuple[int, int]:
        return sentence_at(self.said.text, self.match.start())

    def group(self, *names: str) -> str:
        """The first of these parts that the words have."""
        groups = self.match.groupdict()
        return next((value for name in names if (value := groups.get(name))), "")


def spots_of(said: Plain, paths: Sequence[Path], pattern: str) -> Iterator[Spot]:
    """The places on the path of a task of this pattern, in the order of the text."""
    taken: list[tuple[int, int]] = []
    spots: list[Spot] = []
    for kind, words in (*_OF_SHAPE.get(pattern, ()), *p.ANY):
        if kind == "second" and pattern in _OF_SHAPE:
            continue
        for match in re.finditer(words, said.text):
            if _overlaps(match, taken):
                continue
            taken.append(match.span())
            spot = _spot(_Phrase(kind, match, said, paths))
            spots += [spot] if spot else []
    if spots:
        spots += [
            Spot(*match.span(), lambda path: True, False)
            for match in p.EVERYWHERE.finditer(said.text)
            if not _overlaps(match, taken)
        ]
    yield from sorted(spots, key=lambda spot: spot.start)


_OF_SHAPE = {"square": p.SQUARE, "lawnmower": p.GRID}
"""Places of paths that have a shape."""
_BEGUN_AT = ("mid", "side", "corner", "corners", "mids", "first", "final")
"""Places that a text may name as those where the path begins."""


def _overlaps(match: re.Match[str], taken: Sequence[tuple[int, int]]) -> bool:
    return any(match.start() < end and start < match.end() for start, end in taken)


def _spot(phrase: _Phrase) -> Spot | None:
    text, match = phrase.said.text, phrase.match
    before, behind = (
        re.split(r"[.;]", text[: match.start()])[-1],
        re.split(r"[.;]", text[match.end() :])[0],
    )
    if phrase.kind in _BEGUN_AT and p.BEGINS.search(before):
        return None
    holds = _HOLDS[phrase.kind](phrase) if phrase.paths or phrase.kind in _ON_ANY else None
    return (
        Spot(
            match.start(),
            match.end(),
            holds,
            bool(p.RULED_OUT.search(before) or p.RULES_OUT.match(behind)),
        )
        if holds is not None
        else None
    )


# ---------------------------------------------------------------- on any path


def _at(*wanted: int) -> Holds:
    """At waypoints by their numbers."""
    return lambda path: len(path) - 1 in wanted


def _behind_start(path: Path) -> bool:
    return len(path) > 1


def _legs(phrase: _Phrase) -> Holds | None:
    """ "On legs 1 and 3", of those that are numbered behind a start point."""
    started = re.search(
        r"\bstart(?:ing)? (?:point|position|at|from)\b.*\bleg 1\b[:=,.]? ", phrase.said.text
    )
    wanted = [int(number) for number in re.findall(r"\d", phrase.group("cards"))]
    return _at(*wanted) if started and (not phrase.count or max(wanted) < phrase.count) else None


def _home_or_shape(phrase: _Phrase) -> Holds | None:
    """The way home is the one that the text asks for, behind all others."""
    going = p.GOES_HOME.search(phrase.said.text) and not p.NOT_ALL.search(
        phrase.said.text[slice(*phrase.sentence)]
    )
    return (lambda path: _is_home(path) == (phrase.kind == "home")) if going else None


_HOME = (0.0, 0.0)


def _is_home(path: Path) -> bool:
    """Whether the last of several waypoints is where the vehicle started."""
    return len(path) > 1 and (float(path[-1][0]), float(path[-1][1])) == _HOME


def _final(phrase: _Phrase) -> Holds:
    return _at(phrase.count - 1) if phrase.paths else lambda path: None if len(path) > 1 else False


def _second(phrase: _Phrase) -> Holds | None:
    """ "On that run", that has one leg behind its start."""
    if phrase.paths:
        return _at(1) if phrase.count == 2 else None
    more = re.search(
        r"\b(?:back|return|legs|runs|passes|twice|again|second)\b|\bleg \d", phrase.said.text
    )
    return _behind_start if not more else None


# ---------------------------------------------------------------- on a path that is known


def _on_lane(phrase: _Phrase) -> Holds | None:
    """ "On the run along the third lane", "at the ends of the last lane"."""
    number = w.ORDINAL[phrase.group("ord", "ord2")]
    number = number if number >= 0 else phrase.count // 2 + number
    wanted = (2 * number, 2 * number + 1) if phrase.kind == "lane ends" else (2 * number + 1,)
    return _at(*wanted) if phrase.count % 2 == 0 and max(wanted) < phrase.count else None


def _between(phrase: _Phrase) -> Holds | None:
    """ "From (4, 5) to (4, 50)", where that is no movement."""
    text, match = phrase.said.text, phrase.match
    one, other = (
        phrase.said.places.get(match.start() + sign.start()) for sign in re.finditer("@", match[0])
    )
    path = [tuple(map(float, point)) for point in phrase.paths[0]]
    steps = [
        index for index in range(1, phrase.count) if (path[index - 1], path[index]) == (one, other)
    ]
    begin, end = phrase.sentence
    alone = (
        len(phrase.paths) == 1
        and len(steps) == 1
        and not p.DONE.search(text[begin : match.start()] + text[match.end() : end])
    )
    return _at(*steps) if alone else None


def _bound(phrase: _Phrase) -> Holds | None:
    """ "On the northbound run", where the text has a southbound one; "run it northbound" is a
    movement.
    """
    sentence = phrase.said.text[slice(*phrase.sentence)]
    both = p.BOTH_WAYS.search(phrase.said.text) or p.BOTH_WAYS_SAID.search(sentence)
    if not both or p.DONE.search(p.BOUND_WAY.sub(" ", sentence)):
        return None
    way = {"north": (0, 1), "south": (0, -1), "east": (1, 0), "west": (-1, 0)}[
        phrase.group("way", "way2")
    ]
    return _towards(way)


def _towards(way: tuple[int, int]) -> Holds:
    """On ways towards a point of the compass; that to the first waypoint is not known."""

    def holds(path: Path) -> bool | None:
        if len(path) < 2:
            return None
        east, north = path[-1][0] - path[-2][0], path[-1][1] - path[-2][1]
        along, across = east * way[0] + north * way[1], east * way[1] + north * way[0]
        return along > abs(across) * 2

    return holds


def _on_square(phrase: _Phrase) -> Holds | None:
    """The places of a survey square, the same for every way round it."""
    boxes = {
        tuple(
            round(bound(point[axis] for point in path), 2)
            for axis in (0, 1)
            for bound in (min, max)
        )
        for path in phrase.paths
    }
    if len(boxes) != 1 or len(set(phrase.paths[0])) != 8:
        return None
    left, right, bottom, top = boxes.pop()
    sides = {"north": (1, top), "south": (1, bottom), "east": (0, right), "west": (0, left)}

    def on(side: str, path: Path) -> bool:
        axis, value = sides[side]
        return abs(path[-1][axis] - value) < 0.02

    def corner(path: Path) -> bool:
        return sum(on(side, path) for side in sides) == 2

    named, side = [side for side in sides if side in phrase.group("corner")], phrase.group("side")
    places: dict[str, Holds] = {
        "corners": corner,
        "mids": lambda path: not corner(path),
        "corner": lambda path: all(on(side, path) for side in named),
        "side": lambda path: on(side, path),
        "mid": lambda path: on(side, path) and not corner(path),
    }
    return places[phrase.kind]


_HOLDS: Mapping[str, Callable[[_Phrase], Holds | None]] = {
    "start": lambda phrase: _at(0),
    "first": lambda phrase: _at(0),
    "beyond": lambda phrase: _behind_start,
    "legs": _legs,
    "home": _home_or_shape,
    "shape": _home_or_shape,
    "final": _final,
    "second": _second,
    "last": _final,
    "between": _between,
    "bound": _bound,
    "lane ends": _on_lane,
    "lane run": _on_lane,
    "corners": _on_square,
    "mids": _on_square,
    "corner": _on_square,
    "side": _on_square,
    "mid": _on_square,
}
"""Where places are, by how they are told (`path_scope_words`); None where that cannot be told."""
_ON_ANY = ("start", "first", "beyond", "legs", "home", "shape", "final", "second")
"""Places that can be told where the path is not known."""
