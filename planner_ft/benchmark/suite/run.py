"""`plannerft bench --suite`: run what is missing, then write the tables."""

from __future__ import annotations

from pathlib import Path

from planner_ft.benchmark.suite.combine import PartResults, combine
from planner_ft.benchmark.suite.definition import Suite
from planner_ft.benchmark.suite.session import Report, State, opened
from planner_ft.benchmark.suite.tables import write_suite
from planner_ft.benchmark.suite.units import Flags

__all__ = ["State", "run_suite"]


def run_suite(
    suite: Suite,
    out: Path,
    flags: Flags,
    report: Report,
    *,
    resume: bool = False,
    overwrite: bool = False,
) -> list[PartResults]:
    """Run every unit of a suite that is not finished and write the tables of all into `out`.

    A unit that fails is named in the result and in the tables, and the others go on. Raises
    PlannerError for what keeps the suite from starting.
    """
    with opened(suite, out, flags, report, resume=resume, overwrite=overwrite) as session:
        session.run()
        parts, manifest = combine(session)
        write_suite(out, suite.title, parts, manifest)
    return parts
