"""One plan in review: a reviewer's actions, each saved before it is shown, in a file that several
terminals and browsers may have open; and the plans of its folder.
"""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import asdict
from datetime import UTC, datetime
from itertools import count
from pathlib import Path
from typing import Any

from planner_ft import document as plans
from planner_ft.document import PlanDocument
from planner_ft.document.build import vocabulary_of
from planner_ft.document.confidence import skills_confidence
from planner_ft.document.edits import Difference, compare
from planner_ft.document.track import track
from planner_ft.document.tree import brief
from planner_ft.document.warnings.case import gravest_first, meaning
from planner_ft.planning.planner import Planner
from planner_ft.planning.result import Answer
from planner_ft.planning.settings import DEFAULT_CANDIDATE, PlanSettings
from planner_ft.review.approval import Approval, approval_of, approve, reject, tampered
from planner_ft.review.commands import parse_edit
from planner_ft.review.log import Appended, exclusive, log_beside
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.definition import DEFAULT
from planner_ft.vocabulary.schema import FORMAT

MOST_PLANS = 200
"""Plans of the folder that are offered, newest first."""


class ChangedError(PlannerError):
    """The plan's file is not what it was when it was read."""

    @classmethod
    def of(cls, path: Path) -> ChangedError:
        problem = "was changed by somebody else since it was read, so nothing was done"
        return cls(f"{path}: {problem}; read it again")


@contextlib.contextmanager
def unchanged(path: Path, digest: str) -> Iterator[None]:
    """Hold the plan's lock while its content has this `document_digest`. Raises ChangedError."""
    with exclusive(path):
        value = read_json(path)
        if not isinstance(value, dict) or plans.document_digest(value) != digest:
            raise ChangedError.of(path)
        yield


def plan_names(folder: Path) -> list[str]:
    """The names of the plans in the folder, which may hold any other JSON, newest first."""
    found = []
    for file in filter(Path.is_file, folder.glob("*.json")):
        with contextlib.suppress(OSError), open(file, "rb") as stream:
            if f'"{FORMAT}"'.encode() in stream.read(200):  # plans begin so
                found.append((file.stat().st_mtime, file.name))
    return [name for _time, name in sorted(found, reverse=True)[:MOST_PLANS]]


def add_plan(folder: Path, document: PlanDocument) -> Path:
    """Write a new plan into a file named by the time (UTC). Raises PlannerError."""
    stem = f"plan-{datetime.now(UTC):%Y%m%d-%H%M%S}"
    for number in count(1):
        path = folder / f"{stem}{f'-{number}' if number > 1 else ''}.json"
        with exclusive(path):
            if not path.exists():
                plans.write_document(path, document)
                return path
    raise AssertionError


def signature(path: Path | None) -> tuple[int, int, int] | None:
    """A value that changes when a file is written anew; None where there is no file."""
    try:
        stat = path.stat() if path else None
    except OSError:
        return None
    return (stat.st_mtime_ns, stat.st_size, stat.st_ino) if stat else None


Ask = Callable[[Mapping[str, Any], Sequence[Mapping[str, Any]]], Answer] | None
"""Asks the Task Agent for the skills of a document's task, given with those before it. Raises
PlannerError without a model.
"""


class Desk:
    """A plan in review: `by` is the reviewer (None: unknown), `revision` the content's digest."""

    def __init__(
        self, path: Path, log: Path, vocabulary: Vocabulary, ask: Ask = None, by: str | None = None
    ) -> None:
        """Reads the plan. Raises PlannerError as `read_document` does."""
        self.path, self.log, self.vocabulary, self.by = path, log, vocabulary, by
        self._ask = ask
        self.read()

    def read(self) -> None:
        """Take the plan as it is in the file now."""
        self.document = plans.read_document(self.path, self.vocabulary)
        self.revision = plans.document_digest(self.document)

    def approval(self) -> Approval:
        """The decision in the log about the plan as it is."""
        return approval_of(self.document, self.log)

    def edit(self, text: str) -> list[Difference]:
        """Make and save the edit; returns the differences. Raises PlannerError."""
        edit = parse_edit(text, self.document, self.vocabulary)
        before = self.document
        if edit["kind"] == "undo":
            self.undo()
        elif edit["kind"] == "ask":
            self._ask_again(edit["tasks"])
        else:
            self.apply(edit)
        return compare(before, self.document)

    def apply(self, edit: dict[str, Any]) -> None:
        """Make an edit of planner_ft.document and save it. Raises PlannerError."""
        self._save(plans.apply(self.document, edit, self.vocabulary, self.by))

    def undo(self) -> None:
        """Take the last edit back and save. Raises PlannerError."""
        self._save(plans.undo(self.document, self.vocabulary))

    def adopt(self) -> None:
        """Take over what was changed by hand, as an edit. Raises PlannerError."""
        if not plans.altered(self.document):
            raise PlannerError(f"{self.path}: was not altered by hand; leave --adopt out")
        self._save(plans.adopt(self.document, self.vocabulary, self.by))

    def approve(self, name: str, acknowledged: Collection[str]) -> Appended:
        """Approve the plan in the file. Raises PlannerError, also for new warnings."""
        is_altered = plans.altered(self.document)
        fresh = self.document if is_altered else plans.revise(self.document, self.vocabulary)
        if plans.document_digest(fresh) != self.revision:
            self._save(fresh)
            problem = "warnings and estimates were worked out anew and are others than in the file"
            raise PlannerError(f"{self.path}: {problem}; look at them, then approve")
        with unchanged(self.path, self.revision):
            return approve(self.document, self.log, name, acknowledged)

    def reject(self, name: str, reason: str) -> Appended:
        """Reject the plan as it is in the file. Raises PlannerError."""
        with unchanged(self.path, self.revision):
            return reject(self.document, self.log, name, reason)

    def _ask_again(self, tasks: list[str]) -> None:
        assert self._ask
        if not tasks:
            problem = "every task whose place is known has skills that fit it"
            raise PlannerError(f"skills: {problem}; give the number of a task to ask for it anyway")
        for name in tasks:
            number = [task["id"] for task in self.document["tasks"]].index(name)
            task, before = self.document["tasks"][number], self.document["tasks"][:number]
            answer = self._ask(task, before)
            if answer.plan is None:
                what, why = f"skills of {task['title']}", "; ".join(answer.problems[:2])
                problem = f"the Task Agent's answer is not valid ({why})"
                raise PlannerError(f"{what}: {problem}; edit the task and ask again")
            self.apply(skills_edit(name, answer.plan, answer))

    def _save(self, document: PlanDocument) -> None:
        with unchanged(self.path, self.revision):
            self.document = plans.write_document(self.path, document)
        self.revision = plans.document_digest(self.document)


