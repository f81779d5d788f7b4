"""Straight runs whose direction and length stand apart ("along 45 degrees for 40 m"), and the
task's own track.
"""

from __future__ import annotations

import itertools

from planner_ft.data.quantities import quantities
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths import run_wordings as r
from planner_ft.decoding.constraints.reading.paths import straight_run_wordings as s
from planner_ft.decoding.constraints.reading.paths.run_parts import Event, TaskFacts
from planner_ft.decoding.constraints.reading.paths.shapes import (
    Uncertain,
    stated_lengths,
    stated_sizes,
)


def straight_runs(bare: str, events: list[Event], facts: TaskFacts) -> list[Event]:
    """Straight runs whose direction and length stand apart, one in each part of the text at
    most.
    """
    found: list[Event] = []
    bounds = [0, *(match.end() for match in w.PART.finditer(bare)), len(bare)]
    for start, end in itertools.pairwise(bounds):
        inside = [event for event in events if start <= event.start < end]
        line = _line(bare[start:end], start, inside, facts)
        before = [
            event for event in [*events, *found] if event.grade != "mention" and event.start < end
        ]
        if (
            line
            and _is_own_track(bare[start:end], facts)
            and (not before or max(before, key=lambda event: event.end).point != facts.own)
        ):
            raise Uncertain
        found += [line] if line else _whole_track(bare[start:end], start, inside, facts)
    return found


def _line(part: str, at: int, inside: list[Event], facts: TaskFacts) -> Event | None:
    """The straight run in a part of the text that begins at `at`, with the events `inside` it."""
    if any(event.way for event in inside) or not s.LINE.search(part):
        return None
    lengths, headings = _run_sizes(part, facts)
    if lengths and r.SIXTEENTH.search(part):
        raise Uncertain
    if not lengths or not headings:
        _check_no_run(part, at, inside, lengths, headings)
        return None
    if len(lengths) > 1 or len(headings) > 1:
        raise Uncertain
    ((length, one),) = lengths.items()
    ((heading, two),) = headings.items()
    verbs = [match.start() for match in s.LINE.finditer(part[: max(one, two)])]
    if not verbs or s.NO_LINE.search(
        part[max([verb for verb in verbs if verb < one] or verbs) : max(one, two)]
    ):
        raise Uncertain
    behind = [event for event in inside if event.start - at >= min(one, two)]
    if (
        len(behind) > 1
        or (behind and not s.STARTING.search(part[: behind[0].start - at]))
        or (behind and len(inside) > 1)
    ):
        raise Uncertain
    if sum(event.grade != "mention" for event in inside) > 1 and s.PARALLEL.search(part):
        raise Uncertain
    place = behind[0].end if behind else at + max(one, two)
    done = max((event.end - at for event in inside if event.end - at <= max(one, two)), default=0)
    return Event(
        place,
        place,
        None,
        (heading, length),
        since=at + next((verb for verb in verbs if verb >= done), verbs[-1]),
    )


def _is_own_track(part: str, facts: TaskFacts) -> bool:
    """Whether a run is the task's own track, which begins at its start whether or not the text says
    so.
    """
    return (
        "start" in facts.parameters
        and s.OWN_HEADING.search(part) is not None
        and not s.FROM_ANY.search(part)
    )


# ---------------------------------------------------------------- how far, and where to


def _run_sizes(part: str, facts: TaskFacts) -> tuple[dict[float, int], dict[float, int]]:
    """Lengths and bearings that a run in a part of the text can have, the task's own included, with
    where each ends.
    """
    lengths = {value: end for value, _start, end in stated_sizes(part, [])}
    lengths |= {
        value: end
        for value, start, end in stated_lengths(part, [])
        if s.RUN_BEHIND.match(part[end:]) or s.RUN_BEFORE.search(part[:start])
    }
    lengths = {value: end for value, end in lengths.items() if not s.OFF.match(part[end:])}
    headings = _headings(part)
    own_length, own_heading = s.OWN_LENGTH.search(part), s.OWN_HEADING.search(part)
    if own_length and (length := facts.number("max_dist", "length")) is not None:
        lengths.setdefault(length, own_length.end())
    if not lengths and headings and (travelled := _travelled(part)) is not None:
        lengths[travelled] = len(part)
    along = own_heading or (s.ALONG_IT.search(part) if lengths else None)
    if along and not headings and (heading := facts.number("heading")) is not None:
        headings[heading] = along.end()
    return lengths, headings


def _check_no_run(
    part: str, at: int, inside: list[Event], lengths: dict[float, int], headings: dict[float, int]
) -> None:
    """That a part which names a length or a bearing alone speaks of no run."""
    own_length, own_heading = s.OWN_LENGTH.search(part), s.OWN_HEADING.search(part)
    if (own_length and (headings or own_heading)) or (
        lengths and (own_heading or s.SOME_HEADING.search(part))
    ):
        raise Uncertain
    gone_to = [event for event in inside if event.grade != "mention"]
    if (
        (headings or lengths)
        and len(gone_to) == 1
        and s.FROM_END.search(part[: gone_to[0].start - at])
    ):
        raise Uncertain


def _headings(part: str) -> dict[float, int]:
    """The bearings that a part of the text names for a way, with where each ends."""
    found = {
        float(match[1]) if match[1] else w.bearing_of(match[2]): match
        for match in s.HEADING.finditer(part)
    }
    found |= {w.bearing_of(match[1] or match[2]): match for match in s.DUE.finditer(part)}
    return {
        bearing: match.end()
        for bearing, match in found.items()
        if not _arrives(part[: match.start()])
    }


def _arrives(before: str) -> bool:
    """Whether a bearing behind these words is one to arrive on: "go to [3, 4], heading 315"."""
    return s.ARRIVING.search(before) is not None or (
        s.ARRIVAL.search(before) is not None and not s.PLACE_FROM.search(before)
    )


def _travelled(part: str) -> float | None:
    """How far a stated speed leads in a stated time."""
    found = [
        g.tidy(speed.value * time.value)
        for speed, time in itertools.pairwise(quantities(part))
        if speed.unit == "m/s"
        and time.unit == "s"
        and s.AT_SPEED.fullmatch(part[speed.end : time.start])
    ]
    return found[0] if len(found) == 1 else None


# ---------------------------------------------------------------- the task's own track


def _whole_track(part: str, at: int, inside: list[Event], facts: TaskFacts) -> list[Event]:
    """The task's own track, where a part of the text asks for it as a whole: "run the planned
    track".
    """
    match = s.WHOLE_TRACK.search(part)
    if match is None:
        if s.ANY_TRACK.search(part):
            raise Uncertain
        return []
    heading, length = facts.number("heading"), facts.number("max_dist")
    if (
        facts.own is None
        or heading is None
        or length is None
        or "start" not in facts.parameters
        or any(event.point != facts.own for event in inside)
    ):
        raise Uncertain
    start = [] if inside else [Event(at + match.start(), at + match.start() + 1, facts.own)]
    end = max([at + match.end(), *(event.end for event in inside)])
    return [*start, Event(end, end, None, (heading, length))]
