"""Passes beside a face, a pipe or another straight thing that a task input lays down in words, and
runs along such a line.

A line is laid down by equations ("east face at x = 112, from y = -40 to y = 30"), by its two ends,
by one end, a length and a bearing, or by its middle. The rest of the text says on which side of it,
how far off, from which end and whether back again. None where the text lays down no line, Uncertain
where something about the passes is not clear.
"""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths import face_wordings as f
from planner_ft.decoding.constraints.reading.paths import run_wordings as r
from planner_ft.decoding.constraints.reading.paths.itinerary import (
    plain_text,
    reworded,
    without_fences,
)
from planner_ft.decoding.constraints.reading.paths.shapes import (
    Place,
    Point,
    Uncertain,
    stated_lengths,
    stated_sizes,
)

Path = tuple[Point, ...]
Ends = tuple[Point, Point]
BLANK = "§"


@dataclass(frozen=True)
class _Line:
    """Both ends of a line in the order of the text, and where the text lays it down.

    `solid`: it is a thing that is passed at some distance, not a line to be run along. `told`: the
    text says that it is there, and does not only send the vehicle from one end to the other.
    """

    ends: Ends
    spans: tuple[tuple[int, int], ...]
    solid: bool
    told: bool = True


@dataclass(frozen=True)
class _Run:
    """One pass: the part of the text that asks for it."""

    part: str
    towards: int
    """1 in the order of the line's ends, -1 the other way, 0 where the part does not say."""
    back: bool
    both: bool
    shift: bool = False
    """No pass: only the distance of those that follow."""


def read_faces(record: dict[str, Any]) -> Path | None:
    """Every waypoint of the answer in order, where the input is about passes along the one line
    that it lays down; None where it is not.
    """
    given, prompt = record.get("parameters"), str(record.get("prompt", ""))
    text = reworded(without_fences(plain_text(prompt))) if len(prompt) <= LONGEST else None
    try:
        return _passes(text, given if isinstance(given, dict) else {}) if text else None
    except Uncertain:
        return None


def _passes(text: str, parameters: dict[str, Any]) -> Path | None:
    plain = r.QUOTED.sub(lambda quoted: " " * len(quoted[0]), text)
    plain = f.TO_BEGINNING.sub(
        r"from the \g<end> end ", f.ON_PASS.sub(_noted, f.APPROACH.sub(_noted, plain))
    )
    line = (
        _on_axes(plain)
        or _about_middle(plain, parameters)
        or _from_end(plain)
        or _between_ends(plain)
    )
    if line is None:
        return None
    rest = plain
    for start, end in line.spans:
        rest = rest[:start] + BLANK * (end - start) + rest[end:]
    rest = _with_ends(rest, line.ends)
    said = " ".join(plain[start:end] for start, end in line.spans)
    if not line.told and (not _standoffs(rest) or not (_named_sides(rest) or f.HAND.search(rest))):
        return None
    if f.ELSEWHERE.search(f.NOT_ELSEWHERE.sub(" ", rest)) or r.EXPLICIT.search(rest):
        raise Uncertain
    return _walked(list(_runs(rest, line)), line, rest, said, parameters)


def _noted(match: re.Match[str]) -> str:
    """Nothing for words that say where something is done; those that begin a pass stay."""
    begins = (
        re.search(r"^(?:on|during|for|in) .*(?:run|pass|leg|one)$", match[0], re.IGNORECASE)
        is not None
    )
    led = (
        re.match(
            r"[,:]? (?:keep|stay|at|with|run|go|from|\d)",
            match.string[match.end() :],
            re.IGNORECASE,
        )
        is not None
    )
    return match[0] if begins and led else " " * len(match[0])


def _with_ends(rest: str, ends: Ends) -> str:
    """A text with words for the end of the line where a pass is said to start at its
    coordinates.
    """
    for place in reversed(_places(rest)):
        if place.point in ends and f.STARTS_AT.search(rest[: place.start]):
            rest = (
                rest[: place.start]
                + f"the {'first' if place.point == ends[0] else 'last'} end"
                + rest[place.end :]
            )
    return rest


