"""An expected and a predicted plan side by side: what is the same, changed, missing, added, in
another place.
"""

from __future__ import annotations

import bisect
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

from planner_ft.benchmark.metrics.alignment import Alignment, Pair, align
from planner_ft.benchmark.metrics.entries import Entry, plan_entries
from planner_ft.benchmark.metrics.substitutions import substitutions
from planner_ft.benchmark.metrics.values import known_parameters, values_agree
from planner_ft.report.runs import System, TestSet
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.outputs import parse_output
from planner_ft.vocabulary.plans import Level

Mark = Literal["same", "changed", "moved", "missing", "extra", "substituted"]


@dataclass(frozen=True)
class Difference:
    """A line of the comparison: indices into the expected and the predicted entries, and the
    parameters that differ.
    """

    mark: Mark
    expected: int | None
    predicted: int | None
    changed: tuple[str, ...] = ()


def entries_of(tests: TestSet, sample: str, system: System | None = None) -> tuple[Entry, ...]:
    """The entries of a sample's expected plan, or of a system's answer to it: none where it does
    not parse.
    """
    if system is None:
        return plan_entries(tests.level, tests.samples.get(sample, {}).get("expected"))
    return plan_entries(
        tests.level, parse_output(system.answers.get(sample, {}).get("output")).plan
    )


def differences(
    level: Level, expected: tuple[Entry, ...], predicted: tuple[Entry, ...], vocabulary: Vocabulary
) -> list[Difference]:
    """The lines of a side-by-side view, in the expected order; what was added stands where the
    answer has it.
    """
    alignment = align(level, expected, predicted, vocabulary)
    steady = _in_order(alignment.pairs)
    lines = {
        pair[0]: _matched(level, alignment, pair, pair in steady, vocabulary)
        for pair in alignment.pairs
    }
    replaced = _replaced(alignment)
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
        ordered = [
            *ordered,
            lines.get(index, Difference("missing", index, None)),
            *after.get(index, []),
        ]
    return ordered


def _replaced(alignment: Alignment) -> list[Pair]:
    """Indices of missing entries with those that stand for them."""
    free = list(alignment.extra)
    found = []
    for index, (_expected, predicted) in zip(
        alignment.missing, substitutions(alignment), strict=False
    ):
        other = next(
            (
                other
                for other in free
                if predicted is not None and alignment.predicted[other].name == predicted
            ),
            None,
        )
        if other is not None:
            free.remove(other)
            found.append((index, other))
    return found


def _matched(
    level: Level, alignment: Alignment, pair: Pair, steady: bool, vocabulary: Vocabulary
) -> Difference:
    ours, theirs = alignment.expected[pair[0]], alignment.predicted[pair[1]]
    changed = changed_parameters(level, ours, theirs, vocabulary)
    if changed:
        return Difference("changed", *pair, changed)
    same_place = (
        steady if level == "mission" else (ours.step, ours.role) == (theirs.step, theirs.role)
    )
    return Difference("same" if same_place else "moved", *pair)


def changed_parameters(
    level: Level, expected: Entry, predicted: Entry, vocabulary: Vocabulary
) -> tuple[str, ...]:
    """The parameters that one has and the other has not, or has with another value, as the
    benchmark compares values.

    An expected entry that states no parameters is not compared.
    """
    if not expected.stated:
        return ()
    known = known_parameters(level, expected.name, vocabulary)

    def agree(name: str) -> bool:
        both = name in expected.parameters and name in predicted.parameters
        return both and values_agree(
            predicted.parameters[name], expected.parameters[name], known.get(name), vocabulary
        )

    return tuple(
        name
        for name in dict.fromkeys([*expected.parameters, *predicted.parameters])
        if not agree(name)
    )


def _in_order(pairs: Sequence[Pair]) -> set[Pair]:
    """The largest set of pairs that stand in the same order on both sides (a longest increasing
    subsequence): the others have moved.
    """
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


def shown(level: Level, plan: Any, entry: Entry) -> list[Any]:
    """An entry as the page shows it: name, parameters, place, and the task prompt of a task."""
    if level == "task":
        return [entry.name, entry.parameters, f"{entry.step + 1} {entry.role}", ""]
    prompt = plan["tasks"][entry.step].get("task_prompt")
    return [
        entry.name,
        entry.parameters,
        str(entry.step + 1),
        prompt if isinstance(prompt, str) else "",
    ]
