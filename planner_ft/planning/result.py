"""What planning gives: the mission plan, the skills of each task, what they cost, and questions."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from planner_ft.confidence.calibration import NOT_JUDGED, SURE, Judgement
from planner_ft.confidence.parts import Path
from planner_ft.facts import read
from planner_ft.planning.locations import OpenPlace, Position
from planner_ft.support.files import compact_json
from planner_ft.support.geodesy import Origin
from planner_ft.vocabulary import Parameter, Vocabulary
from planner_ft.vocabulary.plans import canonical_value, task_problems, value_problem

MOST, MOST_OTHERS = 3, 3
"""Questions of a plan, and alternatives of a question."""
Plan = Mapping[str, Any]


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
class Doubt:
    """A choice that the model was not sure of: the title (`name` None) or a parameter of a task,
    counted from 0, what it chose, and `others` that it might have chosen, the likeliest first.
    """

    task: int
    name: str | None
    value: Any
    others: tuple[Any, ...]


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


# ---------------------------------------------------------------- questions instead of guesses

# The least sure choices of a mission plan, with what the model might have chosen instead: what it
# began to write otherwise is completed to a task of the vocabulary, or to a value that the command
# states or the plan has elsewhere. Nothing is invented, and no pass is needed.


def doubts(command: str, plan: Plan, judged: Judgement, vocabulary: Vocabulary) -> list[Doubt]:
    """The least sure choices of a mission plan that have alternatives, the least sure first."""
    unsure = [path for path, held in judged.parts.items() if path in judged.others and held < SURE]
    unsure.sort(key=lambda path: judged.parts[path])
    found = (_doubt(path, command, plan, judged, vocabulary) for path in unsure)
    return [one for one in found if one.others][:MOST]


def _doubt(
    path: Path, command: str, plan: Plan, judged: Judgement, vocabulary: Vocabulary
) -> Doubt:
    at, name = int(path[1]), None if path[2] == "title" else str(path[-1])
    task = plan["tasks"][at]
    value = task["title"] if name is None else task["parameters"][name]
    if name is None:
        titles = vocabulary.task
        known: list[Any] = [title for title in titles if renamed(task, title, vocabulary)]
    else:
        parameter = vocabulary.task[task["title"]].by_name[name]
        known = _values(parameter, command, plan, vocabulary)
    written = {compact_json(one): one for one in known if one != value}
    begun = (start for start, _probability in judged.others[path])
    others = dict.fromkeys(text for start in begun for text in written if _begins(text, start))
    return Doubt(at, name, value, tuple(written[text] for text in others)[:MOST_OTHERS])


def _begins(written: str, begun: str) -> bool:
    """Whether a value is what was begun, or what was begun goes on behind it."""
    return written.startswith(begun) or (begun.startswith(written) and begun[len(written)] in ',}"')


def renamed(task: Plan, title: str, vocabulary: Vocabulary) -> dict[str, Any] | None:
    """The parameters of a task under another title, with its place; None where it needs more."""
    old, new = vocabulary.task[task["title"]], vocabulary.task[title]
    given = {key: value for key, value in task["parameters"].items() if key in new.by_name}
    place = task["parameters"].get(old.position_parameter or "")
    if new.position_parameter and place is not None:
        given.setdefault(new.position_parameter, place)
    made = {"title": title, "parameters": given, "task_prompt": task["task_prompt"]}
    return None if task_problems(made, vocabulary) else given


def _values(parameter: Parameter, command: str, plan: Plan, vocabulary: Vocabulary) -> list[Any]:
    """Values that a parameter can have and that the command states or the plan has elsewhere."""
    facts = read(command)
    found: list[Any] = [
        value
        for task in plan["tasks"]
        for name, value in task["parameters"].items()
        if vocabulary.task[task["title"]].by_name[name].type == parameter.type
    ]
    if parameter.type in ("number", "integer"):
        found = [number.value for number in facts.numbers(parameter.unit)]
    elif parameter.type == "position":
        own = [list(vocabulary.home), list(vocabulary.unresolved)]
        found = [*([place.x, place.y] for place in facts.positions), *found, *own]
    canonical = map(canonical_value, found)
    return [value for value in canonical if value_problem(value, parameter) is None]
