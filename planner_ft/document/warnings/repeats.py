"""Repeats that the command says and the plan has not: counts, intervals, the same for each; and
what the plan does again unasked.
"""

import itertools
import math
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from planner_ft.document.structures import ROUND
from planner_ft.document.track import place_of, shown
from planner_ft.document.warnings.case import FULL, Case, Warning, quoted, same_place, spot, warning
from planner_ft.facts import Position, is_number, near
from planner_ft.facts.places import rows_of
from planner_ft.vocabulary import Entry

AGAIN = ("again", "repeats")
"""Lists of words for doing something again."""
MANY = 8  # tasks that words may ask for which tell little of any
SENTENCE = re.compile(r"^|[.!?;]\s")
WAITING = ("hold", "follow", "drift", "visual")
"""Patterns of tasks that can go on for as long as nobody says otherwise."""
EVERY = re.compile(r"\b(?:every|each) $", re.IGNORECASE)
ONWARD = re.compile(r"(?:[\s,;/\])\[(>→=-]|and|then|back|to)*", re.IGNORECASE)
"""What stands between the positions of a way: "50,0 -> 50,90 and back to 50,0"."""
TIMES = re.compile(r"x(?=\s+[a-z])", re.IGNORECASE)  # "2x round"
WORD = re.compile(r"\S+")
"""The first or second behind a count says what is repeated: "three full revolutions"."""


def intervals(case: Case) -> Iterator[Warning]:
    """ "Every 100 m", where no value of a task or a skill is that, and no two waypoints behind each
    other lie so far apart.
    """
    apart = [math.dist(*pair) for pair in itertools.pairwise(case.plan.gone)]
    for number in (one for one in case.numbers if one.unit == "m" and case.wants(one.start)):
        every = EVERY.search(case.text[: number.start])
        known = [*case.plan.numbers, *apart]
        if every and not any(near(number.value, other) for other in known):
            yield case.lost(every.start(), number.end)


def each(case: Case) -> Iterator[Warning]:
    """Measures that a clause gives for each of several, and one task or limit alone has."""
    for clause in case.clauses:
        start = clause.spans(case.words["each"])
        at = next((place for place, _end in start), None)
        inside = [
            one
            for one in case.numbers
            if at is not None and at < one.start < clause.end and one.unit in ("m", "s")
        ]
        # "One each 30 s" is an interval.
        timed = any(one.unit == "s" and EVERY.search(case.text[: one.start]) for one in inside)
        having = [
            owner
            for owner in case.plan.owners
            if all(any(near(one.value, other) for other in owner) for one in inside)
        ]
        kept = [one["values"] for one in case.limits if "position" in one["values"]]
        kept = [own for own in kept if any(one.value == own.get("distance") for one in inside)]
        alone = inside and len(having) + len(kept) == 1 and len(case.positions) > 1
        if alone and not timed and not clause.corrected:
            words = quoted(clause.text.strip(" ,;."))
            yield warning("repeat-lost", "each", about=words.casefold(), words=words)


def endless(case: Case) -> Iterator[Warning]:
    """Words for going on without end, where the last thing that the plan does comes to an end."""
    known, home = case.vocabulary.task, case.vocabulary.home
    own = [one for one in case.tasks if place_of(one, case.vocabulary) != home]
    for clause in case.clauses if own and known[own[-1]["title"]].pattern not in WAITING else ():
        if any(clause.spans(case.words["endless"])) and not clause.corrected:
            words = quoted(clause.text.strip(" ,;."))
            yield warning("repeat-lost", "endless", about=words.casefold(), words=words)
            break


def to_and_fro(case: Case) -> Iterator[Warning]:
    """Words for going between places several times, where the plan goes to none of them again."""
    home = tuple(case.vocabulary.home)
    again = Counter(spot(at) for at in case.plan.gone if tuple(at) != home)
    found = case.words["to_and_fro"].search(case.text)
    if found and case.wants(found.start()) and case.tasks and max(again.values(), default=0) < 2:
        words = case.text[found.start() : found.end()]
        yield warning("repeat-lost", "to_and_fro", about=words.casefold(), words=words)


def _is_done_again(count: float, found: Mapping[int, tuple[float, int]], case: Case) -> bool:
    """Whether several tasks go round one known place so often, and the command says so once:
    "twice, first at 20 m, then at 10 m" is a round each.
    """
    turned = list[tuple[float, ...]]()
    for task in case.tasks:
        known = case.vocabulary.task[task["title"]]
        angles = [one.name for one in known.parameters if one.unit == "deg"]
        values = [task["parameters"].get(name) for name in angles if known.pattern in ROUND]
        often = any(is_number(one) and near(one, FULL * count) for one in values)
        if often and (at := place_of(task, case.vocabulary)):
            turned.append(spot(at))
    said = sum(number == count for number, _start in found.values())
    return said == 1 and len(set(turned)) < len(turned)


