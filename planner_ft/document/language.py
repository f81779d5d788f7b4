"""The words that commands are checked by: english.toml, and beside a vocabulary's definition
NAME.ontology.toml.
"""

from __future__ import annotations

import functools
import re
import tomllib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_text
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import ONTOLOGY

ENGLISH = Path(__file__).parent / "english.toml"
GAP = r"\W{1,3}(?:[\w'’-]{1,30}\W{1,3}){0,3}?"
"""What ... stands for: up to three words."""
CLAUSE_END = re.compile(
    r"(?<!\d)[.,](?=\s|$)|[.,](?=\s+[^\d\s−–-]|\s*$)|[;:!?\n]|\b(?:then|afterwards|after"
    r" that|and|but)\b",
    re.IGNORECASE,
)


@dataclass(frozen=True)
class Ask:
    """Words that ask for a task, which one of `tasks` answers. With `sends`, other words of the
    clause name what is sent.
    """

    said: re.Pattern[str]
    tasks: frozenset[str]
    sends: bool


@dataclass(frozen=True)
class Language:
    """Patterns by their name in english.toml, what the vehicle can be asked for, its sensors, and
    the questions per missing element.

    `hints` are words per task title of which a command that asks for the task holds one; titles
    without any are not told by words.
    """

    words: dict[str, re.Pattern[str]]
    asks: tuple[Ask, ...]
    hints: dict[str, re.Pattern[str]]
    sensors: re.Pattern[str]
    questions: dict[str, str]


@functools.lru_cache(maxsize=16)
def language(vocabulary: Vocabulary) -> Language:
    """The words for a vehicle. Raises PlannerError that lists what is wrong with its ontology
    file.
    """
    english = tomllib.loads(read_text(ENGLISH))
    own = vocabulary.beside(ONTOLOGY)
    problems = list(_problems(own, vocabulary))
    if problems:
        raise PlannerError(f"{vocabulary.name}{ONTOLOGY}: " + "; ".join(problems))
    words = {
        name: pattern(entry["words"]) for name, entry in english.items() if name != "questions"
    }
    asks = tuple(
        Ask(pattern(entry["words"]), frozenset(entry["tasks"]), entry.get("sends", False))
        for entry in own.get("ask", ())
    )
    hints = {title: pattern(phrases) for title, phrases in own.get("hint", {}).items()}
    return Language(
        words, asks, hints, pattern(own.get("sensor", {}).get("words", ())), english["questions"]
    )


def pattern(phrases: Sequence[str]) -> re.Pattern[str]:
    """The phrases as one pattern of whole words, the longest first; without phrases one that is
    never found.
    """
    written = "|".join(_phrase(phrase) for phrase in sorted(phrases, key=len, reverse=True))
    return re.compile(rf"(?<![\w-])(?:{written})(?![\w])" if written else r"(?!)", re.IGNORECASE)


def clauses(text: str) -> Iterator[tuple[int, int]]:
    """Where the clauses of a text begin and end: at commas, sentence ends, "and" and "then"."""
    start = 0
    for match in CLAUSE_END.finditer(text):
        if text[start : match.start()].strip():
            yield start, match.start()
        start = match.end()
    if text[start:].strip():
        yield start, len(text)


def _phrase(phrase: str) -> str:
    parts = [
        r"[\s-]+".join(
            re.escape(word).replace(r"\*", r"\w*").replace("'", "['’]") for word in part.split()
        )
        for part in phrase.split("...")
    ]
    return GAP.join(parts)


def _problems(own: dict[str, Any], vocabulary: Vocabulary) -> Iterator[str]:
    yield from (f"unknown key {key!r}" for key in own if key not in ("ask", "sensor", "hint"))
    asks = own.get("ask", [])
    if not isinstance(asks, list) or not all(
        isinstance(entry, dict)
        and _are_words(entry.get("words"))
        and _are_words(entry.get("tasks"))
        for entry in asks
    ):
        yield "every [[ask]] needs the lists words and tasks"
        return
    yield from (
        f"[[ask]] names {title!r}, which is no task"
        for entry in asks
        for title in entry["tasks"]
        if title not in vocabulary.task
    )
    if "sensor" in own and not (
        isinstance(own["sensor"], dict) and _are_words(own["sensor"].get("words"))
    ):
        yield "[sensor] needs the list words"
    hints = own.get("hint", {})
    if not isinstance(hints, dict) or not all(_are_words(words) for words in hints.values()):
        yield "[hint] needs a list of words per task title"
        return
    yield from (
        f"[hint] names {title!r}, which is no task"
        for title in hints
        if title not in vocabulary.task
    )


def _are_words(value: Any) -> bool:
    return (
        isinstance(value, list)
        and bool(value)
        and all(isinstance(word, str) and word.strip() for word in value)
    )
