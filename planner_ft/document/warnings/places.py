"""Places of the command that the plan has not, or has otherwise."""

import itertools
import re
from collections.abc import Iterator
from typing import Any

from planner_ft.document.language import Clause
from planner_ft.document.ontology import named_places
from planner_ft.document.structures import OVER, ROUND, bars, structures, way_off
from planner_ft.document.track import place_of, shown
from planner_ft.document.vehicle import STAND_OFF
from planner_ft.document.warnings import picked
from planner_ft.document.warnings.case import (
    Case,
    Warning,
    done_at,
    lost,
    quoted,
    same_place,
    spot,
    warning,
)
from planner_ft.document.warnings.said import CORRECTED, NO
from planner_ft.facts import Position, is_number, near
from planner_ft.facts.geographic import lone_coordinates, read_geographic
from planner_ft.facts.places import read_positions, rows_of
from planner_ft.planning.locations import ARTICLE
from planner_ft.planning.shapes import PASS, goal_of
from planner_ft.vocabulary import Entry, Vocabulary

IT = re.compile(r"\b(?:it|its|there|them|their|that|this|here)\b", re.IGNORECASE)
ALL = re.compile(r"\s+all (?:of )?(?:it|that|this)\b", re.IGNORECASE)
SENTENCES = re.compile(r"[^.!?]*(?:[.!?]+[^.!?]*)?")
"""The rest of a sentence, and the next."""


def positions(case: Case) -> Iterator[Warning]:
    """Single positions, and latitudes and longitudes alone, that the plan has nowhere."""
    passed = {place for row in case.rows for place in row}
    passed |= {*picked.left_out(case)}
    passed |= {place for _clause, _name, place in _left_out(case)}
    passed |= {place for behind, place in _ruled_out(case) if place.start < behind.start}
    wanted = (one for one in case.positions if case.wants(one.start) and one not in passed)
    missing = [place for place in wanted if not case.plan.has(place)]
    known = structures(case.document, case.vocabulary) if missing else ()
    for place in missing:
        kept_off = any(same_place(place, one.position) for one in known)
        told = (kept_off and _is_told_of(place, case)) or picked.is_listed(place, case)
        if not told and not _is_corrected(place, case):
            yield case.lost(place.start, place.end)
    for start, end in lone_coordinates(case.text):
        words = case.text[start:end].strip()
        if words.casefold() not in case.plan.texts:
            yield lost(words)


def _is_corrected(place: Position, case: Case) -> bool:
    """Whether the plan has the position that is said in the place of another one, in one breath:
    "forty fifty, no, forty ninety".
    """
    following = next((one for one in case.positions if one.start >= place.end), None)
    between = case.text[place.end : following.start] if following else ""
    corrected = NO.match(between) or case.words["correction"].search(between)
    close = len(between) <= CORRECTED and corrected is not None
    return close and following is not None and case.plan.has(following)


def taken_back(case: Case) -> Iterator[Warning]:
    """The first task that goes to a place of which "belay all that" takes back all mentions."""
    for clause in case.clauses:
        off = case.words["exclusion"].search(clause.text)
        if off and ALL.match(clause.text, off.end()):
            said = [one for one in case.positions if one.start < clause.start]
            again = [one for one in case.positions if one.start >= clause.start]
            ways = ((task, place_of(task, case.vocabulary)) for task in case.tasks)
            for task, at in ((task, at) for task, at in ways if at):
                kept = any(same_place(one, at) for one in again)
                if not kept and any(same_place(one, at) for one in said):
                    words = quoted(clause.text.strip(" ,;."))
                    yield warning(
                        "contradiction", "ruled_out", task, about=words.casefold(), words=words
                    )
                    break


