"""What skills and tasks do: movements and circles (NAME.motion.toml), and what tasks bring about
and need beyond their places (NAME.logic.toml). Both are no part of the digest.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

MOTION = ".motion.toml"
MotionKind = Literal[
    "go", "hold", "turn-to", "turn-by", "arc", "drift", "wait", "boundary", "clearance", "heading"
]


@dataclass(frozen=True)
class Motion:
    """What a skill does to the vehicle, and its parameters by role ("angle" -> "delta_yaw").

    Metres, seconds, degrees clockwise; a hold without a time lasts until a stop condition.
    """

    kind: MotionKind
    parameters: Mapping[str, str] = field(default_factory=dict)

    def value(self, role: str, parameters: Mapping[str, Any]) -> Any:
        """The value that a skill's parameters give to a role; None where they do not say it."""
        return parameters.get(self.parameters.get(role, ""))


@dataclass(frozen=True)
class Standoff:
    """The task parameters that say the circle kept around a target, and the angle of it."""

    center: str
    radius: str
    arc: str | None = None


@dataclass(frozen=True)
class Motions:
    """The motion of skills by name and the stand-off of tasks by title."""

    skills: Mapping[str, Motion] = field(default_factory=dict)
    standoffs: Mapping[str, Standoff] = field(default_factory=dict)

    def of(self, skill: str) -> Motion | None:
        """What a skill does to the vehicle; None for a skill that nothing is declared for."""
        return self.skills.get(skill)

    def standoff(self, title: str) -> Standoff | None:
        """The circle that a task keeps; None for a task that keeps none."""
        return self.standoffs.get(title)


def build_motions(raw: Mapping[str, Any]) -> Motions:
    """The motions of a parsed file without problems (checks.motion_problems)."""
    skills = {}
    for name, entry in raw.get("skill", {}).items():
        roles = {role: key for role, key in entry.items() if role != "motion"}
        skills[name] = Motion(entry["motion"], roles)
    standoffs = {title: Standoff(**entry) for title, entry in raw.get("task", {}).items()}
    return Motions(skills, standoffs)


# ---------------------------------------------------------------- what tasks bring about and need


LOGIC = ".logic.toml"
LISTS = ("gives", "needs", "yields")


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


def build_logic(raw: Mapping[str, Any]) -> Logic:
    """The logic of a parsed file without problems (checks.logic_problems)."""
    tasks = {
        title: TaskLogic(
            **{key: tuple(entry.get(key, ())) for key in LISTS}, sends=entry.get("sends")
        )
        for title, entry in raw.get("task", {}).items()
    }
    return Logic({name: fact["lacking"] for name, fact in raw.get("fact", {}).items()}, tasks)
