"""Suites of missions: from the command over both agents and an approval to runs in simulators."""

from __future__ import annotations

import contextlib
import functools
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.benchmark.definitions import Kind, key_problems
from planner_ft.benchmark.statistics import Estimate
from planner_ft.document import build, read_document, write_document
from planner_ft.document.losses import lost
from planner_ft.document.vehicle import load_vehicle
from planner_ft.review import approve, log_beside
from planner_ft.review.approval import approval_of
from planner_ft.review.log import head_file
from planner_ft.simulation.asked import SimulationSettings, read_outlines
from planner_ft.simulation.output import COLUMNS, cell, number, published_missions
from planner_ft.simulation.run import MANIFEST, OURS, RESULTS, TEMPORARY, simulate
from planner_ft.support.alone import alone
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import check_writable, read_json, read_toml, write_json, write_text
from planner_ft.support.tables import Table, TableRow, csv_table, markdown_table, row
from planner_ft.support.terminal import Report, under

if TYPE_CHECKING:
    from planner_ft.planning.planner import Planner

KEYS: dict[str, Kind] = {"title": str, "simulators": [str], "seed": int, "missions": [dict]}
MISSION_KEYS: dict[str, Kind] = {
    **dict.fromkeys(("name", "command", "published", "survey"), str),
    "locate": dict,
    "outlines": dict,
    "runs": int,
    "tolerance": float,
    "starts": [list],
}
SHORT = ("success", "waypoint_error", "holding_error", "standoff_error")  # figures for a terminal
SUITE, PLAN = "suite.json", "plan.json"
REASON = "approved by a suite, read by nobody: for simulation alone"
OTHERS = (
    "Published figures are of another simulator, other structures and distances, so that steps,"
    " seconds and thrust are no comparison."
)
Ran = dict[tuple[str, str], dict[str, Any]]  # results.json by mission and simulator


@dataclass(frozen=True)
class Mission:
    """A command and its runs; `published` names its line in published.csv, if it has one; `asked`
    are settings of its simulation, whose `locations` also the agents are told.
    """

    name: str
    command: str
    published: str | None
    asked: Mapping[str, Any]

    @property
    def folder(self) -> str:
        return _folder(self.name)


@dataclass(frozen=True)
class Suite:
    """A suite file, and its content."""

    path: Path
    raw: Mapping[str, Any]
    missions: tuple[Mission, ...]

    @property
    def simulators(self) -> list[str]:
        return list(dict.fromkeys(self.raw["simulators"]))


def _folder(name: str) -> str:
    return re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")


def read_suite(path: Path) -> Suite:
    """A suite file. Raises PlannerError that lists every mistake."""
    raw = read_toml(path)
    problems = key_problems(raw, KEYS, KEYS)
    missions: list[Mission] = []
    for index, values in enumerate([] if problems else raw["missions"]):
        found = key_problems(values, MISSION_KEYS, ("name", "command"))
        try:
            missions += [] if found else [_mission(values)]
        except (PlannerError, TypeError, ValueError) as error:
            found = [str(error) if isinstance(error, PlannerError) else "a place is no [x, y]"]
        problems += [f"missions[{index}]: {text}" for text in found]
    names = Counter(one.folder for one in missions)
    problems += [f"two missions are named {name}" for name, count in names.items() if count > 1]
    if problems:
        raise PlannerError(f"{path}: {'; '.join(problems)}")
    suite = Suite(path, raw, tuple(missions))
    for mission in missions:
        for simulator in suite.simulators:
            _settings(suite, mission, simulator, Path())
    return suite


def _mission(values: Mapping[str, Any]) -> Mission:
    places = {name: (float(x), float(y)) for name, (x, y) in values.get("locate", {}).items()}
    starts = tuple((float(x), float(y)) for x, y in values.get("starts", ()))
    survey, known = values.get("survey", "waypoints"), ("waypoints", "learnt")
    if survey not in known:
        raise PlannerError(f"survey = {survey!r} must be one of {', '.join(known)}")
    name, known_missions = values["name"], [one["mission"] for one in published_missions()]
    published = values.get("published", name if name in known_missions else None)
    if published not in (None, *known_missions):
        listed = ", ".join(known_missions)
        raise PlannerError(f"published = {published!r} is no published mission: {listed}")
    outlines = [f"{structure}={shape}" for structure, shape in values.get("outlines", {}).items()]
    asked = {key: values[key] for key in ("tolerance", "runs") if key in values}
    asked |= {"locations": places, "starts": starts, "survey": survey}
    asked["outlines"] = read_outlines(outlines)
    return Mission(name, values["command"], published, asked)


