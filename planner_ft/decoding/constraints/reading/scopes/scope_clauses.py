"""The clauses of a text with the words in them that count: for skills, for scopes and for
movements.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from planner_ft.data.quantities import positions
from planner_ft.decoding.constraints.reading.paths.itinerary import without_fences
from planner_ft.decoding.constraints.reading.rows import movement_words as m
from planner_ft.decoding.constraints.reading.scopes import scope_words as w
from planner_ft.decoding.constraints.reading.scopes.scope_parts import EVERYWHERE, Part
from planner_ft.decoding.constraints.reading.scopes.skill_words import (
    FREE,
    LAPSED,
    NEGATED,
    SKILL_WORDS,
)

TOLD = ("range", "but", "middle", "return")
"""Scopes that only the movements of the text tell."""
_UNREAD = ("to", "place", *TOLD)
_WHOLE = {"bare": EVERYWHERE, "everywhere": EVERYWHERE, "way": Part(frozenset({m.GOTO}))}
"""Scopes that mean the same steps in every text."""


@dataclass(frozen=True)
class Mark:
    """A word of a clause that counts: of a skill, a scope or a movement."""

    start: int
    end: int
    kind: str
    value: str
    part: Part | None = None
    negated: bool = False
    said: Mapping[str, str | None] = field(default_factory=dict)
    """The words of a scope that is told by the movements of the text."""


@dataclass(frozen=True)
class Clause:
    """A clause with its marks in order; `head`: the scope that a heading before it gives to all of
    it.
    """

    text: str
    marks: tuple[Mark, ...]
    head: Part | None = None

    def of(self, kind: str) -> list[Mark]:
        return [mark for mark in self.marks if mark.kind == kind]


# ---------------------------------------------------------------- clauses and marks


def plain_form(text: str) -> str:
    """The text in small letters, with marks for quotations and places and without corners of
    boundaries and names of cameras.
    """
    plain = m.QUOTED.sub(" q ", without_fences(text))
    behind = len(plain)
    for _x, _y, start, end in sorted(positions(plain), key=lambda found: -found[2]):
        if end <= behind and not m.COUNTED.search(plain[:start]):
            plain, behind = plain[:start] + "@" + plain[end:], start
    return w.SPACES.sub(_closed, m.SENSORS.sub(" cam ", w.PLACE.sub(" @ ", plain.lower())))


def _closed(match: re.Match[str]) -> str:
    """A space, or the mark that stood behind spaces."""
    return match[1] or " "


def is_counted(plain: str) -> bool:
    """Whether each movement of a text is one step, as far as its words tell."""
    rest = w.PERIOD.sub(" ", plain)
    for kind, pattern in w.SCOPES:
        if kind in ("all", "except", "everywhere", "ordinal", "numbered", "while"):
            rest = pattern.sub(" ", rest)
    return not (w.MANY.search(rest) or w.RUN_ON.search(plain))


def clauses_of(plain: str, names: Sequence[str], counted: bool) -> list[Clause]:
    clauses: list[Clause] = []
    for sentence in w.SENTENCE.split(plain):
        head: Part | None = None
        for text in w.CLAUSE.split(sentence):
            if not text.strip() or w.TWO_STEPS.match(text):
                continue
            clause = Clause(text, tuple(marks_of(text, names, counted)))
            header = w.HEADER.match(text)
            first = clause.marks[0] if clause.marks else None
            if header and first and first.kind == "scope" and first.end <= header.end():
                head = first.part
            elif head is not None and not clause.of("scope"):
                clause = replace(clause, head=head)
            clauses.append(clause)
    return clauses


def marks_of(text: str, names: Sequence[str], counted: bool) -> list[Mark]:
    scopes = list(
        _apart(
            (
                Mark(
                    match.start(),
                    match.end(),
                    "scope",
                    kind,
                    _part(kind, match, counted),
                    _negated(text, match),
                    match.groupdict() | {"whole": match[0]},
                )
                for kind, pattern in w.SCOPES
                for match in pattern.finditer(text)
            ),
            [],
        )
    )
    moves = list(
        _apart(
            (
                Mark(match.start(), match.end(), "move", name)
                for name, pattern in m.MOVEMENTS
                for match in pattern.finditer(text)
            ),
            [mark for mark in scopes if mark.value != "to"],
        )
    )
    scopes = [
        mark
        for mark in _apart(scopes, moves)
        if not (moves and mark.value == "to" and w.AFTER_THAT.match(text[: mark.end]))
    ]
    skills = [
        Mark(
            match.start(),
            match.end(),
            "skill",
            name,
            None,
            bool(NEGATED.search(text[: match.start()]) or LAPSED.match(text[match.end() :])),
        )
        for name in names
        for match in SKILL_WORDS[name].finditer(text)
        if not FREE.search(match[0])
    ]
    skills = [
        mark
        for mark in skills
        if not any(
            other.start <= mark.start and mark.end <= other.end for other in (*scopes, *moves)
        )
    ]
    return sorted([*scopes, *moves, *skills], key=lambda mark: (mark.start, mark.end))


def _apart(marks: Iterable[Mark], taken: Iterable[Mark]) -> Iterator[Mark]:
    """Those that lie apart from all before them."""
    kept = list(taken)
    for mark in marks:
        if all(mark.end <= other.start or other.end <= mark.start for other in kept):
            kept.append(mark)
            yield mark


def _negated(text: str, match: re.Match[str]) -> bool:
    return w.NOT_BEFORE.search(text[: match.start()]) is not None


# ---------------------------------------------------------------- what a scope means by itself


def _part(kind: str, match: re.Match[str], counted: bool) -> Part | None:
    """The steps that a scope means; None where it is not read."""
    if kind in _UNREAD or (
        kind == "ordinal" and str(match.groupdict().get("noun")).startswith("of ")
    ):
        return None
    if kind in _WHOLE:
        return _WHOLE[kind]
    if kind == "while":
        gerund = next(
            name for name, value in match.groupdict().items() if value and name != "gerund"
        )
        meant, others = w.GERUNDS[gerund]
        return Part(frozenset({meant}), frozenset(others))
    return _of_noun(kind, match.groupdict(), counted)


def _of_noun(kind: str, groups: Mapping[str, str | None], counted: bool) -> Part | None:
    """The steps that a noun means, with the numbers beside it."""
    sure, maybe = kinds_of(groups.get("noun") or "step")
    part = Part(sure, maybe, counted=counted)
    if kind == "kind" and not part.sure and not part.maybe:
        return None
    if kind == "except" and groups.get("before"):
        sure, maybe = kinds_of(groups["before"] or "")
        part = replace(part, sure=sure, maybe=maybe)
    elif kind == "except" and part.sure | part.maybe:
        part = replace(part, others=True)
    if kind == "several":
        return (
            replace(part, which=frozenset(range(w.COUNTS[groups["count"] or ""])))
            if groups["side"] == "first"
            else None
        )
    if cards := groups.get("cards"):
        return replace(
            part,
            which=frozenset(
                w.CARDINAL[word]
                for word in re.findall(r"\b(?:[a-f]|[1-9]|[a-z]{3,5})\b", cards)
                if word in w.CARDINAL
            ),
        )
    if ords := groups.get("ords"):
        return replace(
            part,
            which=frozenset(w.ORDINAL[word] for word in re.findall(rf"\b{w.ORD}\b", ords)),
            excepted=kind == "except",
        )
    return part


def kinds_of(noun: str) -> tuple[frozenset[str], frozenset[str]]:
    return next(
        (
            kinds
            for pattern, kinds in zip(w.MOVEMENT_KINDS, w.NOUNS.values(), strict=True)
            if pattern.fullmatch(noun)
        ),
        (frozenset(), frozenset()),
    )
