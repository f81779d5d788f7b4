"""The interface of a skill, and how one is found by its name.

A skill of a package of one's own, such as a learnt policy, is an entry point of the group
"planner_ft.skills" that names a subclass of `Skill`; [skill.NAME] in NAME.simulation.toml says
`implementation = "that entry point"`.
"""

import contextlib
import functools
import traceback
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from typing import Any

import numpy as np

from planner_ft.document.track import Point
from planner_ft.simulation.fast import Bools, Floats, Runs, Vessel
from planner_ft.simulation.scene import Scene
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_toml
from planner_ft.vocabulary.definition import Motion

GROUP = "planner_ft.skills"


@dataclass(frozen=True)
class Job:
    """A skill of a step: its parameters, what it does, and what the plan says around it.

    `points` is the planned way in metres, `seconds` the stated time of a stay, `center` what the
    task goes round, `fences` what the plan keeps, `tolerance` in metres.
    """

    skill: str
    parameters: Mapping[str, Any]
    motion: Motion | None
    settings: Mapping[str, Any] = field(default_factory=dict)
    task: str = ""
    step: int = 0
    points: tuple[Point, ...] = ()
    seconds: float | None = None
    speed: float = 1.0
    center: Point | None = None
    margin: float = 0.0
    tolerance: float = 1.0
    failure: str = "failed"

    def value(self, role: str) -> Any:
        """The value of a role of the motion or the settings; None where nothing says it."""
        if self.motion and role in self.motion.parameters:
            return self.motion.value(role, self.parameters)
        return self.parameters.get(self.settings.get(role, ""))


class Skill:
    """One skill of one step for all runs that come to it; `runs` (n,) are numbers of runs.

    `waits` says of a movement that it lasts until the perception of its step is done.
    """

    waits = False

    def __init__(self, job: Job, scene: Scene) -> None:
        self.job, self.scene = job, scene
        self.begun = np.zeros(scene.count)  # when a run began, in s

    @classmethod
    def check(cls, job: Job, vessel: Vessel) -> None:
        """Raise PlannerError, before anything runs, for a job that it cannot do."""

    def start(self, runs: Runs) -> None:
        """The step begins."""
        self.begun[runs] = self.scene.time

    def step(self, runs: Runs, command: Floats) -> Floats:
        """The command (n, 4) of this time step: surge, sway, climb, yaw rate. A movement makes it,
        a filter limits it, and what perceives leaves it.
        """
        return command

    def done(self, runs: Runs) -> Bools:
        """Whether the end condition holds (n,)."""
        return np.ones(len(runs), dtype=bool)

    def failed(self, runs: Runs) -> Bools:
        """Whether the failure mode holds (n,)."""
        return np.zeros(len(runs), dtype=bool)

    @property
    def why(self) -> str:
        """The sentence of a failure."""
        return f"{self.job.skill}: {self.job.failure}"

    def stop(self, runs: Runs) -> None:
        """The step ends."""

    def errors(self, runs: Runs) -> dict[str, Floats]:
        """What is measured of these runs now (n,), in metres: at the end of a step "waypoint", in
        every time step "holding" and "standoff", the latter once "flown" (where it goes at another
        stand-off than the plan's) or else itself has come within the tolerance.
        """
        return {}

    def elapsed(self, runs: Runs) -> Floats:
        """Seconds since the start (n,)."""
        return self.scene.time - self.begun[runs]


SHAPES: Mapping[str, tuple[type, tuple[int, ...]]] = {
    "step": (float, (4,)),
    **dict.fromkeys(("done", "failed"), (bool, ())),
    **dict.fromkeys(("elapsed", "errors"), (float, ())),
}
"""What methods of a skill return: numbers of a type, and their shape for one run."""


def build(job: Job, scene: Scene) -> Skill:
    """The skill of a job. Raises PlannerError that names a skill that cannot be made."""
    kind = implementation_of(job)
    with _naming(job, f"{kind.__name__}()"):
        made = kind(job, scene)
        if not hasattr(made, "begun"):
            raise TypeError("its __init__ does not call super().__init__(job, scene)")
    return made


