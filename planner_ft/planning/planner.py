"""Planning: the Mission Agent's plan, then the skills of each of its tasks."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from planner_ft.planning.agents import Agents
from planner_ft.planning.essentials import asked, missing_defaults, with_defaults, with_essentials
from planner_ft.planning.frame import agents_frame
from planner_ft.planning.limits import with_limits, with_return, without_limits
from planner_ft.planning.locations import (
    Locations,
    OpenPlace,
    charted,
    fitting,
    is_open,
    open_places,
    resolve,
)
from planner_ft.planning.parts import joined, parts_of, with_costs
from planner_ft.planning.passes import gone_to, with_pass
from planner_ft.planning.result import AgentUse, Answer, Doubt, Planned, PlannedTask, doubts
from planner_ft.planning.settings import DEFAULT_CANDIDATE, PlanSettings, choose_agents
from planner_ft.planning.shapes import with_shape
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import nearest_folder, writing
from planner_ft.support.geodesy import Origin
from planner_ft.support.manifest import build_manifest
from planner_ft.support.terminal import Report, silent
from planner_ft.vocabulary import Vocabulary, load_vocabulary


@dataclass(frozen=True)
class TasksKnown:
    """The Mission Agent's tasks, without skills; those at an open place say what they wait for."""

    tasks: tuple[PlannedTask, ...]


@dataclass(frozen=True)
class SkillsKnown:
    """The Task Agent has answered for the task of this number (from 1)."""

    number: int
    answer: Answer


OnEvent = Callable[[TasksKnown | SkillsKnown], None]
"""Called while a command is planned, as soon as something of the plan is known."""


Lost = Callable[[str, Mapping[str, Any], Vocabulary], int]
"""How much of a command a mission plan has lost (planner_ft.document.losses)."""


def unwatched(_event: TasksKnown | SkillsKnown) -> None:
    """Nobody watches."""


