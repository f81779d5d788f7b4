"""The curated mission set: where it lies, reading and auditing it."""

import contextlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import planner_ft
from planner_ft.data.labels import coverage_problems
from planner_ft.data.validation import validate_file
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_jsonl
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level

SPLITS = ("train", "validation", "test")
BUNDLED = Path(__file__).parent / "curated"
"""Where a wheel carries the sets, by vehicle (tool.hatch.build.targets.wheel.force-include)."""


def curated_folder(vocabulary: Vocabulary) -> Path | None:
    """The vehicle's curated set: beside an own definition, else in the checkout that we work in or
    run from, else the package's copy.

    ./data/mission counts in a checkout alone: elsewhere it is what an earlier run has written.
    """
    package = Path(planner_ft.__file__).parent
    checkouts = [
        root for root in (Path(), package.parent) if (root / package.name / "__init__.py").is_file()
    ]
    own = vocabulary.data / "mission"
    bundled = (*(root / own for root in checkouts), BUNDLED / vocabulary.name)
    folders = bundled if vocabulary.bundled else (own,)
    return next((folder for folder in folders if (folder / "train.jsonl").is_file()), None)


def find_source(asked: Path | None = None, vocabulary: Vocabulary | None = None) -> Path:
    """The folder with the curated set: `asked`, else the vehicle's. Raises PlannerError."""
    if asked is not None and not asked.is_dir():
        raise PlannerError(f"--source {asked}: no such folder")
    vocabulary = vocabulary or load_vocabulary()
    folder = asked or curated_folder(vocabulary)
    if folder is None:
        where = f"not in {vocabulary.data / 'mission'}"
        where = "neither in a checkout nor in the package" if vocabulary.bundled else where
        raise PlannerError(
            f"the curated mission set is {where}; give its folder with --source, or --level task"
            " alone"
        )
    return folder


def known_tests(level: Level, folder: Path, vocabulary: Vocabulary) -> Iterator[Path]:
    """Files that are measured on and never trained on: the test and challenge sets of the level in
    `folder`, the vehicle's data and the curated sets, and those of eval/challenge.
    """
    places = [folder, vocabulary.data / level]
    if level == "mission" and (curated := curated_folder(vocabulary)):
        places.append(curated)
    with contextlib.suppress(PlannerError):
        source = find_source()
        places += [source] if level == "mission" else []
        for path in {one.resolve(): one for one in (Path(), source.parent.parent)}.values():
            found = sorted((path / "eval" / "challenge").glob("*.jsonl"))
            yield from (one for one in found if one.name.startswith("task") == (level == "task"))
    for path in {one.resolve(): one for one in places}.values():
        yield from sorted([*path.glob("test*.jsonl"), *path.glob("challenge*.jsonl")])


def curated_splits(
    source: Path, counts: Mapping[Any, int | None], vocabulary: Vocabulary, *, audit: bool = True
) -> dict[str, list[dict[str, Any]]]:
    """The first `counts` records of each split, all of them where the count is None.

    Raises PlannerError when a record is not valid, the whole set lacks coverage (with `audit`), or
    a split is smaller than asked for. `audit` asks for the coverage of the published set.
    """
    paths = {split: source / f"{split}.jsonl" for split in SPLITS}
    reports = [
        validate_file(path, vocabulary, "mission", complete=True, canonical=False)
        for path in paths.values()
    ]
    problems = [str(problem) for report in reports for problem in report.problems]
    problems += [
        f"{report.path}: holds {kind}s; mission records are expected"
        for report in reports
        for kind in report.counts.keys() - {"mission record"}
    ]
    splits = {split: read_jsonl(path) for split, path in paths.items()} if not problems else {}
    own = vocabulary.source != load_vocabulary().source
    of = f" --vocabulary {vocabulary.source}" if own else ""
    lists = f"; plannerft validate --complete{of} {source}/*.jsonl lists them"
    if not problems and audit:
        problems = [f"{source}: {problem}" for problem in coverage_problems(splits, vocabulary)]
        lists = ""
    if problems:
        more = f" (and {len(problems) - 1} more{lists})" if len(problems) > 1 else ""
        other = f"; a set for the vocabulary {vocabulary.name} is needed: give its folder with"
        other = "" if audit else f"{other} --source, or --level task alone"
        raise PlannerError(f"{problems[0]}{more}{other}")
    for split, count in counts.items():
        if count is not None and count > len(splits[split]):
            raise PlannerError(
                f"--{split} {count}: the curated mission set has {len(splits[split])} records"
                " there; ask for fewer, or --level task alone"
            )
    return {split: records[: counts[split]] for split, records in splits.items()}
