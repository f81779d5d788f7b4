"""Mission samples with other values that command and plan share, and two samples as one.

A model that is trained on a hundred commands of a vehicle learns their values by heart. With other
values in each copy of a command it learns to copy them. Numbers are found by `planner_ft.facts`,
things by the plan's texts (`unfamiliar`), so this works for any vehicle. Recombined samples teach
it to go on behind the first order (Jia and Liang 2016, arXiv:1606.03622).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from random import Random
from typing import Any

from planner_ft.data.numbers import in_words
from planner_ft.data.rules import rule_problems
from planner_ft.data.unfamiliar import replaced, with_unfamiliar_words
from planner_ft.facts.geometry import tidy
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.together import Number
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import is_number, plan_problems

WORDS = 0.6
"""Share of the copies with another thing or name, where there is one."""
TRIES = 8
_FIGURE = re.compile(r"[-−–]?\d+(?:\.\d+)?(?![\w:/.,]*\d)")
_FIGURES = re.compile(r"(?<![\w.\-])-?\d+(?:\.\d+)?(?![\w:/]*\d)")
Said = dict[float, float]
LINKS = (". Then ", ". After that ", ", then ", "; then ", ". Next, ", ". ")
MOST_TASKS = 7


def varied(record: dict[str, Any], vocabulary: Vocabulary, rng: Random) -> dict[str, Any] | None:
    """A mission record with other values in prompt and plan alike; None where it has none."""
    kept = {"prompt": record["prompt"], "expected": record["expected"]}
    changed = _with_other_numbers(kept, vocabulary, rng) or kept
    if rng.random() < WORDS:
        changed = with_unfamiliar_words(changed, vocabulary, rng, own=True) or changed
    if changed is kept or plan_problems("mission", changed["expected"], vocabulary, strict=True):
        return None
    return {**{key: record[key] for key in ("id", "family") if key in record}, **changed}


def _with_other_numbers(
    record: dict[str, Any], vocabulary: Vocabulary, rng: Random
) -> dict[str, Any] | None:
    """The record with all plainly written numbers changed; None where that does not fit."""
    prompt, expected = record["prompt"], record["expected"]
    numbers = read_numbers(prompt)
    own = {float(part) for place in (vocabulary.home, vocabulary.unresolved) for part in place}
    for _ in range(TRIES if numbers else 0):
        drawn: dict[float, float] = {}
        said: Said = {}
        pieces, end, clash = list[str](), 0, False
        for number in numbers:
            written = _written(prompt, number)
            new = number.said
            if written and number.said not in own:
                new = drawn.setdefault(number.said, _drawn(number.said, written, rng))
                text = in_words(int(new)) if written[0].isalpha() else str(tidy(new))
                pieces += [prompt[end : number.start], text]
                end = number.start + len(written)
            # In the plan it stands as it is said, and in the base unit.
            pairs = [(number.said, new)]
            if number.unit and number.factor not in (0.0, 1.0):
                other = new * number.factor + number.added
                pairs.append((round(number.value, 2), round(other, 2)))
            for old, now in pairs:
                clash |= said.setdefault(old, now) != now
        apart = len(set(drawn.values()) | own) == len(drawn) + len(own)
        if clash or not apart or not drawn:
            continue
        values = (task["parameters"] for task in expected["tasks"])
        if any(one not in said and one not in own for one in _numbers_of(list(values))):
            return None
        changed = _changed(expected, said, own, drawn)
        if not plan_problems("mission", changed, vocabulary, strict=True):
            return {"prompt": "".join([*pieces, prompt[end:]]), "expected": changed}
    return None


def _written(prompt: str, number: Number) -> str:
    """The figure or word of a number; empty where it is put together ("half an hour", "14:30")."""
    said = number.said
    if found := _FIGURE.match(prompt, number.start):
        same = float(found[0].replace("−", "-").replace("–", "-")) == said
        return found[0] if same else ""
    word = in_words(int(said)) if said == int(said) and 2 <= said < 100 else ""
    return word if word and prompt.startswith(word, number.start) else ""


def _drawn(said: float, written: str, rng: Random) -> float:
    """Another number of about the same size, as round as the old one."""
    if written[0].isalpha():
        return rng.randrange(2, 13)
    size, decimals = abs(said), len(written.partition(".")[2])
    low, high = size / 2, 2 * size + (5 if size >= 1 and not decimals else 0)
    new = round(rng.uniform(low, high), decimals)
    if not decimals:
        step = 5 if size % 5 == 0 and rng.random() < 0.6 else 1
        new = max(step, step * round(new / step))
    return -new if said < 0 else new


def _numbers_of(value: Any) -> Iterator[float]:
    """The numbers of a plan's parameters."""
    if isinstance(value, dict | list):
        for item in value.values() if isinstance(value, dict) else value:
            yield from _numbers_of(item)
    elif is_number(value):
        yield value


def _changed(expected: dict[str, Any], said: Said, own: set[float], drawn: Said) -> dict[str, Any]:
    """The plan with its numbers changed, in parameters and texts."""

    def changed(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: changed(item) for key, item in value.items()}
        if isinstance(value, list):
            return [changed(item) for item in value]
        return tidy(said.get(value, value)) if is_number(value) else value

    def figure(match: re.Match[str]) -> str:
        value = float(match[0])
        return match[0] if value in own or value not in said else str(tidy(said[value]))

    result = replaced(changed(expected), _FIGURES, figure)
    whole = {old: new for old, new in drawn.items() if old == int(old) and 2 <= min(old, new) < 100}
    words = {in_words(int(old)): in_words(int(new)) for old, new in whole.items() if new < 1000}
    if words:
        words |= {old.capitalize(): new.capitalize() for old, new in words.items()}
        pattern = re.compile(rf"(?<![\w-])(?:{'|'.join(words)})(?![\w-])")
        result = replaced(result, pattern, lambda match: words[match[0]])
    return result  # type: ignore[no-any-return]


# ---------------------------------------------------------------- two samples as one


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