# ---------------------------------------------------------------- the line


def _on_axes(text: str) -> _Line | None:
    """A line along an axis: one coordinate is fixed, the other one runs from one value to
    another.
    """
    ranges = list(f.RANGE.finditer(text))
    if len(ranges) != 1:
        return None
    axis, one, two = (
        ranges[0]["axis"].lower(),
        f.number(ranges[0]["one"]),
        f.number(ranges[0]["two"]),
    )
    start, end = ranges[0].span()
    rest = text[:start] + BLANK * (end - start) + text[end:]
    fixed = [match for match in f.FIXED.finditer(rest) if match["axis"].lower() != axis]
    values = {f.number(match["at"]) for match in fixed}
    if len(values) != 1 or one == two:
        return None
    at = values.pop()
    ends = (
        (g.point(at, one), g.point(at, two))
        if axis == "y"
        else (g.point(one, at), g.point(two, at))
    )
    before = min(fixed[0].start(), start)
    noun = f.THING.search(f.clause(text[:before]))
    begin = before - (len(f.clause(text[:before])) - noun.start()) if noun else before
    spans = (
        *((match.start(), match.end()) for match in fixed),
        (start, end),
        *([(begin, before)] if noun else []),
    )
    return _Line(ends, spans, solid=noun is not None)


def _between_ends(text: str) -> _Line | None:
    """A thing whose two ends are stated as places."""
    places = _places(text)
    for one, two in itertools.pairwise(places):
        before, behind = f.clause(text[: one.start]), text[two.end :]
        noun, about = f.THING.search(before), f.THING_BEHIND.match(behind)
        if (
            not f.TO_OTHER_END.fullmatch(text[one.end : two.start])
            or (not noun and not about)
            or one.point == two.point
        ):
            continue
        told = (
            about is not None
            or f.IS_LAID.search(before) is not None
            or f.LABEL.fullmatch(before) is not None
        )
        begin = one.start - len(before) + noun.start() if noun and told else one.start
        return _Line(
            (one.point, two.point),
            ((begin, two.end + (about.end() if about else 0)),),
            solid=True,
            told=told,
        )
    return None


def _from_end(text: str) -> _Line | None:
    """A thing of which one end, the length and the direction are stated."""
    places = _places(text)
    if len({place.point for place in places}) != 1:
        return None
    begin, end = f.sentence(text, places[0].start)
    said = text[begin:end]
    noun, laid = f.THING.search(said), f.GOES.search(said)
    lengths = [
        length for length in stated_lengths(said, []) if not _off(said, length[1], length[2])
    ]
    bearings = list(_bearings(said))
    if not noun or not laid or len(lengths) != 1 or len(bearings) != 1:
        return None
    ends = (places[0].point, g.offset(places[0].point, bearings[0][0], lengths[0][0]))
    first = min(begin + noun.start(), places[0].start)
    last = max(places[0].end, begin + lengths[0][2], begin + bearings[0][1], begin + laid.end())
    return _Line(ends, ((first, last),), solid=True)


