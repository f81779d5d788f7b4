"""What planning gives: the mission plan, the skills of each task, and what they cost."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from planner_ft.confidence.calibration import NOT_JUDGED, Judgement
from planner_ft.planning.doubts import Doubt
from planner_ft.planning.locations import OpenPlace, Position
from planner_ft.support.geodesy import Origin


@dataclass(frozen=True)
class Answer:
    """One answer of an agent and its cost.

    `plan` is None unless the text is a strictly valid plan (see `problems`); `cut`: it met the
    token limit; `seconds` from prompt ids to the complete answer. `judged` says how sure the agent
    is of a plan, by the paths of its own answer. `defaults` and `added` are what
    the vehicle added to the task and to its steps (planner_ft.planning.essentials).
    """

    text: str
    plan: dict[str, Any] | None
    problems: tuple[str, ...]
    notes: tuple[str, ...]
    prompt_tokens: int
    tokens: int
    forward_passes: int
    seconds: float
    cut: bool = False
    defaults: dict[str, Any] = field(default_factory=dict)
    added: tuple[dict[str, Any], ...] = ()
    judged: Judgement = NOT_JUDGED


@dataclass(frozen=True)
class AgentUse:
    """The work of one agent; `seconds` are without `load_seconds` (0: the other agent's base)."""

    candidate: str
    configuration: str
    adapter: str | None
    load_seconds: float
    queries: int
    prompt_tokens: int
    tokens: int
    forward_passes: int
    seconds: float


@dataclass(frozen=True)
class PlannedTask:
    """A task with its skills; `answer` is None when not asked, as while `waits_for` is open.

    `defaults` are the parameters that are the vehicle's.
    """

    title: str
    parameters: dict[str, Any]
    task_prompt: str
    answer: Answer | None = None
    waits_for: str | None = None
    defaults: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Planned:
    """A command with its plan: the mission answer as it was, tasks with `located` places filled in.

    `origin` is where [0, 0] lies, `chart` has structures by name, `doubts` are the choices that the
    Mission Agent is least sure of. `peak_memory` is in bytes, of the process or the GPU.
    """

    command: str
    mission: Answer
    tasks: tuple[PlannedTask, ...]
    open_places: tuple[OpenPlace, ...]
    located: dict[str, list[float]] = field(default_factory=dict)
    usage: dict[str, AgentUse] = field(default_factory=dict)
    peak_memory: int = 0
    manifest: dict[str, Any] = field(default_factory=dict)
    origin: Origin | None = None
    chart: dict[str, Position] = field(default_factory=dict)
    doubts: tuple[Doubt, ...] = ()

    @property
    def valid(self) -> bool:
        """Whether every answer parses and is strictly valid."""
        answers = [self.mission, *(task.answer for task in self.tasks if task.answer is not None)]
        return all(answer.plan is not None for answer in answers)
