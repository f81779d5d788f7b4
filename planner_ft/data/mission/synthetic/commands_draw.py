"""One command from a template: alternatives picked, slots filled, the plan made by the labelling rules."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from random import Random
from typing import Any

from planner_ft.data.mission.synthetic import words
from planner_ft.data.mission.synthetic.commands_format import (
    PARAMETER_OF,
    PARTED,
    REMARKS,
    VALUE_NAMES,
    VALUES,
    Choice,
    FormatError,
    Line,
    Node,
    Slot,
    Template,
    base_of,
)
from planner_ft.data.mission.synthetic.commands_text import joined, target_words
from planner_ft.data.mission.synthetic.commands_values import arc_phrase, data_item, draw_look_alikes, draw_target, draw_value, feature, interval_words, near
from planner_ft.data.mission.synthetic.extras import CANCELLED, NOTHING, RULED_OUT
from planner_ft.data.mission.synthetic.intents import Intent, Target
from planner_ft.data.mission.synthetic.labeller import label
from planner_ft.data.mission.synthetic.mentions import name_of, spoken_identity
from planner_ft.data.mission.synthetic.numbers import Said, Style
from planner_ft.data.mission.synthetic.plan_texts import assumptions, constraints, task_prompt
from planner_ft.data.mission.synthetic.positions import draw_position, position_words, say_position

LOCATED_SHARE = 0.5
SOUGHT_SHARE = 0.12
"""Targets that a command looks for have a position as seldom as this."""
NOT_DONE = {
    "Home": "The vehicle does not return home.", "Transit": "The vehicle does not go there.", "FollowTarget": "Nothing is followed.",
    "SearchAndDetect": "No search is made.", "GlareFreeApproach": "No glare-free pictures are taken.", "SubseaCableTrack": "The cable is not tracked.",
    "VisualDockingApproach": "The vehicle does not dock.",
}  # fmt: skip
SINGULAR = re.compile(r"\b(?:it|its|it's|is|isn't|has|was|looks|one|a|an|that|this)\b", re.IGNORECASE)


@dataclass
class Draw:
    """What one command speaks of, by slot: targets, positions, values and other words; `wrong` holds what is taken back."""

    rng: Random
    style: Style
    targets: dict[str, Target] = field(default_factory=dict)
    values: dict[str, Said] = field(default_factory=dict)
    texts: dict[str, str] = field(default_factory=dict)
    wrong: dict[str, str] = field(default_factory=dict)
    alike: list[Target] = field(default_factory=list)


def draw_command(template: Template, rng: Random, style: Style) -> tuple[str, dict[str, Any], tuple[str, ...]]:
    """The command, its plan, and the text values whose words the command must hold. Raises FormatError where an alternative lacks a slot."""
    parts = list(picked(template.text, rng))
    slots = [part for part in parts if isinstance(part, Slot)]
    said = {slot.name for slot in slots if not slot.wrong}
    tags = {slot.name for slot in slots if slot.base == "+"}
    lines = tuple(line for line in template.lines if not line.tag or line.tag in tags)
    draw = Draw(rng, style)
    _draw_slots(draw, template, lines, slots, parts, said)
    text = _rendered(draw, template, parts)
    plan, expected = _plan(draw, template, lines, said)
    return text, expected, _copied(plan)


def picked(nodes: Iterable[Node], rng: Random) -> Iterable[str | Slot]:
    """The parts of the text with one alternative of each choice."""
    for node in nodes:
        if isinstance(node, Choice):
            yield from picked(node.options[int(rng.random() * len(node.options))], rng)
        else:
            yield node


def _draw_slots(draw: Draw, template: Template, lines: tuple[Line, ...], slots: list[Slot], parts: list[str | Slot], said: set[str]) -> None:
    owner = {name: line.title for line in reversed(lines) for name in line.slots if line.title != "Not"}
    near_by = {line.near for line in lines}
    for slot in sorted(slots, key=lambda slot: slot.base != "P"):
        if slot.name in draw.targets or slot.name in draw.values or slot.name in draw.texts:
            continue
        if slot.base == "P":
            draw.targets[slot.name] = Target(100 + _number(slot), None, draw_position(draw.rng), doubtful=slot.name in near_by)
        elif slot.base == "T":
            draw.targets[slot.name] = _target(draw, template, lines, slot, parts, said)
        elif slot.base == "ID":
            identity, ahead = words.call_sign(draw.rng)
            draw.targets[slot.name] = Target(
                200 + _number(slot), None, _bound_position(draw, template, slot.name, said), identity=identity, said_as=ahead, movable=True
            )
        elif slot.base in VALUE_NAMES:
            draw.values[slot.name] = _new_value(draw, slot, slots, owner)
        elif slot.base != "+":
            draw.texts[slot.name] = _new_text(draw, slot, parts)
    _room_for_readings(draw, lines, slots, owner)
    for slot in slots:
        if slot.wrong:
            draw.wrong[slot.name] = _wrong_words(draw, template, slot, owner.get(slot.name, ""), parts)


_USUAL_OWNER = {
    "radius": "PerformOrbit", "distance": "ParallelStructurePass", "length": "ParallelStructurePass", "width": "BathymetryGridSurvey",
    "spacing": "BathymetryGridSurvey", "duration": "KeepStation",
}  # fmt: skip
"""Which task's range a value has that stands in a remark alone."""


