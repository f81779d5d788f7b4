"""What enforcing rules changes, paired by sample: the same weights decoded freely and at a higher
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

from planner_ft.benchmark.catalogue import CATALOGUE
from planner_ft.benchmark.paired import Paired, holm, paired
from planner_ft.benchmark.verdicts import MARKS, signed, verdict

RIGHT = "right"
"""The outcome of an answer with right names, order and parameters."""

Score = dict[str, Any]
Answers = dict[str, list[Score]]
F1, WHOLE_PLAN = (
    next(metric for metric in CATALOGUE if metric.name == name) for name in ("f1", "whole_plan")
)


@dataclass(frozen=True)
class Change:
    """One configuration against another of the same candidate, over the samples that both answered.

    `f1` and `whole_plan` are compared by sample (after minus before, see `paired`); `p_adjusted`
    are their p-values after Holm over all changes of a run. `seconds` and `forward_passes` are
    ratios of the sums, None where they are not known. `outcomes` counts answers by (outcome before,
    outcome after), an outcome being "right" or a kind of failure.
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
        figures = {
            name: one.difference.to_json()
            for name, one in (("f1", self.f1), ("whole_plan", self.whole_plan))
        }
        tests = {"p": [self.f1.p, self.whole_plan.p], "p_adjusted": list(self.p_adjusted)}
        return {
            **asdict(self),
            **figures,
            **tests,
            "outcomes": [
                {"before": before, "after": after, "n": count}
                for (before, after), count in self.outcomes.items()
            ],
        }


def changes(scores: Sequence[Score], seed: int) -> list[Change]:
    """Every enforced configuration against the free one of the same weights ("lora+state" against
    "lora").
    """
    systems: dict[tuple[str, str], Answers] = {}
    for score in scores:
        systems.setdefault((score["candidate"], score["configuration"]), {}).setdefault(
            score["id"], []
        ).append(score)
    found = []
    for (candidate, configuration), after in systems.items():
        free, enforced, _strength = configuration.partition("+")
        before = systems.get((candidate, free))
        if enforced and before:
            found.append(compare(candidate, free, before, configuration, after, seed))
    holms = iter(holm([p for change in found for p in (change.f1.p, change.whole_plan.p)]))
    return [replace(change, p_adjusted=(next(holms), next(holms))) for change in found]


def compare(
    candidate: str, first: str, before: Answers, second: str, after: Answers, seed: int
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
        f1=paired(F1, before, after, seed),
        whole_plan=paired(WHOLE_PLAN, _with_whole_plan(before), _with_whole_plan(after), seed),
        seconds=_ratio(pairs, "latency_s"),
        forward_passes=_ratio(pairs, "forward_passes"),
        outcomes=dict(outcomes.most_common()),
    )


def _with_whole_plan(answers: Answers) -> Answers:
    return {
        name: [{**score, "whole_plan": score["failure"] is None} for score in scores]
        for name, scores in answers.items()
    }


def _ratio(pairs: list[tuple[Score, Score]], key: str) -> float | None:
    known = [
        (old[key], new[key])
        for old, new in pairs
        if old.get(key) is not None and new.get(key) is not None
    ]
    total = sum(old for old, _new in known)
    return sum(new for _old, new in known) / total if total else None


def changes_markdown(found: Sequence[Change]) -> list[str]:
    """Two tables in Markdown: differences, and the outcomes that changed."""
    if not found:
        return []
    lines = [
        "| What enforcing changes | n | F1 (difference) | Whole plan right (difference, points) |"
        " Latency (ratio) | Forward passes (ratio) |"
    ]
    lines.append("|---|---:|---:|---:|---:|---:|")
    for change in found:
        f1, whole_plan = (
            MARKS[verdict(one, p)]
            for one, p in zip((change.f1, change.whole_plan), change.p_adjusted, strict=True)
        )
        differences = (
            f"{signed(change.f1.difference)} {f1}",
            f"{signed(change.whole_plan.difference, 100, 1)} {whole_plan}",
        )
        cells = (*differences, _times(change.seconds), _times(change.forward_passes))
        lines.append(
            f"| {change.candidate}, {change.before} → {change.after} | {change.n} |"
            f" {' | '.join(cells)} |"
        )
    moved = [
        (change, pair, count)
        for change in found
        for pair, count in change.outcomes.items()
        if pair[0] != pair[1]
    ]
    if moved:
        lines += [
            "",
            "| Outcome, sample by sample | free | enforced | samples |",
            "|---|---|---|---:|",
        ]
        lines += [
            f"| {change.candidate}, {change.before} → {change.after} | {old} | {new} | {count} |"
            for change, (old, new), count in moved
        ]
    return [*lines, ""]


def _times(ratio: float | None) -> str:
    return "–" if ratio is None else f"× {ratio:.2f}"
