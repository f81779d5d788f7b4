"""What a command really asks for: words outside of what it rules out or takes back."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator
from dataclasses import dataclass

from planner_ft.document.language import clauses, language
from planner_ft.vocabulary import Vocabulary

NO = re.compile(r"^no\W+", re.IGNORECASE)


@dataclass(frozen=True)
class Clause:
    """A clause of a command from `start` to `end`.

    `excluded`: where what it rules out begins, before `start` where it only tells of something;
    `corrected`: the next words take it back.
    """

    start: int
    end: int
    text: str
    excluded: int | None
    corrected: bool


@functools.lru_cache(maxsize=64)
def read_clauses(command: str, vocabulary: Vocabulary) -> tuple[Clause, ...]:
    """The clauses of a command in order."""
    words = language(vocabulary).words
    found = []
    for start, end in clauses(command):
        text = command[start:end]
        told = words["told"].search(text)
        excluded = words["exclusion"].search(text)
        behind = command[end : end + 24].lstrip(" ,.;:!?-")
        corrected = any(words["correction"].match(said) for said in (behind, NO.sub("", behind)))
        found.append(
            Clause(
                start,
                end,
                text,
                start - 1 if told else start + excluded.start() if excluded else None,
                corrected,
            )
        )
    return tuple(found)


def said_apart(
    command: str, wanted: re.Pattern[str], vocabulary: Vocabulary
) -> list[tuple[int, int]]:
    """Where a command says words that nothing rules out."""
    return [span for clause in read_clauses(command, vocabulary) for span in _said(clause, wanted)]


def _said(clause: Clause, wanted: re.Pattern[str]) -> Iterator[tuple[int, int]]:
    for match in wanted.finditer(clause.text):
        start = clause.start + match.start()
        if clause.excluded is None or start <= clause.excluded:
            yield start, clause.start + match.end()
