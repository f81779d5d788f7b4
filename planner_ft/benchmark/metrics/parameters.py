"""Parameters of the tasks or skills that were predicted: are the stated values right?"""

from __future__ import annotations

import math
import re
from collections import defaultdict
from dataclasses import dataclass
from typing import Any

from planner_ft.vocabulary import Parameter, Vocabulary
from planner_ft.vocabulary.plans import Level, list_key, named_entries, step_skills

RELATIVE = 0.02
"""Tolerance of numbers, relative to the expected value (labelling rules: converted values are allowed 2 %)."""
ABSOLUTE = 0.005
"""Half a unit of the second decimal, to which converted and computed values are rounded."""

Parameters = dict[str, Any]


@dataclass(frozen=True)
class Agreement:
    """Of the expected entries that the answer has, too (`matched`), how many have exactly the expected parameters."""

    right: int
    matched: int


def parameter_agreement(level: Level, plan: dict[str, Any] | None, expected: dict[str, Any], vocabulary: Vocabulary) -> Agreement:
    """Match predicted with expected entries of equal name and compare their parameters.

    Each expected task or skill is matched with at most one predicted of the same name: first with one whose
    parameters agree, then with what is left, in order. Parameters agree when the keys are the same and every value
    is (`values_agree`). Expected entries without a `parameters` object are not compared.
    """
    predicted: dict[str, list[Parameters]] = defaultdict(list)
    for name, parameters in named_entries(level, plan):
        predicted[name].append(parameters)
    right = 0
    unmet: list[str] = []
    for name, parameters in stated_parameters(level, expected):
        agreeing = next((index for index, given in enumerate(predicted[name]) if parameters_agree(level, name, given, parameters, vocabulary)), None)
        if agreeing is None:
            unmet.append(name)
        else:
            predicted[name].pop(agreeing)
            right += 1
    matched = right
    for name in unmet:
        if predicted[name]:
            predicted[name].pop(0)
            matched += 1
    return Agreement(right, matched)


def parameters_agree(level: Level, name: str, given: Parameters, stated: Parameters, vocabulary: Vocabulary) -> bool:
    """Whether two parameter objects of a task or skill have the same keys with agreeing values."""
    owner = vocabulary.task.get(name) if level == "mission" else vocabulary.skill.get(name)
    known = owner.by_name if owner else {}
    return given.keys() == stated.keys() and all(values_agree(given[key], value, known.get(key), vocabulary) for key, value in stated.items())


def values_agree(given: Any, stated: Any, parameter: Parameter | None, vocabulary: Vocabulary) -> bool:
    """Whether a predicted value is the stated one.

    Numbers, also inside positions: within 2 % or half a unit of the second decimal. The unresolved location agrees
    with itself alone. Texts: without regard to case, spacing and a leading article; lists in order; polygons as
    rings, from any corner in either direction. An identifier may be a number or its text.
    """
    if parameter is not None and parameter.type == "polygon":
        return _rings_agree(given, stated, vocabulary)
    if parameter is not None and parameter.type == "id":
        given, stated = str(given), str(stated)
    if isinstance(stated, list):
        if not isinstance(given, list) or len(given) != len(stated) or _is_unresolved(given, vocabulary) != _is_unresolved(stated, vocabulary):
            return False
        return all(values_agree(ours, theirs, None, vocabulary) for ours, theirs in zip(given, stated, strict=True))
    if _is_number(stated):
        return _is_number(given) and math.isclose(given, stated, rel_tol=0, abs_tol=max(RELATIVE * abs(stated), ABSOLUTE) + 1e-9)
    if isinstance(stated, str):
        return isinstance(given, str) and normalised(given) == normalised(stated)
    return bool(type(given) is type(stated) and given == stated)


def normalised(text: str) -> str:
    """A text in lower case, with single spaces and without a leading article."""
    return re.sub(r"^(the|a|an) ", "", " ".join(text.casefold().split()))


def stated_parameters(level: Level, expected: dict[str, Any]) -> list[tuple[str, Parameters]]:
    """Name and parameters of the expected entries that have a `parameters` object, in order."""
    entries = expected[list_key(level)]
    if level == "task":
        entries = [skill for step in entries for _role, skill in step_skills(step)]
    field = "title" if level == "mission" else "name"
    return [(entry[field], entry["parameters"]) for entry in entries if isinstance(entry.get("parameters"), dict)]


def _rings_agree(given: Any, stated: Any, vocabulary: Vocabulary) -> bool:
    if not isinstance(given, list) or not isinstance(stated, list) or len(given) != len(stated):
        return False
    turns = [ring[start:] + ring[:start] for ring in (given, given[::-1]) for start in range(max(len(ring), 1))]
    return any(values_agree(turn, stated, None, vocabulary) for turn in turns)


def _is_unresolved(value: list[Any], vocabulary: Vocabulary) -> bool:
    return value == list(vocabulary.unresolved)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
