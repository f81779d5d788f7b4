"""The published figures (published/*.csv), to stand beside measured ones."""

from __future__ import annotations

import csv
import functools
from pathlib import Path

from planner_ft.benchmark.results import Row, System
from planner_ft.benchmark.statistics import Estimate
from planner_ft.vocabulary.plans import Level

FOLDER = Path(__file__).parent / "published"
SAMPLES: dict[Level, int] = {"mission": 25, "task": 500}
CONFIGURATIONS = ("base", "lora")
VOCABULARY = "usv"
"""The vocabulary that the published figures are about."""
PERCENT = ("hallucination", "schema_valid")


@functools.cache
def published_rows(level: Level) -> tuple[Row, ...]:
    """The rows of the published table of a level in its order, each model in both configurations;
    rates are fractions.
    """
    with open(FOLDER / f"{level}.csv", encoding="utf-8", newline="") as stream:
        lines = list(csv.DictReader(stream))
    return tuple(_row(line, name, level) for line in lines for name in CONFIGURATIONS)


def source(level: Level) -> str:
    """Where the published figures of a level come from."""
    own = f"its own {SAMPLES[level]} test samples, model weights and hardware"
    return f"published study ({level}-level table): {own}"


def _row(line: dict[str, str], configuration: str, level: Level) -> Row:
    model, metrics = line["model"], {}
    for column, text in line.items():
        metric, _, of = column.rpartition("_")
        if of == configuration:
            metrics[metric] = Estimate(float(text) / (100 if metric in PERCENT else 1))
    system = System(model, configuration, label=f"{model} (published)", published=model)
    return Row(system, SAMPLES[level], metrics, quoted=True)
