"""What a mission plan lacks of its command and what it has too much, counted: for a second look at
it (planner_ft.decoding.second_look).
"""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Any

from planner_ft.data.quantities import positions
from planner_ft.decoding.constraints.reading.missions.apart import PLACE
from planner_ft.decoding.constraints.reading.missions.homeward import home_meant, no_way_home
from planner_ft.decoding.constraints.reading.missions.spoken import SAYS
from planner_ft.document.against import forbidden
from planner_ft.document.language import language
from planner_ft.document.lost import lost_values
from planner_ft.document.said import read_command
from planner_ft.document.warnings.command import unanswered
from planner_ft.vocabulary import Vocabulary

_PLACED = r"[\s,:]{0,2}(?:(?:at|around|about|near|by|on|centred on) )?"
"""What stands between a thing and its coordinates."""
_SEARCH = re.compile(
    r"\b(?:find(?:ing)?\b(?! the (?:hot|warm))|search\w*|locat\w*|look(?:ing)?"
    r" (?:for|around)|hunt\w*|seek\w*|(?<!hot )(?<!hot-)(?<!est )(?<!est-)spot|"
    r"detect\w*|sweep for|where)\b",
    re.IGNORECASE,
)
_ANOTHER = re.compile(
    r"\b(?:another|other|second|also|both|two|one more|any|each|every|different|all)\b",
    re.IGNORECASE,
)
_WORK = re.compile(
    r"\b(?:inspection|survey|report|panorama|check|self-test|time"
    r" lapse|orbit|transit|berthing|docking|scan|sounding|soundings)$"
)
_AGAIN = re.compile(
    r"\b(?:again|another|each|every|both|twice|two|three|thrice|times|likewise|repeat\w*|second|once"
    r" more|too|also|same|as well|either|all|ditto"
    r"|before and after)\b",
    re.IGNORECASE,
)
_SEVERAL = re.compile(
    r":|,? and (?:the|an?|at|one|on|of|for|to|then) |\b(?:ones?|then|before|after|when|as soon"
    r" as|metres and|meters and)\b",
    re.IGNORECASE,
)
"""What may stand before a second target."""
_OFTEN = {"FeatureStare", "SearchAndDetect", "FollowTarget"}
"""Tasks that one verb asks for with several targets."""
_ONCE = {
    "Diagnostics": re.compile(
        r"\b(?:ch(?:e|c)\w*k\w*|chk\w*|diag\w*|test\w*|self-test\w*|health|verif\w*|prov\w*)\b",
        re.IGNORECASE,
    ),
    "AutoGenerateReportSummary": re.compile(
        r"\b(?:rep\w*t\w*|rpt\w*|summ\w*|brief\w*|account\w*)\b", re.IGNORECASE
    ),
}
"""Tasks that are done once in a mission, and the words that ask for them: a second time is asked
for apart, or by a word for it.
"""


def count_lacking(command: str, answer: str, vocabulary: Vocabulary) -> int | None:
    """How many stated values and instructions no task of a plan in JSON answers, how many tasks
    stand in it for another, and how many no word asks for.

    Task prompts and constraints do not count: what only they say is not carried out. None where
    there is no task, or where the command cannot be read with certainty.
    """
    try:
        tasks = json.loads(answer)["tasks"]
    except ValueError:
        return None
    said = read_command(command, vocabulary)
    if said.unread or not tasks:
        return None
    titles = {task["title"] for task in tasks}
    found = (
        lost_values(said, tasks, (), vocabulary),
        unanswered(command, titles, vocabulary),
        _repeated(tasks, vocabulary),
        _groundless(command, titles, vocabulary),
        _searched_for_nothing(command, tasks, vocabulary),
        _searched_again(command, tasks, vocabulary),
        _returned(command, tasks, vocabulary),
        _again(command, [task["title"] for task in tasks], set(_repeated(tasks, vocabulary))),
        forbidden(command, tasks, vocabulary),
    )
    return sum(1 for items in found for _item in items)