class Planner:
    """Plans commands: `Planner.load().plan("Find the red buoy and come home.")`.

    In a `with` block the memory is given back at its end.
    """

    def __init__(
        self, settings: PlanSettings, progress: Report = silent, lost: Lost | None = None
    ) -> None:
        """Checks the settings and loads nothing yet. With `lost`, a long command of which the plan
        has lost something is planned in parts, and the plan that has lost less is taken. Raises
        PlannerError.
        """
        self.settings, self._lost = settings, lost
        self.vocabulary = load_vocabulary(settings.vocabulary)
        agents = choose_agents(settings, self.vocabulary)
        self.agents = Agents(agents, self.vocabulary, settings.device, progress)
        self._progress = progress

    @classmethod
    def load(
        cls,
        candidate: str = DEFAULT_CANDIDATE,
        *,
        progress: Report = silent,
        lost: Lost | None = None,
        **settings: Any,
    ) -> Planner:
        """A planner of PlanSettings with the Mission Agent's base loaded. Raises PlannerError."""
        planner = cls(PlanSettings(candidate, **settings), progress, lost)
        planner.agents.load("mission")
        return planner

    def plan(
        self,
        command: str,
        locations: Locations | None = None,
        on_event: OnEvent = unwatched,
        origin: Origin | None = None,
        chart: Locations | None = None,
    ) -> Planned:
        """The plan of a command; `locations` are positions (metres east, north) of open places.

        Geographic positions of the command are read with the `origin`, where [0, 0] lies; without
        one they are open places. `chart` has positions of places that may be open, and of
        structures to keep clear of. `on_event` gets the tasks, then the skills of each; an error in
        it ends planning. Raises PlannerError for a bad command; a location that fits no open place
        is a note and invalid answers are part of the result.
        """
        check_command(command)
        frame = agents_frame(command, origin)
        mission = self._mission(frame.spoken)
        unsure: list[Doubt] = []
        tasks: tuple[PlannedTask, ...] = ()
        places: list[OpenPlace] = []
        located = {}
        if mission.plan is not None:
            unsure = doubts(frame.spoken, mission.plan, mission.judged, self.vocabulary)
            told = frame.restored(mission.plan, self.vocabulary)
            plan = self._limited(told, frame.spoken)
            known, unused = fitting(plan, locations or {}, self.vocabulary)
            mission = replace(mission, plan=plan, notes=(*mission.notes, *unused))
            filled = resolve(plan, known, self.vocabulary)
            found = charted(chart or {}, open_places(filled, self.vocabulary))
            # A place that the plan does not need is a point of the chart all the same.
            unknown = self.vocabulary.unresolved
            others = ((name, at) for name, at in (locations or {}).items() if name not in known)
            chart = {name: at for name, at in others if tuple(at) != unknown} | {**(chart or {})}
            filled = resolve(filled, found, self.vocabulary)
            located = {name: list(at) for name, at in {**known, **found}.items()}
            places = open_places(filled, self.vocabulary)
            tasks = self._tasks(filled, places, on_event)
        answers = {"mission": [mission], "task": [task.answer for task in tasks if task.answer]}
        agents, manifest = self.agents, self._manifest()
        use: dict[str, AgentUse] = {of: agents.use(of, answers[of]) for of in agents.agents}
        what = command, mission, tasks, tuple(places), located
        measured = use, agents.peak_memory(), manifest
        return Planned(*what, *measured, origin, dict(chart or {}), tuple(unsure))

    def skills(self, task: Mapping[str, Any], before: Sequence[Mapping[str, Any]] = ()) -> Answer:
        """The Task Agent's answer, valid or not, for `title`, `parameters` and `task_prompt`.

        The vehicle's defaults and essential skills are part of it; a task whose prompt says no
        place begins where the tasks `before` it have gone to. Raises PlannerError without a
        Task Agent, for a task whose place is open, and for one that lacks what must be asked.
        """
        if "task" not in self.agents.agents:
            problem = "there is no Task Agent with --mission-only; leave the flag out"
            raise PlannerError(f"{task['title']}: {problem}")
        if task.get("waits_for") or is_open(task, self.vocabulary):
            problem = "its place is open, and skills to nowhere would be worth nothing"
            raise PlannerError(f"{task['title']}: {problem}; say where it is first")
        if names := asked(task, self.vocabulary):
            problem = f"{' and '.join(names)} must be known before its skills are planned"
            raise PlannerError(f"{task['title']}: {problem}; give it as a parameter")
        self.agents.load("task")
        return self._performed(task, self.agents.ask("task", self._record(task)), before)

    def _record(self, task: Mapping[str, Any]) -> dict[str, Any]:
        """What the Task Agent is asked for a task."""
        filled = with_defaults(task, self.vocabulary)
        prompt = without_limits(task["task_prompt"], self.vocabulary)
        return {"task": task["title"], "parameters": filled["parameters"], "prompt": prompt}

    def _performed(
        self, task: Mapping[str, Any], answer: Answer, before: Sequence[Mapping[str, Any]]
    ) -> Answer:
        """The Task Agent's answer with what the vehicle adds to it."""
        if answer.plan is None:
            return answer
        filled = with_defaults(task, self.vocabulary)
        steps, ends = with_pass(
            filled, answer.plan["skill_sequence"], self.vocabulary, gone_to(before, self.vocabulary)
        )
        steps, shaped = with_shape(filled, steps, self.vocabulary)
        steps, added = with_essentials(filled, steps, self.vocabulary)
        defaults = missing_defaults(task, self.vocabulary)
        plan = {"skill_sequence": steps}
        return replace(answer, plan=plan, defaults=defaults, added=(*ends, *shaped, *added))

    def __enter__(self) -> Planner:
        return self

    def __exit__(self, *_error: object) -> None:
        self.agents.release()

    def _mission(self, command: str) -> Answer:
        self.agents.load("mission")
        self._progress("Mission Agent", 0, 0)
        answer = self.agents.ask("mission", {"prompt": command})
        if not answer.tokens:
            name = self.agents.agents["mission"].candidate.name
            way = "shorten the command, or take another candidate"
            raise PlannerError(f"{name}: {'; '.join(answer.problems)}; {way}")
        return self._in_parts(command, answer)

    def _in_parts(self, command: str, whole: Answer) -> Answer:
        """The plan of the command's parts where it has lost less than that of the whole, and has
        no more tasks beyond it than what was lost can be: a way and what is done at its end.
        """
        parts = parts_of(command) if self._lost else []
        if self._lost is None or whole.plan is None or len(parts) < 2:
            return whole
        lost = self._lost(command, self._limited(whole.plan, command), self.vocabulary)
        if not lost:
            return whole
        made = dict(self.agents.ask_each("mission", [{"prompt": part} for part in parts]))
        answers = [made[at] for at in range(len(parts))]
        if not all(answer.plan for answer in answers):
            return with_costs(whole, answers)
        together = joined(answers, self.vocabulary)
        other = self._limited(together.plan or {}, command)
        found = lost - self._lost(command, other, self.vocabulary)
        more = len(other["tasks"]) - len(whole.plan["tasks"])
        if found > 0 and more <= 2 * found:
            return with_costs(together, [whole])
        return with_costs(whole, answers)

    def _limited(self, plan: dict[str, Any], spoken: str) -> dict[str, Any]:
        """The plan with its limits in the task prompts that they hold for."""
        stated = with_limits(plan, self.vocabulary, spoken)
        return with_limits(with_return(stated, self.vocabulary), self.vocabulary, spoken)

    def _tasks(
        self, plan: dict[str, Any], places: list[OpenPlace], on_event: OnEvent
    ) -> tuple[PlannedTask, ...]:
        """Every task with the vehicle's defaults, and its skills where they can be planned now."""
        waiting = {number: place.name for place in places for number in place.tasks}
        planned = [
            PlannedTask(
                **with_defaults(entry, self.vocabulary),
                waits_for=waiting.get(number),
                defaults=missing_defaults(entry, self.vocabulary),
            )
            for number, entry in enumerate(plan["tasks"], start=1)
        ]
        on_event(TasksKnown(tuple(planned)))
        told = [one.waits_for is None and not asked(vars(one), self.vocabulary) for one in planned]
        ready = [at for at, known in enumerate(told) if known and "task" in self.agents.agents]
        if not ready:
            return tuple(planned)
        self.agents.load("task")
        self._progress("Task Agent", 0, len(ready))
        records = [self._record(vars(planned[at])) for at in ready]
        for done, (place, made) in enumerate(self.agents.ask_each("task", records), start=1):
            at = ready[place]
            answer = self._performed(vars(planned[at]), made, plan["tasks"][:at])
            planned[at] = replace(planned[at], answer=answer)
            on_event(SkillsKnown(at + 1, answer))
            self._progress("Task Agent", done, len(ready))
        return tuple(planned)

    def _manifest(self) -> dict[str, Any]:
        """What the plan depended on."""
        named = {"name": self.vocabulary.name, "sha256": self.vocabulary.sha256}
        made: dict[str, Any] = {"configuration": {"decoding": "greedy", "vocabulary": named}}
        agents = {level: agent.record() for level, agent in self.agents.agents.items()}
        device = str(self.agents.device)
        return build_manifest("plan", seed=None, device=device, agents=agents, **made)


