"""Task inputs as the Mission Agent words them, for the benchmark: what planning with two agents
asks the Task Agent.

    python benchmarks/handed_down.py --count 300 --out build/handed_down.jsonl
    plannerft bench --level task --candidates embedded --configurations lora,lora+grounded \
        --data build/handed_down.jsonl --out build/handed_down

The targets, places and figures are drawn anew; the sentences are those of the generator, which the
embedded candidate was trained on. It says how well one agent understands the other, not how well it
reads people.
"""

from __future__ import annotations

import argparse
import itertools
from pathlib import Path

from planner_ft.data.task.sampler import mission_tasks
from planner_ft.support.files import write_jsonl
from planner_ft.vocabulary import load_vocabulary


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument(
        "--seed", type=int, default=400_077, help="far from the seeds that data is made with"
    )
    parser.add_argument("--out", type=Path, required=True)
    arguments = parser.parse_args()
    write_jsonl(
        arguments.out,
        itertools.islice(mission_tasks(load_vocabulary(), arguments.seed), arguments.count),
    )


if __name__ == "__main__":
    main()
