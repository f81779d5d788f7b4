"""The waypoints of straight runs, cable tracks, passes along a face and ways off a place, where a task input leaves no choice about them.

It reads what `itinerary` is too timid for: a text is searched for the places that it leads to, each by the words before it, for straight runs
("along 45 degrees for 40 m") and for points some way off a place. Whatever leads somewhere and is not understood makes the whole unread.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

from planner_ft.data.numerals import signed
from planner_ft.data.quantities import positions, quantities
from planner_ft.data.task import geometry as g
from planner_ft.data.words import edit_distance, words
from planner_ft.decoding.constraints.facts import read
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths import run_wordings as r
from planner_ft.decoding.constraints.reading.paths.itinerary import plain_text, reworded, unsettled, without_fences
from planner_ft.decoding.constraints.reading.paths.shapes import Place, Point, Uncertain, stated_lengths, stated_sizes
from planner_ft.decoding.constraints.reading.paths.tracks import read_track
from planner_ft.vocabulary import Vocabulary

Path = tuple[Point, ...]
Grade = Literal["sure", "maybe", "mention"]


@dataclass(frozen=True)
class _Event:
    """Something that leads to a place: the place itself, or a way (bearing, length) from where the vehicle is, from `start` to `end` of the text.

    `sure`: the words say so; `maybe`: it is said beside something else ("while going to"), and counts where the place is not named otherwise;
    `mention`: it is spoken of only. `since`: where the words begin that are understood with it.
    """

    start: int
    end: int
    point: Point | None
    way: tuple[float, float] | None = None
    grade: Grade = "sure"
    since: int | None = None


@dataclass(frozen=True)
class _Facts:
    parameters: dict[str, Any]
    own: Point | None
    home: Point

    def number(self, *names: str) -> float | None:
        """The first of these parameters that the task has."""
        return next((value for name in names if isinstance(value := self.parameters.get(name), int | float)), None)


SHIFTED = re.compile(r"\b(?:shifted|displaced) (?:by )?\d", re.IGNORECASE)
"""A line that is moved aside as a whole: not read."""


def read_runs(record: dict[str, Any], vocabulary: Vocabulary) -> Path | None:
    """Every waypoint of the answer in order, where the input leaves no choice; None where it does."""
    given = record.get("parameters")
    parameters = given if isinstance(given, dict) else {}
    if read(str(record.get("prompt", "")), vocabulary).numbers_free:
        return None
    facts = _Facts(parameters, _own_place(parameters), g.point(*vocabulary.home))
    fenced = w.LIST_MARK.sub(lambda mark: ";" + " " * (len(mark[0]) - 1), plain_text(str(record.get("prompt", ""))))
    plain = without_fences(fenced)
    text = reworded(plain)
    if text is None or SHIFTED.search(text):
        return None
    try:
        track = read_track(text, parameters)
        if track is not None:
            return track
        if (
            r.STOP.search(_unquoted(text))
            or r.ORDER.search(text)
            or _misspelt(text)
            or _led_to(fenced, plain)
            or (w.ROW.search(text) and r.BOUNDS.search(_clipped(text)))
        ):
            return None
        walked = _walked(_events(text, facts), text, facts.home)
    except Uncertain:
        return None
    unresolved = g.point(*vocabulary.unresolved)
    if any(one == two for one, two in itertools.pairwise(walked)) or (unresolved in walked and facts.own != unresolved) or unsettled(walked, text, facts.home):
        return None
    if facts.own is not None and facts.own not in walked and r.OWN_LEADS.search(text):
        return None
    return tuple(walked) or None


def _own_place(parameters: dict[str, Any]) -> Point | None:
    """The one place among the task's parameters."""
    pairs = [value for value in parameters.values() if isinstance(value, list) and len(value) == 2]
    own = [pair for pair in pairs if all(isinstance(item, int | float) for item in pair)]
    return g.point(*own[0]) if len(own) == 1 else None


def _unquoted(text: str) -> str:
    """A text with blanks for notes and names, which say nothing about the way."""
    return r.QUOTED.sub(lambda quoted: " " * len(quoted[0]), text)


def _clipped(text: str) -> str:
    """The sentences with a row of places."""
    return " ".join(text[max(0, row.start() - 60) : row.end() + 60] for row in w.ROW.finditer(text))


