"""The elements of a command and those that it lacks: objective, target, sensors, constraints.

A missing element becomes a question to the operator and blocks nothing: most commands lack some.
"""

import functools
import itertools
import re
from collections.abc import Container, Iterable, Iterator
from typing import Any

from planner_ft.document.language import Language, language, pattern, read_clauses
from planner_ft.facts import Position, Span
from planner_ft.facts.geometry import rectangle
from planner_ft.facts.places import read_positions, rows_of, written_positions
from planner_ft.facts.words import SMALL
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.schema import ELEMENTS

Way = tuple[tuple[float, float], tuple[float, float]]  # from one position to another
LONGEST_NAME = 7  # words of a noun phrase that are looked at
LONGEST_PIECE = 1500  # characters that are read at once
CLOSED = ("]", ")")
FARTHEST = 40  # characters between a name and its coordinates
_END = re.compile(r"[.!?;]\s+|\n+")
_WORD = re.compile(r"\s+([^\W_][\w'’-]*)")
_LINK = re.compile(r"\s+(?:of|with)\s+(?=\w)", re.IGNORECASE)
_PLACED = re.compile(
    r"\s*,?\s*(?:(?:is|lying|located|somewhere|right|last seen|centred|centered)\s+)?"
    r"(?:at|near|around|on|in|@)?\s*[\[(]?\s*",
    re.IGNORECASE,
)
_BESIDE = re.compile(
    r"\s*(?:,?\s*(?:(?:(?:which|that|she|he|it) )?(?:is|are|was|stands?|standing|lies?|lying|sits?"
    r"|floats?|hangs?|rests?|right|last seen|located|anchored|moored|at anchor|aground|adrift"
    r"|awash|(?:she|he|it)['’]s)\s+"
    r"(?:\w+\s+){0,2}?)?(?:in the \w+\s+|in between\s+)?(?:,?\s*namely\s+)?"
    r"(?:(?:at|near|around|in|on|by|@)\s*|in the \w+,\s+)"
    r"|(?=[\[(\d−–-]))[\[(]?\s*",
    re.IGNORECASE,
)
"""What stands between a thing and its coordinates: "the other way, [0, 35]" names no thing."""
_BEHIND = re.compile(
    r"[\])]?\s*,?\s*(?:there\s+)?(?:is|are|lies?|stands?|sits?|floats?|hangs?|rests?)\s+",
    re.IGNORECASE,
)
"""What stands between coordinates and their thing: "at [0, 35] there is a rock"."""
_STRETCHES = re.compile(
    r",?\s*(?:(?:it|they|which|that)\s+)?(?:(?!(?:and|then|but|or|to)\b)[\w-]+\s+){0,4}?"
    r"(?:from|between)\b\s*(?:(?:the|two|three|[a-z]+s|at)\s+){0,4}?[\[(]?\s*",
    re.IGNORECASE,
)
_DIRECT = re.compile(r"\s*(?:from|between)\b", re.IGNORECASE)
_THERE = re.compile(r"\bthere(?:['’]s|\s+(?:is|are|was|were))\s+", re.IGNORECASE)
_ALONG = re.compile(r"\balong\s(?:[\w-]+\s){0,3}$", re.IGNORECASE)
_ENDS = re.compile(r"[\])]?\s*(?:and|to|until|through to)\s*[\[(]?\s*", re.IGNORECASE)
"""What stands before the ends of a thing, and between them: "a net from [0, 35] to [9, 35]"."""
# A size behind a noun phrase ("of 12 m"), and a code behind a noun ("pile A", "pile c seven").
_SIZE = re.compile(r"\s+of\s+\d[\d.,]*\s?[a-z]+\b")
_CODE = r"[A-Za-z]|[A-Z]{2,3}|[A-Za-z]{0,3}-?\d{1,3}[A-Za-z]?"
_MARK = re.compile(
    rf"(?:\s+(?i:number|no\.?))?(?:\s+(?:{_CODE}|(?i:{'|'.join(SMALL)}))){{1,2}}"
    r"(?=\s+at\b|\s*[\[(])"
)
_NAME = re.compile(r"\s+((?:[A-Z][\w-]*|\d+)(?:\s+(?:[A-Z][\w-]*|\d+))?)(?!\w)")


