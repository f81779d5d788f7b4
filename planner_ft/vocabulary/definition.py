"""A vehicle's tasks and skills, loaded from a definition file and those beside it: what skills and
tasks do (NAME.motion.toml), what tasks bring about and need beyond their places (NAME.logic.toml).
"""

import functools
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal, get_args

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, read_text, read_toml, sha256_text
from planner_ft.vocabulary import checks
from planner_ft.vocabulary.checks import Entry

Role = Literal["navigation", "filter", "perception"]
ParameterType = Literal["position", "polygon", "number", "integer", "text", "id", "texts"]
Arrival = Literal["transit", "self", "none"]
SkillMotion = Literal["goto", "hold", "turn_to", "turn_by", "arc", "drift", "visual", "wait"]
MotionKind = Literal[
    "go", "hold", "turn-to", "turn-by", "arc", "drift", "wait", "boundary", "clearance", "heading"
]
ROLES: tuple[Role, ...] = get_args(Role)

BUNDLED = Path(__file__).parent
DEFAULT = "usv"
PHRASES, VEHICLE, ONTOLOGY = ".phrases.toml", ".vehicle.toml", ".ontology.toml"
MISSIONS, LIMITS, ESSENTIALS = ".missions.toml", ".limits.toml", ".essentials.toml"
SIMULATION, LOGIC, MOTION = ".simulation.toml", ".logic.toml", ".motion.toml"
UNHASHED = (LOGIC, MOTION, VEHICLE, ONTOLOGY, MISSIONS, LIMITS, ESSENTIALS, SIMULATION)
"""Files beside a definition that no prompt, schema or grammar, and so no adapter depends on."""
READ_WITH_IT = (PHRASES, LOGIC, MOTION)


@dataclass(frozen=True)
class Parameter:
    """A parameter of a task or skill."""

    name: str
    type: ParameterType
    unit: str | None = None
    required: bool = False
    minimum: float | None = None
    maximum: float | None = None
    description: str = ""

    @property
    def bounds(self) -> str:
        """Its least and largest value, as "0 to 10000"; empty without bounds."""
        if self.minimum is None or self.maximum is None:
            return ""
        return f"{self.minimum:.15g} to {self.maximum:.15g}"


class _Owner:
    """A task or a skill, which has parameters."""

    parameters: tuple[Parameter, ...]

    @functools.cached_property
    def by_name(self) -> dict[str, Parameter]:
        return {parameter.name: parameter for parameter in self.parameters}


@dataclass(frozen=True)
class Task(_Owner):
    """A task title with parameters, the movement that it stands for, and skills by role."""

    title: str
    category: str
    description: str
    arrival: Arrival
    pattern: str
    leaves: bool = False
    parameters: tuple[Parameter, ...] = ()
    require_any: tuple[str, ...] = ()
    skills: dict[Role, tuple[str, ...]] = field(default_factory=dict)

    @property
    def position_parameter(self) -> str | None:
        """The parameter that says where the task takes place, if it has one."""
        return next((item.name for item in self.parameters if item.type == "position"), None)

    @property
    def docks(self) -> bool:
        """Whether the task ends at a docking spot, which needs no search."""
        return self.pattern == "approach"


@dataclass(frozen=True)
class Skill(_Owner):
    """A skill with its parameters, role, and the strings that a step with it reports."""

    name: str
    category: str
    role: Role
    description: str
    motion: SkillMotion | None = None
    parameters: tuple[Parameter, ...] = ()
    require_any: tuple[str, ...] = ()
    stop: str | None = None
    failure: str | None = None
    output: str | None = None

    @functools.cached_property
    def coordinates(self) -> tuple[Parameter, ...]:
        """x and y of a skill that goes somewhere, in this order; of any other none."""
        needed = [item for item in self.parameters if item.required and item.type == "number"]
        return tuple(needed[:2]) if self.motion == "goto" else ()


@dataclass(frozen=True)
class Motion:
    """What a skill does to the vehicle, and its parameters by role ("angle" -> "delta_yaw").

    Metres, seconds, degrees clockwise; a hold without a time lasts until a stop condition.
    """

    kind: MotionKind
    parameters: Mapping[str, str] = field(default_factory=dict)

    def value(self, role: str, parameters: Entry) -> Any:
        """The value that a skill's parameters give to a role; None where they do not say it."""
        return parameters.get(self.parameters.get(role, ""))


