"""`plannerft skill`: train a skill, or measure it."""

from __future__ import annotations

from pathlib import Path

from planner_ft.cli.options import Options, command
from planner_ft.cli.progress import interruptible, resume_command
from planner_ft.support.errors import PlannerError
from planner_ft.support.terminal import show, terminal

TRAINING = ("recipe", "seed", "sampling", "without", "goto", "resume", "overwrite")
BENCH = ("goto", "episodes", "seed", "out", "overwrite")


@command
def skill(o: Options) -> None:
    """Train a skill, or measure it beside its baselines."""
    if o.action == "train":
        _train(o)
    elif o.action == "bench":
        _bench(o)
    else:
        raise PlannerError(f"plannerft skill {o.action}: must be train or bench")


def _train(o: Options) -> None:
    from planner_ft.skills.training import SkillTraining, train_skill

    folder, changes = o.out or Path("skills") / o.name, o.given("iterations", "environments")
    request = SkillTraining(o.name, folder, changes=changes, **o.take(*TRAINING))
    with interruptible(lambda: f"continue with: {resume_command()}") as report:
        train_skill(request, report)
    show(f"{folder}: policy.safetensors with card, manifest and log.jsonl")
    show(f"next: plannerft skill bench {o.name} --policy {folder}")


def _bench(o: Options) -> None:
    from planner_ft.skills.bench import SkillBench, bench_skill
    from planner_ft.support.tables import terminal_table

    request = SkillBench(o.name, tuple(o.policy or ()), **o.take(*BENCH))
    with interruptible() as report:
        tables = bench_skill(request, report)
    for table in tables:
        terminal().print(terminal_table(table))
    if o.out:
        show(f"{o.out}: table.md, table.csv, episodes.json and manifest.json")
