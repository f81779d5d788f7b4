"""The vocabulary as text: for the prompt of base models, and as a page of the documentation."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from planner_ft.support.files import read_text
from planner_ft.vocabulary.definition import Parameter, Role, Skill, Task, Vocabulary
from planner_ft.vocabulary.plans import Level

ROLE_HEADINGS: dict[Role, str] = {
    "navigation": (
        "navigation skills (exactly one per step; it moves or holds the vehicle and its end ends"
        " the step)"
    ),
    "filter": "filter skills (run beside the navigation skill and constrain it)",
    "perception": "perception skills (run beside the navigation skill and gather data)",
}
FORMS = {
    "position": "[x, y]",
    "polygon": "[[x, y], ...]",
    "texts": '["...", ...]',
    "text": '"..."',
    "id": '"..."',
}
"""How values of a type are written, except for numbers."""


def prompt_text(level: Level, vocabulary: Vocabulary) -> str:
    """The names of this level with their parameters, one per line, as base models are shown
    them.
    """
    if level == "mission":
        return "\n".join(map(_line, vocabulary.tasks))
    return "\n".join(
        line
        for role, heading in ROLE_HEADINGS.items()
        for line in (f"{heading}:", *map(_line, vocabulary.skills_in_role(role)))
    )


def _line(owner: Task | Skill) -> str:
    name = owner.title if isinstance(owner, Task) else owner.name
    return f"- {name}({', '.join(map(_written, owner.parameters))}): {owner.description}"


def _written(parameter: Parameter) -> str:
    number = parameter.type in ("number", "integer")
    unit = f" in {parameter.unit}" if parameter.unit and number else ""
    return f"{parameter.name}: {FORMS.get(parameter.type, parameter.type)}{unit}"


def documentation_page(vocabulary: Vocabulary) -> str:
    """docs/vocabulary.md: tasks by category, then skills by role, each with its parameters."""
    file, tasks, skills = f"{vocabulary.name}.toml", vocabulary.tasks, vocabulary.skills
    lines = [
        f"# Vocabulary: {vocabulary.title}",
        "",
        f"Written by `plannerft vocabulary --docs` from `{file}`; edit that file, not this page.",
        "",
        f"Frame: {vocabulary.frame}. Home is `{list(vocabulary.home)}`;"
        f" `{list(vocabulary.unresolved)}` is a place that is not known yet.",
        "",
        f"## {len(tasks)} tasks",
    ]
    for category in dict.fromkeys(task.category for task in tasks):
        rows = [
            (f"`{task.title}`", task.description, _cells(task))
            for task in tasks
            if task.category == category
        ]
        lines += _table(f"### {category}", ("task", "what it does", "parameters"), rows)
    lines += ["", f"## {len(skills)} skills"]
    for role, heading in ROLE_HEADINGS.items():
        described = [
            (f"`{skill.name}`", skill.category, skill.description, _cells(skill))
            for skill in vocabulary.skills_in_role(role)
        ]
        columns = ("skill", "category", "what it does", "parameters")
        lines += _table(f"### {heading[0].upper()}{heading[1:]}", columns, described)
    fitting = [
        (f"`{task.title}`", *(", ".join(task.skills.get(role, ())) for role in ROLE_HEADINGS))
        for task in tasks
    ]
    lines += _table("## Which skills fit which task", ("task", *ROLE_HEADINGS), fitting)
    return "\n".join(lines) + "\n"


def stale_page(path: Path, vocabulary: Vocabulary) -> bool:
    """Whether the page at `path` is missing or differs from what the vocabulary gives."""
    return not path.is_file() or read_text(path) != documentation_page(vocabulary)


def _table(heading: str, columns: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> list[str]:
    table = [f"| {' | '.join(row)} |" for row in (columns, *rows)]
    return ["", heading, "", table[0], "|---" * len(columns) + "|", *table[1:]]


def _cells(owner: Task | Skill) -> str:
    return "<br>".join(_cell(parameter, owner) for parameter in owner.parameters) or "none"


def _cell(parameter: Parameter, owner: Task | Skill) -> str:
    notes: list[str] = [parameter.type]
    if parameter.unit:
        notes.append(parameter.unit)
    if parameter.minimum is not None and parameter.maximum is not None:
        notes.append(f"{parameter.minimum:g} to {parameter.maximum:g}")
    if parameter.required:
        notes.append("required")
    elif parameter.name in owner.require_any:
        notes.append("one of these required")
    return f"`{parameter.name}` ({', '.join(notes)}): {parameter.description}"