def _about_middle(text: str, parameters: dict[str, Any]) -> _Line | None:
    """A line of which the middle, the length and the direction are stated."""
    places = [
        place
        for place in _places(text)
        if f.MIDDLE.search(text[: place.start]) or f.MIDDLE_BEHIND.match(text[place.end :])
    ]
    if len(places) != 1 or len(_places(text)) != 1:
        return None
    begin, end = f.sentence(text, places[0].start)
    said = text[begin:end]
    long = [length for length in stated_lengths(said, []) if not _off(said, length[1], length[2])]
    lengths = {value for value, _start, _end in long}
    own = parameters.get("length", parameters.get("max_dist"))
    lengths = lengths or (
        {float(own)} if isinstance(own, int | float) and f.OWN_LENGTH.search(said) else set()
    )
    bearings = list(_bearings(said))
    spans = [(begin + span[1], begin + span[2]) for span in long] + [
        (places[0].start, places[0].end)
    ]
    if len({bearing for bearing, _end in bearings}) > 1 or len(lengths) != 1:
        raise Uncertain
    if bearings:
        bearing = bearings[0][0]
        spans += [(begin + bearings[0][1] - 1, begin + bearings[0][1])]
    else:
        axis = f.LIES_ALONG.search(said)
        if not axis:
            raise Uncertain
        bearing = 0.0 if axis["y"] else 90.0
        spans += [(begin + axis.start(), begin + axis.end())]
    (length,) = lengths
    ends = (
        g.offset(places[0].point, bearing + 180, length / 2),
        g.offset(places[0].point, bearing, length / 2),
    )
    return _Line(ends, tuple(spans), solid=f.SOLID.search(said) is not None)


def _places(text: str) -> list[Place]:
    """The places that are written as such."""
    found = [match for match in r.EXPLICIT.finditer(text) if match["a"] or match["c"]]
    return [
        Place(
            g.point(f.number(match["a"] or match["c"]), f.number(match["b"] or match["d"])),
            match.start(),
            match.end(),
        )
        for match in found
    ]


def _bearings(said: str) -> Iterator[tuple[float, int]]:
    """The bearings that a line is said to have, with where each ends."""
    for match in f.BEARING.finditer(said):
        if not f.FACES.search(said[: match.start()]):
            yield float(match["deg"]) if match["deg"] else w.bearing_of(match["way"]), match.end()


# ---------------------------------------------------------------- the passes


def _runs(rest: str, line: _Line) -> Iterator[_Run]:
    """The parts of the text that ask for a pass."""
    parts = f.PARTS.split(f.THERE_AND_BACK.sub("both ways", f.EACH_RUN.sub(" ", rest)))
    several = len(set(_standoffs(rest))) > 1
    if any(f.SHIFT.match(part) for whole in parts for part in f.SHIFT_PARTS.split(whole)):
        parts = [part for whole in parts for part in f.SHIFT_PARTS.split(whole)]
    numbered = sum(f.NUMBERED.match(part) is not None and bool(_standoffs(part)) for part in parts)
    for part in parts:
        if numbered and f.COUNT.search(part) and not _standoffs(part):
            continue
        if f.SHIFT.match(part) and _standoffs(part) and not _towards(part, line.ends):
            yield _Run(part, 0, back=False, both=False, shift=True)
            continue
        if (
            f.ONLY_KEEPS.match(part)
            and len(parts) > 1
            and not _towards(part, line.ends)
            and any(_towards(other, line.ends) for other in parts)
        ):
            continue
        if (
            several
            and f.COUNT.search(part)
            and not _standoffs(part)
            and not _towards(part, line.ends)
        ):
            continue
        towards, both = (
            _towards(f.BACK_SAME.sub("back", part), line.ends),
            f.BOTH_WAYS.search(part) is not None,
        )
        back = not both and f.BACK.search(part) is not None
        passes = f.PASS.search(r.NO_MOVE.sub(" ", part)) is not None
        passes = passes or (numbered > 0 and f.NUMBERED.match(part) is not None)
        if (
            towards
            or both
            or back
            or (passes and (_standoffs(part) or _named_sides(part) or f.ALONG.search(part)))
        ):
            yield _Run(part, towards, back, both)


