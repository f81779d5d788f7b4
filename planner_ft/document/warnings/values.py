"""Values that nobody said, and values that the command says and no task has."""

from __future__ import annotations

import bisect
import itertools
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from planner_ft.benchmark.metrics.source import WAYPOINT, source_of
from planner_ft.benchmark.metrics.values import is_number
from planner_ft.data.quantities import Quantity, close, positions, quantities
from planner_ft.document.language import language
from planner_ft.document.said import Piece, Said, is_place, read_command
from planner_ft.document.warnings.clauses import Clause, read_clauses
from planner_ft.document.warnings.warning import Warning, named, warning
from planner_ft.vocabulary import Parameter, Vocabulary
from planner_ft.vocabulary.plans import step_skills

COURSE = re.compile(r"\b(?:heading|bearing|course)(?: of)?\W{1,3}$", re.IGNORECASE)
CLOCK = re.compile(r"\s*(?:o['’]?clock|am\b|pm\b|utc\b|gmt\b|zulu\b|local\b|ago\b)", re.IGNORECASE)
MOMENT = re.compile(r"(?:an? (?:\w+ )?)?(?:second|minute|moment|day)", re.IGNORECASE)
"""Words that are no time to be kept: "a second", "a good day"."""


def value_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """Values of tasks and skills that are the model's own, and stated ones that reached no task."""
    said = read_command(document["command"], vocabulary)
    if said.unread:
        text = "The command has words or numbers that could not be read with certainty; values of the plan are not all checked against it."
        yield warning("unread-command", text)
    for task in document["tasks"]:
        yield from _unsaid(task, said, vocabulary)
        yield from _unsaid_skills(task, _proposed(document, task), said, vocabulary)
    if document["tasks"] and not said.unread:
        yield from _lost(document, said, vocabulary)


def _unsaid(task: Mapping[str, Any], said: Said, vocabulary: Vocabulary) -> Iterator[Warning]:
    known = vocabulary.task[task["title"]].by_name
    for name, source in task.get("sources", {}).items():
        value = task["parameters"][name]
        if source["kind"] == "model" and name in known and said.states(value, known[name]) is False:
            yield warning("value-not-said", f"{named(task)}: {name} is {_shown(value, known[name])}, which the command does not say.", task, name)


# ---------------------------------------------------------------- skills


