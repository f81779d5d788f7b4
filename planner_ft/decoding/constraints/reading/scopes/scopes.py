"""In which steps of its plan a filter or perception skill runs, where a task input says so plainly.

The text is cut into clauses. In each stand words for skills, for scopes ("on the second leg only")
and for movements. A scope holds for the skills that stand next to it; a skill in the clause of a
movement runs in that movement. What could be meant in two ways is not read: the model decides.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from planner_ft.decoding.constraints.reading.rows import movement_words as m
from planner_ft.decoding.constraints.reading.scopes import scope_words as w
from planner_ft.decoding.constraints.reading.scopes.governing_scopes import governed
from planner_ft.decoding.constraints.reading.scopes.scope_clauses import (
    Clause,
    clauses_of,
    is_counted,
    plain_form,
)
from planner_ft.decoding.constraints.reading.scopes.scope_parts import EVERYWHERE, Part, Scope
from planner_ft.decoding.constraints.reading.scopes.settled_scopes import TextReading
from planner_ft.decoding.constraints.reading.scopes.skill_words import SKILL_WORDS
from planner_ft.vocabulary import Vocabulary

_STARTED = re.compile(r"\bstart(?:ing)? (?:point|position|at|from)\b.*\bleg (?:1|one)\b")
_RETURN = dict(w.SCOPES)["return"]


def read_scopes(text: str, vocabulary: Vocabulary) -> dict[str, Scope]:
    """The skills of a task input of which it is plain where they run; empty where nothing is."""
    plain = plain_form(text)
    if w.CHANGED.search(plain):
        return {}
    names = [
        skill.name
        for role in ("filter", "perception")
        for skill in vocabulary.skills_in_role(role)
        if skill.name in SKILL_WORDS
    ]
    counted = is_counted(plain)
    clauses = clauses_of(plain, names, counted)
    reading = _reading(plain, clauses, counted)
    found: dict[str, list[tuple[Part | None, str]]] = {}
    before = 0
    latest: set[str] = set()
    for clause in clauses:
        for name, part, source in _placed(clause, before, reading):
            found.setdefault(name, []).append((part, source))
        # "While turning, have the detector look for ferries; while holding, too": the scope is for
        # the skill before.
        if (
            clause.of("scope")
            and not clause.of("skill")
            and not clause.of("move")
            and not w.REFUSED.search(clause.text)
        ):
            for name in latest:
                found.setdefault(name, []).append((None, "unread"))
        latest = {mark.value for mark in clause.of("skill")} or latest
        before += len(clause.of("move"))
    scopes = {
        name: scope
        for name, places in found.items()
        if (scope := _scope(places, reading)) is not None
    }
    # Legs that are numbered behind a start point are not the first steps.
    return {
        name: scope
        for name, scope in scopes.items()
        if "numbered" not in scope.source or not _STARTED.search(plain)
    }


def _reading(plain: str, clauses: Sequence[Clause], counted: bool) -> TextReading:
    moves = tuple(mark.value for clause in clauses for mark in clause.of("move"))
    scopes = [mark for clause in clauses for mark in clause.of("scope")]
    return TextReading(
        moves=moves,
        counted=counted,
        ordered=not w.UNORDERED.search(plain),
        whole=len(w.HOME.findall(_RETURN.sub(" ", plain))) < 2
        and all(clause.marks or clause.head or w.IDLE.match(clause.text) for clause in clauses)
        and all(clause.text.count("@") <= len(clause.marks) for clause in clauses),
        scoped=bool(scopes or w.SCOPED.search(plain)) or any(clause.head for clause in clauses),
        runs=len(w.RUNS.findall(plain)),
        stops=m.HOLD in moves or bool(w.STOPS.search(plain)),
        homewards=bool(w.HOMEWARDS.search(plain)),
        elliptic=bool(w.ELLIPTIC.search(plain)),
        kinds=any(
            mark.value in ("kind", "all")
            and mark.part is not None
            and bool(mark.part.sure | mark.part.maybe)
            for mark in scopes
        ),
        paused=bool(w.PAUSED.search(plain)),
    )


def _scope(places: list[tuple[Part | None, str]], reading: TextReading) -> Scope | None:
    parts = tuple(dict.fromkeys(part for part, _source in places if part is not None))
    # Spoken of in different ways: one of them may be meant for another skill.
    unread = any(part is None for part, _source in places)
    if (
        not parts
        or (unread and EVERYWHERE in parts)
        or len({source for part, source in places if part is not None}) > 1
    ):
        return None
    return Scope(
        parts,
        open=reading.elliptic or any(part is None for part, _source in places),
        source="+".join(sorted({source for part, source in places if part is not None})),
        script=reading.script,
    )


def _placed(
    clause: Clause, before: int, reading: TextReading
) -> Iterator[tuple[str, Part | None, str]]:
    """Each skill of a clause with its steps and how they were found; None for steps that are not
    known.
    """
    skills, scopes, moved = clause.of("skill"), clause.of("scope"), clause.of("move")
    if not skills:
        return
    if scopes:
        yield from governed(clause, before, reading)
        return
    for mark in skills:
        if mark.negated:
            continue
        if clause.head is not None:
            yield mark.value, clause.head, "head"
        elif (
            len(moved) == 1
            and not w.NO_MOVE.search(clause.text)
            and ":" not in clause.text[mark.end : moved[0].start]
            and (
                mark.start > moved[0].start
                or "," not in clause.text[mark.end : moved[0].start]
                or w.BESIDES.match(clause.text)
            )
        ):
            yield mark.value, _movement(before, reading), "move"
        elif not moved and not reading.scoped and len(reading.moves) < 2 and reading.runs < 3:
            yield mark.value, EVERYWHERE, "default"
        else:
            yield mark.value, None, "unread"


def _movement(index: int, reading: TextReading) -> Part | None:
    """The steps of one movement of the text."""
    if reading.script:
        return Part(which=frozenset({index}), script=reading.script)
    name = reading.moves[index]
    if len(reading.moves) < 2 or reading.moves.count(name) > 1:
        return None
    return (
        Part(frozenset({name}), m.KINDS - {name})
        if name not in (m.GOTO, m.FACE, m.NUDGE) and reading.whole and reading.ordered
        else None
    )
