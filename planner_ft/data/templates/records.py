"""Template files: JSONL records beside a vehicle's definition, read once and parsed when drawn.

The templates of NAME.toml stand in NAME.commands.jsonl, NAME.clauses.jsonl and NAME.prompts.jsonl,
or, by subject, in the files of the folders NAME.commands/, NAME.clauses/ and NAME.prompts/.
schemas/templates.schema.json is the form of a record.
"""

import functools
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeVar

from planner_ft.data.templates import grammar
from planner_ft.data.templates.grammar import Nodes, Step, TemplateError, all_slots
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_text
from planner_ft.vocabulary import Vocabulary

T = TypeVar("T")
Kind = Literal["commands", "clauses", "prompts"]
SPLITS = ("train", "validation", "test")
FORMS = ("order", "phrase", "sentence")
TEXTS = {
    "commands": ("id", "split", "command", "plan"),
    "clauses": ("id", "split", "clause", "plan", "form"),
    "prompts": ("id", "split", "prompt", "plan"),
}
LISTS = {
    "commands": ("excluded", "constraints", "assumptions"),
    "clauses": ("tasks", "constraints"),
    "prompts": ("tasks",),
}


@dataclass(eq=False)
class Template:
    """A record of a template file; parsed at first use, with errors that name file and line."""

    id: str
    split: str
    text: str
    plan: str
    where: str
    form: str = ""
    tasks: tuple[str, ...] = ()
    excluded: tuple[str, ...] = ()
    constraints: tuple[str, ...] = ()
    assumptions: tuple[str, ...] = ()

    @functools.cached_property
    def nodes(self) -> Nodes:
        return self._parsed(grammar.parse_text, self.text)

    @functools.cached_property
    def steps(self) -> tuple[Step, ...]:
        return self._parsed(grammar.parse_plan, self.plan)

    @functools.cached_property
    def remarks(self) -> tuple[tuple[Nodes, ...], ...]:
        """The constraints and the assumptions."""
        return tuple(
            tuple(self._parsed(grammar.parse_text, line) for line in lines)
            for lines in (self.constraints, self.assumptions)
        )

    def _parsed(self, parse: Callable[[str], T], source: str) -> T:
        try:
            return parse(source)
        except TemplateError as error:
            raise self.error(error) from None

    def error(self, problem: object) -> PlannerError:
        """An error that says where the template stands."""
        return PlannerError(f"{self.where}: {problem}")

    def check_labels(self, steps: str) -> None:
        """Raise TemplateError for a label that text or plan (called `steps`) have alone."""
        slots = list(all_slots(self.nodes))
        asked = {call.label for step in self.steps for call in step.calls() if call.label}
        labels = {slot.key for slot in slots if slot.sign == "?"}
        said = {slot.key for slot in slots if not slot.sign}
        for name in (asked - said - labels) | (labels - asked):
            raise TemplateError(f"the label ?{name} stands only in the text or only in the {steps}")

    @property
    def group(self) -> str:
        """Records of one group, whose ids differ behind a dot, are drawn as one."""
        return self.id.partition(".")[0]

    @property
    def subject(self) -> str:
        """What a record is about: its id without the number."""
        return self.group.rpartition("-")[0]


def template_files(vocabulary: Vocabulary, kind: Kind) -> list[Path]:
    """The template files of a vehicle, by name."""
    if vocabulary.path is None:
        return []
    single = vocabulary.path.with_suffix(f".{kind}.jsonl")
    folder = vocabulary.path.with_suffix(f".{kind}")
    return [path for path in (single, *sorted(folder.glob("*.jsonl"))) if path.is_file()]


def templates(
    vocabulary: Vocabulary, kind: Kind, split: str | None = None, subjects: Sequence[str] = ()
) -> list[list[Template]]:
    """The vehicle's templates of a split by group, of these subjects alone where some are named.
    Raises PlannerError for a faulty record.
    """
    groups: dict[tuple[str, str], list[Template]] = {}
    for path in template_files(vocabulary, kind):
        for template in read_templates(path, kind):
            wanted = not subjects or template.subject in subjects
            if wanted and split in (None, template.split):
                groups.setdefault((path.stem, template.group), []).append(template)
    return list(groups.values())


@functools.lru_cache(maxsize=256)
def read_templates(path: Path, kind: Kind) -> tuple[Template, ...]:
    """The records of one file. Raises PlannerError with file and line."""
    found: dict[str, Template] = {}
    for number, line in enumerate(read_text(path).splitlines(), 1):
        where = f"{path}:{number}"
        try:
            record = json.loads(line)
        except ValueError as error:
            raise PlannerError(f"{where}: not JSON ({error})") from None
        problem = _problem(record, kind)
        if problem or record["id"] in found:
            raise PlannerError(f"{where}: {problem or 'the id stands twice'}")
        name, split, text, plan, *form = (record.pop(key) for key in TEXTS[kind])
        lists: dict[str, Any] = {key: tuple(items) for key, items in record.items()}
        found[name] = Template(name, split, text, plan, where, *form, **lists)
    return tuple(found.values())


def _problem(record: Any, kind: Kind) -> str | None:
    """What is wrong with the form of a record."""
    if not isinstance(record, dict):
        return "not an object"
    for name in TEXTS[kind]:
        if not isinstance(record.get(name), str):
            return f"{name} is missing or no text"
    for name in LISTS[kind]:
        items = record.get(name, None if kind == "prompts" else [])
        if not isinstance(items, list) or not all(isinstance(item, str) for item in items):
            return f"{name} is missing or no list of texts"
    if unknown := record.keys() - {*TEXTS[kind], *LISTS[kind]}:
        return f"unknown field {min(unknown)}"
    if record["split"] not in SPLITS:
        return f"split {record['split']!r}: must be {', '.join(SPLITS)}"
    if record.get("form", FORMS[0]) not in FORMS:
        return f"form {record['form']!r}: must be {', '.join(FORMS)}"
    return None
