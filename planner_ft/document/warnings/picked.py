"""What the command has at one of several places ("circle the second"), and the plan elsewhere or at
others, too; and what it corrects.
"""

import itertools
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from planner_ft.document.language import Ask, Clause, Data
from planner_ft.document.ontology import named_places
from planner_ft.document.structures import ROUND
from planner_ft.document.track import Point, place_of, shown
from planner_ft.document.warnings.case import (
    Case,
    Warning,
    area_corners,
    quoted,
    same_place,
    spot,
    warning,
)
from planner_ft.document.warnings.data import gathered_by
from planner_ft.document.warnings.said import CORRECTED, NO
from planner_ft.facts import Position, is_number, near
from planner_ft.facts.places import rows_of
from planner_ft.facts.units import named
from planner_ft.planning.locations import ARTICLE
from planner_ft.vocabulary import Entry

ORDER = ("first", "second", "third", "fourth", "fifth", "sixth")
ORDINAL = re.compile(
    rf"\bthe (?:very )?({'|'.join(ORDER)}|middle|last|final)(?: (two|three))?"
    r"(?= ones?\b|(?: of (?:them|these|those)| only| alone)?\s*$|\s+([\w ]+))",
    re.IGNORECASE,
)
"""An ordinal that stands for a place, and the noun behind it."""
LABEL = re.compile(r"(?<!\w)([A-Z]{1,2}\d{0,2})\s*(?:(?:is )?at|=|:)?\s*[\[(]?$")  # "A 10,20"
QUOTED = re.compile(r"\"[^\"]{8,}\"|“[^”]{8,}”")
CLOSE = 32  # characters between "begin at" and its position
COUNTS = {None: 1, "two": 2, "three": 3}
ONLY = re.compile(r"\b(?:only|just|alone|nowhere else)\b", re.IGNORECASE)
Places = Sequence[Position]
Done = list[tuple[Point, Entry]]  # the tasks with the places where they are


@dataclass(frozen=True)
class Choice:
    """A clause that picks places of a group, or rules them out."""

    clause: Clause
    group: Places
    picked: Places
    ruled_out: bool

    def wishes(self, case: Case) -> list[Ask | Data]:
        """What is asked for there, or ruled out."""
        asks = case.spoken.asks
        found: list[Ask | Data] = [
            one
            for one in asks
            if (one.named if self.ruled_out else one.said).search(self.clause.text)
        ]
        return [*found, *(one for one in case.spoken.data if one.said.search(self.clause.text))]


def elsewhere(case: Case) -> Iterator[Warning]:
    """A task or data at other places than the one that a clause picks, or at one that it leaves
    out, and a place that is left out altogether.
    """
    done = _done(case)
    every = [one for choices in _choices(case) for one in choices if not one.ruled_out]
    for choices in _choices(case):
        # Where an ordinal can be read in two ways, the plan may have either.
        wrong = min((list(_wrong(case, one, done)) for one in choices), key=len, default=[])
        others = [one for one in every if one.clause is not choices[0].clause]
        fine = [task for at, task in done if any(_is_at(at, one.picked) for one in others)]
        wrong = [task for task in wrong if task not in fine]
        for task in wrong[:1]:
            words = quoted(choices[0].clause.text.strip(" ,;."))
            yield warning("contradiction", "picked", task, about=words.casefold(), words=words)


def quoted_places(case: Case) -> Iterator[Warning]:
    """Tasks at a place that stands in words of somebody else alone: "the mail said 'go to 9,9'"."""
    spans = [match.span() for match in QUOTED.finditer(case.command)]
    for task in case.tasks if spans else ():
        at = place_of(task, case.vocabulary)
        said = [one for one in case.positions if at and same_place(one, at)]
        inside = [any(start < one.start < end for start, end in spans) for one in said]
        if said and all(inside):
            words = quoted(case.text[said[0].start : said[0].end])
            yield warning("value-not-said", "quoted", task, about=words, words=words)


def left_out(case: Case) -> Iterator[Position]:
    """The places that a clause leaves out: "skip the middle one"."""
    for choice in (one for choices in _choices(case) for one in choices):
        if _leaves_out(choice, case):
            yield from choice.picked


def _choices(case: Case) -> Iterator[list[Choice]]:
    """The choices of every ordinal: from the last row of several places before it, and from all."""
    for clause in (one for one in case.clauses if not one.corrected):
        for match in ORDINAL.finditer(clause.text.rstrip(" ,;.!")):
            start = clause.start + match.start()
            ruled_out = clause.excluded is not None and clause.excluded < start
            before = {(one.x, one.y): one for one in case.positions if one.start < start}
            rows = [row for row in rows_of(case.text, before.values()) if len(row) > 1]
            choices = [
                Choice(clause, group, picked, ruled_out)
                for group in (*rows[-1:], list(before.values()))
                if (picked := _picked(group, match[1].casefold(), COUNTS[match[2]]))
            ]
            if choices and len(before) > 1 and _is_place(match[3], case):
                yield choices


