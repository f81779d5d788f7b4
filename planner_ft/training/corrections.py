"""Corrected plans beside the samples of the training file: `train --corrections FILE`, as
`plannerft review --harvest` writes it.
"""

from __future__ import annotations

from pathlib import Path

from planner_ft.support.files import sha256_text
from planner_ft.training.samples import Record, Split, read_split
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level


def with_corrections(
    split: Split, path: Path, level: Level, vocabulary: Vocabulary, problems: list[str]
) -> Split:
    """The split with the records of `path` after its own; its digest covers them. What is wrong
    with the file is added to `problems`.
    """
    corrections = read_split(path, level, vocabulary, problems)
    if corrections is None:
        return split
    known = {record.id for record in split.records}
    problems += [
        f"{path}:{record.line}: id {record.id!r} stands in {split.path} already"
        for record in corrections.records
        if record.id in known
    ]
    last = max((record.line for record in split.records), default=0)
    added = [
        Record(last + number, record.value)
        for number, record in enumerate(corrections.records, start=1)
    ]
    return Split(
        split.path, sha256_text(split.sha256 + corrections.sha256), [*split.records, *added]
    )