def check(command: str, vocabulary: Vocabulary) -> dict[str, Any]:
    """{"elements": [{"element", "start", "end", "text"}], "missing", "questions"} of a command."""
    spoken = language(vocabulary)
    found: dict[str, list[Span]] = {element: [] for element in ELEMENTS}
    found["target"] += _targets(command, spoken)
    instructions = [ask.said for ask in spoken.asks]
    instructions += [spoken.words["verb"], spoken.words["impossible"]]
    for clause in read_clauses(command, vocabulary):
        for words in instructions:
            found["objective"] += clause.spans(words)
        # Words for sensors and data count also where they themselves rule something out.
        for match in spoken.sensors.finditer(clause.text):
            start, end = clause.start + match.start(), clause.start + match.end()
            if clause.wants(start) or spoken.words["exclusion"].match(match[0]):
                found["sensor"].append((start, end))
        if limit := spoken.words["constraint"].search(clause.text):
            end = clause.start + len(clause.text.rstrip())
            found["constraint"].append((clause.start + limit.start(), end))
    elements = [
        {"element": element, "start": start, "end": end, "text": command[start:end]}
        for start, end, element in sorted(
            (*span, name) for name in ELEMENTS for span in _merged(found[name])
        )
    ]
    missing = [element for element in ELEMENTS if not found[element]]
    questions = [spoken.questions[element] for element in missing]
    return {"elements": elements, "missing": missing, "questions": questions}


def _targets(command: str, spoken: Language) -> Iterator[Span]:
    """Named coordinates, noun phrases, numbered and named things, the vehicle's whereabouts."""
    for offset, text in pieces(command):
        named = [*_noun_phrases(text, spoken), *_names(text, spoken)]
        certain = [(place.start, place.end) for place in read_positions(text) if place.certain]
        places = [
            (_before(text, start, named), end + (text[end : end + 1] in CLOSED))
            for start, end in certain
        ]
        here = [match.span() for match in spoken.words["here"].finditer(text)]
        yield from ((start + offset, end + offset) for start, end in (*named, *places, *here))


def pieces(text: str, longest: int = LONGEST_PIECE) -> Iterator[tuple[int, str]]:
    """(start, piece) of the text cut behind sentences, or words where a sentence is too long."""
    start = 0
    while len(text) - start > longest:
        window = text[start : start + longest]
        ends = [match.end() for match in _END.finditer(window)]
        cut = ends[-1] if ends else window.rfind(" ") + 1 or longest
        yield start, window[:cut]
        start += cut
    yield start, text[start:]


@functools.lru_cache(maxsize=1024)
def named_places(
    text: str, vocabulary: Vocabulary, thing: str = ""
) -> tuple[tuple[str, Position], ...]:
    """(words, position) of things beside certain positions: no waypoints and other places. "The
    cages at" names all positions of the row behind it. What stands in the water needs no article,
    nor does the `thing` that is looked for.
    """
    return tuple(_named_places(text, vocabulary, thing))


