"""How grave each kind of warning is, and its name for people.

A **danger** can cost the vehicle, or harm or break what the command rules out. A **caution** says
that the plan is not what was asked for, or cannot be carried out. A **note** also right plans have.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Literal

Severity = Literal["danger", "caution", "note"]
SEVERITIES: tuple[Severity, ...] = ("danger", "caution", "note")
"""The gravest first."""
DANGERS = {
    "unknown-language": "The command was hardly understood",
    "invalid-answer": "A part of the plan is not valid",
    "structure-close": "Too close to a structure",
    "limit-broken": "A limit is broken",
    "limit-lost": "A limit is in no task",
    "contradiction": "The plan contradicts itself or the command",
    "doubtful-origin": "The origin is doubtful",
    "outside-boundary": "Outside a boundary",
    "outside-area": "Outside the area of the vehicle",
    "out-of-reach": "Too far to come back",
    "over-endurance": "Longer than the vehicle lasts",
    "missing-return": "Does not come home",
    "data-ruled-out": "Records what was ruled out",
}
CAUTIONS = {
    "repeat-lost": "A repetition is missing",
    "unresolved-location": "A place is not known",
    "value-asked": "A value must be given",
    "used-before-found": "Used before it is found",
    "not-at-place": "Not at the place of the task",
    "position-missing": "A position is missing",
    "not-planned": "Asked for and not planned",
    "data-not-planned": "Data is not gathered",
    "not-performed": "The steps do not carry out the task",
    "value-not-said": "A value that nobody said",
    "skill-value-not-said": "A value in a step that nobody said",
    "value-lost": "A stated value is in no task",
    "stale-skills": "Steps are out of date",
    "no-skills": "Steps are missing",
}
NOTES_NAMED = {
    "empty-plan": "There is no task",
    "unread-command": "The command was not read in full",
    "data-not-collected": "Sent without being gathered",
    "endurance-open": "Much of the endurance is used",
}
MEANING: dict[str, tuple[Severity, str]] = {
    **{kind: ("danger", name) for kind, name in DANGERS.items()},
    **{kind: ("caution", name) for kind, name in CAUTIONS.items()},
    **{kind: ("note", name) for kind, name in NOTES_NAMED.items()},
}


def meaning(kind: str) -> tuple[Severity, str]:
    """Severity and name of a kind; one that is not known, as of another version, is a caution."""
    return MEANING.get(kind, ("caution", kind.replace("-", " ").capitalize()))


def gravest_first(warnings: Iterable[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    """Dangers, then cautions, then notes, each in the order that they have."""
    return sorted(warnings, key=lambda one: SEVERITIES.index(meaning(one["kind"])[0]))
