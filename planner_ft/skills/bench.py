"""`plannerft skill bench`: policies beside baselines and published figures, with intervals."""

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np
import torch

from planner_ft.benchmark.statistics import bootstrap_mean, clustered_rate, wilson
from planner_ft.simulation.asked import Faults
from planner_ft.simulation.executor import Running, Stage
from planner_ft.simulation.fast import Bools, FastSimulator, Floats
from planner_ft.simulation.scene import Scene
from planner_ft.simulation.skill import Job
from planner_ft.simulation.world import World
from planner_ft.skills.dynamics import Guidance, published_vessel
from planner_ft.skills.episodes import Actor, Episode, contour_follower, oracle, play
from planner_ft.skills.geometry import HELD_OUT, PUBLISHED
from planner_ft.skills.policies import MANIFEST, SKILLS, WEIGHTS, Policy, read_policy
from planner_ft.skills.survey import Task
from planner_ft.support.alone import alone
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import (
    make_folder,
    read_csv,
    read_json,
    sha256_file,
    write_json,
    write_text,
)
from planner_ft.support.geodesy import Origin
from planner_ft.support.manifest import build_manifest
from planner_ft.support.tables import Table, TableRow, csv_table, figure, markdown_table, row
from planner_ft.support.terminal import Report
from planner_ft.vocabulary.definition import Motion

KIND = "skill bench"
FILES = {MANIFEST, "table.md", "episodes.json"} | {
    f"{name}.csv" for name in ("classes", "conditions", "goto", "hold")
}
"""What a bench writes, the manifest first: it tells whose folder it is."""
MOST = 500
ROUNDING = 1.5
COLUMNS = ("success % ↑", "collision % ↓", "lost % ↓", "stand-off m ↓", "steps")
CONDITIONS: dict[str, tuple[tuple[str, ...], Task]] = {
    "published conditions": (tuple(PUBLISHED), Task()),
    "other families: star, U, two circles": (tuple(HELD_OUT), Task()),
    "current 0.15 to 0.25 m/s": (tuple(PUBLISHED), Task(current=(0.15, 0.25))),
    "25 % of the rays lost": (tuple(PUBLISHED), Task(lost=0.25)),
    "stand-off 3 m": (tuple(PUBLISHED), Task(standoff=(3.0, 3.0))),
    "stand-off 8 m": (tuple(PUBLISHED), Task(standoff=(8.0, 8.0))),
}
"""Conditions by name: families, and what is drawn. All but the first are held out."""
CAPTION = (
    "Means over episodes with 95 % intervals (rates: Wilson; means: bootstrap over episodes). Success:"
    " a whole lap; stand-off: mean distance from the commanded one over all time steps, the"
    " approach included. Seeds of one training are shown one by one and pooled, each object a"
    " cluster. Published figures are of another simulator; what the study does not say was chosen."
)


@dataclass(frozen=True)
class SkillBench:
    """What is measured. `policies` are folders; the one that ships comes first."""

    skill: str
    policies: tuple[Path, ...] = ()
    goto: Path | None = None
    episodes: int = 20
    seed: int = 0
    out: Path | None = None
    overwrite: bool = False

    def __post_init__(self) -> None:
        """Raise PlannerError for what there is not."""
        if self.skill not in SKILLS:
            raise PlannerError(f"{self.skill}: must be one of {', '.join(SKILLS)}")
        if not 1 <= self.episodes <= MOST:
            raise PlannerError(f"--episodes {self.episodes}: must be from 1 to {MOST}")
        if self.goto and self.skill != "survey":
            raise PlannerError("--goto: is of `skill bench survey` alone; give --policy instead")
        if not (self.out and self.out.is_dir()):
            return
        found = {path.name for path in self.out.iterdir() if not path.name.startswith(".")}
        if found and not self.overwrite:
            hint = "give --overwrite to replace it, or another folder"
            raise PlannerError(f"--out {self.out}: holds files; {hint}")
        if foreign := sorted(found - FILES) or (
            found and not _is_bench(self.out) and sorted(found)
        ):
            problem = f"holds {foreign[0]}, which is not of a bench of a skill"
            raise PlannerError(f"--out {self.out}: {problem}; give another folder")


