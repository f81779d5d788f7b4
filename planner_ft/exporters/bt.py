"""A plan as a behaviour tree for BehaviorTree.CPP 4 (XML, BTCPP_format="4").

The tree is a Sequence of tasks, each a SubTree of its own; a task is a Sequence of steps. A step is
a Parallel that one success and one failure end: filters are asked again for as long as the step
lasts, and one that fails fails it; perception skills run beside, each until it is done; the
movement, and every stop condition, ends the step. docs/exporters.md says why. Sources: the
library's documentation (https://www.behaviortree.dev/docs/nodes-library/,
https://www.behaviortree.dev/docs/learn-the-basics/xml_format) and its sources 4.10.
"""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any
from xml.etree import ElementTree

from planner_ft.exporters import bt_nodes
from planner_ft.exporters.bt_nodes import FIXED, TABLE, Node, attribute, plain_names, printable
from planner_ft.exporters.formats import Format, PlanExport, Written, typed
from planner_ft.exporters.ledger import Path

Element = ElementTree.Element
Entry = Mapping[str, Any]  # a task, a step, a skill or an open place of a plan document
UNTIL_FAILURE = "KeepRunningUntilFailure"
NO_NOTES = ("title", "task_prompt", "parameters", "waits_for", "skill_sequence")
"""Keys of a task that are more than words in a comment."""