@dataclass(frozen=True)
class Standoff:
    """The task parameters that say the circle kept around a target, and the angle of it."""

    center: str
    radius: str
    arc: str | None = None


TASK_ROLES = {"speed": "speed", "time": "duration"}
"""What a task's own parameters may say of its movement (how fast, in m/s; how long its one stay
lasts, in s), and the names of those that say it where the motion file names no others.
"""


@dataclass(frozen=True)
class Motions:
    """The motion of skills by name, the stand-off of tasks by title, and the parameters of tasks by
    title and role (TASK_ROLES). `sha256` is the digest of what the file says, "" without one.
    """

    skills: Mapping[str, Motion] = field(default_factory=dict)
    standoffs: Mapping[str, Standoff] = field(default_factory=dict)
    named: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    sha256: str = ""

    def parameter(self, title: str, role: str) -> str:
        """The name of a task's parameter that says its speed or its time."""
        return self.named.get(title, {}).get(role, TASK_ROLES[role])

    def of(self, skill: str) -> Motion | None:
        """What a skill does to the vehicle; None for a skill that nothing is declared for."""
        return self.skills.get(skill)

    def standoff(self, title: str) -> Standoff | None:
        """The circle that a task keeps; None for a task that keeps none."""
        return self.standoffs.get(title)


@dataclass(frozen=True)
class TaskLogic:
    """Facts that a task gives and needs, words for its yield, and the parameter of sent items."""

    gives: tuple[str, ...] = ()
    needs: tuple[str, ...] = ()
    yields: tuple[str, ...] = ()
    sends: str | None = None


@dataclass(frozen=True)
class Logic:
    """`lacking`: per fact the sentence for a plan without it; `tasks`: the logic by title."""

    lacking: dict[str, str] = field(default_factory=dict)
    tasks: dict[str, TaskLogic] = field(default_factory=dict)

    def of(self, title: str) -> TaskLogic:
        """The logic of a task; an empty one where nothing is declared."""
        return self.tasks.get(title, TaskLogic())


@dataclass(frozen=True, eq=False)
class Vocabulary:
    """A vehicle's tasks and skills, compared by identity; positions are metres in the local frame.

    `phrases`, `logic` and `motion` are the content of NAME.phrases.toml (wordings for sampling),
    NAME.logic.toml and NAME.motion.toml. `sha256` is the digest of the definition alone.
    """

    name: str
    title: str
    frame: str
    home: tuple[float, float]
    unresolved: tuple[float, float]
    transit: str
    locate: str
    tasks: tuple[Task, ...]
    skills: tuple[Skill, ...]
    source: str
    sha256: str
    phrases: dict[str, Any] = field(default_factory=dict)
    logic: Logic = field(default_factory=Logic)
    motion: Motions = field(default_factory=Motions)
    path: Path | None = None

    @functools.cached_property
    def task(self) -> dict[str, Task]:
        """Tasks by title."""
        return {task.title: task for task in self.tasks}

    @functools.cached_property
    def skill(self) -> dict[str, Skill]:
        """Skills by name."""
        return {skill.name: skill for skill in self.skills}

    @property
    def named(self) -> dict[str, str]:
        """Name and digest, as manifests have them."""
        return {"name": self.name, "sha256": self.sha256}

    @property
    def bundled(self) -> bool:
        """Whether the definition ships with the package."""
        return self.path is not None and self.path.parent == BUNDLED

    @property
    def data(self) -> Path:
        """Its data: data, data/NAME for other bundled vehicles, else beside it."""
        if self.path is not None and not self.bundled:
            return self.path.parent
        return Path("data") / ("" if self.name == DEFAULT else self.name)

    def beside(self, ending: str) -> dict[str, Any]:
        """The file NAME + `ending` beside the definition ({} without). Raises PlannerError."""
        return read_beside(self.path, ending, self.name) if self.path else {}

    def skills_in_role(self, role: Role) -> tuple[Skill, ...]:
        """Skills that can stand in `role`, in the order of the definition."""
        return tuple(skill for skill in self.skills if skill.role == role)


def bundled_vocabularies() -> list[str]:
    """Names of the definitions that ship with the package."""
    return sorted(
        path.stem for path in BUNDLED.glob("*.toml") if not path.name.endswith((PHRASES, *UNHASHED))
    )


