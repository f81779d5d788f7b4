"""The published figures (published/*.csv), to stand beside measured ones."""

from __future__ import annotations

import csv
import functools
from dataclasses import dataclass
from pathlib import Path

from planner_ft.vocabulary.plans import Level

FOLDER = Path(__file__).parent / "published"
SAMPLES: dict[Level, int] = {"mission": 25, "task": 500}
CONFIGURATIONS = ("base", "lora")
VOCABULARY = "usv"
"""The vocabulary that the published figures are about."""


@dataclass(frozen=True)
class PublishedRow:
    """One model's published figures by (metric, configuration), rates as fractions."""

    model: str
    figures: dict[tuple[str, str], float]


@functools.cache
def published_rows(level: Level) -> tuple[PublishedRow, ...]:
    """The rows of the published table of a level, in its order."""
    with open(FOLDER / f"{level}.csv", encoding="utf-8", newline="") as stream:
        return tuple(_row(line) for line in csv.DictReader(stream))


def source(level: Level) -> str:
    """Where the published figures of a level come from."""
    own = f"its own {SAMPLES[level]} test samples, model weights and hardware"
    return f"published study ({level}-level table): {own}"


def _row(line: dict[str, str]) -> PublishedRow:
    figures = {}
    for column, text in line.items():
        metric, _, configuration = column.rpartition("_")
        if configuration in CONFIGURATIONS:
            percent = metric in ("hallucination", "schema_valid")
            figures[metric, configuration] = float(text) / (100 if percent else 1)
    return PublishedRow(line["model"], figures)
