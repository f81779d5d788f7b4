"""One command in the making: what its template speaks of, its text and what it asks for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from random import Random
from typing import TYPE_CHECKING, Any

from planner_ft.data.formulas import (
    HOME,
    WINDS,
    directions,
    is_formula,
    operands,
    opposite,
    worked_out,
)
from planner_ft.data.mission_binding import CLAUSE, IT, LIMIT, OBJECTS, Bound, Line
from planner_ft.data.mission_plan import Intent, Target, point_text
from planner_ft.data.numbers import WRITTEN, Value, bearing, digits, knots, pick, position
from planner_ft.data.task.values import draw_number, draw_point
from planner_ft.data.templates.grammar import (
    Call,
    Chosen,
    Nodes,
    Slot,
    TemplateError,
    base_of,
    choose,
)
from planner_ft.data.templates.records import Template
from planner_ft.data.templates.render import PIECE, article_for
from planner_ft.facts.geometry import Point, point, tidy
from planner_ft.vocabulary import Task

if TYPE_CHECKING:
    from planner_ft.data.missions import MissionSampler

LOCATED, SOUGHT = 0.5, 0.12
"""Shares of targets said with a position, and of those that the command looks for."""
SPOKEN_IN_KNOTS, BOXED = 0.5, 0.3
"""Shares of the limits of speed in knots, and of the boxes that two of their corners name."""
SIDES = (20, 300)
"""Metres between two opposite corners, each way."""
DOUBTFUL, BARE, FITTING = 0.04, 0.5, 0.6
"""Shares of doubtful positions, bare sizes before another size, spacings that divide the width."""
LANES = 12
PLACED = (
    *(" at {}",) * 26,
    *(" ({})", ", at {},", " at position {}", " over at {}", " out at {}", ", {},"),
    " located at {}",
)
DOUBTS = (
    *(" somewhere near {}", " at about {}", " at roughly {}", ", which should be at {},"),
    *(", probably at {},", " at around {}"),
)
JOINTS = (" by ", " x ", "x", " times ")
UNPLACED = frozenset(("a", "one", "look", "nouns"))
"""Options of mentions that carry no position."""


class Drawing(Chosen):
    """One command in the making: what it speaks of, by slot."""

    def __init__(
        self, sampler: MissionSampler, bound: Bound, template: Template, rng: Random
    ) -> None:
        self.sampler, self.bound, self.template, self.rng = sampler, bound, template, rng
        self.words, self.vocabulary = sampler.words, sampler.vocabulary
        self.targets: dict[str, Target] = {}
        self.values: dict[str, Value] = {}
        self.clauses: dict[str, Drawing] = {}
        self.alike: list[Target] = []
        roll = rng.random()
        self.form = None if roll > 0.85 else WRITTEN[0] if roll < 0.3 else pick(WRITTEN, rng)
        super().__init__(template.nodes, rng)
        self.lines = [line for line in bound.lines if not line.label or line.label in self.labels]
        self.corners = {other: (one, ways) for one, other, ways in opposite(template.plan)}
        self.winds = directions(template.plan)
        self.slots.sort(key=lambda slot: slot.base != "P")
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
            there = self._point(*self.corners.get(key, ()))
            self.targets[key] = Target(key, position=there, doubtful=doubtful)
        elif slot.base == "T":
            self.targets[key] = self._target(slot)
        elif slot.base == "ID":
            name, place = self.words.noun("identity", self.rng), self._bound_place(key)
            self.targets[key] = Target(key, identity=name.value, text=name.text, position=place)
        elif slot.base != CLAUSE:
            self.values[key] = self._value(slot)

    def _point(self, corner: str = "", ways: Sequence[tuple[int, int]] = ()) -> Point:
        """A position; the one opposite a corner where that is given."""
        while True:
            place = draw_point(self.rng)
            if corner in self.targets:
                sides = (way * draw_number(self.rng, *SIDES) for way in pick(ways, self.rng))
                start = self._place_of(corner)
                place = point(*(one + side for one, side in zip(start, sides, strict=True)))
            if place not in (self.vocabulary.home, self.vocabulary.unresolved):
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

    def _kind(self, key: str) -> str:
        return self.bound.kinds.get(key, self.sampler.default)

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
        kind, near = self._kind(key), next((line.near for line in lines if line.near), "")
        target = self._alike(key) if kind == "pair" else self._described(key, kind, fixed, common)
        if key in self.bound.places:
            target = replace(target, position=self._bound_place(key))
        elif not near and kind != "pair" and self._is_located(mentions, lines):
            doubt = rng.random() < DOUBTFUL
            target = replace(target, position=self._point(), doubtful=doubt)
        if near in self.targets:
            target = replace(target, whereabouts=f"near {point_text(self._place_of(near))}")
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
            if not unfit and not (common and _is_name(value.value)):
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
            return bearing(pick(WINDS, self.rng), self.rng)
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

    def _wrong(self, slot: Slot) -> list[PIECE]:
        """What is taken back: of the same kind, and another one."""
        key, rng = slot.key, self.rng
        if slot.base == "P":
            right, point = self._place_of(key), self._point()
            near = (right[0], point[1]) if rng.random() < 0.5 else point
            return [(self._place(near if near != right else point), True)]
        if slot.base == "T":
            kind = self._kind(key)
            kind = self.sampler.default if kind == "pair" else kind
            return self._mention(self._described(key, kind, bool(slot.options), True), slot)
        if slot.base == "ID":
            return [(self.words.noun("identity", rng).text, True)]
        for _ in range(60):
            value = self._new(key)
            unsaid = "adj" in slot.options and not value.short
            if value.value != self.values[key].value and not unsaid:
                break
        return [(self._worded(value, slot), True)]

    # ------------------------------------------------------------ text

    def pieces(self) -> Iterator[PIECE]:
        """The text in pieces, each with whether it is a value."""
        wrong = {slot.key: self._wrong(slot) for slot in self.slots if slot.sign == "~"}
        seen: dict[tuple[str, frozenset[str]], str] = {}
        placed = set(self.bound.places)
        for number, part in enumerate(self.parts):
            if isinstance(part, str):
                yield part, False
            elif part.sign:
                yield from wrong[part.key] if part.sign == "~" else ()
            elif part.base == CLAUSE:
                yield from self.clauses[part.key].pieces() if part.key in self.clauses else ()
            elif part.base == "T":
                unplaced = part.options & (UNPLACED | {"bare"}) or self._owns(number)
                with_place = not unplaced and part.key not in placed
                if with_place or "a" in part.options:
                    placed.add(part.key)
                yield from self._mention(self.targets[part.key], part, with_place=with_place)
            elif part.base == IT:
                yield "it", False
            else:
                key = part.key, part.options
                if key not in seen:
                    seen[key] = self._word(part, number)
                yield seen[key], True

    def _owns(self, number: int) -> bool:
        """Whether an apostrophe follows the part: "the barge's"."""
        after = self.parts[number + 1] if number + 1 < len(self.parts) else ""
        return isinstance(after, str) and after.startswith(("'s", "’s"))

    def _word(self, slot: Slot, number: int) -> str:
        if slot.base == "P":
            return self._place(self._place_of(slot.key))
        if slot.base == "ID":
            return self.targets[slot.key].text
        value, (joint, after) = self.values[slot.key], (*self.parts[number + 1 :], "", "")[:2]
        if joint in JOINTS and isinstance(after, Slot) and self.rng.random() < BARE:
            # "20 by 80 ft" says that the 20 are feet.
            sizes = [one for one in (slot, after) if one.base in ("width", "length")]
            plain_ = [one for one in sizes if not one.options and not one.sign]
            if len(plain_) == 2 and all(_metric(self.values[one.key].text) for one in plain_):
                return digits(value.value)
        return self._worded(value, slot)

    def _worded(self, value: Value, slot: Slot) -> str:
        text = value.worded(slot.options)
        return str(value.value) if text == value.text and slot.base in self.words else text

    def _place(self, point: Point) -> str:
        return position(point, self.rng, self.form).text

    def _mention(self, target: Target, slot: Slot, *, with_place: bool = False) -> list[PIECE]:
        """The target as it is spoken of; ordinary words are no values: they can be mistyped."""
        text, options = target.description or target.text, slot.options
        if "nouns" in options:
            return [(plural(target.noun), False)]
        if "look" in options or "one" in options:
            return [(target.text if "look" in options else f"the {target.text} one", False)]
        kept = _is_name(text) or self.rng.random() < 0.6
        if "a" in options:
            return [(f"{article_for(text)} ", False), (text, kept)]
        named = f"the {text}" if target.article and "bare" not in options else text
        if not with_place or target.position is None:
            return [(named, kept)]
        form = pick(DOUBTS if target.doubtful else PLACED, self.rng)
        place, (before, _brace, after) = self._place(target.position), form.partition("{}")
        if before.endswith("(") and place[0] in "[(":
            before, after = " at ", ""
        return [(named, kept), (before, False), (place, True), (after, False)]

    # ------------------------------------------------------------ plan

    def intents(self) -> list[Intent]:
        """What is asked for, in the order of execution."""
        return [self._intent(line) for line in self.lines]

    def remarks(self) -> list[list[str]]:
        """The template's own constraints, and its assumptions, as the plan holds them."""
        texts = ([self._filled(nodes) for nodes in group] for group in self.template.remarks)
        return [[f"{one[0].upper()}{one[1:].rstrip('.')}." for one in group] for group in texts]

    def _intent(self, line: Line) -> Intent:
        if line.task is None:
            return Intent(self.vocabulary.task[self.vocabulary.transit], home=True)
        said = (key for key in line.objects if base_of(key) != "P" or key in self.said)
        rank = {kind: place for place, kind in enumerate(OBJECTS)}
        key = min(said, key=lambda one: rank.get(base_of(one), 0), default=None)
        if key and key not in self.targets:
            raise TemplateError(f"{line.task.title} needs {{{key}}}, which one alternative lacks")
        part = self._filled(line.part) if line.part else ""
        target = self.targets[key] if key else None
        if line.spot:
            target = Target(f"spot {line.spot}", line.spot, text=line.spot, spot=True)
        return Intent(line.task, target, self._parameters(line, line.task), part=part)

    def _parameters(self, line: Line, task: Task) -> dict[str, Any]:
        """The parameters that are said, in the order of the definition."""
        found: dict[str, Any] = {}
        for parameter, slot, value in line.fills:
            if is_formula(slot):
                value = worked_out(slot, self._worth) if operands(slot) <= self.said else None
            elif slot in self.targets:
                value = self.targets[slot].description
            elif slot in self.values and slot in self.said:
                value = self.values[slot].value
            if value is not None and parameter.type == "texts":
                found.setdefault(parameter.name, []).append(value)
            elif value is not None:
                found.setdefault(parameter.name, value)
        return {name: found[name] for name in task.by_name if name in found}

    def given(self, call: Call) -> dict[str, Any]:
        """The values of a limit or demand by name; a target gives object and position."""
        found: dict[str, Any] = {}
        for argument in call.arguments:
            key, slot = str(argument.value), argument.kind == "slot"
            if slot and (target := self.targets.get(key)):
                found["object"] = target.identity or (target.description and target.name)
                if target.position is not None:
                    found["position"] = [tidy(number) for number in target.position]
            elif slot and key in self.values:
                value, name = self.values[key], argument.name or base_of(key)
                found[name] = value.text if name == "time" else value.value
            else:
                literal = argument.value
                found[argument.name] = tidy(literal) if isinstance(literal, float) else literal
        return found

    def _filled(self, nodes: Nodes) -> str:
        """A text of the plan with what its slots stand for."""
        parts = choose(nodes, self.rng, [])
        return "".join(part if isinstance(part, str) else self._named(part) for part in parts)

    def _named(self, slot: Slot) -> str:
        if target := self.targets.get(slot.key):
            return point_text(self._place_of(slot.key)) if slot.base == "P" else target.name
        if value := self.values.get(slot.key):
            return str(value.value) if slot.base in self.words else value.text
        raise TemplateError(f"a remark needs {{{slot.key}}}, which one alternative lacks")


def _is_name(text: str) -> bool:
    """Whether a text has capitals, figures or an article within, so that a slip or a telegram would
    make it another.
    """
    within = {"a", "an", "the"} & set(text.split()[1:])
    return not text.islower() or bool(within) or any(mark.isdigit() for mark in text)


def _metric(text: str) -> bool:
    return text.endswith(("m", "metres", "meters")) and not text.endswith("km")


def plural(noun: str) -> str:
    """The noun, which does not end in y, for more than one."""
    return f"{noun}es" if noun.endswith(("s", "x", "ch", "sh")) else f"{noun}s"
