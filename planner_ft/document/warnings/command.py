"""What the command asks for and no task answers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.document.clauses import Clause, read_clauses
from planner_ft.document.language import language
from planner_ft.document.warnings.warning import Warning, warning
from planner_ft.vocabulary import Vocabulary

LONGEST = 60
"""Characters of the command that are quoted."""


def command_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """Instructions that nothing in the plan answers, and of which the plan does not say that it
    leaves them out.
    """
    planned = {task["title"] for task in document["tasks"]}
    texts = [*document.get("constraints", ()), *document.get("assumptions", ())]
    declined = " ".join(
        text for text in texts if language(vocabulary).words["declined"].search(text)
    ).casefold()
    for clause in read_clauses(document["command"], vocabulary):
        for words, start in (
            *_unanswered(clause, planned, vocabulary),
            *_impossible(clause, planned, vocabulary),
        ):
            if words.casefold() not in declined:
                yield warning(
                    "not-planned",
                    f'The command asks: "{_quoted(clause, start)}"; no task of the plan does that.',
                    about=words.casefold(),
                )


def unanswered(command: str, planned: set[str], vocabulary: Vocabulary) -> Iterator[str]:
    """The words that ask for a task of the vocabulary where none of those that answer them is among
    the titles that are planned.
    """
    for clause in read_clauses(command, vocabulary):
        yield from (words for words, _start in _unanswered(clause, planned, vocabulary))


def _unanswered(
    clause: Clause, planned: set[str], vocabulary: Vocabulary
) -> Iterator[tuple[str, int]]:
    """(words, where in the clause) of what is asked for and not planned."""
    spoken = language(vocabulary)
    sends = any(ask.sends and ask.said.search(clause.text) for ask in spoken.asks)
    for ask in spoken.asks:
        match = ask.said.search(clause.text)
        # What is sent is named by how it came about, which may be long ago: "send the panorama".
        if (
            match
            and not (ask.tasks & planned)
            and (ask.sends or not sends)
            and _counts(clause, match.start())
        ):
            yield match[0], match.start()


def _impossible(
    clause: Clause, planned: set[str], vocabulary: Vocabulary
) -> Iterator[tuple[str, int]]:
    """The words that begin with what no task can do."""
    impossible = language(vocabulary).words["impossible"].match(clause.text.lstrip())
    # A plan without tasks says itself why.
    if planned and impossible and _counts(clause, 0):
        yield impossible[0], 0


def _counts(clause: Clause, place: int) -> bool:
    return not clause.corrected and (
        clause.excluded is None or clause.start + place <= clause.excluded
    )


def _quoted(clause: Clause, start: int) -> str:
    text = " ".join(clause.text[start:].split())
    return text if len(text) <= LONGEST else f"{text[:LONGEST].rsplit(' ', 1)[0]} ..."
