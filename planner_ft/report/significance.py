"""Which differences between systems are real: the comparisons of the benchmark as marks, a table
and sentences.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from planner_ft.benchmark.contrasts import Question, contrasts, system_key
from planner_ft.benchmark.contrasts_text import BEST
from planner_ft.benchmark.statistics import Estimate
from planner_ft.benchmark.verdicts import EXPLAINED, MARKS, p_text, signed
from planner_ft.report.metrics import column, columns
from planner_ft.report.runs import Record, System, TestSet
from planner_ft.report.tables import Cell, Table, TableRow

NOT_WORSE = ("better", "equal", "not told apart")
Compared = Mapping[str, Sequence[Record]]
"""Comparisons by question, as results.json has them, systems named by (alias, configuration)."""


@dataclass(frozen=True)
class Significance:
    """Marks by (system, metric), what they mean, a table of differences, and sentences on the
    baselines by system.
    """

    marks: dict[tuple[str, str], str] = field(default_factory=dict)
    legend: str = ""
    table: Table | None = None
    sentences: dict[str, str] = field(default_factory=dict)


def significance(tests: TestSet) -> Significance:
    """The comparisons that a run has recorded; those of several runs together are made here, by the
    same tests.
    """
    found = _recorded(tests) or _made(tests)
    names = {
        system_key((system.alias, str(system.row.get("configuration")))): system.name
        for system in tests.systems
    }
    known: dict[str, list[Record]] = {
        question: [
            {**one, "first": names[one["first"]], "second": names[one["second"]]}
            for one in lines
            if one["first"] in names and one["second"] in names
        ]
        for question, lines in found.items()
    }
    if not any(known.values()):
        return Significance()
    return Significance(
        _marks(known),
        _legend(known),
        _table(tests, known),
        _against_baselines(known.get("baseline", [])),
    )


def _recorded(tests: TestSet) -> Compared:
    found = tests.results[0].get("comparisons") if len(tests.results) == 1 else None
    return found if isinstance(found, dict) else {}


def _made(tests: TestSet) -> Compared:
    lines = {
        kind: [
            _named(system, line)
            for system in tests.systems
            if system.is_baseline is kind
            for line in _lines(system)
        ]
        for kind in (False, True)
    }
    found: dict[Question, list[Any]] = dict(
        contrasts(
            lines[False], lines[True], int(tests.results[0].get("manifest", {}).get("seed") or 0)
        )
    )
    return {
        question: [one.to_json() for one in comparisons] for question, comparisons in found.items()
    }


def _lines(system: System) -> list[Record]:
    return [line for of_sample in system.repeats.values() for line in of_sample]


def _named(system: System, line: Record) -> Record:
    return {
        **line,
        "candidate": system.alias,
        "configuration": str(system.row.get("configuration")),
    }


def _marks(found: Compared) -> dict[tuple[str, str], str]:
    """As beside the figures of table.md: against the configuration that a row is compared with, and
    a star for the best and its equals.
    """
    marks = {
        (one["second"], one["metric"]): MARKS.get(one["verdict"], "")
        for one in found.get("configuration", [])
    }
    best = {(one["first"], one["metric"]) for one in found.get("best", [])}
    best |= {
        (one["second"], one["metric"])
        for one in found.get("best", [])
        if one["verdict"] in NOT_WORSE
    }
    return marks | {key: marks.get(key, "") + BEST for key in best}


def _legend(found: Compared) -> str:
    parts = (
        [
            "Marks, paired by sample with the model's first configuration (enforced with free):"
            f" {EXPLAINED}."
        ]
        if found.get("configuration")
        else []
    )
    if found.get("best"):
        parts.append(f"{BEST} the best of its column, or not shown to be worse.")
    return " ".join(parts)


def _against_baselines(found: Sequence[Record]) -> dict[str, str]:
    """Whether each system beats each baseline by F1: one that does not has learnt nothing that
    could be shown.
    """
    sentences = {}
    for name in dict.fromkeys(one["second"] for one in found):
        by_f1 = {
            one["first"]: one["verdict"] == "better"
            for one in found
            if one["second"] == name and one["metric"] == "f1"
        }
        beaten, others = (
            [first for first, better in by_f1.items() if better is kind] for kind in (True, False)
        )
        parts = [f"beats {' and '.join(beaten)}"] if beaten else []
        parts += [f"is not shown to beat {' or '.join(others)}"] if others else []
        if parts:
            sentences[name] = f"By F1 it {', but '.join(parts)}."
    return sentences


def _table(tests: TestSet, found: Compared) -> Table:
    known = columns()
    rows = []
    for one in (one for lines in found.values() for one in lines):
        difference = Estimate(**one["difference"])
        if difference.value is None:
            continue
        shown = column(one["metric"], known)
        low, value, high = (
            None if bound is None else bound * shown.scale
            for bound in (difference.low, difference.value, difference.high)
        )
        cells = (
            Cell(shown.heading),
            Cell(
                signed(difference, shown.scale, 1 if shown.scale == 100 else 2),
                bounds=(value, low, high),
            ),
            Cell(p_text(one.get("p_adjusted")), bounds=(one.get("p_adjusted"), None, None)),
            Cell(f"{MARKS.get(one['verdict'], '')} {one['verdict']}".strip()),
        )
        rows.append(TableRow(f"{one['second']} against {one['first']}", cells))
    caption = (
        "First minus second, paired by sample, with its 95 % interval; p adjusted after Holm for"
        " each question."
    )
    heads = ("Metric", "Difference", "p", "Verdict")
    return Table(f"{tests.key}-differences", "Differences", caption, "Systems", heads, tuple(rows))
