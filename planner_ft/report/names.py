"""Names over a whole test set: how often each is expected, predicted and right, and what stands for
what.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from planner_ft.benchmark.metrics.alignment import align
from planner_ft.benchmark.metrics.counts import Counts
from planner_ft.benchmark.metrics.names import counts_by_name
from planner_ft.benchmark.metrics.substitutions import substitutions
from planner_ft.report.differences import entries_of
from planner_ft.report.runs import Record, System, TestSet


@dataclass(frozen=True)
class Confusion:
    """Occurrences by name, and how often one name (expected) has another (predicted) in its place;
    None stands for nothing.
    """

    names: dict[str, Counts]
    substitutions: Counter[tuple[str | None, str | None]]


def confusion(tests: TestSet, system: System) -> Confusion | None:
    """Counts of one system: those that the run recorded, else counted here; None where its answers,
    the data or the vocabulary are not there.
    """
    if isinstance(system.row.get("per_name"), list) and isinstance(
        system.row.get("substitutions"), list
    ):
        return _recorded(system.row)
    if not tests.samples or not system.answers or tests.vocabulary is None:
        return None
    names: dict[str, Counts] = {}
    replaced: Counter[tuple[str | None, str | None]] = Counter()
    for sample in tests.samples:
        expected, predicted = entries_of(tests, sample), entries_of(tests, sample, system)
        for name, counts in counts_by_name(
            [entry.name for entry in predicted], [entry.name for entry in expected]
        ).items():
            before = names.get(name, Counts(0, 0, 0))
            names[name] = Counts(
                before.right + counts.right,
                before.predicted + counts.predicted,
                before.expected + counts.expected,
            )
        replaced.update(substitutions(align(tests.level, expected, predicted, tests.vocabulary)))
    return Confusion(names, replaced)


def _recorded(row: Record) -> Confusion:
    names = {
        str(line["name"]): Counts(line["right"], line["predicted"], line["expected"])
        for line in row["per_name"]
    }
    return Confusion(
        names,
        Counter(
            {(line["expected"], line["predicted"]): line["n"] for line in row["substitutions"]}
        ),
    )