def passed(case: Case) -> Iterator[Warning]:
    """Positions of the command that neither a task nor a limit has, where legs come as close as
    they may to no structure: what is there is not said.
    """
    nearest = case.vehicle.get("stand_off", STAND_OFF)
    for place in (one for one in case.positions if case.wants(one.start)):
        at = place.x, place.y
        if spot(at) in case.plan.meant or at == case.vocabulary.home or not case.plan.has(place):
            continue
        pairs = ((leg, pair) for leg in case.path.legs for pair in itertools.pairwise(leg.points))
        ways = ((way_off(at, *pair), leg.task) for leg, pair in pairs)
        metres, name = min(ways, default=(nearest, ""))
        if metres < nearest:
            where, task = shown(at), case.by_id[name]
            known: dict[str, Any] = {"about": where, "place": where, "metres": metres}
            yield warning("structure-close", "passed", task, **known)


def passed_elsewhere(case: Case) -> Iterator[Warning]:
    """Passes that lie elsewhere than the place that the plan has gone to before them, where their
    prompt says no place: nothing else told the Task Agent where it is.
    """
    last, off = case.vocabulary.home, case.vehicle.get("stand_off", STAND_OFF)
    for task in case.tasks:
        last = place_of(task, case.vocabulary) or last
        known, metres = case.vocabulary.task[task["title"]], task["parameters"].get(PASS[1])
        goals = [goal_of(step, case.vocabulary) for step in task.get("skill_sequence") or ()]
        points = [(goal[0], goal[1]) for goal in goals if goal]
        said = any(place.certain for place in read_positions(task["task_prompt"]))
        if known.pattern != "pass" or said or not is_number(metres) or len(points) < 2:
            continue
        away = min(way_off(last, *pair) for pair in itertools.pairwise(points))
        if last not in (case.vocabulary.home, case.vocabulary.unresolved) and away > metres + off:
            problem = f"its waypoints pass {away:.0f} m from {shown(last)}"
            yield warning("not-performed", "shape", task, problem=problem)


def _is_told_of(place: Position, case: Case) -> bool:
    """Whether words at a place tell what is there, before its row or behind it, and neither they
    nor the next sentence ask for anything there. A bar is only told of.
    """
    lines = bars(case.document, case.vocabulary)
    if any((place.x, place.y) in ends for ends in map(_ends, lines)):
        return True
    row = next(row for row in rows_of(case.text, case.positions) if place in row)
    inside = [one for one in case.clauses if one.end > row[0].start][:1]
    if not case.words["tells"].search(inside[0].text):
        inside += [one for one in case.clauses if one.start > row[-1].start][:1]
    told = " ".join(one.text for one in inside)
    behind = SENTENCES.match(case.text, row[-1].end)
    meant = IT.search(behind[0]) and not case.words["away"].search(behind[0]) if behind else None
    asking = [case.spoken.sensors, *(ask.said for ask in case.spoken.asks)]
    asked = any(words.search(told) for words in asking)
    asked = asked or case.words["verb"].match(told.strip()) is not None
    return case.words["tells"].search(told) is not None and not (asked or meant)


def _ends(line: tuple[str, Position, Position]) -> list[tuple[float, float]]:
    return [(end.x, end.y) for end in line[1:]]


def geographic(case: Case) -> Iterator[Warning]:
    """Geographic positions that are no metres yet and at which the plan has no open place."""
    names = [place["name"] for place in case.document.get("open_places", ())]
    text = case.source.facts.text
    for place in read_geographic(text):
        words = text[place.start : place.end]
        clause = case.clause_at(place.start)
        if clause is None or clause.corrected or any(words in name for name in names):
            continue
        if any(case.words[name].search(clause.text) for name in ("limit", "away")):
            yield warning("limit-lost", "geographic", about=words.casefold(), words=words)
        else:
            yield lost(words)


def rows(case: Case) -> Iterator[Warning]:
    """Rows of positions that are neither the corners of an area nor a route."""
    skipped = list(picked.left_out(case)) if case.rows else []
    for row in case.rows:
        clause = case.clause_at(row[0].start)
        limiting = clause is not None and case.words["limit"].search(clause.text)
        visited = all(case.plan.has(place) for place in row if place not in skipped)
        if not case.plan.encloses(row) and (limiting or not visited):
            words = case.text[row[0].start : row[-1].end]
            kind = ("limit-lost", "area") if limiting else ("value-lost", "row")
            yield warning(*kind, about=words.casefold(), words=quoted(words))


