"""Samples of the commands that are written by hand."""

from __future__ import annotations

from random import Random
from typing import Any

from planner_ft.data.mission.synthetic.commands_check import shipped_templates
from planner_ft.data.mission.synthetic.commands_draw import draw_command
from planner_ft.data.mission.synthetic.commands_noise import noisy
from planner_ft.data.mission.synthetic.numbers import Style


def draw_from_templates(rng: Random, style: Style, name: str) -> dict[str, Any] | None:
    """A sample of one of the shipped templates, each as likely as the others; None where there are
    none.
    """
    templates = shipped_templates()
    if not templates:
        return None
    template = templates[int(rng.random() * len(templates))]
    text, expected, values = draw_command(template, rng, style)
    tags = [] if expected["tasks"] else ["rule.empty"]
    return {
        "id": name,
        "family": f"synthetic-command-{template.subject}",
        "prompt": noisy(text, rng, values),
        "expected": expected,
        "tags": tags,
    }