def _led_to(fenced: str, text: str) -> bool:
    """Whether a row of places that was taken for a boundary stands behind words that lead to a place."""
    return any(r.TO_PLACE.search(fenced[: row.start()]) and not text[row.start() : row.end()].strip() for row in w.ROW.finditer(fenced))


def _misspelt(text: str) -> bool:
    """Whether a word may be the name of a shape with a letter wrong."""
    return any(edit_distance(word, shape, 1) == 1 for word in words(text) if len(word) > 4 for shape in r.SHAPE_NAMES if word not in r.SHAPE_NAMES)


# ---------------------------------------------------------------- what leads where


def _events(text: str, facts: _Facts) -> list[_Event]:
    """Everything that leads somewhere or names a place, in the order of the text."""
    places = list(_places(text))
    bare = _unquoted(_blank(text, places))
    if r.UNPLACED.search(bare) or r.UNPLACED_NEXT.search(re.sub("§+", "§", bare)):
        raise Uncertain
    own, homes = list(_own(bare, facts)), list(_homes(bare, facts))
    idle = {start for start, _end, _point, leads in own if not leads}
    mentioned = sorted([*((place.start, place.end, place.point) for place in places), *(found[:3] for found in own), *homes])
    events: list[_Event] = []
    homes_meant = [(match.start("home"), match.end("home"), facts.home) for match in r.OF_OWN_HOME.finditer(bare)]
    ways = list(_ways(bare, sorted([*mentioned, *homes_meant])))
    used = {anchor for _event, anchor in ways if anchor is not None}
    events += [event for event, _anchor in ways]
    explicit, home = {place.start for place in places}, {found[0] for found in homes}
    for start, end, point in mentioned:
        if start in used:
            continue
        last = max((event for event in events if event.end <= start), key=lambda event: event.end, default=None)
        grade = _grade(text[:start], last, explicit=start in explicit, home=start in home)
        grade = "mention" if start in idle or r.IS_BEHIND.match(text[end:]) else grade
        if grade == "maybe" and _row(text, start, end, places):
            raise Uncertain
        events.append(_Event(start, end, point, grade=grade))
    for event, _anchor in ways:
        bare = bare[: event.start] + " " * (event.end - event.start) + bare[event.end :]
    events += _lines(bare, events, facts)
    return sorted(events, key=lambda event: event.start)


def _blank(text: str, places: list[Place]) -> str:
    """A text with a mark on each letter of its places."""
    for place in places:
        text = text[: place.start] + "§" * (place.end - place.start) + text[place.end :]
    return text


def _places(text: str) -> Iterator[Place]:
    """The places that the text states: pairs in brackets, with axes or with directions; and two numbers behind words that lead to a place."""
    found: list[Place] = []
    for match in r.EXPLICIT.finditer(text):
        found += _explicit(match, text)
    rest = _blank(text, found)
    pairs = [pair for pair in positions(rest) if _can_be_pair(rest, pair[2], pair[3])]
    leading = [pair for pair in pairs if _is_pair(rest, pair[2], pair[3])]
    if any(one[3] > two[2] for one, two in itertools.pairwise(sorted(leading, key=lambda pair: pair[2]))):
        raise Uncertain
    if any(not any(pair[2] < one[3] and one[2] < pair[3] for one in leading) and not _are_angles(rest, pair[2], pair[3]) for pair in pairs):
        raise Uncertain
    bare = [Place(g.point(x, y), start - _sign(rest[:start]), end) for x, y, start, end in leading]
    yield from sorted([*found, *bare], key=lambda place: place.start)


def _sign(before: str) -> int:
    """How long the sign is at the end of a text: "minus " or "-"."""
    match = r.SIGN_BEFORE.search(before)
    return len(match[0]) if match else 0


def _can_be_pair(text: str, start: int, end: int) -> bool:
    """Whether two bare numbers are no sizes, times, angles and counts."""
    said = re.sub(r"\bminus\b", "", text[start:end], flags=re.IGNORECASE)
    return not (w.SIZE.search(said) or r.ANGLE_UNIT.search(said) or "§" in said or r.MEASURED.match(text[end:]) or w.COUNTS.search(text[:start]))


