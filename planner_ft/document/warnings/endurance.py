"""Whether the vehicle lasts, and where the plan leaves it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from planner_ft.data.rules import DOCKING
from planner_ft.document.clauses import said_apart
from planner_ft.document.language import language
from planner_ft.document.track import Point, Track, place_of
from planner_ft.document.warnings.warning import Warning, named, warning
from planner_ft.vocabulary import Vocabulary

MUCH = 0.5
"""The part of the endurance from which parts of unknown length matter."""


def endurance_warnings(
    document: Mapping[str, Any], path: Track, vocabulary: Vocabulary
) -> Iterator[Warning]:
    """Time against endurance, the way home included, and a return that is missing."""
    away = _ends_away(document["tasks"], vocabulary)
    yield from _over(document, path, vocabulary, away is not None)
    if away is None:
        return
    if said_apart(document["command"], language(vocabulary).words["home"], vocabulary):
        yield warning(
            "missing-return",
            f"The command speaks of coming home or back, and the plan ends with {named(away)} and"
            " no return.",
        )
    elif not language(vocabulary).words["stay"].search(document["command"]):
        yield warning(
            "ends-away",
            f"The plan ends with {named(away)}: it brings the vehicle neither home nor to a dock.",
        )


def _over(
    document: Mapping[str, Any], path: Track, vocabulary: Vocabulary, away: bool
) -> Iterator[Warning]:
    vehicle, estimate = document.get("vehicle") or {}, document.get("estimate") or {}
    endurance = vehicle.get("endurance")
    if not endurance or not estimate:
        return
    home = _way_home(path, vocabulary) / vehicle["cruise_speed"] if away else 0.0
    seconds = estimate["seconds"] + home
    told = f"{_minutes(estimate['seconds'])}{f' and {_minutes(home)} for the way home' if home >= 60 else ''}"
    unknown = (
        f" Not counted is what is not known of {_listed(estimate['open'])}."
        if estimate["open"]
        else ""
    )
    if seconds > endurance:
        yield warning(
            "over-endurance",
            f"The plan takes at least {told}, and the vehicle lasts"
            f" {_minutes(endurance)}.{unknown}",
        )
    elif unknown and seconds > MUCH * endurance:
        yield warning(
            "endurance-open",
            f"The known part of the plan takes {told} of the vehicle's"
            f" {_minutes(endurance)}.{unknown}",
        )


def _ends_away(
    tasks: Sequence[Mapping[str, Any]], vocabulary: Vocabulary
) -> Mapping[str, Any] | None:
    """The last task that takes place somewhere, unless that is home or a dock."""
    for task in reversed(tasks):
        known = vocabulary.task[task["title"]]
        visual_dock = known.arrival == "none" and known.pattern == "visual"
        if known.pattern == DOCKING or visual_dock or place_of(task, vocabulary) == vocabulary.home:
            return None
        if known.arrival != "none":
            found: Mapping[str, Any] = task
            return found
    return None


def _way_home(path: Track, vocabulary: Vocabulary) -> float:
    last: Point | None = next((leg.points[-1] for leg in reversed(path.legs) if leg.points), None)
    return math.dist(last, vocabulary.home) if last else 0.0


def _minutes(seconds: float) -> str:
    return f"{math.ceil(seconds / 60):,} min"


def _listed(names: list[str]) -> str:
    return (
        ", ".join(names)
        if len(names) <= 6
        else f"{', '.join(names[:6])} and {len(names) - 6} more tasks"
    )
