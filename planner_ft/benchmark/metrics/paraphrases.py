"""The worst case over paraphrases: a planner that needs the right wording is only as good as its
worst answer.

Samples of one family say like things in like words (`family` of a record). Families of one sample
have no worst case and are left out.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence


def worst_cases(
    values: Sequence[float], samples: Sequence[str], families: Sequence[str]
) -> dict[str, float]:
    """The smallest value of each family that has at least two samples, which are told by id; for
    truths, whether all are true.

    Of a sample that was answered several times every answer counts.
    """
    members: dict[str, list[float]] = defaultdict(list)
    ids: dict[str, set[str]] = defaultdict(set)
    for value, sample, family in zip(values, samples, families, strict=True):
        members[family].append(value)
        ids[family].add(sample)
    return {family: min(found) for family, found in members.items() if len(ids[family]) > 1}
