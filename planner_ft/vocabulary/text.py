"""The vocabulary as text: for the prompt of base models, and as a page of the documentation."""

from __future__ import annotations

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


def prompt_text(level: Level, vocabulary: Vocabulary) -> str:
    """The names of this level with their parameters, one per line, as base models are shown
    them.
    """
    if level == "mission":
        return "\n".join(f"- {_signature(task)}: {task.description}" for task in vocabulary.tasks)
    lines = []
    for role, heading in ROLE_HEADINGS.items():
        lines.append(f"{heading}:")
        lines += [
            f"- {_signature(skill)}: {skill.description}"
            for skill in vocabulary.skills
            if skill.role == role
        ]
    return "\n".join(lines)


def _signature(owner: Task | Skill) -> str:
    name = owner.title if isinstance(owner, Task) else owner.name
    return f"{name}({', '.join(_parameter(parameter) for parameter in owner.parameters)})"


def _parameter(parameter: Parameter) -> str:
    kind = {
        "position": "[x, y]",
        "polygon": "[[x, y], ...]",
        "texts": '["...", ...]',
        "text": '"..."',
        "id": '"..."',
    }.get(parameter.type, parameter.type)
    unit = (
        f" in {parameter.unit}"
        if parameter.unit and parameter.type in ("number", "integer")
        else ""
    )
    return f"{parameter.name}: {kind}{unit}"


def documentation_page(vocabulary: Vocabulary) -> str:
    """docs/vocabulary.md: tasks by category, then skills by role, each with its parameters."""
    lines = [
        f"# Vocabulary: {vocabulary.title}",
        "",
        (
            f"Written by `plannerft vocabulary --docs` from `{vocabulary.name}.toml`; edit that"
            " file, not this page."
        ),
        "",
        (
            f"Frame: {vocabulary.frame}. Home is `{list(vocabulary.home)}`;"
            f" `{list(vocabulary.unresolved)}` is a place that is not known yet."
        ),
        "",
        f"## {len(vocabulary.tasks)} tasks",
    ]
    for category in dict.fromkeys(task.category for task in vocabulary.tasks):
        lines += [
            "",
            f"### {category}",
            "",
            "| task | what it does | parameters |",
            "|---|---|---|",
        ]
        lines += [
            f"| `{task.title}` | {task.description} | {_cells(task)} |"
            for task in vocabulary.tasks
            if task.category == category
        ]
    lines += ["", f"## {len(vocabulary.skills)} skills"]
    for role, heading in ROLE_HEADINGS.items():
        lines += [
            "",
            f"### {heading[0].upper() + heading[1:]}",
            "",
            "| skill | category | what it does | parameters |",
            "|---|---|---|---|",
        ]
        lines += [
            f"| `{skill.name}` | {skill.category} | {skill.description} | {_cells(skill)} |"
            for skill in vocabulary.skills
            if skill.role == role
        ]
    lines += [
        "",
        "## Which skills fit which task",
        "",
        "| task | navigation | filter | perception |",
        "|---|---|---|---|",
    ]
    lines += [
        f"| `{task.title}` | "
        + " | ".join(", ".join(task.skills.get(role, ())) for role in ROLE_HEADINGS)
        + " |"
        for task in vocabulary.tasks
    ]
    return "\n".join(lines) + "\n"


def stale_page(path: Path, vocabulary: Vocabulary) -> bool:
    """Whether the page at `path` is missing or differs from what the vocabulary gives."""
    return not path.is_file() or read_text(path) != documentation_page(vocabulary)


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
