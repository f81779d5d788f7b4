"""One command from a template: alternatives picked and slots filled; commands_plan makes the plan
for it.
"""

from __future__ import annotations

import re
from dataclasses import replace
from random import Random
from typing import Any

from planner_ft.data.mission.synthetic import words
from planner_ft.data.mission.synthetic.commands_format import (
    VALUE_NAMES,
    Line,
    Slot,
    Template,
    picked,
)
from planner_ft.data.mission.synthetic.commands_plan import Draw, copied_values, make_plan
from planner_ft.data.mission.synthetic.commands_text import joined, target_words
from planner_ft.data.mission.synthetic.commands_values import (
    arc_phrase,
    data_item,
    draw_look_alikes,
    draw_target,
    draw_value,
    feature,
    interval_words,
    near,
)
from planner_ft.data.mission.synthetic.intents import Target
from planner_ft.data.mission.synthetic.mentions import spoken_identity
from planner_ft.data.mission.synthetic.numbers import Said, Style, quantity
from planner_ft.data.mission.synthetic.positions import draw_position, position_words, say_position

LOCATED_SHARE = 0.5
SOUGHT_SHARE = 0.12
"""Targets that a command looks for have a position as seldom as this."""
SINGULAR = re.compile(
    r"\b(?:it|its|it's|is|isn't|has|was|looks|one|a|an|that|this)\b", re.IGNORECASE
)


def draw_command(
    template: Template, rng: Random, style: Style
) -> tuple[str, dict[str, Any], tuple[str, ...]]:
    """The command, its plan, and the text values whose words the command must hold. Raises
    FormatError where an alternative lacks a slot.
    """
    parts = list(picked(template.text, rng))
    slots = [part for part in parts if isinstance(part, Slot)]
    said = {slot.name for slot in slots if not slot.wrong}
    tags = {slot.name for slot in slots if slot.base == "+"}
    lines = tuple(line for line in template.lines if not line.tag or line.tag in tags)
    draw = Draw(rng, style)
    _draw_slots(draw, template, lines, slots, parts, said)
    text = _rendered(draw, template, parts)
    plan, expected = make_plan(draw, lines, said)
    return text, expected, copied_values(plan)


def _draw_slots(
    draw: Draw,
    template: Template,
    lines: tuple[Line, ...],
    slots: list[Slot],
    parts: list[str | Slot],
    said: set[str],
) -> None:
    owner = {
        name: line.title for line in reversed(lines) for name in line.slots if line.title != "Not"
    }
    near_by = {line.near for line in lines}
    for slot in sorted(slots, key=lambda slot: slot.base != "P"):
        if slot.name in draw.targets or slot.name in draw.values or slot.name in draw.texts:
            continue
        if slot.base == "P":
            draw.targets[slot.name] = Target(
                100 + _number(slot), None, draw_position(draw.rng), doubtful=slot.name in near_by
            )
        elif slot.base == "T":
            draw.targets[slot.name] = _target(draw, template, lines, slot, parts, said)
        elif slot.base == "ID":
            identity, ahead = words.call_sign(draw.rng)
            draw.targets[slot.name] = Target(
                200 + _number(slot),
                None,
                _bound_position(draw, template, slot.name, said),
                identity=identity,
                said_as=ahead,
                movable=True,
            )
        elif slot.base in VALUE_NAMES:
            draw.values[slot.name] = _new_value(draw, slot, slots, owner)
        elif slot.base != "+":
            draw.texts[slot.name] = _new_text(draw, slot, parts)
    _room_for_readings(draw, lines, slots, owner)
    _lanes_that_fit(draw, lines, slots)
    for slot in slots:
        if slot.wrong:
            draw.wrong[slot.name] = _wrong_words(
                draw, template, slot, owner.get(slot.name, ""), parts
            )


_USUAL_OWNER = {
    "radius": "PerformOrbit",
    "distance": "ParallelStructurePass",
    "length": "ParallelStructurePass",
    "width": "BathymetryGridSurvey",
    "spacing": "BathymetryGridSurvey",
    "duration": "KeepStation",
}
"""Which task's range a value has that stands in a remark alone."""


