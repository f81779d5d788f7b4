"""Loading and checking a vocabulary definition file."""

from __future__ import annotations

import functools
import tomllib
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, Literal, get_args

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_text, sha256_text

Role = Literal["navigation", "filter", "perception"]
ParameterType = Literal["position", "polygon", "number", "integer", "text", "id", "texts"]
Arrival = Literal["transit", "self", "none"]
Motion = Literal["goto", "hold", "turn_to", "turn_by", "arc", "drift", "visual", "wait"]

ROLES: tuple[Role, ...] = get_args(Role)
BUNDLED = Path(__file__).parent
DEFAULT = "usv"
PHRASES = ".phrases.toml"


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


@dataclass(frozen=True)
class Task:
    """A task title with its parameters, the movement it stands for and the skills that fit it, by role."""

    title: str
    category: str
    description: str
    arrival: Arrival
    pattern: str
    leaves: bool = False
    parameters: tuple[Parameter, ...] = ()
    require_any: tuple[str, ...] = ()
    skills: dict[Role, tuple[str, ...]] = field(default_factory=dict)

    @functools.cached_property
    def by_name(self) -> dict[str, Parameter]:
        return {parameter.name: parameter for parameter in self.parameters}

    @property
    def position_parameter(self) -> str | None:
        """The parameter that says where the task takes place, if it has one."""
        return next((parameter.name for parameter in self.parameters if parameter.type == "position"), None)


@dataclass(frozen=True)
class Skill:
    """A skill with its parameters, the role it takes in a step and the strings a step with it reports."""

    name: str
    category: str
    role: Role
    description: str
    motion: Motion | None = None
    parameters: tuple[Parameter, ...] = ()
    require_any: tuple[str, ...] = ()
    stop: str | None = None
    failure: str | None = None
    output: str | None = None

    @functools.cached_property
    def by_name(self) -> dict[str, Parameter]:
        return {parameter.name: parameter for parameter in self.parameters}


