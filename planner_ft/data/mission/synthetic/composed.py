"""Commands put together from clauses: the order turned round, several places, values far from their
task, things taken back.
"""

from __future__ import annotations

from random import Random
from typing import Any

from planner_ft.data.mission.synthetic.commands_check import built_template
from planner_ft.data.mission.synthetic.commands_draw import draw_command
from planner_ft.data.mission.synthetic.commands_format import Line, Template
from planner_ft.data.mission.synthetic.commands_noise import noisy
from planner_ft.data.mission.synthetic.composed_orders import tell_order
from planner_ft.data.mission.synthetic.composed_targets import tell_targets
from planner_ft.data.mission.synthetic.composed_values import (
    tell_apart,
    tell_corrected,
    tell_dropped,
    tell_placed,
    tell_shared,
)
from planner_ft.data.mission.synthetic.composed_wishes import slots_of
from planner_ft.data.mission.synthetic.numbers import Style

KINDS = {
    "order": 38,
    "targets": 32,
    "apart": 12,
    "shared": 9,
    "placed": 12,
    "corrected": 4,
    "dropped": 5,
}
"""How often each kind of structure is drawn."""
TELL = {
    "order": tell_order,
    "targets": tell_targets,
    "apart": tell_apart,
    "shared": tell_shared,
    "placed": tell_placed,
    "corrected": tell_corrected,
}


def compose_template(rng: Random, kind: str) -> Template:
    """A template of the kind, with no choice left in it."""
    remarks: list[Line] = []
    if kind == "dropped":
        text, wishes, remarks = tell_dropped(rng)
    else:
        text, wishes = TELL[kind](rng)
    return built_template(
        tuple(slots_of(text)), (*(wish.line() for wish in wishes), *remarks), kind
    )


def draw_composed(rng: Random, style: Style, name: str) -> dict[str, Any]:
    """A sample of a composed command; its family names the kind of structure."""
    kind = rng.choices(tuple(KINDS), tuple(KINDS.values()))[0]
    text, expected, values = draw_command(compose_template(rng, kind), rng, style)
    return {
        "id": name,
        "family": f"synthetic-composed-{kind}",
        "prompt": noisy(text, rng, values),
        "expected": expected,
        "tags": [],
    }