def _new_value(draw: Draw, slot: Slot, slots: list[Slot], owner: dict[str, str]) -> Said:
    same = [other for other in slots if other.name == slot.name]
    attributive, kind = (
        any(other.mode == "adj" for other in same),
        next((other.kind for other in same if other.kind), ""),
    )
    title = owner.get(slot.name, _USUAL_OWNER.get(slot.base, ""))
    return draw_value(draw.rng, draw.style, title, slot.base, attributive=attributive, kind=kind)


def _room_for_readings(
    draw: Draw, lines: tuple[Line, ...], slots: list[Slot], owner: dict[str, str]
) -> None:
    """A series of measurements has room for more than one reading."""
    for line in lines:
        if line.title != "ThermalTimeLapse":
            continue
        both = [
            slot
            for slot in slots
            if slot.base in ("interval", "duration") and slot.name in line.slots and not slot.wrong
        ]
        while sorted({slot.base for slot in both}) == ["duration", "interval"]:
            value = {slot.base: float(draw.values[slot.name].value) for slot in both}
            if 2 * value["interval"] <= value["duration"]:
                break
            draw.values |= {slot.name: _new_value(draw, slot, slots, owner) for slot in both}


def _lanes_that_fit(draw: Draw, lines: tuple[Line, ...], slots: list[Slot]) -> None:
    """Mostly a line spacing that divides the width of the grid, as people choose it."""
    for line in lines:
        size = {
            slot.base: slot.name
            for slot in slots
            if slot.base in ("width", "spacing") and slot.name in line.slots and not slot.wrong
        }
        if (
            line.title != "BathymetryGridSurvey"
            or len(size) < 2
            or draw.rng.random() > FITTING_SHARE
        ):
            continue
        width = draw.values[size["width"]].value
        fitting = [
            step
            for step in range(2, 31)
            if isinstance(width, int) and width % step == 0 and width // step <= 12
        ]
        if fitting and not any(slot.name == size["spacing"] and slot.mode for slot in slots):
            step = draw.rng.choice(fitting)
            draw.values[size["spacing"]] = quantity(step, "metre", step, draw.rng, draw.style)


FITTING_SHARE = 0.6


def _number(slot: Slot) -> int:
    return int(slot.name.removeprefix(slot.base))


def _target(
    draw: Draw,
    template: Template,
    lines: tuple[Line, ...],
    slot: Slot,
    parts: list[str | Slot],
    said: set[str],
) -> Target:
    name, kind = slot.name, template.kinds[slot.name]
    own = [
        (index, part)
        for index, part in enumerate(parts)
        if isinstance(part, Slot) and part.name == name and not part.wrong
    ]
    plain = any(part.article == "bare" or _owns(parts, index) for index, part in own)
    common = any(part.article == "a" for _, part in own)
    sought = any(line.title == "SearchAndDetect" and name in line.slots for line in lines)
    near_by = next((line.near for line in lines if name in line.slots and line.near), "")
    located = _is_located(
        draw, own, parts, sought=sought, bound=name in template.places or bool(near_by)
    )
    if kind == "pair":
        located = False
        draw.alike = draw.alike or draw_look_alikes(draw.rng, 3)
        target = draw.alike[_number(slot) - 1]
    else:
        target = draw_target(
            draw.rng, _number(slot), kind, located=located, plain=plain, common=common
        )
    if name in template.places:
        target = replace(target, position=_bound_position(draw, template, name, said))
    if near_by in draw.targets:
        target = replace(
            target, whereabouts=f"near {position_words(draw.targets[near_by].position or (0, 0))}"
        )
    doubtful = (
        target.position is not None and name not in template.places and draw.rng.random() < 0.04
    )
    on_site = any(line.here and name in line.slots for line in lines)
    return replace(target, doubtful=doubtful, on_site=on_site)


def _owns(parts: list[str | Slot], index: int) -> bool:
    follower = parts[index + 1] if index + 1 < len(parts) else ""
    return isinstance(follower, str) and follower.startswith(("'s", "’s"))