def _are_angles(text: str, start: int, end: int) -> bool:
    """Whether two bare numbers are angles."""
    return r.ANGLES.search(text[:start]) is not None and r.SIGNED.search(text[max(0, start - 9) : end]) is None


def _is_pair(text: str, start: int, end: int) -> bool:
    """Whether two bare numbers are a place: with a sign, or behind words that lead to one."""
    if r.ANGLES.search(text[:start]):
        return False
    return r.SIGNED.search(text[max(0, start - 9) : end]) is not None or r.TO_PLACE.search(text[:start]) is not None


def _explicit(match: re.Match[str], text: str) -> list[Place]:
    """The place that EXPLICIT has found."""
    if match["a"] or match["c"]:
        x, y = signed(match["a"] or match["c"]), signed(match["b"] or match["d"])
        return [Place(g.point(x, y), match.start(), match.end())]
    first, second = match["f"].lower(), match["i"].lower()
    if (first in ("east", "west")) == (second in ("east", "west")) or (match["j"] and not r.OF_HOME.match(match["j"])):
        raise Uncertain
    one, two = (signed(match[value]) * (-1 if way in ("west", "south") else 1) for value, way in (("e", first), ("h", second)))
    return [Place(g.point(one, two) if first in ("east", "west") else g.point(two, one), match.start(), match.end())]


def _leads(before: str) -> bool:
    """Whether words that lead to a place stand at the end."""
    return (
        any(pattern.search(before) for pattern in (r.TO_PLACE, r.REACHING, r.FROM_PLACE))
        or re.search(r"§[\s,]*(?:(?:and|then|to|on)[\s,]+)*$", before) is not None
    )


def _own(bare: str, facts: _Facts) -> Iterator[tuple[int, int, Point, bool]]:
    """Where the text speaks of the task's own place, and whether as one to go to."""
    lengths = {start for _value, start, _end in stated_lengths(bare, [])}
    for match in itertools.chain(r.OWN.finditer(bare), r.LAST_SEEN.finditer(bare)):
        noun = (match.groupdict().get("noun") or "").lower()
        before, behind = bare[: match.start()], bare[match.end() :]
        listed = (r.LISTED.search(before) or r.OPENING.match(_clause(before))) and r.LISTED_BEHIND.match(behind)
        leads = listed or _leads(before) or r.AT_PLACE.search(before) or r.FROM_OPENING.match(_clause(before))
        if (
            any(match.end() < start < match.end() + 7 and "§" not in bare[match.end() : start] and bare[match.end()] == " " for start in lengths)
            or r.FROM_TO.match(behind)
            or (noun == "start" and r.BARE_START.match(match[0]) and not listed)
            or (r.BARE_START.match(match[0]) and behind[:1] == ":")
        ):
            continue
        if r.NO_OWN.search(before) or r.NO_OWN_BEHIND.match(behind) or not (leads or r.AT.search(before) or r.GIVEN_PLACE.search(match[0])):
            continue
        starts = "start" in match[0].lower() or noun == "beginning"
        if starts and leads and r.BACK_START.search(before) and not re.search(r" (?:of|in) ", match[0]):
            raise Uncertain
        if r.NAMES_NEXT.match(behind):  # "the start at [3, 4]" names one place twice
            continue
        foreign = facts.own is None or (starts and "start" not in facts.parameters) or r.HERE.search(match[0])
        if foreign and leads:
            raise Uncertain
        if facts.own is not None and not foreign:
            yield match.start(), match.end(), facts.own, bool(leads)


def _homes(bare: str, facts: _Facts) -> Iterator[tuple[int, int, Point]]:
    """Where the text leads home, or into the berth."""
    if facts.own is not None and "goal_position" in facts.parameters:
        inwards = [match for match in r.GO_IN.finditer(bare) if not r.SUBORDINATE.search(_clause(bare[: match.start()]))]
        yield from ((match.start(), match.end(), facts.own) for match in inwards)
    yield from ((match.start(), match.end(), facts.home) for match in r.HOME.finditer(bare) if not r.NO_HOME.search(bare[: match.start()]))


def _clause(before: str) -> str:
    """What stands behind the last mark."""
    return re.split(r"[.;:]\s|[–—]\s", before)[-1]


