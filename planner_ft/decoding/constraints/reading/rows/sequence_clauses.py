"""Single movements of a task input: each clause of a text in one form (`sequence_text`) as a
movement with its values, for `sequence`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading.rows import sequence_words as w
from planner_ft.decoding.constraints.reading.rows import turn_forms as f
from planner_ft.decoding.constraints.reading.rows.counted_turns import counted
from planner_ft.decoding.constraints.reading.rows.turn_parts import MOST, NUDGE, ROTATE
from planner_ft.decoding.constraints.reading.rows.turn_parts import Uncertain as Unsure

GOTO, HOLD, ARC, DRIFT, WAIT, VISUAL = (
    "GoToXY",
    "StationKeep",
    "ArcTurn",
    "DriftWithCurrent",
    "WaitForStability",
    "VisualStationKeep",
)


@dataclass(frozen=True)
class Movement:
    """A movement by its skill, with all its values; `free` where the text does not tell them."""

    name: str
    values: Mapping[str, float] = field(default_factory=dict)
    free: bool = False

    @property
    def point(self) -> g.Point | None:
        """Where it goes."""
        return (self.values["x"], self.values["y"]) if self.name == GOTO else None


class Uncertain(Exception):
    """A clause that cannot be told."""


class Clauses:
    """Reads one clause after the other, as one movement or as two; what was read so far is
    `_found`.
    """

    def __init__(
        self, places: tuple[g.Point, ...], parameters: Mapping[str, Any], home: g.Point
    ) -> None:
        self._places, self._home, self._parameters = places, home, parameters
        self._found: list[Movement] = []
        self._portions: dict[int, float] = {}
        self._fresh, self._mark = False, ""

    @property
    def _behind(self) -> str:
        """The movement that the clause before this one is about."""
        return self._found[-1].name if self._fresh and self._found else ""

    def _add(self, name: str, values: Mapping[str, float], *, free: bool = False) -> None:
        self._found.append(Movement(name, dict(values), free))

    def _wait(self, clause: str) -> str | None:
        if self._behind == WAIT and _WAIT_LIMIT.match(clause):
            return self._wait_limit(clause, self._found[-1])
        match = w.WAIT.match(clause)
        if not match:
            return None
        if not w.WAIT_REST.match(clause[match.end() :]):
            raise Uncertain
        self._add(
            WAIT,
            {},
            free=re.search(
                rf"{w.T}.*\b(?:stead|stab|settle|calm|quiet|still|motion|pitch|roll|level)", clause
            )
            is not None,
        )
        return self._wait_limit(clause, self._found[-1])

    def _wait_limit(self, clause: str, wait: Movement) -> str:
        """The threshold and the time that a wait is told with; it is free where they are told
        twice.
        """
        limits, times = (
            [float(value[1:]) for value in dict.fromkeys(re.findall(w.D, clause))],
            [float(value[1:]) for value in re.findall(w.T, clause)],
        )
        told = {"threshold": limits[0]} if len(limits) == 1 else {}
        told |= {"time": times[0]} if len(times) == 1 else {}
        twice = len(limits) > 1 or len(times) > 1 or bool({*told} & {*wait.values})
        self._found[-1] = Movement(
            WAIT, {} if twice or wait.free else {**wait.values, **told}, twice or wait.free
        )
        return ""

    def _drift(self, clause: str) -> str | None:
        match = w.DRIFT.match(clause)
        if not match or not w.DRIFTS.search(match[0]):
            return None
        if (
            match[0].strip() == "ENGINES"
            and not w.TAIL.match(clause[match.end() :])
            and not w.FOR_TIME.search(clause)
        ):
            return None
        rest = clause[match.end() :].replace("ENGINES", " ")
        if match[0].strip() == "ENGINES" and not match["t"] and not w.FOR_TIME.search(rest):
            # "Cut the engines and float" is one movement.
            if self._found and self._found[-1].name == DRIFT and self._behind != DRIFT:
                raise Uncertain
            return ""
        time, rest = (match["t"], rest) if match["t"] else _take(w.FOR_TIME, rest)
        if w.HALF.search(rest) or w.REST.search(rest) or w.PORTION.search(rest):
            raise Uncertain
        values = {"time": float(time[1:])} if time else self._own_time(rest)
        rest = self._there(_without_own_time(rest))
        if re.match(r"^ (?:for )?N\d", rest) or (
            not values
            and not w.TAIL.match(rest)
            and not re.match(r"^ (?:with|while|and|until)\b", rest)
        ):
            raise Uncertain
        self._add(DRIFT, values)
        return rest

    def _there(self, rest: str) -> str:
        """The words behind a movement without a place "at P" that it is made at, to which the
        vehicle goes first.
        """
        match = re.match(rf"^ *(?:at|on|in) (?P<p>{w.P})", rest)
        if not match:
            return rest
        point = self._places[int(match["p"][1:])]
        if point != next((one.point for one in reversed(self._found) if one.point), None):
            self._portions = {
                place + 1 if place == len(self._found) else place: share
                for place, share in self._portions.items()
            }
            self._add(GOTO, dict(zip("xy", point, strict=True)))
        return rest[match.end() :]

    def _own_time(self, rest: str) -> dict[str, float]:
        """The task's own duration, where the words refer to it."""
        own = self._parameters.get("duration")
        if _OWN_TIME.search(rest):
            if not isinstance(own, int | float):
                raise Uncertain
            return {"time": own}
        return {}

    def _visual(self, clause: str) -> str | None:
        if self._behind == VISUAL and re.match(
            r"^keep (?:it|her|him|them)(?: there| so| that way)?$", clause
        ):
            return ""
        match = re.match(r"^VISUAL(?: (?:for )?T[\d.]+)?(?: (?:there|again|until _|as _))*", clause)
        if not match:
            return None
        self._add(VISUAL, {}, free=True)
        return clause[match.end() :]

    def _arc(self, clause: str) -> str | None:
        last = self._found[-1].name if self._found else None
        another = (
            last == ARC
            or (
                _SAME_RADIUS.search(clause) is not None
                and any(one.name == ARC for one in self._found)
            )
        ) and re.match(
            r"^(?:another|one|the other|a second|a)(?: \w+)? [DN]|^(?:N1|another N1) ", clause
        ) is not None
        curved = w.ARC_WORD.search(clause.split(" P")[0][:45]) is not None
        turned = (
            re.match(r"^(?:turn|swing|come|go|wheel|round|[DN]\d)", clause) is not None
            and re.search(rf"radius|{w.L}", clause) is not None
        )
        if not (another or curved or turned) or re.search(
            rf"{w.P}|{w.T}|\b(?:spot|place)\b", clause
        ):
            return None
        values: dict[str, float] = {}
        if _BARE_ARC.match(clause) and not {"radius", "arc"} & {*self._parameters}:
            self._add(ARC, {})
            return ""
        if same := _SAME_RADIUS.search(clause):
            radius = next(
                (one.values.get("radius") for one in reversed(self._found) if one.name == ARC), None
            )
            if radius is None:
                raise Uncertain
            values["radius"], clause = radius, clause.replace(same[0], " ")
        side = ""
        rest = re.sub(r"\b(?:N1|nth)\b", "one", clause)
        for match in w.ARC_VALUE.finditer(rest):
            key = "delta_yaw" if match["v"] else "radius" if match["l"] else "side"
            if key in values or (key == "side" and side):
                raise Uncertain
            side = side or match["side"] or ""
            if key != "side":
                values[key] = float((match["v"] or match["l"])[1:])
        if (
            values.get("delta_yaw", 0) < 1
            or not side
            or not w.ARC_REST.match(w.ARC_VALUE.sub(" ", rest))
        ):
            raise Uncertain
        if "radius" not in values and re.search(r"\bsweeps?\b(?! turn)", clause):
            # A sweep of the camera may be meant.
            raise Uncertain
        values["delta_yaw"] *= f.sign(side)
        self._add(ARC, values)
        return ""

    def _goto(self, clause: str) -> str | None:
        home = w.HOME.match(clause)
        if home:
            self._add(GOTO, dict(zip("xy", self._home, strict=True)))
            return clause[home.end() :]
        match = w.GO_TO.match(clause)
        if not match or not w.OPENS_GOAL.match(clause):
            return None
        placed = w.PLACED_AT.match(clause)
        if (
            w.NO_GOAL_AT.search(placed[0])
            if placed
            else w.NO_GOAL.search(w.GOING.sub("", match[0]))
        ) or re.search(rf"{w.V}|{w.L}", match[0]):
            raise Uncertain
        point = self._places[int(re.findall(w.P, match[0])[-1][1:])]
        if clause[match.end() :].startswith(" first") and any(one.point for one in self._found):
            raise Uncertain
        if point == next(
            (one.point for one in reversed(self._found) if one.point or one.name == DRIFT), None
        ):
            raise Uncertain
        values = dict(zip("xy", point, strict=True))
        rest = clause[match.end() :]
        if via := re.match(rf"^,? (?:via|by way of) (?P<p>{w.P})(?! ?(?:,|and) {w.P})", rest):
            first = self._places[int(via["p"][1:])]
            if first in (
                point,
                next((one.point for one in reversed(self._found) if one.point), None),
            ):
                raise Uncertain
            self._add(GOTO, dict(zip("xy", first, strict=True)))
            rest = rest[via.end() :]
        if yaw := w.YAW.match(rest):
            values["yaw"] = float((yaw["v"] or yaw["w"])[1:])
            rest = rest[yaw.end() :]
        if re.search(r"\b(?:heading|bearing|course|bow|yaw)\b.{0,12}[DNC]\d", rest):
            raise Uncertain
        self._add(GOTO, values)
        return rest

    def _turn(self, clause: str) -> str | None:
        last = self._found[-1] if self._found else None
        if several := self._several_turns(clause):
            self._found += [Movement(NUDGE, {"delta_yaw": g.tidy(value)}) for value in several]
            return ""
        by = w.TURN_BY.match(clause)
        sides = [side for side in (by["before"], by["behind"]) if side] if by else []
        if by and len(sides) == 1:
            if (
                abs(float(by["v"][1:])) > 120
                and re.match(r"(?:swing|com|go)", by["verb"] or "")
                and not re.search(r"bow|nose|head|spot|place", by[0])
            ):
                raise Uncertain
            plain = by["v"][0] == "N" and not by["verb"] and (last is None or last.name != NUDGE)
            if (
                plain
                or by["v"][1] in "+-"
                or (not by["spot"] and not by["verb"] and last is not None and last.name == ARC)
            ):
                raise Uncertain
            often = _TIMES.match(clause[by.end() :])
            if (count := int(often["n"]) if often else 1) > MOST:
                raise Uncertain
            self._found += [
                Movement(NUDGE, {"delta_yaw": f.sign(sides[0]) * float(by["v"][1:])})
            ] * count
            return clause[by.end() + (often.end() if often else 0) :]
        if (back := _RECIPROCAL.match(clause)) and last is not None:
            before = next(
                (one.values["heading"] for one in reversed(self._found) if one.name == ROTATE), None
            )
            if before is None or any(one.name in (NUDGE, ARC, GOTO) for one in self._found):
                raise Uncertain
            self._add(ROTATE, {"heading": (before + 180) % 360})
            return clause[back.end() :]
        turning = (
            next((one.name for one in reversed(self._found) if one.name != HOLD), "") == ROTATE
        )
        to = w.TURN_TO.match(clause) or (w.LISTED_TO.match(clause) if turning else None)
        if not to:
            return None
        value = float(to["v"][1:])
        if self._behind == GOTO and (
            (
                self._mark in (",", "")
                and to[0].startswith(
                    ("head", "facing", "looking", "pointing", "bow", "nose", "aim")
                )
            )
            or (self._mark == "and" and to[0].startswith(("face", "look", "bow", "nose")))
        ):
            raise Uncertain
        if not 0 <= value <= 360:
            raise Uncertain
        self._add(ROTATE, {"heading": value})
        rest = clause[to.end() :]
        if (held := re.match(rf"^ for (?P<t>{w.T})$", rest)) is not None:
            self._add(HOLD, {"time": float(held["t"][1:])})
            return ""
        return rest

    def _several_turns(self, clause: str) -> list[float]:
        """The angles of a clause that counts its turns: "two nudges of 20 degrees to port", "all
        the way round in five equal nudges".
        """
        if (
            (match := _COUNTED.match(clause))
            and w.TAIL.match(clause[match.end() :])
            and 1 <= int(match["n"]) <= MOST
        ):
            return [f.sign(match["side"] or "") * float(match["v"][1:])] * int(match["n"])
        try:
            found = [*counted(f" {clause} ")]
        except Unsure:
            raise Uncertain from None
        if not found:
            return []
        rest = clause[: max(0, found[0].start - 1)] + clause[max(0, found[-1].end - 1) :]
        if (
            len(found) > 1
            or any(name != NUDGE for name, _value in found[0].turns)
            or re.search(rf"{w.V}|{w.T}|{w.P}", rest)
        ):
            raise Uncertain
        return [value for _name, value in found[0].turns]

    def _hold(self, clause: str) -> str | None:
        match = w.HOLD.match(clause)
        if not match:
            return None
        if (
            match["bare"]
            and self._behind not in (GOTO, ROTATE, NUDGE)
            and not (self._behind == HOLD and match.end() < len(clause))
        ):
            raise Uncertain
        rest, values = clause[match.end() :], {}
        time = match["t"] or match["bare"]
        portion, whole = w.PORTION.search(rest), w.PORTION_TIME.search(rest)
        half, remainder = w.HALF.search(rest), w.REST.search(rest)
        if portion:
            self._portions[len(self._found)] = float(portion["n"])
            rest = w.PORTION.sub(" ", rest)
        elif whole:
            time, rest = whole["t"], w.PORTION_TIME.sub(" ", rest)
        elif half or remainder:
            self._portions[len(self._found)] = 0.5 if half else 0.0
            rest = w.REST.sub(" ", w.HALF.sub(" ", rest))
        elif not time:
            time, rest = _take(w.FOR_TIME, rest)
        radius = w.WITHIN.search(rest)
        if radius:
            values["radius"] = float((radius["l"] or radius["m"] or radius["n"])[1:])
            rest = rest[: radius.start()] + rest[radius.end() :]
            if not time and len(self._found) not in self._portions:
                time, rest = _take(w.FOR_TIME, rest)
        values |= {"time": float(time[1:])} if time else self._own_time(rest)
        rest = self._there(_without_own_time(rest))
        if (
            re.match(r"^ (?:for )?N\d", rest)
            or re.match(r"^ (?:it|him|them|her)\b", rest)
            or (not values and re.search(r"\b(?:so|like that)$", match[0]))
        ):
            raise Uncertain
        if self._behind == HOLD and "time" not in values and "radius" in values:
            raise Uncertain
        if not values and self._mark == ":" and not self._fresh:
            raise Uncertain
        if (
            not values
            and len(self._found) not in self._portions
            and not (
                w.OUTRIGHT.match(match[0])
                and (
                    w.TAIL.match(rest)
                    or re.match(r"^ (?:while|to (?!the|this)|using|and|for)\b", rest)
                )
            )
        ):
            raise Uncertain
        self._add(HOLD, values)
        return rest


