"""From the command to the skills over both agents: data that is asked for and comes out as skills.

A record is {"id", "prompt", "skills": [{"task": TITLE, "skills": [NAME, ...]}], "locate"}: a demand
is met when some step of a task of the title has the skill.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.benchmark.folder import RESULTS
from planner_ft.benchmark.statistics import Estimate, clustered_rate
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import iterate_jsonl, write_json, write_jsonl, write_text
from planner_ft.support.tables import Cell, Table, figure, markdown_table, row
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import step_skills

DEFAULT = Path("eval/both/demands.jsonl")
KEYS = ("id", "prompt", "skills", "locate", "expected")
DEMAND = {"task", "skills"}
SCORES, TABLE = "scores.jsonl", "table.md"
FILES = (RESULTS, SCORES, TABLE)
WARNING = "data-not-planned"


@dataclass(frozen=True)
class Demand:
    """One skill that the steps of a task must have; whether the agents gave it, and the plan."""

    record: str
    task: str
    skill: str
    agents: bool
    plan: bool


@dataclass(frozen=True)
class DemandRow:
    """The demands of all records in one configuration; `warned` are records with lost words."""

    candidate: str
    configuration: str
    demands: tuple[Demand, ...]
    records: int
    warned: int

    @property
    def name(self) -> str:
        return f"{self.candidate} {self.configuration}"

    def rates(self) -> dict[str, Estimate]:
        """Shares of demands met by the agents and by the plan, and of records with all met."""
        clusters = [demand.record for demand in self.demands]
        names = list(dict.fromkeys(clusters))
        whole = [all(one.plan for one in self.demands if one.record == name) for name in names]
        return {
            "demands_agents": clustered_rate([one.agents for one in self.demands], clusters),
            "demands_plan": clustered_rate([one.plan for one in self.demands], clusters),
            "all_demands_plan": clustered_rate(whole, names),
        }

    def as_json(self) -> dict[str, Any]:
        named = {"candidate": self.candidate, "configuration": self.configuration}
        counts = {"records": self.records, "demands": len(self.demands), "warned": self.warned}
        return named | counts | {name: rate.to_json() for name, rate in self.rates().items()}


def load_demands(path: Path, vocabulary: Vocabulary) -> list[dict[str, Any]]:
    """The records of a file. Raises PlannerError with file and line."""
    records = []
    for number, value, problem in iterate_jsonl(path):
        if problem := problem or _problem(value, vocabulary):
            raise PlannerError(f"{path}:{number}: {problem}")
        records.append(value or {})
    if not any(record["skills"] for record in records):
        raise PlannerError(f"{path}: demands no skills; give records the key skills")
    return records


def _problem(value: Any, vocabulary: Vocabulary) -> str | None:
    if not isinstance(value, dict) or not all(isinstance(value.get(key), str) for key in KEYS[:2]):
        return "a record with the texts id and prompt is expected"
    if unknown := [key for key in value if key not in KEYS]:
        return f"unknown key {unknown[0]!r}; there is {', '.join(KEYS)}"
    entries = value.setdefault("skills", [])
    for entry in entries if isinstance(entries, list) else [entries]:
        if not isinstance(entry, dict) or entry.keys() != DEMAND:
            return 'skills must be a list of {"task": TITLE, "skills": [NAME, ...]}'
        if entry["task"] not in vocabulary.task:
            return f"skills: {entry['task']!r} is no task of this vehicle"
        unknown = [name for name in entry["skills"] if name not in vocabulary.skill]
        if unknown:
            return f"skills: {unknown[0]!r} is no skill of this vehicle"
    return None


def judge_demands(
    records: Sequence[Mapping[str, Any]],
    plan: Callable[[Mapping[str, Any]], Mapping[str, Any]],
    progress: Callable[[int, int], None],
) -> tuple[tuple[Demand, ...], int]:
    """The demands of the records, and the plans that warn of lost words."""
    demands: list[Demand] = []
    warned = 0
    for number, record in enumerate(records, start=1):
        document = plan(record)
        warned += any(one["kind"] == WARNING for one in document.get("warnings", ()))
        for entry in record["skills"]:
            agents, whole = _skills(document, entry["task"])
            for name in entry["skills"]:
                met = name in agents, name in whole
                demands.append(Demand(record["id"], entry["task"], name, *met))
        progress(number, len(records))
    return tuple(demands), warned


def _skills(document: Mapping[str, Any], title: str) -> tuple[set[str], set[str]]:
    """The skills in the steps of tasks of a title: those that the Task Agent gave, and all."""
    agents, whole = set[str](), set[str]()
    for task in (task for task in document.get("tasks", ()) if task["title"] == title):
        added = {
            (mark["step"], mark["name"])
            for mark in task.get("added", ())
            if "parameter" not in mark
        }
        for index, step in enumerate(task["skill_sequence"] or ()):
            names = {skill["name"] for _role, skill in step_skills(step)}
            whole |= names
            agents |= {name for name in names if (index, name) not in added}
    return agents, whole


def demand_table(rows: Sequence[DemandRow]) -> Table:
    """Shares of demanded skills that come out, in percent."""
    columns = ("demands", "agents %", "plan %", "all %", "lost words")
    caption = (
        "Skills that commands demand, found in the steps of the task that they accompany: given by"
        " the agents, in the plan with what the vehicle adds, and records with all of them. Lost"
        " words: plans that warn of data that no skill gathers."
    )
    lines = []
    for one in rows:
        rates = [_cell(rate) for rate in one.rates().values()]
        lines.append(row(one.name, str(len(one.demands)), *rates, f"{one.warned} of {one.records}"))
    return Table("demands", "Both agents.", caption, "", columns, tuple(lines))


def _cell(rate: Estimate) -> Cell:
    return figure(rate.value, rate.low, rate.high, scale=100, decimals=0)


def write_demands(folder: Path, rows: Sequence[DemandRow], manifest: dict[str, Any]) -> None:
    """Write scores.jsonl, table.md and results.json, which comes last."""
    scores = [
        {"candidate": one.candidate, "configuration": one.configuration, **vars(demand)}
        for one in rows
        for demand in one.demands
    ]
    write_jsonl(folder / SCORES, scores)
    write_text(folder / TABLE, markdown_table(demand_table(rows)))
    write_json(folder / RESULTS, {"rows": [one.as_json() for one in rows], "manifest": manifest})
