"""Which differences between systems are real, as marks, a table and sentences."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from planner_ft.benchmark.contrasts import BEST, NOT_WORSE, Question, contrasts, system_key
from planner_ft.benchmark.verdicts import EXPLAINED, MARKS, p_text
from planner_ft.report.metrics import column
from planner_ft.report.runs import Record, TestSet, within
from planner_ft.support.tables import Cell, Table, figure, row

Compared = Mapping[str, Sequence[Record]]
"""Comparisons by question, as results.json has them, systems named by (alias, configuration)."""


@dataclass(frozen=True)
class Significance:
    """Marks by (system, metric), their meaning, differences, sentences by system on baselines."""

    marks: dict[tuple[str, str], str] = field(default_factory=dict)
    legend: str = ""
    table: Table | None = None
    sentences: dict[str, str] = field(default_factory=dict)


def significance(tests: TestSet) -> Significance:
    """The comparisons that a run has recorded; those of several runs together are made here."""
    names = {system_key((one.alias, one.configuration)): one.name for one in tests.systems}
    known: dict[str, list[Record]] = {}
    for question, lines in (_recorded(tests) or _made(tests)).items():
        ours = [one for one in lines if one["first"] in names and one["second"] in names]
        ends = [{key: names[one[key]] for key in ("first", "second")} for one in ours]
        known[question] = [{**one, **named} for one, named in zip(ours, ends, strict=True)]
    if not any(known.values()):
        return Significance()
    sentences = _by_baseline(known.get("baseline", []))
    return Significance(_marks(known), _legend(known), _table(tests, known), sentences)


def _recorded(tests: TestSet) -> Compared:
    found = tests.results[0].get("comparisons") if len(tests.results) == 1 else None
    return found if isinstance(found, dict) else {}


def _made(tests: TestSet) -> Compared:
    lines: dict[bool, list[Record]] = {False: [], True: []}
    for system in tests.systems:
        named = {"candidate": system.alias, "configuration": system.configuration}
        for of_sample in system.repeats.values():
            lines[system.is_baseline] += [{**line, **named} for line in of_sample]
    seed = int(within(tests.results[0], "manifest", "seed") or 0)
    found: dict[Question, list[Any]] = dict(contrasts(lines[False], lines[True], seed))
    return {question: [one.to_json() for one in made] for question, made in found.items()}


def _marks(found: Compared) -> dict[tuple[str, str], str]:
    """As in table.md: a mark for the comparison of a row, a star for the best and its equals."""
    compared, best = found.get("configuration", []), found.get("best", [])
    marks = {(one["second"], one["metric"]): MARKS.get(one["verdict"], "") for one in compared}
    starred = {(one["first"], one["metric"]) for one in best}
    starred |= {(one["second"], one["metric"]) for one in best if one["verdict"] in NOT_WORSE}
    return marks | {key: marks.get(key, "") + BEST for key in starred}


def _legend(found: Compared) -> str:
    paired = "Marks, paired by sample with the model's first configuration (enforced with free):"
    parts = [f"{paired} {EXPLAINED}."] if found.get("configuration") else []
    if found.get("best"):
        parts.append(f"{BEST} the best of its column, or not shown to be worse.")
    return " ".join(parts)


def _by_baseline(found: Sequence[Record]) -> dict[str, str]:
    """Whether each system beats each baseline by F1, else nothing learnt is shown."""
    verdicts: dict[str, dict[str, bool]] = {}
    for one in found:
        if one["metric"] == "f1":
            verdicts.setdefault(one["second"], {})[one["first"]] = one["verdict"] == "better"
    sentences = {}
    for name, by_first in verdicts.items():
        beaten = [first for first, better in by_first.items() if better]
        others = [first for first, better in by_first.items() if not better]
        parts = [f"beats {' and '.join(beaten)}"] if beaten else []
        parts += [f"is not shown to beat {' or '.join(others)}"] if others else []
        sentences[name] = f"By F1 it {', but '.join(parts)}."
    return sentences


def _table(tests: TestSet, found: Compared) -> Table:
    rows = []
    for one in (one for lines in found.values() for one in lines):
        shown, difference, p = column(one["metric"]), one["difference"], one.get("p_adjusted")
        if difference["value"] is None:
            continue
        decimals = 1 if shown.scale == 100 else 2
        made = figure(**difference, scale=shown.scale, decimals=decimals, sign=True)
        verdict = f"{MARKS.get(one['verdict'], '')} {one['verdict']}".strip()
        cells = Cell(made.plain(), bounds=made.bounds), Cell(p_text(p), bounds=(p, None, None))
        rows.append(row(f"{one['second']} against {one['first']}", shown.heading, *cells, verdict))
    caption = "First minus second, paired by sample, with its 95 % interval; p adjusted after Holm"
    caption += " for each question."
    heads = ("Metric", "Difference", "p", "Verdict")
    return Table(f"{tests.key}-differences", "Differences", caption, "Systems", heads, tuple(rows))