def _walked(
    runs: list[_Run], line: _Line, rest: str, said: str, parameters: dict[str, Any]
) -> Path:
    walked: list[Point] = []
    before, distance = 1, None
    counts = {f.COUNTED[match[1].lower()] for match in f.COUNT.finditer(rest)}
    several = f.DISTANCES.search(rest)
    if several:
        return _several(
            [float(value) for value in re.findall(r"\d+(?:\.\d+)?", several[1])],
            counts,
            line,
            rest,
            said,
            parameters,
        )
    shifts = [run for run in runs if run.shift]
    for number, run in enumerate(runs):
        if run.shift:
            distance = _distance(run.part, rest, distance, line, parameters)
            continue
        if number and not run.towards and not run.back and not run.both:
            raise Uncertain
        towards = run.towards or (-before if run.back else before)
        distance = _distance(run.part, rest, distance, line, parameters)
        ends = line.ends if towards > 0 else (line.ends[1], line.ends[0])
        points = (
            list(_beside(ends, _side(run.part, rest, said, parameters, ends), distance))
            if distance
            else list(ends)
        )
        for point in points + ([points[0]] if run.both else []):
            walked += [point] if not walked or walked[-1] != point else []
        before = -towards if run.both else towards
    if (
        not runs
        or len(walked) < 2
        or (counts and counts != {len(runs) - len(shifts) + sum(run.both for run in runs)})
    ):
        raise Uncertain
    return tuple(walked)


def _several(
    distances: list[float],
    counts: set[int],
    line: _Line,
    rest: str,
    said: str,
    parameters: dict[str, Any],
) -> Path:
    """Passes whose distances stand in one list, there and back in turn or all the same way."""
    towards = _towards(f.ALTERNATING.sub(" ", f.SHIFT.sub(" ", rest)), line.ends)
    alternating, same = f.ALTERNATING.search(rest) is not None, f.SAME_WAY.search(rest) is not None
    others = {value for value, _start, _end in stated_sizes(rest, [])} - set(distances)
    if not towards or alternating == same or counts - {len(distances)} or others:
        raise Uncertain
    walked: list[Point] = []
    for number, distance in enumerate(distances):
        ends = (
            line.ends
            if (towards > 0) == (same or number % 2 == 0)
            else (line.ends[1], line.ends[0])
        )
        walked += _beside(ends, _side(rest, rest, said, parameters, line.ends), distance)
    return tuple(walked)


def _towards(part: str, ends: Ends) -> int:
    """Which way a part of the text says that the line is passed: 1 in the order of its ends, -1 the
    other way, 0 where it does not say.
    """
    plain = f.NAMED_SIDE.sub(" ", part)
    ways = [w.bearing_of(match[1]) for match in f.TO_END.finditer(plain)] + [
        w.bearing_of(match[1]) + 180 for match in f.FROM_END.finditer(plain)
    ]
    for match in f.DIRECTION.finditer(f.TO_END.sub(" ", f.FROM_END.sub(" ", plain))):
        ways.append(w.bearing_of(match["to"] or match["way"] or match["go"]))
    found = {_along(ends, *_vector(way)) for way in ways}
    for match in f.GROWING.finditer(plain):
        found.add(
            _along(ends, *((1, 0) if (match[2] or "").lower() == "x" else (0, 1)))
            * (-1 if match[1].lower().startswith(("de", "fall")) else 1)
        )
    if not found:
        found = {1 for _one in f.GIVEN_ORDER.finditer(plain)} | {
            -1 for _one in f.OTHER_ORDER.finditer(plain)
        }
    if len(found) > 1:
        raise Uncertain
    return found.pop() if found else 0


def _along(ends: Ends, x: float, y: float) -> int:
    along = (ends[1][0] - ends[0][0]) * x + (ends[1][1] - ends[0][1]) * y
    if abs(along) < 1e-6:
        raise Uncertain
    return 1 if along > 0 else -1


def _vector(bearing: float) -> tuple[float, float]:
    return math.sin(math.radians(bearing)), math.cos(math.radians(bearing))


