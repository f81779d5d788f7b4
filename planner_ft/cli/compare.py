"""`plannerft compare` and `plannerft report`."""

from __future__ import annotations

from pathlib import Path

from planner_ft.cli.options import command
from planner_ft.support.alone import alone
from planner_ft.support.errors import PlannerError
from planner_ft.support.terminal import show, terminal


@command
def compare(
    runs: list[Path],
    metric: list[str] | None = None,
    against: str | None = None,
    same: bool = False,
    common: bool = False,
    out: Path | None = None,
    overwrite: bool = False,
    json: bool = False,
    seed: int = 0,
) -> None:
    """Compare rows of finished runs."""
    from planner_ft.benchmark.compare import (
        DEFAULT_METRICS,
        CompareSettings,
        compare_runs,
        print_report,
        render_report,
    )
    from planner_ft.benchmark.folder import check_folder
    from planner_ft.support.files import indented_json, write_json, write_text

    if same and against is not None:
        kinds = f"--same compares rows of the same name and --against {against} one row with all"
        raise PlannerError(f"{kinds}: give one of them")
    metrics = tuple(metric or DEFAULT_METRICS)
    with alone(out, "--out", "a comparison"):
        if out is not None:
            former = () if overwrite else ("comparison.json",)
            check_folder(out, former, "give --overwrite or another --out")
        report = compare_runs(CompareSettings(tuple(runs), metrics, against, same, common, seed))
        if out is not None:
            for name, text in render_report(report).items():
                write_text(out / name, text)
            write_json(out / "comparison.json", report.to_json())
    if json:
        show(indented_json(report.to_json()), end="")
    else:
        print_report(report, terminal())


@command
def report(
    runs: list[Path],
    out: Path | None = None,
    data: list[Path] | None = None,
    title: str = "",
    pictures: str = "all",
    card: Path | None = None,
    overwrite: bool = False,
) -> None:
    """Write the report of runs."""
    if card is not None:
        from planner_ft.report.card import write_card

        count = write_card(card, runs)
        show(f"{card / 'README.md'}: {count} measured figures")
        return
    if out is None and len(runs) > 1:
        raise PlannerError("--out is missing: with several runs, name a folder for the report")
    from planner_ft.report.write import write_report

    target, samples = out or runs[0], data or ()
    with alone(target, "--out", "a report"):
        written = write_report(
            runs, target, data=samples, overwrite=overwrite, title=title, pictures=pictures
        )
    counts = [sum(path.parent.name == name for path in written) for name in ("figures", "tables")]
    show(f"{target}/: report.html, figures/ ({counts[0]} files), tables/ ({counts[1]} files)")