def run_suite(suite: Suite, out: Path, report: Report, *, overwrite: bool = False) -> Ran:
    """Run what is not done yet, and write the table. Raises PlannerError."""
    ran: Ran = {}
    with alone(out, "--out", "a suite"), contextlib.ExitStack() as stack:

        @functools.cache
        def agents() -> Planner:
            """Both agents, loaded when a command is to be planned."""
            from planner_ft.planning.planner import Planner
            from planner_ft.planning.settings import PlanSettings

            return stack.enter_context(Planner(PlanSettings(), lost=lost))

        check_writable(out)
        _take(suite, out, overwrite)
        for mission in suite.missions:
            plan = out / mission.folder / PLAN
            if not _is_approved(plan):
                _plan(mission, plan, agents())
            for simulator in suite.simulators:
                settings = _settings(suite, mission, simulator, plan)
                if not (settings.folder / MANIFEST).exists():
                    simulate(settings, under(f"{mission.name}, {simulator}", report))
                ran[mission.name, simulator] = read_json(settings.folder / RESULTS)
        made = suite_table(suite, ran)
        write_text(out / "table.md", markdown_table(made))
        write_text(out / "table.csv", csv_table(made))
    return ran


def _take(suite: Suite, out: Path, overwrite: bool) -> None:
    """Begin a folder, or go on in one of the same suite."""
    known = out / SUITE
    here = sorted(out.iterdir()) if out.exists() else []
    if here and not known.exists():
        raise PlannerError(f"--out {out}: holds {here[0].name} and no suite; give another folder")
    if here and overwrite:
        _clear(out, read_json(known))
    elif here and read_json(known) != suite.raw:
        hint = "give --overwrite to begin anew, or another folder with --out"
        raise PlannerError(f"--out {out}: holds results of another suite than {suite.path}; {hint}")
    write_json(known, suite.raw)


def _clear(out: Path, raw: Mapping[str, Any]) -> None:
    """Remove the files of a suite. Raises PlannerError when others are there."""
    folders = [out / _folder(one["name"]) for one in raw["missions"]]
    runs = [folder / name for folder in folders for name in raw["simulators"]]
    log = log_beside(Path(PLAN))
    names: list[tuple[Path, tuple[str, ...]]] = [(out, (SUITE, "table.*", TEMPORARY))]
    names += [(one, (PLAN, log.name, head_file(log).name, TEMPORARY, ".*.lock")) for one in folders]
    names += [(one, OURS) for one in runs]
    ours = {path for folder, own in names for name in own for path in folder.glob(name)}
    if foreign := sorted(set(out.rglob("*")) - ours - {*folders, *runs}):
        problem = f"holds {foreign[0].relative_to(out)}, which is not of a suite"
        raise PlannerError(f"--out {out}: {problem}; give another folder")
    for path in ours - {out / SUITE}:  # which is written anew
        path.unlink()
    for folder in (*runs, *folders):
        with contextlib.suppress(OSError):  # not begun, or told twice
            folder.rmdir()


def _is_approved(plan: Path) -> bool:
    """Whether the plan of a mission is there, and somebody decided on it."""
    return plan.exists() and approval_of(read_document(plan), log_beside(plan)).status != "unknown"


def _plan(mission: Mission, path: Path, agents: Planner) -> None:
    """Write the plan of a mission, and approve it in a log of its own beside it."""
    planned = agents.plan(mission.command, mission.asked["locations"])
    document = build(planned, agents.vocabulary, load_vehicle(None, agents.vocabulary))
    write_document(path, document)
    approve(document, log_beside(path), f"suite, {mission.name}", ["all"], REASON)


def _settings(suite: Suite, mission: Mission, simulator: str, plan: Path) -> SimulationSettings:
    # What a killed run left is begun anew: its logs alone are there.
    how = {"simulator": simulator, "overwrite": True, "mcap": 0, **mission.asked}
    return SimulationSettings(plan, plan.parent / simulator, seed=suite.raw["seed"], **how)


def suite_table(suite: Suite, ran: Ran, names: Sequence[str] = tuple(COLUMNS)) -> Table:
    """A row per mission and simulator, and below the published one if there is one, with figures of
    these names.
    """
    columns = ("runs", *(COLUMNS[name][0] for name in names))
    rows = [one for mission in suite.missions for one in _rows(suite, mission, ran, names)]
    caption = "Means over runs with 95 % intervals."
    if any(one.published for one in suite.missions):
        caption += f" {OTHERS}"
    return Table("mission", columns, rows, 0, "missions", suite.raw["title"], caption)


def _rows(suite: Suite, mission: Mission, ran: Ran, names: Sequence[str]) -> Iterator[TableRow]:
    for simulator in suite.simulators:
        result = ran[mission.name, simulator]
        cells = [
            cell(name, Estimate(**result["overall"].get(name, {"value": None}))) for name in names
        ]
        yield row(f"{mission.name}, {simulator}", str(len(result["runs"])), *cells)
    for quoted in (one for one in published_missions() if one["mission"] == mission.published):
        cells = [cell(name, Estimate(number(quoted, name))) for name in names]
        yield row(f"{mission.name}, published", quoted["runs"], *cells, kind="published")