def _named_sides(text: str) -> set[float]:
    """Bearings of the sides that a text names by the compass."""
    plain = f.END_OF.sub(" ", text)
    named = {
        w.bearing_of(next(group for group in match.groups() if group))
        for match in f.NAMED_SIDE.finditer(plain)
    }
    return named | {
        float(match[1]) if match[1] else w.bearing_of(match[2])
        for match in f.FACING.finditer(plain)
    }


def _side(
    part: str, rest: str, said: str, parameters: dict[str, Any], ends: Ends
) -> tuple[float, float]:
    """Where the pass lies from the line: on the side named in its part, else in the rest, else that
    of the face that is described, else the task's own.
    """
    for text in (part, rest, said):
        named, hands = _named_sides(text), {_hand(match) for match in f.HAND.finditer(text)}
        if len(named) + len(hands) > 1:
            raise Uncertain
        if named:
            return _vector(named.pop())
        if hands:
            right = hands.pop()
            (one_x, one_y), (two_x, two_y) = ends
            return (two_y - one_y) * right, (one_x - two_x) * right
    own = str(parameters.get("side_id", "")).lower()
    if not r.WAY.fullmatch(own):
        raise Uncertain
    return _vector(w.bearing_of(own))


def _hand(match: re.Match[str]) -> int:
    """1 for the right of the way, -1 for the left: a thing that is kept to port has the vehicle on
    its right.
    """
    right = match["hand"].lower() in ("right", "starboard")
    return 1 if right != bool(match["kept"]) else -1


def _off(text: str, start: int, end: int) -> bool:
    """Whether a length is how far off something is passed."""
    return (
        f.OFF_BEHIND.match(text[end:]) is not None or f.OFF_BEFORE.search(text[:start]) is not None
    )


def _standoffs(text: str) -> list[float]:
    """How far off a text says to keep from the line, in its order."""
    found = []
    for value, start, end in stated_lengths(text, []):
        if f.OFF_ALL.match(text[end:]) or f.MARGIN_BEFORE.search(f.clause(text[:start])):
            continue
        if _off(text, start, end):
            found.append(value)
    return found


def _distance(
    part: str, rest: str, before: float | None, line: _Line, parameters: dict[str, Any]
) -> float | None:
    """How far off a pass is: as its part says, else as the pass before, else as the rest says, else
    the task's own; None along the line itself.
    """
    here, all_said = set(_standoffs(part)), set(_standoffs(rest))
    sizes = {
        value
        for value, start, _end in stated_sizes(rest, [])
        if not w.OTHER_LENGTH.search(f.sentence_at(rest, start))
    }
    if len(here) > 1 or not sizes <= all_said:
        raise Uncertain
    if (
        here
        and before
        and any(
            f.FURTHER.match(part[end:]) or f.FURTHER_BEFORE.search(part[:start])
            for _value, start, end in stated_lengths(part, [])
        )
    ):
        return before + here.pop()
    if here:
        return here.pop()
    multiple = f.MULTIPLE.search(part)
    if multiple and before:
        return before * (0.5 if multiple[1].lower() == "half" else 2)
    if before:
        return before
    if len(all_said) > 1:
        raise Uncertain
    if all_said:
        return all_said.pop()
    own = parameters.get("distance")
    if isinstance(own, int | float) and (line.solid or f.OWN_DISTANCE.search(rest)):
        return float(own)
    if line.solid or f.OWN_DISTANCE.search(rest):
        raise Uncertain
    return None


def _beside(ends: Ends, side: tuple[float, float], distance: float) -> Iterator[Point]:
    """Both ends moved off at right angles to the line, to the side given."""
    (one_x, one_y), (two_x, two_y) = ends
    length = math.hypot(two_x - one_x, two_y - one_y)
    x, y = (two_y - one_y) / length, (one_x - two_x) / length
    towards = (x * side[0] + y * side[1]) / math.hypot(*side)
    if abs(towards) < 0.3:
        raise Uncertain
    sign = math.copysign(distance, towards)
    for point in ends:
        yield g.point(point[0] + sign * x, point[1] + sign * y)