class _Tree:
    """Builds the tree of a plan, complete or with open places, and keeps account of it."""

    def __init__(self, plan: PlanExport) -> None:
        self.plan, self.vocabulary, self.ledger = plan, plan.vocabulary, plan.ledger()
        self.nodes = bt_nodes.nodes_of(plan.vocabulary)
        self.tasks, self.open = plan.document["tasks"], plan.document["open_places"]
        ids = {node.id for node in self.nodes.all}
        self.labels = [f"{task['id']} {task['title']}" for task in self.tasks]
        self.trees = plain_names(self.labels, ids)
        ports = {port.name for node in self.nodes.all for port in node.ports.values()}
        taken = {*bt_nodes.RESERVED, *ports}
        self.places = plain_names([place["name"] for place in self.open], taken)
        self.finders = {place["name"]: self._finder(place) for place in self.open}

    def written(self) -> Written:
        main = bt_nodes.plain_name(self.plan.name, self.trees.values())
        root = Element("root", BTCPP_format="4", main_tree_to_execute=main)
        heads = [self.plan.name, f"approval: {self.plan.mark}"]
        heads.append(f"local frame: {self.vocabulary.frame}")
        _add_comments(root, [*heads, *self.plan.head_words(self.ledger, TABLE["comment"])])
        tree = _add(root, "BehaviorTree", ID=main)
        sequence = _add(tree, "Sequence", name=printable(self.plan.name))
        for index in range(len(self.open)):
            self.ledger.carry("open_places", index)
        for index in range(len(self.tasks)):
            self._reach(sequence, index)
            root.append(self._task(index))
        if not self.tasks:
            _add(sequence, "AlwaysSuccess")
        root.append(bt_nodes.model_element(self.nodes))
        ElementTree.indent(root)
        xml = ElementTree.tostring(root, encoding="unicode")
        return Written(f'<?xml version="1.0" encoding="UTF-8"?>\n{xml}\n', self.ledger.close())

    def _finder(self, place: Entry) -> int | None:
        """The last task (index from 0) before those that need an open place that searches it."""
        searches = [
            index
            for index, task in enumerate(self.tasks[: place["tasks"][0] - 1])
            if task["title"] == self.vocabulary.locate
            and place["name"] in (task["title"], *task["parameters"].values())
        ]
        return searches[-1] if searches else None

    def _found_by(self, index: int) -> list[str]:
        return [name for name, finder in self.finders.items() if finder == index]

    def _needed_by(self, index: int) -> list[str]:
        return [place["name"] for place in self.open if index + 1 in place["tasks"]]

    def _reach(self, sequence: Element, index: int) -> None:
        """Add a task to the mission, after asking where its place is when no search says it."""
        waits = self._needed_by(index)
        for place in self.open:
            if self.finders[place["name"]] is None and place["tasks"][0] == index + 1:
                self._locate(sequence, place["name"])
        names = [self.places[place] for place in (*waits, *self._found_by(index))]
        entries = {name: f"{{{name}}}" for name in names}
        if not waits:
            ports = self.nodes.tasks[self.tasks[index]["title"]].ports
            entries |= {ports[name].name: text for name, text in self._given(index).items()}
        label = self.labels[index]
        _add(sequence, "SubTree", **{"ID": self.trees[label], "name": printable(label), **entries})

    def _given(self, index: int) -> dict[str, str]:
        """The parameters and the prompt of a task, as attributes."""
        task, at = self.tasks[index], ("tasks", index)
        prompt = self._value((*at, "task_prompt"), task["task_prompt"])
        given = typed(task["parameters"], self.vocabulary.task[task["title"]])
        return {**self._values((*at, "parameters"), given), "task_prompt": prompt}

    def _values(self, at: Path, parameters: Entry) -> dict[str, str]:
        return {name: self._value((*at, name), value) for name, value in parameters.items()}

    def _value(self, path: Path, value: Any) -> str:
        text, form = attribute(value)
        self.ledger.carry(*path, form=form)
        return text

    def _locate(self, parent: Element, place: str) -> None:
        ports = {"place": bt_nodes.readable(place)[0], "position": f"{{{self.places[place]}}}"}
        _leaf(parent, FIXED["LocatePlace"], ports)

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
                self._step(sequence, (*at, "skill_sequence", number), step)
        for place in self._found_by(index):
            self._locate(sequence, place)
        if not len(sequence):
            _add(sequence, "AlwaysSuccess")
        return tree

    def _plan_on_board(self, sequence: Element, index: int) -> None:
        """The task as one leaf, with its place from the blackboard while that is open."""
        task, at = self.tasks[index], ("tasks", index)
        waits = self._needed_by(index)
        values = {"task_prompt": "", **self._given(index)}
        for name, value in task["parameters"].items():
            if waits and value == list(self.vocabulary.unresolved):
                values[name] = f"{{{self.places[waits[0]]}}}"
                self.ledger.carry(*at, "parameters", name, form=TABLE["given"])
        _leaf(sequence, self.nodes.tasks[task["title"]], values)
        if (*at, "waits_for") in self.ledger:
            self.ledger.carry(*at, "waits_for")
        if (*at, "skill_sequence") in self.ledger:
            self.ledger.lose(*at, "skill_sequence", why=TABLE["open_skills"])

    def _notes(self, index: int) -> Iterator[str]:
        """The words of a task beside its title, its parameters and its skills."""
        for path, item in self.ledger.items.items():
            if path[:2] == ("tasks", index) and path[2] not in NO_NOTES:
                self.ledger.carry(*path, form=TABLE["comment"])
                yield item.what

    # ------------------------------------------------------------ steps

    def _step(self, sequence: Element, at: Path, step: Entry) -> None:
        label = printable(f"step {int(at[-1]) + 1}: {step['navigation_skill']['name']}")
        parent = sequence
        if step["failure_modes"]:
            parent = _add(sequence, "Fallback", name=f"{label}, or recover")
        parallel = _add(parent, "Parallel", name=label, success_count="1", failure_count="1")
        outputs = dict(enumerate(step["expected_outputs"]))
        for number, skill in enumerate(step["filter_skills"]):
            keep = _add(parallel, UNTIL_FAILURE)
            self._skill(keep, (*at, "filter_skills", number), skill, outputs)
        if step["perception_skills"]:
            beside = _add(parallel, "Sequence", name="beside the movement")
            together = _add(_add(beside, "ForceSuccess"), "ParallelAll", max_failures="1")
            for number, skill in enumerate(step["perception_skills"]):
                self._skill(together, (*at, "perception_skills", number), skill, outputs)
            _add(_add(beside, UNTIL_FAILURE, name="until the step ends"), "AlwaysSuccess")
        self._skill(parallel, (*at, "navigation_skill"), step["navigation_skill"], outputs)
        for number, text in enumerate(step["stop_conditions"]):
            keep = _add(_add(parallel, "Inverter", name="stops when"), UNTIL_FAILURE)
            path = (*at, "stop_conditions", number)
            self._text(_add(keep, "Inverter"), "StopCondition", path, text)
        for number, text in enumerate(step["failure_modes"]):
            self._text(parent, "HandleFailure", (*at, "failure_modes", number), text)
        for number, text in outputs.items():
            self._text(sequence, "ReportOutput", (*at, "expected_outputs", number), text)

    def _text(self, parent: Element, name: str, path: Path, text: str) -> None:
        """Add a fixed node whose only port holds a sentence of the step."""
        (port,) = FIXED[name].ports
        _leaf(parent, FIXED[name], {port: self._value(path, text)})

    def _skill(self, parent: Element, at: Path, skill: Entry, outputs: dict[int, str]) -> None:
        """Add a skill; an output of its own becomes its port, and is taken from `outputs`."""
        node = self.nodes.skills[skill["name"]]
        given = typed(skill["parameters"], self.vocabulary.skill[skill["name"]])
        values = self._values((*at, "parameters"), given)
        self.ledger.carry(*at, "name")
        own = self.vocabulary.skill[skill["name"]].output
        number = next((number for number, text in outputs.items() if text == own), None)
        if number is not None:
            values["output"] = f"{{{node.ports['output'].name}}}"
            self.ledger.carry(*at[:4], "expected_outputs", number)
            del outputs[number]
        _leaf(parent, node, values)


def _add(parent: Element, tag: str, /, **attributes: str) -> Element:
    return ElementTree.SubElement(parent, tag, attributes)


def _leaf(parent: Element, node: Node, values: Mapping[str, str]) -> None:
    _add(parent, node.id, **{node.ports[key].name: text for key, text in values.items()})


def _add_comments(parent: Element, lines: Iterable[str]) -> None:
    """Add words as comments: XML allows no "--" there, and no "-" at its end."""
    for line in lines:
        words = printable(line).replace("--", "- -").replace("--", "- -")
        parent.append(ElementTree.Comment(f" {words} "))


ABOUT = "behaviour tree for BehaviorTree.CPP 4 (Groot2)"
FORMAT = Format("bt", ".xml", ABOUT, False, lambda plan: _Tree(plan).written())
