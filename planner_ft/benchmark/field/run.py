"""Running field cases through planners, and how many come out right, by kind."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from planner_ft.benchmark.field.cases import Case
from planner_ft.benchmark.field.checks import Outcome, passes
from planner_ft.benchmark.folder import RESULTS
from planner_ft.benchmark.statistics import wilson
from planner_ft.support.files import write_json, write_jsonl, write_text
from planner_ft.support.tables import Table, TableRow, figure, markdown_table, row
from planner_ft.vocabulary import Vocabulary

PLANS, TABLE = "plans.jsonl", "table.md"
FILES = (RESULTS, PLANS, TABLE)
Plan = Callable[[Case], Outcome]


@dataclass(frozen=True)
class Judged:
    """A case that was run: the checks that failed, and whether it failed dangerously in silence."""

    case: Case
    outcome: Outcome
    failed: tuple[Any, ...]

    @property
    def right(self) -> bool:
        return not self.failed

    @property
    def dangerous(self) -> bool:
        return bool(self.failed) and self.case.danger and self.outcome.silent

    def as_json(self) -> dict[str, Any]:
        verdict = {"right": self.right, "dangerous_and_silent": self.dangerous}
        said = {"warnings": self.outcome.warnings, "error": self.outcome.error}
        return {
            "id": self.case.id,
            "kind": self.case.kind,
            **verdict,
            "failed": self.failed,
            **said,
        }


@dataclass(frozen=True)
class FieldRow:
    """All cases in one configuration of a candidate."""

    candidate: str
    configuration: str
    judged: tuple[Judged, ...]

    @property
    def name(self) -> str:
        return f"{self.candidate} {self.configuration}"

    def kinds(self) -> dict[str, list[Judged]]:
        """The cases by kind, in the order of the file."""
        found: dict[str, list[Judged]] = {}
        for one in self.judged:
            found.setdefault(one.case.kind, []).append(one)
        return found

    def as_json(self) -> dict[str, Any]:
        kinds = {kind: counts(some) for kind, some in self.kinds().items()}
        named = {"candidate": self.candidate, "configuration": self.configuration}
        cases = [one.as_json() for one in self.judged]
        return {**named, **counts(self.judged), "kinds": kinds, "cases": cases}


def counts(judged: Sequence[Judged]) -> dict[str, Any]:
    """How many are right, of how many, with the interval of the rate, and what is dangerous."""
    right = sum(one.right for one in judged)
    rate = wilson(right, len(judged)).to_json()
    silent = sum(one.dangerous for one in judged)
    return {"right": right, "of": len(judged), "rate": rate, "dangerous_and_silent": silent}


def judge(
    cases: Sequence[Case],
    plan: Plan,
    vocabulary: Vocabulary,
    progress: Callable[[str, int, int], None],
    label: str,
) -> tuple[Judged, ...]:
    """Plan every case and check the plan."""
    done = []
    for number, case in enumerate(cases, start=1):
        outcome = plan(case)
        failed = tuple(check for check in case.expect if not passes(check, outcome, vocabulary))
        done.append(Judged(case, outcome, failed))
        progress(label, number, len(cases))
    return tuple(done)


def field_table(rows: Sequence[FieldRow]) -> Table:
    """Right, of and the rate by kind of case; the last row of each configuration counts all."""
    lines: list[TableRow] = []
    for one in rows:
        lines.append(row(one.name, kind="section"))
        lines += [_line(kind, some) for kind, some in one.kinds().items()]
        lines.append(_line("all", one.judged))
    columns = ("right", "of", "% [95 %]", "dangerous and silent")
    caption = (
        "Wilson intervals. Dangerous and silent: a dangerous case that failed without a warning."
    )
    return Table("field", "Field cases.", caption, "kind", columns, tuple(lines))


def _line(kind: str, judged: Sequence[Judged]) -> TableRow:
    found = counts(judged)
    rate = found["rate"]
    share = figure(rate["value"], rate["low"], rate["high"], scale=100, decimals=0)
    silent = str(found["dangerous_and_silent"])
    return row(kind, str(found["right"]), str(found["of"]), share, silent)


def failures(rows: Iterable[FieldRow]) -> list[str]:
    """A line per case that failed: its command and the checks."""
    return [
        f"{one.case.id} ({one.case.kind}): {one.case.command!r} fails {list(one.failed)}"
        for row_ in rows
        for one in row_.judged
        if one.failed
    ]


def write_field(folder: Path, rows: Sequence[FieldRow], manifest: dict[str, Any]) -> None:
    """Write plans.jsonl, table.md and results.json, which comes last."""
    plans = [
        {"id": one.case.id, "candidate": row_.candidate, "configuration": row_.configuration}
        | asdict(one.outcome)
        for row_ in rows
        for one in row_.judged
    ]
    write_jsonl(folder / PLANS, plans)
    below = "".join(f"- {line}\n" for line in failures(rows))
    write_text(folder / TABLE, f"{markdown_table(field_table(rows))}\n{below}")
    write_json(folder / RESULTS, {"rows": [one.as_json() for one in rows], "manifest": manifest})
