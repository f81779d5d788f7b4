"""Reading and writing plan documents."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from planner_ft.document.build import PlanDocument, document_digest
from planner_ft.document.entered import short
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, write_json
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.definition import bundled_vocabularies
from planner_ft.vocabulary.plans import plan_problems, task_problems
from planner_ft.vocabulary.schema import FORMAT, VERSION, frame_schema

LARGEST_FILE = 64 * 2**20
"""Bytes of a file that is read at most: a plan of 500 tasks has about 2 MB."""
LONGEST_SHOWN = 200
AS_WRITTEN = "take the file as `plannerft plan` or `plannerft review` wrote it"


def read_document(path: Path | str, vocabulary: Vocabulary | None = None) -> PlanDocument:
    """The document in a file, by default of the bundled vocabulary that it names.

    A wrong digest is no error here: see `altered`. Raises PlannerError.
    """
    path = Path(path)
    size = path.stat().st_size if path.is_file() else 0
    if size > LARGEST_FILE:
        problem = f"has {size} bytes, more than the {LARGEST_FILE} of any plan"
        raise PlannerError(f"{path}: {problem}; {AS_WRITTEN}")
    document = read_json(path)
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        way_out = f"write one with `plannerft plan COMMAND --out {path.name}`"
        raise PlannerError(f"{path}: is no plan document; {way_out}")
    if (found := document.get("version")) != VERSION:
        problem = f"is of version {found!r}, and this program reads version {VERSION}"
        raise PlannerError(f"{path}: {problem}; plan the command again")
    vocabulary = vocabulary or vocabulary_of(document, path)
    made = document.get("vocabulary")
    named = made if isinstance(made, dict) else {}
    if named.get("sha256") != vocabulary.sha256:
        raise PlannerError(
            f"{path}: was made with another vocabulary ({named.get('name')!r}, other content) than"
            f" {vocabulary.name!r}; give its file with --vocabulary, or plan again"
        )
    if (wrong := document_problem(document, vocabulary)) is not None:
        raise PlannerError(f"{path}: {wrong}; {AS_WRITTEN}")
    return document


def document_problem(document: Any, vocabulary: Vocabulary) -> str | None:
    """Where and why a value is no plan document, or None.

    JSON Schema checks the frame alone; plan checks of the tasks take a fraction of its time.
    """
    from jsonschema.exceptions import best_match

    found = best_match(_frame().iter_errors(document))
    if found is not None:
        where = found.json_path.removeprefix("$").lstrip(".") or "the document"
        return f"{where}: {short(found.message, LONGEST_SHOWN)}"
    for where, part in (("tasks", document), ("proposed.tasks", document["proposed"])):
        for index, task in enumerate(part["tasks"]):
            steps = {"skill_sequence": task["skill_sequence"] or []}
            problems = task_problems(task, vocabulary)
            problems += plan_problems("task", steps, vocabulary, strict=True)
            if problems:
                return f"{where}[{index}]: {short(problems[0], LONGEST_SHOWN)}"
    return None


def vocabulary_of(document: PlanDocument, path: Path | str) -> Vocabulary:
    """The bundled vocabulary that a document names. Raises PlannerError when there is none."""
    made = document.get("vocabulary")
    name = made.get("name") if isinstance(made, dict) else None
    if not isinstance(name, str):
        raise PlannerError(f"{path}: names no vocabulary; {AS_WRITTEN}")
    if name not in bundled_vocabularies():
        problem = f"was made with the vocabulary {name!r}, which is not bundled"
        raise PlannerError(f"{path}: {problem}; give its file with --vocabulary")
    return load_vocabulary(name)


def write_document(path: Path | str, document: PlanDocument) -> PlanDocument:
    """Write a document with its digest, atomically; returns it. Raises PlannerError."""
    written = {**document, "digest": document_digest(document)}
    write_json(path, written)
    return written


@cache
def _frame() -> Any:
    import jsonschema

    return jsonschema.Draft202012Validator(frame_schema())
