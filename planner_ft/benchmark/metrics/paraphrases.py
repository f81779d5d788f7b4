"""The worst case over paraphrases: samples of one family say like things in like words."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence


def worst_cases(
    values: Sequence[float], samples: Sequence[str], families: Sequence[str]
) -> dict[str, float]:
    """The smallest value of each family with at least two samples (ids); for truths, whether all
    are true. Of a sample that was answered several times every answer counts.
    """
    members: dict[str, list[float]] = defaultdict(list)
    ids: dict[str, set[str]] = defaultdict(set)
    for value, sample, family in zip(values, samples, families, strict=True):
        members[family].append(value)
        ids[family].add(sample)
    return {family: min(found) for family, found in members.items() if len(ids[family]) > 1}
