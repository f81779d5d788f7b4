"""The nodes that a behaviour tree of a vocabulary is made of: its skills, its tasks, and five that
every plan needs.

Whoever runs a tree implements them: `TreeNodesModel` in the file lists each with its ports, their
types and what they mean (https://www.behaviortree.dev/docs/learn-the-basics/xml_format).
"""

from __future__ import annotations

import functools
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal
from xml.etree import ElementTree

from planner_ft.exporters.bt_values import PORT_TYPES, RESERVED, plain_name, plain_names
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import Parameter, Skill, Task

BUILT_IN = frozenset(
    [
        "AlwaysFailure",
        "AlwaysSuccess",
        "AsyncFallback",
        "AsyncSequence",
        "Delay",
        "Fallback",
        "ForceFailure",
        "ForceSuccess",
        "IfThenElse",
        "Inverter",
        "KeepRunningUntilFailure",
        "LoopBool",
        "LoopDouble",
        "LoopInt",
        "LoopString",
        "Parallel",
        "ParallelAll",
        "Precondition",
        "ReactiveFallback",
        "ReactiveSequence",
        "Repeat",
        "RetryUntilSuccessful",
        "RunOnce",
        "Script",
        "ScriptCondition",
        "Sequence",
        "SequenceStar",
        "SequenceWithMemory",
        "SetBlackboard",
        "SkipUnlessUpdated",
        "Sleep",
        "SubTree",
        "Switch2",
        "Switch3",
        "Switch4",
        "Switch5",
        "Switch6",
        "Timeout",
        "TryCatch",
        "UnsetBlackboard",
        "WaitValueUpdate",
        "WasEntryUpdated",
        "WhileDoElse",
        "Action",
        "BehaviorTree",
        "Condition",
        "Control",
        "Decorator",
        "Root",
        "root",
    ]
)
"""Names that BehaviorTree.CPP 4.10 registers itself, or reads as something else."""


@dataclass(frozen=True)
class Port:
    """A port: `type` as C++ writes it, "" where any will do."""

    name: str
    type: str
    description: str
    output: bool = False


@dataclass(frozen=True)
class Node:
    """A leaf of a tree. `ports` by what they stand for: a parameter's name, and "output" for what a
    skill gives.
    """

    id: str
    description: str
    ports: Mapping[str, Port] = field(default_factory=dict)
    kind: Literal["Action", "Condition"] = "Action"


def _text(name: str, description: str) -> dict[str, Port]:
    return {name: Port(name, "std::string", description)}


STOP = Node(
    "StopCondition",
    "SUCCESS when what the text says holds, else FAILURE; it is asked after the step's movement"
    " began",
    _text("text", "when the step ends"),
    "Condition",
)
HANDLE = Node(
    "HandleFailure",
    "SUCCESS when the step failed in this way and the vehicle recovered, so that the mission goes"
    " on; else FAILURE",
    _text("mode", "the way to fail"),
)
REPORT = Node(
    "ReportOutput",
    "reports what the step was to give and no skill of it gives by itself",
    _text("text", "what is reported"),
)
LOCATE = Node(
    "LocatePlace",
    "writes the position of a place that the search before it found; where none was, it asks;"
    " FAILURE when the place stays unknown",
    {
        **_text("place", "name of the place"),
        "position": Port("position", "", "local metres, x;y", output=True),
    },
)
OWN = (STOP, HANDLE, REPORT, LOCATE)


@dataclass(frozen=True)
class Nodes:
    """A node per skill, by its name, and per task, by its title: the latter plans the task's skills
    on board and runs them.
    """

    skills: Mapping[str, Node]
    tasks: Mapping[str, Node]

    @property
    def all(self) -> tuple[Node, ...]:
        """Every node that whoever runs a tree implements."""
        return (*self.skills.values(), *self.tasks.values(), *OWN)


@functools.lru_cache(maxsize=16)
def nodes_of(vocabulary: Vocabulary) -> Nodes:
    """The nodes of a vocabulary."""
    taken = {*BUILT_IN, *(node.id for node in OWN)}
    skills = plain_names([skill.name for skill in vocabulary.skills], taken)
    tasks = plain_names(
        [f"Plan{task.title}" for task in vocabulary.tasks], {*taken, *skills.values()}
    )
    return Nodes(
        {
            skill.name: Node(skills[skill.name], skill.description, _ports(skill))
            for skill in vocabulary.skills
        },
        {
            task.title: Node(
                tasks[f"Plan{task.title}"],
                f"plans the skills of this task on board and runs them: {task.description}",
                _ports(task),
            )
            for task in vocabulary.tasks
        },
    )


def model_element(nodes: Nodes) -> ElementTree.Element:
    """The `TreeNodesModel` of a file."""
    model = ElementTree.Element("TreeNodesModel")
    for node in nodes.all:
        element = ElementTree.SubElement(model, node.kind, ID=node.id)
        for port in node.ports.values():
            attributes = {"name": port.name, **({"type": port.type} if port.type else {})}
            ElementTree.SubElement(
                element, "output_port" if port.output else "input_port", attributes
            ).text = port.description
        ElementTree.SubElement(element, "description").text = node.description
    return model


def _ports(owner: Skill | Task) -> dict[str, Port]:
    names = plain_names([*owner.by_name, "task_prompt"], RESERVED)
    ports = {
        parameter.name: Port(
            names[parameter.name], PORT_TYPES[parameter.type], _described(parameter)
        )
        for parameter in owner.parameters
    }
    if isinstance(owner, Task):
        return {
            **ports,
            "task_prompt": Port(
                names["task_prompt"], "std::string", "the whole intent of the task"
            ),
        }
    if owner.output:
        # An observation is given, and an observation comes out: two ports.
        taken = {*RESERVED, *names.values()}
        name = plain_name(
            f"{owner.output}_out" if plain_name(owner.output) in taken else owner.output, taken
        )
        ports["output"] = Port(name, "", f"what the skill gives: {owner.output}", output=True)
    return ports


def _described(parameter: Parameter) -> str:
    layout = {"position": "x;y", "polygon": "x;y;x;y ...", "texts": "entries set apart by ;"}.get(
        parameter.type
    )
    return ", ".join(part for part in (parameter.description, parameter.unit, layout) if part)
