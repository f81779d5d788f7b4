"""A long command in parts: its sentences are planned a few at a time, and their plans put together.

A small model leaves instructions of a long command out that it plans one by one.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

from planner_ft.confidence.calibration import Judgement
from planner_ft.confidence.parts import Path
from planner_ft.planning.result import Answer
from planner_ft.support.files import compact_json

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


def joined(answers: Sequence[Answer]) -> Answer:
    """Valid answers to the parts of a command as one; a text that several have stands once."""
    plans = [answer.plan or {} for answer in answers]
    plan: dict[str, Any] = {"tasks": [task for one in plans for task in one["tasks"]]}
    for key in ("assumptions", "constraints"):
        plan[key] = list(dict.fromkeys(text for one in plans for text in one[key]))
    notes = dict.fromkeys(note for answer in answers for note in answer.notes)
    told = (*notes, IN_PARTS.format(count=len(answers)))
    one = replace(answers[0], text=compact_json(plan), plan=plan, notes=told)
    one = replace(one, cut=any(answer.cut for answer in answers), judged=_judged(answers))
    return with_costs(one, answers[1:])


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


def _judged(answers: Sequence[Answer]) -> Judgement:
    """How sure the agent is of the tasks of several plans, and of all as if each were wrong for
    itself.
    """
    if reasons := [answer.judged.reason for answer in answers if answer.judged.reason]:
        return Judgement(reasons[0])
    parts: dict[Path, float] = {(): 1.0}
    others, before = dict[Path, tuple[tuple[str, float], ...]](), 0
    for answer in answers:
        for path, held in answer.judged.parts.items():
            if path[:1] == ("tasks",):
                at = ("tasks", int(path[1]) + before, *path[2:])
                parts[at] = held
                others |= {at: answer.judged.others[path]} if path in answer.judged.others else {}
        parts[()] *= answer.judged.parts[()]
        before += len((answer.plan or {})["tasks"])
    return Judgement("", parts, others)
