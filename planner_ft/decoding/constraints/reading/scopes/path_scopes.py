"""In which steps a skill runs, told by places on a path that is known: "at the middle of the south
side", "on the last lane", "from the start point onwards".

Each sentence, or part of one between semicolons, that tells such places has its skills run there
and nowhere else. Words that only rule out the rest ("elsewhere not", "not on the way there") say
nothing more. What is told in two ways is not read.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from planner_ft.decoding.constraints.reading.rows.movement_rows import plain
from planner_ft.decoding.constraints.reading.scopes import scope_words as w
from planner_ft.decoding.constraints.reading.scopes.path_spots import Holds, Path, Spot, spots_of
from planner_ft.decoding.constraints.reading.scopes.skill_mentions import Mention, mentions_of
from planner_ft.decoding.constraints.reading.scopes.skill_words import SKILL_WORDS
from planner_ft.decoding.constraints.reading.scopes.where import Anchor
from planner_ft.decoding.constraints.reading.skills.evidence import asks_for

_LED_TO = ("line", "pass", "lawnmower", "square")
"""Patterns of tasks that begin where their path does, whatever that is."""
_TIED = re.compile(
    r"\b(?:if|unless|every (?:other|second|third)|alternat\w*|half|instead of the"
    r" (?:grid|square))\b"
)
_STAYS = re.compile(
    r"\b(?:hold|wait|stay|stop|halt|pause|drift|float|keep"
    r" station|turn|rotate|face|pan)(?:s|ing|ping)?\b"
)
"""Words of movements that go nowhere: what a sentence with one of them says may be about that."""
_LIMITS = ("BoundaryEnforcement", "ObstacleAvoidance", "LockHeading")
_PARTS = re.compile(r",|\b(?:and|but|while)\b")
_JOINT = re.compile(r",? (?:and|or|as well as|and also|and again) ")
_GOES_ON = re.compile(r"\d|\bten\b|\b\w+ (?:metres|will do|is enough)\b|ditto|too\b|also")
"""Words that go on about the skills before: "twenty metres up to the first point; from there to the
end, ten".
"""
_Told = tuple[Holds | None, bool]
"""Where a skill runs (None: not known), and whether it is asked for plainly."""


@dataclass(frozen=True)
class PathScope:
    """The waypoints at which a skill runs; `plainly`: it is asked for there beyond doubt."""

    holds: tuple[Holds, ...]
    plainly: bool

    def allows(self, path: Path) -> bool | None:
        """Whether the skill must run (True) or must not (False) on the way to the last of some
        waypoints; None: not known.
        """
        verdicts = [holds(path) for holds in self.holds]
        runs = True in verdicts
        return None if (runs and not self.plainly) or (not runs and None in verdicts) else runs


def read_path_scopes(
    text: str, names: Iterable[str], paths: Sequence[Path], pattern: str
) -> dict[str, PathScope]:
    """Where on the one path of a task, that may be any of some `paths` of one shape, filter and
    perception skills run, by their names.
    """
    said = plain(text)
    if (
        not said.text
        or w.CHANGED.search(said.text)
        or len({len(path) for path in paths}) > 1
        or (paths and len(paths[0]) < 2)
    ):
        return {}
    spots = list(spots_of(said, paths, pattern)) if paths or pattern in _LED_TO else []
    if not spots:
        return {}
    mentions = mentions_of(
        said.text,
        [name for name in names if name in SKILL_WORDS],
        [Anchor(spot.start, spot.end, True, None) for spot in spots],
    )
    found: dict[str, list[_Told]] = {}
    for name, told in _told(said.text, mentions, spots):
        found.setdefault(name, []).append(told)
    return {name: scope for name, places in found.items() if (scope := _scope(places)) is not None}


def _told(
    text: str, mentions: Sequence[Mention], spots: Sequence[Spot]
) -> Iterator[tuple[str, _Told]]:
    """Each skill, sentence by sentence, with what is told of it."""
    latest: set[str] = set()
    for begin, end in _sentences(text):
        sentence = text[begin:end]
        here = [mention for mention in mentions if begin <= mention.start < end]
        inside = [spot for spot in spots if begin <= spot.start < end]
        if not here and any(not spot.ruled_out for spot in inside) and _GOES_ON.search(sentence):
            for name in latest:
                yield name, (None, True)
        latest = {mention.name for mention in here} or latest
        stays = _STAYS.search(sentence) is not None
        for mention, holds in _placed(text, begin, end, here, inside):
            clause = text[max(begin, text.rfind(",", begin, mention.start)) : end]
            yield (
                mention.name,
                (
                    None if stays else holds,
                    asks_for(clause, mention.name) or asks_for(sentence, mention.name),
                ),
            )


def _scope(places: Sequence[_Told]) -> PathScope | None:
    """Where a skill runs. A word for it elsewhere may ask for it there, except in what the task is
    called: "depth grid".
    """
    told = [(holds, plainly) for holds, plainly in places if holds is not None]
    titles = len(places) - len(told)
    if not told or titles > 1 or (titles == 1 and (places[0][0] is not None or places[0][1])):
        return None
    return PathScope(
        tuple(holds for holds, _plainly in told), any(plainly for _holds, plainly in told)
    )


def _sentences(text: str) -> Iterator[tuple[int, int]]:
    begin = 0
    for match in re.finditer(r"[.;!?](?=\s|$)", text):
        yield begin, match.start()
        begin = match.end()
    yield begin, len(text)


def _placed(
    text: str, begin: int, end: int, mentions: Sequence[Mention], spots: Sequence[Spot]
) -> Iterator[tuple[Mention, Holds | None]]:
    """Each mention of a sentence with the places that are meant."""
    positive = [spot for spot in spots if not spot.ruled_out]
    if not positive and spots and not _TIED.search(text[begin:end]):
        # "Not on the way to the start": everywhere else.
        everywhere_else = _but([spot.holds for spot in spots])
        for mention in mentions:
            yield mention, everywhere_else
        return
    if _TIED.search(text[begin:end]) or not positive:
        for mention in mentions:
            if not mention.denied or not spots:
                yield mention, None
        return
    if len(positive) == 1:
        for mention in mentions:
            closer = [
                other
                for other in mentions
                if mention.end <= other.start < positive[0].start
                and "," in text[mention.end : other.start]
            ]
            if mention.name in _LIMITS and closer:
                # "Inside @, pin q at the last point."
                yield mention, None
                continue
            yield (
                mention,
                _less(positive[0].holds, [spot.holds for spot in spots if spot.ruled_out]),
            )
        return
    if len(positive) == 2 and _JOINT.fullmatch(text[positive[0].end : positive[1].start]):
        for mention in mentions:
            near = (
                ","
                not in text[mention.end : positive[0].start] + text[positive[1].end : mention.start]
            )
            yield mention, _either(positive[0].holds, positive[1].holds) if near else None
        return
    parts = _parts(text, begin, end, positive)
    for mention in mentions:
        own = next((spot for (first, last), spot in parts if first <= mention.start < last), None)
        yield mention, own.holds if own else None


def _either(one: Holds, other: Holds) -> Holds:
    """What holds at one of two places: "both at the start point and at the end point"."""

    def holds(path: Path) -> bool | None:
        found = one(path), other(path)
        return True if True in found else None if None in found else False

    return holds


def _less(where: Holds, barred: Sequence[Holds]) -> Holds:
    """A place without others: "on the northbound run, not on the way to its start"."""
    return (
        (lambda path: False if any(one(path) for one in barred) else where(path))
        if barred
        else where
    )


def _but(spots: Sequence[Holds]) -> Holds:
    def holds(path: Path) -> bool | None:
        # Elsewhere it may be meant for some ways only.
        return False if any(one(path) for one in spots) else None

    return holds


def _parts(
    text: str, begin: int, end: int, spots: Sequence[Spot]
) -> list[tuple[tuple[int, int], Spot | None]]:
    """The parts of a sentence that tell one place each."""
    cuts = [begin]
    for one, other in itertools.pairwise(spots):
        # The part ends at the last separator before the next place, or at the first behind this one
        # where the places end their parts.
        between = list(_PARTS.finditer(text, one.end, other.start))
        opens = not text[begin : one.start].strip(" ,")
        if not between:
            return []
        cuts.append((between[-1] if opens else between[0]).start())
    cuts.append(end)
    return [((first, last), spot) for first, last, spot in zip(cuts, cuts[1:], spots, strict=False)]
