"""How well the check of a command finds the elements that people have marked in one.

    python benchmarks/command_check.py --json benchmarks/results/command_check.json

Against the spans of data/mission: whether an element is there, and whether it is missing
(precision, recall and F1 over commands), and how far the spans cover the same letters (over
characters). An element that nearly every command has is "there" with a high F1 whatever the check
does: look at "missing". The words were written with the training split at hand; nothing was changed
for the validation split.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from planner_ft.document.ontology import check
from planner_ft.support.files import read_jsonl, write_json
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.schema import ELEMENTS

USV = load_vocabulary()


def scores(right: int, given: int, wanted: int) -> dict[str, float]:
    """Precision, recall and F1."""
    precision, recall = right / max(given, 1), right / max(wanted, 1)
    return {
        "precision": round(precision, 3),
        "recall": round(recall, 3),
        "f1": round(2 * precision * recall / max(precision + recall, 1e-9), 3),
    }


def letters(spans: list[dict[str, Any]], element: str) -> set[int]:
    return {
        place
        for span in spans
        if span["element"] == element
        for place in range(span["start"], span["end"])
    }


def measure(records: list[dict[str, Any]]) -> dict[str, Any]:
    """Per element the scores of its presence and of its letters."""
    checked = [check(record["prompt"], USV)["elements"] for record in records]
    figures: dict[str, Any] = {}
    for element in ELEMENTS:
        pairs = [
            (letters(found, element), letters(record["spans"], element))
            for found, record in zip(checked, records, strict=True)
        ]
        missing = scores(
            sum(not (ours or theirs) for ours, theirs in pairs),
            sum(not ours for ours, _ in pairs),
            sum(not theirs for _, theirs in pairs),
        )
        present = scores(
            sum(bool(ours and theirs) for ours, theirs in pairs),
            sum(bool(ours) for ours, _ in pairs),
            sum(bool(theirs) for _, theirs in pairs),
        )
        covered = scores(
            sum(len(ours & theirs) for ours, theirs in pairs),
            sum(len(ours) for ours, _ in pairs),
            sum(len(theirs) for _, theirs in pairs),
        )
        figures[element] = {
            "commands": len(records),
            "with it": sum(bool(theirs) for _, theirs in pairs),
            "present": present,
            "missing": missing,
            "letters": covered,
        }
    return figures


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", type=Path, help="also write the figures into this file")
    arguments = parser.parse_args()
    results = {
        split: measure(read_jsonl(f"data/mission/{split}.jsonl"))
        for split in ("train", "validation")
    }
    for split, figures in results.items():
        for element, figure in figures.items():
            told = "   ".join(
                f"{name} {' '.join(f'{key[0]} {value:.3f}' for key, value in figure[name].items())}"
                for name in ("present", "missing", "letters")
            )
            print(
                f"{split:10} {element:10} in {figure['with it']:3} of {figure['commands']:3}  "
                f" {told}"
            )
    if arguments.json:
        write_json(arguments.json, results)


if __name__ == "__main__":
    main()
