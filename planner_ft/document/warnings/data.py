"""Data that the command asks for, or rules out, and what the plan gathers."""

import re
from collections.abc import Iterator
from typing import Any

from planner_ft.document.language import Clause, Data
from planner_ft.document.warnings.asked import STEM, sends
from planner_ft.document.warnings.case import Case, Warning, named, quoted, skills_of, warning
from planner_ft.vocabulary import Entry, Vocabulary
from planner_ft.vocabulary.definition import MISSIONS
from planner_ft.vocabulary.essentials import essentials_of

SENTENCE = re.compile(r"(?<=\.)\s+")


def asked_skills(case: Case) -> set[str]:
    """The skills that can gather what the command asks for, and that it does not rule out: stills,
    but no video.
    """
    asked, ruled_out = set[str](), set[str]()
    for data in case.spoken.data:
        if data.ruled_out and data.said.search(case.command):
            ruled_out |= data.skills
        elif any(any(clause.spans(data.said)) for clause in case.typed):
            asked |= data.skills
    return asked - ruled_out


def data_ruled_out(case: Case) -> Iterator[Warning]:
    """Words that rule data out which steps of the plan gather."""
    gathering = set[str]().union(*(gathered_by(task, case.vocabulary) for task in case.tasks))
    for data in (one for one in case.spoken.data if one.ruled_out and one.skills & gathering):
        for match in data.said.finditer(case.command):
            skills = ", ".join(sorted(data.skills & gathering))
            about = match[0].casefold()
            yield warning("data-ruled-out", about=about, words=match[0], skills=skills)
    asked = asked_skills(case)
    for off in case.words["not_to_be"].finditer(case.command):
        for data in (one for one in case.spoken.data if not one.ruled_out):
            said = data.said.match(case.command[off.end() :].lstrip())
            if said and (none := data.skills & gathering - asked):
                words, listed = f"{off[0]} {said[0]}", ", ".join(sorted(none))
                yield warning("data-ruled-out", about=words.casefold(), words=words, skills=listed)


def data_not_planned(case: Case) -> Iterator[Warning]:
    """Clauses with words for sensors or data that reach no skill. Data that is sent may have been
    gathered long ago, and is not asked for.
    """
    own = [gathered_by(task, case.vocabulary) for task in case.tasks]
    gathering = set[str]().union(*own)
    # What waits says what it will gather, and data to be sent are not gathered anew.
    waiting = [task["task_prompt"] for task in case.tasks if not task["skill_sequence"]]
    valued = " ".join(str(value) for task in case.tasks for value in task["parameters"].values())
    # An approach by GPS says so itself.
    waiting += [case.vocabulary.task[task["title"]].description for task in case.tasks]
    asked = [data for data in case.spoken.data if not data.ruled_out]
    for clause in (one for one in case.typed if not (one.corrected or sends(one, case))):
        lost = [data for data in asked if not _gathered(data, gathering, waiting)]
        # In "a depth picture" is no picture.
        kept = [span for data in asked if data not in lost for span in clause.spans(data.said)]
        found = (span for data in lost for span in clause.spans(data.said))
        spans = sorted(
            one for one in found if not any(a <= one[0] and one[1] <= b for a, b in kept)
        )
        said = dict.fromkeys(case.command[start:end] for start, end in spans)
        words = [one for one in said if one.casefold() not in valued.casefold()]
        if words:
            listed, about = ", ".join(f'"{one}"' for one in words), " ".join(words).casefold()
            yield warning("data-not-planned", "nowhere", about=about, words=listed)
        elif case.words["throughout"].search(clause.text) or (
            _all_along(clause, case) and not _is_elsewhere(asked, clause, own, case)
        ):
            yield from _with_gaps(asked, clause, own, case)
        elif case.words["everywhere"].search(clause.text):
            yield from _once(asked, clause, own, case.tasks)


def prompts_unheard(case: Case) -> Iterator[Warning]:
    """Data that a task prompt says in the sentence of a skill and none of the task's steps gathers:
    the Task Agent has left it out, or a task of this kind cannot have it.
    """
    sentences = case.vocabulary.beside(MISSIONS).get("demand", {})
    for task in (one for one in case.tasks if one["skill_sequence"] and not one.get("stale")):
        own = {skill["name"] for _role, skill in skills_of(task)}
        said = [one.rstrip(".") for one in SENTENCE.split(task["task_prompt"])[1:]]
        for skill, sentence in sentences.items():
            begun = sentence.partition("{")[0].rstrip()
            words = next((one for one in said if one.startswith(begun)), None)
            if words and skill not in own:
                values = {"words": words, "skills": skill}
                yield warning("data-not-planned", "prompt", task, about=skill, **values)


