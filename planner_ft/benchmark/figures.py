"""From scores and timed queries to figures with intervals: the metrics of a row, the row taken
apart, its repeats and costs; and whether a system knows when it is wrong.
"""

import math
from collections import Counter, defaultdict
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from itertools import accumulate, groupby
from typing import Any

from planner_ft.benchmark.catalogue import METRIC, Metric
from planner_ft.benchmark.metrics.alignment import substitutions
from planner_ft.benchmark.metrics.answers import FAILURES, Counts, counts_by
from planner_ft.benchmark.metrics.facts import KINDS
from planner_ft.benchmark.scoring import SampleScore
from planner_ft.benchmark.statistics import (
    Estimate,
    bootstrap_mean,
    bootstrap_ratio,
    clustered_rate,
    quantile,
)
from planner_ft.vocabulary.plans import is_number

OF_GROUPS = ("f1", "exact_sequence", "parameters", "whole_plan", "strict_valid")
QUANTILES = (("median", 0.5), ("p90", 0.9), ("p99", 0.99))
BESIDE = ("load_s", "adapter_swap_s", "peak_memory_bytes")
"""Costs of a candidate that do not belong to a query: run.json has them."""
SHOWN = 5  # examples of each kind of failure
BINS = 10
"""Of equal width, as in Guo et al. 2017 (arXiv:1706.04599)."""
APPROVED = 0.01  # share of wrong plans up to which plans may be approved without a look at each
TENTH = 0.1
Figures = dict[str, Any]
Scores = Sequence[Mapping[str, Any]]  # lines of scores.jsonl
Term = tuple[float, float, str]  # numerator, denominator and family


def summarise(scores: Scores, seed: int, names: Iterable[str] = METRIC) -> dict[str, Estimate]:
    """Metrics over samples, 95 %, families as such: Wilson for rates, bootstrap for others."""
    return {name: _estimate(METRIC[name], _terms(METRIC[name], scores), seed) for name in names}


def _terms(metric: Metric, scores: Scores) -> list[Term]:
    """The terms of the samples that have a value, or of phrasing families, each counting once."""
    if metric.worst:
        values = [float(score[metric.worst] or 0) for score in scores]
        named = ([score[key] for score in scores] for key in ("id", "family"))
        return [(one, 1.0, family) for family, one in worst_cases(values, *named).items()]
    found = ((metric.terms(score), score["family"]) for score in scores)
    return [(*terms, family) for terms, family in found if terms]


def _estimate(metric: Metric, terms: Sequence[Term], seed: int) -> Estimate:
    """The interval is that of a rate where all samples agree: a bootstrap then knows no doubt."""
    if not terms:
        return Estimate(None)
    tops, belows, families = zip(*terms, strict=True)
    if metric.kind == "rate":
        return clustered_rate([top == 1 for top in tops], families)
    estimate = bootstrap_ratio(tops, belows, families, seed)
    if metric.fraction and estimate.value in (0, 1):
        return clustered_rate([estimate.value == 1] * len(families), families)
    return estimate


def worst_cases(
    values: Sequence[float], samples: Sequence[str], families: Sequence[str]
) -> dict[str, float]:
    """The smallest value of each family with two or more samples (ids), of all their answers."""
    members: dict[str, list[tuple[str, float]]] = defaultdict(list)
    for value, sample, family in zip(values, samples, families, strict=True):
        members[family].append((sample, value))
    several = {family: found for family, found in members.items() if len(dict(found)) > 1}
    return {family: min(value for _, value in found) for family, found in several.items()}


def group_figures(scores: Scores) -> list[Figures]:
    """`n` and means per candidate, configuration and group of the data, where it has any."""
    names, found = ("candidate", "configuration", "group"), defaultdict[Any, list[Figures]](list)
    for score in scores:
        if score.get("group"):
            # Scores of earlier versions do not say whether the whole plan is right.
            right = score["failure"] is None
            found[tuple(score[name] for name in names)].append({**score, "whole_plan": right})
    return [
        dict(zip(names, key, strict=True), n=len(members))
        | {name: METRIC[name].value(members) for name in OF_GROUPS}
        for key, members in found.items()
    ]


def all_of(right: int, n: int, k: int) -> float:
    """pass^k of one sample: the chance that k of its n answers, drawn without replacement, are all
    right, C(right, k) / C(n, k) (tau-bench: Yao et al. 2024, arXiv:2406.12045, section 3).
    """
    return math.comb(right, k) / math.comb(n, k)