def uneven_rows(case: Case) -> Iterator[Warning]:
    """A position to which the plan only goes, where it does one thing at all others of its row."""
    done = done_at(case) if case.rows else {}
    for row in case.rows:
        points = [(place.x, place.y) for place in row]
        titles = [
            next((done[at] for at in done if all(map(near, at, one))), None) for one in points
        ]
        known = [own for own in titles if own is not None]
        bare = [place for place, own in zip(row, titles, strict=True) if not own]
        common = set.intersection(*filter(None, known)) if any(known) else set()
        if len(known) == len(row) and len(bare) == 1 and common:
            where, what = shown((bare[0].x, bare[0].y)), ", ".join(sorted(common))
            yield warning("value-lost", "uneven", about=where, titles=what, place=where)


def unvisited(case: Case) -> Iterator[Warning]:
    """A known place that the command names, and to which neither a task nor a limit leads."""
    places = [place_of(task, case.vocabulary) for task in case.tasks]
    places += [limit["values"].get("position") for limit in case.limits]
    known = [place for place in places if place]
    for name, at in case.document.get("structures", {}).items():
        said = re.compile(rf"(?<!\w){re.escape(ARTICLE.sub('', name))}(?!\w)", re.IGNORECASE)
        wanted = any(any(clause.spans(said)) and not clause.corrected for clause in case.clauses)
        if wanted and not any(all(map(near, at, place)) for place in known):
            yield warning("value-lost", "place", about=name.casefold(), name=name, place=shown(at))


def there_and_not(case: Case) -> Iterator[Warning]:
    """A position that one clause asks for and another rules out; where that is said last, one that
    the plan has.
    """
    for place, other in _ruled_out(case):
        clause = case.clause_at(place.start)
        if clause and (other.start > place.start or case.plan.has(place)):
            words, about = quoted(clause.text.strip(" ,;")), f"{place.x:g},{place.y:g}"
            where = shown((place.x, place.y))
            yield warning("contradiction", "place", about=about, place=where, words=words)


def _ruled_out(case: Case) -> Iterator[tuple[Position, Position]]:
    """(place, same place) of which a clause rules the first out and another asks for the second."""
    for place in case.positions:
        clause = case.clause_at(place.start)
        if clause is None or clause.corrected or clause.wants(place.start):
            continue
        for one in case.positions:
            other = case.clause_at(one.start)
            same = one is not place and same_place(place, (one.x, one.y))
            if same and other and other.wants(one.start):
                yield place, one


def turned_round(case: Case) -> Iterator[Warning]:
    """An order that a clause turns round, and places that the plan takes as they were said."""
    said = list(dict.fromkeys((place.x, place.y) for place in case.positions))
    gone = list(dict.fromkeys(filter(None, (place_of(one, case.vocabulary) for one in case.tasks))))
    planned = [place for place in gone if place in said]
    for clause in case.clauses if len(planned) > 1 else ():
        turned = case.words["turned"].search(clause.text)
        before = [place for place in case.positions if place.start < clause.start]
        inside = any(clause.start <= place.start < clause.end for place in case.positions)
        if turned and len(before) > 1 and not inside and planned == sorted(planned, key=said.index):
            words = quoted(clause.text.strip(" ,;."))
            yield warning("contradiction", "order", about=words.casefold(), words=words)


def left_out(case: Case) -> Iterator[Warning]:
    """A task at a thing, or on one, that the command leaves out again: "on second thoughts skip the
    ramp".
    """
    found: list[tuple[Clause, str, list[Any]]] = [
        (clause, name, [one for one in case.tasks if _is_at(one, place, case.vocabulary)])
        for clause, name, place in _left_out(case)
    ]
    found += [(clause, name, _on(name, clause, case)) for clause, name in _names_out(case)]
    for clause, name, tasks in found:
        for task in tasks[:1]:
            words = quoted(clause.text.strip(" ,;."))
            yield warning("contradiction", "ruled_out", task, about=name, words=words)