def _new_value(draw: Draw, slot: Slot, slots: list[Slot], owner: dict[str, str]) -> Said:
    same = [other for other in slots if other.name == slot.name]
    attributive, kind = any(other.mode == "adj" for other in same), next((other.kind for other in same if other.kind), "")
    title = owner.get(slot.name, _USUAL_OWNER.get(slot.base, ""))
    return draw_value(draw.rng, draw.style, title, slot.base, attributive=attributive, kind=kind)


def _room_for_readings(draw: Draw, lines: tuple[Line, ...], slots: list[Slot], owner: dict[str, str]) -> None:
    """A series of measurements has room for more than one reading."""
    for line in lines:
        if line.title != "ThermalTimeLapse":
            continue
        both = [slot for slot in slots if slot.base in ("interval", "duration") and slot.name in line.slots and not slot.wrong]
        while sorted({slot.base for slot in both}) == ["duration", "interval"]:
            value = {slot.base: float(draw.values[slot.name].value) for slot in both}
            if 2 * value["interval"] <= value["duration"]:
                break
            draw.values |= {slot.name: _new_value(draw, slot, slots, owner) for slot in both}


def _number(slot: Slot) -> int:
    return int(slot.name.removeprefix(slot.base))


def _target(draw: Draw, template: Template, lines: tuple[Line, ...], slot: Slot, parts: list[str | Slot], said: set[str]) -> Target:
    name, kind = slot.name, template.kinds[slot.name]
    own = [(index, part) for index, part in enumerate(parts) if isinstance(part, Slot) and part.name == name and not part.wrong]
    plain = any(part.article == "bare" or _owns(parts, index) for index, part in own)
    common = any(part.article == "a" for _, part in own)
    sought = any(line.title == "SearchAndDetect" and name in line.slots for line in lines)
    near_by = next((line.near for line in lines if name in line.slots and line.near), "")
    located = _is_located(draw, own, parts, sought=sought, bound=name in template.places or bool(near_by))
    if kind == "pair":
        located = False
        draw.alike = draw.alike or draw_look_alikes(draw.rng, 3)
        target = draw.alike[_number(slot) - 1]
    else:
        target = draw_target(draw.rng, _number(slot), kind, located=located, plain=plain, common=common)
    if name in template.places:
        target = replace(target, position=_bound_position(draw, template, name, said))
    if near_by in draw.targets:
        target = replace(target, whereabouts=f"near {position_words(draw.targets[near_by].position or (0, 0))}")
    doubtful = target.position is not None and name not in template.places and draw.rng.random() < 0.04
    on_site = any(line.here and name in line.slots for line in lines)
    return replace(target, doubtful=doubtful, on_site=on_site)


