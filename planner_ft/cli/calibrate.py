"""`plannerft calibrate`."""

from __future__ import annotations

from pathlib import Path

from planner_ft.cli.options import command
from planner_ft.cli.progress import interruptible
from planner_ft.support.alone import alone
from planner_ft.support.terminal import show

SHOWN = {"plan": "plans", "entry": "tasks or skills", "value": "values"}


@command
def calibrate(
    data: list[Path],
    level: str = "mission",
    candidate: str = "embedded",
    configuration: str | None = None,
    adapter: Path | None = None,
    vocabulary: str = "usv",
    device: str = "auto",
    quantization: str | None = None,
    out: Path = Path("eval/runs/calibration"),
) -> None:
    """Calibrate a candidate's confidence."""
    from planner_ft.benchmark.calibrate import calibrate as run
    from planner_ft.vocabulary.plans import check_level

    checked = check_level(level)
    named = {
        "candidate": candidate,
        "vocabulary": vocabulary,
        "device": device,
        "quantization": quantization,
        f"{checked}_configuration": configuration,
        f"{checked}_adapter": adapter,
    }
    with alone(out, "--out", "a calibration"), interruptible() as report:
        path, manifest = run(checked, data, out, report, **named)
    for kind, found in manifest["held_out"].items():
        right = f"{found['n'] - found['wrong']} of {found['n']} {SHOWN[kind]} right"
        area = f"area under risk-coverage {found['aurc']:.4f}, random {found['aurc_random']:.4f}"
        show(f"{right}; calibration error {found['ece']:.3f}; {area}")
    show(f"{path}: how sure the {checked} agent is, of these weights")
