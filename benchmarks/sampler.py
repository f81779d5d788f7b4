"""How fast the task sampler is on one core, and what the time goes to.

    python benchmarks/sampler.py [--count N] [--vocabulary FILE] [--profile]
"""

from __future__ import annotations

import argparse
import cProfile
import pstats
import random
import time
from collections import Counter
from collections.abc import Callable
from typing import Any

from planner_ft.data.task import sampler, steps
from planner_ft.support.files import compact_json
from planner_ft.vocabulary.definition import load_vocabulary


def timed(parts: Counter[str], name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    """`function`, its time added to `parts[name]`."""

    def run(*arguments: Any, **options: Any) -> Any:
        start = time.perf_counter()
        try:
            return function(*arguments, **options)
        finally:
            parts[name] += time.perf_counter() - start  # type: ignore[assignment]

    return run


def main() -> None:
    """Sample, serialise, and print samples per second and the share of each part."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--vocabulary", default="usv")
    parser.add_argument("--profile", action="store_true", help="print the functions that take longest")
    options = parser.parse_args()
    vocabulary = load_vocabulary(options.vocabulary)
    next(sampler.sample_tasks(vocabulary, 0, 1, "train"))  # phrases are compiled once
    start = time.perf_counter()
    size = sum(len(compact_json(record)) + 1 for record in sampler.sample_tasks(vocabulary, 1, options.count, "train"))
    total = time.perf_counter() - start
    print(f"{options.count / total:,.0f} validated and serialised samples per second ({options.count} in {total:.2f} s, {size / 1e6:.1f} MB)")
    parts: Counter[str] = Counter()
    for name, place, function in (
        ("draw", sampler, "draw_script"), ("phrasing", sampler, "say_it"), ("plan", sampler, "expected_plan"), ("validation", sampler, "plan_problems"),
        ("geometry", steps, "_step"),
    ):  # fmt: skip
        if name != "geometry":
            setattr(place, function, timed(parts, name, getattr(place, function)))
    for name in ("square", "lawnmower", "circle", "line", "stated_pass"):
        from planner_ft.data.task import geometry

        real = {"square": "survey_square", "line": "straight_line", "stated_pass": "offset"}.get(name, name)
        setattr(geometry, real, timed(parts, "of which geometry", getattr(geometry, real)))
    start = time.perf_counter()
    for record in sampler.sample_tasks(vocabulary, 1, options.count, "train"):
        timed(parts, "serialisation", compact_json)(record)
    whole = time.perf_counter() - start
    for name, seconds in parts.most_common():
        print(f"{name:18} {1e6 * seconds / options.count:7.1f} us per sample  {100 * seconds / whole:5.1f} %")
    if options.profile:
        profile = cProfile.Profile()
        profile.enable()
        for _record in sampler.sample_tasks(vocabulary, 2, min(options.count, 3000), "train"):
            pass
        profile.disable()
        pstats.Stats(profile).sort_stats("tottime").print_stats(18)
    random.seed(0)


if __name__ == "__main__":
    main()
