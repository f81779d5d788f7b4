"""Cases run through planners: right ones by kind of case, and by the data that is demanded.

Plans are written as they are made; all figures are made from what is written.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

from planner_ft.benchmark.field.cases import Case, Outcome, load_cases, load_demands, passes
from planner_ft.benchmark.folder import PLANS, RESULTS, SCORES, RecordLog, check_folder, clear
from planner_ft.benchmark.statistics import Estimate, clustered_rate, wilson
from planner_ft.planning import Planner
from planner_ft.support import files
from planner_ft.support.manifest import build_manifest
from planner_ft.support.tables import Table, TableRow, markdown_table, row
from planner_ft.support.terminal import Report
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import step_skills

TABLE = "table.md"
WARNING = "data-not-planned"
MET = ("agents", "plan")
Record = dict[str, Any]
Plan = Callable[[Case], Outcome]


@dataclass(frozen=True)
class Judged:
    """A case with its plan and the checks that fail."""

    case: Case
    outcome: Outcome
    failed: tuple[Any, ...]

    @property
    def right(self) -> bool:
        return not self.failed

    @property
    def dangerous(self) -> bool:
        """Whether a dangerous case failed in silence."""
        return bool(self.failed) and self.case.danger and self.outcome.silent


@dataclass(frozen=True)
class Row:
    """All cases in one configuration of a candidate; `agents` are what both were made of."""

    candidate: str
    configuration: str
    vocabulary: Vocabulary
    judged: tuple[Judged, ...] = ()
    agents: Record = field(default_factory=dict)

    @property
    def name(self) -> str:
        return f"{self.candidate} {self.configuration}"

    def named(self) -> Record:
        return {"candidate": self.candidate, "configuration": self.configuration}


class Field:
    """Field cases: right ones by kind, and those that are dangerous and silent."""

    kind, load = "field", staticmethod(load_cases)
    files: tuple[str, ...] = (RESULTS, PLANS, TABLE)

    def record(self, one: Row) -> Record:
        kinds = {kind: _counts(some) for kind, some in self._kinds(one)}
        cases = []
        for judged in one.judged:
            found: Record = {"id": judged.case.id, "kind": judged.case.kind, "right": judged.right}
            found |= {"dangerous_and_silent": judged.dangerous, "failed": judged.failed}
            said = {"warnings": judged.outcome.warnings, "error": judged.outcome.error}
            cases.append({**found, **said})
        return {**one.named(), **_counts(one.judged), "kinds": kinds, "cases": cases}

    def _kinds(self, one: Row) -> Iterator[tuple[str, list[Judged]]]:
        """The cases by kind, in the order of the file."""
        for kind in dict.fromkeys(judged.case.kind for judged in one.judged):
            yield kind, [judged for judged in one.judged if judged.case.kind == kind]

    def table(self, rows: Sequence[Row]) -> Table:
        """Right, of and the rate by kind of case; the last row of each configuration counts all."""
        lines: list[TableRow] = []
        for one in rows:
            lines.append(row(one.name, kind="section"))
            for kind, some in (*self._kinds(one), ("all", one.judged)):
                found = _counts(some)
                share = Estimate(**found["rate"]).cell(scale=100, decimals=0)
                silent = str(found["dangerous_and_silent"])
                lines.append(row(kind, str(found["right"]), str(found["of"]), share, silent))
        columns = ("right", "of", "% [95 %]", "dangerous and silent")
        caption = "Wilson intervals. Dangerous and silent: a dangerous case that failed without a"
        return Table("kind", columns, lines, title="Field cases.", caption=f"{caption} warning.")

    def below(self, rows: Sequence[Row]) -> str:
        """A line per case that failed: its command and the checks."""
        every = (one for of_row in rows for one in of_row.judged if one.failed)
        return "\n" + "".join(
            f"- {one.case.id} ({one.case.kind}): {one.case.command!r} fails {list(one.failed)}\n"
            for one in every
        )


class Demands:
    """Demanded skills that the agents alone give, and the plan with what the vehicle adds."""

    kind, load = "both", staticmethod(load_demands)
    files: tuple[str, ...] = (RESULTS, PLANS, SCORES, TABLE)

    def lines(self, one: Row) -> Iterator[Record]:
        """The demands of all records: record, task, skill, and whether they are met."""
        for judged in one.judged:
            alone = _of_agents(judged.outcome)
            for check in judged.case.expect:
                named = {"record": judged.case.id, "task": check["under"], "skill": check["skill"]}
                by_agents = passes(check, alone, one.vocabulary)
                met = {"agents": by_agents, "plan": check not in judged.failed}
                yield {**one.named(), **named, **met}

    def rates(self, one: Row) -> dict[str, Estimate]:
        """Shares of demands met by the agents and by the plan, and of records with all met."""
        lines = list(self.lines(one))
        clusters = [line["record"] for line in lines]
        whole = dict.fromkeys(clusters, True)
        for line in lines:
            whole[line["record"]] &= line["plan"]
        found = {by: clustered_rate([one[by] for one in lines], clusters) for by in MET}
        rates = {f"demands_{by}": rate for by, rate in found.items()}
        return {**rates, "all_demands_plan": clustered_rate([*whole.values()], [*whole])}

    def record(self, one: Row) -> Record:
        documents = (judged.outcome.document for judged in one.judged)
        found = [[one["kind"] for one in document.get("warnings", ())] for document in documents]
        counts = {"records": len(one.judged), "demands": len(list(self.lines(one)))}
        counts["warned"] = sum(WARNING in kinds for kinds in found)
        rates = {name: rate.to_json() for name, rate in self.rates(one).items()}
        return one.named() | counts | rates

    def table(self, rows: Sequence[Row]) -> Table:
        """Shares of demanded skills that come out, in percent."""
        columns = ("demands", "agents %", "plan %", "all %", "lost words")
        caption = (
            "Skills that commands demand, found in the steps of the task that they accompany: given"
            " by the agents, in the plan with what the vehicle adds, and records with all of them."
            " Lost words: plans that warn of data that no skill gathers."
        )
        lines = []
        for one in rows:
            rates = [rate.cell(scale=100, decimals=0) for rate in self.rates(one).values()]
            found = self.record(one)
            warned = f"{found['warned']} of {found['records']}"
            lines.append(row(one.name, str(found["demands"]), *rates, warned))
        return Table("", columns, lines, title="Both agents.", caption=caption)


def _counts(judged: Sequence[Judged]) -> Record:
    """How many are right, of how many, with the interval of the rate, and what is dangerous."""
    right = sum(one.right for one in judged)
    rate = wilson(right, len(judged)).to_json()
    silent = sum(one.dangerous for one in judged)
    return {"right": right, "of": len(judged), "rate": rate, "dangerous_and_silent": silent}


def _of_agents(outcome: Outcome) -> Outcome:
    """A plan without the skills that the vehicle added."""
    tasks = []
    for task in outcome.tasks:
        marks = (mark for mark in task.get("added", ()) if "parameter" not in mark)
        added = {(mark["step"], mark["name"]) for mark in marks}
        steps: list[Record] = []
        for index, step in enumerate(task["skill_sequence"] or ()):
            every = (skill for _role, skill in step_skills(step))
            kept = [skill for skill in every if (index, skill["name"]) not in added]
            steps.append({"perception_skills": kept})
        tasks.append({"title": task["title"], "skill_sequence": steps})
    return Outcome({"tasks": tasks}, outcome.error)


def run_cases(
    bench: Field | Demands,
    cases_in: Sequence[Path],
    out: Path,
    vocabulary: Vocabulary,
    planners: Sequence[Planner],
    new_plan: Callable[[Planner, bool], Plan],
    progress: Report,
    limit: int | None = None,
    *,
    resume: bool = False,
    overwrite: bool = False,
) -> Table:
    """Run the cases of files with every planner. Plans are written into `out` as they are
    made, with `resume` those that are there are not made again; from them the tables and, last,
    results.json. `new_plan` makes what plans a case, for demands with open places taken to be
    somewhere. Returns the table. Raises PlannerError.
    """
    cases = bench.load(cases_in, vocabulary)[:limit]
    check_folder(out, bench.files, resume=resume, overwrite=overwrite)
    if overwrite:
        clear(out, bench.files)
    rows = [_row(planner) for planner in planners]
    data = [bench.kind, vocabulary.sha256, *map(files.sha256_file, cases_in)]
    made_with = {one.name: files.compact_json([one.agents, *data]) for one in rows}
    keys = {name: files.sha256_text(text)[:20] for name, text in made_with.items()}
    with RecordLog(out / PLANS) as log:
        log.refuse_others({name: {key} for name, key in keys.items()})
        for index, (planner, one) in enumerate(zip(planners, tuple(rows), strict=True)):
            missing = set(log.missing(keys[one.name], [case.id for case in cases]))
            asked = [case for case in cases if case.id in missing]
            with planner:
                plan = new_plan(planner, bench.kind == "both")
                made = ({"id": case.id, **one.named(), **asdict(plan(case))} for case in asked)
                log.fill(keys[one.name], made, progress, one.name, len(asked), len(cases))
            found = log.of_key(keys[one.name])
            lines = (found[case.id] for case in cases)
            outcomes = [Outcome(line["document"], line["error"]) for line in lines]
            rows[index] = replace(one, judged=judge(cases, outcomes, vocabulary))
    manifest = build_manifest(
        bench.kind,
        seed=None,
        configuration={"limit": limit, "vocabulary": vocabulary.named},
        inputs={str(path): path for path in cases_in},
        agents={one.name: one.agents for one in rows},
    )
    table = bench.table(rows)
    if isinstance(bench, Demands):
        files.write_jsonl(out / SCORES, [line for one in rows for line in bench.lines(one)])
    failed = bench.below(rows) if isinstance(bench, Field) else ""
    files.write_text(out / TABLE, markdown_table(table) + failed)
    record: Record = {"rows": [bench.record(one) for one in rows], "manifest": manifest}
    files.write_json(out / RESULTS, record)
    return table


def _row(planner: Planner) -> Row:
    """The row of a planner, before any case."""
    known, device = planner.agents.agents, planner.agents.device.type
    agents: Record = {of: {**one.record(), "device": device} for of, one in known.items()}
    named = planner.settings.candidate, known["mission"].configuration.name
    return Row(*named, planner.vocabulary, agents=agents)


def judge(
    cases: Sequence[Case], outcomes: Sequence[Outcome], vocabulary: Vocabulary
) -> tuple[Judged, ...]:
    """The cases with the checks that their plans fail."""
    return tuple(
        Judged(case, found, tuple(one for one in case.expect if not passes(one, found, vocabulary)))
        for case, found in zip(cases, outcomes, strict=True)
    )