def _is_bench(folder: Path) -> bool:
    """Whether the manifest in a folder is a bench's."""
    manifest = read_json(folder / MANIFEST) if (folder / MANIFEST).is_file() else None
    return isinstance(manifest, dict) and manifest.get("kind") == KIND


def bench_skill(request: SkillBench, report: Report) -> list[Table]:
    """Measure and write what is asked for; the tables. Raises PlannerError."""
    torch.set_num_threads(1)  # batches are small, and runs are many
    policies = [read_policy(request.skill, one) for one in (None, *request.policies)]
    with alone(request.out, "--out", "a bench"):
        if request.out:
            make_folder(request.out)
        if request.skill != "survey":
            tables = [tracking_table(request, policies, report)]
            played: Any = {}
        else:
            played = _play_all(request, policies, report)
            played |= pooled(policies[1:], played)
            tables = [class_table(played, request.seed), condition_table(played, request.seed)]
            tables = [_with_goto(one, request.goto) for one in tables]
        if request.out:
            _write(request, request.out, policies, tables, played)
    return tables


def _with_goto(table: Table, goto: Path | None) -> Table:
    """The table with the GoToXY policy of its surveys named, where it is not the one that ships."""
    if goto is None:
        return table
    named = f"GoToXY: {goto}, sha256 {sha256_file(goto / WEIGHTS)[:12]}."
    return replace(table, caption=f"{table.caption} {named}")


Played = dict[str, dict[str, list[Episode]]]  # episodes by policy or baseline, and by condition


def _play_all(request: SkillBench, policies: Sequence[Policy], report: Report) -> Played:
    tracker: Any = read_policy("goto", request.goto).module
    guidance: Any = Guidance(tracker)
    actors: dict[str, tuple[Actor | Policy, Any]] = {
        name: (policy, tracker) for name, policy in _named(policies).items()
    }
    actors["contour follower"] = contour_follower, tracker
    actors["contour follower, guidance and PID"] = contour_follower, guidance
    actors["oracle: offset path"] = oracle, tracker
    played: Played = {name: {} for name in actors}
    total, done = len(actors) * len(CONDITIONS), 0
    for condition, (families, task) in CONDITIONS.items():
        each = [family for family in families for _episode in range(request.episodes)]
        for name, (who, drives) in actors.items():
            report("survey bench", done, total)
            own = replace(task, rounding=ROUNDING if name.startswith("oracle") else None)
            actor = _fresh(who) if isinstance(who, Policy) else who
            played[name][condition] = play(actor, drives, own, each, request.seed)
            done += 1
    report("survey bench", total, total)
    return played


def _named(policies: Sequence[Policy]) -> dict[str, Policy]:
    """Policies by their names in tables; the first one ships."""
    shipped, *others = policies
    return {"learnt, shipped": shipped} | {f"learnt, {one.path.parent}": one for one in others}


def pooled(policies: Sequence[Policy], played: Played) -> Played:
    """The episodes of policies that were trained alike but for the seed, together."""
    alike: dict[Any, dict[int, str]] = {}
    for policy in policies:
        manifest = policy.path.parent / MANIFEST
        settings = read_json(manifest)["configuration"] if manifest.is_file() else {}
        if "seed" in settings:
            seed, name = settings.pop("seed"), f"learnt, {policy.path.parent}"
            alike.setdefault(tuple(sorted(settings.items())), {})[seed] = name
    found: Played = {}
    for items, by_seed in alike.items():
        settings = dict(items)
        words = [settings[key] for key in ("recipe", "sampling") if settings.get(key)]
        words += [f"without {term}"] if (term := settings.get("without")) else []
        parts = [played[name] for name in by_seed.values()]
        if len(parts) > 1:
            name = f"learnt, {', '.join(words)}, {len(parts)} seeds"
            found[name] = {kind: [one for own in parts for one in own[kind]] for kind in parts[0]}
    return found


