"""A plan as a behaviour tree for BehaviorTree.CPP 4 (XML, BTCPP_format="4").

The tree is a Sequence of tasks, each a SubTree of its own; a task is a Sequence of steps. A step is
a Parallel that one success and one failure end: filters are asked again for as long as the step
lasts, and one that fails fails it; perception skills run beside, each until it is done; the
movement, and every stop condition, ends the step. docs/exporters.md says why. Sources: the
library's documentation (https://www.behaviortree.dev/docs/nodes-library/,
https://www.behaviortree.dev/docs/learn-the-basics/xml_format) and its sources 4.10.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any
from xml.etree import ElementTree

from planner_ft.exporters.bt_nodes import (
    FIXED,
    RESERVED,
    TABLE,
    Node,
    attribute,
    model_element,
    nodes_of,
    plain_name,
    plain_names,
    printable,
    readable,
)
from planner_ft.exporters.formats import Format, PlanExport, Written
from planner_ft.exporters.ledger import Ledger, Path

Element = ElementTree.Element
UNTIL_FAILURE = "KeepRunningUntilFailure"
NO_NOTES = ("title", "task_prompt", "parameters", "waits_for", "skill_sequence")
"""Keys of a task that are more than words in a comment."""


def write(plan: PlanExport) -> Written:
    """The tree of a plan, complete or with open places."""
    return _Tree(plan).written()


class _Tree:
    """Builds the file and keeps account of it."""

    def __init__(self, plan: PlanExport) -> None:
        self.plan, self.document = plan, plan.document
        self.ledger: Ledger = plan.ledger()
        self.nodes = nodes_of(plan.vocabulary)
        self.tasks, self.open = self.document["tasks"], self.document["open_places"]
        ids = {node.id for node in self.nodes.all}
        self.labels = [f"{task['id']} {task['title']}" for task in self.tasks]
        self.trees = plain_names(self.labels, ids)
        ports = {port.name for node in self.nodes.all for port in node.ports.values()}
        self.places = plain_names([place["name"] for place in self.open], {*RESERVED, *ports})
        self.finders = {place["name"]: self._finder(place) for place in self.open}

    def written(self) -> Written:
        main = plain_name(self.plan.name, self.trees.values())
        root = Element("root", BTCPP_format="4", main_tree_to_execute=main)
        _add_comments(root, self._head())
        tree = _add(root, "BehaviorTree", ID=main)
        sequence = _add(tree, "Sequence", name=printable(self.plan.name))
        for index in range(len(self.open)):
            self.ledger.carry("open_places", index)
        for index in range(len(self.tasks)):
            self._reach(sequence, index)
            root.append(self._task(index))
        if not self.tasks:
            _add(sequence, "AlwaysSuccess")
        root.append(model_element(self.nodes))
        ElementTree.indent(root)
        xml = ElementTree.tostring(root, encoding="unicode")
        return Written(f'<?xml version="1.0" encoding="UTF-8"?>\n{xml}\n', self.ledger.close())

    def _finder(self, place: Mapping[str, Any]) -> int | None:
        """The last task (index from 0) before those that need an open place that searches it."""
        searches = [
            index
            for index, task in enumerate(self.tasks[: place["tasks"][0] - 1])
            if task["title"] == self.plan.vocabulary.locate
            and place["name"] in (task["title"], *task["parameters"].values())
        ]
        return searches[-1] if searches else None

    def _found_by(self, index: int) -> list[str]:
        return [name for name, finder in self.finders.items() if finder == index]

    def _needed_by(self, index: int) -> list[str]:
        return [place["name"] for place in self.open if index + 1 in place["tasks"]]

    def _reach(self, sequence: Element, index: int) -> None:
        """Add a task to the mission, and before it the question where its place is, where no search
        says it.
        """
        waits = self._needed_by(index)
        for place in self.open:
            if self.finders[place["name"]] is None and place["tasks"][0] == index + 1:
                self._locate(sequence, place["name"])
        names = [self.places[place] for place in (*waits, *self._found_by(index))]
        entries = {name: f"{{{name}}}" for name in names}
        label = self.labels[index]
        given = {} if waits else self._given(index)
        entries = {"ID": self.trees[label], "name": printable(label), **entries, **given}
        _add(sequence, "SubTree", **entries)

    def _given(self, index: int) -> dict[str, str]:
        """A task's prompt and parameters, as entries of its own blackboard."""
        task, at = self.tasks[index], ("tasks", index)
        ports = self.nodes.tasks[task["title"]].ports
        values = self._values((*at, "parameters"), task["parameters"])
        values["task_prompt"] = self._value((*at, "task_prompt"), task["task_prompt"])
        return {ports[name].name: text for name, text in values.items()}

    def _values(self, at: Path, parameters: Mapping[str, Any]) -> dict[str, str]:
        return {name: self._value((*at, name), value) for name, value in parameters.items()}

    def _value(self, path: Path, value: Any) -> str:
        text, form = attribute(value)
        self.ledger.carry(*path, form=form)
        return text

    def _locate(self, parent: Element, place: str) -> None:
        position = f"{{{self.places[place]}}}"
        _leaf(parent, FIXED["LocatePlace"], {"place": readable(place)[0], "position": position})

    # ------------------------------------------------------------ tasks

    def _task(self, index: int) -> Element:
        task, at, label = self.tasks[index], ("tasks", index), self.labels[index]
        tree = Element("BehaviorTree", ID=self.trees[label])
        _add_comments(tree, self._notes(index))
        self.ledger.carry(*at, "title")
        sequence = _add(tree, "Sequence", name=printable(label))
        if task.get("waits_for") or task["skill_sequence"] is None:
            self._plan_on_board(sequence, index)
        else:
            for number, step in enumerate(task["skill_sequence"]):
                self._step(sequence, (*at, "skill_sequence", number), step, f"step {number + 1}")
        for place in self._found_by(index):
            self._locate(sequence, place)
        if not len(sequence):
            _add(sequence, "AlwaysSuccess")
        return tree

    def _plan_on_board(self, sequence: Element, index: int) -> None:
        """The task as one leaf, with its place from the blackboard while that is open."""
        task, at = self.tasks[index], ("tasks", index)
        waits = self._needed_by(index)
        values = {"task_prompt": self._value((*at, "task_prompt"), task["task_prompt"])}
        values |= self._values((*at, "parameters"), task["parameters"])
        for name, value in task["parameters"].items():
            if waits and value == list(self.plan.vocabulary.unresolved):
                values[name] = f"{{{self.places[waits[0]]}}}"
                self.ledger.carry(*at, "parameters", name, form=TABLE["given"])
        _leaf(sequence, self.nodes.tasks[task["title"]], values)
        if (*at, "waits_for") in self.ledger:
            self.ledger.carry(*at, "waits_for")
        if (*at, "skill_sequence") in self.ledger:
            self.ledger.lose(*at, "skill_sequence", why=TABLE["open_skills"])

    # ------------------------------------------------------------ steps

    def _step(self, sequence: Element, at: Path, step: Mapping[str, Any], where: str) -> None:
        label = printable(f"{where}: {step['navigation_skill']['name']}")
        parent = sequence
        if step["failure_modes"]:
            parent = _add(sequence, "Fallback", name=f"{label}, or recover")
        parallel = _add(parent, "Parallel", name=label, success_count="1", failure_count="1")
        left = list(range(len(step["expected_outputs"])))
        for number, skill in enumerate(step["filter_skills"]):
            keep = _add(parallel, UNTIL_FAILURE)
            self._skill(keep, (*at, "filter_skills", number), skill, step, left)
        if step["perception_skills"]:
            beside = _add(parallel, "Sequence", name="beside the movement")
            together = _add(_add(beside, "ForceSuccess"), "ParallelAll", max_failures="1")
            for number, skill in enumerate(step["perception_skills"]):
                self._skill(together, (*at, "perception_skills", number), skill, step, left)
            _add(_add(beside, UNTIL_FAILURE, name="until the step ends"), "AlwaysSuccess")
        self._skill(parallel, (*at, "navigation_skill"), step["navigation_skill"], step, left)
        for number in range(len(step["stop_conditions"])):
            keep = _add(_add(parallel, "Inverter", name="stops when"), UNTIL_FAILURE)
            self._text(_add(keep, "Inverter"), "StopCondition", at, "stop_conditions", step, number)
        for number in range(len(step["failure_modes"])):
            self._text(parent, "HandleFailure", at, "failure_modes", step, number)
        for number in left:
            self._text(sequence, "ReportOutput", at, "expected_outputs", step, number)

    def _text(
        self, parent: Element, name: str, at: Path, key: str, step: Mapping[str, Any], number: int
    ) -> None:
        """Add a fixed node whose only port holds a sentence of the step."""
        (port,) = FIXED[name].ports
        _leaf(parent, FIXED[name], {port: self._value((*at, key, number), step[key][number])})

    def _skill(
        self,
        parent: Element,
        at: Path,
        skill: Mapping[str, Any],
        step: Mapping[str, Any],
        left: list[int],
    ) -> None:
        """Add a skill; an expected output that is the skill's own becomes its output port, and is
        taken from `left`.
        """
        node = self.nodes.skills[skill["name"]]
        values = self._values((*at, "parameters"), skill["parameters"])
        self.ledger.carry(*at, "name")
        own = self.plan.vocabulary.skill[skill["name"]].output
        number = next((one for one in left if step["expected_outputs"][one] == own), None)
        if number is not None:
            values["output"] = f"{{{node.ports['output'].name}}}"
            self.ledger.carry(*at[:4], "expected_outputs", number)
            left.remove(number)
        _leaf(parent, node, values)

    # ------------------------------------------------------------ comments

    def _head(self) -> Iterator[str]:
        """The words of the plan as a whole."""
        yield self.plan.name
        yield f"approval: {self.plan.mark}"
        yield f"local frame: {self.plan.vocabulary.frame}"
        for path, item in self.ledger.items.items():
            if path[0] not in ("tasks", "open_places"):
                self.ledger.carry(*path, form=TABLE["comment"])
                command = f"command: {self.document['command']}"
                yield command if path == ("command",) else item.what

    def _notes(self, index: int) -> Iterator[str]:
        """The words of a task beside its title, its parameters and its skills."""
        for path, item in self.ledger.items.items():
            if path[:2] == ("tasks", index) and path[2] not in NO_NOTES:
                self.ledger.carry(*path, form=TABLE["comment"])
                yield item.what


def _add(parent: Element, tag: str, **attributes: str) -> Element:
    return ElementTree.SubElement(parent, tag, attributes)


def _leaf(parent: Element, node: Node, values: Mapping[str, str]) -> None:
    attributes = {node.ports[key].name: text for key, text in values.items()}
    ElementTree.SubElement(parent, node.id, attributes)


def _add_comments(parent: Element, lines: Iterable[str]) -> None:
    """Add words as comments: XML allows no "--" there, and no "-" at its end."""
    for line in lines:
        words = printable(line).replace("--", "- -").replace("--", "- -")
        parent.append(ElementTree.Comment(f" {words} "))


FORMAT = Format("bt", ".xml", "behaviour tree for BehaviorTree.CPP 4 (Groot2)", False, write)