def check(job: Job, vessel: Vessel) -> None:
    """Raise PlannerError for a job whose skill is not there or cannot do it."""
    kind = implementation_of(job)
    with _naming(job, f"{kind.__name__}.check"):
        kind.check(job, vessel)


def ask(skill: Skill, what: str, runs: Runs, *given: Any) -> Any:
    """What a method of a skill returns for runs, `why` as a text. Raises PlannerError that names
    the skill where it raises, or returns another shape than the method must have.
    """
    name = f"{type(skill).__name__}.{what}"
    with _naming(skill.job, name, runs):
        if what == "why":
            return str(skill.why)
        found = getattr(skill, what)(runs, *given)
        if what == "errors":
            return {key: _shaped(one, what, skill, runs) for key, one in found.items()}
        return _shaped(found, what, skill, runs) if what in SHAPES else None


def _shaped(found: Any, what: str, skill: Skill, runs: Runs) -> Any:
    """What a method returned as an array; one number or truth value holds for all runs."""
    kind, more = SHAPES[what]
    wanted, shape = (len(runs), *more), np.shape(found)
    if not (shape or more) and found is not None:
        return np.full(wanted, found, dtype=kind)
    if shape != wanted:
        told = f"shape {shape}" if shape else repr(found)
        problem = f"{type(skill).__name__}.{what} returned {told} instead of shape {wanted}"
        raise PlannerError(f"{_place(skill.job, runs)}: {problem}; mend the skill")
    return np.array(found, dtype=kind)


@contextlib.contextmanager
def _naming(job: Job, what: str, runs: Runs | None = None) -> Iterator[None]:
    """Tell in one sentence what a skill raises."""
    try:
        yield
    except (PlannerError, MemoryError):
        raise
    except Exception as error:
        at = traceback.extract_tb(error.__traceback__)[-1]
        line = f"{Path(at.filename).name}, line {at.lineno}"
        problem = " ".join(f"{what} raised {type(error).__name__} ({error}) at {line}".split())
        raise PlannerError(f"{_place(job, runs)}: {problem}; mend the skill") from error


def _place(job: Job, runs: Runs | None) -> str:
    """The skill with its task and step, and the runs that it is asked for."""
    numbers = [int(run) + 1 for run in runs] if runs is not None else []
    more = f" and {len(numbers) - 1} more" if numbers[1:] else ""
    where = f", run {numbers[0]}{more}" if numbers else ""
    return f"[skill.{job.skill}], {job.task} step {job.step + 1}{where}"


def implementation_of(job: Job) -> type[Skill]:
    """The class of a skill. Raises PlannerError where there is none."""
    name = job.settings.get("implementation") or (job.motion.kind if job.motion else "measure")
    known = _implementations()
    where = f"[skill.{job.skill}]"
    if name not in known:
        problem = f"implementation = {name!r} is not installed"
        raise PlannerError(f"{where}: {problem}; there is {', '.join(known)}")
    place = known[name].value
    try:
        found = known[name].load()
    except (ImportError, AttributeError) as error:
        hint = "install what it needs, or the package that adds it anew"
        raise PlannerError(f"{where}: {place} cannot be loaded ({error}); {hint}") from None
    if not (isinstance(found, type) and issubclass(found, Skill)):
        raise PlannerError(f"{where}: {place} is no Skill; ask whoever wrote it")
    return found


@functools.cache
def _implementations() -> dict[str, EntryPoint]:
    """By name. A look through all that is installed takes milliseconds, and plans have many steps."""
    bundled = read_toml(Path(__file__).with_name("implementations.toml"))
    known = {key: EntryPoint(key, place, GROUP) for key, place in bundled.items()}
    return known | {one.name: one for one in entry_points(group=GROUP)}
