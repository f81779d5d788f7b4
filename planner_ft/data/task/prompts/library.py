"""The template files of the package, bound to a vehicle and divided among the splits."""

from __future__ import annotations

import functools
import re
import weakref
from collections.abc import Iterator, Sequence
from pathlib import Path

from planner_ft.data.task.phrasebook import Phrasebook
from planner_ft.data.task.prompts.binding import Bound, bind
from planner_ft.data.task.prompts.language import LineText, TemplateError, parse_line
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_text
from planner_ft.vocabulary.definition import Task, Vocabulary

FOLDER = Path(__file__).parent

_BOUND: weakref.WeakKeyDictionary[Vocabulary, tuple[tuple[str, tuple[Bound, ...]], ...]] = (
    weakref.WeakKeyDictionary()
)


def numbered_lines(path: Path) -> Iterator[tuple[int, str]]:
    """The template lines of a file with their numbers; blank lines and those that begin with # are
    passed over.
    """
    for number, line in enumerate(read_text(path).splitlines(), 1):
        if line.strip() and not line.lstrip().startswith("#"):
            yield number, line.strip()


@functools.cache
def parsed() -> tuple[LineText, ...]:
    """All lines of the package's files. Raises PlannerError for one that does not parse."""
    lines = []
    for path in sorted(FOLDER.glob("*.txt")):
        for number, source in numbered_lines(path):
            try:
                lines.append(parse_line(source))
            except TemplateError as error:
                raise PlannerError(f"{path}:{number}: {error}") from None
    return tuple(lines)


def tasks_for(line: LineText, vocabulary: Vocabulary) -> list[Task]:
    """The tasks that the line names and the vehicle has."""
    return (
        list(vocabulary.tasks)
        if "*" in line.tasks
        else [vocabulary.task[title] for title in line.tasks if title in vocabulary.task]
    )


def bound_lines(book: Phrasebook) -> Sequence[tuple[str, tuple[Bound, ...]]]:
    """(text of the line, the line bound to each task that it suits); lines that need what the
    vehicle has not are left out.
    """
    vocabulary = book.vocabulary
    if vocabulary not in _BOUND:
        _BOUND[vocabulary] = tuple(
            (line.source, found) for line in parsed() if (found := tuple(_bindings(line, book)))
        )
    return _BOUND[vocabulary]


def _bindings(line: LineText, book: Phrasebook) -> Iterator[Bound]:
    for task in tasks_for(line, book.vocabulary):
        try:
            yield bind(line, task, book)
        except TemplateError:
            continue


def normal(source: str) -> str:
    """The line as its split is decided by: without blanks and case, so that tidying it up moves it
    nowhere.
    """
    return re.sub(r"\s+", "", source.lower())
