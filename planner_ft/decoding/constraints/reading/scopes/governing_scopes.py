"""Which scope of a clause holds for which of its skills: "on the way out film, and on the way back
take soundings".
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from planner_ft.decoding.constraints.reading.rows import movement_words as m
from planner_ft.decoding.constraints.reading.scopes import scope_words as w
from planner_ft.decoding.constraints.reading.scopes.scope_clauses import Clause, Mark
from planner_ft.decoding.constraints.reading.scopes.scope_parts import EVERYWHERE, Part
from planner_ft.decoding.constraints.reading.scopes.settled_scopes import TextReading, settled


def governed(
    clause: Clause, before: int, reading: TextReading
) -> Iterator[tuple[str, Part | None, str]]:
    groups = _groups(clause)
    moved = clause.of("move")
    held = [(mark, _governor(clause, mark, groups, moved)) for mark in clause.of("skill")]
    # "a pin in the first hold and an entry in the second, another in the third": what runs in the
    # third is not said.
    idle = len(groups) > 1 and any(
        all(group is not other for _mark, other in held) for group in groups
    )
    for mark, group in held:
        if mark.negated and group is None:
            continue
        parts = (
            _meant(group, before, clause, reading)
            if group and not mark.negated and not idle
            else None
        )
        if parts is None:
            yield mark.value, None, "unread"
        for part in parts or ():
            yield mark.value, part, group[0].value if group else ""


def _groups(clause: Clause) -> list[list[Mark]]:
    """The scopes of a clause, those that are one phrase together."""
    groups: list[list[Mark]] = []
    last: Mark | None = None
    for mark in clause.marks:
        if mark.kind == "scope":
            if (
                last is not None
                and last.kind == "scope"
                and w.JOINT.match(clause.text[last.end : mark.start])
                and not clause.text[: mark.end].endswith(
                    f", and {clause.text[mark.start : mark.end]}"
                )
            ):
                groups[-1].append(mark)
            else:
                groups.append([mark])
        last = mark
    return groups


def _meant(
    group: Sequence[Mark], before: int, clause: Clause, reading: TextReading
) -> list[Part] | None:
    """The parts that a phrase names; what it rules out besides says nothing new, unless it takes
    one of them away.
    """
    named = [
        part
        for mark in group
        if not mark.negated
        for part in (settled(mark, before, clause, reading),)
    ]
    ruled_out = [mark.part for mark in group if mark.negated and mark.part is not None]
    if not named or any(part is None for part in named):
        return None
    parts = [part for part in named if part is not None]
    whole = any(part.which is None for part in parts)
    if (
        ruled_out
        and whole
        and any(
            not part.sure or not other.sure or part.sure & other.sure
            for part in ruled_out
            if part
            for other in parts
        )
    ):
        return None
    return parts


def _governor(
    clause: Clause, skill: Mark, groups: list[list[Mark]], moved: Sequence[Mark]
) -> list[Mark] | None:
    """The phrase that holds for a skill; None where it is not plain."""
    if len(groups) == 1:
        group = groups[0]
        if not _reaches(clause.text, skill, group):
            return None
        between = [
            mark
            for mark in moved
            if min(skill.start, group[0].start) < mark.start < max(skill.start, group[0].start)
        ]
        if not moved:
            return group
        if group[0] is clause.marks[0] and len(moved) == 1 and group[0].part is not EVERYWHERE:
            # "At each corner drift with the logger on" is about what is done there.
            part = group[0].part
            return (
                None
                if part and m.HOLD in part.maybe and moved[0].value not in (m.GOTO, m.HOLD)
                else group
            )
        return group if not between and group[0].part is not EVERYWHERE else None
    if moved:
        return None
    order = [mark for mark in clause.marks if mark.kind != "move"]
    if order[0].kind == "scope" and order[-1].kind == "skill":
        return next((group for group in reversed(groups) if group[-1].end <= skill.start), None)
    if order[0].kind == "skill" and order[-1].kind == "scope":
        return next((group for group in groups if group[0].start >= skill.end), None)
    return None


def _reaches(text: str, skill: Mark, group: Sequence[Mark]) -> bool:
    """Whether a phrase that does not open its clause can hold for a skill: no new item of a list
    stands between them.
    """
    if not text[: group[0].start].strip(" ,:"):
        return True
    if skill.start >= group[-1].end:
        between = text[group[-1].end : skill.start]
        return "," not in (
            w.INSERTED.sub("", between)
            if re.search(r"(?:,|\band)\s*$", text[: group[0].start])
            else between
        )
    if text[group[0].start :].startswith("the ") and text[: group[0].start].rstrip().endswith(","):
        return False
    *_, behind = text[skill.end : group[0].start].split(",")
    same_item = behind == text[skill.end : group[0].start]
    return (
        same_item
        or re.search(r"\b(?:and|or)\b", behind) is not None
        or not re.search(r"\b(?!but\b)\w{3,}", behind)
    )
