"""Answers that lm-evaluation-harness logged (--log_samples) as predictions that `plannerft score`
reads.

python eval/lm_eval/predictions.py OUTPUT/MODEL/samples_planner_mission_test_DATE.jsonl >
predictions.jsonl plannerft score --level mission --predictions predictions.jsonl --data
data/mission/test.jsonl
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path


def predictions(path: Path) -> Iterator[dict[str, str]]:
    """Yield {"id", "output"} for every logged sample."""
    with open(path, encoding="utf-8") as stream:
        for line in stream:
            sample = json.loads(line)
            yield {"id": sample["doc"]["id"], "output": sample["filtered_resps"][0]}


if __name__ == "__main__":
    if len(sys.argv) != 2 or not Path(sys.argv[1]).is_file():
        sys.exit(__doc__)
    for prediction in predictions(Path(sys.argv[1])):
        print(json.dumps(prediction, ensure_ascii=False))