def _row(text: str, start: int, end: int, places: list[Place]) -> bool:
    """Whether a place stands in a row of three or more, as the corners of areas do."""
    near = [
        place
        for place in places
        if place.start >= start and not re.search(r"[^\s,;]", re.sub(r"\band\b", "", _blank(text, places)[end : place.start].replace("§", "")))
    ]
    return len(near) > 2


def _grade(text: str, last: _Event | None, *, explicit: bool, home: bool) -> Grade:
    """How certain a place is to be gone to, by the text before it."""
    before = text[last.end :] if last else text
    clause = _clause(text)
    if r.NEGATED.search(clause) or r.OFF_PLACE.search(clause):
        return "mention"
    if last is not None and r.LINK.match(before) and "." not in before and ";" not in before:
        return last.grade
    noun = r.NOUN_WAY.search(clause)
    if noun and not r.OPENING.match(clause) and (r.ARTICLE_WAY.search(clause[: noun.start()]) or noun[0].lower().startswith(("get", "way", "leg"))):
        return "maybe"
    if r.BETWEEN_HERE.search(clause):
        return "maybe"
    if r.ROUND.search(clause):
        return "mention"
    if r.SUBORDINATE.search(clause):
        return "maybe"
    if home:
        return "sure"
    if _leads(clause) or r.AT_PLACE.search(clause) or r.OPENING.match(clause) or r.SEQUENCE.search(text[-60:]):
        return "sure"
    if r.MENTION.search(clause):
        return "mention"
    if explicit and (r.TO_THING.search(clause) or r.TO_THING_NEXT.search(clause)):
        return "sure"
    return "maybe" if explicit and r.DONE_AT.search(clause) and not r.NO_OWN.search(clause) else "mention"


# ---------------------------------------------------------------- ways off and straight runs


def _ways(bare: str, mentioned: list[tuple[int, int, Point]]) -> Iterator[tuple[_Event, int | None]]:
    """Lengths with a direction: "80 m north of the buoy at [75, 50]", "then 30 m due west"; with where the place stands that it is counted from."""
    for match in r.STOP_SHORT.finditer(bare):
        base = next((one for one in mentioned if one[0] <= match.start() < one[1] or one[1] == match.start()), None)
        lengths = [value for value, start, _end in stated_lengths(bare, []) if match.start(2) <= start < match.end()]
        if base is None or len(lengths) != 1:
            raise Uncertain
        yield _Event(base[0], match.end(), g.offset(base[2], w.bearing_of(match[1]), lengths[0])), base[0]
    yield from _offsets(bare, mentioned)


def _offsets(bare: str, mentioned: list[tuple[int, int, Point]]) -> Iterator[tuple[_Event, int | None]]:
    """Ways counted from a place or from where the vehicle is; two that are joined ("20 m east and 30 m north of") are one."""
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
        yield _Event(joined[0][0], behind if again else about[1], point), None if again else about[0]
        joined = []
    yield from _legs(joined, bare, mentioned)


def _anchor(bare: str, behind: int, mentioned: list[tuple[int, int, Point]]) -> tuple[int, int, Point]:
    """What a way off is counted from."""
    anchor = next((one for one in mentioned if one[0] >= behind), None)
    if anchor is None or not r.ANCHOR.fullmatch(bare[behind : anchor[0]]):
        raise Uncertain
    return anchor


def _legs(legs: list[tuple[int, int, float, float]], bare: str, mentioned: list[tuple[int, int, Point]]) -> Iterator[tuple[_Event, int | None]]:
    """Ways from where the vehicle is, or from a place that follows them: "sail 25 m north-east from [3, 4]"."""
    if len(legs) > 1:
        raise Uncertain
    for start, behind, bearing, value in legs:
        anchor = next((one for one in mentioned if one[0] >= behind), None)
        if anchor is not None and r.FROM_IT.match(bare[behind : anchor[0]]):
            yield _Event(start, anchor[1] - 1, anchor[2]), anchor[0]
            yield _Event(anchor[1], anchor[1], None, (bearing, value)), None
        else:
            yield _Event(start, behind, None, (bearing, value)), None


