"""Changes by enforcing rules, paired by sample: the same weights decoded freely and at a higher
strength.

A grammar turns an invented name into one of the vocabulary, and not always into the right one. The
outcomes before and after show it: "hallucination → substitution" is an answer that got valid and
stayed wrong.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.contrasts import Scores, by_system
from planner_ft.benchmark.paired import Paired, Score, holm, paired

RIGHT = "right"
"""The outcome of an answer with right names, order and parameters."""


@dataclass(frozen=True)
class Change:
    """One configuration against another of the same candidate, over the samples that both answered.

    `f1` and `whole_plan` are compared by sample (after minus before); `p_adjusted` are their
    p-values after Holm over all changes of a run. `seconds` and `forward_passes` are ratios of the
    sums, None where they are not known. `outcomes` counts answers by (outcome before, outcome
    after), an outcome being "right" or a kind of failure.
    """

    candidate: str
    before: str
    after: str
    n: int
    f1: Paired
    whole_plan: Paired
    seconds: float | None
    forward_passes: float | None
    outcomes: dict[tuple[str, str], int]
    p_adjusted: tuple[float | None, float | None] = (None, None)

    def to_json(self) -> dict[str, Any]:
        return {
            **asdict(self),
            "f1": self.f1.difference.to_json(),
            "whole_plan": self.whole_plan.difference.to_json(),
            "p": [self.f1.p, self.whole_plan.p],
            "p_adjusted": list(self.p_adjusted),
            "outcomes": [
                {"before": before, "after": after, "n": count}
                for (before, after), count in self.outcomes.items()
            ],
        }


def changes(scores: Sequence[dict[str, Any]], seed: int) -> list[Change]:
    """Every enforced configuration against the free one of the same weights ("lora+state" against
    "lora").
    """
    # Scores of earlier versions do not say whether the whole plan is right.
    systems = by_system({**score, "whole_plan": score["failure"] is None} for score in scores)
    found = []
    for (candidate, configuration), after in systems.items():
        free, enforced, _strength = configuration.partition("+")
        before = systems.get((candidate, free))
        if enforced and before:
            found.append(_change(candidate, free, before, configuration, after, seed))
    holms = iter(holm([p for change in found for p in (change.f1.p, change.whole_plan.p)]))
    return [replace(change, p_adjusted=(next(holms), next(holms))) for change in found]


def _change(
    candidate: str, first: str, before: Scores, second: str, after: Scores, seed: int
) -> Change:
    """Pair two configurations by sample id, and repeats by their number."""
    pairs = [
        pair
        for name in before
        if name in after
        for pair in zip(before[name], after[name], strict=False)
    ]
    outcomes = Counter((old["failure"] or RIGHT, new["failure"] or RIGHT) for old, new in pairs)
    return Change(
        candidate,
        first,
        second,
        len(before.keys() & after.keys()),
        f1=paired(METRIC["f1"], before, after, seed),
        whole_plan=paired(METRIC["whole_plan"], before, after, seed),
        seconds=_ratio(pairs, "latency_s"),
        forward_passes=_ratio(pairs, "forward_passes"),
        outcomes=dict(outcomes.most_common()),
    )


def _ratio(pairs: Sequence[tuple[Score, Score]], key: str) -> float | None:
    known = [
        (old[key], new[key])
        for old, new in pairs
        if old.get(key) is not None and new.get(key) is not None
    ]
    total = sum(old for old, _new in known)
    return sum(new for _old, new in known) / total if total else None
