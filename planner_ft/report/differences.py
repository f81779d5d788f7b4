"""An expected and a predicted plan side by side."""

from __future__ import annotations

from collections import defaultdict
from typing import Literal, NamedTuple

from rapidfuzz.distance import LCSseq

from planner_ft.benchmark.metrics.alignment import Entries, align, replaced
from planner_ft.benchmark.metrics.values import changed_keys
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

Mark = Literal["same", "changed", "moved", "missing", "extra", "substituted"]


class Difference(NamedTuple):
    """Indices into the expected and the predicted entries, and the parameters that differ."""

    mark: Mark
    expected: int | None
    predicted: int | None
    changed: tuple[str, ...] = ()


def differences(
    level: Level, expected: Entries, predicted: Entries, vocabulary: Vocabulary
) -> list[Difference]:
    """The lines of a side-by-side view; additions stand where the answer has them."""
    alignment = align(level, expected, predicted, vocabulary)
    steady = _in_order([theirs for _ours, theirs in alignment.pairs])
    lines = {}
    for pair in alignment.pairs:
        one, other = expected[pair[0]], predicted[pair[1]]
        moved = pair[1] not in steady
        if level == "task":
            moved = (one.step, one.role) != (other.step, other.role)
        changed: tuple[str, ...] = ()
        if one.stated:
            changed = changed_keys(level, one.name, other.parameters, one.parameters, vocabulary)
        mark: Mark = "changed" if changed else "moved" if moved else "same"
        lines[pair[0]] = Difference(mark, *pair, changed)
    for ours, theirs in replaced(alignment).items():
        lines[ours] = Difference("substituted", ours, theirs)
    beside = {line.predicted: ours for ours, line in lines.items()}
    after: dict[int, list[Difference]] = defaultdict(list)
    last = -1
    for index in range(len(predicted)):
        if index in beside:
            last = beside[index]
        else:
            after[last].append(Difference("extra", None, index))
    ordered = after[-1]
    for index in range(len(expected)):
        ordered += [lines.get(index, Difference("missing", index, None)), *after[index]]
    return ordered


def _in_order(numbers: list[int]) -> set[int]:
    """A longest increasing subsequence of different numbers: the others have moved."""
    blocks = LCSseq.opcodes(numbers, sorted(numbers))
    equal = [block for block in blocks if block.tag == "equal"]
    return {number for one in equal for number in numbers[one.src_start : one.src_end]}
