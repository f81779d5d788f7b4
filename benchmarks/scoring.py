"""How fast scoring is on one core, and what the time goes to.

    python benchmarks/scoring.py [--level mission|task] [--count N] [--data FILE] \
        [--profile] [--write DIR]

Expected plans come from the task sampler, or from `--data`; the predictions are those plans,
damaged in ways that real answers are: tasks lost, added, renamed, swapped, values changed, text
cut. Processor time is counted. `--write` keeps the data and the predictions for `plannerft score`.
"""

from __future__ import annotations

import argparse
import cProfile
import json
import pstats
import random
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from planner_ft.benchmark.figures import summarise
from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.scoring import score_sample
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.support.files import read_jsonl, write_jsonl
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level, check_level, list_key, named_entries

Plan = dict[str, Any]


def drop(entries: list[Any], rng: random.Random) -> None:
    """An entry is left out."""
    del entries[rng.randrange(len(entries))]


def repeat(entries: list[Any], rng: random.Random) -> None:
    """An entry stands twice."""
    entries.insert(rng.randrange(len(entries)), rng.choice(entries))


def swap(entries: list[Any], rng: random.Random) -> None:
    """Two entries change places."""
    first, second = rng.randrange(len(entries)), rng.randrange(len(entries))
    entries[first], entries[second] = entries[second], entries[first]


def damaged(level: Level, expected: Plan, vocabulary: Vocabulary, rng: random.Random) -> str:
    """The text of an answer: every second one right, the others wrong in one way or two, some no
    JSON.
    """
    plan: Plan = json.loads(json.dumps(expected))
    entries = plan[list_key(level)]
    for _ in range(rng.choice((0, 0, 1, 1, 2)) if entries else 0):
        ways: tuple[Callable[[list[Any], random.Random], None], ...] = (drop, repeat, swap)
        kind = rng.randrange(5)
        if kind < 3:
            if entries:
                ways[kind](entries, rng)
        elif kind == 3 and entries:
            rename(level, rng.choice(entries), vocabulary, rng)
        else:
            change(level, plan, rng)
    text = json.dumps(plan)
    return text[: rng.randrange(len(text))] if rng.random() < 0.03 else text


def rename(level: Level, entry: Plan, vocabulary: Vocabulary, rng: random.Random) -> None:
    """A task or navigation skill gets another name of the vocabulary, seldom an invented one."""
    names = list(vocabulary.task if level == "mission" else vocabulary.skill)
    name = "Invented" if rng.random() < 0.2 else rng.choice(names)
    if level == "mission":
        entry["title"] = name
    else:
        entry["navigation_skill"] = {**entry["navigation_skill"], "name": name}


def change(level: Level, plan: Plan, rng: random.Random) -> None:
    """A parameter is lost or gets another value."""
    owners = [parameters for _name, parameters in named_entries(level, plan) if parameters]
    if owners:
        parameters = rng.choice(owners)
        key = rng.choice(list(parameters))
        if rng.random() < 0.5:
            del parameters[key]
        else:
            parameters[key] = [-99, -99] if isinstance(parameters[key], list) else 7


def records(
    level: Level, count: int, data: Path | None, vocabulary: Vocabulary
) -> list[dict[str, Any]]:
    """`count` records: sampled tasks, or those of a file, over and over under new ids."""
    if data is None and level == "task":
        return list(sample_tasks(vocabulary, 1, count, "train"))
    given = read_jsonl(data or Path(f"data/{level}/train.jsonl"))
    return [{**given[index % len(given)], "id": f"s{index}"} for index in range(count)]


def main() -> None:
    """Score `count` damaged plans and print the rate."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--level", default="task")
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--data", type=Path)
    parser.add_argument("--profile", action="store_true")
    parser.add_argument("--write", type=Path, metavar="DIR")
    options = parser.parse_args()
    level, vocabulary, rng = check_level(options.level), load_vocabulary(), random.Random(0)
    data = records(level, options.count, options.data, vocabulary)
    samples = [
        Sample(str(record["id"]), str(record.get("family") or record["id"]), record)
        for record in data
    ]
    predictions = {
        sample.id: {"id": sample.id, "output": damaged(level, sample.expected, vocabulary, rng)}
        for sample in samples
    }
    if options.write:
        options.write.mkdir(parents=True, exist_ok=True)
        write_jsonl(options.write / "data.jsonl", data)
        write_jsonl(options.write / "predictions.jsonl", list(predictions.values()))
    warm = [
        score_sample(level, sample, predictions[sample.id], vocabulary) for sample in samples[:20]
    ]
    summarise([one.to_json() for one in warm], seed=0)
    profiler = cProfile.Profile()
    start = time.process_time()
    if options.profile:
        profiler.enable()
    scores = [score_sample(level, sample, predictions[sample.id], vocabulary) for sample in samples]
    scored = time.process_time() - start
    metrics = summarise([one.to_json() for one in scores], seed=0)
    profiler.disable()
    seconds = time.process_time() - start
    print(
        f"{len(samples) / scored:,.0f} samples scored per second of one core ({len(samples)} in"
        f" {scored:.2f} s)"
    )
    print(f"figures and intervals of {len(metrics)} metrics in {seconds - scored:.2f} s")
    print(f"F1 {metrics['f1'].value:.3f}, whole plan right {metrics['whole_plan'].value:.3f}")
    if options.profile:
        pstats.Stats(profiler).sort_stats("cumulative").print_stats(30)


if __name__ == "__main__":
    main()
