"""What a prompt is going to say: movements, filters and perception skills, drawn for one task."""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import Any, Literal

from planner_ft.data.task.context import Context
from planner_ft.data.task.movements import Movement, implied_hold, simple
from planner_ft.data.task.patterns import EXTRA, main_movement
from planner_ft.data.task.phrasebook import Call, Saying
from planner_ft.data.task.phrasing import Scoped, Script
from planner_ft.data.task.shapes import go_back, home

EXTRA_MOVEMENTS = (
    0.56,
    0.2,
    0.13,
    0.07,
    0.04,
)  # how often a prompt has that many movements beside the main one
PERCEPTIONS = (0.14, 0.36, 0.28, 0.15, 0.07)
FILTERS = (0.56, 0.34, 0.1)
AGAIN = 0.15  # share of skills that stand a second time with other parameters
LEGS = 0.06  # share of prompts that are a route of several legs
SCOPED = 0.5  # share of prompts with several movements that say first these and then what runs in which of them


def draw_script(context: Context) -> Script | None:
    """Movements, filters and perception skills of one sample."""
    rng = context.rng
    lead = _lead(context)
    movements = _movements(context, lead)
    if movements is None:
        return None
    script = Script(movements)
    if lead:
        script.perceptions += lead
    perceptions = _draw_calls(context, "perception", _count(rng, PERCEPTIONS), script)
    filters = _draw_calls(context, "filter", _count(rng, FILTERS), script)
    if perceptions and rng.random() < AGAIN / 2 and (again := _another(context, perceptions[-1])):
        perceptions.append(again)
    if movements[0].saying is None and not script.perceptions and not perceptions:
        return None
    scoped = len(movements) > 1 and not context.book.unseen and not lead and rng.random() < SCOPED
    for calls, name in ((perceptions, "perceptions"), (filters, "filters")):
        for call in calls:
            if scoped:
                script.scoped += _scoped(context, call, name, len(movements))
                continue
            if len(movements) > 1 and rng.random() < 0.6:
                getattr(movements[int(rng.random() * len(movements))], name).append(call)
            else:
                getattr(script, name).append(call)
    _at_each(context, script)
    return script


def _scoped(context: Context, call: Call, role: str, count: int) -> list[Scoped]:
    """The skill in some of the steps and, now and then, once more with other parameters in the
    others: "5 m on the first leg, 10 m on the second".
    """
    steps = _steps(count, context.rng)
    others = frozenset(range(count)) - steps
    other = _another(context, call) if others and context.rng.random() < AGAIN else None
    return [Scoped(call, role, steps), *([Scoped(other, role, others)] if other else [])]


def _another(context: Context, call: Call) -> Call | None:
    """The same skill with other parameters."""
    if call.skill is None or not call.parameters or not context.book.skills[call.skill].several:
        return None
    other = context.call(call.skill)
    return other if other.parameters and other.parameters != call.parameters else None


def _steps(count: int, rng: random.Random) -> frozenset[int]:
    """The movements beside which a skill runs: all, one, all but one, or any."""
    roll = rng.random()
    one = frozenset({int(rng.random() * count)})
    if roll < 0.3:
        return frozenset(range(count))
    if roll < 0.75 or count == 2:
        return one
    return frozenset(range(count)) - one if roll < 0.88 else one | {int(rng.random() * count)}


def _at_each(context: Context, script: Script) -> None:
    """Now and then say that a skill runs "at each waypoint", where there is but one movement and it
    has several.
    """
    movement = script.movements[0]
    if (
        len(script.movements) > 1
        or len(movement.steps) < 3
        or movement.kind.endswith("_stops")
        or movement.saying is None
    ):
        return
    goto = context.book.skills[movement.steps[0][0]].skill.motion == "goto"
    phrases = context.book.sentences.get("each" if goto else "each_turn", [])
    for call in script.perceptions:
        if (
            phrases
            and call.skill
            and context.book.skills[call.skill].repeats
            and context.rng.random() < 0.4
        ):
            call.with_saying = None
            call.saying.suffix = f" {phrases[int(context.rng.random() * len(phrases))]}"


def _count(rng: random.Random, shares: Sequence[float]) -> int:
    roll = rng.random()
    for number, share in enumerate(shares):
        if roll < share:
            return number
        roll -= share
    return 0


def _movements(context: Context, lead: list[Call]) -> list[Movement] | None:
    rng = context.rng
    if (lead and rng.random() < 0.55) or (
        not lead
        and rng.random()
        < (0.35 if context.task.arrival == "none" and context.task.pattern == "hold" else 0.02)
    ):
        held = implied_hold(context)
        return [held] if held else None
    if not lead and rng.random() < LEGS and (route := _route(context)):
        return route
    main = (
        simple(context, context.book.motions["hold"])
        if lead and rng.random() < 0.7 and "hold" in context.book.motions
        else main_movement(context)
    )
    movements = [main]
    for _ in range(_count(rng, EXTRA_MOVEMENTS)):
        extra = _extra(context)
        if extra:
            movements.insert(int(rng.random() * (len(movements) + 1)), extra)
    if rng.random() < 0.05 and (last := (home if rng.random() < 0.4 else go_back)(context)):
        movements.append(last)
    return movements


def _route(context: Context) -> list[Movement] | None:
    """Two to four legs, each to a place of its own; the last of them is home now and then."""
    rng = context.rng
    goto = context.book.motions.get("goto")
    if not goto:
        return None
    movements = [simple(context, goto) for _ in range(2 + int(rng.random() ** 1.5 * 3))]
    if rng.random() < 0.15 and (last := home(context)):
        movements[-1] = last
    return movements


def _extra(context: Context) -> Movement | None:
    rng = context.rng
    roll = rng.random()
    if roll < 0.1:
        return EXTRA[int(rng.random() * len(EXTRA))](context)
    if roll < 0.3 and (goto := context.book.motions.get("goto")):
        return simple(context, goto)
    names = context.task.skills["navigation"] if roll < 0.6 else context.book.by_role["navigation"]
    return simple(context, names[int(rng.random() * len(names))])


def _lead(context: Context) -> list[Call]:
    """The hold in the task's own words ("search for the barge"), with the skill that it asks
    for.
    """
    entry, rng = context.entry, context.rng
    if not entry.lead or rng.random() < 0.2:
        return []
    slots = context.slots()
    parameters: dict[str, Any] = {}
    for place, name in entry.links.items():
        if place.startswith("lead."):
            context.require(name)
            value = context.fill(slots, name, place)
            if name == entry.lead_skill.get("from"):
                parameters[entry.lead_skill["parameter"]] = [value]
    templates = [template for template in entry.lead if template.fits(frozenset(slots.given))]
    return (
        [Call(entry.lead_skill.get("skill"), parameters, Saying(templates, slots))]
        if templates
        else []
    )


def _draw_calls(
    context: Context, role: Literal["filter", "perception"], count: int, script: Script
) -> list[Call]:
    rng = context.rng
    fitting = context.task.skills.get(role, ())
    every = context.book.by_role[role]
    calls: list[Call] = []
    for _ in range(count):
        names = (
            fitting if fitting and rng.random() < (0.8 if role == "perception" else 0.9) else every
        )
        if not names:
            break
        name = names[int(rng.random() * len(names))]
        again = [call for call in calls if call.skill == name]
        if again and (
            role == "filter" or not context.book.skills[name].several or rng.random() < 0.7
        ):
            continue
        call = context.call(name)
        if not any(
            call.parameters == other.parameters or not call.parameters or not other.parameters
            for other in again
        ):
            calls.append(call)
    return calls
