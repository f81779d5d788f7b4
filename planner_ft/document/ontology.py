"""What a command says and what it lacks: objective, target or place, sensors and data, operational
constraints.

The words stand in english.toml and in NAME.ontology.toml beside the vocabulary's definition. What
is missing becomes a question to the operator and blocks nothing: most real commands lack one or two
of the four. A command in another language mostly shows its numbers alone.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Any

from planner_ft.document.clauses import Clause, read_clauses
from planner_ft.document.language import Language, language
from planner_ft.facts import Span, pieces
from planner_ft.facts.places import read_positions
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.schema import ELEMENTS

LONGEST_NAME = 7
"""Words of a noun phrase that are looked at."""
_WORD = re.compile(r"[^\W_][\w'’-]*")
_LINK = re.compile(r"\s+(?:of|with)\s+(?=\w)")
_PLACED = re.compile(
    r"\s*,?\s*(?:(?:is|lying|located|somewhere|right|last"
    r" seen|centred|centered)\s+)?(?:at|near|around|on|in)?\s*[\[(]?\s*$"
)
_NAME = re.compile(r"\s+((?:[A-Z][\w-]*|\d+)(?:\s+(?:[A-Z][\w-]*|\d+))?)(?!\w)")


def check(command: str, vocabulary: Vocabulary) -> dict[str, Any]:
    """{"elements": [{"element", "start", "end", "text"}], "missing": [element], "questions":
    [text]} of a command, elements in its order.
    """
    spoken = language(vocabulary)
    read = read_clauses(command, vocabulary)
    found: dict[str, list[Span]] = {
        "objective": _merged(_objectives(read, spoken)),
        "target": _merged(_targets(command, spoken)),
        "sensor": _merged(_sensors(read, spoken)),
        "constraint": _merged(_constraints(read, spoken)),
    }
    elements = sorted(
        (start, end, element) for element in ELEMENTS for start, end in found[element]
    )
    missing = [element for element in ELEMENTS if not found[element]]
    return {
        "elements": [
            {"element": element, "start": start, "end": end, "text": command[start:end]}
            for start, end, element in elements
        ],
        "missing": missing,
        "questions": [spoken.questions[element] for element in missing],
    }


def _objectives(read: Iterable[Clause], spoken: Language) -> Iterator[Span]:
    """The words that ask for a task, and verbs that an instruction begins with."""
    for clause in read:
        for words in (
            *(ask.said for ask in spoken.asks),
            spoken.words["verb"],
            spoken.words["impossible"],
        ):
            for match in words.finditer(clause.text):
                if clause.excluded is None or clause.start + match.start() <= clause.excluded:
                    yield clause.start + match.start(), clause.start + match.end()


def _sensors(read: Iterable[Clause], spoken: Language) -> Iterator[Span]:
    for clause in read:
        for match in spoken.sensors.finditer(clause.text):
            if (
                clause.excluded is None
                or clause.start + match.start() <= clause.excluded
                or spoken.words["exclusion"].match(match[0])
            ):
                yield clause.start + match.start(), clause.start + match.end()


def _constraints(read: Iterable[Clause], spoken: Language) -> Iterator[Span]:
    """From the words that set a limit to the end of their clause."""
    for clause in read:
        match = spoken.words["constraint"].search(clause.text)
        if match:
            yield clause.start + match.start(), clause.start + len(clause.text.rstrip())


def _targets(command: str, spoken: Language) -> Iterator[Span]:
    """Coordinates with the name before them, noun phrases, numbered and named things, and words for
    where the vehicle is.
    """
    for offset, text in pieces(command):
        named = [*_noun_phrases(text, spoken), *_names(text, spoken)]
        places = [(place.start, place.end) for place in read_positions(text) if place.certain]
        here = [match.span() for match in spoken.words["here"].finditer(text)]
        before = {start: _before(text, start, named) for start, _end in places}
        for start, end in (
            *named,
            *((before[start], _closed(text, end)) for start, end in places),
            *here,
        ):
            yield start + offset, end + offset


def _noun_phrases(text: str, spoken: Language) -> list[Span]:
    """Phrases from "the" or "a" to a word that ends them, unless their noun is a time, a sensor or
    a task.
    """
    found: list[Span] = []
    for match in spoken.words["determiner"].finditer(text):
        if found and match.start() < found[-1][1]:
            continue
        head = _phrase_end(text, match.end(), spoken)
        if head is None or _is_nothing(text[match.end() : head], spoken):
            continue
        found.append((match.start(), _linked(text, head, spoken)))
    return found


def _phrase_end(text: str, start: int, spoken: Language) -> int | None:
    """Where the words that belong together end; None where there are none."""
    end = None
    for _number in range(LONGEST_NAME):
        match = re.compile(r"\s+").match(text, start)
        word = _WORD.match(text, match.end()) if match else None
        if (
            word is None
            or spoken.words["boundary"].fullmatch(word[0])
            or word[0] in ("of", "with")
            or spoken.words["determiner"].fullmatch(word[0])
        ):
            break
        end = start = word.end()
    return end


def _linked(text: str, end: int, spoken: Language) -> int:
    """The end of a phrase with what "of" or "with" adds to it."""
    link = _LINK.match(text, end)
    if link is None:
        return end
    determiner = spoken.words["determiner"].match(text, link.end())
    more = _phrase_end(text, determiner.end() if determiner else link.end() - 1, spoken)
    return more or end


def _is_nothing(phrase: str, spoken: Language) -> bool:
    words = phrase.split()
    last = words[-1]
    return any(
        pattern.fullmatch(last) for pattern in (spoken.words["nothing"], spoken.sensors)
    ) or any(ask.said.fullmatch(last) for ask in spoken.asks)


def _names(text: str, spoken: Language) -> list[Span]:
    found = []
    for match in spoken.words["named"].finditer(text):
        name = _NAME.match(text, match.end())
        if name:
            found.append((match.start(), name.end()))
    return found


def _before(text: str, start: int, named: list[Span]) -> int:
    """Where the words for a place begin: with the name that stands before its coordinates."""
    for begin, end in reversed(named):
        if end <= start and start - end <= 40 and _PLACED.fullmatch(text, end, start):
            return begin
    return start - 1 if text[start - 1 : start] in ("[", "(") else start


def _closed(text: str, end: int) -> int:
    return end + 1 if text[end : end + 1] in ("]", ")") else end


def _merged(spans: Iterable[Span]) -> list[Span]:
    """Spans in order; those that overlap as one."""
    merged: list[Span] = []
    for start, end in sorted(spans):
        if merged and start <= merged[-1][1]:
            merged[-1] = (merged[-1][0], max(end, merged[-1][1]))
        else:
            merged.append((start, end))
    return merged