def not_sent(case: Case) -> Iterator[Warning]:
    """Words for data in an order to send that no list of what is sent has; words for any data
    ("the readings") may stand for all of it.
    """
    lists = [(task, _sent(task, case.vocabulary)) for task in case.tasks]
    lists = [(task, names) for task, names in lists if names]
    listed = " ".join([*(one for _task, names in lists for one in names)]).casefold()
    general = [data.said for data in case.spoken.data if not data.skills]
    for clause in (one for one in case.typed if lists and not one.corrected):
        orders = [ask.said.search(clause.text) for ask in case.spoken.asks if ask.sends]
        behind = min((clause.start + one.end() for one in orders if one), default=clause.end)
        for start, end in clause.spans(case.spoken.sensors):
            word = case.command[start:end]
            alike = start < behind or any(said.fullmatch(word) for said in general)
            if not alike and word[:STEM].casefold() not in listed:
                words = {"words": quoted(clause.text.strip(" ,;.")), "name": word}
                yield warning("data-not-planned", "sent", lists[-1][0], about=word, **words)


def _sent(task: Entry, vocabulary: Vocabulary) -> list[str]:
    """What a task sends, by its list."""
    name = vocabulary.logic.of(task["title"]).sends
    return list(task["parameters"].get(name or "", ()))


def _all_along(clause: Clause, case: Case) -> bool:
    """Whether a clause ends with words for the whole way."""
    last = len(clause.text.rstrip(" ,;."))
    return any(match.end() == last for match in case.words["all_along"].finditer(clause.text))


def _is_elsewhere(asked: list[Data], clause: Clause, own: list[set[str]], case: Case) -> bool:
    """Whether other tasks than transits gather what a clause says; the way may be theirs."""
    wanted = set[str]().union(*(one.skills for one in asked if any(clause.spans(one.said))))
    both = zip(case.tasks, own, strict=True)
    return any(task["title"] != case.vocabulary.transit and wanted & names for task, names in both)


def _with_gaps(
    asked: list[Data], clause: Clause, own: list[set[str]], case: Case
) -> Iterator[Warning]:
    """Data that are asked for on every way, and one that does not gather them."""
    for data in (one for one in asked if one.skills and any(clause.spans(one.said))):
        ways = [
            task
            for task, names in zip(case.tasks, own, strict=True)
            if task["skill_sequence"]
            and task["title"] == case.vocabulary.transit
            and not data.skills & names
        ]
        for task in ways[:1]:
            words = quoted(clause.text.strip(" ,;"))
            values: dict[str, Any] = {"words": words, "skills": ", ".join(sorted(data.skills))}
            yield warning("data-not-planned", "gap", task, about=words.casefold(), **values)


def _once(
    asked: list[Data], clause: Clause, own: list[set[str]], tasks: list[dict[str, Any]]
) -> Iterator[Warning]:
    """Data that are asked for at several places, and that one task of several alike gathers."""
    for data in (one for one in asked if one.skills and any(clause.spans(one.said))):
        having = [task for task, names in zip(tasks, own, strict=True) if data.skills & names]
        alike = [task for task in tasks if having and task["title"] == having[0]["title"]]
        if len(having) == 1 and len(alike) > 1:
            said, only = quoted(clause.text.strip(" ,;")), named(having[0])
            skills, about = ", ".join(sorted(data.skills)), said.casefold()
            values: dict[str, Any] = {"words": said, "only": only, "skills": skills}
            yield warning("data-not-planned", "once", about=about, **values)


def gathered_by(task: Entry, vocabulary: Vocabulary) -> set[str]:
    """The skills that gather something in a task; of a task that waits those that are essential."""
    names = {skill["name"] for _role, skill in skills_of(task)}
    if not task["skill_sequence"]:
        names = {*essentials_of(task["title"], vocabulary).skills}
    return {name for name in names if vocabulary.skill[name].role == "perception"}


def _gathered(data: Data, gathering: set[str], texts: list[str]) -> bool:
    """Whether a skill gathers the data, or a text of a task speaks of it."""
    found = data.skills & gathering if data.skills else gathering
    return bool(found) or any(data.said.search(text) for text in texts)
