"""A review in the browser: plan and log on the disk, the agents, and events for every page."""

from __future__ import annotations

import ipaddress
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from planner_ft.document import PlanDocument, altered, build, read_document
from planner_ft.document.edits import KINDS, Edit
from planner_ft.document.vehicle import Vehicle
from planner_ft.document.warnings.asked import other_language
from planner_ft.planning.essentials import asked as needed
from planner_ft.planning.locations import Position
from planner_ft.planning.planner import Planner, SkillsKnown, TasksKnown, check_command
from planner_ft.planning.settings import PlanSettings
from planner_ft.review.approval import check_name
from planner_ft.review.desk import (
    ChangedError,
    Desk,
    State,
    add_plan,
    plan_names,
    plan_state,
    signature,
    skills_edit,
)
from planner_ft.review.log import log_beside
from planner_ft.review.web.planning import Events, Planning
from planner_ft.review.web.run import Runner, Runs
from planner_ft.support.errors import PlannerError, QuestionError
from planner_ft.support.geodesy import Origin
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import task_entry

LOOPBACK, LAST_PORT = "127.0.0.1", 65535
LONGEST_COMMAND = 20_000
"""Characters."""
EDITS = tuple(kind for kind in KINDS if kind not in ("skills", "replace"))
"""The kinds of edits that a page makes: not those that record an agent's answer or an adoption."""

Locations = Mapping[str, Position]
NOWHERE: Locations = {}


@dataclass(frozen=True)
class WebSettings:
    """Address, files and agents: `port` 0 is a free one, log and folder are the plan's, `reviewer`
    is the name that the page begins with, `origin` is that of new commands, `exporting` writes
    approved plans for vehicles (planner_ft.exporters.run), `runner` carries them out.
    """

    host: str = LOOPBACK
    port: int = 0
    open_browser: bool = True
    log: Path | None = None
    folder: Path | None = None
    reviewer: str = ""
    planning: PlanSettings = field(default_factory=PlanSettings)
    origin: Origin | None = None
    exporting: Any = None
    runner: Runner | None = None

    def __post_init__(self) -> None:
        """Raise PlannerError for a port that does not exist."""
        if not 0 <= self.port <= LAST_PORT:
            limits = f"must lie between 0 (any free port) and {LAST_PORT}"
            raise PlannerError(f"--port {self.port}: {limits}")

    @property
    def is_loopback(self) -> bool:
        """Whether only programs on this machine can reach the page."""
        try:
            return self.host == "localhost" or ipaddress.ip_address(self.host).is_loopback
        except ValueError:
            return False


