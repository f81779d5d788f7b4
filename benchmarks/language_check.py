"""How often a command in another language is told, and how often an English one is taken for one.

    python benchmarks/language_check.py

By the share of words that no list knows (`unknown_words`), at several thresholds: 50 commands in
German, French, Spanish, Norwegian and Portuguese (eval/language/other.jsonl), and the English ones
of the development sets: the 50 shortest, 50 at random, and all.
"""

from __future__ import annotations

import random
from pathlib import Path

from planner_ft.document.warnings.asked import UNKNOWN
from planner_ft.facts import unknown_words
from planner_ft.support.files import read_jsonl

EVAL = Path(__file__).parents[1] / "eval"
THRESHOLDS = (0.4, 0.5, 0.55, 0.6, 0.7)


def main() -> None:
    other = [line["prompt"] for line in read_jsonl(EVAL / "language" / "other.jsonl")]
    paths = sorted((EVAL / "challenge").glob("mission*.jsonl"))
    english = sorted((line["prompt"] for path in paths for line in read_jsonl(path)), key=len)
    sets = {"other": other, "50 shortest": english[:50]}
    sets |= {"50 at random": random.Random(0).sample(english, 50), "all English": english}
    shares = {name: [unknown_words(one)[1] for one in of] for name, of in sets.items()}
    for threshold in THRESHOLDS:
        told = (
            f"{name} {sum(one >= threshold for one in of)}/{len(of)}" for name, of in shares.items()
        )
        mark = " (in use)" if threshold == UNKNOWN else ""
        print(f"{threshold:.2f}{mark}: {', '.join(told)}")


if __name__ == "__main__":
    main()