def _named_places(text: str, vocabulary: Vocabulary, thing: str) -> Iterator[tuple[str, Position]]:
    spoken = language(vocabulary)
    bare = [(at, _numbered(text, end)) for at, end in _spans(spoken.words["standing"], text)]
    bare += _spans(pattern([thing] if thing else []), text)
    named = [*sorted(bare), *sorted([*_noun_phrases(text, spoken), *_names(text, spoken)])]
    own = {match.end() for match in spoken.words["own"].finditer(text)}
    things = [
        (start, end)
        for start, end in named
        if end not in own and is_thing(text[start:end], vocabulary)
    ]
    written = written_positions(text)
    told, several = dict(_told_things(text, written, vocabulary)), dict[int, str]()
    areas = set[int]()  # where the corners of areas begin: "the box (0, 0), (40, 0), ..."
    for row in rows_of(text, written):
        words = _words_before(text, row[0].start, things)
        several |= {place.start: words for place in row[1:] if words.casefold().endswith("s")}
        areas |= {row[0].start} if _is_area(row) and not words.casefold().endswith("s") else set()
    for match in spoken.words["one_of_them"].finditer(text):
        sentence = text.rfind(". ", 0, match.start()) + 1
        before = [one for one in bare if sentence <= one[0] and one[1] <= match.start()]
        words = text[slice(*before[-1])] if before else ""
        several |= {match.end() + 1: words} if words.casefold().endswith("s") else {}
    for place in read_positions(text):
        words = _words_beside(text, place, things) if place.certain else ""
        if not place.certain and place in written:
            beside = (at for at in bare if text[at[1] : place.start].isspace())
            words = next((text[start:end] for start, end in beside), "")
            words = words or _words_before(text, place.start, bare)
        if not stands(words, vocabulary):
            words = told.pop(place.start, "") or words or several.pop(place.start, "")
        if words and place.start not in areas:
            yield words, place


def _is_area(row: list[Position]) -> bool:
    """Whether a row of positions is an area by its four corners, and no row of things."""
    return rectangle([(at.x, at.y) for at in row]) is not None


def _told_things(
    text: str, written: list[Position], vocabulary: Vocabulary
) -> Iterator[tuple[int, str]]:
    """(start of a position, words) where a clause tells that one thing stands at one position:
    "the wreck's mast is sticking out of the water at".
    """
    spoken = language(vocabulary)
    asking = [spoken.words["verb"], spoken.sensors, *(ask.said for ask in spoken.asks)]
    for clause in read_clauses(text, vocabulary):
        inside = [one for one in written if clause.start <= one.start < clause.end]
        things = _spans(spoken.words["standing"], clause.text)
        if len(inside) == len(things) == 1 and spoken.words["tells"].search(clause.text):
            start, end = things[0]
            before = spoken.words["determiner"].search(clause.text[:start].rstrip() + " ")
            itself = spoken.words["itself"].fullmatch(clause.text, start, end) and before
            if not itself and not any(words.search(clause.text) for words in asking):
                yield inside[0].start, clause.text[start:end]


def _numbered(text: str, end: int) -> int:
    """The end of a noun with the letter or number behind it: "pile A at"."""
    mark = _MARK.match(text, end)
    return mark.end() if mark else end


def _spans(words: re.Pattern[str], text: str) -> list[Span]:
    return [match.span() for match in words.finditer(text)]


def named_lines(
    text: str, vocabulary: Vocabulary, ways: Container[Way] = ()
) -> Iterator[tuple[str, Position, Position]]:
    """(words, one end, other end) of things that bar the way from one position to another: those
    of a kind that does, and others of which the command says that they are there. "Past the pier
    from A to B" names none where the plan goes that way (`ways`).
    """
    spoken = language(vocabulary)
    bars = [(match.start(), match.end()) for match in spoken.words["bars"].finditer(text)]
    there = {match.end() for match in _THERE.finditer(text)}
    others = [
        (start, end)
        for start, end in _noun_phrases(text, spoken)
        if start in there
        and not spoken.words["passable"].search(text, start, end)
        and is_thing(text[start:end], vocabulary)
    ]
    for one, other in itertools.pairwise(written_positions(text)):
        if not _ENDS.fullmatch(text, one.end, other.start):
            continue
        route = ((one.x, one.y), (other.x, other.y)) in ways
        for start, end in sorted((*bars, *others), reverse=True):
            if between := _STRETCHES.fullmatch(text, end, one.start):
                gone = route and start not in there and _DIRECT.match(between[0])
                if not (gone or _ALONG.search(text, 0, start)):
                    yield text[start:end], one, other
                break


def _words_beside(text: str, place: Position, named: list[Span]) -> str:
    """The name that stands before coordinates, or behind them; empty without one."""
    behind = _BEHIND.match(text, place.end)
    ends = [end for start, end in named if behind and start == behind.end()]
    # "To [150, 50] there is a buoy at [100, 50]": what has a place of its own is not there.
    own = _BESIDE.match(text, ends[0]) if ends else None
    placed = own and any(one.start == own.end() for one in written_positions(text))
    ends = [] if placed else ends
    before = _words_before(text, place.start, named)
    return before or (text[behind.end() : ends[0]] if behind and ends else "")