def skills_edit(task: str, plan: Mapping[str, Any], answer: Answer) -> dict[str, Any]:
    """The edit that gives a task (by id) the skills of a valid answer."""
    given = {"skill_sequence": plan["skill_sequence"], "assumptions": list(answer.notes)}
    given |= {"defaults": answer.defaults} if answer.defaults else {}
    given |= {"added": list(answer.added)} if answer.added else {}
    sure = skills_confidence(answer.judged)
    given |= {"confidence": sure} if sure else {}
    return {"kind": "skills", "task": task, **given}


def open_desk(
    path: Path,
    log: Path | None,
    vocabulary: str | None,
    by: str | None,
    candidate: str | None = None,
    device: str = "auto",
) -> Desk:
    """The desk of a plan in a file with the vocabulary and agents that planned it by default."""
    document, known = read_plan(path, vocabulary)
    settings = settings_of(document, known, candidate, device)
    planner = functools.cache(lambda: Planner(settings))
    return Desk(
        path,
        log or log_beside(path),
        known,
        lambda task, before: planner().skills(task, before),
        by,
    )


def read_plan(path: Path, vocabulary: str | None) -> tuple[PlanDocument, Vocabulary]:
    """A plan and its vocabulary, by default the bundled one that it names. Raises PlannerError."""
    known = load_vocabulary(vocabulary) if vocabulary else None
    document = plans.read_document(path, known)
    return document, known or vocabulary_of(document, path)


def settings_of(
    document: PlanDocument,
    vocabulary: Vocabulary,
    candidate: str | None = None,
    device: str = "auto",
) -> PlanSettings:
    """The settings under which a document was planned; of another candidate, the defaults."""
    agents = {} if candidate else document["manifest"].get("agents", {})
    named: dict[str, Any] = {}
    for level, made in agents.items():
        adapter = made.get("adapter")
        named[f"{level}_candidate"] = made["candidate"]
        named[f"{level}_configuration"] = made.get("configuration")
        # An adapter that lies elsewhere now is looked for as `plannerft plan` does.
        named[f"{level}_adapter"] = adapter if adapter and Path(adapter).is_dir() else None
    source = vocabulary.source
    return PlanSettings(candidate or DEFAULT_CANDIDATE, vocabulary=source, device=device, **named)


def planning_of(
    plan: Path | None, vocabulary: str | None, candidate: str | None, device: str
) -> PlanSettings:
    """The settings under which the plan in a file was planned, without one the defaults."""
    if plan is not None:
        return settings_of(*read_plan(plan, vocabulary), candidate, device)
    named = vocabulary or DEFAULT
    return PlanSettings(candidate or DEFAULT_CANDIDATE, vocabulary=named, device=device)


PLAN = ("document", "path", "revision", "track", "brief", "tampered", "warnings")
"""Keys of the state that are None without a plan."""
State = dict[str, Any]


def plan_state(desk: Desk | None) -> State:
    """The plan on a desk: document, track, brief, what was changed outside of the review (None:
    nothing), warnings with severity and name, differences from the proposal, and the decision.
    """
    if desk is None:
        approval = _undecided("there is no plan yet")
        return {**dict.fromkeys(PLAN), "differences": [], "approval": approval}
    document = desk.document
    try:
        approval = asdict(desk.approval())
    except PlannerError as error:
        # A log that is broken keeps nobody from looking at the plan.
        approval = _undecided(str(error))
    course = track(document, desk.vocabulary)
    foreign = tampered(document, desk.vocabulary)
    warned = [(one, *meaning(one["kind"])) for one in gravest_first(document["warnings"])]
    return {
        "document": document,
        "path": desk.path.name,
        "revision": desk.revision,
        "track": asdict(course),
        "brief": asdict(brief(document, course, desk.vocabulary)),
        "tampered": None if foreign is None else [one.text for one in foreign],
        "warnings": [{**one, "severity": severity, "name": name} for one, severity, name in warned],
        "differences": [asdict(one) for one in plans.differences(document)],
        "approval": approval,
    }


def _undecided(text: str) -> dict[str, Any]:
    return {"status": "unknown", "text": text, "reviewer": None, "time": None, "sequence": None}