def _is_located(
    draw: Draw, own: list[tuple[int, Slot]], parts: list[str | Slot], *, sought: bool, bound: bool
) -> bool:
    """Whether the command gives a position with the target: where a mention can carry it, in about
    half of the draws.
    """
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
        return feature(
            rng, singular=any(isinstance(part, str) and SINGULAR.search(part) for part in parts)
        )
    taken = set(draw.texts.values())
    drawn = {"S": words.side, "K": words.dock_mark, "L": data_item}[slot.base]
    while True:
        text = drawn(rng)
        if text not in taken:
            return text


def _wrong_words(
    draw: Draw, template: Template, slot: Slot, title: str, parts: list[str | Slot]
) -> str:
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
                rng,
                0,
                template.kinds[slot.name].replace("pair", "structure"),
                located=False,
                plain=bool(slot.article),
                common=slot.article == "a",
            )
            text, right = (
                target_words(other, slot.article),
                target_words(draw.targets[slot.name], slot.article),
            )
        elif slot.base == "ID":
            text, right = words.call_sign(rng)[0], draw.targets[slot.name].identity or ""
        elif slot.base in VALUE_NAMES:
            value = draw_value(
                rng, style, title, slot.base, attributive=slot.mode == "adj", kind=slot.kind
            )
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
            told.append(
                _slot_words(draw, template, part, seen, parts, index, told[-1] if told else "")
            )
    return joined(told)


def _slot_words(
    draw: Draw,
    template: Template,
    slot: Slot,
    seen: dict[str, str],
    parts: list[str | Slot],
    index: int,
    before: str,
) -> str:
    if slot.wrong:
        return draw.wrong[slot.name]
    name, rng = slot.name, draw.rng
    if slot.base == "T":
        with_place = (
            not slot.article
            and name not in seen
            and name not in template.places
            and not _owns(parts, index)
        )
        if with_place or slot.article == "a":
            seen[name] = "placed"
        return target_words(
            draw.targets[name], slot.article, rng if with_place else None, draw.style
        )
    if slot.base in VALUE_NAMES:
        key = f"{name} {slot.mode}"
        if key not in seen:
            seen[key] = _value_words(rng, slot, draw.values[name], before)
            if _may_be_bare(draw, parts, index, seen) and rng.random() < BARE_SHARE:
                seen[key] = METRES.sub("", seen[key])
        return seen[key]
    if slot.base == "P":
        if name not in seen:
            seen[name] = say_position(draw.targets[name].position or (0, 0), rng, draw.style)
        return seen[name]
    return spoken_identity(draw.targets[name]) if slot.base == "ID" else draw.texts[name]


def _may_be_bare(draw: Draw, parts: list[str | Slot], index: int, told: dict[str, str]) -> bool:
    """Whether a number is one of "80 by 50", which people often say without units: the first of two
    in metres, or the second after a bare first.
    """
    if (
        _is_size(parts, index)
        and parts[index + 1 : index + 2] in JOINTS
        and _is_size(parts, index + 2)
    ):
        second = parts[index + 2]
        # "20 by 80 ft" says that the 20 are feet.
        return isinstance(second, Slot) and METRES.search(draw.values[second.name].text) is not None
    if not (
        _is_size(parts, index - 2) and parts[index - 1 : index] in JOINTS and _is_size(parts, index)
    ):
        return False
    first = parts[index - 2]
    return isinstance(first, Slot) and METRES.search(told[f"{first.name} "]) is None


def _is_size(parts: list[str | Slot], index: int) -> bool:
    part = parts[index] if 0 <= index < len(parts) else ""
    return (
        isinstance(part, Slot)
        and part.base in ("width", "length")
        and not part.mode
        and not part.wrong
    )


JOINTS = ([" by "], [" x "], ["x"], [" times "])
BARE_SHARE = 0.55
METRES = re.compile(r"\s*(?:m|met(?:re|er)s?)$")


def _value_words(rng: Random, slot: Slot, said: Said, before: str) -> str:
    if slot.mode == "adj":
        return said.attributive
    if slot.base == "arc":
        return arc_phrase(rng, said)
    return interval_words(said, before) if slot.base == "interval" else said.text
