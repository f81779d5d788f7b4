"""Instructions of the command that no task answers or that contradict each other, and commands in
unknown words.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from planner_ft.document.language import Ask, Clause, Language, language, read_clauses
from planner_ft.document.track import place_of
from planner_ft.document.warnings.warning import Warning, named, quoted, warning
from planner_ft.facts import unknown_words
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.places import without_geographic
from planner_ft.planning.frame import frame_of
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import step_skills

STEM = 5
"""First letters by which a word is found again."""
NEAR = 24
"""Characters in which words that rule something out stand before it."""
ARTICLE = 3
"""Words before a noun among which its article is."""
UNKNOWN = 0.55
"""The share of unknown words from which a command may be in another language
(benchmarks/language_check.py).
"""


def command_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """Doubts about the language, and instructions that the plan neither answers nor declines."""
    yield from _language_warning(document["command"])
    if document["tasks"]:
        yield from _instruction_warnings(document, vocabulary)
    planned, spoken = {task["title"] for task in document["tasks"]}, language(vocabulary)
    texts = [*document.get("constraints", ()), *document.get("assumptions", ())]
    declined = " ".join(text for text in texts if spoken.words["declined"].search(text)).casefold()
    clauses = read_clauses(document["command"], vocabulary)
    gone = {ask for ask in spoken.asks if _withdrawn(ask, clauses, spoken)}
    yield from _planned_still(document, gone, clauses, spoken)
    yield from _unasked(document, spoken)
    for clause in clauses:
        for words, start in _unanswered(clause, planned, spoken, gone, vocabulary):
            if words.casefold() not in declined:
                asked = quoted(clause.text[start:])
                text = f'The command asks: "{asked}"; no task of the plan does that.'
                yield warning("not-planned", text, about=words.casefold())


def _language_warning(command: str) -> Iterator[Warning]:
    if text := other_language(command):
        yield warning("unknown-language", text)


def other_language(command: str) -> str | None:
    """A sentence on a command that is not English, as far as can be told from its words."""
    unknown, share = unknown_words(command)
    if share < UNKNOWN:
        return None
    listed = ", ".join(f'"{word}"' for word in unknown[:3])
    text = f"Most words of the command are not known ({listed}): it is not English, or is"
    return f"{text} misspelt, and the plan is what could be read."


def _withdrawn(ask: Ask, clauses: Sequence[Clause], spoken: Language) -> str | None:
    """The words that rule a task out, where nothing behind them asks for it again. An ask without
    nouns is of several things: what rules one of them out leaves the others.
    """
    if ask.named.pattern == ask.said.pattern:
        return None
    last = None
    for clause in (one for one in clauses if not one.corrected):
        for match in ask.named.finditer(clause.text):
            before = clause.text[max(0, match.start() - NEAR) : match.start()]
            ruled_out = spoken.words["exclusion"].search(before)
            if ruled_out and clause.excluded is not None and clause.excluded >= clause.start:
                last = quoted(clause.text.strip(" ,;"))
            else:
                last = None
    return last


def _planned_still(
    document: Mapping[str, Any], gone: set[Ask], clauses: Sequence[Clause], spoken: Language
) -> Iterator[Warning]:
    """A task that the command takes back at last, and that the plan has."""
    for ask in (one for one in gone if len(one.tasks) == 1):
        own = [task for task in document["tasks"] if task["title"] in ask.tasks]
        words = _withdrawn(ask, clauses, spoken)
        if len(own) == 1 and words:
            text = f'The command says "{words}", and {named(own[0])} is in the plan.'
            yield warning("contradiction", text, own[0], about=words.casefold())


def _unasked(document: Mapping[str, Any], spoken: Language) -> Iterator[Warning]:
    """Tasks that nobody asks for without words for them, of which the command has none."""
    if unknown_words(document["command"])[1] >= UNKNOWN:
        return
    told = " ".join(document["command"].split())
    for ask in (one for one in spoken.asks if one.sure and not one.sure.search(told)):
        for task in (one for one in document["tasks"] if one["title"] in ask.tasks):
            text = f"{named(task)}: no words of the command ask for it."
            yield warning("value-not-said", text, task, about="asked")


def _unanswered(
    clause: Clause, planned: set[str], spoken: Language, gone: set[Ask], vocabulary: Vocabulary
) -> Iterator[tuple[str, int]]:
    """(words, where in the clause) that ask for an unplanned task, or one that is impossible."""
    if clause.corrected:
        return
    sends = any(ask.sends and ask.said.search(clause.text) for ask in spoken.asks)
    for ask in (one for one in spoken.asks if one not in gone):
        match = ask.said.search(clause.text)
        if match and any(vocabulary.task[title].docks for title in ask.tasks):
            match = match if not _is_noun(clause.text, match.start(), spoken) else None
        # Data to be sent is named by how it came about, which may be long ago: "send the panorama".
        missing = not ask.tasks & planned and (ask.sends or not sends)
        if match and missing and clause.wants(clause.start + match.start()):
            yield match[0], match.start()
    impossible = spoken.words["impossible"].match(clause.text.lstrip())
    # A plan without tasks says itself why.
    if planned and impossible and clause.wants(clause.start):
        yield impossible[0], 0


def _is_noun(text: str, start: int, spoken: Language) -> bool:
    """Whether a word stands behind an article and two other words at most: "the dry dock"."""
    before = text[:start].split()[-ARTICLE:]
    return any(spoken.words["determiner"].fullmatch(word) for word in before)


# ---------------------------------------------------------------- instructions in other words


def _instruction_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """Instructions beyond the plan's tasks that none of them speaks of, and home asked for and
    ruled out.
    """
    text, spoken = without_geographic(frame_of(document).spoken), language(vocabulary)
    clauses, tasks = read_clauses(text, vocabulary), document["tasks"]
    instructions = [clause for clause in clauses if _instructs(clause, spoken)]
    if len(instructions) > _own_tasks(tasks, vocabulary):
        steps = [step for task in tasks for step in task.get("skill_sequence") or ()]
        owners = [*tasks, *(skill for step in steps for _role, skill in step_skills(step))]
        parts = [document.get("constraints", ()), document.get("assumptions", ())]
        parts += [[task["task_prompt"] for task in tasks]]
        parts += [list(owner["parameters"].values()) for owner in owners]
        planned = compact_json(parts).casefold()
        for clause in instructions:
            yield from _lost_instruction(clause, spoken, planned)
    yield from _home_and_not(clauses, spoken, document, vocabulary)


def _instructs(clause: Clause, spoken: Language) -> bool:
    """Whether a clause begins with an instruction that stands, other than to come home."""
    begins = spoken.words["verb"].match(clause.text.strip())
    stands = begins is not None and not clause.corrected and clause.excluded is None
    return stands and not spoken.words["home"].search(clause.text)


def _own_tasks(tasks: Sequence[Mapping[str, Any]], vocabulary: Vocabulary) -> int:
    """The tasks that such an instruction stands for: not those that look for a place, go to one for
    the task behind them, or go home.
    """
    behind = [vocabulary.task[task["title"]].arrival for task in tasks[1:]] + ["none"]
    return sum(
        task["title"] != vocabulary.locate
        and place_of(task, vocabulary) != vocabulary.home
        and not (task["title"] == vocabulary.transit and arrival == "transit")
        for task, arrival in zip(tasks, behind, strict=True)
    )


def _lost_instruction(clause: Clause, spoken: Language, planned: str) -> Iterator[Warning]:
    """An instruction of which no word and no fact is in the text of a plan."""
    text = clause.text.strip()
    verb = spoken.words["verb"].match(text)
    known = [
        spoken.words["impossible"],
        spoken.words["home"],
        spoken.words["here"],
        spoken.sensors,
        spoken.words["stay"],
    ]
    known += [ask.said for ask in spoken.asks]
    if not verb or read_numbers(text):
        return
    if any(words.search(text) for words in known):
        return
    said_words = re.findall(r"[a-z]{4,}", text[verb.end() :].casefold())
    empty = [spoken.words[name] for name in ("nothing", "water", "boundary", "determiner")]
    nouns = [word for word in said_words if not any(one.fullmatch(word) for one in empty)]
    if nouns and not any(word[:STEM] in planned for word in said_words):
        said = f'The command asks: "{quoted(text)}"; no task of the plan does that.'
        yield warning("not-planned", said, about=text.casefold())


def _home_and_not(
    clauses: Sequence[Clause], spoken: Language, document: Mapping[str, Any], vocabulary: Vocabulary
) -> Iterator[Warning]:
    """A command that asks for home and rules it out, and a plan that ends there."""
    said = [
        (clause.wants(clause.start + match.start()), clause)
        for clause in clauses
        if not clause.corrected
        for match in spoken.words["home"].finditer(clause.text)
    ]
    last = document["tasks"][-1]
    if {wanted for wanted, _clause in said} == {True, False}:
        words = next(clause.text for wanted, clause in said if not wanted).strip(" ,;")
        ends = (
            "ends there" if place_of(last, vocabulary) == vocabulary.home else "does not end there"
        )
        text = f'The command speaks of coming home, and says "{quoted(words)}"; the plan {ends}.'
        yield warning("contradiction", text, about="home")
