"""Which places of a text are gone to: the task's own place, home, and how certain the words before
a place make it.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator

from planner_ft.decoding.constraints.reading.paths import destination_wordings as d
from planner_ft.decoding.constraints.reading.paths.run_parts import (
    Event,
    Grade,
    TaskFacts,
    last_clause,
    without_places,
)
from planner_ft.decoding.constraints.reading.paths.shapes import (
    Place,
    Point,
    Uncertain,
    stated_lengths,
)


def own_places(bare: str, facts: TaskFacts) -> Iterator[tuple[int, int, Point, bool]]:
    """Where the text speaks of the task's own place, and whether as one to go to."""
    lengths = {start for _value, start, _end in stated_lengths(bare, [])}
    for match in itertools.chain(d.OWN.finditer(bare), d.LAST_SEEN.finditer(bare)):
        noun = (match.groupdict().get("noun") or "").lower()
        before, behind = bare[: match.start()], bare[match.end() :]
        listed = (
            d.LISTED.search(before) or d.OPENING.match(last_clause(before))
        ) and d.LISTED_BEHIND.match(behind)
        leads = (
            listed
            or _leads(before)
            or d.AT_PLACE.search(before)
            or d.FROM_OPENING.match(last_clause(before))
        )
        if (
            any(
                match.end() < start < match.end() + 7
                and "§" not in bare[match.end() : start]
                and bare[match.end()] == " "
                for start in lengths
            )
            or d.FROM_TO.match(behind)
            or (noun == "start" and d.BARE_START.match(match[0]) and not listed)
            or (d.BARE_START.match(match[0]) and behind[:1] == ":")
        ):
            continue
        if (
            d.NO_OWN.search(before)
            or d.NO_OWN_BEHIND.match(behind)
            or not (leads or d.AT.search(before) or d.GIVEN_PLACE.search(match[0]))
        ):
            continue
        starts = "start" in match[0].lower() or noun == "beginning"
        if (
            starts
            and leads
            and d.BACK_START.search(before)
            and not re.search(r" (?:of|in) ", match[0])
        ):
            raise Uncertain
        if d.NAMES_NEXT.match(behind):  # "the start at [3, 4]" names one place twice
            continue
        foreign = (
            facts.own is None
            or (starts and "start" not in facts.parameters)
            or d.HERE.search(match[0])
        )
        if foreign and leads:
            raise Uncertain
        if facts.own is not None and not foreign:
            yield match.start(), match.end(), facts.own, bool(leads)


def ways_home(bare: str, facts: TaskFacts) -> Iterator[tuple[int, int, Point]]:
    """Where the text leads home, or into the berth."""
    if facts.own is not None and "goal_position" in facts.parameters:
        inwards = [
            match
            for match in d.GO_IN.finditer(bare)
            if not d.SUBORDINATE.search(last_clause(bare[: match.start()]))
        ]
        yield from ((match.start(), match.end(), facts.own) for match in inwards)
    yield from (
        (match.start(), match.end(), facts.home)
        for match in d.HOME.finditer(bare)
        if not d.NO_HOME.search(bare[: match.start()])
    )


def grade_of(text: str, last: Event | None, *, explicit: bool, home: bool) -> Grade:
    """How certain a place is to be gone to, by the text before it."""
    before = text[last.end :] if last else text
    clause = last_clause(text)
    if d.NEGATED.search(clause) or d.OFF_PLACE.search(clause):
        return "mention"
    if last is not None and d.LINK.match(before) and "." not in before and ";" not in before:
        return last.grade
    noun = d.NOUN_WAY.search(clause)
    if (
        noun
        and not d.OPENING.match(clause)
        and (
            d.ARTICLE_WAY.search(clause[: noun.start()])
            or noun[0].lower().startswith(("get", "way", "leg"))
        )
    ):
        return "maybe"
    if d.BETWEEN_HERE.search(clause):
        return "maybe"
    if d.ROUND.search(clause):
        return "mention"
    if d.SUBORDINATE.search(clause):
        return "maybe"
    if home:
        return "sure"
    if (
        _leads(clause)
        or d.AT_PLACE.search(clause)
        or d.OPENING.match(clause)
        or d.SEQUENCE.search(text[-60:])
    ):
        return "sure"
    if d.MENTION.search(clause):
        return "mention"
    if explicit and (d.TO_THING.search(clause) or d.TO_THING_NEXT.search(clause)):
        return "sure"
    return (
        "maybe"
        if explicit and d.DONE_AT.search(clause) and not d.NO_OWN.search(clause)
        else "mention"
    )


def _leads(before: str) -> bool:
    """Whether words that lead to a place stand at the end."""
    return (
        any(pattern.search(before) for pattern in (d.TO_PLACE, d.REACHING, d.FROM_PLACE))
        or re.search(r"§[\s,]*(?:(?:and|then|to|on)[\s,]+)*$", before) is not None
    )


def in_row(text: str, start: int, end: int, places: list[Place]) -> bool:
    """Whether a place stands in a row of three or more, as the corners of areas do."""
    near = [
        place
        for place in places
        if place.start >= start
        and not re.search(
            r"[^\s,;]",
            re.sub(
                r"\band\b", "", without_places(text, places)[end : place.start].replace("§", "")
            ),
        )
    ]
    return len(near) > 2
