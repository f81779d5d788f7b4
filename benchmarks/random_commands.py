"""Plans of random commands: nothing crashes, no place is invented, no number is lost in silence.

    python benchmarks/random_commands.py [--count 1000] [--seed 1] [--out FILE]

Commands are put together of mission words, numbers and clauses, a third of them with their words
shuffled. For each plan: places of tasks stand in the command, waypoints lie at them or within the
sizes of their task, every number of the command is in the plan, or a warning says so; tasks and
steps stay within their bounds. Prints each violation and the counts.
"""

from __future__ import annotations

import argparse
import math
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import Any

from planner_ft.decoding.constraints.grammar import MOST_STEPS, MOST_TASKS
from planner_ft.document import build
from planner_ft.document.warnings import NOTES
from planner_ft.planning.planner import Planner
from planner_ft.planning.settings import PlanSettings
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json

VERBS = [
    "go to",
    "survey",
    "circle",
    "hold at",
    "inspect",
    "drift at",
    "take a panorama at",
    "map",
    "run along",
    "never enter",
    "keep off",
    "avoid",
    "film",
    "report on",
    "return via",
]
THINGS = [
    "the buoy",
    "the quay",
    "the wreck",
    "the north side",
    "the cable",
    "the barge",
    "a grid",
    "the depths",
    "video",
    "the pier",
    "home",
    "the divers",
    "it",
    "the second one",
]
JOINTS = [", ", " and ", ". Then ", " but ", "; ", " or rather ", " while ", " no, ", " before "]
MEASURES = [
    ("{} m", 1),
    ("{} metres off", 1),
    ("for {} minutes", 60),
    ("for {} s", 1),
    ("at {} m/s", 1),
    ("within {} m", 1),
    ("radius {}", 1),
    ("{} m lines", 1),
    ("heading {} degrees", 1),
    ("at most {} minutes", 60),
]
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
SLACK = 25.0
"""Metres round a place that stand-offs and the vehicle's own distances take."""


def random_command(rng: Random) -> tuple[str, list[tuple[str, float]]]:
    """A command, and its measures as (words, value in SI units)."""
    parts, numbers = list[str](), list[tuple[str, float]]()
    for _ in range(rng.randint(1, 5)):
        clause = [rng.choice(VERBS), rng.choice(THINGS)]
        if rng.random() < 0.7:
            clause.append(f"at {rng.randint(-200, 200)},{rng.randint(-200, 200)}")
        for _ in range(rng.choice((0, 1, 1, 2))):
            form, factor = rng.choice(MEASURES)
            number = rng.randint(2, 90)
            clause.append(form.format(number))
            numbers.append((str(number), float(number * factor)))
        parts.append(" ".join(clause))
    text = parts[0] + "".join(rng.choice(JOINTS) + part for part in parts[1:])
    if rng.random() < 0.33:
        words = text.split()
        at = rng.randrange(len(words))
        words[at:] = rng.sample(words[at:], len(words) - at)
        text, numbers = " ".join(words), []
    return text, numbers


def violations(
    command: str, numbers: list[tuple[str, float]], plan: dict[str, Any]
) -> Iterator[tuple[str, str]]:
    """(kind, what) of everything that a plan must not be."""
    warnings = [one for one in plan["warnings"] if one["kind"] not in NOTES]
    warned = {one["task"] for one in warnings}
    said = [float(number) for number in NUMBER.findall(command)]
    if len(plan["tasks"]) > MOST_TASKS:
        yield "bounds", f"{len(plan['tasks'])} tasks"
    here = (0.0, 0.0)
    for task in plan["tasks"]:
        steps = task.get("skill_sequence") or []
        if len(steps) > MOST_STEPS:
            yield "bounds", f"{len(steps)} steps"
        values = [value for value in task["parameters"].values() if isinstance(value, list)]
        places = [
            value for value in values if len(value) == 2 and isinstance(value[0], int | float)
        ]
        for place in (place for place in places if place not in ([0, 0], [-99, -99])):
            here = (place[0], place[1])
            if not {*place} <= {*said} and task["id"] not in warned:
                yield "invented place", f"{task['title']} {place}"
        sizes = [v for v in task["parameters"].values() if isinstance(v, int | float)]
        reach = max([0.0, *map(float, sizes)]) * math.sqrt(2) + SLACK
        added = {mark["step"] for mark in task.get("added", ()) if mark["kind"] == "clearance"}
        for number, step in enumerate(steps):
            at = step["navigation_skill"]["parameters"]
            if "x" not in at or number in added or task["id"] in warned:
                continue
            if math.dist((at["x"], at["y"]), here) > reach and (at["x"], at["y"]) != (0, 0):
                yield "invented waypoint", f"{task['title']} {at}"
    held = [float(n) for n in NUMBER.findall(compact_json([plan["tasks"], plan["constraints"]]))]
    told = " ".join(one["text"] for one in plan["warnings"])
    for words, value in numbers if plan["tasks"] else ():
        if not {value, float(words)} & {*map(abs, held)} and words not in NUMBER.findall(told):
            yield "lost number", words


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path, help="also write each violation as a line of JSON")
    arguments = parser.parse_args()
    counts, found = Counter[str](), list[str]()
    with Planner(PlanSettings()) as planner:
        for number in range(arguments.count):
            command, numbers = random_command(Random(f"{arguments.seed} {number}"))
            try:
                plan = build(planner.plan(command), planner.vocabulary)
            except PlannerError as problem:
                counts["refused"] += 1
                print(f"refused: {command}: {problem}", flush=True)
                continue
            counts["without a warning"] += not plan["warnings"]
            for kind, what in violations(command, numbers, dict(plan)):
                counts[kind] += 1
                found.append(compact_json([kind, what, command]))
                print(f"{kind}: {what}: {command}", flush=True)
            if arguments.out:
                arguments.out.write_text("".join(f"{line}\n" for line in found), encoding="utf-8")
    print(f"{arguments.count} commands: {dict(counts)}")


if __name__ == "__main__":
    main()
