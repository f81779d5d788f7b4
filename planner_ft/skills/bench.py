"""`plannerft skill bench`: policies beside baselines and published figures, with intervals."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import torch

from planner_ft.benchmark.statistics import bootstrap_mean, wilson
from planner_ft.skills.episodes import Actor, Episode, contour_follower, oracle, play
from planner_ft.skills.policies import MANIFEST, SKILLS, Policy, digest, read_policy, torch_threads
from planner_ft.skills.shapes import HELD_OUT, PUBLISHED
from planner_ft.skills.survey import Task
from planner_ft.skills.tracker import Guidance
from planner_ft.skills.tracking_bench import tracking_table
from planner_ft.support.alone import alone
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import (
    compact_json,
    make_folder,
    read_csv,
    read_json,
    write_json,
    write_text,
)
from planner_ft.support.manifest import build_manifest
from planner_ft.support.tables import Table, TableRow, csv_table, figure, markdown_table, row
from planner_ft.support.terminal import Report

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
    " approach included. Seeds of one training are shown one by one and pooled. Published figures"
    " are of another simulator; what the study does not say was chosen."
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
        if self.out and self.out.exists() and any(self.out.iterdir()) and not self.overwrite:
            hint = "give --overwrite to replace it, or another folder"
            raise PlannerError(f"--out {self.out}: holds files; {hint}")


def bench_skill(request: SkillBench, report: Report) -> list[Table]:
    """Measure and write what is asked for; the tables. Raises PlannerError."""
    torch_threads()
    folders: list[Path | None] = [None, *request.policies]
    policies = [read_policy(request.skill, one) for one in folders]
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
        if request.out:
            _write(request, folders, tables, played)
    return tables


Played = dict[str, dict[str, list[Episode]]]  # episodes by policy or baseline, and by condition


def _play_all(request: SkillBench, policies: Sequence[Policy], report: Report) -> Played:
    tracker: Any = read_policy("goto", request.goto).module
    guidance: Any = Guidance(tracker)
    actors: dict[str, tuple[Actor | Policy, Any]] = {}
    for policy in policies:
        actors["learnt, shipped" if policy is policies[0] else _name(policy)] = policy, tracker
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


def _name(policy: Policy) -> str:
    return f"learnt, {policy.path.parent}"


def pooled(policies: Sequence[Policy], played: Played) -> Played:
    """The episodes of policies that were trained alike but for the seed, together."""
    alike: dict[str, dict[int, str]] = {}
    for policy in policies:
        manifest = policy.path.parent / MANIFEST
        settings = read_json(manifest)["configuration"] if manifest.is_file() else {}
        if "seed" in settings:
            seed = settings.pop("seed")
            alike.setdefault(compact_json(settings), {})[seed] = _name(policy)
    found: Played = {}
    for text, by_seed in alike.items():
        settings = json.loads(text)
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
    for policy, lines in _published().items():
        rows.append(row(f"published: {policy}", kind="section"))
        for line in lines:
            rates = [figure(_number(line[name]), decimals=0) for name in _RATES]
            errors = figure(_number(line["error"])), figure(_number(line["steps"]), decimals=0)
            rows.append(row(line["class"], *rates, *errors, kind="published"))
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
    count = len(episodes)
    rates = [wilson(sum(one.outcome == kind for one in episodes), count) for kind in _RATES]
    error = bootstrap_mean([one.error for one in episodes], range(count), seed)
    steps = bootstrap_mean([float(one.steps) for one in episodes], range(count), seed)
    cells = [one.cell(scale=100, decimals=0) for one in rates]
    return row(name, *cells, error.cell(), steps.cell(decimals=0))


def _published() -> dict[str, list[dict[str, str]]]:
    """Lines of published.csv by policy."""
    found: dict[str, list[dict[str, str]]] = {}
    for line in read_csv(Path(__file__).with_name("published.csv")):
        found.setdefault(line["policy"], []).append(line)
    return found


def _number(text: str) -> float | None:
    return float(text) if text else None


def _write(
    request: SkillBench, folders: Sequence[Path | None], tables: Sequence[Table], played: Played
) -> None:
    assert request.out is not None
    out = request.out
    write_text(out / "table.md", "\n".join(markdown_table(one) for one in tables))
    for one in tables:
        write_text(out / f"{one.name}.csv", csv_table(one))
    episodes = {
        name: {condition: [asdict(one) for one in some] for condition, some in by.items()}
        for name, by in played.items()
    }
    write_json(out / "episodes.json", episodes)
    policies = {str(one or "shipped"): digest(request.skill, one) for one in folders}
    configuration = {"skill": request.skill, "episodes": request.episodes, "policies": policies}
    write_json(
        out / "manifest.json",
        build_manifest("skill bench", seed=request.seed, configuration=configuration),
    )
