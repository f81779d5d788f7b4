"""Samples that are made of other samples: two as one, and one at several places.

Recombined samples teach a model to go on behind the first order, and to keep the order in which
things are to be done apart from the one in which they are said (Jia and Liang 2016,
arXiv:1606.03622).
"""

import re
from random import Random
from typing import Any

from planner_ft.data.rules import rule_problems
from planner_ft.facts.geometry import tidy
from planner_ft.vocabulary import Vocabulary

LINKS = (". Then ", ". After that ", ", then ", "; then ", ". Next, ", ". ", "; ", " - ", " > ")
FIRST = (
    *(", but first ", ". Before that, ", ". But before that, ", "; before that "),
    ". First, though, ",
)
"""Links behind which stands what is to be done first."""
BACKWARDS = 0.3
"""Share of the joined samples that have one."""
MOST_TASKS = 7
OFFSETS = (0, 5, 10, 20, 40)
PLACE = re.compile(r"\[(-?[\d.]+), ?(-?[\d.]+)\]|\((-?[\d.]+), ?(-?[\d.]+)\)")


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
    before, behind = first["prompt"].strip(), second["prompt"].strip()
    if backwards := rng.random() < BACKWARDS:
        before, behind = behind, before
    link = rng.choice(FIRST if backwards else LINKS)
    if link != ". " and behind[1:2].islower():
        behind = behind[0].lower() + behind[1:]
    assumptions = [text for plan in plans for text in plan["assumptions"]]
    expected = {"tasks": tasks, "assumptions": assumptions, "constraints": []}
    known = sum(len(rule_problems(plan, vocabulary)) for plan in plans)
    if len(rule_problems(expected, vocabulary)) > known:
        return None
    return {**first, "prompt": before.rstrip(".!") + link + behind, "expected": expected}


def _named(plan: dict[str, Any], vocabulary: Vocabulary) -> set[str]:
    """The things and known places of a plan."""
    values = [value for task in plan["tasks"] for value in task["parameters"].values()]
    open_places = (list(vocabulary.home), list(vocabulary.unresolved))
    return {str(value) for value in values if isinstance(value, str | list)} - {
        str(place) for place in open_places
    }


def at_several(
    record: dict[str, Any], vocabulary: Vocabulary, rng: Random
) -> dict[str, Any] | None:
    """A record that asks for the same at two to four places; None where the plan is more than one
    task with the way to it, or its place does not stand once in the command, in brackets.
    """
    plan, prompt = record["expected"], record["prompt"]
    tasks, found = plan["tasks"], list(PLACE.finditer(prompt))
    transits = [task["title"] == vocabulary.transit for task in tasks]
    if len(found) != 1 or transits not in ([False], [True], [True, False]):
        return None
    place = [tidy(float(part)) for part in found[0].groups() if part]
    has_place = any(place in task["parameters"].values() for task in tasks)
    if not has_place or plan["assumptions"] or plan["constraints"]:
        return None
    places, count = [place], rng.choice((2, 2, 3, 3, 4))
    while len(places) < count:
        steps = (rng.choice((-1, 1)) * rng.choice((*OFFSETS, rng.randint(1, 90))) for _ in place)
        other = [tidy(part + step) for part, step in zip(place, steps, strict=True)]
        places += [other] if other not in places else []
    form = "[{}, {}]" if found[0][0][0] == "[" else "({}, {})"
    *texts, last = (form.format(*one) for one in places)
    said = ", ".join(texts) + rng.choice((" and ", ", then ", ", ")) + last
    made = [
        {
            "title": task["title"],
            "parameters": {
                name: own if value == place else value for name, value in task["parameters"].items()
            },
            "task_prompt": task["task_prompt"].replace(str(place), str(own)),
        }
        for own in places
        for task in tasks
    ]
    prompt = prompt[: found[0].start()] + said + prompt[found[0].end() :]
    return {**record, "prompt": prompt, "expected": {**plan, "tasks": made}}
