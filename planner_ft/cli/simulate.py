"""`plannerft simulate` and `plannerft skill`."""

import inspect
from pathlib import Path

from planner_ft.cli.options import Options, command, interruptible, resume_command, show_table
from planner_ft.support.errors import PlannerError
from planner_ft.support.geodesy import parse_origin
from planner_ft.support.terminal import show


@command
def simulate(o: Options) -> None:
    """Run an approved plan in a simulator, or a suite of missions from the command on."""
    if (o.plan is None) == (o.suite is None):
        raise PlannerError("give a plan, or --suite FILE, not both")
    if o.suite is not None:
        _suite(o)
        return
    from planner_ft.planning.locations import parse_locations
    from planner_ft.simulation.asked import SimulationSettings, read_faults, read_outlines
    from planner_ft.simulation.output import outcome_lines, table
    from planner_ft.simulation.run import simulate as run

    settings = o.into(
        SimulationSettings,
        locations=parse_locations(o.locate or []),
        starts=tuple(_place(text) for text in o.start or ()),
        faults=read_faults(o.fault or []),
        origin=parse_origin(o.origin) if o.origin is not None else None,
        outlines=read_outlines(o.outline or []),
    )
    with interruptible(lambda: f"{settings.folder} holds the logs so far") as report:
        done = run(settings, report)
    show_table(table(done, narrow=True))
    for line in outcome_lines(done.results):
        show(line)
    if any("nothing found" in one.reason for one in done.results):
        show("what is to be found is placed with --locate NAME=x,y", error=True)
    show(f"{settings.folder}: table.md, tracks.svg, report.html, results.json and a log per run")


def _suite(o: Options) -> None:
    """Run a suite, which says everything itself but where to."""
    from planner_ft.simulation.suite import SHORT, read_suite, run_suite, suite_table

    own = ("plan", "suite", "out", "overwrite")
    for name, item in inspect.signature(simulate).parameters.items():
        if name not in own and getattr(o, name) != item.default:
            raise PlannerError(
                f"--{name}: a suite says this itself; leave it out or edit {o.suite}"
            )
    suite, out = read_suite(o.suite), o.out or Path(f"{o.suite.stem}.simulation")
    again = f"{out} holds what is done; the same command goes on"
    with interruptible(lambda: again) as report:
        ran = run_suite(suite, out, report, overwrite=o.overwrite)
    show_table(suite_table(suite, ran, SHORT))
    show(f"{out}: table.md, table.csv, and a folder per mission with plan, log and runs")


def _place(text: str) -> tuple[float, float]:
    """A --start. Raises PlannerError."""
    try:
        x, y = (float(part) for part in text.split(","))
    except ValueError:
        raise PlannerError(f'--start {text}: expected "x,y" in metres, such as 12,-4') from None
    if not abs(x) + abs(y) < 1e6:
        raise PlannerError(f"--start {text}: must be within 1000 km of home")
    return x, y


USUAL = {"recipe": "ours", "sampling": "uniform", "episodes": 20}


@command
def skill(o: Options) -> None:
    """Train a skill, or measure it beside its baselines."""
    if o.action == "train":
        _train(o)
    elif o.action == "bench":
        _bench(o)
    else:
        raise PlannerError(f"plannerft skill {o.action}: must be train or bench")


def _refuse(o: Options, why: str, *names: str) -> None:
    """Raise PlannerError for an option that would do nothing."""
    for name, value in o.given(*names).items():
        if value != USUAL.get(name, []):
            raise PlannerError(f"--{name}: {why}")


def _train(o: Options) -> None:
    from planner_ft.skills.training import SkillTraining, train_all, train_skill

    _refuse(o, "is of `skill bench`; leave it out", "policy", "episodes")
    if o.name == "all":
        root, why = o.out or Path("skills"), "is of one skill; name it instead of all"
        own = "without", "goto", "iterations", "environments", "recipe", "sampling"
        _refuse(o, why, *own)
        with interruptible(lambda: f"continue with: {resume_command()}") as report:
            train_all(root, report, **o.take("seed", "resume", "overwrite"))
        show(f"{root}: a folder for each skill, with policy.safetensors, card, manifest and log")
        return
    folder, changes = o.out or Path("skills") / o.name, o.given("iterations", "environments")
    request = o.into(SkillTraining, skill=o.name, out=folder, changes=changes)
    with interruptible(lambda: f"continue with: {resume_command()}") as report:
        train_skill(request, report)
    show(f"{folder}: policy.safetensors with card, manifest and log.jsonl")
    show(f"next: plannerft skill bench {o.name} --policy {folder}")


def _bench(o: Options) -> None:
    from planner_ft.skills.bench import SkillBench, bench_skill

    own = "recipe", "iterations", "environments", "sampling", "without", "resume"
    _refuse(o, "is of `skill train`; leave it out", *own)
    request = o.into(SkillBench, skill=o.name, policies=tuple(o.policy or ()))
    with interruptible() as report:
        tables = bench_skill(request, report)
    for table in tables:
        show_table(table)
    if o.out:
        episodes = ["episodes.json"] if o.name == "survey" else []
        files = ", ".join(["table.md", *(f"{one.name}.csv" for one in tables), *episodes])
        show(f"{o.out}: {files} and manifest.json")
