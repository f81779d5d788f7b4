"""What the metrics that read the command cost, and what they miss on plans that are right.

    python benchmarks/plan_logic.py

Expected plans are scored as if they were answers: every value that is called ungrounded, every slot
that is not found and every plan that stops is a mistake of the metrics. Time is processor time per
sample: of the first answer, for which the input is read, and of the next.
"""

from __future__ import annotations

import itertools
import time
from typing import Any

from planner_ft.benchmark.metrics.answers import Answer
from planner_ft.benchmark.scoring import plan_logic
from planner_ft.data.missions import sample_missions
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.facts import corrections
from planner_ft.support.files import read_jsonl
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import Level

USV = load_vocabulary()


def measure(name: str, level: Level, records: list[dict[str, Any]]) -> None:
    """Print a line of figures for some records."""
    expected = [record["expected"] for record in records]
    judged = [(Answer(level, one, one, USV), of) for one, of in zip(expected, records, strict=True)]
    started = time.process_time()
    found = [plan_logic(*one)[0] for one in judged]
    first = time.process_time()
    for one in judged:
        plan_logic(*one)
    again = time.process_time()
    total = {key: sum(int(values[key] or 0) for values in found) for key in found[0]}
    print(
        f"{name:28} n {len(found):5}  ungrounded"
        f" {total['values_judged'] - total['values_grounded']:3} of {total['values_judged']:5} "
        f" slots found {total['slots_in_parameters_right']:5} of {total['slots_stated']:5}  in"
        f" prompts {total['slots_in_prompt_right']:5} of {total['slots_prompted']:5}  executable"
        f" {total['executable']:4}  ms {1000 * (first - started) / len(found):5.2f}, again"
        f" {1000 * (again - first) / len(found):5.2f}"
    )


def main() -> None:
    corrections("thrml")  # Reads the word lists once.
    curated = [
        record
        for split in ("train", "validation", "test")
        for record in read_jsonl(f"data/mission/{split}.jsonl")
    ]
    measure("mission, curated", "mission", curated)
    measure("mission, synthetic", "mission", list(sample_missions(5, 1000)))
    for split in ("train", "test", "test_unseen"):
        measure(
            f"task, sampled, {split}",
            "task",
            list(itertools.islice(sample_tasks(USV, 3, None, split), 400)),
        )


if __name__ == "__main__":
    main()
