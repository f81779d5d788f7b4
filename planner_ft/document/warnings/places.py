"""Positions that a command says one behind the other, places that it names, and what the plan does
there.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from planner_ft.document.language import Clause
from planner_ft.document.track import Point, place_of
from planner_ft.document.warnings.warning import Warning, warning
from planner_ft.facts import Position, near
from planner_ft.planning.locations import ARTICLE
from planner_ft.vocabulary import Vocabulary

ROW = 3


def uneven_rows(
    rows: Sequence[Sequence[Position]], document: Mapping[str, Any], vocabulary: Vocabulary
) -> Iterator[Warning]:
    """A position to which the plan only goes, where it does one thing at all others of its row."""
    done = _done_at(document["tasks"], vocabulary)
    for row in rows:
        titles = [_at(done, (place.x, place.y)) for place in row]
        if len(row) < ROW or None in titles:
            continue
        bare = [place for place, own in zip(row, titles, strict=True) if not own]
        common = set.intersection(*(own for own in titles if own)) if any(titles) else set()
        if len(bare) == 1 and common:
            (place,), what = bare, ", ".join(sorted(common))
            where = f"[{place.x:g}, {place.y:g}]"
            text = f"The plan has {what} at every place named beside {where}, and none there."
            yield warning("value-lost", text, about=where)


def _done_at(tasks: Sequence[Mapping[str, Any]], vocabulary: Vocabulary) -> dict[Point, set[str]]:
    """The titles of the tasks at each place, but for the ways to it."""
    done, at = dict[Point, set[str]](), None
    for task in tasks:
        place = place_of(task, vocabulary)
        at = (place[0], place[1]) if place else at
        if at is not None:
            own = {task["title"]} - {vocabulary.transit, vocabulary.locate}
            key = next((one for one in done if all(map(near, one, at))), at)
            done[key] = done.get(key, set()) | own
    return done


def _at(done: Mapping[Point, set[str]], place: Point) -> set[str] | None:
    return next((own for one, own in done.items() if all(map(near, one, place))), None)


def unvisited(
    clauses: Sequence[Clause], document: Mapping[str, Any], vocabulary: Vocabulary
) -> Iterator[Warning]:
    """A known place that the command names, and to which neither a task nor a limit leads."""
    places = [place_of(task, vocabulary) for task in document["tasks"]]
    places += [limit["values"].get("position") for limit in document.get("limits", ())]
    known = [place for place in places if place]
    for name, at in document.get("structures", {}).items():
        said = re.compile(rf"(?<!\w){re.escape(ARTICLE.sub('', name))}(?!\w)", re.IGNORECASE)
        wanted = any(any(clause.spans(said)) and not clause.corrected for clause in clauses)
        if wanted and not any(all(map(near, at, place)) for place in known):
            where = f"[{at[0]:g}, {at[1]:g}]"
            text = f"The command speaks of {name}, and no task is at {where}, where that is."
            yield warning("value-lost", text, about=name.casefold())
