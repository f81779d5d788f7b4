"""What the command has at one of several places ("circle the second"), and the plan elsewhere."""

import re
from collections.abc import Iterator, Sequence

from planner_ft.document.language import Ask, Clause, Data
from planner_ft.document.track import Point, place_of
from planner_ft.document.warnings.asked import gathered_by
from planner_ft.document.warnings.case import Case, Warning, quoted, same_place, warning
from planner_ft.facts import Position
from planner_ft.facts.places import rows_of
from planner_ft.vocabulary import Entry

ORDER = ("first", "second", "third", "fourth", "fifth", "sixth")
ORDINAL = re.compile(
    rf"\bthe (?:very )?({'|'.join(ORDER)}|middle|last|final)(?: (two|three))?"
    r"(?= ones?\b|(?: of (?:them|these|those)| only| alone)?\s*$|\s+([\w ]+))",
    re.IGNORECASE,
)
"""An ordinal that stands for a place, and the noun behind it."""
COUNTS = {None: 1, "two": 2, "three": 3}
ONLY = re.compile(r"\b(?:only|just|alone|nowhere else)\b", re.IGNORECASE)
Wish = Ask | Data
Done = list[tuple[Point, Entry]]  # the tasks with the places where they are


def elsewhere(case: Case) -> Iterator[Warning]:
    """A task or data at other places than the one that a clause picks, or at one that it leaves
    out, and a place that is left out altogether.
    """
    done = _done(case)
    for clause in (one for one in case.clauses if not one.corrected):
        for match in ORDINAL.finditer(clause.text.rstrip(" ,;.!")):
            start = clause.start + match.start()
            groups = _groups(case, start) if _is_place(match[3], case) else []
            sets = [_picked(group, match[1].casefold(), COUNTS[match[2]]) for group in groups]
            if not all(sets) or not sets:
                continue
            for task in [*_wrong(case, clause, start, groups, sets, done)][:1]:
                words = quoted(clause.text.strip(" ,;."))
                yield warning("contradiction", "picked", task, about=words.casefold(), words=words)


def _is_place(noun: str | None, case: Case) -> bool:
    """Whether the noun behind an ordinal, if any, is one of places or of things at them."""
    return noun is None or any(case.words[name].match(noun) for name in ("water", "standing"))


def _groups(case: Case, start: int) -> list[list[Position]]:
    """The places of which an ordinal may pick: the last row of several before it, and all."""
    before = list({(one.x, one.y): one for one in case.positions if one.start < start}.values())
    rows = [row for row in rows_of(case.text, before) if len(row) > 1]
    return [list(one) for one in (*rows[-1:], before) if len(one) > 1]


def _picked(places: Sequence[Position], ordinal: str, count: int) -> list[Position]:
    if ordinal in ("last", "final"):
        return list(places[-count:])
    if ordinal == "middle":
        return [places[len(places) // 2]] if len(places) % 2 else []
    first = ORDER.index(ordinal)
    return list(places[first : first + count])


def _wrong(
    case: Case,
    clause: Clause,
    start: int,
    groups: list[list[Position]],
    sets: list[list[Position]],
    done: Done,
) -> Iterator[Entry]:
    """The tasks that are not where a clause picks places for them, in any way to read it."""
    ruled_out = clause.excluded is not None and clause.excluded < start
    wishes = [
        one
        for one in (*case.spoken.asks, *case.spoken.data)
        if (one.named if ruled_out and isinstance(one, Ask) else one.said).search(clause.text)
    ]
    if ruled_out and not wishes and case.words["replaced"].search(clause.text):
        tasks = [[task for at, task in done if _is_at(at, places)] for places in sets]
        yield from min(tasks, key=len)
    for wish in wishes:
        own = [(at, task) for at, task in done if _does(task, wish, case)]
        said = sum(bool(wish.said.search(one.text)) for one in case.clauses)
        if not ruled_out and said > 1 and not ONLY.search(clause.text):
            continue
        found = []
        for group, places in zip(groups, sets, strict=True):
            others = places if ruled_out else [one for one in group if one not in places]
            found.append([task for at, task in own if _is_at(at, others)])
        yield from min(found, key=len)


def _does(task: Entry, wish: Wish, case: Case) -> bool:
    if isinstance(wish, Ask):
        return task["title"] in wish.tasks
    return bool(wish.skills & gathered_by(task, case.vocabulary))


def _done(case: Case) -> Done:
    found, last = Done(), None
    for task in case.tasks:
        last = place_of(task, case.vocabulary) or last
        if last is not None:
            found.append((last, task))
    return found


def _is_at(at: Point, places: Sequence[Position]) -> bool:
    return any(same_place(place, at) for place in places)
