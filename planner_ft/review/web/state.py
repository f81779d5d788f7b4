"""What a page shows of a plan, its approval and the vehicle."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from planner_ft.document import PlanDocument, differences
from planner_ft.document.track import track
from planner_ft.document.tree import brief
from planner_ft.document.warnings.case import gravest_first, meaning
from planner_ft.review.changes import tampered
from planner_ft.review.desk import Desk
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary

PLAN = ("document", "path", "revision", "track", "brief", "tampered", "warnings")
"""Keys of the state that are None without a plan."""
State = dict[str, Any]


def plan_state(desk: Desk | None) -> State:
    """The plan on a desk: document, track, brief, what was changed outside of the review (None:
    nothing), warnings with severity and name, differences from the proposal, and the decision.
    """
    if desk is None:
        approval = _undecided("there is no plan yet")
        return {**dict.fromkeys(PLAN), "differences": [], "approval": approval}
    document = desk.document
    try:
        approval = asdict(desk.approval())
    except PlannerError as error:
        # A log that is broken keeps nobody from looking at the plan.
        approval = _undecided(str(error))
    course = track(document, desk.vocabulary)
    short = asdict(brief(document, course, desk.vocabulary))
    foreign = tampered(document, desk.vocabulary)
    found = None if foreign is None else [one.text for one in foreign]
    about = desk.path.name, desk.revision, asdict(course), short, found, _named(document)
    values = (document, *about)
    changed = [asdict(difference) for difference in differences(document)]
    return {**dict(zip(PLAN, values, strict=True)), "differences": changed, "approval": approval}


def _named(document: PlanDocument) -> list[dict[str, Any]]:
    """The warnings, the gravest first, each with its severity and name."""
    return [
        {**one, "severity": severity, "name": name}
        for one in gravest_first(document["warnings"])
        for severity, name in [meaning(one["kind"])]
    ]


def vocabulary_json(vocabulary: Vocabulary) -> dict[str, Any]:
    """The vocabulary for the page: tasks, skills, home, and the place that is not known."""

    def described(entry: Any, *keys: str) -> dict[str, Any]:
        parameters = [asdict(parameter) for parameter in entry.parameters]
        return {**{key: getattr(entry, key) for key in keys}, "parameters": parameters}

    places = {"home": list(vocabulary.home), "unresolved": list(vocabulary.unresolved)}
    tasks = [described(task, "title", "category", "description") for task in vocabulary.tasks]
    keys, skills = ("category", "role", "description"), vocabulary.skills
    by_name = {skill.name: described(skill, *keys) for skill in skills}
    return {"name": vocabulary.name, **places, "tasks": tasks, "skills": by_name}


def _undecided(text: str) -> dict[str, Any]:
    return {"status": "unknown", "text": text, "reviewer": None, "time": None, "sequence": None}
