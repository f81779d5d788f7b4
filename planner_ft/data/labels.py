"""What labels have: the tags of the curated mission set, one per labelling rule (tags.toml), and
their audit; what labels take from their input, and what they must not: values that nobody stated,
values of the command that the plan has lost, numbers that its texts have made up.
"""

import itertools
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from planner_ft.facts import Input, missing_words, near, read_input, words
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.places import read_positions
from planner_ft.facts.units import in_base_units
from planner_ft.support.files import compact_json, read_toml
from planner_ft.vocabulary import Parameter, Vocabulary
from planner_ft.vocabulary.plans import MISSION_KEYS, plan_names, step_skills, value_problem

Records = Sequence[Mapping[str, Any]]

TAGS: dict[str, dict[str, Any]] = read_toml(Path(__file__).with_name("tags.toml"))
"""By tag what a command with it exercises, and which tasks its record has (tags.toml)."""
WORDS = {
    tag: re.compile(rf"\b(?:{of['words']})\b", re.I) for tag, of in TAGS.items() if "words" in of
}
"""A command with such words may be one with the tag, where records have none."""
TOLD = "rule.told"
UNUSED = frozenset({"rule.correction", "rule.exclusion", "rule.search-on-request", TOLD})
"""Tags of commands that say values which the plan does not take over."""
TURNS = ("turn_to", "turn_by")
ARTICLES = {"the", "a", "an"}
COVERAGE = {"train": (125, 8), "validation": (25, 1), "test": (25, 1)}
"""Records of each split, and how often a title at least; every `which.*` tag occurs once."""


def tags_of(vocabulary: Vocabulary) -> list[str]:
    """The tags that a vehicle's commands can have: those of no task, and of a task that it has."""
    known = vocabulary.task.keys()
    return [tag for tag, of in TAGS.items() if not known.isdisjoint(of.get("tasks", known))]


def unchecked_tags(records: Records, vocabulary: Vocabulary) -> list[str]:
    """Tags of records that are about tasks of other vehicles, so that nothing checks them."""
    used = {tag for record in records for tag in record.get("tags", ())}
    return [tag for tag in TAGS if tag in used and tag not in tags_of(vocabulary)]


