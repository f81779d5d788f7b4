"""A row taken apart: figures per name, role and type of parameter, which name stands for which,
examples of failures.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from planner_ft.benchmark.metrics import (
    FAILURES,
    Counts,
    counts_by_name,
    counts_by_role,
    substitutions,
)
from planner_ft.benchmark.metrics.entries import Entry
from planner_ft.benchmark.metrics.slots import KINDS
from planner_ft.benchmark.scoring import SampleScore
from planner_ft.benchmark.statistics import Estimate, clustered_rate

SHOWN = 5
"""Examples of each kind of failure."""
Breakdown = dict[str, Any]
Counted = list[tuple[SampleScore, dict[str, Counts]]]


def breakdown(scores: Sequence[SampleScore]) -> Breakdown:
    """What results.json has per row beside its metrics.

    `per_name`, and at task level `per_role`: `expected` (the support), `predicted` and `right`
    occurrences, `samples` that expect it, precision, recall and F1 with intervals. `per_type`:
    expected values of matched entries by type of parameter, and the share that the answers give.
    `substitutions`: how often a name was predicted where another was expected (`predicted` null:
    omitted, `expected` null: added). `failure_examples`: ids by kind of failure. `stops`: answers
    that cannot be carried out, by the condition that does not hold and the title of the first task
    that stops. `slots`: facts that the inputs state, by kind, and those that reached parameters and
    task prompts.
    """
    by_name = _counted(
        scores,
        lambda score: counts_by_name(
            _names(score.alignment.predicted), _names(score.alignment.expected)
        ),
    )
    found: Breakdown = {"per_name": _tables(by_name, "name")}
    if any("navigation_size" in score.values for score in scores):
        found["per_role"] = _tables(
            _counted(
                scores,
                lambda score: counts_by_role(score.alignment.predicted, score.alignment.expected),
            ),
            "role",
        )
    return {
        **found,
        "per_type": _per_type(scores),
        "substitutions": substitution_counts(scores),
        "failure_examples": failure_examples(scores),
        "stops": stop_counts(scores),
        "slots": slot_shares(scores),
        "ungrounded_examples": [score.id for score in scores if score.details.get("ungrounded")][
            :SHOWN
        ],
    }


def failure_examples(scores: Sequence[SampleScore]) -> dict[str, list[str]]:
    """The first ids of wrong answers of each kind that there is."""
    found: dict[str, list[str]] = {kind: [] for kind in FAILURES}
    for score in scores:
        if score.failure is not None and score.id not in found[score.failure]:
            found[score.failure].append(score.id)
    return {kind: ids[:SHOWN] for kind, ids in found.items() if ids}


def substitution_counts(scores: Sequence[SampleScore]) -> list[dict[str, Any]]:
    """Pairs of expected and predicted name that do not agree, most frequent first."""
    counts = Counter(pair for score in scores for pair in substitutions(score.alignment))
    ordered = sorted(
        counts.items(), key=lambda item: (-item[1], item[0][0] or "", item[0][1] or "")
    )
    return [
        {"expected": expected, "predicted": predicted, "n": count}
        for (expected, predicted), count in ordered
    ]


def stop_counts(scores: Sequence[SampleScore]) -> list[dict[str, Any]]:
    """Where mission plans stop, the most frequent first, with the first ids."""
    ids: dict[tuple[str, str], list[str]] = {}
    for score in scores:
        stop = score.details.get("stop")
        if stop:
            ids.setdefault((stop["condition"], stop["title"]), []).append(score.id)
    ordered = sorted(ids.items(), key=lambda item: (-len(item[1]), item[0]))
    return [
        {"condition": condition, "title": title, "n": len(of_them), "examples": of_them[:SHOWN]}
        for (condition, title), of_them in ordered
    ]


def slot_shares(scores: Sequence[SampleScore]) -> list[dict[str, Any]]:
    """Per kind of slot: how many are stated, and how many reached the right parameters and (mission
    level) task prompts, with the shares.
    """
    families = [score.family for score in scores]
    lines: list[dict[str, Any]] = []
    for kind in KINDS:
        counts = [score.details.get("slots", {}).get(kind, (0, 0, 0)) for score in scores]
        stated = sum(count[0] for count in counts)
        line: dict[str, Any] = {"kind": kind, "stated": stated}
        for place, name in ((1, "in_parameters"), (2, "in_prompt")):
            if all(count[place] is not None for count in counts):
                line[name] = sum(count[place] for count in counts)
                line[f"{name}_share"] = _share(
                    ((count[place], count[0]) for count in counts), families
                ).to_json()
        lines += [line] if stated else []
    return lines


def _counted(
    scores: Sequence[SampleScore], count: Callable[[SampleScore], dict[str, Counts]]
) -> Counted:
    return [(score, count(score)) for score in scores]


def _tables(counted: Counted, heading: str) -> list[dict[str, Any]]:
    """A line per name or role, the most expected first."""
    names = sorted({name for _score, counts in counted for name in counts})
    nothing = Counts(0, 0, 0)
    families = [score.family for score, _counts in counted]
    lines = [
        _line(heading, name, [counts.get(name, nothing) for _score, counts in counted], families)
        for name in names
    ]
    return sorted(lines, key=lambda line: (-line["expected"], line[heading]))


def _line(
    heading: str, name: str, column: Sequence[Counts], families: Sequence[str]
) -> dict[str, Any]:
    return {
        heading: name,
        "expected": sum(entry.expected for entry in column),
        "predicted": sum(entry.predicted for entry in column),
        "right": sum(entry.right for entry in column),
        "samples": sum(entry.expected > 0 for entry in column),
        "precision": (
            _share(((entry.right, entry.predicted) for entry in column), families).to_json()
        ),
        "recall": _share(((entry.right, entry.expected) for entry in column), families).to_json(),
        "f1": _f1(column, families).to_json(),
    }


def _f1(column: Sequence[Counts], families: Sequence[str]) -> Estimate:
    """F1 with an interval that holds for names seen once, which a bootstrap has nothing to resample
    of.

    With J the share of right ones among all that were expected or predicted (Jaccard 1912), F1 is 2
    J / (1 + J), which grows with J: the bounds of J give those of F1.
    """
    share = _share(
        ((entry.right, entry.predicted + entry.expected - entry.right) for entry in column),
        families,
    )
    return Estimate(
        *(
            None if bound is None else 2 * bound / (1 + bound)
            for bound in (share.value, share.low, share.high)
        )
    )


def _share(counts: Iterable[tuple[int, int]], families: Sequence[str]) -> Estimate:
    """right / all over occurrences, those of one sample or family not taken for independent."""
    hits: list[bool] = []
    clusters: list[str] = []
    for (right, of_all), family in zip(counts, families, strict=True):
        hits += [True] * right + [False] * (of_all - right)
        clusters += [family] * of_all
    return clustered_rate(hits, clusters)


def _per_type(scores: Sequence[SampleScore]) -> list[dict[str, Any]]:
    kinds = sorted({kind for score in scores for kind in score.types})
    families = [score.family for score in scores]
    lines = []
    for kind in kinds:
        counts = [score.types.get(kind, (0, 0)) for score in scores]
        right, expected = (
            sum(right for right, _all in counts),
            sum(of_all for _right, of_all in counts),
        )
        lines.append(
            {
                "type": kind,
                "expected": expected,
                "right": right,
                "share": _share(counts, families).to_json(),
            }
        )
    return sorted(lines, key=lambda line: (-line["expected"], line["type"]))


def _names(entries: Sequence[Entry]) -> list[str]:
    return [entry.name for entry in entries]
