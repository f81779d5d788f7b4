"""Repeats: every sample asked several times with sampling, and how often all, or any, of k answers
are right.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from planner_ft.benchmark.scoring import SampleScore
from planner_ft.benchmark.statistics import Estimate, bootstrap_mean


def all_of(right: int, n: int, k: int) -> float:
    """pass^k of one sample: the chance that k of its n answers, drawn without replacement, are all
    right, C(right, k) / C(n, k).

    The unbiased estimator of tau-bench (Yao et al. 2024, arXiv:2406.12045, section 3).
    """
    return math.comb(right, k) / math.comb(n, k)


def any_of(right: int, n: int, k: int) -> float:
    """pass@k of one sample: the chance that at least one of k of its n answers is right, 1 - C(n -
    right, k) / C(n, k).

    The unbiased estimator of Chen et al. 2021 (arXiv:2107.03374, equation 1).
    """
    return 1 - math.comb(n - right, k) / math.comb(n, k)


def pass_figures(scores: Sequence[SampleScore], seed: int) -> dict[str, Any]:
    """pass^k and pass@k for k = 1 to the least number of answers that a sample has, an answer being
    right when the whole plan is.

    Means over samples with 95 % bootstrap intervals, whole phrasing families resampled.
    """
    attempts: dict[str, list[bool]] = {}
    for score in scores:
        attempts.setdefault(score.id, []).append(score.failure is None)
    families = {score.id: score.family for score in scores}
    counts = [(sum(right), len(right)) for right in attempts.values()]
    most = min((n for _right, n in counts), default=0)

    def mean(estimator: Any, k: int) -> Estimate:
        return bootstrap_mean(
            [estimator(right, n, k) for right, n in counts],
            [families[name] for name in attempts],
            seed,
        )

    figures = {"all_of_k": all_of, "any_of_k": any_of}
    return {
        "k": most,
        **{
            name: {str(k): mean(estimator, k).to_json() for k in range(1, most + 1)}
            for name, estimator in figures.items()
        },
    }


def repeats_markdown(figures: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """A table in Markdown: pass^k and pass@k per system, by the system's name; nothing where
    nothing was repeated.
    """
    shown = {name: one for name, one in figures.items() if one.get("k", 0) > 1}
    if not shown:
        return []
    ks = sorted({k for one in shown.values() for k in _ks(one["k"])})
    lines = [
        "| Whole plan right (%) | "
        + " | ".join(f"pass^{k}" for k in ks)
        + " | "
        + " | ".join(f"pass@{k}" for k in ks if k > 1)
        + " |"
    ]
    lines.append("|---|" + "---:|" * (2 * len(ks) - 1))
    for name, one in shown.items():
        cells = [_cell(one["all_of_k"].get(str(k))) for k in ks] + [
            _cell(one["any_of_k"].get(str(k))) for k in ks if k > 1
        ]
        lines.append(f"| {name}, {one['k']} answers per sample | {' | '.join(cells)} |")
    return [
        *lines,
        "",
        "pass^k: all of k answers are right; pass@k: at least one of k is (pass@1 is pass^1).",
        "",
    ]


def _ks(most: int) -> list[int]:
    """1, 2, 4, 8 ... and the last."""
    return [*(2**power for power in range(most.bit_length()) if 2**power < most), most]


def _cell(figure: Mapping[str, float | None] | None) -> str:
    if figure is None or figure["value"] is None:
        return "–"
    text = f"{100 * figure['value']:.1f}"
    low, high = figure["low"], figure["high"]
    return text if low is None or high is None else f"{text} [{100 * low:.1f}, {100 * high:.1f}]"
