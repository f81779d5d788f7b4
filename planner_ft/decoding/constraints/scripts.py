"""The logic of plans: what may follow the tasks of a mission plan and the steps of a skill sequence.

The rules of missions read the vocabulary's fields (locate, transit, unresolved, a task's arrival,
leaves and pattern) and hold for any vehicle. A place that is not known yet needs a search before
it; a target is searched once; a task that is performed at a place follows what brings the vehicle
there; nothing goes to where the vehicle is. They are those of the labelling rules that need no
reading of the command: whether a vehicle that a survey took elsewhere goes on where it is then,
only the command says.

A skill stands in a step once, or again with another value, and the same movement does not come
without end. Where waypoints follow from the facts of the task (`waypoints`), which one may come
next depends on those before it.
"""

from __future__ import annotations

import functools
import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar

from planner_ft.decoding.constraints import grammar as lark
from planner_ft.decoding.constraints.grammar import Grammar, Options, Script, Slot, key
from planner_ft.decoding.constraints.patterns import literal, regex
from planner_ft.decoding.constraints.waypoints import Path, Waypoints
from planner_ft.facts.inputs import SIDES
from planner_ft.vocabulary import Parameter, Skill, Task
from planner_ft.vocabulary.definition import Role
from planner_ft.vocabulary.plans import MISSION_KEYS, STEP_KEYS, WORKING
from planner_ft.vocabulary.replay import START, Progress, target_parameter


@dataclass(frozen=True)
class MissionScript(Script):
    """A mission plan; `progress` is where it stands behind its tasks, `places` are theirs."""

    most: int = lark.MOST_TASKS
    progress: Progress = START
    places: tuple[tuple[float, ...], ...] = ()
    begins: ClassVar[str] = "{" + key(MISSION_KEYS[0]) + "["
    opens: ClassVar[str] = '{"title":"'

    def opening(self, grammar: Grammar) -> str:
        return f"{literal(self.begins)} ({literal(self.opens)} | {self._closes(grammar)})"

    def read(self, before: str) -> MissionScript:
        progress, places = START, list[tuple[float, ...]]()
        for entry in json.loads(before.removesuffix(",") + "]}")[MISSION_KEYS[0]]:
            task = self.vocabulary.task[entry["title"]]
            progress = progress.after(task, entry["parameters"], self.vocabulary)
            places.append(tuple(entry["parameters"].get(task.position_parameter or "", ())))
        return replace(self, progress=progress, places=tuple(places))

    @property
    def known(self) -> Sequence[Task]:
        return self.vocabulary.tasks

    def offers(self, grammar: Grammar, owner: Task) -> bool:
        fits = not self.logical or self.progress.offers(owner)
        return fits and self.possible(grammar, owner)

    def ending(self, grammar: Grammar, owner: Task) -> str:
        more = f"{literal(',' + self.opens)} | " if self.progress.tasks + 1 < self.most else ""
        return f"({more}{self._closes(grammar)})"

    def _closes(self, grammar: Grammar) -> str:
        """What stands behind the last task."""
        texts = grammar.items(self.values.prose(grammar))
        assumptions, constraints = (f",{key(name)}" for name in MISSION_KEYS[1:])
        return f"{literal(']' + assumptions)} {texts} {literal(constraints)} {texts} {literal('}')}"

    # ------------------------------------------------------------ what the tasks so far leave

    def options(self, slot: Slot, barred: Sequence[Any] | None = None) -> Options:
        if self.logical and slot.parameter.name == slot.owner.position_parameter:
            return self._places(slot)
        for side in slot.context if slot.parameter.name in SIDES else ():
            name, _is, size = side.partition("=")
            if name == slot.parameter.name:
                return [(literal(size), slot.context)]
        if self._tells(slot.owner, slot.parameter):
            barred = [target for target in self.progress.searched if target]
        if slot.parameter.type == "id":
            slot = slot._replace(context=frozenset({"identified"}))
        return super().options(slot, barred)

    def needs(self, owner: Task, parameter: Parameter) -> bool:
        # Two searches that name no target are the same search.
        again = self._tells(owner, parameter) and "" in self.progress.searched
        return super().needs(owner, parameter) or again

    def _tells(self, owner: Task, parameter: Parameter) -> bool:
        """Whether a parameter says what is searched."""
        search = self.logical and owner.title == self.vocabulary.locate
        return search and parameter == target_parameter(owner)

    def _places(self, slot: Slot) -> Options:
        """Where a task is; for an area whose corners are said, once, its middle, with its sides
        behind.
        """
        areas = self.values.areas if slot.owner.pattern == "lawnmower" else ()
        found: Options = []
        for middle, *sizes in (area for area in areas if area[0] not in self.places):
            sides = (
                f"{name}={lark.written(size)}" for name, size in zip(SIDES, sizes, strict=True)
            )
            found.append((literal(lark.written(middle)), slot.context | {*sides}))
        others = self._place(slot)
        return [*found, (others, slot.context)] if others else found

    def _place(self, slot: Slot) -> str | None:
        progress, unresolved, at = self.progress, self.vocabulary.unresolved, self.progress.here
        unknown = not slot.context and (bool(progress.searched) or slot.owner.docks)
        if slot.owner.arrival == "transit":
            lost = at is None or (at == unresolved and not unknown)
            return None if at is None or lost else literal(lark.written(at))
        without = [] if unknown else [unresolved]
        # Two places that are not known yet look the same: behind a second search, unresolved can be
        # another place.
        same = at == unresolved and len(progress.searched) > 1
        if slot.owner.title == self.vocabulary.transit and at and not (same or progress.moved):
            without.append(at)
        area = slot.owner.pattern == "lawnmower"
        return (self.values.middle if area else self.values.position)(slot.grammar, without)


