"""The loss curve as a picture."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

from planner_ft.support.files import atomic_writer


def plot_losses(records: list[dict[str, Any]], folder: Path, title: str) -> None:
    """Write `loss.png` and `loss.svg` from the records of a log: training loss a step and its mean,
    validation loss.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib.figure import Figure

    steps = [record for record in records if "loss" in record]
    validations = [record for record in records if "validation_loss" in record]
    figure = Figure(figsize=(7, 4), layout="constrained")
    axes = figure.subplots()
    axes.plot(
        [r["step"] for r in steps],
        [r["loss"] for r in steps],
        color="tab:blue",
        alpha=0.25,
        linewidth=0.8,
        label="training, each step",
    )
    axes.plot(
        [r["step"] for r in steps],
        running_mean([r["loss"] for r in steps]),
        color="tab:blue",
        label="training, running mean",
    )
    if validations:
        axes.plot(
            [r["step"] for r in validations],
            [r["validation_loss"] for r in validations],
            "o-",
            color="tab:orange",
            label="validation",
        )
    axes.set(xlabel="optimiser step", ylabel="cross-entropy per completion token", title=title)
    axes.set_ylim(bottom=0)
    axes.grid(alpha=0.3)
    axes.legend()
    for suffix, options in (("png", {"dpi": 150}), ("svg", {"metadata": {"Date": None}})):
        buffer = io.BytesIO()
        figure.savefig(buffer, format=suffix, **options)
        with atomic_writer(folder / f"loss.{suffix}", "wb") as stream:
            stream.write(buffer.getvalue())


def running_mean(values: list[float]) -> list[float]:
    """Mean over the last values, a thirtieth of all of them."""
    window = max(1, len(values) // 30)
    means, total = [], 0.0
    for index, value in enumerate(values):
        total += value - (values[index - window] if index >= window else 0.0)
        means.append(total / min(index + 1, window))
    return means