def _words_before(text: str, place: int, named: list[Span]) -> str:
    """The name that stands before coordinates; empty without one."""
    for start, end in reversed(named):
        if end <= place <= end + FARTHEST and _BESIDE.fullmatch(text, end, place):
            return text[start:end]
    return ""


def is_thing(words: str, vocabulary: Vocabulary) -> bool:
    """Whether a noun phrase names a thing in the water, and not a place of it: its last word, or
    the one before "of", tells. A mooring buoy and a lock gate are things, the middle of the channel
    is a place.
    """
    return stands(words, vocabulary) or not _ends_with("water", words, vocabulary)


def stands(words: str, vocabulary: Vocabulary) -> bool:
    """Whether a noun phrase names what stands in the water or floats on it."""
    return _ends_with("standing", words, vocabulary)


def _ends_with(kind: str, words: str, vocabulary: Vocabulary) -> bool:
    # "Buoy 7" is a buoy.
    head = re.split(r"\s+(?:of\b|with\b|\d+$)", words.strip(), maxsplit=1)[0]
    found = language(vocabulary).words[kind].finditer(head)
    return any(match.end() == len(head) for match in found)


def _noun_phrases(text: str, spoken: Language) -> Iterator[Span]:
    """Phrases from "the" or "a" to a word that ends them, but no times, sensors or tasks."""
    behind = 0
    for match in spoken.words["determiner"].finditer(text):
        end = _phrase_end(text, match.end(), spoken)
        if match.start() < behind or end is None:
            continue
        noun = text[match.end() : end].split()[-1]
        others = (spoken.words["nothing"], spoken.sensors, *(ask.said for ask in spoken.asks))
        if not any(words.fullmatch(noun) for words in others):
            behind = _linked_end(text, end, spoken)
            yield match.start(), behind


def _phrase_end(text: str, start: int, spoken: Language) -> int | None:
    """Where the words that belong together end; None where there are none."""
    end = None
    for _number in range(LONGEST_NAME):
        word = _WORD.match(text, start)
        ends = [spoken.words["determiner"]]
        # "The moored workboat": what ends a phrase elsewhere can begin one.
        if not (word and end is None and word[1].lower().endswith("ed")):
            ends.append(spoken.words["boundary"])
        if (
            not word
            or word[1].lower() in ("of", "with")
            or any(one.fullmatch(word[1]) for one in ends)
        ):
            break
        end = start = word.end()
    return end


def _linked_end(text: str, end: int, spoken: Language) -> int:
    """The end of a phrase with the words that "of" or "with" adds to it: "with a hull of 9 m"."""
    link = _LINK.match(text, end)
    if link is None:
        return end
    determiner = spoken.words["determiner"].match(text, link.end())
    end = _phrase_end(text, determiner.end() if determiner else link.end() - 1, spoken) or end
    size = _SIZE.match(text, end)
    return size.end() if size else end


def _names(text: str, spoken: Language) -> Iterator[Span]:
    for match in spoken.words["named"].finditer(text):
        name = _NAME.match(text, match.end())
        if name:
            yield match.start(), name.end()


def _before(text: str, start: int, named: list[Span]) -> int:
    """Where the words for a place begin: with the name that stands before its coordinates."""
    for begin, end in reversed(named):
        if end <= start <= end + FARTHEST and _PLACED.fullmatch(text, end, start):
            return begin
    return start - 1 if text[start - 1 : start] in ("[", "(") else start


def _merged(spans: Iterable[Span]) -> list[Span]:
    """Spans in order; those that overlap as one."""
    merged: list[Span] = []
    for start, end in sorted(spans):
        if merged and start <= merged[-1][1]:
            merged[-1] = (merged[-1][0], max(end, merged[-1][1]))
        else:
            merged.append((start, end))
    return merged
