"""Data that the command asks for and that no step of the plan gathers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.document.language import Clause, Data, language, read_clauses
from planner_ft.document.warnings.warning import Warning, named, quoted, warning
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.essentials import essentials_of
from planner_ft.vocabulary.plans import step_skills


def data_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """One per clause with words for sensors or data that reach no skill, or that are ruled out.

    Data that is sent may have been gathered long ago, and is not asked for.
    """
    spoken, tasks = language(vocabulary), document["tasks"]
    if not tasks:
        return
    own = [_gathering(task, vocabulary) for task in tasks]
    gathering = set[str]().union(*own)
    # What waits says what it will gather, and data to be sent are not gathered anew.
    waiting = [task["task_prompt"] for task in tasks if not task["skill_sequence"]]
    waiting += [str(value) for task in tasks for value in task["parameters"].values()]
    for data in (one for one in spoken.data if one.ruled_out and one.skills & gathering):
        for match in data.said.finditer(document["command"]):
            skills = ", ".join(sorted(data.skills & gathering))
            text = f'The command says "{match[0]}", and steps of the plan have {skills}.'
            yield warning("data-ruled-out", text, about=match[0].casefold())
    asked = [data for data in spoken.data if not data.ruled_out]
    for clause in read_clauses(document["command"], vocabulary):
        sends = any(ask.sends and ask.said.search(clause.text) for ask in spoken.asks)
        if clause.corrected or sends:
            continue
        lost = [data for data in asked if not _gathered(data, gathering, waiting)]
        spans = sorted(span for data in lost for span in clause.spans(data.said))
        words = list(dict.fromkeys(document["command"][start:end] for start, end in spans))
        if not words and spoken.words["everywhere"].search(clause.text):
            yield from _once(asked, clause, own, tasks)
        if words:
            listed = ", ".join(f'"{one}"' for one in words)
            text = f"The command speaks of {listed}; no step of the plan gathers that."
            yield warning("data-not-planned", text, about=" ".join(words).casefold())


def _once(
    asked: list[Data], clause: Clause, own: list[set[str]], tasks: list[dict[str, Any]]
) -> Iterator[Warning]:
    """Data that are asked for at several places, and that one task of several alike gathers."""
    for data in (one for one in asked if one.skills and any(clause.spans(one.said))):
        having = [task for task, names in zip(tasks, own, strict=True) if data.skills & names]
        alike = [task for task in tasks if having and task["title"] == having[0]["title"]]
        if len(having) == 1 and len(alike) > 1:
            said, what = quoted(clause.text.strip(" ,;")), ", ".join(sorted(data.skills))
            text = f'The command says "{said}", and {named(having[0])} alone gathers that ({what}).'
            yield warning("data-not-planned", text, about=said.casefold())


def _gathering(task: dict[str, Any], vocabulary: Vocabulary) -> set[str]:
    """The skills that gather something in a task; of a task that waits those that are essential."""
    steps = task["skill_sequence"]
    skills = [skill["name"] for step in steps or () for _role, skill in step_skills(step)]
    names = {*skills} if steps else essentials_of(task["title"], vocabulary).skills.keys()
    return {name for name in names if vocabulary.skill[name].role == "perception"}


def _gathered(data: Data, gathering: set[str], waiting: list[str]) -> bool:
    """Whether a skill gathers the data, or a task that has no skills yet speaks of it."""
    found = data.skills & gathering if data.skills else gathering
    return bool(found) or any(data.said.search(prompt) for prompt in waiting)
