"""Values and texts that an operator enters. All raise PlannerError for what a plan cannot have."""

import functools
import json
import re
from collections.abc import Iterator
from typing import Any
from unicodedata import category

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Parameter, Skill, Task, Vocabulary
from planner_ft.vocabulary.plans import canonical_value, is_number, value_problem
from planner_ft.vocabulary.schema import task_schema

POSITION = Parameter("position", "position", "m")
LARGEST = 1e6  # of a value that is entered: a place within 1000 km, eleven days
LONGEST_PROMPT, LONGEST_SHOWN = 4000, 120
"""Characters of a task prompt, and of a value that a sentence repeats."""


def known(owner: Task | Skill, called: str, name: str) -> Parameter:
    """The parameter of a task or skill that is `called` so."""
    if name not in owner.by_name:
        there = ", ".join(owner.by_name) or "none"
        raise PlannerError(f"{short(name)}: is no parameter of {called}; there is {there}")
    return owner.by_name[name]


def titled(title: str, vocabulary: Vocabulary) -> Task:
    """The definition of a task."""
    if title not in vocabulary.task:
        there = ", ".join(vocabulary.task)
        raise PlannerError(f"{short(title)}: is no task of this vehicle; there is {there}")
    return vocabulary.task[title]


def put(given: dict[str, Any], parameter: Parameter, value: Any) -> None:
    """Set a parameter of a task or skill; None removes it."""
    if value is None:
        given.pop(parameter.name, None)
    else:
        given[parameter.name] = checked(value, parameter)


def checked(value: Any, known: Parameter) -> Any:
    """A value in the form that plans have, where a parameter may have it."""
    if problem := value_problem(value, known):
        unit = f" ({known.unit})" if known.unit else ""
        raise PlannerError(f"{known.name}: {short(problem)}{unit}")
    for one in value if isinstance(value, list) else [value]:
        _visible(one if isinstance(one, str) else "")
    if any(abs(number) > LARGEST for number in _numbers(value)):
        unit = f" {known.unit}" if known.unit else ""
        raise PlannerError(f"{known.name}: must be at most {LARGEST:,.0f}{unit} either way")
    return canonical_value(value)


def _numbers(value: Any) -> Iterator[float]:
    if is_number(value):
        yield value
    elif isinstance(value, list):
        for item in value:
            yield from _numbers(item)


def prompt_text(text: Any) -> str:
    if not isinstance(text, str) or len(text) > LONGEST_PROMPT:
        raise PlannerError(f"the task prompt must be a text of at most {LONGEST_PROMPT} characters")
    return _visible(text.strip())


def _visible(text: str) -> str:
    """The text. Raises PlannerError for control characters, which nobody can see and approve."""
    if hidden := [one for one in text if category(one) == "Cc" and one not in "\n\t"]:
        raise PlannerError(f"the text holds the control character {hidden[0]!r}; leave it out")
    return text


def short(text: str, most: int = LONGEST_SHOWN) -> str:
    """A value as a sentence repeats it, cut at so many characters."""
    return text if len(text) <= most else f"{text[:most]} ..."


def reword(prompt: str, before: Any, after: Any) -> str:
    """The prompt with the one mention of the old value replaced, so that it fits the parameters.

    A value that stays behind becomes a warning.
    """
    if is_number(before):
        wanted = rf"(?<![\w.,-]){re.escape(compact_json(before))}(?![\w]|[.,]\d)"
    elif isinstance(before, str):
        wanted = rf"(?<!\w){re.escape(before)}(?!\w)"
    elif isinstance(before, list) and len(before) == 2 and all(map(is_number, before)):
        x, y = (re.escape(compact_json(part)) for part in before)
        wanted = rf"[\[(]\s*{x}\s*,\s*{y}\s*[\])]"
    else:
        return prompt
    text = after if isinstance(after, str) else json.dumps(after)
    changed, count = re.subn(wanted, lambda _found: text, prompt)
    return changed if count == 1 else prompt


@functools.cache
def task_validator(vocabulary: Vocabulary) -> Any:
    """The validator of tasks against their JSON Schema."""
    import jsonschema

    return jsonschema.Draft202012Validator(task_schema(vocabulary))
