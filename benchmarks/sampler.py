"""How fast the task sampler is on one core, and what the time goes to.

    python benchmarks/sampler.py [--count N] [--vocabulary FILE] [--profile]

Processor time is counted, so that a busy machine gives the same figures.
"""

from __future__ import annotations

import argparse
import cProfile
import gc
import pstats
import time
from collections import defaultdict
from collections.abc import Callable
from typing import Any

from planner_ft.data.task import sampler
from planner_ft.facts import geometry
from planner_ft.support.files import compact_json
from planner_ft.vocabulary.definition import Vocabulary, load_vocabulary

PARTS: tuple[tuple[str, Any, str], ...] = (
    ("put together", sampler, "composed"),
    ("from templates", sampler, "draw_template"),
    ("validation", sampler, "plan_problems"),
    ("geometry", geometry, "survey_square"),
    ("geometry", geometry, "lawnmower"),
    ("geometry", geometry, "circle"),
    ("geometry", geometry, "offset"),
)


def timed(parts: dict[str, float], name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    """`function`, its processor time added to `parts[name]`."""

    def run(*arguments: Any, **options: Any) -> Any:
        start = time.process_time()
        result = function(*arguments, **options)
        parts[name] += time.process_time() - start
        return result

    return run


def rate(vocabulary: Vocabulary, count: int) -> None:
    """Print validated and serialised samples per second of one core."""
    start = time.process_time()
    size = sum(
        len(compact_json(record)) + 1
        for record in sampler.sample_tasks(vocabulary, 1, count, "train")
    )
    seconds = time.process_time() - start
    print(
        f"{count / seconds:,.0f} validated and serialised samples per second of one core ({count}"
        f" in {seconds:.2f} s, {size / 1e6:.1f} MB)"
    )


def shares(vocabulary: Vocabulary, count: int) -> None:
    """Print what the time goes to; measuring itself slows the run down."""
    parts: dict[str, float] = defaultdict(float)
    for name, module, function in PARTS:
        setattr(module, function, timed(parts, name, getattr(module, function)))
    serialise = timed(parts, "serialisation", compact_json)
    start = time.process_time()
    for record in sampler.sample_tasks(vocabulary, 1, count, "train"):
        serialise(record)
    whole = time.process_time() - start
    for name, seconds in sorted(parts.items(), key=lambda item: -item[1]):
        print(
            f"{name:26} {1e6 * seconds / count:7.1f} us per sample  {100 * seconds / whole:5.1f} %"
        )


def profile(vocabulary: Vocabulary, count: int) -> None:
    """Print the functions that take longest."""
    recorder = cProfile.Profile()
    recorder.enable()
    for _record in sampler.sample_tasks(vocabulary, 2, count, "train"):
        pass
    recorder.disable()
    pstats.Stats(recorder).sort_stats("tottime").print_stats(18)


def main() -> None:
    """Parse and run."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--vocabulary", default="usv")
    parser.add_argument(
        "--profile", action="store_true", help="print the functions that take longest"
    )
    options = parser.parse_args()
    vocabulary = load_vocabulary(options.vocabulary)
    next(sampler.sample_tasks(vocabulary, 0, 1, "train"))  # phrases are compiled once
    gc.disable()  # as gen-data does
    rate(vocabulary, options.count)
    if options.profile:
        profile(vocabulary, min(options.count, 3000))
    shares(vocabulary, options.count)


if __name__ == "__main__":
    main()
