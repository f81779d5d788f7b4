"""Facts of a command: values that nobody gave, and how far the stated ones come.

A value is grounded when the command states it (at task level the task prompt or the task's
parameters), in any unit and wording, when the vocabulary gives it (home, the unresolved location),
or when it follows from what is stated by arithmetic (points a stated way off; at task level
waypoints of a grid, a square or a ring, angles of equal turns). It need not be the right value: a
value in the wrong place is grounded, too.

A slot is a value of the expected plan that the command states: coordinates, a stand-off, a
duration, a name. A fact that several tasks need is as many slots. A slot has reached the parameters
when the task (or skill) that is aligned with the expected one has the value; the task prompt when
that task's prompt says it, in any unit and wording.

Values are judged by `planner_ft.facts`, which the decoding strength `grounded` holds answers to as
well: the groundedness of `+grounded` configurations is 100 % by construction.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from planner_ft import facts
from planner_ft.benchmark.metrics.alignment import TASK, Alignment, Entries, values_agree
from planner_ft.vocabulary import Parameter, Vocabulary

KINDS = ("coordinates", "lengths", "durations", "speeds", "angles", "numbers", "names")
BY_UNIT = {"m": "lengths", "s": "durations", "m/s": "speeds", "deg": "angles"}


@dataclass(frozen=True)
class Given:
    """A value of an entry (its index) with the parameter that it is for."""

    entry: int
    parameter: Parameter
    value: Any


Slots = dict[str, list[int]]
"""Per kind of slot, how many are stated, reached the parameters and (missions) the task prompt."""


def groundedness(
    entries: Entries, source: facts.Input, vocabulary: Vocabulary
) -> tuple[int, list[Given]]:
    """How many values of a plan's entries can be judged, and those of them that nobody gave; where
    the input cannot be read with certainty, none.
    """
    judged, ungrounded, before = 0, list[Given](), list[tuple[float, float]]()
    for given in given_values(entries, vocabulary):
        verdict = source.evidence(given.value, given.parameter, facts.SCORING, before).given
        judged += verdict is not None
        ungrounded += [given] if verdict is False else []
        if given.parameter is facts.WAYPOINT:
            before.append((given.value[0], given.value[1]))
    return judged, ungrounded


def given_values(entries: Entries, vocabulary: Vocabulary) -> Iterator[Given]:
    """Every value; a destination's coordinates are one, unknown parameters are judged by form."""
    for index, entry in enumerate(entries):
        skill = vocabulary.skill.get(entry.name) if entry.role != TASK else None
        pair = [item.name for item in skill.coordinates] if skill else []
        numbers = [entry.parameters.get(name) for name in pair]
        together = len(pair) == 2 and all(map(facts.is_number, numbers))
        if together:
            yield Given(index, facts.WAYPOINT, numbers)
        known = entry.known(vocabulary)
        for name, value in entry.parameters.items():
            if not (together and name in pair):
                yield Given(index, known.get(name) or _by_form(name, value), value)


def _by_form(name: str, value: Any) -> Parameter:
    """A parameter of the type that a value has."""
    if facts.is_number(value):
        return Parameter(name, "number")
    if isinstance(value, list):
        return Parameter(name, "position" if facts.is_place(value) else "texts")
    return Parameter(name, "text")


def _slot_kind(parameter: Parameter) -> str:
    """What a slot is, by the type and unit of its parameter."""
    if parameter.type in ("position", "polygon"):
        return "coordinates"
    if parameter.type in ("number", "integer"):
        return BY_UNIT.get(parameter.unit or "", "numbers")
    return "names"


def slot_propagation(
    plan: Any, alignment: Alignment, source: facts.Input, vocabulary: Vocabulary
) -> Slots:
    """Follow every slot of the expected plan into the answer; without a partner it is lost."""
    partner = dict(alignment.pairs)
    there = {
        (given.entry, given.parameter.name): given.value
        for given in given_values(alignment.predicted, vocabulary)
    }
    reached: Slots = {}
    for slot in given_values(alignment.expected, vocabulary):
        # Home, the unresolved location and derived waypoints are no slots.
        if not source.stated(slot.value, slot.parameter, facts.SCORING).given:
            continue
        counts = reached.setdefault(_slot_kind(slot.parameter), [0, 0, 0])
        counts[0] += 1
        if slot.entry not in partner:
            continue
        place = partner[slot.entry], slot.parameter.name
        counts[1] += place in there and values_agree(
            there[place], slot.value, slot.parameter, vocabulary, loose=True
        )
        if (found := alignment.predicted[place[0]]).role == TASK:
            prompt = plan["tasks"][found.step].get("task_prompt")
            counts[2] += isinstance(prompt, str) and _says(prompt, slot)
    return {kind: reached[kind] for kind in KINDS if kind in reached}


def _says(prompt: str, slot: Given) -> bool:
    """Whether a task prompt states a value: in any unit and wording, of a text every word."""
    if _slot_kind(slot.parameter) != "names":
        return facts.read(prompt).evidence(slot.value, slot.parameter, facts.SCORING).given is True
    wanted = slot.value if isinstance(slot.value, list) else [slot.value]
    texts = (facts.normalised(str(one)) for one in wanted)
    return not any(facts.missing_words(prompt, text, misspelt=False) for text in texts)
