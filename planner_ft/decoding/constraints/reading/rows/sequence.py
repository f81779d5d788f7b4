"""Every movement of a task input in order, with its values, where the input is nothing but movements in plain words one after the other.

The text is written in one form (`turn_forms`) and taken clause by clause; each clause has to be a movement, something about one that was
read, or free of every word and value that a movement may be meant by. Else nothing is read. Scopes ("in the second hold only") are taken out before.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from planner_ft.data.lexicon import corrections, is_known
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading.paths.itinerary import without_fences
from planner_ft.decoding.constraints.reading.rows import sequence_words as w
from planner_ft.decoding.constraints.reading.rows import turn_forms as f
from planner_ft.decoding.constraints.reading.rows.sequence_text import prepare
from planner_ft.decoding.constraints.reading.rows.turns import NUDGE, ROTATE, Turn, read_turns
from planner_ft.decoding.constraints.reading.wordings import LOCKED
from planner_ft.vocabulary import Vocabulary

GOTO, HOLD, ARC, DRIFT, WAIT, VISUAL = "GoToXY", "StationKeep", "ArcTurn", "DriftWithCurrent", "WaitForStability", "VisualStationKeep"
NAMES = {GOTO, HOLD, ARC, DRIFT, WAIT, VISUAL, ROTATE, NUDGE}
TURNED = {ROTATE: "heading", NUDGE: "delta_yaw"}
MOST = 24


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


Sequence = tuple[Movement, ...]


class _Uncertain(Exception):
    """A clause that cannot be told."""


def read_sequence(record: dict[str, Any], vocabulary: Vocabulary) -> Sequence | None:
    """The movements of the answer; None where the input leaves a choice or says them in a way that is not read here."""
    if not {*NAMES} <= set(vocabulary.skill):
        return None
    given = record.get("parameters")
    parameters = given if isinstance(given, dict) else {}
    prompt = without_fences(str(record.get("prompt", "")))
    turns = read_turns(record, vocabulary)
    try:
        found = _Reader(prompt, parameters, turns, g.point(*vocabulary.home)).read()
    except _Uncertain:
        return None
    said = tuple((one.name, one.values[TURNED[one.name]]) for one in found if one.name in TURNED)
    if turns is not None and said != turns:
        return None
    return tuple(found) if len(found) <= MOST else None


def agreed(found: Sequence | None, itinerary: tuple[g.Point, ...] | None, vocabulary: Vocabulary) -> Sequence | None:
    """The movements, unless another reading has other waypoints, or a parameter cannot have what they say."""
    if found is None or (itinerary is not None and itinerary != tuple(one.point for one in found if one.point)):
        return None
    for one in found:
        for name, value in one.values.items():
            limits = vocabulary.skill[one.name].by_name[name]
            if limits.minimum is not None and limits.maximum is not None and not limits.minimum <= value <= limits.maximum:
                return None
    return found


class _Reader:
    """Reads one text."""

    def __init__(self, prompt: str, parameters: Mapping[str, Any], turns: tuple[Turn, ...] | None, home: g.Point) -> None:
        prepared = prepare(prompt, parameters)
        if prepared is None:
            raise _Uncertain
        self.text, self._places, self._total = prepared.text, prepared.places, prepared.total
        self._home, self._turns, self._parameters = home, turns, parameters
        self._found: list[Movement] = []
        self._portions: dict[int, float] = {}
        self._fresh, self._mark = False, ""

    def read(self) -> list[Movement]:
        if re.search(r"\b(?:not|n't|never|no need to|no) (?:\w+ )?VISUAL\b", self.text):
            raise _Uncertain
        for sentence in re.split(r"[.;!?](?=\s|$)", self.text):
            self._sentence(sentence.strip())
        if not self._found:
            raise _Uncertain
        self._shared()
        self._found = [replace(one, values={name: g.tidy(round(value, 2)) for name, value in one.values.items()}) for one in self._found]
        names = {one.name for one in self._found}
        if any(scope.search(self.text) and not names & set(known) for scope, known in _SCOPED):
            raise _Uncertain
        return self._found

    # ------------------------------------------------------------ sentences

    def _sentence(self, sentence: str) -> None:
        if again := w.AFTER_EACH.match(sentence):
            return self._after_each(again["rest"])
        earlier = list(self._found)
        if (first := w.REORDERED.match(sentence)) and earlier:
            if sum(one.name == GOTO for one in earlier) > 1:
                raise _Uncertain
            self._found = []
            self._clauses(first["rest"])
            if not self._found:
                raise _Uncertain
            self._found += earlier
            return None
        if both := w.BEFORE_THAT.match(sentence):
            later, rest = both["later"], both["rest"]
            self._clauses(rest)
            if len(self._found) == len(earlier):
                raise _Uncertain
            count = len(self._found)
            self._clauses(re.sub(r"^(\w+?)(?:(?<=[a-z])\1)?ing\b", _verb, later))
            if len(self._found) == count:
                raise _Uncertain
            return None
        if each := w.EACH_BEHIND.search(sentence):
            self._clauses(sentence[: each.start()] + " . " + sentence[each.end() :])
            return self._after_each(each["rest"])
        return self._clauses(sentence)

    def _after_each(self, rest: str) -> None:
        """A hold or a wait behind each rotation that was read."""
        before, turned = [one for one in self._found if one.name not in TURNED], [one for one in self._found if one.name in TURNED]
        self._found = []
        self._clauses(re.split(r" (?:before you|before turning|before going|and then turn)\b", rest)[0])
        behind, self._found = self._found, []
        if len(turned) < 2 or not behind or any(one.name not in (HOLD, WAIT, DRIFT) for one in behind) or any(one.name != GOTO for one in before):
            raise _Uncertain
        self._found = [*before, *(step for one in turned for step in (one, *behind))]

    def _clauses(self, sentence: str) -> None:
        for scope in w.SCOPES:
            sentence = scope.sub(" _ ", sentence)
        listed = self._counted_turns(sentence)
        if listed is not None:
            sentence = listed
        at = 0
        self._mark = ""
        for mark in [*w.CLAUSE.finditer(sentence), None]:
            self._clause(sentence[at : mark.start() if mark else len(sentence)])
            if mark:
                self._mark, at = (mark[0].strip() or self._mark), mark.end()

    def _counted_turns(self, sentence: str) -> str | None:
        """Where all rotations of the text are counted in one sentence ("four headings clockwise from north"), those, and the rest of it."""
        if (
            self._turns is None
            or len(self._turns) < 2
            or not re.search(
                r"\b(?:N\d+ (?:evenly|equal|headings|directions|bearings|sectors|times|turns|pans|nudges|steps|views|parts|rotations)|in steps of|every D|"
                r"D[\d.]+ apart)",
                sentence,
            )
        ):
            return None
        if any(one.name in TURNED for one in self._found) or re.search(
            rf"{w.P}|{w.T}|{w.L}|\b(?:hold\w*|wait\w*|stay\w*|paus\w*|drift\w*|float\w*|go|VISUAL|visual\w*|arc|sweep\w*|ENGINES|home|centr\w*|frame|"
            rf"after|before|once)\b",
            sentence,
        ):
            raise _Uncertain
        self._found += [Movement(name, {TURNED[name]: value}) for name, value in self._turns]
        return ""

    # ------------------------------------------------------------ clauses

    def _clause(self, clause: str) -> None:
        clause = w.FILLER.sub("", clause.strip(" ,:()-")).strip(" ,:()-")
        if clause in ("holding", "turning", "drifting", "waiting", "moving", "settling"):
            return None
        if (rest := self._modifier(clause)) is not None:
            return self._rest(rest)
        clause = w.FILLER.sub("", clause.strip(" ,:()-_")).strip(" ,:()-_")
        if not clause or w.TAIL.match(clause):
            return None
        for read in (self._two_holds, self._between, self._wait, self._drift, self._visual, self._arc, self._goto, self._turn, self._hold):
            rest = read(clause)
            if rest is not None:
                self._fresh = True
                return self._rest(rest)
        self._rest(clause, led=True)
        self._fresh = self._fresh and clause == ""
        return None

    def _rest(self, rest: str, *, led: bool = False) -> None:
        """What stands behind a movement: another one, or nothing that may be one."""
        plain = rest.strip(" ,:()-_")
        if not plain or w.TAIL.match(plain):
            return None
        if not led and plain != rest and (w.HOLD.match(plain) or w.TURN_TO.match(plain) or w.DRIFT.match(plain)):
            return self._clause(plain)
        if led and _TITLE.match(plain):
            return None
        if led and re.search(r"then|next|after|subseq|finally|lastly|followed", self._mark):
            raise _Uncertain
        if led and (w.KEEPS.match(plain) or _BARE_NUMBER.match(plain)):
            raise _Uncertain
        if any(map(w.PERCEIVING.match, _spellings(plain))) and not any(w.MOVES.search(spelt) for spelt in _spellings(plain)):
            return None
        plain = LOCKED.sub(" ", f.SENSED.sub(" ", _PERCEIVED.sub(" ", plain)))
        if any(w.CUES.search(spelt) for spelt in _spellings(plain)):
            raise _Uncertain
        return None

    @property
    def _behind(self) -> str:
        """The movement that the clause before this one is about."""
        return self._found[-1].name if self._fresh and self._found else ""

    def _add(self, name: str, values: Mapping[str, float], *, free: bool = False) -> None:
        self._found.append(Movement(name, dict(values), free))

    def _modifier(self, clause: str) -> str | None:
        """A radius or a time on its own belongs to the movement before it."""
        every = re.search(
            r"(?: (?:for|in|on|of) (?:both|all|each)(?: (?:of them|times|turns|arcs|holds|sweeps|bends|curves))?| both times| each time| each)$|"
            r"^both (?:times )?|_",
            clause,
        )
        bare = clause.replace(every[0], " ").strip() if every else clause
        bare = re.sub(r"^(?:keep|stay|remain|keeping|staying) (?=within L)", "", bare)
        match = re.fullmatch(rf"{w.WITHIN.pattern}|(?:with )?(?P<r>{w.L}) (?:for )?radius|(?:with )?(?:a )?radius (?:is |of )?(?P<q>{w.L}|N\d[\d.]*)", bare)
        if match and self._found and (self._fresh or every):
            length = float(next(value for value in match.groupdict().values() if value)[1:])
            kind = next((one.name for one in reversed(self._found) if one.name in (ARC, HOLD)), None)
            lacking = [number for number, one in enumerate(self._found) if one.name == kind and "radius" not in one.values]
            if not lacking or (not every and lacking[-1] != len(self._found) - 1):
                raise _Uncertain
            for number in lacking if every else lacking[-1:]:
                self._found[number] = replace(self._found[number], values={**self._found[number].values, "radius": length})
            return ""
        yaw = w.YAW_BEHIND.match(clause)
        if yaw and self._behind == GOTO and "yaw" not in self._found[-1].values:
            self._found[-1] = replace(self._found[-1], values={**self._found[-1].values, "yaw": float((yaw["v"] or yaw["w"])[1:])})
            return ""
        time = re.fullmatch(w.FOR_TIME.pattern, bare)
        if time and self._behind in (HOLD, DRIFT) and "time" not in self._found[-1].values:
            self._found[-1] = replace(self._found[-1], values={**self._found[-1].values, "time": float(time["t"][1:])})
            return ""
        return None

    def _two_holds(self, clause: str) -> str | None:
        match = w.HOLDS.match(clause)
        if not match or self._found:
            return None
        if match["n"] == "3":
            raise _Uncertain
        self._found += [Movement(HOLD, {"time": float(match["t"][1:])})] * 2
        return ""

    def _between(self, clause: str) -> str | None:
        match = w.IN_BETWEEN.match(clause)
        if not match:
            return None
        if [one.name for one in self._found] not in ([HOLD] * 2, [ARC] * 2, [DRIFT] * 2):
            raise _Uncertain
        self._found, ends = self._found[:1], self._found[1:]
        self._clause(match["rest"] or match["other"])
        self._found += ends
        if len(self._found) < 3:
            raise _Uncertain
        return ""

    def _wait(self, clause: str) -> str | None:
        if self._behind == WAIT and re.match(
            rf"^(?:(?:the )?threshold|below|under|within|up to|for|at most|(?:a )?max\w*)?(?: (?:of|is|for|at))* ?(?:{w.D}|{w.T})(?: (?:at most|max|"
            rf"maximum|degrees|allowed))*$",
            clause,
        ):
            return ""
        match = w.WAIT.match(clause)
        if not match:
            return None
        if not w.WAIT_REST.match(clause[match.end() :]):
            raise _Uncertain
        self._add(WAIT, {}, free=True)
        return ""

    def _drift(self, clause: str) -> str | None:
        match = w.DRIFT.match(clause)
        if not match or not w.DRIFTS.search(match[0]):
            return None
        if match[0].strip() == "ENGINES" and not w.TAIL.match(clause[match.end() :]) and not w.FOR_TIME.search(clause):
            return None
        rest = clause[match.end() :].replace("ENGINES", " ")
        if match[0].strip() == "ENGINES" and not match["t"] and not w.FOR_TIME.search(rest):
            # "Cut the engines and float" is one movement.
            if self._found and self._found[-1].name == DRIFT:
                raise _Uncertain
            return ""
        time, rest = (match["t"], rest) if match["t"] else _take(w.FOR_TIME, rest)
        if w.HALF.search(rest) or w.REST.search(rest) or w.PORTION.search(rest):
            raise _Uncertain
        values = {"time": float(time[1:])} if time else self._own_time(rest)
        rest = self._there(_without_own_time(rest))
        if not values and not w.TAIL.match(rest) and not re.match(r"^ (?:with|while|and|until)\b", rest):
            raise _Uncertain
        self._add(DRIFT, values)
        return rest

    def _there(self, rest: str) -> str:
        """The words behind a movement without a place "at P" that it is made at, to which the vehicle goes first."""
        match = re.match(rf"^ *(?:at|on|in) (?P<p>{w.P})", rest)
        if not match:
            return rest
        point = self._places[int(match["p"][1:])]
        if point != next((one.point for one in reversed(self._found) if one.point), None):
            self._portions = {place + 1 if place == len(self._found) else place: share for place, share in self._portions.items()}
            self._add(GOTO, dict(zip("xy", point, strict=True)))
        return rest[match.end() :]

    def _own_time(self, rest: str) -> dict[str, float]:
        """The task's own duration, where the words refer to it."""
        own = self._parameters.get("duration")
        if _OWN_TIME.search(rest):
            if not isinstance(own, int | float):
                raise _Uncertain
            return {"time": own}
        return {}

    def _visual(self, clause: str) -> str | None:
        if self._behind == VISUAL and re.match(r"^keep (?:it|her|him|them)(?: there| so| that way)?$", clause):
            return ""
        match = re.match(r"^VISUAL(?: (?:for )?T[\d.]+)?(?: (?:there|again|until _|as _))*", clause)
        if not match:
            return None
        self._add(VISUAL, {}, free=True)
        return clause[match.end() :]

    def _arc(self, clause: str) -> str | None:
        last = self._found[-1].name if self._found else None
        another = last == ARC and re.match(r"^(?:another|one|the other|a second|a)(?: \w+)? [DN]|^(?:N1|another N1) ", clause) is not None
        curved = w.ARC_WORD.search(clause.split(" P")[0][:45]) is not None
        turned = re.match(r"^(?:turn|swing|come|go|wheel|round|[DN]\d)", clause) is not None and re.search(rf"radius|{w.L}", clause) is not None
        if not (another or curved or turned) or re.search(rf"{w.P}|{w.T}|\b(?:spot|place)\b", clause):
            return None
        values: dict[str, float] = {}
        if same := _SAME_RADIUS.search(clause):
            radius = next((one.values.get("radius") for one in reversed(self._found) if one.name == ARC), None)
            if radius is None:
                raise _Uncertain
            values["radius"], clause = radius, clause.replace(same[0], " ")
        side = ""
        rest = re.sub(r"\b(?:N1|nth)\b", "one", clause)
        for match in w.ARC_VALUE.finditer(rest):
            key = "delta_yaw" if match["v"] else "radius" if match["l"] else "side"
            if key in values or (key == "side" and side):
                raise _Uncertain
            side = side or match["side"] or ""
            if key != "side":
                values[key] = float((match["v"] or match["l"])[1:])
        if values.get("delta_yaw", 0) < 1 or not side or not w.ARC_REST.match(w.ARC_VALUE.sub(" ", rest)):
            raise _Uncertain
        if "radius" not in values and re.search(r"\bsweeps?\b(?! turn)", clause):
            # A sweep of the camera may be meant.
            raise _Uncertain
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
        if (w.NO_GOAL_AT.search(placed[0]) if placed else w.NO_GOAL.search(w.GOING.sub("", match[0]))) or re.search(rf"{w.V}|{w.L}", match[0]):
            raise _Uncertain
        point = self._places[int(re.findall(w.P, match[0])[-1][1:])]
        if clause[match.end() :].startswith(" first") and any(one.point for one in self._found):
            raise _Uncertain
        if point == next((one.point for one in reversed(self._found) if one.point), None):
            raise _Uncertain
        values = dict(zip("xy", point, strict=True))
        rest = clause[match.end() :]
        if via := re.match(rf"^,? (?:via|by way of) (?P<p>{w.P})(?! ?(?:,|and) {w.P})", rest):
            first = self._places[int(via["p"][1:])]
            if first in (point, next((one.point for one in reversed(self._found) if one.point), None)):
                raise _Uncertain
            self._add(GOTO, dict(zip("xy", first, strict=True)))
            rest = rest[via.end() :]
        if yaw := w.YAW.match(rest):
            values["yaw"] = float((yaw["v"] or yaw["w"])[1:])
            rest = rest[yaw.end() :]
        if re.search(r"\b(?:heading|bearing|course|bow|yaw)\b.{0,12}[DNC]\d", rest):
            raise _Uncertain
        self._add(GOTO, values)
        return rest

    def _turn(self, clause: str) -> str | None:
        last = self._found[-1] if self._found else None
        by = w.TURN_BY.match(clause)
        sides = [side for side in (by["before"], by["behind"]) if side] if by else []
        if by and len(sides) == 1:
            if abs(float(by["v"][1:])) > 120 and re.match(r"(?:swing|com|go)", by["verb"] or "") and not re.search(r"bow|nose|head|spot|place", by[0]):
                raise _Uncertain
            plain = by["v"][0] == "N" and not by["verb"] and (last is None or last.name != NUDGE)
            if plain or by["v"][1] in "+-" or (not by["spot"] and not by["verb"] and last is not None and last.name == ARC):
                raise _Uncertain
            self._add(NUDGE, {"delta_yaw": f.sign(sides[0]) * float(by["v"][1:])})
            return clause[by.end() :]
        if (back := _RECIPROCAL.match(clause)) and last is not None:
            before = next((one.values["heading"] for one in reversed(self._found) if one.name == ROTATE), None)
            if before is None or any(one.name in (NUDGE, ARC, GOTO) for one in self._found):
                raise _Uncertain
            self._add(ROTATE, {"heading": (before + 180) % 360})
            return clause[back.end() :]
        turning = next((one.name for one in reversed(self._found) if one.name != HOLD), "") == ROTATE
        to = w.TURN_TO.match(clause) or (w.LISTED_TO.match(clause) if turning else None)
        if not to:
            return None
        value = float(to["v"][1:])
        if self._behind == GOTO and (
            (self._mark in (",", "") and to[0].startswith(("head", "facing", "looking", "pointing", "bow", "nose", "aim")))
            or (self._mark == "and" and to[0].startswith(("face", "look", "bow", "nose")))
        ):
            raise _Uncertain
        if not 0 <= value <= 360:
            raise _Uncertain
        self._add(ROTATE, {"heading": value})
        rest = clause[to.end() :]
        if (held := re.match(rf"^ for (?P<t>{w.T})$", rest)) is not None:
            self._add(HOLD, {"time": float(held["t"][1:])})
            return ""
        return rest

    def _hold(self, clause: str) -> str | None:
        match = w.HOLD.match(clause)
        if not match:
            return None
        if match["bare"] and self._behind not in (GOTO, ROTATE, NUDGE) and not (self._behind == HOLD and match.end() < len(clause)):
            raise _Uncertain
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
        if re.match(r"^ (?:it|him|them|her)\b", rest) or (not values and re.search(r"\b(?:so|like that)$", match[0])):
            raise _Uncertain
        if self._behind == HOLD and "time" not in values and "radius" in values:
            raise _Uncertain
        if not values and self._mark == ":" and not self._fresh:
            raise _Uncertain
        if (
            not values
            and len(self._found) not in self._portions
            and not (w.OUTRIGHT.match(match[0]) and (w.TAIL.match(rest) or re.match(r"^ (?:while|to (?!the|this)|using|and|for)\b", rest)))
        ):
            raise _Uncertain
        self._add(HOLD, values)
        return rest

    # ------------------------------------------------------------ values that several movements share

    def _shared(self) -> None:
        """Parts of a whole time: "the first ten of the twenty minutes", "half the time"."""
        if not self._portions:
            return
        total = self._total
        if total is None or any(self._found[place].name != HOLD for place in self._portions):
            raise _Uncertain
        said = self._portions
        if any(value >= 1 for value in said.values()):
            known = sum(value for value in said.values())
            factors = [factor for factor in (1, 60, 3600) if abs(known * factor - total) < 1e-6]
            if 0.0 in said.values() and len(said) == 2:
                factors = [factor for factor in (60,) if known * factor < total and known < 60]
            if len(factors) != 1 or 0.5 in said.values():
                raise _Uncertain
            shares = {place: value * factors[0] if value else total - known * factors[0] for place, value in said.items()}
        elif sorted(said.values()) in ([0.0, 0.5], [0.5, 0.5]):
            shares = dict.fromkeys(said, total / 2)
        else:
            raise _Uncertain
        for place, share in shares.items():
            self._found[place] = replace(self._found[place], values={**self._found[place].values, "time": g.tidy(share)})


