"""What fills the slots of a plan: guidance and waypoints, or learnt skills.

A slot is exchangeable: parameters, perception, filters, end and failure modes stay what they are.
`learnt = "..."` in [skill.NAME] and [task.TITLE] of NAME.simulation.toml names the implementation.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from planner_ft.simulation.asked import reach
from planner_ft.simulation.executor import Stage
from planner_ft.simulation.fast import Floats
from planner_ft.simulation.skill import Job
from planner_ft.simulation.world import PILE
from planner_ft.support.errors import PlannerError

LEARNT, GUIDANCE, WAYPOINTS = "learnt", "guidance", "waypoints"
CLEAR = 0.5  # share of a learnt stand-off that filters without a distance of their own keep clear


@dataclass(frozen=True)
class Slots:
    """`goto`: guidance, learnt, or the folder of a policy; `survey`: waypoints, learnt, or the
    folder of a policy. `outlines` are corners (n, 2) about their places of structures by name.
    """

    goto: str = GUIDANCE
    survey: str = WAYPOINTS
    outlines: Mapping[str, Floats] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Raise PlannerError for a word that is neither known nor a folder."""
        for flag, value, usual, _table in self._given():
            if value not in (usual, LEARNT) and not Path(value).is_dir():
                known = f"{usual}, {LEARNT}, or the folder of a trained policy"
                raise PlannerError(f"{flag} {value}: must be {known}")

    def check(self, raw: Mapping[str, Any], vocabulary: str) -> None:
        """Raise PlannerError for a vehicle without such skills."""
        for flag, value, usual, table in self._given():
            if value != usual and not any(LEARNT in one for one in raw.get(table, {}).values()):
                problem = f"{vocabulary} has no learnt skill for it; leave it out"
                raise PlannerError(f"{flag} {value}: {problem}")

    def _given(self) -> Iterator[tuple[str, str, str, str]]:
        """The flag, value and usual value of each slot, and the table of what is learnt."""
        yield "--goto", self.goto, GUIDANCE, "skill"
        yield "--survey", self.survey, WAYPOINTS, "task"

    def settings(self, own: Mapping[str, Any], kind: str | None) -> Mapping[str, Any]:
        """The settings of a skill with a motion of this kind, with what fills its slot."""
        if self.goto == GUIDANCE or LEARNT not in own:
            return own
        folder = {"policy": self.goto} if kind == "go" and self.goto != LEARNT else {}
        return {**own, "implementation": own[LEARNT], **folder}

    def standoff(self, name: str | None, radius: float) -> float:
        """Metres from a structure's surface for a radius about its place."""
        outline = self.outlines.get(name or "")
        return radius - (PILE if outline is None else reach(outline))

    def surveyed(self, stages: Sequence[Stage], job: Job) -> list[Stage]:
        """The stages of a task with all but its approach replaced by one learnt survey."""
        approach, rest = stages[0], stages[1:] or stages
        clear = CLEAR * float(job.settings["standoff"])
        filters = [replace(one, margin=min(one.margin, clear)) for one in _all(stages, "filters")]
        modes = dict.fromkeys(mode for one in stages for mode in one.failures)
        number = rest[0].step
        survey = Stage(
            job.task,
            number,
            replace(job, step=number),
            tuple(replace(one, step=number) for one in filters),
            tuple(replace(one, step=number) for one in _all(stages, "sensors")),
            sum(one.patience for one in rest),
            tuple(modes),
        )
        return [approach, survey]


def _all(stages: Sequence[Stage], role: str) -> list[Job]:
    """The filters or sensors of all stages, each once."""
    found: dict[str, Job] = {}
    for stage in stages:
        for job in getattr(stage, role):
            found.setdefault(f"{job.skill} {sorted(job.parameters.items())}", job)
    return list(found.values())
