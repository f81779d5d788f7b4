"""The curated mission set: where it lies, reading and auditing it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import planner_ft
from planner_ft.data.tags import coverage_problems
from planner_ft.data.validation import file_values, identity, object_problems
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import DEFAULT

SPLITS = ("train", "validation", "test")
SOURCE = Path("data") / "mission"
BUNDLED = Path(__file__).parent / "curated"
"""Where a wheel carries the set (tool.hatch.build.targets.wheel.force-include)."""


def find_source(asked: Path | None = None) -> Path:
    """The folder with the curated set: `asked`, else that of the checkout that we work in or run
    from, else the package's copy.

    ./data/mission counts in a checkout alone: elsewhere it is what an earlier run has written.
    """
    if asked is not None:
        if not asked.is_dir():
            raise PlannerError(f"--source {asked}: no such folder")
        return asked
    package = Path(planner_ft.__file__).parent
    checkouts = [
        root for root in (Path(), package.parent) if (root / package.name / "__init__.py").is_file()
    ]
    for folder in (*(root / SOURCE for root in checkouts), BUNDLED):
        if (folder / "train.jsonl").is_file():
            return folder
    raise PlannerError(
        "the curated mission set is neither in a checkout nor in the package; give its folder with"
        " --source, or --level task alone"
    )


def curated_splits(
    source: Path, counts: Mapping[Any, int | None], vocabulary: Vocabulary, named: str = DEFAULT
) -> dict[str, list[dict[str, Any]]]:
    """The first `counts` records of each split, all of them where the count is None.

    Raises PlannerError when a record is not valid, the whole set lacks coverage, or a split is
    smaller than asked for. The coverage is that of the published set and is asked of the default
    vocabulary's alone.
    """
    splits, problems = {}, []
    for split in SPLITS:
        splits[split], found = _read(source / f"{split}.jsonl", vocabulary)
        problems += found
    lists = f"; plannerft validate --complete {source}/*.jsonl lists them"
    if not problems and named == DEFAULT:
        problems = [f"{source}: {problem}" for problem in coverage_problems(splits, vocabulary)]
        lists = ""
    if problems:
        more = f" (and {len(problems) - 1} more{lists})" if len(problems) > 1 else ""
        other = (
            f"; a set for the vocabulary {named} is needed: give its folder with --source, or"
            " --level task alone"
            if named != DEFAULT
            else ""
        )
        raise PlannerError(f"{problems[0]}{more}{other}")
    for split, count in counts.items():
        if count is not None and count > len(splits[split]):
            raise PlannerError(
                f"--{split} {count}: the curated mission set has {len(splits[split])} records"
                " there; ask for fewer, or --level task alone"
            )
    return {split: records[: counts[split]] for split, records in splits.items()}


def _read(path: Path, vocabulary: Vocabulary) -> tuple[list[dict[str, Any]], list[str]]:
    records: list[dict[str, Any]] = []
    problems = []
    lines: dict[str, int] = {}
    for line, value, problem in file_values(path):
        if problem is not None or not isinstance(value, dict):
            problems.append(f"{path}:{line}: {problem or 'a JSON object is expected'}")
            continue
        _kind, _level, texts = object_problems(value, vocabulary, "mission", complete=True)
        if "expected" not in value:
            texts.append("expected is missing")
        if identity(value) in lines:
            texts.append(f"id {value.get('id')!r} stands in line {lines[identity(value)]} already")
        lines.setdefault(identity(value), line)
        records.append(value)
        problems += [f"{path}:{line}: {text}" for text in texts]
    return records, problems
