"""A plan as a behaviour file (.bhv) for the helm of MOOS-IvP.

Every movement is a behaviour that runs while MISSION_STEP holds its number, and sets the next when
it is complete. Boundaries and clearances are behaviours beside them. Skills that no behaviour does
are posted as SKILL_ variables for apps of the vehicle, and words stand in comments.
docs/exporters.md says how it is used; the sources of the syntax are named in moos_behaviours.
"""

from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.document.track import fastest
from planner_ft.exporters.formats import Action, Format, PlanExport, Written, typed
from planner_ft.exporters.ledger import LISTS
from planner_ft.exporters.moos_behaviours import (
    STEP,
    TABLE,
    Move,
    block,
    comment,
    guard_form,
    guards,
    move_of,
    quoted,
    variable,
)
from planner_ft.support.files import compact_json
from planner_ft.vocabulary.plans import step_skills

DEFAULT_SPEED = 1.0  # metres per second where the plan's vehicle says none


class _File:
    """Builds the behaviour file of a plan, up to the first task whose movement is not known, and
    keeps account of it. Movements are numbered from 1.
    """

    def __init__(self, plan: PlanExport) -> None:
        self.plan, self.document, self.vocabulary = plan, plan.document, plan.vocabulary
        self.ledger, self.motions = plan.ledger(), plan.vocabulary.motion
        vehicle = self.document.get("vehicle") or {}
        self.area = vehicle.get("area")
        speed = float(vehicle.get("cruise_speed") or DEFAULT_SPEED)
        most = [fastest(self.document, number + 1) for number in range(len(self.document["tasks"]))]
        moves = [(one, move_of(one, min(speed, most[one.task]))) for one in plan.actions]
        for action in (action for action, move in moves if move is None and action.step):
            self.ledger.lose(*action.at, why=TABLE["unknown"])
        known = ((action, move) for action, move in moves if move)
        self.moves = dict(enumerate(known, start=1))

    def written(self) -> Written:
        lines = [*self._head(), ""]
        for guard in guards(self._filters()):
            lines += [*guard, ""]
        for index, task in enumerate(self.document["tasks"][: self.plan.ready]):
            lines += [*comment("-" * 100), *self._task_words(index, task)]
            for number, (action, move) in self.moves.items():
                if action.task == index:
                    lines += [*self._movement(number, action, move), ""]
        if self.plan.blocked:
            lines += comment(f"the plan goes on, and this file does not: {self.plan.blocked[1]}")
            self.plan.lose_blocked(self.ledger)
        return Written("\n".join(lines).rstrip() + "\n", self.ledger.close())

    # ------------------------------------------------------------ words

    def _head(self) -> Iterator[str]:
        """The words of the plan as a whole, and the variables with which the mission begins."""
        origin = self.plan.origin
        where = "LatOrigin and LongOrigin are where the plan's [0, 0] lies"
        if origin:
            where = f"LatOrigin = {origin.latitude:.8f}, LongOrigin = {origin.longitude:.8f}"
        yield from comment(self.plan.name)
        yield from comment(f"approval: {self.plan.mark}")
        yield from comment(f"{self.vocabulary.frame}: the helm's own x and y")
        yield from comment(f"in the .moos file: {where}")
        for text in self.plan.head_words(self.ledger, TABLE["comment"]):
            yield from comment(text)
        yield from ("", "initialize DEPLOY = false", f"initialize {STEP} = 1")
        yield "initialize MISSION = open"
        yield f"initialize MISSION_NAME = {quoted(self.plan.name)}"

    def _task_words(self, index: int, task: Mapping[str, Any]) -> Iterator[str]:
        yield from comment(f"{task['id']} {task['title']}: {task['task_prompt']}")
        for path, item in self.ledger.items.items():
            if path[:2] == ("tasks", index) and path[2] != "skill_sequence":
                if path[2] not in ("title", "task_prompt"):
                    yield from comment(item.what)
                self.ledger.carry(*path, form=TABLE["comment"])

    # ------------------------------------------------------------ movements

    def _movement(self, number: int, action: Action, move: Move) -> Iterator[str]:
        name, skill = f"{action.entry['id']}_{action.number + 1}", action.skill
        yield from comment(f"{name}: {skill['name']} {compact_json(skill['parameters'])}")
        for key in LISTS:
            if action.step.get(key):
                yield from comment(f"{key.replace('_', ' ')}: {'; '.join(action.step[key])}")
        if action.step:
            self._account(action, move)
        else:
            known = self.vocabulary.task[action.entry["title"]]
            self.ledger.carry("tasks", action.task, "parameters", known.position_parameter or "")
        base = [("pwt", "100"), ("condition", "DEPLOY = true"), ("condition", f"{STEP} = {number}")]
        # The helm takes no name that another one begins with: "t1_1" and "t1_10" could not stand in
        # one file.
        flags: list[tuple[str, str]] = [*self._flags(number, action, move)]
        for ending, (kind, settings) in zip(("move", "speed"), move.behaviours, strict=False):
            yield from block(kind, f"{name}_{ending}", [*base, *flags, *settings])
            flags = []

    def _flags(self, number: int, action: Action, move: Move) -> Iterator[tuple[str, str]]:
        """The skills beside the movement, on while the step lasts; and the next step."""
        beside = [skill for role, skill in step_skills(action.step) if role != "navigation"]
        for skill in beside:
            given = typed(skill["parameters"], self.vocabulary.skill[skill["name"]]).items()
            texts = {key: one if isinstance(one, str) else compact_json(one) for key, one in given}
            state = "; ".join(["on", *(f"{key}={text}" for key, text in texts.items())])
            yield "activeflag", f"{variable(skill['name'])} = {quoted(state)}"
        ending = "endflag" if move.ends else "idleflag"
        for name in dict.fromkeys(skill["name"] for skill in beside):
            yield ending, f"{variable(name)} = {quoted('off')}"
        if move.ends:
            yield "endflag", f"{STEP} = {number + 1}"
            if number == len(self.moves):
                yield "endflag", f"MISSION = {'partly' if self.plan.blocked else 'complete'}"
                yield "endflag", "DEPLOY = false"

    def _account(self, action: Action, move: Move) -> None:
        """Enter what becomes of a step's movement and words; `_filters` enters its other skills."""
        name = (*action.at, "navigation_skill", "name")
        self.ledger.carry(*name, form="" if move.ends else TABLE["unended"])
        if not move.ends:
            self.ledger.stop(*name)
        for role, path in action.roles():
            if role in move.forms:
                self.ledger.carry(*path, form=move.forms[role])
            else:
                self.ledger.lose(*path, why=move.losses.get(role, TABLE["no_setting"]))
        if action.timed:
            self.ledger.carry("tasks", action.task, "parameters", action.timed)
        stop = self.vocabulary.skill[action.skill["name"]].stop if move.ends else None
        for words in LISTS:
            for number, text in enumerate(action.step[words]):
                kept = words == "stop_conditions" and text == stop
                form = "" if kept else TABLE["texts"][words]
                self.ledger.carry(*action.at, words, number, form=form)

    # ------------------------------------------------------------ filters

    def _filters(self) -> Iterator[tuple[int, str, Any]]:
        """(number of the movement, kind, polygon or distance) of every filter that a behaviour
        stands for; the rest are flags alone.
        """
        if self.area:
            region, _form = guard_form("boundary", self.area)
            self.ledger.carry("vehicle", "area", form="" if region else TABLE["area"])
            if region:
                yield from ((number, "boundary", self.area) for number in self.moves)
        for number, (action, _move) in self.moves.items():
            for key in ("filter_skills", "perception_skills"):
                for index, skill in enumerate(action.step.get(key, ())):
                    form, guard = self._guarded(skill)
                    self.ledger.carry(*action.at, key, index, form=form)
                    if guard:
                        yield (number, *guard)

    def _guarded(self, skill: Mapping[str, Any]) -> tuple[str, tuple[str, Any] | None]:
        """How the file holds a skill beside a movement; (kind, value) of its behaviour, if any."""
        motion, given = self.motions.of(skill["name"]), skill["parameters"]
        if motion and motion.kind in ("boundary", "clearance"):
            value = motion.value("polygon" if motion.kind == "boundary" else "distance", given)
            stands, form = guard_form(motion.kind, value)
            return form, (motion.kind, value) if stands else None
        words = skill["name"], *map(str, given.values())
        changed = any(quoted(one) != f'"{one}"' for one in words)
        return f"{TABLE['flag']}; {TABLE['changed']}" if changed else TABLE["flag"], None


ABOUT = "behaviour file for the helm of MOOS-IvP"
FORMAT = Format("moos", ".bhv", ABOUT, False, lambda plan: _File(plan).written())