def _fresh(policy: Policy) -> Actor:
    """A policy with an empty memory."""
    module: Any = policy.module
    module.memory = None
    torch.manual_seed(0)
    return module.act  # type: ignore[no-any-return]


def class_table(played: Played, seed: int) -> Table:
    """A section per policy or baseline, a row per shape class, and the published figures."""
    first, rows = next(iter(CONDITIONS)), list[TableRow]()
    for name, by_condition in played.items():
        episodes = by_condition[first]
        rows.append(row(name, kind="section"))
        kinds = dict.fromkeys(one.family for one in episodes)
        for kind in kinds:
            rows.append(_row(kind, [one for one in episodes if one.family == kind], seed))
        rows.append(_row("all", episodes, seed))
    published = read_csv(Path(__file__).with_name("published.csv"))
    for policy, lines in groupby(published, key=lambda line: line["policy"]):
        rows.append(row(f"published: {policy}", kind="section"))
        for line in lines:
            cells = [
                figure(float(line[name]) if line[name] else None, decimals=decimals)
                for name, decimals in (*((one, 0) for one in _RATES), ("error", 2), ("steps", 0))
            ]
            rows.append(row(line["class"], *cells, kind="published"))
    return Table("", COLUMNS, rows, name="classes", title="By shape class.", caption=CAPTION)


def condition_table(played: Played, seed: int) -> Table:
    """A section per condition, a row per policy or baseline."""
    rows = list[TableRow]()
    for condition in CONDITIONS:
        rows.append(row(condition, kind="section"))
        for name, by_condition in played.items():
            rows.append(_row(name, by_condition[condition], seed))
    caption = "Over all classes; every condition but the first lies beyond what was trained on."
    return Table("", COLUMNS, rows, name="conditions", title="By condition.", caption=caption)


_RATES = ("success", "collision", "lost")


def _row(name: str, episodes: Sequence[Episode], seed: int) -> TableRow:
    objects = [one.number for one in episodes]  # pooled seeds share them
    rates = [clustered_rate([one.outcome == kind for one in episodes], objects) for kind in _RATES]
    error = bootstrap_mean([one.error for one in episodes], objects, seed)
    steps = bootstrap_mean([float(one.steps) for one in episodes], objects, seed)
    cells = [one.cell(scale=100, decimals=0) for one in rates]
    return row(name, *cells, error.cell(), steps.cell(decimals=0))


def _write(
    request: SkillBench, out: Path, policies: list[Policy], tables: list[Table], played: Played
) -> None:
    names = ["shipped", *map(str, request.policies)]
    digests = {name: sha256_file(one.path) for name, one in zip(names, policies, strict=True)}
    configuration = {"skill": request.skill, "episodes": request.episodes, "policies": digests}
    if played:
        goto = read_policy("goto", request.goto).path
        configuration["goto"] = {str(request.goto or "shipped"): sha256_file(goto)}
    manifest = build_manifest(KIND, seed=request.seed, configuration=configuration)
    write_json(out / MANIFEST, manifest)
    for name in FILES - {MANIFEST}:
        (out / name).unlink(missing_ok=True)
    write_text(out / "table.md", "\n".join(markdown_table(one) for one in tables))
    for one in tables:
        write_text(out / f"{one.name}.csv", csv_table(one))
    episodes = {
        name: {condition: [asdict(one) for one in some] for condition, some in by.items()}
        for name, by in played.items()
    }
    if played:
        write_json(out / "episodes.json", episodes)


# ----------------------------------- GoToXY and StationKeep, in the simulator of missions


CURRENTS = {"published current": 1.0, "twice the published current": 2.0}
AWAY = (5.0, 30.0)  # metres from a goal at the start
SECONDS, PATIENCE = 60.0, 120.0  # how long a place is held, and how long a way may take
TRACKED = {
    "goto": (("arrived % ↑", "waypoint m ↓", "seconds ↓"), "0.93 to 0.97"),
    "hold": (("stayed % ↑", "holding m ↓", "after 20 s, m ↓"), "0.12 to 0.43"),
}
"""Columns, and what was published for the second."""
TRACKING = (
    "In the simulator of missions, position by GPS and dead reckoning, errors against the truth;"
    " means with 95 % intervals (rates: Wilson; means: bootstrap over episodes). Waypoint: the"
    " distance when a way ends, tolerance 1 m; holding: mean distance over 60 s, from up to 1 m off."
)


