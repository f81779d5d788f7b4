"""A review in the browser: the plan on the disk, the approval log, the agents, and what every page
is told of them.
"""

from __future__ import annotations

import threading
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.document import PlanDocument, apply, build, differences, undo
from planner_ft.document.track import track
from planner_ft.document.vehicle import Vehicle
from planner_ft.planning.locations import Position, is_open
from planner_ft.planning.planner import SkillsKnown, TasksKnown, check_command
from planner_ft.planning.result import Answer
from planner_ft.review import approval_of, log_beside
from planner_ft.review.desk import Desk
from planner_ft.review.web.events import Events
from planner_ft.review.web.plan_file import Current, PlanFile, signature
from planner_ft.review.web.planning import Planning
from planner_ft.review.web.settings import WebSettings
from planner_ft.review.web.vocabulary import vocabulary_json
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary

if TYPE_CHECKING:
    from planner_ft.planning.planner import Planner

LONGEST_COMMAND = 20_000
"""Characters."""
EDITS = ("locate", "parameter", "prompt", "remove", "move", "insert", "skill")
"""The kinds of edits that a page makes: not those that record what an agent answered or what was
adopted.
"""
State = dict[str, Any]


class Session:
    """What the pages see and do. Its methods raise PlannerError with the sentence that the page
    shows, and may be called from any thread.
    """

    def __init__(
        self,
        plan: Path | None,
        settings: WebSettings,
        vocabulary: Vocabulary,
        vehicle: Vehicle | None = None,
    ) -> None:
        """`vehicle` is the one that new commands are planned for: the vocabulary's own by
        default.
        """
        self.vocabulary, self.vehicle = vocabulary, vehicle
        folder = settings.folder or (plan.parent if plan else Path())
        self.file = PlanFile(plan, folder, vocabulary)
        self.events = Events()
        self.planning = Planning(settings.planning, self.events, self.tell_state)
        self.log = settings.log or log_beside(folder / "any")
        self._lock = threading.Lock()
        self._told: Any = self._signature()
        self._shown: tuple[Any, State] = (None, {})

    # ------------------------------------------------------------ what a page sees

    def state(self) -> State:
        """Everything that a page shows. Raises PlannerError when the plan cannot be read."""
        return {
            **self._plan_state(),
            "planner": self.planning.as_json(),
            "busy": self.planning.busy,
            "vocabulary": vocabulary_json(self.vocabulary),
            "plans": self.file.plans(),
        }

    def look(self) -> None:
        """Tell the pages when plan or log are not what they were told of: somebody else wrote
        them.
        """
        now = self._signature()
        with self._lock:
            changed, self._told = now != self._told, now
        if changed:
            self._tell_state()

    def tell_state(self) -> None:
        """Tell the pages to ask for the state anew."""
        with self._lock:
            self._told = self._signature()
        self._tell_state()

    # ------------------------------------------------------------ what a page does

    def edit(self, revision: str, edit: dict[str, Any]) -> State:
        """Make one edit."""
        if edit.get("kind") not in EDITS:
            raise PlannerError(
                f"edit {str(edit.get('kind'))[:40]!r}: is none that a page makes; there is"
                f" {', '.join(EDITS)}"
            )
        self.file.change(revision, lambda document: apply(document, edit, self.vocabulary))
        return self._changed()

    def undo(self, revision: str) -> State:
        """Take the last edit back."""
        self.file.change(revision, lambda document: undo(document, self.vocabulary))
        return self._changed()

    def approve(self, revision: str, name: str, acknowledged: list[str]) -> State:
        """Record an approval. Raises UnacknowledgedError when warnings are not acknowledged."""
        self._desk(revision).approve(name, acknowledged)
        return self._changed()

    def reject(self, revision: str, name: str, reason: str) -> State:
        """Record a rejection."""
        self._desk(revision).reject(name, reason)
        return self._changed()

    def open(self, name: str) -> State:
        """Show another plan of the folder."""
        self.file.open(name)
        return self._changed()

    def plan(self, command: str, locations: Mapping[str, Position]) -> None:
        """Have a command planned; the plan is a file of its own, and is shown when it is done.
        Raises BusyError.
        """
        if len(command) > LONGEST_COMMAND:
            raise PlannerError(
                f"the command has {len(command)} characters, and at most {LONGEST_COMMAND} are"
                " planned; shorten it"
            )
        check_command(command)

        def work(planner: Planner) -> None:
            planned = planner.plan(command, locations, self._watch)
            self.file.add(build(planned, self.vocabulary, self.vehicle))

        self.planning.ask({"what": "planning", "label": "planning", "command": command}, work)

    def skills(self, revision: str, task: str) -> None:
        """Have the Task Agent asked again for one task; its answer becomes an edit. Raises
        BusyError, ChangedError.
        """
        with self.file.held(revision) as now:
            path, asked = now.path, _task(now.document, task)
        if is_open(asked, self.vocabulary):
            raise PlannerError(f"task {task}: its place is not known yet; say where it is first")

        def work(planner: Planner) -> None:
            answer = planner.skills(asked)
            if answer.plan is None:
                raise PlannerError(
                    f"task {task}: the Task Agent's answer is not valid ({answer.problems[0]}); the"
                    " task keeps the skills that it has"
                )
            edit = {
                "kind": "skills",
                "task": task,
                "skill_sequence": answer.plan["skill_sequence"],
                "assumptions": list(answer.notes),
            }
            self._take_skills(path, asked, edit)

        self.planning.ask({"what": "skills", "label": f"skills of task {task}"}, work)

    # ------------------------------------------------------------ parts

    def _desk(self, revision: str) -> Desk:
        """The plan as the review in the terminal has it, where decisions are taken. Raises
        ChangedError when it is of another revision.
        """
        with self.file.held(revision) as now:
            return Desk(now.path, self.log, self.vocabulary, _no_agent)

    def _take_skills(self, path: Path, asked: dict[str, Any], edit: dict[str, Any]) -> None:
        """Put the skills of a task into the plan, which may have been edited elsewhere since they
        were asked for.
        """
        now = self.file.current()
        if now is None or now.path != path:
            raise PlannerError(
                f"task {asked['id']}: another plan is shown since its skills were asked for; open"
                f" {path.name} and ask again"
            )
        task = _task(now.document, asked["id"])
        if any(task[key] != asked[key] for key in ("title", "parameters", "task_prompt")):
            raise PlannerError(
                f"task {asked['id']} was edited while its skills were planned; ask again"
            )
        self.file.change(now.revision, lambda document: apply(document, edit, self.vocabulary))

    def _watch(self, event: TasksKnown | SkillsKnown) -> None:
        """Tell the pages of a plan that comes into being."""
        self.planning.go_on()
        if isinstance(event, TasksKnown):
            tasks = [
                {
                    "id": f"t{number}",
                    "title": task.title,
                    "parameters": task.parameters,
                    "task_prompt": task.task_prompt,
                    "skill_sequence": None,
                }
                | ({"waits_for": task.waits_for} if task.waits_for else {})
                for number, task in enumerate(event.tasks, start=1)
            ]
            self.events.tell("tasks", {"tasks": tasks})
        else:
            skills = event.answer.plan["skill_sequence"] if event.answer.plan is not None else None
            self.events.tell("skills", {"task": f"t{event.number}", "skill_sequence": skills})

    def _changed(self) -> State:
        self.tell_state()
        return self.state()

    def _signature(self) -> Any:
        return self.file.signature(), signature(self.log)

    def _tell_state(self) -> None:
        try:
            now = self.file.current()
        except PlannerError:
            now = None
        self.events.tell("state", {"revision": now.revision if now else None})

    def _plan_state(self) -> State:
        """The part of the state that follows from plan and log, computed anew when one of them
        changed.
        """
        found = self._signature()
        if self._shown[0] != found:
            self._shown = (found, self._seen(self.file.current()))
        return self._shown[1]

    def _seen(self, now: Current | None) -> State:
        if now is None:
            return {
                "document": None,
                "path": None,
                "revision": None,
                "differences": [],
                "track": None,
                "approval": _undecided("there is no plan yet"),
            }
        return {
            "document": now.document,
            "path": now.path.name,
            "revision": now.revision,
            "differences": [difference.as_json() for difference in differences(now.document)],
            "track": track(now.document, self.vocabulary).as_json(),
            "approval": self._approval(now.document),
        }

    def _approval(self, document: PlanDocument) -> dict[str, Any]:
        """What the log says of the plan. A log that is broken keeps nobody from looking at the
        plan.
        """
        try:
            return approval_of(document, self.log).as_json()
        except PlannerError as error:
            return _undecided(str(error))


def _undecided(text: str) -> dict[str, Any]:
    return {"status": "unknown", "text": text, "reviewer": None, "time": None, "sequence": None}


def _no_agent(_task: Mapping[str, Any]) -> Answer:
    raise AssertionError("decisions ask no agent")


def _task(document: PlanDocument, ident: str) -> dict[str, Any]:
    for task in document["tasks"]:
        if task["id"] == ident:
            found: dict[str, Any] = task
            return found
    raise PlannerError(f"task {ident}: is not in the plan any more")