def repeats(case: Case) -> Iterator[Warning]:
    """Counts of rounds or times that nothing in the plan is done so often."""
    text, found = case.text, dict[int, tuple[float, int]]()
    for number in case.numbers:
        inside = any(place.start <= number.start < place.end for place in case.positions)
        counts = number.unit is None and abs(number.value) >= 2 and number.value.is_integer()
        if counts and not (inside and text[number.end - 1].isdigit()):
            # "Minus thirty four times" may be four times.
            first = itertools.islice(WORD.finditer(text, number.end), 1 if inside else 2)
            if times := TIMES.match(text, number.end):
                found[times.end()] = number.value, number.start
            counted = (case.words["repeats"].match(text, word.start()) for word in first)
            if behind := next(filter(None, counted), None):
                found[behind.end()] = number.value, number.start
    for count, name in ((2.0, "twice"), (3.0, "thrice")):
        spans = (match.span() for match in case.words[name].finditer(text))
        found |= {end: (count, start) for start, end in spans}
    for end, (count, start) in found.items():
        clause = case.clause_at(start)
        if clause and case.wants(start):
            places = [one for one in case.positions if clause.start <= one.start < clause.end]
            sentence = max(match.end() for match in SENTENCE.finditer(text, 0, start))
            ahead = SENTENCE.search(text, end)
            near_by = [
                row
                for row in rows_of(text, case.positions, ONWARD)
                if len(row) > 1
                and sentence <= row[0].start < (ahead.start() if ahead else len(text))
                and (not places or set(row) & set(places))
            ]
            about: Any = {"about": text[start:end].casefold(), "words": text[start:end]}
            if not case.plan.repeats(count, places, near_by[-1] if near_by else ()):
                yield warning("repeat-lost", "count", **about)
            elif not case.words["each"].search(text) and _is_done_again(count, found, case):
                yield warning("repeat-lost", "again", **about)
            elif jump := _jump(near_by[-1] if near_by else (), case):
                one, other = (shown((at.x, at.y)) for at in jump)
                yield warning("repeat-lost", "order", place=one, other=other, **about)


def _jump(row: Sequence[Position], case: Case) -> tuple[Position, Position] | None:
    """The first two places of a round that the plan goes to one behind the other, and that are no
    neighbours on it.
    """
    if row and same_place(row[-1], (row[0].x, row[0].y)):
        row = row[:-1]
    places = (place_of(task, case.vocabulary) for task in case.tasks)
    found = [
        next((number for number, one in enumerate(row) if same_place(one, at)), None)
        for at in places
        if at
    ]
    on_it = [number for number in found if number is not None]
    for one, other in itertools.pairwise(on_it):
        if (other - one) % len(row) not in (0, 1, len(row) - 1):
            return row[one], row[other]
    return None


def done_again(case: Case) -> Iterator[Warning]:
    """What is done again at a place that the command says once, or at once where the vehicle is,
    without words for doing it again. A way leads there again where nothing is done at its end.
    """
    again = any(case.words[name].search(case.command) for name in AGAIN)
    known, done = case.vocabulary, list[tuple[str, Entry]]()
    behind = [known.task[task["title"]].arrival for task in case.tasks[1:]] + ["self"]
    for number, (task, arrival) in enumerate(zip(case.tasks, behind, strict=True)):
        at, one = place_of(task, known), (task["title"], task["parameters"])
        if at is None and one in done[-1:] and not again:
            yield warning("value-not-said", "asked", task, about="asked")
        if at is None or at == known.home:
            done += [one] if at is None else []
            continue
        ends = one not in done[-1:] and arrival == "self"
        said = [place for place in case.positions if same_place(place, at)]
        twice = len(said) == 1 and one in done and (task["title"] != known.transit or ends)
        if twice and not _asked_again(task, case.tasks[:number], said[0], case):
            yield warning("value-not-said", "asked", task, about="asked")
        done.append(one)


def _asked_again(task: Entry, before: Sequence[Entry], at: Position, case: Case) -> bool:
    """Whether a task may be done again on purpose: in another manner, asked for several times, or
    with words for that where the command asks for it or says its place. "Lost it twice on Monday"
    asks for nothing.
    """
    known = case.vocabulary.task[task["title"]]
    alike = (one for one in before if one["title"] == task["title"])
    same = known.pattern not in (*ROUND, "lawnmower") or any(
        one["task_prompt"] == task["task_prompt"] for one in alike
    )
    own = [ask for ask in case.spoken.asks if task["title"] in ask.tasks and len(ask.tasks) < MANY]
    asked = [one for one in case.clauses if any(ask.said.search(one.text) for ask in own)]
    there = [one for one in case.clauses if one.start <= at.start < one.end]
    words = [case.words[name] for name in AGAIN]
    # On the way there and back nothing need be asked for.
    clauses = case.clauses if task["title"] == case.vocabulary.transit else (*asked, *there)
    told = any(word.search(one.text) for one in clauses for word in words)
    return not same or len(asked) > 1 or told
