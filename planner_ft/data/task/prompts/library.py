"""The prompt templates of a vehicle, bound to the tasks that they suit when they are drawn."""

from __future__ import annotations

from collections.abc import Iterator

from planner_ft.data.task.phrasebook import Phrasebook
from planner_ft.data.task.prompts.binding import Bound, bind
from planner_ft.data.templates.grammar import TemplateError
from planner_ft.data.templates.records import Template


def bindings(template: Template, book: Phrasebook) -> tuple[Bound, ...]:
    """The template for each task that it suits. Raises PlannerError where a task that it names does
    not fit; of "*" the tasks are left that have what it needs.
    """
    key = book.vocabulary
    if key not in template.bound:
        template.bound[key] = tuple(_bindings(template, book))
    found: tuple[Bound, ...] = template.bound[key]
    return found


def _bindings(template: Template, book: Phrasebook) -> Iterator[Bound]:
    vocabulary = book.vocabulary
    every = "*" in template.tasks
    for title in vocabulary.task if every else template.tasks:
        if title not in vocabulary.task:
            raise template.error(f"there is no task {title}")
        try:
            yield bind(template, vocabulary.task[title], book)
        except TemplateError as error:
            if not every:
                raise template.error(error) from None
