"""Plans of random commands: nothing crashes, no place is invented, no number is lost in silence.

    python benchmarks/random_commands.py [--count 1000] [--batch 20] [--plans PLANS.jsonl]

Commands are put together of mission words, numbers and clauses, a third of them shuffled. Places of
tasks stand in the command, waypoints lie within the sizes of their task, every number is in the
plan or in a warning (or numbers could not be read), tasks and steps are bounded. The agents answer
a batch of commands at a time. With --plans documents are kept, and a later run goes on behind them.
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
from planner_ft.document.track import place_of
from planner_ft.document.warnings import NOTES
from planner_ft.planning.planner import Planner
from planner_ft.planning.result import Answer
from planner_ft.planning.settings import PlanSettings
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, iterate_jsonl
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import Level

WORDS = """\
go to|survey|circle|hold at|inspect|drift at|take a panorama at|map|run along|never enter|keep off|film
the buoy|the quay|the wreck|the north side|the cable|a grid|the depths|video|home|the divers|it
,| and|. Then| but|;| or rather| while| no,| before
{} m|{} metres off|within {} m|radius {}|{} m lines|for {} s|at {} m/s|heading {} degrees
for {} minutes|at most {} minutes"""
VERBS, THINGS, JOINTS, METRES, MINUTES = (line.split("|") for line in WORDS.splitlines())
MEASURES = [*((form, 1) for form in METRES), *((form, 60) for form in MINUTES)]
USV = load_vocabulary()
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
SLACK = 25.0
"""Metres round a place that stand-offs and the vehicle's own distances take."""
NOT_YET = Answer("", None, ("not asked yet",), (), 1, 1, 0, 0.0)


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
    text = parts[0] + "".join(f"{rng.choice(JOINTS)} {part}" for part in parts[1:])
    if rng.random() > 0.33:
        return text, numbers
    return " ".join(rng.sample(text.split(), len(text.split()))), []


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
        place = place_of(task, USV)
        here = place or here
        if place and place != USV.home and not {*place} <= {*said} and task["id"] not in warned:
            yield "invented place", f"{task['title']} {place}"
        sizes = [v for v in task["parameters"].values() if isinstance(v, int | float)]
        reach = max([0.0, *sizes]) * math.sqrt(2) + SLACK
        added = {mark["step"] for mark in task.get("added", ()) if mark["kind"] == "clearance"}
        for at in (
            s["navigation_skill"]["parameters"] for n, s in enumerate(steps) if n not in added
        ):
            goal = (at["x"], at["y"]) if "x" in at else USV.home
            if goal != USV.home and math.dist(goal, here) > reach and task["id"] not in warned:
                yield "invented waypoint", f"{task['title']} {at}"
    held = [float(n) for n in NUMBER.findall(compact_json([plan["tasks"], plan["constraints"]]))]
    if any(one["kind"] == "unread-command" for one in plan["warnings"]):
        return
    told = " ".join(one["text"] for one in plan["warnings"])
    for words, value in numbers if plan["tasks"] else ():
        if not {value, float(words)} & {*map(abs, held)} and words not in NUMBER.findall(told):
            yield "lost number", words


class Ahead:
    """Asks a planner's agents for many commands at once: what is asked is first only noted."""

    def __init__(self, planner: Planner) -> None:
        self.planner, self.ask_all = planner, planner.agents.ask_all
        self.known, self.waiting = dict[str, Answer](), dict[str, tuple[Level, Any]]()
        planner.agents.ask = self.ask  # type: ignore[method-assign]

    def ask(self, level: Level, record: dict[str, Any]) -> Answer:
        key = compact_json([level, record])
        if key not in self.known:
            self.waiting[key] = level, record
        return self.known.get(key, NOT_YET)

    def plans(self, commands: list[str]) -> list[dict[str, Any] | str]:
        """The document of every command, or the refusal: of the mission, then of its tasks."""
        made = list(map(self._plan, commands))
        while self.waiting:
            asked, self.waiting = self.waiting, {}
            for level in {level for level, _record in asked.values()}:
                own = {key: record for key, (of, record) in asked.items() if of == level}
                self.known |= zip(own, self.ask_all(level, list(own.values())), strict=True)
            made = list(map(self._plan, commands))
        self.known.clear()
        return made

    def _plan(self, command: str) -> dict[str, Any] | str:
        try:
            return dict(build(self.planner.plan(command), self.planner.vocabulary))
        except PlannerError as problem:
            return str(problem)


def judged(number: int, plan: dict[str, Any] | str, counts: Counter[str]) -> None:
    """Count and print what is wrong with the plan of a command."""
    command, numbers = random_command(Random(number))
    if isinstance(plan, str):
        counts["refused"] += 1
        print(f"{number}: refused: {command}: {plan}", flush=True)
        return
    counts["without a warning"] += not plan["warnings"]
    for kind, what in violations(command, numbers, plan):
        counts[kind] += 1
        print(f"{number}: {kind}: {what}: {command}", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--batch", type=int, default=20)
    parser.add_argument("--plans", type=Path)
    arguments = parser.parse_args()
    counts, done = Counter[str](), 0
    if arguments.plans and arguments.plans.exists():
        for _line, plan, _problem in iterate_jsonl(arguments.plans):
            judged(done, plan or "no plan", counts)
            done += 1
    with Planner(PlanSettings()) as planner:
        ahead = Ahead(planner)
        for begin in range(done, arguments.count, arguments.batch):
            numbers = range(begin, min(begin + arguments.batch, arguments.count))
            plans = ahead.plans([random_command(Random(number))[0] for number in numbers])
            for number, plan in zip(numbers, plans, strict=True):
                judged(number, plan, counts)
            if arguments.plans:
                with arguments.plans.open("a", encoding="utf-8") as file:
                    file.writelines(f"{compact_json(plan)}\n" for plan in plans)
    print(f"{arguments.count} commands: {dict(counts)}")


if __name__ == "__main__":
    main()
