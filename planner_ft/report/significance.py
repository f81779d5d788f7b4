"""Which differences between systems are real: the comparisons of the benchmark as marks, a table
and sentences.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from planner_ft.benchmark.contrasts import BEST, Question, contrasts, system_key
from planner_ft.benchmark.statistics import Estimate
from planner_ft.benchmark.verdicts import EXPLAINED, MARKS, p_text, signed
from planner_ft.report.metrics import column
from planner_ft.report.runs import Record, TestSet
from planner_ft.support.tables import Cell, Table, TableRow

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
    names = {system_key((one.alias, one.configuration)): one.name for one in tests.systems}
    known: dict[str, list[Record]] = {
        question: [
            {**one, "first": names[one["first"]], "second": names[one["second"]]}
            for one in lines
            if one["first"] in names and one["second"] in names
        ]
        for question, lines in (_recorded(tests) or _made(tests)).items()
    }
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
    seed = int(tests.results[0].get("manifest", {}).get("seed") or 0)
    found: dict[Question, list[Any]] = dict(contrasts(lines[False], lines[True], seed))
    return {question: [one.to_json() for one in made] for question, made in found.items()}


def _marks(found: Compared) -> dict[tuple[str, str], str]:
    """As beside the figures of table.md: against the configuration that a row is compared with, and
    a star for the best and its equals.
    """
    compared, best = found.get("configuration", []), found.get("best", [])
    marks = {(one["second"], one["metric"]): MARKS.get(one["verdict"], "") for one in compared}
    starred = {(one["first"], one["metric"]) for one in best}
    starred |= {(one["second"], one["metric"]) for one in best if one["verdict"] in NOT_WORSE}
    return marks | {key: marks.get(key, "") + BEST for key in starred}


def _legend(found: Compared) -> str:
    parts = []
    if found.get("configuration"):
        parts.append(
            "Marks, paired by sample with the model's first configuration (enforced with free):"
            f" {EXPLAINED}."
        )
    if found.get("best"):
        parts.append(f"{BEST} the best of its column, or not shown to be worse.")
    return " ".join(parts)


def _by_baseline(found: Sequence[Record]) -> dict[str, str]:
    """Whether each system beats each baseline by F1: one that does not has learnt nothing that
    could be shown.
    """
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
        difference = Estimate(**one["difference"])
        if difference.value is None:
            continue
        shown = column(one["metric"])
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
