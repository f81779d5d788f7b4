"""`plannerft skill`: train a skill, or measure it."""

from __future__ import annotations

from pathlib import Path

from planner_ft.cli.options import command, given
from planner_ft.cli.progress import interruptible, resume_command
from planner_ft.support.errors import PlannerError
from planner_ft.support.terminal import show, terminal


@command
def skill(
    action: str,
    name: str,
    recipe: str = "ours",
    out: Path | None = None,
    seed: int = 0,
    iterations: int | None = None,
    environments: int | None = None,
    sampling: str = "uniform",
    without: str | None = None,
    goto: Path | None = None,
    policy: list[Path] | None = None,
    episodes: int = 20,
    resume: bool = False,
    overwrite: bool = False,
) -> None:
    """Train a skill, or measure it beside its baselines."""
    if action not in ("train", "bench"):
        raise PlannerError(f"plannerft skill {action}: must be train or bench")
    if action == "bench":
        _bench(name, policy or [], goto, episodes, seed, out, overwrite)
        return
    from planner_ft.skills.training import SkillTraining, train_skill

    changes = given({"iterations": iterations, "environments": environments}, *_SETTINGS)
    folder = out or Path("skills") / name
    request = SkillTraining(
        *(name, folder, recipe, seed, sampling, without, goto, changes, resume, overwrite)
    )
    with interruptible(lambda: f"continue with: {resume_command()}") as report:
        train_skill(request, report)
    show(f"{folder}: policy.safetensors with card, manifest and log.jsonl")
    show(f"next: plannerft skill bench {name} --policy {folder}")


_SETTINGS = ("iterations", "environments")


def _bench(
    name: str,
    policies: list[Path],
    goto: Path | None,
    episodes: int,
    seed: int,
    out: Path | None,
    overwrite: bool,
) -> None:
    from planner_ft.skills.bench import SkillBench, bench_skill
    from planner_ft.support.tables import terminal_table

    request = SkillBench(name, tuple(policies), goto, episodes, seed, out, overwrite)
    with interruptible() as report:
        tables = bench_skill(request, report)
    for table in tables:
        terminal().print(terminal_table(table))
    if out:
        show(f"{out}: table.md, table.csv, episodes.json and manifest.json")
