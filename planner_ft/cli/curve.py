"""`plannerft learning-curve`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from planner_ft.cli.options import command, given
from planner_ft.cli.progress import resume_command, status
from planner_ft.cli.train import with_settings
from planner_ft.support.alone import alone
from planner_ft.support.errors import PlannerError
from planner_ft.support.terminal import show

NAMED = ("level", "candidate", "vocabulary", "data_dir")


@with_settings("seed", "max_samples", "keep_checkpoints")
@command
def learning_curve(
    level: str | None = None,
    candidate: str | None = None,
    sizes: str | None = None,
    seeds: int = 3,
    strength: str = "schema",
    vocabulary: str | None = None,
    data_dir: str | None = None,
    data: Path | None = None,
    limit: int | None = None,
    out: Path = Path("eval/runs/learning-curve"),
    resume: bool = False,
    overwrite: bool = False,
    **settings: Any,
) -> None:
    """Train on growing parts of the training set and benchmark each."""
    from planner_ft.benchmark.curve.points import SAMPLES, write_curve
    from planner_ft.benchmark.curve.units import begin, prepare, run_units
    from planner_ft.report.curve import write_figure
    from planner_ft.training.request import build_request

    if resume and overwrite:
        raise PlannerError("--overwrite and --resume exclude each other")
    flags = given(settings, *settings)
    request = build_request(given(locals(), *NAMED), flags)
    curve = prepare(request, out, _sizes(sizes), seeds, strength, data, limit, flags)
    with alone(out, "--out", "a learning curve"):
        begin(curve, resume=resume, overwrite=overwrite)
        with status(lambda: f"go on with: {resume_command()}") as state:
            run_units(curve, state)
            state(0, "tables and figure")
            write_figure(write_curve(curve), SAMPLES[request.level], out)
    show((out / "table.md").read_text(encoding="utf-8"))
    show(
        f"{out}/: table.md, table.csv, learning_curve.json, learning-curve.png, learning-curve.svg"
    )


def _sizes(text: str | None) -> tuple[int, ...] | None:
    try:
        return None if text is None else tuple(int(part) for part in text.split(","))
    except ValueError:
        raise PlannerError(f"--sizes {text}: must be numbers such as 0,8,16") from None
