"""How often right plans raise a warning, and how often a planted mistake does.

    python benchmarks/plan_warnings.py --json benchmarks/results/plan_warnings.json

The expected plans of data/mission and data/task are right: a serious warning about one is a false
alarm. Each planted mistake is made in every place of every plan where it can be made, one at a
time; it is found when a serious warning appears that the right plan does not have. `by` counts the
kinds that found it. Synthetic commands, of a seed that nothing was developed on, are harder: they
correct themselves, look back and speak of other things; no mistakes are planted in their plans.
"""

from __future__ import annotations

import argparse
import copy
import time
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from planner_ft.data.missions import sample_missions
from planner_ft.document.build import revise
from planner_ft.document.vehicle import load_vehicle
from planner_ft.document.warnings import KINDS, SERIOUS
from planner_ft.facts import corrections
from planner_ft.support.files import read_jsonl, write_json
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import step_skills

USV = load_vocabulary()
SEED = 23
SAMPLED = Path("data/task/train.jsonl")
COUNTED = {
    "mission": tuple(
        kind for kind in SERIOUS if kind not in ("unresolved-location", "no-skills", "left-out")
    ),
    "task": ("skill-value-not-said", "out-of-reach"),
}
"""Serious kinds that say that something is wrong. An open place, missing skills and what the vehicle
has no task for are facts of a right plan, too; a task apart from its mission, with parameters that its prompt does not repeat and
a boundary that the sampler draws anywhere, can be judged by its skills alone.
"""
Document = dict[str, Any]
Plant = Callable[[Document], Iterator[Document]]


def of_mission(record: dict[str, Any]) -> Document:
    """The document of an expected mission plan, its skills left empty."""
    tasks = [
        {"id": f"t{number}", **task, "skill_sequence": []}
        for number, task in enumerate(record["expected"]["tasks"], 1)
    ]
    return {
        **_document(record["prompt"], tasks),
        "assumptions": record["expected"]["assumptions"],
        "constraints": record["expected"]["constraints"],
    }


def of_task(record: dict[str, Any]) -> Document:
    """The document of one task with its expected skills; the task prompt is the command."""
    task = {
        "id": "t1",
        "title": record["task"],
        "parameters": record["parameters"],
        "task_prompt": record["prompt"],
    }
    return _document(
        record["prompt"], [{**task, "skill_sequence": record["expected"]["skill_sequence"]}]
    )


def _document(command: str, tasks: list[dict[str, Any]]) -> Document:
    vehicle = load_vehicle(None, USV).as_json()
    return {
        "command": command,
        "vehicle": vehicle,
        "tasks": tasks,
        "located": {},
        "assumptions": [],
        "constraints": [],
        "edits": [],
    }


def raised(document: Document) -> dict[str, str]:
    """The warnings of a document: kind by id. What is proposed is what it holds."""
    revised = revise({**document, "proposed": copy.deepcopy({"tasks": document["tasks"]})}, USV)
    return {item["id"]: item["kind"] for item in revised["warnings"]}


# ---------------------------------------------------------------- mistakes


def _without(title: str | None) -> Plant:
    def plant(document: Document) -> Iterator[Document]:
        for index, task in enumerate(document["tasks"]):
            if title in (None, task["title"]):
                yield {
                    **document,
                    "tasks": [*document["tasks"][:index], *document["tasks"][index + 1 :]],
                }

    return plant


def _without_return(document: Document) -> Iterator[Document]:
    last = document["tasks"][-1] if len(document["tasks"]) > 1 else None
    if last and last["parameters"].get("target_position") == list(USV.home):
        yield {**document, "tasks": document["tasks"][:-1]}


def _changed(types: tuple[str, ...], change: Callable[[Any], Any]) -> Plant:
    """Every parameter of these types changed, where it is no home and no open place."""

    def plant(document: Document) -> Iterator[Document]:
        for index, task in enumerate(document["tasks"]):
            for name, value in task["parameters"].items():
                if USV.task[task["title"]].by_name[name].type in types and value not in (
                    list(USV.home),
                    list(USV.unresolved),
                ):
                    changed = copy.deepcopy(document)
                    changed["tasks"][index]["parameters"][name] = change(value)
                    yield changed

    return plant


def _invented(document: Document) -> Iterator[Document]:
    """A number for a parameter that the command leaves open."""
    for index, task in enumerate(document["tasks"]):
        for parameter in USV.task[task["title"]].parameters:
            if parameter.type == "number" and parameter.name not in task["parameters"]:
                changed = copy.deepcopy(document)
                changed["tasks"][index]["parameters"][parameter.name] = 17
                yield changed


def _long_hold(document: Document) -> Iterator[Document]:
    for index, task in enumerate(document["tasks"]):
        if "duration" in task["parameters"]:
            step = {
                "navigation_skill": {"name": "StationKeep", "parameters": {"time": 36000}},
                "filter_skills": [],
                "perception_skills": [],
            }
            changed = copy.deepcopy(document)
            changed["tasks"][index]["parameters"]["duration"] = 36000
            changed["tasks"][index]["skill_sequence"] = [step]
            yield changed


def _skill_number(change: Callable[[Any], Any], names: tuple[str, ...], *, among: bool) -> Plant:
    """The first number of a task's skills among `names`, or none of them, changed."""

    def plant(document: Document) -> Iterator[Document]:
        changed = copy.deepcopy(document)
        for step in changed["tasks"][0]["skill_sequence"]:
            for _role, skill in step_skills(step):
                for name, value in skill["parameters"].items():
                    if isinstance(value, int | float) and (name in names) == among:
                        skill["parameters"][name] = change(value)
                        yield changed
                        return

    return plant


