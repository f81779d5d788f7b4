"""Every movement of a task input in order, with its values, where the input is nothing but
movements in plain words one after the other.

The text is written in one form (`turn_forms`) and taken clause by clause; each clause has to be a
movement, something about one that was read, or free of every word and value that a movement may be
meant by. Else nothing is read. Scopes ("in the second hold only") are taken out before.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from planner_ft.data.lexicon import corrections, is_known
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading.paths.itinerary import without_fences
from planner_ft.decoding.constraints.reading.rows import sequence_words as w
from planner_ft.decoding.constraints.reading.rows import turn_forms as f
from planner_ft.decoding.constraints.reading.rows.sequence_clauses import (
    ARC,
    DRIFT,
    GOTO,
    HOLD,
    VISUAL,
    WAIT,
    Clauses,
    Movement,
    Uncertain,
)
from planner_ft.decoding.constraints.reading.rows.sequence_text import prepare
from planner_ft.decoding.constraints.reading.rows.turn_parts import MOST, NUDGE, ROTATE, Turn
from planner_ft.decoding.constraints.reading.rows.turns import read_turns
from planner_ft.decoding.constraints.reading.wordings import LOCKED
from planner_ft.vocabulary import Vocabulary

NAMES = {GOTO, HOLD, ARC, DRIFT, WAIT, VISUAL, ROTATE, NUDGE}
TURNED = {ROTATE: "heading", NUDGE: "delta_yaw"}
Sequence = tuple[Movement, ...]


def read_sequence(record: dict[str, Any], vocabulary: Vocabulary) -> Sequence | None:
    """The movements of the answer; None where the input leaves a choice or says them in a way that
    is not read here.
    """
    if not {*NAMES} <= set(vocabulary.skill):
        return None
    given = record.get("parameters")
    parameters = given if isinstance(given, dict) else {}
    prompt = without_fences(str(record.get("prompt", "")))
    turns = read_turns(record, vocabulary)
    try:
        task = vocabulary.task.get(str(record.get("task")))
        found = _Reader(
            prompt,
            parameters,
            turns,
            g.point(*vocabulary.home),
            stays=task is not None and task.pattern == "hold",
        ).read()
    except Uncertain:
        return None
    said = tuple((one.name, one.values[TURNED[one.name]]) for one in found if one.name in TURNED)
    if turns is not None and said != turns:
        return None
    return tuple(found) if len(found) <= MOST else None


def agreed(
    found: Sequence | None, itinerary: tuple[g.Point, ...] | None, vocabulary: Vocabulary
) -> Sequence | None:
    """The movements, unless another reading has other waypoints, or a parameter cannot have what
    they say.
    """
    points = tuple(one.point for one in found or () if one.point)
    # It lies at home already: "from your berth at [0, 0] go to [30, 8]".
    if found is None or (
        itinerary is not None and itinerary not in (points, (g.point(*vocabulary.home), *points))
    ):
        return None
    for one in found:
        for name, value in one.values.items():
            limits = vocabulary.skill[one.name].by_name[name]
            if (
                limits.minimum is not None
                and limits.maximum is not None
                and not limits.minimum <= value <= limits.maximum
            ):
                return None
    return found


class _Reader(Clauses):
    """Reads one text; `stays` where the task is done on station unless a movement is told."""

    def __init__(
        self,
        prompt: str,
        parameters: Mapping[str, Any],
        turns: tuple[Turn, ...] | None,
        home: g.Point,
        *,
        stays: bool,
    ) -> None:
        prepared = prepare(prompt, parameters)
        if prepared is None:
            raise Uncertain
        super().__init__(prepared.places, parameters, home)
        self.text, self._total = prepared.text, prepared.total
        self._turns, self._stays = turns, stays

    def read(self) -> list[Movement]:
        if re.search(r"\b(?:not|n't|never|no need to|no) (?:\w+ )?VISUAL\b", self.text):
            raise Uncertain
        for sentence in re.split(r"[.;!?](?=\s|$)", self.text):
            self._sentence(sentence.strip())
        if not self._found and self._stays and not _UNTOLD.search(self.text):
            self._add(HOLD, {})
        if not self._found:
            raise Uncertain
        self._shared()
        self._found = [
            replace(
                one, values={name: g.tidy(round(value, 2)) for name, value in one.values.items()}
            )
            for one in self._found
        ]
        names = {one.name for one in self._found}
        if any(scope.search(self.text) and not names & set(known) for scope, known in _SCOPED):
            raise Uncertain
        return self._found

    # ------------------------------------------------------------ sentences

    def _sentence(self, sentence: str) -> None:
        if again := w.AFTER_EACH.match(sentence):
            return self._after_each(again["rest"])
        earlier = list(self._found)
        if (first := w.REORDERED.match(sentence)) and earlier:
            if sum(one.name == GOTO for one in earlier) > 1:
                raise Uncertain
            self._found = []
            self._clauses(first["rest"])
            if not self._found:
                raise Uncertain
            self._found += earlier
            return None
        if both := w.BEFORE_THAT.match(sentence):
            later, rest = both["later"], both["rest"]
            self._clauses(rest)
            if len(self._found) == len(earlier):
                raise Uncertain
            count = len(self._found)
            self._clauses(re.sub(r"^(\w+?)(?:(?<=[a-z])\1)?ing\b", _verb, later))
            if len(self._found) == count:
                raise Uncertain
            return None
        if each := w.EACH_BEHIND.search(sentence):
            self._clauses(sentence[: each.start()] + " . " + sentence[each.end() :])
            return self._after_each(each["rest"])
        return self._clauses(sentence)

    def _after_each(self, rest: str) -> None:
        """A hold or a wait behind each rotation that was read."""
        before, turned = (
            [one for one in self._found if one.name not in TURNED],
            [one for one in self._found if one.name in TURNED],
        )
        self._found = []
        self._clauses(
            re.split(r" (?:before you|before turning|before going|and then turn)\b", rest)[0]
        )
        behind, self._found = self._found, []
        if not turned and len(before) > 1:
            turned, before = before, []
        if (
            len(turned) < 2
            or not behind
            or any(one.name not in (HOLD, WAIT, DRIFT) for one in behind)
            or any(one.name != GOTO for one in before)
        ):
            raise Uncertain
        if turned[0].name == GOTO and any(one.name != GOTO for one in turned):
            raise Uncertain
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
        """Where all rotations of the text are counted in one sentence ("four headings clockwise
        from north"), those, and the rest of it.
        """
        if (
            self._turns is None
            or len(self._turns) < 2
            or not re.search(
                r"\b(?:N\d+"
                r" (?:evenly|equal|headings|directions|bearings|sectors|times|turns|pans|nudges|steps|views|parts|rotations)|in"
                r" steps of|every D|"
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
            return None
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
        for read in (
            self._two_holds,
            self._between,
            self._wait,
            self._drift,
            self._visual,
            self._arc,
            self._goto,
            self._turn,
            self._hold,
        ):
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
        if (
            not led
            and plain != rest
            and (w.HOLD.match(plain) or w.TURN_TO.match(plain) or w.DRIFT.match(plain))
        ):
            return self._clause(plain)
        if _EITHER.search(plain):
            raise Uncertain
        if led and _TITLE.match(plain):
            return None
        if led and re.search(r"then|next|after|subseq|finally|lastly|followed", self._mark):
            raise Uncertain
        if led and (w.KEEPS.match(plain) or _BARE_NUMBER.match(plain)):
            raise Uncertain
        if any(map(w.PERCEIVING.match, _spellings(plain))) and not any(
            w.MOVES.search(spelt) for spelt in _spellings(plain)
        ):
            return None
        plain = LOCKED.sub(" ", f.SENSED.sub(" ", _PERCEIVED.sub(" ", plain)))
        if any(w.CUES.search(spelt) for spelt in _spellings(plain)):
            raise Uncertain
        return None

    def _modifier(self, clause: str) -> str | None:
        """A radius or a time on its own belongs to the movement before it."""
        every = re.search(
            r"(?: (?:for|in|on|of) (?:both|all|each)(?: (?:of"
            r" them|times|turns|arcs|holds|sweeps|bends|curves))?| both times| each time| each)$|"
            r"^both (?:times )?|_",
            clause,
        )
        bare = clause.replace(every[0], " ").strip() if every else clause
        bare = re.sub(r"^(?:keep|stay|remain|keeping|staying) (?=within L)", "", bare)
        match = re.fullmatch(
            rf"{w.WITHIN.pattern}|(?:with )?(?P<r>{w.L}) (?:for )?radius|(?:with )?(?:a )?radius"
            rf" (?:is |of )?(?P<q>{w.L}|N\d[\d.]*)",
            bare,
        )
        if match and self._found and (self._fresh or every):
            length = float(next(value for value in match.groupdict().values() if value)[1:])
            kind = next(
                (one.name for one in reversed(self._found) if one.name in (ARC, HOLD)), None
            )
            lacking = [
                number
                for number, one in enumerate(self._found)
                if one.name == kind and "radius" not in one.values
            ]
            if not lacking or (not every and lacking[-1] != len(self._found) - 1):
                raise Uncertain
            for number in lacking if every else lacking[-1:]:
                self._found[number] = replace(
                    self._found[number], values={**self._found[number].values, "radius": length}
                )
            return ""
        yaw = w.YAW_BEHIND.match(clause)
        if yaw and self._behind == GOTO and "yaw" not in self._found[-1].values:
            self._found[-1] = replace(
                self._found[-1],
                values={**self._found[-1].values, "yaw": float((yaw["v"] or yaw["w"])[1:])},
            )
            return ""
        time = re.fullmatch(w.FOR_TIME.pattern, bare)
        if time and self._behind in (HOLD, DRIFT) and "time" not in self._found[-1].values:
            self._found[-1] = replace(
                self._found[-1], values={**self._found[-1].values, "time": float(time["t"][1:])}
            )
            return ""
        return None

    def _two_holds(self, clause: str) -> str | None:
        match = w.HOLDS.match(clause)
        if not match or self._found:
            return None
        if match["n"] == "3":
            raise Uncertain
        self._found += [Movement(HOLD, {"time": float(match["t"][1:])})] * 2
        return ""

    def _between(self, clause: str) -> str | None:
        match = w.IN_BETWEEN.match(clause)
        if not match:
            return None
        if [one.name for one in self._found] not in ([HOLD] * 2, [ARC] * 2, [DRIFT] * 2):
            raise Uncertain
        self._found, ends = self._found[:1], self._found[1:]
        self._clause(match["rest"] or match["other"])
        self._found += ends
        if len(self._found) < 3:
            raise Uncertain
        return ""

    # ------------------------------------------------------------ values that several movements
    # share

    def _shared(self) -> None:
        """Parts of a whole time: "the first ten of the twenty minutes", "half the time"."""
        if not self._portions:
            return
        total = self._total
        if total is None or any(self._found[place].name != HOLD for place in self._portions):
            raise Uncertain
        said = self._portions
        if any(value >= 1 for value in said.values()):
            known = sum(value for value in said.values())
            factors = [factor for factor in (1, 60, 3600) if abs(known * factor - total) < 1e-6]
            if 0.0 in said.values() and len(said) == 2:
                factors = [factor for factor in (60,) if known * factor < total and known < 60]
            if len(factors) != 1 or 0.5 in said.values():
                raise Uncertain
            shares = {
                place: value * factors[0] if value else total - known * factors[0]
                for place, value in said.items()
            }
        elif sorted(said.values()) in ([0.0, 0.5], [0.5, 0.5]):
            shares = dict.fromkeys(said, total / 2)
        else:
            raise Uncertain
        for place, share in shares.items():
            self._found[place] = replace(
                self._found[place], values={**self._found[place].values, "time": g.tidy(share)}
            )


_UNTOLD = f.compiled(
    r"\b(?:headings|bearings|table|see to it|the whole time (?:that )?you|while you|as you|when"
    rf" you|whenever)\b|C[\d.]+|{w.P}|{w.T}|\bENGINES\b"
)
"""What a movement may be meant by in a text in which none was read: without it the vehicle stays
where it is, if the task is done on station.
"""
_EITHER = f.compiled(r"^or (?:[a-z]+ ){0,3}[NTDLP]\d")
_TITLE = f.compiled(
    r"^(?:(?:make )?an? s(?:-bend|-turn|-curve)?(?:"
    r" [a-z]+){0,2}$|(?:berth|pier|buoy|contact|site|turbine|job|task|plan|leg|order|dock|jetty)"
    r" (?:N\d+|[a-z])$)"
)
_BARE_NUMBER = f.compiled(
    r"^(?:(?:to|for|at) )?N-?[\d.]+(?: (?:there|next|in|again|last|too|now)\b|$| _)"
)
_PERCEIVED = f.compiled(
    r"\blet (?:her|the bow|it|the boat) swing\b|\b(?:may|can|free to) swing\b|^swing(?:"
    r" free(?:ly)?)?(?: in the \w+)?$|^(?:facing the [a-z ]+|holding|"
    r"turning|drifting)$|"
    r"\btrack(?:ing)?"
    r" (?![^.;,]*\b(?:cable|pipe\w*|line|wall|face|along|heading|course|bearing)\b)(?:object"
    r" |contact |target |the )?[^.;,]*|"
    r"\banother (?:fix|still|photo|picture|snapshot|image|reading|marker|mark|pin|note)\b|^(?:\w+"
    r" )?panorama(?: in N\d+)?$|"
    r"\b(?:with|at|in) D[\d.]+ (?:field|view|fov)|\b(?:gps|current|own|our|its|geo|relative|ship's)"
    r" (?:position|heading)\b|\b(?:heading|bow|nose|"
    r"yaw)(?: is| stays| kept)? (?:locked|fixed|free|unlocked)\b|"
    r"\b(?:lock(?:ed|ing)?|fix|free) (?:the |her |its )?(?:heading|bow|nose)\b|\b(?:relative )?pose"
    r" (?:relative )?to\b"
)
_WORD = f.compiled(r"\b[a-z]{4,}\b")
_IN = (
    r"\b(?:in|during|while|whilst|as|when|for|on|throughout|the|both|each|this|that)(?:"
    r" (?:you|she|the|it|a|each|both|every|nth|first|second|last|"
    r"final|N\d+|is|are|boat|only))* "
)
_SCOPED = (
    (f.compiled(_IN + r"(?:holds?|holding|station[- ]keeping|staying|stays)\b"), (HOLD, VISUAL)),
    (f.compiled(_IN + r"(?:drifts?|drifting|floats?|floating|adrift|afloat)\b"), (DRIFT,)),
    (
        f.compiled(
            _IN + r"(?:turns?|turning|rotat\w+|nudges?|nudging|pans?|panning|swings?|swinging)\b"
        ),
        (ROTATE, NUDGE, ARC),
    ),
    (f.compiled(_IN + r"(?:arcs?|sweeps?|sweeping|curves?)\b"), (ARC,)),
    (f.compiled(_IN + r"(?:waits?|waiting|settl\w+|steadies)\b"), (WAIT, HOLD)),
    (
        f.compiled(
            _IN + r"(?:legs?|runs?|running|way(?! round)|transits?|passages?|trip|sailing)\b"
        ),
        (GOTO,),
    ),
)
"""Movements that scopes speak of, with the skills that they can be."""


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