@dataclass(frozen=True)
class Vocabulary:
    """A vehicle's tasks and skills. Positions are metres in the local frame.

    `phrases` is the content of the companion file NAME.phrases.toml, from which the task sampler words its prompts.
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

    @functools.cached_property
    def task(self) -> dict[str, Task]:
        """Tasks by title."""
        return {task.title: task for task in self.tasks}

    @functools.cached_property
    def skill(self) -> dict[str, Skill]:
        """Skills by name."""
        return {skill.name: skill for skill in self.skills}

    def skills_in_role(self, role: Role) -> tuple[Skill, ...]:
        """Skills that can stand in `role`, in the order of the definition."""
        return tuple(skill for skill in self.skills if skill.role == role)


def bundled_vocabularies() -> list[str]:
    """Names of the definitions that ship with the package."""
    return sorted(path.stem for path in BUNDLED.glob("*.toml") if not path.name.endswith(PHRASES))


@functools.lru_cache(maxsize=16)
def load_vocabulary(source: str | Path = DEFAULT) -> Vocabulary:
    """Load a definition by the name of a bundled one ("usv") or by path.

    Raises PlannerError that lists everything wrong with the file.
    """
    bundled = BUNDLED / f"{source}.toml"
    path = bundled if str(source).isidentifier() and bundled.is_file() else Path(source)
    if not path.is_file():
        raise PlannerError(f"--vocabulary {source}: no such file, and no bundled vocabulary of that name ({', '.join(bundled_vocabularies())})")
    text = read_text(path)
    raw = _parse(path, text)
    companion = path.with_name(path.name.removesuffix(".toml") + PHRASES)
    phrases = _parse(companion, read_text(companion)) if companion.is_file() else {}
    problems: list[str] = []
    vocabulary = _build(raw, phrases, str(source), sha256_text(text), problems)
    if not problems and vocabulary is not None:
        _check_references(vocabulary, problems)
    if problems or vocabulary is None:
        raise PlannerError(f"{path}: " + "; ".join(problems))
    return vocabulary


def _parse(path: Path, text: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise PlannerError(f"{path}: not TOML: {error}") from None


def _build(raw: dict[str, Any], phrases: dict[str, Any], source: str, sha256: str, problems: list[str]) -> Vocabulary | None:
    vehicle = raw.get("vehicle", {})
    missing = [key for key in ("name", "title", "frame", "home", "unresolved", "transit", "locate") if key not in vehicle]
    if missing:
        problems.append(f"[vehicle] lacks {', '.join(missing)}")
        return None
    tasks = [_entry(Task, entry, f"task {entry.get('title', index + 1)}", problems) for index, entry in enumerate(raw.get("task", []))]
    skills = [_entry(Skill, entry, f"skill {entry.get('name', index + 1)}", problems) for index, entry in enumerate(raw.get("skill", []))]
    if not tasks or not skills:
        problems.append("at least one [[task]] and one [[skill]] are needed")
    if problems:
        return None
    return Vocabulary(
        name=vehicle["name"], title=vehicle["title"], frame=vehicle["frame"],
        home=tuple(vehicle["home"]), unresolved=tuple(vehicle["unresolved"]),
        transit=vehicle["transit"], locate=vehicle["locate"],
        tasks=tuple(tasks), skills=tuple(skills), source=source, sha256=sha256, phrases=phrases,
    )  # fmt: skip


def _entry(kind: type, entry: dict[str, Any], where: str, problems: list[str]) -> Any:
    values = dict(entry)
    values["parameters"] = tuple(_parameter(item, where, problems) for item in values.get("parameters", []))
    values["require_any"] = tuple(values.get("require_any", ()))
    if "skills" in values:
        values["skills"] = {role: tuple(names) for role, names in values["skills"].items()}
    return _construct(kind, values, where, problems)


def _parameter(entry: dict[str, Any], where: str, problems: list[str]) -> Any:
    where = f"{where}, parameter {entry.get('name', '?')}"
    if entry.get("type") not in get_args(ParameterType):
        problems.append(f"{where}: type {entry.get('type')!r} is none of {', '.join(get_args(ParameterType))}")
    return _construct(Parameter, entry, where, problems)


def _construct(kind: type, values: dict[str, Any], where: str, problems: list[str]) -> Any:
    unknown = sorted(set(values) - {item.name for item in fields(kind)})
    if unknown:
        problems.append(f"{where}: unknown key {', '.join(unknown)}")
        return None
    try:
        return kind(**values)
    except TypeError as error:
        problems.append(f"{where}: {str(error).split('() ')[-1]}")
        return None


def _check_references(vocabulary: Vocabulary, problems: list[str]) -> None:
    for kind, names in (("task", [task.title for task in vocabulary.tasks]), ("skill", [skill.name for skill in vocabulary.skills])):
        problems.extend(f"{kind} {name} is defined twice" for name in sorted({name for name in names if names.count(name) > 1}))
    for key in ("transit", "locate"):
        if getattr(vocabulary, key) not in vocabulary.task:
            problems.append(f"[vehicle] {key} = {getattr(vocabulary, key)!r} is no task")
    for task in vocabulary.tasks:
        if task.arrival not in get_args(Arrival):
            problems.append(f"task {task.title}: arrival {task.arrival!r} is none of {', '.join(get_args(Arrival))}")
        if not task.skills.get("navigation"):
            problems.append(f"task {task.title}: needs at least one navigation skill")
        problems.extend(f"task {task.title}: require_any names {name!r}, which is no parameter" for name in task.require_any if name not in task.by_name)
        for role, fitting in task.skills.items():
            for name in fitting:
                if name not in vocabulary.skill:
                    problems.append(f"task {task.title}: skill {name!r} is not defined")
                elif vocabulary.skill[name].role != role:
                    problems.append(f"task {task.title}: skill {name!r} has the role {vocabulary.skill[name].role}, not {role}")
    problems.extend(f"skill {skill.name}: role {skill.role!r} is none of {', '.join(ROLES)}" for skill in vocabulary.skills if skill.role not in ROLES)
    motions = get_args(Motion)
    odd = [skill for skill in vocabulary.skills if skill.motion not in (None, *motions)]
    problems.extend(f"skill {skill.name}: motion {skill.motion!r} is none of {', '.join(motions)}" for skill in odd)
    for kind, known in (("task", set(vocabulary.task)), ("skill", set(vocabulary.skill))):
        unknown = sorted(set(vocabulary.phrases.get(kind, {})) - known)
        problems.extend(f"the phrase file has phrases for {kind} {name!r}, which is not defined" for name in unknown)