def any_of(right: int, n: int, k: int) -> float:
    """pass@k of one sample: the chance that at least one of k of its n answers is right, 1 - C(n -
    right, k) / C(n, k) (Chen et al. 2021, arXiv:2107.03374, equation 1).
    """
    return 1 - math.comb(n - right, k) / math.comb(n, k)


def pass_figures(scores: Scores, seed: int) -> Figures:
    """pass^k and pass@k for k = 1 to the least number of answers that a sample has, an answer being
    right when the whole plan is; means over samples, 95 % bootstrap, whole families resampled.
    """
    answers: dict[tuple[str, str], list[bool]] = defaultdict(list)
    for score in scores:
        answers[score["id"], score["family"]].append(score["failure"] is None)
    families = [family for _id, family in answers]
    counts = [(sum(right), len(right)) for right in answers.values()]
    found: Figures = {"k": min((n for _right, n in counts), default=0)}
    for kind, estimator in {"all_of_k": all_of, "any_of_k": any_of}.items():
        found[kind] = {}
        for k in range(1, found["k"] + 1):
            values = [estimator(right, n, k) for right, n in counts]
            found[kind][str(k)] = bootstrap_mean(values, families, seed).to_json()
    return found


def cost_figures(
    timed: Mapping[str, Mapping[str, Any]],
    families: Mapping[str, Hashable],
    beside: Mapping[str, Any],
    planning: Sequence[Mapping[str, Any]],
    seed: int,
) -> Figures:
    """The `costs` of a row in results.json; empty where nothing was measured. `timed` are lines of
    latency.jsonl by sample id, `families` the phrasing families of samples, `beside` the figures of
    run.json on the candidate, `planning` the row's lines of planning.jsonl.
    """
    known = {name: line for name, line in timed.items() if is_number(line.get("latency_s"))}
    lines, figures = list(known.values()), Figures()
    if lines:
        clusters = [families.get(name, name) for name in known]
        seconds = [float(line["latency_s"]) for line in lines]
        shares = {name: quantile(seconds, share) for name, share in QUANTILES}
        figures["latency_s"] = {name: share.to_json() for name, share in shares.items()}
        first = [line.get("first_token_s") for line in lines]
        pairs = [(one, of) for one, of in zip(first, clusters, strict=True) if one is not None]
        if pairs:
            times, own = zip(*pairs, strict=True)
            figures["first_token_s"] = bootstrap_mean(times, own, seed).to_json()
        if all(is_number(line.get("tokens")) for line in lines):
            tokens = [float(line["tokens"]) for line in lines]
            figures["tokens_per_s"] = bootstrap_ratio(tokens, seconds, clusters, seed).to_json()
        figures["n"] = len(lines)
    figures |= {name: beside[name] for name in BESIDE if beside.get(name) is not None}
    return figures | ({"planning": _planning_times(planning, seed)} if planning else {})


def _planning_times(lines: Sequence[Mapping[str, Any]], seed: int) -> list[Figures]:
    """Seconds to plan by number of tasks planned, and each agent's; no invalid plans."""
    made, valid = [], sorted(filter(_tasks, lines), key=_tasks)
    for tasks, of_number in groupby(valid, key=_tasks):
        found = list(of_number)
        ids, seconds = ([line[key] for line in found] for key in ("id", "seconds"))
        whole = bootstrap_mean(seconds, ids, seed).to_json()
        agents = {key: sum(line[key] for line in found) for key in ("mission_s", "task_s")}
        means = {key: total / len(found) for key, total in agents.items()}
        made.append({"tasks": tasks, "n": len(found), "seconds": whole, **means})
    return made


def _tasks(line: Mapping[str, Any]) -> int:
    return int(line.get("tasks") or 0)


def breakdown(scores: Sequence[SampleScore]) -> Figures:
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
    pairs = [(score.alignment.predicted, score.alignment.expected) for score in scores]
    parts = ["name", *(["role"] if any("navigation_size" in one.values for one in scores) else [])]
    types = [
        {"type": kind, "expected": sum(of), "right": sum(right)}
        | {"share": clustered_rate(right, families, of).to_json()}
        for kind, (right, of) in _columns([score.types for score in scores], (0, 0))
    ]
    replaced = Counter(pair for score in scores for pair in substitutions(score.alignment))
    frequent = sorted(replaced.items(), key=lambda one: (-one[1], *(name or "" for name in one[0])))
    failed = {
        kind: list(dict.fromkeys(score.id for score in scores if score.failure == kind))[:SHOWN]
        for kind in FAILURES
    }
    slots = dict(_columns([score.details.get("slots", {}) for score in scores], (0, 0, 0)))
    ungrounded = [score.id for score in scores if score.details.get("ungrounded")]
    found = {
        f"per_{by}": _per(by, [counts_by(by, *pair) for pair in pairs], families) for by in parts
    }
    return found | {
        "per_type": _most_expected("type", types),
        "substitutions": [
            {"expected": expected, "predicted": predicted, "n": count}
            for (expected, predicted), count in frequent
        ],
        "failure_examples": {kind: ids for kind, ids in failed.items() if ids},
        "stops": _stops(scores),
        "slots": [_slot(kind, families, *slots[kind]) for kind in KINDS if kind in slots],
        "ungrounded_examples": ungrounded[:SHOWN],
        **_confidence(scores),
    }


