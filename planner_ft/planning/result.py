"""What planning gives: the mission plan, the skills of each task, and what they cost."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from planner_ft.planning.locations import OpenPlace


@dataclass(frozen=True)
class Answer:
    """One answer of an agent, and what it cost.

    `plan` is None when the text does not parse or is not strictly valid: `problems` says why. `cut`
    is True when the answer met the token limit. `seconds` is the time from prompt ids to the
    complete answer.
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


@dataclass(frozen=True)
class AgentUse:
    """What one agent did in all.

    `load_seconds` is the time to load its base, 0 where the other agent's serves it too; `seconds`
    leaves it out.
    """

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
    """A task of the mission with its skills.

    `answer` is None where the Task Agent was not asked: because the task's place is open, which
    `waits_for` names, or at all.
    """

    title: str
    parameters: dict[str, Any]
    task_prompt: str
    answer: Answer | None = None
    waits_for: str | None = None


@dataclass(frozen=True)
class Planned:
    """A command with everything that was planned for it.

    `mission` is the Mission Agent's answer as it was, `tasks` have the places filled in that were
    given (`located`). `open_places` are those that no position is known for. `peak_memory` is the
    most memory of the whole process, in bytes (of the GPU, where there is one); `manifest` says
    what the plan depended on.
    """

    command: str
    mission: Answer
    tasks: tuple[PlannedTask, ...]
    open_places: tuple[OpenPlace, ...]
    located: dict[str, list[float]] = field(default_factory=dict)
    usage: dict[str, AgentUse] = field(default_factory=dict)
    peak_memory: int = 0
    manifest: dict[str, Any] = field(default_factory=dict)

    @property
    def valid(self) -> bool:
        """Whether every answer parses and is strictly valid."""
        answers = [self.mission, *(task.answer for task in self.tasks if task.answer is not None)]
        return all(answer.plan is not None for answer in answers)

    @property
    def complete(self) -> bool:
        """Whether every task has its skills, so that nothing is left to fill in."""
        return self.valid and all(task.answer is not None for task in self.tasks)
