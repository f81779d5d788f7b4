"""Limits between the two agents: into every task prompt that lacks them, and not to the Task Agent.

A limit holds for all tasks of the mission or for those that it names. The Task Agent is not asked
for it: planning carries it into the steps as a filter (planner_ft.document.limits).
"""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from planner_ft.facts import read
from planner_ft.facts.geographic import without_geographic
from planner_ft.facts.places import rows_of, written_positions
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.limits import (
    Limit,
    Limits,
    load_limits,
    prompt_sentence,
    read_limit,
    sentence,
    slots,
    written,
)

GENERAL = ("fence", "keep_out_area", "keep_out", "clearance", "distance", "speed")
"""Kinds that are kept for the whole mission when one task prompt has them; the others can be meant
for that task alone.
"""
CORNERS = 3
Plan = Mapping[str, Any]
Row = list[list[float]]
"""Positions, as a command lists them."""
Write = Callable[..., str]
"""How a sentence is written: among the constraints or in a prompt."""
SENTENCE = re.compile(r"(?<=\.)\s+(?=[A-Z])")


def limits_in(texts: list[str], limits: Limits) -> list[Limit]:
    """The limits of sentences, each once."""
    found: list[Limit] = []
    for limit in (read_limit(text, limits) for text in texts):
        if limit and limit not in found:
            found.append(limit)
    return found


def with_limits(plan: Plan, vocabulary: Vocabulary, command: str | None = None) -> dict[str, Any]:
    """The mission plan with its limits in the prompts of all tasks, each sentence once, and those
    that stand in one prompt alone among its constraints; one of some tasks that the prompt of
    another has holds for all. A time of return that the command does not say is left out, and one
    that is a duration is a time to be back within. An area that has a corner twice is the one row
    of the command that has all of its corners, and what is kept off at one place of a row is at the
    others, too, to which no task leads.
    """
    limits = load_limits(vocabulary)
    rows = areas_of(command) if command else []

    def kept(texts: Iterable[str], write: Write) -> list[str]:
        whole = (_whole(text, rows, limits, write) for text in texts)
        return list(_kept(whole, command, limits, write))

    constraints = kept(plan.get("constraints", ()), sentence)
    split = (dict.fromkeys(SENTENCE.split(task["task_prompt"])) for task in plan["tasks"])
    prompts = [kept(texts, prompt_sentence) for texts in split]
    titles = [task["title"] for task in plan["tasks"]]
    told = [*zip(titles, (limits_in(own, limits) for own in prompts), strict=True)]
    constraints = list(dict.fromkeys(_for_all(text, told, limits) for text in constraints))
    stated = limits_in(constraints, limits)
    for limit in limits_in([text for texts in prompts for text in texts], limits):
        if limit.kind in GENERAL and limit not in stated:
            stated.append(limit)
            constraints.append(sentence(limit.kind, limit.values, limits))
    for limit in list(_of_rows(stated, plan["tasks"], command or "")):
        stated.append(limit)
        constraints.append(sentence(limit.kind, limit.values, limits))
    tasks = []
    for task, texts in zip(plan["tasks"], prompts, strict=True):
        own = limits_in(texts, limits)
        lacking = (one for one in stated if one not in own)
        held = (one for one in lacking if holds_for(one, task["title"], plan["tasks"]))
        added = dict.fromkeys(prompt_sentence(one.kind, one.values, limits) for one in held)
        texts = [*texts, *(text for text in added if text not in texts)]
        tasks.append({**task, "task_prompt": " ".join(texts) or task["task_prompt"]})
    return {**plan, "tasks": tasks, "constraints": constraints}


def _for_all(text: str, told: Iterable[tuple[str, list[Limit]]], limits: Limits) -> str:
    """The sentence of a limit; one that tasks of other titles are `told` holds for all."""
    limit = read_limit(text, limits)
    if limit is None or not limit.titles or limit.kind not in GENERAL:
        return text
    others = any(limit in own and not limit.holds_for(title) for title, own in told)
    return sentence(limit.kind, limit.values, limits) if others else text


def with_return(plan: Plan, vocabulary: Vocabulary) -> Plan:
    """The mission plan with the way home behind its last task, where a limit of it says when the
    vehicle is to be back and it ends elsewhere.
    """
    stated = limits_in(list(plan.get("constraints", ())), load_limits(vocabulary))
    back = any(limit.kind == "return" and not limit.titles for limit in stated)
    home, way = list(vocabulary.home), vocabulary.task.get(vocabulary.transit)
    if not back or way is None or last_away(plan["tasks"], vocabulary) is None:
        return plan
    # A way that needs more than its place, such as a height, is left to the warnings.
    if any(item.required and item.name != way.position_parameter for item in way.parameters):
        return plan
    prompt = f"Return home to {written(home)}."
    task = {"title": way.title, "parameters": {way.position_parameter: home}}
    return {**plan, "tasks": [*plan["tasks"], {**task, "task_prompt": prompt}]}


