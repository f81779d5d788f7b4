"""The nodes of behaviour trees, and names and values as BehaviorTree.CPP 4 reads them.

A vocabulary's nodes are its skills, its tasks, and four that every plan needs. Whoever runs a tree
implements them: `TreeNodesModel` in the file lists each with its ports. Sources: the library's
rules for names (https://github.com/BehaviorTree/BehaviorTree.CPP, docs/name_validation_rules.md)
and for lists in ports, whose entries are set apart by ";"
(https://www.behaviortree.dev/docs/tutorial-basics/tutorial_03_generic_ports).
"""

import functools
import json
import re
import unicodedata
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from decimal import Decimal
from typing import Any
from xml.etree import ElementTree

from planner_ft.exporters.formats import TABLES
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import Skill, Task

TABLE: dict[str, Any] = TABLES["bt"]
RESERVED = frozenset({"name", "ID"})
"""Attributes that mean something to the library; others that it reserves begin with "_"."""
UNREADABLE = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\ufffe\uffff\ud800-\udfff]")


@dataclass(frozen=True)
class Port:
    """A port: `type` as C++ writes it, "" where any will do."""

    name: str
    type: str
    description: str
    tag: str = "input_port"


@dataclass(frozen=True)
class Node:
    """A leaf of a tree. `ports` by a parameter's name, and "output" for the result of a skill."""

    id: str
    description: str
    ports: Mapping[str, Port]
    kind: str = "Action"


FIXED = {
    name: Node(
        name,
        entry["description"],
        {key: Port(key, *port) for key, port in entry["ports"].items()},
        entry.get("kind", "Action"),
    )
    for name, entry in TABLE["nodes"].items()
}
"""The nodes that every plan needs: StopCondition, HandleFailure, ReportOutput, LocatePlace."""


class Nodes:
    """A node per skill by name, and per task by title, which plans and runs the task's skills;
    `all` that whoever runs a tree implements.
    """

    def __init__(self, vocabulary: Vocabulary) -> None:
        taken = {*TABLE["built_in"].split(), *FIXED}
        ids = plain_names([skill.name for skill in vocabulary.skills], taken)
        self.skills = {
            one.name: Node(ids[one.name], one.description, _ports(one)) for one in vocabulary.skills
        }
        taken |= set(ids.values())
        ids = plain_names([f"Plan{task.title}" for task in vocabulary.tasks], taken)
        self.tasks = {
            one.title: Node(ids[f"Plan{one.title}"], TABLE["plan"] + one.description, _ports(one))
            for one in vocabulary.tasks
        }
        self.all = (*self.skills.values(), *self.tasks.values(), *FIXED.values())


nodes_of = functools.lru_cache(maxsize=16)(Nodes)


def model_element(nodes: Nodes) -> ElementTree.Element:
    """The `TreeNodesModel` of a file."""
    model = ElementTree.Element("TreeNodesModel")
    for node in nodes.all:
        element = ElementTree.SubElement(model, node.kind, ID=node.id)
        for port in node.ports.values():
            attributes = {"name": port.name, **({"type": port.type} if port.type else {})}
            ElementTree.SubElement(element, port.tag, attributes).text = port.description
        ElementTree.SubElement(element, "description").text = node.description
    return model


def _ports(owner: Skill | Task) -> dict[str, Port]:
    names = plain_names([*owner.by_name, "task_prompt"], RESERVED)
    ports = {}
    for one in owner.parameters:
        parts = (one.description, one.unit, TABLE["layouts"].get(one.type))
        words = ", ".join(part for part in parts if part)
        ports[one.name] = Port(names[one.name], TABLE["port_types"][one.type], words)
    if isinstance(owner, Task):
        prompt = Port(names["task_prompt"], "std::string", "the whole intent of the task")
        return {**ports, "task_prompt": prompt}
    if owner.output:
        # An observation is given, and an observation comes out: two ports.
        taken = {*RESERVED, *names.values()}
        name = owner.output + ("_out" if plain_name(owner.output) in taken else "")
        words = f"what the skill gives: {owner.output}"
        ports["output"] = Port(plain_name(name, taken), "", words, "output_port")
    return ports


# ------------------------------------------------------------ names and values


def plain_name(text: str, taken: Iterable[str] = ()) -> str:
    """ASCII letters, digits and "_", a letter first, for what a tree names; none of `taken`."""
    ascii_only = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode()
    name = re.sub(r"[^A-Za-z0-9_]+", "_", ascii_only).strip("_") or "unnamed"
    name = name if name[0].isalpha() else f"n_{name}"
    others = set(taken)
    candidates = (name, *(f"{name}_{number}" for number in range(2, len(others) + 3)))
    return next(candidate for candidate in candidates if candidate not in others)


def plain_names(texts: Iterable[str], taken: Iterable[str] = ()) -> dict[str, str]:
    """Per text a name that no other text and none of `taken` has."""
    names: dict[str, str] = {}
    for text in texts:
        names.setdefault(text, plain_name(text, (*taken, *names.values())))
    return names


def printable(text: str) -> str:
    """Text without the control characters that XML has no place for."""
    return UNREADABLE.sub("\ufffd", text)


def readable(text: str) -> tuple[str, str]:
    """(the text as an attribute can hold it, how that differs from the plan's or "")."""
    clean = printable(text)
    inner = clean.strip(" ")
    if len(inner) > 2 and inner[0] == "{" and inner[-1] == "}":
        return f"({inner[1:-1]})", TABLE["pointer"]
    if clean == "=":  # the blackboard entry of the port's own name
        return "(=)", TABLE["pointer"]
    return clean, TABLE["unreadable"] if clean != text else ""


def attribute(value: Any) -> tuple[str, str]:
    """(a parameter's value as an attribute's text, how that differs from the value or "")."""
    if isinstance(value, str):
        return readable(value)
    if isinstance(value, int | float) and not isinstance(value, bool):
        return _number(value), ""
    if not isinstance(value, list):
        return readable(compact_json(value))
    if all(isinstance(item, str) for item in value):
        if any(";" in item or item.startswith("json:") for item in value):
            return readable("json:" + json.dumps(value, ensure_ascii=False))
        return readable(";".join(value))
    rows = [item if isinstance(item, list) else [item] for item in value]
    return ";".join(_number(number) for row in rows for number in row), ""


def _number(value: float) -> str:
    """Decimal digits without an exponent, of exactly this value."""
    return f"{Decimal(repr(value)):f}"
