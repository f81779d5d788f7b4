"""Whether a system knows when it is wrong: calibration and selective prediction.

Answers are ranked by their confidence; those of equal confidence count as in random order.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate, groupby
from typing import Any

BINS = 10
"""Of equal width, as in Guo et al. 2017 (arXiv:1706.04599)."""
APPROVED = 0.01  # share of wrong plans up to which plans may be approved without a look at each
TENTH = 0.1


def confidence_figures(confidence: Sequence[float], right: Sequence[bool]) -> dict[str, Any]:
    """`n` and `wrong`; `ece`, the expected calibration error; `aurc`, the area under the
    risk-coverage curve (Geifman and El-Yaniv 2017), and `aurc_random`, that of random order, the
    share of wrong answers; `least_sure_tenth`, the share of the wrong answers among the least sure
    tenth; `approved_99`, the largest share of answers, the surest first, of which at most 1 % are
    wrong; `curve`, the share of wrong answers among the surest k, k from 1; `bins` of [mean
    confidence, share of right answers, answers].
    """
    n, wrong = len(right), sum(not one for one in right)
    errors = _errors_among_surest(confidence, right)
    risks = [found / count for count, found in enumerate(errors, start=1)]
    bins = reliability_bins(confidence, right)
    tenth = n - round(n * TENTH)
    least = wrong - (errors[tenth - 1] if tenth else 0.0)
    within = [count for count, risk in enumerate(risks, start=1) if risk <= APPROVED]
    return {
        "n": n,
        "wrong": wrong,
        "ece": sum(count * abs(held - share) for held, share, count in bins) / n if n else None,
        "aurc": sum(risks) / n if n else None,
        "aurc_random": wrong / n if n else None,
        "least_sure_tenth": least / wrong if wrong else None,
        "approved_99": max(within, default=0) / n if n else None,
        "curve": risks,
        "bins": bins,
    }


def reliability_bins(
    confidence: Sequence[float], right: Sequence[bool]
) -> list[tuple[float, float, int]]:
    """(mean confidence, share of right answers, answers) of every bin that has any."""
    found: dict[int, list[tuple[float, bool]]] = {}
    for held, one in sorted(zip(confidence, right, strict=True)):
        found.setdefault(min(int(held * BINS), BINS - 1), []).append((held, one))
    return [
        (sum(held for held, _ in of) / len(of), sum(one for _, one in of) / len(of), len(of))
        for of in found.values()
    ]


def _errors_among_surest(confidence: Sequence[float], right: Sequence[bool]) -> list[float]:
    """Expected wrong answers among the surest k, k from 1."""
    order = sorted(zip(confidence, right, strict=True), key=lambda pair: -pair[0])
    each: list[float] = []
    for _held, tied in groupby(order, key=lambda pair: pair[0]):
        of = [not one for _, one in tied]
        each += [sum(of) / len(of)] * len(of)
    return list(accumulate(each))