def _is_place(noun: str | None, case: Case) -> bool:
    """Whether the noun behind an ordinal, if any, is one of places or of things at them."""
    return noun is None or any(case.words[name].match(noun) for name in ("water", "standing"))


def _picked(places: Places, ordinal: str, count: int) -> Places:
    if ordinal in ("last", "final"):
        return places[-count:]
    if ordinal == "middle":
        return [places[len(places) // 2]] if len(places) % 2 else []
    first = ORDER.index(ordinal)
    return places[first : first + count]


def _leaves_out(choice: Choice, case: Case) -> bool:
    skips = case.words["replaced"].search(choice.clause.text) is not None
    return choice.ruled_out and skips and not choice.wishes(case)


def _wrong(case: Case, choice: Choice, done: Done) -> Iterator[Entry]:
    """The tasks that are not where a choice has them."""
    if _leaves_out(choice, case):
        yield from (task for at, task in done if _is_at(at, choice.picked))
    rest = [one for one in choice.group if one not in choice.picked]
    for wish in choice.wishes(case):
        said = sum(wish.said.search(one.text) is not None for one in case.clauses)
        if choice.ruled_out or said < 2 or ONLY.search(choice.clause.text):
            barred = choice.picked if choice.ruled_out else rest
            own = [(at, task) for at, task in done if _does(task, wish, case)]
            yield from (task for at, task in own if _is_at(at, barred))


def _does(task: Entry, wish: Ask | Data, case: Case) -> bool:
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


def _is_at(at: Point, places: Places) -> bool:
    return any(same_place(place, at) for place in places)


def named_order(case: Case) -> Iterator[Warning]:
    """Things whose places are told first, and which the command then names in another order than
    the plan goes to them, without a word that turns an order round.
    """
    said = _named_again(case)
    if not said or case.words["orders"].search(case.text, min(said.values())[0]):
        return
    at = (place_of(task, case.vocabulary) for task in case.tasks)
    gone = [one for one in dict.fromkeys(spot(one) for one in at if one) if one in said]
    named = sorted(gone, key=lambda one: said[one])
    if gone != named and len({said[one][0] for one in named}) == len(named):
        words = ", ".join(said[one][1] for one in named)
        yield warning("contradiction", "named", about=words.casefold(), words=words)


def ends_otherwise(case: Case) -> Iterator[Warning]:
    """A place at which the command begins or ends, and a plan that goes to another one first, or
    last but for the way home.
    """
    at = (place_of(task, case.vocabulary) for task in case.tasks)
    gone = [one for one in dict.fromkeys(filter(None, at)) if one != case.vocabulary.home]
    for name, end in (("starts_at", 0), ("ends_at", -1)):
        for said in case.words[name].finditer(case.text) if len(gone) > 1 else ():
            place = next((one for one in case.positions if one.start >= said.end()), None)
            between = case.text[said.end() : place.start] if place else ""
            close = len(between) <= CLOSE and not any(mark in between for mark in ".;\n")
            if place is None or not close or not case.wants(said.start()):
                continue
            if any(same_place(place, one) for one in gone) and not same_place(place, gone[end]):
                words = quoted(case.text[said.start() : place.end])
                yield warning("contradiction", "ends", about=words.casefold(), words=words)


def is_listed(place: Position, case: Case) -> bool:
    """Whether a position is one of a list of things, of which the command then names others."""
    said, clause = _named_again(case), case.clause_at(place.start)
    asking = [case.words["verb"], case.spoken.sensors, *(ask.said for ask in case.spoken.asks)]
    asked = clause is None or any(words.search(clause.text) for words in asking)
    named = any(same_place(one, (place.x, place.y)) for _name, one in _things(case))
    return bool(said) and named and not asked and spot((place.x, place.y)) not in said


def _things(case: Case) -> list[tuple[str, Position]]:
    """The things of the command, and its letters, with their places."""
    labels = ((LABEL.search(case.text[: place.start]), place) for place in case.positions)
    things = [(match[1], place) for match, place in labels if match]
    return [*things, *named_places(case.text, case.vocabulary)]


def _named_again(case: Case) -> dict[tuple[float, ...], tuple[int, str]]:
    """Where the command names things behind all of their places, with the name, by the place."""
    things, said = _things(case), dict[tuple[float, ...], tuple[int, str]]()
    last = max((place.end for _name, place in things), default=0)
    for name, place in things:
        bare = ARTICLE.sub("", name)
        again = re.compile(rf"(?<!\w){re.escape(bare)}(?!\w)", re.IGNORECASE if bare[1:] else 0)
        found = [at.start() for at in again.finditer(case.text, last) if case.wants(at.start())]
        if found:
            said[spot((place.x, place.y))] = found[0], bare
    return said


def at_corners(case: Case) -> Iterator[Warning]:
    """Ways to a corner of an area that the plan goes over whole, where nothing is done and the
    command says it for the area alone.
    """
    known = case.vocabulary
    corners = {spot(at) for task in case.tasks for at in area_corners(task["parameters"])}
    behind = [known.task[task["title"]].arrival for task in case.tasks[1:]] + ["self"]
    for task, arrival in zip(case.tasks, behind, strict=True):
        at = place_of(task, known) if task["title"] == known.transit and arrival == "self" else None
        said = [one for one in case.positions if at and same_place(one, at)]
        if at and at != known.home and spot(at) in corners and len(said) == 1:
            yield warning("value-not-said", "asked", task, about="asked")


def of_another_task(case: Case) -> Iterator[Warning]:
    """A name of one task that the command says only where it asks for others: a video of the
    "subsea cable" that is to be tracked. What is looked for is named by other tasks.
    """
    asks, titles = case.spoken.asks, {task["title"] for task in case.tasks}
    values = [value for task in case.tasks for value in task["parameters"].values()]
    for task in case.tasks:
        own = [ask for ask in asks if task["title"] in ask.tasks]
        others = [ask for ask in asks if ask not in own and ask.tasks & titles]
        for item in case.vocabulary.task[task["title"]].parameters:
            value = task["parameters"].get(item.name) if item.type == "text" else None
            if not value or values.count(value) > 1 or task["title"] == case.vocabulary.locate:
                continue
            said = re.finditer(re.escape(value), case.text, re.IGNORECASE)
            clauses = [clause for one in said if (clause := case.clause_at(one.start()))]
            alien = [_asked_in(one, others) and not _asked_in(one, own) for one in clauses]
            if clauses and all(alien):
                words = {"name": item.name, "value": f'"{value}"'}
                words["words"] = quoted(clauses[0].text.strip(" ,;."))
                yield warning("value-not-said", "other_task", task, item.name, **words)


def _asked_in(clause: Clause, asks: Sequence[Ask]) -> bool:
    return any(ask.said.search(clause.text) for ask in asks)


def round_nothing(case: Case) -> Iterator[Warning]:
    """A round of a bare position of the command, where it names a thing elsewhere to which no task
    goes and which no limit is about: the round may be of that.
    """
    things = named_places(case.text, case.vocabulary)
    places = [place_of(task, case.vocabulary) for task in case.tasks]
    limited = [str(limit["values"].get("object", "")).casefold() for limit in case.limits]
    missed = [
        (words, at)
        for words, at in things
        if not any(place and same_place(at, place) for place in places)
        and not any(words.casefold() in one for one in limited)
    ]
    for task, place in zip(case.tasks, places, strict=True) if missed else ():
        if place is None or case.vocabulary.task[task["title"]].pattern not in ROUND:
            continue
        called = [*things, *named_places(task["task_prompt"], case.vocabulary)]
        said = any(same_place(at, place) for at in case.positions)
        if said and not any(same_place(at, place) for _words, at in called):
            words, at = missed[0]
            values = {"place": shown(place), "words": words, "other": shown((at.x, at.y))}
            yield warning("contradiction", "round", task, **values)


def corrected_still(case: Case) -> Iterator[Warning]:
    """A value of a task that the command corrects at once, and says nowhere else: "25 metres, no,
    20 metres".
    """
    for one, other in itertools.pairwise(case.numbers):
        between = case.text[one.end : other.start]
        said = case.words["correction"].search(between) or NO.fullmatch(between)
        if not said or len(between) > CORRECTED or one.unit is None or one.unit != other.unit:
            continue
        alike = (number for number in case.numbers if number.unit in (None, one.unit))
        again = sum(near(number.value, one.value) for number in alike) > 1
        if again or near(one.value, other.value):
            continue
        for task in case.tasks:
            values = [*_values(task, one.unit, case)]
            if any(near(one.value, at) for at in values) and not any(
                near(other.value, at) for at in values
            ):
                words = quoted(case.text[one.start : other.end])
                yield warning("contradiction", "ruled_out", task, about=words, words=words)


def _values(task: Entry, base: str, case: Case) -> Iterator[float]:
    """The values of a task in a base unit."""
    for item in case.vocabulary.task[task["title"]].parameters:
        unit, value = named(item.unit), task["parameters"].get(item.name)
        if unit and unit.base == base and is_number(value):
            yield unit.in_base(value)