_OWN_TIME = f.compiled(
    r"\b(?:for )?(?:the |its )(?:(?:given|set|planned|stated|whole|full|task's|required) )+(?:duration|time|period)\b|"
    r"\b(?:for )?the duration of the task\b|\b(?:for )?the (?:duration|period)$"
)


_TITLE = f.compiled(
    r"^(?:(?:make )?an? s(?:-bend|-turn|-curve)?(?: [a-z]+){0,2}$|(?:berth|pier|buoy|contact|site|turbine|job|task|plan|leg|order|dock|jetty) (?:N\d+|[a-z])$)"
)
_RECIPROCAL = f.compiled(
    r"^(?:turn|come|swing|go|rotate|pivot)(?: (?:her|round|the bow|about|back|on))* (?:to|onto|on) the (?:reciprocal|opposite)(?: (?:bearing|heading|"
    r"direction|course))?(?= |$)"
)
_SAME_RADIUS = f.compiled(r"\b(?:on|with|at|of) (?:the|that) same radius\b|\bsame radius\b|\bradius (?:unchanged|as before)\b")
_BARE_NUMBER = f.compiled(r"^(?:(?:to|for|at) )?N-?[\d.]+(?: (?:there|next)|$| _)")
_PERCEIVED = f.compiled(
    r"\blet (?:her|the bow|it|the boat) swing\b|\b(?:may|can|free to) swing\b|^swing(?: free(?:ly)?)?(?: in the \w+)?$|^(?:facing the [a-z ]+|holding|"
    r"turning|drifting)$|"
    r"\btrack(?:ing)? (?![^.;,]*\b(?:cable|pipe\w*|line|wall|face|along|heading|course|bearing)\b)(?:object |contact |target |the )?[^.;,]*|"
    r"\banother (?:fix|still|photo|picture|snapshot|image|reading|marker|mark|pin|note)\b|^(?:\w+ )?panorama(?: in N\d+)?$|"
    r"\b(?:with|at|in) D[\d.]+ (?:field|view|fov)|\b(?:gps|current|own|our|its|geo|relative|ship's) (?:position|heading)\b|\b(?:heading|bow|nose|"
    r"yaw)(?: is| stays| kept)? (?:locked|fixed|free|unlocked)\b|"
    r"\b(?:lock(?:ed|ing)?|fix|free) (?:the |her |its )?(?:heading|bow|nose)\b|\b(?:relative )?pose (?:relative )?to\b"
)
_WORD = f.compiled(r"\b[a-z]{4,}\b")
_IN = (
    r"\b(?:in|during|while|whilst|as|when|for|on|throughout|the|both|each|this|that)(?: (?:you|she|the|it|a|each|both|every|nth|first|second|last|"
    r"final|N\d+|is|are|boat|only))* "
)
_SCOPED = (
    (f.compiled(_IN + r"(?:holds?|holding|station[- ]keeping|staying|stays)\b"), (HOLD, VISUAL)),
    (f.compiled(_IN + r"(?:drifts?|drifting|floats?|floating|adrift|afloat)\b"), (DRIFT,)),
    (f.compiled(_IN + r"(?:turns?|turning|rotat\w+|nudges?|nudging|pans?|panning|swings?|swinging)\b"), (ROTATE, NUDGE, ARC)),
    (f.compiled(_IN + r"(?:arcs?|sweeps?|sweeping|curves?)\b"), (ARC,)),
    (f.compiled(_IN + r"(?:waits?|waiting|settl\w+|steadies)\b"), (WAIT, HOLD)),
    (f.compiled(_IN + r"(?:legs?|runs?|running|way|transits?|passages?|trip|sailing)\b"), (GOTO,)),
)
"""Movements that scopes speak of, with the skills that they can be."""


def _without_own_time(rest: str) -> str:
    return _OWN_TIME.sub(" ", rest)


def _take(pattern: re.Pattern[str], text: str) -> tuple[str | None, str]:
    """The time that a text states, and the text without it."""
    match = pattern.search(text)
    return (match["t"], text[: match.start()] + " " + text[match.end() :]) if match else (None, text)


def _spellings(text: str) -> list[str]:
    """A text, and with the words that no list knows put right one by one."""
    unknown = [word for word in dict.fromkeys(_WORD.findall(text)) if not is_known(word)]
    return [text, *(text.replace(word, other) for word in unknown for other in corrections(word))]


_VERBS = {
    "hold": "hold",
    "turn": "turn",
    "go": "go",
    "mov": "move",
    "driv": "drive",
    "com": "come",
    "rotat": "rotate",
    "drift": "drift",
    "float": "float",
    "leav": "leave",
}


def _verb(match: re.Match[str]) -> str:
    return _VERBS.get(match[1], match[1])
