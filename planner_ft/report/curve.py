"""The figure of a learning curve."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import astuple
from pathlib import Path

from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.curve.points import SHOWN, Point
from planner_ft.report.charts import WORDS, Chart, cell
from planner_ft.report.pictures import picture
from planner_ft.support.files import atomic_writer
from planner_ft.support.tables import Table, row


def write_figure(points: Sequence[Point], what: str, out: Path) -> list[Path]:
    """Draw F1, exact sequences and whole plans by number of training samples (`what`) into
    learning-curve.png and .svg in `out`.
    """
    rows = [
        row(METRIC[name].heading.removesuffix(" (%)"), cell(point.size), figure, "")
        for name in SHOWN
        for point in points
        for figure in [cell(*astuple(point.metrics[name]))]
    ]
    words = WORDS["learning-curve"]
    heads = (f"{what} trained on", "share", "")
    table = Table("Line", heads, rows, name="learning-curve", **words)
    written = []
    for suffix, content in picture(Chart("lines", table)).items():
        written.append(out / f"{table.name}.{suffix}")
        with atomic_writer(written[-1], "wb") as stream:
            stream.write(content)
    return written
