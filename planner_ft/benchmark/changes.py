"""Changes by enforcing rules, paired by sample: the same weights decoded freely and at a higher
strength.

A grammar turns an invented name into one of the vocabulary, and not always into the right one. The
outcomes before and after show it: "hallucination → substitution" is an answer that got valid and
stayed wrong.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.contrasts import by_system
from planner_ft.benchmark.paired import Score, holm, paired

RIGHT = "right"
"""The outcome of an answer with right names, order and parameters."""
COMPARED = ("f1", "whole_plan")


def changes(scores: Iterable[Mapping[str, Any]], seed: int) -> list[dict[str, Any]]:
    """Every enforced configuration against the free one of the same weights ("lora+state" against
    "lora"), over the samples that both answered, as results.json has them.

    `f1` and `whole_plan` are differences by sample (after minus before), `p` and `p_adjusted` their
    p-values, the latter after Holm over all changes of a run. `seconds` and `forward_passes` are
    ratios of the sums, None where they are not known. `outcomes` counts answers by outcome before
    and after, "right" or a kind of failure.
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
            {
                **dict(zip(("candidate", "before", "after"), names, strict=True)),
                "n": len(common),
                **{
                    name: one.difference.to_json() for name, one in zip(COMPARED, pair, strict=True)
                },
                "seconds": _ratio(answers, "latency_s"),
                "forward_passes": _ratio(answers, "forward_passes"),
                "outcomes": [
                    {"before": old, "after": new, "n": count}
                    for (old, new), count in outcomes.most_common()
                ],
                "p": [one.p for one in pair],
                "p_adjusted": ps[2 * index : 2 * index + 2],
            }
        )
    return made


def _ratio(pairs: Sequence[tuple[Score, Score]], key: str) -> float | None:
    known = [[line.get(key) for line in pair] for pair in pairs]
    sums = [
        sum(column) for column in zip(*(pair for pair in known if None not in pair), strict=True)
    ]
    return sums[1] / sums[0] if sums and sums[0] else None
