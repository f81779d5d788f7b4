"""Edges of a plan: which task or step follows which."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Sequence
from itertools import pairwise

from planner_ft.benchmark.metrics.counts import Counts

Node = tuple[Hashable, int]


def edge_f1(predicted: Sequence[Hashable], expected: Sequence[Hashable]) -> float:
    """F1 between the sets of edges of two sequences (TaskBench's edge F1, Shen et al. 2023).

    A node is a name with the number of its occurrence; an edge leads from each node to the next.
    Where neither sequence has two nodes: 1.0 for equal sequences, else 0.0.
    """
    ours, theirs = edges(predicted), edges(expected)
    if not ours and not theirs:
        return float(list(predicted) == list(expected))
    return Counts(len(ours & theirs), len(ours), len(theirs)).f1


def edges(sequence: Sequence[Hashable]) -> set[tuple[Node, Node]]:
    """Pairs of neighbours."""
    seen: Counter[Hashable] = Counter()
    nodes: list[Node] = []
    for name in sequence:
        seen[name] += 1
        nodes.append((name, seen[name]))
    return set(pairwise(nodes))