LONGEST_WORKING = 600
"""Characters of a working. The longest of 3,000 sampled tasks has 250."""
SUMS = r"[xy0-9.+/=;\-]"
"""Signs of a working (data.task.working); its form is not enforced: wrong sums derive nothing."""
STEP = "{" + key(STEP_KEYS[0])
LISTS: dict[Role, str] = {"filter": STEP_KEYS[1], "perception": STEP_KEYS[2]}
MOST_ALIKE = 4
"""Uses of a skill in one step."""
MOST_SAME, MOST_RUN = 12, 36
"""Equal steps in a row, and movements that go nowhere: a turn in 36 steps has 10 degrees each."""


@dataclass(frozen=True)
class TaskScript(Script):
    """A skill sequence, skill by skill.

    `waypoints` are those that the facts give, None where any may be meant. `steps` are those so
    far, with the one whose lists are being written; `role` is that of the next skill, `working`
    what stands before the steps.
    """

    most: int = lark.MOST_STEPS
    waypoints: Waypoints | None = None
    steps: tuple[dict[str, Any], ...] = ()
    role: Role = "navigation"
    working: str = ""
    begins: ClassVar[str] = "{" + key("skill_sequence") + "["
    opens: ClassVar[str] = '{"name":"'

    def opening(self, grammar: Grammar) -> str:
        sums = grammar.terminal(regex(f'"{SUMS}{{1,{LONGEST_WORKING}}}"'))
        working = f'({literal(key(WORKING))} {sums} ",")?'
        ways = f"({literal(STEP + self.opens)} | {literal(']}')})"
        return f'"{{" {working} {literal(self.begins[1:])} {ways}'

    def read(self, before: str) -> TaskScript:
        done, role = before.removesuffix(STEP), self.role
        plan = json.loads(done.removesuffix(",") + ("]}]}" if done == before else "]}"))
        if done == before:
            role = "perception" if LISTS["perception"] in plan["skill_sequence"][-1] else "filter"
        steps, working = tuple(plan["skill_sequence"]), plan.get(WORKING, "")
        return replace(self, steps=steps, role=role, working=working)

    @property
    def known(self) -> Sequence[Skill]:
        return self.vocabulary.skills_in_role(self.role)

    def offers(self, grammar: Grammar, owner: Skill) -> bool:
        if self.logical and self.role == "navigation":
            moves = [step[STEP_KEYS[0]] for step in self.steps]
            latest, run = moves[-MOST_SAME:], [move["name"] for move in moves[-MOST_RUN:]]
            same = len(latest) == MOST_SAME and all(move == latest[0] for move in latest)
            long = not owner.coordinates and run.count(owner.name) == MOST_RUN
            return not ((same and latest[0]["name"] == owner.name) or long)
        used = self._used(owner)
        again = not self.logical or not used or (all(used) and len(used) < MOST_ALIKE)
        return again and self.possible(grammar, owner)

    def ending(self, grammar: Grammar, owner: Skill) -> str:
        role, used = self.role, [*(one["name"] for one in self._beside), owner.name]
        behind = f"{literal(']')} {self._reports(grammar, owner if role == 'navigation' else None)}"
        behind = self._list("perception", used if role == "perception" else [], behind)
        if role == "perception":
            return behind
        behind = f"{literal('],' + key(LISTS['perception']) + '[')} {behind}"
        behind = self._list("filter", used if role == "filter" else [], behind)
        return (
            behind if role == "filter" else f"{literal(',' + key(LISTS['filter']) + '[')} {behind}"
        )

    def _list(self, role: Role, used: Sequence[str], behind: str) -> str:
        """The next skill of a role's list after those used, or what stands `behind` the list."""
        more = len(used) < lark.MOST_SKILLS and any(
            not (self.logical and skill.name in used)
            or (skill.parameters and used.count(skill.name) < MOST_ALIKE)
            for skill in self.vocabulary.skills_in_role(role)
        )
        return f"({literal(',' * bool(used) + self.opens)} | {behind})" if more else behind

    def _reports(self, grammar: Grammar, move: Skill | None) -> str:
        """The rest of a step, with a `move` whose values are written in the same part, and the way
        to the next one or the end.
        """
        keys, texts = STEP_KEYS[3:], self.values.step_texts
        tail = (f"{literal(',' + key(name))} {texts(grammar, name)} " for name in keys)
        rest = grammar.rule("".join(tail) + literal("}"))
        another = len(self.steps) + bool(move) < self.most
        ways = [literal("," + STEP + self.opens)] if another else []
        going, known = int(bool(move and move.coordinates)), self.waypoints
        if not (another and known and known.unfinished(self._path, going)):
            ways.append(literal("]}"))
        return f"{rest} ({' | '.join(ways)})"

    # ------------------------------------------------------------ what the steps so far leave

    def options(self, slot: Slot, barred: Sequence[Any] | None = None) -> Options:
        """No unresolved corner, for a destination one of the waypoints where there are any, and for
        a skill that was used in its step another value of the parameter that it was used with.
        """
        owner, parameter = slot.owner, slot.parameter
        if self.logical and parameter in owner.coordinates:
            return self._coordinate(slot, owner.coordinates.index(parameter))
        if self.logical and parameter.type == "polygon":
            barred = (self.vocabulary.unresolved,)
        elif parameter == self._telling(owner) and parameter.type not in ("texts", "position"):
            barred = [one[parameter.name] for one in self._used(owner) if parameter.name in one]
        return super().options(slot, barred)

    def needs(self, owner: Skill, parameter: Parameter) -> bool:
        return super().needs(owner, parameter) or parameter == self._telling(owner)

    @property
    def _beside(self) -> list[dict[str, Any]]:
        """The skills before the next one in its list."""
        return self.steps[-1][LISTS[self.role]] if self.role in LISTS else []

    def _used(self, skill: Skill) -> list[dict[str, Any]]:
        return [one["parameters"] for one in self._beside if one["name"] == skill.name]

    def _telling(self, owner: Skill) -> Parameter | None:
        """The parameter that tells one use of a skill from the other."""
        named = {name for one in self._used(owner) for name in one} if self.logical else ()
        return next((item for item in owner.parameters if item.name in named), None)

    @property
    def _path(self) -> Path:
        """The waypoints so far."""
        moves = (step[STEP_KEYS[0]] for step in self.steps)
        known = (
            (self.vocabulary.skill[one["name"]].coordinates, one["parameters"]) for one in moves
        )
        return tuple((values[xy[0].name], values[xy[1].name]) for xy, values in known if xy)

    @functools.cached_property
    def _columns(self) -> dict[str, list[str]]:
        """The waypoints that may follow: y by x, as they are written."""
        columns: dict[str, list[str]] = {}
        known = self.waypoints.following(self._path, self.working) if self.waypoints else ()
        for x, y in known:
            columns.setdefault(lark.written(x), []).append(lark.written(y))
        return columns

    def _coordinate(self, slot: Slot, axis: int) -> Options:
        """A coordinate of one of the waypoints where there are any, else of any place but the
        unresolved one. The context of y is the x of several that was chosen.
        """
        unresolved, columns = self.vocabulary.unresolved[axis], self._columns
        if columns and axis == 0:
            return [(literal(x), frozenset({x})) for x in columns]
        if columns:
            symbol = slot.grammar.one_of(columns[next(iter(slot.context))])
            return [(symbol, frozenset())] if symbol else []
        barred = () if axis == 1 and not slot.context else (unresolved,)
        symbol = self.values.number(slot.grammar, slot.parameter, barred)
        options: Options = [(symbol, frozenset())] if symbol else []
        if axis == 0 and self.values.has_number(slot.parameter, unresolved):
            options.append((literal(x := lark.written(unresolved)), frozenset({x})))
        return options
