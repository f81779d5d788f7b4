"""The worst case over paraphrases: a planner that needs the right wording is only as good as its worst answer.

Samples of one family say like things in like words (`family` of a record). Families of one sample have no worst case and are left out.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence


def worst_cases(values: Sequence[float], families: Sequence[str]) -> dict[str, float]:
    """The smallest value of each family that has at least two samples; for truths, whether all are true."""
    members: dict[str, list[float]] = defaultdict(list)
    for value, family in zip(values, families, strict=True):
        members[family].append(value)
    return {family: min(found) for family, found in members.items() if len(found) > 1}
