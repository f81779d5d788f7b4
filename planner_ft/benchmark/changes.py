"""Changes by enforcing rules, paired by sample: the same weights decoded freely and at a higher
strength.

A grammar turns an invented name into one of the vocabulary, and not always into the right one. The
outcomes before and after show it: "hallucination → substitution" is an answer that got valid and
stayed wrong.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.contrasts import by_system
from planner_ft.benchmark.paired import Paired, Score, holm, paired

RIGHT = "right"
"""The outcome of an answer with right names, order and parameters."""
COMPARED = ("f1", "whole_plan")


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
        outcomes = self.outcomes.items()
        return {
            **asdict(self),
            "f1": self.f1.difference.to_json(),
            "whole_plan": self.whole_plan.difference.to_json(),
            "p": [self.f1.p, self.whole_plan.p],
            "p_adjusted": list(self.p_adjusted),
            "outcomes": [
                {"before": old, "after": new, "n": count} for (old, new), count in outcomes
            ],
        }


def changes(scores: Iterable[Mapping[str, Any]], seed: int) -> list[Change]:
    """Every enforced configuration against the free one of the same weights ("lora+state" against
    "lora").
    """
    # Scores of earlier versions do not say whether the whole plan is right.
    systems = by_system({**score, "whole_plan": score["failure"] is None} for score in scores)
    wanted = [
        (candidate, free, configuration)
        for candidate, configuration in systems
        for free, plus, _strength in [configuration.partition("+")]
        if plus and (candidate, free) in systems
    ]
    ends = [(systems[name, free], systems[name, enforced]) for name, free, enforced in wanted]
    found = [[paired(METRIC[name], *both, seed) for name in COMPARED] for both in ends]
    ps = holm([one.p for pair in found for one in pair])
    made = []
    for index, (names, (before, after), pair) in enumerate(zip(wanted, ends, found, strict=True)):
        common = [name for name in before if name in after]
        answers = [both for name in common for both in zip(before[name], after[name], strict=False)]
        outcomes = Counter(
            (old["failure"] or RIGHT, new["failure"] or RIGHT) for old, new in answers
        )
        made.append(
            Change(
                *names,
                len(common),
                f1=pair[0],
                whole_plan=pair[1],
                seconds=_ratio(answers, "latency_s"),
                forward_passes=_ratio(answers, "forward_passes"),
                outcomes=dict(outcomes.most_common()),
                p_adjusted=(ps[2 * index], ps[2 * index + 1]),
            )
        )
    return made


def _ratio(pairs: Sequence[tuple[Score, Score]], key: str) -> float | None:
    known = [[line.get(key) for line in pair] for pair in pairs]
    sums = [
        sum(column) for column in zip(*(pair for pair in known if None not in pair), strict=True)
    ]
    return sums[1] / sums[0] if sums and sums[0] else None
