"""The vocabulary as text: for the prompt of base models, and as a page of the documentation."""

from __future__ import annotations

from pathlib import Path

from planner_ft.support.files import read_text
from planner_ft.vocabulary.definition import Parameter, Role, Skill, Task, Vocabulary
from planner_ft.vocabulary.essentials import load_essentials
from planner_ft.vocabulary.plans import Level

PAGE = Path(__file__).parent / "shapes" / "vocabulary.md.j2"
ROLE_HEADINGS: dict[Role, str] = {
    "navigation": "navigation skills (exactly one per step; it moves or holds the vehicle and its"
    " end ends the step)",
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
    """Names and parameters of this level, one a line, as base models are shown them."""
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
    import jinja2

    environment = jinja2.Environment(undefined=jinja2.StrictUndefined)
    template = environment.from_string(read_text(PAGE))
    categories = dict.fromkeys(task.category for task in vocabulary.tasks)
    page = template.render(
        vocabulary=vocabulary,
        categories=categories,
        headings=ROLE_HEADINGS,
        notes=_notes,
        essentials=load_essentials(vocabulary),
    )
    return page.rstrip() + "\n"


def _notes(parameter: Parameter, owner: Task | Skill) -> str:
    """Type, unit and range of a parameter, and whether it is required."""
    notes: list[str] = [parameter.type]
    if parameter.unit:
        notes.append(parameter.unit)
    if parameter.minimum is not None and parameter.maximum is not None:
        notes.append(f"{parameter.minimum:g} to {parameter.maximum:g}")
    if parameter.required:
        notes.append("required")
    elif parameter.name in owner.require_any:
        notes.append("one of these required")
    return ", ".join(notes)


def stale_page(path: Path, vocabulary: Vocabulary) -> bool:
    """Whether the page at `path` is missing or differs from what the vocabulary gives."""
    return not path.is_file() or read_text(path) != documentation_page(vocabulary)