def _columns(
    parts: Sequence[Mapping[str, Sequence[int]]], none: Sequence[int]
) -> Iterator[tuple[str, list[tuple[int, ...]]]]:
    """For every key of some samples' counts each count as a column, `none` where it is not."""
    for key in {key for part in parts for key in part}:
        yield key, list(zip(*(part.get(key, none) for part in parts), strict=True))


def _most_expected(by: str, lines: Iterable[Figures]) -> list[Figures]:
    return sorted(lines, key=lambda line: (-line["expected"], line[by]))


def _per(
    by: str, counted: Sequence[Mapping[str, Counts]], families: Sequence[str]
) -> list[Figures]:
    """A line per name or role, the most expected first; occurrences of one sample or family are not
    taken for independent.
    """
    lines = []
    for name, (right, predicted, expected) in _columns(counted, Counts(0, 0, 0)):
        # With J the share of right ones among all that were expected or predicted (Jaccard 1912),
        # F1 is 2 J / (1 + J), which grows with J: its bounds hold for names seen once, too.
        counts = zip(right, predicted, expected, strict=True)
        every = [ours + theirs - both for both, ours, theirs in counts]
        either = clustered_rate(right, families, every)
        f1 = {key: None if j is None else 2 * j / (1 + j) for key, j in either.to_json().items()}
        line = {by: name, "expected": sum(expected), "predicted": sum(predicted)}
        line |= {"right": sum(right), "samples": sum(map(bool, expected))}
        for share, of in {"precision": predicted, "recall": expected}.items():
            line[share] = clustered_rate(right, families, of).to_json()
        lines.append({**line, "f1": f1})
    return _most_expected(by, lines)


def _slot(
    kind: str, families: Sequence[str], stated: Sequence[int], *reached: Sequence[int]
) -> Figures:
    """Stated slots of a kind; how many, and which share, reached parameters and task prompts."""
    line: Figures = {"kind": kind, "stated": sum(stated)}
    for name, counts in zip(("in_parameters", "in_prompt"), reached, strict=True):
        if None not in counts:
            line[name] = sum(counts)
            line[f"{name}_share"] = clustered_rate(counts, families, stated).to_json()
    return line


def _stops(scores: Sequence[SampleScore]) -> list[Figures]:
    """Where mission plans stop, the most frequent first, with the first ids."""
    ids: dict[tuple[str, str], list[str]] = defaultdict(list)
    for score in scores:
        if stop := score.details.get("stop"):
            ids[stop["condition"], stop["title"]].append(score.id)
    return [
        {"condition": condition, "title": title, "n": len(found), "examples": found[:SHOWN]}
        for (condition, title), found in sorted(ids.items(), key=lambda one: (-len(one[1]), one[0]))
    ]


def _confidence(scores: Sequence[SampleScore]) -> Figures:
    known = [score for score in scores if score.details.get("confidence") is not None]
    if not known:
        return {}
    calibrated = any(score.details.get("calibrated") for score in scores)
    held = [score.details["confidence"] for score in known]
    found = confidence_figures(held, [score.failure is None for score in known])
    beside = {"calibrated": calibrated, "not_known": len(scores) - len(known)}
    return {"confidence": {**beside, **found}}


def confidence_figures(confidence: Sequence[float], right: Sequence[bool]) -> Figures:
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
    order = sorted(zip(confidence, right, strict=True))
    found = groupby(order, key=lambda one: min(int(one[0] * BINS), BINS - 1))
    columns = (zip(*members, strict=True) for _bin, members in found)
    return [(sum(held) / len(held), sum(hits) / len(hits), len(hits)) for held, hits in columns]


def _errors_among_surest(confidence: Sequence[float], right: Sequence[bool]) -> list[float]:
    """Expected wrong answers among the surest k, k from 1."""
    order = sorted(zip(confidence, right, strict=True), key=lambda pair: -pair[0])
    each: list[float] = []
    for _held, tied in groupby(order, key=lambda pair: pair[0]):
        of = [not one for _, one in tied]
        each += [sum(of) / len(of)] * len(of)
    return list(accumulate(each))