def tag_problems(record: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[str]:
    """Unknown tags, and tags that do not agree with the tasks of the expected plan."""
    tags = record.get("tags", [])
    titles = set(plan_names("mission", record.get("expected")))
    for tag in tags:
        of = TAGS.get(tag, {})
        needed = [title for title in of.get("tasks", ()) if title in vocabulary.task]
        needed += [getattr(vocabulary, of["role"])] if "role" in of else []
        if not of:
            yield f"tag {tag!r} is not known"
        elif needed and titles.isdisjoint(needed):
            yield f"tag {tag} needs {' or '.join(needed)} in the plan"
    if len(set(tags)) != len(tags):
        yield "a tag stands twice"
    for tag, of in TAGS.items():
        if of.get("always") in titles and tag not in tags:
            yield f"{of['always']} is in the plan, but the tag {tag} is not"
    if ("rule.empty" in tags) != (not titles):
        yield "the tag rule.empty and an empty task list go together"


def coverage_problems(splits: Mapping[str, Records], vocabulary: Vocabulary) -> list[str]:
    """What a curated mission set lacks per split, and families and prompts that cross splits."""
    problems = [
        f"{split}: {len(splits[split])} records, {count} are expected"
        for split, (count, _least) in COVERAGE.items()
        if len(splits[split]) != count
    ]
    for split, (_count, least) in COVERAGE.items():
        plans = (plan_names("mission", record["expected"]) for record in splits[split])
        found = Counter(name for names in plans for name in names)
        problems += [
            f"{split}: {task.title} occurs {found[task.title]} times, {least} are needed"
            for task in vocabulary.tasks
            if found[task.title] < least
        ]
    for split, records in splits.items():
        tags = {tag for record in records for tag in record.get("tags", [])}
        which = (tag for tag in tags_of(vocabulary) if tag.startswith("which."))
        missing = (tag for tag in which if tag not in tags)
        problems += [f"{split}: no record has the tag {tag}" for tag in missing]
    for key in ("family", "prompt"):
        homes: dict[str, str] = {}
        for split, records in splits.items():
            for value in dict.fromkeys(str(record[key]) for record in records):
                if homes.setdefault(value, split) != split:
                    problems.append(f"{key} {value!r} is in {homes[value]} and in {split}")
    return problems


# ---------------------------------------------------------------- values


def unstated(
    value: Any, parameter: Parameter, source: Input, said: str, where: str, *, misspelt: bool = True
) -> Iterator[str]:
    """Why a value does not come from what was said."""
    if parameter.type in ("number", "integer"):
        # Turning left is a negative angle, and is said without the sign.
        if [source.evidence(number, parameter).given for number in (value, -value)] == [False] * 2:
            unit = f" {parameter.unit}" if parameter.unit else ""
            yield f"{value!r}{unit} does not follow from {where}"
    elif parameter.type == "position":
        if source.evidence(value, parameter).given is False:
            yield f"the coordinates {value!r} are not in {where}"
    elif parameter.type in ("text", "id", "texts"):
        for text in value if isinstance(value, list) else [str(value)]:
            # Telegrams leave articles out.
            found = missing_words(said, text, misspelt=misspelt)
            if missing := [word for word in found if word not in ARTICLES]:
                hint = "" if misspelt else " (spelling put right needs the tag param.spelling)"
                yield f"{', '.join(map(repr, missing))} of {text!r} not in {where}{hint}"
            if ARTICLES & set(words(text)[:1]):
                yield f"{text!r} begins with an article"
            if text != text.strip() or text[-1:] in ".,;:!?":
                yield f"{text!r} ends or begins with a blank or punctuation"


def step_problems(record: dict[str, Any], vocabulary: Vocabulary) -> Iterator[str]:
    """What breaks a labelling rule in the expected skill sequence of a task record: a value is
    written only where the prompt states it or refers to a task parameter. Waypoints are computed,
    and so are turns in equal steps; they are not checked, and invalid values are passed over.
    """
    parameters, source = record.get("parameters"), read_input(record, vocabulary)
    given = parameters.values() if isinstance(parameters, dict) else ()
    said = " ".join([str(record["prompt"]), *map(str, given)])
    sequence = record["expected"].get("skill_sequence")
    steps = [list(step_skills(step)) for step in (sequence if isinstance(sequence, list) else ())]
    moves = (entry for step in steps for role, entry in step if role == "navigation")
    often = Counter(str(entry.get("name")) for entry in moves)
    for index, step in enumerate(steps):
        entries = [entry for _role, entry in step]
        for place, entry in enumerate(entries):
            skill = vocabulary.skill.get(str(entry.get("name")))
            values = entry.get("parameters", {})
            if skill is None or not isinstance(values, dict):
                continue
            where = f"skill_sequence[{index}] {skill.name}"
            if entry in entries[:place]:
                yield f"{where}: stands twice in the step with the same parameters"
            computed = skill.motion in TURNS and often[skill.name] > 2
            for name, value in values.items() if skill.motion != "goto" and not computed else ():
                known = skill.by_name.get(name)
                if known is not None and not value_problem(value, known):
                    found = unstated(value, known, source, said, "the prompt or a task parameter")
                    yield from (f"{where}, {name}: {problem}" for problem in found)


# ---------------------------------------------------------------- the texts of a plan


def completeness_problems(record: dict[str, Any], vocabulary: Vocabulary) -> Iterator[str]:
    """What is missing in a record of a mission whose plan is strictly valid."""
    expected, tasks, prompt = record["expected"], record["expected"]["tasks"], record["prompt"]
    for index, task in enumerate(tasks):
        if not task["task_prompt"].strip():
            yield f"expected: tasks[{index}] {task['title']}: task_prompt is empty"
    if not tasks and not expected["constraints"]:
        yield "expected: an empty task list needs a constraint that says why"
    values = [value for task in tasks for value in task["parameters"].values()]
    if list(vocabulary.unresolved) in values and not expected["assumptions"]:
        yield "expected: a plan with an unresolved place needs an assumption about it"
    for index, (task, following) in enumerate(itertools.pairwise(tasks)):
        if (task["title"], task["parameters"]) == (following["title"], following["parameters"]):
            yield f"expected: tasks[{index + 1}] {task['title']}: the same task again"
    yield from _invented_numbers(expected, prompt, vocabulary)
    tags = record.get("tags")
    if isinstance(tags, list) and tasks and not UNUSED & set(map(str, tags)):
        for lost in _lost_values(expected, values, prompt, vocabulary):
            yield f"expected: {lost} in no parameter and no constraint; if it is told and not asked for, tag {TOLD} says so"


def _invented_numbers(plan: dict[str, Any], prompt: str, vocabulary: Vocabulary) -> Iterator[str]:
    """Numbers in the plan's texts that neither the command nor a parameter has."""
    tasks = plan["tasks"]
    texts = {f"tasks[{index}].task_prompt": task["task_prompt"] for index, task in enumerate(tasks)}
    for key in MISSION_KEYS[1:]:
        texts |= {f"{key}[{index}]": text for index, text in enumerate(plan[key])}
    given = [[task["parameters"] for task in tasks], vocabulary.home, vocabulary.unresolved]
    numbers = (*read_numbers(prompt), *read_numbers(compact_json(given)))
    known = {abs(number) for found in numbers for number in (found.value, found.said)}
    for where, text in texts.items():
        for found in read_numbers(text):
            in_figures = text[found.start : found.end].lstrip("-−–")[:1].isdigit()
            if in_figures and not {abs(found.said), abs(found.value)} & known:
                value = f"{found.said:g}"
                yield f"expected: {where}: {value} is neither in the command nor in a parameter"


def _lost_values(
    expected: dict[str, Any], values: list[Any], prompt: str, vocabulary: Vocabulary
) -> Iterator[str]:
    """Quantities with a unit, and coordinates in brackets, of the command that the plan lacks. "A
    day" and "an hour" may be sayings and are passed over.
    """
    flat = [one for value in values for one in (value if isinstance(value, list) else [value])]
    numbers = [number for number in flat if isinstance(number, int | float)]
    for task in expected["tasks"]:
        known = vocabulary.task[task["title"]].by_name
        numbers += in_base_units(task["parameters"], known)
    for text in (*expected["assumptions"], *expected["constraints"]):
        numbers += [found.value for found in read_numbers(text)]
    for found in read_numbers(prompt):
        said = prompt[found.start : found.end]
        saying = words(said)[:1] in (["a"], ["an"])
        if found.unit and not saying and not any(near(one, found.value) for one in numbers):
            yield f"{said!r} of the command stands"
    for place in read_positions(prompt):
        stated = [place.x, place.y] in values or {place.x, place.y} <= set(numbers)
        if prompt[place.start - 1 : place.start] in ("[", "(") and not stated:
            said = prompt[place.start : place.end]
            yield f"the coordinates {said!r} of the command stand"