def _lines(bare: str, events: list[_Event], facts: _Facts) -> list[_Event]:
    """Straight runs whose direction and length stand apart, one in each part of the text at most."""
    found: list[_Event] = []
    bounds = [0, *(match.end() for match in w.PART.finditer(bare)), len(bare)]
    for start, end in itertools.pairwise(bounds):
        inside = [event for event in events if start <= event.start < end]
        line = _line(bare[start:end], start, inside, facts)
        before = [event for event in [*events, *found] if event.grade != "mention" and event.start < end]
        if line and _is_own_track(bare[start:end], facts) and (not before or max(before, key=lambda event: event.end).point != facts.own):
            raise Uncertain
        found += [line] if line else _whole_track(bare[start:end], start, inside, facts)
    return found


def _line(part: str, at: int, inside: list[_Event], facts: _Facts) -> _Event | None:
    """The straight run in a part of the text that begins at `at`, with the events `inside` it."""
    if any(event.way for event in inside) or not r.LINE.search(part):
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
    verbs = [match.start() for match in r.LINE.finditer(part[: max(one, two)])]
    if not verbs or r.NO_LINE.search(part[max([verb for verb in verbs if verb < one] or verbs) : max(one, two)]):
        raise Uncertain
    behind = [event for event in inside if event.start - at >= min(one, two)]
    if len(behind) > 1 or (behind and not r.STARTING.search(part[: behind[0].start - at])) or (behind and len(inside) > 1):
        raise Uncertain
    if sum(event.grade != "mention" for event in inside) > 1 and r.PARALLEL.search(part):
        raise Uncertain
    place = behind[0].end if behind else at + max(one, two)
    done = max((event.end - at for event in inside if event.end - at <= max(one, two)), default=0)
    return _Event(place, place, None, (heading, length), since=at + next((verb for verb in verbs if verb >= done), verbs[-1]))


def _is_own_track(part: str, facts: _Facts) -> bool:
    """Whether a run is the task's own track, which begins at its start whether or not the text says so."""
    return "start" in facts.parameters and r.OWN_HEADING.search(part) is not None and not r.FROM_ANY.search(part)


def _run_sizes(part: str, facts: _Facts) -> tuple[dict[float, int], dict[float, int]]:
    """Lengths and bearings that a run in a part of the text can have, the task's own included, with where each ends."""
    lengths = {value: end for value, _start, end in stated_sizes(part, [])}
    lengths |= {value: end for value, start, end in stated_lengths(part, []) if r.RUN_BEHIND.match(part[end:]) or r.RUN_BEFORE.search(part[:start])}
    lengths = {value: end for value, end in lengths.items() if not r.OFF.match(part[end:])}
    headings = _headings(part)
    own_length, own_heading = r.OWN_LENGTH.search(part), r.OWN_HEADING.search(part)
    if own_length and (length := facts.number("max_dist", "length")) is not None:
        lengths.setdefault(length, own_length.end())
    if not lengths and headings and (travelled := _travelled(part)) is not None:
        lengths[travelled] = len(part)
    along = own_heading or (r.ALONG_IT.search(part) if lengths else None)
    if along and not headings and (heading := facts.number("heading")) is not None:
        headings[heading] = along.end()
    return lengths, headings


def _check_no_run(part: str, at: int, inside: list[_Event], lengths: dict[float, int], headings: dict[float, int]) -> None:
    """That a part which names a length or a bearing alone speaks of no run."""
    own_length, own_heading = r.OWN_LENGTH.search(part), r.OWN_HEADING.search(part)
    if (own_length and (headings or own_heading)) or (lengths and (own_heading or r.SOME_HEADING.search(part))):
        raise Uncertain
    gone_to = [event for event in inside if event.grade != "mention"]
    if (headings or lengths) and len(gone_to) == 1 and r.FROM_END.search(part[: gone_to[0].start - at]):
        raise Uncertain


def _headings(part: str) -> dict[float, int]:
    """The bearings that a part of the text names for a way, with where each ends."""
    found = {float(match[1]) if match[1] else w.bearing_of(match[2]): match for match in r.HEADING.finditer(part)}
    found |= {w.bearing_of(match[1] or match[2]): match for match in r.DUE.finditer(part)}
    return {bearing: match.end() for bearing, match in found.items() if not _arrives(part[: match.start()])}


