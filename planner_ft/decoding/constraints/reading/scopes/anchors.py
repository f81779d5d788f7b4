"""The words of a text that say where something is done, and its movements, in their order, each
with the steps that it means.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from planner_ft.decoding.constraints.reading.rows.movement_rows import Plain, Row
from planner_ft.decoding.constraints.reading.scopes import step_scope_words as s
from planner_ft.decoding.constraints.reading.scopes.step_meanings import meaning
from planner_ft.decoding.constraints.reading.scopes.where import EVERYWHERE, Anchor, Phrase, Where

Found = Sequence[tuple[str, re.Match[str]]]
"""Scopes of a text by how they are told."""

_DENIED_SCOPE = re.compile(
    r"\b(?:not|never|nor|none|neither|nothing|nowhere|no|without|no one|nobody|needs nothing)(?:"
    r" (?!(?:and|but|with)\b)[\w-]+){0,2},? ?(?:(?:and|"
    r"but) )?$|\bno other(?: \w+)?$"
)
_MOVES = re.compile(
    r"\b(?:on|back|out|over)"
    r" $|\b(?:go|goes|come|comes|move|pass|head|sail|proceed|drive|steam|motor|follow|track|continue|carry|return|"
    r"run (?:along|on|up|out|back|past|down|straight|in|it))\b[^.;,@]*$"
)
"""Words for a movement that a place behind them is the end of."""
_BOUND = re.compile(
    r"\b(?:(?P<after>once|after|as soon as|when|from the end of)|(?P<until>until|till|up to(?: and"
    r" including| the end of)?|until the end of|"
    r"to the end of|through to)|(?P<before>before)|"
    r"(?P<other>(?:since|by|than|as|like|unlike|past|beyond|between|from|towards?)(?="
    r" $)))(?P<words>(?: (?!the\b|and\b|but\b)\w+){0,2}) ?$"
)
_OVER = re.compile(r" (?:is|has been|was) (?:over|done|finished|through|complete\w*|behind)\b")
_BY_KIND = ("kind", "all", "while", "everywhere", "corner", "both", "that")
"""Scopes that mean steps also where the movements of a text cannot be counted."""
_STAYS = frozenset({s.HOLD, s.DRIFT, s.ARC, s.VISUAL, s.WAIT})
"""Movements that are meant by their kind where all of a kind are meant."""


def scopes_of(text: str) -> Iterator[tuple[str, re.Match[str]]]:
    """The scopes of a text, none over another."""
    taken: list[tuple[int, int]] = []
    found = []
    for kind, pattern in s.SCOPES:
        for match in pattern.finditer(text):
            if (
                kind == "upto"
                and re.match("up|as", match[0])
                and _MOVES.search(text[: match.start()])
            ):
                continue
            if all(match.end() <= start or end <= match.start() for start, end in taken):
                taken.append(match.span())
                found.append((kind, match))
    yield from sorted(found, key=lambda one: one[1].start())


def anchors_of(said: Plain, found: Found, row: Row, counted: bool) -> list[Anchor]:
    """The movements and scopes of a text in their order, each with what it means."""
    anchors = [
        Anchor(unit.start, unit.end, False, Where(_chain(row, index)) if counted else None)
        for index, unit in enumerate(row.units)
    ]
    for kind, match in found:
        if any(anchor.start < match.end() and match.start() < anchor.end for anchor in anchors):
            continue
        before = sorted(
            (anchor for anchor in anchors if anchor.end <= match.start() and not anchor.denied),
            key=lambda anchor: anchor.start,
        )
        where = _where(Phrase(kind, match, row, before, said), counted)
        clause = re.split(r"[.;:!?]", said.text[: match.start()])[-1]
        anchors.append(
            Anchor(
                match.start(),
                match.end(),
                True,
                where,
                _DENIED_SCOPE.search(clause) is not None,
                kind,
            )
        )
    return sorted(anchors, key=lambda anchor: anchor.start)


def _where(phrase: Phrase, counted: bool) -> Where | None:
    """The steps that a scope means; where movements cannot be `counted`, only those that no number
    tells.
    """
    row, text, match = phrase.row, phrase.said.text, phrase.match
    where = meaning(phrase) if counted or phrase.kind in _BY_KIND else None
    if (
        phrase.kind == "everywhere"
        and where is None
        and counted
        and {unit.kind for unit in row.units} == {s.GOTO}
    ):
        where = EVERYWHERE
    where = _by_kind(
        _bounded(where, text[: match.start()], text[match.end() :], phrase.count), phrase
    )
    if where is None or counted:
        return where
    return (
        Where(kinds=where.kinds, parity=where.parity)
        if where.kinds is not None or where.parity is not None
        else None
    )


def _by_kind(where: Where | None, phrase: Phrase) -> Where | None:
    """Movements that are all of their kinds, also by these: a plan that does not go by the row is
    told as much.
    """
    if where is None or not where.units or where.kinds is not None:
        return where
    kinds = phrase.kinds_at(where.units)
    whole = kinds <= _STAYS and phrase.row.of(kinds) == tuple(sorted(where.units))
    return Where(where.units, kinds) if whole else where


def _bounded(where: Where | None, before: str, behind: str, count: int) -> Where | None:
    """What a word before a scope makes of it: "once the first hold is over", "up to the end of the
    second leg".
    """
    bound = _BOUND.search(before)
    if bound is None or where is None:
        return where
    if where.units is None or bound["words"]:
        return None
    over = _OVER.match(behind) is not None
    if bound["after"] and (over or bound["after"] in ("after", "from the end of")):
        units = range(max(where.units) + 1, count)
    elif bound["until"] and (over or "end" in bound["until"] or "includ" in bound["until"]):
        units = range(max(where.units) + 1)
    elif bound["before"] or bound["until"] == "until":
        units = range(min(where.units))
    else:
        return None
    return Where(frozenset(units)) if units else None


def _chain(row: Row, index: int) -> frozenset[int]:
    """A movement with those that are named in one list with it."""
    first = index
    while row.units[first].chained and first:
        first -= 1
    last = index
    while last + 1 < len(row.units) and row.units[last + 1].chained:
        last += 1
    return frozenset(range(first, last + 1))
