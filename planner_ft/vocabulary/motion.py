"""What skills do to the vehicle, and the circles that tasks keep: the companion file
NAME.motion.toml of a definition.

Drawing, measuring and exporting a plan read it. It changes no prompt, no schema and no grammar, and
so it is no part of the vocabulary's digest, by which adapters know what they were trained on.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal, get_args

if TYPE_CHECKING:
    from planner_ft.vocabulary.definition import Parameter, Skill, Task

MOTION = ".motion.toml"
MotionKind = Literal[
    "go", "hold", "turn-to", "turn-by", "arc", "drift", "wait", "boundary", "clearance", "heading"
]
KINDS: tuple[MotionKind, ...] = get_args(MotionKind)

ROLES_OF: dict[MotionKind, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "go": (("x", "y"), ("heading", "altitude")),
    "hold": ((), ("time", "radius")),
    "turn-to": (("heading",), ()),
    "turn-by": (("angle",), ()),
    "arc": (("radius", "angle"), ()),
    "drift": ((), ("time",)),
    "wait": ((), ("time",)),
    "boundary": (("polygon",), ()),
    "clearance": ((), ("distance",)),
    "heading": ((), ()),
}
"""Per kind of motion the roles of parameters that it must have, and those that it may have."""
FILTER_KINDS = ("boundary", "clearance", "heading")
STANDOFF = ("center", "radius", "arc")


@dataclass(frozen=True)
class Motion:
    """What a skill does to the vehicle, and which of its parameters plays which role ("time" ->
    "time", "angle" -> "delta_yaw").

    Lengths are metres, times seconds, angles degrees; headings and arcs clockwise. A hold without a
    time lasts until a stop condition.
    """

    kind: MotionKind
    parameters: Mapping[str, str] = field(default_factory=dict)

    def value(self, role: str, parameters: Mapping[str, Any]) -> Any:
        """The value that a skill's parameters give to a role; None where they do not say it."""
        return parameters.get(self.parameters.get(role, ""))


@dataclass(frozen=True)
class Standoff:
    """The names of the task parameters that say the circle which a task keeps around its target,
    and the angle of it.
    """

    center: str
    radius: str
    arc: str | None = None


@dataclass(frozen=True)
class Motions:
    """The motion of skills by name and the stand-off of tasks by title."""

    skills: Mapping[str, Motion] = field(default_factory=dict)
    standoffs: Mapping[str, Standoff] = field(default_factory=dict)

    def of(self, skill: str) -> Motion | None:
        """What a skill does to the vehicle; None for a skill that does nothing to it, or that
        nothing is declared for.
        """
        return self.skills.get(skill)

    def standoff(self, title: str) -> Standoff | None:
        """The circle that a task keeps; None for a task that keeps none."""
        return self.standoffs.get(title)


def build_motions(raw: Mapping[str, Any]) -> Motions:
    """The motions of a parsed file that `motion_problems` finds nothing wrong with."""
    skills = {
        name: Motion(
            entry["motion"], {role: key for role, key in entry.items() if role != "motion"}
        )
        for name, entry in raw.get("skill", {}).items()
    }
    return Motions(
        skills, {title: Standoff(**entry) for title, entry in raw.get("task", {}).items()}
    )


def motion_problems(
    raw: Mapping[str, Any], tasks: Mapping[str, Task], skills: Mapping[str, Skill]
) -> Iterator[str]:
    """Everything wrong with a parsed file, for a vocabulary with these tasks by title and skills by
    name.
    """
    yield from (
        f"the motion file has an unknown key {key!r}" for key in raw if key not in ("skill", "task")
    )
    for key in ("skill", "task"):
        if not isinstance(raw.get(key, {}), dict) or not all(
            isinstance(entry, dict) for entry in raw.get(key, {}).values()
        ):
            yield f"the motion file needs tables [{key}.NAME]"
            return
    for name, entry in raw.get("skill", {}).items():
        yield from (
            f"the motion file: skill {name}: {problem}"
            for problem in _skill_problems(entry, skills.get(name))
        )
    for title, entry in raw.get("task", {}).items():
        yield from (
            f"the motion file: task {title}: {problem}"
            for problem in _standoff_problems(entry, tasks.get(title))
        )


def _skill_problems(entry: Mapping[str, Any], skill: Skill | None) -> Iterator[str]:
    if skill is None:
        yield "it is not defined"
        return
    kind = next((known for known in KINDS if known == entry.get("motion")), None)
    if kind is None:
        yield f"motion = {entry.get('motion')!r} must be one of {', '.join(KINDS)}"
        return
    if (skill.role == "filter") != (kind in FILTER_KINDS):
        yield f"motion = {kind!r} does not fit the role {skill.role}"
    needed, allowed = ROLES_OF[kind]
    yield from (
        f"{kind} needs {role} = the name of a parameter" for role in needed if role not in entry
    )
    for role, name in entry.items():
        if role == "motion":
            continue
        if role not in (*needed, *allowed):
            yield f"unknown key {role!r}"
            continue
        wanted = "polygon" if role == "polygon" else "number"
        yield from _name_problems(role, name, skill.by_name, wanted)


def _standoff_problems(entry: Mapping[str, Any], task: Task | None) -> Iterator[str]:
    if task is None:
        yield "it is not defined"
        return
    yield from (
        f"a stand-off needs {role} = the name of a parameter"
        for role in ("center", "radius")
        if role not in entry
    )
    for role, name in entry.items():
        if role not in STANDOFF:
            yield f"unknown key {role!r}"
            continue
        yield from _name_problems(
            role, name, task.by_name, "position" if role == "center" else "number"
        )


def _name_problems(
    role: str, name: Any, parameters: Mapping[str, Parameter], wanted: str
) -> Iterator[str]:
    parameter = parameters.get(name) if isinstance(name, str) else None
    if parameter is None or parameter.type != wanted:
        yield f"{role} = {name!r} must name a parameter of type {wanted}"