@functools.lru_cache(maxsize=16)
def load_vocabulary(source: str | Path = DEFAULT, *, without: tuple[str, ...] = ()) -> Vocabulary:
    """Load a bundled definition ("usv") or a path. Raises PlannerError listing all problems. Files
    beside it with an ending in `without` are not read.
    """
    bundled = BUNDLED / f"{source}.toml"
    path = bundled if str(source).isidentifier() and bundled.is_file() else Path(source)
    if not path.is_file():
        raise PlannerError(
            f"--vocabulary {source}: no such file, and no bundled vocabulary of that name"
            f" ({', '.join(bundled_vocabularies())})"
        )
    raw = read_toml(path)
    phrases, logic, motion = (
        {} if ending in without else _beside(path, ending) for ending in READ_WITH_IT
    )
    vocabulary = build_vocabulary(raw, phrases, str(path), logic=logic, motion=motion)
    return replace(vocabulary, path=path, source=str(source), sha256=sha256_text(read_text(path)))


def build_vocabulary(
    raw: dict[str, Any],
    phrases: dict[str, Any],
    where: str,
    *,
    logic: dict[str, Any] | None = None,
    motion: dict[str, Any] | None = None,
) -> Vocabulary:
    """The vocabulary of parsed files. Raises PlannerError that lists everything wrong."""
    logic, motion = logic or {}, motion or {}
    problems = list(checks.shape_problems(raw, phrases))
    if not problems:
        vocabulary = _build(raw, phrases)
        problems += checks.reference_problems(vocabulary)
        problems += checks.logic_problems(logic, vocabulary.task)
        problems += checks.motion_problems(motion, vocabulary.task, vocabulary.skill)
    if problems:
        raise PlannerError(f"{where}: " + "; ".join(problems))
    return replace(vocabulary, logic=_logic(logic), motion=_motions(motion))


def read_beside(path: Path, ending: str, name: str) -> dict[str, Any]:
    """The file `name` + `ending` beside a definition ({} without one), its shape checked. Raises
    PlannerError.
    """
    raw = _beside(path, ending)
    if raw and (problem := checks.shape_of_file(raw, ending)):
        raise PlannerError(f"{name}{ending}: {problem}")
    return raw


def _beside(path: Path, ending: str) -> dict[str, Any]:
    beside = path.with_name(path.name.removesuffix(".toml") + ending)
    return read_toml(beside) if beside.is_file() else {}


def _build(raw: dict[str, Any], phrases: dict[str, Any]) -> Vocabulary:
    values: dict[str, Any] = {"source": "", "sha256": "", "phrases": phrases}
    for key, value in raw["vehicle"].items():
        values[key] = tuple(value) if isinstance(value, list) else value
    tasks = tuple(Task(**_values(entry)) for entry in raw["task"])
    skills = tuple(Skill(**_values(entry)) for entry in raw["skill"])
    return Vocabulary(tasks=tasks, skills=skills, **values)


def _values(entry: dict[str, Any]) -> dict[str, Any]:
    values = {**entry, "require_any": tuple(entry.get("require_any", ()))}
    values["parameters"] = tuple(Parameter(**item) for item in entry.get("parameters", ()))
    if "skills" in entry:
        values["skills"] = {role: tuple(names) for role, names in entry["skills"].items()}
    return values


def _motions(raw: Entry) -> Motions:
    skills = {}
    for name, entry in raw.get("skill", {}).items():
        roles = {role: key for role, key in entry.items() if role != "motion"}
        skills[name] = Motion(entry["motion"], roles)
    standoffs, named = {}, {}
    for title, entry in raw.get("task", {}).items():
        named[title] = {role: entry[role] for role in entry.keys() & TASK_ROLES.keys()}
        if ring := {role: key for role, key in entry.items() if role not in TASK_ROLES}:
            standoffs[title] = Standoff(**ring)
    return Motions(skills, standoffs, named, sha256_text(compact_json(raw)) if raw else "")


def _logic(raw: Entry) -> Logic:
    tasks = {}
    for title, entry in raw.get("task", {}).items():
        lists = {key: tuple(entry.get(key, ())) for key in checks.LISTS}
        tasks[title] = TaskLogic(**lists, sends=entry.get("sends"))
    return Logic({name: fact["lacking"] for name, fact in raw.get("fact", {}).items()}, tasks)
