"""What a plan does against its command: tasks that it rules out, an order that it forbids, places
that it says of something else.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from planner_ft.data.quantities import positions
from planner_ft.data.rules import DOCKING
from planner_ft.decoding.constraints.reading.missions.apart import SENTENCE, sentences
from planner_ft.decoding.constraints.reading.missions.orders import ONLY_THEN, asked, read_orders
from planner_ft.decoding.constraints.reading.missions.searches import MOVES, SEARCH, THERE
from planner_ft.decoding.constraints.reading.missions.spoken import SAYS
from planner_ft.vocabulary import Vocabulary

_TOLD_BY_LACK = {"GlareFreeApproach", "SearchAndDetect"}
"""What is asked for by what there is not to be: "without glare"."""
_DONE_ONCE = {"Diagnostics", "AutoGenerateReportSummary"}
_NO = re.compile(
    r"\b(?:no|not|don['’]?t|without|skip|never|neither|needn['’]?t)\b(?!"
    r" (?:only|until|before|forget|later|less|more))(?: (?!but\b)[a-z'-]+){0,3} $",
    re.IGNORECASE,
)
_OURSELVES = re.compile(
    r"\b(?:I|we)(?:['’]ll| will| shall)\b[^.;,]{0,40}\b(?:myself|ourselves)\b", re.IGNORECASE
)
_CONDITION = re.compile(
    r"\b(?:until|till|before|unless|prior|yet|but|rather|only|reason|if|may|without a|next"
    r" time|earlier|first|sure)\b",
    re.IGNORECASE,
)
"""Words of sentences that may ask for a task by ruling something out."""
_DOCK = re.compile(
    r"\b(?:doc?k|bert|moor|along"
    r" ?side|tie\b|tied|tying|slip|park|lay|laid|harbo|marina|cradle|ramp|come in|bring (?:\w+"
    r" ){1,2}in|fast|garage|basin|quay|wharf|"
    r"jett|pontoon|stage|landing|in\b|home|return|back)",
    re.IGNORECASE,
)
"""Words for a way to a berth whose place is not stated; that a pier is spoken of is none."""
_BESIDE, _BEFORE = 40, 6
"""Characters between what is followed and where it is, and between that place and what is
followed.
"""


def forbidden(
    command: str, tasks: Sequence[Mapping[str, Any]], vocabulary: Vocabulary
) -> Iterator[str]:
    """The titles of what a plan does against its command."""
    yield from _denied(command, {task["title"] for task in tasks})
    yield from _out_of_order(command, [task["title"] for task in tasks])
    yield from _found_there(command, tasks, vocabulary)
    yield from _placed_elsewhere(command, tasks, vocabulary)
    unknown = list(vocabulary.unresolved)
    docked = [
        task["title"]
        for task in tasks
        if vocabulary.task[task["title"]].pattern == DOCKING
        and unknown in task["parameters"].values()
    ]
    yield from () if _DOCK.search(command) else docked


def _denied(command: str, titles: set[str]) -> Iterator[str]:
    """Tasks that a command speaks of only to rule them out: "no report", "don't circle it", "I will
    write it up myself".
    """
    for title in sorted(titles & set(SAYS) - _TOLD_BY_LACK):
        spoken = [
            (sentence, match)
            for sentence in sentences(command)
            for match in SAYS[title].finditer(sentence)
        ]
        if spoken and all(_ruled_out(sentence, match) for sentence, match in spoken):
            yield title


def _ruled_out(sentence: str, match: re.Match[str]) -> bool:
    if _CONDITION.search(sentence):
        return False
    ours = any(own.start() < match.start() < own.end() for own in _OURSELVES.finditer(sentence))
    return ours or _NO.search(sentence[: match.start()]) is not None


def _out_of_order(command: str, titles: Sequence[str]) -> Iterator[str]:
    """Tasks that stand before one which the command has come first, or without it: "send the log,
    but only once the sensors have been checked".
    """
    told = (
        (titles.index(one), titles.index(two), two)
        for one, two in read_orders(command).titles
        if one in titles and two in titles
    )
    early = dict.fromkeys(title for before, behind, title in told if behind < before)
    yield from early
    for sentence in sentences(command):
        for match in ONLY_THEN.finditer(sentence):
            before, behind = (
                sentence[: match.start()].rpartition(", and ")[2],
                sentence[match.end() :].partition(", and ")[0],
            )
            later, earlier = asked(before), asked(behind)
            if later & earlier:
                continue
            pairs = (
                (one, other)
                for one in later
                for other in earlier
                if titles.count(one) == titles.count(other) == 1
            )
            yield from (
                one
                for one, other in pairs
                if titles.index(one) < titles.index(other) and one not in early
            )
            wanted = later or asked(sentence[: match.start()])
            if earlier <= _DONE_ONCE and not earlier & set(titles) and wanted & set(titles):
                yield from earlier


def _found_there(
    command: str, tasks: Sequence[Mapping[str, Any]], vocabulary: Vocabulary
) -> Iterator[str]:
    """What is searched for although it is where the vehicle is then: "hold at [4, 5] and film the
    hatch while you are there".
    """
    if SEARCH.search(command):
        return
    places = [
        start
        for _x, _y, start, _end in positions(command)
        if command[start - 1 : start] in ("[", "(", "-")
    ]
    starts = [0, *(match.end() for match in SENTENCE.finditer(command)), len(command)]
    for task in tasks:
        text = (
            str(next(iter(task["parameters"].values()), "")).lower()
            if task["title"] == vocabulary.locate
            else ""
        )
        spots = (
            [match.start() for match in re.finditer(rf"\b{re.escape(text)}\b", command.lower())]
            if text
            else []
        )
        if len(spots) == 1:
            first = max(start for start in starts if start <= spots[0])
            last = min(start for start in starts if start > spots[0])
            between = [place for place in places if place < spots[0]]
            if (
                between
                and THERE.search(command, first, last)
                and not MOVES.search(command, max(first, between[-1]), spots[0])
            ):
                yield task["title"]


def _placed_elsewhere(
    command: str, tasks: Sequence[Mapping[str, Any]], vocabulary: Vocabulary
) -> Iterator[str]:
    """A target with a name that is followed from a place which the command says of something
    else.
    """
    for task in tasks:
        known = vocabulary.task[task["title"]]
        name = next(
            (
                str(task["parameters"][item.name])
                for item in known.parameters
                if item.type == "id" and item.name in task["parameters"]
            ),
            "",
        )
        place = task["parameters"].get(known.position_parameter or "")
        if name and place and tuple(place) != tuple(vocabulary.unresolved):
            spots = [
                (start, end) for x, y, start, end in positions(command) if (x, y) == tuple(place)
            ]
            named = [
                match.span()
                for match in re.finditer(rf"\b{re.escape(name)}\b", command, re.IGNORECASE)
            ]
            if (
                spots
                and named
                and not any(
                    0 <= spot[0] - end <= _BESIDE or 0 <= start - spot[1] <= _BEFORE
                    for spot in spots
                    for start, end in named
                )
            ):
                yield task["title"]
