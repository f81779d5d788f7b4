"""What a format is, what it is given, and which formats there are.

A format of a lab's own is an entry point of the group "planner_ft.formats" that names a `Format`:

    [project.entry-points."planner_ft.formats"]
    ours = "our_package.ours:FORMAT"
"""

import functools
import tomllib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from typing import Any

from planner_ft.document.track import Leg, Track, hold_time, track
from planner_ft.exporters.ledger import Account, Ledger
from planner_ft.exporters.ledger import Path as Place
from planner_ft.support.errors import PlannerError
from planner_ft.support.geodesy import Origin
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import Motion, Skill, Task

GROUP = "planner_ft.formats"
DRAFT = "DRAFT - NOT APPROVED"
TABLES: dict[str, Any] = tomllib.loads(Path(__file__).with_name("tables.toml").read_text("utf-8"))
BUNDLED: dict[str, str] = TABLES["formats"]
NO_SKILL: dict[str, Any] = {"name": "", "parameters": {}}


def typed(parameters: Mapping[str, Any], owner: Skill | Task) -> dict[str, Any]:
    """Parameters with whole numbers as integers where the definition says so: 5 for 5.0."""
    whole = [one.name for one in owner.parameters if one.type == "integer"]
    given = {name: parameters[name] for name in whole if name in parameters}
    return {**parameters, **{name: int(one) for name, one in given.items() if one == int(one)}}


@dataclass(frozen=True)
class Action:
    """The movement of a step, or of a task without skills, which has no step ({}).

    `task` and `number` are the indices (from 0) of its task and its step, `motion` is what its
    skill does, `leg` its movement in the track; None where they are not known. `timed` is the
    task's parameter with the time of a hold by a skill that takes none.
    """

    task: int
    number: int
    entry: Mapping[str, Any]
    step: Mapping[str, Any]
    motion: Motion | None
    leg: Leg | None
    timed: str = ""

    @property
    def at(self) -> Place:
        """Where its step stands in the document."""
        return "tasks", self.task, "skill_sequence", self.number

    @property
    def skill(self) -> Any:
        """The skill that moves the vehicle."""
        return self.step.get("navigation_skill", NO_SKILL)

    @property
    def given(self) -> dict[str, Any]:
        """The stated values of the movement by their roles."""
        parameters, known = self.skill["parameters"], self.motion.parameters if self.motion else {}
        given = {role: parameters.get(name) for role, name in known.items()}
        given |= {"time": self.leg.seconds} if self.timed and self.leg else {}
        return {role: value for role, value in given.items() if value is not None}

    def roles(self) -> Iterator[tuple[str, Place]]:
        """The role (its name where it has none) and the place of each parameter of the skill."""
        known = self.motion.parameters.items() if self.motion else ()
        roles = {name: role for role, name in known}
        for name in self.skill["parameters"]:
            yield roles.get(name, name), (*self.at, "navigation_skill", "parameters", name)


@dataclass(frozen=True)
class PlanExport:
    """A plan on its way to a vehicle.

    `origin`, where [0, 0] lies, is None only for formats that do not need it. `approval` says in
    one sentence who approved the plan and when; it is None for a draft.
    """

    document: dict[str, Any]
    vocabulary: Vocabulary
    origin: Origin | None = None
    approval: str | None = None

    @property
    def name(self) -> str:
        """A name for the mission; a draft's begins with DRAFT."""
        name = f"plan {self.document['digest'][:12]}"
        return name if self.approval else f"{DRAFT}: {name}"

    @property
    def mark(self) -> str:
        """The file's words about its approval: who gave it, or DRAFT."""
        return self.approval or DRAFT

    @functools.cached_property
    def track(self) -> Track:
        """The vehicle's track in local metres."""
        return track(self.document, self.vocabulary)

    @functools.cached_property
    def blocked(self) -> tuple[int, str] | None:
        """(index from 0 of the first task that waits for a place or for its skills, why), or None:
        a format that cannot wait carries no task from here on.
        """
        for index, task in enumerate(self.document["tasks"]):
            name, place = task["id"], task.get("waits_for")
            if place:
                why = f'{name} waits for "{place}", and the format cannot wait'
                return index, f"{why}: plan again when it is located"
            if task["skill_sequence"] is None and name in self.track.open:
                why = f"{name} has no skills, and the format cannot go on without its movement"
                return index, f"{why}: plan its skills first"
        return None

    @functools.cached_property
    def actions(self) -> list[Action]:
        """The movements that a format which cannot wait for a place carries."""
        found, legs = [], {(leg.task, leg.step): leg for leg in self.track.legs}
        for index, task in enumerate(self.document["tasks"][: self.ready]):
            steps, own = task["skill_sequence"], hold_time(task, self.vocabulary)
            for number, step in enumerate([{}] if steps is None else steps):
                name = step["navigation_skill"]["name"] if step else ""
                motion, leg = self.vocabulary.motion.of(name), legs.get((task["id"], number))
                timed = own[0] if own and motion and motion.kind == "hold" else ""
                found.append(Action(index, number, task, step, motion, leg, timed))
        return found

    @property
    def ready(self) -> int:
        """Tasks, from the first, that a format that cannot wait for a place carries."""
        return self.blocked[0] if self.blocked else len(self.document["tasks"])

    def ledger(self) -> Ledger:
        """A new account of this plan."""
        return Ledger(self.document)

    def lose_blocked(self, ledger: Ledger) -> None:
        """Enter the tasks from the first blocked one on as lost."""
        for index in range(self.ready, len(self.document["tasks"])):
            ledger.lose("tasks", index, why=self.blocked[1] if self.blocked else "")
        if self.blocked:
            ledger.stop("tasks", self.ready)

    def head_words(self, ledger: Ledger, form: str) -> Iterator[str]:
        """The words of the plan as a whole, which are entered as carried in this form."""
        for path, item in ledger.items.items():
            if path[0] not in ("tasks", "open_places"):
                ledger.carry(*path, form=form)
                yield f"command: {self.document['command']}" if path[0] == "command" else item.what


@dataclass(frozen=True)
class Written:
    """A format's file, and what became of everything that the plan says."""

    text: str
    account: Account


@dataclass(frozen=True)
class Format:
    """A file format for approved plans; `extension` begins with a dot. `write` may raise
    PlannerError for a plan that the format cannot take at all.
    """

    name: str
    extension: str
    description: str
    needs_origin: bool
    write: Callable[[PlanExport], Written]


def known_formats() -> dict[str, EntryPoint]:
    """The bundled formats, then those that entry points add."""
    bundled = {name: EntryPoint(name, place, GROUP) for name, place in BUNDLED.items()}
    return bundled | {one.name: one for one in entry_points(group=GROUP) if one.name not in bundled}


def load_format(name: str) -> Format:
    """A format by its name. Raises PlannerError when there is none or it cannot be loaded."""
    known = known_formats()
    if name not in known:
        raise PlannerError(f"--format {name}: must be one of {', '.join(known)}, or all")
    entry = known[name]
    about = f"--format {name}: {entry.value}"
    try:
        loaded = entry.load()
    except (ImportError, AttributeError) as error:
        hint = "install what it needs, or the package that adds it anew"
        raise PlannerError(f"{about} cannot be loaded ({error}); {hint}") from error
    if not isinstance(loaded, Format):
        raise PlannerError(f"{about} is no planner_ft.exporters.Format; ask whoever wrote it")
    return loaded
