"""The comparisons that a table of results makes: configurations of one model, models with the best
one, everything with the baselines; their marks and sentences.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal

from planner_ft.benchmark.catalogue import METRIC, Metric
from planner_ft.benchmark.paired import Paired, Score, paired
from planner_ft.benchmark.verdicts import DEFAULT_METRICS, EXPLAINED, Comparison, adjusted, p_text

Question = Literal["configuration", "best", "baseline"]
"""configuration: a model's configurations with its first one, enforced ones with the free one of
the same weights. best: models in one configuration with the best of them. baseline: every row with
each baseline.
"""
Contrasts = Mapping[Question, Sequence[Comparison]]
System = tuple[str, str]
"""Candidate and configuration."""
Scores = dict[str, list[Score]]
"""The scores of a system by sample id."""

COMPARED = (*DEFAULT_METRICS, "schema_valid")
DECISIVE = ("f1", "whole_plan")
"""The metrics that say whether a baseline is beaten."""
BEST = "★"
NOT_WORSE = ("equal", "not told apart", "better")


def contrasts(
    scores: Iterable[Mapping[str, Any]], baselines: Iterable[Mapping[str, Any]], seed: int
) -> dict[Question, list[Comparison]]:
    """All comparisons from the lines of scores.jsonl and baselines.jsonl, adjusted after Holm
    within each question.
    """
    rows, without_model = by_system(scores), by_system(baselines)
    everything = rows | without_model
    pairs = _configurations(list(rows))
    beside = [(first, second) for second in rows for first in without_model]
    wanted: dict[Question, list[tuple[System, System, Metric]]] = {
        "configuration": [(*pair, metric) for pair in pairs for metric in _metrics(COMPARED)],
        "best": _with_best(rows),
        "baseline": [(*pair, metric) for pair in beside for metric in _metrics(DECISIVE)],
    }

    def compared(first: System, second: System, metric: Metric) -> tuple[str, str, Paired]:
        found = paired(metric, everything[first], everything[second], seed)
        return system_key(first), system_key(second), found

    return {
        question: adjusted([compared(*one) for one in asked]) for question, asked in wanted.items()
    }


def system_key(system: System) -> str:
    """How comparisons name a row: "candidate configuration"."""
    return " ".join(system)


def by_system(scores: Iterable[Mapping[str, Any]]) -> dict[System, Scores]:
    """Lines of scores.jsonl by system, then by sample id."""
    rows: dict[System, Scores] = {}
    for score in scores:
        key = str(score.get("candidate")), str(score.get("configuration"))
        rows.setdefault(key, {}).setdefault(str(score.get("id")), []).append(score)
    return rows


def _metrics(names: Sequence[str]) -> list[Metric]:
    return [metric for name, metric in METRIC.items() if name in names]


def _configurations(systems: Sequence[System]) -> list[tuple[System, System]]:
    """(reference, row) within each candidate."""
    pairs = []
    for candidate, configuration in systems:
        own = [other for name, other in systems if name == candidate]
        free = configuration.partition("+")[0]
        reference = free if free != configuration and free in own else own[0]
        if reference != configuration:
            pairs.append(((candidate, reference), (candidate, configuration)))
    return pairs


def _with_best(rows: Mapping[System, Scores]) -> list[tuple[System, System, Metric]]:
    """Each candidate with the best one of the same configuration, metric by metric; the first of
    those that are equally good.
    """
    found = []
    for configuration in dict.fromkeys(configuration for _candidate, configuration in rows):
        systems = [system for system in rows if system[1] == configuration]
        for metric in _metrics(COMPARED) if len(systems) > 1 else ():
            sign = -1 if metric.better == "↓" else 1
            values = {
                system: metric.value(line for lines in rows[system].values() for line in lines)
                for system in systems
            }
            known = {one: sign * value for one, value in values.items() if value is not None}
            if known:
                best = max(known, key=known.__getitem__)
                found += [(best, system, metric) for system in systems if system != best]
    return found


def marks(found: Contrasts) -> dict[tuple[str, str], str]:
    """Marks by (system, metric): the verdict on the configuration that the row is compared with,
    and ★ for the best of a column and its equals.
    """
    marked = {(one.second, one.paired.metric): one.mark for one in found["configuration"]}
    best = {(one.first, one.paired.metric) for one in found["best"]}
    best |= {(one.second, one.paired.metric) for one in found["best"] if one.verdict in NOT_WORSE}
    return marked | {key: marked.get(key, "") + BEST for key in best}


def legend(found: Contrasts) -> list[str]:
    """The meaning of the marks that a table has."""
    lines = []
    if found["configuration"]:
        reference = "the model's first configuration (enforced with free)"
        lines.append(f"Marks, paired by sample with {reference}: {EXPLAINED}.")
    if found["best"]:
        tests = "same tests, adjusted for all models and metrics"
        lines.append(f"{BEST}: the best of its column, or not shown to be worse ({tests}).")
    return lines


def baseline_sentences(found: Contrasts) -> dict[str, str]:
    """By system: the baselines that it beats, and those that it is not shown to beat."""
    rows: dict[str, list[Comparison]] = {}
    for one in found["baseline"]:
        rows.setdefault(one.second, []).append(one)
    sentences = {}
    for name, comparisons in rows.items():
        beaten = _listed([one for one in comparisons if one.verdict == "better"])
        others = _listed([one for one in comparisons if one.verdict != "better"])
        parts = [f"beats {beaten}"] if beaten else []
        parts += [f"is not shown to beat {others}"] if others else []
        sentences[name] = f"{', but '.join(parts)}."
    return sentences


def contrast_notes(found: Contrasts, baseline_notes: Sequence[str] = ()) -> list[str]:
    """The legend of the marks, and whether each row beats the baselines."""
    beside = baseline_sentences(found).items()
    return [*legend(found), *baseline_notes, *(f"{name} {text}" for name, text in beside)]


def baseline_name(name: str) -> str:
    """A baseline without its configuration."""
    return name.removesuffix(" baseline")


def _listed(comparisons: Sequence[Comparison]) -> str:
    """Baselines with the metrics in brackets."""
    by_first: dict[str, list[str]] = {}
    for one in comparisons:
        text = f"{one.paired.metric.replace('_', ' ')}: p {p_text(one.p_adjusted)}"
        by_first.setdefault(baseline_name(one.first), []).append(text)
    return " and ".join(f"the {name} ({', '.join(found)})" for name, found in by_first.items())
