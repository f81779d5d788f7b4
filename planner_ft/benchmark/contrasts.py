"""The comparisons that a table of results makes: configurations of one model, models with the best
one, everything with the baselines.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

from planner_ft.benchmark.catalogue import CATALOGUE, Metric
from planner_ft.benchmark.paired import Paired, Score, paired
from planner_ft.benchmark.verdicts import DEFAULT_METRICS, LOWER_IS_BETTER, Comparison, adjusted

Question = Literal["configuration", "best", "baseline"]
"""configuration: a model's configurations with its first one, enforced ones with the free one of
the same weights. best: models in one configuration with the best of them. baseline: every row with
each baseline.
"""
System = tuple[str, str]
"""Candidate and configuration."""
Scores = dict[str, list[Score]]
"""The scores of a system by sample id."""

METRICS = (*DEFAULT_METRICS, "schema_valid")
DECISIVE = ("f1", "whole_plan")
"""The metrics that say whether a baseline is beaten."""


def contrasts(
    scores: Sequence[Mapping[str, Any]], baselines: Sequence[Mapping[str, Any]], seed: int
) -> dict[Question, list[Comparison]]:
    """All comparisons from the lines of scores.jsonl and baselines.jsonl, adjusted after Holm
    within each question.
    """
    rows, without_model = _by_system(scores), _by_system(baselines)
    found: dict[Question, list[Comparison]] = {}
    found["configuration"] = _adjusted(
        [
            (first, second, one)
            for first, second in _configurations(rows)
            for one in _paired(rows[first], rows[second], METRICS, seed)
        ]
    )
    found["best"] = _adjusted(_with_best(rows, seed))
    against = [(first, second) for second in rows for first in without_model]
    found["baseline"] = _adjusted(
        [
            (first, second, one)
            for first, second in against
            for one in _paired(without_model[first], rows[second], DECISIVE, seed)
        ]
    )
    return found


def system_key(system: System) -> str:
    """How comparisons name a row: "candidate configuration", as results.json and `plannerft
    compare` do.
    """
    return " ".join(system)


def _by_system(scores: Sequence[Mapping[str, Any]]) -> dict[System, Scores]:
    rows: dict[System, Scores] = {}
    for score in scores:
        rows.setdefault((score["candidate"], score["configuration"]), {}).setdefault(
            score["id"], []
        ).append(score)
    return rows


def _paired(first: Scores, second: Scores, names: Sequence[str], seed: int) -> list[Paired]:
    return [paired(metric, first, second, seed) for metric in CATALOGUE if metric.name in names]


def _adjusted(found: Sequence[tuple[System, System, Paired]]) -> list[Comparison]:
    return adjusted([(system_key(first), system_key(second), one) for first, second, one in found])


def _configurations(rows: Mapping[System, Scores]) -> list[tuple[System, System]]:
    """(against, row) within each candidate."""
    pairs = []
    for candidate, configuration in rows:
        own = [other for name, other in rows if name == candidate]
        free = configuration.partition("+")[0]
        against = free if free != configuration and free in own else own[0]
        if against != configuration:
            pairs.append(((candidate, against), (candidate, configuration)))
    return pairs


def _with_best(rows: Mapping[System, Scores], seed: int) -> list[tuple[System, System, Paired]]:
    """Each candidate with the best one of the same configuration, metric by metric; the first of
    those that are equally good.
    """
    found = []
    for configuration in dict.fromkeys(configuration for _candidate, configuration in rows):
        systems = [system for system in rows if system[1] == configuration]
        for metric in (
            metric for metric in CATALOGUE if metric.name in METRICS and len(systems) > 1
        ):
            best = _best(metric, systems, rows)
            found += [
                (best, system, paired(metric, rows[best], rows[system], seed))
                for system in systems
                if best is not None and system != best
            ]
    return found


def _best(metric: Metric, systems: Sequence[System], rows: Mapping[System, Scores]) -> Any:
    sign = -1 if metric.name in LOWER_IS_BETTER else 1
    values = [(_value(metric, rows[system]), system) for system in systems]
    known = [
        (sign * value, -index, system)
        for index, (value, system) in enumerate(values)
        if value is not None
    ]
    return max(known)[2] if known else None


def _value(metric: Metric, scores: Scores) -> float | None:
    lines = [line for of_sample in scores.values() for line in of_sample]
    if metric.kind == "ratio":
        below = sum(line.get(metric.over[1]) or 0 for line in lines)
        return sum(line.get(metric.over[0]) or 0 for line in lines) / below if below else None
    known = [float(line[metric.name]) for line in lines if line.get(metric.name) is not None]
    return sum(known) / len(known) if known else None
