"""A row taken apart: by name, role and type of parameter, substitutions, examples of failures; and
whether the system knows when it is wrong (calibration and selective prediction).
"""

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import accumulate, groupby
from typing import Any

from planner_ft.benchmark.metrics.alignment import substitutions
from planner_ft.benchmark.metrics.facts import KINDS
from planner_ft.benchmark.metrics.failures import FAILURES
from planner_ft.benchmark.metrics.names import Counts, counts_by_name, counts_by_role
from planner_ft.benchmark.scoring import SampleScore
from planner_ft.benchmark.statistics import Estimate, clustered_rate

SHOWN = 5  # examples of each kind of failure
BINS = 10
"""Of equal width, as in Guo et al. 2017 (arXiv:1706.04599)."""
APPROVED = 0.01  # share of wrong plans up to which plans may be approved without a look at each
TENTH = 0.1
Breakdown = dict[str, Any]
Lines = list[dict[str, Any]]
Scores = Sequence[SampleScore]


def breakdown(scores: Scores) -> Breakdown:
    """The parts of a row of results.json beside its metrics.

    `per_name`, and at task level `per_role`: `expected` (the support), `predicted` and `right`
    occurrences, `samples` that expect it, precision, recall and F1 with intervals. `per_type`:
    expected values of matched entries by type of parameter, and the share that the answers give.
    `substitutions`: how often a name was predicted where another was expected (`predicted` null:
    omitted, `expected` null: added). `failure_examples`: ids by kind of failure. `stops`: answers
    that cannot be carried out, by the condition that does not hold and the title of the first task
    that stops. `slots`: facts that the inputs state, by kind, and those that reached parameters and
    task prompts. `confidence`, where any answer has one: `confidence_figures`, `not_known` answers,
    and whether it is `calibrated`.
    """
    families = [score.family for score in scores]
    entries = [(score.alignment.predicted, score.alignment.expected) for score in scores]
    names = [counts_by_name(*([one.name for one in side] for side in pair)) for pair in entries]
    found: Breakdown = {"per_name": _per(names, families, "name")}
    if any("navigation_size" in score.values for score in scores):
        found["per_role"] = _per([counts_by_role(*pair) for pair in entries], families, "role")
    replaced = Counter(pair for score in scores for pair in substitutions(score.alignment))
    frequent = sorted(replaced.items(), key=lambda one: (-one[1], *(name or "" for name in one[0])))
    ungrounded = [score.id for score in scores if score.details.get("ungrounded")]
    failed = {
        kind: list(dict.fromkeys(score.id for score in scores if score.failure == kind))[:SHOWN]
        for kind in FAILURES
    }
    return {
        **found,
        "per_type": _per_type(scores, families),
        "substitutions": [
            {"expected": expected, "predicted": predicted, "n": count}
            for (expected, predicted), count in frequent
        ],
        "failure_examples": {kind: ids for kind, ids in failed.items() if ids},
        "stops": _stops(scores),
        "slots": _slots(scores, families),
        "ungrounded_examples": ungrounded[:SHOWN],
        **_confidence(scores),
    }


def _confidence(scores: Scores) -> dict[str, Any]:
    known = [score for score in scores if score.details.get("confidence") is not None]
    if not known:
        return {}
    calibrated = any(score.details.get("calibrated") for score in scores)
    held = [score.details["confidence"] for score in known]
    found = confidence_figures(held, [score.failure is None for score in known])
    beside = {"calibrated": calibrated, "not_known": len(scores) - len(known)}
    return {"confidence": {**beside, **found}}


def _stops(scores: Scores) -> Lines:
    """Where mission plans stop, the most frequent first, with the first ids."""
    ids: dict[tuple[str, str], list[str]] = {}
    for score in scores:
        if stop := score.details.get("stop"):
            ids.setdefault((stop["condition"], stop["title"]), []).append(score.id)
    return [
        {"condition": condition, "title": title, "n": len(found), "examples": found[:SHOWN]}
        for (condition, title), found in sorted(ids.items(), key=lambda one: (-len(one[1]), one[0]))
    ]


def _slots(scores: Scores, families: Sequence[str]) -> Lines:
    """Stated slots per kind, and how many, and which share, reached parameters and task prompts."""
    lines: Lines = []
    for kind in KINDS:
        counts = [score.details.get("slots", {}).get(kind, (0, 0, 0)) for score in scores]
        line: dict[str, Any] = {"kind": kind, "stated": sum(count[0] for count in counts)}
        for place, name in ((1, "in_parameters"), (2, "in_prompt")):
            if all(count[place] is not None for count in counts):
                pairs = [(count[place], count[0]) for count in counts]
                line[name] = sum(right for right, _all in pairs)
                line[f"{name}_share"] = _share(pairs, families).to_json()
        lines += [line] if line["stated"] else []
    return lines


def _per(counted: Sequence[dict[str, Counts]], families: Sequence[str], heading: str) -> Lines:
    """A line per name or role, the most expected first."""
    lines = []
    for name in {name for counts in counted for name in counts}:
        column = [counts.get(name, Counts(0, 0, 0)) for counts in counted]
        right, predicted, expected = (sum(part) for part in zip(*column, strict=True))
        # With J the share of right ones among all that were expected or predicted (Jaccard 1912),
        # F1 is 2 J / (1 + J), which grows with J: its bounds hold for names seen once, too.
        either = _share(((one.right, sum(one[1:]) - one.right) for one in column), families)
        bounds = [None if j is None else 2 * j / (1 + j) for j in either.to_json().values()]
        samples = sum(one.expected > 0 for one in column)
        line = {heading: name, "expected": expected, "predicted": predicted, "right": right}
        shares = {
            "precision": _share(((one.right, one.predicted) for one in column), families),
            "recall": _share(((one.right, one.expected) for one in column), families),
            "f1": Estimate(*bounds),
        }
        figures = {key: share.to_json() for key, share in shares.items()}
        lines.append({**line, "samples": samples, **figures})
    return sorted(lines, key=lambda line: (-line["expected"], line[heading]))


def _share(counts: Iterable[tuple[int, int]], families: Sequence[str]) -> Estimate:
    """right / all over occurrences, those of one sample or family not taken for independent."""
    hits: list[bool] = []
    clusters: list[str] = []
    for (right, of_all), family in zip(counts, families, strict=True):
        hits += [True] * right + [False] * (of_all - right)
        clusters += [family] * of_all
    return clustered_rate(hits, clusters)


def _per_type(scores: Scores, families: Sequence[str]) -> Lines:
    lines = []
    for kind in {kind for score in scores for kind in score.types}:
        counts = [score.types.get(kind, (0, 0)) for score in scores]
        right, expected = (sum(column) for column in zip(*counts, strict=True))
        share = _share(counts, families).to_json()
        lines.append({"type": kind, "expected": expected, "right": right, "share": share})
    return sorted(lines, key=lambda line: (-line["expected"], line["type"]))


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
    bins = _bins(confidence, right)
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


def _bins(confidence: Sequence[float], right: Sequence[bool]) -> list[tuple[float, float, int]]:
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
