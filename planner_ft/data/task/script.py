"""What a prompt is going to say: movements, and the filters and perception skills that run in some
or all of them, drawn for one task; and the plan that this means.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

from planner_ft.data.numbers import pick
from planner_ft.data.task.context import Call, Context, Movement
from planner_ft.data.task.movements import EXTRA, home, main_movement
from planner_ft.data.task.phrasebook import Saying
from planner_ft.data.task.steps import entry_of, plan_step
from planner_ft.vocabulary.definition import Vocabulary

EXTRA_MOVEMENTS = (0.56, 0.2, 0.13, 0.07, 0.04)
"""How often a prompt has none, one, ... movements beside the main one."""
AGAIN = 0.15
"""Share of skills that stand a second time with other parameters."""

Beside = Literal["filter", "perception"]
SHARES: dict[Beside, Sequence[float]] = {
    "perception": (0.14, 0.36, 0.28, 0.15, 0.07),
    "filter": (0.56, 0.34, 0.1),
}


@dataclass(frozen=True)
class Run:
    """A skill that runs beside some of the movements, given by their places."""

    call: Call
    role: Beside
    steps: frozenset[int]


@dataclass
class Script:
    """The movements in their order, and the skills beside them."""

    movements: list[Movement]
    runs: list[Run]

    @property
    def skills(self) -> set[str]:
        """The filters and perception skills."""
        return {run.call.skill for run in self.runs if run.call.skill}


def draw_script(c: Context) -> Script | None:
    """The script of one sample; None when the draw came to nothing."""
    lead = _lead(c)
    movements = _movements(c, lead is not None)
    every = frozenset(range(len(movements)))
    runs = [Run(lead, "perception", every)] if lead else []
    for role, shares in SHARES.items():
        for call in _calls(c, role, _count(c.rng, shares)):
            steps = _steps(len(movements), c.rng)
            others = every - steps or every
            runs.append(Run(call, role, steps))
            share = AGAIN if others != every else AGAIN / 2 if role == "perception" else 0
            if c.rng.random() < share and (other := _another(c, call)):
                runs.append(Run(other, role, others))
    silent = movements[0].saying is None and not any(run.role == "perception" for run in runs)
    return None if silent else Script(movements, runs)


def _count(rng: random.Random, shares: Sequence[float]) -> int:
    return rng.choices(range(len(shares)), shares)[0]


def _steps(count: int, rng: random.Random) -> frozenset[int]:
    """The movements beside which a skill runs: all, one, all but one, or any two."""
    every, one, roll = frozenset(range(count)), frozenset({int(rng.random() * count)}), rng.random()
    if count == 1 or roll < 0.33:
        return every
    if roll < 0.8 or count == 2:
        return one
    return every - one if roll < 0.9 else one | {int(rng.random() * count)}


def _lead(c: Context) -> Call | None:
    """The hold in the task's own words ("search for the barge"), with the skill that it asks
    for.
    """
    entry = c.entry
    if not entry.lead or c.rng.random() < 0.2:
        return None
    slots = c.slots()
    parameters: dict[str, Any] = {}
    for place, name in entry.links.items():
        if place.startswith("lead."):
            c.require(name)
            value = c.fill(slots, name, place)
            if name == entry.lead_skill.get("from"):
                parameters[entry.lead_skill["parameter"]] = [value]
    phrases = [phrase for phrase in entry.lead if phrase.fits(frozenset(slots))]
    call = Call(entry.lead_skill.get("skill"), parameters, Saying(phrases, slots))
    return call if phrases else None


def _movements(c: Context, lead: bool) -> list[Movement]:
    rng, motions = c.rng, c.book.motions
    holds = c.task.arrival == "none" and c.task.pattern == "hold"
    if "hold" in motions and rng.random() < (0.55 if lead else 0.35 if holds else 0.02):
        # The hold of a prompt that asks for no movement.
        return [Movement("implied", [(motions["hold"], {})], None)]
    waits = lead and "hold" in motions and rng.random() < 0.7
    movements = [c.simple(motions["hold"]) if waits else main_movement(c)]
    for _ in range(_count(rng, EXTRA_MOVEMENTS)):
        if extra := _extra(c):
            movements.insert(int(rng.random() * (len(movements) + 1)), extra)
    if rng.random() < 0.03 and (back := home(c)):
        movements.append(back)
    return movements


def _extra(c: Context) -> Movement | None:
    roll = c.rng.random()
    if roll < 0.1:
        return pick(EXTRA, c.rng)(c)
    if roll < 0.35 and "goto" in c.book.motions:
        return c.simple(c.book.motions["goto"])
    if roll < 0.65:
        return c.simple(pick(c.task.skills["navigation"], c.rng))
    return c.simple(pick(c.book.vocabulary.skills_in_role("navigation"), c.rng).name)


def _calls(c: Context, role: Beside, count: int) -> list[Call]:
    """Different skills of the role, mostly those that fit the task."""
    every = [skill.name for skill in c.book.vocabulary.skills_in_role(role)]
    fitting = c.task.skills.get(role, ())
    calls: dict[str, Call] = {}
    for _ in range(count if every else 0):
        name = pick(fitting if fitting and c.rng.random() < 0.85 else every, c.rng)
        if name not in calls:
            calls[name] = c.call(name)
    return list(calls.values())


def _another(c: Context, call: Call) -> Call | None:
    """The same skill with other parameters."""
    if call.skill is None or not call.parameters or not c.book.skills[call.skill].several:
        return None
    other = c.call(call.skill)
    return other if other.parameters and other.parameters != call.parameters else None


def expected_plan(script: Script, vocabulary: Vocabulary) -> dict[str, Any]:
    """The skill plan in canonical form. Within a step, filters and perception skills stand in the
    order of mention.
    """
    runs = sorted((run for run in script.runs if run.call.skill), key=lambda run: run.call.order)
    entries = [
        (run, entry_of(run.call.skill or "", run.call.parameters, vocabulary)) for run in runs
    ]
    steps = []
    for place, movement in enumerate(script.movements):
        filters, perceptions = (
            [entry for run, entry in entries if run.role == role and place in run.steps]
            for role in ("filter", "perception")
        )
        steps += [
            plan_step(name, parameters, filters, perceptions, vocabulary)
            for name, parameters in movement.steps
        ]
    return {"skill_sequence": steps}