MISSION: dict[str, Plant] = {
    "a task is dropped": _without(None),
    "the search is forgotten": _without(USV.locate),
    "a transit is forgotten": _without(USV.transit),
    "the return is forgotten": _without_return,
    "a number is changed by half": _changed(
        ("number", "integer"), lambda value: max(1, round(value * 1.5))
    ),
    "a number is changed by one": _changed(("number", "integer"), lambda value: value + 1),
    "a position is 10 m off": _changed(("position",), lambda value: [value[0] + 10, value[1]]),
    "x and y are swapped": _changed(
        ("position",), lambda value: [value[1], value[0] + (value[0] == value[1])]
    ),
    "a position is 50 km away": _changed(("position",), lambda _value: [50_000, 0]),
    "another target is named": _changed(("text",), lambda _value: "purple lighthouse"),
    "a value is invented": _invented,
    "a hold lasts ten hours": _long_hold,
}
TASK: dict[str, Plant] = {
    "a skill's number is changed by half": _skill_number(
        lambda value: round(value * 1.5) + 1, ("x", "y"), among=False
    ),
    "a waypoint is 13 m off": _skill_number(lambda value: value + 13, ("x", "y"), among=True),
    "a waypoint is 500 km away": _skill_number(lambda _value: 500_000, ("x", "y"), among=True),
}


# ---------------------------------------------------------------- figures


def false_alarms(documents: list[Document], counted: tuple[str, ...]) -> dict[str, Any]:
    """Per kind the right plans that have a warning of it, and those that have a serious one."""
    plans = [set(raised(document).values()) for document in documents]
    counts = Counter(kind for kinds in plans for kind in kinds)
    shown = [
        kind
        for kind in KINDS
        if counts[kind] and (kind in counted or counted == COUNTED["mission"])
    ]
    return {
        "plans": len(plans),
        "plans with a false alarm": sum(not kinds.isdisjoint(counted) for kinds in plans),
        "kinds": {kind: counts[kind] for kind in shown},
    }


def detections(
    documents: list[Document], plants: dict[str, Plant], counted: tuple[str, ...]
) -> dict[str, Any]:
    """Per mistake how often it was made and found, and by which kinds."""
    figures: dict[str, Any] = {}
    before = [raised(document) for document in documents] if plants else []
    for name, plant in plants.items():
        made, found, by = 0, 0, Counter[str]()
        for document, known in zip(documents, before, strict=True):
            for changed in plant(document):
                if changed["tasks"] == document["tasks"]:
                    continue
                new = {
                    kind
                    for key, kind in raised(changed).items()
                    if key not in known and kind in counted
                }
                made, found = made + 1, found + bool(new)
                by.update(new)
        figures[name] = {"made": made, "found": found, "by": dict(by.most_common())}
    return figures


def speed(count: int, records: list[dict[str, Any]]) -> dict[str, float]:
    """Processor seconds of a revision of `count` tasks that were never read, and of the next
    one.
    """
    tasks = [
        {**of_task(record)["tasks"][0], "id": f"t{number}"}
        for number, record in enumerate(records[:count], 1)
    ]
    document = {
        **_document(" ".join(record["prompt"] for record in records[:count]), tasks),
        "proposed": {"tasks": tasks},
    }
    started = time.process_time()
    revised = revise(document, USV)
    first = time.process_time()
    revise(revised, USV)
    return {
        "tasks": count,
        "letters of the command": len(document["command"]),
        "first": round(first - started, 3),
        "next": round(time.process_time() - first, 3),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", type=Path, help="also write the figures into this file")
    arguments = parser.parse_args()
    if not SAMPLED.is_file():
        parser.error(f"{SAMPLED}: no such file; write it with `plannerft gen-data --level task`")
    corrections("thrml")  # Reads the word lists once.
    sampled = read_jsonl(SAMPLED)
    speed(1, sampled[1000:])  # Reads the word files once.
    results: dict[str, Any] = {
        "false alarms": {},
        "detected": {},
        "seconds": [speed(10, sampled[500:]), speed(500, sampled)],
    }
    for timed in results["seconds"]:
        print(timed)
    for level, split, records, plants, build in (
        ("mission", "train", read_jsonl("data/mission/train.jsonl"), MISSION, of_mission),
        ("mission", "validation", read_jsonl("data/mission/validation.jsonl"), MISSION, of_mission),
        ("mission", f"synthetic, seed {SEED}", list(sample_missions(SEED, 500)), {}, of_mission),
        ("task", "validation", read_jsonl("data/task/validation.jsonl"), TASK, of_task),
    ):
        documents = [build(record) for record in records]
        name = f"{level}, {split}"
        results["false alarms"][name] = alarms = false_alarms(documents, COUNTED[level])
        results["detected"][name] = detected = detections(
            [document for document in documents if document["tasks"]], plants, COUNTED[level]
        )
        print(
            f"\n{name}: {alarms['plans with a false alarm']} of {alarms['plans']} right plans have"
            " a serious warning"
        )
        for kind, count in alarms["kinds"].items():
            print(f"  {kind:24} {count:4} {'serious' if kind in COUNTED[level] else ''}")
        for mistake, figure in detected.items():
            print(f"  {mistake:38} {figure['found']:4} of {figure['made']:4}  {figure['by']}")
    if arguments.json:
        write_json(arguments.json, results)


if __name__ == "__main__":
    main()