def _groundless(command: str, titles: Iterable[str], vocabulary: Vocabulary) -> Iterator[str]:
    """The titles of tasks that no word of the command can mean."""
    hints = language(vocabulary).hints
    yield from (title for title in titles if title in hints and not hints[title].search(command))


def _searched_for_nothing(
    command: str, tasks: Sequence[Mapping[str, Any]], vocabulary: Vocabulary
) -> Iterator[str]:
    """What is searched for although the command says where it is, and does not ask for a search:
    "the tide gauge at [-14, 22] ... the gauge".
    """
    if _SEARCH.search(command):
        return
    before = [
        command[: start - 1].lower()
        for _x, _y, start, _end in positions(command)
        if command[start - 1 : start] in ("[", "(")
    ]
    for task in tasks:
        described = (
            [str(value).lower() for value in task["parameters"].values()]
            if task["title"] == vocabulary.locate
            else []
        )
        for text in described:
            named = re.search(
                rf"\b(?:that|this|it)(?: is|['’]s) (?:the |an? |our )?{re.escape(text)}\b",
                command,
                re.IGNORECASE,
            )
            placed = any(re.search(rf"\b{re.escape(text)}{_PLACED}$", piece) for piece in before)
            if placed or (named and any(len(piece) < named.start() for piece in before)):
                yield text


def _searched_again(
    command: str, tasks: Sequence[Mapping[str, Any]], vocabulary: Vocabulary
) -> Iterator[str]:
    """What was found before under its full name ("the sunken lighter ... the lighter"), and what is
    no thing but work ("for the inspection").
    """
    before: list[str] = []
    for task in tasks:
        described = (
            [str(value).lower() for value in task["parameters"].values()]
            if task["title"] == vocabulary.locate
            else []
        )
        for text in described:
            if _WORK.search(text) or (
                any(f" {text} " in f" {other} " and text != other for other in before)
                and not _ANOTHER.search(command)
            ):
                yield text
        before += described


def _returned(
    command: str, tasks: Sequence[Mapping[str, Any]], vocabulary: Vocabulary
) -> Iterator[str]:
    """The way home, where the command rules it out or speaks of home in another sense alone
    ("before you leave home").
    """
    home = [
        task
        for task in tasks
        if list(vocabulary.home) in task["parameters"].values()
        and task["title"] == vocabulary.transit
    ]
    if home and ((home[-1] is tasks[-1] and no_way_home(command)) or not home_meant(command)):
        yield home[-1]["title"]


def _again(command: str, titles: Sequence[str], repeated: Collection[str]) -> Iterator[str]:
    """The titles of tasks that stand in the plan twice, and in the command once; not those that are
    known to be repeated.
    """
    if _AGAIN.search(command):
        return
    yield from (
        title
        for title, asked in _ONCE.items()
        if titles.count(title) > 1 and len(asked.findall(command)) < 2
    )
    # What is spoken of once, at one place, is done once.
    asked_once = SAYS.keys() - _OFTEN - _ONCE.keys() - set(repeated)
    alone = len(PLACE.findall(command)) < 2 and not _SEVERAL.search(command)
    yield from (
        title
        for title in dict.fromkeys(titles)
        if alone
        and title in asked_once
        and titles.count(title) > 1
        and len(SAYS[title].findall(command)) == 1
    )


def _repeated(tasks: Sequence[Mapping[str, Any]], vocabulary: Vocabulary) -> Iterator[str]:
    """The titles of tasks that were done at the same place just so before."""
    place: list[float] | None = None
    searches, seen = 0, set[tuple[str, str, str, int]]()
    for task in tasks:
        parameter = vocabulary.task[task["title"]].position_parameter
        searches += task["title"] == vocabulary.locate
        place = task["parameters"].get(parameter, place) if parameter else place
        key = (task["title"], json.dumps(task["parameters"], sort_keys=True), str(place), searches)
        if key in seen and task["title"] != vocabulary.transit:
            yield task["title"]
        seen.add(key)
