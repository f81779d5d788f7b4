"""The synthetic mission set: as many commands with their plans as are asked for, in a folder of its
own beside the curated set.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

from planner_ft.data.card import table
from planner_ft.data.missions import sample_missions
from planner_ft.data.output import DataFolder
from planner_ft.data.validation import canonical_record
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import plan_names, plan_problems

FOLDER, FILE = "mission-synthetic", "train.jsonl"
EVERY = 500


def synthetic_folder(
    out: Path,
    vocabulary: Vocabulary,
    seed: int,
    count: int,
    progress: Callable[[str, int, int], None],
) -> DataFolder:
    """The folder with `count` records (id, family, prompt, expected, tags), a card and a manifest.
    Raises PlannerError for another vehicle.
    """
    lines: list[str] = []
    titles: Counter[str] = Counter()
    families: Counter[str] = Counter()
    for record in sample_missions(seed, count, vocabulary):
        problems = plan_problems("mission", record["expected"], vocabulary, strict=True)
        if problems:
            raise PlannerError(f"--synthetic: {record['family']}: {problems[0]}")
        lines.append(canonical_record("mission", record, vocabulary) + "\n")
        titles.update(plan_names("mission", record["expected"]))
        families[record["family"]] += 1
        if len(lines) % EVERY == 0 or len(lines) == count:
            progress("mission: synthetic", len(lines), count)
    configuration = {
        "level": "mission",
        "synthetic": count,
        "vocabulary": vocabulary.name,
        "vocabulary_sha256": vocabulary.sha256,
    }
    manifest = build_manifest("data", seed=seed, configuration=configuration)
    return DataFolder(
        out / FOLDER,
        {FILE: "".join(lines), "README.md": _card(count, seed, titles, families)},
        manifest,
    )


def _card(count: int, seed: int, titles: Counter[str], families: Counter[str]) -> str:
    front: dict[str, Any] = {
        "pretty_name": "Synthetic mission plans",
        "language": ["en"],
        "license": "apache-2.0",
        "task_categories": ["text-generation"],
    }
    return (
        "---\n"
        + "".join(f"{key}: {compact_json(value)}\n" for key, value in front.items())
        + f"---\n# Synthetic mission plans\n\n{count} commands with their plans, written by"
        f" `plannerft gen-data --level mission --synthetic {count}` with seed {seed}. They come"
        " from whole commands written by hand, with slots for targets, positions and values, and"
        " clauses of limits and demands for data."
        " Labels follow the labelling rules by construction. No curated command is among them.\n\n## Tasks\n\n"
        + table(["task", "occurrences"], titles.most_common())
        + "\n## Families\n\n"
        + table(["family", "records"], families.most_common(40))
    )
