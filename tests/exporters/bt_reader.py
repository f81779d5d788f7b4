"""Reading behaviour trees back: the schema, a small interpreter of the library's nodes, and what a
plan says in a tree.

BehaviorTree.CPP itself is in no Python registry. The interpreter follows its documentation of the
nodes (https://www.behaviortree.dev/docs/nodes-library/).
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from lxml import etree

SCHEMA = Path(__file__).parents[2] / "schemas" / "behaviortree.xsd"
TYPES = {
    "double": "number",
    "int": "whole",
    "std::string": "text",
    "std::vector<double>": "numbers",
    "std::vector<std::string>": "text",
    "": "entry",
}

Tick = Callable[[str, dict[str, str]], str]
"""What a leaf answers, by its name and its ports: "S", "F" or "R"."""


def read(text: str) -> Any:
    """The root element of a file that the schema finds nothing wrong with."""
    root = etree.fromstring(text.encode())
    schema = etree.XMLSchema(
        etree.fromstring(_with_leaves(SCHEMA.read_text(encoding="utf-8"), root).encode())
    )
    schema.assertValid(root)
    return root


def _with_leaves(schema: str, root: Any) -> str:
    """The schema with an element for every leaf of the file's model; places on the blackboard may
    stand for any value.
    """
    elements = []
    for leaf in root.find("TreeNodesModel"):
        attributes = []
        for port in leaf.findall("input_port") + leaf.findall("output_port"):
            kind = TYPES[port.get("type", "")] if port.tag == "input_port" else "entry"
            attributes.append(f'<xs:attribute name="{port.get("name")}" type="{kind}"/>')
        content = (
            "<xs:complexContent><xs:extension"
            f' base="anyNode">{"".join(attributes)}</xs:extension></xs:complexContent>'
        )
        elements.append(
            f'<xs:element name="{leaf.get("ID")}"'
            f' substitutionGroup="node"><xs:complexType>{content}</xs:complexType></xs:element>'
        )
    return schema.replace("</xs:schema>", "".join(elements) + "</xs:schema>")


def numbers(text: str) -> list[float]:
    return [float(part) for part in text.split(";")]


class Runner:
    """Runs a file's main tree, tick by tick. `done` lists the leaves that were asked, by name, each
    time they began anew.
    """

    def __init__(self, root: Any, tick: Tick) -> None:
        self.trees = {tree.get("ID"): tree for tree in root.findall("BehaviorTree")}
        self.main, self.tick_leaf = self.trees[root.get("main_tree_to_execute")][-1], tick
        self.done: list[str] = []
        self.state: dict[Any, Any] = {}

    def run(self, most: int = 1000) -> str:
        for _count in range(most):
            answer = self._tick(self.main)
            if answer != "R":
                return answer
        return "R"

    def _tick(self, node: Any) -> str:
        children = [child for child in node if isinstance(child.tag, str)]
        kinds: dict[str, Callable[[Any, list[Any]], str]] = {
            "Sequence": lambda node, children: self._in_turn(node, children, "F"),
            "Fallback": lambda node, children: self._in_turn(node, children, "S"),
            "Parallel": self._parallel,
            "ParallelAll": self._parallel_all,
            "ForceSuccess": (
                lambda _node, children: {"F": "S"}.get(answer := self._tick(children[0]), answer)
            ),
            "Inverter": (
                lambda _node, children: {"S": "F", "F": "S"}.get(
                    answer := self._tick(children[0]), answer
                )
            ),
            "KeepRunningUntilFailure": (
                lambda _node, children: {"S": "R"}.get(answer := self._tick(children[0]), answer)
            ),
            "AlwaysSuccess": lambda _node, _children: "S",
            "SubTree": lambda node, _children: self._tick(
                next(child for child in self.trees[node.get("ID")] if isinstance(child.tag, str))
            ),
        }
        return kinds.get(node.tag, self._leaf)(node, children)

    def _leaf(self, node: Any, _children: list[Any]) -> str:
        if self.state.get(node) != "R":
            self.done.append(node.tag)
        self.state[node] = self.tick_leaf(node.tag, dict(node.attrib))
        return str(self.state[node])

    def _in_turn(self, node: Any, children: list[Any], ends: str) -> str:
        index = self.state.get(node, 0)
        while index < len(children):
            answer = self._tick(children[index])
            if answer == "R":
                self.state[node] = index
                return "R"
            if answer == ends:
                self.state.pop(node, None)
                return answer
            index += 1
        self.state.pop(node, None)
        return "F" if ends == "S" else "S"

    def _parallel(self, node: Any, children: list[Any]) -> str:
        ended = self.state.setdefault(node, {})
        for child in children:
            if child not in ended and (answer := self._tick(child)) != "R":
                ended[child] = answer
            answers = list(ended.values())
            if answers.count("S") >= int(node.get("success_count")):
                return self._halted(node, "S")
            if answers.count("F") >= int(node.get("failure_count")):
                return self._halted(node, "F")
        return "R"

    def _parallel_all(self, node: Any, children: list[Any]) -> str:
        ended = self.state.setdefault(node, {})
        for child in children:
            if child not in ended and (answer := self._tick(child)) != "R":
                ended[child] = answer
        if len(ended) < len(children):
            return "R"
        return self._halted(node, "F" if "F" in ended.values() else "S")

    def _halted(self, node: Any, answer: str) -> str:
        for inside in node.iter():
            self.state.pop(inside, None)
        return answer
