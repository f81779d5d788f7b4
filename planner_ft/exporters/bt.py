"""A plan as a behaviour tree for BehaviorTree.CPP 4 (XML, BTCPP_format="4").

The tree is a Sequence of tasks, each a SubTree of its own; a task is a Sequence of steps. A step is
a Parallel that one success and one failure end: filters are asked again for as long as the step
lasts, and one that fails fails it; perception skills run beside, each until it is done; the
movement, and every stop condition, ends the step. docs/handover.md says why. Sources: the library's
documentation (https://www.behaviortree.dev/docs/nodes-library/,
https://www.behaviortree.dev/docs/learn-the-basics/xml_format) and its sources 4.10.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any
from xml.etree import ElementTree

from planner_ft.exporters.bt_nodes import (
    HANDLE,
    LOCATE,
    REPORT,
    STOP,
    Node,
    model_element,
    nodes_of,
)
from planner_ft.exporters.bt_values import (
    RESERVED,
    UNREADABLE,
    attribute,
    plain_name,
    plain_names,
    readable,
)
from planner_ft.exporters.formats import Format, Handover, Written
from planner_ft.exporters.ledger import Item, Ledger, Path

Element = ElementTree.Element
COMMENT_FORM = "as words in a comment"
GIVEN = "LocatePlace gives it when the tree runs"


def write(handover: Handover) -> Written:
    """The tree of a plan, complete or with open places."""
    return _Tree(handover).written()


class _Tree:
    """Builds the file and keeps account of it."""

    def __init__(self, handover: Handover) -> None:
        self.handover, self.document = handover, handover.document
        self.ledger: Ledger = handover.ledger()
        self.nodes = nodes_of(handover.vocabulary)
        tasks = self.document["tasks"]
        self.notes: dict[int, list[Item]] = {}
        for item in self.ledger.items.values():
            if item.path[0] == "tasks" and item.path[2] not in (
                "title",
                "task_prompt",
                "parameters",
                "waits_for",
                "skill_sequence",
            ):
                self.notes.setdefault(int(item.path[1]), []).append(item)
        self.trees = plain_names(
            [f"{task['id']} {task['title']}" for task in tasks],
            {node.id for node in self.nodes.all},
        )
        ports = {port.name for node in self.nodes.all for port in node.ports.values()}
        self.places = plain_names(
            [place["name"] for place in self.document["open_places"]], {*RESERVED, *ports}
        )

    def written(self) -> Written:
        tasks = self.document["tasks"]
        main = plain_name(self.handover.name, self.trees.values())
        root = Element("root", BTCPP_format="4", main_tree_to_execute=main)
        root.extend(ElementTree.Comment(f" {line} ") for line in self._head())
        sequence = _add(
            _add(root, "BehaviorTree", ID=main), "Sequence", name=_name(self.handover.name)
        )
        located = self._located_by()
        for index in range(len(tasks)):
            self._reach(sequence, index, located)
            root.append(
                self._task(index, [place for place, finder in located.items() if finder == index])
            )
        if not tasks:
            _add(sequence, "AlwaysSuccess")
        root.append(model_element(self.nodes))
        ElementTree.indent(root)
        return Written(
            '<?xml version="1.0"'
            f' encoding="UTF-8"?>\n{ElementTree.tostring(root, encoding="unicode")}\n',
            self.ledger.close(),
        )

    def _located_by(self) -> dict[str, int | None]:
        """Per open place the task (index from 0) whose search finds it, None where no task before
        those that need it searches it.
        """
        found: dict[str, int | None] = {}
        for place in self.document["open_places"]:
            before = enumerate(self.document["tasks"][: place["tasks"][0] - 1])
            searches = [
                index
                for index, task in before
                if task["title"] == self.handover.vocabulary.locate
                and place["name"] in (task["title"], *task["parameters"].values())
            ]
            found[place["name"]] = searches[-1] if searches else None
        for index, _place in enumerate(self.document["open_places"]):
            self.ledger.carry("open_places", index)
        return found

    def _reach(self, sequence: Element, index: int, located: Mapping[str, int | None]) -> None:
        """Add a task to the mission, and before it the question where its place is, where no search
        says it.
        """
        task = self.document["tasks"][index]
        waits = [
            place["name"] for place in self.document["open_places"] if index + 1 in place["tasks"]
        ]
        for place in waits:
            if located[place] is None and index + 1 == self._first(place):
                self._locate(sequence, place)
        entries = {
            self.places[place]: f"{{{self.places[place]}}}"
            for place in (*waits, *(name for name, finder in located.items() if finder == index))
        }
        label = f"{task['id']} {task['title']}"
        given = {} if waits else self._given(index)
        _add(sequence, "SubTree", ID=self.trees[label], name=_name(label), **entries, **given)

    def _first(self, place: str) -> int:
        return next(
            int(known["tasks"][0])
            for known in self.document["open_places"]
            if known["name"] == place
        )

    def _given(self, index: int) -> dict[str, str]:
        """A task's prompt and parameters, as entries of its own blackboard."""
        task = self.document["tasks"][index]
        ports = self.nodes.tasks[task["title"]].ports
        values = {
            name: self._value(("tasks", index, "parameters", name), value)
            for name, value in task["parameters"].items()
        }
        values["task_prompt"] = self._value(("tasks", index, "task_prompt"), task["task_prompt"])
        return {ports[name].name: text for name, text in values.items()}

    def _value(self, path: Path, value: Any) -> str:
        text, form = attribute(value)
        self.ledger.carry(*path, form=form)
        return text

    def _locate(self, parent: Element, place: str) -> None:
        _leaf(
            parent, LOCATE, {"place": readable(place)[0], "position": f"{{{self.places[place]}}}"}
        )

    # ------------------------------------------------------------ tasks

    def _task(self, index: int, finds: list[str]) -> Element:
        task, at = self.document["tasks"][index], ("tasks", index)
        label = f"{task['id']} {task['title']}"
        tree = Element("BehaviorTree", ID=self.trees[label])
        tree.extend(ElementTree.Comment(f" {line} ") for line in self._notes(index))
        self.ledger.carry(*at, "title")
        sequence = _add(tree, "Sequence", name=_name(label))
        if task.get("waits_for") or task["skill_sequence"] is None:
            self._plan_on_board(sequence, index)
        else:
            for number, step in enumerate(task["skill_sequence"]):
                self._step(sequence, (*at, "skill_sequence", number), step, f"step {number + 1}")
        for place in finds:
            self._locate(sequence, place)
        if not len(sequence):
            _add(sequence, "AlwaysSuccess")
        return tree

    def _plan_on_board(self, sequence: Element, index: int) -> None:
        """The task as one leaf, with its place from the blackboard while that is open."""
        task, at = self.document["tasks"][index], ("tasks", index)
        node = self.nodes.tasks[task["title"]]
        waits = next(
            (
                place["name"]
                for place in self.document["open_places"]
                if index + 1 in place["tasks"]
            ),
            None,
        )
        values = {"task_prompt": self._value((*at, "task_prompt"), task["task_prompt"])}
        for name, value in task["parameters"].items():
            if waits and value == list(self.handover.vocabulary.unresolved):
                values[name] = f"{{{self.places[waits]}}}"
                self.ledger.carry(*at, "parameters", name, form=GIVEN)
            else:
                values[name] = self._value((*at, "parameters", name), value)
        _leaf(sequence, node, values)
        if (*at, "waits_for") in self.ledger:
            self.ledger.carry(*at, "waits_for")
        if (*at, "skill_sequence") in self.ledger:
            self.ledger.lose(
                *at,
                "skill_sequence",
                why="its place is open: skills to an unknown place are not handed over",
            )

    # ------------------------------------------------------------ steps

    def _step(self, sequence: Element, at: Path, step: Mapping[str, Any], where: str) -> None:
        label = f"{where}: {step['navigation_skill']['name']}"
        parent = (
            _add(sequence, "Fallback", name=_name(f"{label}, or recover"))
            if step["failure_modes"]
            else sequence
        )
        parallel = _add(parent, "Parallel", name=_name(label), success_count="1", failure_count="1")
        outputs = dict.fromkeys(range(len(step["expected_outputs"])))
        for number, skill in enumerate(step["filter_skills"]):
            self._skill(
                _add(parallel, "KeepRunningUntilFailure"),
                (*at, "filter_skills", number),
                skill,
                step,
                outputs,
            )
        if step["perception_skills"]:
            beside = _add(parallel, "Sequence", name="beside the movement")
            together = _add(_add(beside, "ForceSuccess"), "ParallelAll", max_failures="1")
            for number, skill in enumerate(step["perception_skills"]):
                self._skill(together, (*at, "perception_skills", number), skill, step, outputs)
            _add(
                _add(beside, "KeepRunningUntilFailure", name="until the step ends"), "AlwaysSuccess"
            )
        self._skill(parallel, (*at, "navigation_skill"), step["navigation_skill"], step, outputs)
        for number, text in enumerate(step["stop_conditions"]):
            until = _add(
                _add(_add(parallel, "Inverter", name="stops when"), "KeepRunningUntilFailure"),
                "Inverter",
            )
            _leaf(until, STOP, {"text": self._value((*at, "stop_conditions", number), text)})
        for number, text in enumerate(step["failure_modes"]):
            _leaf(parent, HANDLE, {"mode": self._value((*at, "failure_modes", number), text)})
        for number in outputs:
            _leaf(
                sequence,
                REPORT,
                {
                    "text": self._value(
                        (*at, "expected_outputs", number), step["expected_outputs"][number]
                    )
                },
            )

    def _skill(
        self,
        parent: Element,
        at: Path,
        skill: Mapping[str, Any],
        step: Mapping[str, Any],
        outputs: dict[int, None],
    ) -> None:
        """Add a skill; an expected output that is the skill's own becomes its output port, and is
        taken from `outputs`.
        """
        node = self.nodes.skills[skill["name"]]
        values = {
            name: self._value((*at, "parameters", name), value)
            for name, value in skill["parameters"].items()
        }
        self.ledger.carry(*at, "name")
        own = self.handover.vocabulary.skill[skill["name"]].output
        number = next(
            (number for number in outputs if step["expected_outputs"][number] == own), None
        )
        if number is not None:
            values["output"] = f"{{{node.ports['output'].name}}}"
            self.ledger.carry(*at[:4], "expected_outputs", number)
            del outputs[number]
        _leaf(parent, node, values)

    # ------------------------------------------------------------ words

    def _head(self) -> Iterator[str]:
        """What the plan says as a whole, as comments."""
        yield _comment(self.handover.name)
        yield _comment(f"approval: {self.handover.mark}")
        yield _comment(f"local frame: {self.handover.vocabulary.frame}")
        for path, item in self.ledger.items.items():
            if path[0] not in ("tasks", "open_places"):
                yield self._said(
                    f"command: {self.document['command']}" if path == ("command",) else item.what,
                    path,
                )

    def _notes(self, index: int) -> Iterator[str]:
        """What is said of a task beside its title, its parameters and its skills."""
        return (self._said(item.what, item.path) for item in self.notes.get(index, ()))

    def _said(self, words: str, path: Path) -> str:
        self.ledger.carry(*path, form=COMMENT_FORM)
        return _comment(words)


def _add(parent: Element, tag: str, **attributes: str) -> Element:
    return ElementTree.SubElement(parent, tag, attributes)


def _leaf(parent: Element, node: Node, values: Mapping[str, str]) -> None:
    ElementTree.SubElement(
        parent, node.id, {node.ports[key].name: text for key, text in values.items()}
    )


def _name(text: str) -> str:
    return UNREADABLE.sub("\ufffd", text)


def _comment(words: str) -> str:
    """Words that may stand in a comment: XML allows no "--" there, and no "-" at its end."""
    return UNREADABLE.sub("\ufffd", words).replace("--", "- -").replace("--", "- -")


FORMAT = Format(
    "bt", ".xml", "behaviour tree for BehaviorTree.CPP 4 (Groot2)", needs_origin=False, write=write
)