def _arrives(before: str) -> bool:
    """Whether a bearing behind these words is one to arrive on: "go to [3, 4], heading 315"."""
    return r.ARRIVING.search(before) is not None or (r.ARRIVAL.search(before) is not None and not r.PLACE_FROM.search(before))


def _travelled(part: str) -> float | None:
    """How far a stated speed leads in a stated time."""
    found = [
        g.tidy(speed.value * time.value)
        for speed, time in itertools.pairwise(quantities(part))
        if speed.unit == "m/s" and time.unit == "s" and r.AT_SPEED.fullmatch(part[speed.end : time.start])
    ]
    return found[0] if len(found) == 1 else None


def _whole_track(part: str, at: int, inside: list[_Event], facts: _Facts) -> list[_Event]:
    """The task's own track, where a part of the text asks for it as a whole: "run the planned track"."""
    match = r.WHOLE_TRACK.search(part)
    if match is None:
        if r.ANY_TRACK.search(part):
            raise Uncertain
        return []
    heading, length = facts.number("heading"), facts.number("max_dist")
    if facts.own is None or heading is None or length is None or "start" not in facts.parameters or any(event.point != facts.own for event in inside):
        raise Uncertain
    start = [] if inside else [_Event(at + match.start(), at + match.start() + 1, facts.own)]
    end = max([at + match.end(), *(event.end for event in inside)])
    return [*start, _Event(end, end, None, (heading, length))]


# ---------------------------------------------------------------- the whole way


def _walked(events: list[_Event], text: str, home: Point) -> list[Point]:
    """The waypoints, where all that leads somewhere is understood."""
    events = _once(events)
    if not any(event.grade != "mention" for event in events):
        raise Uncertain
    _check_rest(events, text)
    walked: list[Point] = []
    for event in events:
        if event.grade == "mention":
            continue
        if event.point is not None:
            walked.append(event.point)
        elif event.way is not None and (walked or r.STARTS_HOME.search(text)):
            walked.append(g.offset(walked[-1] if walked else home, *event.way))
        else:
            raise Uncertain
    if len(walked) > 1 and (r.BEFORE_FIRST.search(text) or r.FIRST_LAST.search(text) or _turned_round(text, events)):
        raise Uncertain
    return walked


def _once(events: list[_Event]) -> list[_Event]:
    """The events without those that name a place again beside something else."""
    sure = {event.point for event in events if event.grade == "sure" and event.point is not None}
    seen: set[Point] = set()
    kept = []
    for event in events:
        if (
            event.grade == "mention"
            and event.point not in sure
            and event.point is not None
            and not any(event.point == one.point for one in events if one.grade == "maybe")
        ):
            raise Uncertain
        if event.grade == "maybe" and event.point is not None:
            if event.point in sure or event.point in seen:
                continue
            seen.add(event.point)
        kept.append(event)
    return kept


def _turned_round(text: str, events: list[_Event]) -> bool:
    """Whether a clause speaks of a place after one that comes later: "Go to B after the run to A"."""
    starts = [event.start for event in events if event.grade != "mention"]
    return any(r.AFTER_INSIDE.search(re.split(r"[.;]\s", text[:start])[-1]) for start in starts[1:])


def _check_rest(events: list[_Event], text: str) -> None:
    """Whatever leads somewhere must be part of what was understood."""
    rest = text
    for event in events:
        clause = _clause(text[: event.start])
        begin = event.start - min(len(re.split(r",|\bthen\b|\band\b", clause)[-1]), 70)
        begin = begin if event.since is None else min(begin, event.since)
        rest = rest[:begin] + " " * (event.end - begin) + rest[event.end :]
    rest = r.NO_MOVE.sub(" ", _unquoted(rest))
    if r.MOVE.search(rest):
        raise Uncertain
    walked = {event.way[1] for event in events if event.way}
    for value, start, _end in stated_sizes(text, list(_places(text))):
        said = value in walked or any(event.start <= start < event.end for event in events)
        if not said and not w.OTHER_LENGTH.search(re.split(r"[.;]\s", text[:start])[-1] + re.split(r"[.;](?:\s|$)", text[start:])[0]):
            raise Uncertain
