"""A plan document of a planned command, and everything that derives from the rest of a document;
reading and writing it.

A place that was filled in stands as `located` beside the parameters of its tasks.
"""

import copy
import hashlib
from collections.abc import Sequence
from dataclasses import asdict
from functools import cache
from pathlib import Path
from typing import Any

from planner_ft.confidence.calibration import Judgement
from planner_ft.document.clearance import cleared
from planner_ft.document.confidence import (
    choices,
    kept_confidence,
    open_choices,
    plan_confidence,
    task_confidence,
)
from planner_ft.document.entered import short
from planner_ft.document.limits import carried, with_words
from planner_ft.document.ontology import check
from planner_ft.document.sources import sources
from planner_ft.document.track import estimate, track
from planner_ft.document.vehicle import Vehicle, load_vehicle
from planner_ft.document.warnings import warnings
from planner_ft.planning.essentials import asked, kept_additions, kept_defaults, question
from planner_ft.planning.locations import OpenPlace, open_places, place_in
from planner_ft.planning.result import Answer, Planned, PlannedTask
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, write_json
from planner_ft.vocabulary import Entry, Vocabulary, load_vocabulary
from planner_ft.vocabulary.definition import bundled_vocabularies
from planner_ft.vocabulary.plans import canonical_parameters, plan_problems, task_problems
from planner_ft.vocabulary.schema import FORMAT, TASK_KEYS, VERSION, document_keys, frame_schema

PlanDocument = dict[str, Any]  # a plan document (schemas/plan.schema.json), never changed in place
DERIVED = ("waits_for", "asks", "sources")  # keys of a task that follow from the rest
LARGEST = 2**53 - 1  # larger whole numbers have no exact form in RFC 8785 (I-JSON, RFC 7493)
LARGEST_FILE = 64 * 2**20
"""Bytes of a file that is read at most: a plan of 500 tasks has about 2 MB."""
LONGEST_SHOWN = 200
AS_WRITTEN = "take the file as `plannerft plan` or `plannerft review` wrote it"


def build(planned: Planned, vocabulary: Vocabulary, vehicle: Vehicle | None = None) -> PlanDocument:
    """The document of a planned command; `vehicle` is by default the vocabulary's."""
    plan = planned.mission.plan or {"tasks": []}
    judged = planned.mission.judged
    tasks = [_task(number, task, judged) for number, task in enumerate(planned.tasks, start=1)]
    places: dict[str, Any] = {}
    for place in open_places(plan, vocabulary):
        for task in (tasks[number - 1] for number in place.tasks):
            where, position = place_in(task, vocabulary)
            if position is not None:
                task["located"] = {where: place.name}
                places[place.name] = position
    charted = {name: list(position) for name, position in planned.chart.items()}
    proposal = {
        "tasks": tasks,
        "assumptions": [*plan.get("assumptions", []), *planned.mission.notes],
        "constraints": list(plan.get("constraints", [])),
        "located": places,
        **({"choices": choices(planned.doubts)} if planned.doubts else {}),
    }
    document = {
        "format": FORMAT,
        "version": VERSION,
        "command": planned.command,
        "vocabulary": {**vocabulary.named, **_motion_of(vocabulary)},
        "vehicle": (vehicle or load_vehicle(None, vocabulary)).as_json(),
        **({"origin": asdict(planned.origin)} if planned.origin else {}),
        **({"structures": charted} if charted else {}),
        **{key: value for key, value in proposal.items() if key != "choices"},
        "confidence": plan_confidence(planned),
        **_problems(planned.mission),
        "edits": [],
        "usage": {agent: asdict(use) for agent, use in planned.usage.items()},
        "peak_memory_bytes": planned.peak_memory,
        "manifest": planned.manifest,
    }
    tasks = made_safe(document, vocabulary)
    document |= {"tasks": tasks, "proposed": copy.deepcopy({**proposal, "tasks": tasks})}
    return revise(document, vocabulary)


def made_safe(document: PlanDocument, vocabulary: Vocabulary) -> list[dict[str, Any]]:
    """The tasks with the filters of the plan's limits, and clear of structures."""
    return cleared({**document, "tasks": carried(document, vocabulary)}, vocabulary)


def _task(number: int, task: PlannedTask, judged: Judgement) -> dict[str, Any]:
    entry: dict[str, Any] = {"id": f"t{number}", "title": task.title}
    entry |= {"parameters": task.parameters, "task_prompt": task.task_prompt}
    entry |= {"defaults": task.defaults} if task.defaults else {}
    entry["skill_sequence"] = None
    if answer := task.answer:
        entry["skill_sequence"] = answer.plan and answer.plan["skill_sequence"]
        entry |= {"added": list(answer.added)} if answer.added else {}
        entry |= {"assumptions": list(answer.notes)} if answer.notes else {}
        entry |= _problems(answer)
    if found := task_confidence(number, task, judged):
        entry["confidence"] = found
    return copy.deepcopy(entry)


def _problems(answer: Answer) -> dict[str, Any]:
    """What is wrong with an answer, with its raw text; nothing for a valid one."""
    if answer.plan is not None:
        return {}
    return {"problems": list(answer.problems), "output": answer.text}


