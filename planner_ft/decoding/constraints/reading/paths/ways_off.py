"""Lengths with a direction: "80 m north of the buoy at (75, 50)", "then 30 m due west"."""

from __future__ import annotations

from collections.abc import Iterator

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths import run_wordings as r
from planner_ft.decoding.constraints.reading.paths.run_parts import Event
from planner_ft.decoding.constraints.reading.paths.shapes import Point, Uncertain, stated_lengths


def ways_off(
    bare: str, mentioned: list[tuple[int, int, Point]]
) -> Iterator[tuple[Event, int | None]]:
    """Lengths with a direction: "80 m north of the buoy at [75, 50]", "then 30 m due west"; with
    where the place stands that it is counted from.
    """
    for match in r.STOP_SHORT.finditer(bare):
        base = next(
            (
                one
                for one in mentioned
                if one[0] <= match.start() < one[1] or one[1] == match.start()
            ),
            None,
        )
        lengths = [
            value
            for value, start, _end in stated_lengths(bare, [])
            if match.start(2) <= start < match.end()
        ]
        if base is None or len(lengths) != 1:
            raise Uncertain
        yield (
            Event(base[0], match.end(), g.offset(base[2], w.bearing_of(match[1]), lengths[0])),
            base[0],
        )
    yield from _offsets(bare, mentioned)


def _offsets(
    bare: str, mentioned: list[tuple[int, int, Point]]
) -> Iterator[tuple[Event, int | None]]:
    """Ways counted from a place or from where the vehicle is; two that are joined ("20 m east and
    30 m north of") are one.
    """
    joined: list[tuple[int, int, float, float]] = []
    about: tuple[int, int, Point] | None = None
    for value, start, end in stated_lengths(bare, []):
        match = r.WAY_BEHIND.match(bare[end:])
        if match is None:
            continue
        if r.SIXTEENTH.match(match[0].strip() + bare[end + match.end() :][:12]):
            raise Uncertain
        bearing, behind = w.bearing_of(match[1]), end + match.end()
        if joined and not r.JOINS.fullmatch(bare[joined[-1][1] : start]):
            yield from _legs(joined, bare, mentioned)
            joined = []
        joined.append((start, behind, bearing, value))
        if match[2] is None:
            continue
        if not r.OF_IT.match(bare[behind:]):
            about = _anchor(bare, behind, mentioned)
        elif about is None and not r.BY_WAY.search(bare[: joined[0][0]]):
            about = max((one for one in mentioned if one[1] <= joined[0][0]), default=None)
        if about is None or len(joined) > 2:
            raise Uncertain
        point = about[2]
        for _start, _end, way, length in joined:
            point = g.offset(point, way, length)
        again = about[0] < start
        yield Event(joined[0][0], behind if again else about[1], point), None if again else about[0]
        joined = []
    yield from _legs(joined, bare, mentioned)


def _anchor(
    bare: str, behind: int, mentioned: list[tuple[int, int, Point]]
) -> tuple[int, int, Point]:
    """What a way off is counted from."""
    anchor = next((one for one in mentioned if one[0] >= behind), None)
    if anchor is None or not r.ANCHOR.fullmatch(bare[behind : anchor[0]]):
        raise Uncertain
    return anchor


def _legs(
    legs: list[tuple[int, int, float, float]], bare: str, mentioned: list[tuple[int, int, Point]]
) -> Iterator[tuple[Event, int | None]]:
    """Ways from where the vehicle is, or from a place that follows them: "sail 25 m north-east from
    [3, 4]".
    """
    if len(legs) > 1:
        raise Uncertain
    for start, behind, bearing, value in legs:
        anchor = next((one for one in mentioned if one[0] >= behind), None)
        if anchor is not None and r.FROM_IT.match(bare[behind : anchor[0]]):
            yield Event(start, anchor[1] - 1, anchor[2]), anchor[0]
            yield Event(anchor[1], anchor[1], None, (bearing, value)), None
        else:
            yield Event(start, behind, None, (bearing, value)), None
