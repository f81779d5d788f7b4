"""A long command in parts: its sentences are planned a few at a time, and their plans put together.

A small model leaves instructions of a long command out that it plans one by one.
"""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from planner_ft.confidence.calibration import Judgement
from planner_ft.confidence.parts import Path
from planner_ft.planning.result import Answer
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.replay import START, sound

MOST_WORDS = 25
"""Words of the sentences that are planned together."""
SENTENCE = re.compile(r"(?<=[.;!?])\s+|\n+")
IN_PARTS = (
    "The command was planned in {count} parts: the plan of the whole had left out more of it."
)


def parts_of(command: str) -> list[str]:
    """The sentences of a command, as many together as have few words."""
    parts = list[str]()
    for sentence in filter(str.strip, SENTENCE.split(command)):
        longer = f"{parts[-1]} {sentence}" if parts else sentence
        if parts and len(longer.split()) <= MOST_WORDS:
            parts[-1] = longer
        else:
            parts.append(sentence)
    return parts


def joined(answers: Sequence[Answer], vocabulary: Vocabulary) -> Answer:
    """Valid answers to the parts of a command as one; a text that several have stands once, and no
    way leads to where the vehicle is.
    """
    plans = [answer.plan or {} for answer in answers]
    every = [
        ((number, at), task)
        for number, one in enumerate(plans)
        for at, task in enumerate(one["tasks"])
    ]
    idle = _idle([task for _from, task in every], vocabulary)
    kept = [one for at, one in enumerate(every) if at not in idle]
    plan: dict[str, Any] = {"tasks": [task for _from, task in kept]}
    for key in ("assumptions", "constraints"):
        plan[key] = list(dict.fromkeys(text for one in plans for text in one[key]))
    notes = dict.fromkeys(note for answer in answers for note in answer.notes)
    told = (*notes, IN_PARTS.format(count=len(answers)))
    judged = _judged(answers, [at for at, _task in kept])
    one = replace(answers[0], text=compact_json(plan), plan=plan, notes=told, judged=judged)
    return with_costs(replace(one, cut=any(answer.cut for answer in answers)), answers[1:])


def _idle(tasks: Sequence[Mapping[str, Any]], vocabulary: Vocabulary) -> set[int]:
    """The transits to where the vehicle is: home, at the beginning."""
    found, progress = set[int](), replace(START, here=vocabulary.home)
    for at, task in enumerate(tasks):
        known, given = vocabulary.task[task["title"]], task["parameters"]
        place = given.get(known.position_parameter or "")
        here = None if progress.moved or progress.found else progress.here
        if known.title == vocabulary.transit and place and tuple(place) == here:
            found.add(at)
        progress = progress.after(known, sound(given, known), vocabulary)
    return found


def with_costs(answer: Answer, others: Iterable[Answer]) -> Answer:
    """The answer with what others have cost, too."""
    every = [answer, *others]
    return replace(
        answer,
        prompt_tokens=sum(one.prompt_tokens for one in every),
        tokens=sum(one.tokens for one in every),
        forward_passes=sum(one.forward_passes for one in every),
        seconds=sum(one.seconds for one in every),
    )


def _judged(answers: Sequence[Answer], kept: Sequence[tuple[int, int]]) -> Judgement:
    """How sure the agent is of the tasks of several plans that are kept, by answer and task, and of
    all as if each plan were wrong for itself.
    """
    if reasons := [answer.judged.reason for answer in answers if answer.judged.reason]:
        return Judgement(reasons[0])
    parts: dict[Path, float] = {(): math.prod(one.judged.parts[()] for one in answers)}
    others = dict[Path, tuple[tuple[str, float], ...]]()
    for place, (number, at) in enumerate(kept):
        judged = answers[number].judged
        for path in (one for one in judged.parts if one[:2] == ("tasks", at)):
            moved = ("tasks", place, *path[2:])
            parts[moved] = judged.parts[path]
            others |= {moved: judged.others[path]} if path in judged.others else {}
    return Judgement("", parts, others)
