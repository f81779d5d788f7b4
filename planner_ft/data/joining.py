"""Two mission samples as one: a command behind another, and the plan of both.

Recombined samples teach a model that has seen a hundred commands of a vehicle to go on behind the
first order (Jia and Liang 2016, arXiv:1606.03622). It works for any vehicle.
"""

from __future__ import annotations

from random import Random
from typing import Any

from planner_ft.data.rules import rule_problems
from planner_ft.vocabulary import Vocabulary

LINKS = (". Then ", ". After that ", ", then ", "; then ", ". Next, ", ". ")
MOST_TASKS = 7


def joined(
    first: dict[str, Any], second: dict[str, Any], vocabulary: Vocabulary, rng: Random
) -> dict[str, Any] | None:
    """A record that asks for both plans in this order; None where the labelling rules do not allow
    it, one of them rules something out, or both speak of one thing.
    """
    plans = [record["expected"] for record in (first, second)]
    tasks = [task for plan in plans for task in plan["tasks"]]
    if not all(plan["tasks"] for plan in plans) or any(plan["constraints"] for plan in plans):
        return None
    if len(tasks) > MOST_TASKS or _named(plans[0], vocabulary) & _named(plans[1], vocabulary):
        return None
    link, behind = rng.choice(LINKS), second["prompt"].strip()
    if link != ". " and behind[1:2].islower():
        behind = behind[0].lower() + behind[1:]
    assumptions = [text for plan in plans for text in plan["assumptions"]]
    expected = {"tasks": tasks, "assumptions": assumptions, "constraints": []}
    known = sum(len(rule_problems(plan, vocabulary)) for plan in plans)
    if len(rule_problems(expected, vocabulary)) > known:
        return None
    prompt = first["prompt"].strip().rstrip(".!") + link + behind
    return {**first, "prompt": prompt, "expected": expected}


def _named(plan: dict[str, Any], vocabulary: Vocabulary) -> set[str]:
    """The things and known places of a plan."""
    values = [value for task in plan["tasks"] for value in task["parameters"].values()]
    open_places = (list(vocabulary.home), list(vocabulary.unresolved))
    return {str(value) for value in values if isinstance(value, str | list)} - {
        str(place) for place in open_places
    }
