"""From the command to the skills over both agents: data that is asked for and comes out as skills.

A record is {"id", "prompt", "skills": [{"task": TITLE, "skills": [NAME, ...]}], "locate"}: a demand
is met when some step of a task of the title has the skill.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.benchmark.field.cases import Case, check_problems
from planner_ft.benchmark.field.checks import Outcome, passes
from planner_ft.benchmark.field.run import Judged
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
class DemandRow:
    """The demands of all records in one configuration: record, task, skill, and whether the agents
    and the plan meet it; `warned` are records with lost words.
    """

    candidate: str
    configuration: str
    demands: tuple[dict[str, Any], ...]
    records: int
    warned: int

    @property
    def name(self) -> str:
        return f"{self.candidate} {self.configuration}"

    def rates(self) -> dict[str, Estimate]:
        """Shares of demands met by the agents and by the plan, and of records with all met."""
        clusters = [one["record"] for one in self.demands]
        met = {by: [one[by] for one in self.demands] for by in ("agents", "plan")}
        whole = dict.fromkeys(clusters, True)
        for one in self.demands:
            whole[one["record"]] &= one["plan"]
        return {
            **{f"demands_{by}": clustered_rate(found, clusters) for by, found in met.items()},
            "all_demands_plan": clustered_rate([*whole.values()], [*whole]),
        }

    def as_json(self) -> dict[str, Any]:
        named = {"candidate": self.candidate, "configuration": self.configuration}
        counts = {"records": self.records, "demands": len(self.demands), "warned": self.warned}
        return named | counts | {name: rate.to_json() for name, rate in self.rates().items()}


def load_demands(path: Path, vocabulary: Vocabulary) -> list[Case]:
    """The records of a file as cases, a check per demand. Raises PlannerError with file and line."""
    cases = []
    for number, value, problem in iterate_jsonl(path):
        if problem := problem or _problem(value, vocabulary):
            raise PlannerError(f"{path}:{number}: {problem}")
        record = value or {}
        locate = {name: (x, y) for name, (x, y) in record.get("locate", {}).items()}
        expect = tuple(_checks(record.get("skills", [])))
        cases.append(Case(record["id"], "both", record["prompt"], expect, locate))
    if not any(case.expect for case in cases):
        raise PlannerError(f"{path}: demands no skills; give records the key skills")
    return cases


def _checks(entries: Sequence[dict[str, Any]]) -> list[dict[str, str]]:
    return [{"skill": name, "under": one["task"]} for one in entries for name in one["skills"]]


def _problem(value: Any, vocabulary: Vocabulary) -> str | None:
    if not isinstance(value, dict) or not all(isinstance(value.get(key), str) for key in KEYS[:2]):
        return "a record with the texts id and prompt is expected"
    if unknown := [key for key in value if key not in KEYS]:
        return f"unknown key {unknown[0]!r}; there is {', '.join(KEYS)}"
    entries = value.get("skills", [])
    if not isinstance(entries, list) or not all(map(_is_demand, entries)):
        return 'skills must be a list of {"task": TITLE, "skills": [NAME, ...]}'
    checks = [*({"under": entry["task"]} for entry in entries), *_checks(entries)]
    problems = (text for check in checks for text in check_problems(check, vocabulary))
    return next((f"skills: {text}" for text in problems), None)


def _is_demand(entry: Any) -> bool:
    if not isinstance(entry, dict) or entry.keys() != DEMAND:
        return False
    names = entry["skills"] if isinstance(entry["skills"], list) else [None]
    return all(isinstance(name, str) for name in (entry["task"], *names))


def demand_row(
    name: tuple[str, str], judged: Sequence[Judged], vocabulary: Vocabulary
) -> DemandRow:
    """The demands of the records in the configuration of a candidate."""
    demands = [
        {
            "record": one.case.id,
            "task": check["under"],
            "skill": check["skill"],
            "agents": passes(check, _of_agents(one.outcome), vocabulary),
            "plan": check not in one.failed,
        }
        for one in judged
        for check in one.case.expect
    ]
    warnings = [one.outcome.document.get("warnings", ()) for one in judged]
    warned = sum(any(warning["kind"] == WARNING for warning in found) for found in warnings)
    return DemandRow(*name, tuple(demands), len(judged), warned)


def _of_agents(outcome: Outcome) -> Outcome:
    """A plan without the skills that the vehicle added."""
    tasks = []
    for task in outcome.tasks:
        marks = (mark for mark in task.get("added", ()) if "parameter" not in mark)
        added = {(mark["step"], mark["name"]) for mark in marks}
        steps = [
            [one for _role, one in step_skills(step) if (index, one["name"]) not in added]
            for index, step in enumerate(task["skill_sequence"] or ())
        ]
        sequence = [{"perception_skills": skills} for skills in steps]
        tasks.append({"title": task["title"], "skill_sequence": sequence})
    return Outcome({"tasks": tasks}, outcome.error)


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
        {"candidate": one.candidate, "configuration": one.configuration, **demand}
        for one in rows
        for demand in one.demands
    ]
    write_jsonl(folder / SCORES, scores)
    write_text(folder / TABLE, markdown_table(demand_table(rows)))
    write_json(folder / RESULTS, {"rows": [one.as_json() for one in rows], "manifest": manifest})