def _owns(parts: list[str | Slot], index: int) -> bool:
    follower = parts[index + 1] if index + 1 < len(parts) else ""
    return isinstance(follower, str) and follower.startswith(("'s", "’s"))


def _is_located(draw: Draw, own: list[tuple[int, Slot]], parts: list[str | Slot], *, sought: bool, bound: bool) -> bool:
    """Whether the command gives a position with the target: where a mention can carry it, in about half of the draws."""
    modes = {part.mode for _, part in own}
    if bound or "lost" in modes or not _bearer(own, parts):
        return False
    return "located" in modes or draw.rng.random() < (SOUGHT_SHARE if sought else LOCATED_SHARE)


def _bearer(own: list[tuple[int, Slot]], parts: list[str | Slot]) -> bool:
    """Whether a mention can carry a position: a full one before which none was indefinite."""
    for index, part in own:
        if part.article == "a":
            return False
        if not part.article and not _owns(parts, index):
            return True
    return False


def _bound_position(draw: Draw, template: Template, name: str, said: set[str]) -> Any:
    place = template.places.get(name)
    return draw.targets[place].position if place in said and place in draw.targets else None


def _new_text(draw: Draw, slot: Slot, parts: list[str | Slot]) -> str:
    rng = draw.rng
    if slot.base == "F":
        return feature(rng, singular=any(isinstance(part, str) and SINGULAR.search(part) for part in parts))
    taken = set(draw.texts.values())
    drawn = {"S": words.side, "K": words.dock_mark, "L": data_item}[slot.base]
    while True:
        text = drawn(rng)
        if text not in taken:
            return text


def _wrong_words(draw: Draw, template: Template, slot: Slot, title: str, parts: list[str | Slot]) -> str:
    """The words of a value that is taken back: of the same kind, and another one."""
    rng, style = draw.rng, draw.style
    while True:
        if slot.base == "P":
            text, right = (
                say_position(near(draw.targets[slot.name].position or (0, 0), rng), rng, style),
                say_position(draw.targets[slot.name].position or (0, 0), rng, style),
            )
        elif slot.base == "T":
            other = draw_target(
                rng, 0, template.kinds[slot.name].replace("pair", "structure"), located=False, plain=bool(slot.article), common=slot.article == "a"
            )
            text, right = target_words(other, slot.article), target_words(draw.targets[slot.name], slot.article)
        elif slot.base == "ID":
            text, right = words.call_sign(rng)[0], draw.targets[slot.name].identity or ""
        elif slot.base in VALUE_NAMES:
            value = draw_value(rng, style, title, slot.base, attributive=slot.mode == "adj", kind=slot.kind)
            text = _value_words(rng, slot, value, "every")
            right = text if value.value == draw.values[slot.name].value else ""
        else:
            text, right = _new_text(draw, slot, parts), draw.texts[slot.name]
        if text != right:
            return text


def _rendered(draw: Draw, template: Template, parts: list[str | Slot]) -> str:
    seen: dict[str, str] = {}
    told: list[str] = []
    for index, part in enumerate(parts):
        if isinstance(part, str):
            told.append(part)
        elif part.base != "+":
            told.append(_slot_words(draw, template, part, seen, parts, index, told[-1] if told else ""))
    return joined(told)


def _slot_words(draw: Draw, template: Template, slot: Slot, seen: dict[str, str], parts: list[str | Slot], index: int, before: str) -> str:
    if slot.wrong:
        return draw.wrong[slot.name]
    name, rng = slot.name, draw.rng
    if slot.base == "T":
        with_place = not slot.article and name not in seen and name not in template.places and not _owns(parts, index)
        if with_place or slot.article == "a":
            seen[name] = "placed"
        return target_words(draw.targets[name], slot.article, rng if with_place else None, draw.style)
    if slot.base in VALUE_NAMES:
        key = f"{name} {slot.mode}"
        if key not in seen:
            seen[key] = _value_words(rng, slot, draw.values[name], before)
        return seen[key]
    if slot.base == "P":
        if name not in seen:
            seen[name] = say_position(draw.targets[name].position or (0, 0), rng, draw.style)
        return seen[name]
    return spoken_identity(draw.targets[name]) if slot.base == "ID" else draw.texts[name]


