"""Slot propagation: how far the facts that a command states come, from the command to the skills.

A slot is a value of the expected plan that the command states (at task level the task prompt or the
task's parameters): coordinates, a stand-off, a duration, a name. A fact that several tasks need is
as many slots. A slot has reached

- the parameters, when the task (or skill) that is aligned with the expected one has the value;
- the task prompt, when that task's prompt says it, in any unit and wording;
- the skills, in the two-agent pipeline (`skill_slots`), when they carry it out: as a skill's
  parameter, or as geometry.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.benchmark.metrics.alignment import Alignment
from planner_ft.benchmark.metrics.entries import Entry
from planner_ft.benchmark.metrics.groundedness import Given, given_values
from planner_ft.benchmark.metrics.values import normalised, values_agree
from planner_ft.facts import SCORING, Input, missing_words, read
from planner_ft.vocabulary import Parameter, Vocabulary
from planner_ft.vocabulary.plans import Level

KINDS = ("coordinates", "lengths", "durations", "speeds", "angles", "numbers", "names")
BY_UNIT = {"m": "lengths", "s": "durations", "m/s": "speeds", "deg": "angles"}


@dataclass(frozen=True)
class Reached:
    """Per kind of slot, how many the input states and how many of them reached the parameters, and
    the task prompt (mission level).
    """

    stated: Counter[str]
    in_parameters: Counter[str]
    in_prompt: Counter[str]


def slot_kind(parameter: Parameter) -> str:
    """What a slot is, by the type and unit of its parameter."""
    if parameter.type in ("position", "polygon"):
        return "coordinates"
    return (
        BY_UNIT.get(parameter.unit or "", "numbers")
        if parameter.type in ("number", "integer")
        else "names"
    )


def stated_slots(
    level: Level, expected: Sequence[Entry], source: Input, vocabulary: Vocabulary
) -> list[Given]:
    """The values of an expected plan that the input states; home, the unresolved location and
    derived waypoints are none.
    """
    return [
        given
        for given in given_values(level, expected, vocabulary)
        if source.stated(given.value, given.parameter, SCORING).given
    ]


def slot_propagation(
    level: Level, plan: Any, alignment: Alignment, source: Input, vocabulary: Vocabulary
) -> Reached:
    """Follow every slot of the expected plan into the answer; a slot of an expected entry without a
    partner is lost.
    """
    partner = dict(alignment.pairs)
    there = {
        (given.entry, given.parameter.name): given.value
        for given in given_values(level, alignment.predicted, vocabulary)
    }
    reached = Reached(Counter(), Counter(), Counter())
    for slot in stated_slots(level, alignment.expected, source, vocabulary):
        kind = slot_kind(slot.parameter)
        reached.stated[kind] += 1
        if slot.entry not in partner:
            continue
        place = partner[slot.entry], slot.parameter.name
        reached.in_parameters[kind] += place in there and values_agree(
            there[place], slot.value, slot.parameter, vocabulary, loose=True
        )
        if level == "mission":
            reached.in_prompt[kind] += prompt_says(
                task_prompt(plan, alignment.predicted[place[0]]), slot
            )
    return reached


def task_prompt(plan: Any, entry: Entry) -> str:
    """The task prompt of a task of a mission plan; empty where it has none."""
    prompt = plan["tasks"][entry.step].get("task_prompt")
    return prompt if isinstance(prompt, str) else ""


def prompt_says(prompt: str, slot: Given) -> bool:
    """Whether a task prompt states a value: a number in any unit and wording, coordinates as a
    pair, every word of a text.
    """
    if slot_kind(slot.parameter) != "names":
        found = read(prompt).evidence(slot.value, slot.parameter, SCORING)
        return bool(prompt) and found.given is True
    texts = slot.value if isinstance(slot.value, list) else [slot.value]
    return all(not missing_words(prompt, normalised(str(text)), misspelt=False) for text in texts)
