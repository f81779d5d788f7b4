"""The slots of a command's template, filled: targets, positions and values that it speaks of."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from random import Random
from typing import TYPE_CHECKING, Any

from planner_ft.data import formulas
from planner_ft.data.formulas import HOME, is_formula, operands, worked_out
from planner_ft.data.mission_binding import CLAUSE, LIMIT, Bound, Line
from planner_ft.data.mission_plan import Target
from planner_ft.data.numbers import WRITTEN, Value, bearing, knots, pick
from planner_ft.data.templates.grammar import Chosen, Slot, base_of, fail
from planner_ft.data.values import draw_number, draw_point
from planner_ft.facts.geometry import Point, point
from planner_ft.vocabulary.limits import written

if TYPE_CHECKING:
    from planner_ft.data.missions import MissionSampler

LOCATED, SOUGHT = 0.5, 0.12
"""Shares of targets said with a position, and of those that the command looks for."""
ALIGNED = 0.5
"""Share of the positions that share a coordinate with another one of the command, or with home."""
SPOKEN_IN_KNOTS, BOXED = 0.5, 0.3
"""Shares of the limits of speed in knots, and of the boxes that two of their corners name."""
SIDES = (20, 300)
"""Metres between two corners, each way."""
DOUBTFUL, FITTING = 0.04, 0.6
"""Shares of doubtful positions, and of the spacings that divide the width."""
LANES = 12
AT_HOME = frozenset(("x0", "y0"))
BESIDE = re.compile(r"[xy]\d+|on\d+_\d+")
UNPLACED = frozenset(("a", "one", "look", "nouns"))
"""Options of mentions that carry no position."""


class Filling(Chosen):
    """What one command speaks of, by slot."""

    def __init__(self, sampler: MissionSampler, bound: Bound, rng: Random) -> None:
        self.sampler, self.bound, self.template, self.rng = sampler, bound, bound.template, rng
        self.words, self.vocabulary = sampler.words, sampler.vocabulary
        self.targets: dict[str, Target] = {}
        self.values: dict[str, Value] = {}
        self.alike: list[Target] = []
        self.clauses: dict[str, Any] = {}
        roll = rng.random()
        self.form = None if roll > 0.85 else WRITTEN[0] if roll < 0.3 else pick(WRITTEN, rng)
        super().__init__(self.template.nodes, rng)
        chosen = {"", *self.labels, *self.said}
        self.lines = [line for line in bound.lines if line.label in chosen]
        plan = self.template.plan
        self.corners = {other: (one, ways) for one, other, ways in formulas.opposite(plan)}
        self.winds = formulas.directions(plan)
        self.slots.sort(key=_turn)
        for slot in self.slots:
            if slot.key not in self.targets and slot.key not in self.values:
                self._draw(slot)
        self._agree()
        for key in (key for line in self.lines for key in line.objects if is_formula(key)):
            if operands(key) <= self.said:
                self.targets[key] = Target(key, position=worked_out(key, self._worth))

    # ------------------------------------------------------------ what is spoken of

    def _draw(self, slot: Slot) -> None:
        key = slot.key
        if slot.base == "P":
            doubtful = any(line.near == key for line in self.lines)
            options = {option for one in self.slots if one.key == key for option in one.options}
            there = self._beside(options) if options else self._point(*self.corners.get(key, ()))
            self.targets[key] = Target(key, position=there, doubtful=doubtful)
        elif slot.base == "T":
            self.targets[key] = self._target(slot)
        elif slot.base == "ID":
            name, place = self.words.noun("identity", self.rng), self._bound_place(key)
            self.targets[key] = Target(key, identity=name.value, text=name.text, position=place)
        elif slot.base != CLAUSE:
            self.values[key] = self._value(slot)

    def _point(self, corner: str = "", ways: Sequence[tuple[int, int]] = ()) -> Point:
        """A position; the one opposite a corner where that is given. Some share coordinates with
        other places of the command, as the corners of a box do.
        """
        known = [target.position for target in self.targets.values() if target.position]
        taken = {self.vocabulary.home, self.vocabulary.unresolved, *known}
        while True:
            place = draw_point(self.rng)
            if known and self.rng.random() < ALIGNED:
                others = [self.vocabulary.home, *known]
                (x, _), (_, y) = pick(others, self.rng), pick(others, self.rng)
                place = pick(((x, place[1]), (place[0], y), (x, y)), self.rng)
            if corner in self.targets:
                sides = (way * draw_number(self.rng, *SIDES) for way in pick(ways, self.rng))
                start = self._place_of(corner)
                place = point(*(one + side for one, side in zip(start, sides, strict=True)))
            if place not in taken:
                return place

    def _beside(self, options: Iterable[str]) -> Point:
        """A position with the x or the y of other places ("x1", "y2"; 0 is home), a side away along
        the other axis, or the next one in a row of two ("on1_2"). Raises TemplateError.
        """
        shared: dict[str, float] = {}
        start = self.vocabulary.home
        for option in sorted(options):
            numbers = re.findall(r"\d+", option) if BESIDE.fullmatch(option) else ["?"]
            keys = [HOME if number == "0" else f"P{number}" for number in numbers]
            if not self.targets.keys() | {HOME} >= {*keys}:
                fail(f"{option} names no place that is said before")
            start, *second = map(self._worth, keys)
            if second:
                return point(*(2 * there - one for one, there in zip(start, *second, strict=True)))
            shared[option[0]] = start["xy".index(option[0])]
        taken = {target.position for target in self.targets.values()}
        while True:
            sides = (pick((-1, 1), self.rng) * draw_number(self.rng, *SIDES) for _ in start)
            moved = zip("xy", start, sides, strict=True)
            place = point(*(shared.get(axis, one + side) for axis, one, side in moved))
            if len(shared) == 2 or place not in taken:
                return place

    def _worth(self, key: str) -> Any:
        """The position or the number of a slot."""
        if key == HOME:
            return self.vocabulary.home
        return self._place_of(key) if key in self.targets else self.values[key].value

    def _place_of(self, key: str) -> Point:
        return self.targets[key].position or (0, 0)

    def _bound_place(self, key: str) -> Point | None:
        place = self.targets.get(self.bound.places.get(key, ""))
        return place.position if place else None

    def _target(self, slot: Slot) -> Target:
        key, rng = slot.key, self.rng
        mentions = [
            (part.options, self._owns(number))
            for number, part in enumerate(self.parts)
            if isinstance(part, Slot) and part.key == key and not part.sign
        ]
        lines = [line for line in self.lines if key in line.objects]
        common = any("a" in options for options, _owns in mentions)
        fixed = common or any("bare" in options or owns for options, owns in mentions)
        kind = self.bound.kinds.get(key, self.sampler.default)
        near = next((line.near for line in lines if line.near), "")
        target = self._alike(key) if kind == "pair" else self._described(key, kind, fixed, common)
        if key in self.bound.places:
            target = replace(target, position=self._bound_place(key))
        elif not near and kind != "pair" and self._is_located(mentions, lines):
            doubt = rng.random() < DOUBTFUL
            target = replace(target, position=self._point(), doubtful=doubt)
        if near in self.targets:
            target = replace(target, whereabouts=f"near {written(self._place_of(near))}")
        spot = any(line.task is not None and line.task.docks for line in lines)
        return replace(target, spot=spot, on_site=any(line.here for line in lines))

    def _is_located(
        self, mentions: Sequence[tuple[frozenset[str], bool]], lines: Sequence[Line]
    ) -> bool:
        """Whether the command gives a position with the target: where a mention can carry it."""
        first = next((mention for mention in mentions if "bare" not in mention[0]), None)
        every: frozenset[str] = frozenset().union(*(options for options, _owns in mentions))
        if "lost" in every or first is None or first[0] & UNPLACED or first[1]:
            return False
        locate = self.vocabulary.locate
        sought = any(line.task is not None and line.task.title == locate for line in lines)
        return "located" in every or self.rng.random() < (SOUGHT if sought else LOCATED)

    def _described(self, key: str, kind: str, fixed: bool, common: bool) -> Target:
        """A target; `fixed` takes an article and no "with ..." phrase, `common` no name."""
        for _ in range(20):
            value = self.words.noun(kind, self.rng)
            article = value.text != value.value
            unfit = fixed and (not article or " with " in value.value)
            if not unfit and not (common and is_name(value.value)):
                break
        return Target(key, value.value, article=article, text=value.value)

    def _alike(self, key: str) -> Target:
        """One of several targets with one noun that differ in their look."""
        if not self.alike:
            while (noun := self.words.entry("pair", self.rng)).endswith("y"):
                continue
            looks = self.words.entry("looks", self.rng).split("/")
            if self.rng.random() < 0.5:
                looks[:2] = looks[1::-1]
            self.alike = [Target(key, f"{look} {noun}", text=look, noun=noun) for look in looks]
        return replace(self.alike[int(key[1:]) - 1], key=key)

    def _value(self, slot: Slot) -> Value:
        """A value with the wordings that its slots ask for; texts of one kind differ."""
        mentions = [other.options for other in self.slots if other.key == slot.key]
        options: frozenset[str] = frozenset().union(*mentions)
        taken = [value.value for key, value in self.values.items() if base_of(key) == slot.base]
        for _ in range(60):
            value = self._new(slot.key)
            if value.has(options) and (value.value not in taken or slot.base not in self.words):
                break
        return value

    def _new(self, key: str) -> Value:
        owner = self.bound.owners.get(key)
        if owner is None or owner[1].type in ("text", "texts", "id"):
            return self.words.noun(base_of(key), self.rng)
        if key in self.winds:
            return bearing(pick(formulas.WINDS, self.rng), self.rng)
        value = self.sampler.value(*owner, self.rng)
        if owner[0] is LIMIT:
            if value.noun and base_of(key) == "polygon" and self.rng.random() < BOXED:
                return Value(value.value, value.noun)
            if base_of(key) == "speed" and self.rng.random() < SPOKEN_IN_KNOTS:
                return knots(self.rng)
        return value

    def _agree(self) -> None:
        """A series of readings has room for two; mostly, lines fit the width of their grid."""
        values = self.values
        for line in self.lines:
            slot = {fill.parameter.name: fill.slot for fill in line.fills if fill.slot in values}
            if {"interval", "duration"} <= slot.keys():
                every, whole = slot["interval"], slot["duration"]
                for _ in range(50):
                    if 2 * values[every].value <= values[whole].value:
                        break
                    values[every], values[whole] = self._new(every), self._new(whole)
            if {"width", "spacing"} <= slot.keys() and self.rng.random() < FITTING:
                width, lane = values[slot["width"]].value, slot["spacing"]
                for _ in range(20):
                    if any(values[lane].value * count == width for count in range(2, LANES)):
                        break
                    values[lane] = self._new(lane)

    def _owns(self, number: int) -> bool:
        """Whether an apostrophe follows the part: "the barge's"."""
        after = self.parts[number + 1] if number + 1 < len(self.parts) else ""
        return isinstance(after, str) and after.startswith(("'s", "’s"))


def _turn(slot: Slot) -> tuple[int, str]:
    """Places come first; those beside others follow these, by number."""
    if slot.base != "P":
        return 2, ""
    return (1, slot.key) if slot.options - AT_HOME else (0, "")


def is_name(text: str) -> bool:
    """Whether a text has capitals, figures or an article within, so that a slip or a telegram would
    make it another.
    """
    within = {"a", "an", "the"} & set(text.split()[1:])
    return not text.islower() or bool(within) or any(mark.isdigit() for mark in text)