def _left_out(case: Case) -> Iterator[tuple[Clause, str, Position]]:
    labels = ((picked.LABEL.search(case.text[: place.start]), place) for place in case.positions)
    things = [(match[1], place) for match, place in labels if match]
    things += named_places(case.text, case.vocabulary)
    for clause, name in _names_out(case):
        for words, place in things:
            if name == ARTICLE.sub("", words).casefold() and place.start < clause.start:
                yield clause, name, place


def _names_out(case: Case) -> Iterator[tuple[Clause, str]]:
    """What clauses rule out: "skip the ramp", "leave the ramp out"."""
    for clause in (one for one in case.clauses if one.excluded is not None):
        match = case.words["exclusion"].search(clause.text)
        name = ARTICLE.sub("", clause.text[match.end() :].strip(" ,;.")) if match else ""
        if name:
            yield clause, name.casefold().removesuffix(" out")


def _on(name: str, clause: Clause, case: Case) -> list[Entry]:
    """The tasks that have what was named before a clause as a text: the feature to be filmed."""
    said = case.text[: clause.start].casefold()
    texts = (
        (task, value.casefold())
        for task in case.tasks
        for value in task["parameters"].values()
        if isinstance(value, str)
    )
    return [task for task, text in texts if f"{text} ".startswith(f"{name} ") and name in said]


def _is_at(task: Entry, place: Position, vocabulary: Vocabulary) -> bool:
    at = place_of(task, vocabulary)
    return at is not None and same_place(place, at)


def misnamed(case: Case) -> Iterator[Warning]:
    """A task prompt that puts one thing of the command where the command has another, and a limit
    with its thing at another place than the command has it.
    """
    said = [(words.casefold(), at) for words, at in named_places(case.text, case.vocabulary)]
    names = {words for words, _place in said}
    for task in case.tasks:
        for words, place in named_places(task["task_prompt"], case.vocabulary):
            at = place.x, place.y
            there = {name for name, other in said if same_place(other, at)}
            same = any(_is_named(words, name) for name in there)
            if there and words.casefold() in names - there and not same:
                values = {"words": words, "place": shown(at), "other": min(there)}
                yield warning("contradiction", "misnamed", task, **values)
    for limit in case.limits:
        thing, at = limit["values"].get("object"), limit["values"].get("position")
        known = [place for words, place in said if thing and _is_named(words, thing)]
        if at and known and not any(same_place(place, at) for place in known):
            text, where = limit["text"].rstrip("."), shown((known[0].x, known[0].y))
            told = {"limit": text, "words": thing, "place": where}
            yield warning("contradiction", "limit_misplaced", None, about=text, **told)


def _is_named(words: str, thing: str) -> bool:
    """Whether two names end with one word, in the singular or in the plural."""
    one, other = (name.casefold().split()[-1].removesuffix("s") for name in (words, thing))
    return one == other


def round_home(case: Case) -> Iterator[Warning]:
    """A task that goes round home, or over it, where the command has no numbers for home."""
    home = case.vocabulary.home
    if not any(same_place(place, home) for place in case.positions):
        for task in case.tasks:
            pattern = case.vocabulary.task[task["title"]].pattern
            if pattern in (*ROUND, *OVER) and place_of(task, case.vocabulary) == home:
                yield warning("value-not-said", "asked", task, about="asked")


def unmoved(case: Case) -> Iterator[Warning]:
    """A place that is gone to, and words that have the vehicle stay where it is."""
    home = case.vocabulary.home
    away = [one for one in case.tasks if place_of(one, case.vocabulary) not in (None, home)]
    for clause in case.clauses if away else ():
        if case.words["unmoved"].search(clause.text) and not clause.corrected:
            words = quoted(clause.text.strip(" ,;."))
            yield warning("contradiction", "unmoved", away[0], about="unmoved", words=words)
