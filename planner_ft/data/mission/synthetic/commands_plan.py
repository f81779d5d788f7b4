"""The plan of a command that was drawn from a template, by the labelling rules."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from random import Random
from typing import Any

from planner_ft.data.mission.synthetic.commands_format import (
    PARAMETER_OF,
    PARTED,
    REMARKS,
    VALUES,
    FormatError,
    Line,
    base_of,
    picked,
)
from planner_ft.data.mission.synthetic.extras import CANCELLED, NOTHING, RULED_OUT
from planner_ft.data.mission.synthetic.intents import Intent, Target
from planner_ft.data.mission.synthetic.labeller import Planned, label
from planner_ft.data.mission.synthetic.mentions import name_of
from planner_ft.data.mission.synthetic.numbers import Said, Style
from planner_ft.data.mission.synthetic.plan_texts import assumptions, constraints, task_prompt
from planner_ft.data.mission.synthetic.positions import position_words

NOT_DONE = {
    "Home": "The vehicle does not return home.",
    "Transit": "The vehicle does not go there.",
    "FollowTarget": "Nothing is followed.",
    "SearchAndDetect": "No search is made.",
    "GlareFreeApproach": "No glare-free pictures are taken.",
    "SubseaCableTrack": "The cable is not tracked.",
    "VisualDockingApproach": "The vehicle does not dock.",
}


@dataclass
class Draw:
    """What one command speaks of, by slot: targets, positions, values and other words; `wrong`
    holds what is taken back.
    """

    rng: Random
    style: Style
    targets: dict[str, Target] = field(default_factory=dict)
    values: dict[str, Said] = field(default_factory=dict)
    texts: dict[str, str] = field(default_factory=dict)
    wrong: dict[str, str] = field(default_factory=dict)
    alike: list[Target] = field(default_factory=list)


def make_plan(
    draw: Draw, lines: tuple[Line, ...], said: set[str]
) -> tuple[list[Planned], dict[str, Any]]:
    """The plan for what is said, as tasks and as the record holds it. Raises FormatError where an
    intent's target is not said.
    """
    intents = [
        _intent(draw, line, said) for line in lines if line.title not in (*REMARKS, "Nothing")
    ]
    plan = label(intents)
    notes, taken = _remarks(draw, lines, empty=not intents)
    expected = {
        "tasks": [
            {
                "title": planned.title,
                "parameters": planned.parameters,
                "task_prompt": task_prompt(planned, draw.rng),
            }
            for planned in plan
        ],
        "assumptions": list(dict.fromkeys([*assumptions(plan), *taken])),
        "constraints": list(dict.fromkeys([*constraints(plan), *notes])),
    }
    return plan, expected


def _intent(draw: Draw, line: Line, said: set[str]) -> Intent:
    if line.title == "Home":
        return Intent("Transit", home=True)
    place = next(
        (
            name
            for base in ("ID", "T", "P")
            for name in line.of(base)
            if base != "P" or name in said
        ),
        None,
    )
    if place is not None and place not in draw.targets:
        raise FormatError(f"{line.title} needs {{{place}}}, which one alternative does not say")
    target = draw.targets[place] if place is not None else None
    if line.title == "SubseaCableTrack" and target is not None and target.description is None:
        target = replace(target, description="cable")
    return Intent(line.title, target, _parameters(draw, line, target), part=_part(draw, line))


def _parameters(draw: Draw, line: Line, target: Target | None) -> dict[str, Any]:
    parameters: dict[str, Any] = {}
    fixed = {name: str(value) for name, value in line.fixed if name in ("F", "S", "K")}
    features = [draw.texts[name] for name in line.of("F") if name in draw.texts] or [
        fixed[name] for name in fixed if name == "F"
    ]
    if line.title in ("FeatureStare", "GlareFreeApproach"):
        thing = features[0] if features else target.description if target is not None else None
        if thing is not None:
            parameters["feature_type" if line.title == "FeatureStare" else "target_feature"] = thing
    for base, parameter in (("S", "side_id"), ("K", "target_feature")):
        if base in fixed:
            parameters[parameter] = fixed[base]
        for name in line.of(base):
            if name in draw.texts and line.title not in PARTED:
                parameters[parameter] = draw.texts[name]
    items = [draw.texts[name] for name in line.of("L") if name in draw.texts]
    if items:
        parameters["target_list"] = items
    values = {
        base_of(name): draw.values[name].value for name in line.slots if name in draw.values
    } | dict(line.fixed)
    return parameters | {
        PARAMETER_OF.get(base, base): values[base] for base in VALUES[line.title] if base in values
    }


def _part(draw: Draw, line: Line) -> str:
    if line.title not in PARTED:
        return ""
    parts = [draw.texts[name] for name in line.of("F") if name in draw.texts]
    return (
        parts[0]
        if parts
        else next((f"{draw.texts[name]} side" for name in line.of("S") if name in draw.texts), "")
    )


def _remarks(draw: Draw, lines: tuple[Line, ...], *, empty: bool) -> tuple[list[str], list[str]]:
    """Constraints and assumptions of the command's own remarks."""
    notes: list[str] = []
    taken: list[str] = []
    for line in lines:
        if line.title == "Not":
            notes.append(
                RULED_OUT[line.slots[0]][1]
                if line.slots[0] in RULED_OUT
                else NOT_DONE[line.slots[0]]
            )
        elif line.title == "Cannot":
            notes.append(f"The vehicle has no task for {_remark(draw, line)}.")
        elif line.title in ("Note", "Assume"):
            text = _remark(draw, line)
            (notes if line.title == "Note" else taken).append(f"{text[:1].upper()}{text[1:]}.")
    if empty and any(line.title == "Not" for line in lines):
        notes.append(CANCELLED)
    elif empty and not notes:
        notes.append(NOTHING)
    return notes, taken


def _remark(draw: Draw, line: Line) -> str:
    told = []
    for part in picked(line.remark, draw.rng):
        if isinstance(part, str):
            told.append(part)
        elif part.base == "P":
            told.append(position_words(draw.targets[part.name].position or (0, 0)))
        elif part.base in ("T", "ID"):
            told.append(name_of(draw.targets[part.name]))
        else:
            told.append(
                draw.values[part.name].text if part.name in draw.values else draw.texts[part.name]
            )
    return "".join(told).strip().rstrip(".")


def copied_values(plan: list[Planned]) -> tuple[str, ...]:
    """Text values whose words the command must hold."""
    values: list[str] = []
    for planned in plan:
        values += [value for value in planned.parameters.values() if isinstance(value, str)]
        values += planned.parameters.get("target_list", [])
        if planned.target is not None:
            values += [
                text for text in (planned.target.description, planned.target.identity) if text
            ]
    return tuple(dict.fromkeys(values))