def _proposed(document: Mapping[str, Any], task: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The steps that the model proposed for a task."""
    tasks = document.get("proposed", {"tasks": ()})["tasks"]
    return next((other["skill_sequence"] or [] for other in tasks if other["id"] == task["id"]), [])


def _unsaid_skills(task: Mapping[str, Any], proposed: list[dict[str, Any]], said: Said, vocabulary: Vocabulary) -> Iterator[Warning]:
    """One warning per skill and parameter of a task. What an operator has changed is not the model's own."""
    steps = task.get("skill_sequence") or []
    if not steps or task.get("stale"):
        return
    source = source_of("task", {"prompt": task["task_prompt"], "task": task["title"], "parameters": task["parameters"]}, vocabulary)
    own = [value for value in task["parameters"].values() if isinstance(value, list)]
    told: set[str] = set()
    for number, step in enumerate(steps):
        edited = number < len(proposed) and step != proposed[number]
        for skill_name, parameter, value in _values(step, vocabulary):
            key = f"{skill_name}.{parameter.name}"
            if key in told or (edited and not _stands(skill_name, parameter, value, proposed[number], vocabulary)) or value in own:
                continue
            if source.gives(value, parameter) is False and said.states(value, _plain(parameter)) is not True:
                told.add(key)
                text = f"{named(task)}: {skill_name} has {parameter.name} {_shown(value, parameter)}, which neither command nor task says or leads to."
                yield {**warning("skill-value-not-said", text, task, about=key), "parameter": parameter.name}


def _values(step: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[tuple[str, Parameter, Any]]:
    """Every value of a step's skills with its parameter; the two coordinates of a destination as one."""
    for _role, skill in step_skills(step):
        known = vocabulary.skill[skill["name"]].by_name
        motion = vocabulary.motion.of(skill["name"])
        pair = [motion.parameters["x"], motion.parameters["y"]] if motion and motion.kind == "go" else []
        if pair and all(is_number(skill["parameters"].get(name)) for name in pair):
            yield skill["name"], WAYPOINT, [skill["parameters"][name] for name in pair]
        for name, value in skill["parameters"].items():
            if name not in pair and name in known:
                yield skill["name"], known[name], value


def _stands(skill_name: str, parameter: Parameter, value: Any, step: Mapping[str, Any], vocabulary: Vocabulary) -> bool:
    return any((skill_name, parameter.name, value) == (name, other.name, proposed) for name, other, proposed in _values(step, vocabulary))


def _plain(parameter: Parameter) -> Parameter:
    return Parameter(parameter.name, "position", "m") if parameter is WAYPOINT else parameter


def _shown(value: Any, parameter: Parameter) -> str:
    text = f"{value:g}" if is_number(value) else str(value)
    return f"{text[:60]}{f' {parameter.unit}' if is_number(value) and parameter.unit not in (None, 'count') else ''}"


# ---------------------------------------------------------------- values that are lost


def _lost(document: Mapping[str, Any], said: Said, vocabulary: Vocabulary) -> Iterator[Warning]:
    """Quantities with a unit, courses and coordinates of the command that stand nowhere in the plan."""
    held, places = _held(document)
    wanted = Wanted(read_clauses(said.command, vocabulary), language(vocabulary).words["correction"])
    for piece in said.pieces:
        for text, values in _stated(piece, wanted):
            if not any(_among(value, held) for value in values):
                yield warning("value-lost", f'The command says "{text}", and no task has it.', about=text.casefold())
        for text, options in _stated_places(piece, wanted):
            known = any(abs(x - a) <= 0.01 and abs(y - b) <= 0.01 for x, y in options for a, b in places)
            if not known and not all(_among(part, held) for part in options[0]):
                yield warning("value-lost", f'The command says "{text}", and no task has it.', about=text.casefold())


def _held(document: Mapping[str, Any]) -> tuple[list[float], list[tuple[float, float]]]:
    """The numbers, sorted, and the places that stand in a plan: in parameters, task prompts, assumptions and constraints."""
    skills = (skill for task in document["tasks"] for step in task.get("skill_sequence") or () for _role, skill in step_skills(step))
    values = [value for owner in (*document["tasks"], *skills) for value in owner["parameters"].values()]
    numbers = {float(number) for value in values for number in _flat(value)}
    places = [(value[0], value[1]) for value in values if isinstance(value, list) and len(value) == 2 and all(map(is_number, value))]
    for text in (*(task["task_prompt"] for task in document["tasks"]), *document.get("assumptions", ()), *document.get("constraints", ())):
        numbers |= {number for quantity in quantities(text) for number in (quantity.value, quantity.said)}
        places += [(x, y) for x, y, _start, _end in positions(text)]
    return sorted(numbers), list(dict.fromkeys(places))


def _flat(value: Any) -> Iterator[float]:
    if is_number(value):
        yield value
    elif isinstance(value, list):
        for item in value:
            yield from _flat(item)


@dataclass(frozen=True)
class Wanted:
    """What of a command counts: not what it rules out, nor what its next words take back."""

    clauses: tuple[Clause, ...]
    correction: re.Pattern[str]

    def at(self, place: int) -> bool:
        """Whether words at this place are wanted."""
        index = bisect.bisect_right(self.clauses, place, key=lambda clause: clause.start) - 1
        clause = self.clauses[index] if index >= 0 else None
        return clause is None or (not clause.corrected and (clause.excluded is None or place < clause.excluded))


def _stated(piece: Piece, wanted: Wanted) -> Iterator[tuple[str, tuple[float, ...]]]:
    """(words, the numbers that they can stand for) of the measures of a text. Counts, ids, parts and times of day are none."""
    found = quantities(piece.text)
    used: set[int] = set()
    for index, quantity in enumerate(found):
        following = found[index + 1] if index + 1 < len(found) else None
        if index in used or not _is_measure(piece.text, quantity) or not wanted.at(piece.offset + quantity.start):
            continue
        if following and following.start - quantity.end <= 30 and wanted.correction.search(piece.text, quantity.end, following.start):
            continue
        values, end = [quantity.value], quantity.end
        if following and quantity.unit == following.unit == "s" and following.start - quantity.end <= 5:
            values.append(quantity.value + following.value)
            used.add(index + 1)
            end = following.end
        elif following and quantity.unit == "s" and following.unit is None and following.start - quantity.end <= 1 and quantity.said:
            # "five minutes forty"
            values.append(quantity.value + following.value * quantity.value / quantity.said / 60)
            end = following.end
        yield piece.text[quantity.start : end], tuple(values)


def _is_measure(text: str, quantity: Quantity) -> bool:
    if CLOCK.match(text, quantity.end) or quantity.unit == "%" or MOMENT.fullmatch(text, quantity.start, quantity.end):
        return False
    return quantity.unit is not None or COURSE.search(text, max(0, quantity.start - 20), quantity.start) is not None


def _stated_places(piece: Piece, wanted: Wanted) -> Iterator[tuple[str, list[tuple[float, float]]]]:
    """(words, what they can stand for) of what certainly are coordinates."""
    for (start, end), group in itertools.groupby(positions(piece.text), key=lambda item: (item[2], item[3])):
        if is_place(piece.text, start, end) and wanted.at(piece.offset + start):
            following = quantities(piece.text[end : end + 40])
            taken_back = following and wanted.correction.search(piece.text[end : end + 40], 0, following[0].start)
            if not taken_back:
                yield piece.text[start:end], [(x, y) for x, y, _start, _end in group]


def _among(value: float, held: list[float]) -> bool:
    """Whether a number is among sorted ones, up to rounding and sign."""
    for number in (value, -value):
        index = bisect.bisect_left(held, number)
        if any(close(number, near) or abs(number - near) <= 1e-4 * abs(number) for near in held[max(0, index - 1) : index + 1]):
            return True
    return False
