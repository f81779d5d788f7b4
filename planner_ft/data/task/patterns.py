"""Which movements a task's pattern stands for, and how often each is drawn."""

from __future__ import annotations

from planner_ft.data.task.context import Context
from planner_ft.data.task.movements import Builder, Movement, simple
from planner_ft.data.task.shapes import (
    beside,
    circle,
    home,
    lawnmower,
    line,
    square,
    stated_pass,
    waypoints,
    with_stops,
)
from planner_ft.data.task.turns import full_turn, headings, once_round, sectors, swing, turn_steps

STOPS = 0.07  # share of waypoint movements with a hold at each point

PATTERNS: dict[str, tuple[tuple[float, Builder], ...]] = {
    "goto": ((0.12, waypoints), (0.08, beside), (0.03, home)),
    "square": ((0.85, square), (0.08, waypoints)),
    "lawnmower": ((0.85, lawnmower), (0.08, waypoints)),
    "orbit": (
        (0.22, circle),
        (0.17, once_round),
        (0.05, waypoints),
        (0.03, square),
        (0.03, beside),
    ),
    "pass": ((0.5, stated_pass), (0.35, line), (0.08, waypoints)),
    "line": ((0.75, line), (0.1, stated_pass)),
    "sectors": ((0.3, sectors), (0.22, headings), (0.08, turn_steps), (0.1, full_turn)),
    "sweep": ((0.15, headings), (0.12, swing), (0.1, turn_steps), (0.05, full_turn)),
    "follow": ((0.05, waypoints), (0.03, beside)),
    "arc": ((0.05, once_round), (0.05, beside)),
    "approach": ((0.07, beside),),
}
EXTRA: tuple[Builder, ...] = (
    waypoints,
    square,
    line,
    stated_pass,
    headings,
    turn_steps,
    swing,
    circle,
    lawnmower,
    full_turn,
    once_round,
    beside,
)


def main_movement(context: Context) -> Movement:
    """The movement of the task's pattern, or a navigation skill that fits the task."""
    rng = context.rng
    roll = rng.random()
    for share, builder in PATTERNS.get(context.task.pattern, ()):
        if roll < share:
            movement = builder(context)
            if movement:
                return (
                    with_stops(context, movement)
                    if builder in (waypoints, square, circle) and rng.random() < STOPS
                    else movement
                )
            break
        roll -= share
    names = context.task.skills["navigation"]
    return simple(context, names[int(rng.random() ** 1.8 * len(names))])
