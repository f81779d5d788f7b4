"""`plannerft compare` and `plannerft report`."""

from __future__ import annotations

from planner_ft.cli.options import AGAIN, Options, command
from planner_ft.support.alone import alone
from planner_ft.support.errors import PlannerError
from planner_ft.support.terminal import show, terminal


@command
def compare(o: Options) -> None:
    """Compare rows of finished runs."""
    from planner_ft.benchmark import compare
    from planner_ft.benchmark.folder import check_folder
    from planner_ft.support.files import indented_json, write_json, write_text

    if o.same and o.against is not None:
        kinds = f"--same compares rows of the same name and --against {o.against} one row with all"
        raise PlannerError(f"{kinds}: give one of them")
    metrics = tuple(o.metric or compare.DEFAULT_METRICS)
    how = (o.against, o.same, o.common, o.seed)
    with alone(o.out, "--out", "a comparison"):
        if o.out is not None:
            check_folder(o.out, ("comparison.json",), AGAIN, overwrite=o.overwrite)
        report = compare.compare_runs(compare.CompareSettings(tuple(o.runs), metrics, *how))
        if o.out is not None:
            for name, text in compare.render_report(report).items():
                write_text(o.out / name, text)
            write_json(o.out / "comparison.json", report.to_json())
    if o.json:
        show(indented_json(report.to_json()), end="")
    else:
        compare.print_report(report, terminal())


@command
def report(o: Options) -> None:
    """Write the report of runs."""
    if o.card is not None:
        from planner_ft.report.card import write_card

        show(f"{o.card / 'README.md'}: {write_card(o.card, o.runs)} measured figures")
        return
    if o.out is None and len(o.runs) > 1:
        raise PlannerError("--out is missing: with several runs, name a folder for the report")
    from planner_ft.report.write import write_report

    target, how = o.out or o.runs[0], o.take("overwrite", "title", "pictures")
    with alone(target, "--out", "a report"):
        written = write_report(o.runs, target, data=o.data or (), **how)
    counts = [sum(path.parent.name == name for path in written) for name in ("figures", "tables")]
    show(f"{target}/: report.html, figures/ ({counts[0]} files), tables/ ({counts[1]} files)")