def check_command(command: str) -> str:
    """The command itself. Raises PlannerError when it is empty or no Unicode text."""
    if not command.strip():
        example = 'plannerft plan "Find the red buoy and come home."'
        raise PlannerError(f"the command is empty; say what is to be done, such as {example}")
    try:
        command.encode()
    except UnicodeEncodeError as error:
        where = f"(character {error.start + 1}); write it as UTF-8"
        raise PlannerError(f"the command is not UTF-8 text {where}") from None
    return command


def read_command(stream: Any) -> str:
    """The command on a stream of bytes. Raises PlannerError when it is not UTF-8."""
    data: bytes = stream.read()
    try:
        return data.decode("utf-8-sig").strip()
    except UnicodeDecodeError as error:
        where = f"(byte {error.start}); write it as UTF-8"
        raise PlannerError(f"the command on standard input is not UTF-8 text {where}") from None


def new_file(path: Path, *, overwrite: bool) -> Path:
    """The path itself. Raises PlannerError for an existing or impossible file."""
    if path.is_dir():
        raise PlannerError(f"--out {path}: is a folder; give a file")
    if path.exists() and not overwrite:
        raise PlannerError(f"--out {path}: exists; give --overwrite to replace it, or another file")
    with writing(f"--out {path}", "choose another folder"):
        tempfile.TemporaryFile(dir=nearest_folder(path.parent)).close()
    return path
