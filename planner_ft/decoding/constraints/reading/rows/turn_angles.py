"""What each angle of a text means: an angle to turn by, a heading to turn to, or neither. The words
on both sides of it tell.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from planner_ft.decoding.constraints.reading.rows import angle_wordings as a
from planner_ft.decoding.constraints.reading.rows import turn_forms as f
from planner_ft.decoding.constraints.reading.rows.turn_parts import (
    CURVED,
    MOST,
    NUDGE,
    ROTATE,
    Found,
    Uncertain,
    heading,
)


@dataclass(frozen=True)
class Angle:
    """An angle of the text: the words before it in its sentence, all behind it, and what stands
    between it and the rotation read last.
    """

    token: str
    start: int
    end: int
    before: str
    behind: str
    since: str
    last: Found | None

    @property
    def bare(self) -> bool:
        """Whether no degrees are said."""
        return self.token[0] == "N"

    @property
    def signed(self) -> bool:
        """Whether a plus or minus is said."""
        return self.token[1] in "+-"

    @property
    def value(self) -> float:
        """The number."""
        return float(self.token[1:])

    def goes_on(self, turn: str, text: str | None = None) -> bool:
        """Whether the angle, or the words `text` before it, continue a list of such rotations."""
        return (
            self.last is not None
            and self.last.turns[-1][0] == turn
            and a.SEPARATOR.match(self.since if text is None else text) is not None
        )


def read_angles(text: str, *, orbits: bool) -> list[Found]:
    """What each angle of the text means. Raises Uncertain when one of them cannot be told."""
    found: list[Found] = []
    taken = 0
    if a.WIDE.search(text):
        raise Uncertain
    for token in re.finditer(f.V, text):
        if token.start() < taken or (token[0][0] == "N" and a.IS_COUNT.match(text, token.end())):
            continue
        sentence = max(text.rfind(mark, 0, token.start()) for mark in (". ", "; ", "~")) + 1
        before = text[max(taken, sentence) : token.start()]
        angle = Angle(
            token[0],
            *token.span(),
            before,
            text[token.end() :],
            text[taken : token.start()],
            found[-1] if found else None,
        )
        if nudge := _nudge(angle):
            in_place = a.IN_PLACE.search(text[max(taken, nudge.start - 25) : nudge.end])
            if (orbits or CURVED.search(text[sentence:].partition(". ")[0])) and not in_place:
                raise Uncertain
            found.append(nudge)
        elif _is_heading(angle):
            if found and found[-1].turns[-1][0] == NUDGE and a.THAT_IS.match(angle.since):
                raise Uncertain
            start = max(text.rfind(mark, 0, token.start()) for mark in (". ", "; ")) + 1
            found = [
                *_listed(found, angle),
                _turn_to(angle, text[start : token.start()], text[taken : token.start()]),
            ]
        elif (
            angle.bare
            and 0 < abs(angle.value) <= 12
            and not a.SIDE_BEHIND.match(angle.behind)
            and not (found and a.SEPARATOR.match(angle.since))
        ):
            continue
        else:
            raise Uncertain
        taken = found[-1].end
    return found


def _listed(found: list[Found], angle: Angle) -> list[Found]:
    """The rotations, the last one no side note when a list goes on behind it."""
    goes_on = found and found[-1].side_note and not a.HEAD_LEAD.search(angle.before)
    return [*found[:-1], replace(found[-1], side_note=False)] if goes_on else found


# ---------------------------------------------------------------- angles to turn by


def _nudge(angle: Angle) -> Found | None:
    """The rotations by the angle, where it is one."""
    side_behind, side_before, by = (
        a.SIDE_BEHIND.match(angle.behind),
        a.SIDE_BEFORE.search(angle.before),
        a.BY.search(angle.before),
    )
    counted = a.TIMES_BEFORE.search(angle.before)
    side = side_behind or side_before
    if angle.token[0] == "C" or not (
        _sided(angle, side_behind, side_before) if side else _unsided(angle, by, counted)
    ):
        return None
    if (side_behind and side_before and not counted) or (side and angle.signed):
        raise Uncertain
    value = angle.value * (f.sign(side["side"]) if side else 1)
    end = angle.end + (side_behind.end() if side_behind else 0)
    count, used = _count(angle, counted, angle.behind[end - angle.end :])
    end += used
    if angle.last and angle.last.turns[-1][0] == NUDGE and angle.last.turns[-1][1] * value > 0:
        more = a.ONCE_MORE.match(angle.behind[end - angle.end :])
        end += more.end() if more else 0
    first = min(
        (match.start() for match in (side_before, by, counted) if match), default=len(angle.before)
    )
    if abs(value) > 360 or not value or not 1 <= count <= MOST:
        raise Uncertain
    return Found(
        angle.start - len(angle.before) + first,
        end,
        ((NUDGE, value),) * count,
        a.IN_PASSING.search(angle.before[:first]) is not None,
    )


def _sided(
    angle: Angle, side_behind: re.Match[str] | None, side_before: re.Match[str] | None
) -> bool:
    """Whether an angle beside a word for a side is one to turn by: of a bare number a verb has to
    say so, or the rotation before it.
    """
    if not angle.bare or a.BY.search(angle.before) or a.TIMES_BEFORE.search(angle.before):
        return True
    if side_before and a.BY.search(angle.before[: side_before.start("side")]):
        return True
    since = (
        angle.since.rpartition(side_before["side"])[0]
        if side_before and not side_behind
        else angle.since
    )
    return angle.goes_on(NUDGE, since)


def _unsided(angle: Angle, by: re.Match[str] | None, counted: re.Match[str] | None) -> bool:
    """Whether an angle without a side is one to turn by: "swing the bow 40 degrees", "then minus 20
    degrees".
    """
    if by and by[0].startswith("yaw") and angle.before[: by.start()].strip(" ;:"):
        # The yaw on arrival at a place looks the same.
        raise Uncertain
    if angle.signed and angle.goes_on(NUDGE):
        return True
    if by and angle.value > 180 and not by[0].endswith(("by ", "through ")):
        # "Rotate 270 degrees" may as well be a heading.
        raise Uncertain
    if (
        by
        and not a.ENDS.match(angle.behind)
        and not re.match(r" ?(?:N\d+ times|each|at a time)\b", angle.behind)
    ):
        raise Uncertain
    if by:
        return not angle.bare or by[0].endswith("by ")
    return counted is not None and not angle.bare and not a.HEAD_LEAD.search(angle.before)


def _count(angle: Angle, counted: re.Match[str] | None, rest: str) -> tuple[int, int]:
    """How often the rotation is made, and the length of the words behind it that say so."""
    behind = a.TIMES_BEHIND.match(rest)
    used = behind.end() if behind else 0
    many = a.OF_MANY.search(angle.before) or a.EACH.match(rest)
    listed = counted and a.LISTED_BEHIND.match(rest) and re.search(r", $", angle.before)
    if (
        (counted and behind)
        or (many and not counted and not behind)
        or listed
        or a.LOOSE_END.match(rest[used:])
    ):
        raise Uncertain
    return int(counted[1] if counted else (behind[1] or behind[2]) if behind else 1), used


# ---------------------------------------------------------------- headings to turn to


def _is_heading(angle: Angle) -> bool:
    """Whether the vehicle is to turn to the angle: by the words before it, or as the next of a
    list.
    """
    if a.NO_HEADING.match(angle.behind) or angle.signed:
        return False
    if lead := a.HEAD_LEAD.search(angle.before):
        # "Turn 180" may be an angle.
        return angle.token[0] == "C" or lead[0] != "turn "
    ends = not angle.bare or a.ENDS.match(angle.behind) is not None
    if (
        angle.last
        and angle.last.turns[-1][0] == ROTATE
        and a.NEXT.search(angle.before)
        and a.ENDS.match(angle.behind)
    ):
        return not angle.bare or angle.value > 12 or angle.value == 0
    return angle.goes_on(ROTATE) and angle.since.strip(" ") != "" and ends


def _turn_to(angle: Angle, sentence: str, since: str) -> Found:
    """The rotation to the angle."""
    lead = a.HEAD_LEAD.search(angle.before)
    if not lead:
        return Found(angle.start, angle.end, (heading(angle.value),))
    words = len(lead[0])
    if not _turns_there(lead[0], sentence[: len(sentence) - words]):
        raise Uncertain
    return Found(
        angle.start - words,
        angle.end,
        (heading(angle.value),),
        a.IN_PASSING.search(since[: len(since) - words]) is not None,
    )


def _turns_there(lead: str, before: str) -> bool:
    """Whether a heading is one to turn to, and not the yaw on arrival at a place that the same
    sentence names before it: "go to P and face 040".
    """
    if not a.STRONG.search(lead):
        return False
    if (
        re.match(r"\W*(?:fac|point|look)ing", lead)
        and before.strip(" ~,:")
        and not a.IN_PASSING.search(before)
        and not before.rstrip().endswith(":")
    ):
        return False
    if (
        re.match(r"\W*(?:bow|nose)[ :]*$", lead)
        and before.strip(" ~,:")
        and not a.LEADING.search(before)
    ):
        return False
    place = [*re.finditer(rf"\b(?:{f.GOAL}|{a.TRAVEL})\b|~a", before)]
    if not place or a.TURNS_THERE.search(lead):
        return True
    return re.search(r"\bthen\b|[:]", before[place[-1].end() :] + lead) is not None
