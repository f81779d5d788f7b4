"""An expected and a predicted plan side by side, and how often each name is right in a test set."""

from __future__ import annotations

import bisect
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from planner_ft.benchmark.metrics.alignment import (
    Alignment,
    Entry,
    Pair,
    align,
    plan_entries,
    substitutions,
)
from planner_ft.benchmark.metrics.names import Counts, counts_by_name
from planner_ft.benchmark.metrics.values import known_parameters, values_agree
from planner_ft.report.runs import System, TestSet
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.outputs import parse_output
from planner_ft.vocabulary.plans import Level

Mark = Literal["same", "changed", "moved", "missing", "extra", "substituted"]


@dataclass(frozen=True)
class Difference:
    """Indices into the expected and the predicted entries, and the parameters that differ."""

    mark: Mark
    expected: int | None
    predicted: int | None
    changed: tuple[str, ...] = ()


@dataclass(frozen=True)
class Confusion:
    """Occurrences by name, and counts of (expected, predicted) in one place; None: nothing."""

    names: dict[str, Counts]
    substitutions: Counter[tuple[str | None, str | None]]


def entries_of(tests: TestSet, sample: str, system: System | None = None) -> tuple[Entry, ...]:
    """The entries of a sample's expected plan, or of a system's answer, if it parses."""
    if system is None:
        return plan_entries(tests.level, tests.samples.get(sample, {}).get("expected"))
    output = system.answers.get(sample, {}).get("output")
    return plan_entries(tests.level, parse_output(output).plan)


def confusion(tests: TestSet, system: System) -> Confusion | None:
    """Counts that a run recorded, else counted here; None where answers or data are not there."""
    names, replaced = system.row.get("per_name"), system.row.get("substitutions")
    if isinstance(names, list) and isinstance(replaced, list):
        keys = ("right", "predicted", "expected")
        counts = {str(line["name"]): Counts(*(line[key] for key in keys)) for line in names}
        pairs = {(line["expected"], line["predicted"]): line["n"] for line in replaced}
        return Confusion(counts, Counter(pairs))
    if not tests.samples or not system.answers or tests.vocabulary is None:
        return None
    found = Confusion({}, Counter())
    for sample in tests.samples:
        expected, predicted = entries_of(tests, sample), entries_of(tests, sample, system)
        ours, theirs = [one.name for one in expected], [one.name for one in predicted]
        for name, more in counts_by_name(theirs, ours).items():
            found.names[name] = _sum(found.names.get(name, Counts(0, 0, 0)), more)
        alignment = align(tests.level, expected, predicted, tests.vocabulary)
        found.substitutions.update(substitutions(alignment))
    return found


def _sum(one: Counts, other: Counts) -> Counts:
    return Counts(*(sum(pair) for pair in zip(one, other, strict=True)))


def differences(
    level: Level, expected: tuple[Entry, ...], predicted: tuple[Entry, ...], vocabulary: Vocabulary
) -> list[Difference]:
    """The lines of a side-by-side view; additions stand where the answer has them."""
    alignment = align(level, expected, predicted, vocabulary)
    steady = _in_order(alignment.pairs)
    lines = {}
    for pair in alignment.pairs:
        lines[pair[0]] = _matched(level, alignment, pair, pair in steady, vocabulary)
    replaced = list(_replaced(alignment))
    lines |= {ours: Difference("substituted", ours, theirs) for ours, theirs in replaced}
    taken = {theirs: ours for ours, theirs in [*alignment.pairs, *replaced]}
    after: dict[int, list[Difference]] = {}
    row = -1
    for index in range(len(predicted)):
        row = taken.get(index, row)
        if index not in taken:
            after.setdefault(row, []).append(Difference("extra", None, index))
    ordered = after.get(-1, [])
    for index in range(len(expected)):
        line = lines.get(index, Difference("missing", index, None))
        ordered = [*ordered, line, *after.get(index, [])]
    return ordered


def _replaced(alignment: Alignment) -> Iterator[Pair]:
    """Indices of missing entries with those that stand for them."""
    free = list(alignment.extra)
    pairs = zip(alignment.missing, substitutions(alignment), strict=False)
    for index, (_expected, name) in pairs:
        named = [other for other in free if alignment.predicted[other].name == name]
        if name is not None and named:
            free.remove(named[0])
            yield index, named[0]


def _matched(
    level: Level, alignment: Alignment, pair: Pair, steady: bool, vocabulary: Vocabulary
) -> Difference:
    ours, theirs = alignment.expected[pair[0]], alignment.predicted[pair[1]]
    changed = changed_parameters(level, ours, theirs, vocabulary)
    if changed:
        return Difference("changed", *pair, changed)
    if level == "task":
        steady = (ours.step, ours.role) == (theirs.step, theirs.role)
    return Difference("same" if steady else "moved", *pair)


def changed_parameters(
    level: Level, expected: Entry, predicted: Entry, vocabulary: Vocabulary
) -> tuple[str, ...]:
    """The parameters that differ; none where the expected entry states no parameters."""
    if not expected.stated:
        return ()
    known = known_parameters(level, expected.name, vocabulary)
    ours, theirs = expected.parameters, predicted.parameters

    def agree(name: str) -> bool:
        both = name in ours and name in theirs
        return both and values_agree(theirs[name], ours[name], known.get(name), vocabulary)

    return tuple(name for name in dict.fromkeys([*ours, *theirs]) if not agree(name))


def _in_order(pairs: Sequence[Pair]) -> set[Pair]:
    """The pairs of a longest increasing subsequence: the others have moved."""
    ends: list[int] = []
    last: list[int] = []
    before: list[int | None] = []
    for index, (_ours, theirs) in enumerate(pairs):
        position = bisect.bisect_left(ends, theirs)
        before.append(last[position - 1] if position else None)
        ends[position : position + 1] = [theirs]
        last[position : position + 1] = [index]
    kept: set[Pair] = set()
    current = last[-1] if last else None
    while current is not None:
        kept.add(pairs[current])
        current = before[current]
    return kept