_OWN_TIME = f.compiled(
    r"\b(?:for )?(?:the |its )(?:(?:given|set|planned|stated|whole|full|task's|required)"
    r" )+(?:duration|time|period)\b|"
    r"\b(?:for )?the duration of the task\b|\b(?:for )?the (?:duration|period)$"
)
_WAIT_LIMIT = f.compiled(
    r"^(?:(?:the )?threshold|below|under|within|up to|for|at most|(?:a )?max\w*)?(?:"
    rf" (?:of|is|for|at))* ?(?:{w.D}|{w.T})"
    r"(?: (?:at most|max|maximum|degrees|allowed))*$"
)
"""Behind a wait: what it waits for."""
_RECIPROCAL = f.compiled(
    r"^(?:turn|come|swing|go|rotate|pivot)(?: (?:her|round|the bow|about|back|on))* (?:to|onto|on)"
    r" the (?:reciprocal|opposite)(?: (?:bearing|heading|"
    r"direction|course))?(?= |$)"
)
_BARE_ARC = f.compiled(
    r"^(?:(?:make|do|take|perform|sail|run|describe) )?(?:an? |one )?(?:sweeping turn|arc turn|wide"
    r" turn|arc)(?: there| here)?$"
)
_COUNTED = f.compiled(
    rf"^(?:make |do |take )?N(?P<n>\d+) (?:(?:equal|small|single|separate|successive|quick|short)"
    rf" )*(?:nudges|pans|turns|rotations|swings|twists|"
    rf"yaws) (?:of |by )?"
    rf"(?P<v>{w.D})(?: degrees)?(?: each| every)?,? ?(?P<side>{f.SIDE})?"
)
_TIMES = f.compiled(r"^,? ?(?:N(?P<n>\d+) times)(?: over| running| in a row)?\b")
_SAME_RADIUS = f.compiled(
    r"\b(?:on|with|at|of) (?:the|that) same radius\b|\bsame radius\b|\bradius (?:unchanged|as"
    r" before)\b"
)


def _without_own_time(rest: str) -> str:
    return _OWN_TIME.sub(" ", rest)


def _take(pattern: re.Pattern[str], text: str) -> tuple[str | None, str]:
    """The time that a text states, and the text without it."""
    match = pattern.search(text)
    return (
        (match["t"], text[: match.start()] + " " + text[match.end() :]) if match else (None, text)
    )
