"""What enforcing rules changes, paired by sample: the same weights decoded freely and at a higher strength.

A grammar turns an invented name into one of the vocabulary, and not always into the right one. The outcomes before and after
show it: "hallucination → substitution" is an answer that got valid and stayed wrong.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from planner_ft.benchmark.statistics import Estimate, bootstrap_mean

RIGHT = "right"
"""The outcome of an answer with right names, order and parameters."""

Score = dict[str, Any]


@dataclass(frozen=True)
class Change:
    """One configuration against another of the same candidate, over the samples that both answered.

    `f1` and `whole_plan` are mean differences per sample (after minus before, 95 % interval clustered by family); `seconds` and
    `forward_passes` are ratios of the sums, None where they are not known. `outcomes` counts samples by (outcome before, outcome after),
    an outcome being "right" or a kind of failure.
    """

    candidate: str
    before: str
    after: str
    n: int
    f1: Estimate
    whole_plan: Estimate
    seconds: float | None
    forward_passes: float | None
    outcomes: dict[tuple[str, str], int]

    def to_json(self) -> dict[str, Any]:
        return {**asdict(self), "outcomes": [{"before": before, "after": after, "n": count} for (before, after), count in self.outcomes.items()]}


def changes(scores: Sequence[Score], seed: int) -> list[Change]:
    """Every enforced configuration against the free one of the same weights ("lora+state" against "lora")."""
    systems: dict[tuple[str, str], dict[str, Score]] = {}
    for score in scores:
        systems.setdefault((score["candidate"], score["configuration"]), {})[score["id"]] = score
    found = []
    for (candidate, configuration), after in systems.items():
        free, enforced, _strength = configuration.partition("+")
        before = systems.get((candidate, free))
        if enforced and before:
            found.append(compare(candidate, free, before, configuration, after, seed))
    return found


def compare(candidate: str, first: str, before: dict[str, Score], second: str, after: dict[str, Score], seed: int) -> Change:
    """Pair two configurations by sample id."""
    pairs = [(before[name], after[name]) for name in before if name in after]
    families = [old["family"] for old, _new in pairs]
    outcomes = Counter((old["failure"] or RIGHT, new["failure"] or RIGHT) for old, new in pairs)
    return Change(
        candidate, first, second, len(pairs),
        f1=bootstrap_mean([new["f1"] - old["f1"] for old, new in pairs], families, seed),
        whole_plan=bootstrap_mean([float(new["failure"] is None) - float(old["failure"] is None) for old, new in pairs], families, seed),
        seconds=_ratio(pairs, "latency_s"),
        forward_passes=_ratio(pairs, "forward_passes"),
        outcomes=dict(outcomes.most_common()),
    )  # fmt: skip


def _ratio(pairs: list[tuple[Score, Score]], key: str) -> float | None:
    known = [(old[key], new[key]) for old, new in pairs if old.get(key) is not None and new.get(key) is not None]
    total = sum(old for old, _new in known)
    return sum(new for _old, new in known) / total if total else None


def changes_markdown(found: Sequence[Change]) -> list[str]:
    """Two tables in Markdown: differences, and the outcomes that changed."""
    if not found:
        return []
    lines = ["| What enforcing changes | n | F1 (difference) | Whole plan right (difference, points) | Latency (ratio) | Forward passes (ratio) |"]
    lines.append("|---|---:|---:|---:|---:|---:|")
    for change in found:
        cells = (_signed(change.f1, 1, 3), _signed(change.whole_plan, 100, 1), _times(change.seconds), _times(change.forward_passes))
        lines.append(f"| {change.candidate}, {change.before} → {change.after} | {change.n} | {' | '.join(cells)} |")
    moved = [(change, pair, count) for change in found for pair, count in change.outcomes.items() if pair[0] != pair[1]]
    if moved:
        lines += ["", "| Outcome, sample by sample | free | enforced | samples |", "|---|---|---|---:|"]
        lines += [f"| {change.candidate}, {change.before} → {change.after} | {old} | {new} | {count} |" for change, (old, new), count in moved]
    return [*lines, ""]


def _signed(estimate: Estimate, scale: int, decimals: int) -> str:
    if estimate.value is None:
        return "–"
    text = f"{estimate.value * scale:+.{decimals}f}"
    if estimate.low is None or estimate.high is None:
        return text
    return f"{text} [{estimate.low * scale:+.{decimals}f}, {estimate.high * scale:+.{decimals}f}]"


def _times(ratio: float | None) -> str:
    return "–" if ratio is None else f"× {ratio:.2f}"