class Session:
    """State and actions of the pages, from any thread; a PlannerError is shown to people."""

    def __init__(self, plan: Path | None, settings: WebSettings) -> None:
        """`plan` is shown first; new commands are for its vehicle, or the vocabulary's own."""
        self.path, self.vocabulary = plan, load_vocabulary(settings.planning.vocabulary)
        document = read_document(plan, self.vocabulary) if plan else None
        self.vehicle = Vehicle(**document["vehicle"]) if document else None
        self.folder = settings.folder or (plan.parent if plan else Path())
        self.log = settings.log or log_beside(self.folder / "any")
        self.origin, self.reviewer = settings.origin, settings.reviewer
        self.exporting = settings.exporting
        self.events = Events()
        self.planning = Planning(settings.planning, self.events, self.tell_state)
        source = self.vocabulary.source
        self.runs = Runs(settings.runner, self.log, source, self.events, self.tell_state)
        self._known: Any = self._signature()
        self._shown: tuple[Any, State] = (None, {})

    def state(self) -> State:
        """What a page shows, computed anew when plan or log changed. Raises PlannerError."""
        now = self._signature()
        if self._shown[0] != now:
            self._shown = (now, plan_state(self._desk() if self.path else None))
        return {
            **self._shown[1],
            "planner": self.planning.as_json(),
            "busy": self.planning.busy,
            "vocabulary": vocabulary_json(self.vocabulary),
            "formats": self.exporting.formats() if self.exporting else [],
            "reviewer": self.reviewer,
            "plans": plan_names(self.folder),
            "run": self.runs.as_json(),
        }

    def look(self) -> None:
        """Tell the pages when somebody else wrote plan or log."""
        if self._signature() != self._known:
            self.tell_state()

    def tell_state(self) -> None:
        """Tell the pages to ask for the state anew."""
        self._known = self._signature()
        try:
            revision = self._desk().revision if self.path else None
        except PlannerError:
            revision = None
        self.events.tell("state", {"revision": revision})

    def end(self) -> None:
        """End agents, run and event streams, which would keep a server waiting."""
        self.planning.stop()
        self.runs.end()
        self.events.close()

    # ------------------------------------------------------------ actions of a page

    def edit(self, revision: str, edit: Edit, by: str = "") -> State:
        """Make one edit in the name of a person."""
        if edit.get("kind") not in EDITS:
            problem = f"is none that a page makes; there is {', '.join(EDITS)}"
            raise PlannerError(f"edit {str(edit.get('kind'))[:40]!r}: {problem}")
        self._editable(revision, by).apply(edit)
        return self._changed()

    def undo(self, revision: str) -> State:
        """Take the last edit back."""
        self._editable(revision).undo()
        return self._changed()

    def approve(self, revision: str, name: str, acknowledged: list[str]) -> State:
        """Record an approval. Raises UnacknowledgedError when warnings are not acknowledged."""
        self._desk(revision).approve(name, acknowledged)
        return self._changed()

    def reject(self, revision: str, name: str, reason: str) -> State:
        """Record a rejection."""
        self._desk(revision).reject(name, reason)
        return self._changed()

    def export(
        self,
        revision: str,
        formats: list[str],
        origin: str = "",
        overwrite: bool = False,
        sure: bool = False,
    ) -> list[dict[str, Any]]:
        """Write the approved plan in these formats. Raises QuestionError."""
        if self.exporting is None:
            raise PlannerError("nothing exports plans here; plannerft export does")
        desk = self._desk(revision)
        asked, flags = (
            (desk.path, desk.log, formats, origin),
            {"overwrite": overwrite, "sure": sure},
        )
        written: list[dict[str, Any]] = self.exporting.hand_over(*asked, **flags)
        return written

    def run(self, revision: str, name: str, speed: float) -> State:
        """Carry the approved plan out, watched by the pages."""
        self.runs.begin(self._desk(revision), name, speed)
        return self.state()

    def abort(self, name: str) -> State:
        """Stop the run at once."""
        self.runs.abort(name)
        return self.state()

    def open(self, path: str) -> State:
        """Show another plan of the folder. Raises PlannerError."""
        if path not in plan_names(self.folder):
            raise PlannerError(f"{path}: is no plan in {self.folder}; choose one that is listed")
        read_document(self.folder / path, self.vocabulary)
        self.path = self.folder / path
        return self._changed()

    def plan(self, command: str, locate: Locations = NOWHERE, sure: bool = False) -> None:
        """Have a command planned into a file of its own, shown when done. Raises BusyError, and
        QuestionError for another language unless `sure`.
        """
        if len(command) > LONGEST_COMMAND:
            limit = f"at most {LONGEST_COMMAND} are planned; shorten it"
            raise PlannerError(f"the command has {len(command)} characters, and {limit}")
        check_command(command)
        if not sure and (question := other_language(command)):
            raise QuestionError(question)
        places = {name: (x, y) for name, (x, y) in locate.items()}

        def work(planner: Planner) -> None:
            planned = planner.plan(command, places, self._watch, self.origin)
            document = build(planned, self.vocabulary, self.vehicle)
            self.path = add_plan(self.folder, document)

        self.planning.ask({"what": "planning", "label": "planning", "command": command}, work)

    def skills(self, revision: str, task: str, by: str = "") -> None:
        """Ask the Task Agent again for a task, as an edit. Raises BusyError, ChangedError."""
        desk = self._desk(revision)
        asked = _task(desk.document, task)
        before = desk.document["tasks"][: desk.document["tasks"].index(asked)]
        if "waits_for" in asked:
            raise PlannerError(f"task {task}: its place is not known yet; say where it is first")
        if names := needed(asked, self.vocabulary):
            raise PlannerError(f"task {task}: {' and '.join(names)} must be known first; add it")

        def work(planner: Planner) -> None:
            answer = planner.skills(asked, before)
            if answer.plan is None:
                problem = f"the Task Agent's answer is not valid ({answer.problems[0]})"
                raise PlannerError(f"task {task}: {problem}; the task keeps the skills that it has")
            now = self._desk(by=by)  # the plan may have been edited meanwhile
            if now.path != desk.path:
                problem = "another plan is shown since its skills were asked for"
                raise PlannerError(f"task {task}: {problem}; open {desk.path.name} and ask again")
            if task_entry(_task(now.document, task)) != task_entry(asked):
                problem = "was edited while its skills were planned"
                raise PlannerError(f"task {task} {problem}; ask again")
            now.apply(skills_edit(task, answer.plan, answer))

        self.planning.ask({"what": "skills", "label": f"skills of task {task}"}, work)

    # ------------------------------------------------------------ parts

    def _desk(self, revision: str | None = None, by: str = "") -> Desk:
        """The plan as on the disk. Raises ChangedError when it is not of the given revision."""
        if self.path is None:
            raise ChangedError("there is no plan yet; plan a command first")
        desk = Desk(self.path, self.log, self.vocabulary, by=by.strip() or None)
        if revision not in (None, desk.revision):
            raise ChangedError.of(self.path)
        return desk

    def _editable(self, revision: str, by: str = "") -> Desk:
        if by.strip():
            check_name(by)
        desk = self._desk(revision, by)
        if altered(desk.document):
            name = desk.path.name
            way_out = f"take the changes over with `plannerft review {name} --adopt`"
            raise PlannerError(f"{name} was changed by hand; {way_out} before you edit it")
        return desk

    def _watch(self, event: TasksKnown | SkillsKnown) -> None:
        """Show a plan to the pages while it comes into being."""
        self.planning.go_on()
        if isinstance(event, SkillsKnown):
            skills = event.answer.plan and event.answer.plan["skill_sequence"]
            self.events.tell("skills", {"task": f"t{event.number}", "skill_sequence": skills})
            return
        tasks = []
        for number, task in enumerate(event.tasks, start=1):
            waits = {"waits_for": task.waits_for} if task.waits_for else {}
            own = {"id": f"t{number}", "skill_sequence": None, **waits}
            tasks.append(task_entry(vars(task)) | own)
        self.events.tell("tasks", {"tasks": tasks})

    def _changed(self) -> State:
        self.tell_state()
        return self.state()

    def _signature(self) -> Any:
        return self.path, signature(self.path), signature(self.log)


def _task(document: PlanDocument, ident: str) -> dict[str, Any]:
    tasks: dict[str, dict[str, Any]] = {task["id"]: task for task in document["tasks"]}
    if ident not in tasks:
        raise PlannerError(f"task {ident}: is not in the plan any more")
    return tasks[ident]


def vocabulary_json(vocabulary: Vocabulary) -> dict[str, Any]:
    """The vocabulary for the page: tasks, skills, home, and the place that is not known."""

    def described(entry: Any, *keys: str) -> dict[str, Any]:
        parameters = [asdict(parameter) for parameter in entry.parameters]
        return {**{key: getattr(entry, key) for key in keys}, "parameters": parameters}

    places = {"home": list(vocabulary.home), "unresolved": list(vocabulary.unresolved)}
    tasks = [described(task, "title", "category", "description") for task in vocabulary.tasks]
    keys, skills = ("category", "role", "description"), vocabulary.skills
    by_name = {skill.name: described(skill, *keys) for skill in skills}
    return {"name": vocabulary.name, **places, "tasks": tasks, "skills": by_name}
