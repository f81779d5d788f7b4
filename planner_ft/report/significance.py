"""Which differences between systems are real: every row against the first, paired by sample, as marks, a table and sentences."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from planner_ft.benchmark.catalogue import CATALOGUE
from planner_ft.benchmark.compare import DEFAULT_METRICS
from planner_ft.benchmark.paired import paired
from planner_ft.benchmark.verdicts import EXPLAINED, Comparison, adjusted, p_text, signed
from planner_ft.report.metrics import column, columns
from planner_ft.report.runs import System, TestSet
from planner_ft.report.tables import Cell, Table, TableRow

DECISIVE = ("f1", "whole_plan")
"""By these metrics candidates are compared with the baselines."""


@dataclass(frozen=True)
class Significance:
    """Marks by (system, metric), what they mean, a table of differences, and sentences for the summary."""

    marks: dict[tuple[str, str], str] = field(default_factory=dict)
    legend: str = ""
    table: Table | None = None
    sentences: tuple[str, ...] = ()


def significance(tests: TestSet) -> Significance:
    """Compare the other candidates with the first one, and all candidates with the baselines; Holm's adjustment is over all of it."""
    scored = [system for system in tests.systems if system.repeats]
    candidates, baselines = ([system for system in scored if system.is_baseline is kind] for kind in (False, True))
    pairs: list[tuple[System, System, Sequence[str]]] = [(candidates[0], other, DEFAULT_METRICS) for other in candidates[1:]]
    pairs += [(baseline, candidate, DECISIVE) for baseline in baselines for candidate in candidates]
    found = _compared(pairs, int(tests.results[0].get("manifest", {}).get("seed") or 0))
    if not found:
        return Significance()
    first = candidates[0].name
    among = [one for one in found if one.first == first]
    legend = f"Marks compare with {first}, paired by sample: {EXPLAINED}." if among else ""
    marks = {(one.second, one.paired.metric): one.mark for one in among}
    sentences = [_against_baselines(candidate, [one for one in found if one.second == candidate.name and one.first != first]) for candidate in candidates]
    return Significance(marks, legend, _table(tests, found), tuple(text for text in sentences if text))


def _compared(pairs: Sequence[tuple[System, System, Sequence[str]]], seed: int) -> list[Comparison]:
    """What both systems have figures of."""
    known = {metric.name: metric for metric in CATALOGUE}
    found = [(one.name, other.name, paired(known[name], one.repeats, other.repeats, seed)) for one, other, names in pairs for name in names]
    return adjusted([entry for entry in found if entry[2].difference.value is not None])


def _against_baselines(candidate: System, found: Sequence[Comparison]) -> str:
    """Whether a candidate beats each baseline by F1: one that does not has learnt nothing that could be shown."""
    by_f1 = {one.first: one.verdict == "better" for one in found if one.paired.metric == "f1"}
    if not by_f1:
        return ""
    beaten, others = ([name for name, better in by_f1.items() if better is kind] for kind in (True, False))
    parts = [f"beats {' and '.join(beaten)} by F1"] if beaten else []
    parts += [f"is not shown to beat {' or '.join(others)} by F1"] if others else []
    return f"{candidate.name} {', but '.join(parts)}."


def _table(tests: TestSet, found: Sequence[Comparison]) -> Table:
    known = columns()
    rows = []
    for one in found:
        shown = column(one.paired.metric, known)
        bounds = (one.paired.difference.value, one.paired.difference.low, one.paired.difference.high)
        scaled = tuple(None if bound is None else bound * shown.scale for bound in bounds)
        cells = (
            Cell(shown.heading),
            Cell(signed(one.paired.difference, shown.scale, max(shown.decimals, 2 if shown.scale == 1 else 1)), bounds=(scaled[0], scaled[1], scaled[2])),
            Cell(p_text(one.p_adjusted), bounds=(one.p_adjusted, None, None)),
            Cell(f"{one.mark} {one.verdict}".strip()),
        )
        rows.append(TableRow(f"{one.second} against {one.first}", cells))
    caption = "Second minus first with its 95 % interval; p adjusted after Holm over this table."
    heads = ("Metric", "Difference", "p", "Verdict")
    return Table(f"{tests.key}-differences", "Differences, paired by sample", caption, "Systems", heads, tuple(rows))
