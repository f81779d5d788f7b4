"""From the scores and timed queries of samples to figures with intervals."""

import math
from collections import defaultdict
from collections.abc import Hashable, Iterable, Mapping, Sequence
from typing import Any

from planner_ft.benchmark import statistics
from planner_ft.benchmark.catalogue import METRIC, Metric
from planner_ft.benchmark.statistics import Estimate
from planner_ft.vocabulary.plans import is_number

OF_GROUPS = ("f1", "exact_sequence", "parameters", "whole_plan", "strict_valid")
QUANTILES = (("median", 0.5), ("p90", 0.9), ("p99", 0.99))
BESIDE = ("load_s", "adapter_swap_s", "peak_memory_bytes")
"""Costs of a candidate that do not belong to a query: run.json has them."""
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
        return statistics.clustered_rate([top == 1 for top in tops], families)
    estimate = statistics.bootstrap_ratio(tops, belows, families, seed)
    if metric.fraction and estimate.value in (0, 1):
        return statistics.clustered_rate([estimate.value == 1] * len(families), families)
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
    found: dict[tuple[str, str, str], list[Figures]] = {}
    for score in scores:
        if score.get("group"):
            key = score["candidate"], score["configuration"], score["group"]
            # Scores of earlier versions do not say whether the whole plan is right.
            right = score["failure"] is None
            found.setdefault(key, []).append({**score, "whole_plan": right})
    names = ("candidate", "configuration", "group")
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
    attempts: dict[str, list[bool]] = {}
    for score in scores:
        attempts.setdefault(score["id"], []).append(score["failure"] is None)
    family = {score["id"]: score["family"] for score in scores}
    families = [family[name] for name in attempts]
    counts = [(sum(right), len(right)) for right in attempts.values()]
    found: Figures = {"k": min((n for _right, n in counts), default=0)}
    for kind, estimator in {"all_of_k": all_of, "any_of_k": any_of}.items():
        found[kind] = {}
        for k in range(1, found["k"] + 1):
            values = [estimator(right, n, k) for right, n in counts]
            found[kind][str(k)] = statistics.bootstrap_mean(values, families, seed).to_json()
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
    clusters = [families.get(name, name) for name in known]
    if lines:
        seconds = [float(line["latency_s"]) for line in lines]
        shares = {name: statistics.quantile(seconds, share) for name, share in QUANTILES}
        figures["latency_s"] = {name: share.to_json() for name, share in shares.items()}
        first = [line.get("first_token_s") for line in lines]
        pairs = [(one, of) for one, of in zip(first, clusters, strict=True) if one is not None]
        if pairs:
            times, own = zip(*pairs, strict=True)
            figures["first_token_s"] = statistics.bootstrap_mean(times, own, seed).to_json()
        if all(is_number(line.get("tokens")) for line in lines):
            tokens = [float(line["tokens"]) for line in lines]
            rate = statistics.bootstrap_ratio(tokens, seconds, clusters, seed)
            figures["tokens_per_s"] = rate.to_json()
        figures["n"] = len(lines)
    figures |= {name: beside[name] for name in BESIDE if beside.get(name) is not None}
    return figures | ({"planning": _planning_times(planning, seed)} if planning else {})


def _planning_times(lines: Sequence[Mapping[str, Any]], seed: int) -> list[Figures]:
    """Seconds to plan by number of tasks planned, and each agent's; no invalid plans."""
    by_tasks: dict[int, list[Mapping[str, Any]]] = {}
    for line in lines:
        if line.get("tasks"):
            by_tasks.setdefault(int(line["tasks"]), []).append(line)
    made = []
    for tasks, found in sorted(by_tasks.items()):
        seconds, ids = [line["seconds"] for line in found], [line["id"] for line in found]
        whole = statistics.bootstrap_mean(seconds, ids, seed).to_json()
        figures: Figures = {"tasks": tasks, "n": len(found), "seconds": whole}
        for agent in ("mission_s", "task_s"):
            figures[agent] = sum(line[agent] for line in found) / len(found)
        made.append(figures)
    return made