def _value_words(rng: Random, slot: Slot, said: Said, before: str) -> str:
    if slot.mode == "adj":
        return said.attributive
    if slot.base == "arc":
        return arc_phrase(rng, said)
    return interval_words(said, before) if slot.base == "interval" else said.text


def _plan(draw: Draw, template: Template, lines: tuple[Line, ...], said: set[str]) -> tuple[list[Any], dict[str, Any]]:
    intents = [_intent(draw, line, said) for line in lines if line.title not in (*REMARKS, "Nothing")]
    plan = label(intents)
    notes, taken = _remarks(draw, lines, empty=not intents)
    expected = {
        "tasks": [{"title": planned.title, "parameters": planned.parameters, "task_prompt": task_prompt(planned, draw.rng)} for planned in plan],
        "assumptions": list(dict.fromkeys([*assumptions(plan), *taken])),
        "constraints": list(dict.fromkeys([*constraints(plan), *notes])),
    }
    return plan, expected


def _intent(draw: Draw, line: Line, said: set[str]) -> Intent:
    if line.title == "Home":
        return Intent("Transit", home=True)
    place = next((name for base in ("ID", "T", "P") for name in line.of(base) if base != "P" or name in said), None)
    if place is not None and place not in draw.targets:
        raise FormatError(f"{line.title} needs {{{place}}}, which one alternative does not say")
    target = draw.targets[place] if place is not None else None
    if line.title == "SubseaCableTrack" and target is not None and target.description is None:
        target = replace(target, description="cable")
    return Intent(line.title, target, _parameters(draw, line, target), part=_part(draw, line))


def _parameters(draw: Draw, line: Line, target: Target | None) -> dict[str, Any]:
    parameters: dict[str, Any] = {}
    features = [draw.texts[name] for name in line.of("F") if name in draw.texts]
    if line.title in ("FeatureStare", "GlareFreeApproach"):
        thing = features[0] if features else target.description if target is not None else None
        if thing is not None:
            parameters["feature_type" if line.title == "FeatureStare" else "target_feature"] = thing
    for base, parameter in (("S", "side_id"), ("K", "target_feature")):
        for name in line.of(base):
            if name in draw.texts and line.title not in PARTED:
                parameters[parameter] = draw.texts[name]
    items = [draw.texts[name] for name in line.of("L") if name in draw.texts]
    if items:
        parameters["target_list"] = items
    values = {base_of(name): draw.values[name].value for name in line.slots if name in draw.values} | dict(line.fixed)
    return parameters | {PARAMETER_OF.get(base, base): values[base] for base in ("side_id", *VALUES[line.title]) if base in values}


def _part(draw: Draw, line: Line) -> str:
    if line.title not in PARTED:
        return ""
    parts = [draw.texts[name] for name in line.of("F") if name in draw.texts]
    return parts[0] if parts else next((f"{draw.texts[name]} side" for name in line.of("S") if name in draw.texts), "")


def _remarks(draw: Draw, lines: tuple[Line, ...], *, empty: bool) -> tuple[list[str], list[str]]:
    """Constraints and assumptions of the command's own remarks."""
    notes, taken = [], []
    for line in lines:
        if line.title == "Not":
            notes.append(RULED_OUT[line.slots[0]][1] if line.slots[0] in RULED_OUT else NOT_DONE[line.slots[0]])
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
            told.append(draw.values[part.name].text if part.name in draw.values else draw.texts[part.name])
    return "".join(told).strip().rstrip(".")


def _copied(plan: list[Any]) -> tuple[str, ...]:
    values: list[str] = []
    for planned in plan:
        values += [value for value in planned.parameters.values() if isinstance(value, str)]
        values += planned.parameters.get("target_list", [])
        if planned.target is not None:
            values += [text for text in (planned.target.description, planned.target.identity) if text]
    return tuple(dict.fromkeys(values))
