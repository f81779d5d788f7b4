"""Instructions of the command that no task answers, and commands in unknown words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.document.language import Clause, Language, language, read_clauses
from planner_ft.document.warnings.warning import Warning, quoted, warning
from planner_ft.facts import unknown_words
from planner_ft.vocabulary import Vocabulary

UNKNOWN = 0.6
"""The share of unknown words from which a command may be in another language: of 1,000 commands in
English, misspelt ones among them, three are above it.
"""


def command_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """Doubts about the language, and instructions that the plan neither answers nor declines."""
    yield from _language_warning(document["command"])
    planned, spoken = {task["title"] for task in document["tasks"]}, language(vocabulary)
    texts = [*document.get("constraints", ()), *document.get("assumptions", ())]
    declined = " ".join(text for text in texts if spoken.words["declined"].search(text)).casefold()
    for clause in read_clauses(document["command"], vocabulary):
        for words, start in _unanswered(clause, planned, spoken):
            if words.casefold() not in declined:
                asked = quoted(clause.text[start:])
                text = f'The command asks: "{asked}"; no task of the plan does that.'
                yield warning("not-planned", text, about=words.casefold())


def _language_warning(command: str) -> Iterator[Warning]:
    unknown, share = unknown_words(command)
    if share >= UNKNOWN:
        listed = ", ".join(f'"{word}"' for word in unknown[:3])
        text = f"Most words of the command are not known ({listed}): it is not English, or is"
        yield warning("unknown-language", f"{text} misspelt, and the plan is what could be read.")


def _unanswered(clause: Clause, planned: set[str], spoken: Language) -> Iterator[tuple[str, int]]:
    """(words, where in the clause) that ask for an unplanned task, or one that is impossible."""
    if clause.corrected:
        return
    sends = any(ask.sends and ask.said.search(clause.text) for ask in spoken.asks)
    for ask in spoken.asks:
        match = ask.said.search(clause.text)
        # Data to be sent is named by how it came about, which may be long ago: "send the panorama".
        missing = not ask.tasks & planned and (ask.sends or not sends)
        if match and missing and clause.wants(clause.start + match.start()):
            yield match[0], match.start()
    impossible = spoken.words["impossible"].match(clause.text.lstrip())
    # A plan without tasks says itself why.
    if planned and impossible and clause.wants(clause.start):
        yield impossible[0], 0