def tracking_table(request: SkillBench, policies: Sequence[Policy], report: Report) -> Table:
    """A section per current, a row per policy and for guidance."""
    skill, seed, (columns, published) = request.skill, request.seed, TRACKED[request.skill]
    implementations: dict[str, dict[str, Any]] = {
        name: {"implementation": f"learnt-{skill}", "policy": str(policy.path.parent)}
        for name, policy in _named(policies).items()
    }
    implementations["guidance and PID"] = {}
    rows, total, done = list[TableRow](), len(CURRENTS) * len(implementations), 0
    for current, factor in CURRENTS.items():
        rows.append(row(current, kind="section"))
        for name, settings in implementations.items():
            report(f"{skill} bench", done, total)
            arrived, *figures = measure(request, settings, factor)
            rate = wilson(int(arrived.sum()), len(arrived)).cell(scale=100, decimals=0)
            means = [bootstrap_mean(one.tolist(), range(len(one)), seed) for one in figures]
            rows.append(row(name, rate, *(one.cell() for one in means)))
            done += 1
    report(f"{skill} bench", total, total)
    shown = figure(None), published, figure(None)
    rows += [row("published", kind="section"), row("", *shown, kind="published")]
    return Table("", columns, rows, name=skill, caption=TRACKING)


def measure(
    request: SkillBench, settings: dict[str, Any], factor: float
) -> tuple[Bools, Floats, Floats]:
    """Which episodes came to their end, and two figures of each (n,)."""
    hold, count = request.skill == "hold", request.episodes
    scene = _scene(count, hold, factor, request.seed)
    motion, seconds = Motion("hold" if hold else "go", {}), SECONDS if hold else None
    stay: dict[str, Any] = {"points": ((0.0, 0.0),), "seconds": seconds}
    job = Job("skill", {}, motion, settings, speed=scene.vessel.speed, **stay)
    running = Running(Stage("bench", 0, job, (), (), PATIENCE, ()), scene)
    everyone = np.arange(count)
    running.start(everyone)
    ended, active = np.full(count, np.nan), np.ones(count, dtype=bool)
    errors, off = np.zeros(count), list[Floats]()
    while active.any() and scene.time < PATIENCE:
        runs = everyone[active]
        running.step(runs, scene)
        scene.advance(active)
        off.append(np.linalg.norm(scene.pose[:, :2], axis=1))
        over = runs[running.done(runs)]
        ended[over], errors[over] = scene.time, off[-1][over]
        active[over] = False
    arrived = np.isfinite(ended)
    if hold:
        after = np.array(off[: round(SECONDS / scene.seconds)])
        return arrived, after.mean(axis=0), after[round(20 / scene.seconds) :].mean(axis=0)
    return arrived, errors[arrived], ended[arrived]


def _scene(count: int, hold: bool, factor: float, seed: int) -> Scene:
    """Vehicles at rest about [0, 0], heading anywhere, in `factor` times the published current."""
    random, vessel = np.random.default_rng([seed, 17]), published_vessel()
    world = World(
        *(vessel, (0.0, 0.0), (), (), {}, (), lambda _start, _goal: True, Faults(), count, seed)
    )
    world.current = factor * world.current
    starts, away = np.zeros((count, 4)), (0.0, 1.0) if hold else AWAY
    far, angle = random.uniform(*away, count), random.uniform(0, 7, count)
    starts[:, 0], starts[:, 1] = far * np.cos(angle), far * np.sin(angle)
    starts[:, 3] = random.uniform(-math.pi, math.pi, count)
    return Scene(world, FastSimulator(vessel, count), starts, Origin(0.0, 0.0), lambda _r, _l: None)