def revise(document: PlanDocument, vocabulary: Vocabulary) -> PlanDocument:
    """The document with derived keys, validity and digest made anew."""
    was = {task["id"]: task for task in document["proposed"]["tasks"]}
    tasks = [
        _ordered_task(task, was.get(task["id"], task), vocabulary) for task in document["tasks"]
    ]
    places = places_of(tasks, vocabulary)
    for place in places:
        for number in place.tasks:
            tasks[number - 1]["waits_for"] = place.name
    questions = []
    for number, task in enumerate(tasks, start=1):
        if text := question(number, task, vocabulary):
            task["asks"] = asked(task, vocabulary)
            questions.append(text)
    valid = not any("problems" in part for part in (document, *tasks))
    revised = {
        **{key: value for key, value in document.items() if key not in ("limits", "choices")},
        "tasks": tasks,
        "valid": valid,
        "complete": valid
        and not questions
        and all(task["skill_sequence"] is not None for task in tasks),
        "questions": questions,
        "open_places": [{"name": place.name, "tasks": list(place.tasks)} for place in places],
        "ontology": check(document["command"], vocabulary),
    }
    if limits := with_words(revised, vocabulary):
        revised["limits"] = limits
    if asking := list(open_choices(revised, vocabulary)):
        revised["choices"] = asking
    for task, found in zip(tasks, sources(revised, vocabulary), strict=True):
        task["sources"] = found
    path = track(revised, vocabulary)
    revised["estimate"] = estimate(revised, path, vocabulary.home)
    revised["warnings"] = warnings(revised, vocabulary, path)
    revised["tasks"] = [_ordered(task, TASK_KEYS) for task in tasks]
    ordered = _ordered(revised, document_keys())
    return {**ordered, "digest": document_digest(ordered)}


def _ordered_task(
    task: dict[str, Any], proposed: dict[str, Any], vocabulary: Vocabulary
) -> dict[str, Any]:
    """A task without what derives, its parameters in the order of the definition."""
    known = vocabulary.task.get(task["title"])
    marks = {"defaults": kept_defaults(task), "added": kept_additions(task)}
    marks["confidence"] = kept_confidence(task, proposed)
    kept = {key: value for key, value in without_derived(task).items() if key not in marks}
    kept |= {key: value for key, value in marks.items() if value}
    return {**kept, "parameters": canonical_parameters(task["parameters"], known)}


def without_derived(task: Entry) -> dict[str, Any]:
    """A task without what derives."""
    return {key: value for key, value in task.items() if key not in DERIVED}


def _ordered(value: Entry, keys: Sequence[str]) -> dict[str, Any]:
    return {key: value[key] for key in keys if key in value}


def places_of(tasks: Sequence[dict[str, Any]], vocabulary: Vocabulary) -> list[OpenPlace]:
    """The places that a document's tasks leave open."""
    return open_places({"tasks": tasks}, vocabulary)


def tasks_at(
    name: str, tasks: Sequence[dict[str, Any]], vocabulary: Vocabulary
) -> list[tuple[dict[str, Any], str]]:
    """The tasks at a place, open or located, each with what `place_in` says holds its position."""
    places = [place for place in places_of(tasks, vocabulary) if place.name == name]
    waiting = [tasks[number - 1] for place in places for number in place.tasks]
    found = [(task, place_in(task, vocabulary)[0]) for task in waiting]
    return found + [
        (task, parameter)
        for task in tasks
        for parameter, located in task.get("located", {}).items()
        if located == name
    ]


def canonical(value: Any) -> bytes:
    """The canonical form (RFC 8785); whole numbers beyond 2^53 - 1 as floating-point numbers."""
    import rfc8785

    return rfc8785.dumps(_exact(value))


def sha256_canonical(value: Any) -> str:
    """Hexadecimal SHA-256 over the canonical form of a JSON value."""
    return hashlib.sha256(canonical(value)).hexdigest()


def document_digest(document: Entry) -> str:
    """The digest of a plan document: of all of it but the key `digest`."""
    return sha256_canonical({key: value for key, value in document.items() if key != "digest"})


def altered(document: Entry) -> bool:
    """Whether a document was changed without a new digest, as by hand."""
    return document.get("digest") != document_digest(document)


def _exact(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _exact(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_exact(item) for item in value]
    if isinstance(value, int) and not isinstance(value, bool) and abs(value) > LARGEST:
        return float(value)
    return value


def read_document(path: Path | str, vocabulary: Vocabulary | None = None) -> PlanDocument:
    """The document in a file, by default of the bundled vocabulary that it names.

    A wrong digest is no error here: see `altered`. Raises PlannerError.
    """
    path = Path(path)
    size = path.stat().st_size if path.is_file() else 0
    if size > LARGEST_FILE:
        problem = f"has {size} bytes, more than the {LARGEST_FILE} of any plan"
        raise PlannerError(f"{path}: {problem}; {AS_WRITTEN}")
    document = read_json(path, unique=True)
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
    moved = named.get("motion")
    if moved is not None and {"motion": moved} != _motion_of(vocabulary):
        raise PlannerError(
            f"{path}: was made with another motion file of {vocabulary.name!r}: its skills move the"
            " vehicle otherwise now; give the file that it was made with, or plan again"
        )
    if (wrong := document_problem(document, vocabulary)) is not None:
        raise PlannerError(f"{path}: {wrong}; {AS_WRITTEN}")
    return document


def _motion_of(vocabulary: Vocabulary) -> dict[str, str]:
    """The digest of what skills do to the vehicle; none without a motion file."""
    return {"motion": vocabulary.motion.sha256} if vocabulary.motion.sha256 else {}


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
