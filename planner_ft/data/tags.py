"""The tags of the curated mission set, one per labelling rule (tags.toml), and their audit."""

from __future__ import annotations

import re
import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import plan_names

Records = Sequence[Mapping[str, Any]]

_TABLE = tomllib.loads(Path(__file__).with_suffix(".toml").read_text("utf-8"))


def _column(key: str) -> dict[str, Any]:
    return {tag: entry[key] for tag, entry in _TABLE.items() if key in entry}


TAGS: dict[str, str] = _column("rule")
"""Tag to what a command with it exercises."""
TASKS_OF_TAG: dict[str, list[str]] = _column("tasks")
"""A record with the tag has one of these tasks."""
ROLE_OF_TAG: dict[str, str] = _column("role")
"""A record with the tag has the task that the vehicle's definition names for this role."""
ALWAYS_TAGGED: dict[str, str] = {task: tag for tag, task in _column("always").items()}
"""A record with the task has this tag."""
WORDS = {tag: re.compile(rf"\b(?:{words})\b", re.I) for tag, words in _column("words").items()}
"""A command with such words may be one with the tag, where records have none."""
COVERAGE = {"train": (125, 8), "validation": (25, 1), "test": (25, 1)}
"""Records of each split, and how often a title at least; every `which.*` tag occurs once."""


def tags_of(vocabulary: Vocabulary) -> list[str]:
    """The tags that a vehicle's commands can have: those of no task, and of a task that it has."""
    known = vocabulary.task.keys()
    return [tag for tag in TAGS if not known.isdisjoint(TASKS_OF_TAG.get(tag, known))]


def unchecked_tags(records: Records, vocabulary: Vocabulary) -> list[str]:
    """Tags of records that are about tasks of other vehicles, so that nothing checks them."""
    used = {tag for record in records for tag in record.get("tags", ())}
    return [tag for tag in TAGS if tag in used and tag not in tags_of(vocabulary)]


def tag_problems(record: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[str]:
    """Unknown tags, and tags that do not agree with the tasks of the expected plan."""
    tags = record.get("tags", [])
    titles = set(plan_names("mission", record.get("expected")))
    for tag in tags:
        role = ROLE_OF_TAG.get(tag)
        needed = [title for title in TASKS_OF_TAG.get(tag, ()) if title in vocabulary.task]
        needed += [getattr(vocabulary, role)] if role else []
        if tag not in TAGS:
            yield f"tag {tag!r} is not known"
        elif needed and titles.isdisjoint(needed):
            yield f"tag {tag} needs {' or '.join(needed)} in the plan"
    if len(set(tags)) != len(tags):
        yield "a tag stands twice"
    for title, tag in ALWAYS_TAGGED.items():
        if title in titles and tag not in tags:
            yield f"{title} is in the plan, but the tag {tag} is not"
    if ("rule.empty" in tags) != (not titles):
        yield "the tag rule.empty and an empty task list go together"


def coverage_problems(splits: Mapping[str, Records], vocabulary: Vocabulary) -> list[str]:
    """What a curated mission set lacks per split, and families and prompts that cross splits."""
    problems = [
        f"{split}: {len(splits[split])} records, {count} are expected"
        for split, (count, _least) in COVERAGE.items()
        if len(splits[split]) != count
    ]
    for split, (_count, least) in COVERAGE.items():
        plans = (plan_names("mission", record["expected"]) for record in splits[split])
        found = Counter(name for names in plans for name in names)
        problems += [
            f"{split}: {task.title} occurs {found[task.title]} times, {least} are needed"
            for task in vocabulary.tasks
            if found[task.title] < least
        ]
    for split, records in splits.items():
        tags = {tag for record in records for tag in record.get("tags", [])}
        which = (tag for tag in tags_of(vocabulary) if tag.startswith("which."))
        missing = (tag for tag in which if tag not in tags)
        problems += [f"{split}: no record has the tag {tag}" for tag in missing]
    for key in ("family", "prompt"):
        homes: dict[str, str] = {}
        for split, records in splits.items():
            for value in dict.fromkeys(str(record[key]) for record in records):
                if homes.setdefault(value, split) != split:
                    problems.append(f"{key} {value!r} is in {homes[value]} and in {split}")
    return problems