def last_away(tasks: Sequence[Plan], vocabulary: Vocabulary) -> Plan | None:
    """The last task that takes place somewhere, unless that is home or a dock."""
    for task in reversed(tasks):
        known = vocabulary.task[task["title"]]
        docks = known.docks or (known.arrival == "none" and known.pattern == "visual")
        place = task["parameters"].get(known.position_parameter or "")
        if docks or (place and tuple(place) == vocabulary.home):
            return None
        if known.arrival != "none":
            return task
    return None


def holds_for(limit: Limit, title: str, tasks: Iterable[Mapping[str, Any]]) -> bool:
    """Whether a limit of a plan with these tasks is one of a task of this title. A limit of tasks
    that the plan does not have holds for all.
    """
    planned = {task["title"] for task in tasks}
    return limit.holds_for(title) or not planned & {*limit.titles}


def without_limits(prompt: str, vocabulary: Vocabulary) -> str:
    """A task prompt without the sentences that are limits."""
    limits = load_limits(vocabulary)
    kept = [text for text in SENTENCE.split(prompt) if read_limit(text, limits) is None]
    return " ".join(kept) or prompt


def forbidden_skills(prompt: str, vocabulary: Vocabulary) -> set[str]:
    """The skills that break a limit of a task prompt; near a thing only where the task names it."""
    limits = load_limits(vocabulary)
    asked = without_limits(prompt, vocabulary).casefold()
    found = limits_in(SENTENCE.split(prompt), limits)
    holding = [limit for limit in found if limit.values.get("object", "").casefold() in asked]
    return {name for limit in holding for name in limits[limit.kind].forbids}


def kept_off(task: Mapping[str, Any], vocabulary: Vocabulary) -> float:
    """The metres that the limits in a task's prompt keep from what it is done at; 0 without any."""
    prompt, known = task.get("task_prompt", ""), vocabulary.task[task["title"]]
    asked = without_limits(prompt, vocabulary).casefold()
    place, off = task["parameters"].get(known.position_parameter or ""), [0.0]
    for limit in limits_in(SENTENCE.split(prompt), load_limits(vocabulary)):
        at, thing = limit.values.get("position"), limit.values.get("object", "").casefold()
        if at == place if at else thing and thing in asked:
            off.append(limit.values.get("distance", 0.0))
    return max(off)


def time_left(values: Mapping[str, Any]) -> float | None:
    """Seconds to be back within, where a time of return is a duration ("40 minutes")."""
    readings = read(str(values.get("within") or values["time"])).numbers("s")
    return readings[0].value if len(readings) == 1 and readings[0].unit == "s" else None


def _kept(texts: Iterable[str], command: str | None, limits: Limits, write: Write) -> Iterator[str]:
    """Sentences without times of return that the command does not say."""
    for text in texts:
        limit = read_limit(text, limits)
        time = limit.values.get("time") if limit and limit.kind == "return" else None
        if limit is None or time is None:
            yield text
        elif command is None or str(time).casefold() in command.casefold():
            known = {name for form in limits["return"].sentences for name in slots(form)}
            lasts = "within" in known and not limit.titles and time_left(limit.values) is not None
            yield write("return", {"within": time}, limits) if lasts else text


def areas_of(command: str) -> list[Row]:
    """The rows of positions of a command that can be the corners of an area."""
    text = without_geographic(command)
    rows = rows_of(text, written_positions(text))
    return [[[place.x, place.y] for place in row] for row in rows if len(row) >= CORNERS]


def _of_rows(stated: Sequence[Limit], tasks: Sequence[Plan], command: str) -> Iterator[Limit]:
    """The limits of "barges at 40,30 and 80,30, keep 20 m off both", where one place has one."""
    held = [(one, list(one.values["position"])) for one in stated if "position" in one.values]
    known = [place for _limit, place in held]
    known += [value for task in tasks for value in task.get("parameters", {}).values()]
    text = without_geographic(command) if held else ""
    found = written_positions(text)
    said = [[place.x, place.y] for place in found]
    for row in rows_of(text, found):
        places = [[place.x, place.y] for place in row]
        # What is said again elsewhere may have its limit from there.
        own = [one for one, at in held if at in places and said.count(at) == 1]
        if [one.kind for one in own] == ["keep_out"] and not own[0].titles:
            for place in places:
                if place not in known:
                    yield replace(own[0], values={**own[0].values, "position": place})


def _whole(text: str, rows: Sequence[Row], limits: Limits, write: Write) -> str:
    """The sentence of a limit with all corners of its area, where it lacks one or has one twice."""
    limit = read_limit(text, limits)
    corners = limit.values.get("polygon", []) if limit else []
    ends = corners[:-1] if corners[:1] == corners[-1:] else corners
    if limit is None or limit.titles or not ends:
        return text
    meant = [row for row in rows if all(corner in row for corner in ends)]
    if len(meant) != 1:
        return text
    # Positions of the row that stand before or behind all corners are others.
    places = [meant[0].index(corner) for corner in ends]
    all_of_it = all(ends.count(corner) == 1 for corner in ends)
    row = meant[0][min(places) : max(places) + 1] if all_of_it else meant[0]
    lacks = any(ends.count(corner) != 1 for corner in row)
    return write(limit.kind, {"polygon": row}, limits) if lacks else text
